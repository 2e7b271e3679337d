"""Formulas and values as objects of other packages, and tables for notebooks."""

from __future__ import annotations

import re
from html import escape
from typing import TYPE_CHECKING, Any

from ._errors import InputError, UnsupportedError

if TYPE_CHECKING:
    from ._native import Problem, Signal

def problem_of(source: tuple[str, str], values: dict[str, Any]) -> Problem:
    """A problem from what it was pickled as."""
    from ._native import Problem

    return Problem._read(*source, values)


def signal_of(problem: Problem, name: str) -> Signal:
    """A signal from what it was pickled as."""
    return problem.signal(name)


def magnitudes(times: Any, unit: str) -> Any:
    """Quantities of pint as plain numbers, in seconds where times have a unit."""
    try:
        return times.to("s" if unit else "").magnitude
    except Exception as error:
        remedy = "give quantities of time, such as t * ureg.us" if unit else "give times as plain numbers"
        raise InputError(f"the times are in `{times.units}`", remedy) from error


_FUNCTIONS = ("cos", "exp", "sin", "sqrt")
_TOKEN = re.compile(r"\s*(?:(?P<number>\d+)|(?P<name>[^\W\d]\w*)|(?P<sign>[-+*/^()]))")


def mpf(text: str) -> Any:
    """A decimal number with all its digits."""
    import mpmath

    with mpmath.workdps(len(text) + 5):
        return mpmath.mpf(text)


def rounded(numerator: int, denominator: int, bits: int, rounding: str) -> Any:
    """A quotient as a number of mpmath."""
    import mpmath

    return mpmath.mp.make_mpf(mpmath.libmp.from_rational(numerator, denominator, bits, rounding))


def sympy_of(formula: str) -> Any:
    """The right side of a formula, whose lines may be broken and end in remarks."""
    import sympy

    lines = [line.partition("#")[0] for line in formula.splitlines()]
    text = " ".join(lines).partition(" = ")[2].strip()
    known: dict[str, Any] = {"Integer": sympy.Integer}
    python, place = "", 0
    while place < len(text):
        token = _TOKEN.match(text, place)
        if token is None:
            raise UnsupportedError(
                f"`{text[place : place + 20]} …` is not translated to SymPy", "use the text or LaTeX"
            )
        place = token.end()
        if token["number"]:
            python += f"Integer({token['number']})"
        elif token["name"]:
            name = token["name"]
            known[f"n_{name}"] = (
                getattr(sympy, name) if name in (*_FUNCTIONS, "pi") else sympy.Symbol(name)
            )
            python += f"n_{name}"
        else:
            python += token["sign"].replace("^", "**")
    return eval(python, {"__builtins__": {}}, known)  # of signs, numbers and these names alone


def table_of(head: list[str], rows: list[list[str]]) -> str:
    """A table in HTML."""

    def row(cells: list[str], tag: str) -> str:
        return "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    return "<table>" + row(head, "th") + "".join(row(cells, "td") for cells in rows) + "</table>"


def html_of(problem: Problem) -> str:
    """What can be asked of a problem."""
    rows = [
        ["symbols without a value", ", ".join(problem.symbols)],
        ["observables", ", ".join(problem.observables)],
        ["waves", ", ".join(problem.waves)],
    ]
    return table_of([problem.title, ""], [row for row in rows if row[1]])

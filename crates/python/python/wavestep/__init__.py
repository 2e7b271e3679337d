"""Exact solutions of wave propagation in bars: formulas, proven digits, NumPy arrays, pictures.

>>> import wavestep as ws
>>> p = ws.scene("rigid-mass", mu=1)
>>> p.signal("velocity")("3/2")
0.22313016014842982

Times and values are ``int``, ``float`` (its exact value), ``Fraction``, ``Decimal``, text such as ``"33/10"`` or,
in scenes with units, ``"120 us"``, or quantities of pint.
"""

from __future__ import annotations

import os

from ._native import SCENES, Curve, Formula, Problem, Signal, Value, __version__, set_memory

# typing takes longer to import than the package.
TYPE_CHECKING = False

if TYPE_CHECKING:
    from ._errors import (
        AccuracyError,
        Diagnostic,
        Error,
        InputError,
        InternalError,
        UndefinedError,
        UnsupportedError,
        WorkError,
    )
    from ._native import _Number
    from ._results import (
        BarField,
        Body,
        Contact,
        Event,
        Extremum,
        Field,
        History,
        Picture,
        Place,
        Root,
        Values,
    )
    from ._sweep import sweep

__all__ = [
    "SCENES",
    "AccuracyError",
    "BarField",
    "Body",
    "Contact",
    "Curve",
    "Diagnostic",
    "Error",
    "Event",
    "Extremum",
    "Field",
    "Formula",
    "History",
    "InputError",
    "InternalError",
    "Picture",
    "Place",
    "Problem",
    "Root",
    "Signal",
    "UndefinedError",
    "UnsupportedError",
    "Value",
    "Values",
    "WorkError",
    "read",
    "scene",
    "set_memory",
    "sweep",
]


if not TYPE_CHECKING:  # so that names which are nowhere are found

    def __getattr__(name):
        """The names above that are imported when they are asked for."""
        from importlib import import_module

        for module in ("_errors", "_results", "_sweep") if name in __all__ else ():
            found = getattr(import_module(f"wavestep.{module}"), name, None)
            if found is not None:
                globals()[name] = found
                return found
        raise AttributeError(f"module 'wavestep' has no attribute '{name}'")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


def scene(name: str, /, **values: _Number) -> Problem:
    """The built-in scene of this name, one of ``SCENES``, with values in place of symbols.

    >>> scene("two-bars").waves
    ['f', 'g', 'F']
    """
    return Problem._builtin(name, values)


def read(text: str | os.PathLike[str], /, **values: _Number) -> Problem:
    """A scene from a file, or from a text, which has several lines.

    >>> p = read('''scene "A"
    ... bar rod { impedance = 1, travel = 1, velocity = 1 }
    ... line free - rod | fixed
    ... observe push = force(rod.right)''')
    >>> p.signal("push")(1)
    1.0
    """
    return Problem._read(*_text(text), values)


def _text(text: str | os.PathLike[str]) -> tuple[str, str]:
    """What errors call a text, and the text."""
    if isinstance(text, str) and "\n" in text:
        return "text", text
    if isinstance(text, str) and set('{"') & set(text):
        from ._errors import InputError

        raise InputError("a text of one line is taken as a file name", "write each statement on a line of its own")
    with open(text, encoding="utf-8") as file:
        return os.fspath(text), file.read()

#!/usr/bin/env python3
"""Writes the pieces of certificates as theorems for Coq: coq/Pieces.v says what they mean, docs/certificates.md how to use them.

The laws are those of laws.py, and pieces.py proves that they have one solution; Coq proves that the pieces are that solution.
"""

import re
import sys
from fractions import Fraction

from check import read_roots
from exact import LATEST, ROOTS, is_count, over_one, read, read_function, terms, thawed
from pieces import check_statement
from reading import MALFORMED, Wrong, files, load, need, printable


class Theory:
    """The text of a theorem. Symbols and denominators are counted; what has been written once has a number."""

    def __init__(self, cert):
        self.cert, self.symbols, self.factors = cert, {}, {}

    def polynomial(self, top):
        """Terms t numerator denominator [x symbol power; ...]."""

        def term(monomial, c):
            powers = (f"x {self.symbols.setdefault(s, len(self.symbols) + 1)} {power}" for s, power in monomial)
            return f"t ({c.numerator}) {c.denominator} [{'; '.join(powers)}]"

        return "p [" + "; ".join(term(monomial, Fraction(c)) for monomial, c in top.items()) + "]"

    def ratio(self, function, time=None):
        """r [powers of factors] [coefficient of time^0; ...]: over one denominator."""
        powers, above = over_one(function)
        for factor in powers:
            self.factors.setdefault(factor, len(self.factors))
        course = {}
        list(terms(function, time))  # no divisor holds the time
        for _, m, c, power in terms(above, time):
            course.setdefault(power, {})[tuple(pair for pair in m if pair[0] != time)] = c
        below = [powers.get(factor, 0) for factor in self.factors] if powers else []
        coefficients = (self.polynomial(course.get(power, {})) for power in range(max(course, default=-1) + 1))
        return f"r [{'; '.join(map(str, below))}] [{'; '.join(coefficients)}]"

    def expression(self, expression, time):
        rows = (f"({self.ratio(thawed(x), time)}, {self.ratio(function, time)})" for x, function in expression.items())
        return "[" + ";\n  ".join(rows) + "]"

    def form(self, form):
        """The waves of a law, and what acts on it."""
        waves, forcing = [], []
        for (wave, kind, lag), coefficient in form.items():
            if kind == "forcing":
                forcing.append(f"({lag}, {self.expression(coefficient, self.cert['time'])})")
                continue
            need(not any(exponent for exponent in coefficient), "the coefficient of a wave holds an exponential")
            number = self.cert["waves"].index(wave)
            waves.append(f"({kind.capitalize()}, {number}, {lag}, {self.ratio(coefficient.get((), {}))})")
        return "{| waves := [" + ";\n  ".join(waves) + "];\n  forcing := [" + ";\n  ".join(forcing) + "] |}"

    def pieces(self):
        """Definitions of all functions of all waves, and the list of their names."""
        lines, names = [], []
        for i, wave in enumerate(self.cert["waves"]):
            own = self.cert["pieces"][wave]
            need(len(own) == self.cert["through"] + 1, "pieces are missing")
            lines += [
                f"Definition w{i}_{n} : expression :=\n  {self.expression(read(rows), self.cert['local'])}."
                for n, rows in enumerate(own)
            ]
            names.append("[" + "; ".join(f"w{i}_{n}" for n in range(len(own))) + "]")
        return lines, "[" + "; ".join(names) + "]"

    def written(self, name):
        """A module of this name."""
        cert = self.cert
        read_roots(cert)
        need(cert["kind"] == "pieces" and is_count(cert["through"], LATEST), "this is no certificate of pieces")
        need(type(cert["waves"]) is list and set(cert["pieces"]) == set(cert["waves"]), "waves and pieces")
        need(not ROOTS, "pieces with square roots are not written for Coq")
        period = read_function(cert["period"])
        need(set(period) <= {()}, "a period with a denominator is not written for Coq")
        equations, continuity = check_statement(cert)
        lines, pieces = self.pieces()
        laws = ";\n  ".join(map(self.form, equations))
        starts = ";\n  ".join(f"({self.form(form)}, {self.expression(start, cert['time'])})" for form, start in continuity)
        claim = {"equations": f"[{laws}]", "continuity": f"[{starts}]", "period": self.polynomial(period.get((), {}))}
        claim |= {"through": cert["through"], "pieces": pieces}
        claim["factors"] = "[" + "; ".join(self.polynomial(dict(factor)) for factor in self.factors) + "]"  # all are known now
        symbols = ", ".join(f"{number} {symbol}" for symbol, number in self.symbols.items())
        about = re.sub(
            '[(*)"]', " ", printable(f"{cert['title']}; waves {', '.join(cert['waves'])}; symbols {symbols or 'none'}")
        )
        return [
            f"(* {about} *)",
            f"Module {name}.",
            *lines,
            "Definition claim : certificate := {|",
            ";\n".join(f"  {key} := {what}" for key, what in claim.items()),
            "|}.",
            "Theorem proven symbols : divides_by_nonzero claim symbols -> holds claim symbols.",
            "Proof. intro nonzero. apply checked; [exact nonzero | vm_cast_no_check (eq_refl true)]. Qed.",
            f"End {name}.",
            "",
        ]


def main():
    names = files("CERTIFICATE.json ... > THEORY.v")
    lines, modules = ["From Wavestep Require Import Pieces.", ""], [f"Certificate{i + 1}" for i in range(len(names))]
    for module, name in zip(modules, names):
        try:
            lines += Theory(load(name)).written(module)
        except (Wrong, OSError) as error:
            sys.exit(printable(f"{name}: {error}"))
        except MALFORMED as error:
            sys.exit(printable(f"{name}: it is not laid out as it should be: {error!r}"))
    all_ = ", ".join(f"{module}.proven" for module in modules)
    print("\n".join(lines + [f"Definition proven := ({all_}).", "Print Assumptions proven."]))


if __name__ == "__main__":
    main()

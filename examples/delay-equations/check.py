"""Checks problems.json without wavestep: `python check.py`, with mpmath and SymPy alone.

In each delay the solution is expanded in a Taylor series, whose coefficients follow from those of the delays before.
The series converge everywhere; 240 terms in numbers of 150 digits are summed at the times of the file.
"""

import json
import pathlib
import sys

import mpmath as mp
import sympy as sp

TERMS, DIGITS = 240, 150
t = sp.Symbol("t")


def taylor(text, at):
    """The series of an expression in t about a place, by differentiation."""
    place, found, factorial = sp.Rational(at), [], mp.mpf(1)
    derivative = sp.sympify(text, {"t": t})
    cycle = {}  # the derivatives of cos(2*t) come again but for a factor; evaluate each once
    for j in range(TERMS):
        if derivative == 0:
            return found + [mp.mpf(0)] * (TERMS - j)
        factor, rest = derivative.as_coeff_Mul()
        if rest not in cycle:
            cycle[rest] = mp.mpf(sp.N(rest.subs(t, place), DIGITS))
        found.append(mp.mpf(factor.p) / factor.q * cycle[rest] / factorial)
        factorial *= j + 1
        derivative = sp.expand(sp.diff(derivative, t))
    return found


def mpf(text):
    return mp.mpf(sp.Rational(text).p) / sp.Rational(text).q


def solution(p):
    """x at the times of a problem."""
    order, delay, start = p["order"], sp.Rational(p["delay"]), [mpf(s) for s in p["start"]]
    terms = [(mpf(e["c"]), e["derivative"], e["lag"]) for e in p["terms"]]
    deepest = max(lag for _, _, lag in terms)
    pieces = [taylor(p["history"], -k * delay) for k in range(deepest, 0, -1)]
    last = max(sp.Rational(time) for time in p["values"]) // delay
    width, jump = mpf(delay), []
    rising = [[mp.rf(i + 1, j) for j in range(3)] for i in range(TERMS)]  # (i + j)!/i!
    for n in range(int(last) + 1):
        force = taylor(p["forcing"], n * delay) if p["forcing"] != "0" else [mp.mpf(0)] * TERMS
        x = [mp.mpf(0)] * TERMS
        x[0] = mp.polyval(pieces[-1][::-1], width)
        if order == 2:
            x[1] = mp.polyval([i * c for i, c in enumerate(pieces[-1])][:0:-1], width)
        # What is continuous is the highest derivative but one, less its neutral terms.
        if n == 0:
            leap = start[-1] - taylor(p["history"], 0)[order - 1]  # (order - 1)! is 1
        else:
            leap = mp.fsum(c * jump[n - lag] for c, j, lag in terms if j == order and n >= lag)
        jump.append(leap)
        if n == 0:
            x[:order] = start
        else:
            x[order - 1] += leap
        for i in range(TERMS - order):
            value = force[i]
            for c, j, lag in terms:
                piece = pieces[-lag] if lag else x
                value += c * rising[i][j] * piece[i + j]
            x[i + order] = value / rising[i][order]
        pieces.append(x)
    at = [sp.Rational(time) for time in p["values"]]
    return [mp.polyval(pieces[deepest + int(s // delay)][::-1], mpf(s % delay)) for s in at]


if __name__ == "__main__":
    mp.mp.dps = DIGITS
    file = pathlib.Path(__file__).parent / "problems.json"
    problems, worst = json.loads(file.read_text(encoding="utf-8")), mp.mpf(0)
    for p in problems:
        for time, mine, given in zip(p["values"], solution(p), map(mp.mpf, p["values"].values())):
            error = abs(mine - given) / (abs(given) or 1)
            worst = max(worst, error)
            if error > mp.mpf(10) ** -99:
                sys.exit(f"{p['name']} at {time}: {mp.nstr(mine, 110)} is not {mp.nstr(given, 110)}")
    print(f"{len(problems)} problems, largest relative difference {mp.nstr(worst, 2)}")

"""Runs wavestep beside other tools on the same problems, and writes the table into docs/comparison.md."""

import contextlib
import importlib.metadata
import io
import json
import pathlib
import sys
import time

import mpmath as mp
import numpy as np
import sympy as sp

import wavestep as ws

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "delay-equations"))
from make import scene  # noqa: E402
from solvers import SOLVERS, error, place, processor, short  # noqa: E402

PROBLEMS = {p["name"]: p for p in json.loads((HERE.parent / "delay-equations/problems.json").read_text())}
s, mu, E = sp.symbols("s mu E")
mp.mp.dps = 130


def timed(work, times=3):
    """The result, and the least processor time of a few runs after the first."""
    found, spent = None, []
    for _ in range(times + 1):
        begun = time.process_time()
        found = work()
        spent.append(time.process_time() - begun)
        if spent[0] > 2:
            return found, spent[0]
    return found, min(spent[1:])


def pieces(count, a, b, c, delay, decay, history, start, one, derivative, integral):
    """P[n] of x[n] = exp(-a s) P[n](s) for x' = -a x + b x(t - delay) + c x'(t - delay); decay is exp(-a delay)."""
    before, found, jump, value = history * one, [], start - history, start
    for _ in range(count):
        found.append(integral(b * before + c * (derivative(before) - a * before)) + value * one)
        before, jump = found[-1], c * jump
        value = decay * before(delay) + jump
    return found


def places(p):
    delay = sp.Rational(p["delay"])
    times = [sp.Rational(text) for text in p["values"]]
    return [(int(at // delay), at % delay) for at in times]


def parameters(p):
    given = {(e["derivative"], e["lag"]): sp.Rational(e["c"]) for e in p["terms"]}
    a, b, c = (given.get(place, sp.Integer(0)) for place in [(0, 0), (0, 1), (1, 1)])
    return -a, b, c, sp.Rational(p["delay"]), sp.Rational(p["history"]), sp.Rational(p["start"][0])


def by_wavestep(p):
    signal = ws.read(p["scene"]).signal("x")
    return [mp.mpf(str(signal.digits(text, 100).decimal(100))) for text in p["values"]]


def by_wavestep_doubles(p):
    signal = ws.read(p["scene"]).signal("x")
    return [mp.mpf(signal(text)) for text in p["values"]]


def by_sympy(p):
    a, b, c, delay, history, start = parameters(p)
    one = sp.Poly(1, s, domain=sp.QQ[E])
    found = pieces(places(p)[-1][0] + 1, a, b, c, delay, E, history, start, one, sp.Poly.diff, sp.Poly.integrate)
    exact = [sp.exp(-a * at) * found[n](at).subs(E, sp.exp(-a * delay)) for n, at in places(p)]
    return [mp.mpf(str(sp.N(x, 110))) for x in exact]


def by_flint(p):
    import flint

    flint.ctx.prec = 500
    a, b, c, delay, history, start = [flint.arb(flint.fmpq(int(x.p), int(x.q))) for x in parameters(p)]
    count = places(p)[-1][0] + 1
    one, decay = flint.arb_poly([1]), (-a * delay).exp()
    found = pieces(
        count, a, b, c, delay, decay, history, start, one, flint.arb_poly.derivative, flint.arb_poly.integral
    )
    values = []
    for n, at in places(p):
        at = flint.arb(flint.fmpq(int(at.p), int(at.q)))
        ball = (-a * at).exp() * found[n](at)
        assert float(ball.rad()) <= 1e-100 * abs(float(ball.mid()))
        values.append(mp.mpf(ball.mid().str(120, radius=False)))
    return values


def formula_by_wavestep():
    return ws.scene("rigid-mass").derive("f", 8)[0]


def formula_by_sympy():
    one = sp.Poly(1, s, domain=sp.QQ[mu, E])
    found = pieces(9, 1, -1, 1, 2 * mu, E, 0, 1, one, sp.Poly.diff, sp.Poly.integrate)
    return sp.exp(-s) * found[8].as_expr().subs(E, sp.exp(-2 * mu))


def bars(length):
    return f"""scene "Two bars"
material steel {{ modulus = 210 GPa, density = 7850 kg/m^3 }}
bar striker {{ material = steel, diameter = 20 mm, length = 300 mm, velocity = 10 m/s }}
bar rod {{ material = steel, diameter = 16 mm, length = {length} mm }}
line free - striker | rod - free
contacts open
observe push = force(rod.at(1/2))
"""


def bars_by_elwaspatid(length):
    import elwaspatid

    with contextlib.redirect_stdout(io.StringIO()):
        bar = elwaspatid.BarSet([210e9] * 2, [7850] * 2, [0.3, length / 1000], [0.02, 0.016], nmin=20)
        run = elwaspatid.WP2(bar, nstep=int(6e-4 / bar.dt), Vinit=10)
    rod = bar.seg[1]
    middle = abs(rod.xloc - length / 2000).argmin()
    return run.time, -rod.Force[:, middle]


def main():
    names = ["wavestep", "sympy", "python-flint", "scipy", "jitcdde", "diffrax", "elwaspatid"]
    versions = {}
    for name in names:
        with contextlib.suppress(importlib.metadata.PackageNotFoundError):
            versions[name] = importlib.metadata.version(name)
    rows = ["| problem | tool | time | how far off |", "|---|---|---|---|"]

    def row(problem, tool, spent, off):
        rows.append(f"| {problem} | {tool} | {spent} | {off} |")
        print(rows[-1], flush=True)

    formula, spent = timed(formula_by_wavestep)
    row("formula of f₈(s), with μ as a symbol", "wavestep", short(spent), "exact")
    other, spent = timed(formula_by_sympy)
    same = sp.expand(formula.sympy() - other) == 0
    row("", "SymPy", short(spent), "exact" if same else "**differs**")

    for name, title in [
        ("neutral-jump-2", "`neutral-jump-2`: a mass strikes a bar, 25 round trips"),
        ("pure-delay-4", "`pure-delay-4`: x' = −2 x(t − 1), 25 delays"),
    ]:
        p = PROBLEMS[name]
        p["scene"] = scene(p)
        exact = [mp.mpf(value) for value in p["values"].values()]
        largest = max(map(abs, exact))
        for tool, work in [
            ("wavestep, 100 digits", by_wavestep), ("wavestep, doubles", by_wavestep_doubles),
            ("SymPy, 110 digits", by_sympy), ("python-flint, balls", by_flint),
        ]:
            if work is by_flint and "python-flint" not in versions:
                continue
            found, spent = timed(lambda work=work: work(p))
            off = max(abs(x - y) for x, y in zip(found, exact)) / largest
            row(title, tool, short(spent), f"{float(off):.0e}" if off else "the reference")
            title = ""
        for tool, (work, _) in SOLVERS.items():
            if tool.lower() not in versions:
                continue
            found, spent, prepared = work(p)
            ready = f" after {short(prepared)}" if prepared else ""
            row("", tool, short(spent) + ready, f"{error(p, found):.0e}")

    if "elwaspatid" in versions:
        for length in (900, 910):
            (times, force), spent = timed(lambda: bars_by_elwaspatid(length))
            signal = ws.read(bars(length)).signal("push")
            breaks = np.array([float(at) for at in signal.breaks(0, "700 us")])
            # Where a step falls on a front, either side will do: compare the others.
            clear = np.array([abs(breaks - at).min() > times[1] / 4 for at in times])
            exact, own = timed(lambda: ws.read(bars(length)).signal("push")(times))
            row(f"two bars, 300 and {length} mm: force", "wavestep", short(own), "each the nearest double, as proven")
            off = abs(force - exact)[clear].mean() / abs(exact).max()
            row("", "elwaspatid, 20 cells in the striker", short(spent), f"{off:.0e} on average")
    rows.extend(["", "Versions: " + ", ".join(f"{name} {version}" for name, version in versions.items())
                 + f"; Python {sys.version.split()[0]}, one core of {processor()}."])
    missing = [name for name in names if name not in versions]
    if missing:
        rows.append(f"Not installed: {', '.join(missing)}.")
    place(HERE.parents[1] / "docs/comparison.md", rows)


if __name__ == "__main__":
    main()

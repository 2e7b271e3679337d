"""The problems of problems.json in SciPy, JiTCDDE and diffrax: each gives x at the times, the
processor time, and the time to compile before that.

SciPy and diffrax know no delays. They use the method of steps with the pieces of all delays side by side, x_n(s) for
x(n*delay + s), so that nothing is interpolated; neutral terms are eliminated from the piece before to the piece after.
"""

import contextlib
import logging
import tempfile
import time
import warnings

import numpy as np
import sympy as sp

t = sp.Symbol("t")
logging.getLogger("jax").setLevel(logging.ERROR)  # JiTCDDE has setuptools make everybody talk


def parsed(text):
    return sp.sympify(text, {"t": t})


class Steps:
    """A problem as the system U' = A U + G(s) of its pieces, U[j] the derivative of order j of all pieces."""

    def __init__(self, p):
        self.order, self.delay = p["order"], float(sp.Rational(p["delay"]))
        self.times = [sp.Rational(time) for time in p["values"]]
        self.places = [(int(at // sp.Rational(p["delay"])), float(at % sp.Rational(p["delay"]))) for at in self.times]
        self.count = self.places[-1][0] + 1
        phi, force = parsed(p["history"]), parsed(p["forcing"])
        inside = np.zeros((self.order + 1, self.count, self.count))
        given = [force.subs(t, t + n * sp.Rational(p["delay"])) for n in range(self.count)]
        for term in p["terms"]:
            j, k = term["derivative"], term["lag"]
            inside[j] += float(sp.Rational(term["c"])) * np.eye(self.count, k=-k)
            for n in range(min(k, self.count)):
                past = sp.diff(phi, t, j).subs(t, t + (n - k) * sp.Rational(p["delay"]))
                given[n] += sp.Rational(term["c"]) * past
        self.solved = np.linalg.inv(np.eye(self.count) - inside[self.order])
        self.matrix = self.solved @ np.hstack(list(inside[: self.order]))
        self.given = given
        self.start = [float(sp.Rational(s)) for s in p["start"]]
        ends = float(sp.diff(phi, t, self.order - 1).subs(t, 0))
        jump = np.zeros(self.count)
        jump[0] = self.start[-1] - ends
        self.jump = self.solved @ jump

    def right_side(self, np, name):
        """U' in NumPy, or in what has its functions."""
        given = sp.lambdify(t, self.given, name)

        def rate(s, u):
            force = np.stack([np.asarray(g, dtype=float) for g in given(s)])
            return np.concatenate([u[self.count :], self.matrix @ u + self.solved @ force])

        return rate

    def march(self, solve):
        """`solve(u, places)` gives U at these local times and at the end of the delay."""
        u, end, found = np.zeros(self.order * self.count), None, {}
        for n in range(self.count):
            for j in range(self.order):
                u[j * self.count + n] = self.start[j] if n == 0 else end[j * self.count + n - 1]
            if n:
                u[(self.order - 1) * self.count + n] += self.jump[n]
            places = [s for m, s in self.places if m == n]
            *at, end = solve(u, places)
            found.update({(n, s): float(v[n]) for s, v in zip(places, at)})
        return [found[place] for place in self.places]


def scipy_steps(p, tolerance=1e-12):
    from scipy.integrate import solve_ivp

    steps = Steps(p)
    begun = time.process_time()
    rate = steps.right_side(np, "numpy")

    def solve(u, places):
        run = solve_ivp(rate, (0, steps.delay), u, "DOP853", [*places, steps.delay], rtol=tolerance, atol=tolerance)
        return list(run.y.T)

    return steps.march(solve), time.process_time() - begun, 0.0


def diffrax_steps(p, tolerance=1e-12):
    import diffrax
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)
    steps = Steps(p)
    rate = steps.right_side(jnp, "jax")
    control = diffrax.PIDController(rtol=tolerance, atol=tolerance)
    term = diffrax.ODETerm(lambda s, u, _: rate(s, u))
    slots = max(sum(m == n for m, _ in steps.places) for n in range(steps.count))

    @jax.jit
    def run(u, at):
        save = diffrax.SaveAt(ts=at)
        return diffrax.diffeqsolve(
            term, diffrax.Dopri8(), 0.0, steps.delay, None, u, saveat=save, stepsize_controller=control
        ).ys

    def solve(u, places):
        at = sorted([*places, *[steps.delay] * (slots + 1 - len(places))])
        found = list(np.array(run(jnp.array(u), jnp.array(at))))
        return [*found[: len(places)], found[-1]]

    begun = time.perf_counter()
    steps.march(solve)
    prepared = time.perf_counter() - begun
    begun = time.process_time()
    return steps.march(solve), time.process_time() - begun, prepared


def jitcdde_run(p, tolerance=1e-9):
    import jitcdde as jit
    import symengine

    class Keeping(jit.jitcdde):
        """Keeps all of the past, so that values can be taken from it in the end."""

        max_delay = property(lambda _: 1e9, lambda _, given: None)

    order, delay = p["order"], sp.Rational(p["delay"])
    ends = [sp.diff(parsed(p["history"]), t, j).subs(t, 0) for j in range(order)]
    leap = np.array([float(sp.Rational(start) - end) for start, end in zip(p["start"], ends)])
    total = symengine.sympify(parsed(p["forcing"])).subs(symengine.Symbol("t"), jit.t)
    for term in p["terms"]:
        c, j, k = symengine.sympify(sp.Rational(term["c"])), term["derivative"], term["lag"]
        past = jit.t - symengine.sympify(delay * k)
        total += c * (jit.dy(j - 1, past) if j == order else jit.y(j, past) if k else jit.y(j))
    begun = time.perf_counter()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        times = [float(sp.Rational(time)) for time in p["values"]]
        longest = float(delay) * max(term["lag"] for term in p["terms"])
        system = Keeping([*[jit.y(j) for j in range(1, order)], total], verbose=False)
        system.set_integration_parameters(rtol=tolerance, atol=tolerance)
        phi = [sp.lambdify(t, sp.diff(parsed(p["history"]), t, j)) for j in range(order)]
        system.past_from_function(lambda at: [float(f(at)) for f in phi], np.linspace(-longest, 0, 10), tol=9)
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            system.compile_C()  # it would read a pyproject.toml that lies about
    compiled = time.perf_counter() - begun
    begun = time.process_time()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        if leap.any():
            system.jump(leap, 0.0)  # over a width of 1e-5
        else:
            system.step_on_discontinuities()
        system.integrate(times[-1])
        solution = system.get_state()
    spent = time.process_time() - begun
    found = [float(solution.get_state(at)[0]) for at in times]
    return found, spent, compiled


SOLVERS = {
    "SciPy": (scipy_steps, "method of steps with `solve_ivp`, DOP853, tolerance 1e-12"),
    "JiTCDDE": (jitcdde_run, "its own third-order method with C code, tolerance 1e-9, a jump at the start smeared over 1e-5"),
    "diffrax": (diffrax_steps, "method of steps with `Dopri8`, tolerance 1e-12"),
}


def error(p, found):
    """The largest error, over the largest value of the problem."""
    exact = [float(value) for value in p["values"].values()]
    return max(abs(a - b) for a, b in zip(found, exact)) / max(abs(b) for b in exact)


def short(seconds):
    scale, unit = next(((k, u) for k, u in [(1, "s"), (1e-3, "ms"), (1e-6, "µs")] if seconds >= k), (1e-9, "ns"))
    return f"{float(f'{seconds / scale:.2g}'):g} {unit}"


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        return next((line.split(": ")[1].strip() for line in file if line.startswith("model name")), "unknown")


def place(page, lines):
    """Puts lines between the marks of a page."""
    head, rest = page.read_text(encoding="utf-8").split("<!-- measured -->\n")
    tail = rest.split("<!-- end -->\n")[1]
    text = "\n".join(lines)
    page.write_text(f"{head}<!-- measured -->\n{text}\n<!-- end -->\n{tail}", encoding="utf-8")

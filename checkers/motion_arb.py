"""The motion of a line whose contacts push and never pull, over Arb: a second opinion, which shares nothing with motion.py.

The laws of all runs, elements and contacts are one linear system, whose inverse gives velocities, accelerations and forces at
once. A motion is bounded on a step by its start and by what arrives, in the largest norm; so are all its derivatives, and with
them Lagrange's remainder of its Taylor polynomial. Numbers are rational while they are short, and balls of Arb after that.
"""

import json
from fractions import Fraction
from itertools import product as pairs
from math import frexp

import flint
from flint import arb, fmpq

from reading import Undecided, decided, need
from series_arb import (
    Length,
    NIL,
    derivative,
    dot,
    rational,
    horner,
    interval,
    is_nil,
    moved,
    product,
    short,
    sign,
    size,
    span,
    stays_positive,
)

SPARE = 70  # bits beside a local contact of which none are lost to the orders that are left out
ELEMENTS = {
    **dict.fromkeys(("free", "fixed", "endless", "contact"), {"is"}),
    **dict.fromkeys(("spring", "support"), {"is", "name", "stiffness", "damping"}),
    "bar": {"is", "name", "impedance", "travel", "velocity", "force"},
    "gap": {"is", "width"},
    "local": {"is", "name", "force", "compression", "exponent"},
    "mass": {"is", "name", "mass", "velocity"},
    **dict.fromkeys(("force", "velocity"), {"is", "name", "course", "from", "until"}),
}


def distinct(terms):
    """The terms of a polynomial, none of which is zero or stands twice."""
    keys = {tuple(sorted(names.items())) for _, names in terms}
    need(len(keys) == len(terms) and all(rational(c) != 0 for c, _ in terms), "a term stands twice, or is zero")
    return terms


class Parts:
    """The elements of the line in numbers."""

    def __init__(self, cert):
        self.roots = {name: rational(text) for name, text in cert["roots"].items()}
        self.numbers = {name: interval(ends) for name, ends in cert["numbers"].items()}
        need(not self.numbers.keys() & (self.roots.keys() | {cert["time"]}), "a name stands for two numbers")
        self.time, line = cert["time"], cert["line"]
        need(type(self.time) is str and self.time not in self.roots, "the time has no name of its own")
        need("pi" not in {self.time, *self.roots, *self.numbers}, "pi is the number")
        self.numbers["pi"] = arb.pi()
        need(all(set(own) == ELEMENTS[own["is"]] for own in line), "an element has other keys")
        ends = {"free", "fixed", "endless"}
        need(
            len(line) >= 3 and all((own["is"] in ends) == (i in (0, len(line) - 1)) for i, own in enumerate(line)),
            "a line has two ends",
        )
        self.links, self.mass, self.momentum, self.fixed, self.endless = [], [NIL], [NIL], [False], [False]
        self.supports, self.loads, self.given = [], [], {}
        self.named, self.masses = {}, {}
        for own in line:
            run = len(self.mass) - 1
            if "name" in own:
                need(type(own["name"]) is str and own["name"] not in self.named, "two elements have one name")
                places = {**dict.fromkeys(("bar", "spring", "local"), len(self.links)), "support": len(self.supports)}
                self.named[own["name"]] = own["is"], places.get(own["is"], run)
            if own["is"] in ("bar", "spring", "local", "contact", "gap"):
                keys = {"bar": ("impedance", "velocity", "force"), "spring": ("stiffness", "damping"), "gap": ("width",)}
                keys["local"] = ("force", "compression")
                link = {"is": own["is"], **{key: self.number(own[key]) for key in keys.get(own["is"], ())}}
                need(own["is"] != "gap" or sign(link["width"]) == 1, "a gap has no width")
                link["is"] = "contact" if own["is"] == "gap" else own["is"]
                if own["is"] == "bar":
                    link["travel"] = None if own["travel"] is None else self.length(own["travel"])
                    link["rows"] = own["travel"]
                    need(sign(link["impedance"]) == 1, "an impedance is not positive")
                if own["is"] == "local":
                    link["exponent"] = rational(own["exponent"])
                    top, below = int(link["exponent"].p), int(link["exponent"].q)
                    need(below <= top <= 1000 and below <= 100, "the force of a local contact has a steep beginning, or a huge exponent")
                    need(cert["bits"] > SPARE, "a local contact needs more bits")
                    need(sign(link["force"]) == sign(link["compression"]) == 1, "a local contact without stiffness")
                self.links.append(link)
                for values, new in ((self.mass, NIL), (self.momentum, NIL), (self.fixed, False), (self.endless, False)):
                    values.append(new)
            elif own["is"] == "mass":
                mass = self.number(own["mass"])
                need(sign(mass) == 1, "a mass is not positive")
                self.masses[own["name"]] = mass
                self.mass[run] = short(self.mass[run] + mass)
                self.momentum[run] = short(self.momentum[run] + product(mass, self.number(own["velocity"])))
            elif own["is"] == "support":
                self.supports.append((run, self.number(own["stiffness"]), self.number(own["damping"])))
            elif own["is"] in ("force", "velocity"):
                if own["is"] == "velocity":
                    need(run not in self.given, "a place moves in two ways")
                    self.given[run] = len(self.loads)
                self.loads.append((run, self.load(own)))
            elif own["is"] in ("fixed", "endless"):
                (self.fixed if own["is"] == "fixed" else self.endless)[run] = True
            else:
                need(own["is"] == "free", "an element whose law is not known here")
        need(len(self.mass) <= 64, "a line is too long")
        for i, link in enumerate(self.links):
            far = self.endless[i] or self.endless[i + 1]
            need(not far or link["is"] == "bar" and link["travel"] is None, "an endless end without an endless bar")
            need(link["is"] != "bar" or far == (link["travel"] is None), "a bar has no length")
            decided(link["is"] != "bar" or far or sign(link["travel"].value()) == 1, "a bar has no length")
            need(
                link["is"] != "spring" or all(sign(link[key]) in (0, 1) for key in ("stiffness", "damping")),
                "stiffness or damping may be negative",
            )
        for run, far in enumerate(self.endless):
            alone = is_nil(self.mass[run]) and all(run != own[0] for own in self.supports + self.loads)
            need(not far or alone, "something stands at an endless end")
        need(all(sign(c) in (0, 1) for _, *pair in self.supports for c in pair), "stiffness or damping may be negative")
        self.contacts = [i for i, link in enumerate(self.links) if link["is"] == "contact"]
        for run in self.given:  # what contacts may hold to it has no inertia, nor has it itself
            near = {run}
            while more := {i + side for i in self.contacts for side in (0, 1) if near & {i, i + 1}} - near:
                near |= more
            light = all(is_nil(self.mass[own]) and not self.fixed[own] for own in near)
            need(light and near & self.given.keys() == {run}, "a mass, a wall or another load touches what moves as a load says")
        self.locals = [i for i, link in enumerate(self.links) if link["is"] == "local"]

    def polynomial(self, terms):
        total = NIL
        for c, powers in distinct(terms):
            term = rational(c)
            for name, power in powers.items():
                need(type(power) is int and 0 < power <= 10**4, "a power is no positive integer")
                if name in self.numbers:
                    base = self.numbers[name]
                else:
                    need(name in self.roots and self.roots[name] > 0, f"{name} has no value")
                    base = arb(self.roots[name]).sqrt()
                term = product(term, base**power)
            total = short(total + term)
        return total

    def number(self, rows):
        need(type(rows) is list, "a number is no list")
        total = NIL
        for top, factors in rows:
            need(type(factors) is list, "factors are no list")
            below = fmpq(1)
            for factor, power in factors:
                need(type(power) is int and 0 < power <= 10**4, "a power is no positive integer")
                below = product(below, self.polynomial(factor) ** power)
            decided(sign(below) in (1, -1), "a divisor may be zero")
            total = short(total + self.polynomial(top) / below)
        return total

    def is_sum(self, parts, whole):
        """Whether numbers add up to another one for all values of what they hold: over one denominator all terms cancel."""
        rows, total = [(1, *row) for part in parts for row in part] + [(-1, *row) for row in whole], {}
        for i, (way, top, _) in enumerate(rows):
            lifted = self.expanded(top)
            for factor, power in (own for j, (_, _, factors) in enumerate(rows) if j != i for own in factors):
                need(type(power) is int and 0 < power <= 100, "a power of a factor is too large")
                for _ in range(power):
                    lifted = self.multiplied(lifted, self.expanded(factor))
            for names, c in lifted.items():
                total[names] = total.get(names, NIL) + way * c
        return all(c == 0 for c in total.values())

    def expanded(self, terms):
        return self.multiplied({tuple(sorted(names.items())): rational(c) for c, names in distinct(terms)}, {(): fmpq(1)})

    def multiplied(self, a, b):
        """Two polynomials, where squares of roots are numbers."""
        found = {}
        for left, x in a.items():
            for right, y in b.items():
                powers, value = dict(left), x * y
                for name, power in right:
                    powers[name] = powers.get(name, 0) + power
                for name in powers.keys() & self.roots.keys():
                    value *= self.roots[name] ** (powers[name] // 2)
                    powers[name] %= 2
                key = tuple(sorted((name, power) for name, power in powers.items() if power))
                found[key] = found.get(key, NIL) + value
        return found

    def length(self, rows):
        """A length of time: those that are multiples of each other count in one unit."""
        value = self.number(rows)
        if isinstance(value, fmpq):
            return Length(value)
        first = rational(rows[0][0][0][0])
        unit = [[[[str(rational(c) / first), names] for c, names in top], factors] for top, factors in rows]
        return Length(0, {json.dumps(unit): [first, value / first]})

    def load(self, own):
        begin, end = (None if own[key] is None else self.length(own[key]) for key in ("from", "until"))
        begin = begin if begin is not None else Length()
        decided(sign(begin.value()) in (0, 1), "a load may begin early")
        decided(end is None or sign(end.plus(begin, -1).value()) == 1, "a load may end before it begins")
        parts = lambda course: sorted([self.plain(exponent), self.plain(function)] for exponent, function in course)
        need(parts(own["course"]) == parts(self.conjugate(own["course"])), "a load is not real")
        return {"course": own["course"], "from": begin, "until": end}

    def conjugate(self, rows):
        """The same with -i in place of i."""
        imaginary = {name for name, square in self.roots.items() if square == -1}
        if isinstance(rows, list) and len(rows) == 2 and isinstance(rows[0], str) and isinstance(rows[1], dict):
            is_odd = sum(power for name, power in rows[1].items() if name in imaginary) % 2
            return [str(-Fraction(rows[0])) if is_odd else rows[0], rows[1]]
        return [self.conjugate(row) for row in rows] if isinstance(rows, list) else rows

    def plain(self, rows):
        """The same with numbers written in one way, and terms in one order."""
        if isinstance(rows, list) and len(rows) == 2 and isinstance(rows[0], str) and isinstance(rows[1], dict):
            return json.dumps([str(Fraction(rows[0])), sorted(rows[1].items())])
        return json.dumps(sorted(self.plain(row) for row in rows) if isinstance(rows, list) else rows)

    def complex(self, rows):
        """A rational function of time: its powers, in complex numbers."""
        powers = {}
        for top, factors in rows:
            need(type(factors) is list, "factors are no list")
            need(all(self.time not in names for factor, _ in factors for _, names in factor), "a divisor holds the time")
            below = flint.acb(1)
            for factor, power in factors:
                need(type(power) is int and 0 < power <= 10**4, "a power is no positive integer")
                below *= self.complex([[factor, []]]).get(0, flint.acb(0)) ** power
            decided(not below.contains(0), "a divisor may be zero")
            for c, names in distinct(top):
                term, power = flint.acb(rational(c)), 0
                for name, exponent in names.items():
                    need(type(exponent) is int and 0 < exponent <= 10**4, "a power is no positive integer")
                    if name == self.time:
                        power = exponent
                    elif name in self.numbers:
                        term *= flint.acb(self.numbers[name]) ** exponent
                    else:
                        need(name in self.roots, f"{name} has no value")
                        term *= flint.acb(self.roots[name]).sqrt() ** exponent
                powers[power] = powers.get(power, flint.acb(0)) + term / below
        return powers

    def is_polynomial(self, course):
        """The coefficients of a course that is a polynomial with rational numbers."""
        coefficients = {}
        for exponent, function in course:
            if exponent or any(factors for _, factors in function):
                return None
            for top, _ in function:
                for c, names in distinct(top):
                    if names.keys() - {self.time}:
                        return None
                    power = names.get(self.time, 0)
                    need(not names or type(power) is int and 0 < power <= 10**4, "a power is no positive integer")
                    coefficients[power] = coefficients.get(power, NIL) + rational(c)
        return coefficients

    def pushes(self, load, begin, step, order):
        """The Taylor coefficients of a load in whole steps from a time on."""
        known = self.is_polynomial(load["course"])
        if known is not None:
            need(all(power <= order for power in known), "a load has too high a power")
            series = [known.get(k, NIL) for k in range(order + 1)]
            return [short(c * step**k) for k, c in enumerate(moved(series, begin))]

        def turn(exponent):
            """r where an exponent is i pi r at the beginning, and grows by a multiple of i pi."""
            if not isinstance(begin, fmpq) or any(factors for _, factors in exponent):
                return None
            i, r = next((name for name, square in self.roots.items() if square == -1), None), NIL
            for c, names in (term for top, _ in exponent for term in top):
                if names.get("pi") != 1 or names.get(i) != 1 or names.keys() - {"pi", i, self.time}:
                    return None
                r += rational(c) * begin ** names.get(self.time, 0)
            return r

        def at(time, is_begin):
            total = flint.acb_series([0], prec=order + 1)
            t = flint.acb_series([time, step], prec=order + 1)
            for exponent, function in load["course"]:
                linear, powers = self.complex(exponent), self.complex(function)
                need(all(power <= 1 for power in linear), "an exponent is not linear in the time")
                x = (
                    flint.acb_series([linear.get(0, 0)], prec=order + 1)
                    + flint.acb_series([linear.get(1, 0)], prec=order + 1) * t
                )
                r, begins = turn(exponent) if is_begin else None, x.exp()
                if r is not None:  # without rounding where that is a number
                    sine, cosine = arb.sin_cos_pi_fmpq(r)
                    x = flint.acb_series([0, linear.get(1, 0) * step], prec=order + 1)
                    begins = x.exp() * flint.acb(cosine, sine)
                value = flint.acb_series([0], prec=order + 1)
                for power in range(max(powers, default=0), -1, -1):
                    value = value * t + flint.acb_series([powers.get(power, 0)], prec=order + 1)
                total = total + value * begins
            return [total[k].real for k in range(order + 1)]

        flint.ctx.cap = order + 1
        return at(arb(begin), True)[:order] + [at(span(arb(begin), arb(begin) + arb(step)), False)[order]]


class Laws:
    """All laws while some contacts are closed: what is known, velocities of masses, compressions and displacements, and what
    arrives give the velocities of all runs, the accelerations of masses and the forces that hold runs together."""

    def __init__(self, parts, closed):
        self.parts, runs = parts, range(len(parts.mass))
        self.heavy = [sign(parts.mass[r]) == 1 and not parts.fixed[r] for r in runs]
        self.held = [i for i, link in enumerate(parts.links) if link["is"] == "contact" and i in closed]
        self.loose = [
            i for i, link in enumerate(parts.links) if link["is"] == "spring" and is_nil(link["damping"]) and self.hangs(i)
        ]
        self.held = sorted(self.held + self.loose)
        self.springs = [i for i, link in enumerate(parts.links) if link["is"] == "spring" and i not in self.loose]
        self.propped = [n for n, own in enumerate(parts.supports) if self.stands_alone(own[0])]
        self.still = [parts.fixed[r] or parts.endless[r] or r in parts.given for r in runs]
        self.moving = [r for r in runs if not self.still[r]]
        unknown = [("a" if self.heavy[r] else "v", r) for r in self.moving] + [("X", i) for i in self.held]
        self.place = {key: n for n, key in enumerate(unknown)}
        rows = [self.balance(r) for r in self.moving] + [self.joint(i) for i in self.held]
        self.inverse = inverse(rows)
        # Velocities that are given stand behind the solution.
        self.behind = {r: len(unknown) + n for n, r in enumerate(parts.given)}

    def hangs(self, i):
        """Whether one end of a spring touches nothing that pushes it."""
        parts, links = self.parts, self.parts.links
        for r, step in ((i, -1), (i + 1, 1)):
            while True:
                held = parts.fixed[r] or self.heavy[r] or any(r == own[0] for own in parts.supports + parts.loads)
                beyond = r - 1 if step < 0 else r
                if held or 0 <= beyond < len(links) and links[beyond]["is"] != "contact":
                    break
                if not 0 <= beyond < len(links) or beyond not in self.held:
                    return True
                r += step
        return False

    def slack(self):
        """What cannot be compressed."""
        return {("alpha", i) for i in self.loose} | {("u", n) for n in self.propped}

    def stands_alone(self, r):
        """Whether undamped supports hold a run and what is held to it, and nothing pushes them."""
        parts, near = self.parts, {r}
        while more := {i + side for i in self.held for side in (0, 1) if near & {i, i + 1}} - near:
            near |= more
        touched = {i for run in near for i in (run - 1, run) if 0 <= i < len(parts.links)} - set(self.held)
        pushed = any(parts.fixed[run] or self.heavy[run] or any(run == own[0] for own in parts.loads) for run in near)
        damped = any(run in near and not is_nil(damping) for run, _, damping in parts.supports)
        return not pushed and not damped and all(parts.links[i]["is"] == "contact" for i in touched)

    def balance(self, r):
        """The coefficients of what is not known in the forces on a run less its inertia."""
        parts, row = self.parts, [NIL] * len(self.place)

        def resists(run, amount):
            if ("v", run) in self.place:
                row[self.place["v", run]] = short(row[self.place["v", run]] + amount)

        if self.heavy[r]:
            row[self.place["a", r]] = -parts.mass[r]
        for i in (r - 1, r):
            if not 0 <= i < len(parts.links):
                continue
            link, other = parts.links[i], i if i == r - 1 else r + 1
            if link["is"] == "bar":
                resists(r, -link["impedance"])
            elif i in self.held:
                row[self.place["X", i]] = fmpq(1 if i == r - 1 else -1)
            elif link["is"] == "spring":
                resists(r, -link["damping"])
                resists(other, link["damping"])
        for n, (run, _, damping) in enumerate(parts.supports):
            if run == r:  # one that nothing pushes has no velocity, however it is damped
                resists(r, fmpq(-1) if n in self.propped else -damping)
        return row

    def joint(self, i):
        """Equal velocities, or accelerations where both are those of masses."""
        row = [NIL] * len(self.place)
        kind = "a" if all(self.heavy[r] or self.parts.fixed[r] for r in (i, i + 1)) else "v"
        for r, amount in ((i, fmpq(1)), (i + 1, fmpq(-1))):
            if (kind, r) in self.place:
                row[self.place[kind, r]] = amount
        return row

    def known(self, state, waves, loads, base, pressed):
        """Minus what is known in each equation, the forces in local contacts among it."""
        parts, forces = self.parts, [NIL] * len(self.parts.mass)
        v = lambda r: state["v", r] if ("v", r) in state else loads[parts.given[r]] if r in parts.given else NIL

        def push(r, amount):
            forces[r] = short(forces[r] + amount)

        for i, link in enumerate(parts.links):
            if link["is"] == "bar":
                # X + Z (2 f - v + V) at the right end, X + Z (v - V - 2 g) at the left one.
                if not parts.endless[i + 1]:
                    push(
                        i + 1,
                        base * link["force"]
                        + product(link["impedance"], 2 * waves[i, "f"] - v(i + 1) + base * link["velocity"]),
                    )
                if not parts.endless[i]:
                    push(
                        i,
                        -base * link["force"] - product(link["impedance"], v(i) - base * link["velocity"] - 2 * waves[i, "g"]),
                    )
            elif i in self.springs:
                force = product(link["stiffness"], state["alpha", i]) + product(link["damping"], v(i) - v(i + 1))
                push(i, -force)
                push(i + 1, force)
            elif link["is"] == "local":
                push(i, -pressed[i])
                push(i + 1, pressed[i])
        for n, (r, stiffness, damping) in enumerate(parts.supports):
            push(r, -product(stiffness, state["u", n]) - product(damping, v(r)))
        for n, ((r, _), amount) in enumerate(zip(parts.loads, loads)):
            push(r, NIL if parts.given.get(r) == n else amount)
        return [-forces[r] for r in self.moving] + [NIL if self.rigid(i) else v(i + 1) - v(i) for i in self.held]

    def rigid(self, i):
        return all(self.heavy[r] or self.parts.fixed[r] for r in (i, i + 1))

    def solved(self, state, waves, loads, base, pressed):
        column = self.known(state, waves, loads, base, pressed)
        return [dot(row, column) for row in self.inverse] + [loads[n] for n in self.parts.given.values()]

    def velocity(self, state, solution, r):
        if ("v", r) in self.place:
            return solution[self.place["v", r]]
        if r in self.behind:
            return solution[self.behind[r]]
        return state["v", r] if ("v", r) in state else NIL

    def rates(self, state, solution):
        """The derivatives of what is known."""
        found = {}
        for kind, n in state:
            if kind == "v":
                found[kind, n] = solution[self.place["a", n]]
            elif kind == "alpha":
                run = (self.velocity(state, solution, r) for r in (n, n + 1))
                left, right = run
                found[kind, n] = left - right if n not in self.loose else NIL
            else:
                found[kind, n] = self.velocity(state, solution, self.parts.supports[n][0])
        return found


def inverse(rows):
    """By elimination: exact where all numbers are."""
    count = len(rows)
    rows = [list(row) + [fmpq(int(i == j)) for j in range(count)] for i, row in enumerate(rows)]
    for column in range(count):
        usable = [r for r in range(column, count) if sign(rows[r][column]) in (1, -1)]
        decided(usable, "the laws do not determine a velocity")
        pivot = max(usable, key=lambda r: float(size(rows[r][column])))
        rows[column], rows[pivot] = rows[pivot], rows[column]
        by = rows[column][column]
        rows[column] = [short(c / by) for c in rows[column]]
        rows[column][column] = fmpq(1)
        for r in range(count):
            share = rows[r][column]
            if r != column and not is_nil(share):
                rows[r] = [short(a - product(share, b)) for a, b in zip(rows[r], rows[column])]
                rows[r][column] = NIL
    return [row[count:] for row in rows]


def balance(grown, moves, presses):
    """A power of two by which compressions have to grow so that velocities change as fast by them as the other way round."""
    there, back = (max((grown[pair] for pair in own), default=arb(0)) for own in (pairs(moves, presses), pairs(presses, moves)))
    ratio = float(there.upper()) / float(back.upper()) if there > 0 and back > 0 else 1.0
    return fmpq(2) ** (frexp(ratio)[1] // 2)


class Beginning(Undecided):
    """Only the first derivative of the force in a local contact is bounded."""


STEADY = 6  # by how much a compression is larger than what it may change by on a cell


def force_of(link, compression):
    return product(link["force"], raised(link, compression, link["exponent"]))


def slope_of(link, compression):
    """All slopes between those for the least and the largest compression."""
    exponent = link["exponent"]
    return product(link["force"] * exponent / link["compression"], raised(link, compression, exponent - 1))


def raised(link, compression, power):
    share = arb(compression) / link["compression"]
    if sign(share) == 1:
        return share**power
    most = share.upper()
    if not power:  # beside zero it may be both
        return NIL if most < 0 else span(0, 1)
    return span(0, most**power) if most > 0 else NIL


START = 0, Length()


def at(time):
    return 0, Length(time)


class Story:
    """What has happened so far. A time is (n, s): s after the n-th instant that is not exact, the 0-th is the start; two stories
    have one list of these."""

    def __init__(self, cert, origins):
        self.parts = parts = Parts(cert)
        self.terms, self.step, self.end = cert["terms"], rational(cert["step"]), rational(cert["to"])
        self.order = self.terms  # of the cell that is being worked out
        self.bits = cert["bits"]
        self.least = fmpq(1, 1 << self.bits // 4)  # how short a cell is on which a local contact begins or ceases to push
        need(self.step > 0 and self.end > 0 and self.end / self.step < 8000, "a window without steps, or with too many")
        self.told = []
        for contact, kind, low, high in cert["events"]:
            need(type(contact) is int and 0 <= contact < len(parts.contacts), "an event without a contact")
            self.told.append((parts.contacts[contact], kind, rational(low), rational(high)))
            need(0 <= self.told[-1][2] <= self.told[-1][3], "an interval runs backwards")
            before = [own[3] for own in self.told[:-1] if own[0] == self.told[-1][0]]
            need(not before or before[-1] <= self.told[-1][2], "two events of a contact are in one interval")
        self.origins, self.now = origins, START
        self.begins, self.reaches, self.past, self.integrals, self.happened = [], [], [], {}, []
        self.gaps = {i: parts.links[i].get("width", NIL) for i in parts.contacts}
        self.closed, self.idle, self.flush, self.pressed = {i for i in self.gaps if is_nil(self.gaps[i])}, {}, {}, set()
        heavy = [r for r, m in enumerate(parts.mass) if sign(m) == 1 and not parts.fixed[r]]
        self.state = {("v", r): short(parts.momentum[r] / parts.mass[r]) for r in heavy}
        self.state |= {("alpha", i): NIL for i, link in enumerate(parts.links) if link["is"] in ("spring", "local")}
        self.state |= {("u", n): NIL for n in range(len(parts.supports))}
        self.laws = Laws(parts, self.closed)
        need(all(is_nil(p) for p, wall in zip(parts.momentum, parts.fixed) if wall), "a mass meets a wall at the start")
        for i in self.closed:  # what is rigid on both sides of a contact moves as one already
            if self.laws.rigid(i):
                known = [NIL if parts.fixed[r] else self.state["v", r] for r in (i, i + 1)]
                need(is_nil(known[0] - known[1]), "two rigid bodies meet at the start")

    def when(self, time):
        return self.origins[time[0]] + time[1].value()

    def between(self, a, b):
        """How long a time is after another one."""
        return a[1].plus(b[1], -1).value() if a[0] == b[0] else self.when(a) - self.when(b)

    def is_later(self, a, b):
        order = 0 if a == b else sign(self.between(a, b))
        decided(order is not None, "it is not decided which of two times is the later one")
        return order == 1

    def next_break(self):
        times = [at(self.end)] + [at(low) for _, _, low, high in self.told if low == high]
        for link in self.parts.links:
            if link["is"] == "bar" and link["travel"] is not None:
                times += [(n, s.plus(link["travel"])) for n, s in self.begins[-self.count(link["travel"]) :] + [self.now]]
        times += [(0, load[key]) for _, load in self.parts.loads for key in ("from", "until") if load[key] is not None]
        first = None
        for time in times:
            if self.is_later(time, self.now) and (first is None or self.is_later(first, time)):
                first = time
        return first

    def count(self, travel):
        """How many cells have begun within a travel time, and one more."""
        count = 1
        while count < len(self.begins) and not self.is_later(
            self.now, (self.begins[-count][0], self.begins[-count][1].plus(travel))
        ):
            count += 1
        return count + 1

    def arriving(self):
        silence, found = [NIL] * (self.terms + 1), {}
        for i, link in enumerate(self.parts.links):
            if link["is"] != "bar":
                continue
            found[i, "f"] = found[i, "g"] = silence
            if link["travel"] is None:
                continue
            for n in range(len(self.begins) - 1, -1, -1):
                begin = (self.begins[n][0], self.begins[n][1].plus(link["travel"]))
                if not self.is_later(begin, self.now):
                    later = short(self.between(self.now, begin) / self.step)
                    found[i, "f"], found[i, "g"] = (moved(self.past[n][way, i], later) for way in "fg")
                    break
        return found

    def acting(self):
        found = []
        for _, load in self.parts.loads:
            is_on = not self.is_later((0, load["from"]), self.now) and (
                load["until"] is None or self.is_later((0, load["until"]), self.now)
            )
            time = self.now[1].value() if self.now[0] == 0 else self.when(self.now)
            found.append(self.parts.pushes(load, time, self.step, self.terms) if is_on else [NIL] * (self.terms + 1))
        return found

    def coefficients(self, state, waves, loads, count, base=fmpq(1), boxes=None):
        """Taylor coefficients of all that is known, of the solutions and of the forces in local contacts: as many as are wanted.
        The base is what stands with the velocities and forces of bars at the start. Where all is the derivative of something,
        boxes hold the compressions themselves."""
        states, solutions, pressed = [state], [], {i: [] for i in self.parts.locals}
        ways = {i: [state["alpha", i]] if boxes is None else [boxes[i], state["alpha", i]] for i in pressed}
        for k in range(count):
            for i, force in pressed.items():
                while len(force) < len(ways[i]):
                    force.append(self.press(self.parts.links[i], ways[i], force))
            drives = {i: force[k] if boxes is None else force[k + 1] * (k + 1) for i, force in pressed.items()}
            arrives = {key: own[k] for key, own in waves.items()}
            solution = self.laws.solved(states[k], arrives, [own[k] for own in loads], NIL if k else base, drives)
            solutions.append(solution)
            scale = self.step / (k + 1)
            states.append({key: short(rate * scale) for key, rate in self.laws.rates(states[k], solution).items()})
            for i, way in ways.items():
                way.append(states[-1]["alpha", i] / (1 if boxes is None else k + 2))
        return states, solutions, pressed

    def press(self, link, way, force):
        """The next coefficient of F (a/b)^m where a is positive: all but the first follow from a X' = m X a'."""
        k, a, m = len(force), way[0], link["exponent"]
        if sign(a) == -1 or all(map(is_nil, way)):
            return NIL
        if k and sign(a) == 1:
            top, below = int(m.p), int(m.q)
            row = flint.arb_mat(1, k, [way[j] * (top * j - below * (k - j)) for j in range(1, k + 1)])
            return (row * flint.arb_mat(k, 1, force[::-1]))[0, 0] / (a * below * k)
        if k > 1:
            raise Beginning("a local contact may begin or cease to push")
        return force_of(link, a) if k == 0 else slope_of(link, a) * way[1]

    def guard(self, i, states, solutions):
        """What must not be negative: the force of a closed contact, the gap of an open one."""
        if i in self.closed:
            return [own[self.laws.place["X", i]] for own in solutions]
        speeds = [self.laws.velocity(s, z, i + 1) - self.laws.velocity(s, z, i) for s, z in zip(states, solutions)]
        series = [self.gaps[i]] + [short(c * self.step / (k + 1)) for k, c in enumerate(speeds)]
        for k in range(1, min(len(series), 1 + self.flush.get(i, 0))):
            series[k] = NIL
        return series[: len(solutions)]

    def last(self, i, wide, solutions):
        """The same, enclosed for the whole cell: its last coefficient."""
        if i in self.closed:
            return solutions[self.order][self.laws.place["X", i]]
        k = self.order - 1
        right, left = (self.laws.velocity(wide[k], solutions[k], r) for r in (i + 1, i))
        return short((right - left) * self.step / self.order)

    def start_of(self, series):
        first = next((c for c in series if not is_nil(c)), NIL)
        order = sign(first)
        decided(order is not None, "it is not decided whether a contact changes")
        return order

    def settled(self, waves, loads):
        before, count = (set(self.closed), dict(self.idle), set(self.pressed)), len(self.happened)
        for _ in range(4 * len(self.gaps) + 1):
            states, solutions, pressed = self.begun(waves, loads)
            wrong = [i for i in self.gaps if self.start_of(self.guard(i, states, solutions)) < 0]
            if not wrong:
                for i in self.gaps.keys() - (before[0] ^ self.closed):  # nothing has become of it
                    self.happened[count:] = [event for event in self.happened[count:] if event[0] != i]
                    if i in before[1]:
                        self.idle[i] = before[1][i]
                    self.pressed |= before[2] & {i}
                return states, solutions, pressed
            self.switch([i for i in wrong if i not in self.propping(wrong)], False)
        raise Undecided("contacts open and close without end")

    def begun(self, waves, loads):
        """All coefficients but the last; the first alone where a local contact may begin or cease to push."""
        self.order = min([self.terms, *(len(own) - 1 for own in waves.values())])
        if self.parts.locals and self.order > 1:
            shortest = self.longest(self.coefficients(self.state, waves, loads, 1)[0])
            tiny, wanted = (int(shortest.q) // int(shortest.p)).bit_length(), self.bits - SPARE
            self.order = min(self.order, max((2 * wanted - 5 * tiny) // 4 + 4, wanted // tiny + 2)) if tiny > 1 else self.order
        try:
            return self.coefficients(self.state, waves, loads, self.order)
        except Beginning:
            self.order = 1
            return self.coefficients(self.state, waves, loads, 1)

    def propping(self, wrong):
        """The contacts that stay closed since a support, which would else be left alone, pushes there."""
        later = Laws(self.parts, self.closed ^ set(wrong))
        found = set()
        for n in set(later.propped) - set(self.laws.propped):
            left = right = self.parts.supports[n][0]
            while left - 1 in later.held:
                left -= 1
            while right in later.held:
                right += 1
            push = NIL
            for m, (r, stiffness, _) in enumerate(self.parts.supports):
                if left <= r <= right:
                    push = push + product(stiffness, self.state["u", m])
            decided(sign(push) is not None, "it is not decided whether a support pushes")
            found |= {left - 1} if sign(push) == 1 else {right} if sign(push) == -1 else set()
        return found

    def switch(self, contacts, smoothly):
        """Opens and closes contacts at this instant."""
        slack, speeds, heavy = self.laws.slack(), dict(self.state), self.laws.heavy
        for i in contacts:
            if i in self.closed:
                since = self.idle.pop(i, None)
                if since is not None and since != self.now:
                    self.happened.append((i, "release", since))
                self.happened.append((i, "opening", self.now))
            else:
                known = [speeds[("v", r)] if heavy[r] else NIL for r in (i, i + 1)]
                is_rigid = all(heavy[r] or self.parts.fixed[r] for r in (i, i + 1))
                need(not is_rigid or i in self.flush or is_nil(known[0] - known[1]), "two rigid bodies meet")
                self.happened.append((i, "closing", self.now))
            self.closed ^= {i}
            self.pressed.discard(i)
            self.gaps[i] = NIL
        self.laws = Laws(self.parts, self.closed)
        freed = self.laws.slack() - slack
        for key in freed:
            is_slack = key[0] == "u" and is_nil(self.parts.supports[key[1]][1])
            decided(is_slack or smoothly or sign(self.state[key]) is not None, "it is not decided whether a spring is compressed")
            need(is_slack or sign(self.state[key]) in (0, None), "a compressed spring comes loose")
            self.state[key] = NIL
        # How many derivatives of a gap are zero at first: that of the second order too where masses or walls part, whose force has
        # just come to zero.
        self.flush = {}
        for i in contacts:
            both = heavy[i] and heavy[i + 1]
            if i not in self.closed and not freed and (both or smoothly):
                self.flush[i] = 1 + int(smoothly and len(contacts) == 1 and self.laws.rigid(i))

    def largest(self, start, waves, loads, share, slopes):
        """Bounds of y' on a share of a step, where y'' = A y' + b': |y'| <= (|y'(0)| + h |b'|) / (1 - h |A|). Local contacts are
        springs whose stiffness varies, up to their steepest slope. What is compressed counts in a unit in which it oscillates about
        as far as what moves."""
        nothing, silent = {key: NIL for key in start}, [NIL] * len(loads)
        grown, unpressed = {}, {i: NIL for i in slopes}
        for unit in start:
            state = {**nothing, unit: fmpq(1)}
            pressed = {i: slope if unit == ("alpha", i) else NIL for i, slope in slopes.items()}
            solution = self.laws.solved(state, {key: NIL for key in waves}, silent, NIL, pressed)
            grown |= {(key, unit): size(rate) for key, rate in self.laws.rates(state, solution).items()}
        arrives = {key: own[0] for key, own in waves.items()}
        driven = self.laws.rates(nothing, self.laws.solved(nothing, arrives, [own[0] for own in loads], NIL, unpressed))
        # Bars decouple what stands between them.
        boxes, length = {}, arb(share) * arb(self.step)
        for place in {self.place_of(*key) for key in start}:
            own = [key for key in start if self.place_of(*key) == place]
            moves, presses = ([key for key in own if (key[0] == "v") == is_speed] for is_speed in (True, False))
            units = dict.fromkeys(moves, fmpq(1)) | dict.fromkeys(presses, balance(grown, moves, presses))
            largest = lambda values: max(size(values[key]) * units[key] for key in own)
            norm = max(size(sum((grown[key, unit] * units[key] / units[unit] for unit in own), arb(0))) for key in own)
            forcing, first = largest(driven), largest(start)
            need((norm + forcing + first).is_finite(), "a motion without bounds")
            if not length * norm < 0.75:
                return None
            bound = ((first + length * forcing) / (1 - length * norm) * arb(self.step)).upper()
            is_silent = first.is_zero() and forcing.is_zero()
            boxes |= {key: NIL if is_silent else arb(0, (bound / units[key]).upper()) for key in own}
        return boxes

    def place_of(self, kind, n):
        """Which place between two bars something known belongs to."""
        run = self.parts.supports[n][0] if kind == "u" else n
        return sum(link["is"] == "bar" for link in self.parts.links[:run])

    def enclosed(self, states, waves, loads, share):
        """What is known and solved, of the two last orders on a share of a step, and the last order of forces in local contacts;
        None where it is too long. All orders but the first are those of the derivatives, which vanish where nothing changes."""
        place = span(0, share)
        spread, acting = {key: moved(own, place) for key, own in waves.items()}, [moved(own, place) for own in loads]
        over, under = {key: derivative(own) for key, own in spread.items()}, [derivative(own) for own in acting]
        start = {key: rate for key, rate in states[1].items()}
        rooms = {i: self.room(states[0]["alpha", i], start["alpha", i], share) for i in self.parts.locals}
        box = self.largest(
            {key: rate / self.step for key, rate in start.items()},
            {key: [c / self.step for c in own] for key, own in over.items()},
            [[c / self.step for c in own] for own in under],
            share,
            {i: slope_of(self.parts.links[i], room) for i, room in rooms.items()},
        )
        if box is None:
            return None
        boxes = self.confined(states[0], start, box, (over, under), rooms, place)
        if boxes is None:
            return None
        rates, solutions, forces = self.coefficients(box, over, under, self.order, NIL, boxes)
        up = lambda rows, k: {key: c / k for key, c in rows[k - 1].items()}
        wide = {k: up(rates, k) for k in (self.order - 1, self.order) if k}
        all_ = {k: [c / k for c in solutions[k - 1]] for k in (self.order - 1, self.order) if k}
        if self.order == 1:
            wide[0] = {key: short(own + place * box[key]) for key, own in states[0].items()}
            here, now = {key: own[0] for key, own in spread.items()}, {i: own[0] for i, own in forces.items()}
            all_[0] = self.laws.solved(wide[0], here, [own[0] for own in acting], fmpq(1), now)
        return wide, all_, {i: own[self.order] for i, own in forces.items()}

    def room(self, compression, rate, share):
        """Between which numbers a compression is taken to be: nearly where it is, or, where there is a gap, on the same side. Where
        only one order is worked out, it is twice as far as it gets at first."""
        here, way = arb(compression), 2 * size(rate) * arb(share)
        if self.order == 1:
            return here + arb(0, way + arb(self.least))
        return here * arb(1, arb(1) / STEADY) if sign(compression) == 1 else span(here - way, here / 16)

    def confined(self, state, start, box, driven, rooms, place):
        """The compressions of local contacts, which have to stay where they are taken to be; their rates are narrowed in the box."""
        if not rooms:
            return {}
        slopes = {i: product(span(0, slope_of(self.parts.links[i], room)), box["alpha", i]) for i, room in rooms.items()}
        arrives, acts = {key: own[0] for key, own in driven[0].items()}, [own[0] for own in driven[1]]
        rates = self.laws.rates(box, self.laws.solved(box, arrives, acts, NIL, slopes))
        for key, own in rates.items():
            rate = start[key] + product(place, own * self.step)
            box[key] = NIL if is_nil(rate) or is_nil(box[key]) else arb(rate).intersection(box[key])
        boxes = {}
        for i, room in rooms.items():
            boxes[i] = state["alpha", i] + product(place, box["alpha", i])
            if not is_nil(boxes[i]) and not room.contains_interior(arb(boxes[i])):
                return None
        return boxes

    def cell(self):
        end = self.next_break()
        waves, loads = self.arriving(), self.acting()
        states, solutions, pressed = self.settled(waves, loads)
        share, high = short(self.between(end, self.now) / self.step), self.longest(states)
        if sign(share - high) != -1:
            end, share = (self.now[0], self.now[1].plus(Length(self.step * high))), high
        while sign(share - high / 2) == -1:
            high = high / 2
        for _ in range(80):
            if self.parts.locals and high <= self.least:
                self.order = 1
            last = self.enclosed(states, waves, loads, high)
            if last is not None:
                break
            high = high / 2
            end, share = (self.now[0], self.now[1].plus(Length(self.step * high))), high
        decided(last is not None, "a step is too long")
        wide, all_, forces = last
        guards = {i: self.guard(i, states, solutions)[: self.order] + [self.last(i, wide, all_)] for i in self.gaps}
        for i in sorted(self.closed):
            if not all(map(is_nil, guards[i])):
                if self.now == START and all(own[0] != i for own in self.happened):
                    self.happened.append((i, "closing", self.now))
                self.idle.pop(i, None)
                self.pressed.add(i)
            elif i in self.pressed:
                self.idle.setdefault(i, self.now)
        change = self.change_before(end)
        if change is not None:
            decided(sign(share - change[2]) in (0, 1), "it is not decided whether an event is in a step")
            place = self.root(guards[change[0]], *change[1:])
        else:
            place = share
        for i, own in guards.items():
            until = change[1] if change is not None and change[0] == i else place
            until = until if isinstance(until, fmpq) else rational_above(until)
            decided(all(map(is_nil, own)) or stays_positive(own, NIL, until), "a contact may change, but no event is claimed")
        motion = {key: [s[key] for s in states[: self.order]] + [wide[self.order][key]] for key in self.state}
        motion |= {("push", i): own[: self.order] + [forces[i]] for i, own in pressed.items()}
        for r in range(len(self.parts.mass)):
            speed = [self.laws.velocity(s, z, r) for s, z in zip(states, solutions[: self.order])]
            motion["speed", r] = speed + [self.laws.velocity(wide[self.order], all_[self.order], r)]
        for i, link in enumerate(self.parts.links):
            if link["is"] == "bar":
                for way, other, r in (("f", "g", i), ("g", "f", i + 1)):
                    wave_in = waves[i, other]
                    if len(wave_in) > self.order + 1:
                        wave_in = wave_in[: self.order] + [moved(wave_in, span(0, high))[self.order]]
                    waves_out = [short(a - b) for a, b in zip(motion["speed", r], wave_in)]
                    waves_out[0] = waves_out[0] - link["velocity"]
                    motion[way, i] = [NIL] * (self.order + 1) if self.parts.endless[r] else waves_out
        self.begins.append(self.now)
        self.reaches.append(high)
        self.past.append(motion)
        need(len(self.begins) < 8000, "there are too many steps")
        self.state = {key: horner(motion[key], place) for key in self.state}
        self.gaps = {i: NIL if i in self.closed else horner(guards[i], place) for i in self.gaps}
        self.flush = {}
        if change is None:
            self.now = end
            return
        self.origins.append(self.when(self.now) + place * self.step)
        self.now = (len(self.origins) - 1, Length())
        self.switch([change[0]], True)

    def longest(self, states):
        """How long a cell may be: so short that the compression of a local contact hardly changes."""
        high = fmpq(1) if not self.parts.locals else fmpq(1, 4) if self.order > 1 else self.least
        for i in self.parts.locals if self.order > 1 else ():
            now, rate = (states[k]["alpha", i] for k in (0, 1))
            # An open contact has to stay open, but a ball tells its ends with thirty bits alone.
            share = {1: arb(4) / (5 * STEADY), -1: arb(2) ** 20}.get(sign(now))
            if share is not None and not size(rate) * arb(high) < arb(abs(now)) * share:
                digits, power = (arb(abs(now)) * share / size(rate)).lower().man_exp()
                cut = max(int(digits).bit_length() - 4, 0)
                high = fmpq(int(digits) >> cut) * fmpq(2) ** (int(power) + cut)
        return max(high, self.least)

    def change_before(self, end):
        """The contact of which it is claimed that it changes by itself first on this cell, and when, in steps from now."""
        found = None
        for i in self.gaps:
            done = sum(1 for own in self.happened if own[0] == i and own[1] != "release")
            claims = [own for own in self.told if own[0] == i and own[1] != "release"][done:]
            if not claims or claims[0][2] == claims[0][3] or not arb(claims[0][3]) <= self.when(end).lower():
                continue
            low, high = ((arb(time) - self.when(self.now)) / self.step for time in claims[0][2:])
            low, high = rational_below(low), rational_above(high)
            if high > 0 and (found is None or low < found[1]):
                found = (i, max(low, NIL), high)
        return found

    def root(self, series, low, high):
        """The only zero of what falls between two places."""
        need(sign(horner(series, low)) == 1 and sign(horner(series, high)) == -1, "a contact does not change when it is said")
        falls, place = derivative(series), span(low, high)
        decided(sign(horner(falls, place)) == -1, "a contact may change more than once")
        for _ in range(12):
            middle = arb(place.mid())
            newton = middle - horner(series, middle) / horner(falls, place)
            need(newton.overlaps(place), "a contact does not change when it is said")
            place = newton.intersection(place)
        return place

    def run(self):
        while self.now != at(self.end):
            self.cell()
        self.happened += [(i, "release", since) for i, since in sorted(self.idle.items())]


def rational_above(ball):
    mantissa, exponent = arb(ball.upper()).mid().man_exp()
    return fmpq(int(mantissa)) * fmpq(2) ** int(exponent) + fmpq(1, 1 << flint.ctx.prec)


def rational_below(ball):
    return -rational_above(-ball)


def check_motion(cert, more=""):
    """The story that is claimed, and what is observed of it; of a second one too, where one is subtracted."""
    names = "wavestep_certificate kind title constants time line numbers roots to events step terms bits " + more
    others = {"minus"} if more and "minus" in cert else set()
    need(set(cert) == set(names.split()) | others, "a certificate has other keys")
    bits, terms = cert["bits"], cert["terms"]
    need(all(type(own) is int for own in (bits, terms)) and 4 <= bits <= 4096 and 4 <= terms <= 400, "bits or terms")
    flint.ctx.prec = bits + 32
    lines, origins = [cert], [arb(0)]
    if others:
        need(set(cert["minus"]) == set("title constants time line events observed".split()), "a second scene has other keys")
        lines.append({**cert, **cert["minus"]})
    return [(told(own, origins), own.get("observed")) for own in lines]


def told(cert, origins):
    """What happens, which has to be what is claimed."""
    story = Story(cert, origins)
    story.run()
    need(len(story.told) == len(story.happened), "there are more or fewer events")
    times = []
    for contact, kind, low, high in story.told:
        own = next((n for n, event in enumerate(story.happened) if event[0] == contact), None)
        need(own is not None and story.happened[own][1] == kind, f"there is no {kind} then")
        _, _, time = story.happened.pop(own)
        exact = time[1].value() if time[0] == 0 else story.when(time)
        need(
            not exact < low
            and not exact > high
            and (isinstance(exact, fmpq) or arb(low) <= exact.lower() and exact.upper() <= arb(high)),
            "an event is at another time",
        )
        times.append(time)
    for earlier, later in zip(times, times[1:]):
        decided(sign(story.between(later, earlier)) in (0, 1), "events are not in the order of time")
    return story

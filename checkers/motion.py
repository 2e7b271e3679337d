"""The motion of a line with contacts that push and never pull, with proof, in nothing but the standard library.

Time is cut into cells, on each of which every wave, velocity and force is a Taylor polynomial with a bounded remainder; series.py
adds and multiplies these.
"""

from fractions import Fraction
from functools import cache
from math import comb, factorial, isqrt

from exact import MINUS, ROOTS, Ball, accumulate, add, alike, coefficients, frozen, is_zero, put, rational, read, read_function, thawed
from exact import slope as derivative
from reading import Undecided, decided, need
from series import (
    ONE,
    PRECISION,
    ZERO,
    Duration,
    Number,
    ball,
    begins,
    dot,
    interval,
    is_positive,
    power,
    shifted,
    slope,
    total,
    value,
    weighted,
)

KEYS = {kind: {"is"} for kind in ("free", "fixed", "endless", "contact")}
KEYS |= {kind: {"is", "name", "stiffness", "damping"} for kind in ("spring", "support")}
KEYS |= {"gap": {"is", "width"}, "local": {"is", "name", "force", "compression", "exponent"}}
KEYS["bar"] = {"is", "name", "travel", "impedance", "velocity", "force"}
KEYS |= {"mass": {"is", "name", "mass", "velocity"}, **{load: {"is", "name", "course", "from", "until"} for load in ("force", "velocity")}}
CLAIMS = {
    "wavestep_certificate",
    "kind",
    "title",
    "constants",
    "time",
    "line",
    "numbers",
    "roots",
    "to",
    "events",
    "step",
    "terms",
    "bits",
}
OF_SECOND = {"title", "constants", "time", "line", "events", "observed"}
MOST_CELLS, MOST_BITS, MOST_TERMS, MOST_RUNS = 8000, 4096, 400, 64
SPARE = 70  # bits of which none are lost to the orders that are left out
STEADY = 16  # by how much a compression is larger than what it changes by on half a cell


class Load:
    """A force or a velocity that acts from one time to another, a sum of polynomials times exponentials."""

    def __init__(self, element, line, cert):
        self.course, self.line, self.time = read(element["course"]), line, cert["time"]
        for function in self.course.values():
            for below in function:
                line.number_over(below)  # also where nothing stands above it
        self.begin, self.end = (None if element[key] is None else line.duration(element[key]) for key in ("from", "until"))
        self.begin = self.begin or Duration({})
        for symbol in (symbol for symbol, square in ROOTS.items() if square == -1):  # the conjugate is the same
            other = put(self.course, symbol, {(): {((symbol, 1),): -1}})
            need(is_zero(accumulate(other, self.course, MINUS)), "a load is not real")
        is_late = lambda time: time == Duration({}) or time.number().sign() == 1
        decided(is_late(self.begin), "a load may begin early")
        decided(self.end is None or (self.end - self.begin).number().sign() == 1, "a load may end before it begins")

    def series(self, begin, step, terms):
        """Its Taylor polynomial in whole steps about a time."""
        low, high = begin.ends()
        need(high - low <= step, "a time is not known well enough")
        there = put(self.course, self.time, {(): {(): (low + high) / 2, ((self.time, 1),): step}})
        sums = [ZERO] * (terms + 1)
        for exponent, function in there.items():
            factors = coefficients(function, self.time, dict)
            need(len(factors) <= terms, "a course has too high a power")
            own = self.smooth(exponent, factors, terms) if exponent else list(map(self.real, factors)) + [ZERO] * terms
            sums = [a + b for a, b in zip(sums, own)]
        for k in range(3):  # exactly, where no exponent is left but for turns, as where a sine begins
            here = put(there, self.time, {(): {(): 0}}).items()
            known = [(alike(thawed(exponent), {}), function) for exponent, function in here]
            if not all(factor for factor, _ in known):
                break
            own = {}
            for factor, function in known:
                add(own, function, factor)
            sums[k], there = self.real(own).times(Fraction(1, factorial(k))), derivative(there, self.time)
        return shifted(sums, Number.between((low - high) / step, (high - low) / step))

    def complex(self, function):
        """A sum of products of roots and constants over such ones without roots of -1."""
        bits, constants = PRECISION["bits"], self.line.constants
        real = lambda own: Ball(bits, own.units()[0], 0, own.units()[1])
        sum_ = Ball(bits, 0)
        for below, top in function.items():
            over = self.line.number_over(below)
            for monomial, c in top.items():
                need(all(p == 1 if s in ROOTS else s in constants for s, p in monomial), "a symbol has no value")
                own = Ball.of({tuple((s, p) for s, p in monomial if s in ROOTS): c}, bits)
                for symbol, power in monomial:
                    for _ in range(0 if symbol in ROOTS else power):
                        own = own * real(constants[symbol])
                sum_ = sum_ + (own * real(over) if below else own)
        return sum_

    def real(self, function):
        function = {below: top for below, top in function.items() if top}
        if not function.keys() - {()} and not function.get((), {}).keys() - {()}:
            return Number(function.get((), {}).get((), Fraction(0)))
        own = self.complex(function)
        return ball(own.real, own.off)

    def smooth(self, exponent, factors, terms):
        """A polynomial times an exponential; of the highest derivative a bound for -1 <= x <= 2."""
        bits = PRECISION["bits"]
        start, rate, *others = coefficients(thawed(exponent), self.time, dict) + [{}, {}]
        need(not any(others), "an exponent is not linear in the time")
        factors, x, powers = list(map(self.complex, factors)), self.complex(rate), [self.complex(start).exp()]
        decided(x.size() >> bits < 64, "a step is too long for a load")
        for k in range(terms):
            powers.append((powers[-1] * x).over(k + 1))
        real = lambda own: ball(own.real, own.off)
        sums = [total(real(factors[i] * powers[k - i]) for i in range(min(k + 1, len(factors)))) for k in range(terms)]
        growth = (Ball(bits, 2 * x.size()).exp()).size()  # of the exponential, from the start on
        bound = Fraction(0)
        for i in range(len(factors)):
            lifted = sum(comb(j, i) * 2 ** (j - i) * factors[j].size() for j in range(i, len(factors)))
            bound += Fraction(lifted * powers[terms - i].size() * growth, 1 << 3 * bits)
        return sums + [Number.between(-bound, bound)]


@cache
def pi(bits):
    """16 arctan(1/5) - 4 arctan(1/239); each division leaves out less than a unit, of which 2^16 are one of the ball's."""

    def arctan(n):
        power, sum_, k = (1 << bits + 16) // n, 0, 1
        while power:
            sum_ += power // k if k % 4 == 1 else -(power // k)
            power, k = power // (n * n), k + 2
        return sum_

    return ball((16 * arctan(5) - 4 * arctan(239)) >> 16, 2)


class Line:
    """Runs, which move as one, between bars, springs and contacts."""

    def __init__(self, cert):
        self.constants = {name: interval(pair) for name, pair in cert["numbers"].items()}
        need(not self.constants.keys() & (ROOTS.keys() | {cert["time"]}), "a name stands for two numbers")
        need(not {cert["time"], "pi"} & ROOTS.keys() and "pi" not in {cert["time"], *self.constants}, "a name stands for two numbers")
        self.constants["pi"] = pi(PRECISION["bits"])
        elements = cert["line"]
        need(
            all(element.keys() == KEYS.get(element["is"]) for element in elements),
            "an element lacks something, or has too much",
        )
        need(type(cert["time"]) is str, "the time has no name")
        is_end = [element["is"] in ("free", "fixed", "endless") for element in elements]
        need(len(elements) > 2 and is_end == [True] + [False] * (len(elements) - 2) + [True], "a line has two ends")
        self.links, self.travels, runs, self.places, supports = [], [], [[]], {}, 0
        for element in elements:
            if "name" in element:
                need(type(element["name"]) is str and element["name"] not in self.places, "a name stands twice")
                kind = element["is"]
                place = len(self.links) if kind in ("bar", "spring", "local") else supports if kind == "support" else len(runs) - 1
                self.places[element["name"]] = kind, place
                supports += kind == "support"
            if element["is"] in ("bar", "spring", "local", "contact", "gap"):
                self.links.append(self.link(element))
                self.travels.append(element.get("travel"))
                runs.append([])
            else:
                runs[-1].append(element)
        need(len(runs) <= MOST_RUNS, "too long a line")
        self.count = len(runs)
        known = {"free", "fixed", "endless", "mass", "support", "force", "velocity"}
        need(all(element["is"] in known for run in runs for element in run), "an element without a law here")
        of = lambda run, kind: [element for element in run if element["is"] == kind]
        self.fixed = [bool(of(run, "fixed")) for run in runs]
        self.masses = [total(self.number(own["mass"]) for own in of(run, "mass")) for run in runs]
        self.own_masses = {own["name"]: self.number(own["mass"]) for own in elements if own["is"] == "mass"}
        momenta = [total(self.number(own["mass"]) * self.number(own["velocity"]) for own in of(run, "mass")) for run in runs]
        self.starts = [p / m if m.sign() else ZERO for p, m in zip(momenta, self.masses)]
        self.supports = [
            (r, *(self.number(own[key]) for key in ("stiffness", "damping")))
            for r, run in enumerate(runs)
            for own in of(run, "support")
        ]
        acting = [(r, own) for r, run in enumerate(runs) for own in run if own["is"] in ("force", "velocity")]
        self.loads = [(r, Load(own, self, cert)) for r, own in acting]
        self.imposed = {r: n for n, (r, own) in enumerate(acting) if own["is"] == "velocity"}
        need(len(self.imposed) == sum(own["is"] == "velocity" for _, own in acting), "a place has two velocities")
        inert = lambda r: self.fixed[r] or self.masses[r].sign()
        need(not any(inert(r) for r in self.imposed), "a mass or a wall has another velocity")
        self.endless = [bool(of(run, "endless")) for run in runs]
        need(all(len(run) == 1 for run, is_endless in zip(runs, self.endless) if is_endless), "an endless line ends with a bar")
        for i, link in enumerate(self.links):
            has_end = link["is"] == "bar" and (self.endless[i] or self.endless[i + 1])
            need(has_end == (link["is"] == "bar" and link["travel"] is None), "a bar lacks an end, or has one too many")
            need(link["is"] == "bar" or not self.endless[i] and not self.endless[i + 1], "an endless line ends with a bar")
        positive = [self.number(own["mass"]) for run in runs for own in of(run, "mass")]
        positive += [link["impedance"] for link in self.links if link["is"] == "bar"]
        positive += [link[key] for link in self.links if link["is"] == "local" for key in ("force", "compression")]
        numbers = [own for _, *pair in self.supports for own in pair]
        numbers += [link[key] for link in self.links if link["is"] == "spring" for key in ("stiffness", "damping")]
        need(
            all(own.sign() == 1 for own in positive) and all(own.sign() in (0, 1) for own in numbers),
            "a number is not positive",
        )
        for r in self.imposed:
            for way in (-1, 1):
                other = r + way
                while 0 <= other < self.count and self.links[min(other, other - way)]["is"] == "contact":
                    need(not inert(other) and other not in self.imposed, "a mass or a wall touches what has another velocity")
                    other += way
        self.contacts, self.locals = ([i for i, link in enumerate(self.links) if link["is"] == kind] for kind in ("contact", "local"))

    def number(self, rows):
        """A polynomial in the constants over such ones."""
        need(type(rows) is list, "a number is no list")
        sums = []
        for below, top in read_function(rows).items():
            sums.append(self.polynomial(top) * self.number_over(below))
        return total(sums)

    def number_over(self, below):
        """1 over a product of polynomials in the constants."""
        divisor = ONE
        for factor, power in below:
            for _ in range(power):
                divisor = divisor * self.polynomial(dict(factor))
        return ONE / divisor

    def duration(self, rows):
        """A length of time, as a multiple of 1 or of what others are multiples of, too."""
        self.number(rows)  # nothing is divided by what may be zero
        function = read_function(rows)
        first = next((c for _, top in sorted(function.items()) for _, c in sorted(top.items()) if c), Fraction(0))
        if not first:
            return Duration({})
        name = frozen({below: {m: c / first for m, c in top.items()} for below, top in function.items()})
        is_rational = name == frozen({(): {(): Fraction(1)}})
        if not is_rational:
            Duration.VALUES[name] = self.number(rows).times(1 / first)
        return Duration({"" if is_rational else name: first})

    def polynomial(self, top):
        sums = []
        for monomial, c in top.items():
            product = Number(Fraction(c))
            for symbol, power in monomial:
                if symbol not in self.constants:
                    need(ROOTS.get(symbol, -1) > 0, f"{symbol} has no value")
                    low = isqrt(int(ROOTS[symbol]) << 2 * PRECISION["bits"])
                    self.constants[symbol] = ball(low, 1)
                for _ in range(power):
                    product = product * self.constants[symbol]
            sums.append(product)
        return total(sums)

    def link(self, element):
        if element["is"] == "bar":
            travel = None if element["travel"] is None else self.duration(element["travel"])
            decided(travel is None or travel.number().sign() == 1, "a bar without length")
            own = {key: self.number(element[key]) for key in ("impedance", "velocity", "force")}
            return {"is": "bar", "travel": travel, **own}
        if element["is"] == "spring":
            return {"is": "spring", **{key: self.number(element[key]) for key in ("stiffness", "damping")}}
        if element["is"] == "local":
            exponent = rational(element["exponent"])
            need(1 <= exponent and exponent.numerator <= 1000 and exponent.denominator <= 100, "an exponent is less than 1, or too large")
            return {"is": "local", "exponent": exponent, **{key: self.number(element[key]) for key in ("force", "compression")}}
        gap = self.number(element["width"]) if element["is"] == "gap" else ZERO
        need(element["is"] != "gap" or gap.sign() == 1, "a gap may be no gap")
        return {"is": "contact", "gap": gap}


class Turning(Undecided):
    """A local contact may begin or cease to push, where its force has no further derivatives."""


class System:
    """The laws of a line while some of its contacts are closed."""

    def __init__(self, line, closed):
        self.line, links = line, line.links
        rigid = lambda i: links[i]["is"] == "contact" and i in closed
        # An undamped spring has no force, and keeps its length, where one of its ends is loose.
        self.loose = {
            i
            for i, link in enumerate(links)
            if link["is"] == "spring" and link["damping"].is_zero() and self.is_loose(i, rigid)
        }
        self.group = [0]
        for i in range(len(links)):
            self.group.append(self.group[-1] + (not (rigid(i) or i in self.loose)))
        self.count = self.group[-1] + 1
        self.members = [[r for r in range(line.count) if self.group[r] == g] for g in range(self.count)]
        self.driven = {g: n for r, n in line.imposed.items() for g in [self.group[r]]}
        self.fixed = [g in self.driven or any(line.fixed[r] for r in own) for g, own in enumerate(self.members)]
        self.mass = [total(line.masses[r] for r in own) for own in self.members]
        # What undamped supports alone hold goes back at once to where they carry no force. Any damping keeps it at rest there.
        self.resting = {n for n, (r, _, _) in enumerate(line.supports) if self.is_propped(self.group[r])}
        self.moved = [not fixed and mass.sign() == 1 for fixed, mass in zip(self.fixed, self.mass)]
        self.endless = [any(line.endless[r] for r in own) for own in self.members]
        self.free = [g for g in range(self.count) if not self.fixed[g] and not self.moved[g] and not self.endless[g]]
        self.mover = [next((r for r in own if line.masses[r].sign()), own[0]) for own in self.members]
        self.rows = self.balances()
        self.inverse, self.shares = self.inverted()

    def is_loose(self, i, rigid):
        """Whether one end of a spring touches open contacts only."""
        line = self.line
        loaded = lambda r: line.fixed[r] or line.masses[r].sign() or any(own[0] == r for own in line.supports + line.loads)
        for way, r in ((-1, i), (1, i + 1)):
            while not loaded(r):
                beyond = r - 1 if way < 0 else r
                if not 0 <= beyond < len(line.links) or line.links[beyond]["is"] == "contact" and not rigid(beyond):
                    return True
                if line.links[beyond]["is"] != "contact":
                    break
                r += way
        return False

    def is_propped(self, g):
        """Whether what moves as one touches undamped supports and open contacts only."""
        line, own = self.line, self.members[g]
        beside = [i for r in own for i in (r - 1, r) if 0 <= i < len(line.links) and i not in self.loose]
        return (
            all(line.links[i]["is"] == "contact" for i in beside)
            and not any(line.fixed[r] or line.masses[r].sign() for r in own)
            and not any(r in own for r, _ in line.loads)
            and all(damping.is_zero() for r, _, damping in line.supports if r in own)
        )

    def balances(self):
        """The forces on each run: factors times sums, of what is counted how often. At the start bars have a velocity V and a force X
        besides, so that their ends are pressed with X + Z (2 f - v + V) and X + Z (v - V - 2 g)."""
        line, speed = self.line, lambda r: ("v", self.group[r])
        rows = [[] for _ in range(line.count)]
        for i, link in enumerate(line.links):
            if link["is"] == "bar":
                for r, way, pressed in ((i, "left", -link["force"]), (i + 1, "right", link["force"])):
                    if not line.endless[r]:
                        rows[r] += [(pressed, [("start", 1)])]
                        rows[r] += [(link["impedance"], [((i, way), 2), (speed(r), -1), (("velocity", i), 1)])]
            elif link["is"] == "spring" and i not in self.loose:
                force = [(link["stiffness"], [(("alpha", i), 1)]), (link["damping"], [(speed(i), 1), (speed(i + 1), -1)])]
                rows[i] += [(-factor, parts) for factor, parts in force]
                rows[i + 1] += force
            elif link["is"] == "local":
                rows[i].append((-ONE, [(("push", i), 1)]))
                rows[i + 1].append((ONE, [(("push", i), 1)]))
        for n, (r, stiffness, damping) in enumerate(line.supports):
            rows[r] += [(-stiffness, [(("u", n), 1)]), (-(ONE if n in self.resting else damping), [(speed(r), 1)])]
        for n, (r, _) in enumerate(line.loads):
            if n not in line.imposed.values():
                rows[r].append((ONE, [(("load", n), 1)]))
        return rows

    def forces(self, known):
        """The forces on each run, of one order of the series."""
        sum_of = lambda parts: weighted([(known[key], way) for key, way in parts])
        return [dot([(factor, sum_of(parts), 1) for factor, parts in row]) for row in self.rows]

    def inverted(self):
        """The inverse of the matrix of velocities that follow from the balance of forces alone, and by how much each of these changes
        the force on each run."""
        size, columns, shares = len(self.free), [], []
        for g in self.free:
            one = [weighted((c, way) for c, parts in row for key, way in parts if key == ("v", g)) for row in self.rows]
            columns.append([total(one[r] for r in self.members[own]) for own in self.free])
            shares.append(one)
        rows = [[columns[c][r] for c in range(size)] + [ONE if c == r else ZERO for c in range(size)] for r in range(size)]
        for c in range(size):
            pivot = next((r for r in range(c, size) if rows[r][c].sign()), None)
            decided(pivot is not None, "the forces do not determine a velocity")
            rows[c], rows[pivot] = rows[pivot], rows[c]
            rows[c] = [own / rows[c][c] if i != c else ONE for i, own in enumerate(rows[c])]
            for r in range(size):
                share = rows[r][c]
                if r != c and not share.is_zero():
                    rows[r] = [a - share * b for a, b in zip(rows[r], rows[c])]
        return [sparse(row[size:]) for row in rows], [sparse(row) for row in zip(*shares)]

    def solve(self, start, incoming, loads, step, orders):
        """All orders of velocities, compressions, displacements, gaps and forces, from those of order 0."""
        line, groups = self.line, range(self.count)
        now = {key: start[key] for key in ("alpha", "u", "gap")}
        now["v"] = {g: start["v"][self.mover[g]] if self.moved[g] else ZERO for g in groups if g not in self.free}
        series = {**{key: [own] for key, own in now.items()}, "forces": [], "push": []}
        for k in range(orders):
            v = series["v"][k]
            v |= {g: loads[n][k] for g, n in self.driven.items()}
            series["push"].append({i: self.push(i, series) for i in line.locals})
            known = {(key, n): own for key in ("v", "alpha", "u", "push") for n, own in series[key][k].items()}
            known |= {key: own[k] for key, own in incoming.items()} | {("load", n): own[k] for n, own in enumerate(loads)}
            known |= {("velocity", i): ZERO if k else own["velocity"] for i, own in enumerate(line.links) if own["is"] == "bar"}
            known |= {("v", g): ZERO for g in self.free} | {"start": ZERO if k else ONE}
            forces = self.forces(known)
            if self.free:
                open_ = [total(forces[r] for r in self.members[g]) for g in self.free]
                speeds = [dot([(c, open_[n], -1) for n, c in row]) for row in self.inverse]
                v |= zip(self.free, speeds)
                forces = [force + dot([(c, speeds[n], 1) for n, c in row]) for force, row in zip(forces, self.shares)]
            pushed = {g: total(forces[r] for r in self.members[g]) / self.mass[g] for g in groups if self.moved[g]}
            share = step / (k + 1)
            later = lambda rate: rate.times(share)
            run = lambda r: v[self.group[r]]
            series["v"].append({g: later(pushed[g]) if self.moved[g] else ZERO for g in groups if g not in self.free})
            series["alpha"].append({i: ZERO if i in self.loose else later(run(i) - run(i + 1)) for i in now["alpha"]})
            series["u"].append({n: later(run(r)) for n, (r, _, _) in enumerate(line.supports)})
            series["gap"].append({i: later(run(i + 1) - run(i)) for i in line.contacts})
            # Less inertia.
            keeps = lambda r: line.masses[r] * pushed[self.group[r]] if self.group[r] in pushed else ZERO
            series["forces"].append([force - keeps(r) for r, force in enumerate(forces)])
        return series

    def push(self, i, series):
        """The next order of the force F (a/b)^m in a local contact with the compression a, by a X' = m X a' where a is positive."""
        own, a, known = self.line.links[i], [one[i] for one in series["alpha"]], [one[i] for one in series["push"]]
        m, k, share = own["exponent"], len(known), a[0] / own["compression"]
        if a[0].sign() == -1 or all(one.is_zero() for one in a):
            return ZERO
        if k == 0:
            return own["force"] * power(share, m)
        if a[0].sign() == 1:
            p, q = m.numerator, m.denominator
            return dot((a[j], known[k - j], p * j - q * (k - j)) for j in range(1, k + 1)).times(Fraction(1, q * k)) / a[0]
        if k == 1:  # the slope lies between its values for the least and the largest compression
            return (own["force"] * power(share, m - 1) * a[1] / own["compression"]).times(m)
        raise Turning

    def contact_force(self, i, forces):
        """The force in a closed contact, by the balance of either side: of one that gives exactly zero, else of one without mass,
        if there is any."""
        own, line = self.members[self.group[i]], self.line
        sides = [(1, [r for r in own if r <= i]), (-1, [r for r in own if r > i])]
        sides = [(way, side) for way, side in sides if not any(line.fixed[r] or r in line.imposed for r in side)]
        need(sides, "a contact between walls")
        sides.sort(key=lambda own: any(line.masses[r].sign() for r in own[1]))
        told = [total(forces[r] for r in side).times(way) for way, side in sides]
        return next((force for force in told if force.is_zero()), told[0])


class Motion:
    """The motion as far as it is followed. A time is the number of an event, 0 for the start, and an exact time after it; the
    events of a second motion are counted on."""

    def __init__(self, cert, instants):
        self.line, self.claims, self.to = Line(cert), read_claims(cert), rational(cert["to"])
        self.step, self.terms = rational(cert["step"]), cert["terms"]
        need(not self.line.locals or PRECISION["bits"] > SPARE, "bits are too few for a local contact")
        need(self.to > 0 and self.step > 0 and self.to / self.step < MOST_CELLS, "the window is empty, or too long")
        line = self.line
        need(all(0 <= contact < len(line.contacts) for contact, *_ in self.claims), "an event without a contact")
        self.instants, self.now, self.marks, self.lengths, self.past, self.events = instants, START, [], [], [], []
        self.open = {i: {"flat": 0, "idle": None, "pressed": False} for i in line.contacts}
        gaps = {i: line.links[i]["gap"] for i in line.contacts}
        self.closed = {i for i, own in gaps.items() if own.is_zero()}
        springs = [i for i, link in enumerate(line.links) if link["is"] in ("spring", "local")]
        self.state = {
            "v": list(line.starts),
            "alpha": {i: ZERO for i in springs},
            "u": dict.fromkeys(range(len(line.supports)), ZERO),
            "gap": gaps,
        }
        self.system = System(line, self.closed)
        for own, fixed in zip(self.system.members, self.system.fixed):
            speeds = [line.starts[r] for r in own if line.masses[r].sign()] + [ZERO] * fixed
            need(all((speed - speeds[0]).is_zero() for speed in speeds[1:]), "rigid bodies meet at the start")
        self.late = {link["travel"]: -1 for link in line.links if link["is"] == "bar" and link["travel"] is not None}

    def instant(self, time):
        return self.instants[time[0]] + time[1].number()

    def later(self, a, b):
        """The sign of a less b."""
        sign = 0 if a == b else self.since(a, b).sign()
        decided(a == b or sign, "the order of two times is not decided")
        return sign

    def since(self, a, b):
        """How long after b a time a is."""
        return (a[1] - b[1]).number() if a[0] == b[0] else self.instant(a) - self.instant(b)

    def incoming(self):
        """The waves that reach the ends of bars from now on, and when the next one begins to."""
        found, nothing, ends = {}, [ZERO] * (self.terms + 1), [exactly(self.to)]
        for travel in self.late:
            while (
                self.late[travel] + 1 < len(self.marks)
                and self.later(moved(self.marks[self.late[travel] + 1], travel), self.now) <= 0
            ):
                self.late[travel] += 1
            if self.late[travel] + 1 < len(self.marks):
                ends.append(moved(self.marks[self.late[travel] + 1], travel))
            else:
                ends.append(moved(self.now, travel))
        for i, link in enumerate(self.line.links):
            if link["is"] == "bar":
                first = self.late.get(link["travel"], -1)
                for way in ("left", "right"):
                    found[i, way] = nothing
                    if first >= 0:
                        after = self.since(self.now, moved(self.marks[first], link["travel"]))
                        found[i, way] = shifted(self.past[first][way, i], after.times(1 / self.step), self.lengths[first])
        return found, ends

    def loads(self):
        """What acts from now on, and when that changes."""
        found, ends = [], []
        for _, load in self.line.loads:
            times = [(0, own) for own in (load.begin, load.end) if own is not None]
            ends += [own for own in times if self.later(own, self.now) > 0]
            acts = self.later((0, load.begin), self.now) <= 0
            acts = acts and (load.end is None or self.later((0, load.end), self.now) > 0)
            found.append(load.series(self.instant(self.now), self.step, self.terms) if acts else [ZERO] * (self.terms + 1))
        return found, ends

    def earliest(self, times):
        best = None
        for time in times:
            if self.later(time, self.now) > 0 and (best is None or self.later(time, best) < 0):
                best = time
        return best

    def settle(self, waves, loads):
        """The contacts that are closed from now on: a closed one does not pull, and a gap is not negative."""
        before, told = {i: (i in self.closed, self.open[i]["idle"], self.open[i]["pressed"]) for i in self.open}, len(
            self.events
        )
        for _ in range(4 * len(self.line.contacts) + 1):
            solved = self.solved(waves, loads)
            changes = []
            for i in self.line.contacts:
                sign = begins(self.kept(i, solved) + [ZERO])
                decided(sign is not None, "whether a contact changes is not decided")
                changes += [i] if sign < 0 else []
            changes = self.yielding(changes)
            if not changes:
                # What opens and closes at one instant has done neither.
                twice = {i for i in self.open if before[i][0] == (i in self.closed)}
                self.events[told:] = [event for event in self.events[told:] if event[1] not in twice]
                for i in twice:
                    _, self.open[i]["idle"], self.open[i]["pressed"] = before[i]
                return solved
            self.change(changes, False)
        raise Undecided("the contacts do not settle")

    def solved(self, waves, loads):
        """All orders of which those that arrive are known; one, where a local contact may begin or cease to push, and few on the tiny
        cells after that."""
        orders = min([self.terms, *(len(own) - 1 for own in waves.values())])
        if self.line.locals and orders > 1:
            tiny = self.pace(self.system.solve(self.state, waves, loads, self.step, 1))
            tiny, wanted = tiny.denominator.bit_length() - tiny.numerator.bit_length(), max(PRECISION["bits"] - SPARE, 0)
            orders = min(orders, max((wanted - 5 * tiny // 2) // 3 + 4, wanted // tiny + 2)) if tiny > 0 else orders
        try:
            return self.system.solve(self.state, waves, loads, self.step, orders)
        except Turning:
            return self.system.solve(self.state, waves, loads, self.step, 1)

    def yielding(self, changes):
        """Without a contact that a support would press: what supports alone would hold on, displaced, goes back to one side."""
        after, line = System(self.line, self.closed ^ set(changes)), self.line
        kept = set()
        for n in after.resting - self.system.resting:
            r, stiffness, _ = line.supports[n]
            own = after.members[after.group[r]]
            push = total(line.supports[m][1] * self.state["u"][m] for m in after.resting if line.supports[m][0] in own)
            decided(push.sign() is not None, "whether a support pushes is not decided")
            if push.sign() in (1, -1):
                kept.add(own[0] - 1 if push.sign() == 1 else own[-1])
        return [i for i in changes if i not in kept]

    def change(self, changes, by_itself):
        """Opens and closes contacts now. Where one opens by itself, or where both sides have inertia, the velocities on both
        sides are equal at first, unless the end of a spring comes loose. Where one opens by itself between masses or walls, its
        force has just come to zero, so their accelerations are equal too."""
        before, was_flush = self.system, {i: own["flat"] for i, own in self.open.items()}
        for i in changes:
            closes, own, idle = i not in self.closed, self.open[i], self.open[i]["idle"]
            if not closes and idle is not None and idle != self.now:
                self.events.append(("release", i, idle))
            self.events.append(("closing" if closes else "opening", i, self.now))
            self.closed ^= {i}
            own["idle"], own["pressed"], self.state["gap"][i] = None, False, ZERO
        self.system = System(self.line, self.closed)
        loosened = [("alpha", i) for i in self.system.loose - before.loose]
        loosened += [("u", n) for n in self.system.resting - before.resting]
        for what, n in loosened:
            is_slack, sign = what == "u" and self.line.supports[n][1].is_zero(), self.state[what][n].sign()
            # Where a contact opens by itself, its force has come to zero, and with it what stands alone behind it.
            decided(is_slack or by_itself or sign is not None, "whether a spring or a support is compressed is not decided")
            need(is_slack or sign in (0, None), "a spring or a support comes loose while it is compressed")
            self.state[what][n] = ZERO
        for i in self.closed & set(changes):
            need(was_flush[i] or not self.is_rigid_impact(i), "rigid bodies meet")
        for g, own in enumerate(self.system.members):
            for r in own:
                self.state["v"][r] = ZERO if self.system.fixed[g] else self.state["v"][self.system.mover[g]]
        for own in self.open.values():
            own["flat"] = 0  # velocities may jump
        for i in changes:
            groups = [self.system.group[r] for r in (i, i + 1)]
            inert, rigid = all(self.system.moved[g] for g in groups), all(self.system.moved[g] or self.system.fixed[g] for g in groups)
            if i not in self.closed and not loosened:
                self.open[i]["flat"] = int(inert or by_itself) + int(by_itself and rigid and len(changes) == 1)

    def is_rigid_impact(self, i):
        """Whether masses or walls on both sides of a contact, with nothing elastic between, have different velocities."""
        line, own = self.line, self.system.members[self.system.group[i]]
        sides = [[r for r in own if r <= i], [r for r in own if r > i]]
        speeds = [
            [ZERO if line.fixed[r] else self.state["v"][r] for r in side if line.fixed[r] or line.masses[r].sign()]
            for side in sides
        ]
        return all(speeds) and not (speeds[0][0] - speeds[1][0]).is_zero()

    def kept(self, i, solved):
        """What is not negative while a contact stays as it is: its force, or its gap."""
        if i in self.closed:
            return [self.system.contact_force(i, one) for one in solved["forces"]]
        series = [one[i] for one in solved["gap"]]
        for k in range(1, min(len(series), 1 + self.open[i]["flat"])):
            series[k] = ZERO
        return series[: len(solved["forces"])]

    def last(self, i, last, order):
        """The same, the last coefficient, for the whole cell."""
        return self.system.contact_force(i, last["forces"][order]) if i in self.closed else last["gap"][order][i]

    def enclosed(self, waves, loads, reach, orders):
        """All series of so many orders on a part of a step from now on, or None where it is too long."""
        span = Number.between(Fraction(0), reach)
        waves, loads = {key: shifted(own, span, Number(reach)) for key, own in waves.items()}, [shifted(own, span) for own in loads]
        start, box, system = self.state, self.state, self.system
        widened = lambda own: own if own.is_zero() else ball(own.units()[0], own.units()[1] * 5 // 4 + 1)
        for _ in range(40):
            rates = {key: own[1] for key, own in system.solve(box, waves, loads, self.step, 1).items() if len(own) > 1}
            speeds = [rates["v"].get(system.group[r], ZERO) for r in range(self.line.count)]
            grown = {key: {n: own + span * rates[key][n] for n, own in start[key].items()} for key in ("alpha", "u")}
            grown |= {"v": [own + span * rate for own, rate in zip(start["v"], speeds)], "gap": start["gap"]}
            values = lambda state: [*state["v"], *state["alpha"].values(), *state["u"].values()]
            if orders > 2 and not all(self.is_steady(grown["alpha"][i]) for i in self.line.locals):
                return None
            if all(old.holds(new) for old, new in zip(values(box), values(grown))):
                return system.solve(grown, waves, loads, self.step, orders)
            box = {key: {n: widened(own) for n, own in grown[key].items()} for key in ("alpha", "u", "gap")}
            box["v"] = [widened(own) for own in grown["v"]]
        return None

    @staticmethod
    def is_steady(compression):
        """Whether a local contact does not push, or is pressed nearly alike."""
        mid, off = compression.units()
        return compression.is_zero() or compression.sign() == -1 or mid > STEADY * off

    def advance(self):
        """One cell: what arrives, which contacts are closed, how far all is known, whether a contact changes, what leaves."""
        line = self.line
        waves, ends = self.incoming()
        loads, more = self.loads()
        exact = [exactly(low) for _, _, low, high in self.claims if low == high]
        end = self.earliest(ends + more + exact)
        solved = self.settle(waves, loads)
        end, last = self.cell(waves, loads, end, solved)
        system, N = self.system, len(last["forces"]) - 1
        guards = {i: self.kept(i, solved)[:N] + [self.last(i, last, N)] for i in line.contacts}
        self.watch(guards)
        due = self.due(end)
        place = self.crossing(due, guards) if due else self.since(end, self.now).times(1 / self.step)
        for i, own in guards.items():
            until = due[1] if due and due[0] == i else place.ends()[1]
            is_kept = all(c.is_zero() for c in own) or is_positive(own, Fraction(0), until)
            decided(is_kept, "a contact may change, but no event is claimed")
        series = lambda kind, n: [solved[kind][k].get(n, ZERO) for k in range(N)] + [last[kind][N].get(n, ZERO)]
        cell = {("v", r): series("v", system.group[r]) for r in range(line.count)}
        cell |= {("alpha", i): series("alpha", i) for i in self.state["alpha"]}
        cell |= {("u", n): series("u", n) for n in self.state["u"]}
        cell |= {("push", i): series("push", i) for i in line.locals}
        reach = place.ends()[1]
        length, over = Number(reach), Number.between(Fraction(0), reach)
        for i, link in enumerate(line.links):
            if link["is"] == "bar":
                for way, other, r in (("right", "left", i), ("left", "right", i + 1)):
                    at_rest = [link["velocity"]] + [ZERO] * N
                    arrives = waves[i, other]
                    if len(arrives) > N + 1:
                        arrives = [*arrives[:N], shifted(arrives, over, length)[N]]
                    leaves = [c - v - w for c, v, w in zip(cell["v", r], at_rest, arrives)]
                    cell[way, i] = [ZERO] * (N + 1) if line.endless[r] else leaves
        self.marks.append(self.now)
        self.lengths.append(length)
        self.past.append(cell)
        need(len(self.marks) < MOST_CELLS, "too many cells")
        self.state = {
            "v": [value(cell["v", r], place) for r in range(line.count)],
            "alpha": {i: value(cell["alpha", i], place) for i in self.state["alpha"]},
            "u": {n: value(cell["u", n], place) for n in self.state["u"]},
            "gap": {i: ZERO if i in self.closed else value(guards[i], place) for i in line.contacts},
        }
        for own in self.open.values():
            own["flat"] = 0
        if due:
            self.instants.append(self.instant(self.now) + place.times(self.step))
            self.now = (len(self.instants) - 1, Duration({}))
            self.change([due[0]], True)
        else:
            self.now = end

    def pace(self, solved):
        """How many steps a cell may take, so that the compression of a local contact hardly changes."""
        most = Fraction(1)
        for i in self.line.locals:
            compression, rate = (solved["alpha"][k][i].ends() for k in (0, 1))
            if compression[0] > 0 and any(rate):
                most = min(most, compression[0] / max(map(abs, rate)) / (STEADY // 2 + 1))
        return most

    def cell(self, waves, loads, end, solved):
        """The end of a cell that is short enough, and what encloses the last orders there."""
        least, orders = Fraction(1, 2 ** (PRECISION["bits"] // 4)), len(solved["forces"]) + 1
        reach = self.since(end, self.now).ends()[1] / self.step
        most = least if self.line.locals and orders == 2 else self.pace(solved)
        if reach > most:
            reach = rounded(max(most, least))
            end = moved(self.now, Duration.of(self.step * reach))
        for _ in range(80):
            orders = 2 if self.line.locals and reach <= least else orders
            last = self.enclosed(waves, loads, reach, orders)
            if last:
                return end, last
            reach = rounded(reach / 2)
            end = moved(self.now, Duration.of(self.step * reach))
        raise Undecided("a cell is too long")

    def watch(self, guards):
        """Notes impacts at the start, and since when contacts that have pushed have no force."""
        for i in sorted(self.closed):
            own, is_silent = self.open[i], all(c.is_zero() for c in guards[i])
            if not is_silent and self.now == START and all(event[1] != i for event in self.events):
                self.events.append(("closing", i, self.now))
            own["pressed"] |= not is_silent
            own["idle"] = (own["idle"] or self.now) if is_silent and own["pressed"] else None

    def due(self, end):
        """The contact that changes by itself on this cell first, as is claimed, and the interval, in steps from now."""
        best, (_, late), now = None, self.instant(self.now).ends(), self.instant(self.now)
        for i in self.line.contacts:
            told = sum(1 for kind, contact, _ in self.events if contact == i and kind != "release")
            claims = [claim[2:] for claim in self.claims if self.line.contacts[claim[0]] == i and claim[1] != "release"][told:]
            if claims and claims[0][0] < claims[0][1] <= self.instant(end).ends()[0]:
                low, high = ((time - edge) / self.step for time, edge in zip(claims[0], (late, now.ends()[0])))
                if 0 < high <= self.since(end, self.now).ends()[1] / self.step and (best is None or low < best[1]):
                    best = (i, max(low, Fraction(0)), high)
        return best

    def crossing(self, due, guards):
        """When a force or a gap comes to zero: once, since it falls there."""
        i, low, high = due
        series, falls = guards[i], slope(guards[i])
        need(value(series, Number(low)).sign() == 1, "a contact has changed before")
        need(value(series, Number(high)).sign() == -1, "a contact has not changed yet")
        for _ in range(10):
            rate = value(falls, Number.between(low, high))
            decided(rate.sign() == -1, "a contact may change twice")
            middle = (low + high) / 2
            near = (Number(middle) - value(series, Number(middle)) / rate).ends()
            low, high = max(low, near[0]), min(high, near[1])
            need(low <= high, "a contact does not change here")
            found = Number.between(low, high)
            low, high = found.ends()
        return found

    def follow(self):
        while self.now != exactly(self.to):
            self.advance()
        for i in sorted(self.closed):
            if self.open[i]["idle"] is not None:
                self.events.append(("release", i, self.open[i]["idle"]))


def sparse(row):
    """The entries of a row that are not zero, each with its place."""
    return [(n, own) for n, own in enumerate(row) if not own.is_zero()]


def rounded(number):
    """A number that is not much smaller, with a power of two below."""
    bits = number.denominator.bit_length() - number.numerator.bit_length() + 4
    return Fraction((number.numerator << bits) // number.denominator, 1 << bits) if bits > 0 else number


START = 0, Duration({})


def exactly(time):
    return 0, Duration.of(time)


def moved(time, by):
    return time[0], time[1] + by


def read_claims(cert):
    claims = []
    for contact, kind, low, high in cert["events"]:
        need(kind in ("closing", "opening", "release") and type(contact) is int, "an unknown event")
        low, high = rational(low), rational(high)
        need(0 <= low <= high, "an interval runs backwards, or begins too early")
        before = [end for other, _, _, end in claims if other == contact]
        need(not before or before[-1] <= low, "two events of a contact are in one interval")
        claims.append((contact, kind, low, high))
    return claims


def check_motions(cert, more):
    """The contacts of each line close, open and lose their force in this order, and no other ones do before the end."""
    need(cert.keys() == CLAIMS.union(more), "a claim lacks something, or has too much")
    for key, most in (("bits", MOST_BITS), ("terms", MOST_TERMS)):
        need(type(cert[key]) is int and 4 <= cert[key] <= most, f"{key} are too few, or too many")
    PRECISION["bits"] = cert["bits"]
    scenes, instants = [cert], [ZERO]
    if "minus" in cert:
        need(cert["minus"].keys() == OF_SECOND, "a second scene lacks something, or has too much")
        scenes.append(cert | cert["minus"])
    return [(followed(scene, instants), scene) for scene in scenes]


def followed(cert, instants):
    motion = Motion(cert, instants)
    motion.follow()
    need(len(motion.claims) == len(motion.events), f"{len(motion.events)} events instead of {len(motion.claims)}")
    found = {i: [own for own in motion.events if own[1] == i] for i in motion.line.contacts}
    times = []
    for contact, kind, low, high in motion.claims:
        event, *found[motion.line.contacts[contact]] = found[motion.line.contacts[contact]] or [(None, None, None)]
        need(event[0] == kind, f"a contact does something else than {kind}")
        first, last = motion.instant(event[2]).ends()
        need(low <= first and last <= high, f"the {kind} is between {float(first)} and {float(last)}")
        times.append(event[2])
    for a, b in zip(times, times[1:]):
        decided(motion.since(b, a).sign() in (0, 1), "events are not in the order of time")
    return motion


def check_events(cert):
    check_motions(cert, ())

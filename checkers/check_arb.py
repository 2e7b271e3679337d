#!/usr/bin/env python3
"""Checks certificates of wavestep over FLINT and Arb (`pip install python-flint`): a second opinion, which shares nothing with
check.py. Polynomials are FLINT's; laws are not turned into recurrences but evaluated, period by period, from the pieces;
signs between arrivals are shown by Taylor series in balls with Lagrange's remainder. docs/certificates.md says what is claimed.
"""

import json
import math
import random
import re
import sys

from reading import Wrong, main, need

try:
    import flint
    from flint import acb, acb_series, arb, fmpq, fmpq_mat, fmpq_mpoly_ctx

    from motion_arb import check_motion
    from readings_arb import check_extreme, check_reading, check_readings, check_zeros
    from series_arb import rational
except ImportError:
    if __name__ != "__main__":
        raise
    sys.exit("python-flint is missing: pip install python-flint")


def is_index(value, most=10**4):
    """An integer that is neither negative nor of a size that would fill the memory."""
    return type(value) is int and 0 <= value <= most


# Exact values: sums of quotients of polynomials times exponentials of such quotients.


class Ring:
    """The polynomials in all symbols of a certificate, where squares of roots are numbers."""

    def __init__(self, cert):
        need('"#' not in json.dumps(cert), "a name of ours")
        self.times = [cert["local"], cert["time"]]
        scenes = [cert] + ([cert["minus"]] if "minus" in cert else [])
        names = {name for scene in scenes for name in (scene["local"], scene["time"], *scene["waves"])}
        need(not names & set(cert["roots"]), "a time or a wave is no root")
        need("pi" not in names | set(cert["roots"]) | set(cert.get("numbers", {})), "pi is the number")
        names = {*self.times, *cert["roots"], "#n", "#p", "#r"}

        def collect(node):
            if isinstance(node, dict):
                names.update(key for key, power in node.items() if isinstance(power, int))
            for child in node.values() if isinstance(node, dict) else node if isinstance(node, list) else ():
                collect(child)

        collect([cert[key] for key in ("period", "line", "equations", "continuity", "pieces", "general", "observed", "minus") if key in cert])
        self.names = sorted(names)
        self.context = fmpq_mpoly_ctx.get(self.names, "lex")
        self.symbols = dict(zip(self.names, self.context.gens()))
        self.below = {self.names.index(root): self.prime(text) for root, text in cert["roots"].items()}
        need(len(set(self.below.values())) == len(self.below) <= 16, "two roots of one number, or too many")
        self.squares = [self.symbols[root] ** 2 - rational(square) for root, square in cert["roots"].items()]
        self.roots = list(self.below)
        self.zero, self.one = self.context.constant(0), self.context.constant(1)

    @staticmethod
    def prime(text):
        """Roots of -1 and of different primes are independent: no product of what is not zero is zero."""
        need(re.fullmatch("-1|[1-9][0-9]{0,11}", text), "what is below a root is no integer")
        value = int(text)
        proper = value > 1 and not any(value % d == 0 for d in range(2, math.isqrt(value) + 1))
        need(value == -1 or proper, "what is below a root is no prime")
        return value

    def reduced(self, polynomial):
        for square in self.squares:
            polynomial = polynomial % square
        return polynomial

    def polynomial(self, terms):
        total = {}
        for coefficient, powers in terms:
            need(all(is_index(power) and power > 0 for power in powers.values()), "a power is no positive integer")
            key = tuple(powers.get(name, 0) for name in self.names)
            need(key not in total and rational(coefficient) != 0, "a term stands twice, or is zero")
            total[key] = rational(coefficient)
        return self.context.from_dict(total)

    def quotient(self, rows):
        total = Quotient(self, self.zero, self.one)
        for top, factors in rows:
            need(type(factors) is list, "factors are no list")
            below = self.one
            for factor, power in factors:
                need(is_index(power) and power > 0, "a power is no positive integer")
                below = below * self.reduced(self.polynomial(factor)) ** power
            need(self.reduced(below) != 0, "a divisor is zero")
            total = total + Quotient(self, self.polynomial(top), self.reduced(below))
        return total

    def number(self, value):
        return Quotient(self, self.context.constant(value), self.one)

    def sum(self, rows):
        total = Sum({})
        for exponent, quotient in rows:
            total = total + Sum.of(self.quotient(exponent), self.quotient(quotient))
        return total


def key_of(number):
    """A polynomial, or a rational number, as a key; names do not count, since they may look like products."""
    terms = {(): number} if isinstance(number, fmpq) else number.to_dict()
    parts = [(tuple((i, power) for i, power in enumerate(powers) if power), (c.p, c.q)) for powers, c in terms.items() if c != 0]
    return tuple(sorted(parts))


class Quotient:
    def __init__(self, ring, top, below):
        self.ring, self.top, self.below = ring, ring.reduced(top), below

    def __add__(self, other):
        if self.below == other.below:
            return Quotient(self.ring, self.top + other.top, self.below)
        common = self.below.gcd(other.below)
        left, right = other.below / common, self.below / common
        return Quotient(self.ring, self.top * left + other.top * right, self.ring.reduced(self.below * left))

    def __mul__(self, other):
        return Quotient(self.ring, self.top * other.top, self.ring.reduced(self.below * other.below))

    def __sub__(self, other):
        return self + Quotient(self.ring, -other.top, other.below)

    def key(self):
        """The same for equal quotients, roots of sums apart, and another one for others."""
        common = self.top.gcd(self.below)
        unit = (self.below / common).leading_coefficient()
        return key_of(self.top / common / unit), key_of(self.below / common / unit)

    def powers(self, symbol):
        """The coefficients of the powers of a symbol above; below it does not stand."""
        index, parts = self.ring.names.index(symbol), {}
        need(self.below.degrees()[index] == 0, "a divisor holds the time")
        for monomial, coefficient in self.top.to_dict().items():
            rest = tuple(0 if i == index else power for i, power in enumerate(monomial))
            parts.setdefault(monomial[index], {})[rest] = coefficient
        below = self.below
        return {power: Quotient(self.ring, self.ring.context.from_dict(part), below) for power, part in parts.items()}

    def slope(self, symbol):
        need(self.below.degrees()[self.ring.names.index(symbol)] == 0, "a divisor holds the time")
        return Quotient(self.ring, self.top.derivative(symbol), self.below)

    def put(self, symbol, value):
        powers, total = self.powers(symbol), self.ring.number(0)
        for power in range(max(powers, default=0), -1, -1):
            total = total * value + powers.get(power, self.ring.number(0))
        return total


class Sum:
    def __init__(self, parts):
        self.parts = parts

    @staticmethod
    def of(exponent, quotient):
        return Sum({exponent.key(): (exponent, quotient)})

    def __add__(self, other):
        parts = dict(self.parts)
        for key, (exponent, quotient) in other.parts.items():
            parts[key] = (exponent, parts[key][1] + quotient if key in parts else quotient)
        return Sum(parts)

    def __mul__(self, other):
        total = Sum({})
        for exponent, quotient in self.parts.values():
            for more, factor in other.parts.values():
                total = total + Sum.of(exponent + more, quotient * factor)
        return total

    def __neg__(self):
        return Sum({key: (x, Quotient(r.ring, -r.top, r.below)) for key, (x, r) in self.parts.items()})

    def __sub__(self, other):
        return self + -other

    def slope(self, symbol):
        return Sum({key: (x, r.slope(symbol) + x.slope(symbol) * r) for key, (x, r) in self.parts.items()})

    def put(self, symbol, value):
        total = Sum({})
        for exponent, quotient in self.parts.values():
            total = total + Sum.of(exponent.put(symbol, value), quotient.put(symbol, value))
        return total

    def has(self, *symbols):
        """Whether one of these symbols stands in it."""
        polynomials = [p for pair in self.parts.values() for quotient in pair for p in (quotient.top, quotient.below)]
        return any(p.degrees()[p.context().variable_to_index(symbol)] > 0 for p in polynomials for symbol in symbols if p != 0)

    def is_zero(self):
        left = [part for part in self.parts.values() if part[1].top != 0]
        while left:
            (x, total), *others = left
            factors = [turned(y - x) if "pi" in x.ring.symbols else None for y, _ in others]
            for (_, quotient), factor in zip(others, factors):
                total = total + quotient * factor if factor else total
            if total.top != 0:
                return False
            left = [other for other, factor in zip(others, factors) if not factor]
        return True


def turned(exponent):
    """exp(i pi r), where an exponent is that and 12 r is whole; without roots of 2 and 3 where 2 r is."""
    ring = exponent.ring
    roots = {square: ring.context.gen(place) for place, square in ring.below.items()}
    if -1 not in roots:
        return None
    i, whole = roots[-1], ring.symbols["pi"] * roots[-1] * exponent.below
    r = exponent.top.leading_coefficient() / whole.leading_coefficient()
    if exponent.top != whole * r:
        return None
    known = {fmpq(0): 1}
    if {2, 3} <= roots.keys():
        sum_, less = roots[2] * (roots[3] + 1), roots[2] * (roots[3] - 1)
        known |= {fmpq(1, 12): (sum_ + i * less) / 4, fmpq(5, 12): (less + i * sum_) / 4}
        known |= {fmpq(1, 3): (1 + i * roots[3]) / 2, fmpq(1, 4): (1 + i) * roots[2] / 2, fmpq(1, 6): (i + roots[3]) / 2}
    quarters = (2 * r).floor()
    rest = r - fmpq(int(quarters), 2)
    return Quotient(ring, known[rest] * i ** int(quarters % 4), ring.one) if rest in known else None


def constant(ring, value):
    return Sum.of(ring.number(0), ring.number(value))


def inverse(quotient):
    need(quotient.top != 0, "a divisor is zero")
    return Quotient(quotient.ring, quotient.below, quotient.top)


def power(base, exponent, total):
    """Times a power, which may be negative where the base is a quotient."""
    for _ in range(abs(exponent)):
        total = total * (base if exponent > 0 else inverse(base))
    return total


# What laws are evaluated for: the waves on a period, or one wave at a time.


class Period:
    """The waves on the n-th period in local time, or their slopes; waves are zero before the first one."""

    def __init__(self, claim, n, slopes=False):
        self.claim, self.n, self.slopes = claim, n, slopes
        self.rates = None if slopes else Period(claim, n, True)

    def wave(self, name, lag):
        need(lag == int(lag) and lag >= 0, "a wave returns before it left, or between two periods")
        return self.at(name, self.n - int(lag))

    def at(self, name, n):
        if n < 0:
            return Sum({})
        return (self.claim.slopes if self.slopes else self.claim.pieces)[name][n]

    def sum(self, name, lag):
        total = Sum({})
        for n in range(self.n - lag):
            total = total + self.at(name, n)
        return total

    def forcing(self, function, lag):
        """What begins within a period is told by `Between`."""
        claim, ring = self.claim, self.claim.ring
        need(lag >= 0, "something acts before the start")
        if lag > self.n:
            return Sum({})
        function = function.slope(claim.time) if self.slopes else function
        later = Quotient(ring, ring.symbols[claim.local], ring.one) + claim.period * ring.number(self.n - lag)
        return function.put(claim.time, later)


class Unit:
    """One wave is 1 on the period itself, or its slope is; all else is zero."""

    def __init__(self, ring, name, slope):
        self.ring, self.name = ring, name
        self.rates = Unit(ring, name, False) if slope else None
        self.is_rate = slope

    def wave(self, name, lag):
        return constant(self.ring, 1) if name == self.name and lag == 0 and not self.is_rate else Sum({})

    def sum(self, name, lag):
        return Sum({})

    forcing = sum


class Between:
    """Only what begins within a period is there, with another factor for each time: it has to cancel."""

    def __init__(self, ring, time, factors, slopes=False):
        self.ring, self.time, self.factors, self.slopes = ring, time, factors, slopes
        self.rates = None if slopes else Between(ring, time, factors, True)

    def wave(self, name, lag):
        return Sum({})

    sum = wave

    def forcing(self, function, lag):
        if lag == int(lag):
            return Sum({})
        function = function.slope(self.time) if self.slopes else function
        return constant(self.ring, self.factors.setdefault(lag, fmpq(random.randrange(1, 1 << 60)))) * function


class Stated:
    """Equations and continuous forms as they are stated."""

    def __init__(self, cert, ring):
        self.ring = ring
        self.equations = [self.read(rows) for rows in cert["equations"]]
        self.continuity = [(self.read(rows), ring.sum(rows["start"])) for rows in cert["continuity"]]
        need(not any(start.has(*ring.times) for _, start in self.continuity), "a start depends on time")

    def read(self, rows):
        waves = [(wave, kind, lag, self.ring.sum(c)) for wave, kind, lag, c in rows["waves"]]
        forcing = [(lag, self.ring.sum(function)) for lag, function in rows["forcing"]]
        need(all(is_index(lag, 10**6) for lag in [lag for *_, lag, _ in waves] + [lag for lag, _ in forcing]), "a lag is no number of periods")
        need(not any(c.has(*self.ring.times) for *_, c in waves), "a coefficient depends on time")
        need(not any(function.has(self.ring.times[0]) for _, function in forcing), "a load depends on local time")
        return waves, forcing

    def value(self, form, world):
        total, (waves, forcing) = Sum({}), form
        for name, kind, lag, coefficient in waves:
            need(kind in ("value", "slope", "sum"), f"unknown operator {kind}")
            if kind == "slope" and world.rates is None:
                continue
            wave = world.rates.wave(name, lag) if kind == "slope" else world.sum(name, lag) if kind == "sum" else world.wave(name, lag)
            total = total + coefficient * wave
        for lag, function in forcing:
            total = total + world.forcing(function, lag)
        return total

    def zeros(self, world):
        return [self.value(form, world) for form in self.equations]

    def continuous(self, world):
        return [self.value(form, world) for form, _ in self.continuity]

    def starts(self):
        return [start for _, start in self.continuity]


class Line:
    """The laws of a line as it is drawn: runs of elements that move as one, with bars and springs between them."""

    def __init__(self, cert, claim):
        self.claim, self.ring, self.line = claim, claim.ring, cert["line"]
        ends = [i for i, element in enumerate(self.line) if element["is"] in ("free", "fixed", "endless")]
        need(ends == [0, len(self.line) - 1] and ends[1] > 0, "a line has two ends")
        self.runs, self.links, self.clocks = [[]], [], [self.count(self.line[0]["clock"])]
        for element in self.line:
            if element["is"] in ("bar", "spring"):
                is_bar = element["is"] == "bar"
                self.clocks.append(self.count(element["clock"]) if is_bar else self.clocks[-1])
                self.links.append(element)
                self.runs.append([])
            else:
                known = ("free", "fixed", "endless", "mass", "support", "force", "velocity", "motion")
                need(element["is"] in known, f"unknown element {element['is']}")
                self.runs[-1].append(element)
        for run, elements in enumerate(self.runs):
            if any(element["is"] == "endless" for element in elements):
                need(len(elements) == 1 and run in (0, len(self.links)), "an endless line ends with a bar")

    def count(self, rows):
        """How many periods a time is."""
        if rows is None:
            return None
        time, period = self.ring.quotient(rows), self.claim.period
        top, below = time.top * period.below, time.below * period.top
        count = top.leading_coefficient() / below.leading_coefficient() if top != 0 else fmpq(0)
        need(top == count * below, "a time is no multiple of the period")
        need(-(10**6) <= count <= 10**6, "a time is too late")
        return count

    def of(self, element, key):
        number = Sum.of(self.ring.number(0), self.ring.quotient(element[key]))
        need(not number.has(*self.ring.times), f"{key} depends on time")
        return number

    def is_at(self, run, *kinds):
        return [element for element in self.runs[run] if element["is"] in kinds]

    def load(self, element, run, world):
        total, time = Sum({}), self.claim.time
        first, last = self.count(element["from"]), self.count(element["until"])
        need(last is None or first < last, "a load ends before it begins")
        for key in ("from", "until"):
            if element[key] is not None:
                moment = self.ring.quotient(element[key])
                later = Quotient(self.ring, self.ring.symbols[time], self.ring.one) + moment
                course = self.ring.sum(element["course"]).put(time, later)
                need(not course.has(self.claim.local), "a load depends on local time")
                part = world.forcing(course, self.clocks[run] + self.count(element[key]))
                total = total + part if key == "from" else total - part
        return total

    def bar_waves(self, link, run, world):
        """The waves to the right and to the left at an end of a bar."""
        bar, (here, there) = self.links[link], (self.clocks[run], self.clocks[link if run > link else link + 1])
        for way, end in (("right", link), ("left", link + 1)):
            need((bar[way] is None) == bool(self.is_at(end, "endless")), "a bar lacks a wave, or has one from nowhere")
        travel = self.count(bar["travel"])
        need(travel is None or travel > 0, "a bar without length")
        lag = lambda: travel + here - there
        right = world.wave(bar["right"], lag() if run > link else 0) if bar["right"] else Sum({})
        left = world.wave(bar["left"], 0 if run > link else lag()) if bar["left"] else Sum({})
        return right, left

    def velocities(self, run, world):
        found = [self.load(element, run, world) for element in self.is_at(run, "velocity")]
        found += [Sum({}) for _ in self.is_at(run, "fixed")]
        for link in (run - 1, run):
            if 0 <= link < len(self.links) and self.links[link]["is"] == "bar":
                right, left = self.bar_waves(link, run, world)
                found.append(world.forcing(self.of(self.links[link], "velocity"), self.clocks[run]) + right + left)
        for element in self.is_at(run, "motion"):
            found.append(world.forcing(self.of(element, "from"), self.clocks[run]) + world.wave(element["wave"], 0))
        need(found, "a velocity is missing")
        return found

    def approach(self, link, world):
        return self.velocities(link, world)[0] - self.velocities(link + 1, world)[0]

    def force(self, link, run, world):
        if not 0 <= link < len(self.links):
            return Sum({})
        element = self.links[link]
        if element["is"] == "bar":
            right, left = self.bar_waves(link, run, world)
            at_start = world.forcing(self.of(element, "force"), self.clocks[run])
            return at_start + self.of(element, "impedance") * (right - left)
        damping = self.of(element, "damping") * self.approach(link, world)
        return damping + self.of(element, "stiffness") * world.wave(element["wave"], 0) if element["wave"] else damping

    def balance(self, run, world):
        total = self.force(run - 1, run, world) - self.force(run, run, world)
        first = self.velocities(run, world)[0]
        for element in self.runs[run]:
            if element["is"] == "mass" and world.rates is not None:
                total = total - self.of(element, "mass") * self.velocities(run, world.rates)[0]
            elif element["is"] == "support":
                total = total - self.of(element, "damping") * first
                if element["wave"]:
                    total = total - self.of(element, "stiffness") * world.wave(element["wave"], 0)
            elif element["is"] == "force":
                total = total + self.load(element, run, world)
        return total

    def moving(self):
        return [run for run in range(len(self.runs)) if not self.is_at(run, "endless")]

    def stored(self):
        """Waves that grow with a velocity: compressions and displacements."""
        for link, element in enumerate(self.links):
            if element["is"] == "spring":
                self.need_wave(element)
                if element["wave"]:
                    yield element["wave"], lambda world, link=link: self.approach(link, world)
        for run in self.moving():
            for element in self.is_at(run, "support"):
                self.need_wave(element)
                if element["wave"]:
                    yield element["wave"], lambda world, run=run: self.velocities(run, world)[0]

    def need_wave(self, element):
        need(element["wave"] is not None or self.of(element, "stiffness").is_zero(), "a compression is missing")

    def zeros(self, world):
        found = []
        for run in self.moving():
            first, *others = self.velocities(run, world)
            found += [first - other for other in others]
            if not self.is_at(run, "fixed", "velocity"):
                found.append(self.balance(run, world))
        for wave, velocity in self.stored():
            rate = world.rates.wave(wave, 0) if world.rates is not None else Sum({})
            found.append(rate - velocity(world))
        return found

    def continuous(self, world):
        found = []
        for run in self.moving():
            masses = self.is_at(run, "mass")
            if masses and not self.is_at(run, "fixed", "velocity"):
                momentum = Sum({})
                for element in masses:
                    start = world.forcing(self.of(element, "velocity"), self.clocks[run])
                    momentum = momentum + self.of(element, "mass") * (self.velocities(run, world)[0] - start)
                found.append(momentum)
        return found + [world.wave(wave, 0) for wave, _ in self.stored()]

    def starts(self):
        return [Sum({})] * len(self.continuous(Between(self.ring, self.claim.time, {})))


class Claim:
    """The pieces, and the laws that they satisfy."""

    def __init__(self, cert, ring):
        self.cert, self.ring = cert, ring
        need(ring.times == [cert["local"], cert["time"]], "the times have different names")
        self.local, self.time, self.period = cert["local"], cert["time"], self.ring.quotient(cert["period"])
        need(all(type(time) is str and time for time in self.ring.times) and self.local != self.time, "names of times")
        self.has_positive_period()
        self.set_pieces({wave: list(map(self.ring.sum, all_)) for wave, all_ in cert.get("pieces", {}).items()})
        need(not any(piece.has(self.time) for all_ in self.pieces.values() for piece in all_), "a piece depends on scene time")
        self.laws = Line(cert, self) if "line" in cert else Stated(cert, self.ring)
        need("pieces" not in cert or is_index(cert["through"], 10**6), "a period is no number")
        self.count = cert["through"] + 1 if "pieces" in cert else 0
        claimed = cert["pieces" if "pieces" in cert else "general"]
        need(all(type(wave) is str and wave for wave in cert["waves"]), "names of waves")
        need(set(claimed) == set(cert["waves"]) and len(cert["waves"]) == len(claimed), "names of waves")
        need(all(len(all_) == self.count for all_ in self.pieces.values()), "pieces are missing")
        if "observed" in cert:
            self.check_observed()
        self.minus = Claim(cert["minus"], ring) if "minus" in cert else None
        need(not (self.minus and self.minus.minus), "a third scene")

    def has_positive_period(self):
        period = Sum.of(self.ring.number(0), self.period)
        need(not period.has(*self.ring.times, *{"pi"} & set(self.ring.names), *map(self.ring.names.__getitem__, self.ring.roots)), "a period depends on time, or is no rational function")
        top, below = self.period.top, self.period.below
        if top.is_constant() and below.is_constant():
            return need(number_of(self.period) > 0, "a period is not positive")
        mixed = any(c > 0 for c in top.to_dict().values()) or any(c < 0 for c in below.to_dict().values())
        need(top != 0 and mixed, "a period is not positive")  # claims hold where it is

    def set_pieces(self, pieces):
        self.pieces = pieces
        self.slopes = {wave: [piece.slope(self.local) for piece in all_] for wave, all_ in pieces.items()}

    def check(self):
        if self.minus:
            self.minus.check()
        need(all(total.is_zero() for total in self.between()), "something begins within a period")
        self.determined()
        end, beginning = self.period, self.ring.number(0)
        before = self.laws.starts()
        for n in range(self.count):
            world = Period(self, n)
            for i, total in enumerate(self.laws.zeros(world)):
                need(total.is_zero(), f"law {i} on period {n}")
            forms = self.laws.continuous(world)
            for i, (form, start) in enumerate(zip(forms, before, strict=True)):
                need((form.put(self.local, beginning) - start).is_zero(), f"continuity {i} at the start of period {n}")
            before = [form.put(self.local, end) for form in forms]

    def between(self):
        world = Between(self.ring, self.time, {})
        return self.laws.zeros(world) + self.laws.continuous(world)

    def determined(self):
        """The laws have no other solution: two matrices have full rank."""
        waves, values = self.cert["waves"], {}
        number = lambda total: self.at_random(total, values)
        columns = lambda laws, slope: [list(map(number, laws(Unit(self.ring, wave, slope)))) for wave in waves]
        slopes, levels = columns(self.laws.zeros, True), columns(self.laws.zeros, False)
        starts = columns(self.laws.continuous, False)
        rows = lambda columns: list(map(list, zip(*columns)))
        need(len(slopes[0]) == len(waves), "laws and waves")
        pairs = list(zip(rows(slopes), rows(levels)))
        plain = [level for slope, level in pairs if not any(slope)]
        for matrix in ([slope for slope, _ in pairs if any(slope)] + plain, rows(starts) + plain):
            need(fmpq_mat(matrix or [[0]]).rank() == len(waves), "the laws leave something open")

    def at_random(self, total, values):
        """With random numbers for symbols."""
        at = lambda key: values.setdefault(key, fmpq(random.randrange(1, 1 << 60)))
        numbers, result = [at(name) for name in self.ring.names], fmpq(0)
        for exponent, quotient in total.parts.values():
            sides = (quotient.top.degrees(), quotient.below.degrees())
            need(not any(side[root] > 0 for side in sides for root in self.ring.roots), "a root in an equation")
            need(exponent.top == 0 or quotient.top == 0, "an exponential in an equation")
            result += quotient.top(*numbers) / quotient.below(*numbers)
        return result

    # Values between arrivals.

    def seen(self, begin):
        """The quantity from a time on as a sum in scene time, less that of a second scene, and when a next piece begins."""
        need(begin >= 0, "the time is before the start")
        period, total, ends = number_of(self.period), self.ring.sum(self.cert["observed"]["forcing"]), []
        for wave, kind, delay, coefficient in self.cert["observed"]["waves"]:
            need(kind in ("value", "slope") and wave in self.pieces, "an unknown wave or operator")
            delay = rational(delay)
            n = int(((begin - delay) / period).floor())
            ends.append(delay + (max(n, -1) + 1) * period)
            if n >= 0:
                need(n < self.count, "a period is missing")
                piece = (self.slopes if kind == "slope" else self.pieces)[wave][n]
                time = Quotient(self.ring, self.ring.symbols[self.time], self.ring.one)
                local = time + self.ring.number(-delay - n * period)
                total = total + self.ring.sum(coefficient) * piece.put(self.local, local)
        if self.minus:
            less, next_ = self.minus.seen(begin)
            total, ends = total - less, ends + ([next_] if next_ is not None else [])
        for index in (index for index, below in self.ring.below.items() if below == -1):
            root = self.ring.names[index]
            turned = Quotient(self.ring, -self.ring.symbols[root], self.ring.one)
            need((total.put(root, turned) - total).is_zero(), "the quantity is not real")
        return total, min(ends, default=None)

    def check_observed(self):
        observed, times = self.cert["observed"], self.ring.times
        need(not any(self.ring.sum(c).has(*times) for *_, c in observed["waves"]), "a coefficient depends on time")
        need(not self.ring.sum(observed["forcing"]).has(self.local), "what is observed depends on local time")


def number_of(quotient):
    """A rational number, or a polynomial in roots."""
    ring, top = quotient.ring, quotient.top
    need(quotient.below.is_constant(), "a symbol has no value")
    top = top / quotient.below.leading_coefficient()
    if top.is_constant():
        return top.leading_coefficient() if top != 0 else fmpq(0)
    need(all(degree == 0 or i in ring.roots for i, degree in enumerate(top.degrees())), "a symbol has no value")
    return top


class Numbers:
    """A sum in scene time with numbers: parts (c, r, p) mean p(t) exp(c + r t)."""

    def __init__(self, ring, parts):
        self.ring, self.parts = ring, parts

    @staticmethod
    def of(total, claim):
        parts = []
        for exponent, quotient in total.parts.values():
            linear, powers = exponent.powers(claim.time), quotient.powers(claim.time)
            need(all(power <= 1 for power in linear), "an exponent is not linear in the time")
            c, r = (number_of(linear[power]) if power in linear else fmpq(0) for power in (0, 1))
            p = [number_of(powers[power]) if power in powers else fmpq(0) for power in range(max(powers, default=-1) + 1)]
            if any(a != 0 for a in p):
                parts.append((c, r, p))
        return Numbers(claim.ring, parts)

    def times(self, a, b):
        """The product of two numbers, with numbers in place of squares of roots."""
        product = a * b
        return product if isinstance(product, fmpq) else self.ring.reduced(product)

    def ball(self, number):
        return acb(number) if isinstance(number, fmpq) else number_in_balls(self.ring, number)

    def slope(self):
        parts = []
        for c, r, p in self.parts:
            slope = [self.times(r, a) + (i + 1) * b for i, (a, b) in enumerate(zip(p, p[1:] + [fmpq(0)]))]
            if any(a != 0 for a in slope):
                parts.append((c, r, slope))
        return Numbers(self.ring, parts)

    def shifted(self, by):
        """The sum plus a number."""
        return Numbers(self.ring, self.parts + ([(fmpq(0), fmpq(0), [by])] if by != 0 else []))

    def sign(self, time):
        """Exponentials of different algebraic numbers are linearly independent over algebraic numbers."""
        exact = {}
        for c, r, p in self.parts:
            value = fmpq(0)
            for a in reversed(p):
                value = value * time + a
            x = c + r * time
            key = key_of(x)
            exact[key] = x, exact.get(key, (x, fmpq(0)))[1] + value
        if all(value == 0 for _, value in exact.values()):
            return 0
        for bits in (64, 256, 1024, 4096, 16384, 65536):
            flint.ctx.prec = bits
            value = sum((self.ball(x).exp() * self.ball(a) for x, a in exact.values()), acb(0)).real
            if value > 0 or value < 0:
                return 1 if value > 0 else -1
        raise Wrong("a sign is not decided")

    def series(self, middle, terms):
        """The Taylor coefficients about each point of a ball."""
        flint.ctx.cap = terms
        total, t = acb_series([0], prec=terms), acb_series([middle, 1], prec=terms)
        for c, r, p in self.parts:
            value = acb_series([0], prec=terms)
            for a in reversed(p):
                value = value * t + acb_series([self.ball(a)], prec=terms)
            exponent = acb_series([self.ball(c)], prec=terms) + acb_series([self.ball(r)], prec=terms) * t
            total = total + value * exponent.exp()
        return [total[k].real for k in range(terms)]

    def sign_on(self, begin, end):
        """f(m + x) = c_0 + ... + c_(N-1) x^(N-1) + c x^N with c among the N-th coefficients about all points of the interval."""
        for bits, terms in ((192, 12), (192, 24), (256, 48), (512, 96), (2048, 192)):
            flint.ctx.prec = bits
            middle, half = arb((begin + end) / 2), arb((end - begin) / 2)
            about = self.series(middle, terms)
            last = self.series(middle + half * arb(0, 1), terms + 1)[terms]
            rest = sum((abs(c) * half**k for k, c in enumerate(about) if k), abs(last) * half**terms)
            if about[0] > rest or -about[0] > rest:
                return 1 if about[0] > 0 else -1
        raise Wrong(f"no sign is seen between {begin} and {end}")


def number_in_balls(ring, polynomial):
    """A polynomial in roots, each of which is the root of an integer."""
    total = acb(0)
    for powers, c in polynomial.to_dict().items():
        term = acb(c)
        for index in ring.roots:
            if powers[index]:
                need(powers[index] == 1, "a square of a root")
                term *= acb(ring.below[index]).sqrt()
        total += term
    return total


# Formulas for every n.


class Later:
    """The same one period later."""

    def __init__(self, world):
        self.world = world
        self.rates = Later(world.rates) if world.rates is not None else None

    def wave(self, name, lag):
        return self.world.wave(name, lag + 1)

    def forcing(self, function, lag):
        return self.world.forcing(function, lag + 1)

    def sum(self, name, lag):
        return Sum({})


class Sums:
    """What a sum over earlier periods has of the last of these."""

    def __init__(self, world):
        self.world, self.rates = world, None

    def sum(self, name, lag):
        return self.world.wave(name, lag + 1)

    def wave(self, name, lag):
        return Sum({})

    forcing = wave


def differences(laws, world):
    """Laws less the same one period before: sums over earlier periods are gone."""
    three = zip(laws.zeros(world), laws.zeros(Later(world)), laws.zeros(Sums(world)), strict=True)
    return [now - before + sums for now, before, sums in three]


class Counting:
    """A world that only notes the largest delay."""

    def __init__(self):
        self.latest, self.rates = 0, self

    def wave(self, name, lag):
        need(lag == int(lag) and lag >= 0, "a wave returns before it left, or between two periods")
        return self.forcing(name, lag)

    def forcing(self, _, lag):
        self.latest = max(self.latest, int(lag) + 1)
        return Sum({})

    sum = wave


def latest_of(laws):
    world = Counting()
    laws.continuous(world), laws.zeros(world)
    return world.latest


class Echoes:
    """Waves as sums of echoes, e_k(t - k D): what laws hold for the delay k D, with rational or symbolic k."""

    def __init__(self, claim, forms):
        self.claim, self.ring = claim, claim.ring
        some = next(iter(forms.values()))
        for key in ("rate", "ratio", "laguerre"):
            need(all(own[key] == some[key] for own in forms.values()), "different echoes")
        self.b, self.r = self.ring.quotient(some["rate"]), self.ring.quotient(some["ratio"])
        self.c = None if some["laguerre"] is None else self.ring.quotient(some["laguerre"])
        need(self.c is None or self.c.top != 0, "Laguerre's polynomials of nothing")
        self.first = {wave: list(map(self.ring.sum, own["first"])) for wave, own in forms.items()}
        self.terms = {wave: [(i, self.ring.quotient(c)) for i, c in own["terms"]] for wave, own in forms.items()}
        need(all(is_index(i) for own in self.terms.values() for i, _ in own), "an echo is no number")
        need(not any(echo.has(claim.time) for first in self.first.values() for echo in first), "an echo depends on scene time")
        numbers = [c for own in self.terms.values() for _, c in own] + [self.b, self.r] + [self.c] * (self.c is not None)
        need(all(is_free(Sum.of(self.ring.number(0), number), claim) for number in numbers), "a number depends on time")
        self.minus = self.ring.number(-1)
        self.x = Quotient(self.ring, self.ring.symbols[claim.local], self.ring.one)
        self.known = {}

    def basic(self, m):
        """L_m(c x) by its recurrence, or x^m/m!."""
        need(m >= 0, "an echo before the first one")
        one = self.ring.number(1)
        before, now = self.ring.number(0), one
        for k in range(m):
            if self.c is None:
                now = now * self.x * self.ring.number(fmpq(1, k + 1))
            else:
                factor = self.ring.number(2 * k + 1) + self.minus * self.c * self.x
                following = factor * now + self.ring.number(-k) * before
                before, now = now, following * self.ring.number(fmpq(1, k + 1))
        return now

    def echo(self, wave, k):
        if k < len(self.first[wave]):
            return self.first[wave][k]
        if (wave, k) not in self.known:
            total = self.ring.number(0)
            for i, c in self.terms[wave]:
                total = total + c * self.basic(k - i)
            self.known[wave, k] = Sum.of(self.minus * self.b * self.x, power(self.r, k, total))
        return self.known[wave, k]

    def late(self, wave, lag, slopes):
        """The transform of e_(k - lag) or of its slope over that of T_k, both without r^k, and the value of e_(k - lag) at 0."""
        p = Quotient(self.ring, self.ring.symbols["#p"], self.ring.one)
        u = p + self.b
        v = u + self.minus * self.c if self.c is not None else self.ring.number(1)
        total, start = self.ring.number(0), self.ring.number(0)
        for i, c in self.terms[wave]:
            own = power(self.r, -lag, c)
            total = total + power(u, lag + i, power(v, -lag - i, own))
            start = start + own
        return (p * total if slopes else total), start if self.c is not None else self.ring.number(0)


class Delay:
    """What waves, or their slopes, have of one delay k D."""

    def __init__(self, echoes, k, slopes=False):
        self.echoes, self.k, self.slopes = echoes, k, slopes
        self.rates = None if slopes else Delay(echoes, k, True)

    def wave(self, name, lag):
        need(lag == int(lag) and lag >= 0, "a wave returns before it left, or between two periods")
        if lag > self.k:
            return Sum({})
        echo = self.echoes.echo(name, self.k - int(lag))
        return echo.slope(self.echoes.claim.local) if self.slopes else echo

    def forcing(self, function, lag):
        if lag != self.k:
            return Sum({})
        time = self.echoes.claim.time
        return (function.slope(time) if self.slopes else function).put(time, self.echoes.x)

    def sum(self, name, lag):
        return Sum({})


class Transform:
    """All late echoes at once: their transforms, or (of slopes) what these lack, the values at 0."""

    def __init__(self, echoes, starts, slopes=False):
        self.echoes, self.starts, self.slopes = echoes, starts, slopes
        self.rates = None if slopes else Transform(echoes, starts, True)

    def wave(self, name, lag):
        transform, start = self.echoes.late(name, int(lag), self.slopes)
        kept = self.slopes if self.starts == "slopes" else not self.slopes
        start = start if kept else self.echoes.ring.number(0)
        return Sum.of(self.echoes.ring.number(0), transform if self.starts is None else start)

    def forcing(self, function, lag):
        return Sum({})

    sum = forcing


def is_free(total, claim):
    return total.slope(claim.local).is_zero() and total.slope(claim.time).is_zero()


def check_general(cert, claim):
    forms = cert["general"]
    if isinstance(claim.laws, Stated):
        for waves, _ in claim.laws.equations + [form for form, _ in claim.laws.continuity]:
            need(all(is_free(c, claim) for *_, c in waves), "a coefficient depends on time")
        for (waves, _), _ in claim.laws.continuity:
            need(all(kind == "value" for _, kind, _, _ in waves), "a sum or a slope that is continuous")
    begins = latest_of(claim.laws) + 2 + max(len(own["first"]) for own in forms.values())
    if not all("rate" in own for own in forms.values()):
        return check_sequences(claim, forms, begins)
    echoes = Echoes(claim, forms)
    begins += max([0] + [i for own in echoes.terms.values() for i, _ in own])
    starts, zero = claim.laws.starts(), claim.ring.number(0)
    for k in range(begins):
        world = Delay(echoes, k)
        need(all(total.is_zero() for total in differences(claim.laws, world)), f"a law for echo {k}")
        for form, start in zip(claim.laws.continuous(world), starts, strict=True):
            begin = form.put(claim.local, zero)
            need((begin if k else begin - start).is_zero(), f"continuity of echo {k}")
    for starts in (None, "slopes"):
        need(all(total.is_zero() for total in differences(claim.laws, Transform(echoes, starts))), "a law for all later echoes")
    begin = claim.laws.continuous(Transform(echoes, "values"))
    need(all(total.is_zero() for total in begin), "the values with which all later echoes begin")


class Sequence:
    """Waves that are sums of c n^j r^n, with a power of `#r` in place of each r^n."""

    def __init__(self, claim, forms):
        self.claim, self.ring, self.tags, self.rates = claim, claim.ring, {}, None
        read = self.ring.sum
        self.first = {wave: list(map(read, own["first"])) for wave, own in forms.items()}
        self.terms = {wave: [(read(c), j, read(r)) for c, j, r in own["terms"]] for wave, own in forms.items()}
        need(all(is_free(part, claim) for own in self.terms.values() for c, _, r in own for part in (c, r)), "a sequence")
        need(all(is_index(j) for own in self.terms.values() for _, j, _ in own), "a power")
        need(not any(value.has(claim.time) for first in self.first.values() for value in first), "a value depends on scene time")
        self.latest = latest_of(claim.laws) + 1

    def at(self, wave, n):
        if n < len(self.first[wave]):
            return self.first[wave][n]
        total = Sum({})
        for c, j, ratio in self.terms[wave]:
            total = total + power(ratio, n, c * constant(self.ring, fmpq(n) ** j))
        return total

    def tag(self, ratio):
        key = tuple(sorted((x, r.key()) for x, (_, r) in ratio.parts.items()))
        tag = self.ring.symbols["#r"] ** self.tags.setdefault(key, len(self.tags))
        return Sum.of(self.ring.number(0), Quotient(self.ring, tag, self.ring.one))

    def wave(self, name, lag):
        n = Sum.of(self.ring.number(0), Quotient(self.ring, self.ring.symbols["#n"] - int(lag), self.ring.one))
        total = Sum({})
        for c, j, ratio in self.terms[name]:
            total = total + self.tag(ratio) * power(ratio, self.latest - int(lag), power(n, j, c))
        return total

    def forcing(self, function, lag):
        need(is_free(function, self.claim), "a load that changes")
        return self.tag(constant(self.ring, 1)) * function

    def sum(self, name, lag):
        return Sum({})


def check_sequences(claim, forms, begins):
    world = Sequence(claim, forms)
    claim.set_pieces({wave: [world.at(wave, n) for n in range(begins)] for wave in forms})
    claim.count = begins
    need(not claim.laws.starts(), "sequences start nowhere")
    units = [claim.laws.zeros(Unit(claim.ring, wave, True)) for wave in forms]
    need(all(total.is_zero() for unit in units for total in unit), "derivatives of sequences")
    claim.check()
    need(all(total.is_zero() for total in differences(claim.laws, world)), "a law for every n")


# Claims about a window.


def cells(cert, claim, level):
    """The intervals of the window: the quantity less a level there, what order has one sign, and which."""
    time = rational(cert["from"])
    need(time < rational(cert["to"]), "the window is empty")
    for begin, end, order in cert["cells"]:
        begin, end = rational(begin), rational(end)
        need(begin == time and begin < end, "the intervals have gaps")
        total, next_ = claim.seen(begin)
        need(next_ is None or end <= next_, "a wave arrives within an interval")
        total = total - constant(claim.ring, level)
        if order is None:
            need(total.is_zero(), "the quantity is not constant")
            yield begin, end, Numbers.of(total, claim), order, 0
        else:
            need(type(order) is int and 0 <= order <= 64, "an order is no number")
            numbers = [Numbers.of(total, claim)]
            for _ in range(order):
                numbers.append(numbers[-1].slope())
            flat = [all(between.sign(at) == 0 for between in numbers[1:-1]) for at in (begin, end)]
            need(any(flat), "the derivatives between do not vanish")
            yield begin, end, numbers[0], order, numbers[-1].sign_on(begin, end)
        time = end
    need(time == rational(cert["to"]), "the intervals end early or late")


def decimal(cert):
    """A decimal, and half a unit of its last place."""
    need(type(cert["last_place"]) is int and -20000 <= cert["last_place"] <= 20000, "a place is no number")
    value, unit = rational(cert["value"]), fmpq(10) ** cert["last_place"]
    need((value / unit).q == 1, "the decimal has more digits than it says")
    return value, unit / 2


def check_value(cert, claim):
    time, (value, slack) = rational(cert["at"]), decimal(cert)
    numbers = Numbers.of(claim.seen(time)[0], claim)
    need(numbers.shifted(slack - value).sign(time) >= 0 >= numbers.shifted(-slack - value).sign(time), "another value")


def check_doubles(cert, claim):
    begin, end, points = rational(cert["from"]), rational(cert["to"]), cert["points"]
    need(is_index(points) and points == len(cert["values"]) > 0 and begin <= end, "values and times")
    for i, row in enumerate(cert["values"]):
        time, (value, off) = begin + (end - begin) * fmpq(i, max(points - 1, 1)), map(rational, row)
        numbers = Numbers.of(claim.seen(time)[0], claim).shifted(-value)
        need(numbers.shifted(off).sign(time) >= 0 >= numbers.shifted(-off).sign(time), f"another value at {time}")


def check_roots(cert, claim):
    claims = [tuple(map(rational, pair)) for pair in cert["zeros"]]
    need(all(a[1] < b[0] for a, b in zip(claims, claims[1:])), "two zeros are in one place")
    exact, crossings = [], []
    for begin, end, numbers, order, _ in cells(cert, claim, fmpq(0)):
        if order is None:
            exact.append([begin, end])
        elif order > 0:
            signs = numbers.sign(begin), numbers.sign(end)
            if signs[0] * signs[1] < 0:
                crossings.append((begin, end, numbers))
            exact += [[at, at] for at, sign in zip((begin, end), signs) if sign == 0]
    joined = []
    for first, last in exact:
        if joined and joined[-1][1] == first:
            joined[-1][1] = last
        else:
            joined.append([first, last])
    tell = lambda low, high, first, last: low <= first and last <= high and (first == last or (low, high) == (first, last))
    crosses = lambda low, high, numbers: low < high and numbers.sign(low) * numbers.sign(high) < 0
    told = [
        sum(tell(low, high, *pair) for pair in joined)
        + sum(crosses(max(low, begin), min(high, end), numbers) for begin, end, numbers in crossings)
        for low, high in claims
    ]
    need(told == [1] * len(claims) and len(claims) == len(joined) + len(crossings), "the zeros are others")


def check_extremum(cert, claim):
    need(cert["goal"] in ("largest", "smallest", "distance"), "an unknown goal")
    (value, slack), (place, time), taken = decimal(cert), cert["attained"], []
    for way, goals in ((1, ("largest", "distance")), (-1, ("smallest", "distance"))):
        if cert["goal"] not in goals:
            continue
        # The distance is the size of the largest value, or of the smallest one.
        bound = way * (value if cert["goal"] == "distance" else way * value) + way * slack
        for i, (begin, end, numbers, order, sign) in enumerate(cells(cert, claim, bound)):
            signs = [sign] if not order else [numbers.sign(begin), numbers.sign(end)]
            need(all(way * sign <= 0 for sign in signs), f"a value between {begin} and {end} is beyond the extremum")
            if i == place:
                at = rational(time)
                taken.append(begin <= at <= end and way * numbers.shifted(2 * way * slack).sign(at) >= 0)
    need(any(taken), "the extremum is not taken where it is said")


def check(cert):
    version = cert.get("wavestep_certificate")
    need(type(version) is int and version == 1, "a certificate of another version")
    need(isinstance(cert["title"], str) and cert["title"].encode(), "a title is missing")
    kinds = {"pieces": lambda *_: None, "general": check_general, "value": check_value, "doubles": check_doubles}
    kinds |= {"roots": check_roots, "extremum": check_extremum}
    motions = {"events": check_motion, "reading": check_reading, "readings": check_readings}
    motions |= {"extreme": check_extreme, "zeros": check_zeros}
    need(cert["kind"] in kinds | motions, f"unknown kind {json.dumps(cert['kind'])}")
    need("minus" not in cert or "observed" in cert["minus"] and cert["kind"] not in ("pieces", "general"), "a second scene for nothing")
    if cert["kind"] in motions:
        squares = [Ring.prime(text) for text in cert["roots"].values()]
        need(len(set(squares)) == len(squares) <= 16, "two roots of one number, or too many")
        motions[cert["kind"]](cert)
        return
    claim = Claim(cert, Ring(cert))
    claim.check()
    kinds[cert["kind"]](cert, claim)


if __name__ == "__main__":
    main(check)

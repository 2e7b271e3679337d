"""What is read of a motion: values at times, largest and smallest values, zeros, with nothing but the standard library."""

from bisect import bisect_left
from fractions import Fraction
from functools import cmp_to_key
from itertools import zip_longest

from exact import MINUS, accumulate, decimal, is_count, is_zero, rational, read_function
from motion import check_motions, exactly, moved
from reading import decided, need
from series import ONE, ZERO, Duration, Number, interval, is_positive, shifted, slope, squared, total, value

READS, HALF = {"quantity", "observed"}, Fraction(1, 2)

# What can be read of elements, and how much more has to be said: delays of both waves, a side.
READINGS = {("bar", what): 2 for what in ("velocity", "displacement", "force")}
READINGS |= {("bar", "work"): 2, ("bar", "momentum"): 0} | {(kind, "energy"): 0 for kind in ("bar", "mass", "spring", "support")}
READINGS |= {(kind, what): 1 for kind in ("spring", "local") for what in ("velocity", "displacement")}
READINGS |= {(kind, what): 0 for kind in ("mass", "support", "force", "velocity") for what in ("velocity", "displacement")}
READINGS |= {(kind, what): 0 for kind in ("spring", "support") for what in ("compression", "force", "loss")}
READINGS |= {("local", what): 0 for what in ("compression", "force")}
CONTINUOUS = {(kind, "displacement") for kind in ("bar", "spring", "local", "mass", "support", "force", "velocity")}
CONTINUOUS |= {("spring", "compression"), ("local", "compression"), ("mass", "velocity")}


class Reader:
    """Reads a motion that has been followed."""

    def __init__(self, motion, rows):
        self.motion, self.rows, self.sums = motion, rows, {}

    def cell_at(self, time):
        """The number of the cell that holds a time, and how far in it the time is, in steps."""
        after = lambda n: time - self.motion.instant(self.motion.marks[n])

        def is_later(n):
            decided(after(n).sign() is not None, "it is not decided on which side of an arrival a time is")
            return after(n).sign() == -1

        n = bisect_left(range(len(self.motion.marks)), True, key=is_later) - 1
        need(n >= 0, "a time before the start")
        return n, after(n).times(1 / self.motion.step)

    def integral(self, n, key, of):
        """The integral from the start on, of what is known or of its square, as a series on a cell."""
        read = lambda m: squared(self.past(m, key), self.motion.lengths[m]) if of is squared else self.past(m, key)
        over = lambda m: [c.times(self.motion.step / (k + 1)) for k, c in enumerate(read(m))]
        sums = self.sums.setdefault((key, of), [ZERO])
        while len(sums) <= n:
            m = len(sums) - 1
            length = self.motion.since(self.motion.marks[m + 1], self.motion.marks[m]).times(1 / self.motion.step)
            sums.append(value([sums[m], *over(m)], length))
        return [sums[n], *over(n)]

    def past(self, n, key):
        """What is known on a cell, and the rate at which a spring is compressed."""
        past, (what, place) = self.motion.past[n], key
        if what != "rate":
            return past[key]
        return list(map(total, zip_longest(past["v", place], scaled(-ONE, past["v", place + 1]), fillvalue=ZERO)))

    def at(self, time):
        """What is known at a time: a function of what, how long before, and of what of it the integral from the start on is meant."""

        def known(key, delay, summed=None):
            there = time - self.motion.line.number(delay) if delay else time
            decided(there.sign() is not None, "it is not decided whether a wave has arrived")
            if there.sign() == -1:  # nothing was before the start
                return [ZERO]
            n, x = self.cell_at(there)
            return [value(self.integral(n, key, summed) if summed else self.motion.past[n][key], x)]

        return [time], known, ONE

    def on(self, begin, end):
        """The same between two times between which nothing arrives, as series about the first one."""

        def known(key, delay, summed=None):
            delay = self.motion.line.duration(delay) if delay else Duration({})
            n = bisect_left(range(len(self.motion.marks)), True, key=lambda n: self.motion.later(moved(self.motion.marks[n], delay), begin) > 0) - 1
            need(n + 1 == len(self.motion.marks) or self.motion.later(moved(self.motion.marks[n + 1], delay), end) >= 0, "something arrives between")
            if n < 0:
                return [ZERO]
            after = self.motion.since(begin, moved(self.motion.marks[n], delay)).times(1 / self.motion.step)
            return shifted(self.integral(n, key, summed) if summed else self.motion.past[n][key], after, self.motion.lengths[n])

        reach = Number(self.motion.since(end, begin).ends()[1] / self.motion.step)
        return [self.motion.instant(begin), Number(self.motion.step)], known, reach

    def seen(self, where):
        """A sum of coefficients times what is read of elements, as a value or a series."""
        line, sums, (time, known, reach) = self.motion.line, [[ZERO]], where
        for coefficient, what, name, *of in self.rows:
            need(name in line.places, f"there is no {name}")
            kind, n = line.places[name]
            need((kind, what) in READINGS and len(of) == READINGS[kind, what], f"{what} of {name} cannot be read")
            factor, link = line.number(coefficient), line.links[n] if kind in ("bar", "spring", "local") else {}
            if kind == "bar" and what in ("momentum", "energy"):
                sums += [scaled(factor * link["impedance"], own) for own in getattr(self, what)(n, link, known)]
                continue
            if kind == "bar":
                is_sum, (right, left) = what == "displacement", of
                self.need_section(n, right, left)
                if what == "work":
                    sums += [scaled(factor, own) for own in self.work(link, time, [(("right", n), right), (("left", n), left)], known)]
                    continue
                at_rest = scaled(link["velocity"], time if is_sum else [ONE])
                size, way = (link["impedance"], -link["impedance"]) if what == "force" else (ONE, ONE)
                sums.append(scaled(factor, [link["force"]] if what == "force" else at_rest))
                for key, own, amount in ((("right", n), right, size), (("left", n), left, way)):
                    sums += [] if own is None else [scaled(factor * amount, known(key, own, list if is_sum else None))]
                continue
            if what in ("velocity", "displacement"):
                need(not of or of[0] in ("left", "right"), "a side is missing")
                run = n + (of[0] == "right") if of else line.supports[n][0] if kind == "support" else n
                sums.append(scaled(factor, known(("v", run), None, list if what == "displacement" else None)))
                continue
            if kind == "mass":
                sums.append(scaled((factor * line.own_masses[name]).times(HALF), squared(known(("v", n), None), reach)))
                continue
            if kind == "local":
                sums.append(scaled(factor, known(("alpha" if what == "compression" else "push", n), None)))
                continue
            read = known(("alpha", n) if kind == "spring" else ("u", n), None)
            stiffness, damping = (link["stiffness"], link["damping"]) if link else line.supports[n][1:]
            if what == "energy":
                sums.append(scaled((factor * stiffness).times(HALF), squared(read, reach)))
                continue
            if what == "loss":  # what its damper has taken
                key = ("rate", n) if link else ("v", line.supports[n][0])
                sums.append(scaled(factor * damping, known(key, None, squared)))
                continue
            if what == "compression":
                sums.append(scaled(factor, read))
                continue
            sums.append(scaled(factor * stiffness, read))
            for r, way in ((n, damping), (n + 1, -damping)) if link else ((line.supports[n][0], damping),):
                sums.append(scaled(factor * way, known(("v", r), None)))
        return list(map(total, zip_longest(*sums, fillvalue=ZERO)))

    def inside(self, n, way, known, of):
        """What a wave in a bar, or its square, adds up to over all sections: for its travel time, or else from the start on."""
        line, key = self.motion.line, (way, n)
        if line.endless[n + (way == "left")]:
            return []
        gone = [] if line.travels[n] is None else [scaled(-ONE, known(key, line.travels[n], of))]
        return [known(key, None, of), *gone]

    def work(self, link, time, waves, known):
        """What has passed a section of a bar, the integral of force times velocity: with the waves a and b these are x + z (a - b) and
        v + a + b, and their product is x v + (x + z v) a + (x - z v) b + z (a^2 - b^2)."""
        z, v, x = link["impedance"], link["velocity"], link["force"]
        sums = [scaled(x * v, time)]
        for way, (key, delay) in zip((z, -z), waves):
            if delay is not None:
                sums += [scaled(x + way * v, known(key, delay, list)), scaled(way, known(key, delay, squared))]
        return sums

    def momentum(self, n, link, known):
        """Of a bar over its impedance: the sum of the velocities of all sections."""
        need(link["travel"] or link["velocity"].is_zero(), "the momentum of an endless bar is infinite")
        at_rest = link["velocity"] * link["travel"].number() if link["travel"] else ZERO
        return [[at_rest], *self.inside(n, "right", known, list), *self.inside(n, "left", known, list)]

    def energy(self, n, link, known):
        """Of a bar over its impedance: half the squares of velocities and of forces over the impedance. For the waves a and b these
        are v + a + b and x + a - b, so that they add up to (v^2 + x^2)/2 + a^2 + b^2 + (v + x) a + (v - x) b."""
        v, x = link["velocity"], link["force"] / link["impedance"]
        need(link["travel"] or v.is_zero() and x.is_zero(), "the energy of an endless bar is infinite")
        at_rest = (v * v + x * x).times(HALF) * link["travel"].number() if link["travel"] else ZERO
        sums = [[at_rest]]
        for way, factor in (("right", v + x), ("left", v - x)):
            sums += self.inside(n, way, known, squared)
            sums += [scaled(factor, own) for own in self.inside(n, way, known, list)]
        return sums

    def arrivals(self):
        """When what is read may change."""
        places, rows = self.motion.line.places, self.rows
        in_bars = [places[name][1] for _, what, name, *_ in rows if what in ("momentum", "energy") and places[name][0] == "bar"]
        of_bars = [self.motion.line.travels[n] for n in in_bars]
        told = [own for row in rows for own in row[3:] if type(own) is list] + [own for own in of_bars if own is not None]
        delays = [Duration({})] + [self.motion.line.duration(own) for own in told]
        return {moved(mark, delay) for mark in self.motion.marks for delay in delays}

    def need_section(self, n, right, left):
        """Two delays are those of one section of a bar: from an endless side comes nothing, else they add up to the travel time."""
        line, delays = self.motion.line, [own for own in (right, left) if own is not None]
        need((right is None, left is None) == (line.endless[n], line.endless[n + 1]), "a wave is left out, or comes from an endless side")
        for own in delays:
            decided(line.number(own).sign() in (0, 1), "a delay may be negative")
        if len(delays) == 2:
            rest = accumulate({(): read_function(right)}, {(): read_function(left)})
            need(is_zero(accumulate(rest, {(): read_function(line.travels[n])}, MINUS)), "the delays do not add up to the travel time")


class Reading:
    """What is read of a motion, less what is read of a second one, if any."""

    def __init__(self, cert, more):
        motions = check_motions(cert, READS.union(more, {"minus"} & cert.keys()))
        self.readers, self.motion = [Reader(motion, scene["observed"]) for motion, scene in motions], motions[0][0]

    def less(self, series):
        one, *others = series
        return list(map(total, zip_longest(one, *(scaled(-ONE, own) for own in others), fillvalue=ZERO)))

    def at(self, time):
        return self.less([reader.seen(reader.at(time)) for reader in self.readers])[0]

    def on(self, begin, end):
        return self.less([reader.seen(reader.on(begin, end)) for reader in self.readers])

    def is_continuous(self):
        """Whether nothing that is read ever jumps."""
        rows = ((reader.motion.line.places[name][0], what) for reader in self.readers for _, what, name, *_ in reader.rows)
        return CONTINUOUS.issuperset(rows)

    def parts(self, begin, end, times):
        """Times in order, from one to another, between which nothing that is read arrives; these ones are among them, but for
        those of which it is not decided whether they are before an arrival."""
        later, since = self.motion.later, self.motion.since
        cuts = set().union(*(reader.arrivals() for reader in self.readers))
        cuts |= {time for time in times if all(time == cut or since(time, cut).sign() for cut in cuts)}
        inside = [cut for cut in cuts if later(begin, cut) < 0 < later(end, cut)]
        found = [begin, *sorted(inside, key=cmp_to_key(later)), end]
        return [(a, b) for a, b in zip(found, found[1:]) if later(a, b)]


def scaled(factor, series):
    return [factor * own for own in series]


def within(motion, time):
    """The least and the greatest time of an interval, where the motion is known."""
    first, last = time.ends()
    need(0 <= first and last < motion.to, "the time is outside the window")
    return first, last


def check_reading(cert):
    """What is read at a time is the decimal, correctly rounded, for all times and units of the two intervals."""
    reading = Reading(cert, {"unit", "at", "value", "last_place"})
    (claim, slack), time = decimal(cert), interval(cert["at"])
    within(reading.motion, time)
    low, high = (reading.at(time) * interval(cert["unit"])).ends()
    need(claim - slack <= low and high <= claim + slack, f"the value is between {float(low)} and {float(high)}")


def check_readings(cert):
    """What is read at evenly spaced times is off by the bound at most, for all times and units of the intervals."""
    reading = Reading(cert, {"unit", "from", "until", "points", "values"})
    begin, end, unit = (interval(cert[key]) for key in ("from", "until", "unit"))
    within(reading.motion, begin)
    within(reading.motion, end)
    need(cert["points"] == 1 or (end - begin).sign() == 1, "the window runs backwards, or may do so")
    need(is_count(cert["points"]) and cert["points"] == len(cert["values"]) > 0, "a value is missing, or there is one too many")
    for i, (claim, off) in enumerate([rational(own) for own in row] for row in cert["values"]):
        share = Fraction(i, max(cert["points"] - 1, 1))
        low, high = (reading.at(begin.times(1 - share) + end.times(share)) * unit).ends()
        need(claim - off <= low and high <= claim + off, f"value {i} is between {float(low)} and {float(high)}")


def check_extreme(cert):
    """Nothing that is read in the window is beyond the decimal by more than half a unit of its last place, and at one time it is
    as near; a distance is so on both sides of zero, and as near on one."""
    ways, (claim, slack) = {"largest": [1], "smallest": [-1], "distance": [1, -1]}[cert["goal"]], decimal(cert)
    reading = Reading(cert, {"unit", "from", "until", "goal", "value", "last_place", "times", "attained"})
    motion, (begin, end, unit) = reading.motion, (interval(cert[key]) for key in ("from", "until", "unit"))
    (first, after), (before, last) = within(motion, begin), within(motion, end)
    need(after < before, "the window is empty")
    size = lambda way: claim * way if cert["goal"] == "distance" else claim
    # How far what is read is below a bound, which is half a unit beyond the decimal or short of it.
    left = lambda way, read, by: scaled(Number(Fraction(-way)), [read[0] * unit - Number(size(way) + way * by), *scaled(unit, read[1:])])
    for a, b in reading.parts(exactly(first), exactly(last), [exactly(rational(own)) for own in cert["times"]]):
        read, reach = reading.on(a, b), motion.since(b, a).ends()[1] / motion.step
        for below in (left(way, read, slack) for way in ways):
            need(below[0].sign() == 1, f"a value is beyond the extremum at {float(motion.instant(a).ends()[0])}")
            decided(is_positive(below, Fraction(0), reach), "between two times there may be an extremum")
    time = rational(cert["attained"])
    need(after <= time < before, "the extremum is taken outside the window")
    near = [left(way, [reading.at(Number(time))], -slack)[0].sign() for way in ways]
    decided(any(sign in (0, -1) for sign in near), "the extremum is not taken where it is said")


def check_zeros(cert):
    """From the least to the greatest time of the window what is read is zero once in each of the intervals, and throughout each of
    the rests, and nowhere else but perhaps in the interval in which a rest begins."""
    reading, ((first, after), (before, last)) = Reading(cert, {"from", "until", "times", "zeros", "rests"}), (
        map(rational, cert[key]) for key in ("from", "until")
    )
    motion = reading.motion
    need(first <= after and before <= last and first < last, "the window is empty, or runs backwards")
    need(0 <= first and last < motion.to, "the time is outside the window")
    need(all(type(cert[key]) is list for key in ("zeros", "rests", "times")), "a list is missing")
    ends = [rational(time) for low, high in cert["zeros"] for time in (low, high)]
    need(all(a < b for a, b in zip([first, *ends], [*ends, last])), "intervals of zeros overlap, or reach beyond the window")
    zeros = [(exactly(low), exactly(high)) for low, high in zip(ends[::2], ends[1::2])]
    crossing, crossed, rests, is_after_rest = None, [], [], False
    claims = [[tuple(map(rational, time)) for time in rest] for rest in cert["rests"]]
    hints = list(map(exactly, [*map(rational, cert["times"]), *ends, *(low for (low, _), _ in claims)]))
    parts = reading.parts(exactly(first), exactly(last), hints)
    reads = [reading.on(a, b) for a, b in parts]
    is_rest = [all(own.is_zero() for own in read) for read in reads] + [False]
    for n, ((a, b), read) in enumerate(zip(parts, reads)):
        length = motion.since(b, a).times(1 / motion.step)
        reach, inside = length.ends()[1], [i for i, (low, high) in enumerate(zeros) if motion.later(low, a) <= 0 <= motion.later(high, b)]
        if is_rest[n]:
            need(not inside, "where one zero is claimed it is zero all of the time")
            rests = [*rests[:-1], (rests[-1][0], b)] if is_after_rest else [*rests, (a, b)]
            is_after_rest = True
            continue
        if n == 0 and read[0].is_zero():  # a rest of no length
            rests, is_after_rest = [(a, a)], True
        if is_rest[n + 1] and len(rests) < len(claims):  # nothing is claimed where it begins
            low, high = claims[len(rests)][0]
            if motion.later(exactly(low), a) <= 0 and motion.instant(b).ends()[1] <= high:
                is_after_rest = False
                continue
        if inside:
            way = value(slope(read), Number.between(Fraction(0), reach)).sign()
            decided(way in (1, -1), "it is not decided whether there is one zero in an interval")
            low, high = zeros[inside[0]]
            begins, ends = motion.later(low, a) == 0, motion.later(high, b) == 0
            # Across a time at which something arrives, what is continuous goes on in the same direction.
            need(begins or crossing == (inside, way) and reading.is_continuous(), "an interval of a zero is cut by an arrival")
            decided(not begins or read[0].sign() == -way, "there may be no zero in an interval")
            decided(not ends or value(read, length).sign() == way, "there may be no zero in an interval")
            crossing, crossed = (inside, way), crossed + inside * ends
        else:
            while is_after_rest and read[0].is_zero():  # where the rest ends it is zero, and not later
                read = read[1:]
            way = read[0].sign()
            decided(way in (1, -1), "it is not decided whether it is zero at a time")
            decided(is_rest[n + 1] or value(read, length).sign() == way, "it is not decided whether it is zero just before a time")
            decided(is_positive(scaled(Number(Fraction(way)), read), Fraction(0), reach), "between two times there may be a zero")
        is_after_rest = False
    need(crossed == list(range(len(zeros))), "an interval of a zero is cut by an arrival")
    need(len(rests) == len(claims), f"there are {len(rests)} rests")
    for times, intervals in zip(rests, claims):
        for time, (least, most) in zip(times, intervals):
            low, high = motion.instant(time).ends()
            need(least <= low and high <= most, "a rest begins or ends at another time")

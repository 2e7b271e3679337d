"""What is read of a motion, over Arb: values at times, bounds of all values in a window, and all zeros there."""

from bisect import bisect_left
from functools import cmp_to_key

from flint import arb, fmpq

from motion_arb import at, check_motion, rational_above, rational_below
from reading import decided, need
from series_arb import NIL, Length, derivative, horner, interval, is_nil, moved, rational, short, sign, span, square, stays_positive

READ = "quantity observed "


def plus(a, b):
    a, b = sorted((a, b), key=len)
    return [short(x + y) for x, y in zip(a, b)] + b[len(a) :]


def times(factor, series):
    return [NIL if is_nil(c) else short(factor * c) for c in series]


class Place:
    """Where a motion is read: from a time on until another one, as Taylor coefficients in steps, or only at a time."""

    def __init__(self, story, begin, end):
        self.story, self.begin, self.end = story, begin, end
        self.reach = rational_above(arb(story.between(end, begin) / story.step)) if end else fmpq(1)

    def time(self):
        return [self.story.when(self.begin), self.story.step]

    def delayed(self, rows):
        delay = self.story.parts.length(rows)
        return lambda time: (time[0], time[1].plus(delay))

    def series(self, key, later, over=None):
        """Something in the last cell that begins no later, counted from there; or the integral of some of it from the start on."""
        story = self.story
        following = bisect_left(story.begins, True, key=lambda begin: story.is_later(later(begin), self.begin))
        if self.end is not None and following < len(story.begins):
            need(not story.is_later(self.end, later(story.begins[following])), "something arrives there")
        found = following - 1
        if found < 0:
            return [NIL]
        own = self.integral(key, found, over) if over else story.past[found][key]
        gone = short(story.between(self.begin, later(story.begins[found])) / story.step)
        return moved(own, gone) if self.end else [horner(own, gone)]

    def integral(self, key, n, over):
        story = self.story
        rate = lambda past: plus(past["speed", key[1]], times(-1, past["speed", key[1] + 1]))
        known = lambda past: rate(past) if key[0] == "rate" else past[key]
        read = lambda m: square(known(story.past[m]), story.reaches[m]) if over is square else known(story.past[m])
        grown = lambda m: times(story.step, [NIL] + [c / (k + 1) for k, c in enumerate(read(m))])
        sums = story.integrals.setdefault((key, over), [NIL])
        for m in range(len(sums) - 1, n):
            length = short(story.between(story.begins[m + 1], story.begins[m]) / story.step)
            sums.append(short(sums[m] + horner(grown(m), length)))
        return plus([sums[n]], grown(n))

    def check_section(self, n, right, left):
        """Whether the delays are those of a section: none from an endless side, else as long together as the way through the bar."""
        parts, delays = self.story.parts, [own for own in (right, left) if own is not None]
        need([right is None, left is None] == parts.endless[n : n + 2], "a wave is missing, or comes from an endless side")
        decided(all(sign(parts.length(own).value()) in (0, 1) for own in delays), "a wave may be read before it enters")
        if len(delays) == 2:
            need(parts.is_sum(delays, parts.links[n]["rows"]), "the delays are not those of one section")

    def gathered(self, n, way, over):
        """The integral over a bar of a wave, or of its square: what has entered and not left yet."""
        endless, travel, now = self.story.parts.endless, self.story.parts.links[n]["travel"], lambda time: time
        if endless[n] if way == "f" else endless[n + 1]:
            return [NIL]
        entered = self.series((way, n), now, over)
        if travel is None:
            return entered
        return plus(entered, times(-1, self.series((way, n), lambda time: (time[0], time[1].plus(travel)), over)))

    def whole(self, n, what):
        """The momentum of a bar, or its energy: that of v + f + g and p + Z (f - g) is Z/2 (v + f + g)^2 + (p + Z (f - g))^2/(2 Z)."""
        link = self.story.parts.links[n]
        z, v, p, travel = (link[key] for key in ("impedance", "velocity", "force", "travel"))
        need(travel is not None or is_nil(v) and (what == "momentum" or is_nil(p)), "something infinite is read")
        width = NIL if travel is None else travel.value()
        f, g = (self.gathered(n, way, list) for way in "fg")
        if what == "momentum":
            return plus([short(z * v * width)], times(z, plus(f, g)))
        squares = times(z, plus(self.gathered(n, "f", square), self.gathered(n, "g", square)))
        mixed = plus(times(short(z * v + p), f), times(short(z * v - p), g))
        return plus([short((z * v * v + p * p / z) * width / 2)], plus(squares, mixed))

    def passed(self, n, right, left):
        """The integral of (v + f + g) (p + Z (f - g)) at a section, where the waves have been on the way for so long."""
        self.check_section(n, right, left)
        z, v, p = (self.story.parts.links[n][key] for key in ("impedance", "velocity", "force"))
        work = times(short(p * v), self.time())
        for way, own, side in (("f", right, z), ("g", left, -z)):
            if own is not None:
                wave, power = (self.series((way, n), self.delayed(own), over) for over in (list, square))
                work = plus(work, plus(times(short(p + side * v), wave), times(side, power)))
        return work

    def observed(self, rows):
        """The sum of what is read of elements by their names."""
        parts, result = self.story.parts, [NIL]
        now = lambda time: time
        for factor, what, name, *of in rows:
            kind, n = parts.named[name]
            if kind == "bar" and what in ("momentum", "energy"):
                need(not of, "a bar as a whole has no section")
                read = self.whole(n, what)
            elif kind == "bar" and what == "work":
                need(len(of) == 2, "the section is missing")
                read = self.passed(n, *of)
            elif what == "loss":
                need(kind in ("spring", "support") and not of, "this has no damper")
                key = ("rate", n) if kind == "spring" else ("speed", parts.supports[n][0])
                damping = parts.links[n]["damping"] if kind == "spring" else parts.supports[n][2]
                read = times(damping, self.series(key, now, square))
            elif what == "energy":
                need(kind in ("mass", "spring", "support") and not of, "this has no energy")
                key = {"mass": "speed", "spring": "alpha", "support": "u"}[kind]
                own = {"mass": parts.masses.get(name), "support": parts.supports[n][1] if kind == "support" else None}
                own = parts.links[n]["stiffness"] if kind == "spring" else own[kind]
                read = times(own / 2, square(self.series((key, n), now), self.reach))
            elif kind == "bar":
                need(what in ("velocity", "force", "displacement") and len(of) == 2, "a bar is read in another way")
                self.check_section(n, *of)
                link, over = parts.links[n], what == "displacement"
                f, g = (
                    [NIL] if own is None else self.series((way, n), self.delayed(own), list if over else None) for way, own in zip("fg", of)
                )
                read = plus(times(link["velocity"], self.time() if over else [fmpq(1)]), plus(f, g))
                if what == "force":
                    read = plus([link["force"]], times(link["impedance"], plus(f, times(-1, g))))
            elif what in ("velocity", "displacement"):
                is_link = kind in ("spring", "local")
                need(of in (["left"], ["right"]) if is_link else not of, "a spring has two sides, others have none")
                run = n + (of == ["right"]) if is_link else parts.supports[n][0] if kind == "support" else n
                read = self.series(("speed", run), now, list if what == "displacement" else None)
            elif kind == "local":
                need(what in ("compression", "force") and not of, "this cannot be read")
                read = self.series(("alpha" if what == "compression" else "push", n), now)
            else:
                need(what in ("compression", "force") and kind in ("spring", "support") and not of, "this cannot be read")
                read = self.series(("alpha" if kind == "spring" else "u", n), now)
                if what == "force":
                    run, stiffness, damping = (
                        (n, parts.links[n]["stiffness"], parts.links[n]["damping"]) if kind == "spring" else parts.supports[n]
                    )
                    beyond = self.series(("speed", n + 1), now) if kind == "spring" else [NIL]
                    rate = plus(self.series(("speed", run), now), times(-1, beyond))
                    read = plus(times(stiffness, read), times(damping, rate))
            result = plus(result, times(parts.number(factor), read))
        return result


class Observed:
    """What is read of a motion, less what is read of a second one, if any."""

    def __init__(self, cert, more):
        self.told = check_motion(cert, READ + more)
        self.story = self.told[0][0]

    def seen(self, begin, end):
        series = [Place(story, begin, end).observed(rows) for story, rows in self.told]
        return series[0] if len(series) == 1 else plus(series[0], times(-1, series[1]))

    def never_jumps(self):
        """Whether all that is read is a displacement, the velocity of a mass, or how far a spring or a local contact is pressed."""
        kinds = [(story.parts.named[row[2]][0], row[1]) for story, rows in self.told for row in rows]
        pressed = [(kind, "compression") for kind in ("spring", "local")]
        return all(what == "displacement" or (kind, what) in [("mass", "velocity"), *pressed] for kind, what in kinds)

    def read(self, time):
        """The value at a time that may be an interval."""
        story = self.story
        need(sign(time) in (0, 1) and sign(story.end - time) == 1, "the time is outside the window")
        begin = at(time) if isinstance(time, fmpq) else (len(story.origins), Length())
        story.origins += [] if isinstance(time, fmpq) else [time]
        return self.seen(begin, None)[0]

    def cut(self, begin, end, hints):
        """Parts of a window between which nothing that is read arrives, as pairs of times; some begin at these times."""
        story = self.story
        first = begin if isinstance(begin, fmpq) else rational_below(begin)
        last = end if isinstance(end, fmpq) else rational_above(end)
        need(0 <= first and last < story.end and sign(end - begin) == 1, "the window is empty, or outside what is followed")
        arrivals = [(n, s.plus(lag)) for own, rows in self.told for n, s in own.begins for lag in lags(own, rows)]
        # Hints that are not known to be before or after an arrival are none.
        hints = [at(rational(time)) for time in hints]
        arrivals += [time for time in hints if all(time == own or sign(story.between(time, own)) for own in arrivals)]
        inside = [time for time in arrivals if story.is_later(time, at(first)) and story.is_later(at(last), time)]
        order = lambda a, b: story.is_later(a, b) - story.is_later(b, a)
        cuts = [at(first), *sorted(inside, key=cmp_to_key(order)), at(last)]
        return [(a, b) for a, b in zip(cuts, cuts[1:]) if story.is_later(b, a)]


def lags(story, rows):
    """How much later than something begins it is read."""
    found = [Length()] + [story.parts.length(own) for row in rows for own in row[3:] if type(own) is list]
    bars = [story.parts.named[row[2]] for row in rows if row[1] in ("momentum", "energy")]
    travels = [story.parts.links[n]["travel"] for kind, n in bars if kind == "bar"]
    return found + [travel for travel in travels if travel is not None]


def is_within(value, error):
    return bool(arb(abs(value)) <= arb(error)) if isinstance(value, arb) else abs(value) <= error


def decimal(cert):
    place = cert["last_place"]
    need(type(place) is int and abs(place) <= 20000, "a place is no number, or too large")
    value, unit = rational(cert["value"]), fmpq(10) ** place
    need(int((value / unit).q) == 1, "the decimal has more digits than it says")
    return value, unit / 2


def check_reading(cert):
    """The decimal is what is read, correctly rounded, whatever the time and the unit are within their intervals."""
    observed, (value, half) = Observed(cert, "unit at value last_place"), decimal(cert)
    read = observed.read(interval(cert["at"])) * interval(cert["unit"])
    need(is_within(read - value, half), "the value is another one")


def check_readings(cert):
    """Each value is as near to what is read at its time as its bound says."""
    observed, count = Observed(cert, "unit from until points values"), cert["points"]
    begin, end, unit = (interval(cert[key]) for key in ("from", "until", "unit"))
    need(type(count) is int and len(cert["values"]) == count > 0, "there are more or fewer values than points")
    need(sign(end - begin) in (0, 1) or count == 1, "the window runs backwards")
    for i, (value, error) in enumerate(cert["values"]):
        share = fmpq(i, max(count - 1, 1))
        time = begin * (1 - share) + end * share
        need(is_within(observed.read(time) * unit - rational(value), rational(error)), f"value {i} is another one")


def length(story, a, b):
    """A bound of how long a part is, in steps."""
    steps = short(story.between(b, a) / story.step)
    return steps if isinstance(steps, fmpq) else rational_above(steps)


def check_extreme(cert):
    """What is read stays on one side of a bound, half a unit in the last place beyond the decimal, and comes as near once; of a
    distance it stays between two, and comes as near to one."""
    observed = Observed(cert, "unit from until goal value last_place times attained")
    (value, half), (begin, end, unit) = decimal(cert), (interval(cert[key]) for key in ("from", "until", "unit"))
    bounds = {"largest": {1: value}, "smallest": {-1: -value}, "distance": {1: value, -1: value}}[cert["goal"]]
    for a, b in observed.cut(begin, end, cert["times"]):
        read, until = times(unit, observed.seen(a, b)), length(observed.story, a, b)
        for way, most in bounds.items():
            left = plus([most + half], times(-way, read))
            decided(sign(left[0]) == 1 and stays_positive(left, NIL, until), "a value is beyond the extremum, or may be")
    time = rational(cert["attained"])
    need(sign(time - begin) in (0, 1) and sign(end - time) == 1, "the extremum is taken outside the window")
    read = observed.read(time) * unit
    near = [sign(way * read - (most - half)) in (0, 1) for way, most in bounds.items()]
    need(any(near), "the extremum is not taken where it is said")


def exact_or_ball(story, time):
    return time[1].value() if time[0] == 0 else story.when(time)


def begins_in(story, a, b, claim):
    """Whether a part lies in the interval in which the rest after it is said to begin."""
    return claim is not None and not story.is_later(at(claim[0]), a) and sign(claim[1] - exact_or_ball(story, b)) in (0, 1)


def check_zeros(cert):
    """What is read passes through zero once in each interval, does not leave it in a rest, and is not zero elsewhere in the widest
    window: nothing is said of the interval in which a rest begins."""
    observed = Observed(cert, "from until times zeros rests")
    story = observed.story
    (begin, after), (before, end) = (map(rational, cert[key]) for key in ("from", "until"))
    need(begin <= after and before <= end, "a time runs backwards")
    pairs = [[rational(low), rational(high)] for low, high in cert["zeros"]]
    need(all(isinstance(cert[key], list) for key in ("zeros", "rests", "times")), "a list is missing")
    marks = [begin, *sum(pairs, []), end]
    need(begin < end and all(a < b for a, b in zip(marks, marks[1:])), "intervals of zeros overlap, or reach beyond the window")
    found, passed, rests, rising = set(), None, [], {}
    claims = [[list(map(rational, time)) for time in rest] for rest in cert["rests"]]
    hints = cert["times"] + [time for pair in cert["zeros"] for time in pair] + [low for (low, _), _ in cert["rests"]]
    parts = [(a, b, observed.seen(a, b)) for a, b in observed.cut(begin, end, hints)]
    rested = [all(map(is_nil, read)) for _, _, read in parts]
    for (a, b, read), rests_now, rests_next in zip(parts, rested, rested[1:] + [False]):
        until = length(story, a, b)
        holds = [i for i, (low, high) in enumerate(pairs) if not story.is_later(at(low), a) and not story.is_later(b, at(high))]
        if passed is None and is_nil(read[0]):
            rests.append([a, a])
        may_begin_at_zero, passed, steps = bool(rests) and rests[-1][1] == a, b, short(story.between(b, a) / story.step)
        if rests_now:
            need(not holds, "where one zero is claimed it is zero all of the time")
            rests += [] if may_begin_at_zero else [[a, a]]
            rests[-1][1] = b
        elif rests_next and begins_in(story, a, b, claims[len(rests)][0] if len(rests) < len(claims) else None):
            need(not holds, "a zero is where a rest begins")
        elif holds:
            way = sign(horner(derivative(read), span(NIL, until)))
            decided(way in (1, -1), "it may turn round where one zero is claimed")
            own, (low, high) = holds[0], pairs[holds[0]]
            if a == at(low):
                decided(sign(read[0]) == -way, "it may not pass through zero where that is claimed")
                rising[own] = way
            # Something arrives in between: what never jumps has one zero if it goes one way all of the time.
            need(rising.get(own) == way and (a == at(low) or observed.never_jumps()), "an interval of a zero is cut by an arrival")
            if b == at(high):
                decided(sign(horner(read, steps)) == way, "it may not pass through zero where that is claimed")
                found.add(own)
        else:
            while may_begin_at_zero and is_nil(read[0]):
                read = read[1:]
            way = sign(read[0])
            decided(way in (1, -1) and (rests_next or sign(horner(read, steps)) == way), "there may be another zero at an arrival")
            decided(stays_positive(times(way, read), NIL, until), "there may be another zero")
    need(len(found) == len(pairs), "a zero is missing")
    need(len(rests) == len(claims), "there are more or fewer rests")
    for rest, (early, late) in zip(rests, claims):
        for time, (low, high) in zip(rest, (early, late)):
            when = exact_or_ball(story, time)
            need(sign(when - low) in (0, 1) and sign(high - when) in (0, 1), "a rest begins or ends at another time")

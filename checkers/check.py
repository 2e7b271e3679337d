#!/usr/bin/env python3
"""Checks certificates of wavestep with nothing but the standard library; docs/certificates.md says what is claimed.

exact.py, beside this file, adds, multiplies and compares; what is proven here, and why, reads from top to bottom.
"""

import json
import math
import re
import sys
from fractions import Fraction

from exact import LATEST, MINUS, ONE, ROOTS, Wrong, accumulate, add, decimal, frozen, is_count, is_zero, key_of, less, need, number
from exact import number_at, on_period, plus, power, printable, put, rational, read, read_form, read_function, sign, sign_on, slope, times, whole
from motion import check_events, check_reading

# What Python raises where a certificate is not laid out as it should be.
MALFORMED = (LookupError, TypeError, ValueError, ArithmeticError, AttributeError, RecursionError, MemoryError)

# From the drawing of a line to its laws.


def periods(rows, cert):
    """How many periods a time is; the far end of an endless bar has none."""
    if rows is None:
        return None
    values, time, period = {}, read_function(rows), read_function(cert["period"])
    count = number_at({(): time}, values) / number_at({(): period}, values)
    need(is_zero({(): add(add({}, time), period, {(): {(): -count}})}), "a time is no multiple of the period")
    need(abs(count) <= LATEST, "a time is too late")
    return count


def laws(cert):
    """What is zero on each period and what is continuous from 0 on, by the laws of the elements: those of runs, which move
    as one, between links, bars and springs, which pass a force on. A place has a clock, ahead by so many periods."""
    line, t, ends = cert["line"], cert["time"], ("free", "fixed", "endless")
    is_end = [element["is"] in ends for element in line]
    need(is_end == [True] + [False] * (len(line) - 2) + [True], "a line has two ends")
    runs, links, clocks = [[]], [], [line[0]["clock"]]
    for element in line:
        if element["is"] in ("bar", "spring"):
            links.append(element)
            clocks.append(element["clock"] if element["is"] == "bar" else clocks[-1])
            runs.append([])
        else:
            need(element["is"] in ends + ("mass", "support", "force", "velocity", "motion"), "an unknown element")
            runs[-1].append(element)
    clocks = [periods(clock, cert) for clock in clocks]

    def own(run, *kinds):
        return [element for element in runs[run] if element["is"] in kinds]

    def of(element, key):
        return {(): read_function(element[key])}

    def wave(name, lag=0):
        return {(name, "value", lag): {(): ONE}}

    def acting(function, lag):
        return {(None, "forcing", lag): function}

    def load(element, run):
        """The course of a load from its beginning to its end."""
        total, course = {}, read(element["course"])
        is_late = element["until"] is None or periods(element["from"], cert) < periods(element["until"], cert)
        need(is_late, "a load ends before it begins")
        for key, factor in (("from", {(): ONE}), ("until", MINUS)):
            if element[key] is not None:
                later = put(course, t, add({(): {((t, 1),): 1}}, read_function(element[key])))
                total = plus(total, times(factor, acting(later, clocks[run] + periods(element[key], cert))))
        return total

    def bar(link, run):
        """Velocity V + f + g and compressive force X + Z (f - g) of a bar at its left end (run = link) or its right one; a
        wave enters at each end that is not endless, and takes the travel time to the other one."""
        element, here, there = links[link], clocks[run], clocks[link + (run == link)]
        for way, end in (("right", link), ("left", link + 1)):
            need((element[way] is None) == bool(own(end, "endless")), "a bar lacks a wave, or has one from nowhere")
        travel = periods(element["travel"], cert)
        need(travel is None or travel > 0, "a bar without length")
        late = lambda way: wave(element[way], travel + here - there) if element[way] else {}
        now = lambda way: wave(element[way]) if element[way] else {}
        f, g = (now("right"), late("left")) if run == link else (late("right"), now("left"))
        velocity = plus(acting(of(element, "velocity"), here), f, g)
        return velocity, plus(acting(of(element, "force"), here), times(of(element, "impedance"), less(f, g)))

    def velocities(run):
        """All that is known of the velocity of a run."""
        found = [load(element, run) for element in own(run, "velocity")] + [{} for _ in own(run, "fixed")]
        found += [bar(link, run)[0] for link in (run - 1, run) if 0 <= link < len(links) and links[link]["is"] == "bar"]
        found += [plus(wave(element["wave"]), acting(of(element, "from"), clocks[run])) for element in own(run, "motion")]
        need(found, "a velocity is missing")
        return found

    def closing(link):
        return less(velocities(link)[0], velocities(link + 1)[0])

    def force(link, run):
        """The compressive force in a link; in a spring k a + d a'."""
        if not 0 <= link < len(links):
            return {}
        spring = links[link]
        if spring["is"] == "bar":
            return bar(link, run)[1]
        return plus(times(of(spring, "stiffness"), wave(spring["wave"])), times(of(spring, "damping"), closing(link)))

    def slope_of(velocity):
        steep = lambda kind, c: ("forcing", slope(c, t)) if kind == "forcing" else ("slope", c)
        return {(name, steep(kind, c)[0], lag): steep(kind, c)[1] for (name, kind, lag), c in velocity.items()}

    equations, starts = [], []
    stored = [(link, closing(i)) for i, link in enumerate(links) if link["is"] == "spring"]
    for run in range(len(runs)):
        if own(run, "endless"):
            need(len(runs[run]) == 1, "an endless line ends with a bar")
            continue
        first, *others = velocities(run)
        equations += [less(first, other) for other in others]
        stored += [(support, first) for support in own(run, "support")]
        if own(run, "fixed", "velocity"):
            continue
        balance = plus(less(force(run - 1, run), force(run, run)), *(load(element, run) for element in own(run, "force")))
        for mass in own(run, "mass"):
            balance = less(balance, times(of(mass, "mass"), slope_of(first)))
        for support in own(run, "support"):
            pushes = times(of(support, "stiffness"), wave(support["wave"]))
            balance = less(balance, plus(pushes, times(of(support, "damping"), first)))
        equations.append(balance)
        gained = lambda mass: times(of(mass, "mass"), less(first, acting(of(mass, "velocity"), clocks[run])))
        starts += [plus(*map(gained, own(run, "mass")))] if own(run, "mass") else []  # masses that start together share it
    for element, rate in stored:  # what springs are shortened by, and supports displaced
        need(element["wave"] is not None or is_zero(of(element, "stiffness")), "a spring has no compression")
        if element["wave"] is not None:
            equations.append(less(slope_of(wave(element["wave"])), rate))
            starts.append(wave(element["wave"]))
    return [whole(form) for form in equations], [(whole(form), {}) for form in starts]


# The pieces satisfy the laws, and nothing else does.


def rank(rows):
    rows, found = [row[:] for row in rows], 0
    for column in range(len(rows[0]) if rows else 0):
        pivot = next((row for row in rows[found:] if row[column]), None)
        if pivot is None:
            continue
        rows.remove(pivot)
        rows.insert(found, pivot)
        found += 1
        for row in rows[found:]:
            share = row[column] / pivot[column]
            row[:] = [a - share * b for a, b in zip(row, pivot)]
    return found


def check_determined(equations, continuity, waves):
    """No other functions satisfy the statement: what has no derivatives on the period itself, differentiated, and the
    other equations determine all derivatives there; with what is continuous, all values at its start."""
    values = {}

    def row(form, kind):
        return [number_at(form.get((wave, kind, 0), {}), values) for wave in waves]

    slopes = [row(equation, "slope") for equation in equations]
    levels = [row(equation, "value") for equation in equations]
    plain = [level for level, slope_ in zip(levels, slopes) if not any(slope_)]
    starts = [row(form, "value") for form, _ in continuity]
    need(rank([r for r in slopes if any(r)] + plain) == len(waves), "the equations leave derivatives open")
    need(rank(starts + plain) == len(waves), "what is continuous leaves values open")


def statement(cert):
    """Forms that are zero on each period, and continuous ones with their starts: as stated, or as the drawing has them."""
    if "line" in cert:
        return laws(cert)
    return list(map(read_form, cert["equations"])), [(read_form(law), read(law["start"])) for law in cert["continuity"]]


def holds(rows, *symbols):
    """Whether a symbol stands anywhere in what is written of polynomials."""
    if isinstance(rows, dict):
        return any(symbol in rows for symbol in symbols)
    return isinstance(rows, list) and any(holds(row, *symbols) for row in rows)


def check_symbols(cert):
    """Times, waves and roots have names apart, periods are positive, and nothing depends on a time where it must not."""
    local, time, waves = cert["local"], cert["time"], cert["waves"]
    need(all(type(name) is str and name for name in [local, time, *waves]) and local != time, "names of times or waves")
    need(not ROOTS.keys() & {local, time, *waves}, "a time or a wave is no root")
    # Claims hold where the period is positive; a number is, and any other period for some positive numbers if not all is less.
    period = read_function(cert["period"])
    tops = [c for top in period.values() for c in top.values()]
    factors = [c for below in period for factor, _ in below for _, c in factor]
    is_number = all(not m for top in period.values() for m in top) and all(not m for below in period for f, _ in below for m, _ in f)
    is_positive = number_at({(): period}, {}) > 0 if is_number else any(c > 0 for c in tops) or any(c < 0 for c in factors)
    need(is_positive and not holds(cert["period"], *ROOTS), "a period is not positive")
    forms = [] if "line" in cert else cert["equations"] + cert["continuity"]
    elements = cert.get("line", [])
    fixed = [cert["period"]] + [element[key] for element in elements for key in element if key != "course"]
    fixed += [c for form in forms for *_, c in form["waves"]] + [form["start"] for form in forms if "start" in form]
    of_time = [element["course"] for element in elements if "course" in element] + [function for form in forms for _, function in form["forcing"]]
    if "observed" in cert:
        fixed += [c for *_, c in cert["observed"]["waves"]]
        of_time.append(cert["observed"]["forcing"])
    general = list(cert.get("general", {}).values())
    fixed += [own[key] for own in general for key in own if key != "first"]
    of_local = list(cert.get("pieces", {}).values()) + [own["first"] for own in general]
    need(not holds(fixed, local, time), "a number depends on time")
    need(not holds(of_time, local) and not holds(of_local, time), "a function depends on another time")


def check_statement(cert):
    """The laws, which are as many as waves and have one solution."""
    check_symbols(cert)
    equations, continuity = statement(cert)
    need(len(equations) == len(cert["waves"]) == len(set(cert["waves"])), "waves and equations")
    check_determined(equations, continuity, cert["waves"])
    return equations, continuity


def check_periods(cert, equations, continuity, pieces):
    """Every equation holds on every period; what is continuous is, and starts as stated."""
    zero, end = {(): {(): 0}}, read_function(cert["period"])
    for n in range(min(map(len, pieces.values()))):
        for i, equation in enumerate(equations):
            need(is_zero(on_period(equation, pieces, n, cert)), f"equation {i} on period {n}")
        for i, (form, start) in enumerate(continuity):
            begin = put(on_period(form, pieces, n, cert), cert["local"], zero)
            before = put(on_period(form, pieces, n - 1, cert), cert["local"], end) if n else start
            accumulate(begin, before, MINUS)
            need(is_zero(begin), f"continuity {i} at the start of period {n}")


def check_pieces(cert):
    """The pieces satisfy the laws, and nothing else does so."""
    pieces = {wave: [read(piece) for piece in all_] for wave, all_ in cert["pieces"].items()}
    need(set(pieces) == set(cert["waves"]), "waves and pieces")
    need(is_count(cert["through"], LATEST), "a period is no number, or too late")
    need(all(len(all_) == cert["through"] + 1 for all_ in pieces.values()), "pieces are missing")
    check_periods(cert, *check_statement(cert), pieces)
    return pieces


# Formulas for every n: the first ones satisfy the laws, and from some n on all do, by one identity.


def check_general(cert):
    equations, continuity = check_statement(cert)
    equations = list(map(without_sums, equations))
    forms, laws_ = cert["general"], equations + [form for form, _ in continuity]
    keys = [key for form in laws_ for key in form]
    need(set(forms) == set(cert["waves"]) and '"#' not in json.dumps(cert), "waves, formulas, or names of symbols")
    need(all(is_free(c, cert) for form in laws_ for (_, kind, _), c in form.items() if kind != "forcing"), "a coefficient")
    kinds = {kind for form, _ in continuity for _, kind, _ in form}
    need(kinds <= {"value", "forcing"}, "a sum or a slope that is continuous")
    latest = max(lag for _, _, lag in keys)
    if all("rate" in own for own in forms.values()):
        check_echoes(cert, equations, continuity, latest)
    else:
        check_sequences(cert, equations, continuity, latest)


def without_sums(form):
    """With sums over all earlier periods: less the same form one period before, which holds as well."""
    if all(kind != "sum" for _, kind, _ in form):
        return form
    total = {}
    for (wave, kind, lag), c in form.items():
        parts = ({(wave, "value", lag + 1): c},) if kind == "sum" else ({(wave, kind, lag): c}, times(MINUS, {(wave, kind, lag + 1): c}))
        total = plus(total, *parts)
    return total


def is_free(expression, cert):
    return all(is_zero(slope(expression, cert[time])) for time in ("local", "time"))


def check_sequences(cert, equations, continuity, latest):
    """Waves that are constant on each period: sums of c n^j r^n. Each r^n is as good as a symbol of its own."""
    need(not continuity and all(kind != "slope" for form in equations for _, kind, _ in form), "derivatives of sequences")
    forms = {wave: [(read(c), j, read(ratio)) for c, j, ratio in own["terms"]] for wave, own in cert["general"].items()}
    begins = latest + max(len(own["first"]) for own in cert["general"].values()) + 1

    def value(wave, n):
        first, total = cert["general"][wave]["first"], {}
        if n < len(first):
            return read(first[n])
        for c, j, ratio in forms[wave]:
            accumulate(total, c, power(ratio, n, {(): {(): {(): Fraction(n) ** j}}}))
        return total

    need(all(is_free(part, cert) for own in forms.values() for c, _, ratio in own for part in (c, ratio)), "a sequence")
    need(all(is_count(j) for own in forms.values() for _, j, _ in own), "a power is no integer, or too large")
    pieces = {wave: [value(wave, n) for n in range(begins)] for wave in forms}
    check_periods(cert, equations, continuity, pieces)
    for i, equation in enumerate(equations):
        sums = {}  # by ratios, times their powers n - latest
        for (wave, kind, lag), coefficient in equation.items():
            if kind == "forcing":
                need(is_free(coefficient, cert), "a load that changes")
                accumulate(sums.setdefault(key_of({(): ONE}), {}), coefficient)
                continue
            for c, j, ratio in forms[wave]:
                before = {(): {(): {(("#n", 1),): 1, (): Fraction(-lag)}}}
                factor = power(ratio, latest - lag, power(before, j, c))
                accumulate(sums.setdefault(key_of(ratio), {}), coefficient, factor)
        need(all(map(is_zero, sums.values())), f"equation {i} for every n")


def check_echoes(cert, equations, continuity, latest):
    """Waves are sums of echoes, w(t) = sum of e_k(t - k D), so laws hold for each delay k D; from some k on, with T_k Laguerre's
    polynomials L_k(c x) or x^k/k!,  e_k(x) = r^k exp(-b x) (sum of c_i T_(k-i)(x)).  Laplace's transform of exp(-b x) T_k(x) is
    v^k/u^(k+1) with u = p + b, and v = u - c or 1; that of a slope is p times that of the function, less its value at 0."""
    s, forms, functions = cert["local"], cert["general"], {(): ONE}
    need(all(is_count(i) for own in forms.values() for i, _ in own["terms"]), "an echo is no number, or too late")
    begins = 2 + latest + max(max([len(own["first"])] + [i for i, _ in own["terms"]]) for own in forms.values())
    some = next(iter(forms.values()))
    same = ("rate", "ratio", "laguerre")
    need(all([own[key] for key in same] == [some[key] for key in same] for own in forms.values()), "different echoes")
    b, r = ({(): read_function(some[key])} for key in ("rate", "ratio"))
    c = None if some["laguerre"] is None else {(): read_function(some["laguerre"])}
    need(c is None or not is_zero(c), "Laguerre's polynomials of nothing")
    symbol = lambda name: {(): {(): {((name, 1),): 1}}}
    terms = {wave: [(i, {(): read_function(own_c)}) for i, own_c in own["terms"]] for wave, own in forms.items()}
    need(all(is_free(part, cert) for part in [b, r, c or b] + [c_ for own in terms.values() for _, c_ in own]), "an echo")

    def basic(k):
        """T_k(x)."""
        need(k >= 0, "an echo before the first one")
        if not c:
            return power(symbol(s), k, {(): {(): {(): Fraction(1, math.factorial(k))}}})
        total, minus = {}, accumulate({}, accumulate({}, c, MINUS), symbol(s))
        for j in range(k + 1):
            accumulate(total, power(minus, j, {(): {(): {(): Fraction(math.comb(k, j), math.factorial(j))}}}))
        return total

    def echo(wave, k):
        if k < len(forms[wave]["first"]):
            return read(forms[wave]["first"][k])
        total = {}
        for i, c_i in terms[wave]:
            accumulate(total, basic(k - i), c_i)
        decay = {frozen(accumulate({}, accumulate({}, b, MINUS), symbol(s))[()]): functions[()]}
        return power(r, k, accumulate({}, total, decay))

    def late(form, k):
        """What a form has of the delay k D."""
        total = {}
        for (wave, kind, lag), coefficient in form.items():
            if kind == "forcing" and lag == k:
                accumulate(total, put(coefficient, cert["time"], symbol(s)[()]))
            elif kind != "forcing" and lag <= k:
                known = echo(wave, k - lag)
                accumulate(total, slope(known, s) if kind == "slope" else known, coefficient)
        return total

    for k in range(begins):
        need(all(is_zero(late(equation, k)) for equation in equations), f"an equation for echo {k}")
        for form, start in continuity:
            value = put(late(form, k), s, {(): {(): 0}})
            need(is_zero(accumulate(value, {} if k else start, MINUS)), f"continuity of echo {k}")

    p = symbol("#p")
    u = accumulate(accumulate({}, p), b)
    v = accumulate(accumulate({}, u), c, MINUS) if c else functions
    orders = [lag + i for form in equations for wave, kind, lag in form if wave for i, _ in terms[wave]]
    for form, kinds in [(equation, ("slope",)) for equation in equations] + [(form, ("value",)) for form, _ in continuity]:
        transform, start = {}, {}  # over r^(k - latest) (v/u)^k and over r^(k - latest)
        for (wave, kind, lag), coefficient in form.items():
            for i, c_i in terms.get(wave, ()):
                j, own = lag + i, power(r, latest - lag, accumulate({}, coefficient, c_i))
                whole_ = power(v, max(orders) - j, power(u, j - min(orders), own))
                accumulate(transform, whole_, p if kind == "slope" else functions)
                accumulate(start, own if kind in kinds and c else {})
        need(kinds == ("value",) or is_zero(transform), "an equation for all later echoes")
        need(is_zero(start), "the values with which all later echoes begin")


# What a quantity is between arrivals, and what follows.


def check_scenes(cert):
    """The scene with its pieces, and the one that is subtracted, if any: it has the same time."""
    scenes = [(cert, check_pieces(cert))]
    if "minus" in cert:
        need(all(cert["minus"][time] == cert[time] for time in ("time", "local")), "the times have different names")
        need("minus" not in cert["minus"], "a third scene")
        scenes.append((cert["minus"], check_pieces(cert["minus"])))
    return scenes


def seen(scenes, begin):
    """A quantity as an expression in scene time, from a time on, less that of a second scene, and when a next piece begins."""
    (cert, pieces), *others = scenes
    period, t, total, end = number(read_function(cert["period"])).get((), 0), cert["time"], {}, None
    need(begin >= 0, "the time is before the start")
    for wave, kind, delay, coefficient in cert["observed"]["waves"]:
        need(wave in pieces and kind in ("value", "slope"), f"unknown wave {wave} or operator {kind}")
        n = (begin - rational(delay)) // period
        end = min(filter(None, (end, rational(delay) + (max(n, -1) + 1) * period)))
        if n >= 0:
            need(n < len(pieces[wave]), "a period is missing")
            piece = slope(pieces[wave][n], cert["local"]) if kind == "slope" else pieces[wave][n]
            local = add({(): {((t, 1),): 1}}, {(): {(): -rational(delay) - n * period}})
            accumulate(total, put(piece, cert["local"], local), read(coefficient))
    accumulate(total, read(cert["observed"]["forcing"]))
    if others:
        less_, next_ = seen(others, begin)
        accumulate(total, less_, MINUS)
        end = min(filter(None, (end, next_)), default=None)
    for symbol in (symbol for symbol, square in ROOTS.items() if square == -1):  # the conjugate is the same
        need(is_zero(accumulate(put(total, symbol, {(): {((symbol, 1),): -1}}), total, MINUS)), "the quantity is not real")
    return total, end


def lifted(expression, by):
    return accumulate(accumulate({}, expression), {(): {(): {(): by}}})


def cells(cert, scenes, level):
    """Intervals without gaps from the first time of the window to the last, each with the quantity less a level and a
    derivative that has one sign there. That of order 0 is the quantity itself; with that of order 1, or of order k where
    those of orders 1 ... k - 1 are zero at one end, the quantity is strictly monotone; without one it is the level."""
    t, time = cert["time"], rational(cert["from"])
    need(time < rational(cert["to"]), "the window is empty")
    for begin, end, order in cert["cells"]:
        begin, end = rational(begin), rational(end)
        need(begin == time and begin < end, "the intervals have gaps")
        expression, next_ = seen(scenes, begin)
        need(next_ is None or end <= next_, "a wave arrives within an interval")
        expression = lifted(expression, -level)
        if order is None:
            need(is_zero(expression), "the quantity is not constant")
            yield begin, end, expression, order, 0
        else:
            need(type(order) is int and 0 <= order <= 64, "an order is no number")
            derivatives = [expression]
            for _ in range(order):
                derivatives.append(slope(derivatives[-1], t))
            flat = lambda at: all(sign(derivative, t, at) == 0 for derivative in derivatives[1:-1])
            need(flat(begin) or flat(end), "the derivatives between do not vanish")
            yield begin, end, expression, order, sign_on(derivatives[-1], t, begin, end)
        time = end
    need(time == rational(cert["to"]), "the intervals end early or late")


def check_value(cert):
    """The decimal is the value, correctly rounded."""
    time, (claim, slack) = rational(cert["at"]), decimal(cert)
    expression, _ = seen(check_scenes(cert), time)
    need(sign(lifted(expression, slack - claim), cert["time"], time) >= 0, "the value is another one: smaller")
    need(sign(lifted(expression, -slack - claim), cert["time"], time) <= 0, "the value is another one: larger")


def evenly_spaced(begin, end, count):
    need(is_count(count) and count > 0 and begin <= end, "no times, or they run backwards")
    return [begin + (end - begin) * i / max(count - 1, 1) for i in range(count)]


def check_doubles(cert):
    """Each value, one at each of evenly spaced times, is off by its bound at most."""
    scenes, t, times_ = check_scenes(cert), cert["time"], evenly_spaced(*map(rational, (cert["from"], cert["to"])), cert["points"])
    need(len(times_) == len(cert["values"]), "a value is missing, or there is one too many")
    for time, (value, off) in zip(times_, ([rational(own) for own in row] for row in cert["values"])):
        expression, _ = seen(scenes, time)
        is_near = sign(lifted(expression, off - value), t, time) >= 0 >= sign(lifted(expression, -off - value), t, time)
        need(is_near, f"the value at {time} is another one")


def check_roots(cert):
    """Zeros, also of limits where waves arrive, are where monotone parts change sign, or at ends of intervals."""
    t, found = cert["time"], []
    for begin, end, expression, order, _ in cells(cert, check_scenes(cert), Fraction(0)):
        if order is None:
            zeros = [(begin, end)]
        elif order == 0:
            continue
        else:
            zeros = [(at, at) for at in (begin, end) if sign(expression, t, at) == 0]
            if sign(expression, t, begin) * sign(expression, t, end) < 0:
                found.append((begin, end, expression))
        for first, last in zeros:
            joins = found and found[-1][2] is None and found[-1][1] == first
            found.append((found.pop()[0] if joins else first, last, None))
    claims = [tuple(map(rational, claim)) for claim in cert["zeros"]]
    need(len(claims) == len(found), f"{len(found)} zeros instead of {len(claims)}")
    need(all(a[1] < b[0] for a, b in zip(claims, claims[1:])), "two zeros are in one place")
    for (low, high), (begin, end, expression) in zip(claims, found):
        if expression is None:
            need((low, high) == (begin, end) if begin < end else low <= begin <= high, f"the zero at {begin} is not told")
        else:
            low, high = max(low, begin), min(high, end)
            need(low < high and sign(expression, t, low) * sign(expression, t, high) < 0, f"the zero after {begin} is not told")


def check_extremum(cert):
    """Nothing is beyond the rounded value by more than half a unit of its last place, and something comes as near to it. A
    distance is the larger of the largest value and of the negative of the smallest."""
    ways = {"largest": [1], "smallest": [-1], "distance": [1, -1]}[cert["goal"]]
    (claim, slack), t, (place, time), scenes, is_taken = decimal(cert), cert["time"], cert["attained"], check_scenes(cert), False
    for way in ways:
        bound = (way * claim if len(ways) > 1 else claim) + way * slack
        for i, (begin, end, expression, order, sign_) in enumerate(cells(cert, scenes, bound)):
            signs = [sign_] if order in (None, 0) else [sign(expression, t, at) for at in (begin, end)]
            need(all(sign_ * way <= 0 for sign_ in signs), f"a value between {begin} and {end} is beyond the extremum")
            if i == place and begin <= rational(time) <= end:
                is_taken |= sign(lifted(expression, 2 * way * slack), t, rational(time)) * way >= 0
    need(is_taken, "the extremum is not taken where it is said")


def read_square(text):
    """What is below a root: -1 or a prime. Roots of different ones are independent."""
    need(re.fullmatch("-1|[1-9][0-9]{0,11}", text), "what is below a root is neither -1 nor a prime")
    square = int(text)
    is_prime = square == -1 or square > 1 and all(square % divisor for divisor in range(2, math.isqrt(square) + 1))
    need(is_prime, "what is below a root is neither -1 nor a prime")
    return Fraction(square)


def read_roots(cert):
    need(type(cert["wavestep_certificate"]) is int and cert["wavestep_certificate"] == 1, "a certificate of another version")
    ROOTS.clear()
    ROOTS.update({symbol: read_square(square) for symbol, square in cert["roots"].items()})
    need(len(set(ROOTS.values())) == len(ROOTS) <= 16, "two roots of one number, or too many")


def check(cert):
    read_roots(cert)
    kinds = {"pieces": check_pieces, "general": check_general, "value": check_value, "doubles": check_doubles}
    kinds |= {"roots": check_roots, "extremum": check_extremum, "events": check_events, "reading": check_reading}
    need(type(cert["title"]) is str and cert["title"].encode(), "a title is missing")
    need(cert["kind"] in kinds, f"unknown kind {json.dumps(cert['kind'])}")
    need("minus" not in cert or "observed" in cert["minus"] and cert["kind"] not in ("pieces", "general"), "a second scene for nothing")
    kinds[cert["kind"]](cert)


def one_each(pairs):
    """An object, no key of which stands twice."""
    if len(dict(pairs)) < len(pairs):
        raise ValueError("a key stands twice")
    return dict(pairs)


def short(text):
    if len(text) > 12:
        raise ValueError("a number is too long")
    return int(text)


def no_number(text):
    raise ValueError(f"{text[:40]} is neither a text nor an integer")


def verdict(name):
    """What is told of a file, on one line, and whether it is proven."""
    proven, told = judged(name)
    return proven, printable(f"{name}: {told}")


def load(name):
    with open(name, encoding="utf-8") as file:
        ways = {"object_pairs_hook": one_each, "parse_int": short, "parse_float": no_number, "parse_constant": no_number}
        return json.load(file, **ways)


def judged(name):
    try:
        certificate = load(name)
    except (OSError, ValueError, RecursionError) as error:
        return False, f"cannot be read: {error}"
    try:
        check(certificate)
    except Wrong as error:
        return False, f"NOT proven: {error}"
    except MALFORMED as error:
        return False, f"NOT proven: it is not laid out as it should be: {error!r}"
    return True, f"proven ({certificate['kind']} of {json.dumps(certificate['title'], ensure_ascii=False)})"


if __name__ == "__main__":
    if not sys.argv[1:] or sys.argv[1].startswith("-"):
        print(f"usage: {sys.argv[0]} CERTIFICATE.json ...", file=sys.stderr)
        sys.exit(2)
    sys.set_int_max_str_digits(0)  # numbers have bounds of their own
    sys.stdout.reconfigure(errors="backslashreplace")
    verdicts = [verdict(name) for name in sys.argv[1:]]
    print("\n".join(told for _, told in verdicts))
    sys.exit(not all(proven for proven, _ in verdicts))

#!/usr/bin/env python3
"""Checks certificates of wavestep with nothing but the standard library; docs/certificates.md says what is claimed.

A polynomial is a dict from monomials, sorted tuples of (symbol, power), to rational numbers; a rational function is a
dict from denominators, sorted tuples of (factor, power), to polynomials; an expression is a dict from exponents X, each a
rational function, to rational functions R: the sum of all R exp(X).
"""

import json
import math
import random
import sys
from fractions import Fraction

ROOTS = {}  # symbols that stand for square roots, with what is below these
ONE = {(): {(): 1}}
MINUS = {(): {(): {(): -1}}}  # the expression -1


class Wrong(Exception):
    """What a certificate claims does not follow."""


def need(claim, told):
    if not claim:
        raise Wrong(told)


def product(a, b):
    """Two monomials: the product, and the rational number that squares of roots leave."""
    if not a or not b:
        return a or b, 1
    powers, left = dict(a), 1
    for symbol, power in b:
        powers[symbol] = powers.get(symbol, 0) + power
    for symbol in ROOTS.keys() & powers.keys():
        left *= ROOTS[symbol] ** (powers[symbol] // 2)
        powers[symbol] %= 2
    return tuple(sorted((s, p) for s, p in powers.items() if p)), left


def frozen(function):
    """A rational function as a key."""
    return tuple(sorted((below, tuple(sorted(top.items()))) for below, top in function.items() if top))


def thawed(key):
    return {below: dict(top) for below, top in key}


def add(total, function, factor=None):
    """Adds a rational function, times a factor, to another one."""
    for below, top in function.items():
        for other, more in (ONE if factor is None else factor).items():
            both = product(below, other)[0] if below and other else below or other
            sum_ = total.setdefault(both, {})
            for m, c in top.items():
                for n, d in more.items():
                    key, left = product(m, n)
                    value = sum_.get(key, 0) + c * d * left
                    if value:
                        sum_[key] = value
                    else:
                        sum_.pop(key, None)
    return total


def accumulate(total, expression, factor=None):
    """The same with expressions."""
    for exponent, function in expression.items():
        for other, more in ({(): ONE} if factor is None else factor).items():
            both = frozen(add(thawed(exponent), thawed(other))) if exponent and other else exponent or other
            add(total.setdefault(both, {}), function, more)
    return total


def is_zero(expression):
    """Whether each rational function is zero: over one denominator its numerators cancel."""
    for function in expression.values():
        powers = {}
        for below in function:
            for factor, power in below:
                powers[factor] = max(power, powers.get(factor, 0))
        total = {}
        for below, top in function.items():
            lacking = ONE
            for factor, power in powers.items():
                for _ in range(power - dict(below).get(factor, 0)):
                    lacking = add({}, {(): dict(factor)}, lacking)
            add(total, {(): top}, lacking)
        if any(total.values()):
            return False
    return True


def terms(function, s):
    """Denominator, monomial, coefficient and power of the time, which stands above alone, of each term."""
    for below, top in function.items():
        need(all(s not in dict(m) for factor, _ in below for m, _ in factor), "a divisor holds the time")
        for m, c in top.items():
            yield below, m, c, dict(m).get(s, 0)


def slope(expression, s):
    """The derivative with respect to a symbol: (R' + X' R) exp(X)."""

    def of(function):
        result = {}
        for below, m, c, power in terms(function, s):
            if power:
                rest = tuple((t, p - (t == s)) for t, p in m if t != s or p > 1)
                add(result, {below: {rest: c * power}})
        return result

    return {x: add(of(r), r, of(thawed(x))) for x, r in expression.items()}


def put(expression, s, value):
    """With a rational function in place of a symbol."""
    powers = [ONE]

    def of(function):
        result = {}
        for below, m, c, power in terms(function, s):
            while len(powers) <= power:
                powers.append(add({}, powers[-1], value))
            add(result, {below: {tuple(pair for pair in m if pair[0] != s): c}}, powers[power])
        return result

    result = {}
    for exponent, function in expression.items():
        add(result.setdefault(frozen(of(thawed(exponent))), {}), of(function))
    return result


def read_polynomial(terms):
    polynomial = {}
    for coefficient, powers in terms:
        need(all(type(p) is int and p > 0 for p in powers.values()), "a power is no positive integer")
        monomial = tuple(sorted(powers.items()))
        need(monomial not in polynomial and Fraction(coefficient), "a term stands twice, or is zero")
        polynomial[monomial] = Fraction(coefficient)
    return polynomial


def read_function(rows):
    function = {}
    for top, below in rows:
        key = ()
        for factor, power in below:
            need(factor and type(power) is int and power > 0, "a divisor is zero")
            key, _ = product(key, ((tuple(sorted(read_polynomial(factor).items())), power),))
        add(function, {key: read_polynomial(top)})
    return function


def read(rows):
    expression = {}
    for exponent, function in rows:
        add(expression.setdefault(frozen(read_function(exponent)), {}), read_function(function))
    return expression


# Linear forms in the waves: dicts from (wave, operator, lag) to coefficients; forcing has no wave and a function instead.


def read_form(rows):
    parts = [((wave, kind, lag), c) for wave, kind, lag, c in rows["waves"]]
    total = {}
    for key, rows_ in parts + [((None, "forcing", lag), function) for lag, function in rows["forcing"]]:
        accumulate(total.setdefault(key, {}), read(rows_))
    return total


def plus(*parts):
    """The sum of forms, each times an expression."""
    total = {}
    for factor, form in parts:
        for key, coefficient in form.items():
            accumulate(total.setdefault(key, {}), coefficient, factor)
    return total


def on_period(form, pieces, n, cert):
    """The value on the n-th period, in local time; waves are zero before the first one."""
    s, total = cert["local"], {}
    for (wave, kind, lag), coefficient in form.items():
        need(kind in ("value", "slope", "sum", "forcing") and type(lag) is int and lag >= 0, f"unknown operator {kind} at {lag}")
        if kind == "forcing" and lag <= n:
            later = add({(): {((s, 1),): 1}}, read_function(cert["period"]), {(): {(): Fraction(n - lag)}})
            accumulate(total, put(coefficient, cert["time"], later))
        past = () if kind == "forcing" else range(n - lag) if kind == "sum" else [n - lag] if lag <= n else []
        for i in past:
            piece = pieces[wave][i]
            accumulate(total, slope(piece, s) if kind == "slope" else piece, coefficient)
    return total


def whole(form):
    """Without what cancels; what is left is later by whole periods."""
    left = {key: c for key, c in form.items() if not is_zero(c)}
    need(all(lag == int(lag) and lag >= 0 for _, _, lag in left), "a delay is no multiple of the period")
    return {(name, kind, int(lag)): c for (name, kind, lag), c in left.items()}


# From the drawing of a line to its laws.


def periods(rows, cert):
    """How many periods a time is; the far end of an endless bar has none."""
    if rows is None:
        return None
    values, time, period = {}, read_function(rows), read_function(cert["period"])
    count = number_at({(): time}, values) / number_at({(): period}, values)
    need(is_zero({(): add(add({}, time), period, {(): {(): -count}})}), "a time is no multiple of the period")
    return count


def laws(cert):
    """What is zero on each period and what is continuous from 0 on, by the laws of the elements: those of runs, which move
    as one, between links, which pass a force on: bars and springs."""
    one, minus, t = {(): ONE}, MINUS, cert["time"]
    runs, links, clocks = [[]], [], [cert["line"][0]["clock"]]
    for element in cert["line"]:
        if element["is"] in ("bar", "spring"):
            links.append(element)
            clocks.append(element["clock"] if element["is"] == "bar" else clocks[-1])
            runs.append([])
        else:
            runs[-1].append(element)
    clocks = [periods(clock, cert) for clock in clocks]
    of = lambda element, key: {(): read_function(element[key])}
    wave = lambda name, lag=0: {(name, "value", lag): one}
    acting = lambda function, lag: {(None, "forcing", lag): function}
    kinds = lambda run: [element["is"] for element in runs[run]]
    are_ends = [element["is"] in ("free", "fixed", "endless") for element in cert["line"]]
    need(are_ends == [True] + [False] * (len(are_ends) - 2) + [True], "a line has two ends")

    def load(element, run):
        """The course of a load from its beginning to its end, by the clock of its place."""
        total, course = {}, read(element["course"])
        for key, sign in (("from", one), ("until", minus)):
            if element[key] is not None:
                later = put(course, t, add({(): {((t, 1),): 1}}, read_function(element[key])))
                total = plus((one, total), (sign, acting(later, clocks[run] + periods(element[key], cert))))
        return total

    def bar(link, run):
        """Velocity V + f + g and compressive force X + Z (f - g) of a bar at its left end (run = link) or its right one."""
        element, here = links[link], clocks[run]
        travel = periods(element["travel"], cert)
        f, g = (wave(element[way]) if element[way] else {} for way in ("right", "left"))
        if run == link and g:
            g = wave(element["left"], travel + here - clocks[link + 1])
        if run > link and f:
            f = wave(element["right"], travel + here - clocks[link])
        difference = plus((one, f), (minus, g))
        velocity = plus((one, acting(of(element, "velocity"), here)), (one, f), (one, g))
        return velocity, plus((one, acting(of(element, "force"), here)), (of(element, "impedance"), difference))

    def velocities(run):
        found = [load(element, run) for element in runs[run] if element["is"] == "velocity"]
        found += [{}] * kinds(run).count("fixed")
        for link in (run - 1, run):
            if 0 <= link < len(links) and links[link]["is"] == "bar":
                found.append(bar(link, run)[0])
        for element in runs[run]:
            if element["is"] == "motion":
                found.append(plus((one, wave(element["wave"])), (one, acting(of(element, "from"), clocks[run]))))
        need(found, "a velocity is missing")
        return found

    def closing(link):
        return plus((one, velocities(link)[0]), (minus, velocities(link + 1)[0]))

    def force(link, run):
        """The compressive force in a link; in a spring k a + d a'."""
        if not 0 <= link < len(links):
            return {}
        if links[link]["is"] == "bar":
            return bar(link, run)[1]
        return plus((of(links[link], "damping"), closing(link)), (of(links[link], "stiffness"), wave(links[link]["wave"])))

    def slope_of(form):
        """Of a velocity."""
        steep = lambda kind, c: ("forcing", slope(c, t)) if kind == "forcing" else ("slope", c)
        return {(name, steep(kind, c)[0], lag): steep(kind, c)[1] for (name, kind, lag), c in form.items()}

    equations, starts = [], []
    for run, elements in enumerate(runs):
        if "endless" in kinds(run):
            need(len(elements) == 1 and run in (0, len(links)), "an endless line ends with a bar")
            continue
        first, *others = velocities(run)
        equations += [plus((one, first), (minus, other)) for other in others]
        balance, momentum, massive = plus((one, force(run - 1, run)), (minus, force(run, run))), {}, False
        for element in elements:
            if element["is"] == "mass":  # momenta add up where masses start together
                balance = plus((one, balance), (accumulate({}, of(element, "mass"), minus), slope_of(first)))
                start = acting(of(element, "velocity"), clocks[run])
                momentum = plus((one, momentum), (of(element, "mass"), plus((one, first), (minus, start))))
                massive = True
            elif element["is"] == "support":
                balance = plus((one, balance), (accumulate({}, of(element, "damping"), minus), first))
                if element["wave"]:
                    moved = wave(element["wave"])
                    balance = plus((one, balance), (accumulate({}, of(element, "stiffness"), minus), moved))
                    equations.append(plus((one, slope_of(moved)), (minus, first)))
                    starts.append(moved)
            elif element["is"] == "force":
                balance = plus((one, balance), (one, load(element, run)))
            else:
                need(element["is"] in ("free", "fixed", "velocity", "motion"), f"unknown element {element['is']}")
        if "fixed" not in kinds(run) and "velocity" not in kinds(run):
            equations.append(balance)
            starts += [momentum] if massive else []
    for link, element in enumerate(links):
        if element["is"] == "spring" and element["wave"]:
            shortened = wave(element["wave"])
            equations.append(plus((one, slope_of(shortened)), (minus, closing(link))))
            starts.append(shortened)
    return [whole(form) for form in equations], [(whole(form), {}) for form in starts]

def number_at(expression, values):
    """The value for pseudo-random numbers in place of symbols and of exponentials."""
    at = lambda key: values.setdefault(key, Fraction(random.randrange(1, 1 << 60)))
    of = lambda top: sum(c * math.prod(at(s) ** p for s, p in m) for m, c in top.items())
    total = Fraction(0)
    for exponent, function in expression.items():
        for below, top in function.items():
            need(not any(s in ROOTS for m in top for s, _ in m), "a root in an equation")
            divisor = math.prod(of(dict(factor)) ** power for factor, power in below)
            total += of(top) / divisor * (at(exponent) if exponent else 1)
    return total


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


def check_pieces(cert):
    """Every equation holds on every period; what is continuous is, and starts as stated; and nothing else does so."""
    equations, continuity = statement(cert)
    pieces = {wave: [read(piece) for piece in all_] for wave, all_ in cert["pieces"].items()}
    need(set(pieces) == set(cert["waves"]) and len(equations) == len(pieces), "waves and equations")
    check_determined(equations, continuity, cert["waves"])
    last = cert["through"] + 1
    need(all(len(all_) == last for all_ in pieces.values()), "pieces are missing")
    zero, end = {(): {(): 0}}, read_function(cert["period"])
    for n in range(last):
        for i, equation in enumerate(equations):
            need(is_zero(on_period(equation, pieces, n, cert)), f"equation {i} on period {n}")
        for i, (form, start) in enumerate(continuity):
            begin = put(on_period(form, pieces, n, cert), cert["local"], zero)
            before = put(on_period(form, pieces, n - 1, cert), cert["local"], end) if n else start
            accumulate(begin, before, MINUS)
            need(is_zero(begin), f"continuity {i} at the start of period {n}")
    return pieces


def exponential(x, bits):
    """Two rationals with e^x between them: the Taylor sum of x/2^k, squared k times."""
    unit, halvings = Fraction(1, 1 << bits), max(0, abs(x).__ceil__().bit_length() + 1)
    y = x / (1 << halvings)
    total = term = Fraction(1)
    i = 0
    while abs(term) > unit:
        i += 1
        term = Fraction(round(term * y / i / unit)) * unit
        total += term
    low, high = total - 2 * (i + 2) * unit, total + 2 * (i + 2) * unit
    for _ in range(halvings):
        low, high = (low * low // unit) * unit, -(-high * high // unit) * unit
    return low, high


def number(function):
    """A rational function without symbols."""
    tops = [top for top in function.values() if top]
    need(all(set(top) == {()} for top in tops) and all(not b for b, top in function.items() if top), "a symbol has no value")
    return sum((top[()] for top in tops), Fraction(0))


# Values between arrivals: sums of polynomials times exponentials of the time, with rational numbers.


def seen(cert, pieces, begin):
    """A quantity as an expression in scene time, from a time on, and when a next piece of a wave begins."""
    period, t, total, end = number(read_function(cert["period"])), cert["time"], {}, None
    need(begin >= 0, "the time is before the start")
    for wave, kind, delay, coefficient in cert["observed"]["waves"]:
        need(wave in pieces and kind in ("value", "slope"), f"unknown wave {wave} or operator {kind}")
        n = (begin - Fraction(delay)) // period
        end = min(filter(None, (end, Fraction(delay) + (max(n, -1) + 1) * period)))
        if n >= 0:
            need(n < len(pieces[wave]), "a period is missing")
            piece = slope(pieces[wave][n], cert["local"]) if kind == "slope" else pieces[wave][n]
            local = add({(): {((t, 1),): 1}}, {(): {(): -Fraction(delay) - n * period}})
            accumulate(total, put(piece, cert["local"], local), read(coefficient))
    return accumulate(total, read(cert["observed"]["forcing"])), end


def sign(expression, t, time):
    """The sign at a time. Exponentials of different rational numbers are linearly independent over rational numbers."""
    here = put(expression, t, {(): {(): time}})
    parts = [(number(thawed(x)), number(r)) for x, r in here.items()]
    for bits in (128, 512, 2048, 8192, 32768) if any(r for _, r in parts) else ():
        low = high = Fraction(0)
        for x, r in parts:
            a, b = sorted(r * e for e in exponential(x, bits))
            low, high = low + a, high + b
        if low > 0 or high < 0:
            return 1 if low > 0 else -1
    need(not any(r for _, r in parts), "a sign is not decided")
    return 0


def coefficients(function, t):
    """Those of a polynomial in the time, without other symbols."""
    powers = [Fraction(0)]
    for below, m, c, power in terms(function, t):
        need(not below and m in ((), ((t, power),)), "a symbol has no value")
        powers += [Fraction(0)] * (power + 1 - len(powers))
        powers[power] += c
    return powers


def taylor(exponent, function, t, m, h, bits):
    """Of R exp(X) at t = m + h u: the part of X without u, the coefficients of all powers of u in R exp of the rest of X, and
    a bound of what they leave out for |u| <= 1."""
    constant, rate = (coefficients(exponent, t) + [Fraction(0)])[:2]
    need(len(coefficients(exponent, t)) <= 2, "an exponent is not linear in the time")
    powers, x = coefficients(function, t), rate * h
    series, following = [Fraction(1)], abs(x)
    while following > Fraction(1, 1 << bits) or 2 * abs(x) > len(series) + 1:  # then what follows is halved each time
        series.append(series[-1] * x / len(series))
        following = abs(series[-1] * x / len(series))
    total = [Fraction(0)] * (len(series) + len(powers) - 1)
    rest = Fraction(0)
    for i in range(len(powers)):
        own = h**i * sum(c * math.comb(j, i) * m ** (j - i) for j, c in enumerate(powers) if j >= i)
        rest += abs(own) * 2 * following
        for k, factor in enumerate(series):
            total[i + k] += own * factor
    return constant + rate * m, total, rest


def sign_on(expression, t, begin, end):
    """The sign on an interval: a value differs from the coefficient of u^0 by the sizes of all others at most."""
    m, h = (begin + end) / 2, (end - begin) / 2
    for bits in (128, 512, 2048):
        bounds, rest = {}, Fraction(0)
        for exponent, function in expression.items():
            x, powers, left = taylor(thawed(exponent), function, t, m, h, bits)
            factor = exponential(x, bits)
            rest += left * factor[1]
            for k, power in enumerate(powers):
                low, high = bounds.get(k, (0, 0))
                a, b = sorted(power * e for e in factor)
                bounds[k] = low + a, high + b
        low, high = bounds.pop(0, (0, 0))
        rest += sum(max(-a, b) for a, b in bounds.values())
        if low > rest or high < -rest:
            return 1 if low > 0 else -1
    raise Wrong(f"no sign is seen between {begin} and {end}")


def cells(cert, pieces, level):
    """Intervals without gaps from the first time of the window to the last, each with the quantity less a level and a
    derivative that has one sign there. That of order 0 is the quantity itself; with that of order 1, or of order k where
    those of orders 1 ... k - 1 are zero at one end, the quantity is strictly monotone; without one it is the level."""
    t, time = cert["time"], Fraction(cert["from"])
    for begin, end, order in cert["cells"]:
        begin, end = Fraction(begin), Fraction(end)
        need(begin == time and begin < end, "the intervals have gaps")
        expression, next_ = seen(cert, pieces, begin)
        need(next_ is None or end <= next_, "a wave arrives within an interval")
        accumulate(expression, {(): {(): {(): -level}}})
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
    need(time == Fraction(cert["to"]), "the intervals end early or late")


def check_value(cert):
    """The decimal is the value, correctly rounded."""
    time, claim, slack = Fraction(cert["at"]), Fraction(cert["value"]), Fraction(10) ** cert["last_place"] / 2
    expression, _ = seen(cert, check_pieces(cert), time)
    accumulate(expression, {(): {(): {(): slack - claim}}})
    need(sign(expression, cert["time"], time) >= 0, "the value is another one: smaller")
    accumulate(expression, {(): {(): {(): -2 * slack}}})
    need(sign(expression, cert["time"], time) <= 0, "the value is another one: larger")


def check_roots(cert):
    """Zeros, also of limits where waves arrive, are where monotone parts change sign, or at ends of intervals."""
    t, found = cert["time"], []
    for begin, end, expression, order, _ in cells(cert, check_pieces(cert), Fraction(0)):
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
    claims = [tuple(map(Fraction, claim)) for claim in cert["zeros"]]
    need(len(claims) == len(found), f"{len(found)} zeros instead of {len(claims)}")
    need(all(a[1] < b[0] for a, b in zip(claims, claims[1:])), "two zeros are in one place")
    for (low, high), (begin, end, expression) in zip(claims, found):
        if expression is None:
            need((low, high) == (begin, end) if begin < end else low <= begin <= high, f"the zero at {begin} is not told")
        else:
            low, high = max(low, begin), min(high, end)
            need(low < high and sign(expression, t, low) * sign(expression, t, high) < 0, f"the zero after {begin} is not told")


def check_extremum(cert):
    """Nothing is beyond the rounded value by more than half a unit of its last place, and something comes as near to it."""
    way = {"largest": 1, "smallest": -1}[cert["goal"]]
    slack, t, (place, time) = Fraction(10) ** cert["last_place"] / 2, cert["time"], cert["attained"]
    is_taken = False
    bound = Fraction(cert["value"]) + way * slack
    for i, (begin, end, expression, order, sign_) in enumerate(cells(cert, check_pieces(cert), bound)):
        signs = [sign_] if order in (None, 0) else [sign(expression, t, at) for at in (begin, end)]
        need(all(sign_ * way <= 0 for sign_ in signs), f"a value between {begin} and {end} is beyond the extremum")
        if i == place:
            accumulate(expression, {(): {(): {(): 2 * way * slack}}})
            is_taken = begin <= Fraction(time) <= end and sign(expression, t, Fraction(time)) * way >= 0
    need(is_taken, "the extremum is not taken where it is said")


def check(cert):
    need(cert.get("wavestep_certificate") == 1, "a certificate of another version")
    ROOTS.clear()
    ROOTS.update({symbol: Fraction(square) for symbol, square in cert["roots"].items()})
    kinds = {"pieces": check_pieces, "value": check_value, "roots": check_roots, "extremum": check_extremum}
    need(cert["kind"] in kinds, f"unknown kind {cert['kind']}")
    kinds[cert["kind"]](cert)


if __name__ == "__main__":
    for name in sys.argv[1:]:
        with open(name, encoding="utf-8") as file:
            certificate = json.load(file)
        try:
            check(certificate)
        except Wrong as error:
            sys.exit(f"{name}: NOT proven: {error}")
        print(f"{name}: proven ({certificate['kind']} of {certificate['title']})")

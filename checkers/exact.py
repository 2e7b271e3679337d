"""Exact values, and signs of what they stand for, with nothing but the standard library.

A polynomial is a dict from monomials, sorted tuples of (symbol, power), to rational numbers; a rational function is a
dict from denominators, sorted tuples of (factor, power), to polynomials; an expression is a dict from exponents X, each a
rational function, to rational functions R: the sum of all R exp(X).
"""

import math
import random
import re
from fractions import Fraction

from reading import Wrong, need

ROOTS = {}  # symbols that stand for square roots, with what is below these
ONE = {(): {(): 1}}
MINUS = {(): {(): {(): -1}}}  # the expression -1
LONGEST, HIGHEST, LATEST, PLACES = 20000, 10**4, 10**6, 20000  # characters of a number; powers; delays in periods; decimals


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


def over_one(function):
    """A rational function over one denominator: the powers of its factors, and the numerator, a function without denominators."""
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
    return powers, total


def vanishes(function):
    """Whether a rational function is zero: over one denominator its numerators cancel."""
    return not any(over_one(function)[1].values())


def turn(function):
    """r where a rational function is i pi r, pi being the number; None where it is not."""
    powers, total = over_one(function)
    if not total or not total[()]:
        return Fraction(0)
    below = ONE
    for factor, power in powers.items():
        for _ in range(power):
            below = add({}, {(): dict(factor)}, below)
    i = next((symbol for symbol, square in ROOTS.items() if square == -1), None)
    whole = add({}, below, {(): {tuple(sorted([("pi", 1), (i, 1)])): 1}}) if i else {(): {}}
    r = next((Fraction(total[()].get(m, 0)) / c for m, c in whole[()].items()), 0)
    return r if r and vanishes(add(add({}, total), whole, {(): {(): -r}})) else None


def turned(r):
    """exp(i pi r) where 12 r is whole: a power of exp(i pi/12) = (sqrt(6) + sqrt(2))/4 + i (sqrt(6) - sqrt(2))/4."""
    roots = {square: ((symbol, 1),) for symbol, square in ROOTS.items()}
    if 2 * r == int(2 * r):
        twelfth, count = {(): {roots[-1]: 1}}, int(2 * r) % 4  # of a fourth of a turn no other root is needed
    elif {2, 3} <= roots.keys() and 12 * r == int(12 * r):
        product_of = lambda *squares: tuple(sorted(pair for square in squares for pair in roots[square]))
        quarter, count = Fraction(1, 4), int(12 * r) % 24
        real = {product_of(2, 3): quarter, product_of(2): quarter}
        twelfth = {(): real | {product_of(-1, 2, 3): quarter, product_of(-1, 2): -quarter}}
    else:
        return None
    value = ONE
    for _ in range(count):
        value = add({}, value, twelfth)
    return value


def alike(x, y):
    """exp(x - y) where it is known, as a rational function; None else. One exponent may be written in more than one way."""
    r = turn(add(add({}, x), y, {(): {(): -1}}))
    return None if r is None else ONE if r == 0 else turned(r)


def is_zero(expression):
    """Whether the rational functions before each exponential cancel."""
    left = [(thawed(x), function) for x, function in expression.items() if not vanishes(function)]
    while left:
        (x, total), *others = left
        factors = [alike(y, x) for y, _ in others]
        for (_, function), factor in zip(others, factors):
            total = add(add({}, total), function, factor) if factor else total
        if not vanishes(total):
            return False
        left = [other for other, factor in zip(others, factors) if not factor]
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


def rational(text):
    """A fraction or a decimal, without digits or an exponent that would fill the memory."""
    need(len(text) <= LONGEST, "a number is too long")
    need(re.fullmatch(r"-?[0-9]+(/[0-9]+|(\.[0-9]+)?(e-?[0-9]{1,4})?)", text), f"{text[:40]} is no number")
    return Fraction(text)


def decimal(cert):
    """A decimal, and half a unit of its last place."""
    need(type(cert["last_place"]) is int and abs(cert["last_place"]) <= PLACES, "a place is no number, or too large")
    value, unit = rational(cert["value"]), Fraction(10) ** cert["last_place"]
    need((value / unit).denominator == 1, "the decimal has more digits than it says")
    return value, unit / 2


def is_count(power, most=HIGHEST):
    return type(power) is int and 0 <= power <= most


def read_polynomial(terms):
    polynomial = {}
    for coefficient, powers in terms:
        need(all(is_count(p) and p > 0 for p in powers.values()), "a power is no positive integer, or too large")
        monomial = tuple(sorted(powers.items()))
        need(monomial not in polynomial and rational(coefficient), "a term stands twice, or is zero")
        polynomial[monomial] = rational(coefficient)
    return polynomial


def reduced(polynomial):
    """With numbers in place of squares of roots."""
    total = {}
    for monomial, c in polynomial.items():
        rest = tuple((s, p % 2 if s in ROOTS else p) for s, p in monomial)
        key = tuple(pair for pair in rest if pair[1])
        total[key] = total.get(key, 0) + c * math.prod(ROOTS[s] ** (p // 2) for s, p in monomial if s in ROOTS)
    return {key: c for key, c in total.items() if c}


def read_function(rows):
    function = {}
    for top, below in rows:
        key = ()
        need(type(below) is list, "factors are no list")
        for factor, power in below:
            need(is_count(power) and power > 0, "a power is no positive integer, or too large")
            # Roots of -1 and of primes are independent: nothing but zero divides zero.
            divisor = reduced(read_polynomial(factor))
            need(divisor, "a divisor is zero")
            key, _ = product(key, ((tuple(sorted(divisor.items())), power),))
        add(function, {key: reduced(read_polynomial(top))})
    return function


def read(rows):
    expression = {}
    for exponent, function in rows:
        add(expression.setdefault(frozen(read_function(exponent)), {}), read_function(function))
    return expression


def number_at(expression, values):
    """The value for pseudo-random numbers in place of symbols."""
    at = lambda key: values.setdefault(key, Fraction(random.randrange(1, 1 << 60)))
    of = lambda top: sum(c * math.prod(at(s) ** p for s, p in m) for m, c in top.items())
    total = Fraction(0)
    for exponent, function in expression.items():
        need(not exponent or is_zero({(): function}), "an exponential in an equation")  # they depend on each other
        for below, top in function.items():
            tops = [top] + [dict(factor) for factor, _ in below]
            need(not any(s in ROOTS for top_ in tops for m in top_ for s, _ in m), "a root in an equation")
            divisor = math.prod(of(dict(factor)) ** power for factor, power in below)
            total += of(top) / divisor if top else 0
    return total


def power(base, exponent, total):
    """An expression to a power, times another one."""
    need(type(exponent) is int and exponent >= 0, "a power is negative")
    for _ in range(exponent):
        total = accumulate({}, total, base)
    return total


def key_of(expression):
    """An expression as a key."""
    return tuple(sorted((x, frozen(function)) for x, function in expression.items()))


# Linear forms in the waves: dicts from (wave, operator, lag) to coefficients; forcing has no wave and a function instead.


def read_form(rows):
    parts = [((wave, kind, lag), c) for wave, kind, lag, c in rows["waves"]]
    total = {}
    for key, rows_ in parts + [((None, "forcing", lag), function) for lag, function in rows["forcing"]]:
        need(key[0] is None or key[1] in ("value", "slope", "sum"), f"unknown operator {key[1]}")
        need(is_count(key[2], LATEST), "a lag is no number of periods, or too large")
        accumulate(total.setdefault(key, {}), read(rows_))
    return total


def plus(*forms):
    total = {}
    for form in forms:
        for key, coefficient in form.items():
            accumulate(total.setdefault(key, {}), coefficient)
    return total


def times(factor, form):
    return {key: accumulate({}, coefficient, factor) for key, coefficient in form.items()}


def less(a, b):
    return plus(a, times(MINUS, b))


def on_period(form, pieces, n, cert):
    """The value on the n-th period, in local time; waves are zero before the first one."""
    s, total = cert["local"], {}
    for (wave, kind, lag), coefficient in form.items():
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
    need(all(lag == int(lag) and 0 <= lag <= LATEST for _, _, lag in left), "a delay is no multiple of the period")
    return {(name, kind, int(lag)): c for (name, kind, lag), c in left.items()}


# Values: sums of polynomials times exponentials of the time, with numbers: rational ones, or sums of such times roots.


class Ball:
    """A complex number: its parts in whole units of 2^-bits, and how many units it is off at most."""

    def __init__(self, bits, real, imaginary=0, off=0):
        self.bits, self.real, self.imaginary, self.off = bits, real, imaginary, off

    @staticmethod
    def of(numbers, bits):
        """A sum of rational numbers times products of roots; each part of it is the root of a rational number."""
        parts = [0, 0]
        for monomial, c in numbers.items():
            below = [ROOTS[s] for s, _ in monomial]
            size = math.isqrt(int(c * c * abs(math.prod(below)) * (1 << 2 * bits)))
            parts[-1 in below] += size if c > 0 else -size
        return Ball(bits, *parts, off=len(numbers))

    def __add__(self, other):
        return Ball(self.bits, self.real + other.real, self.imaginary + other.imaginary, self.off + other.off)

    def __mul__(self, other):
        a, b, c, d = self.real, self.imaginary, other.real, other.imaginary
        off = (abs(a) + abs(b)) * other.off + (abs(c) + abs(d) + other.off) * self.off
        return Ball(self.bits, (a * c - b * d) >> self.bits, (a * d + b * c) >> self.bits, (off >> self.bits) + 3)

    def over(self, count):
        return Ball(self.bits, self.real // count, self.imaginary // count, self.off // count + 3)

    def size(self):
        """A bound of its size, in units."""
        return abs(self.real) + abs(self.imaginary) + self.off

    def sign(self):
        """That of its real part, if it is decided."""
        return 0 if abs(self.real) <= self.off else 1 if self.real > 0 else -1

    def exp(self):
        """The Taylor sum of x/2^k, squared k times."""
        halvings = max(0, (self.size() >> self.bits).bit_length() + 1)
        need(halvings <= 22, "an exponent is too large")
        y = self.over(1 << halvings)
        total = term = Ball(self.bits, 1 << self.bits)
        i = 0
        while abs(term.real) + abs(term.imaginary) > 4:
            i += 1
            term = (term * y).over(i)
            total += term
        total.off += 2 * term.size()  # each term is at most half of that before
        for _ in range(halvings):
            total *= total
        return total


def number(function):
    """A rational function without symbols but roots, from products of roots to rational numbers."""
    need(not any(below and top for below, top in function.items()), "a symbol has no value")
    top = function.get((), {})
    need(all(s in ROOTS and p == 1 for monomial in top for s, p in monomial), "a symbol has no value")
    return {monomial: c for monomial, c in top.items() if c}


def coefficients(function, t, of=number):
    """Those of a polynomial in the time, without other symbols unless they are kept."""
    powers = [{}]
    for below, m, c, power in terms(function, t):
        powers += [{} for _ in range(power + 1 - len(powers))]
        add(powers[power], {below: {tuple(pair for pair in m if pair[0] != t): c}})
    return [of(power) for power in powers]


def sign(expression, t, time):
    """The sign at a time of what is real. Exponentials of different algebraic numbers are linearly independent over these."""
    here = put(expression, t, {(): {(): time}})
    parts = [(number(thawed(x)), number(r)) for x, r in here.items() if number(r)]
    for bits in (128, 512, 2048, 8192, 32768, 131072) if parts else ():
        total = sum((Ball.of(x, bits).exp() * Ball.of(r, bits) for x, r in parts), Ball(bits, 0))
        if total.sign():
            return total.sign()
    need(not parts, "a sign is not decided")
    return 0


def taylor(exponent, function, t, bits):
    """Of R exp(X): the coefficients of all powers of t, and a bound, in units, of what they leave out for |t| <= 1."""
    start, rate, *others = coefficients(exponent, t) + [{}]
    need(not any(others), "an exponent is not linear in the time")
    factors, x, series = [Ball.of(own, bits) for own in coefficients(function, t)], Ball.of(rate, bits), [Ball.of(start, bits).exp()]
    need(x.size() >> bits < 4096, "an interval is too long")
    while abs(series[-1].real) + abs(series[-1].imaginary) > 4 or 2 * x.size() > len(series) << bits:
        series.append((series[-1] * x).over(len(series)))
    total = [Ball(bits, 0) for _ in range(len(series) + len(factors) - 1)]
    for i, own in enumerate(factors):
        for k, factor in enumerate(series):
            total[i + k] += own * factor
    return total, sum((own.size() * series[-1].size() >> bits) + 1 for own in factors)  # what follows is halved each time


def sign_on(expression, t, begin, end):
    """The sign on an interval of what is real: a value differs from that in the middle by the sizes of all other coefficients
    of a Taylor series at most."""
    about = put(expression, t, {(): {(): (begin + end) / 2, ((t, 1),): (end - begin) / 2}})
    for bits in (128, 512, 2048, 8192):
        total, rest = {}, 0
        for exponent, function in about.items():
            powers, left = taylor(thawed(exponent), function, t, bits)
            rest += left
            for k, power in enumerate(powers):
                total[k] = total.get(k, Ball(bits, 0)) + power
        middle = total.pop(0, Ball(bits, 0))
        middle.off += rest + sum(abs(power.real) + power.off for power in total.values())
        if middle.sign():
            return middle.sign()
    raise Wrong(f"no sign is seen between {begin} and {end}")

"""Numbers that are exact or enclosed, and functions on a step, for motion.py.

Between two breaks all is smooth. A function is a list c of N + 1 numbers there, in units of the step: Taylor's coefficients at
the start for k < N, and for k = N what encloses the N-th derivative over N! on the whole cell. So f(x) = c_0 + c_1 x + ... +
c_N x^N, by Lagrange's remainder.
"""

from fractions import Fraction
from math import comb, gcd
from operator import mul

from exact import rational
from reading import decided, need

EXACT = 1024  # bits of the longest denominator of a number that is exact
PRECISION = {"bits": 256}


class Number:
    """A rational number top/below, exact as long as its denominator is short; or a ball, of which below is 0, whose midpoint top and
    radius off are in units of 2^-bits."""

    __slots__ = ("top", "below", "off")

    def __init__(self, exact):
        self.top, self.below, self.off = exact.numerator, exact.denominator, 0
        self.shorten()

    def shorten(self):
        if self.below.bit_length() > EXACT:
            self.top, self.below, self.off = (self.top << PRECISION["bits"]) // self.below, 0, 1

    @staticmethod
    def between(low, high):
        """All between two rational numbers."""
        if low == high:
            return Number(low)
        bits = PRECISION["bits"]
        low, high = (low.numerator << bits) // low.denominator, -((-high.numerator << bits) // high.denominator)
        return ball((low + high) >> 1, (high - low + 2) >> 1)

    def units(self):
        if not self.below:
            return self.top, self.off
        mid, rest = divmod(self.top << PRECISION["bits"], self.below)
        return mid, int(rest > 0)

    def __add__(self, other):
        if self.below and not self.top:
            return other
        if other.below and not other.top:
            return self
        if self.below and other.below:
            return quotient(self.top * other.below + other.top * self.below, self.below * other.below)
        (a, i), (b, j) = self.units(), other.units()
        return ball(a + b, i + j)

    def __neg__(self):
        own = Number.__new__(Number)
        own.top, own.below, own.off = -self.top, self.below, self.off
        return own

    def __sub__(self, other):
        return self + -other

    def times(self, factor):
        """Times a rational number."""
        top, below = factor.numerator, factor.denominator
        if self.below:
            return quotient(self.top * top, self.below * below) if self.top else ZERO
        if below == 1:
            return ball(self.top * top, self.off * abs(top)) if top else ZERO
        return ball(self.top * top // below, self.off * abs(top) // below + 2)

    def __mul__(self, other):
        return dot([(self, other, 1)])

    def __truediv__(self, other):
        decided(other.sign(), "a divisor may be zero")
        if other.below:
            return self.times(1 / other.exact())
        if self.is_zero():
            return ZERO
        (a, i), (b, j) = self.units(), other.units()
        mid = (a << PRECISION["bits"]) // b
        return ball(mid, ((i << PRECISION["bits"]) + (abs(mid) + 1) * j) // (abs(b) - j) + 2)

    def exact(self):
        return Fraction(self.top, self.below)

    def is_zero(self):
        return self.below and not self.top

    def sign(self):
        """1, -1, or 0 where it is exactly zero; None where it is not decided."""
        if abs(self.top) > self.off:
            return 1 if self.top > 0 else -1
        return 0 if self.below else None

    def holds(self, other):
        if self.below:
            return (self.top, self.below) == (other.top, other.below)
        (a, i), (b, j) = self.units(), other.units()
        return abs(a - b) + j <= i

    def ends(self):
        if self.below:
            return self.exact(), self.exact()
        unit = 1 << PRECISION["bits"]
        return Fraction(self.top - self.off, unit), Fraction(self.top + self.off, unit)


def ball(mid, off):
    own = Number.__new__(Number)
    own.top, own.below, own.off = mid, 0, off
    return own


def quotient(top, below):
    """One integer over another, which is positive."""
    own, common = Number.__new__(Number), gcd(top, below)
    own.top, own.below, own.off = top // common, below // common, 0
    own.shorten()
    return own


def dot(terms):
    """A sum of products of two numbers and an integer; of balls, in units of 2^-bits squared."""
    sum_, bits, mid, off = ZERO, PRECISION["bits"], 0, 0
    for a, b, count in terms:
        if a.below and not a.top or b.below and not b.top:
            continue
        if a.below and b.below:
            sum_ = sum_ + quotient(a.top * b.top * count, a.below * b.below)
            continue
        if b.below:
            a, b = b, a
        if a.below:
            mid += (a.top * b.top * count << bits) // a.below
            off += (abs(a.top) * b.off * abs(count) << bits) // a.below + 2
        else:
            mid += a.top * b.top * count
            off += ((abs(a.top) + a.off) * b.off + a.off * abs(b.top)) * abs(count)
    return sum_ + ball(mid >> bits, (off >> bits) + 2) if mid or off else sum_


ZERO, ONE = Number(Fraction(0)), Number(Fraction(1))


def interval(pair):
    need(type(pair) is list, "an interval is no list")
    low, high = map(rational, pair)
    need(low <= high, "an interval runs backwards")
    return Number.between(low, high)


class Duration:
    """A sum of rational multiples of travel times: of 1, under no name, and of others, under names; their values are kept here."""

    VALUES = {}

    def __init__(self, parts):
        self.parts = {name: c for name, c in parts.items() if c}

    @staticmethod
    def of(rational_):
        return Duration({"": Fraction(rational_)})

    def __add__(self, other):
        names = self.parts.keys() | other.parts.keys()
        return Duration({name: self.parts.get(name, 0) + other.parts.get(name, 0) for name in names})

    def __sub__(self, other):
        return self + Duration({name: -c for name, c in other.parts.items()})

    def __eq__(self, other):
        return self.parts == other.parts

    def __hash__(self):
        return hash(frozenset(self.parts.items()))

    def number(self):
        return total(ONE.times(c) if not name else self.VALUES[name].times(c) for name, c in self.parts.items())


def total(numbers):
    return weighted((own, 1) for own in numbers)


def weighted(terms):
    """A sum of numbers, each times an integer."""
    sum_, mid, off = ZERO, 0, 0
    for own, count in terms:
        if not own.below:
            mid += own.top * count
            off += own.off * abs(count)
        elif own.top:
            sum_ = sum_ + (own if count == 1 else own.times(count))
    return sum_ + ball(mid, off) if mid or off else sum_


def shifted(series, x, reach=ONE):
    """Taylor coefficients about another place, or enclosures of them for an interval. Of a cell that reaches as far as a number of
    steps, which may be tiny, they grow by its inverse from order to order, and count in a smaller unit meanwhile."""
    count, some = len(series), [j for j, own in enumerate(series) if not own.is_zero()]
    if x.is_zero() or not some:
        return list(series)
    tiny = PRECISION["bits"] - sum(reach.units()).bit_length()
    if tiny * count > PRECISION["bits"] // 4:
        small = lambda k: Fraction(1, 1 << tiny * k)
        there = shifted([own.times(small(k)) for k, own in enumerate(series)], x.times(1 / small(1)))
        return [own.times(1 / small(k)) for k, own in enumerate(there)]
    last, powers = some[-1], [ONE]
    for _ in range(last):
        powers.append(powers[-1] * x)
    # Orders from this one on are exact: those above the last ball if the place is exact, else at most the last.
    blurred = max((j for j in some if not series[j].below), default=-1) + 1 if x.below else last + (not series[last].below)
    known = [dot((series[j], powers[j - k], comb(j, k)) for j in some if j >= k) for k in range(blurred, last + 1)]
    (a, i), (b, h) = (zip(*(own.units() for own in numbers)) for numbers in (series[: last + 1], powers))
    size, wide = list(map(abs, a)), [abs(own) + off for own, off in zip(b, h)]
    balls, bits = [], PRECISION["bits"]
    for k in range(blurred):
        counts = [comb(j, k) for j in range(k, last + 1)]
        of = lambda left, right: sum(map(mul, map(mul, left[k:], counts), right))
        balls.append(ball(of(a, b) >> bits, (of(i, wide) + of(size, h) >> bits) + 2))
    return balls + known + [ZERO] * (count - 1 - last)


def squared(series, reach=ONE):
    """The last coefficient encloses what the derivative of that order is on a whole cell, by those of all orders."""
    last, on_cell = len(series) - 1, shifted(series, Number.between(Fraction(0), reach.ends()[1]), reach)
    return [dot((a[j], a[k - j], 1 + (2 * j < k)) for j in range(k // 2 + 1)) for k, a in enumerate([series] * last + [on_cell])]


def value(series, x):
    result = ZERO
    for own in reversed(series):
        result = result * x + own
    return result


def slope(series):
    return [own.times(k) for k, own in enumerate(series)][1:] or [ZERO]


def power(base, exponent):
    """What is positive of a number, raised to a rational power that is positive or zero."""
    p, q, bits = exponent.numerator, exponent.denominator, PRECISION["bits"]
    if not p:
        return ONE if base.sign() == 1 else Number.between(Fraction(0), Fraction(1))
    if base.is_zero():
        return ZERO
    mid, off = base.units()
    low, high = (root(max(own, 0) ** p << bits * q >> bits * p, q) for own in (mid - off, mid + off))
    return ball((low + high + 1) >> 1, ((high - low) >> 1) + 2)


def root(number, q):
    """The largest integer whose q-th power is no larger, by Newton's method from above."""
    if q == 1 or number < 2:
        return number
    best = 1 << -(-number.bit_length() // q)
    while True:
        next_ = ((q - 1) * best + number // best ** (q - 1)) // q
        if next_ >= best:
            return best
        best = next_


def begins(series):
    """The sign just after the start, 0 where a function is zero on the whole cell; None where it is not decided."""
    for own in series[:-1]:
        if not own.is_zero():
            return own.sign()
    return 0 if series[-1].is_zero() else None


def is_positive(series, low, high, depth=80):
    """Whether a function that is not negative at the start of the cell is positive between two places of it; zeros with which
    it begins there, and one at the end, do not count."""
    if not low:
        while len(series) > 1 and series[0].is_zero():
            series = series[1:]
    if value(series, Number.between(low, high)).sign() == 1:
        return True
    ends = [value(series, Number(end)).sign() for end in (low, high)]
    if value(slope(series), Number.between(low, high)).sign() and ends[0] in (0, 1) and ends[1] in (0, 1):
        return True
    middle = (low + high) / 2
    return depth > 0 and is_positive(series, low, middle, depth - 1) and is_positive(series, middle, high, depth - 1)

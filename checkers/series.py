"""Numbers that are exact or enclosed, and functions on a step, for motion.py.

Between two breaks all is smooth. A function is a list c of N + 1 numbers there, in units of the step: Taylor's coefficients at
the start for k < N, and for k = N what encloses the N-th derivative over N! on the whole cell. So f(x) = c_0 + c_1 x + ... +
c_N x^N, by Lagrange's remainder.
"""

from fractions import Fraction
from math import comb

from exact import rational
from reading import decided, need

EXACT = 1024  # bits of the longest denominator of a number that is exact
PRECISION = {"bits": 256}


class Number:
    """A rational number, exact as long as its denominator is short; or a ball, whose midpoint and radius are in units of 2^-bits."""

    __slots__ = ("exact", "mid", "off")

    def __init__(self, exact, mid=0, off=0):
        if exact is not None and exact.denominator.bit_length() > EXACT:
            bits = PRECISION["bits"]
            exact, mid, off = None, (exact.numerator << bits) // exact.denominator, 1
        self.exact, self.mid, self.off = exact, mid, off

    @staticmethod
    def between(low, high):
        """All between two rational numbers."""
        if low == high:
            return Number(low)
        bits = PRECISION["bits"]
        low, high = (low.numerator << bits) // low.denominator, -((-high.numerator << bits) // high.denominator)
        return Number(None, (low + high) >> 1, (high - low + 2) >> 1)

    def units(self):
        if self.exact is None:
            return self.mid, self.off
        top, below = self.exact.numerator << PRECISION["bits"], self.exact.denominator
        return top // below, int(top % below > 0)

    def __add__(self, other):
        if self.exact is not None and other.exact is not None:
            return Number(self.exact + other.exact)
        (a, i), (b, j) = self.units(), other.units()
        return Number(None, a + b, i + j)

    def __neg__(self):
        return Number(-self.exact) if self.exact is not None else Number(None, -self.mid, self.off)

    def __sub__(self, other):
        return self + -other

    def times(self, factor):
        """Times a rational number."""
        if self.exact is not None:
            return Number(self.exact * factor)
        top, below = factor.numerator, factor.denominator
        if below == 1:
            return Number(None, self.mid * top, self.off * abs(top)) if top else ZERO
        return Number(None, self.mid * top // below, self.off * abs(top) // below + 2)

    def __mul__(self, other):
        if self.exact is not None:
            return other.times(self.exact) if self.exact else ZERO
        if other.exact is not None:
            return self.times(other.exact) if other.exact else ZERO
        off = (abs(self.mid) + self.off) * other.off + self.off * abs(other.mid)
        return Number(None, self.mid * other.mid >> PRECISION["bits"], (off >> PRECISION["bits"]) + 2)

    def __truediv__(self, other):
        decided(other.sign(), "a divisor may be zero")
        if self.is_zero():
            return ZERO
        if other.exact is not None:
            return self.times(1 / other.exact)
        (a, i), (b, j) = self.units(), other.units()
        mid = (a << PRECISION["bits"]) // b
        return Number(None, mid, ((i << PRECISION["bits"]) + (abs(mid) + 1) * j) // (abs(b) - j) + 2)

    def is_zero(self):
        return self.exact is not None and not self.exact

    def sign(self):
        """1, -1, or 0 where it is exactly zero; None where it is not decided."""
        if self.exact is not None:
            return (self.exact > 0) - (self.exact < 0)
        return None if abs(self.mid) <= self.off else 1 if self.mid > 0 else -1

    def holds(self, other):
        if self.exact is not None:
            return self.exact == other.exact
        (a, i), (b, j) = self.units(), other.units()
        return abs(a - b) + j <= i

    def ends(self):
        if self.exact is not None:
            return self.exact, self.exact
        unit = 1 << PRECISION["bits"]
        return Fraction(self.mid - self.off, unit), Fraction(self.mid + self.off, unit)


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
    result = ZERO
    for own in numbers:
        if not own.is_zero():
            result = result + own
    return result


def shifted(series, x):
    """Taylor coefficients about another place, or enclosures of them for an interval."""
    count, some = len(series), [j for j, own in enumerate(series) if not own.is_zero()]
    if x.is_zero() or not some:
        return list(series)
    powers = [ONE]
    for _ in range(some[-1]):
        powers.append(powers[-1] * x)
    part = lambda k: total((series[j] * powers[j - k]).times(comb(j, k)) for j in some if j >= k)
    return [part(k) if k <= some[-1] else ZERO for k in range(count)]


def squared(series):
    """The last coefficient encloses what the derivative of that order is on a whole step, by those of all orders."""
    last, on_step = len(series) - 1, shifted(series, Number.between(Fraction(0), Fraction(1)))
    return [total(a[j] * a[k - j] for j in range(k + 1)) for k, a in enumerate([series] * last + [on_step])]


def value(series, x):
    result = ZERO
    for own in reversed(series):
        result = result * x + own
    return result


def slope(series):
    return [own.times(k) for k, own in enumerate(series)][1:] or [ZERO]


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

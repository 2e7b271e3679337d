"""Numbers that are rational or balls of Arb, and functions on a step, for motion_arb.py.

A function on a step is a list of Taylor coefficients, the last one enclosed for the whole step.
"""

import re
from fractions import Fraction

from flint import arb, arb_poly, fmpq

from reading import need


def rational(text):
    need(type(text) is str and len(text) <= 20000, "a number is no text, or too long")
    need(re.fullmatch(r"-?[0-9]+(/[0-9]+|(\.[0-9]+)?(e-?[0-9]{1,4})?)", text), f"{text[:40]} is no number")
    value = Fraction(text)
    return fmpq(value.numerator, value.denominator)


NIL = fmpq(0)
LONGEST = 1024  # bits of a denominator


def short(x):
    """A rational number with a long denominator as a ball."""
    return arb(x) if isinstance(x, fmpq) and int(x.q).bit_length() > LONGEST else x


def is_nil(x):
    return not x if isinstance(x, fmpq) else x.is_zero()


def sign(x):
    """1, 0 or -1; None where it is not known."""
    if isinstance(x, fmpq):
        return (x > 0) - (x < 0)
    return 1 if x > 0 else -1 if x < 0 else 0 if x.is_zero() else None


def size(x):
    return arb(abs(x)).upper()


def span(low, high):
    """All numbers between two, which may be balls themselves."""
    low, high = arb(low), arb(high)
    return low if (high - low).is_zero() else low.union(high)


def product(a, b):
    return NIL if is_nil(a) or is_nil(b) else short(a * b)


def dot(row, column):
    result = NIL
    for a, b in zip(row, column):
        if not is_nil(a) and not is_nil(b):
            result = result + a * b
    return short(result)


def interval(ends):
    need(type(ends) is list, "an interval is no list")
    low, high = map(rational, ends)
    need(low <= high, "an interval runs backwards")
    return low if low == high else span(low, high)


class Length:
    """A length of time: a rational number, and rational multiples of travel times that are none."""

    def __init__(self, plain=0, others=()):
        self.plain, self.others = fmpq(plain), {key: own for key, own in dict(others).items() if own[0] != 0}

    def plus(self, other, way=1):
        others = {key: [way * count, value] for key, (count, value) in other.others.items()}
        for key, (count, value) in self.others.items():
            others[key] = [count + others.get(key, [0])[0], value]
        return Length(self.plain + way * other.plain, others)

    def value(self):
        return sum((count * value for count, value in self.others.values()), self.plain)

    def __eq__(self, other):
        difference = self.plus(other, -1)
        return difference.plain == 0 and not difference.others


# Functions on a step: Taylor coefficients, the last one enclosed for the whole step.


def are_exact(numbers):
    return all(isinstance(own, fmpq) for own in numbers)


def padded(polynomial, count):
    """The coefficients of a polynomial of Arb, and zeros behind them."""
    found = polynomial.coeffs()
    return found + [NIL] * (count - len(found))


def moved(series, x):
    """The coefficients about another place, or about all places of an interval."""
    if is_nil(x) or all(map(is_nil, series)):
        return series
    result, count = list(series), len(series)
    exact = next(k for k in range(count + 1) if are_exact(series[k:]))
    for start in range(count - 1):  # Horner's scheme, repeated, so that what is exact stays so
        for i in range(count - 2, max(start, exact) - 1, -1):
            result[i] = short(result[i] + product(result[i + 1], x))
    return padded(arb_poly(series)(arb_poly([x, 1])), count)[:exact] + result[exact:]


def horner(series, x):
    result = NIL
    for c in reversed(series):
        result = short(product(result, x) + c)
    return result


def square(series, reach):
    """Its last coefficient is enclosed for the whole cell by the coefficients about all of its places."""
    count, everywhere = len(series), moved(series, span(NIL, reach))
    here, there = (padded(arb_poly(c) * arb_poly(c), 2 * count) for c in (series, everywhere))
    exact = next(k for k in range(count) if k == count - 1 or not are_exact(series[: k + 1]))
    return [dot(series[: k + 1], series[k::-1]) for k in range(exact)] + here[exact : count - 1] + [there[count - 1]]


def derivative(series):
    return [c * k for k, c in enumerate(series) if k] or [NIL]


def stays_positive(series, begin, end, depth=80):
    """Whether it is positive strictly between two places; what it begins with at 0 may be zeros."""
    if begin == 0:
        first = next((k for k, c in enumerate(series) if not is_nil(c)), len(series) - 1)
        series = series[first:]
    if sign(horner(series, span(begin, end))) == 1:
        return True
    if sign(horner(derivative(series), span(begin, end))) in (1, -1):
        if all(sign(horner(series, at)) in (0, 1) for at in (begin, end)):
            return True
    half = (begin + end) / 2
    return depth > 0 and stays_positive(series, begin, half, depth - 1) and stays_positive(series, half, end, depth - 1)

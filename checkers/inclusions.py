#!/usr/bin/env python3
"""Tries the numbers of series.py: whatever a ball stands for, its sums, products and quotients have to hold it.

`inclusions.py COUNT` draws numbers and functions of few bits, so that rounding matters, and points of the balls, computes with
these exactly, and exits with 1 where a result lies outside of what series.py encloses it with.
"""

import random
import sys
from fractions import Fraction
from math import comb

import series
from series import ZERO, Number, ball, dot, power, shifted, squared, value, weighted

BITS = 24


def number(draw):
    """Zero, a rational number, or a ball, which may be exact or wide."""
    kind = draw.random()
    if kind < 0.25:
        return ZERO
    if kind < 0.5:
        return Number(Fraction(draw.randint(-50, 50), draw.randint(1, 9)))
    return ball(draw.randint(-4 << BITS, 4 << BITS), draw.choice([0, 1, 3, 100, 1 << BITS - 4]))


def point(own, draw):
    """What a number may stand for, its ends more often than not."""
    low, high = own.ends()
    return draw.choice([low, high, low + (high - low) * Fraction(draw.randint(0, 9), 9)])


def expanded(series_, x):
    """Taylor's coefficients of a polynomial about another place."""
    orders = range(len(series_))
    return [sum(series_[j] * comb(j, k) * x ** (j - k) for j in orders[k:]) for k in orders]


def trial(draw):
    """Pairs of an enclosure and a number that it has to hold."""
    own = [number(draw) for _ in range(draw.randint(1, 7))]
    inner = [point(one, draw) for one in own]
    a, b = own[0], number(draw)
    p, q = inner[0], point(b, draw)
    counts = [draw.randint(-3, 3) for _ in own]
    factor = Fraction(draw.randint(-9, 9), draw.randint(1, 9))
    yield from [(a + b, p + q), (a - b, p - q), (a * b, p * q), (a.times(factor), p * factor)]
    if b.sign():
        yield a / b, p / q
    yield weighted(zip(own, counts)), sum(map(Fraction.__mul__, inner, map(Fraction, counts)))
    yield dot([(one, b, count) for one, count in zip(own, counts)]), sum(one * q * count for one, count in zip(inner, counts))
    yield value(own, b), sum(one * q**k for k, one in enumerate(inner))
    yield from zip(shifted(own, b), expanded(inner, q))
    if p >= 0 and a.sign() == 1:
        yield power(a, Fraction(3)), p**3
    # On a cell: a polynomial, all of whose coefficients but the last are squared as they are.
    on_cell = squared(own)
    yield from ((on_cell[k], sum(inner[j] * inner[k - j] for j in range(k + 1))) for k in range(len(own) - 1))


def main(count):
    series.PRECISION["bits"], draw, tried = BITS, random.Random(1), 0
    for i in range(count):
        for enclosure, held in trial(draw):
            low, high = enclosure.ends()
            tried += 1
            if not low <= held <= high:
                raise SystemExit(f"trial {i}: {held} is not between {low} and {high}")
    print(f"{tried} results, all enclosed")


if __name__ == "__main__":
    main(int(sys.argv[1]))

#!/usr/bin/env python3
"""Checks certificates of wavestep with nothing but the standard library; docs/certificates.md says what is claimed.

It chooses the check for each kind. laws.py derives the laws of a line, pieces.py proves pieces, general.py formulas for every n,
windows.py values, zeros and extrema, motion.py with series.py events, readings.py what is read of motions; exact.py is the arithmetic.
"""

import json
import math
import re
from fractions import Fraction

from exact import ROOTS
from general import check_general
from motion import check_events
from pieces import check_pieces
from reading import main, need
from readings import check_extreme, check_reading, check_readings, check_zeros
from windows import check_doubles, check_extremum, check_roots, check_value


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
    kinds |= {"readings": check_readings, "extreme": check_extreme, "zeros": check_zeros}
    need(type(cert["title"]) is str and cert["title"].encode(), "a title is missing")
    need(cert["kind"] in kinds, f"unknown kind {json.dumps(cert['kind'])}")
    need("minus" not in cert or "observed" in cert["minus"] and cert["kind"] not in ("pieces", "general"), "a second scene for nothing")
    kinds[cert["kind"]](cert)


if __name__ == "__main__":
    main(check)

"""Problem A in python-flint:  python3 python_flint.py 20

P_n is a list by powers of E of lists by powers of s of polynomials in mu.
"""

import sys
from operator import mul
from time import perf_counter

from flint import fmpq, fmpq_poly

ZERO = fmpq_poly([])


def derive(last):
    d_powers = [fmpq_poly([0] * i + [2**i]) for i in range(last + 1)]
    polynomials, before = [[[fmpq_poly([1])]]], [ZERO]
    for n in range(last):
        p = polynomials[-1]
        at = [sum(map(mul, row, d_powers), ZERO) for row in p] + [ZERO]
        new = [minus_twice_integral(row) for row in p] + [[ZERO]]
        for k in range(n + 1):
            new[k + 1][0] += at[k] - before[k]
        polynomials.append(new)
        before = at
    return polynomials


def minus_twice_integral(row):
    """The row p - 2 * (integral of p from 0 to s)."""
    integral = [ZERO] + [a * fmpq(2, i) for i, a in enumerate(row, 1)]
    return [a - b for a, b in zip(row + [ZERO], integral)]


start = perf_counter()
p = derive(int(sys.argv[1]))[-1]
seconds = perf_counter() - start

terms = sum(c != 0 for row in p for a in row for c in a.coeffs())
value = sum(fmpq(1, 2) ** k * a(fmpq(1, 3)) for k, row in enumerate(p) for a in row)
print(f"terms={terms} value={value} seconds={seconds:.3f}")

"""Problem A in SymPy's sparse polynomial ring:  python3 sympy_ring.py 20

Each step goes over the terms by hand: `compose` for P(D) alone makes it some ten times as slow.
"""

import sys
from time import perf_counter

from sympy import QQ
from sympy.polys.rings import ring

R, s, mu, E = ring("s, mu, E", QQ)


def derive(last):
    d_powers = [QQ(2**i) for i in range(last + 1)]
    integrals = [QQ(2, i + 1) for i in range(last + 1)]
    polynomials, before = [R.one], R.zero
    for _ in range(last):
        p, at = polynomials[-1].copy(), R.zero
        for (i, j, k), c in polynomials[-1].items():
            p[i + 1, j, k] = p.get((i + 1, j, k), 0) - c * integrals[i]
            at[0, i + j, k] = at.get((0, i + j, k), 0) + c * d_powers[i]
        at.strip_zero()
        p.strip_zero()
        polynomials.append(p + E * (at - before))
        before = at
    return polynomials


start = perf_counter()
p = derive(int(sys.argv[1]))[-1]
seconds = perf_counter() - start

value = p.evaluate([(s, 1), (mu, QQ(1, 3)), (E, QQ(1, 2))])
print(f"terms={len(p)} value={value} seconds={seconds:.3f}")

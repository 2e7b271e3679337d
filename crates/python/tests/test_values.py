"""Values, roots and extrema, held against closed forms."""

import threading
import time
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
import pint
import pytest

import wavestep as ws

MASS = ws.scene("rigid-mass", mu=1)


def closed_form(t: Fraction) -> mpmath.mpf:
    """The wave f of a rigid mass on a fixed bar, mu = 1, in the first three periods."""
    n, s = divmod(t, 2)
    e, s = mpmath.exp, mpmath.mpf(s.numerator) / s.denominator
    return (
        e(-s),
        e(-s) * (1 - 2 * s + e(-2)),
        e(-s) * (2 * s**2 - s * (4 + 2 * e(-2)) + 1 - 3 * e(-2) + e(-4)),
    )[int(n)]


@pytest.mark.parametrize("t", [Fraction(0), Fraction(1, 3), Fraction(33, 10), Fraction(59, 10)])
def test_digits_are_those_of_the_closed_form(t: Fraction) -> None:
    with mpmath.workdps(60):
        value = MASS.signal("f").digits(t, 40)
        assert abs(value.mpf(40) - closed_form(t)) < mpmath.mpf(10) ** -39
        assert abs(mpmath.sqrt(value) ** 2 - closed_form(t)) < mpmath.mpf(10) ** -39
        lower, upper = (mpmath.mpf(end.numerator) / end.denominator for end in value.bounds)
        assert lower - mpmath.mpf(10) ** -55 <= closed_form(t) <= upper + mpmath.mpf(10) ** -55


def test_arrays_hold_the_nearest_doubles() -> None:
    f = MASS.signal("f")
    times = np.random.default_rng(1).uniform(0, 6, 50)
    with mpmath.workdps(60):
        exact = [float(closed_form(Fraction(t))) for t in times]
    assert f(times).tolist() == exact
    assert [f(t) for t in times] == exact
    # From some thousand values on by polynomials, in any order.
    many = np.concatenate([times, np.linspace(0, 6, 5000, endpoint=False)])
    assert f(many)[:50].tolist() == exact


def test_floats_mean_their_exact_value() -> None:
    f = MASS.signal("f")
    assert f.digits(0.1, 30) == f.digits(Fraction(0.1), 30) == f.digits(Decimal(0.1), 30)
    assert f.digits(0.1, 30) == f.digits(np.float64(0.1), 30)
    assert f.digits(0.1, 30) != f.digits("0.1", 30) == f.digits(Decimal("0.1"), 30)
    assert f.digits(3, 20) == f.digits(np.int64(3), 20) == f.digits("3", 20)
    assert f(np.float32(0.1)) == f(float(np.float32(0.1)))


def test_quantities_keep_their_units() -> None:
    force: Any = ws.scene("hopkinson").signal("force")
    unit: Any = pint.UnitRegistry()
    assert force.unit == "N"
    assert force.digits(unit.Quantity(400, "us"), 20) == force.digits("400 us", 20)
    assert force.digits(unit.Quantity(Fraction(2, 5), "ms"), 20) == force.digits("400 us", 20)
    several = force(unit.Quantity(np.array([100.0, 400.0]), "us"))
    assert several[1] == pytest.approx(force("400 us"), rel=1e-12)
    with pytest.raises(ws.InputError, match="time"):
        force(unit.Quantity(1, "m"))


def test_curves_keep_their_bound() -> None:
    f = MASS.signal("f")
    times = np.random.default_rng(2).uniform(0, 40, 3000)
    for within in (None, "1e-6"):
        curve = f.compiled(0, 40, within=within)
        for some in (times, np.sort(times)):
            errors = abs(curve(some) - f(some))
            assert (errors <= curve.bound + np.spacing(abs(curve(some)))).all()
    found = f.values(times, within="abs:1e-9")
    assert found.bound is not None and (abs(found.values - f(times)) <= found.errors).all()
    assert f.values([1, "3/2", Fraction(5, 2)], method="certified").values.tolist() == [
        f(1), f(1.5), f(2.5)
    ]  # fmt: skip


def test_arrays_of_any_shape_and_kind() -> None:
    f = MASS.signal("f")
    t = np.linspace(0, 5, 12).reshape(3, 4)
    functions: list[Callable[..., Any]] = [f, f.compiled(0, 6)]
    for function in functions:
        assert function(t).shape == (3, 4)
        assert (function(t.T) == function(t).T).all()
        assert (function(t[:, ::2]) == function(t)[:, ::2]).all()
        assert (function(np.arange(4)) == function([0, 1, 2, 3])).all()
        assert function(np.array([])).shape == (0,)
        frozen, out = t.copy(), np.empty((3, 4))
        frozen.flags.writeable = False
        assert function(frozen, out=out) is out and (out == function(t)).all()


def test_roots_and_extrema() -> None:
    strain = MASS.signal("strain_impact")
    root, jump = strain.roots(2, 4, digits=20)
    with mpmath.workdps(30):
        assert abs(root.time.mpf() - (3 + mpmath.exp(-2) / 2)) < mpmath.mpf(10) ** -18
    assert (root.kind, root.rises, jump.kind, str(jump.time)) == ("simple", True, "jump", "4")
    (level,) = MASS.signal("velocity").roots(0, 1, level="1/2")
    assert float(level.time) == float(mpmath.log(2))
    most = strain.maximum(0, 4)
    assert (most.places[0].kind, most.places[0].attained) == ("arrival", False)
    least = MASS.signal("strain_fixed").minimum(0, 4, digits=9)
    assert str(least.value) == "-2.27067057" and str(least.places[0].time) == "3"


def test_work_goes_on_beside_other_threads() -> None:
    f = ws.scene("rigid-mass", mu="1/3").signal("f")
    thread = threading.Thread(target=f.digits, args=(600, 2000))
    thread.start()
    turns = 0
    while thread.is_alive():
        time.sleep(0.001)
        turns += 1
    assert turns > 20, "the interpreter was locked"


def test_threads_share_a_problem() -> None:
    f = MASS.signal("f")
    found: list[float] = []

    def work() -> None:
        found.append(f(np.linspace(0, 5, 100)).sum())

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=60)
    assert len(found) == 8 and len(set(found)) == 1

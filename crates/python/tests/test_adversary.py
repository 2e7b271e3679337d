"""What careless callers give."""

import copy
import pickle
import threading
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import wavestep as ws

mass = ws.scene("rigid-mass", mu=1)
velocity = mass.signal("velocity")
curve = velocity.compiled(0, 10)
force = ws.scene("hopkinson").signal("force")


def test_arrays_of_quantities_have_the_dimension_of_times() -> None:
    pint = pytest.importorskip("pint")
    unit = pint.UnitRegistry()
    times = np.array([300.0])
    assert force(times * unit.us) == force(times * 1e-6)
    seconds = force.compiled(0, "1 ms")
    assert seconds(times * unit.us) == seconds(times * 1e-6)
    assert seconds(300 * unit.us) == seconds("300 us") == seconds(0.0003)
    cases: list[tuple[Any, Any]] = [(force, unit.m), (seconds, unit.m), (velocity, unit.s), (curve, unit.s)]
    for signal, wrong in cases:
        with pytest.raises(ws.InputError, match="the times are in"):
            signal(times * wrong)
    with pytest.raises(ws.InputError):
        force.values(times * unit.m)


def test_arrays_that_overlap_are_refused() -> None:
    memory = bytearray(np.append(np.linspace(0, 10, 11), 0).tobytes())
    for call in (velocity, curve):
        with pytest.raises(ws.InputError, match="shares nothing"):
            call(np.frombuffer(memory)[:11], out=np.frombuffer(memory)[1:])
    out = np.empty(5)
    assert curve(np.linspace(0, 4, 5), out=out) is out


def test_times_of_all_kinds() -> None:
    for time in ("3/2", Fraction(3, 2), Decimal("1.5"), np.float32(1.5), np.array(1.5)):
        assert velocity(time) == velocity(1.5)
        assert curve(time) == curve(1.5)
    table = np.array([[0.5, 1.5], [2.5, 3.5]])
    assert velocity.values(table).values.shape == velocity(table).shape == (2, 2)
    assert velocity.values([0.5], within=1e-6).bound == velocity.values([0.5], within="1e-6").bound
    with pytest.raises(ws.InputError, match="masked"):
        velocity(np.ma.masked_array([0.5, 1.5], [False, True]))


def test_numbers_that_are_too_long() -> None:
    for time in (Decimal("1E+999999999"), 10**20000, Fraction(1, 10**20000)):
        for call in (velocity, curve, velocity.digits):
            with pytest.raises(ws.InputError, match="more than 10000 digits"):
                call(time)


def test_times_beyond_all_doubles() -> None:
    for ask in (velocity, velocity.digits, curve):
        with pytest.raises((ws.WorkError, ws.InputError)):
            ask(10**400)


def test_limits() -> None:
    value = velocity.digits("1/2")
    with pytest.raises(ws.InputError, match="digits are asked for"):
        value.decimal(10**9)
    with pytest.raises(ws.Error):
        mass.derive("f", iter(int, 1))
    with pytest.raises(ws.InputError, match="more than 1000000"):
        ws.sweep("rigid-mass", {"mu": range(1, 10**9)}, at=1)
    with pytest.raises(ws.InputError):
        ws.set_memory(-1)
    assert len(ws.sweep("rigid-mass", {"mu": [1, 2]}, at=1, threads=100_000)) == 2
    with pytest.raises(ws.InputError, match="cannot be told from the column"):
        ws.sweep("rigid-mass", {"note": [1, 2]}, at=1)
    with pytest.raises(ws.InputError, match="file name"):
        ws.read('scene "A" bar rod { travel = 1 }')


def test_what_is_pickled_and_copied() -> None:
    for signal in (velocity, pickle.loads(pickle.dumps(velocity)), copy.deepcopy(velocity)):
        assert signal("3/2") == velocity("3/2")
    problem = pickle.loads(pickle.dumps(ws.scene("rigid-mass", mu="1/4")))
    assert problem.title == mass.title and problem.symbols == []
    value = velocity.digits(1)
    assert copy.deepcopy([value, mass, curve])[0] is value
    assert f"{value:.3f} {value}" == f"0.368 {value}"


def test_a_thread_that_waits() -> None:
    asking = threading.Thread(target=lambda: velocity.digits(300, 3000))
    asking.start()
    assert velocity(1) == float(velocity.digits(1))
    asking.join()


def test_damaged_folders(tmp_path: Path) -> None:
    def sweep() -> list[float]:
        return list(ws.sweep("rigid-mass", {"mu": [1, 2, 3]}, at=1, quantities="velocity", folder=tmp_path, chunk=1).iloc[:, 1])

    told = sweep()
    first = sorted(tmp_path.glob("rows-*.parquet"))[0]
    first.write_bytes(first.read_bytes()[:50])
    assert sweep() == told
    (tmp_path / "sweep.json").write_text('{"request": 1')
    with pytest.raises(ws.InputError, match="another sweep"):
        sweep()


def test_tolerances_of_all_kinds() -> None:
    expected = velocity.values([0.5], within="1e-3").bound
    kinds: list[Any] = [1e-3, Fraction(1, 1000), Decimal("0.001"), np.float64(0.001)]
    for own in kinds:
        assert velocity.values([0.5], within=own).bound == expected
        assert velocity.compiled(0, 1, within=own).bound == velocity.compiled(0, 1, within="1e-3").bound
    wrong: list[Any] = [0, -1, float("inf"), float("nan"), "abc"]
    for within in wrong:
        with pytest.raises(ws.InputError, match="is not a tolerance") as caught:
            velocity.values([0.5], within=within)
        assert caught.value.remedy


def test_lists_of_times_tell_what_is_wrong_in_them() -> None:
    assert velocity.values([Fraction(1, 3), "1/2"]).values.shape == (2,)
    nested: Any = [[0.5], [1.5]]
    assert velocity.values(nested).values.shape == (2, 1)
    with pytest.raises(ws.InputError, match="more than 10000 digits"):
        velocity.values([0.5, 10**20000])
    with pytest.raises(ws.InputError, match="is not a number"):
        velocity.values([0.5, None])  # type: ignore[list-item]


def test_axes_of_sweeps_have_doubles() -> None:
    for values in ([10**400], "1e400,1"):
        with pytest.raises(ws.InputError, match="beyond the range of doubles"):
            ws.sweep("rigid-mass", over={"mu": values}, at=1)
    with pytest.raises(ws.InputError, match="no values for `mu`"):
        ws.sweep("rigid-mass", over={"mu": []}, at=1)


def test_pictures_that_cannot_be_drawn_have_a_remedy() -> None:
    unseen = 'scene "A"\nbar rod { impedance = 1, travel = 1, velocity = 1 }\nline free - rod | fixed'
    with pytest.raises(ws.UnsupportedError, match="no observables") as caught:
        ws.read(unseen).plot()
    assert caught.value.remedy

"""Sweeps: rows are those of single calls, the same bytes on any engine, and none is lost or done twice."""

import os
import pathlib
import pickle
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import dask.distributed
import numpy as np
import pandas
import pytest

import wavestep as ws
from wavestep import _sweep

MASS = "mass-on-fixed-bar"
ROD = """scene "A"
symbol z > 0
symbol v > 0
bar rod { impedance = z, travel = 1, velocity = v }
line free - rod | fixed
observe push = force(rod.right)
"""
OVER: dict[str, Any] = {"mu": "1/4..4:60"}
ASKED: dict[str, Any] = {"at": ["1", 3], "quantities": "velocity", "max": "strain_fixed", "end": 5}


def same_bytes(one: pandas.DataFrame, other: pandas.DataFrame) -> bool:
    """Whether two tables are the same to the last bit."""
    return pickle.dumps(one.to_dict("list")) == pickle.dumps(other.to_dict("list")) and all(
        one[name].to_numpy().tobytes() == other[name].to_numpy().tobytes() for name in one.columns[:-2]
    )


def sweep(**options: Any) -> pandas.DataFrame:
    frame: pandas.DataFrame = ws.sweep(MASS, OVER, **{**ASKED, **options})
    return frame


@pytest.fixture(scope="module")
def client() -> Iterator[Any]:
    with (
        dask.distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0"
        ) as cluster,
        dask.distributed.Client(cluster) as client,
    ):
        yield client


# First, before the module has its client.
def test_dask_needs_a_client() -> None:
    with pytest.raises(ws.InputError, match="there is no client"):
        sweep(engine="dask")


def test_rows_are_those_of_single_calls() -> None:
    values: list[Any] = [1, 0.3, "1/3", Fraction(7, 5), np.float64(2.5)]
    frame = ws.sweep(MASS, {"mu": values}, **ASKED)
    assert list(frame.columns) == [
        "mu", "velocity(1)", "velocity(3)", "max(strain_fixed)", "time of max(strain_fixed)", "note", "error"
    ]  # fmt: skip
    for (_, row), mu in zip(frame.iterrows(), values, strict=True):
        problem = ws.scene(MASS, mu=mu)
        velocity = problem.signal("velocity")
        most = problem.signal("strain_fixed").maximum(0, 5, digits=17)
        assert (row["velocity(1)"], row["velocity(3)"]) == (velocity(1), velocity(3))
        assert row["max(strain_fixed)"] == float(most.value)
        assert row["time of max(strain_fixed)"] == float(most.places[0].time)
        assert row["mu"] == float(Fraction(mu))
    assert frame["error"].isna().all()


def test_scenes_are_given_in_any_way(tmp_path: pathlib.Path) -> None:
    file = tmp_path / "rod.wave"
    file.write_text(ROD)
    for scene in (ROD, file, str(file), ws.read(ROD), ws.read(ROD, z=5)):
        over = {"z": [2], "v": [3]} if not isinstance(scene, ws.Problem) or "z" in scene.symbols else {"v": [3]}
        assert ws.sweep(scene, over, at=1)["push(1)"][0] == (6 if "z" in over else 15)


def test_datasets_have_the_symbols_as_axes() -> None:
    data = ws.sweep(ROD, {"z": [1, 2], "v": "1..3:3"}, at=1, dataset=True)
    assert data.sizes == {"z": 2, "v": 3}
    assert data["push(1)"].sel(z=2).values.tolist() == [2, 4, 6]
    assert (data["error"] == "").all() and (data["note"] == "").all()


def test_rows_say_what_they_take_for_granted(client: Any, tmp_path: pathlib.Path) -> None:
    parted = ROD.replace("v }", "v, strain = 1 }")
    places: list[tuple[Any, Any]] = [("threads", None), ("dask", tmp_path), ("threads", tmp_path)]
    tables = [
        ws.sweep(parted, {"z": [1], "v": ["1/2", 2]}, at="1/2", folder=folder, engine=engine, client=client)
        for engine, folder in places
    ]
    for frame in tables:
        assert frame["note"].isna().tolist() == [False, True], frame["note"].tolist()
        assert "between rod and wall is in tension" in frame["note"][0]


def test_rows_without_an_answer_say_why() -> None:
    frame = ws.sweep(MASS, {"mu": [1, -1, 2]}, at=1, quantities="velocity")
    assert frame["error"].isna().tolist() == [True, False, True]
    assert np.isnan(frame["velocity(1)"][1]) and frame["velocity(1)"].notna().sum() == 2


def test_threads_change_nothing() -> None:
    one = sweep(threads=1)
    assert len(one) == 60 and all(same_bytes(sweep(threads=n), one) for n in (2, 5))


def test_sweeps_are_pickled() -> None:
    asked = _sweep._sweep(MASS, OVER, [0.1, "3"], [], ("velocity", "velocity"), 0, 2.5, False)
    assert pickle.loads(pickle.dumps(asked)).request == asked.request


@pytest.mark.parametrize("engine", ["threads", "dask"])
def test_only_what_is_missing_is_done_again(
    engine: Any, client: Any, tmp_path: pathlib.Path
) -> None:
    whole = sweep()
    assert same_bytes(sweep(folder=tmp_path, chunk=7, engine=engine, client=client), whole)
    files = sorted(tmp_path.glob("*.parquet"))
    assert len(files) == 9
    times = {file: file.stat().st_mtime_ns for file in files}
    for lost in files[2:4]:
        lost.unlink()
    # The chunks of the folder hold, whatever their size would be now.
    assert same_bytes(sweep(folder=tmp_path, chunk=50, engine=engine, client=client), whole)
    again = [file for file in files if file.stat().st_mtime_ns != times[file]]
    assert again == files[2:4] and sorted(tmp_path.glob("*.parquet")) == files
    with pytest.raises(ws.InputError, match="holds rows of another sweep"):
        sweep(folder=tmp_path, end=6)


@pytest.mark.skipif(sys.platform == "win32", reason="signals differ")
def test_an_interrupted_sweep_is_resumed(tmp_path: pathlib.Path) -> None:
    code = f"""
import signal
import wavestep as ws
# A process that was begun in the background may have its interrupts ignored.
signal.signal(signal.SIGINT, signal.default_int_handler)
try:
    ws.sweep({MASS!r}, {{"mu": "1/4..4:1000"}}, max="strain_fixed", end=8, folder={str(tmp_path)!r}, chunk=10)
except KeyboardInterrupt:
    print("stopped")
"""
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    while len(list(tmp_path.glob("*.parquet"))) < 3:
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    assert process.communicate(timeout=30)[0] == "stopped\n"
    done = {file: file.stat().st_mtime_ns for file in tmp_path.glob("*.parquet")}
    assert 3 <= len(done) < 100
    ws.sweep(MASS, {"mu": "1/4..4:1000"}, max="strain_fixed", end=8, folder=tmp_path)
    assert len(list(tmp_path.glob("*.parquet"))) == 100
    assert all(file.stat().st_mtime_ns == when for file, when in done.items())


def kill_one(client: Any, folder: pathlib.Path, after: int) -> threading.Thread:
    """Kills the process of a worker once so many chunks are done."""
    (victim, *_) = client.run(os.getpid).values()

    def kill() -> None:
        while len(list(folder.glob("*.parquet"))) < after:
            time.sleep(0.005)
        os.kill(victim, signal.SIGKILL)

    thread = threading.Thread(target=kill)
    thread.start()
    return thread


@pytest.mark.skipif(sys.platform == "win32", reason="signals differ")
def test_a_killed_worker_loses_nothing(client: Any, tmp_path: pathlib.Path) -> None:
    over: Any = {"mu": "1/4..4:400"}
    asked: Any = {"max": "strain_fixed", "end": 8}
    before = set(client.run(os.getpid).values())
    killing = kill_one(client, tmp_path, after=5)
    frame = ws.sweep(MASS, over, **asked, engine="dask", client=client, folder=tmp_path, chunk=10)
    killing.join()
    assert same_bytes(frame, ws.sweep(MASS, over, **asked))
    assert len(list(tmp_path.glob("*.parquet"))) == 40
    client.wait_for_workers(2)
    assert len(before & set(client.run(os.getpid).values())) == 1


def test_lazy_frames_work_out_what_is_asked_for(client: Any, tmp_path: pathlib.Path) -> None:
    frame: Any = ws.sweep(MASS, OVER, **ASKED, engine="dask", lazy=True, folder=tmp_path, chunk=7)
    assert frame.npartitions == 9 and not list(tmp_path.glob("*.parquet"))
    whole = sweep()
    assert same_bytes(frame.partitions[1].compute(), whole[7:14])
    assert len(list(tmp_path.glob("*.parquet"))) == 1
    assert same_bytes(frame.compute(), whole)
    assert frame.loc[20:22].compute()["mu"].tolist() == whole["mu"][20:23].tolist()


def test_chunks_take_about_the_same_time() -> None:
    asked = _sweep._sweep(MASS, {"mu": "1/4..4:5000"}, 1, [], ([], []), 0, None, False)
    ranges = _sweep._ranges(asked, None, None, is_estimated=True)
    assert ranges[0][0] == 0 and ranges[-1][1] == 5000 and 1 < len(ranges) <= 65
    assert all(one[1] == other[0] for one, other in zip(ranges, ranges[1:], strict=False))


BAD: dict[str, tuple[Callable[[], object], str]] = {
    "scene": (lambda: ws.sweep("rigid-mas", OVER, at=1), "rigid-mass"),
    "symbol": (lambda: ws.sweep(MASS, {"nu": [1]}, at=1), "its symbols are mu"),
    "twice": (lambda: ws.sweep(ws.scene(MASS, mu=1), OVER, at=1), "two values are given for `mu`"),
    "no symbol": (lambda: ws.sweep(MASS, {}, at=1), "give values by symbol"),
    "no values": (lambda: ws.sweep(MASS, {"mu": []}, at=1), "there are no values for `mu`"),
    "one value": (lambda: ws.sweep(MASS, {"mu": 1}, at=1), "not a list"),  # type: ignore[dict-item]
    "range": (lambda: ws.sweep(MASS, {"mu": "2..1:3"}, at=1), "is empty"),
    "text": (lambda: ws.sweep(MASS, {"mu": ["one"]}, at=1), "mu"),
    "nan": (lambda: ws.sweep(MASS, {"mu": [float("nan")]}, at=1), "finite"),
    "nothing": (lambda: ws.sweep(MASS, OVER), "give `at`"),
    "quantity": (lambda: ws.sweep(MASS, OVER, at=1, quantities="velocty"), "velocity"),
    "no time": (lambda: ws.sweep(MASS, OVER, contacts=True, quantities="velocity"), "need times"),
    "time": (lambda: ws.sweep(MASS, OVER, at="x"), "at:1:1"),
    "time twice": (lambda: ws.sweep(MASS, OVER, at=[1, "1"]), "twice"),
    "window": (lambda: ws.sweep(MASS, OVER, max="velocity", begin=3, end=2), "is empty"),
    "early": (lambda: ws.sweep(MASS, OVER, at=-1), "from 0 on"),
    "many": (lambda: ws.sweep(ROD, {"z": "1..2:2000", "v": "1..2:2000"}, at=1), "in parts"),
    "many values": (lambda: ws.sweep(MASS, {"mu": "1..2:1000000000"}, at=1), "more than 1000000"),
    "engine": (lambda: ws.sweep(MASS, OVER, at=1, engine="spark"), "dask"),  # type: ignore[arg-type]
    "threads": (lambda: ws.sweep(MASS, OVER, at=1, threads=0), "from 1 on"),
    "lazy": (lambda: ws.sweep(MASS, OVER, at=1, lazy=True), "engine"),
    "lazy dataset": (
        lambda: ws.sweep(MASS, OVER, at=1, lazy=True, dataset=True, engine="dask"),
        "is a frame",
    ),
}


@pytest.mark.parametrize("what", BAD)
def test_bad_input_is_told_with_a_remedy(what: str) -> None:
    call, told = BAD[what]
    with pytest.raises(ws.InputError) as caught:
        call()
    message = str(caught.value)
    assert told in message and "--" not in message, message
    assert caught.value.remedy or caught.value.diagnostics or "give " in message

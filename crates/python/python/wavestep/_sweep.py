"""Sweeps: a scene at many values of its symbols, on the cores of this machine or on a Dask cluster."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from itertools import chain
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from ._errors import InputError
from ._native import Problem, _Sweep

if TYPE_CHECKING:
    from pathlib import Path

    from pandas import DataFrame as _DataFrame
    from xarray import Dataset as _Dataset

    from ._native import _Columns, _Number

    _Scene: TypeAlias = Problem | str | os.PathLike[str]
    _Over: TypeAlias = Mapping[str, str | Iterable[_Number]]
    _Range: TypeAlias = tuple[int, int]

# The columns that hold text, at the end of the table.
_TEXTS = ("note", "error")

# Seconds that a chunk should take, and into how many a short sweep is cut.
_LEAST, _MOST, _CHUNKS = 0.1, 2.0, 64

# Rows that are timed for the estimate, and for how many seconds at most.
_TIMED, _TIMED_FOR = 16, 2.0


def sweep(
    scene: _Scene,
    over: _Over,
    *,
    at: _Number | Iterable[_Number] = (),
    quantities: str | Iterable[str] = (),
    max: str | Iterable[str] = (),
    min: str | Iterable[str] = (),
    contacts: bool = False,
    begin: _Number = 0,
    end: _Number | None = None,
    engine: Literal["threads", "dask"] = "threads",
    threads: int | None = None,
    client: Any = None,
    folder: str | os.PathLike[str] | None = None,
    chunk: int | None = None,
    progress: bool = True,
    dataset: bool = False,
    lazy: bool = False,
) -> Any:
    """A table with a row for each combination of values of a scene's symbols; the last symbol changes fastest.

    It is a frame of pandas, or with ``dataset=True`` a dataset of xarray with the symbols as coordinates.

    >>> import wavestep as ws
    >>> ws.sweep("saint-venant", over={"mu": [1, "3/2", 2]}, contacts=True)["contact time hammer-rod"].tolist()
    [3.067667641618306, 2.683262356122621, 2.5045789097221833]

    ``over`` has values by symbol: a list, or text such as ``"1..4:7"`` (seven from 1 to 4) or ``"1/10..10:25:log"``. The
    columns are those of the command `wavestep sweep`:

    - ``at``: values of ``quantities`` at these times, or of all observables;
    - ``max``, ``min``: extrema of these quantities from ``begin`` to ``end``, each with the first time at which it is
      taken; without ``end`` to the end of the scene's usual window;
    - ``contacts``: how often each contact closes, duration and impulse of its first contact, and the coefficient of
      restitution;
    - ``note``: what the row takes for granted, ``error``: why it has no values.

    ``threads`` are as many as there are cores where nothing is said, and ``progress`` shows a bar where tqdm is installed.
    ``folder`` keeps finished chunks, so that an interrupted sweep is resumed with the chunks that it began with; ``chunk``
    is their number of rows, else they take about the same time. With ``engine="dask"`` the workers of ``client``, or of
    the current one, do the work; ``lazy=True`` gives a frame of Dask that works out its chunks when they are asked for.
    """
    from pathlib import Path

    _check_engine(engine, threads, chunk, lazy, dataset)
    asked = _sweep(scene, over, at, quantities, (max, min), begin, end, contacts)
    place = None if folder is None else Path(folder).absolute()
    ranges = _ranges(asked, place, chunk, is_estimated=engine == "dask" or place is not None)
    if lazy:
        return _lazy(asked, ranges, place)
    parts = {part: found for part in ranges if (found := _kept(asked, place, part)) is not None}
    missing = [part for part in ranges if part not in parts]
    with _progress(len(asked), progress) as tell:
        tell(sum(stop - start for start, stop in parts))

        def add(part: _Range, found: _Columns) -> None:
            parts[part] = found
            tell(part[1] - part[0])

        if engine == "dask":
            _on_dask(asked, missing, place, client, add)
        else:
            _on_threads(asked, missing, place, threads, add)
    table = _joined([parts[part] for part in ranges])
    return _dataset(asked, table) if dataset else _frame(table)


def _check_engine(
    engine: str, threads: int | None, chunk: int | None, lazy: bool, dataset: bool
) -> None:
    if engine not in ("threads", "dask"):
        raise InputError(f"there is no engine `{engine}`", 'give "threads" or "dask"')
    for name, count in (("threads", threads), ("chunk", chunk)):
        if count is not None and count < 1:
            raise InputError(f"`{name}` is {count}", "give a whole number from 1 on, or leave it out")
    if lazy and engine != "dask":
        raise InputError("only Dask works lazily", 'add engine="dask"')
    if lazy and dataset:
        raise InputError("a lazy sweep is a frame", "leave out `lazy` or `dataset`")


def _sweep(
    scene: _Scene,
    over: _Over,
    at: Any,
    quantities: str | Iterable[str],
    extrema: tuple[str | Iterable[str], str | Iterable[str]],
    begin: _Number,
    end: _Number | None,
    contacts: bool,
) -> _Sweep:
    """What is asked, checked."""
    if not isinstance(over, Mapping) or not over:
        raise InputError("`over` names no symbol", 'give values by symbol, as in over={"mu": [1, 2]}')
    times = [_called(time) for time in _several(at)]
    largest, smallest = map(_names, extrema)
    names = _names(quantities)
    if not (times or largest or smallest or contacts):
        raise InputError("nothing is asked", "give `at`, `max`, `min` or contacts=True")
    if names and not times:
        raise InputError("`quantities` need times", "give `at`, or name them in `max` or `min`")
    if len({label for label, _ in times}) < len(times):
        raise InputError("a time is given twice", "give each time in `at` once")
    source, values = _source(scene)
    last = None if end is None else _called(end)
    pairs = list(over.items())
    return _Sweep(source, values, pairs, times, names, (largest, smallest), _called(begin), last, contacts)


def _source(scene: _Scene) -> tuple[tuple[str, str], dict[str, Any]]:
    """What the scene is called and its text, and the values that are put in already."""
    import wavestep

    if isinstance(scene, str) and not set("\n./\\") & set(scene):
        scene = wavestep.scene(scene)
    if isinstance(scene, Problem):
        return scene._source()
    if not isinstance(scene, (str, os.PathLike)):
        raise InputError("this is no scene", "give a problem, the name of a scene, a file or a text")
    return wavestep._text(scene), {}


def _several(values: Any) -> list[Any]:
    """A list, also of one time."""
    is_one = not isinstance(values, Iterable) or isinstance(values, str)
    # Arrays and quantities of pint say how many dimensions they have.
    return [values] if is_one or getattr(values, "ndim", 1) == 0 else list(values)


def _names(names: str | Iterable[str]) -> list[str]:
    return [name.strip() for name in _several(names)]


def _called(time: Any) -> tuple[str, Any]:
    """A time with the name that columns give it."""
    return str(time).strip(), time


# ---- Chunks ------------------------------------------------------------------------------------------


def _rows(asked: _Sweep, part: _Range) -> _Columns:
    """The columns of some rows, worked out on this thread."""
    found: _Columns = {}
    asked.run([part], 1, lambda _part, columns: found.update(columns))
    return found


def _ranges(asked: _Sweep, folder: Path | None, chunk: int | None, is_estimated: bool) -> list[_Range]:
    """The chunks: those that the folder says, or new ones, which the folder then holds."""
    import json

    count = len(asked)
    file = folder and folder / "sweep.json"
    if file and file.exists():
        try:
            held = json.loads(file.read_text(encoding="utf-8"))
            is_same = held["request"] == json.loads(asked.request)
            ends: list[int] = held["ends"]
            is_whole = [0, *ends] == sorted({0, *ends}) and ends[-1] == count
        except (ValueError, KeyError, TypeError, IndexError):
            is_same = is_whole = False
        if not (is_same and is_whole):
            raise InputError(f"`{folder}` holds rows of another sweep", "name another folder, or delete this one")
    elif chunk or not is_estimated or count <= _CHUNKS:
        size = chunk or -(-count // _CHUNKS)
        ends = [*range(size, count, size), count]
    else:
        ends = _estimated_ends(asked)
    if file and not file.exists():
        file.parent.mkdir(parents=True, exist_ok=True)
        held = {"request": json.loads(asked.request), "ends": ends}
        _write(file, lambda path: path.write_text(json.dumps(held), encoding="utf-8"))
    return list(zip([0, *ends], ends, strict=False))


def _estimated_ends(asked: _Sweep) -> list[int]:
    """Where chunks end that take about the same time, judging by some rows between which it is interpolated."""
    import numpy

    count, begun = len(asked), time.perf_counter()
    costs: dict[int, float] = {}
    # From coarse to fine, so that those that are timed are spread where time is short.
    for i in sorted(range(_TIMED), key=lambda i: f"{i:04b}"[::-1]):
        row, started = i * (count - 1) // (_TIMED - 1), time.perf_counter()
        _rows(asked, (row, row + 1))
        costs[row] = time.perf_counter() - started
        if time.perf_counter() - begun > _TIMED_FOR:
            break
    known = sorted(costs)
    until = numpy.interp(range(count), known, [costs[row] for row in known]).cumsum()
    chunks = until[-1] / min(max(until[-1] / _CHUNKS, _LEAST), _MOST)
    cuts = numpy.searchsorted(until, numpy.arange(1, chunks) * (until[-1] / chunks))
    return [*sorted({int(cut) for cut in cuts if 0 < cut < count}), count]


def _file(folder: Path, part: _Range) -> Path:
    return folder / "rows-{:07}-{:07}.parquet".format(*part)


def _kept(asked: _Sweep, folder: Path | None, part: _Range) -> _Columns | None:
    """A chunk that is done already; one whose file is damaged is not."""
    if folder is None or not _file(folder, part).exists():
        return None
    from pyarrow import ArrowException, parquet

    try:
        table = parquet.read_table(_file(folder, part))
    except (ArrowException, OSError):
        return None
    if table.num_rows != part[1] - part[0] or set(table.column_names) != {*asked.columns, *_TEXTS}:
        return None
    return {
        name: table[name].to_pylist() if name in _TEXTS else table[name].to_numpy() for name in table.column_names
    }


def _keep(folder: Path | None, part: _Range, found: _Columns) -> None:
    """Writes a chunk."""
    if folder is None:
        return
    import pyarrow
    from pyarrow import parquet

    texts = {name: pyarrow.array(found[name], pyarrow.string()) for name in _TEXTS}
    table = pyarrow.table({**found, **texts})
    _write(_file(folder, part), lambda path: parquet.write_table(table, path))


def _write(file: Path, write: Callable[[Path], object]) -> None:
    """Writes a file that is there whole or not at all."""
    from uuid import uuid4

    beside = file.with_name(f"{file.name}.{uuid4().hex}.part")
    write(beside)
    os.replace(beside, file)


def _chunk(asked: _Sweep, part: _Range, folder: Path | None) -> _Columns:
    """A chunk on a worker."""
    found = _kept(asked, folder, part)
    if found is None:
        found = _rows(asked, part)
        _keep(folder, part, found)
    return found


# ---- Engines -----------------------------------------------------------------------------------------


def _on_threads(
    asked: _Sweep,
    missing: list[_Range],
    folder: Path | None,
    threads: int | None,
    add: Callable[[_Range, _Columns], None],
) -> None:
    def done(part: _Range, found: _Columns) -> None:
        _keep(folder, part, found)
        add(part, found)

    asked.run(missing, threads, done)


def _tasks(asked: _Sweep, ranges: list[_Range], folder: Path | None) -> list[Any]:
    """Chunks as tasks of Dask, which share what is asked."""
    import dask

    shared = dask.delayed(asked)
    task = dask.delayed(_chunk)
    return [task(shared, part, folder) for part in ranges]


def _on_dask(
    asked: _Sweep,
    missing: list[_Range],
    folder: Path | None,
    client: Any,
    add: Callable[[_Range, _Columns], None],
) -> None:
    from dask import distributed

    try:
        client = client or distributed.default_client()
    except ValueError:
        remedy = "give `client`, or make one first: dask.distributed.Client()"
        raise InputError("there is no client of a Dask cluster", remedy) from None
    futures = client.compute(_tasks(asked, missing, folder))
    parts = {future.key: part for future, part in zip(futures, missing, strict=True)}
    for future in distributed.as_completed(futures):
        add(parts[future.key], future.result())
        # What is here is not worked out again if its worker is lost.
        future.release()


def _lazy(asked: _Sweep, ranges: list[_Range], folder: Path | None) -> Any:
    import dask
    import dask.dataframe
    import numpy

    frame = dask.delayed(_frame)
    frames = [
        frame(task, start) for task, (start, _) in zip(_tasks(asked, ranges, folder), ranges, strict=True)
    ]
    divisions = [*(start for start, _ in ranges), len(asked) - 1]
    empty: _Columns = dict.fromkeys(asked.columns, numpy.empty(0))
    return dask.dataframe.from_delayed(
        frames, meta=_frame({**empty, "note": [], "error": []}), divisions=tuple(divisions)
    )


# ---- Tables ------------------------------------------------------------------------------------------


def _joined(parts: list[_Columns]) -> _Columns:
    import numpy

    def joined(name: str) -> Any:
        columns = [part[name] for part in parts]
        return list(chain.from_iterable(columns)) if name in _TEXTS else numpy.concatenate(columns)

    return {name: joined(name) for name in parts[0]}


def _frame(table: _Columns, start: int = 0) -> _DataFrame:
    import pandas

    texts = {name: pandas.array(table[name], dtype="string") for name in _TEXTS}
    index = pandas.RangeIndex(start, start + len(table["error"]))
    return pandas.DataFrame({**table, **texts}, index=index)


def _dataset(asked: _Sweep, table: _Columns) -> _Dataset:
    """The table as arrays over the axes; an empty text where there is no note or error."""
    import numpy
    import xarray

    axes = dict(asked.axes)
    shape = [len(values) for values in axes.values()]
    columns = {**table, **{name: numpy.array([text or "" for text in table[name]]) for name in _TEXTS}}
    arrays = {
        name: (list(axes), numpy.reshape(column, shape))
        for name, column in columns.items()
        if name not in axes
    }
    return xarray.Dataset(arrays, coords=axes)


@contextmanager
def _progress(count: int, is_shown: bool) -> Iterator[Callable[[int], object]]:
    """Is told how many more rows are done; a bar in notebooks and terminals where tqdm is installed."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        is_shown = False
    if is_shown:
        with tqdm(total=count, unit="row", disable=None) as bar:
            yield bar.update
    else:
        yield lambda rows: None

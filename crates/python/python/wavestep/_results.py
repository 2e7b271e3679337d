"""Results as dataclasses."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from fractions import Fraction

    from pandas import DataFrame as _DataFrame

    from ._native import _Array, Value


def _frame(rows: list[dict[str, Any]]) -> _DataFrame:
    import pandas

    return pandas.DataFrame(rows)


@dataclass(frozen=True)
class Root:
    """Where a signal takes a value (``begin`` is ``end``, but for intervals), or jumps over it."""

    kind: Literal["simple", "double", "end", "arrival", "jump", "interval", "undecided"]
    begin: Value
    end: Value
    rises: bool | None

    @property
    def time(self) -> Value:
        """The first time."""
        return self.begin


@dataclass(frozen=True)
class Place:
    """Where an extremum is taken or, if it is a limit from earlier times alone, approached."""

    kind: Literal["critical", "end", "arrival", "plateau", "undecided"]
    begin: Value
    end: Value
    attained: bool

    @property
    def time(self) -> Value:
        """The first time."""
        return self.begin


@dataclass(frozen=True)
class Extremum:
    """The largest or smallest value of a window, with all places that cannot be told apart."""

    value: Value
    places: tuple[Place, ...]


@dataclass(frozen=True)
class Body:
    """A part of the line that moves by itself, with what it holds; ``None`` where that is infinite."""

    elements: tuple[str, ...]
    energy: Value | None
    momentum: Value | None
    velocity: Value | None
    vibration: Value | None


@dataclass(frozen=True)
class Event:
    """Something that happens at a contact; forces and velocities just before and just after."""

    kind: Literal["impact", "opening", "release", "closing"]
    between: tuple[str, str]
    time: Value
    forces: tuple[Value, Value]
    velocities: tuple[tuple[Value, Value], tuple[Value, Value]]
    bodies: tuple[Body, ...]


@dataclass(frozen=True)
class Contact:
    """How long a contact was closed each time, ``None`` where it still is, with which impulse."""

    between: tuple[str, str]
    durations: tuple[Value | None, ...]
    impulses: tuple[Value, ...]
    restitution: Value | None


@dataclass(frozen=True)
class History:
    """What contacts did: all that happened, until ``until`` where nothing is known of later times."""

    events: tuple[Event, ...]
    contacts: tuple[Contact, ...]
    ending: Literal["parted", "followed", "no contact"]
    until: Value | None
    assumptions: tuple[str, ...]

    def to_frame(self) -> _DataFrame:
        """The events as a table of doubles."""
        return _frame(
            [
                {
                    "kind": event.kind,
                    "left": event.between[0],
                    "right": event.between[1],
                    "time": float(event.time),
                    "force_before": float(event.forces[0]),
                    "force_after": float(event.forces[1]),
                }
                for event in self.events
            ]
        )

    def _repr_html_(self) -> str:
        from ._convert import table_of

        rows = [[event.kind, " – ".join(event.between), str(event.time)] for event in self.events]
        return table_of(["event", "between", "time"], rows)


@dataclass(frozen=True)
class BarField:
    """The fields of a bar at the nodes ``x``, or as averages over the cells between them."""

    name: str
    x: _Array
    velocity: _Array
    strain: _Array
    displacement: _Array
    force: _Array
    bounds: dict[str, _Array]
    """A proven bound on the error of every value, by the names of the fields."""


@dataclass(frozen=True)
class Field:
    """The fields of a scene at a time."""

    time: Fraction
    bars: tuple[BarField, ...]

    def to_frame(self) -> _DataFrame:
        """All bars in one table; the left end of each cell stands for an average over it."""
        import pandas

        frames = []
        for bar in self.bars:
            fields = {name: getattr(bar, name) for name in bar.bounds}
            columns = {"bar": bar.name, "x": bar.x[: len(bar.velocity)], **fields}
            frames.append(pandas.DataFrame(columns))
        return pandas.concat(frames, ignore_index=True)


@dataclass(frozen=True)
class Values:
    """Values in doubles with a proven bound, beyond half a unit in the last place; ``None`` where none is proven."""

    values: _Array
    bound: float | None
    method: str
    law: str

    @property
    def errors(self) -> _Array:
        """A bound on the error of each value; infinite where none is proven."""
        import numpy

        bound = numpy.inf if self.bound is None else self.bound
        errors: _Array = bound + numpy.spacing(numpy.abs(self.values)) / 2
        return errors


@dataclass(frozen=True, repr=False)
class Picture:
    """A picture that notebooks show."""

    svg: str

    def _repr_svg_(self) -> str:
        return self.svg

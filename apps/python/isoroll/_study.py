"""Studies of all orbits of one energy: sections, chaos."""

from __future__ import annotations

from ctypes import byref, c_void_p
from typing import Any, Dict, NamedTuple, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors
from ._library import New, Notes, check, context, encoded, interruptible, lib, whole
from ._scene import SceneLike, as_scene
from ._table import Table, doubles, from_record, new_record


_MOST_STARTS, _MOST_ROWS = 10**7, 10**9


def _axis(axis: Optional[int]) -> int:
    if axis is None:
        return -1
    if axis not in (1, 2, 3):
        raise _errors.BadArgument(f"axis is {axis}: it must be 1, 2 or 3, or None: the global section")
    return int(axis) - 1


def _points(at: Optional[ArrayLike]) -> NDArray[np.float64]:
    points = np.ascontiguousarray(np.empty((0, 2)) if at is None else doubles("at", at))
    if points.ndim > 2 or points.shape[-1] != 2:
        raise _errors.BadArgument(f"at has shape {points.shape}, it must be (starts, 2): l, x")
    return points.reshape(-1, 2)


def _tolerance(tolerance: Optional[float]) -> float:
    """For C, where 0 means the scene's. From the caller 0 and nan are refused, as in run."""
    if tolerance is None:
        return 0.0
    if not float(tolerance) > 0:
        error = _errors.BadArgument(f"tolerance is {tolerance}, it must be a positive number")
        error.about = "tolerance"
        raise error
    return float(tolerance)


def _taken(pointer: int) -> New:
    new = new_record()
    new.value = pointer
    return new


def _orbits(starts: int, at: int, rows: int, what: str) -> int:
    """The number of starts, if the study is not out of reach: a slip of the hand would fill the memory."""
    number = whole("starts", starts, 0)
    if number > _MOST_STARTS:
        raise _errors.BadArgument(f"starts is {number}, it must be a whole number from 0 to {_MOST_STARTS}")
    if (number + at + 1) * rows > _MOST_ROWS:
        raise _errors.BadArgument(f"{what} is {rows}: with {number + at + 1} orbits these are more than 1e9 rows")
    return number


def _event(event: Optional[Tuple[str, float]]) -> Tuple[Optional[bytes], float]:
    if event is None:
        return None, 0.0
    if isinstance(event, str) or len(event) != 2 or not isinstance(event[0], str):
        raise _errors.BadArgument(f"event is {event!r:.60}: it must be (column, value), such as ('n1', 0)")
    return encoded(event[0]), float(event[1])


class Section(Table):
    """Crossings, a row each: columns orbit (from 0), crossing (from 1), t, tau, s, l, x, and the states asked for.

    point   the same crossings as the point finds them by itself, with the columns orbit, crossing, t, tau, s, l, x;
            None unless both models are integrated
    """

    point: Optional[Table] = None


def _section(record: New, point: New) -> Section:
    table = from_record(record, "section")
    result = Section(table.array, table.columns, table.lines, kind="section", record=table._record)
    result.point = from_record(point, "section") if point.value else None
    return result


def section(scene: SceneLike, *, crossings: int = 500, starts: int = 0, seed: int = 0,
            at: Optional[ArrayLike] = None, axis: Optional[int] = None, event: Optional[Tuple[str, float]] = None,
            models: str = "auto", states: Optional[str] = None, tolerance: Optional[float] = None,
            threads: int = 0) -> Section:
    """The Poincare section of a scene: what `isoroll section` writes.

    crossings  of each orbit
    starts     orbits of the same energy, spread evenly over the section, up to 10^7; seed: another choice of them
    at         shape (N, 2): (l, x) of further starts
    axis       1, 2, 3: the section n_axis = 0, increasing; None: the global one
    event      (column, value) in place of the axis: crossings where the column passes the value upwards
    models     "ball", "point", "both": those that are integrated, each by itself; "auto": both if the ball has a twin
    states     "ball", "point", "both": also the states in each row

    l is an angle in (-pi, pi], x is in (-1, 1); both models have the same l and x.
    """
    chosen, ctx, new, point, notes = as_scene(scene, {}), context(), new_record(), new_record(), Notes()
    points, rows = _points(at), whole("crossings", crossings, 1)
    if axis is not None and event is not None:
        raise _errors.BadArgument("axis or event, not both")

    def so_far() -> Optional[Section]:
        return _section(new, point) if new.value else None

    with interruptible(so_far):
        status = lib.iso_foreign_section(
            ctx, chosen.pointer, rows, _orbits(starts, len(points), rows, "crossings"),
            whole("seed", seed, 0), points.ctypes.data, len(points), _axis(axis),
            *_event(event), encoded(models),
            encoded(states) if states else None, _tolerance(tolerance),
            whole("threads", threads, 0, 1024), byref(new), byref(point), *notes.arguments)
    try:
        check(status, ctx)
    except _errors.IsorollError as error:
        error.partial = so_far()
        raise
    notes.tell()
    return _section(new, point)


class Share(NamedTuple):
    """The orbits spread over the section.

    orbits     those that were followed; `asked` were to be, `failed` failed
    share      the chaotic fraction of them; NaN if none was followed
    low, high  its 95 % confidence interval; undecided orbits are not chaotic at the low end, chaotic at the high end
    """

    orbits: int
    chaotic: int
    regular: int
    undecided: int
    failed: int
    asked: int
    share: float
    low: float
    high: float


class Chaos:
    """Which orbits are chaotic.

    verdict   of the scene's own orbit: "regular", "chaotic" or "undecided"
    verdicts  of all orbits, shape (orbits,), as words; orbit 0 is the scene's own
    orbits    a Table with a row for each orbit: orbit, l, x, verdict, disagree, then for each model that was
              integrated ball_exponent_t, ball_error_t, ball_megno, ball_gali2, ... (lib/foreign/foreign.h)
    share     a Share, or None without starts
    trace     {"ball": Table, "point": Table}: the indicators of the scene's own orbit by turns
    lines     what is known besides: "section", "integral", "failure", ...
    """

    def __init__(self, orbits: Table, trace: Dict[str, Table]) -> None:
        self.orbits, self.trace, self.lines = orbits, trace, orbits.lines
        names = [lib.iso_verdict_name(i).decode() for i in range(4)]
        self.verdicts = np.array(names)[orbits["verdict"].astype(int)]
        self.verdict = str(self.verdicts[0])
        self.share: Optional[Share] = None
        if "share" in self.lines:
            numbers = [float(self.lines[key]) for key in ("count", *Share._fields[1:])]
            self.share = Share(*(int(x) for x in numbers[:6]), *numbers[6:])

    def __getstate__(self) -> Dict[str, Any]:
        return {**self.__dict__, "lines": None}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self.__dict__.update(state)
        self.lines = self.orbits.lines

    def __repr__(self) -> str:
        return f"<isoroll.Chaos: {self.verdict}, {len(self.orbits)} orbits, {self.share}>"


def chaos(scene: SceneLike, *, turns: int = 3000, starts: int = 0, seed: int = 0, at: Optional[ArrayLike] = None,
          axis: Optional[int] = None, models: str = "auto", tolerance: Optional[float] = None,
          threads: int = 0, exponent_turns: int = 0) -> Chaos:
    """Which orbits are chaotic: exponents, MEGNO, GALI_2 and a verdict, as `isoroll chaos`. Arguments: see section.

    turns           at most, of each orbit. Exponents are per unit of t, tau and s.
    exponent_turns  a chaotic orbit goes on to so many turns, for its exponent; errors that are not known are NaN
    """
    chosen, ctx, new, trace, points = as_scene(scene, {}), context(), new_record(), (c_void_p * 2)(), _points(at)
    try:
        with interruptible():
            status = lib.iso_foreign_chaos(
                ctx, chosen.pointer, whole("turns", turns, 1, _MOST_ROWS),
                whole("exponent_turns", exponent_turns, 0, _MOST_ROWS), _orbits(starts, len(points), 1, "turns"),
                whole("seed", seed, 0),
                points.ctypes.data, len(points), _axis(axis), encoded(models), _tolerance(tolerance),
                whole("threads", threads, 0, 1024), byref(new), trace)
    finally:
        traces = {name: from_record(_taken(pointer)) for name, pointer in zip(("ball", "point"), trace) if pointer}
    check(status, ctx)
    return Chaos(from_record(new), traces)

"""Studies by their names; sections and chaos, of all orbits of one energy."""

from __future__ import annotations

import os
from ctypes import c_void_p
from typing import Any, Callable, Dict, Mapping, NamedTuple, Optional, Tuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors
from ._library import Notes, check, context, encoded, interruptible, lib, whole
from ._scene import SceneLike, as_scene
from ._table import Table, doubles, from_record, new_record

_MOST_STARTS, _MOST_ROWS = 10**7, 10**9
_Made = TypeVar("_Made")


def _text(name: str, value: Any) -> str:
    """An option as it is typed after the command."""
    if isinstance(value, (str, bytes, bool)):
        return "true" if value is True else os.fsdecode(value)
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    numbers = doubles(name, value)
    if numbers.ndim == 0:
        return repr(float(numbers))
    return ";".join(",".join(map(repr, row)) for row in np.atleast_2d(numbers).tolist())


def _run(scene: SceneLike, name: str, options: Mapping[str, Any], make: Callable[..., _Made]) -> _Made:
    """What `make` makes of the tables of a study; so also an exception's `partial`."""
    chosen, ctx, notes, made = as_scene(scene, {}), context(), Notes(), (c_void_p * 6)()
    given = {key.rstrip("_").replace("_", "-"): value for key, value in options.items()
             if value is not None and value is not False and not (key == "at" and np.size(value) == 0)}
    text = "\n".join(f"{key}={_text(key, value)}" for key, value in given.items())

    def found() -> Optional[_Made]:
        news = [new_record() for _ in made]
        for new, pointer in zip(news, made):
            new.value = pointer
        return make(*(from_record(new) if new.value else None for new in news)) if made[0] else None

    with interruptible(found):
        status = lib.iso_foreign_study(ctx, chosen.pointer, None, encoded(name), encoded(text), None, None, made,
                                       *notes.arguments)
    result = found()
    try:
        check(status, ctx)
    except _errors.IsorollError as error:
        error.partial = result
        raise
    notes.tell(4)
    return result  # type: ignore[return-value]


def study(scene: SceneLike, name: str, **options: Any) -> Tuple[Optional[Table], ...]:
    """Any study of a scene, with the options of the command of this name: "section", "chaos", ...

    options  as the command has them, exponent_turns=700 for --exponent-turns 700, as_="both" for --as both; True: one
             without an argument; None, False: not given

    Returns six tables, None in place of those that are not made (iso_foreign_study in lib/foreign/foreign.h). The
    lines of the first have the scene, and the result by the names of the command's --json.
    """
    return _run(scene, name, options, lambda *tables: tables)


def _points(at: Optional[ArrayLike]) -> NDArray[np.float64]:
    points = np.empty((0, 2)) if at is None else doubles("at", at)
    if points.ndim > 2 or points.shape[-1] != 2:
        raise _errors.BadArgument(f"at has shape {points.shape}, it must be (starts, 2): l, x")
    return points.reshape(-1, 2)


def _orbits(starts: int, at: int, rows: int, what: str) -> int:
    """The number of starts, if the study is not out of reach: a slip of the hand would fill the memory."""
    number = whole("starts", starts, 0)
    if number > _MOST_STARTS:
        raise _errors.BadArgument(f"starts is {number}, it must be a whole number from 0 to {_MOST_STARTS}")
    if (number + at + 1) * rows > _MOST_ROWS:
        raise _errors.BadArgument(f"{what} is {rows}: with {number + at + 1} orbits these are more than 1e9 rows")
    return number


def _event(event: Optional[Tuple[str, float]]) -> Optional[str]:
    if event is None:
        return None
    if isinstance(event, str) or len(event) != 2 or not isinstance(event[0], str):
        raise _errors.BadArgument(f"event is {event!r:.60}: it must be (column, value), such as ('n1', 0)")
    return f"{event[0]}={float(event[1])!r}"


def _model(models: str) -> Optional[str]:
    return None if models == "auto" else models


class Section(Table):
    """Crossings, a row each: columns orbit (from 0), crossing (from 1), t, tau, s, l, x, and the states asked for.

    point   the same crossings as the point finds them by itself, with the columns orbit, crossing, t, tau, s, l, x;
            None unless both models are integrated
    """

    point: Optional[Table] = None


def _section(table: Table, point: Optional[Table], *_unused: None) -> Section:
    result = Section(table.array, table.columns, table.lines, kind="section", record=table._record)
    result.point = point
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
    points, rows = _points(at), whole("crossings", crossings, 1)
    return _run(scene, "section", dict(
        crossings=rows, starts=_orbits(starts, len(points), rows, "crossings"), seed=seed, at=points, axis=axis,
        event=_event(event), model=_model(models), as_=states, tol=tolerance, threads=threads or None), _section)


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


_SHARE = ("followed", "chaotic_starts", "regular_starts", "undecided_starts", "failed", "starts", "chaotic", "low",
          "high")  # as the lines call them


class Chaos:
    """Which orbits are chaotic.

    verdict   of the scene's own orbit: "regular", "chaotic" or "undecided"
    verdicts  of all orbits, shape (orbits,), as words; orbit 0 is the scene's own
    orbits    a Table with a row for each orbit: orbit, l, x, verdict, disagree, then for each model that was
              integrated ball_exponent_t, ball_error_t, ball_megno, ball_gali2, ... (`isoroll list tables`)
    share     a Share, or None without starts
    trace     {"ball": Table, "point": Table}: the indicators of the scene's own orbit by turns
    lines     what is known besides, as `isoroll chaos --json` calls it: "section.axis", "integral", ...; "failure"
    """

    def __init__(self, orbits: Table, trace: Dict[str, Table]) -> None:
        self.orbits, self.trace, self.lines = orbits, trace, orbits.lines
        self.verdicts = orbits.words("verdict")
        self.verdict = str(self.verdicts[0])
        self.share: Optional[Share] = None
        if "share.starts" in self.lines:
            numbers = [float(self.lines.get("share." + key, "nan")) for key in _SHARE]
            self.share = Share(*(int(x) for x in numbers[:6]), *numbers[6:])

    def __getstate__(self) -> Dict[str, Any]:
        return {**self.__dict__, "lines": None}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self.__dict__.update(state)
        self.lines = self.orbits.lines

    def __repr__(self) -> str:
        return f"<isoroll.Chaos: {self.verdict}, {len(self.orbits)} orbits, {self.share}>"


def _chaos(orbits: Table, *traces: Optional[Table]) -> Chaos:
    return Chaos(orbits, {name: trace for name, trace in zip(("ball", "point"), traces) if trace is not None})


def chaos(scene: SceneLike, *, turns: int = 3000, starts: int = 0, seed: int = 0, at: Optional[ArrayLike] = None,
          axis: Optional[int] = None, models: str = "auto", tolerance: Optional[float] = None,
          threads: int = 0, exponent_turns: int = 0) -> Chaos:
    """Which orbits are chaotic: exponents, MEGNO, GALI_2 and a verdict, as `isoroll chaos`. Arguments: see section.

    turns           at most, of each orbit. Exponents are per unit of t, tau and s.
    exponent_turns  a chaotic orbit goes on to so many turns, for its exponent; errors that are not known are NaN
    """
    points = _points(at)
    return _run(scene, "chaos", dict(
        turns=whole("turns", turns, 1, _MOST_ROWS),
        exponent_turns=whole("exponent_turns", exponent_turns, 0, _MOST_ROWS),
        starts=_orbits(starts, len(points), 1, "turns"), seed=seed, at=points, axis=axis, model=_model(models),
        tol=tolerance, threads=threads or None), _chaos)

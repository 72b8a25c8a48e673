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
from ._kinds import Chaos, Section
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
    chosen, ctx, notes, made = as_scene(scene, {}), context(), Notes(), (c_void_p * 3)()
    given = {key.rstrip("_").replace("_", "-"): value for key, value in options.items()
             if value is not None and value is not False and not (key == "at" and np.size(value) == 0)}
    text = "\n".join(f"{key}={_text(key, value)}" for key, value in given.items())

    def found() -> Optional[_Made]:
        news = [new_record() for _ in made]
        for new, pointer in zip(news, made):
            new.value = pointer
        return make(*(from_record(new) if new.value else None for new in news)) if made[0] else None

    with interruptible(found):
        status = lib.iso_foreign_study(ctx, chosen.pointer, encoded(name), encoded(text), made, *notes.arguments)
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

    Returns three tables, None in place of those that are not made (iso_foreign_study in lib/foreign/foreign.h). The
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


def _section(table: Section, point: Optional[Table], _unused: None) -> Section:
    table.point = point
    return table


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


def _chaos(orbits: Chaos, *traces: Optional[Table]) -> Chaos:
    orbits.indicators = {name: trace for name, trace in zip(("ball", "point"), traces) if trace is not None}
    return orbits


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

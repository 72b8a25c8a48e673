"""Runs, orbits, batches."""

from __future__ import annotations

import threading
from ctypes import byref, c_char_p, c_void_p
from typing import Any, Dict, Iterable, List, Mapping, Optional, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors
from ._library import Monitor, New, Notes, Owned, check, context, encoded, interruptible, lib, whole
from ._scene import Scene, SceneLike, as_scene, as_scenes
from ._kinds import Trajectory
from ._lines import Lines
from ._study import ask
from ._table import Record, Table, doubles, new_record

_ERRORS = ("ball", "point", "t", "tau", "s")


def _times(times: ArrayLike) -> NDArray[np.float64]:
    return np.asarray(doubles("times", times), order="C")


def run(scene: SceneLike, times: Optional[ArrayLike] = None, *, backend: Optional[str] = None,
        method: Optional[str] = None, tol: Optional[float] = None, as_: Optional[str] = None,
        t_end: Optional[float] = None, step: Optional[float] = None, errors: bool = False,
        **changes: Any) -> Trajectory:
    """The trajectory of a scene: what `isoroll run` writes, to the bit.

    scene    a path, YAML text, a dict or a Scene
    times    shape (N,), in any order, t of a ball's scene, s of a point's; without it the scene's own grid
    backend  "ball", "point", "exact", "auto": what computes the orbit
    method   the integrator, or "auto"
    tol      largest relative error of one step, in [1e-15, 0.1]
    as_      "ball", "point", "both": which model is written
    t_end    last time, in place of the scene's
    step     time between rows, in place of the scene's
    errors   also find the largest errors of the rows, table.errors; this takes many times as long
    changes  columns, k, J, ...: other keywords of Scene

    Returns a table of shape (rows, columns). There are fewer rows than times if the ball loses contact: a warning
    says when. After a failure, error.partial has the rows before it.
    """
    changes.update({key: value for key, value in (("backend", backend), ("method", method), ("tol", tol),
                                                  ("as_", as_), ("t_end", t_end), ("step", step)) if value is not None})
    chosen, record = as_scene(scene, changes), None
    if times is not None:
        asked, new, ctx = np.atleast_1d(_times(times)).ravel(), new_record(), context()
        check(lib.iso_record_create(ctx, 1, (c_char_p * 1)(b"time"), byref(new)), ctx)
        record = Record(new.take() or 0)
        check(lib.iso_record_add(ctx, record.pointer, asked.size, asked.ctypes.data), ctx)
    table = ask("run", chosen, record, {"verbose": True} if errors else {}, lambda *tables: tables[0])
    assert isinstance(table, Trajectory)
    if errors:
        known = table.lines.text
        table.errors = {name: float(known.get(f"errors.{name}", "nan")) for name in _ERRORS}
    return table


class _OfOrbit(Trajectory):
    """A table of an orbit. Its lines are those of a run; they are made when they are asked for."""

    _scene: Optional[Scene]
    _backend: str

    def __init__(self, array: NDArray[np.float64], orbit: Orbit) -> None:
        # not by Table.__init__, which would take a third of the time of a short call; the array is known to fit
        self.__dict__.update(_array=array, _columns=orbit.columns, kind="trajectory", _record=None, _lines=None,
                             _words={}, _scene=orbit.scene, _backend=orbit.backend)

    @property
    def lines(self) -> Lines:
        """What a run says in its lines of `#`."""
        if self._lines is None and self._scene is not None:
            self.__dict__["_lines"] = run(self._scene, [0.0], backend=self._backend).lines
        return self._lines

    def __getstate__(self) -> Dict[str, Any]:
        return {**super().__getstate__(), "_scene": None}


class Orbit(Owned):
    """One orbit, which can be asked for any time, in any order. Threads may share it: one call after the other."""

    def __init__(self, scene: SceneLike, **changes: Any) -> None:
        self.scene = as_scene(scene, changes)
        new, ctx = New(lib.iso_solution_free), context()
        with interruptible():
            status = lib.iso_solution_create(ctx, self.scene.pointer, byref(new))
        check(status, ctx)
        self._own(new.take(), lib.iso_solution_free)
        self._context = lib.iso_solution_context(self.pointer)
        self._monitor = Monitor(self._context)
        self._lock = threading.Lock()
        self.columns = self.scene.columns

    def at(self, times: ArrayLike) -> Table:
        """The rows at these times: t of a ball's scene, s of a point's.

        times  any shape, any order. Returns a table of shape (*times.shape, columns): for one time table["n"] has
        shape (3,). The numbers do not depend on the other times, nor on earlier calls. They are those of a run by
        the same backend, to the bit.
        """
        asked, notes = _times(times), Notes()
        array = np.empty(asked.shape + (len(self.columns),))
        with self._lock, interruptible():
            status = lib.iso_solution_at(self.pointer, asked.ctypes.data, asked.size, array.ctypes.data,
                                              *notes.arguments)
            check(status, self._context)
        notes.tell()
        return _OfOrbit(array, self)

    @property
    def backend(self) -> str:
        """What finds the orbit: "ball", "point" or "exact"."""
        name: bytes = lib.iso_solution_word(self.pointer, b"backend")
        return name.decode()

    @property
    def energy(self) -> float:
        """The energy h of the ball, mass length^2 / time^2."""
        return float(lib.iso_solution_number(self.pointer, b"h"))

    @property
    def coupling(self) -> float:
        """The coupling eps of the point, h det(J) / k^2: mass^4 length^8 / time^2."""
        return float(lib.iso_solution_number(self.pointer, b"eps"))

    @property
    def has_twin(self) -> bool:
        """Whether the orbit has both models."""
        return bool(lib.iso_solution_word(self.pointer, b"models") == b"both")

    def __repr__(self) -> str:
        return f"<isoroll.Orbit of {self.scene!r}>"


def orbit(scene: SceneLike, **changes: Any) -> Orbit:
    """The orbit of a scene.

    >>> isoroll.orbit("scene.yaml", as_="both").at([0, 10, 5]).gamma        # shape (3, 3)
    """
    return Orbit(scene, **changes)


class Batch(Trajectory):
    """The table of a batch: array has shape (orbits, rows, columns); table.n has shape (orbits, rows, 3). What
    differs from orbit to orbit, such as k and J, is in the lines of batch.orbit(i).

    status   int32, shape (orbits,): 0 for an orbit that went well (lib/base/status.h)
    failure  the exception of the first orbit that failed, or None
    """

    status: NDArray[np.int32]
    failure: Optional[_errors.IsorollError] = None
    _origin: Optional[Tuple[List[Scene], List[Optional[NDArray[np.float64]]]]] = None

    def orbit(self, i: int) -> Trajectory:
        """The rows of one orbit, a view of shape (rows, columns), with its k, J, h, eps, effects in the lines."""
        return Trajectory(self.array[i], self.columns, self._lines_of(range(len(self.array))[i]))

    def _lines_of(self, i: int) -> Mapping[str, str]:
        if self._origin is None:
            return self.lines
        scenes, replaced = self._origin
        scene, ctx = Scene(scenes[i if len(scenes) > 1 else 0]), context()
        own = [None if values is None else np.ascontiguousarray(values[i]) for values in replaced]
        check(lib.iso_scene_replace(ctx, scene.pointer, *(None if x is None else x.ctypes.data for x in own)),
              ctx)
        lines = dict(run(scene, [0.0]).lines.text)
        if scene.backend == "auto":
            del lines["backend"]  # a batch chooses by its own times
        return lines

    def __getstate__(self) -> Dict[str, Any]:
        return {**super().__getstate__(), "_origin": None}


def _count(shapes: Iterable[int]) -> int:
    counts = {count for count in shapes if count != 1}
    if len(counts) > 1:
        raise _errors.BadArgument(f"scenes, k, J and start are of {sorted(counts)} orbits: give one, or one for each")
    return counts.pop() if counts else 1


def _spread(values: Optional[ArrayLike], count: int, width: int) -> Optional[NDArray[np.float64]]:
    if values is None:
        return None
    return np.ascontiguousarray(np.broadcast_to(doubles("k, J, start", values).reshape(-1, width),
                                                (count, width)))


def _orbits_of(name: str, values: Optional[ArrayLike], width: int) -> int:
    if values is None:
        return 1
    shape = doubles(name, values).shape
    right = len(shape) <= 1 if width == 1 else 1 <= len(shape) <= 2 and shape[-1] == width
    if not right:
        wanted = "(orbits,)" if width == 1 else f"(orbits, {width})"
        raise _errors.BadArgument(f"{name} has shape {shape}, it must be {wanted}")
    return int(np.prod(shape)) // width


def batch(scenes: Union[SceneLike, Iterable[SceneLike]], times: ArrayLike, *, k: Optional[ArrayLike] = None,
          J: Optional[ArrayLike] = None, start: Optional[ArrayLike] = None, threads: int = 0,
          vectors: Optional[str] = None, on_error: str = "raise", **changes: Any) -> Batch:
    """Many orbits at the same times, on all processors, by method taylor in the lanes of vectors.

    scenes    one scene, or a list of them that agree in columns, backend, tolerance and the model of the start
    times     shape (rows,), t of a ball's scene, s of a point's: away from 0, in one direction
    k, J      shape (orbits,) and (orbits, 3), or one for all: in place of the scene's; the ball is then reduced.
              k has no unit; J are the moments about the contact point, mass length^2
    start     shape (orbits, 6): omega [1/time], n (of a point M, gamma), in place of the scene's
    threads   0: one for each processor
    vectors   "avx512", "avx2", "plain"; None: the widest of this processor
    on_error  "raise"; or "keep": rows that an orbit has not reached are NaN, and batch.status says why

    The eps of a point's scene is kept where k, J or start is replaced: the energy H of the point is then another one.
    Without eps the scene says H = 0, and eps follows from each start.

    Returns a table of shape (orbits, rows, columns). An orbit's numbers do not depend on the orbits beside it.
    """
    if on_error not in ("raise", "keep"):
        raise _errors.BadArgument(f"on_error is '{on_error}', it must be 'raise' or 'keep'")
    chosen = as_scenes(scenes, changes)
    if not chosen:
        raise _errors.BadArgument("there are no scenes")
    count = _count([len(chosen), _orbits_of("k", k, 1), _orbits_of("J", J, 3), _orbits_of("start", start, 6)])
    asked, columns = np.atleast_1d(_times(times)).ravel(), chosen[0].columns
    arrays = [_spread(k, count, 1), _spread(J, count, 3), _spread(start, count, 6)]
    pointers = (c_void_p * len(chosen))(*(scene.pointer for scene in chosen))
    array, statuses = np.empty((count, asked.size, len(columns))), np.zeros(count, dtype=np.int32)
    result, ctx = Batch(array, columns, kind="batch"), context()
    result.status, result._origin = statuses, (chosen, arrays)
    with interruptible(lambda: result if statuses.any() else None):
        status = lib.iso_batch(ctx, pointers, len(chosen), count,
                                       *(None if a is None else a.ctypes.data for a in arrays), asked.ctypes.data,
                                       asked.size, whole("threads", threads, 0, 1024),
                                       None if vectors is None else encoded(vectors),
                                       array.ctypes.data, statuses.ctypes.data)
    try:
        check(status, ctx)
    except _errors.IsorollError as error:
        if on_error == "raise" or not statuses.any():
            error.partial = result if statuses.any() else None
            raise
        result.failure = error
    return result

"""Scenes: a ball or a point, its start, times, effects; from a file, from text, or from a dict."""

from __future__ import annotations

import json
import os
import re
from ctypes import byref, c_double, c_int, c_void_p
from typing import Any, Iterable, List, Mapping, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _errors
from ._library import Owned, check, context, encoded, lib

SceneLike = Union["Scene", str, "os.PathLike[str]", Mapping[str, Any]]

_MOST_COLUMNS = 64  # ISO_MAX_COLUMNS


def _yaml(value: Any) -> str:
    """A value as YAML in one line."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_word(str(key))}: {_yaml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, str):
        return _word(value)
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, np.ndarray) and not np.ma.is_masked(value):
        return _yaml(value.tolist())
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_yaml(item) for item in value) + "]"
    raise _errors.BadArgument(f"a scene has numbers, words, lists and dicts, not {type(value).__name__}: {value!r}")


def _word(text: str) -> str:
    return text if re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", text) else json.dumps(text, ensure_ascii=False)


def _text(source: Union[str, Mapping[str, Any]]) -> bytes:
    """The YAML text of a dict, or a text as it is."""
    try:
        if isinstance(source, str):
            return source.encode()
        return "".join(f"{_word(str(key))}: {_yaml(value)}\n" for key, value in source.items()).encode()
    except (RecursionError, UnicodeError, ValueError) as error:
        if isinstance(error, _errors.IsorollError):
            raise
        raise _errors.BadArgument(f"the scene cannot be made into text: {error}") from None


class Scene(Owned):
    """A scene (lib/doc/formats.md, section 1).

    source   the path of a YAML file; a str with a newline: YAML text; a dict of its sections; another Scene
    changes  backend, method, tolerance, end, step, as_ ("ball", "point", "both"), columns (a list of names):
             they override the scene, like the options of the command; columns come last, after those of as_

    >>> isoroll.Scene({"reduced": {"k": -1, "J": [1, 2, 5]},
    ...                "initial": {"normal": [0.36, 0.48, 0.8], "angular_velocity": [0.8, -0.6, 0]},
    ...                "time": {"end": 100, "step": 0.1}})
    """

    def __init__(self, source: SceneLike, **changes: Any) -> None:
        new, ctx = c_void_p(), context()
        if isinstance(source, Scene):
            status = lib.iso_foreign_scene_copy(ctx, source.pointer, byref(new))
        elif isinstance(source, Mapping):
            text = _text(source)
            status = lib.iso_foreign_scene_parse(ctx, b"<dict>", text, len(text), byref(new))
        elif isinstance(source, str) and "\n" in source:
            text = _text(source)
            status = lib.iso_foreign_scene_parse(ctx, b"<text>", text, len(text), byref(new))
        elif isinstance(source, (str, os.PathLike)):
            status = lib.iso_foreign_scene_read(ctx, encoded(source), byref(new))
        else:
            raise TypeError(f"a scene is a path, a text, a dict or a Scene, not {type(source).__name__}")
        check(status, ctx)
        self._own(new.value, lib.iso_foreign_scene_free)
        for key in sorted(changes, key="columns".__eq__):  # last: as_ sets columns of its own
            self._set(key, changes[key])
        numbers = (c_int * _MOST_COLUMNS)()
        count = lib.iso_foreign_scene_columns(self.pointer, numbers)
        self._columns = tuple(lib.iso_column_name(c).decode() for c in numbers[:count])

    def _set(self, key: str, value: Any) -> None:
        if value is None:
            return
        if key not in ("backend", "method", "tolerance", "end", "step", "as_", "columns"):
            raise TypeError(f"'{key}' is no argument: backend, method, tolerance, end, step, as_, columns")
        if key == "columns" and not isinstance(value, str):
            value = ",".join(value)
        if key == "columns" and not value:
            error = _errors.BadArgument("columns is empty: name at least one, such as t")
            error.about = key
            raise error
        if not isinstance(value, str):
            try:
                value = repr(float(value))
            except (TypeError, ValueError, OverflowError) as wrong:
                raise _errors.BadArgument(f"{key} is {value!r:.60}: {wrong}") from None
        ctx = context()
        check(lib.iso_foreign_scene_set(ctx, self.pointer, key.rstrip("_").encode(), encoded(value)), ctx)

    def _numbers(self, key: str) -> NDArray[np.float64]:
        values = (c_double * 6)()
        count = lib.iso_foreign_scene_numbers(self.pointer, key.encode(), values)
        return np.array(values[:count])

    def _word(self, key: str) -> str:
        word: bytes = lib.iso_foreign_scene_word(self.pointer, key.encode())
        return word.decode("utf-8", "replace")

    @property
    def model(self) -> str:
        """The model of the start: "ball" or "point"."""
        return self._word("model")

    @property
    def backend(self) -> str:
        """What is to find the orbit: "ball", "point", "exact" or "auto"."""
        return self._word("backend")

    @property
    def k(self) -> float:
        """The geometry number."""
        return float(self._numbers("k")[0])

    @property
    def J(self) -> NDArray[np.float64]:
        """The moments of inertia about the contact point, shape (3,), mass length^2."""
        return self._numbers("J")

    @property
    def start(self) -> NDArray[np.float64]:
        """The state at time 0, shape (6,): omega [1/time], n; of a point M, gamma."""
        return self._numbers("start")

    @property
    def end(self) -> float:
        """The last time of a run: t of a ball, s of a point."""
        return float(self._numbers("end")[0])

    @property
    def tolerance(self) -> float:
        """The largest relative error of one step."""
        return float(self._numbers("tolerance")[0])

    @property
    def columns(self) -> Tuple[str, ...]:
        """The columns that its rows have."""
        return self._columns

    def __repr__(self) -> str:
        return f"<isoroll.Scene {self._word('name')}: {self.model}, k = {self.k:g}, J = {self.J.tolist()}>"


def as_scene(source: SceneLike, changes: Mapping[str, Any]) -> Scene:
    """A scene as it is, or a new one."""
    if isinstance(source, Scene) and not any(value is not None for value in changes.values()):
        return source
    return Scene(source, **changes)


def as_scenes(source: Union[SceneLike, Iterable[SceneLike]], changes: Mapping[str, Any]) -> List[Scene]:
    """One scene, or several."""
    if isinstance(source, (Scene, str, os.PathLike, Mapping)):
        return [as_scene(source, changes)]
    return [as_scene(scene, changes) for scene in source]

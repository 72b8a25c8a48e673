"""Scenes: a ball or a point, its start, times, effects; from keywords, a file, text, or a dict."""

from __future__ import annotations

import difflib
import os
import sys
from ctypes import byref, c_char_p, c_double, c_int, c_void_p
from typing import Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors
from ._library import Owned, check, context, encoded, items, lib, listed, real
from ._yaml import dump, filled, load, plain

SceneLike = Union["Scene", str, "os.PathLike[str]", Mapping[str, Any]]

_MOST_COLUMNS = 64  # ISO_MAX_COLUMNS
_MOST_BYTES = 16 << 20  # of a file
_SET = ("backend", "method", "tolerance", "end", "step", "as", "columns")  # what iso_scene_set can change
_NUMBERS = ("tolerance", "end", "step")  # those of them that are numbers


def _keys() -> Dict[str, Dict[str, None]]:
    """The keys of each section, in the order of the library; those of "effects" are the effects."""
    section, key = c_char_p(), c_char_p()
    found: Dict[str, Dict[str, None]] = {}
    i = 0
    while lib.iso_scene_key(i, byref(section), byref(key)):
        found.setdefault((section.value or b"").decode(), {})[(key.value or b"").decode()] = None
        i += 1
    return found


KEYS = _keys()
_SECTION = {key: section for section in reversed(list(KEYS)) for key in KEYS[section]}  # the first that has the key
_SECTION.update(k="", J="", D="")  # of `reduced` or of `point`
_BALL, _POINT = ("normal", "angular_velocity"), ("gamma", "M")


#: what others call a key: columns of a table, options of the command, letters of the theory
_ALSO = {"omega": "angular_velocity", "w": "angular_velocity", "n": "normal", "m": "mass", "I": "inertia"}


def _unknown(key: str) -> TypeError:
    names = [*KEYS, *_SECTION]
    near = [_ALSO[key]] if key in _ALSO else [name for name in names if name.lower() == key.lower()]
    near = near or difflib.get_close_matches(key, names, 1)
    meant = f"did you mean '{near[0]}'?" if near else "it takes " + ", ".join(dict.fromkeys(names))
    return TypeError(f"a scene has no keyword '{key}': {meant}")


class _Draft:
    """The sections of a scene while keywords change them."""

    def __init__(self, sections: Mapping[str, Any], base: Any) -> None:
        self.sections: Dict[str, Any] = plain(sections)
        self.base = base

    def section(self, name: str) -> Dict[str, Any]:
        found = self.sections.setdefault(name, {})
        if not isinstance(found, dict):
            raise _errors.BadInput(f"'{name}' is {found!r:.60}, it should be a dict")
        return found

    def become(self, model: str) -> None:
        """One of ball, reduced and point, with the same k and J where they are known."""
        if model in self.sections:
            return
        old = next((self.sections[m] for m in ("reduced", "point") if m in self.sections), {})
        known = {key: old[key] for key in ("k", "J") if key in old}
        if "ball" in self.sections and model != "ball":
            if self.base is None:
                raise _errors.BadInput("a ball has mass, radius, inertia and surface, or k and J: give either")
            scene = self.base()
            known = {"k": scene.k, "J": scene.J.tolist()}
        others = [name for name in ("ball", "surface", "reduced", "point") if name != model]
        rest = {name: value for name, value in self.sections.items() if name not in others}
        self.sections = {model: {} if model == "ball" else known, **rest}
        start = self.sections.get("initial", {})
        for key in _BALL if model == "point" else _POINT:
            start.pop(key, None)

    def put(self, key: str, value: Any) -> None:
        if key in KEYS and value is None:
            self.sections.pop(key, None)
        elif key in KEYS:
            self.sections[key] = {"kind": value} if key == "surface" and isinstance(value, str) else plain(value)
        elif key in KEYS["effects"]:
            if value is None or value is False:
                self.section("effects").pop(key, None)
            else:
                self.section("effects")[key] = {} if value is True else plain(value)
        elif value is not None:
            name = _SECTION[key] or ("point" if "point" in self.sections else "reduced")
            self.section(name)[key] = plain(value)

    def change(self, keys: Mapping[str, Any]) -> None:
        said = {key for key, value in keys.items() if value is not None}
        for model, own in (("ball", {"ball", "surface", *KEYS["ball"]}), ("point", {"point", "eps", *_POINT})):
            if said & own:
                self.become(model)
        if said & {"k", "J", "D", "reduced"} and "point" not in self.sections:
            self.become("reduced")
        if said & set(_BALL) and "point" in self.sections and not said & set(_POINT):
            self.become("reduced")
        for key, value in keys.items():
            self.put(key, value)


class Scene(Owned):
    """A scene: a ball or a point, its start, times, effects, and how to solve (lib/doc/formats.md, section 1).

    source   the path of a YAML file; a str with a newline: YAML text; a dict of the sections of such a file;
             another Scene. None: the keywords say all
    others   keys of a scene file, and names of effects; they change the source. A section, such as `surface`, or an
             effect is a dict; True is an effect without numbers; None or False takes an effect away

    A ball has k and J, or mass, radius, inertia and surface; it starts from normal and angular_velocity. A point has
    k, J and perhaps eps; it starts from gamma and M. Where k or J replace those of a body, the ball is a reduced one.
    Without a source the last time is 100 unless `end` says otherwise.

    >>> ball = isoroll.Scene(k=0.5, J=(1, 2, 5), normal=(0.36, 0.48, 0.8), angular_velocity=(0.9, -0.3, -0.225))
    >>> isoroll.Scene(ball, k=0.4, end=20, gravity={"mgb": 0.7, "up": (0, 0.6, 0.8)})
    >>> isoroll.Scene(mass=6.8, radius=0.11, inertia=(0.027, 0.028, 0.029), surface="plane", normal=(0, 0, 1),
    ...               angular_velocity=(1, 2, 0))
    >>> isoroll.Scene(k=-1, J=(6, 4, 2), eps=0.5, gamma=(1, 0, 0), M=(0, 0.1, 0.2))

    `tol` and `t_end`, as options call them, are `tolerance` and `end`.

    Scenes are values: equal if they say the same, whatever the order and the digits; they can be keys of dicts, and
    be copied and pickled. They cannot be changed.
    """

    _name: str
    _text: Optional[bytes]  # that it was read from; None: it was made of keywords or a dict, or was changed

    def __init__(self, source: Optional[SceneLike] = None, *, k: Optional[float] = None,
                 J: Optional[ArrayLike] = None, D: Optional[float] = None, eps: Optional[float] = None,
                 normal: Optional[ArrayLike] = None, angular_velocity: Optional[ArrayLike] = None,
                 gamma: Optional[ArrayLike] = None, M: Optional[ArrayLike] = None, project: Optional[bool] = None,
                 mass: Optional[float] = None, radius: Optional[float] = None, inertia: Optional[ArrayLike] = None,
                 surface: Union[None, str, Mapping[str, Any]] = None, end: Optional[float] = None,
                 step: Optional[float] = None, backend: Optional[str] = None, method: Optional[str] = None,
                 tolerance: Optional[float] = None, as_: Optional[str] = None,
                 columns: Union[None, str, Sequence[str]] = None, **others: Any) -> None:
        if (tolerance is not None and "tol" in others) or (end is not None and "t_end" in others):
            raise TypeError("tol and tolerance say the same, and so do t_end and end: leave out one of them")
        tolerance, end = others.pop("tol", tolerance), others.pop("t_end", end)  # as options call them
        asked = dict(k=k, J=J, D=D, eps=eps, normal=normal, angular_velocity=angular_velocity, gamma=gamma, M=M,
                     project=project, mass=mass, radius=radius, inertia=inertia, surface=surface)
        keys = {key: value for key, value in asked.items() if value is not None}
        keys.update((key.rstrip("_"), value) for key, value in others.items())
        for key in keys:
            if key not in KEYS and key not in _SECTION:
                raise _unknown(key)
        settings = {"backend": backend, "method": method, "tolerance": tolerance, "end": end, "step": step, "as": as_,
                    "columns": columns}  # the columns last: those of `as` stand behind it
        if keys or source is None:
            self._parse(self._changed(source, keys), "<keywords>")
            self._text = None
        else:
            self._take(source)
        for key, value in settings.items():
            if value is not None:
                self._set(key, value)

    # --- making -----------------------------------------------------------------------------------------------------

    def _parse(self, text: bytes, name: str) -> None:
        new, ctx = c_void_p(), context()
        check(lib.iso_scene_parse(ctx, encoded(name), text, len(text), byref(new)), ctx)
        self._own(new.value, lib.iso_scene_free)
        self._text, self._name = text, name
        self._find_columns()

    def _take(self, source: SceneLike) -> None:
        """A scene as the source has it."""
        if isinstance(source, Scene):
            new, ctx = c_void_p(), context()
            check(lib.iso_scene_copy(ctx, source.pointer, byref(new)), ctx)
            self._own(new.value, lib.iso_scene_free)
            self._text, self._name, self._columns = source._text, source._name, source._columns
        elif isinstance(source, Mapping):
            self._parse(dump(source), "<dict>")
            self._text = None
        elif isinstance(source, str) and "\n" in source:
            try:
                self._parse(source.encode(), "<text>")
            except UnicodeError as error:
                raise _errors.BadArgument(f"this cannot be made into the text of a scene: {error}") from None
        elif isinstance(source, (str, os.PathLike)):
            self._parse(*_file(source))
        else:
            raise _errors.BadType(f"a scene is a path, a text, a dict or a Scene, not {type(source).__name__}")

    @staticmethod
    def _changed(source: Optional[SceneLike], keys: Mapping[str, Any]) -> bytes:
        if source is None:
            draft = _Draft({"time": {"end": 100}}, None)
        elif isinstance(source, Mapping):
            draft = _Draft(source, lambda: Scene(source))
        else:
            base = source if isinstance(source, Scene) else Scene(source)
            draft = _Draft(base.sections, lambda: base)
        draft.change(keys)
        if "initial" not in draft.sections:
            raise _errors.BadInput("the scene has no start: give normal and angular_velocity; of a point gamma and M")
        order = [*KEYS, *draft.sections]
        return dump({name: draft.sections[name] for name in dict.fromkeys(order) if name in draft.sections})

    def _set(self, key: str, value: Any) -> None:
        if key == "columns":
            value = listed(key, value)
        elif key in _NUMBERS:
            value = repr(real(key, value))
        elif not isinstance(value, str):
            raise _errors.BadType(f"{key} is {value!r:.60}, it must be a text")
        if key == "columns" and not value:
            error = _errors.BadArgument("columns is empty: name at least one, such as t")
            error.about = key
            raise error
        ctx = context()
        check(lib.iso_scene_set(ctx, self.pointer, key.encode(), encoded(value)), ctx)
        self._text = None
        self._find_columns()

    def _find_columns(self) -> None:
        numbers = (c_int * _MOST_COLUMNS)()
        count = lib.iso_scene_columns(self.pointer, numbers)
        text, names = (c_char_p * 3)(), []
        for number in numbers[:count]:
            lib.iso_column(number, text)
            names.append((text[0] or b"").decode())
        self._columns = tuple(names)

    # --- as text ----------------------------------------------------------------------------------------------------

    def _printed(self) -> bytes:
        return filled(lambda *into: lib.iso_scene_text(context(), self.pointer, *into), 1024)

    @property
    def sections(self) -> Dict[str, Any]:
        """What the scene says, as a dict of its sections: Scene(scene.sections) == scene."""
        found = load(self._text or self._printed(), self._name)
        return {name: value for name, value in found.items() if value != {}}

    @property
    def text(self) -> str:
        """YAML that the command takes, and that gives the same run to the bit. Of a file it is the file's own text,
        unless something was changed."""
        return (self._text or self._printed()).decode("utf-8-sig")

    def __eq__(self, other: object) -> bool:
        return self._printed() == other._printed() if isinstance(other, Scene) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._printed())

    def __reduce_ex__(self, protocol: Any) -> Any:
        return _again, (self._text, self._text or self._printed(), self._name)

    def __setattr__(self, name: str, value: Any) -> None:
        if not name.startswith("_"):
            raise AttributeError(f"a scene cannot be changed: isoroll.Scene(scene, {name}=...) is another one")
        super().__setattr__(name, value)

    def __copy__(self) -> Scene:
        return self

    def __deepcopy__(self, memo: Any) -> Scene:
        return self

    def __repr__(self) -> str:
        if not self._pointer:
            return "<isoroll.Scene that was never made>"
        words = []
        for name, section in self.sections.items():
            flat = {name: section} if name == "surface" or not isinstance(section, dict) else section
            words += [f"{'as_' if key == 'as' else key}={value!r}" for key, value in flat.items()]
        return f"isoroll.Scene({', '.join(words)})"

    # --- questions --------------------------------------------------------------------------------------------------

    def _numbers(self, key: str) -> NDArray[np.float64]:
        values = (c_double * 6)()
        count = lib.iso_scene_numbers(self.pointer, key.encode(), values)
        return np.array(values[:count])

    def _word(self, key: str) -> str:
        word: bytes = lib.iso_scene_word(self.pointer, key.encode())
        return word.decode("utf-8", "replace")

    @property
    def name(self) -> str:
        """What messages call it: the path of its file, or <text>, <dict>, <keywords>."""
        return self._name

    @property
    def model(self) -> str:
        """The model of the start: "ball" or "point"."""
        return self._word("model")

    @property
    def backend(self) -> str:
        """What is to find the orbit: "ball", "point", "exact" or "auto"."""
        return self._word("backend")

    @property
    def method(self) -> str:
        """The integrator, or "auto"."""
        return self._word("method")

    @property
    def k(self) -> float:
        """The geometry number."""
        return float(self._numbers("k")[0])

    @property
    def J(self) -> NDArray[np.float64]:
        """The moments of inertia about the contact point, shape (3,), mass length^2."""
        return self._numbers("J")

    @property
    def eps(self) -> float:
        """The coupling of a point's potential as the scene states it; NaN: the scene is a ball's, or H = 0."""
        return float(self._numbers("eps")[0])

    @property
    def start(self) -> NDArray[np.float64]:
        """The state at time 0, shape (6,): omega [1/time], n; of a point M, gamma."""
        return self._numbers("start")

    def _part(self, model: str, name: str, part: slice) -> NDArray[np.float64]:
        if self.model != model:
            raise AttributeError(f"this scene starts from a {self.model}: it has no {name}")
        return self.start[part]

    @property
    def normal(self) -> NDArray[np.float64]:
        """n at time 0, of a ball's scene, shape (3,)."""
        return self._part("ball", "normal", slice(3, 6))

    @property
    def angular_velocity(self) -> NDArray[np.float64]:
        """omega at time 0, of a ball's scene, shape (3,), 1/time."""
        return self._part("ball", "angular_velocity", slice(0, 3))

    @property
    def gamma(self) -> NDArray[np.float64]:
        """gamma at time 0, of a point's scene, shape (3,)."""
        return self._part("point", "gamma", slice(3, 6))

    @property
    def M(self) -> NDArray[np.float64]:
        """M at time 0, of a point's scene, shape (3,), 1/time."""
        return self._part("point", "M", slice(0, 3))

    @property
    def effects(self) -> Tuple[str, ...]:
        """The names of the effects that the scene states."""
        return tuple(self.sections.get("effects", ()))

    @property
    def end(self) -> float:
        """The last time of a run: t of a ball, s of a point."""
        return float(self._numbers("end")[0])

    @property
    def step(self) -> float:
        """The time between the rows of a run."""
        return float(self._numbers("step")[0]) or abs(self.end) / 100

    @property
    def tolerance(self) -> float:
        """The largest relative error of one step."""
        return float(self._numbers("tolerance")[0])

    @property
    def columns(self) -> Tuple[str, ...]:
        """The columns that its rows have."""
        return self._columns


def _file(path: Union[str, "os.PathLike[str]"]) -> Tuple[bytes, str]:
    """The text of a file, and what messages call it. The library words what goes wrong."""
    code = encoded(path)
    name = os.fsdecode(code)
    if name == "-":
        return sys.stdin.buffer.read(_MOST_BYTES + 1), "<stdin>"
    try:
        with open(code, "rb") as file:
            text = file.read(_MOST_BYTES + 1)
    except OSError:
        text = None
    if text is None or len(text) > _MOST_BYTES:
        new, ctx = c_void_p(), context()
        status = lib.iso_scene_read(ctx, code, byref(new))
        if new.value:
            lib.iso_scene_free(new.value)
        check(status, ctx)
        raise _errors.FileTrouble(f"'{name}' changes while it is read")
    return text, name


def _again(own: Optional[bytes], text: bytes, name: str) -> Scene:
    """A scene that was pickled."""
    scene = Scene.__new__(Scene)
    scene._parse(text, name)
    scene._text = own
    return scene


def as_scene(source: SceneLike, changes: Mapping[str, Any]) -> Scene:
    """A scene as it is, or a new one."""
    if isinstance(source, Scene) and not any(value is not None for value in changes.values()):
        return source
    return Scene(source, **changes)


def as_scenes(source: Union[SceneLike, Iterable[SceneLike]], changes: Mapping[str, Any]) -> List[Scene]:
    """One scene, or several."""
    if isinstance(source, (Scene, str, os.PathLike, Mapping)):
        return [as_scene(source, changes)]
    return [as_scene(scene, changes) for scene in items("scenes", source)]

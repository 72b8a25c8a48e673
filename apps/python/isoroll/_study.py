"""Asking a study of the library: options as text, progress, interruption, and what comes back."""

from __future__ import annotations

import sys
import threading
from ctypes import CFUNCTYPE, Structure, byref, c_char_p, c_double, c_size_t, c_void_p, cast, create_string_buffer
from typing import Any, Callable, Dict, List, Mapping, NamedTuple, Optional, Tuple, TypeVar, Union

import numpy as np

from . import _errors
from ._library import _raised, check, context, doubles, encoded, fraction, interruptible, lib, number
from ._scene import Scene, SceneLike, as_scene
from ._table import Record, Table, from_record, new_record

TABLES = 6  # ISO_STUDY_TABLES

#: True: a bar on stderr; a function: it is called with the part that is done, 0 to 1
ProgressLike = Union[None, bool, Callable[[float], Any]]
_Made = TypeVar("_Made")


class Option(NamedTuple):
    """An option of a study, as the library describes it."""

    name: str
    type: str  # "flag", "whole", "number", "numbers", "word", "text"
    argument: str
    expected: str
    doc: str
    words: Tuple[str, ...]


def options_of(study: str) -> List[Option]:
    """The options of a study, in the order of the command's help."""
    found: List[Option] = []
    text, name = (c_char_p * 5)(), encoded(study)
    while lib.iso_study_option(name, len(found), text):
        words: List[str] = []
        while word := lib.iso_study_option_word(name, len(found), len(words)):
            words.append(word.decode())
        found.append(Option(*((x or b"").decode() for x in text), words=tuple(words)))
    return found


def _names() -> Tuple[str, ...]:
    found: List[str] = []
    while name := lib.iso_study_name(len(found)):
        found.append(name.decode())
    return tuple(found)


#: the names of all studies
STUDIES = _names()
NEEDS_SCENE, NEEDS_RECORD, TAKES_SCENE = 1, 2, 4


# --- options --------------------------------------------------------------------------------------------------------


def text_of(name: str, value: Any) -> str:
    """An option as it is typed after the command: 3, 0.5, 1/2, "1,2,5", "l,x;l,x", "k=0.4:0.6", "omega1=0.1"."""
    if isinstance(value, Mapping):
        return ",".join(f"{key}={text_of(name, item).replace(',', ':')}" for key, item in value.items())
    if isinstance(value, tuple) and len(value) == 2 and isinstance(value[0], str):
        return text_of(name, {value[0]: value[1]})
    if isinstance(value, str):
        return value
    if fraction(value):
        return str(fraction(value))
    if isinstance(value, (list, tuple)) and any(map(fraction, value)):
        return ",".join(text_of(name, item) for item in value)
    if isinstance(value, (int, np.integer)) and not isinstance(value, bool):
        return str(int(value))
    numbers = doubles(name, value)
    if numbers.ndim == 0:
        number = float(numbers)
        return str(int(number)) if number.is_integer() and abs(number) < 2**53 else repr(number)
    if numbers.ndim > 2:
        raise _errors.BadArgument(f"{name} has shape {numbers.shape}")
    return ";".join(",".join(text_of(name, x) for x in row) for row in np.atleast_2d(numbers).tolist())


def _given(study: str, options: Mapping[str, Any]) -> Dict[str, str]:
    """Options by the names of the command, as text."""
    types = {option.name: option.type for option in options_of(study)}
    ranges = {option.name for option in options_of(study) if option.argument == "A:B"}
    given = {key.rstrip("_").replace("_", "-"): value for key, value in options.items()
             if value is not None and value is not False and not (key == "at" and np.size(value) == 0)}
    for key, value in given.items():
        if types.get(key) in ("whole", "number"):
            number(key, value)
        elif types.get(key) == "numbers":
            doubles(key, value)
        elif types.get(key) == "flag":
            if not isinstance(value, (bool, np.bool_)):
                raise _errors.BadType(f"{key} is {value!r:.60}, it must be True or False")
            given[key] = str(bool(value)).lower()
    texts = {key: text_of(key, {key: value} if key in ranges and not isinstance(value, str) else value)
             for key, value in given.items()}
    texts.update((key, texts[key].partition("=")[2]) for key in ranges & texts.keys() if "=" in texts[key])
    return texts


def lines_of(texts: Mapping[str, str]) -> str:
    """Options as the library reads them: lines NAME=VALUE."""
    for key, text in texts.items():
        if "\n" in text:
            raise _errors.BadArgument(f"{key} is {text!r:.60}: it has the end of a line in it")
    return "\n".join(f"{key}={text}" for key, text in texts.items())


# --- progress -------------------------------------------------------------------------------------------------------


def _bar(part: float) -> None:
    width = 40
    done = int(width * part)
    sys.stderr.write(f"\r[{'#' * done}{' ' * (width - done)}] {100 * part:3.0f} %")
    sys.stderr.flush()


class Progress:
    """What the library calls with the part that is done, perhaps from threads of its own. What the user's function
    raises ends the call."""

    def __init__(self, progress: ProgressLike) -> None:
        if not (progress is None or isinstance(progress, bool) or callable(progress)):
            raise _errors.BadType(f"progress is {progress!r:.60}, it must be True or a function")
        self.show = _bar if progress is True else progress or None
        self.bar, self.raised, self.shown = progress is True, None, 0.0
        self.lock, self.thread = threading.Lock(), threading.get_ident()
        self.call = CFUNCTYPE(None, c_void_p, c_double)(self._tell) if self.show else None

    @property
    def pointer(self) -> Optional[c_void_p]:
        return cast(self.call, c_void_p) if self.call is not None else None

    def _tell(self, _unused: Any, part: float) -> None:
        with self.lock:
            if self.raised is not None or part < self.shown or self.show is None:
                return
            self.shown = part
            try:
                self.show(part)
            except BaseException as error:
                self.raised = error
                if self.thread == threading.main_thread().ident:
                    _raised.append(error)

    def end(self) -> None:
        """Raises what the user's function raised."""
        if self.bar and self.shown > 0:
            sys.stderr.write("\r" + 50 * " " + "\r")
        if self.raised is not None:
            raise self.raised


class _Sink(Structure):
    """iso_sink of lib/base/sink.h: who takes notes and progress. Rows stay in the tables."""

    _fields_ = [(name, c_void_p) for name in ("header", "row", "note", "progress", "data")]


_Note = CFUNCTYPE(None, c_void_p, c_char_p)


# --- asking ---------------------------------------------------------------------------------------------------------


def ask(name: str, scene: Optional[SceneLike], record: Optional[Record], options: Mapping[str, Any],
        make: Callable[..., _Made], progress: ProgressLike = None) -> _Made:
    """What `make` makes of the tables of a study; so also an exception's `partial`."""
    chosen: Optional[Scene] = None if scene is None else as_scene(scene, {})
    ctx, notes, made, shown = context(), [], (c_void_p * TABLES)(), Progress(progress)
    note = _Note(lambda _unused, words: notes.append(words.decode("utf-8", "replace")))
    sink = _Sink(None, None, cast(note, c_void_p), shown.pointer, None)
    kept: List[Any] = []
    given = _given(name, options)
    text = lines_of(given)

    def found() -> Optional[_Made]:
        if not kept:
            news = [new_record() for _ in made]
            for new, pointer in zip(news, made):
                new.value = pointer
            tables = [from_record(new) if new.value else None for new in news]
            kept.append(make(*tables) if tables[0] is not None else None)
        return kept[0]  # type: ignore[no-any-return]

    with interruptible(found):
        status = lib.iso_study_ask(ctx, encoded(name), None if chosen is None else chosen.pointer,
                                   None if record is None else record.pointer, encoded(text), byref(sink), made)
    result = found()
    try:
        shown.end()
        check(status, ctx)
    except BaseException as error:
        error.partial = result  # type: ignore[attr-defined]
        raise
    for words in notes:
        _errors.warn(words)
    return result  # type: ignore[return-value]


def study(scene: Optional[SceneLike], name: str, *, progress: ProgressLike = None,
          **options: Any) -> Tuple[Optional[Table], ...]:
    """Any study of a scene by its name, with the options of the command of this name: "section", "chaos", ...

    options  as the command has them, exponent_turns=700 for --exponent-turns 700, as_="both" for --as both; True: one
             without an argument; None, False: not given

    Returns six tables, None in place of those that are not made (iso_study_ask in lib/api/interface.h). The
    lines of the first have the scene, and the result by the names of the command's --json. A study that has a
    function of its own, such as isoroll.chaos, is better asked by it.
    """
    return ask(name, scene, None, options, lambda *tables: tables, progress)


def docs() -> Dict[str, str]:
    """What each study does, in one line."""
    return {name: lib.iso_study_doc(name.encode()).decode() for name in STUDIES}


def list_(topic: Optional[str] = None) -> str:
    """What there is, as text: `isoroll list`.

    topic  "systems", "backends", "effects", "methods", "surfaces", "integrals", "clocks", "columns", "tables";
           None: all of them

    >>> print(isoroll.list_("methods"))

    The columns of a table that is there are in table.units and table.doc.
    """
    ctx, length = context(), c_size_t()
    named = None if topic is None else encoded(topic)
    check(lib.iso_list(ctx, named, None, 0, byref(length)), ctx)
    text = create_string_buffer(length.value + 1)
    check(lib.iso_list(ctx, named, text, length.value + 1, byref(length)), ctx)
    return text.value.decode()

"""The text of scenes and sweeps: from dicts to YAML, and from YAML to dicts, which the library reads."""

from __future__ import annotations

import json
import re
from ctypes import byref, c_size_t, create_string_buffer
from typing import Any, Callable, Dict, Mapping

import numpy as np

from . import _errors
from ._library import check, context, encoded, fraction, lib


def _unknown(value: Any) -> Any:
    """What json does not know as a value that it knows."""
    known = plain(value)
    if known is value:
        raise _errors.BadArgument(f"a scene has numbers, words, lists and dicts, not {type(value).__name__}: {value!r}")
    return known


def dump(sections: Mapping[str, Any]) -> bytes:
    """A dict as YAML, in JSON's form, a line for each section. Numbers read back to the same doubles, and fractions,
    such as "1/3" and Fraction(1, 3), as what they are."""
    json_of = json.JSONEncoder(ensure_ascii=False, default=_unknown).encode
    try:
        text = "".join(f"{json_of(str(key))}: {json_of(value)}\n" for key, value in sections.items())
        return re.sub(r'"([-+.\deE]+/[-+.\deE]+)"', r"\1", text).encode()
    except (RecursionError, TypeError, UnicodeError, ValueError) as error:
        if isinstance(error, _errors.IsorollError):
            raise
        raise _errors.BadArgument(f"this cannot be made into the text of a scene: {error}") from None


def plain(value: Any) -> Any:
    """A value as `load` gives it: with lists, Python's numbers and dicts of its own."""
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, np.floating):
        return float(value)
    if not isinstance(value, str) and fraction(value):
        return fraction(value)
    if isinstance(value, (np.ndarray, np.generic)) and not np.ma.is_masked(value):
        return value.tolist()
    return value


def filled(call: Callable[[Any, int, Any], int], room: int) -> bytes:
    """The text that a function of the library writes into a buffer, of which it tells how long it should be."""
    length = c_size_t()
    while True:
        buffer = create_string_buffer(room)
        check(call(buffer, room, byref(length)), context())
        if length.value < room:
            return buffer.value
        room = length.value + 1


def load(text: bytes, name: str) -> Dict[str, Any]:
    """YAML as a dict of dicts, lists, numbers and words. Messages call it `name`."""
    found = json.loads(filled(lambda *into: lib.iso_yaml_json(context(), encoded(name), text, len(text), *into),
                              4 * len(text) + 64))
    return found if isinstance(found, dict) else {}

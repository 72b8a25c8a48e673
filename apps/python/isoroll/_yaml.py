"""The text of scenes and sweeps: from dicts to YAML, and from YAML to dicts by the library."""

from __future__ import annotations

import json
import re
from ctypes import byref, c_size_t, create_string_buffer
from typing import Any, Dict, Mapping

import numpy as np

from . import _errors
from ._library import check, context, encoded, lib


def _word(text: str) -> str:
    plain = re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", text) and text not in ("true", "false")
    return text if plain else json.dumps(text, ensure_ascii=False)


def _value(value: Any) -> str:
    """A value as YAML in one line."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_word(str(key))}: {_value(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, str):
        return _word(value)
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, np.ndarray) and not np.ma.is_masked(value):
        return _value(value.tolist())
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(item) for item in value) + "]"
    raise _errors.BadArgument(f"a scene has numbers, words, lists and dicts, not {type(value).__name__}: {value!r}")


def dump(sections: Mapping[str, Any]) -> bytes:
    """A dict as YAML, a line for each section. Numbers read back to the same doubles."""
    try:
        return "".join(f"{_word(str(key))}: {_value(value)}\n" for key, value in sections.items()).encode()
    except (RecursionError, UnicodeError, ValueError) as error:
        if isinstance(error, _errors.IsorollError):
            raise
        raise _errors.BadArgument(f"this cannot be made into the text of a scene: {error}") from None


def plain(value: Any) -> Any:
    """A value as `load` gives it: with lists, Python's numbers and dicts of its own."""
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, (np.ndarray, np.generic)) and not np.ma.is_masked(value):
        return value.tolist()
    return value


def load(text: bytes, name: str) -> Dict[str, Any]:
    """YAML as a dict of dicts, lists, numbers and words. Messages call it `name`."""
    ctx, room, length = context(), 4 * len(text) + 64, c_size_t()
    while True:
        buffer = create_string_buffer(room)
        check(lib.iso_foreign_yaml_json(ctx, encoded(name), text, len(text), buffer, room, byref(length)), ctx)
        if length.value < room:
            break
        room = length.value + 1
    found = json.loads(buffer.value)
    return found if isinstance(found, dict) else {}

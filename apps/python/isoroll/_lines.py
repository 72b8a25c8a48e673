"""The lines `# key: value` of a table, with numbers as numbers."""

from __future__ import annotations

import re
from types import MappingProxyType
from typing import Any, Dict, Iterator, Mapping, Union

import numpy as np
from numpy.typing import NDArray

from . import _errors
from ._library import doubles

#: what a line can say
Value = Union[float, str, "NDArray[np.float64]"]

_NUMBER = r"[+-]?(?:(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|nan|inf)"
_NUMBERS = re.compile(rf"{_NUMBER}(?: {_NUMBER})*")


def value_of(text: str) -> Value:
    """A text as a number, as an array of numbers, or as it is."""
    if not _NUMBERS.fullmatch(text):
        return text
    if " " not in text:
        return float(text)
    array = np.array([float(x) for x in text.split(" ")])
    array.flags.writeable = False
    return array


def text_of(value: Any) -> str:
    """A number or numbers as a line has them, with 17 digits; a text as it is."""
    if isinstance(value, (str, bool)):
        return value if isinstance(value, str) else str(value).lower()
    return " ".join("%.17g" % x for x in np.ravel(doubles("the value of a line", value)))


def _with_lists(found: Any) -> Any:
    """Dicts whose keys are 0, 1, 2, ... as lists."""
    if not isinstance(found, dict):
        return found
    values = {key: _with_lists(value) for key, value in found.items()}
    return list(values.values()) if values and list(values) == [str(i) for i in range(len(values))] else values


class Lines(Mapping[str, Any]):
    """What a file says in its lines of `#`, by key. lines["k"] is a float, lines["J"] an array that cannot be
    written to, lines["model"] a text.

    text  the same with all values as they stand in the file
    tree  the same as dicts and lists: tree["angles"][0]["frequency"]["t"] is the line "angles.0.frequency.t"
    """

    text: Mapping[str, str]

    def __init__(self, lines: Mapping[str, Any]) -> None:
        if not isinstance(lines, Mapping):
            raise _errors.BadType(f"lines are a dict, not {type(lines).__name__}")
        if isinstance(lines, Lines):
            lines = lines.text
        if not isinstance(lines, MappingProxyType):  # else they are texts already
            lines = MappingProxyType({str(key): text_of(lines[key]) for key in lines})
        self.__dict__["text"] = lines

    @property
    def tree(self) -> Dict[str, Any]:
        """The lines as dicts and lists."""
        found: Dict[str, Any] = {}
        for key, value in self.items():
            *path, last = key.split(".")
            place = found
            for step in path:
                inner = place.setdefault(step, {})
                place = inner if isinstance(inner, dict) else place.setdefault(step + ".", {})
            place[last] = value
        return _with_lists(found)  # type: ignore[no-any-return]

    def __getitem__(self, key: str) -> Value:
        if key not in self.text:
            raise KeyError(f"there is no line '{key}': the table has {', '.join(self.text) or 'none'}")
        return value_of(self.text[key])

    def __iter__(self) -> Iterator[str]:
        return iter(self.text)

    def __len__(self) -> int:
        return len(self.text)

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("the lines of a table cannot be changed: make another table")

    def __eq__(self, other: object) -> bool:
        return dict(self.text) == dict(other.text) if isinstance(other, Lines) else NotImplemented

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> Any:
        return Lines, (dict(self.text),)

    def __repr__(self) -> str:
        return "Lines(" + ", ".join(f"{key}={value}" for key, value in self.text.items()) + ")"

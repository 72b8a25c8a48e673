"""Tables: named columns of doubles and lines `key: value`; what the library calls a record."""

from __future__ import annotations

from ctypes import byref, c_char_p, c_double
from types import MappingProxyType
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors
from ._library import New, Owned, check, context, lib

#: vectors by the names of their columns
VECTORS = {name: tuple(f"{name}{i}" for i in range(1, 4))
           for name in ("omega", "n", "M", "gamma", "e", "contact", "trace", "centre", "N")}
VECTORS["q"] = ("q0", "q1", "q2", "q3")


#: names of columns, which are no names for other things
_NAMES = frozenset(("t", "tau", "s")).union(VECTORS, *VECTORS.values())


def _decoded(text: c_char_p) -> str:
    return (text.value or b"").decode("utf-8", "surrogateescape")


def doubles(what: str, values: Any) -> NDArray[np.float64]:
    """Numbers as float64. Those that have no such form are refused: complex ones, words, masked ones."""
    if type(values) is np.ndarray and values.dtype == np.float64:
        return values
    try:
        array = np.asarray(values)
    except (ValueError, TypeError) as error:
        raise _errors.BadArgument(f"{what}: {error}") from None
    if np.ma.is_masked(values):
        raise _errors.BadArgument(f"{what} has masked numbers: fill them first")
    if array.dtype != np.float64 and array.dtype.kind not in "biuf":
        raise _errors.BadArgument(f"{what} must be real numbers, not {array.dtype}")
    return np.asarray(array, dtype=np.float64)


class Record(Owned):
    """A record of the library. Arrays that view its rows keep it alive; the last one frees it."""

    def __init__(self, pointer: int) -> None:
        self._own(pointer, lib.iso_record_free)

    def columns(self) -> Tuple[str, ...]:
        return tuple(lib.iso_record_name(self.pointer, c).decode()
                     for c in range(lib.iso_record_columns(self.pointer)))

    def lines(self) -> Mapping[str, str]:
        key, value = c_char_p(), c_char_p()
        found: Dict[str, str] = {}
        number = 0
        while lib.iso_record_line(self.pointer, number, byref(key), byref(value)):
            found[_decoded(key)] = _decoded(value)
            number += 1
        return MappingProxyType(found)

    def array(self) -> NDArray[np.float64]:
        """The rows, not copied: shape (rows, columns)."""
        rows, columns = lib.iso_record_rows(self.pointer), lib.iso_record_columns(self.pointer)
        if rows == 0:
            return np.empty((0, columns))
        memory = (c_double * (rows * columns)).from_address(lib.iso_record_row(self.pointer, 0))
        memory._record = self
        return np.frombuffer(memory, dtype=np.float64).reshape(rows, columns)


class Table:
    """Numbers in named columns.

    array    float64, shape (..., columns): (rows, columns) for a trajectory, (orbits, rows, columns) for a batch,
             (columns,) for a single time
    columns  names of the columns, such as ("t", "omega1", "omega2", "omega3", "n1", "n2", "n3")
    lines    what a file says in its lines of `#`: "k", "J", "model", ... as text

    The numbers can be changed (table.n[3] = ...); array, columns and lines themselves cannot: make another table.
    table["t"] is a column, shape (...); table["omega"] is a vector, shape (..., 3). Both are views of the array. Only
    if the columns of a vector do not stand side by side, in order, it is a copy, which cannot be written to. The
    clocks and the states of both models can also be written table.t, table.omega, table.n, table.M, ... Units are
    the scene's.
    """

    kind: str
    _array: NDArray[np.float64]
    _columns: Tuple[str, ...]
    _lines: Mapping[str, str]
    _record: Optional[Record]

    def __init__(self, array: ArrayLike, columns: Sequence[str], lines: Optional[Mapping[str, str]] = None, *,
                 kind: str = "trajectory", record: Optional[Record] = None) -> None:
        numbers, names = doubles("array", array), tuple(columns)
        if numbers.ndim == 0 or numbers.shape[-1] != len(names):
            raise _errors.BadArgument(f"array has shape {numbers.shape}, and there are {len(names)} columns: its "
                                      "last length must be their number")
        self.__dict__.update(_array=numbers, _columns=names, kind=kind, _record=record,
                             _lines=MappingProxyType(dict(lines or {})))

    @property
    def array(self) -> NDArray[np.float64]:
        return self._array

    @property
    def columns(self) -> Tuple[str, ...]:
        return self._columns

    @property
    def lines(self) -> Mapping[str, str]:
        return self._lines

    @property
    def k(self) -> float:
        """The geometry number, from the lines."""
        return float(self._line("k"))

    @property
    def J(self) -> NDArray[np.float64]:
        """The moments about the contact point, shape (3,), from the lines."""
        return np.array([float(x) for x in self._line("J").split()])

    def _line(self, key: str) -> str:
        if key not in self.lines:
            raise _errors.BadInput(f"the table has no line '{key}'")
        return self.lines[key]

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """A column (...,) or a vector (..., 3) by its name."""
        if not isinstance(name, str):
            raise TypeError(f"a table has columns by their names, not by {name!r}: table.array has the numbers")
        if name in self.columns:
            return self.array[..., self.columns.index(name)]
        parts = VECTORS.get(name, ())
        if not parts or any(part not in self.columns for part in parts):
            raise KeyError(f"there is no column '{name}': the table has {', '.join(self.columns)}")
        first = self.columns.index(parts[0])
        if self.columns[first:first + len(parts)] == parts:
            return self.array[..., first:first + len(parts)]
        copied = self.array[..., [self.columns.index(part) for part in parts]]
        copied.flags.writeable = False  # numbers written to it would go nowhere
        return copied

    def __contains__(self, name: str) -> bool:
        return name in self.columns or (name in VECTORS and all(part in self.columns for part in VECTORS[name]))

    def words(self, name: str) -> NDArray[np.str_]:
        """A column of words, such as verdict, whose numbers stand for them. For a table from a file or a study."""
        if self._record is None:
            raise _errors.BadArgument("this table has numbers alone: its words went with the file or the study")
        return np.array([lib.iso_record_word(self._record.pointer, x).decode() for x in self[name]])

    def __getattr__(self, name: str) -> NDArray[np.float64]:
        if name.startswith("_") or "_columns" not in self.__dict__:
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError as error:
            raise AttributeError(error.args[0]) from None

    def __setattr__(self, name: str, value: Any) -> None:
        """What would change no number of the table is refused."""
        if name in ("array", "columns", "lines"):
            raise AttributeError(f"'{name}' of a table cannot be replaced: change numbers in it (table.array[...] = "
                                 "...), or make another one, isoroll.Table(array, columns, lines)")
        if name in _NAMES or name in self.__dict__.get("_columns", ()):
            raise AttributeError(f"'{name}' is a name of a column: change its numbers (table.{name}[...] = ...), or "
                                 "make another table by isoroll.trajectory")
        super().__setattr__(name, value)

    def __len__(self) -> int:
        return len(self.array)

    def __getstate__(self) -> Dict[str, Any]:
        """For pickle and copy: without the library's record, so the array is a copy."""
        lines = dict(self.lines)
        return {**self.__dict__, "_array": self.array.copy(), "_lines": lines, "_record": None}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._lines = MappingProxyType(state["_lines"])

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> NDArray[Any]:
        if copy:
            return np.array(self.array, dtype=dtype)
        return np.asarray(self.array, dtype=dtype)

    @property
    def rows(self) -> NDArray[Any]:
        """The same memory as a structured array, shape (...): rows["t"], rows[5]["omega1"]. Only if the array has
        gaps, it is a copy, which cannot be written to."""
        dtype, array = np.dtype([(name, np.float64) for name in self.columns]), np.ascontiguousarray(self.array)
        if not np.may_share_memory(array, self.array):
            array.flags.writeable = False
        return array.view(dtype)[..., 0]

    def __repr__(self) -> str:
        return f"<isoroll.Table {self.array.shape}: {', '.join(self.columns)}>"


def new_record() -> New:
    """Where a call puts a record."""
    return New(lib.iso_record_free)


def from_record(new: New) -> Table:
    """The table of a new record, which it takes over."""
    if not new.value:
        raise _errors.IsorollError("the library gave no record")
    record = Record(new.take() or 0)
    kind = lib.iso_record_kind(record.pointer).decode() or "trajectory"
    return Table(record.array(), record.columns(), record.lines(), kind=kind, record=record)


def _bytes(text: str) -> bytes:
    """A name or a line for C. It came from a file, perhaps not in UTF-8, or from the caller."""
    if "\0" in text or "\n" in text or "\r" in text:
        raise _errors.BadArgument(f"{text!r} has the end of a line in it, or a zero byte")
    return text.encode("utf-8", "surrogateescape")


def as_record(table: Table) -> Record:
    """The record of a table: its own, or a new one with copies of its rows."""
    if not isinstance(table, Table):
        raise TypeError(f"a Table is needed, not {type(table).__name__}: see isoroll.trajectory")
    if table._record is not None:
        return table._record
    if table.array.ndim > 2:
        raise _errors.BadArgument("this table has many orbits: take one of them, table.orbit(i)")
    array = np.ascontiguousarray(np.atleast_2d(table.array), dtype=np.float64)
    names = (c_char_p * len(table.columns))(*(_bytes(name) for name in table.columns))
    new, ctx = new_record(), context()
    check(lib.iso_record_create(ctx, len(names), names, byref(new)), ctx)
    record = Record(new.take() or 0)
    for key, value in table.lines.items():
        check(lib.iso_record_set(ctx, record.pointer, _bytes(key), _bytes(value)), ctx)
    check(lib.iso_record_add(ctx, record.pointer, len(array), array.ctypes.data), ctx)
    return record


def _text(value: Union[str, ArrayLike]) -> str:
    if isinstance(value, str):
        return value
    return " ".join("%.17g" % x for x in np.ravel(doubles("a line", value)))


def trajectory(columns: Mapping[str, ArrayLike], **lines: Union[str, ArrayLike]) -> Table:
    """A trajectory from arrays of your own.

    columns  arrays of length N, or vectors of shape (N, 3), by name: {"t": t, "omega": omega, "n": n}
    lines    what a file would say in its lines of `#`: k=-1, J=[1, 2, 5], eps=6.5

    >>> isoroll.convert(isoroll.trajectory({"t": t, "omega": w, "n": n}, k=1, J=[1, 2, 5]), "point")
    """
    names: List[str] = []
    parts: List[NDArray[np.float64]] = []
    for name, values in columns.items():
        array = doubles(f"column '{name}'", values)
        group: Tuple[str, ...] = VECTORS[name] if name in VECTORS and array.ndim == 2 else (name,)
        if array.ndim < 2:
            array = array.reshape(-1, 1)
        if array.ndim > 2 or array.shape[1] != len(group):
            raise _errors.BadArgument(f"column '{name}' has shape {np.shape(values)}")
        if parts and len(array) != len(parts[0]):
            raise _errors.BadArgument(f"column '{name}' has {len(array)} rows, the others have {len(parts[0])}")
        names.extend(group)
        parts.append(array)
    if not parts:
        raise _errors.BadArgument("a trajectory needs columns")
    said = {key.replace("_", "."): _text(value) for key, value in lines.items()}
    if "model" not in said:
        ball, point = "omega1" in names, "M1" in names
        said = {"model": "both" if ball and point else "point" if point else "ball", **said}
    return Table(np.ascontiguousarray(np.hstack(parts)), names, said)

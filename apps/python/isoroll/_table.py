"""Tables: named columns of doubles and lines `key: value`; what the library calls a record."""

from __future__ import annotations

from ctypes import byref, c_char_p, c_double, c_void_p
from types import MappingProxyType
from typing import Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors
from ._library import Owned, check, context, lib

#: vectors by the names of their columns
VECTORS = {name: tuple(f"{name}{i}" for i in range(1, 4))
           for name in ("omega", "n", "M", "gamma", "e", "contact", "trace", "centre", "N")}
VECTORS["q"] = ("q0", "q1", "q2", "q3")


def _decoded(text: c_char_p) -> str:
    return (text.value or b"").decode("utf-8", "replace")


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
        while lib.iso_record_line(self.pointer, len(found), byref(key), byref(value)):
            found[_decoded(key)] = _decoded(value)
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
    lines    what a file says in its lines of `#`: "k", "J", "model", ... as text (read only)

    table["t"] is a column, shape (...); table["omega"] is a vector, shape (..., 3); neither is a copy. The clocks and
    the states of both models can also be written table.t, table.omega, table.n, table.M, ... Units are the scene's.
    """

    def __init__(self, array: NDArray[np.float64], columns: Sequence[str],
                 lines: Optional[Mapping[str, str]] = None, *, kind: str = "trajectory",
                 record: Optional[Record] = None) -> None:
        self.array = array
        self.columns: Tuple[str, ...] = tuple(columns)
        self.kind = kind
        self._lines: Mapping[str, str] = MappingProxyType(dict(lines or {}))
        self._record = record

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
        """A column (...,) or a vector (..., 3) by its name; a view."""
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
        return self.array[..., [self.columns.index(part) for part in parts]]

    def __contains__(self, name: str) -> bool:
        return name in self.columns or (name in VECTORS and all(part in self.columns for part in VECTORS[name]))

    def __getattr__(self, name: str) -> NDArray[np.float64]:
        if name.startswith("_") or "columns" not in self.__dict__:
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError as error:
            raise AttributeError(error.args[0]) from None

    def __len__(self) -> int:
        return len(self.array)

    def __getstate__(self) -> Dict[str, Any]:
        """For pickle and copy: without the library's record, so the array is a copy."""
        lines = dict(self.lines)
        return {**self.__dict__, "array": self.array.copy(), "_lines": lines, "_record": None}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._lines = MappingProxyType(state["_lines"])

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> NDArray[Any]:
        if copy:
            return np.array(self.array, dtype=dtype)
        return np.asarray(self.array, dtype=dtype)

    @property
    def rows(self) -> NDArray[Any]:
        """The same memory as a structured array, shape (...): rows["t"], rows[5]["omega1"]."""
        dtype = np.dtype([(name, np.float64) for name in self.columns])
        return np.ascontiguousarray(self.array).view(dtype)[..., 0]

    def __repr__(self) -> str:
        return f"<isoroll.Table {self.array.shape}: {', '.join(self.columns)}>"


def from_record(pointer: Optional[int], kind: str = "trajectory") -> Table:
    """The table of a new record, which it takes over."""
    if not pointer:
        raise _errors.IsorollError("the library gave no record")
    record = Record(pointer)
    return Table(record.array(), record.columns(), record.lines(), kind=kind, record=record)


def as_record(table: Table) -> Record:
    """The record of a table: its own, or a new one with copies of its rows."""
    if table._record is not None:
        return table._record
    if table.array.ndim > 2:
        raise _errors.BadArgument("this table has many orbits: take one of them, table.orbit(i)")
    array = np.ascontiguousarray(np.atleast_2d(table.array), dtype=np.float64)
    names = (c_char_p * len(table.columns))(*(name.encode() for name in table.columns))
    new, ctx = c_void_p(), context()
    check(lib.iso_record_create(ctx, len(names), names, byref(new)), ctx)
    record = Record(new.value or 0)
    for key, value in table.lines.items():
        check(lib.iso_record_set(ctx, record.pointer, key.encode(), value.encode()), ctx)
    check(lib.iso_foreign_record_append(ctx, record.pointer, len(array), array.ctypes.data), ctx)
    return record


def _text(value: Union[str, ArrayLike]) -> str:
    if isinstance(value, str):
        return value
    return " ".join("%.17g" % x for x in np.ravel(np.asarray(value, dtype=np.float64)))


def trajectory(columns: Mapping[str, ArrayLike], **lines: Union[str, ArrayLike]) -> Table:
    """A trajectory from arrays of your own.

    columns  arrays of length N, or vectors of shape (N, 3), by name: {"t": t, "omega": omega, "n": n}
    lines    what a file would say in its lines of `#`: k=-1, J=[1, 2, 5], eps=6.5

    >>> isoroll.convert(isoroll.trajectory({"t": t, "omega": w, "n": n}, k=1, J=[1, 2, 5]), "point")
    """
    names: List[str] = []
    parts: List[NDArray[np.float64]] = []
    for name, values in columns.items():
        array = np.asarray(values, dtype=np.float64)
        group: Iterable[str] = VECTORS[name] if name in VECTORS and array.ndim == 2 else (name,)
        array = array.reshape(len(array), -1) if array.ndim else array.reshape(1, 1)
        if array.shape[1] != len(tuple(group)):
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

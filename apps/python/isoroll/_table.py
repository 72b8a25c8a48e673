"""Tables: named columns of numbers or words and lines `key: value`; what the library calls a record."""

from __future__ import annotations

import functools
import html
import os
import shutil
import sys
import textwrap
from ctypes import byref, c_char_p, c_double, c_size_t, create_string_buffer
from types import MappingProxyType
from typing import Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Type, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors, _hdf5
from ._library import New, Owned, check, context, doubles, encoded, interruptible, items, lib, real, whole
from ._lines import Lines, text_of

PathLike = Union[str, bytes, "os.PathLike[str]"]

#: vectors by the names of their columns
VECTORS = {name: tuple(f"{name}{i}" for i in range(1, 4))
           for name in ("omega", "n", "M", "gamma", "e", "contact", "trace", "centre", "N")}
VECTORS["q"] = ("q0", "q1", "q2", "q3")

#: names of columns, which are no names for other things
_NAMES = frozenset(("t", "tau", "s")).union(VECTORS, *VECTORS.values())
_TRAJECTORY = "trajectory"
_WIDTH = 100  # of a printed table
_Made = TypeVar("_Made", bound="Table")


def _decoded(text: c_char_p) -> str:
    return (text.value or b"").decode("utf-8", "surrogateescape")


class Record(Owned):
    """A record of the library. Arrays that view its rows keep it alive; the last one frees it."""

    def __init__(self, pointer: int) -> None:
        self._own(pointer, lib.iso_record_free)

    def columns(self) -> Tuple[str, ...]:
        return tuple(lib.iso_record_name(self.pointer, c).decode("utf-8", "surrogateescape")
                     for c in range(lib.iso_record_columns(self.pointer)))

    def lines(self) -> Lines:
        key, value = c_char_p(), c_char_p()
        found: Dict[str, str] = {}
        number = 0
        while lib.iso_record_line(self.pointer, number, byref(key), byref(value)):
            found[_decoded(key)] = _decoded(value)
            number += 1
        return Lines(MappingProxyType(found))

    def with_words(self) -> List[int]:
        """The columns of words."""
        pointer, has = self.pointer, lib.iso_record_has_words
        return [column for column in range(lib.iso_record_columns(pointer)) if has(pointer, column)]

    def words(self, column: int, numbers: NDArray[np.float64]) -> Dict[float, str]:
        """The words that the numbers of a column stand for."""
        return {x: lib.iso_record_word(self.pointer, x).decode("utf-8", "surrogateescape")
                for x in np.unique(numbers).tolist()}

    def array(self) -> NDArray[np.float64]:
        """The rows, not copied: shape (rows, columns)."""
        rows, columns = lib.iso_record_rows(self.pointer), lib.iso_record_columns(self.pointer)
        if rows == 0 or columns == 0:
            return np.empty((rows, columns))
        memory = (c_double * (rows * columns)).from_address(lib.iso_record_row(self.pointer, 0))
        memory._record = self
        return np.frombuffer(memory, dtype=np.float64).reshape(rows, columns)


class Table:
    """Numbers and words in named columns.

    array    float64, shape (..., columns): (rows, columns) for a file, (orbits, rows, columns) for a batch,
             (columns,) for a single time. A word is a number here; table["verdict"] has the words
    columns  names of the columns, such as ("t", "omega1", "omega2", "omega3", "n1", "n2", "n3")
    lines    what a file says in its lines of `#`: lines["k"] is a float, lines["J"] an array, lines["model"] a text;
             lines.text has all of them as they stand in the file
    kind     "trajectory", "section", "chaos", ..., as in the first line of a file
    units    the unit of each column, "" for a number without one
    doc      what each column is

    table["t"] is a column, shape (...); table["omega"] is a vector, shape (..., 3). Both are views of the array. Only
    if the columns of a vector do not stand side by side, in order, it is a copy, which cannot be written to; so are
    words. All columns can also be written table.t, table.omega, table.verdict, ...; table.k and table.J are in the
    lines, unless they are columns. Where a table has something else of the same name, as a chart has its kind,
    write table["kind"]. The numbers can be changed (table.n[3] = ...); array, columns and lines themselves cannot:
    make another table. Units are the scene's.
    """

    kind: str
    _array: NDArray[np.float64]
    _columns: Tuple[str, ...]
    _lines: Lines
    _record: Optional[Record]
    _words: Mapping[str, Mapping[float, str]]

    #: the kind of a new one
    _kind = _TRAJECTORY

    def __init__(self, array: ArrayLike, columns: Sequence[str], lines: Optional[Mapping[str, Any]] = None, *,
                 kind: Optional[str] = None, record: Optional[Record] = None) -> None:
        numbers, names = doubles("array", array), tuple(items("columns", columns, str))
        if not isinstance(kind, (str, type(None))):
            raise _errors.BadType(f"kind is {kind!r:.60}, it must be a text")
        if numbers.ndim == 0 or numbers.shape[-1] != len(names):
            raise _errors.BadArgument(f"array has shape {numbers.shape}, and there are {len(names)} columns: its "
                                      "last length must be their number")
        words = {} if record is None else {names[i]: record.words(i, numbers[..., i]) for i in record.with_words()}
        self.__dict__.update(_array=numbers, _columns=names, kind=kind or self._kind, _record=record,
                             _words=words,
                             _lines=lines if isinstance(lines, Lines) else Lines({} if lines is None else lines))

    @property
    def array(self) -> NDArray[np.float64]:
        """All numbers, shape (..., columns)."""
        return self._array

    @property
    def columns(self) -> Tuple[str, ...]:
        """The names of the columns."""
        return self._columns

    @property
    def lines(self) -> Lines:
        """What a file says in its lines of `#`, with numbers as numbers."""
        return self._lines

    @property
    def units(self) -> Dict[str, str]:
        """The unit of each column; "" for a number without one, and for words."""
        return {name: unit for name, (unit, _) in self._described().items()}

    @property
    def doc(self) -> Dict[str, str]:
        """What each column is, in one line."""
        return {name: doc for name, (_, doc) in self._described().items()}

    def _described(self) -> Dict[str, Tuple[str, str]]:
        return {name: columns_of(self.kind).get(name, ("", "")) for name in self.columns}

    # --- columns ----------------------------------------------------------------------------------------------------

    def __getitem__(self, name: str) -> NDArray[Any]:
        """A column (...,) or a vector (..., 3) by its name; words as an array of str."""
        if not isinstance(name, str):
            raise TypeError(f"a table has columns by their names, not by {name!r}: table.array has the numbers")
        if name in self.columns:
            numbers = self.array[..., self.columns.index(name)]
            return self._as_words(name, numbers) if name in self._words else numbers
        parts = VECTORS.get(name, ())
        if not parts or any(part not in self.columns for part in parts):
            raise KeyError(f"there is no column '{name}': the table has {', '.join(self.columns)}")
        first = self.columns.index(parts[0])
        if self.columns[first:first + len(parts)] == parts:
            return self.array[..., first:first + len(parts)]
        copied = self.array[..., [self.columns.index(part) for part in parts]]
        copied.flags.writeable = False  # numbers written to it would go nowhere
        return copied

    def _as_words(self, name: str, numbers: NDArray[np.float64]) -> NDArray[np.str_]:
        found = self._words[name]
        if self._record is not None:  # the numbers may have been changed
            found = self._record.words(self.columns.index(name), numbers)
        keys, place = np.unique(numbers, return_inverse=True)
        words = np.array([found.get(x, "") for x in keys.tolist()] or [""])[place].reshape(numbers.shape)
        words.flags.writeable = False
        return words

    @property
    def codes(self) -> Dict[str, Dict[float, str]]:
        """What the numbers of columns of words mean in `array` and `rows` of this table; in another one they differ:
        codes["stability"][1.0] can be "stable"."""
        return {name: dict(zip(self.array[..., self.columns.index(name)].ravel().tolist(), self[name].ravel().tolist()))
                for name in self._words}

    def __contains__(self, name: object) -> bool:
        return name in self.columns or (name in VECTORS and all(part in self.columns for part in VECTORS[str(name)]))

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or "_columns" not in self.__dict__:
            raise AttributeError(name)
        if name in ("k", "J") and name not in self.columns:
            if name in self.lines:
                return self.lines[name]
            raise AttributeError(f"the table has no column and no line '{name}'")
        try:
            return self[name]
        except KeyError as error:
            of_lines = f"; it is a line: table.lines['{name}']" if name in self.lines else ""
            raise AttributeError(error.args[0] + of_lines) from None

    def __setattr__(self, name: str, value: Any) -> None:
        """What would change no number of the table is refused."""
        if name in ("array", "columns", "lines", "units", "doc"):
            raise AttributeError(f"'{name}' of a table cannot be replaced: change numbers in it (table.array[...] = "
                                 "...), or make another one, isoroll.Table(array, columns, lines)")
        if name in _NAMES or name in self.__dict__.get("_columns", ()):
            raise AttributeError(f"'{name}' is a name of a column: change its numbers (table.{name}[...] = ...), or "
                                 "make another table by isoroll.trajectory")
        super().__setattr__(name, value)

    def __dir__(self) -> Iterable[str]:
        return [*super().__dir__(), *self.columns, *(name for name in VECTORS if name in self)]

    def _ipython_key_completions_(self) -> List[str]:
        return [*self.columns, *(name for name in VECTORS if name in self)]

    def __len__(self) -> int:
        return len(self.array)

    # --- other forms ------------------------------------------------------------------------------------------------

    def __getstate__(self) -> Dict[str, Any]:
        """For pickle and copy: without the library's record, so the array is a copy."""
        words = {name: self._record.words(i, self.array[..., i]) if self._record is not None else self._words[name]
                 for i, name in enumerate(self.columns) if name in self._words}
        return {**self.__dict__, "_array": self.array.copy(), "_lines": self.lines, "_record": None, "_words": words}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self.__dict__.update(state)

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> NDArray[Any]:
        if copy:
            return np.array(self.array, dtype=dtype)
        return np.asarray(self.array, dtype=dtype)

    @property
    def rows(self) -> NDArray[Any]:
        """The same memory as a structured array, shape (...): rows["t"], rows[5]["omega1"]. A column of words has
        its `codes`. Only if the array has gaps, it is a copy, which cannot be written to."""
        dtype, array = np.dtype([(name, np.float64) for name in self.columns]), np.ascontiguousarray(self.array)
        if not self.columns:
            return np.empty(array.shape[:-1], dtype)
        if not np.may_share_memory(array, self.array):
            array.flags.writeable = False
        return array.view(dtype)[..., 0]

    def to_pandas(self) -> Any:
        """A DataFrame with the columns; its attrs are the lines. Numbers are not copied, unless there are words."""
        try:
            import pandas
        except ImportError:
            raise ImportError("to_pandas needs pandas, which is not installed here: pip install pandas") from None
        array = np.atleast_2d(self.array)
        if array.ndim > 2:
            raise _errors.BadArgument("this table has many orbits: take one of them, table.orbit(i)")
        if self._words:
            frame = pandas.DataFrame({name: np.atleast_1d(self[name]) for name in self.columns})
        else:
            frame = pandas.DataFrame(array, columns=list(self.columns), copy=False)
        frame.attrs.update({key: value.tolist() if isinstance(value, np.ndarray) else value
                            for key, value in self.lines.items()})  # pandas compares attrs: arrays it could not
        return frame

    def write(self, path: PathLike, *, digits: Union[int, str] = 17) -> None:
        """Writes the table: CSV, or HDF5 if the name ends in .h5; other endings are refused. The file appears when it is whole.

        digits  1 to 17, or "hex": C's %a. With 17 and "hex" the numbers read back exactly.

        In trajectories and sections a number that is not finite is refused.
        """
        ctx, record, name = context(), as_record(self), encoded(path)
        ending = os.path.splitext(os.fsdecode(name))[1]
        if ending not in ("", ".csv", ".h5"):
            raise _errors.BadArgument(f"'{os.fsdecode(path)}' ends in '{ending}': a table is written as .csv or .h5")
        number = 0 if isinstance(digits, str) and digits == "hex" else whole("digits", digits, 1, 17)
        with _hdf5.calls(name), interruptible():
            status = lib.iso_record_write(ctx, name, record.pointer, number, encoded(self.kind))
        check(status, ctx)

    def plot(self, ax: Any = None, **how: Any) -> Any:
        """Draws the table with matplotlib, as `isoroll plot` does, and returns the Axes, or an array of them.

        ax   where to draw: Axes, or as many as the picture has parts; None: a new figure
        how  value, columns, title, window, over: see isoroll.plot
        """
        from ._plot import draw
        return draw(self, ax, **how)

    def picture(self, output: PathLike, *, style: Optional[str] = None, size: Optional[str] = None,
                title: Optional[str] = None, template: Optional[PathLike] = None, script: Optional[PathLike] = None,
                **how: Any) -> None:
        """The command's own picture of the table, by gnuplot: `isoroll plot`, which must be installed.

        output    the file of the picture: .svg, .png or .pdf
        style     "screen" or "print", with letters of 8 pt
        size      "86x60mm", "1200x800px"
        title     above the picture; "none": nothing
        template  a file of gnuplot in place of the command's own, such as a changed copy of apps/isoroll/pictures
        script    a file that gets the script of gnuplot, with its data
        how       value, columns, window, over: see isoroll.plot
        """
        from ._command import picture
        from ._picture import wishes
        files = {key: None if path is None else os.fsdecode(encoded(path))
                 for key, path in (("template", template), ("script", script))}
        over, options = wishes(**how)
        picture(self, output, over, {"style": style, "size": size, "title": title, **files, **options})

    def __repr__(self) -> str:
        shape = f"{len(self)} rows" if self.array.ndim == 2 else f"shape {self.array.shape}"
        return f"<isoroll.{type(self).__name__}: {shape}; {', '.join(self.columns)}>"

    def _cells(self) -> List[List[str]]:
        """The first and the last rows as texts, column by column; "..." stands for rows between."""
        count = int(np.prod(self.array.shape[:-1]))
        flat = self.array.reshape(count, len(self.columns))
        shown = list(range(count)) if count <= 12 else [*range(5), None, *range(count - 5, count)]
        words = {name: np.ravel(self[name]) for name in self._words}
        return [["..." if row is None else str(words[name][row]) if name in words else f"{flat[row, i]:.6g}"
                 for row in shown] for i, name in enumerate(self.columns)]

    def _told(self, folded: bool) -> str:
        """What the command prints of a study, as wide as the terminal if that is wanted; "" of rows that it writes."""
        if self._record is None or self.kind in ("trajectory", "section"):
            return ""
        width = shutil.get_terminal_size().columns if folded and sys.stdout.isatty() else 0
        ctx, length = context(), c_size_t()
        check(lib.iso_study_text(ctx, self._record.pointer, width, None, 0, byref(length)), ctx)
        text = create_string_buffer(length.value + 1)
        check(lib.iso_study_text(ctx, self._record.pointer, width, text, length.value + 1, byref(length)), ctx)
        return text.value.decode("utf-8", "replace")

    def __str__(self) -> str:
        """What the command prints of a study; else the first and the last rows, and as many columns as fit."""
        told = self._told(True)
        if told:
            return told.rstrip("\n")
        columns = [[name, *cells] for name, cells in zip(self.columns, self._cells())]
        columns = [[text.rjust(max(map(len, column)) + 2) for text in column] for column in columns]
        ends = np.cumsum([len(column[0]) for column in columns])
        count = max(1, int(np.sum(ends <= _WIDTH)))
        lines = [self._heading(), *map("".join, zip(*columns[:count]))]
        if count < len(columns):
            lines += textwrap.wrap("more columns: " + ", ".join(self.columns[count:]), _WIDTH)
        return "\n".join(lines)

    def _heading(self) -> str:
        said = ""
        for key in ("k", "J"):
            values = np.ravel(self.lines[key]).tolist() if key in self.lines and key not in self.columns else []
            if values:
                said += f", {key} = " + " ".join(f"{x:.6g}" if isinstance(x, float) else x for x in values)
        shape = f"{len(self)} rows" if self.array.ndim == 2 else f"shape {self.array.shape}"
        return f"{self.kind}, {shape}{said}"

    def _repr_html_(self) -> str:
        """For notebooks: what the command prints of a study; the first and the last rows, with units."""
        told = self._told(False)
        told = f"<pre>{html.escape(told)}</pre>" if told else ""
        units = self.units
        head = "".join(f"<th>{html.escape(name)}<br><small>{html.escape(units[name])}</small></th>"
                       for name in self.columns)
        rows = zip(*self._cells())
        body = "".join("<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in row) + "</tr>" for row in rows)
        caption = f"<caption>{html.escape(self._heading())}</caption>"
        return f"{told}<table>{caption}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


#: the class of each kind; others are plain tables (_kinds.py fills it)
CLASSES: Dict[str, Type[Table]] = {}


@functools.lru_cache(maxsize=None)
def columns_of(kind: str) -> Mapping[str, Tuple[str, str]]:
    """The columns of a kind of table: name, unit and meaning; besides, those of a trajectory."""
    name, text, own = create_string_buffer(64), (c_char_p * 2)(), (c_char_p * 3)()
    found: Dict[str, Tuple[str, str]] = {}
    i = 0
    kind = "sweep" if kind == "sweep part" else kind
    while lib.iso_kind_column(kind.encode(), i, name, text):
        found[name.value.decode()] = (text[0] or b"").decode(), (text[1] or b"").decode()
        i += 1
    i = 0
    while lib.iso_column(i, own):
        found.setdefault(own[0].decode(), ((own[1] or b"").decode(), (own[2] or b"").decode()))
        i += 1
    return found


def new_record() -> New:
    """Where a call puts a record."""
    return New(lib.iso_record_free)


def from_record(new: New) -> Table:
    """The table of a new record, which it takes over, of the class of its kind."""
    if not new.value:
        raise _errors.IsorollError("the library gave no record")
    record = Record(new.take() or 0)
    kind = lib.iso_record_kind(record.pointer).decode() or _TRAJECTORY
    return CLASSES.get(kind, Table)(record.array(), record.columns(), record.lines(), kind=kind, record=record)


def _bytes(text: str, value: bool = False) -> bytes:
    """A name, or the value of a line, for C. It came from a file, perhaps not in UTF-8, or from the caller."""
    if "\0" in text or (not value and ("\n" in text or "\r" in text)):
        raise _errors.BadArgument(f"{text!r} has the end of a line in it, or a zero byte")
    return text.encode("utf-8", "surrogateescape")


def _with_words(ctx: int, record: Record, table: Table, array: NDArray[np.float64]) -> NDArray[np.float64]:
    """The rows of a table without a record, with the numbers that its words have in the new one."""
    array, number = array.copy(), c_double()
    for name, words in table._words.items():
        column = table.columns.index(name)
        lib.iso_record_set_words(record.pointer, column, True)
        old = array[:, column].copy()
        for code, word in words.items():
            check(lib.iso_record_intern(ctx, record.pointer, _bytes(word), byref(number)), ctx)
            array[old == code, column] = number.value
    return array


def as_record(table: Table) -> Record:
    """The record of a table: its own, or a new one with copies of its rows."""
    if not isinstance(table, Table):
        raise _errors.BadType(f"a Table is needed, not {type(table).__name__}: see isoroll.trajectory")
    if table._record is not None:
        return table._record
    if table.array.ndim > 2:
        raise _errors.BadArgument("this table has many orbits: take one of them, table.orbit(i)")
    array = np.ascontiguousarray(np.atleast_2d(table.array), dtype=np.float64)
    names = (c_char_p * len(table.columns))(*(_bytes(name) for name in table.columns))
    new, ctx = new_record(), context()
    check(lib.iso_record_create(ctx, len(names), names, byref(new)), ctx)
    record = Record(new.take() or 0)
    lib.iso_record_set_kind(record.pointer, _bytes(table.kind))
    for key, value in table.lines.text.items():
        check(lib.iso_record_set(ctx, record.pointer, _bytes(key), _bytes(value, True)), ctx)
    if table._words:
        array = _with_words(ctx, record, table, array)
    check(lib.iso_record_add(ctx, record.pointer, len(array), array.ctypes.data), ctx)
    return record


def trajectory(columns: Mapping[str, ArrayLike], **lines: Union[str, ArrayLike]) -> Table:
    """A trajectory from arrays of your own.

    columns  arrays of length N, or vectors of shape (N, 3), by name: {"t": t, "omega": omega, "n": n}
    lines    what a file would say in its lines of `#`: k=-1, J=[1, 2, 5], eps=6.5

    >>> isoroll.convert(isoroll.trajectory({"t": t, "omega": w, "n": n}, k=1, J=[1, 2, 5]), "point")
    """
    if not isinstance(columns, Mapping):
        raise _errors.BadType(f"a trajectory is made of a dict of columns, not of {type(columns).__name__}")
    names: List[str] = []
    parts: List[NDArray[np.float64]] = []
    for name, values in columns.items():
        array = doubles(f"column '{name}'", values)
        group: Tuple[str, ...] = VECTORS[name] if name in VECTORS and array.ndim == 2 else (name,)
        if array.ndim < 2:
            array = array.reshape(-1, 1)
        if array.ndim > 2 or array.shape[1] != len(group):
            wanted = f"(rows, {len(group)})" if len(group) > 1 else "(rows,)"
            vectors = "" if len(group) > 1 else "; vectors are " + ", ".join(VECTORS)
            raise _errors.BadArgument(f"column '{name}' has shape {np.shape(values)}, it must be {wanted}{vectors}")
        if parts and len(array) != len(parts[0]):
            raise _errors.BadArgument(f"column '{name}' has {len(array)} rows, the others have {len(parts[0])}")
        names.extend(group)
        parts.append(array)
    if not parts:
        raise _errors.BadArgument("a trajectory needs columns")
    for key in {"k", "eps", "h"} & set(lines):
        real(key, lines[key])
    if "J" in lines and (np.shape(lines["J"]) != (3,) or
                         not all(np.isfinite(real("J", x)) for x in np.asarray(lines["J"], dtype=object))):
        raise _errors.BadArgument("J must be three finite numbers")
    said = {key.replace("_", "."): text_of(value) for key, value in lines.items()}
    if "model" not in said:
        ball, point = "omega1" in names, "M1" in names
        said = {"model": "both" if ball and point else "point" if point else "ball", **said}
    return CLASSES[_TRAJECTORY](np.ascontiguousarray(np.hstack(parts)), names, said)

"""Files of trajectories, and conversion to the other model."""

from __future__ import annotations

import os
import re
from array import array
from ctypes import byref
from math import isfinite
from typing import BinaryIO, Dict, List, Optional, Sequence, Union

import numpy as np

from . import _errors
from ._library import Notes, check, context, encoded, interruptible, lib, whole
from ._table import VECTORS, Table, as_record, from_record, new_record

PathLike = Union[str, bytes, "os.PathLike[str]"]


_MAGIC = b"# isoroll section "
_LONGEST_LINE = 65535
_MOST_COLUMNS = 64
_COLUMNS = frozenset(("orbit", "crossing", "t", "tau", "s", "l", "x",
                      *(part for name in ("omega", "n", "M", "gamma") for part in VECTORS[name])))
_NUMBER = re.compile(r"[+-]?(0[xX][0-9a-fA-F.]+([pP][+-]?[0-9]+)?|[0-9.]+([eE][+-]?[0-9]+)?)")


class _SectionFile:
    """Reads the lines of a section in CSV (lib/doc/formats.md, section 5)."""

    def __init__(self, path: str) -> None:
        self.path, self.number = path, 0
        self.lines: Dict[str, str] = {}
        self.columns: List[str] = []
        self.numbers = array("d")

    def fail(self, words: str, column: int = 1) -> _errors.BadInput:
        return _errors.BadInput(f"{self.path}:{self.number}:{column}: {words}")

    def read(self, file: BinaryIO) -> Table:
        for raw in iter(lambda: file.readline(_LONGEST_LINE + 1), b""):
            self.number += 1
            if len(raw) > _LONGEST_LINE:
                raise self.fail("this line is longer than 64 KiB: is this a section file?")
            if b"\0" in raw:
                raise self.fail("a NUL byte: this is not a text file", raw.index(b"\0") + 1)
            self.take(raw.decode("utf-8", "surrogateescape").rstrip("\r\n"))
        if not self.columns:
            raise self.fail("expected a line of column names such as orbit,crossing,t,..., found the end of the file")
        rows = np.array(self.numbers).reshape(-1, len(self.columns))
        return Table(rows, self.columns, self.lines, kind="section")

    def take(self, text: str) -> None:
        if self.number == 1:
            if text != "# isoroll section 1":
                raise self.fail(f"expected '# isoroll section 1', found {text!r:.60}")
        elif text.startswith("#"):
            self.take_line(text)
        elif not self.columns and text:
            self.take_names(text)
        elif text:
            self.take_row(text)

    def take_line(self, text: str) -> None:
        key, colon, value = text[1:].partition(":")
        if colon and key.strip() and (not value or value[0] in " \t"):
            self.lines[key.strip()] = value.strip()
        elif self.columns:  # the rows have begun: perhaps a damaged one
            raise self.fail(f"expected a row or '# key: value', found {text!r:.60}")

    def take_names(self, text: str) -> None:
        at = 1
        for name in text.split(","):
            if name not in _COLUMNS or name in self.columns or len(self.columns) == _MOST_COLUMNS:
                what = "duplicate" if name in self.columns else "unknown"
                raise self.fail(f"{what} column {name!r:.60}; valid are " + ", ".join(sorted(_COLUMNS)), at)
            self.columns.append(name)
            at += len(name) + 1

    def take_row(self, text: str) -> None:
        fields, at = text.split(","), 1
        if len(fields) != len(self.columns):
            raise self.fail(f"expected {len(self.columns)} numbers, one for each column, found {len(fields)}")
        for name, field in zip(self.columns, fields):
            number = self.finite(field)
            if number is None:
                raise self.fail(f"expected a finite number for {name}, not {field!r:.60}", at)
            self.numbers.append(number)
            at += len(field) + 1

    @staticmethod
    def finite(field: str) -> Optional[float]:
        """Decimal or C's %a. float would also take "nan", "inf", "1_000"."""
        if not _NUMBER.fullmatch(field):
            return None
        try:
            number = float.fromhex(field) if "x" in field or "X" in field else float(field)
        except (ValueError, OverflowError):
            return None
        return number if isfinite(number) else None


def _read_section(path: bytes) -> Optional[Table]:
    """The table of a CSV file of sections; None: it is another file."""
    try:
        if path == b"-" or path.endswith(b".h5") or not os.path.isfile(path):
            return None
        with open(path, "rb") as file:
            if file.read(len(_MAGIC)) != _MAGIC:
                return None
            file.seek(0)
            return _SectionFile(os.fsdecode(path)).read(file)
    except OSError as error:
        raise _errors.FileTrouble(f"cannot read '{os.fsdecode(path)}': {error.strerror}") from None


def read(path: PathLike, columns: Optional[Union[str, Sequence[str]]] = None) -> Table:
    """Reads a trajectory: CSV, or HDF5 if the name ends in .h5; also files of other programs. Also a section in CSV.

    columns  for files without names: those of the columns from left to right, "-" for one to be passed over

    Returns a table of shape (rows, columns).
    """
    name = encoded(path)
    table = _read_section(name) if columns is None else None
    if table is not None:
        return table
    if columns is not None and not isinstance(columns, str):
        columns = ",".join(columns)
    ctx, new, notes = context(), new_record(), Notes()
    with interruptible():
        status = lib.iso_foreign_read(ctx, name, None if columns is None else encoded(columns),
                                      byref(new), *notes.arguments)
    check(status, ctx)
    notes.tell()
    return from_record(new)


def write(table: Table, path: PathLike, *, digits: Union[int, str] = 17) -> None:
    """Writes a table: CSV, or HDF5 if the name ends in .h5. The file appears when it is whole.

    digits  1 to 17, or "hex": C's %a. With 17 and "hex" the numbers read back exactly.

    A number that is not finite is refused.
    """
    ctx, record = context(), as_record(table)
    number = 0 if digits == "hex" else whole("digits", digits, 1, 17)
    kind = "section" if table.kind == "section" else "trajectory"
    if kind == "section" and encoded(path).endswith(b".h5"):
        raise _errors.BadArgument("a section is written as CSV only: give it another name than .h5")
    with interruptible():
        status = lib.iso_foreign_write(ctx, encoded(path), record.pointer, number, kind.encode())
    check(status, ctx)


def convert(table: Table, to: str, *, tolerance: float = 1e-14, row_tolerance: float = 1e-5,
            shift_J: bool = False) -> Table:
    """Converts a trajectory to the model `to`, "ball" or "point"; k, J and h or eps are in its lines.

    tolerance      relative error of the other model's clock, from row to row
    row_tolerance  how far a row may be from a unit vector and from a right angle: for rows with few digits
    shift_J        k = -1: a point off H = 0 becomes a free ball with the moments J + E/eps

    Returns a table with a row for each row: the clock, then omega, n or M, gamma. A warning says if the rows do not
    solve the equations that their lines state.
    """
    for key in ("k", "J"):
        if key not in getattr(table, "lines", (key,)):
            raise _errors.BadInput(f"the table has no line '{key}': isoroll.trajectory(..., k=..., J=...) gives one")
    ctx, record, new, notes = context(), as_record(table), new_record(), Notes()
    with interruptible():
        status = lib.iso_foreign_convert(ctx, record.pointer, encoded(to), float(tolerance), float(row_tolerance),
                                         bool(shift_J),
                                         byref(new), *notes.arguments)
    check(status, ctx)
    notes.tell()
    return from_record(new)

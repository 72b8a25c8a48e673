"""Files of trajectories, and conversion to the other model."""

from __future__ import annotations

import os
from ctypes import byref
from typing import Dict, List, Optional, Sequence, Union

import numpy as np

from . import _errors
from ._library import Notes, check, context, encoded, interruptible, lib, whole
from ._table import Table, as_record, from_record, new_record

PathLike = Union[str, "os.PathLike[str]"]


def _read_section(path: str) -> Optional[Table]:
    """The table of a CSV file of sections; None: it is another file."""
    if path == "-" or path.endswith(".h5") or not os.path.isfile(path):
        return None
    with open(path, encoding="utf-8", errors="replace") as file:
        if not file.readline().startswith("# isoroll section 1"):
            return None
        lines: Dict[str, str] = {}
        rows: List[str] = []
        for text in file:
            key, colon, value = text[2:].rstrip("\n").partition(": ")
            if not text.startswith("#"):
                rows.append(text)
            elif colon:
                lines[key] = value
    try:
        columns = rows[0].strip().split(",")
        array = np.loadtxt(rows[1:], delimiter=",", ndmin=2)
        return Table(array.reshape(-1, len(columns)), columns, lines, kind="section")
    except (IndexError, ValueError) as error:
        raise _errors.BadInput(f"{path}: {error}") from None


def read(path: PathLike, columns: Optional[Union[str, Sequence[str]]] = None) -> Table:
    """Reads a trajectory: CSV, or HDF5 if the name ends in .h5; also files of other programs. Also a section in CSV.

    columns  for files without names: those of the columns from left to right, "-" for one to be passed over

    Returns a table of shape (rows, columns).
    """
    name = os.fspath(path)
    table = _read_section(name) if columns is None else None
    if table is not None:
        return table
    if columns is not None and not isinstance(columns, str):
        columns = ",".join(columns)
    ctx, new, notes = context(), new_record(), Notes()
    with interruptible():
        status = lib.iso_foreign_read(ctx, encoded(name), None if columns is None else encoded(columns),
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
    ctx, record, new, notes = context(), as_record(table), new_record(), Notes()
    with interruptible():
        status = lib.iso_foreign_convert(ctx, record.pointer, encoded(to), float(tolerance), float(row_tolerance),
                                         bool(shift_J),
                                         byref(new), *notes.arguments)
    check(status, ctx)
    notes.tell()
    return from_record(new)

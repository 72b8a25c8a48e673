"""Files of tables, and conversion of trajectories to the other model."""

from __future__ import annotations

import os
from ctypes import byref
from typing import Optional, Sequence, Union

from . import _errors, _hdf5
from ._library import Notes, check, context, encoded, interruptible, lib, whole
from ._table import Table, as_record, from_record, new_record

PathLike = Union[str, bytes, "os.PathLike[str]"]


def read(path: PathLike, columns: Optional[Union[str, Sequence[str]]] = None) -> Table:
    """Reads a table: CSV, or HDF5 if the name ends in .h5; a trajectory also from files of other programs.

    columns  for files without names: those of the columns from left to right, "-" for one to be passed over

    Returns a table of shape (rows, columns), whose kind is that of the file: "trajectory", "section", "chaos", ...
    """
    if columns is not None and not isinstance(columns, str):
        columns = ",".join(columns)
    ctx, new, notes, name = context(), new_record(), Notes(), encoded(path)
    with _hdf5.calls(name), interruptible():
        status = lib.iso_foreign_read(ctx, name, None if columns is None else encoded(columns),
                                      byref(new), *notes.arguments)
    check(status, ctx)
    notes.tell()
    return from_record(new)


def write(table: Table, path: PathLike, *, digits: Union[int, str] = 17) -> None:
    """Writes a table: CSV, or HDF5 if the name ends in .h5. The file appears when it is whole.

    digits  1 to 17, or "hex": C's %a. With 17 and "hex" the numbers read back exactly.

    In trajectories and sections a number that is not finite is refused.
    """
    ctx, record, name = context(), as_record(table), encoded(path)
    number = 0 if digits == "hex" else whole("digits", digits, 1, 17)
    with _hdf5.calls(name), interruptible():
        status = lib.iso_foreign_write(ctx, name, record.pointer, number, encoded(table.kind))
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

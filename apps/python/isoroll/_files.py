"""Files of tables, and conversion of trajectories to the other model."""

from __future__ import annotations

from ctypes import byref
from typing import Optional, Sequence, Union

from . import _errors
from ._library import Notes, check, context, encoded, interruptible, lib
from ._table import PathLike, Table, as_record, from_record, new_record


def read(path: PathLike, columns: Optional[Union[str, Sequence[str]]] = None) -> Table:
    """Reads a table of any kind, old ones too: CSV, or HDF5; a trajectory also from files of other programs.

    columns  for files without names: those of the columns from left to right, "-" for one to be passed over

    Returns a table of the class of its kind: Trajectory, Section, Chaos, Periodic, Branch, Chart, Splitting, Cost,
    Sweep.
    """
    if columns is not None and not isinstance(columns, str):
        columns = ",".join(columns)
    ctx, new, notes = context(), new_record(), Notes()
    with interruptible():
        status = lib.iso_foreign_read(ctx, encoded(path), None if columns is None else encoded(columns),
                                      byref(new), *notes.arguments)
    check(status, ctx)
    notes.tell()
    return from_record(new)


def write(table: Table, path: PathLike, *, digits: Union[int, str] = 17) -> None:
    """Writes a table: table.write(path), which see."""
    if not isinstance(table, Table):
        raise TypeError(f"a Table is needed, not {type(table).__name__}: see isoroll.trajectory")
    table.write(path, digits=digits)


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

"""Files of tables, and conversion of trajectories to the other model."""

from __future__ import annotations

import os
from ctypes import byref
from typing import Optional, Sequence, Union

from numpy.typing import ArrayLike

from . import _errors, _hdf5
from ._library import Notes, check, context, encoded, interruptible, lib, listed
from ._kinds import Trajectory
from ._scene import SceneLike
from ._study import ask
from ._table import PathLike, Table, as_record, from_record, new_record


def read(path: PathLike, columns: Optional[Union[str, Sequence[str]]] = None) -> Table:
    """Reads a table of any kind, old ones too: CSV, or HDF5; a trajectory also from files of other programs.

    columns  for files without names: those of the columns from left to right, "-" for one to be passed over

    Returns a table of the class of its kind: Trajectory, Section, Chaos, Periodic, Branch, Chart, Splitting, Cost,
    Sweep.
    """
    named = None if columns is None else encoded(listed("columns", columns))
    ctx, new, notes, name = context(), new_record(), Notes(), encoded(path)
    with _hdf5.calls(name), interruptible():
        status = lib.iso_record_read(ctx, name, named, byref(new), *notes.arguments)
    check(status, ctx)
    notes.tell()
    return from_record(new)


def write(table: Table, path: PathLike, *, digits: Union[int, str] = 17) -> None:
    """Writes a table: see table.write."""
    if not isinstance(table, Table):
        raise _errors.BadType(f"a Table is needed, not {type(table).__name__}: see isoroll.trajectory")
    table.write(path, digits=digits)


def as_table(source: Union[Table, PathLike], columns: Optional[Union[str, Sequence[str]]] = None) -> Table:
    """A table as it is, or that of a file."""
    if isinstance(source, Table):
        return source
    if not isinstance(source, (str, bytes, os.PathLike)):
        raise _errors.BadType(f"a Table is needed, or the path of its file, not {type(source).__name__}: see "
                              "isoroll.trajectory")
    return read(source, columns)


def convert(table: Union[Table, PathLike], to: str, *, tol: float = 1e-14, k: Optional[float] = None,
            J: Optional[ArrayLike] = None, eps: Optional[float] = None, h: Optional[float] = None,
            scene: Optional[SceneLike] = None, columns: Optional[Union[str, Sequence[str]]] = None,
            row_tolerance: float = 1e-5, shift_J: bool = False) -> Trajectory:
    """Converts a trajectory to the model `to`, "ball" or "point".

    table          a trajectory, or the path of its file; k, J and h or eps are in its lines
    tol            relative error of the other model's clock, from row to row
    k, J, eps, h   if the lines do not say them
    scene          take k, J and the effects from this scene, if the lines do not say them
    columns        of a file without names: those of its columns from left to right, "-" for one passed over
    row_tolerance  how far a row may be from a unit vector and from a right angle: for rows with few digits
    shift_J        k = -1: a point off H = 0 becomes a free ball with the moments J + E/eps

    Returns a table with a row for each row: the clock, then omega, n or M, gamma. A warning says if the rows do not
    solve the equations that their lines state.
    """
    options = {"to": to, "tol": tol, "k": k, "J": J, "eps": eps, "h": h, "row_tolerance": row_tolerance,
               "shift_J": shift_J}
    found = ask("convert", scene, as_record(as_table(table, columns)), options, lambda rows, *_: rows)
    assert isinstance(found, Trajectory)
    return found

"""What a picture of a table shows: the tables that the library makes to be drawn (lib/picture/picture.h)."""

from __future__ import annotations

from ctypes import byref, c_char_p, c_void_p
from typing import Any, Dict, List, Optional, Sequence, Tuple, Union

from . import _errors
from ._kinds import Chaos, Comparison, Section
from ._library import check, context, doubles, encoded, interruptible, items, lib, listed
from ._table import VECTORS, Table, as_record, from_record, new_record

TABLES = 16  # ISO_PICTURE_TABLES of lib/picture/picture.h
WindowLike = Union[None, str, Sequence[Sequence[float]]]


class Picture(Dict[str, Table]):
    """What is to be seen of a table: the tables that are drawn, by their names.

    layout  the name of what draws them: a template of the command, a function of _plot_layouts.py
    """

    def __init__(self, layout: str, tables: Sequence[Table]) -> None:
        super().__init__((table.kind, table) for table in tables)
        self.layout, self._lines = layout, tables[0].lines.text

    def text(self, key: str) -> str:
        """A line of the picture; "": there is none."""
        return self._lines.get(key, "")

    def number(self, key: str) -> float:
        """The same as a number; 0: there is none."""
        return float(self.text(key) or 0)


def _given(table: Table, over: Sequence[Table]) -> List[Table]:
    """The tables of which the picture is made: the library knows what each further one adds."""
    parts: Tuple[Optional[Table], ...] = ()
    if isinstance(table, Chaos) and table.indicators and table.share is None:
        table, *parts = table.indicators.values()
    elif isinstance(table, Section):
        parts = (table.point,)
    elif isinstance(table, Comparison):
        parts = (table.ball, table.point)
    return [table, *(part for part in parts if part is not None), *over]


def picture_of(table: Table, over: Sequence[Table] = (), **options: Optional[str]) -> Picture:
    """The picture of a table. Its notes become warnings."""
    records, ctx = [as_record(each) for each in _given(table, over)], context()
    given = (c_void_p * (len(records) + 1))(*(record.pointer for record in records), None)
    text = "\n".join(f"{key}={value}" for key, value in options.items() if value is not None)
    made, layout = (c_void_p * TABLES)(), c_char_p()
    try:
        with interruptible():
            status = lib.iso_picture_of(ctx, given, encoded(text), byref(layout), made)
    finally:
        news = [new_record() for _ in range(TABLES)]
        for new, pointer in zip(news, made):
            new.value = pointer
    check(status, ctx)
    found = Picture((layout.value or b"").decode(), [from_record(new) for new in news if new.value])
    if found.text("note"):
        _errors.warn(found.text("note"))
    return found


# --- what is asked for ----------------------------------------------------------------------------------------------


def wishes(value: Optional[str] = None, columns: Union[None, str, Sequence[str]] = None, window: WindowLike = None,
           over: Union[Table, Sequence[Table]] = ()) -> Tuple[List[Table], Dict[str, Optional[str]]]:
    """Further tables, and options as the library and the command take them."""
    if columns is not None:
        columns = listed("columns", columns)
        if columns.count(",") != 1:
            raise _errors.BadArgument(f"columns is {columns!r:.60}: it must be two names, such as ('t', 'n3')")
    if window is not None and not isinstance(window, str):
        bounds = doubles("window", window)
        if bounds.shape != (2, 2):
            raise _errors.BadArgument("window must be two ranges: ((l0, l1), (x0, x1)), or '0.5:1.2,-0.3:0.3'")
        window = ",".join(f"{low!r}:{high!r}" for low, high in bounds.tolist())
    tables = items("over", [over] if isinstance(over, Table) else over, Table)
    return tables, {"value": value, "columns": columns, "window": window}


def curves(table: Table, columns: Optional[str]) -> List[Optional[str]]:
    """X,Y for each curve: a vector has one for each component."""
    x, _, y = (columns or "").partition(",")
    return [f"{x},{part}" for part in VECTORS[y]] if y in table and y not in table.columns else [columns]

"""What pictures of tables share: colours, axes, titles."""

from __future__ import annotations

from typing import Any, List, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _errors
from ._table import Table

# Okabe and Ito's colours, for all kinds of sight, and paler ones for the far side of a sphere
BLUE, VERMILLION, GREEN, ORANGE, PINK, SKY = "#0072B2", "#D55E00", "#009E73", "#E69F00", "#CC79A7", "#56B4E9"
FAR_BLUE, GREY, DARK, LINE = "#A9CDE2", "#B0B0B0", "#606060", "#707070"
PI_TICKS = ((-np.pi, -np.pi / 2, 0, np.pi / 2, np.pi), ("−π", "−π/2", "0", "π/2", "π"))
Numbers = NDArray[np.float64]


def pyplot() -> Any:
    try:
        import matplotlib.pyplot as found
    except ImportError:
        raise ImportError("plot needs matplotlib, which is not installed here: pip install matplotlib; `isoroll "
                          "plot` draws files without it") from None
    return found


# --- axes -----------------------------------------------------------------------------------------------------------


def axes_of(ax: Any, count: int, size: Tuple[float, float], rows: int = 1) -> List[Any]:
    """`count` axes: those given, or those of a new figure."""
    if ax is None:
        figure = pyplot().figure(figsize=size, layout="constrained")
        made = list(np.ravel(figure.subplots(rows, -(-count // rows), squeeze=False)))
        for extra in made[count:]:
            extra.set_visible(False)
        return made[:count]
    given = list(np.ravel(np.asarray(ax, dtype=object)))
    if not all(hasattr(each, "scatter") for each in given):
        raise _errors.BadType("ax must be Axes of matplotlib, not "
                              f"{', '.join(type(each).__name__ for each in given[:1])}; isoroll.plot(table, 'a.svg') "
                              "writes a picture")
    if len(given) != count:
        raise _errors.BadArgument(f"ax has {len(given)} Axes, this picture has {count} parts")
    return given


def given(axes: Sequence[Any]) -> Any:
    """One Axes, or an array of them."""
    if len(axes) == 1:
        return axes[0]
    array = np.empty(len(axes), dtype=object)
    array[:] = axes
    return array


def plain(ax: Any) -> None:
    """Axes on the left and below, and a grid."""
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)
    ax.grid(color="#DDE1E5", lw=0.8)
    ax.set_axisbelow(True)


def name_of(table: Table, column: str) -> str:
    unit = table.units.get(column, "")
    return f"{column} [{unit}]" if unit else column


def title_of(table: Table, title: Optional[str]) -> str:
    lines = table.lines
    if title is not None or "title" in lines:
        return title if title is not None else str(lines.text["title"])
    if "k" not in lines or "J" not in lines:
        return table.kind
    return f"{table.kind}: k = {lines['k']:.6g}, J = " + " ".join(f"{x:.6g}" for x in np.ravel(lines["J"]))


def needs(table: Table, *columns: str) -> None:
    for name in columns:
        if name not in table:
            raise _errors.BadInput(f"no picture: the table has no column '{name}', it has {', '.join(table.columns)}")
    if len(table) == 0:
        raise _errors.BadInput("no picture: the table has no rows")


def axis_of(table: Table) -> int:
    """The axis a of the section, from 0."""
    text = table.lines.text.get("axis", table.lines.text.get("section.axis", ""))
    if text[:1] not in ("1", "2", "3"):
        raise _errors.BadInput("no picture: the table does not say its axis, in a line '# axis: 3'")
    return int(text[0]) - 1

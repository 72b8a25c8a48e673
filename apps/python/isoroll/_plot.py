"""Pictures of tables with matplotlib, as the command's templates draw them (apps/isoroll/pictures). Nothing that has a
meaning is computed here: the library says what is to be seen (_picture.py)."""

from __future__ import annotations

import os
from typing import Any, List, Optional, Sequence, Set, Union

import numpy as np

from . import _errors
from ._files import as_table
from ._library import encoded
from ._picture import WindowLike, curves, picture_of, wishes
from ._table import PathLike, Table

#: open axes with a grid: of new figures; axes of the caller are as they are
_STYLE = {"axes.titlesize": "medium", "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
          "axes.axisbelow": True, "grid.color": "#DDE1E5", "legend.fontsize": "small", "legend.frameon": False}


def pyplot() -> Any:
    try:
        import matplotlib.pyplot as found
    except ImportError:
        raise ImportError("plot needs matplotlib, which is not installed here: pip install matplotlib; "
                          "table.picture and `isoroll plot` draw files without it") from None
    return found


def plain(text: str) -> str:
    """A text that has no formulas, of one line, as long as there is room."""
    text = "".join(c if c.isprintable() else " " for c in text).replace("$", r"\$")
    return text if len(text) <= 110 else text[:109] + "…"


def parts(ax: Any, rows: Sequence[str], heights: Sequence[float], width: float = 9) -> List[Any]:
    """The axes of a picture: those given, or of a new figure, in rows such as ("AB", "CC"), in inches."""
    names = sorted(set("".join(rows)) - {"."})
    if ax is None:
        figure = pyplot().figure(figsize=(width, sum(heights)), layout="constrained")
        made = figure.subplot_mosaic("\n".join(rows), gridspec_kw={"height_ratios": heights})
        return [made[name] for name in names]
    given = list(np.ravel(np.asarray(ax, dtype=object)))
    if not all(hasattr(each, "scatter") for each in given):
        raise _errors.BadType(f"ax must be Axes of matplotlib, not {type(given[0]).__name__}; "
                              "isoroll.plot(table, 'a.svg') writes a picture")
    if len(given) != len(names):
        raise _errors.BadArgument(f"ax has {len(given)} Axes, this picture has {len(names)} parts")
    return given


def keys(axes: Sequence[Any], own: bool) -> None:
    """Keys of axes that have none yet: below those of a new figure. What another one says is not said again."""
    said: Set[str] = set()
    for at in axes:
        labels = set(at.get_legend_handles_labels()[1])
        if at.get_legend() is None and not labels <= said:
            width, height = at.get_position().size * at.figure.get_size_inches()
            ncol = min(max(int(20 * width / (5 + max(map(len, labels)))), 1), 4)  # as many as there is room for
            at.legend(**({"loc": "upper center", "bbox_to_anchor": (0.5, -0.5 / height), "ncol": ncol} if own else {}))
        said |= labels


def draw(table: Table, ax: Any = None, *, title: Optional[str] = None, **how: Any) -> Any:
    """Draws a table: see plot."""
    with pyplot().rc_context(_STYLE):
        from ._plot_layouts import LAYOUTS
        over, options = wishes(**how)
        orbits = [table.orbit(i) for i in range(len(table))] if table.array.ndim > 2 else [table]  # type: ignore
        pictures = [picture_of(each, over, **{**options, "columns": columns})
                    for each in orbits for columns in curves(table, options["columns"])]
        first, batch = pictures[0], len(orbits) > 1 and not options["columns"]
        if first.layout not in LAYOUTS:
            raise _errors.BadInput(f"matplotlib has no layout '{first.layout}' for a table '{table.kind}': "
                                   "table.picture(FILE) draws it by the command's template")
        axes = LAYOUTS["batch" if batch else first.layout](pictures if batch or options["columns"] else first, ax)
        keys(axes, ax is None)
        title = (f"{len(orbits)} orbits" if batch else first.text("title")) if title is None else title
        if len(axes) == 1:
            axes[0].set_title(plain(title))
            return axes[0]
        if ax is None:
            axes[0].figure.suptitle(plain(title))
            units = "lengths, times and forces are in the units of the scene" if first.text("above") else ""
            words = [plain(text) for text in (first.text("noise"), units) if text and not batch]
            axes[0].figure.supxlabel("\n".join(words), fontsize="small")
    found = np.empty(len(axes), dtype=object)
    found[:] = axes
    return found


def plot(table: Union[Table, PathLike], output: Optional[PathLike] = None, *, ax: Any = None,
         value: Optional[str] = None, columns: Union[None, str, Sequence[str]] = None,
         title: Optional[str] = None, window: WindowLike = None, over: Union[Table, Sequence[Table]] = ()) -> Any:
    """Draws any table with matplotlib, as `isoroll plot` does.

    table    a table, or the path of its file
    output   the file of the picture: .svg, .png, .pdf, ...; None: none is written
    ax       where to draw: Axes, or as many as the picture has parts; None: a new figure
    value    of a sweep: which column is drawn, such as "splitting_m"
    columns  draws only these two: ("t", "n3") is n3 over t; a vector is three curves
    title    above the picture
    window   of a section: this part, ((l0, l1), (x0, x1))
    over     of a section: tables that add to it: verdicts of chaos, periodic orbits, splittings

    Returns the Axes, or an array of them where the picture has several parts. What is grey, dashed, marked is found by
    the library, the same for the command and for this function; the gid of an artist says what it is, such as
    "above:contact:near". table.picture(FILE) is the command's own picture.
    """
    found = draw(as_table(table), ax, title=title, value=value, columns=columns, window=window, over=over)
    if output is not None:
        np.ravel(np.asarray(found, dtype=object))[0].figure.savefig(os.fsdecode(encoded(output)))
    return found

"""Pictures of tables with matplotlib, in the style of the command's (apps/isoroll/plot): curves and charts."""

from __future__ import annotations

import inspect
import os
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _errors
from ._plot_orbits import draw_chaos, draw_comparison, draw_periodic, draw_section, draw_trajectory
from ._plot_parts import (BLUE, DARK, FAR_BLUE, GREEN, LINE, Numbers, ORANGE, PINK, SKY, VERMILLION, axes_of, given,
                           name_of, needs, plain, pyplot, title_of)
from ._files import as_table
from ._library import encoded, listed
from ._table import VECTORS, PathLike, Table


# --- curves and charts ----------------------------------------------------------------------------------------------


def _branches(table: Table, ax: Any, title: Optional[str] = None) -> Any:
    """Trace and place of followed orbits over what varies."""
    needs(table, "branch", "u", "trace", "event")
    axes, over = axes_of(ax, 2, (9, 6.4), 2), table.columns[3]
    for i, branch in enumerate(np.unique(table["branch"])):
        rows = (table["branch"] == branch) & (table["event"] == "")
        colour = (BLUE, VERMILLION, GREEN, ORANGE, PINK, SKY, "black")[i % 7]
        axes[0].plot(table[over][rows], table["trace"][rows], color=colour, lw=1.5)
        axes[1].plot(table[over][rows], 2 / np.pi * table["u"][rows], color=colour, lw=1.5)
    for level in (2, -2):
        axes[0].axhline(level, color=LINE, lw=1, ls="--")
    axes[0].set(ylim=(-6, 6), ylabel="trace", title=title_of(table, title))
    axes[1].set(ylim=(0, 1), ylabel="place on the line: 2 u/π", xlabel=over)
    return given(axes)


def _chart(table: Table, ax: Any, title: Optional[str] = None) -> Any:
    """Where the rotations are stable, and the borders."""
    needs(table, "kind", "least", "greatest")
    axes, kind, (right, up) = axes_of(ax, 2, (9, 4.8)), table["kind"], table.columns[1:3]
    edge = 2 + 1e-9  # with equal moments a trace is -2 up to rounding
    for at, name in zip(axes, ("least", "greatest")):
        trace = table[name]
        for rows, look in (((np.abs(trace) <= edge) & (kind == "grid"), dict(color="#CFE3F2", label="stable")),
                           ((trace < -edge) & (kind == "grid"), dict(color=ORANGE, label="T < −2")),
                           ((trace > edge) & (kind == "grid"), dict(color=VERMILLION, label="T > 2")),
                           (np.isfinite(trace) & (kind == "border"), dict(color="black", s=1, label="T = 2, −2"))):
            at.scatter(table[right][rows], table[up][rows], **{"s": 4, "marker": "s", "linewidths": 0, **look})
        at.set(title=f"rotation about the axis of the {name} moment", xlabel=right, ylabel=up)
    axes[0].legend(loc="best", fontsize="small", markerscale=2)
    if ax is None:
        axes[0].figure.suptitle(title_of(table, title))
    return given(axes)


def _splitting(table: Table, ax: Any, title: Optional[str] = None) -> Any:
    """|m| over k or the level, with its error."""
    needs(table, "k", "level", "m", "error")
    over = "level" if len(table) > 1 and table["k"][0] == table["k"][1] else "k"
    at, m, error = axes_of(ax, 1, (9, 4.7))[0], table["m"], table["error"]
    good = np.isfinite(m) & (error > 0) & (table["zero"] != 1 if "zero" in table else True)
    known = np.abs(m) >= 10 * error
    signs = (m > 0, BLUE, "m > 0"), (m < 0, VERMILLION, "m < 0")
    for rows, colour, word in ((good & known & sign, colour, word) for sign, colour, word in signs):
        if rows.any():
            at.errorbar(table[over][rows], np.abs(m[rows]), error[rows], fmt="o", ms=4, color=colour, label=word)
    if (rows := good & ~known).any():
        at.plot(table[over][rows], np.abs(m[rows]) + error[rows], "v", color=DARK, label="m below")
    at.set(yscale="log", xlabel=over, ylabel="|m|", title=title_of(table, title))
    if good.any():
        at.legend(frameon=False)
    plain(at)
    return at


def _cost(table: Table, ax: Any, title: Optional[str] = None) -> Any:
    """Error against time: a panel for each backend, a line for each method."""
    needs(table, "backend", "method", "error", "total")
    error, seconds = np.maximum(table["error"], 1e-17), table["total"]
    backend, method = table["backend"], table["method"]
    good = np.isfinite(error) & (seconds > 0)
    panels = [name for name in ("ball", "point") if (good & (backend == name)).any()] or ["exact"]
    axes = axes_of(ax, len(panels), (4.7 * len(panels), 5))
    names = list(dict.fromkeys(method[good & (method != "")].tolist()))
    colours = dict(zip(names, (BLUE, VERMILLION, GREEN, "black", PINK, ORANGE, SKY, "#7A5195", "#404040", "#8C6D1F")))
    for at, name in zip(axes, panels):
        for word in names:
            if (rows := good & (backend == name) & (method == word)).any():
                first = word in colours
                at.plot(error[rows], seconds[rows], "o-" if first else "-", ms=4, lw=1.4 if first else 0.8,
                        color=colours.get(word, "#B4BABF"), label=word if first else None)
        if (rows := good & (backend == "exact")).any():
            at.plot(error[rows], seconds[rows], "k*", ms=10, ls="", label="closed solution")
        at.set(xscale="log", yscale="log", title=name, xlabel="largest relative error of (ω, n)")
        at.invert_xaxis()
        if (bound := table.lines.get("uncertainty", 0.0)) and bound > np.min(error[good]):
            at.axvspan(np.min(error[good]) / 2, bound, color="#E4E7EA", lw=0, label="below what is known")
        at.legend(fontsize="x-small")
        plain(at)
    axes[0].set_ylabel("processor time in seconds")
    if ax is None:
        axes[0].figure.suptitle(title_of(table, title))
    return given(axes)


# --- sweeps ---------------------------------------------------------------------------------------------------------

_MOST_MAPS = 9
_ERRORS = {"chaos_share": ("chaos_share_low", "chaos_share_high"), "splitting_m": (None, "splitting_error"),
           "splitting_x": (None, "splitting_x_error"), "frequencies_f1_t": (None, "frequencies_f1_error"),
           "frequencies_f2_t": (None, "frequencies_f2_error"), "frequencies_rotation": (None, None),
           **{f"rotations_trace{i}": (None, f"rotations_error{i}") for i in (1, 2, 3)},
           "backends_largest": (None, None), "contact_time": (None, None)}


def _measured(table: Table, value: Optional[str]) -> Tuple[List[str], str]:
    """The columns that vary from row to row, and the one that is drawn."""
    own = [name for name in table.columns if name not in ("point", "status", "reason")]
    groups = [name.partition("/") for name in str(table.lines.text.get("names", table.lines.text.get("columns", ""))).split()]
    varying = [name for group, _, name in groups if group == "vary"]
    measured = [name for name in own if name not in varying and name not in table._words]
    if value is None:
        value = next((name for name in (*_ERRORS, *measured) if name in measured and name != "state_t"), None)
    if value not in measured:
        raise _errors.BadInput(f"no picture: '{value}' is not measured; there are {', '.join(measured)}")
    return [name for name in varying if np.ptp(table[name]) > 0], value


def _map(table: Table, at: Any, rows: NDArray[np.bool_], places: Mapping[str, Numbers], value: str) -> Any:
    (xname, x), (yname, y) = places.items()
    z = table[value]
    drawn = at.scatter(x[rows], y[rows], c=z[rows], s=max(4, 12000 / rows.sum()), marker="s", linewidths=0,
                       vmin=np.nanmin(z), vmax=np.nanmax(z), cmap="viridis")
    at.set(xlabel=xname, ylabel=yname)
    return drawn


def _line(table: Table, at: Any, xname: str, x: Numbers, value: str) -> None:
    order, z, (low, high) = np.argsort(x, kind="stable"), table[value], _ERRORS.get(value, (None, None))
    if high in table:
        band = (table[low], table[high]) if low else (z - table[high], z + table[high])
        at.fill_between(x[order], band[0][order], band[1][order], color=FAR_BLUE, alpha=0.7, lw=0,
                        label="95 % confidence, undecided orbits included" if low else "± estimated error")
    at.plot(x[order], z[order], "o-", ms=3, lw=1.4, color=BLUE)
    at.set(xlabel=xname, ylabel=value)
    plain(at)


def _sweep(table: Table, ax: Any, value: Optional[str] = None, title: Optional[str] = None) -> Any:
    """A value over one number as a curve with its error; over two as a map; of a third number several maps."""
    needs(table, "status")
    varying, value = _measured(table, value)
    places: Dict[str, Numbers] = {name: table[name] for name in varying}
    if {"J1", "J2", "J3"} <= set(varying):
        J = [places.pop(f"J{i}") for i in (1, 2, 3)]
        places = {"J1/J3": J[0] / J[2], "J2/J3": J[1] / J[2], **places}
    values = {name: np.unique(column) for name, column in places.items()}
    panel = min((name for name in places if "/" not in name), key=lambda name: len(values[name]), default="")
    if len(places) != 3 or len(values[panel]) > _MOST_MAPS:
        panel = ""
    if len(places) not in (1, 2, 3 if panel else 2):
        raise _errors.BadInput(f"no picture: {', '.join(places) or 'nothing'} varies: a picture shows one or two "
                               f"numbers, and a third one of at most {_MOST_MAPS} values")
    maps = values[panel] if panel else [None]
    which = places.pop(panel, None)
    rows = 1 + (len(maps) > 3) + (len(maps) > 6)
    axes = axes_of(ax, len(maps), (9, 4.8 if len(maps) == 1 else 3.6 * rows), rows)
    for at, this in zip(axes, maps):
        if len(places) == 1:
            _line(table, at, *next(iter(places.items())), value)
        else:
            shown = np.ones(len(table), dtype=bool) if which is None else which == this
            drawn = _map(table, at, shown, places, value)
            at.set_title("" if which is None else f"{panel} = {this:.6g}")
        if "k" in places and list(places)[0] == "k":
            marked = [k for k in (-1, 1) if np.min(places["k"]) <= k <= np.max(places["k"])]
            for k in marked:
                at.axvline(k, color="#404040", lw=1.2, ls="--", label="k = ±1: integrable" if k == marked[0] else None)
        if len(places) == 1 and at.get_legend_handles_labels()[0]:
            at.legend(framealpha=1, edgecolor="none")
    if len(places) == 2:
        axes[0].figure.colorbar(drawn, ax=axes, label=value)
    if ax is None:
        axes[0].figure.suptitle(title or f"{value}: {len(table)} points")
    return given(axes)


# --- all ------------------------------------------------------------------------------------------------------------

def _curve(table: Table, ax: Any, x: str, y: str, title: Optional[str] = None) -> Any:
    needs(table, x, y)
    axes = axes_of(ax, 1, (9, 4.8))
    for name in VECTORS[y] if y not in table.columns else (y,):
        axes[0].plot(np.atleast_2d(table[x].T).T, np.atleast_2d(table[name].T).T, lw=1.2, label=name)
    if y not in table.columns:
        axes[0].legend(frameon=False)
    axes[0].set(xlabel=name_of(table, x), ylabel=name_of(table, y), title=title or "")
    plain(axes[0])
    return axes[0]


_DRAW: Dict[str, Callable[..., Any]] = {
    "trajectory": draw_trajectory, "section": draw_section, "chaos": draw_chaos, "periodic": draw_periodic,
    "periodic follow": _branches, "periodic chart": _chart, "splitting": _splitting, "cost": _cost,
    "compare": draw_comparison, "sweep": _sweep, "sweep part": _sweep, "batch": draw_trajectory}


def draw(table: Table, ax: Any, how: Mapping[str, Any]) -> Any:
    """Draws a table by its kind, or the column y over x."""
    pyplot()
    if how.get("columns") is not None:
        names = listed("columns", how["columns"]).split(",")
        if len(names) != 2:
            raise _errors.BadArgument(f"columns is {how['columns']!r:.60}: it must be two names, such as ('t', 'n3')")
        return _curve(table, ax, names[0], names[1], how.get("title"))
    how = {key: value for key, value in how.items() if value is not None}
    function = _DRAW.get(table.kind)
    if function is None:
        raise _errors.BadInput(f"no picture of a table of kind '{table.kind}': table.plot(columns=(X, Y)) draws a "
                               f"column over another; it has {', '.join(table.columns)}")
    takes = [name for name in inspect.signature(function).parameters if name not in ("table", "ax")]
    for name in how:
        if name not in takes:
            raise TypeError(f"the plot of a table of kind '{table.kind}' takes ax, columns, {', '.join(takes)}, not "
                            f"'{name}'")
    return function(table, ax, **how)


def plot(table: Union[Table, PathLike], output: Optional[PathLike] = None, *, ax: Any = None,
         value: Optional[str] = None, columns: Union[None, str, Sequence[str]] = None,
         title: Optional[str] = None) -> Any:
    """Draws any table with matplotlib, in the style of `isoroll plot`.

    table    a table, or the path of its file
    output   the file of the picture: .svg, .png, .pdf, ...; None: none is written
    ax       where to draw: Axes, or as many as the picture has parts; None: a new figure
    value    of a sweep: which column is drawn, such as "splitting_m"
    columns  draws only these two: ("t", "n3") is n3 over t; a vector is three curves
    title    above the picture

    Returns the Axes, or an array of them where the picture has several parts. Nothing is computed anew; of more than
    5000 rows of a path 5000 are drawn.
    """
    found = draw(as_table(table), ax, {"value": value, "columns": columns, "title": title})
    if output is not None:
        np.ravel(np.asarray(found, dtype=object))[0].figure.savefig(os.fsdecode(encoded(output)))
    return found

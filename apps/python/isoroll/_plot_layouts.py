"""The layouts of pictures in matplotlib, one for each template of the command (apps/isoroll/pictures/LAYOUT.gp), with
its colours, dashes and marks. A layout takes a picture and the caller's Axes, and returns the Axes."""

from __future__ import annotations

import textwrap
from typing import Any, Callable, Dict, List, Sequence

import numpy as np
from numpy.typing import NDArray

from ._picture import Picture
from ._plot import parts, plain, pyplot

# the colours of page.gp, by the same names
BLUE, VERMILLION, GREEN, PURPLE, SKY, ORANGE = "#0072B2", "#D55E00", "#009E73", "#8320E4", "#56B4E9", "#E8AA00"
DARK_RED, BLACK, WHITE, PALE_BLUE, PALE_YELLOW = "#8B1A00", "#000000", "#FFFFFF", "#CFE3F2", "#F7E3B0"
FAR_BLUE, FAR_VERMILLION, PALE_PURPLE, PALE_GREEN = "#A9CDE2", "#F0BE9B", "#D9A9C6", "#8FCBB4"
INK, AXES, HELP, OUTLINE, BEHIND, GREY = "#404040", "#606060", "#707070", "#8A939B", "#909090", "#B0B0B0"
OTHERS, NEAR_GRID, GRID, BAND, SPHERE = "#B4BABF", "#B9C0C7", "#DDE1E5", "#E8ECEF", "#F4F6F8"
STROKES = ((BLUE, "-"), (VERMILLION, (0, (8, 3))), (GREEN, (0, (8, 3, 2, 3))), (BLACK, (0, (2, 3))),
           (PURPLE, (0, (12, 4))), (ORANGE, "-"), (SKY, (0, (4, 4))), (BLUE, (0, (2, 2))),
           (GREEN, (0, (12, 3, 2, 3, 2, 3))), (ORANGE, (0, (5, 2))))
VIRIDIS = ("#440154", "#472C7A", "#3B518B", "#2C718E", "#21908D", "#27AD81", "#5CC863", "#AADC32", "#FDE725")
VIRIDIS_DOTS = ("#440154", "#472977", "#3D4B88", "#30698D", "#25868D", "#25A186", "#43BB71", "#7ED14D", "#C8E02D")
EXPONENTS = (PALE_YELLOW, ORANGE, DARK_RED)
ANGLES = ((-np.pi, -np.pi / 2, 0, np.pi / 2, np.pi), ("−π", "−π/2", "0", "π/2", "π"))
DASHED = (0, (6, 4))
Numbers = NDArray[np.float64]
Rows = NDArray[np.bool_]


def stroke(i: int) -> Dict[str, Any]:
    """Colour and dash of the i-th of several lines, from 0."""
    return {"color": STROKES[i % len(STROKES)][0], "ls": STROKES[i % len(STROKES)][1], "lw": 1.5}


def scale(colours: Sequence[Any]) -> Any:
    return pyplot().matplotlib.colors.LinearSegmentedColormap.from_list("isoroll", colours)


def where(rows: Rows, values: Numbers) -> Numbers:
    """Numbers of these rows; of others NaN, a gap of a line."""
    return np.where(rows, values, np.nan)


def dots(at: Any, table: Any, x: str, y: str, rows: Any = slice(None), **look: Any) -> Any:
    return at.scatter(table[x][rows], table[y][rows], **look)


def bar(drawn: Any, axes: Any, words: str) -> None:
    """A scale of colours, which is no image: a file of vectors has no pixels."""
    drawn.figure.colorbar(drawn, ax=axes, label=words).solids.set(rasterized=False, edgecolor="face")


def areas(at: Any, corners: Sequence[Any], **look: Any) -> Any:
    """Filled areas, which meet without a seam."""
    drawn = pyplot().matplotlib.collections.PolyCollection(corners, linewidths=0.4, **look)
    at.add_collection(drawn)
    at.autoscale_view()
    return drawn


# --- spheres --------------------------------------------------------------------------------------------------------

SEEN = np.array([[-0.42261826174069944, 0.90630778703664996, 0.0],  # right, up, towards the eye, as in page.gp
                 [-0.36862823570066146, -0.17189417172037236, 0.91354545764260087],
                 [0.8279521875606311, 0.3860804504512761, 0.40673664307580021]])


def globe(at: Any, p: Picture, which: str) -> None:
    """The sphere itself, with meridians and parallels, and its axes."""
    a, m = np.append(np.linspace(0, 2 * np.pi, 73), np.nan), np.arange(6)[:, None] * np.pi / 6
    b = m[:5] - np.pi / 3
    lines = [[np.cos(a) * np.cos(m), np.cos(a) * np.sin(m), np.sin(a) + 0 * m],
             [np.cos(a) * np.cos(b), np.sin(a) * np.cos(b), 0 * a + np.sin(b)]]
    right, up, depth = SEEN @ np.hstack([np.reshape(each, (3, -1)) for each in lines])
    at.add_patch(pyplot().Circle((0, 0), 1, fc=SPHERE, ec=OUTLINE, zorder=0))
    at.plot(where(depth <= 0, right), up, color=GRID, lw=0.6, zorder=1)
    at.plot(where(depth >= 0, right), up, color=NEAR_GRID, lw=0.8, zorder=3)
    for of, *tip, number, x, y in zip(*(p["axes"][name] for name in p["axes"].columns)):
        if of == which:
            at.plot(tip[::2], tip[1::2], color=AXES, lw=1.2, zorder=2.5)
            at.text(x, y, f"{number:.0f}", ha="center", va="center", color=INK)
    at.set(xlim=(-1.25, 1.25), ylim=(-1.2, 1.25), aspect="equal", title=p.text("on_" + which))
    at.set_axis_off()


def path_on(at: Any, p: Picture, which: str, colour: str = BLUE, far: str = FAR_BLUE) -> None:
    """The path on the far side in a pale colour, then on the near one."""
    path, length = p[which], p.number(which + "_length")
    for near, side, shade, width in ((0, "far", far, 0.8), (1, "near", colour, 0.8 if length > 40 else 1.8)):
        look = {"lw": width} if length > 0 else {"ls": "", "marker": "o", "mew": 0,
                                                 "ms": 0.7 if p.number(which + "_rows") > 500 else 2}
        at.plot(where(path["near"] == near, path["right"]), path["up"], color=shade, zorder=2 + 2 * near,
                label=side + " side" if far == FAR_BLUE else None, gid=f"{which}:{side}", **look)


def sphere(at: Any, p: Picture, which: str) -> None:
    globe(at, p, which)
    path_on(at, p, which)
    for sign, marker in (("start", "o"), ("end", "^")):
        rows = (p["ends"]["of"] == which) & (p["ends"]["sign"] == sign)
        dots(at, p["ends"], "right", "up", rows, s=36, marker=marker, zorder=7, label=sign, linewidths=0,
             c=np.where(p["ends"]["near"][rows] == 1, BLACK, BEHIND), gid=f"{which}:{sign}")
    at.legend(loc="upper center", bbox_to_anchor=(0.5, 0.03), ncol=4)


def spheres_of(p: Picture) -> List[str]:
    return [which for which in ("ball", "point") if p.text("on_" + which)]


def batch(pictures: Sequence[Picture], ax: Any) -> List[Any]:
    """The paths of all orbits on the spheres of both models."""
    spheres = spheres_of(pictures[0])
    axes = parts(ax, ["AB"[:len(spheres)]], [4.7], 4.5 * len(spheres))
    for at, which in zip(axes, spheres):
        globe(at, pictures[0], which)
        for i, p in enumerate(pictures):
            if which in p:
                path_on(at, p, which, STROKES[i % len(STROKES)][0], NEAR_GRID)
    return axes


# --- trajectories ---------------------------------------------------------------------------------------------------


def support(at: Any, p: Picture, which: str) -> None:
    """The sphere or the plane on which the ball rolls, and the ball itself."""
    circle, marks, upward, lost = pyplot().Circle, p["marks"], "away" if which == "above" else "up", p.text("lost")
    if p.number("support") > 0:
        solid = {"fc": BAND, "lw": 1.5} if p.number("solid") else {"fill": False, "lw": 2.5}
        at.add_patch(circle((0, 0), p.number("support"), ec=OUTLINE, zorder=0, gid=which + ":support", **solid))
    if which == "side" and p.text("slope"):
        at.axline((0, p.number("at")), slope=p.number("slope"), color=OUTLINE, lw=3, zorder=0, gid="side:plane")
    for sign, look in (("start", {"fill": False, "ls": (0, (4, 3))}),
                       ("lost" if lost == "contact lost" else "end", {"fc": FAR_BLUE, "alpha": 0.35})):
        for i in np.flatnonzero((marks["sign"] == sign) & (p.number("ball") > 0) & (p.number("strip") == 0)):
            at.add_patch(circle((marks["right"][i], marks[upward][i]), p.number("ball"), ec=AXES, zorder=2, **look))


def view(at: Any, p: Picture, which: str) -> None:
    """The path in space, seen from above or from the side."""
    path, marks, upward, strip = p["path"], p["marks"], "away" if which == "above" else "up", p.number("strip")
    support(at, p, which)
    for of, pale, colour, dash, width in zip(p.text("paths").split(), (FAR_BLUE, FAR_VERMILLION), (BLUE, VERMILLION),
                                             ("-", DASHED), (1.6, 1)):
        look = {"ls": "", "marker": "o", "ms": 1} if p.number("dots") else {"ls": dash}
        for near, word in ((0, "behind"), (1, "near")):
            at.plot(where((path["of"] == of) & (path[which] == near), path["right"]), path[upward], zorder=near + width,
                    color=colour if near else pale, lw=width if near else 1, label=of if near else None,
                    gid=f"{which}:{of}:{word}", **look)
    for sign, marker, colour in (("start", "o", BLACK), ("end", "^", BLACK), ("lost", "x", VERMILLION)):
        if (rows := marks["sign"] == sign).any():
            dots(at, marks, "right", upward, rows, s=40, zorder=6, gid=f"{which}:{sign}", marker=marker, color=colour,
                 label=p.text("lost") if sign == "lost" else sign)
    at.set(xlabel=p.text("right_name"), ylabel=p.text(upward + "_name"), title=p.text(which))
    at.set_aspect("auto" if strip else "equal", "datalim")


def curve_of(at: Any, p: Picture, i: int, **look: Any) -> None:
    rows = p["values"]["curve"] == i + 1
    at.plot(p["values"]["x"][rows], p["values"]["y"][rows], marker="o" if rows.sum() == 1 else None, **look)


def chart(at: Any, p: Picture, which: str) -> None:
    """Curves of one chart: energies, pressure, paces; errors: drifts, or differences of two computations."""
    curves, errors = p["curves"], which in ("drift", "difference")
    rows = np.flatnonzero(curves["chart"] == which)
    at.set(xlabel=curves["over"][rows[0]], yscale="log" if errors else "linear")
    at.set_title({"drift": "relative drift of the integrals", "paces": "speed (mean 1)",
                  "difference": p.text("differences")}.get(which, ""), loc="left")
    colours = {"energy h": BLACK, "kinetic": BLUE, "pressure": BLUE, "ds/dt": BLUE}
    for j, i in enumerate(rows):
        name, low, high, on = curves["name"][i], curves["low"][i], curves["high"][i], at
        if curves["right"][i] == 1:
            on = at.twinx()
            at.set(zorder=1, facecolor="none")  # its curves are before those of the right axis
            on.set(ylabel=name, ylim=(0 if 0 <= low < 0.3 * high else low, high + 0.04 * (high - low) or 1))
        look = stroke(j) if errors else {"color": colours.get(name, ORANGE)}
        curve_of(on, p, i, gid=f"{which}:{name}", label=f"{name}  {high:.0e}" if errors else name, **look)
    for i, t in enumerate(p["losses"]["t"] if which in ("energies", "pressure") else ()):
        at.axvline(t, color=VERMILLION, ls=DASHED, gid=which + ":lost", label=None if i else p.text("lost"))
    at.legend(loc="upper left" if errors else "lower right", bbox_to_anchor=(1, 1), ncol=1 if errors else 4,
              title="largest" if errors else None)


def trajectory(p: Picture, ax: Any) -> List[Any]:
    """Views in space, spheres, charts, those that there are: in rows of two."""
    strip, all_charts = p.number("strip") > 0, list(dict.fromkeys(p["curves"]["chart"].tolist()))
    kinds = [*((view, which) for which in ("above", "side") if p.text(which)),
             *((sphere, which) for which in spheres_of(p)), *((chart, which) for which in all_charts)]
    rows: List[str] = []
    heights: List[float] = []
    for i, (draw, _) in enumerate(kinds):
        name, wide = chr(65 + i), draw is chart and i == len(kinds) - 1 or strip and i == 0
        if rows and rows[-1][1] == ".":
            rows[-1] = rows[-1][0] + name
        else:
            rows.append(2 * name if wide else name + ".")
            heights.append(2.6 if draw is chart or strip and i == 0 else 4.3)
    axes = parts(ax, ["A"] if rows == ["A."] else rows, heights, 4.7 if rows == ["A."] else 9)
    for at, (draw, which) in zip(axes, kinds):
        draw(at, p, which)
    return axes


def columns(pictures: Sequence[Picture], ax: Any) -> List[Any]:
    """One column over another; components of a vector, and orbits of a batch, are curves of one chart."""
    (at,) = axes = parts(ax, ["A"], [5])
    names = list(dict.fromkeys(p["curves"]["name"][0] for p in pictures))
    for i, p in enumerate(pictures):
        look = {**stroke(i), "label": names[i]} if len(names) == len(pictures) > 1 else stroke(0)
        curve_of(at, p, 0, gid="curve", **look)
    at.set(xlabel=pictures[0]["curves"]["over"][0], ylabel=names[0] if len(names) == 1 else "")
    if pictures[0].number("equal"):
        at.set_aspect("equal", "datalim")
    return axes


# --- one kind each --------------------------------------------------------------------------------------------------


def branch(p: Picture, ax: Any) -> List[Any]:
    points, events = p["points"], p["events"]
    trace, place = axes = parts(ax, ["A", "B"], [3.4, 3])
    for at, name in ((trace, "trace"), (place, "place")):
        for i in range(int(p.number("branches"))):
            rows = points["branch"] == i + 1
            at.plot(points["at"][rows], points[name][rows], gid=f"{name}:{i + 1}", **stroke(i))
        dots(at, events, "at", name, s=22, color=BLACK, zorder=5, gid=name + ":events")
        at.margins(x=0)
    for x, y, word in zip(events["at"], events["trace"], events["event"]):
        trace.annotate(word, (x, y), (4, 4), textcoords="offset points", rotation=15, fontsize="x-small")
    trace.axhspan(-2, 2, color=PALE_BLUE, lw=0, zorder=0, label="stable")
    trace.legend(loc="upper left")
    trace.set(ylim=(-6, 6), ylabel="trace")
    place.set(ylim=(0, 1), ylabel="place on the line: 2 u/π", xlabel=p.text("over"))
    return axes


CLASSES = ((0, PALE_BLUE, "stable"), (-1, ORANGE, "unstable, T < −2"), (1, VERMILLION, "unstable, T > 2 (T: trace)"),
           (2, GREY, "no such rotation"))


def stability(p: Picture, ax: Any) -> List[Any]:
    cells, borders = p["cells"], p["borders"]
    sides = np.stack([cells[name] for name in ("left", "bottom", "left", "top", "right", "top", "right", "bottom")], 1)
    axes = parts(ax, ["AB"], [4.8])
    for at, side, moment in zip(axes, (1, 2), ("least", "greatest")):
        for number, colour, name in CLASSES[:3 + int(p.number("none"))]:
            rows = (cells["side"] == side) & (cells["class"] == number)
            areas(at, sides[rows].reshape(-1, 4, 2), color=colour, label=name, gid=f"{moment}:{number}")
        dots(at, borders, "k", "up", borders["side"] == side, s=1, color=BLACK, label="border, T = ±2",
             gid=moment + ":border")
        at.margins(0)
        at.set(xlabel="k", ylabel=p.text("up"), title=f"rotation about the axis of the {moment} moment")
    return axes


def splitting(p: Picture, ax: Any) -> List[Any]:
    (at,) = axes = parts(ax, ["A"], [5])
    table = p["rows"]
    for sign, word, colour, look in ((1, "m > 0", BLUE, {"marker": "o"}), (0, "|m| below", AXES, {"marker": "v"}),
                                     (-1, "m < 0", VERMILLION, {"marker": "o", "facecolors": WHITE})):
        if (rows := table["sign"] == sign).any():
            over, low, high = (table[name][rows] for name in ("over", "low", "high"))
            at.vlines(over, low, high if sign else low, color=colour, lw=1.2)
            dots(at, table, "over", "size", rows, s=26, edgecolors=colour, label=word, zorder=3, gid=word,
                 **{"facecolors": colour, **look})
    at.set(yscale="log", xlabel=p.text("over"), ylabel="|m| (0: no splitting)")
    return axes


def cost(p: Picture, ax: Any) -> List[Any]:
    points, closed, panels, methods = p["points"], p["closed"], p["panels"]["name"], p["methods"]["name"]
    axes = parts(ax, ["AB"[:len(panels)]], [5.2], max(4.7 * len(panels), 6))
    for i, (at, panel) in enumerate(zip(axes, panels)):
        for series in np.unique(points["series"][points["panel"] == i + 1]):
            rows = points["series"] == series
            n = int(points["named"][rows][0]) - 1
            look = {**stroke(n), "marker": "os^vDos^vD"[n], "mfc": STROKES[n][0] if n < 5 else "none"} if n >= 0 else {
                "color": OTHERS, "lw": 0.8, "zorder": 1}
            at.plot(points["error"][rows], points["seconds"][rows], ms=5, label=methods[n] if n >= 0 else None,
                    gid=methods[n] if n >= 0 else "others", **look)
        at.plot([], [], color=OTHERS, lw=0.8, label="other methods" if p.number("nameless") else None)
        if len(closed):
            at.plot(closed["error"], closed["seconds"], "*", color=BLACK, ms=10, label="closed solution", gid="closed")
        at.set(xscale="log", yscale="log", xlabel="largest relative error of (ω, n)", title=panel)
        at.sharex(axes[0]) if i else None
        at.sharey(axes[0]) if i else None
    axes[0].autoscale()
    least, most = axes[0].get_xlim()
    axes[0].set(xlim=(most, least), ylabel="processor time in seconds")
    for at in axes:
        if p.number("uncertainty") > least:
            at.axvspan(least, min(p.number("uncertainty"), most), color=BAND, zorder=0, label="below what is known")
    return axes


def frequencies(p: Picture, ax: Any) -> List[Any]:
    lines, a = p["lines"], int(p.number("axis"))
    (at,) = axes = parts(ax, ["A"], [4.4])
    names = f"$n_{a % 3 + 1} + i\\,n_{(a + 1) % 3 + 1}$", f"$n_{a}$"
    for signal, name, colour, dash, face in ((1, names[0], BLUE, "-", BLUE), (2, names[1], VERMILLION, DASHED, "none")):
        if (rows := lines["signal"] == signal).any():
            at.vlines(lines["frequency"][rows], 1e-300, lines["amplitude"][rows], color=colour, lw=2, ls=dash)
            dots(at, lines, "frequency", "amplitude", rows, s=22, facecolors=face, edgecolors=colour, zorder=3,
                 label=name, gid=f"signal:{signal}")
    for x, y, word in zip(lines["frequency"], lines["amplitude"], lines["label"]):
        at.annotate(word, (x, y), (0, 6), textcoords="offset points", rotation=90, fontsize="x-small", ha="center")
    labelled = "; m,n: m times frequency 1 and n times frequency 2" if p.number("labels") else ""
    at.set(yscale="log", xlabel="frequency in t" + labelled, ylabel="amplitude",
              ylim=(10.0**(np.floor(np.log10(min(1, np.min(lines["amplitude"])))) - 1), 4))
    at.text(0.5, 0.95, p.text("warning"), color=VERMILLION, transform=at.transAxes, ha="center", fontsize="small")
    return axes


def momentum(p: Picture, ax: Any) -> List[Any]:
    areas_of, lines, h, f = p["parts"], p["lines"], p.number("at_h"), p.number("at_f")
    axes = parts(ax, ["AB"], [5.6])
    for at, over in zip(axes, (0, 1)):  # F, and F/h
        for number, name in zip(p["kinds"]["part"].astype(int), p["kinds"]["name"]):
            x, low, high = (areas_of[column][areas_of["part"] == number] for column in ("h", "low", "high"))
            at.fill_between(x, low / x**over, high / x**over, lw=0, label=name, gid=name,
                            color=(FAR_BLUE, PALE_YELLOW, PALE_PURPLE, PALE_GREEN)[number - 1])
        for number, name in zip(p["rotations"]["line"].astype(int), p["rotations"]["name"]):
            x, y = (lines[column][lines["line"] == number] for column in ("h", "f"))
            at.plot(x, y / x**over, label=name, lw=2, gid=name, color=(BLUE, BLACK, VERMILLION, INK)[number - 1],
                    ls=("-", (0, (8, 4)), (0, (12, 4)), (0, (2, 3)))[number - 1])
        at.scatter(h, f / h**over, s=45, color=BLACK, zorder=5, label="this orbit", gid="orbit")
        at.set(xlabel="energy h", ylabel=f"$F_{{{p.text('f')}}}$" + " / h" * over, xlim=(0, 2 * h))
    for _, name, x, y in zip(*(p["kinds"][column] for column in p["kinds"].columns)):
        axes[1].text(x, y, name, ha="center", va="center", fontsize="small") if np.isfinite(x) else None
    axes[1].set_ylim(p.number("low"), p.number("high"))
    return axes


# --- sweeps ---------------------------------------------------------------------------------------------------------


def scales(at: Any, p: Picture, y: str) -> None:
    """Logarithmic axes, and marks where the free ball is integrable."""
    at.set(xscale="log" if p.number("logarithmic_x") else "linear", yscale="log" if p.number(y) else "linear")
    for i, (axis, k) in enumerate(zip(p["marks"]["axis"], p["marks"]["at"])):
        (at.axvline if axis == 1 else at.axhline)(k, color=INK, lw=1.2, ls=DASHED, gid="integrable",
                                                  label=None if i else "k = ±1: the free ball is integrable")


def sweep_curve(p: Picture, ax: Any) -> List[Any]:
    curve, error = p["curve"], p.text("error")
    (at,) = axes = parts(ax, ["A"], [4.8])
    if error:
        at.fill_between(curve["at"], curve["low"], curve["high"], color=FAR_BLUE, lw=0, label=error, gid="band")
    at.plot(curve["at"], curve["value"], "o-", ms=3, lw=1.4, color=BLUE, gid="value")
    at.set(xlabel=p.text("over"), ylabel=p.text("value"))
    scales(at, p, "sizes")
    return axes


def sweep_map(p: Picture, ax: Any) -> List[Any]:
    cells, maps, colours = p["cells"], p["maps"]["name"], pyplot().matplotlib.colors
    norm = (colours.LogNorm if p.number("sizes") else colours.Normalize)(p.number("low"), p.number("high"))
    names, wide = "ABCDEF"[:len(maps)], min(len(maps), 3)
    rows = [names[i:i + 3].ljust(wide, ".") for i in range(0, len(maps), 3)]
    axes = parts(ax, rows, [4.8 if wide < 3 else 3.6] * len(rows), 9)
    ends = np.flatnonzero(np.isnan(cells["cell"]))
    starts = np.append(0, ends[:-1] + 1)
    corners = [np.stack([cells["x"][a:b], cells["y"][a:b]], 1) for a, b in zip(starts, ends)]
    number, missing, value = (cells[name][starts] for name in ("map", "missing", "value"))
    for i, (at, name) in enumerate(zip(axes, maps)):
        for none, look in ((1, {"color": GREY, "label": "no value", "gid": "missing"}),
                           (0, {"norm": norm, "cmap": scale(VIRIDIS), "edgecolors": "face", "gid": "cells"})):
            some = np.flatnonzero((number == i + 1) & (missing == none))
            if len(some) or not none:
                drawn = areas(at, [corners[c] for c in some], **({} if none else {"array": value[some]}), **look)
        scales(at, p, "logarithmic_y")
        at.set(xlabel=p.text("x"), ylabel=p.text("y"), title=plain(name))
        at.margins(0.02)
        at.autoscale_view()
    bar(drawn, axes, p.text("value"))
    return axes


# --- sections and chaos ---------------------------------------------------------------------------------------------


def by_hue(hue: Numbers) -> Numbers:
    """Colours of orbits that have no scale: neither pale nor dark."""
    turn = 2 * np.pi * (hue[:, None] - np.array([0, 1 / 3, 2 / 3]))
    return np.floor(255 * (0.47 + 0.36 * np.cos(turn) - 0.03 * np.cos(2 * turn))) / 255


def crossings(at: Any, p: Picture, side: str) -> Any:
    """The spots of one model; those of a scale of colours."""
    spots, few, bar = p[side], p.number("few"), p.number("bar")
    size = min(max(9 / (len(spots) + 1)**0.5, 0.05), 0.4)**2 * 45
    for shade, name, colour in ((1, "grey", GREY), (2, "dark", INK), (0, "coloured", None)):
        rows, words = spots["shade"] == shade, "\n".join(textwrap.wrap(p.text(name + "_means"), 40))
        look = {"color": colour} if colour else {"c": by_hue(spots["colour"][rows])} if not bar else {
            "c": spots["colour"][rows], "cmap": scale(VIRIDIS_DOTS), "vmin": p.number("low"), "vmax": p.number("high")}
        drawn = dots(at, spots, "right", "up", rows, s=(4 if shade else 25) if few else size, linewidths=0, zorder=3,
                     gid=f"{side}:{name}", rasterized=len(spots) > 40000, **look)
        at.plot([], [], "o", ms=5, color=colour, label=words or None)
    at.set(xlim=(p.number(side + "_x0"), p.number(side + "_x1")), ylim=(p.number(side + "_y0"), p.number(side + "_y1")),
           xlabel=p.text(side + "_right"), ylabel=p.text(side + "_up"), title=p.text(side + "_title"))
    if not p.number("window"):
        at.set_xticks(*ANGLES)
    return drawn if bar else None


def lines_over(at: Any, p: Picture, side: str) -> None:
    """Periodic orbits, and the curves of the unstable rotation."""
    for name, colour, dash, word in (("enters", BLUE, (0, (6, 4)), "enters it"),
                                     ("leaves", VERMILLION, "-", "leaves the unstable rotation")):
        if p.number("curves"):
            curve = p[f"{side}_{name}"]
            at.plot(curve["right"], curve["up"], zorder=4, gid=f"{side}:{name}", color=colour, ls=dash, label=word)
    for stable, name, look in ((0, "unstable", {"marker": "x", "color": BLACK}),
                               (1, "stable", {"facecolors": WHITE, "edgecolors": BLACK})):
        if p.number(name):
            orbits = p[side + "_orbits"]
            dots(at, orbits, "right", "up", orbits["stable"] == stable, s=28, linewidths=1.3, zorder=5 + stable,
                 gid=f"{side}:{name}", label=name + " periodic orbit", **look)


def section(p: Picture, ax: Any) -> List[Any]:
    axes, boundary = parts(ax, ["AB"], [4.9]), p["boundary"]
    for at, side in zip(axes, ("ball", "point")):
        scaled = crossings(at, p, side)
        lines_over(at, p, side)
    for edge, end in (("high", p.number("point_y1")), ("low", p.number("point_y0"))):
        axes[1].fill_between(boundary["l"], boundary[edge], end, color=BAND, lw=0, zorder=1)
        axes[1].plot(boundary["l"], boundary[edge], color=AXES, lw=1, zorder=2)
    if scaled is not None:
        bar(scaled, axes, "rotation number: turns from crossing to crossing")
    return axes


def chaos(p: Picture, ax: Any) -> List[Any]:
    (at,) = axes = parts(ax, ["A"], [5.2])
    size = min(max(30 / sum(len(p[name]) for name in ("regular", "chaotic", "undecided"))**0.5, 0.12), 1.6)**2 * 40
    exponents = {"c": p["chaotic"]["exponent"], "vmin": 0, "cmap": scale(EXPONENTS)}
    for name, look in (("regular", {"color": FAR_BLUE}), ("chaotic", exponents),
                       ("undecided", {"color": BLACK, "marker": "x"})):
        if len(p[name]):
            drawn = dots(at, p[name], "l", "x", s=size, label=name, gid=name, **look)
            bar(drawn, at, "exponent per turn") if name == "chaotic" else None
    at.set(xlim=(-np.pi, np.pi), ylim=(-1, 1), xlabel=p.text("right_name"), ylabel=p.text("up_name"))
    at.set_xticks(*ANGLES)
    return axes


def indicators(p: Picture, ax: Any) -> List[Any]:
    growth, megno, gali = axes = parts(ax, ["AA", "BC"], [3.2, 3.2])
    for side, look, mean in (("ball", {"color": BLUE, "lw": 1.6}, (0, (6, 3))),
                             ("point", {"color": ORANGE, "lw": 2.4}, (0, (2, 3)))):
        for at, name, more in ((growth, "growth", {}), (megno, "megno", {}), (gali, "gali2", {}),
                               (megno, "mean", {"ls": mean})):
            if len(p[side]):
                at.plot(p[side]["turn"], p[side][name], gid=f"{side}:{name}",
                        label=side + (", mean" if more else ""), **look, **more)
    megno.axhline(2, color=HELP, lw=1.2, ls=(0, (3, 3)))
    for at, name in zip(axes, ("ln |d|, d: a small distance", "MEGNO", "GALI₂")):
        at.set(xlabel="turns", ylabel=name)
        at.legend()
    gali.set(yscale="log", ylim=(None, 2))
    return axes


LAYOUTS: Dict[str, Callable[..., List[Any]]] = {
    "batch": batch, "branch": branch, "chaos": chaos, "chart": stability, "columns": columns, "cost": cost,
    "difference": trajectory, "frequencies": frequencies, "indicators": indicators, "momentum": momentum,
    "section": section, "splitting": splitting, "sweep_curve": sweep_curve, "sweep_map": sweep_map,
    "trajectory": trajectory}

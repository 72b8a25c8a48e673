"""Pictures of orbits on their spheres, and of sections."""

from __future__ import annotations

from typing import Any, Callable, Mapping, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _errors
from ._plot_parts import (BLUE, DARK, FAR_BLUE, GREY, LINE, Numbers, ORANGE, PI_TICKS, SKY, VERMILLION, axes_of,
                           axis_of, given, name_of, needs, plain, pyplot, title_of)
from ._table import Table

_MOST_ROWS = 5000  # of a path

# --- orbits ---------------------------------------------------------------------------------------------------------

_A, _E = np.deg2rad(25), np.deg2rad(24)  # the eye: azimuth and elevation
_RIGHT = np.array([-np.sin(_A), np.cos(_A), 0])
_UP = np.array([-np.sin(_E) * np.cos(_A), -np.sin(_E) * np.sin(_A), np.cos(_E)])
_EYE = np.array([np.cos(_E) * np.cos(_A), np.cos(_E) * np.sin(_A), np.sin(_E)])


def _project(path: Numbers, near: bool) -> Tuple[Numbers, Numbers]:
    """Places on the paper of unit vectors; those on the other side are NaN."""
    seen = (path @ _EYE > 0) == near
    return np.where(seen, path @ _RIGHT, np.nan), np.where(seen, path @ _UP, np.nan)


def _graticule() -> Numbers:
    turn = np.deg2rad(np.append(np.arange(0, 361, 5), np.nan))
    circles = [np.stack([np.cos(turn) * np.cos(a), np.cos(turn) * np.sin(a), np.sin(turn)], 1)
               for a in np.deg2rad(np.arange(0, 180, 30))]
    circles += [np.stack([np.cos(b) * np.cos(turn), np.cos(b) * np.sin(turn), np.sin(b) + 0 * turn], 1)
                for b in np.deg2rad(np.arange(-60, 61, 30))]
    return np.concatenate(circles)


def _sphere(ax: Any, paths: Numbers, title: str) -> None:
    """The unit sphere with paths on it, shape (paths, rows, 3): the far side pale, the near side on top."""
    lattice = _graticule()
    ax.add_patch(pyplot().Circle((0, 0), 1, fc="#F4F6F8", ec="#8A939B", zorder=0))
    colours = [BLUE] if len(paths) == 1 else [colour_of(i) for i in range(len(paths))]
    for near in (False, True):
        ax.plot(*_project(lattice, near), color="#B9C0C7" if near else "#DDE1E5", lw=0.6, zorder=1 + 2 * near)
        for path, colour in zip(paths, colours):
            step = np.linalg.norm(np.diff(path, axis=0), axis=1)
            joined = not np.any(step > 0.6)  # rows farther apart are no path
            look = {"ls": "", "marker": ".", "ms": 2}
            if joined:
                look = {"lw": 1.6 if near and np.nansum(step) < 40 else 0.8}
            pale = FAR_BLUE if len(paths) == 1 else "#D5DADF"
            ax.plot(*_project(path, near), color=colour if near else pale, zorder=2 + 2 * near, **look)
    for i in range(3):
        v = np.eye(3)[i]
        x, y = v @ _RIGHT, v @ _UP
        end = 1 + 0.14 / max(np.hypot(x, y), 0.5)
        ax.plot([x, x * end], [y, y * end], color=DARK, lw=1.2, zorder=6)
        ax.text(x * (end + 0.08), y * (end + 0.08), str(i + 1), ha="center", va="center", color="#404040")
    if len(paths) == 1:
        for v, marker, word in ((paths[0][0], "o", "start"), (paths[0][-1], "^", "end")):
            colour = "black" if v @ _EYE > 0 else "#909090"
            ax.plot(v @ _RIGHT, v @ _UP, marker, color=colour, ms=6, zorder=7, label=word)
        ax.legend(loc="lower left", frameon=False, fontsize="small")
    ax.set(xlim=(-1.25, 1.25), ylim=(-1.2, 1.25), aspect="equal", title=title)
    ax.set_axis_off()


def _thin(table: Table, name: str) -> Numbers:
    """A vector as paths, shape (orbits, rows, 3), of at most 5000 rows."""
    paths = table[name]
    paths = paths[None] if paths.ndim == 2 else paths
    count = paths.shape[1]
    if count <= _MOST_ROWS:
        return paths
    return paths[:, np.linspace(0, count - 1, _MOST_ROWS).round().astype(int)]


def draw_trajectory(table: Table, ax: Any, title: Optional[str] = None) -> Any:
    """The path of n on the ball's sphere, that of gamma on the point's; of columns of effects also the path of the
    contact from above, and the pressure."""
    if table.array.ndim == 1:
        raise _errors.BadInput("no picture: the table is of a single time")
    spheres = [(name, words) for name, words in (("n", "the ball: n, the normal where it touches"),
                                                 ("gamma", "the point: γ, its place")) if name in table]
    above, force = "contact" in table and table.array.ndim == 2, "pressure" in table and table.array.ndim == 2
    if len(table) == 0 or not (spheres or above or force):
        raise _errors.BadInput(f"no picture: the table has no rows of n or gamma; table.plot(columns=(X, Y)) draws a "
                               f"column over another; it has {', '.join(table.columns)}")
    count = len(spheres) + above + force
    axes = axes_of(ax, count, (4.5 * min(count, 2), 4.7 * (1 + (count > 2))), 1 + (count > 2))
    for (name, words), at in zip(spheres, axes):
        _sphere(at, _thin(table, name), words)
    if above:
        at = axes[len(spheres)]
        at.plot(*table.contact.T[:2], color=BLUE, lw=1.4)
        at.set(aspect="equal", title="from above: the contact", xlabel=name_of(table, "contact1"), ylabel="contact2")
        plain(at)
    if force:
        at = axes[-1]
        clock = "t" if "t" in table else table.columns[0]
        at.plot(table[clock], table.pressure, color=BLUE, lw=1.4)
        at.axhline(0, color=LINE, lw=1, ls="--")
        at.set(xlabel=name_of(table, clock), ylabel=name_of(table, "pressure"), title="pressure")
        plain(at)
    if ax is None:
        axes[0].figure.suptitle(title_of(table, title))
    return given(axes)


def draw_comparison(table: Table, ax: Any, title: Optional[str] = None) -> Any:
    """The paths of n by the ball and of gamma by the point, unless the table is of a file; then how far the two
    computations are apart."""
    needs(table, "omega", "n", "M", "gamma")
    spheres = [(orbit, name, words) for orbit, name, words in (
        (getattr(table, "ball", None), "n", "the ball: n, the normal where it touches"),
        (getattr(table, "point", None), "gamma", "the point: γ, its place")) if orbit is not None]
    axes = axes_of(ax, len(spheres) + 1, (13.5 if spheres else 9, 4.8))
    for (orbit, name, words), at in zip(spheres, axes):
        _sphere(at, _thin(orbit, name), words)
    at, clock = axes[-1], table.columns[0]
    for name, word, colour in zip(("omega", "n", "M", "gamma"), "ωnMγ", (BLUE, SKY, VERMILLION, ORANGE)):
        at.plot(table[clock], table[name], color=colour, lw=1.2, label=word)
    at.set(yscale="log", xlabel=name_of(table, clock), title="difference of ball and point")
    at.legend(frameon=False, ncols=4)
    plain(at)
    if ax is None:
        at.figure.suptitle(title_of(table, title))
    return given(axes)


# --- sections -------------------------------------------------------------------------------------------------------


def colour_of(orbit: float) -> Tuple[float, float, float]:
    """The hues of successive orbits differ by the golden section of the circle; the first is a strong blue."""
    turn = 2 * np.pi * ((0.6 + orbit * 0.61803398874989485) % 1 + np.array([0, -1 / 3, -2 / 3]))
    r, g, b = np.clip(0.47 + 0.36 * np.cos(turn) - 0.03 * np.cos(2 * turn), 0, 1)
    return float(r), float(g), float(b)


def _of_ball(k: float, J: Numbers, a: int, l: Numbers, x: Numbers) -> Tuple[Numbers, Numbers]:
    """The angle psi of n = (cos psi, -sin psi, 0), and omega_a/|omega|: n ~ J^(1/2) gamma, omega ~ J^(-1/2) M."""
    b, c, root = (a + 1) % 3, (a + 2) % 3, np.sqrt(J)
    across, sign = np.sqrt((1 - x) * (1 + x)), np.sign(k)
    omega = sign * np.stack([across * np.sin(l) / root[b], across * np.cos(l) / root[c], x / root[a]])
    return np.arctan2(root[c] * np.sin(l), root[b] * np.cos(l)), omega[2] / np.linalg.norm(omega, axis=0)


def _momentum(table: Table, a: int) -> Optional[Callable[[Numbers], Numbers]]:
    """G(l), the point's |M| on the section; None where more acts than a level."""
    k, J, eps, acts = table.lines["k"], table.lines["J"], table.lines.get("eps", 0.0), table.lines.text.get("effects")
    if not eps > 0 or acts not in (None, "level"):
        return None
    energy = table.lines.get("level.c", 0.0) * np.prod(J) / k**2 if acts else 0.0

    def largest(l: Numbers) -> Numbers:
        q = J[(a + 1) % 3] * np.cos(l)**2 + J[(a + 2) % 3] * np.sin(l)**2
        found: Numbers = np.sqrt(2 * np.maximum(0, energy + eps * q**(-1 / k)))
        return found

    return largest


def _draw_sections(table: Table, axes: Sequence[Any], orbit: Numbers, spots: Sequence[Tuple[Numbers, Numbers]],
                   grey: Mapping[float, bool], a: int, words: str) -> None:
    size = min(max(160 / max(len(orbit), 1)**0.5, 0.2), 14)
    G, (b, c) = _momentum(table, a), ((a + 1) % 3 + 1, (a + 2) % 3 + 1)
    kinds = sorted(set(orbit.tolist()), key=lambda i: (not grey.get(i, False), i))  # the grey ones lie behind
    colours = {i: np.array((0.69, 0.69, 0.69) if grey.get(i) else colour_of(i)) for i in kinds}
    order = np.argsort([not grey.get(i, False) for i in orbit.tolist()], kind="stable")
    shade = np.array([colours[i] for i in orbit.tolist()])[order]
    places = [_of_ball(table.lines["k"], table.lines["J"], a, *spots[0]),
              (spots[1][0], spots[1][1] * G(spots[1][0]) if G else spots[1][1])]
    for ax, (right, up) in zip(axes, places):
        ax.scatter(right[order], up[order], s=size, c=shade, linewidths=0, rasterized=len(orbit) > 40000)
        ax.set(xlim=(-np.pi, np.pi))
        ax.set_xticks(*PI_TICKS)
    axes[0].set(title=f"ball: n{a + 1} = 0, n{a + 1} increasing", ylim=(-1, 1), ylabel=f"ω{a + 1} / |ω|",
                xlabel=f"ψ,  where n{b} = cos ψ, n{c} = −sin ψ")
    axes[1].set(title=f"point: γ{a + 1} = 0, γ{a + 1} increasing",
                xlabel=f"l,  where γ{b} = cos l, γ{c} = −sin l",
                ylabel=f"L = M{a + 1}" if G else f"x = M{a + 1} / |M|")
    edge = np.linspace(-np.pi, np.pi, 241)
    bound = G(edge) if G else np.ones(241)
    most = 1.05 * float(np.max(bound))
    for side in (1, -1):
        axes[1].fill_between(edge, side * bound, side * most, color="#ECEFF1", lw=0)
        axes[1].plot(edge, side * bound, color=DARK, lw=1)
    axes[1].set_ylim(-most, most)
    if any(grey.values()):
        axes[1].plot([], [], "o", color=GREY, label=words)
        axes[1].legend(loc="upper right", fontsize="small")


def draw_section(table: Table, ax: Any, title: Optional[str] = None) -> Any:
    """The sections of both models; grey: orbits on which ball and point part, if the table has both."""
    needs(table, "orbit", "l", "x")
    a, point = axis_of(table), getattr(table, "point", None)
    axes, grey = axes_of(ax, 2, (9, 4.7)), {}
    l, x, orbit = table["l"], table["x"], table["orbit"]
    other = (l, x)
    if point is not None and len(point) == len(table):
        other = point["l"], point["x"]
        apart = np.maximum(np.abs(np.remainder(l - other[0] + np.pi, 2 * np.pi) - np.pi), np.abs(x - other[1])) > 1e-3
        grey = dict.fromkeys(np.unique(orbit[apart]).tolist(), True)
    _draw_sections(table, axes, orbit, ((l, x), other), grey, a, "ball and point part: chaotic")
    if ax is None:
        axes[0].figure.suptitle(title_of(table, title))
    return given(axes)


def draw_periodic(table: Table, ax: Any, title: Optional[str] = None) -> Any:
    """A crossing of each orbit and its images by the reversors and by half turns; grey: unstable ones."""
    needs(table, "orbit", "l", "x", "stability")
    n, sign = np.arange(8)[:, None], np.where(np.arange(8) & 1, -1, 1)[:, None]
    l = np.remainder(sign * table["l"] + np.where(n & 2, np.pi, 0) + np.pi, 2 * np.pi) - np.pi
    x = np.where(n & 4, -sign, sign) * table["x"]
    orbit = np.tile(table["orbit"] - 1, 8)
    grey = {i - 1: word in ("unstable", "inverse") for i, word in zip(table["orbit"].tolist(), table["stability"])}
    axes, spots = axes_of(ax, 2, (9, 4.7)), (l.ravel(), x.ravel())
    _draw_sections(table, axes, orbit, (spots, spots), grey, axis_of(table), "unstable")
    if ax is None:
        axes[0].figure.suptitle(title_of(table, title))
    return given(axes)


def draw_chaos(table: Table, ax: Any, title: Optional[str] = None) -> Any:
    """The starts on the section, chaotic ones coloured by their exponent per turn."""
    needs(table, "l", "x", "verdict")
    l, x, verdict = table["l"], table["x"], table["verdict"]
    there = np.isfinite(l) & np.isfinite(x)
    if not there.any():
        raise _errors.BadInput("no picture: the table has no orbit that starts on the section")
    at, a = axes_of(ax, 1, (9, 5.2))[0], axis_of(table)
    size = float(min(max(900 / there.sum()**0.5, 4), 60))
    for word, look in (("regular", dict(color=FAR_BLUE)), ("undecided", dict(color="black", marker="x"))):
        if (kind := there & (verdict == word)).any():
            at.scatter(l[kind], x[kind], s=size, label=word, **look)
    if (kind := there & (verdict == "chaotic")).any():
        both = [table[name] for name in ("ball_per_turn", "point_per_turn") if name in table]
        exponent = both[0] if len(both) < 2 else np.where(table["ball_verdict"] == "chaotic", *both)
        colours = pyplot().matplotlib.colors.LinearSegmentedColormap.from_list("", ["#F7E3B0", ORANGE, "#8B1A00"])
        drawn = at.scatter(l[kind], x[kind], s=size, c=exponent[kind], vmin=0, cmap=colours, label="chaotic")
        at.figure.colorbar(drawn, ax=at, label="exponent per turn")
    b, c = (a + 1) % 3 + 1, (a + 2) % 3 + 1
    at.set(xlim=(-np.pi, np.pi), ylim=(-1, 1), title=title_of(table, title), ylabel=f"M{a + 1} / |M|",
           xlabel=f"l,  where γ{b} = cos l, γ{c} = −sin l")
    at.set_xticks(*PI_TICKS)
    at.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncol=3, frameon=False)
    return at

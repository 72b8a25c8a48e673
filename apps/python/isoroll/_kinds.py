"""The classes of tables, one for each kind of file."""

from __future__ import annotations

import html
from typing import Any, Dict, Iterable, NamedTuple, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from ._table import CLASSES, Table
from ._yaml import load


class Trajectory(Table):
    """Rows of orbits: the clocks t, tau, s; omega and n of the ball, M and gamma of the point; columns of effects.

    errors  if they were asked for, the largest relative errors of the rows, by "ball" (omega, n), "point" (M, gamma),
            "t", "tau", "s"; NaN where the rows do not show them, or where they are not known; else None
    """

    _kind = "trajectory"
    errors: Optional[Dict[str, float]] = None


class Section(Table):
    """Crossings, a row each: columns orbit (from 0), crossing (from 1), t, tau, s, l, x, and the states asked for.

    point   the same crossings as the point finds them by itself, with the columns orbit, crossing, t, tau, s, l, x;
            None unless both models are integrated here
    """

    _kind = "section"
    point: Optional[Table] = None


class Share(NamedTuple):
    """The orbits spread over the section.

    orbits     those that were followed; `asked` were to be, `failed` failed
    share      chaotic / orbits, in which undecided orbits count as not chaotic; NaN if none was followed
    low, high  its 95 % confidence interval; undecided orbits are not chaotic at the low end, chaotic at the high end.
               Where many are undecided, `share` stands near `low`
    """

    orbits: int
    chaotic: int
    regular: int
    undecided: int
    failed: int
    asked: int
    share: float
    low: float
    high: float


_SHARE = ("followed", "chaotic_starts", "regular_starts", "undecided_starts", "failed", "starts", "chaotic", "low",
          "high")  # as the lines call them


class Chaos(Table):
    """Which orbits are chaotic, a row each: orbit, l, x, verdict ("regular", "chaotic", "undecided"), disagree, then
    for each model that was integrated ball_exponent_t, ball_error_t, ball_megno, ball_gali2, ... Orbit 0 is the
    scene's own: table.verdict[0].

    indicators  {"ball": Table, "point": Table}: those of the scene's own orbit, by turns; {} of a file
    """

    _kind = "chaos"
    indicators: Dict[str, Table] = {}

    @property
    def share(self) -> Optional[Share]:
        """Which part of the section is chaotic; None without starts, and of a file."""
        if "share.starts" not in self.lines:
            return None
        numbers = [float(self.lines.text.get("share." + key, "nan")) for key in _SHARE]
        return Share(*(int(x) for x in numbers[:6]), *numbers[6:])


class Periodic(Table):
    """Periodic orbits, a row each: period, l, x, trace, error, stability, symmetry, t, tau, s, and the start in both
    models."""

    _kind = "periodic"


class Branch(Table):
    """Points of branches of periodic orbits, and events on them, whose `event` is not empty."""

    _kind = "periodic follow"


class Chart(Table):
    """Stability of the rotations over k and a moment, or the level. The column `kind`, table["kind"], is "grid", or
    says which border passes there; table.kind is "periodic chart"."""

    _kind = "periodic chart"


class Splitting(Table):
    """The splitting of the separatrix, a row for each k or level: m is the slope of the curves where they meet."""

    _kind = "splitting"


class Cost(Table):
    """What accuracy costs, a row for each backend, method and tolerance."""

    _kind = "cost"


class Sweep(Table):
    """Many scenes, a row each: the number of the point, what varies, what is measured, status, reason.

    text   the text of the sweep
    scene  the text of its scene's file; "": the scene stands in the sweep
    """

    _kind = "sweep"

    @property
    def text(self) -> str:
        """The text of the sweep."""
        return str(self.lines.text.get("sweep", ""))

    @property
    def scene(self) -> str:
        """The text of its scene's file; "": the scene stands in the sweep."""
        return str(self.lines.text.get("scene", ""))

    @property
    def axes(self) -> Dict[str, NDArray[np.float64]]:
        """What varies, and its values, if the points fill a grid: of a vector such as J, shape (values, 3). Else it
        is empty: the sweep draws its points, or has but a part of them, or has a value twice in a row."""
        plan = load(self.text.encode(), "<sweep>")
        names = [name[5:] for name in str(self.lines.text.get("names", "")).split() if name.startswith("vary/")]
        values: Dict[str, NDArray[np.float64]] = {}
        stride = len(self)
        if "samples" in plan:
            return {}
        for key in plan.get("vary", {}):
            width = 2 if key == "start" else 3 if names[:1] == [key + "1"] else 1
            rows = np.stack([self[name] for name in names[:width]], 1)
            names = names[width:]
            values[key], stride = _cycle(rows, stride)
            if key != "start" and width == 1:
                values[key] = values[key][:, 0]
        return values if stride == 1 and not names else {}

    def to_xarray(self) -> Any:
        """A Dataset of xarray: a dimension for each number that varies, if the points fill a grid, else `point`. A
        vector that varies, such as J, is one dimension, with its components as coordinates."""
        try:
            import xarray
        except ImportError:
            raise ImportError("to_xarray needs xarray, which is not installed here: pip install xarray") from None
        axes = self.axes
        shape, dims = tuple(map(len, axes.values())) or (len(self),), tuple(axes) or ("point",)
        known = {name: (name, each) if each.ndim == 1 else (name, np.arange(len(each))) for name, each in axes.items()}
        for name, each in axes.items():
            for i in range(each.shape[1] if each.ndim > 1 else 0):
                known["lx"[i] if name == "start" else f"{name}{i + 1}"] = (name, each[:, i])
        data = {name: (dims, np.reshape(self[name], shape)) for name in self.columns if name not in known}
        return xarray.Dataset(data, known, {"sweep": self.text})


def _cycle(rows: NDArray[np.float64], stride: int) -> Tuple[NDArray[np.float64], int]:
    """The values of an axis that changes after `stride`/values points, the first axis slowest; and that number."""
    here = rows[:stride]
    changes = np.flatnonzero((here[1:] != here[:-1]).any(1)) + 1
    each = int(changes[0]) if len(changes) else max(stride, 1)
    if stride == 0 or stride % each or not np.array_equal(here, np.repeat(here[::each], each, 0)):
        return here[:0], 0
    if not np.array_equal(rows, np.tile(here, (len(rows) // stride, 1)) if len(rows) % stride == 0 else here):
        return here[:0], 0
    return here[::each], each



class Comparison(Table):
    """An orbit by every backend: differences of ball and point over the time.

    ball, point, exact       the orbits themselves; None where there is none
    ball_exact, point_exact  differences from the closed solution; None where there is none
    """

    _kind = "compare"
    ball: Optional[Table] = None
    point: Optional[Table] = None
    exact: Optional[Table] = None
    ball_exact: Optional[Table] = None
    point_exact: Optional[Table] = None


class Result(Table):
    """A result without rows: what was found stands in its lines, by the names of the command's --json.

    >>> isoroll.frequencies("scene.yaml").frequency_ratio
    >>> isoroll.frequencies("scene.yaml").angles[0]["frequency"]["t"]

    tree  all lines as dicts and lists: tree["angles"][0]["frequency"]["t"] is the line "angles.0.frequency.t"
    text  what the command prints
    """

    @property
    def tree(self) -> Dict[str, Any]:
        """The lines as dicts and lists. Its keys can also be written as attributes."""
        return self.lines.tree

    @property
    def text(self) -> str:
        """What the command prints."""
        return self._told(False) or "\n".join(f"{key}: {value}" for key, value in self.lines.text.items())

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("_") and "_columns" in self.__dict__ and name in self.tree:
            return self.tree[name]
        return super().__getattr__(name)

    def __dir__(self) -> Iterable[str]:
        return [*super().__dir__(), *(key for key in self.tree if key.isidentifier())]

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self.text)}</pre>"

    def __str__(self) -> str:
        return self._told(True) or self.text

    def __repr__(self) -> str:
        return f"<isoroll.Result: {self.kind}; {', '.join(self.tree)}>"


for _class in (Comparison, Trajectory, Section, Chaos, Periodic, Branch, Chart, Splitting, Cost, Sweep):
    CLASSES[_class._kind] = _class
CLASSES["sweep part"] = Sweep
for _kind in ("frequencies", "integrals", "explain", "analogue"):
    CLASSES[_kind] = Result

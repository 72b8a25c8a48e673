"""Pictures: what is grey, dashed, marked is the same set of rows for gnuplot and for matplotlib; colours; refusals."""

import os
import re
import shlex
import unittest
import warnings

import numpy as np
from shared import BALL, SOURCE, WILD, Case, example

import isoroll
from isoroll import _picture

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot

    from isoroll import _plot_layouts as layouts
except ImportError:
    matplotlib = None

PAGE = os.path.join(SOURCE, "apps", "isoroll", "pictures", "page.gp")


def blocks(script):
    """The data blocks of a script of gnuplot, by their names: columns by their names; an empty line is a row of NaN."""
    found = {}
    for name, text in re.findall(r"^\$(\w+) << EOD\n(.*?)^EOD\n", script, re.M | re.S):
        head, *lines = text.splitlines()
        names = shlex.split(head)
        rows = [shlex.split(line) or ["NaN"] * len(names) for line in lines]
        columns = [[row[i] for row in rows] for i in range(len(names))]
        found[name] = {key: np.array(column) if any(not re.fullmatch(r"NaN|[-+.e0-9]+", x) for x in column)
                       else np.array(column, dtype=float) for key, column in zip(names, columns)}
    return found


def rows_of(x, y):
    """Places as sorted rows; those that are not drawn are left out."""
    rows = np.stack([np.asarray(x, dtype=float), np.asarray(y, dtype=float)], axis=1).reshape(-1, 2)
    rows = rows[np.isfinite(rows).all(axis=1)]
    return rows[np.lexsort(rows.T)]


def corners_of(shapes):
    """Corners of areas, each once."""
    found = np.unique(np.concatenate([np.reshape(shape, (-1, 2)) for shape in shapes] or [np.empty((0, 2))]), axis=0)
    return rows_of(*found.T)


@unittest.skipUnless(matplotlib, "python3-matplotlib is not installed")
class Law(Case):
    """Each method draws one kind by both, and names the rows that stand out."""

    def setUp(self):
        super().setUp()
        self.addCleanup(pyplot.close, "all")

    def by_both(self, table, *options, **how):
        """The blocks of the command, and the artists of matplotlib by their gid."""
        table.write(self.path("table.csv"))
        self.command("plot", "table.csv", "-o", "a.svg", "--script", "a.gp", *options)
        self.blocks_of("a.gp", isoroll.read(self.path("table.csv")), **how)

    def blocks_of(self, script, table, **how):
        with open(self.path(script), encoding="utf-8") as file:
            self.gnuplot = blocks(file.read())
        axes = np.ravel(np.asarray(table.plot(**how), dtype=object))
        self.artists = {}
        for at in axes[0].figure.axes:
            for artist in (*at.get_lines(), *at.collections, *at.patches):
                self.artists.setdefault(artist.get_gid(), []).append(artist)

    def drawn(self, gid):
        places = [np.empty((0, 2))]
        for artist in self.artists.get(gid, ()):
            places.append(artist.get_xydata() if hasattr(artist, "get_xydata") else np.asarray(artist.get_offsets()))
        return rows_of(*np.ma.filled(np.concatenate(places).astype(float), np.nan).T)

    def alike(self, gid, block, x, y, rows=True, some=False):
        """The rows of a block are those of the artist; some: and there are any."""
        table = self.gnuplot[block]
        rows = np.broadcast_to(rows, len(table[x]))
        wanted = rows_of(table[x][rows], table[y][rows])
        found = self.drawn(gid)
        self.assertEqual(found.shape, wanted.shape, gid)
        self.same(found, wanted)
        self.assertTrue(len(found) > 0 or not some, f"{gid}: nothing is drawn")

    def areas_alike(self, gid, shapes, some=False):
        found = corners_of([path.vertices for artist in self.artists.get(gid, ()) for path in artist.get_paths()])
        self.assertEqual(found.shape, corners_of(shapes).shape, gid)
        self.near(found, corners_of(shapes), 1e-12) if len(found) else None
        self.assertTrue(len(found) > 0 or not some, f"{gid}: nothing is drawn")

    # --- trajectories

    def check_trajectory(self, table, some=()):
        self.by_both(table)
        for which in ("ball", "point"):
            if which in self.gnuplot:
                near, ends = self.gnuplot[which]["near"] == 1, self.gnuplot["ends"]
                self.alike(f"{which}:near", which, "right", "up", near, True)
                self.alike(f"{which}:far", which, "right", "up", ~near, True)
                for sign in ("start", "end"):
                    rows = (ends["of"] == which) & (ends["sign"] == sign)
                    self.alike(f"{which}:{sign}", "ends", "right", "up", rows, True)
                    shown = self.artists[f"{which}:{sign}"][0].get_facecolor()[0][:3]
                    self.assertEqual(matplotlib.colors.to_hex(shown).upper(),
                                     layouts.BLACK if ends["near"][rows][0] == 1 else layouts.BEHIND)
        for view, up in (("above", "away"), ("side", "up")):
            if not any(str(gid).startswith(view) for gid in self.artists):
                continue
            path, marks = self.gnuplot["path"], self.gnuplot["marks"]
            for of in set(path["of"].tolist()):
                for near, word in ((1, "near"), (0, "behind")):
                    self.alike(f"{view}:{of}:{word}", "path", "right", up, (path["of"] == of) & (path[view] == near))
            for sign in ("start", "end", "lost"):
                self.alike(f"{view}:{sign}", "marks", "right", up, marks["sign"] == sign)
        lost = [line.get_xdata()[0] for gid in ("pressure:lost", "energies:lost") for line in self.artists.get(gid, ())]
        self.assertEqual(sorted(set(lost)), sorted(set(self.gnuplot["losses"]["t"].tolist())))
        for gid in some:
            self.assertTrue(gid in self.artists, f"{gid} is not there; there are {sorted(map(str, self.artists))}")

    def test_trajectories(self):
        self.check_trajectory(isoroll.run(BALL), ["ball:far", "point:near", "paces:ds/dt"])
        self.check_trajectory(isoroll.run(WILD, as_="both", t_end=300))
        with self.assertWarnsRegex(isoroll.IsorollWarning, "drawn alone"):
            self.check_trajectory(isoroll.run(example("10_bowl"), t_end=3), ["above:support", "side:contact:near"])

    def test_a_ball_on_a_sphere_loses_contact(self):
        warnings.simplefilter("ignore", isoroll.IsorollWarning)
        self.check_trajectory(isoroll.run(example("09_off_the_top")), ["above:lost", "side:lost", "pressure:lost"])
        self.assertTrue(len(self.drawn("side:lost")))

    def test_columns(self):
        self.by_both(isoroll.run(BALL), "--columns", "t,n3", columns=("t", "n3"))
        self.alike("curve", "values", "x", "y", True, True)

    def test_compare(self):
        self.by_both(isoroll.compare(WILD, t_end=5))
        for i, name in enumerate("ωnMγ"):
            self.alike(f"difference:{name}", "values", "x", "y", self.gnuplot["values"]["curve"] == i + 1, True)

    # --- families

    def test_branches(self):
        for vary in (("k", (0.4, 0.6)), ("J2", (1.5, 2.5))):
            self.by_both(isoroll.periodic(WILD, period=1, follow=vary))
            points = self.gnuplot["points"]
            for name in ("trace", "place"):
                self.alike(name + ":events", "events", "at", name, True, vary[0] == "k")
                for branch in np.unique(points["branch"]):
                    self.alike(f"{name}:{branch:.0f}", "points", "at", name, points["branch"] == branch, True)

    def test_charts(self):
        for chart in ("J2", {"J2": (1, 3)}):
            self.by_both(isoroll.periodic(WILD, chart=chart, steps=12))
            cells, borders = self.gnuplot["cells"], self.gnuplot["borders"]
            for side, moment in ((1, "least"), (2, "greatest")):
                for kind in (-1, 0, 1, 2):
                    rows = np.flatnonzero((cells["side"] == side) & (cells["class"] == kind))
                    shapes = [[(cells[x][i], cells[y][i]) for x in ("left", "right") for y in ("bottom", "top")]
                              for i in rows]
                    self.areas_alike(f"{moment}:{kind}", shapes, kind == 0)
                self.alike(moment + ":border", "borders", "k", "up", borders["side"] == side)

    def test_splittings(self):
        self.by_both(isoroll.splitting(WILD, k=[0.5, 0.75, 1, 1.1]))
        for sign, gid in ((1, "m > 0"), (-1, "m < 0"), (0, "|m| below")):
            self.alike(gid, "rows", "over", "size", self.gnuplot["rows"]["sign"] == sign, sign == 1)

    def test_costs(self):
        self.by_both(isoroll.cost(WILD, quick=True, t_end=1))
        points = self.gnuplot["points"]
        self.alike("others", "points", "error", "seconds", points["named"] == 0, True)
        for number, name in enumerate(self.gnuplot["methods"]["name"], 1):
            self.alike(name, "points", "error", "seconds", points["named"] == number, True)

    def test_frequencies(self):
        for scene, names in ((WILD, ("signal:1", "signal:2")), (BALL, ())):
            self.command("frequencies", scene, "--plot", "f.svg", "--script", "f.gp")
            self.blocks_of("f.gp", isoroll.frequencies(scene))
            for i, gid in enumerate(names, 1):
                self.alike(gid, "lines", "frequency", "amplitude", self.gnuplot["lines"]["signal"] == i, True)
            for number, name in zip(*self.gnuplot.get("rotations", {"line": (), "name": ()}).values()):
                self.assertEqual(len(self.artists[name]), 2)
                line = self.gnuplot["lines"]["line"] == number
                self.same(self.artists[name][0].get_ydata(), self.gnuplot["lines"]["f"][line])

    # --- sweeps

    def test_sweeps(self):
        plan = {"scene": isoroll.Scene(WILD, end=20), "measure": {"state": {}}, "until": {"time": 1}}
        self.by_both(isoroll.sweep({**plan, "vary": {"k": {"from": 0.5, "to": 1.2, "count": 5}}}))
        self.alike("value", "curve", "at", "value", True, True)
        marks = [line.get_xdata()[0] for line in self.artists["integrable"]]
        self.assertEqual(marks, self.gnuplot["marks"]["at"].tolist())
        table = isoroll.sweep({**plan, "vary": {"k": [0.5, 0.75], "J3": [4, 5, 6], "J1": [-1, 1.1, 1.2]}})
        self.by_both(table, "--value", "state_n1", value="state_n1")
        cells = self.gnuplot["cells"]
        for missing, gid in ((1, "missing"), (0, "cells")):
            rows = cells["missing"] == missing
            self.areas_alike(gid, [rows_of(cells["x"][rows], cells["y"][rows])], True)
        whole = cells["missing"] == 0
        values = [cells["value"][whole & (cells["cell"] == cell)][0] for cell in np.unique(cells["cell"][whole])]
        self.same(np.sort(np.concatenate([each.get_array() for each in self.artists["cells"]])), np.sort(values))


    # --- sections and chaos

    def check_section(self, *some):
        for side in ("ball", "point"):
            shade = self.gnuplot[side]["shade"]
            for number, name in enumerate(("coloured", "grey", "dark")):
                self.alike(f"{side}:{name}", side, "right", "up", shade == number, name in some)

    def test_sections(self):
        scene = isoroll.section(WILD, starts=4, crossings=200)
        level = isoroll.section(example("21_levels"), crossings=40)
        for table, options, how in ((scene, (), {}), (level, (), {}),
                                    (scene, ("--window", "0:1.5,-0.3:0.3"), {"window": ((0, 1.5), (-0.3, 0.3))})):
            self.by_both(table, *options, **how)
            self.check_section(*(("coloured", "grey") if table is scene and not how else ()))
        self.assertIn("too few crossings", self.artists["ball:grey"][0].axes.get_legend().get_texts()[0].get_text())

    def test_what_is_over_a_section(self):
        over = isoroll.periodic(WILD, period=2), isoroll.splitting(WILD, k=[0.5])
        for i, table in enumerate(over):
            table.write(self.path(f"over{i}.csv"))
        self.by_both(isoroll.section(WILD, crossings=30), "--over", "over0.csv", "--over", "over1.csv", over=over)
        self.check_section()
        for side in ("ball", "point"):
            stable = self.gnuplot[side + "_orbits"]["stable"] == 1
            self.alike(side + ":stable", side + "_orbits", "right", "up", stable, True)
            self.alike(side + ":unstable", side + "_orbits", "right", "up", ~stable, True)
            for name in ("leaves", "enters"):
                self.alike(f"{side}:{name}", f"{side}_{name}", "right", "up", True, True)

    def test_ball_and_point_part(self):
        table = isoroll.section(WILD, starts=8, crossings=300)
        apart = np.maximum(np.abs(np.remainder(table.l - table.point.l + np.pi, 2 * np.pi) - np.pi),
                           np.abs(table.x - table.point.x)) > 1e-3
        chaotic = np.isin(table["orbit"], np.unique(table["orbit"][apart]))
        axes = table.plot()
        grey, coloured = (next(each.get_offsets() for each in axes[1].collections if each.get_gid() == "point:" + name)
                          for name in ("grey", "coloured"))
        self.assertTrue(len(coloured) and chaotic.any() and not chaotic.all())
        near = np.min(np.abs(table.point.l[chaotic][:, None] - coloured[:, 0]), axis=1) < 1e-4
        self.assertLess(near.mean(), 0.1, "coloured ones stand there by chance only")
        near = np.min(np.abs(table.point.l[chaotic][:, None] - grey[:, 0]), axis=1) < 1e-4
        self.assertGreater(near.mean(), 0.9)
        self.assertIn("ball and point part: chaotic", axes[0].get_legend().get_texts()[0].get_text())

    def test_periodic_orbits(self):
        for period in (1, 2):
            self.by_both(isoroll.periodic(WILD, period=period))
            self.check_section("coloured", *["grey"] * (period - 1))

    def test_chaos(self):
        for turns in (40, 200):
            self.by_both(isoroll.chaos(WILD, starts=20, turns=turns))
            for name in ("regular", "chaotic", "undecided"):
                self.alike(name, name, "l", "x", True, name == ("undecided" if turns == 40 else "chaotic"))
        self.same(self.artists["chaotic"][0].get_array(), self.gnuplot["chaotic"]["exponent"])

    def test_indicators(self):
        for options in ({}, {"model": "point"}):
            words = [word for key, value in options.items() for word in (f"--{key}", value)]
            self.command("chaos", WILD, "--turns", "60", *words, "--plot", "c.svg", "--script", "c.gp")
            self.blocks_of("c.gp", isoroll.chaos(WILD, turns=60, **options))
            for side in ("ball", "point"):
                for name in ("growth", "megno", "mean", "gali2"):
                    self.alike(f"{side}:{name}", side, "turn", name, True, side == "point")


@unittest.skipUnless(matplotlib, "python3-matplotlib is not installed")
class Look(Case):
    def setUp(self):
        super().setUp()
        self.addCleanup(pyplot.close, "all")
        with open(PAGE, encoding="utf-8") as file:
            self.page = file.read()

    def test_colours_are_those_of_the_command(self):
        names = dict(re.findall(r"(\w+) = '(#[0-9A-F]{6})'", self.page))
        ours = {name: value for name, value in vars(layouts).items() if isinstance(value, str) and re.match("#", value)}
        self.assertGreater(len(ours), 20)
        self.assertEqual(ours, {name: names.get(name.lower()) for name in ours})
        lines = re.findall(r"^set style line \d+ dt (\S+) lc rgb (\w+)", self.page, re.M)
        self.assertEqual([(names[colour], dash) for dash, colour in lines],
                         [(colour, "1" if dash == "-" else f"({','.join(map(str, dash[1]))})")
                          for colour, dash in layouts.STROKES])
        for name, ours in (("viridis", layouts.VIRIDIS), ("viridis_dots", layouts.VIRIDIS_DOTS),
                           ("exponents", layouts.EXPONENTS)):
            scale = re.search(rf'^{name} = "(.*?)"', self.page, re.M | re.S)[1]
            self.assertEqual(re.findall("#[0-9A-F]{6}", scale), list(ours))
        for row, name in zip(layouts.SEEN, "XYD"):
            formula = re.search(rf"^{name}\(x, y, z\) = (.*)", self.page, re.M)[1]
            self.near([eval(formula, {"x": x, "y": y, "z": z}) for x, y, z in np.eye(3)], row, 0)

    def test_room_for_tables(self):
        with open(os.path.join(SOURCE, "lib", "picture", "picture.h"), encoding="utf-8") as file:
            self.assertRegex(file.read(), rf"ISO_PICTURE_TABLES = {_picture.TABLES}\b")

    def test_a_layout_that_is_not_known(self):
        branch = layouts.LAYOUTS.pop("branch")
        self.addCleanup(layouts.LAYOUTS.__setitem__, "branch", branch)
        table = isoroll.periodic(WILD, period=1, follow=("k", (0.49, 0.51)))
        self.refuses(isoroll.BadInput, "no layout 'branch' for a table 'periodic follow': table.picture(FILE)",
                     table.plot)

    def test_the_command_draws(self):
        table = isoroll.run(BALL, t_end=3)
        table.picture(self.path("a.svg"), title="Marked", script=self.path("a.gp"), columns=("t", "n3"))
        with open(self.path("a.svg"), encoding="utf-8") as picture, open(self.path("a.gp"), encoding="utf-8") as script:
            self.assertIn("Marked", picture.read())
            self.assertIn("$values << EOD", script.read())
        with open(self.path("own.gp"), "w", encoding="utf-8") as file:
            file.write("width = 300; height = 200; panels = 1\neval page\nset title 'My own'\n"
                       "plot $values using 'x':'y'\n")
        table.picture(self.path("b.svg"), template=self.path("own.gp"), size="600x400px", style="print")
        with open(self.path("b.svg"), encoding="utf-8") as picture:
            self.assertIn("My own", picture.read())
        self.refuses(isoroll.BadArgument, "style", table.picture, self.path("c.svg"), style="loud")
        self.refuses(isoroll.BadArgument, "sections", table.picture, self.path("c.svg"), window=((0, 1), (0, 1)))
        with self.assertRaises(TypeError):
            table.picture(self.path("c.svg"), colour="red")

    def test_units_and_hostile_titles(self):
        for title in ("a $x^2$ and $", "\\frac{1}{2}", "two\nlines", "x" * 300, "`touch here` \"'"):
            axes = isoroll.run(BALL, t_end=1).plot(title=title)
            axes[0].figure.canvas.draw()
            shown = axes[0].figure._suptitle.get_text()
            self.assertLessEqual(len(shown), 115)
            self.assertNotIn("\n", shown)


if __name__ == "__main__":
    unittest.main()

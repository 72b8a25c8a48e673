"""Tables: words, lines, units, other forms, refusals, pictures, memory."""

import builtins
import os
import pickle
import subprocess
import sys
import unittest
from unittest import mock

import numpy as np
from shared import BALL, WILD, Case, example

import isoroll

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
except ImportError:
    matplotlib = None


def without(*names):
    """An import of these modules fails."""
    real = builtins.__import__

    def fake(name, *arguments, **named):
        if name.split(".")[0] in names:
            raise ImportError(name)
        return real(name, *arguments, **named)

    return mock.patch.object(builtins, "__import__", fake)


class Words(Case):
    def test_are_words(self):
        table = isoroll.chaos(WILD, turns=40, starts=5)
        self.assertEqual(table.verdict.shape, (6,))
        self.assertTrue(set(table.verdict) <= {"regular", "chaotic", "undecided"})
        self.assertEqual(table["verdict"].tolist(), table.verdict.tolist())
        with self.assertRaisesRegex(ValueError, "read-only"):
            table.verdict[0] = "new"
        for name in ("c.csv", "c.h5"):
            table.write(self.path(name))
            self.assertEqual(isoroll.read(self.path(name)).verdict.tolist(), table.verdict.tolist())
        again = pickle.loads(pickle.dumps(table))
        self.assertIs(type(again), isoroll.Chaos)
        self.assertEqual((again.verdict.tolist(), again.lines, again.share), (table.verdict.tolist(), table.lines,
                                                                            table.share))
        again.write(self.path("again.csv"))
        self.same_files(self.path("c.csv"), self.path("again.csv"))
        table["verdict"]  # words follow the numbers
        table.array[1, table.columns.index("verdict")] = 0
        self.assertEqual(table.verdict[1], "")

    def test_columns_that_have_the_name_of_something_else(self):
        chart = isoroll.periodic(WILD, chart="J2", steps=4)
        self.assertEqual(chart.kind, "periodic chart")
        self.assertIn("grid", chart["kind"])
        splitting = isoroll.splitting(WILD, k=[0.5, 0.75])
        self.assertEqual(splitting.k.tolist(), [0.5, 0.75])
        self.assertEqual(isoroll.run(WILD).k, 0.5)
        self.assertIn("verdict", dir(isoroll.chaos(WILD, turns=2)))


class Lines(Case):
    def test_numbers_are_numbers(self):
        lines = isoroll.run(BALL).lines
        self.assertEqual((lines["k"], lines["model"], lines.text["k"]), (-1.0, "ball", "-1"))
        self.assertEqual(lines["isoroll"], isoroll.__version__)
        self.assertIsInstance(lines["k"], float)
        self.assertEqual(lines["J"].tolist(), [1, 2, 5])
        with self.assertRaisesRegex(KeyError, "no line 'K': the table has model, k, J, h"):
            lines["K"]
        with self.assertRaisesRegex(AttributeError, r"no column 'h': .*it is a line: table.lines\['h'\]"):
            isoroll.run(BALL).h
        with self.assertRaisesRegex(ValueError, "read-only"):
            lines["J"][0] = 2
        self.assertEqual(lines.get("absent", 3), 3)
        own = isoroll.Table([[0.0]], ["t"], {"k": 1 / 3, "J": (1, 2, 5), "note": "a text", "at": "1 2 x", "e": "-1e-3"}
                            )
        self.assertEqual((own.k, own.lines["note"]), (1 / 3, "a text"))
        self.assertEqual((own.lines["at"], own.lines["e"]), ("1 2 x", -1e-3))
        self.assertEqual(own.lines.text["k"], "0.33333333333333331")
        self.assertEqual(pickle.loads(pickle.dumps(lines)), lines)
        for bad in ("1_0", "0x1p3", "1,2", "", "nano", "1 ", "١"):
            self.assertEqual(isoroll.Table([[0.0]], ["t"], {"x": bad}).lines["x"], bad)
        with self.assertRaisesRegex(AttributeError, "cannot be changed"):
            lines.text = {}

    def test_results(self):
        found = isoroll.frequencies(BALL)
        self.assertEqual(found.angles[0]["frequency"]["t"], found.lines["angles.0.frequency.t"])
        self.assertEqual(found.frequency_ratio, found.lines["frequency_ratio"])
        self.assertIn("<pre>", found._repr_html_())
        self.assertLess(len(repr(found)), 250)
        with self.assertRaises(AttributeError):
            found.absent


class Forms(Case):
    def test_words_about_itself(self):
        for table in (isoroll.run(BALL), isoroll.section(WILD, crossings=50),
                      isoroll.batch(WILD, [1, 2], k=[0.5, 0.6]), isoroll.orbit(BALL).at(1.0)):
            self.assertLess(len(repr(table)), 700)
            self.assertIn(table.columns[0], repr(table))
            page = table._repr_html_()
            self.assertIn(f"<th>{table.columns[0]}<br>", page)
            self.assertLess(page.count("<tr>"), 14)
            text = str(table).split("\n")
            self.assertLessEqual(max(map(len, text)), 100)
            self.assertLess(len(text), 24)
            self.assertEqual(text[1].split()[0], table.columns[0])
            for name in table.columns:  # those without room are named
                self.assertIn(name, str(table))
        self.assertIn("<small>1/time</small>", isoroll.run(BALL)._repr_html_())
        table = isoroll.Table([[1, 2.5], [-3, 0]], ["a", "b"], {"k": 2 / 3, "J": [1, 2, 0.1]})
        self.assertEqual(str(table), "trajectory, 2 rows, k = 0.666667, J = 1 2 0.1\n   a    b\n   1  2.5\n  -3    0")
        chaos = isoroll.chaos(WILD)
        self.assertEqual(str(chaos) + "\n", self.command("chaos", WILD))  # what a study tells
        self.assertIn("<pre>this orbit: chaotic", chaos._repr_html_())
        self.assertEqual(len(str(isoroll.Table(np.empty((0, 1)), ["a"])).split("\n")), 2)
        evil = isoroll.Table([[0.0]], ["<b>"], {"k": "<i>"})
        self.assertNotIn("<b>", evil._repr_html_())
        self.assertNotIn("<i>", evil._repr_html_())

    def test_pandas(self):
        """What is handed to pandas, whether or not it is there: the same memory, or columns with words."""
        class Frame:
            def __init__(self, data, columns=None, copy=None):
                self.data, self.columns, self.copy, self.attrs = data, columns, copy, {}

        table = isoroll.run(BALL)
        with mock.patch.dict(sys.modules, pandas=mock.Mock(DataFrame=Frame)):
            frame = table.to_pandas()
            self.assertTrue(np.shares_memory(frame.data, table.array))
            self.assertEqual((frame.columns, frame.copy), (list(table.columns), False))
            self.assertEqual((frame.attrs["k"], frame.attrs["J"], frame.attrs["model"]), (-1.0, [1, 2, 5], "ball"))
            self.assertEqual(frame.attrs.keys(), table.lines.keys())
            self.assertEqual(isoroll.chaos(WILD, turns=3).to_pandas().data["verdict"].tolist(), ["undecided"])
            self.refuses(isoroll.BadArgument, "many orbits", isoroll.batch(WILD, [1]).to_pandas)
        try:
            import pandas
        except ImportError:
            return
        frame = table.to_pandas()
        self.assertIsInstance(frame, pandas.DataFrame)
        np.testing.assert_array_equal(frame["n3"], table["n3"])

    def test_codes(self):
        found = isoroll.periodic(WILD, period=2)
        self.assertEqual([found.codes["stability"][code] for code in found.rows["stability"]], list(found["stability"]))
        self.assertEqual(isoroll.run(BALL).codes, {})

    def test_without_pandas_and_matplotlib(self):
        table = isoroll.run(BALL)
        with without("pandas"), self.assertRaisesRegex(ImportError, "to_pandas needs pandas.*pip install"):
            table.to_pandas()
        with without("matplotlib"), self.assertRaisesRegex(ImportError, "plot needs matplotlib.*pip install"):
            table.plot()

    def test_strided_and_read_only_arrays(self):
        wide = np.zeros((50, 14))
        wide[:, ::2] = isoroll.run(WILD).array[:50]
        view = wide[:, ::2]
        view.flags.writeable = False
        table = isoroll.Table(view, isoroll.run(WILD).columns, isoroll.run(WILD).lines)
        self.assertTrue(np.shares_memory(table.n, wide))
        with self.assertRaisesRegex(ValueError, "read-only"):
            table.n[0] = 0
        table.write(self.path("a.csv"))
        self.same(isoroll.read(self.path("a.csv")).array, np.ascontiguousarray(view))
        self.same(isoroll.convert(table, "point").array, isoroll.convert(self.path("a.csv"), "point").array)
        self.assertEqual(isoroll.check(table).worst.tolist(), isoroll.check(self.path("a.csv")).worst.tolist())
        times = np.linspace(0, 5, 12)[::-2]
        times.flags.writeable = False
        self.same(isoroll.run(WILD, times).t, np.ascontiguousarray(times))


    def test_without_columns(self):
        for table in (isoroll.Table(np.empty((3, 0)), []), isoroll.explain(WILD)):
            self.assertEqual(table.rows.shape, (len(table),))
            self.assertEqual(table.columns, ())
            self.assertTrue(str(table) and table._repr_html_())
        for columns, kind in (([1, 2], None), (["a", None], None), (["a", "b"], 5)):
            make = lambda: isoroll.Table(np.zeros((1, 2)), columns, kind=kind)
            self.refuses(isoroll.BadType, "text", make)


class Refusals(Case):
    def test_refused(self):
        for name, text, words in (("a.csv", "# isoroll section 9\nl\n1\n", "expected version 1"),
                                  ("b.h5", "no HDF5", ""), ("c.csv", "", "")):
            with open(self.path(name), "w", encoding="utf-8") as file:
                file.write(text)
            with self.assertRaises(isoroll.IsorollError) as caught:
                isoroll.read(self.path(name))
            self.assertIn(words, str(caught.exception))
        with self.assertRaisesRegex(KeyError, "no column 'x': the table has t, omega1"):
            isoroll.run(BALL)["x"]


@unittest.skipUnless(matplotlib, "python3-matplotlib is not installed")
class Pictures(Case):
    def tearDown(self):
        pyplot.close("all")

    def tables(self):
        scene = isoroll.Scene(WILD, end=20)
        yield isoroll.run(BALL, as_="both"), 3
        yield isoroll.run(BALL), 3
        yield isoroll.batch(WILD, np.linspace(0.1, 3, 30), k=[0.5, 0.6]), 2
        yield isoroll.section(WILD, starts=3, crossings=20), 2
        yield isoroll.section(example("21_levels"), crossings=10), 2
        yield isoroll.chaos(WILD, starts=6, turns=40), 1
        yield isoroll.chaos(WILD, turns=40), 3
        yield isoroll.periodic(WILD, period=2), 2
        yield isoroll.periodic(WILD, period=1, follow=("k", (0.49, 0.51))), 2
        yield isoroll.periodic(WILD, chart="J2", steps=6), 2
        yield isoroll.splitting(WILD, k=[0.5, 0.75]), 1
        yield isoroll.frequencies(BALL), 2
        compared = isoroll.compare(WILD, t_end=5)
        compared.write(self.path("compared.csv"))
        yield compared, 3
        yield isoroll.read(self.path("compared.csv")), 1
        yield isoroll.cost(WILD, quick=True, method="taylor", t_end=1), 2
        plan = {"scene": scene, "measure": {"state": {}}, "until": {"time": 1}}
        yield isoroll.sweep({**plan, "vary": {"k": {"from": 0.5, "to": 1.2, "count": 5}}}), 1
        yield isoroll.sweep({**plan, "vary": {"k": [0.5, 0.75], "J3": [4, 5, 6], "J1": [1, 1.1, 1.2]}}), 2

    def test_each_kind(self):
        for table, parts in self.tables():
            with self.subTest(table):
                axes = np.ravel(np.asarray(table.plot(), dtype=object))
                self.assertEqual(len(axes), parts)
                for at in axes:
                    self.assertIsInstance(at, matplotlib.axes.Axes)
                    self.assertTrue(at.has_data())
                axes[0].figure.canvas.draw()
                table.write(self.path("a.h5")) if table.array.ndim == 2 and table.columns else None
                own = pyplot.figure().subplots(1, parts)
                self.assertIs(np.ravel(np.asarray(table.plot(own), dtype=object))[0], np.ravel(own)[0])
                more = pyplot.figure().subplots(1, parts + 1)
                self.refuses(isoroll.BadArgument, "this picture has", table.plot, more)
                pyplot.close("all")

    def test_draw_the_numbers(self):
        table = isoroll.run(BALL)
        curve = table.plot(columns=("t", "n3")).get_lines()[0]
        self.same(curve.get_xdata(), table.t)
        self.same(curve.get_ydata(), table["n3"])
        self.assertEqual(len(isoroll.plot(table, columns="t,omega").get_lines()), 3)
        for section in (isoroll.section(WILD, starts=2, crossings=10, as_="both", model="ball"),
                        isoroll.section(example("21_levels"), crossings=10, as_="both", model="ball")):
            a = int(section.lines["axis"])
            b, c = a % 3 + 1, (a + 1) % 3 + 1
            point = np.stack([section["l"], section[f"M{a}"]], 1)
            ball = np.stack([np.arctan2(-section[f"n{c}"], section[f"n{b}"]),
                             section[f"omega{a}"] / np.linalg.norm(section.omega, axis=1)], 1)
            for at, wanted in zip(section.plot(), (ball, point)):  # each has a spot on it, which others may share
                spots = np.concatenate([each.get_offsets() for each in at.collections[:3]])
                cell = np.array([np.diff(at.get_xlim())[0], np.diff(at.get_ylim())[0]]) / 640
                far = np.abs(wanted[:, None] - spots[None]) / cell
                self.assertLess(np.max(np.min(np.max(far, axis=2), axis=1)), 1)

    def test_files(self):
        table = isoroll.section(WILD, crossings=10)
        table.write(self.path("s.csv"))
        isoroll.plot(self.path("s.csv"), self.path("s.png"))
        self.assertGreater(os.path.getsize(self.path("s.png")), 5000)

    def test_refused(self):
        for table, words in ((isoroll.explain(BALL), "there is no picture of a table 'explain'"),
                             (isoroll.run(BALL, columns=["t"]), "no column"),
                             (isoroll.trajectory({"t": [], "n": np.ones((0, 3))}), "no rows"),
                             (isoroll.Table([[0.0, 1, 1]], ["orbit", "l", "x"], kind="section"), "say its axis")):
            self.refuses(isoroll.BadInput, words, table.plot)
        self.refuses(isoroll.BadInput, "no column 'x'", isoroll.run(BALL).plot, columns=("t", "x"))
        self.refuses(isoroll.BadArgument, "two names", isoroll.run(BALL).plot, columns="t")
        self.refuses(isoroll.BadArgument, "value is not for a picture of a table 'trajectory'", isoroll.run(BALL).plot,
                     value="n1")
        self.refuses(isoroll.BadArgument, "window must be two ranges", isoroll.run(BALL).plot, window=(1, 2))
        with self.assertRaisesRegex(TypeError, "unexpected keyword argument 'colour'"):
            isoroll.run(BALL).plot(colour="red")
        for ax in ("picture.svg", pyplot.figure()):
            with self.assertRaisesRegex(TypeError, "Axes of matplotlib, not (str|Figure); isoroll.plot"):
                isoroll.run(BALL).plot(ax)


class Memory(Case):
    def test_a_batch_is_not_copied(self):
        """1500 orbits of 500 rows, 42 MB: the process grows by this once. (A million would be 28 GB.)"""
        code = ("import isoroll, numpy as np, resource\n"
                "most = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024\n"
                f"k, times = np.linspace(0.5, 0.7, 1500), np.linspace(0.02, 10, 500)\n"
                f"isoroll.batch({WILD!r}, times, k=k[:200])\n"
                "before = most()\n"
                f"table = isoroll.batch({WILD!r}, times, k=k)\n"
                "views = table.n, table['omega'], table.orbit(7).n, np.asarray(table), table.rows, table.t\n"
                "assert all(np.shares_memory(view, table.array) for view in views)\n"
                "print((most() - before) / table.array.nbytes)")
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
        self.assertEqual(done.stderr, "")
        self.assertLess(float(done.stdout), 1.4)


if __name__ == "__main__":
    unittest.main()

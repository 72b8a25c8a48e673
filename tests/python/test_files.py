"""Files, conversion, tables, and NumPy's own readers."""

import copy
import gc
import os
import pickle
import subprocess
import sys
import unittest

import numpy as np
from shared import BALL, SOURCE, WILD, Case, example

import isoroll


class Files(Case):
    def test_there_and_back(self):
        table = isoroll.run(BALL, as_="both")
        for name, digits in (("a.csv", 17), ("b.csv", "hex"), ("c.h5", 17)):
            try:
                isoroll.write(table, self.path(name), digits=digits)
            except isoroll.BadArgument as error:
                self.assertIn("HDF5", str(error))
                continue
            again = isoroll.read(self.path(name))
            self.same(again.array, table.array)
            self.assertEqual(again.columns, table.columns)
            self.assertEqual(dict(again.lines.text), dict(table.lines.text))
        with open(self.path("b.csv"), encoding="utf-8") as file:
            self.assertIn("0x1.", file.read())
        isoroll.write(table, self.path("d.csv"), digits=3)
        self.near(isoroll.read(self.path("d.csv")).n, table.n, 0.5e-3)

    def test_several_orbits(self):
        section = isoroll.section(BALL, starts=2, crossings=5, as_="ball")
        table = isoroll.convert(section, "point")
        isoroll.write(table, self.path("orbits.csv"))
        again = isoroll.read(self.path("orbits.csv"))
        self.assertEqual(again.columns, table.columns)
        self.same(again.array, table.array)
        self.assertLess(np.max(isoroll.check(again).worst), 1e-9)

    def test_what_is_changed_is_written(self):
        table = isoroll.run(BALL)
        table.n[3, 1] = 0.125
        isoroll.write(table, self.path("a.csv"))
        self.assertEqual(isoroll.read(self.path("a.csv")).n[3, 1], 0.125)
        table.t[7] = np.nan
        self.refuses(isoroll.NumericalFailure, "", isoroll.write, table, self.path("a.csv"))
        self.assertEqual(isoroll.read(self.path("a.csv")).n[3, 1], 0.125)  # the old file is whole

    def test_sections(self):
        self.command("section", WILD, "--starts", "3", "--crossings", "20", "-o", "command.csv", "--quiet")
        table = isoroll.read(self.path("command.csv"))
        isoroll.write(table, self.path("python.csv"))
        self.same_files(self.path("command.csv"), self.path("python.csv"))
        self.assertEqual(len(table), 80)
        isoroll.write(table, self.path("hex.csv"), digits="hex")
        for path in (self.path("hex.csv"), os.fsencode(self.path("hex.csv"))):
            self.same(isoroll.read(path).array, table.array)
        isoroll.write(isoroll.section(WILD, crossings=3, as_="both"), self.path("both.csv"))
        self.assertEqual(isoroll.read(self.path("both.csv")).M.shape, (3, 3))

    def test_files_of_others(self):
        file = example("14_from_python", "leapfrog.csv")
        table = isoroll.read(file, ["-", "s", "gamma1", "gamma2", "gamma3", "M1", "M2", "M3"])
        own = isoroll.trajectory({"s": table.s, "M": table.M, "gamma": table.gamma}, k=-1, J=[6, 4, 2], eps=0.5)
        ball = isoroll.convert(own, "ball", row_tolerance=1e-3)
        self.command("convert", "--to", "ball", "--max-defect", "1", "--k=-1", "--J", "6,4,2", "--eps", "0.5",
                     "--row-tolerance", "1e-3", "--columns", "-,s,gamma1,gamma2,gamma3,M1,M2,M3", file,
                     "-o", "ball.csv")
        self.same(isoroll.read(self.path("ball.csv")).n, ball.n)

    def test_other_columns(self):
        with open(self.path("a.csv"), "w", encoding="utf-8") as file:
            file.write("t,weight,n1\n0,7,1\n1,8,2\n")
        with self.assertWarnsRegex(isoroll.IsorollWarning, "passed over: .*weight"):
            table = isoroll.read(self.path("a.csv"))
        self.same(table.array, [[0.0, 1.0], [1.0, 2.0]])

    def test_lines_that_are_no_utf_8(self):
        with open(self.path("a.csv"), "wb") as file:
            file.write(b"# isoroll trajectory 1\n# \xff: 1\n# \xfe: \xe9\n# \xfd: 3\nt,n1\n0,1\n")
        code = f"import isoroll; t = isoroll.read({self.path('a.csv')!r}); print(len(t.lines)); " \
            f"isoroll.write(isoroll.Table(t.array, t.columns, t.lines), {self.path('b.csv')!r})"
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300, check=True)
        self.assertEqual(done.stdout, "3\n")
        self.same_files(self.path("a.csv"), self.path("b.csv"))
        with open(self.path("c.csv"), "wb") as file:
            file.write(b"# isoroll mine 1\nt,\xb5\n0,1\n")
        isoroll.read(self.path("c.csv")).write(self.path("d.csv"))
        with open(self.path("d.csv"), "rb") as file:
            self.assertIn(b"t,\xb5\n", file.read())

    def test_refused(self):
        self.refuses(isoroll.FileTrouble, "No such file", isoroll.read, self.path("absent.csv"))
        self.refuses(isoroll.FileTrouble, "", isoroll.write, isoroll.run(BALL), self.path("no/folder.csv"))
        self.assertIsInstance(isoroll.FileTrouble(), OSError)
        with open(self.path("a.csv"), "w", encoding="utf-8") as file:
            file.write("t,n1\n0,1\n1,x\n")
        self.refuses(isoroll.BadInput, "a.csv:3:3:", isoroll.read, self.path("a.csv"))
        for digits in (0, 18, -1):
            self.refuses(isoroll.BadArgument, "digits", isoroll.write, isoroll.run(BALL), self.path("b.csv"),
                         digits=digits)
        with open(self.path("s.csv"), "w", encoding="utf-8") as file:
            file.write("# isoroll section 1\norbit,l\n0,1\n0\n")
        self.refuses(isoroll.BadInput, "s.csv:4:2: expected more cells", isoroll.read, self.path("s.csv"))

class Conversion(Case):
    def test_is_that_of_the_command(self):
        ball = isoroll.run(BALL)
        isoroll.write(ball, self.path("ball.csv"))
        self.command("convert", "--to", "point", "ball.csv", "-o", "point.csv", "--quiet")
        command, point = isoroll.read(self.path("point.csv")), isoroll.convert(ball, "point")
        self.same(command.array, point.array)
        self.assertEqual(dict(command.lines.text), dict(point.lines.text))

    def test_rows_that_solve_other_equations(self):
        ball = isoroll.run(BALL)
        other = isoroll.trajectory({"t": ball.t, "omega": ball.omega, "n": ball.n}, k=-1, J=[1, 2, 5.1])
        with self.assertWarnsRegex(isoroll.IsorollWarning, "do not solve the equations"):
            isoroll.convert(other, "point")

    def test_refused(self):
        ball = isoroll.run(BALL)
        self.refuses(isoroll.BadArgument, "expected ball or point", isoroll.convert, ball, "both", about="to")
        self.refuses(isoroll.BadArgument, "tol is '2': expected", isoroll.convert, ball, "point", tol=2)
        self.refuses(isoroll.BadArgument, "row-tolerance", isoroll.convert, ball, "point", row_tolerance=0)
        bare = isoroll.trajectory({"t": ball.t, "omega": ball.omega, "n": ball.n})
        self.refuses(isoroll.BadInput, "does not say its k", isoroll.convert, bare, "point")


class Tables(Case):
    def test_views(self):
        table = isoroll.run(BALL)
        for view in (table["t"], table["omega"], table.n, table["omega2"], np.asarray(table), table.rows):
            self.assertTrue(np.shares_memory(view, table.array))
        self.assertEqual(table.rows["n3"][4], table.n[4, 2])
        self.assertEqual(table.n.shape, (301, 3))
        self.assertIn("omega", table)
        self.assertNotIn("gamma", table)
        with self.assertRaisesRegex(KeyError, "there is no column 'gamma'"):
            table["gamma"]
        with self.assertRaisesRegex(AttributeError, "there is no column 'gamma'"):
            table.gamma
        self.assertEqual((table.k, table.J.tolist()), (-1, [1, 2, 5]))

    def test_an_array_outlives_its_table(self):
        n = isoroll.run(BALL).n
        wanted = isoroll.run(BALL).n.copy()
        gc.collect()
        for _ in range(100):  # other tables would take its memory
            isoroll.run(BALL, end=1)
        self.same(n, wanted)

    def test_columns_in_another_order(self):
        table = isoroll.run(BALL, columns=["n3", "t", "n1", "n2"])
        np.testing.assert_array_equal(table.n, isoroll.run(BALL).n)
        with self.assertRaisesRegex(ValueError, "read-only"):  # a copy: writing to it would change nothing
            table.n[0] = 0
        table["n1"][0] = 7
        self.assertEqual(table.n[0, 0], 7)
        gaps = isoroll.Table(np.zeros((4, 6))[:, ::2], ["n1", "n2", "n3"])
        with self.assertRaisesRegex(ValueError, "read-only"):
            gaps.rows["n1"][:] = 1

    def test_nothing_is_written_to_nowhere(self):
        for table in (isoroll.run(BALL), isoroll.orbit(BALL).at([1, 2]), isoroll.batch(BALL, [1])):
            for name in ("array", "columns", "lines"):
                with self.assertRaisesRegex(AttributeError, f"'{name}' of a table cannot be replaced"):
                    setattr(table, name, getattr(table, name))
            for name in ("t", "n", "omega2", "gamma"):
                with self.assertRaisesRegex(AttributeError, "is a name of a column"):
                    setattr(table, name, np.zeros(2))
            table.label = "mine"
            table.n[...] = 0.5
            self.assertTrue((table.array[..., 4:] == 0.5).all())

    def test_arrays_that_do_not_fit(self):
        table = isoroll.run(BALL)
        for array in (table.array[:, :4], table.array[0, :2], 1.0, table.array.T, [[1, 2], [3]]):
            with self.assertRaises(isoroll.BadArgument):
                isoroll.Table(array, table.columns, table.lines)
        for bad in (table.array + 1j, np.ma.masked_less(table.array, 0), table.array.astype(str)):
            with self.assertRaisesRegex(isoroll.BadArgument, "array "):
                isoroll.Table(bad, table.columns)
        whole = isoroll.Table([[0, 1], [1, 2]], ["t", "n1"])
        isoroll.write(whole, self.path("a.csv"))
        self.same(isoroll.read(self.path("a.csv")).array, [[0.0, 1.0], [1.0, 2.0]])

    def test_copies(self):
        table = isoroll.run(BALL)
        for other in (copy.deepcopy(table), pickle.loads(pickle.dumps(table)), copy.copy(table)):
            self.same(other.array, table.array)
            self.assertEqual(dict(other.lines.text), dict(table.lines.text))
            self.assertFalse(np.shares_memory(other.array, table.array))
            isoroll.write(other, self.path("a.csv"))
        with self.assertRaisesRegex(TypeError, "cannot be copied"):
            copy.copy(isoroll.orbit(BALL))

    def test_own(self):
        for bad in ({}, {"t": [1, 2], "n": [[1, 2, 3]]}, {"n": [[1, 2]]}, {"n": 1.0}):
            with self.assertRaises(isoroll.BadArgument):
                isoroll.trajectory(bad) if bad != {"n": 1.0} else isoroll.trajectory({"n": [[1.0], [2.0]]})
        for bad in ({"t": [1j]}, {"t": np.ma.masked_equal([1.0, 2.0], 2)}, {"t": ["x"]}, {"n": np.ones((2, 3, 1))}):
            self.refuses(isoroll.BadArgument, "column '", isoroll.trajectory, bad)
        for columns, lines in (({"t\0x": [1]}, {}), ({"t\nx": [1]}, {}), ({"t": [1]}, {"note": "a\0b"})):
            self.refuses(isoroll.BadArgument, "end of a line", isoroll.write, isoroll.trajectory(columns, **lines),
                         self.path("a.csv"))
        for columns, words in (({"n": np.ones((3, 4))}, r"'n' has shape (3, 4), it must be (rows, 3)"),
                               ({"w": np.ones((4, 3))}, "it must be (rows,); vectors are omega, n"),
                               ({"q": np.ones((4, 3))}, "it must be (rows, 4)")):
            self.refuses(isoroll.BadArgument, words, isoroll.trajectory, columns)
        self.assertEqual(isoroll.trajectory({"t": [], "n": np.ones((0, 3))}).n.shape, (0, 3))
        table = isoroll.trajectory({"s": [0, 1], "M1": [1, 2]}, k=1)
        self.assertEqual((table.columns, table.lines["model"]), (("s", "M1"), "point"))


class Numpy(Case):
    """The calls of lib/doc/formats.md that need NumPy alone."""

    def test_documented_calls(self):
        isoroll.write(isoroll.run(BALL), self.path("ball.csv"))
        with open(os.path.join(SOURCE, "lib/doc/formats.md"), encoding="utf-8") as file:
            calls = [line.strip() for line in file if line.startswith("    ball = np.")]
        self.assertGreaterEqual(len(calls), 2)
        table = isoroll.read(self.path("ball.csv"))
        folder = os.getcwd()
        os.chdir(self.folder)
        try:
            for call in calls:
                found = eval(call.split("=", 1)[1], {"np": np, "open": open})  # NAME = CALL
                if found.dtype.names:
                    self.same(found["omega2"], table["omega2"])
                    self.assertEqual(found.dtype.names, table.columns)
                else:
                    self.same(found, table.array)
        finally:
            os.chdir(folder)


if __name__ == "__main__":
    unittest.main()

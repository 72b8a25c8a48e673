"""What is no number, no text, no table: every call refuses it by an error of the package; all numbers by one rule."""

import decimal
import os
import unittest
import warnings

import numpy as np
from shared import WILD, Case, example

import isoroll

START = dict(k=0.5, J=(1.4, 2.1, 3), normal=(0.36, 0.48, 0.8), angular_velocity=(0.9, -0.3, -0.225))
SCENE = isoroll.Scene(**START, end=2, step=1)
TABLE = isoroll.run(SCENE)
BARE = isoroll.Table(TABLE.array, TABLE.columns)
PLAN = {"scene": SCENE, "vary": {"k": [0.5]}, "measure": {"rotations": {}}}

#: one number each; what takes it, and a value that it takes
NUMBERS = {
    "k": (lambda x: isoroll.Scene(SCENE, k=x), 1),
    "end": (lambda x: isoroll.Scene(SCENE, end=x), 1),
    "step": (lambda x: isoroll.Scene(SCENE, step=x), 1),
    "tolerance": (lambda x: isoroll.Scene(SCENE, tolerance=x), 0.0625),
    "run end": (lambda x: isoroll.run(SCENE, t_end=x), 1),
    "run step": (lambda x: isoroll.run(SCENE, step=x), 1),
    "run tol": (lambda x: isoroll.run(SCENE, tol=x), 0.0625),
    "orbit end": (lambda x: isoroll.orbit(SCENE, end=x), 1),
    "threads": (lambda x: isoroll.batch(SCENE, [1], threads=x), 1),
    "sweep threads": (lambda x: isoroll.sweep(PLAN, threads=x), 1),
    "digits": (lambda x: TABLE.write(os.devnull, digits=x), 1),
    "convert tol": (lambda x: isoroll.convert(TABLE, "point", tol=x), 0.0625),
    "row_tolerance": (lambda x: isoroll.convert(TABLE, "point", row_tolerance=x), 0.0625),
    "convert k": (lambda x: isoroll.convert(BARE, "point", k=x, J=START["J"], row_tolerance=0.0625), 0.5),
    "crossings": (lambda x: isoroll.section(SCENE, crossings=x), 1),
    "starts": (lambda x: isoroll.section(SCENE, crossings=1, starts=x), 1),
    "section tol": (lambda x: isoroll.section(SCENE, crossings=1, tol=x), None),
    "turns": (lambda x: isoroll.chaos(SCENE, turns=x), 2),
    "splitting k": (lambda x: isoroll.splitting(SCENE, k=x), 0.5),
    "period": (lambda x: isoroll.periodic(SCENE, period=x), 1),
    "energy": (lambda x: isoroll.analogue(neumann=(1, 2, 2.5), energy=x), 2),
    "compare end": (lambda x: isoroll.compare(SCENE, t_end=x), 1),
    "check max": (lambda x: isoroll.check(TABLE, max=x), 1),
}
WHOLE = ("threads", "sweep threads", "digits", "crossings", "starts", "turns", "period")
TEXTS = ("splitting k",)  # numbers, or a text as it is typed after the command
#: what float() would take, and what it would not
NO_NUMBERS = (True, np.True_, np.array(True), "1", "1e3", b"1", bytearray(b"1"), 1 + 0j, np.complex128(1),
              decimal.Decimal(1), np.datetime64("2020"), memoryview(b"1"), {1}, {},
              object())
NO_SCALARS = ([1.0], np.array([1.0]))  # of calls that take one number
NOT_FINITE = (np.nan, np.inf, -np.inf, np.float64("nan"))

#: arrays of numbers
ARRAYS = {
    "J": lambda x: isoroll.Scene(SCENE, J=x), "normal": lambda x: isoroll.Scene(SCENE, normal=x),
    "times": lambda x: isoroll.run(SCENE, x), "at": lambda x: isoroll.orbit(SCENE).at(x),
    "batch times": lambda x: isoroll.batch(SCENE, x), "batch k": lambda x: isoroll.batch(SCENE, [1], k=x),
    "batch J": lambda x: isoroll.batch(SCENE, [1], J=x), "batch start": lambda x: isoroll.batch(SCENE, [1], start=x),
    "section at": lambda x: isoroll.section(WILD, crossings=1, at=x),
    "neumann": lambda x: isoroll.analogue(neumann=x, energy=2), "check J": lambda x: isoroll.check(TABLE, J=x),
    "convert J": lambda x: isoroll.convert(BARE, "point", k=0.5, J=x),
}
NO_ARRAYS = ([True, False, True], "1,2,3", b"123", [1j, 2, 3], ["1", "2", "3"], [[1], 2, 3], {1, 2, 3}, {}, object(),
             [None, 1, 2], [np.nan, 1, 2])

#: scenes, tables, files, names
OBJECTS = {
    "Scene": isoroll.Scene, "run": isoroll.run, "orbit": isoroll.orbit, "batch": lambda x: isoroll.batch(x, [1]),
    "section": isoroll.section, "chaos": isoroll.chaos, "explain": isoroll.explain,
    "study": lambda x: isoroll.study(x, "chaos"), "sweep": isoroll.sweep, "trajectory": isoroll.trajectory, "Lines": isoroll.Lines, "check": isoroll.check,
    "convert": lambda x: isoroll.convert(x, "point"), "read": isoroll.read, "plot": isoroll.plot, "view": isoroll.view,
    "write": lambda x: isoroll.write(x, os.devnull), "path": TABLE.write, "to": lambda x: isoroll.convert(TABLE, x),
    "columns": lambda x: isoroll.Table([[1.0]], x), "array": lambda x: isoroll.Table(x, ["t"]),
    "study name": lambda x: isoroll.study(SCENE, x),
}
NAMES = {  # None: not given
    "scene columns": lambda x: isoroll.Scene(SCENE, columns=x), "backend": lambda x: isoroll.run(SCENE, backend=x),
    "as": lambda x: isoroll.Scene(SCENE, as_=x), "vectors": lambda x: isoroll.batch(SCENE, [1], vectors=x),
    "read columns": lambda x: isoroll.read(os.devnull, columns=x), "list": isoroll.list_,
    "kind": lambda x: isoroll.Table([[1.0]], ["t"], kind=x), "lines": lambda x: isoroll.Table([[1.0]], ["t"], x),
    "progress": lambda x: isoroll.chaos(SCENE, turns=1, progress=x),
}
ODD = (3, 1.5, np.float64(1), 1j, np.True_, np.array(2), object(), memoryview(b"ab"), [object()], range(2))


class Objects(Case):
    def refused(self, call, value, kind=isoroll.IsorollError):
        """Refused by an error of the package, with words of its own."""
        with self.assertRaises(kind) as caught:
            call(value)
        self.assertIsInstance(caught.exception, ValueError)
        self.assertGreater(len(str(caught.exception)), 8)

    def test_numbers_are_numbers(self):
        for name, (call, good) in NUMBERS.items():
            for wrong in NO_NUMBERS + (() if name in TEXTS else NO_SCALARS):
                if name in TEXTS and isinstance(wrong, (str, dict)):
                    continue
                with self.subTest(name, wrong=repr(wrong)):
                    self.refused(call, wrong)
            for wrong in NOT_FINITE:
                with self.subTest(name, wrong=repr(wrong)):
                    self.refused(call, wrong)
            if good is None:
                continue
            for kind in (np.int64, np.uint8) if name in WHOLE else (np.float32, np.longdouble, np.array):
                with self.subTest(name, kind=kind.__name__), warnings.catch_warnings():
                    warnings.simplefilter("ignore", isoroll.IsorollWarning)
                    call(kind(good))

    def test_arrays_are_of_numbers(self):
        for name, call in ARRAYS.items():
            for wrong in NO_ARRAYS:
                with self.subTest(name, wrong=repr(wrong)):
                    self.refused(call, wrong)

    def test_objects(self):
        for name, call in {**OBJECTS, **NAMES}.items():
            for odd in (*ODD, *(() if name in NAMES else (None,))):
                with self.subTest(name, odd=repr(odd)):
                    self.refused(call, odd)
        self.assertTrue(issubclass(isoroll.BadType, TypeError))
        with self.assertRaises(isoroll.BadType):
            isoroll.trajectory(None)
        for lines in ({"k": True}, {"k": "1e3"}, {"k": [1, 2]}, {"J": "abc"}, {"J": (1, 2)}, {"J": [True, 2, 3]},
                      {"J": (1, 2, np.nan)}, {"k": np.timedelta64(1)}):
            with self.assertRaises(isoroll.BadArgument, msg=lines):
                isoroll.trajectory({"t": [0.0]}, **lines)


class Warnings(Case):
    def test_point_at_the_line_of_the_caller(self):
        """Of each kind of call that warns: the file is this one, the line that of the call."""
        weights = self.path("weights.csv")
        np.savetxt(weights, np.insert(TABLE.array, 1, 5, axis=1), delimiter=",", comments="",
                   header="t,weight,omega1,omega2,omega3,n1,n2,n3")
        false = isoroll.trajectory({"t": TABLE.t, "omega": 1.1 * TABLE.omega, "n": TABLE.n}, k=0.5, J=START["J"])
        calls = {"run": lambda: isoroll.run(example("09_off_the_top")), "read": lambda: isoroll.read(weights),
                 "check": lambda: isoroll.check(weights, k=0.5, J=START["J"]),
                 "convert": lambda: isoroll.convert(false, "point"),
                 "section": lambda: isoroll.section(WILD, axis=1, crossings=5),
                 "study": lambda: isoroll.study(WILD, "section", axis=1, crossings=5)}
        for name, call in calls.items():
            with self.subTest(name), warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                call()
                self.assertGreater(len(caught), 0)
                for found in caught:
                    self.assertEqual(found.filename, __file__)
                    self.assertEqual(found.lineno, call.__code__.co_firstlineno)


if __name__ == "__main__":
    unittest.main()

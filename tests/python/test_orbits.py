"""Runs, orbits and batches: what Python gets is what the command writes and what the library computes."""

import pickle
import unittest
import warnings

import numpy as np
from shared import BALL, WILD, Case, example, starts

import isoroll


class Runs(Case):
    def test_dict_text_and_file_are_one_scene(self):
        sections = {"reduced": {"k": np.array(0.5), "J": np.array([1.0, 2.0, 5.0])},
                    "initial": {"normal": (0.36, 0.48, 0.8), "angular_velocity": [0.9, -0.3, -0.225]},
                    "time": {"end": np.float64(7), "step": 0.25}, "effects": {"field": {"linear": [0, 0, 0.1]}},
                    "output": {"as": "ball", "columns": ["n1", "t"]}}
        text = """reduced: {k: 0.5, J: [1, 2, 5]}
initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}
time: {end: 7, step: 0.25}
effects: {field: {linear: [0, 0, 0.1]}}
output: {as: ball, columns: [n1, t]}
"""
        with open(self.path("scene.yaml"), "w", encoding="utf-8") as file:
            file.write(text)
        tables = [isoroll.run(source) for source in (sections, text, self.path("scene.yaml"), isoroll.Scene(text))]
        for table in tables[1:]:
            self.same(tables[0].array, table.array)
            self.assertEqual(dict(tables[0].lines.text), dict(table.lines.text))
        self.assertEqual(tables[0].columns, ("n1", "t"))
        scene = isoroll.Scene(sections)
        self.assertEqual((scene.model, scene.k, scene.end), ("ball", 0.5, 7))
        np.testing.assert_array_equal(scene.J, [1, 2, 5])
        self.near(scene.start, [0.9, -0.3, -0.225, 0.36, 0.48, 0.8], 1e-15)

    def test_order_of_changes(self):
        wanted = isoroll.run(isoroll.Scene(BALL, as_="both"), columns=["M1", "t"])
        self.assertEqual(wanted.columns, ("M1", "t"))
        for changes in ({"as_": "both", "columns": ["M1", "t"]}, {"columns": ["M1", "t"], "as_": "both"}):
            self.assertEqual(isoroll.Scene(BALL, **changes).columns, wanted.columns)
            self.same(isoroll.run(BALL, **changes).array, wanted.array)
            self.same(isoroll.orbit(BALL, **changes).at(wanted.t[:3]).array, wanted.array[:3])
        for empty in ([], (), ""):
            self.refuses(isoroll.BadArgument, "empty", isoroll.run, BALL, columns=empty, about="columns")

    def test_errors_cover_the_truth(self):
        table = isoroll.run(BALL, errors=True, method="rk8pd", tolerance=1e-8)
        truth = isoroll.run(BALL, backend="exact")
        self.assertGreater(table.errors["ball"], 1e-12)
        self.near(table.n, truth.n, table.errors["ball"])
        self.assertTrue(np.isnan(table.errors["point"]))
        self.assertIsNone(isoroll.run(BALL).errors)

    def test_contact(self):
        scene = example("09_off_the_top")
        with self.assertWarnsRegex(isoroll.IsorollWarning, "contact is lost at t = "):
            table = isoroll.run(scene)
        lost = table.t[-1]
        orbit = isoroll.orbit(scene)
        self.same(orbit.at(table.t[:-1]).array, table.array[:-1])
        self.refuses(isoroll.NumericalFailure, "contact is lost at", orbit.at, [0.1, 2 * lost], about="reactions")
        self.refuses(isoroll.BadArgument, "a batch does not see", isoroll.batch, scene, [0.1], about="scenes")

    def test_a_failure_keeps_the_rows_before_it(self):
        scene = {"reduced": {"k": 1, "J": [1, 2, 5]}, "time": {"end": -2000, "step": 100},
                 "initial": {"normal": [0, 0, 1], "angular_velocity": [1, 0.5, 0]},
                 "effects": {"rolling_resistance": {"coefficient": 0.1}}}
        error = self.refuses(isoroll.NumericalFailure, "", isoroll.run, scene)
        self.assertGreater(len(error.partial), 0)
        self.same(error.partial.array, isoroll.run(scene, error.partial.t).array)


class Orbits(Case):
    def test_shapes(self):
        orbit = isoroll.orbit(BALL, as_="both")
        for shape in ((), (0,), (3,), (2, 3), (2, 0, 4)):
            table = orbit.at(np.full(shape, 2.5))
            self.assertEqual(table.array.shape, shape + (15,))
            self.assertEqual(table.omega.shape, shape + (3,))
            self.assertEqual(table.tau.shape, shape)
        self.near(np.sum(orbit.at(3).n ** 2), 1, 1e-14)
        self.near(np.sum(orbit.at(3).M * orbit.at(3).gamma), 0, 1e-13)

    def test_slices_that_are_not_contiguous(self):
        orbit, times = isoroll.orbit(BALL), np.linspace(0, 10, 21)
        self.same(orbit.at(times[::2]).array, orbit.at(times).array[::2])
        wanted = orbit.at(times).array.reshape(3, 7, 7).transpose(1, 0, 2).copy()
        self.same(orbit.at(times.reshape(3, 7).T).array, wanted)
        self.same(orbit.at(list(range(5))).array, orbit.at(np.arange(5)).array)

    def test_energy_and_lines(self):
        orbit = isoroll.orbit(BALL)
        omega, J = orbit.at(7.0).omega, orbit.scene.J
        self.near(0.5 * np.sum(J * omega**2), orbit.energy, 1e-12)
        self.near(orbit.coupling, orbit.energy * np.prod(J) / orbit.scene.k**2, 1e-12)
        self.assertTrue(orbit.has_twin)
        self.assertFalse(isoroll.orbit(example("11_rubber_and_marble")).has_twin)
        table = orbit.at([1, 2, 3])
        again = isoroll.run(BALL, [1, 2, 3], backend=orbit.backend)
        self.assertEqual(dict(table.lines.text), dict(again.lines.text))
        self.same(isoroll.convert(table, "point").gamma, isoroll.convert(again, "point").gamma)

    def test_backends(self):
        for backend in ("ball", "point", "exact"):
            orbit = isoroll.orbit(BALL, backend=backend)
            self.assertEqual(orbit.backend, backend)
            times = [3.0, 0.0, -1.0, 2.0]
            self.same(orbit.at(times).array, isoroll.run(BALL, times, backend=backend).array)
        orbit = isoroll.orbit(BALL)
        self.same(orbit.at(0).array[1:], orbit.scene.start)  # as given, whatever backend auto takes

    def test_times_that_are_none(self):
        orbit = isoroll.orbit(BALL)
        for bad in (np.nan, np.inf, -np.inf):
            self.refuses(isoroll.BadArgument, "time 1 must be finite", orbit.at, [0, bad, 1], about="times")
        self.refuses(isoroll.BadArgument, "", orbit.at, 1e300)
        self.assertEqual(orbit.at(1).array.shape, (7,))  # it goes on


class Batches(Case):
    def test_lists_are_arrays(self):
        k, J = np.array([0.5, -1, 1.5]), np.array([[1, 2, 5], [2, 3, 4], [1, 1.5, 2]])
        first = starts(3)
        scenes = [{"reduced": {"k": k[i], "J": J[i]}, "time": {"end": 1},
                   "initial": {"normal": first[i, 3:], "angular_velocity": first[i, :3]}} for i in range(3)]
        table = isoroll.batch(scenes, [2, 4], as_="both")
        self.same(isoroll.batch(scenes[0], [2, 4], k=k, J=J, start=first, as_="both").array, table.array)
        self.assertEqual(table.gamma.shape, (3, 2, 3))
        self.assertEqual(table.orbit(1)["M"].shape, (2, 3))
        self.same(isoroll.batch(scenes[0], [2, 4], J=J[0], k=k).array,
                  isoroll.batch([{**scenes[0], "reduced": {"k": k[i], "J": J[0]}} for i in range(3)], [2, 4]).array)
        self.same(isoroll.batch(scenes[0], [2, 4], J=J).array,
                  isoroll.batch([{**scenes[0], "reduced": {"k": k[0], "J": J[i]}} for i in range(3)], [2, 4]).array)

    def test_an_orbit_by_itself(self):
        k, first, times = [-1, 0.5, 1.5], starts(3), np.linspace(0, 5, 51)
        table = isoroll.batch(WILD, times, k=k, start=first)
        for i in (0, 1, 2, -1):
            scene = {"reduced": {"k": k[i], "J": [1, 2, 5]}, "time": {"end": 50, "step": 0.5},
                     "initial": {"normal": first[i, 3:], "angular_velocity": first[i, :3]}}
            alone, own = isoroll.orbit(scene, backend="ball").at(times), table.orbit(i)
            self.assertEqual({**own.lines.text, "backend": "ball"}, dict(alone.lines.text))
            self.near(isoroll.convert(own, "point").array, isoroll.convert(alone, "point").array, 1e-8)
            isoroll.write(own, self.path("a.csv"))
            self.command("convert", "--to", "point", "a.csv", "-o", "point.csv", "--quiet")
        with self.assertRaises(IndexError):
            table.orbit(3)
        self.assertEqual(dict(pickle.loads(pickle.dumps(table)).orbit(0).lines.text), {})
        for name in ("07_neumann_point", "12_neumann_off_level"):
            point = isoroll.batch(example(name), [0, 0.5, 1], J=[[1, 1.5, 2], [1, 1.5, 2.5]])
            alone = isoroll.orbit(example(name), backend="point").at([0, 0.5, 1])
            self.assertEqual({**point.orbit(0).lines.text, "backend": "point"}, dict(alone.lines.text))
            self.near(isoroll.convert(point.orbit(0), "ball").n, isoroll.convert(alone, "ball").n, 1e-9)
        self.assertEqual(point.orbit(1).J[2], 2.5)
        self.assertEqual(point.orbit(1).lines["eps"], point.orbit(0).lines["eps"])

    def test_points(self):
        scene = example("07_neumann_point")
        table = isoroll.batch(scene, [0.5, 1])
        self.near(table.array[0], isoroll.orbit(scene).at([0.5, 1]).array, 1e-9)
        self.assertEqual(table.columns[0], "s")

    def test_failures(self):
        first = starts(60)
        k = np.full(60, 0.5)
        refused = self.refuses(isoroll.BadInput, "orbit 41: k = 0", isoroll.batch, WILD, [1], k=np.where(
            np.arange(60) == 41, 0, k), about="k")
        self.assertEqual(list(np.nonzero(refused.partial.status)[0]), [41])
        first[[43, 50], :3] *= 1e13  # more turns than can be followed
        error = self.refuses(isoroll.BadArgument, "orbit 43: ", isoroll.batch, WILD, [1, 1e4], start=first)
        kept = isoroll.batch(WILD, [1, 1e4][:2], start=first[38:48], on_error="keep")
        self.assertEqual(list(np.nonzero(kept.status)[0]), [5])
        self.assertTrue(np.isnan(kept.array[5]).all())
        self.assertFalse(np.isnan(kept.array[[4, 6]]).any())
        self.assertIn("orbit 5: ", str(kept.failure))
        self.assertEqual(list(np.nonzero(error.partial.status)[0]), [43, 50])

    def test_arguments(self):
        refuse = lambda words, **named: self.refuses(isoroll.BadArgument, words, isoroll.batch, WILD,
                                                     named.pop("times", [1.0]), **named)
        refuse("start has shape (3, 5)", start=np.zeros((3, 5)))
        refuse("k has shape (2, 2)", k=np.ones((2, 2)))
        refuse("[2, 3] orbits", k=[1, 2], J=np.ones((3, 3)))
        refuse("away from 0", times=[2, 1])
        for bad in (-1, 1025, 2**32 + 1, 1.5, np.nan, "two"):
            refuse("threads is", threads=bad)
        self.same(isoroll.batch(WILD, [1.0], threads=np.int64(1)).array, isoroll.batch(WILD, [1.0]).array)
        refuse("no vectors 'x'", vectors="x")
        refuse("backend exact", backend="exact")
        refuse("by method taylor, not 'rk8pd'", method="rk8pd")
        refuse("on_error", on_error="ignore")
        self.refuses(isoroll.BadArgument, "there are no scenes", isoroll.batch, [], [1])
        self.refuses(isoroll.BadArgument, "scene 1 has another tolerance", isoroll.batch,
                     [WILD, isoroll.Scene(WILD, tolerance=1e-9)], [1], about="scenes")
        self.assertEqual(isoroll.batch(WILD, []).array.shape, (1, 0, 7))

if __name__ == "__main__":
    warnings.simplefilter("error")
    unittest.main()

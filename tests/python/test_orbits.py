"""Runs, orbits and batches: what Python gets is what the command writes and what the library computes."""

import itertools
import pickle
import unittest
import warnings

import numpy as np
from shared import BALL, FULL, WILD, Case, example, starts

import isoroll

SCENES = [BALL, example("07_neumann_point"), example("10_bowl"), example("11_rubber_and_marble"),
          example("12_neumann_off_level"), example("05_equal_radii")]


class Runs(Case):
    def test_files_of_the_command(self):
        for scene in SCENES:
            for how in ({}, {"as_": "both"}):
                options = ["--as", "both"] if how else []
                if how and "rubber" in scene or how and "bowl" in scene:
                    continue  # the point has no such orbit
                with self.subTest(scene=scene, **how):
                    self.command("run", scene, "-o", "command.csv", "--t-end", "5", *options)
                    isoroll.write(isoroll.run(scene, end=5, **how), self.path("python.csv"))
                    self.same_files(self.path("command.csv"), self.path("python.csv"))

    def test_backends_and_methods(self):
        for how in ({"backend": "exact"}, {"backend": "point"}, {"method": "adams", "tolerance": 1e-8},
                    {"method": "rk8pd"}):
            options = [f"--{key}={value}".replace("tolerance", "tol") for key, value in how.items()]
            with self.subTest(**how):
                self.command("run", BALL, "-o", "command.csv", *options)
                isoroll.write(isoroll.run(BALL, **how), self.path("python.csv"))
                self.same_files(self.path("command.csv"), self.path("python.csv"))

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

    def test_times_in_any_order(self):
        rng = np.random.default_rng(1)
        times = rng.permutation(np.linspace(-20, 30, 101))
        table = isoroll.run(BALL, times)
        self.same(table.t, times)
        self.same(table.array, isoroll.run(BALL, np.sort(times)).array[np.argsort(np.argsort(times))])

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
        self.command("run", scene, "-o", "command.csv")
        isoroll.write(table, self.path("python.csv"))
        self.same_files(self.path("command.csv"), self.path("python.csv"))
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
    def test_any_order_equals_a_run(self):
        for scene in SCENES:
            table = isoroll.run(scene, end=10)
            orbit = isoroll.orbit(scene, end=10)
            clock = table.array[:, table.columns.index("t" if "t" in table else "s")]
            order = np.random.default_rng(2).permutation(len(clock))
            with self.subTest(scene=scene):
                self.same(orbit.at(clock[order]).array, table.array[order])
                self.same(orbit.at(clock).array, table.array)
                for i in order[:5]:
                    self.same(orbit.at(clock[i]).array, table.array[i])

    def test_a_rotor_is_a_magnetic_field(self):
        scene = {"reduced": {"k": -1, "J": [1, 2, 5]}, "time": {"end": 5, "step": 1},
                 "initial": {"normal": [0.36, 0.48, 0.8], "angular_velocity": [0.9, -0.3, -0.225]},
                 "effects": {"rotor": {"momentum": [0.3, 0.4, 0.5]}}}
        ball, point = (isoroll.run(scene, backend=backend, as_="both") for backend in ("ball", "point"))
        self.assertLess(np.abs(ball.array - point.array).max(), 1e-11)
        start = {name: [ball.array[0, ball.columns.index(f"{name}{i}")] for i in (1, 2, 3)] for name in ("M", "gamma")}
        twin = isoroll.Scene(point={"k": -1, "J": [1, 2, 5]}, initial=start, end=float(ball.s[-1]),
                             magnetic={"momentum": [0.3, 0.4, 0.5]})
        last = isoroll.run(twin, as_="both").array[-1]
        self.assertLess(np.abs(np.sort(last) - np.sort(ball.array[-1])).max(), 1e-10)

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
    def test_orbits_one_by_one(self):
        """Each orbit alone is the same to the bit, and near the orbit of another backend."""
        first, times = starts(20), [1.0, 10.0, 25.0]
        table = isoroll.batch(WILD, times, start=first)
        self.assertEqual(table.array.shape, (20, 3, 7))
        self.assertFalse(table.status.any())
        for i in range(0, 20, 3):
            self.same(isoroll.batch(WILD, times, start=first[i]).array[0], table.array[i])
            scene = {"reduced": {"k": 0.5, "J": [1, 2, 5]}, "time": {"end": 1},
                     "initial": {"normal": first[i, 3:], "angular_velocity": first[i, :3]}}
            self.near(isoroll.orbit(scene, backend="ball").at(times).array, table.array[i], 1e-8)

    def test_order_threads_and_back(self):
        first = starts(700)
        table = isoroll.batch(WILD, [5.0], start=first)
        self.same(isoroll.batch(WILD, [5.0], start=first[::-1]).array[::-1].copy(), table.array)
        self.same(isoroll.batch(WILD, [5.0], start=first, threads=1).array, table.array)
        self.same(isoroll.batch(WILD, [5.0], start=first, threads=5).array, table.array)
        back = isoroll.batch(WILD, [-5.0], start=table.array[:, 0, 1:])
        self.near(back.array[:, 0, 1:], first, 1e-9)

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
        first = starts(600)
        k = np.full(600, 0.5)
        refused = self.refuses(isoroll.BadInput, "orbit 417: k = 0", isoroll.batch, WILD, [1], k=np.where(
            np.arange(600) == 417, 0, k), about="k")
        self.assertEqual(list(np.nonzero(refused.partial.status)[0]), [417])
        first[5, 3:] = 0, 0, 2
        self.refuses(isoroll.BadInput, "orbit 5: normal has length 2", isoroll.batch, WILD, [1], start=first)
        first = starts(600)
        first[[430, 500], :3] *= 1e13  # more turns than can be followed
        error = self.refuses(isoroll.BadArgument, "orbit 430: ", isoroll.batch, WILD, [1, 1e4], start=first)
        kept = isoroll.batch(WILD, [1, 1e4][:2], start=first[425:435], on_error="keep")
        self.assertEqual(list(np.nonzero(kept.status)[0]), [5])
        self.assertTrue(np.isnan(kept.array[5]).all())
        self.assertFalse(np.isnan(kept.array[[4, 6]]).any())
        self.assertIn("orbit 5: ", str(kept.failure))
        self.assertEqual(list(np.nonzero(error.partial.status)[0]), [430, 500])

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

    @unittest.skipUnless(FULL, "takes a gigabyte")
    def test_large(self):
        first = starts(6000)
        table = isoroll.batch(WILD, np.linspace(0, 1, 500), start=first)
        for i in itertools.chain(range(3), (1999, 2048, 5999)):
            self.same(isoroll.batch(WILD, np.linspace(0, 1, 500), start=first[i]).array[0], table.array[i])


if __name__ == "__main__":
    warnings.simplefilter("error")
    unittest.main()

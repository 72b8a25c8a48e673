"""Scenes as values: keywords, text, equality, copies."""

import copy
import glob
import os
import pickle
import unittest

import numpy as np
from shared import BALL, SOURCE, WILD, Case, example

import isoroll
from isoroll._scene import KEYS

WHOLE = dict(k=0.5, J=(1, 2, 5), normal=(0.36, 0.48, 0.8), angular_velocity=(0.9, -0.3, -0.225))


def scenes():
    """The scenes of all examples."""
    found = sorted(glob.glob(os.path.join(SOURCE, "examples", "*", "*.yaml")))
    for path in found:
        with open(path, encoding="utf-8") as file:
            if "vary:" not in file.read():
                yield path


class Keywords(Case):
    def test_are_those_of_the_library(self):
        """Each key of the library is a keyword of the same meaning: what Scene says of itself comes back."""
        said = isoroll.Scene.__init__.__annotations__
        for section, keys in KEYS.items():
            for key in keys:
                if section not in ("effects", "surface"):
                    self.assertIn(key + "_" * (key == "as"), said)
        self.assertEqual(KEYS["reduced"].keys(), {"k", "J", "D"})
        self.assertIn("gravity", KEYS["effects"])

    def test_make_what_a_file_says(self):
        ball = isoroll.Scene(**WHOLE, end=7)
        self.assertEqual(ball, isoroll.Scene({
            "reduced": {"k": 0.5, "J": [1, 2, 5]}, "time": {"end": 7.0},
            "initial": {"angular_velocity": np.array([0.9, -0.3, -0.225]), "normal": [0.36, 0.48, 0.8]}}))
        self.assertEqual((ball.k, ball.J.tolist(), ball.end, ball.step), (0.5, [1, 2, 5], 7, 0.07))
        body = isoroll.Scene(mass=6.8, radius=0.1092, inertia=(0.027, 0.0274, 0.0283),
                             surface={"kind": "shell", "radius": 0.0546}, normal=(0, 0, 1),
                             angular_velocity=(1, 0, 0))
        self.assertEqual(body.k, -1)
        self.near(body.J, np.array([0.027, 0.0274, 0.0283]) + 6.8 * 0.1092**2, 1e-16)
        point = isoroll.Scene(k=-1, J=(6, 4, 2), eps=0.5, gamma=(1, 0, 0), M=(0, 0.1, 0.2))
        self.assertEqual((point.model, point.eps), ("point", 0.5))
        self.near(point.start, [0, 0.1, 0.2, 1, 0, 0], 0)
        self.assertEqual((point.gamma.tolist(), point.M.tolist()), ([1, 0, 0], [0, 0.1, 0.2]))
        self.assertEqual((body.normal.tolist(), body.angular_velocity.tolist()), ([0, 0, 1], [1, 0, 0]))
        with self.assertRaisesRegex(AttributeError, "starts from a ball: it has no gamma"):
            body.gamma
        with self.assertRaisesRegex(AttributeError, "starts from a point: it has no normal"):
            point.normal

    def test_words_for_slips(self):
        for slip, meant in (("omega", "angular_velocity"), ("n", "normal"), ("K", "k"), ("gravety", "gravity"), ("j", "J")):
            with self.assertRaisesRegex(TypeError, f"no keyword '{slip}': did you mean '{meant}'"):
                isoroll.Scene(WILD, **{slip: 1})
        self.refuses(isoroll.BadInput, "no start: give normal and angular_velocity", isoroll.Scene, k=0.5, J=(1, 2, 5))
        scene = isoroll.Scene(WILD)
        self.assertEqual(isoroll.Scene(WILD, tol=1e-9, t_end=7), isoroll.Scene(WILD, tolerance=1e-9, end=7))
        for name in ("k", "normal", "anything"):
            with self.assertRaisesRegex(AttributeError, rf"cannot be changed: isoroll.Scene\(scene, {name}=...\)"):
                setattr(scene, name, 1)
        self.assertEqual(scene, isoroll.Scene(WILD))

    def test_change_a_scene(self):
        for source in (WILD, isoroll.Scene(WILD), isoroll.Scene(WILD).text, isoroll.Scene(WILD).sections):
            other = isoroll.Scene(source, k=0.4, gravity={"mgb": 0.7, "up": (0, 0.6, 0.8)}, attitude=True, end=3)
            self.assertEqual((other.k, other.J.tolist(), other.end), (0.4, [1, 2, 5], 3))
            self.assertEqual(other.effects, ("gravity", "attitude"))
            self.assertIn("e1", other.columns)
            self.assertEqual(isoroll.Scene(other, gravity=None, attitude=False).effects, ())
            self.assertEqual(isoroll.Scene(other, effects=None, k=0.5), isoroll.Scene(WILD, end=3))
        self.assertEqual(isoroll.run(WILD, k=0.4, end=2).k, 0.4)

    def test_change_the_model(self):
        body = isoroll.Scene(example("01_bowling_ball"), gravity=None)
        reduced = isoroll.Scene(body, k=0.4)
        self.assertEqual((reduced.k, reduced.J.tolist()), (0.4, body.J.tolist()))
        self.assertNotIn("surface", reduced.sections)
        point = isoroll.Scene(WILD, gamma=(1, 0, 0), M=(0, 0.1, 0.2))
        self.assertEqual((point.model, point.k, point.J.tolist()), ("point", 0.5, [1, 2, 5]))
        ball = isoroll.Scene(point, **{key: WHOLE[key] for key in ("normal", "angular_velocity")})
        self.near(ball.start, isoroll.Scene(WILD).start, 0)
        again = isoroll.Scene(ball, mass=1, radius=1, inertia=(1, 2, 2.5), surface="plane")
        self.assertEqual(again.k, 1)

    def test_refused(self):
        scene = isoroll.Scene(**WHOLE)
        for bad, words in (({"kk": 3}, "did you mean 'k'"), ({"gravty": {}}, "did you mean 'gravity'"),
                           ({"xyz": 1}, "it takes ball, surface")):
            with self.assertRaisesRegex(TypeError, words):
                isoroll.Scene(scene, **bad)
        refuse = lambda kind, words, **keys: self.refuses(kind, words, isoroll.Scene, scene, **keys)
        refuse(isoroll.BadInput, "k = 0", k=0)
        refuse(isoroll.BadInput, "a list of 3", J=(1, 2))
        refuse(isoroll.BadInput, "missing 'up'", gravity={"mgb": 1})
        refuse(isoroll.BadInput, "give 'mgb'", gravity={"g": 1, "up": (0, 0, 1)})
        refuse(isoroll.BadInput, "unknown key 'color'", gravity={"color": 1})
        refuse(isoroll.BadArgument, "not object", k=object())
        refuse(isoroll.BadArgument, "must be in", tolerance=4)
        self.refuses(isoroll.BadInput, "no start", isoroll.Scene, k=1, J=(1, 2, 5))
        self.refuses(isoroll.BadInput, "no start", isoroll.Scene)
        self.refuses(isoroll.BadInput, "give either", isoroll.Scene, k=1, J=(1, 2, 5), mass=2, surface="plane")
        self.refuses(isoroll.BadArgument, "surrogates", isoroll.Scene, "\ud800.yaml")


class Text(Case):
    def test_gives_the_command_the_same_run(self):
        many = [isoroll.Scene(path) for path in scenes()]
        many += [isoroll.Scene(BALL, k=1 / 3, J=(0.1, 0.2, 0.25), end=3.1, step=0.7, as_="both", tolerance=1e-9),
                 isoroll.Scene(example("01_bowling_ball"), end=0.3, columns=["t", "n1", "q0"], attitude=True),
                 isoroll.Scene(**WHOLE, backend="ball", method="rk8pd", field={"linear": (0, 0.1, 1 / 7)})]
        many += [isoroll.Scene(BALL, **how) for how in ({"backend": "exact"}, {"backend": "point"},
                                                        {"method": "adams", "tolerance": 1e-8})]
        many += [isoroll.Scene(example(name), as_="both") for name in ("07_neumann_point", "12_neumann_off_level",
                                                                       "05_equal_radii")]
        for scene in many:
            scene = isoroll.Scene(scene, end=scene.end / 20 if scene.end > 3.2 else scene.end)
            with self.subTest(scene.name, text=scene.text):
                with open(self.path("scene.yaml"), "w", encoding="utf-8") as file:
                    file.write(scene.text)
                self.command("run", "scene.yaml", "-o", "command.csv")
                try:
                    isoroll.run(scene).write(self.path("python.csv"))
                except isoroll.IsorollWarning:  # contact is lost
                    with self.assertWarns(isoroll.IsorollWarning):
                        isoroll.run(scene).write(self.path("python.csv"))
                self.same_files(self.path("command.csv"), self.path("python.csv"))
                self.assertEqual(isoroll.Scene(scene.text), scene)

    def test_of_a_file_is_its_own(self):
        with open(BALL, encoding="utf-8") as file:
            self.assertEqual(isoroll.Scene(BALL).text, file.read())

    def test_of_a_changed_scene_is_the_library_s(self):
        third = isoroll.Scene("# k is a fraction\nreduced: {k: 1/3, J: [1, 2, 5/7]}\ntime: {end: 1}\n"
                              "initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}\n")
        text = ("reduced: {k: 1/3, J: [1, 2, 5/7]}\n"
                "initial: {normal: [0.36, 0.48, 0.8],\n          angular_velocity: [0.9, -0.3, -0.225]}\n"
                "time: {end: 2.5}\n")
        self.assertEqual(isoroll.Scene(third, end=2.5).text, text)
        text += "effects:\n  potential: {U: \"c*n1^2\", parameters: {c: 0.1}}\n  attitude: {}\n"
        changed = isoroll.Scene(third, end=2.5, attitude=True, potential={"U": "c*n1^2", "parameters": {"c": 0.1}})
        self.assertEqual(changed.text, text)
        self.assertEqual(eval(repr(changed), {"isoroll": isoroll}).text, text)

    def test_of_unusual_yaml(self):
        text = '{"reduced": {k: 5.0e-1, "J": [+1, 2.0,\n 5]}, initial: {project: true, normal: [-0.0, 0, 1], ' \
            "angular_velocity: [1,0,0.5]}, time: {end: 1}, output: {columns: ['t', \"n1\"]}}"
        scene = isoroll.Scene(text)
        self.assertEqual(scene.sections, {
            "reduced": {"k": 0.5, "J": [1, 2, 5]}, "time": {"end": 1}, "output": {"columns": ["t", "n1"]},
            "initial": {"project": True, "normal": [0, 0, 1], "angular_velocity": [1, 0, 0.5]}})
        self.assertTrue(np.signbit(scene.sections["initial"]["normal"][0]))
        self.assertEqual(isoroll.Scene(scene, end=1), scene)
        self.assertEqual(isoroll.Scene("\ufeff" + text), scene)


class Values(Case):
    def test_equal_if_they_say_the_same(self):
        one, other = isoroll.Scene(**WHOLE), isoroll.Scene("time: {end: 1.0e2}\n# a comment\n"
                                                           "initial: {angular_velocity: [.9, -0.30, -0.225], "
                                                           "normal: [0.36, 0.48, 0.8]}\n"
                                                           "reduced: {J: [1, 2.0, 5], k: 0.5}\n")
        self.assertEqual(one, other)
        self.assertEqual(hash(one), hash(other))
        self.assertEqual(len({one, other, isoroll.Scene(one, end=100.0)}), 1)
        for odd in (dict(columns="t, n1"), dict(columns=["t", "n1\n"]), dict(method=" taylor"), dict(backend="'ball'"),
                    dict(as_="both\n")):  # what YAML takes
            scene = isoroll.Scene(one, **odd)
            self.assertEqual(isoroll.Scene(scene.text), scene)
            self.assertEqual(isoroll.Scene(scene.text).columns, scene.columns)
        for change in (dict(end=99), dict(k=0.5000000001), dict(attitude=True), dict(as_="both")):
            self.assertNotEqual(isoroll.Scene(one, **change), one)
        self.assertEqual(isoroll.Scene(one, as_="both", end=5), isoroll.Scene(one, end=5, as_="both"))
        self.assertNotEqual(one, 3)

    def test_come_back_from_their_words(self):
        for path in scenes():
            scene = isoroll.Scene(path, tolerance=1e-11)
            for again in (eval(repr(scene), {"isoroll": isoroll}), pickle.loads(pickle.dumps(scene)),
                          copy.copy(scene), copy.deepcopy(scene), isoroll.Scene(scene.sections)):
                self.assertEqual(again, scene)
                self.assertEqual((again.columns, again.tolerance), (scene.columns, 1e-11))
        self.assertLess(len(repr(isoroll.Scene(**WHOLE))), 120)


if __name__ == "__main__":
    unittest.main()

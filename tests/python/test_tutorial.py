"""The tutorial of examples/22_tutorial: it runs, and what its words say is so."""

import contextlib
import io
import os
import re
import runpy
import types
import unittest
from unittest import mock

import numpy as np
from shared import FULL, Case, example

import isoroll

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
except ImportError:
    matplotlib = None

TUTORIAL = example("22_tutorial", "tutorial.py")


def energy_is(t):
    return abs(t.energy[0] - 0.6216) < 5e-5 and np.ptp(t.energy) < 1e-14 * t.energy[0]


def rows_of_our_own(t):
    exact = isoroll.orbit(t.scene).at(t.mine.t)
    return t.h == 0.02 and t.mine.t[-1] == 20 and max(np.ptp(exact.array - t.mine.array, axis=0)) < 1e-6


def neighbours_part(t):
    return len(t.start) == 100 and t.times[-1] == 200 and t.growth[0.5][-1] > 1e6


def neighbours_stay(t):
    return np.max(t.growth[1.0]) < 100


def half_of_it(t):
    return t.chaos.verdict[0] == "chaotic" and t.share.low < 0.55 < t.share.high and 0.35 < t.share.share < 0.65


def at_the_plane(t):
    return t.sweep.chaos_share[t.sweep.k == 1].tolist() == [0]


def periods(t):
    stable = t.periodic.stability == "stable"
    inside = np.abs(t.periodic.trace) < 2
    return len(t.periodic) == 8 and max(t.periodic.period) == 2 and stable.sum() == 3 and (stable == inside).all()


def closes(t):
    apart = np.max(np.abs(t.ends.array[1, 1:] - t.ends.array[0, 1:]))
    return abs(t.periodic.t[0] - 11.84) < 5e-3 and t.periodic.period[0] == 1 and apart < 1e-12


def slope_of_half(t):
    return abs(t.splitting.m[t.splitting.k == 0.5][0] - 0.1419) < 5e-5


def slopes_over_k(t):
    k, m = t.splitting.k, t.splitting.m
    zero, beyond = k == 1, m[k > 1]
    falls = np.all(np.diff(m[k <= 1]) < 0)
    return falls and abs(m[zero][0]) < t.splitting.error[zero][0] and np.all((beyond < 0) & (beyond > -1e-3))


#: every number of the prose, in its words, and whether it is so
CLAIMS = {
    "k = 1/2 is a ball on the outside of a sphere of its own size": lambda t: isoroll.Scene(
        mass=1, radius=1, inertia=(1, 1, 1), surface={"kind": "outside", "radius": 1}, normal=(0, 0, 1),
        angular_velocity=(1, 0, 0)).k == t.scene.k == 0.5,
    "k = 1 is a plane": lambda t: isoroll.Scene(t.scene, mass=1, radius=1, inertia=(1, 1, 1),
                                                surface="plane").k == t.plane.k == 1,
    "the shape (rows, 3)": lambda t: t.orbit.omega.shape == t.orbit.gamma.shape == (len(t.orbit), 3),
    "It is 0.6216, and all rows agree to 14 digits": energy_is,
    "step of 0.02 the rows are right to 6 digits until t = 20": rows_of_our_own,
    "Both give back each bit": lambda t: np.array_equal(t.again.array, t.as_point.array),
    "100 neighbours: their angular velocities are turned about n by at most 1e-8": lambda t: np.max(t.angle) == 1e-8,
    "With k = 1/2 their distances grow by more than a million times until t = 200": neighbours_part,
    "their distances grow by less than 100": neighbours_stay,
    "Orbit 0 is the scene's own; it is chaotic. So is about half of the section; the 95 % interval": half_of_it,
    "At k = 1 nothing is chaotic": at_the_plane,
    "is between -2 and 2. Of period 1 and 2 there are 8, and 3 of them are stable": periods,
    "The first one closes after t = 11.84, to 12 digits": closes,
    "m is 0.1419 at k = 1/2": slope_of_half,
    "is 0 at k = 1: there it is smaller than its error. Beyond, m is negative, and |m| is below 1e-3": slopes_over_k,
    "Two columns of a journal are 178 mm wide": lambda t: abs(t.figure.get_size_inches()[0] * 25.4 - 178) < 1e-9,
}


def prose():
    """The words of the cells of text, on one line."""
    with open(TUTORIAL, encoding="utf-8") as file:
        cells = re.split(r"^# %%", file.read(), flags=re.M)
    text = "\n".join(cell for cell in cells if cell.startswith(" [markdown]"))
    return " ".join(re.sub(r"^# ?", "", text, flags=re.M).split())


@unittest.skipUnless(matplotlib, "python3-matplotlib is not installed")
class Tutorial(Case):
    def run_it(self):
        self.addCleanup(os.chdir, os.getcwd())
        self.addCleanup(pyplot.close, "all")
        self.addCleanup(pyplot.rcParams.update, pyplot.rcParams.copy())
        os.chdir(self.folder)
        out = io.StringIO()
        with mock.patch.dict(os.environ, {} if FULL else {"TUTORIAL_QUICK": "1"}), contextlib.redirect_stdout(out):
            names = runpy.run_path(TUTORIAL)
        return types.SimpleNamespace(**names), out.getvalue()

    def test_what_it_says(self):
        names, out = self.run_it()
        for words, so in CLAIMS.items():
            with self.subTest(words):
                self.assertTrue(so(names))
        self.assertGreater(len(out.split("\n")), 60)
        with open("figure.pdf", "rb") as file:
            page = file.read()
        width = float(re.search(rb"/MediaBox \[ 0 0 ([0-9.]+)", page).group(1))
        self.assertAlmostEqual(width / 72 * 25.4, 178, 2)
        if not FULL:  # of the many spots of the full figure there is an image
            self.assertNotIn(b"/Subtype /Image", page)  # all of it is vectors
        self.assertGreater(os.path.getsize("figure.png"), 20000)
        isoroll.read("share.h5").plot()

    def test_all_its_numbers_are_checked(self):
        text = prose()
        for words in CLAIMS:
            self.assertIn(words, text)
            text = text.replace(words, "")
        text = re.sub(r"`[^`]*`|passes n3 = 0|If m is not 0", "", text)
        self.assertEqual(re.findall(r"\S*[0-9]\S*", text), [])


if __name__ == "__main__":
    unittest.main()

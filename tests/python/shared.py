"""What the tests of the Python package share: scenes, the command, rows of files."""

import os
import signal
import subprocess
import tempfile
import threading
import unittest
import warnings

import numpy as np

import isoroll

ISOROLL = os.environ["ISO_COMMAND"]  # the command, to compare with
SOURCE = os.environ["ISO_SOURCE"]
FULL = os.environ.get("ISO_TEST_LENGTH") == "full"


def example(name, file="scene.yaml"):
    return os.path.join(SOURCE, "examples", name, file)


#: a free ball, k = 1/2, J = 1, 2, 5
WILD = example("16_sections")
BALL = example("15_two_spheres")


class Case(unittest.TestCase):
    """A test with a folder of its own. Warnings of isoroll are errors unless a test catches them."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        catch = warnings.catch_warnings()
        catch.__enter__()
        self.addCleanup(catch.__exit__, None, None, None)
        warnings.simplefilter("error", isoroll.IsorollWarning)

    def path(self, name):
        return os.path.join(self.folder, name)

    def command(self, *arguments, status=0):
        done = subprocess.run([ISOROLL, *arguments], capture_output=True, text=True, cwd=self.folder, check=False)
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stdout

    def same(self, a, b):
        """To the bit."""
        np.testing.assert_array_equal(np.asarray(a).view(np.uint64), np.asarray(b).view(np.uint64))

    def same_files(self, a, b):
        with open(a, "rb") as first, open(b, "rb") as second:
            self.assertEqual(first.read(), second.read())

    def near(self, a, b, bound):
        self.assertLessEqual(np.max(np.abs(np.asarray(a) - np.asarray(b))), bound)

    def refuses(self, kind, words, function, *arguments, about=None, **named):
        """The call raises this class, with these words; gives the exception."""
        with self.assertRaises(kind) as caught:
            function(*arguments, **named)
        error = caught.exception
        self.assertIn(words, str(error))
        self.assertEqual(error.status, kind.status)
        if about is not None:
            self.assertEqual(error.about, about)
        return error

    def press(self, call, rows=None):
        """What the call had found when Ctrl-C ended it; later and later, until it has more than so many rows."""
        delay = 0.2
        while True:
            timer = threading.Timer(delay, os.kill, (os.getpid(), signal.SIGINT))
            with self.assertRaises(KeyboardInterrupt) as caught:
                timer.start()
                call()
            timer.join()
            self.assertEqual(signal.getsignal(signal.SIGINT), signal.default_int_handler)
            found = getattr(caught.exception, "partial", None)
            if rows is None or (found is not None and len(found) > rows):
                return found
            delay *= 2


def starts(count):
    """States of a ball, shape (count, 6): |omega| = 1, n = (0, 0, 1)."""
    angle = 2 * np.pi * np.arange(count) / count
    zero = 0 * angle
    return np.stack([np.cos(angle), np.sin(angle), zero, zero, zero, zero + 1], axis=1)

"""What the package does to its process: errors, threads, memory, Ctrl-C, and which library it takes."""

import os
import signal
import subprocess
import sys
import threading
import unittest

import numpy as np
from shared import FULL, BALL, WILD, Case, example, starts

import isoroll

PAGE = os.sysconf("SC_PAGE_SIZE")


def resident():
    """Bytes of this process in memory."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * PAGE


class Errors(Case):
    def test_classes(self):
        names = {kind.status for kind in (isoroll.BadArgument, isoroll.BadInput, isoroll.NotMapped, isoroll.Stopped,
                                          isoroll.NumericalFailure, isoroll.FileTrouble, isoroll.NoMemory,
                                          isoroll.ClosedPipe)}
        with open(os.path.join(os.environ["ISO_SOURCE"], "lib/base/status.h"), encoding="utf-8") as file:
            known = {line.split("(")[1].split(",")[0] for line in file if line.strip().startswith("X(ISO_")}
        self.assertEqual(names | {"ISO_OK"}, known)
        self.assertIsInstance(isoroll.BadInput("x"), (isoroll.IsorollError, ValueError))

    def test_words_of_scenes(self):
        self.refuses(isoroll.FileTrouble, "absent.yaml", isoroll.run, "absent.yaml")
        with open(self.path("scene.yaml"), "w", encoding="utf-8") as file:
            file.write("reduced: {k: 1, J: [1, 2, 5]}\ninitial: {normal: [0, 0, 2], angular_velocity: [1, 0, 0]}\n"
                       "time: {end: 1}\n")
        self.refuses(isoroll.BadInput, "scene.yaml:2:19: normal has length 2", isoroll.run, self.path("scene.yaml"))
        self.refuses(isoroll.BadInput, "<text>:1:1: unknown key 'a'", isoroll.run, "a: 1\n")
        self.refuses(isoroll.BadInput, "<dict>:1:", isoroll.run, {"reduced": {"k": float("nan"), "J": [1, 2, 5]}})
        self.refuses(isoroll.BadArgument, "not object", isoroll.run, {"reduced": {"k": object()}})
        around = {}
        around["a"] = around
        for bad in (around, {"reduced": {"k": "\ud800"}}, "a: \ud800\n", {"k": 10**5000}):
            self.refuses(isoroll.BadArgument, "made into the text", isoroll.Scene, bad)
        masked = {"reduced": {"k": 1, "J": np.ma.masked_equal([1, 2, 5], 5)}}
        self.refuses(isoroll.BadArgument, "not MaskedArray", isoroll.Scene, masked)
        scene = example("11_rubber_and_marble")
        for call in (isoroll.run, isoroll.orbit):  # with the place of `twist` in the file
            self.refuses(isoroll.NotMapped, f"{scene}:14:10: 'twist' breaks", call, scene, as_="point")
        self.refuses(isoroll.BadArgument, "zero byte", isoroll.run, BALL + "\0x")
        self.refuses(isoroll.BadArgument, "zero byte", isoroll.run, BALL, method="taylor\0x")
        with self.assertRaises(TypeError):
            isoroll.run(3)
        with self.assertRaises(TypeError):
            isoroll.run(BALL, toll=3)

    def test_words_of_arguments(self):
        for key, value in (("backend", "x"), ("end", np.inf), ("as_", "x"), ("columns", ["t", "x"])):
            self.refuses(isoroll.BadArgument, "", isoroll.run, BALL, about=key.rstrip("_"), **{key: value})
        self.refuses(isoroll.BadArgument, "1e8 rows", isoroll.run, BALL, end=1e12)
        self.refuses(isoroll.BadArgument, "there are no times", isoroll.run, BALL, [])
        orbit = isoroll.orbit(BALL)
        for bad in (1j, np.datetime64("2020"), "5", None, 10**400, np.ma.masked_equal([1.0, 2.0], 2), [1, [2]]):
            self.refuses(isoroll.BadArgument, "times", orbit.at, bad)
            self.refuses(isoroll.BadArgument, "", isoroll.batch, WILD, [1.0], start=[[1, 0, 0, 0, 0, bad]])
        self.refuses(isoroll.BadArgument, "end is", isoroll.run, BALL, end=10**400)
        for event in ((), ("omega1",), "n1", (1, 1)):
            self.refuses(isoroll.BadArgument, "event", isoroll.section, WILD, event=event)
        for kind in (isoroll.Scene, isoroll.Orbit):
            self.refuses(isoroll.BadArgument, "never made", lambda: kind.__new__(kind).pointer)
        self.refuses(isoroll.BadArgument, "never made", lambda: isoroll.Scene.__new__(isoroll.Scene).k)
        self.refuses(isoroll.BadInput, "\U0001f600", isoroll.run, {"\U0001f600": 1})
        for call in (isoroll.write, isoroll.convert):
            with self.assertRaisesRegex(TypeError, "a Table is needed"):
                call(np.zeros((2, 7)), "point")


class Threads(Case):
    def test_same_numbers(self):
        wanted = isoroll.run(WILD, end=50).array
        table = isoroll.orbit(WILD)
        times = np.linspace(0, 50, 7)
        shared = table.at(times).array
        wrong = []

        studied = isoroll.periodic(WILD, period=1).array

        def work():
            if not np.array_equal(isoroll.periodic(WILD, period=1, threads=1).array, studied):
                wrong.append("periodic")
            for i in range(20):
                if not np.array_equal(isoroll.run(WILD, end=50).array, wanted):
                    wrong.append("run")
                if not np.array_equal(table.at(times[i % 7]).array, shared[i % 7]):
                    wrong.append("at")
                try:
                    isoroll.run(WILD, method=f"absent{threading.get_ident()}")
                except isoroll.BadArgument as error:
                    if str(threading.get_ident()) not in str(error):
                        wrong.append("words")

        threads = [threading.Thread(target=work) for _ in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_python_goes_on_meanwhile(self):
        """While another thread is in a call of the library: that waits for rows, which this thread writes."""
        path, table = self.path("pipe"), self.path("table.csv")
        isoroll.write(isoroll.run(BALL), table)
        code = (f"import isoroll, os, threading\nos.mkfifo({path!r})\nfound = []\n"
                f"thread = threading.Thread(target=lambda: found.append(isoroll.read({path!r})))\nthread.start()\n"
                f"with open({table!r}, 'rb') as rows, open({path!r}, 'wb') as pipe:\n"
                "    for row in rows:\n        pipe.write(row)\n        pipe.flush()\n"
                f"thread.join()\nprint(len(found[0]))")
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=300)
        self.assertEqual((done.stdout.strip(), done.stderr), (str(len(isoroll.run(BALL))), ""))


class Memory(Case):
    def grows(self, work, count):
        """Bytes that `count` calls leave behind."""
        for i in range(count // 10):
            work(i)
        before = resident()
        for i in range(count):
            work(i)
        return resident() - before

    def test_nothing_is_left(self):
        orbit, first = isoroll.orbit(BALL, as_="both"), starts(4)
        small = isoroll.run(BALL, end=1)

        def fails(i):
            try:
                isoroll.run(BALL, columns=["t", f"x{i}"])
            except isoroll.BadArgument:
                pass

        def in_a_thread(i):
            thread = threading.Thread(target=isoroll.run, args=(BALL, [float(i)]))
            thread.start()
            thread.join()

        for name, count, work in (("run", 10000, lambda i: isoroll.run(BALL, end=1).n),
                                  ("at", 10000, lambda i: orbit.at([0.1, 0.2])),
                                  ("orbit", 2000, lambda i: isoroll.orbit(BALL).at(0.1)),
                                  ("convert", 2000, lambda i: isoroll.convert(small, "point")),
                                  ("batch", 2000, lambda i: isoroll.batch(BALL, [0.1], start=first, threads=1)),
                                  ("section", 300, lambda i: isoroll.section(BALL, crossings=2, starts=1, threads=1)),
                                  ("chaos", 300, lambda i: isoroll.chaos(BALL, turns=2, starts=1, threads=1)),
                                  ("failure", 10000, fails), ("thread", 300, in_a_thread)):
            with self.subTest(name):
                self.assertLess(self.grows(work, count if FULL else count // 4), 2 << 20 if FULL else 1 << 20)

    def test_nothing_is_left_by_an_exception_after_the_call(self):
        table = isoroll.run(BALL, np.linspace(0, 1, 2000))
        path, words = self.path("a.csv"), ",".join(table.columns)
        isoroll.write(table, path)
        with open(path, encoding="utf-8") as file:
            text = file.read().replace("# isoroll trajectory 1\n", "").replace(words, words.replace("n3", "weight"))
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        other = isoroll.trajectory({"t": table.t, "omega": table.omega, "n": table.n}, k=-1, J=[1, 2, 5.1])

        def warned(call, *arguments):
            with self.assertRaises(isoroll.IsorollWarning):
                call(*arguments)

        for name, work in (("read", lambda i: warned(isoroll.read, path)),
                           ("convert", lambda i: warned(isoroll.convert, other, "point"))):
            with self.subTest(name):  # each time 100 kB would stay
                self.assertLess(self.grows(work, 200), 4 << 20)


class CtrlC(Case):
    LONG = {"end": 1e8, "step": 1e6, "backend": "ball"}

    def setUp(self):
        super().setUp()
        if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
            self.skipTest("SIGINT is ignored here")

    def test_ends_a_call(self):
        orbit = isoroll.orbit(BALL, backend="ball")
        for call in (lambda: isoroll.run(BALL, **self.LONG), lambda: orbit.at(1e8),
                     lambda: isoroll.batch(WILD, [1e7], start=starts(100)),
                     lambda: isoroll.section(WILD, crossings=10000000)):
            self.press(call)
        self.same(isoroll.run(BALL).array, isoroll.run(BALL).array)
        self.same(orbit.at(1.0).array, isoroll.run(BALL, [1.0], backend="ball").array[0])

    def test_what_was_found_is_kept(self):
        found = self.press(lambda: isoroll.run(BALL, end=1e7, step=0.5, backend="ball"), rows=10)
        self.same(found.array, isoroll.run(BALL, found.t, backend="ball").array)
        found = self.press(lambda: isoroll.section(WILD, crossings=10000000), rows=0)
        self.assertEqual(found.columns[:2], ("orbit", "crossing"))
        found = self.press(lambda: isoroll.batch(WILD, [1e7], start=starts(100)), rows=0)
        self.assertEqual(found.array.shape, (100, 1, 7))

    def test_nothing_is_left(self):
        before, size = None, 0
        for _ in range(16):  # what malloc keeps does not grow with the calls
            found = self.press(lambda: isoroll.run(BALL, end=1e7, step=0.2, backend="ball"), rows=50000)
            if before is None:
                before = resident()
                continue
            size += found.array.nbytes
        del found
        self.assertLess(resident() - before, size // 2)

    def test_exceptions_of_other_handlers(self):
        def handler(number, frame):
            raise TimeoutError("too long")

        old = signal.signal(signal.SIGALRM, handler)
        try:
            for call in (lambda: isoroll.run(BALL, **self.LONG), lambda: isoroll.run(WILD, end=2e5, step=1e4)):
                delay, found = 0.15, None
                while found is None:  # None: it came before the call had begun
                    with self.assertRaisesRegex(TimeoutError, "too long") as caught:
                        signal.setitimer(signal.ITIMER_REAL, delay)
                        call()
                    delay, found = 2 * delay, getattr(caught.exception, "partial", None)
                self.assertLess(len(found), 100)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, old)
        self.assertIs(sys.unraisablehook, sys.__unraisablehook__)

    def test_a_handler_of_ones_own(self):
        seen = []
        old = signal.signal(signal.SIGINT, lambda number, frame: seen.append(number))
        try:
            timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
            timer.start()
            self.refuses(isoroll.Stopped, "stopped on request", isoroll.run, BALL, **self.LONG)
        finally:
            signal.signal(signal.SIGINT, old)
        self.assertEqual(seen, [signal.SIGINT])


class Library(Case):
    def python(self, library, code="import isoroll"):
        """What an own Python says; it takes this library."""
        return subprocess.run([sys.executable, "-c", code], env={**os.environ, "ISOROLL_LIBRARY": library},
                              capture_output=True, text=True, check=False)

    def test_python_ends_during_a_call(self):
        code = (f"import isoroll, threading, time\ndef work():\n    isoroll.run({BALL!r}, end=1e6, step=0.1)\n"
                "threading.Thread(target=work, daemon=True).start()\ntime.sleep(0.5)")
        done = self.python(os.environ["ISOROLL_LIBRARY"], code)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_version(self):
        with open(os.path.join(os.environ["ISO_SOURCE"], "lib/base/version.h"), encoding="utf-8") as file:
            words = [line.split() for line in file if line.startswith("#define ISO_VERSION_")]
        numbers = ".".join(word[2] for word in words[:3])
        self.assertEqual((isoroll.__version__, isoroll.library_version), (numbers, numbers))

    def test_not_found(self):
        said = self.python("/absent/libisoroll.so.0").stderr
        for words in ("LibraryError", "/absent/libisoroll.so.0", "ISOROLL_LIBRARY"):
            self.assertIn(words, said)

    def test_default_names(self):
        environment = {key: value for key, value in os.environ.items() if key != "ISOROLL_LIBRARY"}
        code = ("import ctypes\ndef load(name):\n    raise OSError(name + ' is not there')\nctypes.CDLL = load\n"
                "import isoroll")
        said = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True,
                              check=False).stderr
        for words in ("LibraryError", "Install isoroll", "ldconfig", "libisoroll.so.0 is not there"):
            self.assertIn(words, said)

    def test_other_libraries(self):
        self.assertIn("is not the library of isoroll", self.python("libm.so.6").stderr)
        compiler = os.environ.get("CC", "cc")
        for code, words in (('const char *iso_version(void) { return "9.9.9"; }', "is isoroll 9.9.9"),
                            (f'const char *iso_version(void) {{ return "{isoroll.__version__}"; }}',
                             "has no function iso_interface")):
            with open(self.path("other.c"), "w", encoding="utf-8") as file:
                file.write(code)
            try:
                subprocess.run([compiler, "-shared", "-fPIC", self.path("other.c"), "-o", self.path("other.so")],
                               check=True)
            except OSError:
                self.skipTest("there is no C compiler")
            self.assertIn(words, self.python(self.path("other.so")).stderr)


if __name__ == "__main__":
    unittest.main()

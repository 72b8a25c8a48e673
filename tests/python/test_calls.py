"""The functions for the command's instruments: the same names, options, numbers, words; progress, interrupts."""

import inspect
import json
import os
import pickle
import re
import signal
import threading
import unittest
from fractions import Fraction

import numpy as np
from shared import BALL, SOURCE, WILD, Case, example

import isoroll
from isoroll import _instruments

#: options that are no keywords, and what stands in their place
EVERYWHERE = {"output": "table.write", "plot": "table.plot", "csv": "table.write", "json": "the table itself",
              "quiet": "warnings", "help": "help()",
              **dict.fromkeys(("style", "size", "title", "script", "template", "window", "over"),
                              "of gnuplot's pictures: table.picture")}
ELSEWHERE = {
    "run": {"verbose": "errors=True",
            **dict.fromkeys(("certify", "digits", "work-digits"), "for the command: enclosures, which are no doubles")},
    "convert": {"digits": "table.write(digits=)", "max-defect": "a warning", "strict": "a warning"},
    "sweep": {"merge": "for the command: files", "point": "for the command: prints a scene"},
    "plot": {"k": "the table says it", "J": "the table says it", "eps": "the table says it", "h": "the table says it",
             "scene": "the table says it", "row-tolerance": "nothing is computed"},
}
#: keywords that are no options: what is studied, and how Python is told of progress; of each function
OWN = {"scene", "table", "source", "progress", "columns"}
OWN_OF = {"run": {"times", "errors", "changes"}, "plot": {"ax", "title", "output", "window", "over"}, "view": {"output"},
          "list": {"topic"}, "chaos": {"at"}, "sweep": {"output"}}  # which the library has, and the command not
NO_CALL = {"manual": "documents of the command"}


class Lists(Case):
    def options(self, command):
        text = self.command(command, "--help")
        return re.findall(r"^  --([a-zA-Z][a-zA-Z-]*)", text, re.M)

    def commands(self):
        found = re.findall(r"^  ([a-z]+) {2,}", self.command("--help"), re.M)
        self.assertGreaterEqual(len(found), 17)
        return found

    def test_each_command_is_a_function(self):
        for command in self.commands():
            if command not in NO_CALL:
                self.assertTrue(callable(getattr(isoroll, _instruments.python_name(command), None) or
                                         getattr(isoroll, command + "_")), command)

    def test_each_option_is_a_keyword_and_each_keyword_an_option(self):
        for command in self.commands():
            if command in NO_CALL:
                continue
            function = getattr(isoroll, command, None) or getattr(isoroll, command + "_")
            elsewhere = {**EVERYWHERE, **ELSEWHERE.get(command, {})}
            options = {_instruments.python_name(o) for o in self.options(command) if o not in elsewhere}
            keywords = set(inspect.signature(function).parameters)
            with self.subTest(command):
                self.assertEqual(options - keywords, set(), "options without a keyword")
                self.assertEqual(keywords - options - OWN - OWN_OF.get(command, set()), set(), "no option")

    def test_messages_name_keywords(self):
        error = self.refuses(isoroll.BadArgument, "axis '7': expected", isoroll.section, WILD, axis=7)
        self.assertNotIn("--", str(error))
        error = self.refuses(isoroll.BadArgument, "chart or follow, not both", isoroll.periodic, WILD, chart="J2",
                             follow="k=0.4:0.6")
        self.assertNotIn("--", str(error))
        with self.assertRaises(isoroll.BadInput) as caught:
            isoroll.Scene(k=0.5, J=[1, 2, -5], normal=[0, 0, 1], angular_velocity=[1, 0, 0], end=1)
        self.assertTrue(str(caught.exception).startswith("J3 = -5"), str(caught.exception))

    def test_endings(self):
        table = isoroll.run(BALL, t_end=1)
        for name in ("a.xyz", "a.csv.gz", "a.CSV"):
            self.refuses(isoroll.BadArgument, "is written as .csv or .h5", table.write, self.path(name))
            self.assertFalse(os.path.exists(self.path(name)))
        for name in ("a.csv", "a"):
            table.write(self.path(name))
            self.assertEqual(len(isoroll.read(self.path(name))), len(table))
    def test_a_sweep_is_explained(self):
        """In the words of the command: a path, a text and a dict. Times differ from call to call."""
        path, text = self.path("sweep.yaml"), f"scene: {WILD}\nvary: {{k: [0.5]}}\nmeasure: {{rotations: {{}}}}\n"
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        wanted = self.command("explain", "sweep.yaml")
        self.assertIn("rotations", wanted)
        for source in (path, text, {"scene": WILD, "vary": {"k": [0.5]}, "measure": {"rotations": {}}}):
            told = isoroll.explain(source)
            self.assertIsInstance(told, isoroll.Result)
            without = [re.sub(r"(about )?[0-9.]+ (ms|s|minutes)\b", "TIME", str(x)) for x in (told, wanted)]
            self.assertEqual(*without)
        self.refuses(isoroll.BadArgument, "method is for scenes", isoroll.explain, path, method="taylor")
        self.refuses(isoroll.BadInput, "<text>:2:", isoroll.explain, text.replace("[0.5]", "[x]"))

    def test_all_is_documented(self):
        for name in isoroll.__all__:
            thing = getattr(isoroll, name)
            if callable(thing):
                self.assertGreater(len(inspect.getdoc(thing) or ""), 10, name)
        for name, function in _instruments.INSTRUMENTS.items():
            self.assertIs(pickle.loads(pickle.dumps(function)), function)
            self.assertIn(f"`isoroll {name}`", function.__doc__)
            for parameter in inspect.signature(function).parameters:
                self.assertRegex(function.__doc__, rf"(?m)^{parameter} ")
                self.assertNotIn("--", function.__doc__.replace("--json", ""))

    def test_columns_are_documented(self):
        for table in (isoroll.run(BALL, as_="both"), isoroll.section(WILD, crossings=2, as_="both"),
                      isoroll.chaos(WILD, turns=5, starts=1), isoroll.periodic(WILD, period=1),
                      isoroll.chaos(WILD, turns=5).indicators["point"], isoroll.splitting(WILD),
                      isoroll.run(example("10_bowl"), t_end=0.1), isoroll.check(isoroll.run(BALL)),
                      isoroll.compare(WILD, t_end=1)):
            for column in table.columns:
                self.assertTrue(table.doc[column], (table.kind, column))
                self.assertIn(column, table.units)
        self.assertEqual(isoroll.run(BALL).units["omega1"], "1/time")
        swept = isoroll.sweep({"scene": isoroll.Scene(WILD), "vary": {"k": [0.5]}, "until": {"turns": 2},
                               "measure": {"state": {}, "chaos": {}, "frequencies": {}, "splitting": {}}})
        self.assertEqual([column for column in swept.columns if not swept.doc[column]], ["k"])  # what varies
        swept_by_time = isoroll.sweep({"scene": isoroll.Scene(WILD), "vary": {"k": [0.5]}, "until": {"time": 2},
                                       "measure": {"backends": {}, "error": {}}})
        self.assertEqual([column for column in swept_by_time.columns if not swept_by_time.doc[column]], ["k"])
        self.assertEqual((swept.units["frequencies_f1_t"], swept.units["state_l"]), ("rad/time", "rad"))


def rows_of(path):
    """Lines of a file without the lines of #."""
    with open(path, encoding="utf-8") as file:
        return [line for line in file if not line.startswith("#")]


class Numbers(Case):
    """Each call gives what the command writes or prints."""

    def test_tables(self):
        for name, file, arguments, named, kind in (
                ("chaos", "--csv", ["--starts", "4", "--turns", "60"], {"starts": 4, "turns": 60}, isoroll.Chaos),
                ("periodic", "-o", ["--period", "2", "--all", "--grid", "200"],
                 {"period": 2, "all": True, "grid": 200}, isoroll.Periodic),
                ("periodic", "-o", ["--period", "1", "--follow", "k=0.49:0.51"],
                 {"period": 1, "follow": {"k": (0.49, 0.51)}}, isoroll.Branch),
                ("periodic", "-o", ["--chart", "J2", "--steps", "6"], {"chart": "J2", "steps": 6}, isoroll.Chart),
                ("splitting", "-o", ["--k", "0.5,0.75"], {"k": [0.5, 0.75]}, isoroll.Splitting)):
            with self.subTest(name, **named):
                self.command(name, WILD, *arguments, file, "command.csv")
                table = getattr(isoroll, name)(WILD, **named)
                self.assertIs(type(table), kind)
                table.write(self.path("python.csv"))
                self.assertEqual(rows_of(self.path("command.csv")), rows_of(self.path("python.csv")))
                read = isoroll.read(self.path("command.csv"))
                self.assertIs(type(read), kind)
                self.assertEqual(read.lines["command"], table.lines["command"])
                for key, text in read.lines.text.items():  # Python's lines say more, and no title
                    if key in table.lines:
                        self.assertEqual(table.lines.text[key], text, key)

    def test_cost(self):
        table = isoroll.cost(WILD, quick=True, method="taylor", backend="ball", t_end=1)
        self.command("cost", WILD, "--quick", "--method", "taylor", "--backend", "ball", "--t-end", "1", "--csv",
                     "c.csv")
        read = isoroll.read(self.path("c.csv"))
        self.assertEqual(read.columns, table.columns)
        for column in ("backend", "method", "tolerance", "error", "rhs"):  # times are never the same
            self.assertEqual(read[column].tolist(), table[column].tolist())

    def test_numbers_of_json(self):
        def compare(wanted, got, path=""):
            self.assertIsInstance(got, type(wanted) if isinstance(wanted, (dict, list)) else object, path)
            named = wanted if isinstance(wanted, dict) else dict(enumerate(wanted)) if isinstance(wanted, list) else {}
            for key, value in named.items():
                if value is None or key in ("isoroll", "seconds"):
                    continue
                if isinstance(wanted, dict) and key not in got:
                    self.assertIn(key, ("J", "k"), path)
                    continue
                compare(value, got[key], f"{path}.{key}")
            if isinstance(wanted, (int, float)):
                self.assertEqual(float(wanted), float(got), path)
            elif isinstance(wanted, str):
                self.assertEqual(wanted, got if isinstance(got, str) else f"{got:g}", path)

        for name, scene, arguments, named in (("frequencies", BALL, [], {}),
                                              ("frequencies", WILD, ["--turns", "40"], {"turns": 40}),
                                              ("integrals", BALL, ["--orbits", "16"], {"orbits": 16})):
            with self.subTest(name, scene=scene):
                wanted = json.loads(self.command(name, scene, *arguments, "--json"))
                got = getattr(isoroll, name)(scene, **named)
                self.assertIsInstance(got, isoroll.Result)
                known = {key: value for key, value in wanted.items() if isinstance(value, (dict, str, float, int))}
                compare({key: value for key, value in known.items() if key not in ("k", "J")}, got.tree)

    def test_compare(self):
        table = isoroll.compare(BALL, t_end=3)
        wanted = json.loads(self.command("compare", BALL, "--t-end", "3", "--json"))
        self.assertIsInstance(table, isoroll.Comparison)
        self.near(table.ball.n, isoroll.run(BALL, t_end=3, backend="ball").n, 1e-13)
        self.assertIsNotNone(table.exact)
        self.assertLess(np.max(table.array[:, 1:]), 1e-9)
        self.assertEqual(wanted["k"], table.k)

    def test_check(self):
        table = isoroll.run(BALL)
        table.write(self.path("a.csv"))
        wanted = json.loads(self.command("check", "a.csv", "--json"))
        for source in (table, self.path("a.csv")):
            found = isoroll.check(source)
            self.assertLess(found.worst.max(), 1e-11)
            text = json.dumps(wanted)
            for name, worst in zip(found.name, found.worst):
                self.assertIn(json.dumps(str(name)), text)
                self.assertIn(repr(float(worst)).rstrip("0").rstrip("."), text)
        bare = isoroll.trajectory({"t": table.t[:5], "omega": table.omega[:5], "n": table.n[:5]})
        self.refuses(isoroll.BadInput, "k", isoroll.check, bare)
        self.assertLess(isoroll.check(bare, k=-1, J=(1, 2, 5)).worst.max(), 1e-11)
        self.assertLess(isoroll.check(bare, scene=BALL).worst.max(), 1e-11)
        self.assertNotIn("k", bare.lines)

    def test_convert_what_says_little(self):
        table = isoroll.run(BALL)
        bare = isoroll.trajectory({"t": table.t, "omega": table.omega, "n": table.n})
        wanted = isoroll.convert(table, "point")
        self.same(isoroll.convert(bare, "point", k=-1, J=(1, 2, 5)).array, wanted.array)
        self.same(isoroll.convert(bare, "point", scene=BALL).array, wanted.array)
        np.savetxt(self.path("own.txt"), table.array)
        own = isoroll.convert(self.path("own.txt"), "point", columns=table.columns, scene=BALL)
        self.same(own.array, wanted.array)
        self.refuses(isoroll.BadInput, "does not say its k", isoroll.convert, bare, "point")

    def test_words(self):
        wanted = self.command("explain", BALL)
        self.assertEqual(re.sub("cost of.*", "", str(isoroll.explain(BALL))), re.sub("cost of.*", "", wanted))
        found = isoroll.analogue(neumann=(1, 2, 2.5), energy=2)
        self.assertEqual(found.text, self.command("analogue", "--neumann", "1,2,2.5", "--energy", "2"))
        self.assertEqual(isoroll.Scene(found.text).k, -1)
        for topic in ("clocks", "methods", "tables"):
            self.assertEqual(isoroll.list_(topic), self.command("list", topic))
        self.assertEqual(isoroll.list_(), self.command("list"))
        self.refuses(isoroll.BadArgument, "nothing is called 'method'; did you mean 'methods'?", isoroll.list_, "method")

    def test_sweep(self):
        scene = isoroll.Scene(WILD, end=20)
        plan = {"scene": scene, "vary": {"k": {"from": 0.5, "to": 0.7, "count": 5}}, "measure": {"state": {}},
                "until": {"time": 3}}
        parts = []
        table = isoroll.sweep(plan, progress=parts.append)
        self.assertEqual((parts[-1], sorted(parts)), (1, parts))
        self.assertEqual(list(table.k), [0.5, 0.55, 0.6, 0.65, 0.7])
        self.near(table["state_n1"][2], isoroll.run(scene, [3], k=0.6).n[0, 0], 1e-12)
        self.assertFalse(table.status.any())
        with open(self.path("sweep.yaml"), "w", encoding="utf-8") as file:
            file.write(table.text)
        for name in ("s.csv", "s.h5"):
            self.command("sweep", "sweep.yaml", "-o", "command_" + name)
            isoroll.sweep(self.path("sweep.yaml")).write(self.path("python_" + name))
            read, own = isoroll.read(self.path("command_" + name)), isoroll.read(self.path("python_" + name))
            self.assertIs(type(read), isoroll.Sweep)
            self.same(read.array[:, :9], own.array[:, :9])
            self.assertEqual(dict(read.lines.text), dict(own.lines.text))
            output = self.path("output_" + name)
            self.same(isoroll.sweep(self.path("sweep.yaml"), output=output).array[:, :9], read.array[:, :9])
            self.same_files(output, self.path("command_" + name))
            self.same(isoroll.sweep(self.path("sweep.yaml"), output=output, resume=True).array, read.array)
            self.command("plot", "python_" + name, "--value", "state_n1", "-o", "picture.svg")  # it is a whole result
        part = isoroll.sweep(self.path("sweep.yaml"), output=self.path("part.csv"), shard="1/2")
        self.assertTrue(0 < len(part) < 5)
        for said, wrong in (("need an output", {"resume": True}), ("is no regular file", {"output": "/dev/null"}),
                            ("the end of a line", {"output": "a.csv\nshard=1/2"}), ("expected i/n", {"output": "a", "shard": "2"}),
                            ("True or False", {"output": "a", "resume": "false"}), ("must be a text", {"output": 5})):
            self.refuses(isoroll.BadArgument, said, isoroll.sweep, self.path("sweep.yaml"), **wrong)
        self.assertEqual(rows_of(self.path("command_s.csv")), rows_of(self.path("python_s.csv")))
        self.refuses(isoroll.BadInput, "<dict>", isoroll.sweep, {"scene": scene})
        self.refuses(isoroll.FileTrouble, "absent.yaml", isoroll.sweep, "absent.yaml")

    def test_axes(self):
        plan = {"scene": isoroll.Scene(WILD, end=20), "measure": {"state": {}}, "until": {"time": 1},
                "vary": {"k": [0.7, 0.5], "J": {"triangle": 9, "ordered": True}, "l": [0.2, 0.1], "x": 0.3}}
        table = isoroll.sweep(plan)
        self.assertEqual([(name, each.shape) for name, each in table.axes.items()],
                         [("k", (2,)), ("J", (3, 3)), ("l", (2,)), ("x", (1,))])
        for vary, shape in (({"J": [[1, 2, 5], [1, 2, 4]]}, {"J": (2, 3)}), ({"k": [0.5, 0.5, 0.6], "J3": [4, 5]}, {}),
                            ({"J2": [2, "5/2"], "J3": [Fraction(9, 2), 5, 4]}, {"J2": (2,), "J3": (3,)})):
            found = isoroll.sweep({**plan, "vary": vary}).axes
            self.assertEqual({name: each.shape for name, each in found.items()}, shape)
        drawn = {"J2": {"from": 2, "to": 3}, "J3": {"from": 5, "to": 6}}
        self.assertEqual(isoroll.sweep({**plan, "vary": drawn, "samples": {"count": 3}}).axes, {})
        try:
            import xarray  # noqa: F401
        except ImportError:
            return self.assertRaisesRegex(ImportError, "to_xarray needs xarray", table.to_xarray)
        grid = table.to_xarray()
        for row, n1 in zip(table.array, table["state_n1"]):
            at = grid.sel(k=row[1], l=row[5], x=0.3)
            self.assertEqual(float(at.state_n1[np.flatnonzero(at.J3 == row[4])[0]]), n1)

    def test_fractions(self):
        scene, half = isoroll.Scene(WILD, end=20), Fraction(1, 2)
        self.assertEqual(isoroll.Scene(WILD, k=half).k, 0.5)
        self.assertEqual(isoroll.Scene(WILD, k="1/3", J=("1/2", half, 1)).k, 1 / 3)
        one = isoroll.splitting(scene, k=[0.5, 0.75], digits="double").m
        for k in ("1/2,3/4", [half, Fraction(3, 4)], ["1/2", 0.75]):
            self.same(isoroll.splitting(scene, k=k, digits="double").m, one)
        self.same(isoroll.run(scene, t_end=half).array, isoroll.run(scene, t_end=0.5).array)
        ball = isoroll.run(scene, [0, 1])
        self.same(isoroll.section(scene, at=[("1/2", half)], crossings=2).array,
                  isoroll.section(scene, at=[(0.5, 0.5)], crossings=2).array)
        self.refuses(isoroll.BadArgument, "a fraction such as 1/2", isoroll.run, scene, t_end="1/0")
        bare = isoroll.trajectory({"t": ball.t, "omega": ball.omega, "n": ball.n})
        self.same(isoroll.convert(bare, "point", k=half, J=scene.J).array,
                  isoroll.convert(ball, "point").array)

    def test_view(self):
        os.environ["ISOROLL_COMMAND"] = os.environ["ISO_COMMAND"]
        self.command("view", BALL, "-o", "command.html")
        isoroll.view(BALL, self.path("python.html"))
        self.same_files(self.path("command.html"), self.path("python.html"))
        page = isoroll.view(isoroll.run(BALL))
        self.assertIn("<script", page)
        self.assertIn("<iframe", page._repr_html_())
        self.refuses(isoroll.BadArgument, "live=True", isoroll.view)
        self.refuses(isoroll.FileTrouble, "absent.yaml", isoroll.view, "absent.yaml")
        os.environ["ISOROLL_COMMAND"] = "/absent/isoroll"
        self.refuses(isoroll.FileTrouble, "/absent/isoroll", isoroll.view, BALL)
        os.environ["ISOROLL_COMMAND"] = os.environ["ISO_COMMAND"]


    def test_view_live(self):
        os.environ["ISOROLL_COMMAND"] = os.environ["ISO_COMMAND"]
        try:
            isoroll.view(BALL, self.path("python.html"), live=True)
        except isoroll.BadArgument as error:
            return self.assertIn("WebAssembly", str(error))  # of a build with ISO_LIVE=OFF
        self.command("view", BALL, "--live", "-o", "command.html")
        self.same_files(self.path("command.html"), self.path("python.html"))
        self.assertIn('id="library"', isoroll.view(live=True))


class Refusals(Case):
    def test_name_what_there_is(self):
        for call, words in ((lambda: isoroll.chaos(WILD, turn=3), "keyword argument 'turn'.*exponent_turns"),
                            (lambda: isoroll.section(), "missing a required argument: 'scene'"),
                            (lambda: isoroll.sweep(3), "a path, a text or a dict")):
            with self.assertRaisesRegex(TypeError, words):
                call()
        self.refuses(isoroll.BadArgument, "period is '0'", isoroll.periodic, WILD, period=0)
        self.refuses(isoroll.BadArgument, "digits is 'many'", isoroll.splitting, WILD, digits="many")
        self.refuses(isoroll.BadArgument, "end of a line", isoroll.splitting, WILD, k="1\nlevel=2")
        self.refuses(isoroll.BadInput, "", isoroll.periodic, example("10_bowl"))
        self.refuses(isoroll.BadArgument, "", isoroll.analogue)


class Meanwhile(Case):
    def test_interrupts(self):
        if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
            self.skipTest("SIGINT is ignored here")
        plan = {"scene": isoroll.Scene(WILD, end=1e6), "vary": {"k": {"from": 0.5, "to": 0.7, "count": 2000}},
                "measure": {"state": {}}, "until": {"time": 5e3}}
        self.assertLess(len(self.press(lambda: isoroll.sweep(plan), rows=0)), 2000)
        self.assertIsInstance(self.press(lambda: isoroll.chaos(WILD, starts=100000, turns=300), rows=0), isoroll.Chaos)

    def test_progress_that_raises(self):
        def stop(part):
            raise ZeroDivisionError("enough")

        plan = {"scene": isoroll.Scene(WILD), "vary": {"k": {"from": 0.5, "to": 0.7, "count": 3000}},
                "measure": {"state": {}}, "until": {"time": 2000}}
        with self.assertRaisesRegex(ZeroDivisionError, "enough") as raised:
            isoroll.sweep(plan, progress=stop)
        self.assertLess(len(raised.exception.partial), 3000)  # it ends the call
        plan["until"] = {"time": 20}
        caught = []

        def work():
            try:
                isoroll.sweep(plan, progress=stop)
            except ZeroDivisionError as error:
                caught.append(error)

        thread = threading.Thread(target=work)
        thread.start()
        thread.join()
        self.assertEqual(len(caught), 1)

if __name__ == "__main__":
    unittest.main()

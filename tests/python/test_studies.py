"""Sections and chaos: rows, verdicts and shares are those of the command."""

import json
import pickle
import unittest

import numpy as np
from shared import BALL, WILD, Case, example

import isoroll


class Sections(Case):
    def test_files_of_the_command(self):
        for options, named in (([], {}), (["--starts", "4", "--seed", "7"], {"starts": 4, "seed": 7}),
                               (["--axis", "2", "--model", "ball"], {"axis": 2, "model": "ball"}),
                               (["--at", "0.5,0.2;1,-0.3", "--as", "both"],
                                {"at": [[0.5, 0.2], [1, -0.3]], "as_": "both"}),
                               (["--event", "omega1=0.1"], {"event": ("omega1", 0.1)})):
            self.command("section", WILD, "--crossings", "20", "-o", "command.csv", "--quiet", *options)
            with self.subTest(**named):
                try:
                    table = isoroll.section(WILD, crossings=20, **named)
                except isoroll.IsorollWarning:  # the section of axis 2 is not global
                    with self.assertWarns(isoroll.IsorollWarning):
                        table = isoroll.section(WILD, crossings=20, **named)
                isoroll.write(table, self.path("python.csv"))
                self.same_files(self.path("command.csv"), self.path("python.csv"))
                self.same(isoroll.read(self.path("command.csv")).array, table.array)

    def test_both_models(self):
        table = isoroll.section(BALL, starts=10, crossings=50)
        self.near(table.x, table.point.x, 1e-9)
        self.near(table["l"], table.point["l"], 1e-9)
        self.near(table.t, table.point.t, 1e-8)
        for column in ("orbit", "crossing"):
            self.same(table[column], table.point[column])
        self.assertEqual((table.point.lines["model"], table.kind), ("point", "section"))
        self.assertIsNone(isoroll.section(BALL, model="ball", crossings=3).point)

    def test_is_on_the_section(self):
        table = isoroll.section(WILD, crossings=30, as_="both")
        self.near(table["n3"], 0, 1e-12)
        self.near(table["gamma3"], 0, 1e-12)
        self.near(table["M3"] / np.linalg.norm(table.M, axis=1), table.x, 1e-12)

    def test_refused(self):
        refuse = lambda kind, words, **named: self.refuses(kind, words, isoroll.section, WILD, **named)
        refuse(isoroll.BadArgument, "axis '4'", axis=4)
        refuse(isoroll.BadArgument, "no column 'foo'", event=("foo", 1))
        refuse(isoroll.BadArgument, "only once", event=("t", 1))
        refuse(isoroll.BadArgument, "not both", event=("n3", 0), axis=1)
        refuse(isoroll.BadArgument, "crossings is '0'", crossings=0)
        refuse(isoroll.BadArgument, "starts is '1.5'", starts=1.5)
        refuse(isoroll.BadArgument, "1e9 rows", starts=2**62)
        refuse(isoroll.BadArgument, "crossings is", crossings=2**62)
        refuse(isoroll.BadArgument, "1e9 rows", crossings=10**6, starts=1000)
        refuse(isoroll.BadArgument, "1e9 rows", crossings=np.int64(2**62), starts=None)
        refuse(isoroll.BadArgument, "crossings is '1,2'", crossings=np.array([1, 2]))
        refuse(isoroll.BadArgument, "starts is '1,2'", starts=[1, 2])
        refuse(isoroll.BadArgument, "(starts, 2)", at=0.5)
        refuse(isoroll.BadArgument, "seed is '-1'", seed=-1)
        refuse(isoroll.BadArgument, "", event=("n1", np.nan))
        refuse(isoroll.BadArgument, "", tol=2)
        refuse(isoroll.BadArgument, "tol is 'nan'", tol=np.nan, about="tol")
        refuse(isoroll.BadArgument, "expected l,x", at=[[np.nan, 0]])
        refuse(isoroll.BadArgument, "shape (3,)", at=[1, 2, 3])
        refuse(isoroll.BadArgument, "expected ball, point or both", model="neither")
        refuse(isoroll.BadInput, "", at=[[0, 2]])
        self.refuses(isoroll.BadInput, "", isoroll.section, example("10_bowl"))


class Written(Case):
    def test_each_table_reads_back(self):
        chaos, section = isoroll.chaos(WILD, turns=100), isoroll.section(WILD, crossings=3)
        for table in (chaos, chaos.indicators["ball"], section, section.point, isoroll.section(WILD, cloud=512),
                      isoroll.check(isoroll.run(BALL)), isoroll.compare(isoroll.Scene(BALL, end=2))):
            for path in map(self.path, ("a.csv", "a.h5")):
                with self.subTest(kind=table.kind, path=path):
                    table.write(path)
                    again = isoroll.read(path)
                    self.assertEqual((again.kind, again.columns, again.lines), (table.kind, table.columns, table.lines))
                    for name in table.columns:
                        np.testing.assert_array_equal(again[name], table[name])
        for table in (isoroll.explain(WILD), isoroll.frequencies(BALL, turns=20)):
            self.refuses(isoroll.BadArgument, "has only lines", table.write, self.path("b.csv"))


class Names(Case):
    def test_a_study_by_its_name(self):
        table, point, *others = isoroll.study(WILD, "section", crossings=20, at=[[0.5, 0.2]], as_="both")
        named = isoroll.section(WILD, crossings=20, at=[[0.5, 0.2]], as_="both")
        self.same(table.array, named.array)
        self.same(point.array, named.point.array)
        self.assertEqual((table.kind, table.lines, others), ("section", named.lines, [None] * 4))

    def test_lines_are_those_of_json(self):
        command = json.loads(self.command("chaos", WILD, "--starts", "12", "--turns", "300", "--json"))
        lines = isoroll.study(WILD, "chaos", starts=12, turns=300, exponent_turns=None)[0].lines
        self.assertEqual(lines["ball.verdict"], command["ball"]["verdict"])
        self.assertEqual(float(lines["point.exponent.tau"]), command["point"]["exponent"]["tau"])
        self.assertEqual(float(lines["share.low"]), command["share"]["low"])
        self.assertEqual(int(lines["section.axis"]), command["section"]["axis"])

    def test_refused(self):
        refuse = lambda words, *given, **named: self.refuses(isoroll.BadArgument, words, isoroll.study, WILD, *given,
                                                             **named)
        refuse("no study 'chaso'; did you mean 'chaos'?", "chaso")
        refuse("chaos has no option 'turn'; did you mean 'turns'?", "chaos", turn=3)
        refuse("turns is 'true': expected a whole number from 1 on", "chaos", turns=True)


class Verdicts(Case):
    def test_are_those_of_the_command(self):
        for scene in (WILD, BALL):
            command = json.loads(self.command("chaos", scene, "--starts", "12", "--turns", "1500", "--json"))
            found = isoroll.chaos(scene, starts=12, turns=1500)
            with self.subTest(scene=scene):
                self.assertEqual(found.verdict[0], command["ball"]["verdict"])
                self.assertEqual(found.share.chaotic, command["share"]["chaotic_starts"])
                self.assertEqual(found.share.undecided, command["share"]["undecided_starts"])
                self.assertEqual((found.share.asked, found.share.orbits), (12, command["share"]["followed"]))
                self.assertEqual((found.share.low, found.share.high),
                                 (command["share"]["low"], command["share"]["high"]))
                self.assertEqual(found["ball_exponent_t"][0], command["ball"]["exponent"]["t"])
                self.assertEqual(found["point_megno"][0], command["point"]["megno"])
                spread = found.verdict[1:]
                self.assertEqual(int(np.sum(spread == "chaotic")), found.share.chaotic)
                self.assertEqual(len(found), 13)

    def test_k_minus_one_has_no_chaos(self):
        found = isoroll.chaos(BALL, starts=12, turns=1500)
        self.assertEqual(found.share.chaotic, 0)
        self.assertIn("integral", found.lines)
        self.assertNotIn("integral", isoroll.chaos(WILD, turns=10).lines)

    def test_exponent_goes_on(self):
        brief, far = (isoroll.chaos(WILD, model="point", exponent_turns=turns) for turns in (0, 700))
        self.assertTrue(np.isnan(brief["point_error_t"][0]))
        self.assertGreater(far["point_error_t"][0], 0)
        self.assertEqual(far["point_exponent_turns"][0], 700)
        self.assertEqual(far["point_turns"][0], brief["point_turns"][0])

    def test_trace(self):
        found = isoroll.chaos(WILD, turns=300, model="ball")
        again = pickle.loads(pickle.dumps(found))
        self.assertEqual((again.verdict[0], again.lines), (found.verdict[0], found.lines))
        self.assertEqual(list(found.indicators), ["ball"])
        self.assertEqual(found.indicators["ball"].columns, ("turn", "t", "growth", "megno", "mean", "gali2"))
        self.assertEqual(found.indicators["ball"]["turn"][0], 1)
        self.assertIsNone(found.share)
        self.assertNotIn("point_megno", found)

    def test_refused(self):
        self.refuses(isoroll.BadArgument, "turns is '0'", isoroll.chaos, WILD, turns=0)
        self.refuses(isoroll.BadArgument, "starts is", isoroll.chaos, WILD, starts=2**61)
        self.refuses(isoroll.BadArgument, "turns is", isoroll.chaos, WILD, turns=2**60)
        self.refuses(isoroll.BadArgument, "tol is 'nan'", isoroll.chaos, WILD, tol=np.nan)
        self.refuses(isoroll.BadInput, "", isoroll.chaos, example("10_bowl"))
        self.refuses(isoroll.NotMapped, "", isoroll.chaos, example("11_rubber_and_marble"), model="point")


if __name__ == "__main__":
    unittest.main()

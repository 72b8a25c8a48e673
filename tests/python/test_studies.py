"""Sections and chaos: rows, verdicts and shares are those of the command."""

import json
import pickle
import unittest

import numpy as np
from shared import BALL, WILD, Case

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
        table = isoroll.section(BALL, starts=2, crossings=5)
        self.near(table.x, table.point.x, 1e-9)
        self.assertEqual((table.point.lines["model"], table.kind), ("point", "section"))
        self.assertIsNone(isoroll.section(BALL, model="ball", crossings=3).point)

    def test_refused(self):
        refuse = lambda kind, words, **named: self.refuses(kind, words, isoroll.section, WILD, **named)
        refuse(isoroll.BadArgument, "no column 'foo'", event=("foo", 1))
        refuse(isoroll.BadArgument, "only once", event=("t", 1))
        refuse(isoroll.BadArgument, "1e9 rows", starts=2**62)
        refuse(isoroll.BadArgument, "crossings is", crossings=2**62)
        refuse(isoroll.BadArgument, "1e9 rows", crossings=10**6, starts=1000)
        refuse(isoroll.BadArgument, "1e9 rows", crossings=np.int64(2**62), starts=None)
        refuse(isoroll.BadArgument, "crossings is array([1, 2]), it must be a number", crossings=np.array([1, 2]))
        refuse(isoroll.BadArgument, "starts is [1, 2], it must be a number", starts=[1, 2])
        refuse(isoroll.BadArgument, "(starts, 2)", at=0.5)
        refuse(isoroll.BadArgument, "", event=("n1", np.nan))
        refuse(isoroll.BadArgument, "tol is 'nan'", tol=np.nan, about="tol")
        refuse(isoroll.BadArgument, "expected l,x", at=[[np.nan, 0]])
        refuse(isoroll.BadArgument, "shape (3,)", at=[1, 2, 3])


class Written(Case):
    def test_each_table_reads_back(self):
        chaos, section = isoroll.chaos(WILD, turns=100), isoroll.section(WILD, crossings=3)
        for table in (chaos, chaos.indicators["ball"], section, section.point, isoroll.section(WILD, area=True),
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

    def test_refused(self):
        refuse = lambda words, *given, **named: self.refuses(isoroll.BadArgument, words, isoroll.study, WILD, *given,
                                                             **named)
        refuse("no study 'chaso'; did you mean 'chaos'?", "chaso")
        refuse("chaos has no option 'turn'; did you mean 'turns'?", "chaos", turn=3)
        refuse("turns is True, it must be a number", "chaos", turns=True)


class Verdicts(Case):
    def test_are_those_of_the_command(self):
        command = json.loads(self.command("chaos", WILD, "--starts", "12", "--turns", "1500", "--json"))
        found = isoroll.chaos(WILD, starts=12, turns=1500)
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
        self.refuses(isoroll.BadArgument, "starts is", isoroll.chaos, WILD, starts=2**61)
        self.refuses(isoroll.BadArgument, "turns is", isoroll.chaos, WILD, turns=2**60)


if __name__ == "__main__":
    unittest.main()

"""Effects that a scene writes, from a dict: as a file says them, and the integrals that are watched."""

import unittest

from shared import Case

import isoroll

START = dict(k=0.5, J=(1.4, 2.1, 3.0), normal=(0.36, 0.48, 0.8), angular_velocity=(0.9, -0.3, -0.225))
VALLEY = {"U": "c*n1^2 + 0.1/(1.2 - n3)", "parameters": {"c": 0.3}}


class Written(Case):
    def test_a_dict_is_what_a_file_says(self):
        """Friction that grows with latitude, and a push that is fixed in space."""
        torque = {"M": [f"-r*n3^2*omega{i} + p*e{i}" for i in (1, 2, 3)], "parameters": {"r": 0.1, "p": 0.2}}
        scene = isoroll.Scene(**START, end=3, gravity={"mgb": 0, "up": (0, 0.6, 0.8)}, torque=torque, potential=VALLEY)
        text = isoroll.Scene(**START, end=3).text + """effects:
  gravity: {mgb: 0, up: [0, 0.6, 0.8]}
  torque:
    M: ["-r*n3^2*omega1 + p*e1", "-r*n3^2*omega2 + p*e2", "-r*n3^2*omega3 + p*e3"]
    parameters: {r: 0.1, p: 0.2}
  potential: {U: "c*n1^2 + 0.1/(1.2 - n3)", parameters: {c: 0.3}}
"""
        self.same(isoroll.run(scene).array, isoroll.run(text).array)

    def test_integrals_are_watched(self):
        energy = "(J1*omega1^2 + J2*omega2^2 + J3*omega3^2)/2 + c*n1^2 + 0.1/(1.2 - n3)"
        claims = {"F": energy, "F2": "omega1^2", "parameters": {"c": 0.3}}
        table = isoroll.run(isoroll.Scene(**START, end=5, potential=VALLEY, integrals=claims))
        for rows, model in ((table, "ball"), (isoroll.convert(table, "point"), "point")):
            found = isoroll.check(rows)
            worst = dict(zip(found.name, found.worst))
            self.assertLess(worst[f"{model} F"], 1e-13)
            self.assertGreater(worst[f"{model} F2"], 1e-3)

    def test_what_is_not_finite_at_the_start_is_bad_input(self):
        """By every road: keywords have no file, so what is left is the expression, the state and the reason."""
        for effect, words in (({"potential": {"U": "1/(n1 - 0.36)"}}, "U is not a finite number where"),
                              ({"torque": {"M": ["0", "log(n1 - 0.36)", "0"]}}, "M2 is not a finite number")):
            scene = isoroll.Scene(**START, end=1, **effect)
            for call in (isoroll.run, isoroll.orbit, isoroll.section, isoroll.chaos,
                         lambda scene: isoroll.batch(scene, [1, 2])):
                error = self.refuses(isoroll.BadInput, words, call, scene)
                self.assertRegex(str(error), r"n = \(0.36, 0.48, 0.8\): in column \d of the text, (log of|a division)")


if __name__ == "__main__":
    unittest.main()

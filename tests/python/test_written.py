"""Effects that a scene writes, from a dict: their orbits against SciPy, and the integrals that are watched."""

import unittest

import numpy as np
from shared import Case

import isoroll

J = np.array([1.4, 2.1, 3.0])
START = dict(k=0.5, J=tuple(J), normal=(0.36, 0.48, 0.8), angular_velocity=(0.9, -0.3, -0.225))
#: friction that grows with latitude, and a push that is fixed in space
TORQUE = {"M": [f"-r*n3^2*omega{i} + p*e{i}" for i in (1, 2, 3)], "parameters": {"r": 0.1, "p": 0.2}}
VALLEY = {"U": "c*n1^2 + 0.1/(1.2 - n3)", "parameters": {"c": 0.3}}


def orbit(torque, y, times, k=0.5):
    """The ball (9) with a torque(omega, n, e), by SciPy; y has omega, n, e."""
    from scipy.integrate import solve_ivp

    def slope(_, y):
        w, n, e = y[:3], y[3:6], y[6:]
        push = np.cross(J * w, w) + torque(w, n, e)
        turn = -k * np.dot(w, np.cross(n, w)) - np.dot(n, push / J)  # (w,n)' = 0
        return np.concatenate([(push + turn / np.dot(n, n / J) * n) / J, k * np.cross(n, w), np.cross(e, w)])

    found = solve_ivp(slope, (0, times[-1]), y, "DOP853", times, rtol=3e-14, atol=1e-16)
    return found.y.T


class Written(Case):
    def compare(self, scene, torque):
        try:
            import scipy  # noqa: F401
        except ImportError:
            self.skipTest("scipy is not installed")
        table = isoroll.run(scene)
        start = np.concatenate([START["angular_velocity"], START["normal"], (0, 0.6, 0.8)])
        others = orbit(torque, start, table.t)
        self.assertLess(np.abs(table.omega - others[:, :3]).max(), 1e-12)
        self.assertLess(np.abs(table.n - others[:, 3:6]).max(), 1e-12)

    def test_a_torque(self):
        weightless = {"mgb": 0, "up": (0, 0.6, 0.8)}
        scene = isoroll.Scene(**START, end=3, tolerance=1e-14, gravity=weightless, torque=TORQUE)
        self.compare(scene, lambda w, n, e: -0.1 * n[2] ** 2 * w + 0.2 * e)

    def test_a_potential(self):
        def torque(w, n, e):
            return 0.5 * np.cross(n, (0.6 * n[0], 0, 0.1 / (1.2 - n[2]) ** 2))

        self.compare(isoroll.Scene(**START, end=3, tolerance=1e-14, potential=VALLEY), torque)

    def test_integrals_are_watched(self):
        energy = "(J1*omega1^2 + J2*omega2^2 + J3*omega3^2)/2 + c*n1^2 + 0.1/(1.2 - n3)"
        claims = {"F": energy, "F2": "omega1^2", "parameters": {"c": 0.3}}
        table = isoroll.run(isoroll.Scene(**START, end=5, potential=VALLEY, integrals=claims))
        for rows, model in ((table, "ball"), (isoroll.convert(table, "point"), "point")):
            found = isoroll.check(rows)
            worst = dict(zip(found.name, found.worst))
            self.assertLess(worst[f"{model} F"], 1e-13)
            self.assertGreater(worst[f"{model} F2"], 1e-3)

    def test_what_is_wrong_is_told(self):
        for U, words in (("n1 +", "not the end"), ("sqrt(n1^2)", "U: this has a corner")):
            with self.assertRaisesRegex(isoroll.BadInput, words):
                isoroll.run(isoroll.Scene(**START, end=1, potential={"U": U}))


if __name__ == "__main__":
    unittest.main()

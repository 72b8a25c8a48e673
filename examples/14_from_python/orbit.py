"""An orbit of the ball (9) by SciPy, as somebody's own program might write it: names and order of its own, blanks
between, no parameters. Needs SciPy; orbit.txt is what it wrote."""
import numpy as np
from scipy.integrate import solve_ivp

k, J = 2 / 3, np.array([0.52, 0.73, 0.81])  # outside a sphere twice as large


def rhs(t, y):
    w, n = y[:3], y[3:]
    torque = np.cross(J * w, w)
    reaction = -torque @ (n / J) / (n @ (n / J))
    return np.concatenate([(torque + reaction * n) / J, k * np.cross(n, w)])


n = np.array([0.6, 0.0, 0.8])
w = np.array([0.4, 1.1, -0.3])
times = np.linspace(0, 30, 301)
y = solve_ivp(rhs, (0, 30), np.concatenate([w, n]), method="DOP853", rtol=1e-12, atol=1e-12, t_eval=times).y
np.savetxt("orbit.txt", np.column_stack([y[3:].T, y[:3].T, times]), fmt="%.17g",
           header="n1 n2 n3 omega1 omega2 omega3 t")

# sections.py - a section of both models from Python, in cells: an editor for notebooks runs them one by one.
#     python3 sections.py [PICTURE]

# %% A scene, one orbit: the states of both models at some times.
import os
import sys

import matplotlib
import numpy as np

import isoroll

folder = os.path.dirname(os.path.abspath(__file__))
scene = isoroll.Scene(os.path.join(folder, "scene.yaml"))
both = isoroll.orbit(scene, as_="both").at([0, 10, 5])
print(scene)
print("gamma at t = 0, 10, 5:", *both.gamma)

# %% 60 orbits of the same energy, spread over the section. Which of them are chaotic?
chaos = isoroll.chaos(scene, starts=60, model="ball")
print(f"chaotic: {chaos.share.share:.0%} of the section, between {chaos.share.low:.0%} and {chaos.share.high:.0%}")

# %% The section of these orbits. Each model is integrated by itself.
starts = np.column_stack([chaos.l, chaos.x])[1:]  # orbit 0 is the scene's own
section = isoroll.section(scene, at=starts, crossings=400, as_="both")
print(f"n{section.lines['section'][1:]}: {len(section)} crossings by the ball, {len(section.point)} by the point")

# %% Left: directions of the ball's n and omega. Right: place and momentum of the point.
if len(sys.argv) > 1:
    matplotlib.use("Agg")  # into a file
import matplotlib.pyplot as plt

a = int(section.lines["axis"]) - 1
b, c = (a + 1) % 3, (a + 2) % 3


def draw(axes, orbit, angle, part, title):
    grey = (chaos.verdict == "chaotic")[orbit.astype(int)]
    axes.plot(angle[grey], part[grey], ",", color="0.6")
    axes.scatter(angle[~grey], part[~grey], s=0.3, c=orbit[~grey], cmap="turbo", linewidths=0)
    axes.set(title=title, xlim=(-np.pi, np.pi), ylim=(-1, 1))


figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2), dpi=72, layout="constrained")
n, omega = section.n, section.omega
draw(left, section["orbit"], np.arctan2(n[:, c], n[:, b]), omega[:, a] / np.linalg.norm(omega, axis=1), "the ball")
left.set(xlabel=f"angle of n in the plane {b + 1}{c + 1}", ylabel=f"omega{a + 1}/|omega|")
point = section.point
draw(right, point["orbit"], -point["l"], point["x"], "the point")
right.set(xlabel=f"angle of gamma in the plane {b + 1}{c + 1}", ylabel=f"M{a + 1}/|M|")

# %% Show it, or save it.
if len(sys.argv) > 1:
    figure.savefig(sys.argv[1])
else:
    plt.show()

# %% [markdown]
# # From a scene to a figure for a paper
#
# Ten minutes with isoroll in Python. This file is in cells: VS Code, Spyder and Jupyter (by jupytext) run them one
# by one. `python3 tutorial.py` runs them all, in half a minute, and writes `figure.pdf` into this folder.
#
# A ball covered with rubber rolls on a sphere: it neither slips nor twists. A point moves on a sphere, in a
# potential. They have the same orbits. How much of the motion is chaotic?

# %%
import os

import matplotlib.pyplot as plt
import numpy as np

import isoroll

if "TUTORIAL_QUICK" in os.environ:  # a look at everything in a few seconds
    starts, crossings, turns, ks = 12, 60, 300, np.arange(5, 31, 5) / 20
else:
    starts, crossings, turns, ks = 80, 200, 1000, np.arange(5, 31) / 20

# %% [markdown]
# ## A scene
#
# A ball is two things: the geometry k and the moments of inertia J about the contact. k = 1/2 is a ball on the outside
# of a sphere of its own size. `normal` is the direction of the contact, in the axes of the ball; `angular_velocity` is
# at right angles to it, because the ball does not twist. `text` is the same scene as a file for the command.

# %%
scene = isoroll.Scene(k=0.5, J=(1, 2, 5), normal=(0.36, 0.48, 0.8), angular_velocity=(0.9, -0.3, -0.225))
print(scene.text)

# %% [markdown]
# Scenes are values. Another one with other numbers is made from this one; nothing changes the old one. k = 1 is a
# plane: there the problem has one more integral, and no chaos.

# %%
plane = isoroll.Scene(scene, k=1)
print(scene.k, plane.k)

# %% [markdown]
# ## One orbit
#
# `run` gives a table. Its columns are arrays of NumPy, vectors have the shape (rows, 3). omega and n belong to the
# ball, M and gamma to the point, and there are three clocks: t is the ball's, s the point's. No number is copied.

# %%
orbit = isoroll.run(scene, as_="both")
print(orbit)
print({name: f"{orbit.doc[name]} [{orbit.units[name]}]" for name in ("t", "s", "omega1")})

# %% [markdown]
# What the file of the table would say above its rows is in `lines`; k and J are attributes too. So the energy is one
# line. It is 0.6216, and all rows agree to 14 digits.

# %%
energy = (orbit.J * orbit.omega**2).sum(axis=1) / 2
print(f"h = {orbit.lines['h']:.4f}, and over the rows it differs by {np.ptp(energy):.0e}")
orbit.plot()

# %% [markdown]
# ## Arrays of your own
#
# Any arrays become a table. Here they come from a program of our own: the equations of the ball, and the method of
# Runge and Kutta. `check` says how well the rows solve the equations, and `convert` carries them to the point. With a
# step of 0.02 the rows are right to 6 digits until t = 20.


# %%
def rate(state):
    w, n = state[:3], state[3:]
    turn = (n @ (scene.J * w)) / (n @ (n / scene.J)) / scene.J.prod()
    return np.concatenate([turn * np.cross(n, scene.J * w), scene.k * np.cross(n, w)])


h, states = 0.02, [scene.start]
for _ in range(1000):
    y = states[-1]
    a = rate(y)
    b = rate(y + h / 2 * a)
    c = rate(y + h / 2 * b)
    d = rate(y + h * c)
    states.append(y + h / 6 * (a + 2 * b + 2 * c + d))
states = np.array(states)
mine = isoroll.trajectory({"t": h * np.arange(1001), "omega": states[:, :3], "n": states[:, 3:]}, k=0.5, J=(1, 2, 5))
residuals = isoroll.check(mine)
print(residuals)
as_point = isoroll.convert(mine, "point")

# %% [markdown]
# ## Files
#
# `write` takes every table, `read` every file of isoroll, also those of the command. The end of the name says what it
# is: `.csv` for people, `.h5` for many rows. Both give back each bit. With pandas, `to_pandas()` is a DataFrame.

# %%
as_point.write("point.csv")
again = isoroll.read("point.csv")
print(again.k, again.J, np.array_equal(again.array, as_point.array))
try:
    print(again.to_pandas().describe())
except ImportError as error:
    print(error)

# %% [markdown]
# ## Many orbits
#
# A batch follows many orbits at once, on all processors. Here are 100 neighbours: their angular velocities are turned
# about n by at most 1e-8. With k = 1/2 their distances grow by more than a million times until t = 200: this motion is
# chaotic. In the plane the same neighbours stay together; their distances grow by less than 100.

# %%
w, n = scene.angular_velocity, scene.normal
angle = 1e-8 * np.linspace(-1, 1, 100)[:, None]
start = np.hstack([np.cos(angle) * w + np.sin(angle) * np.cross(n, w), np.tile(n, (100, 1))])
times = np.arange(1, 201)
growth = {}
for one in (scene, plane):
    batch = isoroll.batch(one, times, start=start)
    spread = np.sqrt(batch.n.var(axis=0).sum(axis=1))  # batch.n has the shape (orbits, rows, 3)
    growth[one.k] = spread / spread[0]
    print(f"k = {one.k}: {batch.n.shape}, the distances grow {growth[one.k][-1]:.2g} times")

# %% [markdown]
# ## A section
#
# All orbits of one energy in one picture: a dot wherever an orbit passes n3 = 0 upwards. The starts are spread over the
# section. Ball and point are integrated each by itself. Regular orbits are curves, the same ones on both sides. In the
# chaotic sea rounding errors grow, until ball and point part: these dots are grey.

# %%
section = isoroll.section(scene, starts=starts, crossings=crossings, as_="both")
print(section)
section.plot()

# %% [markdown]
# ## The chaotic share
#
# How large is the sea? `chaos` follows each start until its neighbours tell. Orbit 0 is the scene's own; it is chaotic.
# So is about half of the section; the 95 % interval says how sure that is. Orbits that are not decided count at its
# upper end: more turns make it narrow. `help(isoroll.chaos)` has all options.

# %%
chaos = isoroll.chaos(scene, starts=starts, turns=turns, model="point")
share = chaos.share
print(f"the scene's own orbit is {chaos.verdict[0]}")
print(f"{share.chaotic} of {share.orbits} are chaotic: {share.share:.2f}, between {share.low:.2f} and {share.high:.2f}")

# %% [markdown]
# Over k this is a sweep: many scenes, and what is measured at each. `progress=True` shows a bar. Ctrl-C ends it, and
# the exception's `partial` has the points that are done. At k = 1 nothing is chaotic.

# %%
sweep = isoroll.sweep({"scene": scene, "vary": {"k": ks}, "measure": {"chaos": {"starts": starts, "model": "point"}},
                       "until": {"turns": turns}})
sweep.write("share.h5")
print(isoroll.read("share.h5").chaos_share)

# %% [markdown]
# ## Periodic orbits
#
# In the middle of an island is a stable periodic orbit; unstable ones lie in the sea. An orbit is stable if the trace
# of its return is between -2 and 2. Of period 1 and 2 there are 8, and 3 of them are stable. The first one closes after
# t = 11.84, to 12 digits: a scene that starts there shows it.

# %%
periodic = isoroll.periodic(scene, period=2)
print(periodic)
closed = isoroll.Scene(scene, normal=periodic.n[0], angular_velocity=periodic.omega[0], end=periodic.t[0])
ends = isoroll.run(closed, [0, closed.end])
print(f"after t = {closed.end:.2f} it is back to {np.abs(ends.n[1] - ends.n[0]).max():.0e}")

# %% [markdown]
# ## Why there is chaos
#
# The rotation about the middle axis is unstable. The curve of orbits that leave it meets its mirror curve with the
# slopes m and -m. If m is not 0, the curves cross, and no other analytic integral exists. m is 0.1419 at k = 1/2. It
# falls with k, and is 0 at k = 1: there it is smaller than its error. Beyond, m is negative, and |m| is below 1e-3.

# %%
splitting = isoroll.splitting(scene, k=ks, digits="double")
print(splitting)

# %% [markdown]
# ## A figure for a paper
#
# Two columns of a journal are 178 mm wide. `plot` draws into Axes of your own, so a figure is put together as with any
# other data. Over the section are the periodic orbits: rings are stable ones, crosses unstable ones. The end of the
# name says what is written: `.pdf` has vectors, for the journal (many spots are an image); `.png` is for a page.

# %%
plt.rcParams.update({"font.size": 7, "axes.titlesize": 7, "legend.fontsize": 6, "pdf.fonttype": 42})
figure, axes = plt.subplots(2, 2, figsize=(178 / 25.4, 135 / 25.4), layout="constrained")
section.plot(ax=axes[0], over=periodic)
for at in axes[0]:
    for dots in at.collections[:3]:  # grey, dark, and coloured ones
        dots.set_sizes([0.5])  # for a small figure
axes[0, 0].get_legend().remove()
sweep.plot(ax=axes[1, 0])
axes[1, 0].set(ylabel="chaotic share of the section", title="")
splitting.plot(ax=axes[1, 1])
axes[1, 1].set(ylabel="splitting |m|", title="")
for letter, at in zip("abcd", axes.flat):
    at.set_title(f"({letter})", loc="left", fontweight="bold")
for name in ("figure.pdf", "figure.png"):
    figure.savefig(name, dpi=120)

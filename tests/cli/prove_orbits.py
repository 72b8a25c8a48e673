"""prove_orbits.py CERTIFICATE HALVES CHANGE - orbits found another way lie inside every step of a certificate.

The equations are gamma'' = -gamma + kappa gamma x gamma', in vectors and in 60 digits of mpmath; those of the
certificate (lib/doc/prove.md) are others. HALVES half returns are taken, each with one orbit that starts anywhere in its
set. J_c is changed by CHANGE. Prints how many numbers were compared, and how many of them lie outside.
"""
import random
import sys

from mpmath import cos, mp, mpf, sin, sqrt

mp.dps = 60
TERMS = 45


def exact(text):
    top, _, below = text.partition("/")
    return mpf(top) / mpf(below or 1)


def balls(words):
    numbers = [int(w, 16) for w in words]
    return [(numbers[i] * mpf(2) ** numbers[i + 1], numbers[i + 2] * mpf(2) ** numbers[i + 3])
            for i in range(0, len(numbers), 4)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def step(gamma, u, h, k, J):
    """A step of a Taylor series."""
    g, v = [[x] for x in gamma], [[x] for x in u]
    q, b, kappa = [], [[], [], []], []
    for n in range(TERMS):
        def product(x, y):
            return sum(x[i] * y[n - i] for i in range(n + 1))
        q.append(sum(J[i] * product(g[i], g[i]) for i in range(3)))
        for i in range(3):
            j, m = (i + 1) % 3, (i + 2) % 3
            b[i].append(product(g[j], v[m]) - product(g[m], v[j]))
        p = sum(J[i] * product(g[i], b[i]) for i in range(3))
        kappa.append((-p / k - sum(q[i] * kappa[n - i] for i in range(1, n + 1))) / q[0])
        rates = [product(kappa, b[i]) - g[i][n] for i in range(3)]
        for i in range(3):
            g[i].append(v[i][n] / (n + 1))
            v[i].append(rates[i] / (n + 1))
    return [[sum(c * h ** i for i, c in enumerate(series)) for series in part] for part in (g, v)]


def state(gamma, u, J):
    b, Jg, Ju = cross(gamma, u), [x * y for x, y in zip(J, gamma)], [x * y for x, y in zip(J, u)]
    return [dot(Jg, gamma), dot(Jg, u), dot(Jg, b), dot(Ju, u), dot(Ju, b), gamma[2], u[2], b[2]]


def follow(lines, at, k, J):
    """(compared, outside) of one orbit of the half return that begins in line `at`."""
    anywhere = [m + r * (2 * mpf(random.random()) - 1) for m, r in balls(lines[at + 1][1:]) + balls(lines[at + 2][1:])]
    l, x = anywhere
    gamma, u = [cos(l), -sin(l), mpf(0)], [-x * sin(l), -x * cos(l), sqrt(1 - x * x)]
    compared = outside = 0
    h = None
    for words in lines[at + 3:]:
        if words[0] == "window":
            return compared, outside
        if words[0] == "step":
            h = balls(words[1:])[0][0]
            continue
        for _ in range(2 if h else 0):
            gamma, u = step(gamma, u, h / 2, k, J)
        for number, (middle, radius) in zip(state(gamma, u, J), balls(words[1:])):
            compared += 1
            outside += abs(number - middle) > radius + mpf(10) ** -50


lines = [line.split() for line in open(sys.argv[1]) if line[0] != "#"]
said = {words[0]: words[1:] for words in lines if words[0] in ("k", "moments")}
k, J = exact(said["k"][0]), [exact(text) for text in said["moments"]]
J[2] += mpf(sys.argv[3])
random.seed(35)
places = [i for i, words in enumerate(lines) if words[0] == "half"]
found = [follow(lines, at, k, J) for at in random.sample(places, min(int(sys.argv[2]), len(places)))]
print(sum(f[0] for f in found), sum(f[1] for f in found))

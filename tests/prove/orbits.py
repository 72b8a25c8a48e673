"""orbits.py ISOROLL [--count N] [--digits D] [--seed S] [--change X]

Random orbits of 'isoroll run --certify' against an integrator that shares nothing with it: the point's equation of
second order in the ball's time, as power series in whole numbers (fixed point), with no enclosure at all:

    gamma_tt = (1 + 1/(2k)) (q_t/q) gamma_t + (2 h k/det J) q ((1 - k) q gamma - J gamma)
               - 2 kappa c q^(2 + 1/k) gamma + (J^(1/2) K, gamma)/sqrt(det J) gamma x gamma_t,      kappa = k^2/det J
    s_t = kappa q^(1 + 1/(2k)),   tau_t = q^(1 - 1/(2k)),   q = (gamma, J gamma)

isoroll encloses the ball's omega and n by (9), or M and gamma by (24). D digits are computed here, and isoroll's rows
hold between 20 and D - 40 of them. Every number of every row must lie inside its enclosure. With --change X the
coefficient 2 h k/det J is multiplied by 1 + X, and each orbit must leave its enclosures.
"""
import argparse
import operator
import random
import subprocess
import sys
from fractions import Fraction

from mpmath import mp, mpf

ORDER = 1.15  # coefficients for each digit


class Fixed:
    """Whole numbers that stand for multiples of 2^-bits."""

    def __init__(self, digits):
        self.bits = int(digits * 3.33) + 80

    def of(self, x):
        return int(mp.nint(mpf(x) * mpf(2) ** self.bits))

    def to(self, a):
        return mpf(a) / mpf(2) ** self.bits

    def times(self, a, b):
        return a * b >> self.bits

    def convolve(self, a, b, n):
        """Coefficient n of the product."""
        return sum(map(operator.mul, a[: n + 1], b[n::-1])) >> self.bits


class Orbit:
    def __init__(self, fixed, scene, change):
        self.f = fixed
        k, J = scene["k"], scene["J"]
        n, w = scene["n"], scene["w"]
        self.k, self.J, self.det = k, J, J[0] * J[1] * J[2]
        length = mp.sqrt(sum(x * x for x in n))
        n = [x / length for x in n]
        along = sum(x * y for x, y in zip(n, w))
        w = [y - along * x for x, y in zip(n, w)]
        g = sum(x * x / j for x, j in zip(n, J))
        c = scene["c"]
        h = sum(x * x * j for x, j in zip(w, J)) / 2 - c * g ** (-1 / k)
        kappa = k * k / self.det
        self.gamma = [x / mp.sqrt(j * g) for x, j in zip(n, J)]
        v = [x * mp.sqrt(j) for x, j in zip(w, J)]
        self.rate = [x * k / (mp.sqrt(self.det) * g) for x in cross(self.gamma, v)]
        self.tau = self.s = self.t = mpf(0)
        self.kappa, self.first = kappa, 1 + 1 / (2 * k)
        self.b = 2 * h * k / self.det * (1 + change)
        self.level = -2 * kappa * c
        self.field = [x * mp.sqrt(j) / mp.sqrt(self.det) for x, j in zip(scene["K"], J)]
        self.h = mpf(1) / 4

    def series(self, h, order):
        """Coefficients of gamma, tau and s in t/h."""
        f, k = self.f, self.k
        J = [f.of(j) for j in self.J]
        G = [[f.of(x)] for x in self.gamma]
        U = [[f.of(x * h)] for x in self.rate]
        q, r, W, Y, L, P, Q = [], [], [], [[], [], []], [], [], []
        X = [[], [], []]
        a, b, level = f.of(self.first), f.of(self.b * h * h), f.of(self.level * h * h)
        field = [f.of(x * h) for x in self.field]
        one_less_k, power, tau_power = f.of(1 - k), f.of(2 + 1 / k), f.of(1 - 1 / (2 * k))
        q0 = sum(j * x * x for j, x in zip(self.J, self.gamma))
        starts = (q0 ** (2 + 1 / k), q0 ** (1 - 1 / (2 * k)), q0 ** self.first)
        W.append(f.of(starts[0])), P.append(f.of(starts[1])), Q.append(f.of(starts[2]))
        for n in range(order):
            q.append(sum(f.times(J[i], f.convolve(G[i], G[i], n)) for i in range(3)))
            slope = 2 * sum(f.times(J[i], f.convolve(G[i], U[i], n)) for i in range(3))
            known = sum(map(operator.mul, q[1 : n + 1], r[n - 1 :: -1])) if n > 0 else 0
            r.append(((slope << f.bits) - known) // q[0])
            for S, p in ((W, power), (P, tau_power), (Q, a)):
                if n > 0:
                    S.append(f.times(p, f.convolve(r, S, n - 1)) // n)
            L.append(sum(f.times(field[i], G[i][n]) for i in range(3)))
            for i in range(3):
                j, m = (i + 1) % 3, (i + 2) % 3
                Y[i].append(f.times(one_less_k, f.convolve(q, G[i], n)) - f.times(J[i], G[i][n]))
                if any(field):
                    X[i].append(f.convolve(G[j], U[m], n) - f.convolve(G[m], U[j], n))
            for i in range(3):
                x = f.times(a, f.convolve(r, U[i], n)) + f.times(b, f.convolve(q, Y[i], n))
                if level:
                    x += f.times(level, f.convolve(W, G[i], n))
                if any(field):
                    x += f.convolve(L, X[i], n)
                U[i].append(x // (n + 1))
            for i in range(3):
                G[i].append(U[i][n] // (n + 1))
        clock = [[0] + [x // (n + 1) for n, x in enumerate(S)] for S in (P, Q)]
        return G, U, clock

    def step(self, most, order):
        f = self.f
        while True:
            h = min(self.h, most)
            G, U, clock = self.series(h, order)
            last = max(abs(x) for S in G + U for x in (S[-1], S[-2]))
            small = last.bit_length() < 16
            if h >= self.h or not small:
                self.h = h * (mpf(1.2) if small else mpf(2) ** (mpf(-last.bit_length()) / order))
            if small:
                break
        self.gamma = [f.to(sum(S)) for S in G]
        self.rate = [f.to(sum(S)) / h for S in U]
        self.tau += f.to(sum(clock[0])) * h
        self.s += f.to(sum(clock[1])) * h * self.kappa
        return h

    def go_to(self, t, order):
        while self.t < t:
            most = t - self.t
            h = self.step(most, order)
            self.t = t if h == most else self.t + h

    def row(self):
        J, k = self.J, self.k
        q = sum(j * x * x for j, x in zip(J, self.gamma))
        v = [x * mp.sqrt(self.det) / (k * q) for x in cross(self.rate, self.gamma)]
        w = [x / mp.sqrt(j) for x, j in zip(v, J)]
        n = [x * mp.sqrt(j / q) for x, j in zip(self.gamma, J)]
        N = mp.sqrt(self.det) / k * q ** (-1 / (2 * k))
        return [self.t, self.tau, self.s] + w + n + [N * x for x in v] + self.gamma


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def exact(text):
    x = Fraction(text)
    return mpf(x.numerator) / mpf(x.denominator)


def draw(rng, digits):
    """A scene, its text and the same in numbers."""
    k = rng.choice(["1", "-1", "1/2", "-1/3", "2", "3/7", f"{rng.uniform(0.2, 3):.3f}", f"{-rng.uniform(0.2, 3):.3f}"])
    J = [f"{rng.uniform(1, 4):.2f}" for _ in range(3)]
    n = [rng.gauss(0, 1) for _ in range(3)]
    length = sum(x * x for x in n) ** 0.5
    n = [f"{x / length:.9f}" for x in n]
    w = [f"{rng.uniform(-1, 1):.5f}" for _ in range(3)]
    kind = rng.choice(["free", "free", "rotor", "level", "both"])
    K = [f"{rng.uniform(-1, 1):.2f}" if kind in ("rotor", "both") else "0" for _ in range(3)]
    c = f"{rng.uniform(-0.1, 0.3):.3f}" if kind in ("level", "both") else "0"
    if c == "-0.000" or float(c) == 0:
        c = "0"
    effects = []
    if any(x != "0" for x in K):
        effects.append(f"rotor: {{momentum: [{', '.join(K)}]}}")
    if c != "0":
        effects.append(f"level: {{c: {c}}}")
    end, rows = rng.choice(["0.4", "0.7", "1.2"]), rng.choice(["0.3", "0.5"])
    text = f"""reduced: {{k: {k}, J: [{', '.join(J)}]}}
initial: {{normal: [{', '.join(n)}], angular_velocity: [{', '.join(w)}], project: true}}
effects: {{{', '.join(effects)}}}
time: {{end: {end}, step: {rows}}}
output: {{as: both}}
"""
    if not effects:
        text = text.replace("effects: {}\n", "")
    scene = {"k": exact(k), "J": [exact(x) for x in J], "n": [exact(x) for x in n], "w": [exact(x) for x in w]}
    scene.update(K=[exact(x) for x in K], c=exact(c))
    return text, scene, rng.randint(20, digits - 40), rng.choice(["ball", "point"]), rng.choice([0, 1, 2, 3])


def rows_of(isoroll, text, digits, backend, spare):
    """spare: more digits to compute with; 0: as many as it takes. With few, the enclosures are as narrow as they can be,
    and the last rows may be missing."""
    command = [isoroll, "run", "-", "--certify", "--digits", str(digits), "--backend", backend]
    command += ["--work-digits", str(digits + spare)] if spare else []
    done = subprocess.run(command, input=text, capture_output=True, text=True, check=False)
    if done.returncode not in ((0, 4) if spare else (0,)):
        sys.exit(f"FAIL {' '.join(command)}: {done.stderr}\n{text}")
    lines = [line for line in done.stdout.splitlines() if line[0] != "#"]
    return [[exact(x) for x in line.split(",")] for line in lines[1:]]


def misses(row, reference, slack):
    """How many numbers lie outside their enclosures."""
    pairs = zip(row[::2], row[1::2], reference)
    return sum(abs(middle - x) > radius + slack * (1 + abs(x)) for middle, radius, x in pairs)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("isoroll")
    parser.add_argument("--count", type=int, default=3)
    parser.add_argument("--digits", type=int, default=90)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--change", type=str, default="0")
    o = parser.parse_args()
    mp.dps = o.digits + 20
    rng, change, slack = random.Random(o.seed), mpf(o.change), mpf(10) ** (30 - o.digits)
    order, rows, numbers, outside, orbits_outside = int(ORDER * o.digits) + 10, 0, 0, 0, 0
    for _ in range(o.count):
        text, scene, digits, backend, spare = draw(rng, o.digits)
        if change:
            digits, spare = o.digits - 40, 0
        orbit, missed = Orbit(Fixed(o.digits), scene, change), 0
        for row in rows_of(o.isoroll, text, digits, backend, spare):
            orbit.go_to(row[0], order)
            missed += misses(row, orbit.row(), slack)
            rows, numbers = rows + 1, numbers + len(row) // 2
        outside, orbits_outside = outside + missed, orbits_outside + (missed > 0)
        if missed and not change:
            print(f"FAIL {missed} numbers outside, {digits} digits, {backend}:\n{text}")
    print(f"{o.count} orbits, {rows} rows, {numbers} numbers: {outside} outside their enclosures, of {orbits_outside} orbits")
    sys.exit(orbits_outside != (o.count if change else 0))


main()

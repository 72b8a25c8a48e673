"""flow.py - Taylor series of an orbit and its neighbours in fixed point, for check.py. Equations: lib/doc/prove.md.

A number is a whole number m, its error a whole number r, both in units of 2^-P.
"""
from fractions import Fraction as Q
from operator import mul

from intervals import Interval, Refused, interval, need

TERMS = 240  # at most, of a series


class Series:
    """Coefficients m +- r, in units of 2^-P; a is |m|, u is |m| + r."""

    __slots__ = ("m", "r", "a", "u")

    def __init__(self):
        self.m, self.r, self.a, self.u = [], [], [], []

    def push(self, m, r):
        self.m.append(m)
        self.r.append(r)
        self.a.append(abs(m))
        self.u.append(abs(m) + r)


class Flow:
    """The orbit that begins in a state, as series in s/h, and bounds of what is left out. The ball: k, J, P bits."""

    def __init__(self, k, moments, bits):
        self.bits, self.one = bits, 1 << bits
        inverse_k = 1 / k
        self.inverse_k, self.factor = self.fixed(inverse_k), self.fixed(1 - k * 2)
        self.trace = self.fixed(interval(sum(moments)))
        self.size_factor, self.size_inverse_k = self.up((1 - k * 2).size()), self.up(inverse_k.size())

    def fixed(self, x):
        low = (x.lo.numerator << self.bits) // x.lo.denominator
        high = -((-x.hi.numerator << self.bits) // x.hi.denominator)
        m = (low + high) >> 1
        return m, max(m - low, high - m)

    def up(self, x):
        return -((-x.numerator << self.bits) // x.denominator)

    def back(self, m, r):
        return Interval(Q(m - r, self.one), Q(m + r, self.one))

    def times(self, a, b):
        return (a[0] * b[0]) >> self.bits, ((abs(a[0]) * b[1] + a[1] * (abs(b[0]) + b[1])) >> self.bits) + 2

    def over(self, a, b):
        """a/b, b > 0 and away from 0."""
        low = b[0] - b[1]
        need(low > 0, "q is not above 0 in a step")
        m = (a[0] << self.bits) // b[0]
        return m, (a[1] * self.one + (abs(m) + 1) * b[1]) // low + 2

    def product(self, a, b, n):
        """Coefficient n of the product of two series."""
        m = sum(map(mul, a.m[: n + 1], b.m[n::-1]))
        r = sum(map(mul, a.u[: n + 1], b.r[n::-1])) + sum(map(mul, a.r[: n + 1], b.a[n::-1]))
        return m >> self.bits, (r >> self.bits) + 2

    def quotient(self, top, q, c, n):
        """Coefficient n of c = top/q, from those before."""
        m, r = top
        if n > 0:
            m -= sum(map(mul, q.m[1 : n + 1], c.m[n - 1 :: -1])) >> self.bits
            error = sum(map(mul, q.u[1 : n + 1], c.r[n - 1 :: -1])) + sum(map(mul, q.r[1 : n + 1], c.a[n - 1 :: -1]))
            r += (error >> self.bits) + 2
        return self.over((m, r), (q.m[0], q.r[0]))

    def expand(self, state, h, small):
        """Series of the state's numbers and of what follows from them, till terms are below `small`."""
        self.h = h = self.fixed(interval(h))
        names = "q r p f d g w z y1 v1 y2 v2 y3 v3".split()[: len(state)]
        s = self.series = {name: Series() for name in names + "kappa e twist rho eta square H".split()}
        self.names = names
        for name, x in zip(names, state):
            s[name].push(*self.fixed(x))
        last = self.one
        for n in range(TERMS):
            rates = self.rates(n)
            top = 0
            for name, (m, r) in rates.items():
                m, r = self.times((m, r), h)
                s[name].push(m // (n + 1), r // (n + 1) + 2)
                top = max(top, abs(m))
            if n > 8 and top < small and last < small:
                break
            last = top
        self.follow(n + 1)
        self.order = n + 1
        self.bound()

    def follow(self, n):
        """Coefficient n of the series that follow."""
        s = self.series
        q, p, f = s["q"], s["p"], s["f"]
        m, r = -q.m[n] - f.m[n], q.r[n] + f.r[n]
        if n == 0:
            m, r = m + self.trace[0], r + self.trace[1]
        s["e"].push(m, r)
        s["twist"].push(m - f.m[n], r + f.r[n])
        m, r = self.times((p.m[n], p.r[n]), self.inverse_k)
        s["kappa"].push(*self.quotient((-m, r), q, s["kappa"], n))
        if len(self.names) == 8:
            return
        for name, top in (("rho", (s["r"].m[n], s["r"].r[n])), ("eta", (s["e"].m[n] - q.m[n], s["e"].r[n] + q.r[n]))):
            s[name].push(*self.quotient(self.times(top, self.inverse_k), q, s[name], n))
        square = self.product(s["kappa"], s["kappa"], n)
        s["square"].push(*square)
        part = self.times(square, self.factor)  # H = 1 + (1 - 2 k) kappa^2 + (e - q)/(k q)
        m, r = part[0] + s["eta"].m[n], part[1] + s["eta"].r[n]
        if n == 0:
            m += self.one
        s["H"].push(m, r)

    def rates(self, n):
        """Coefficient n of the derivatives."""
        self.follow(n)
        s = self.series
        at = {name: (s[name].m[n], s[name].r[n]) for name in self.names}
        kappa = s["kappa"]
        by = {name: self.product(kappa, s[name], n) for name in ("p", "r", "d", "twist", "z", "w")}

        def total(*terms):  # (factor, number)
            return sum(c * x[0] for c, x in terms), sum(abs(c) * x[1] for c, x in terms)

        rate = {
            "q": total((2, at["r"])),
            "r": total((1, at["f"]), (-1, at["q"]), (1, by["p"])),
            "p": total((1, at["d"]), (-1, by["r"])),
            "f": total((2, by["d"]), (-2, at["r"])),
            "d": total((1, by["twist"]), (-1, at["p"])),
            "g": at["w"],
            "w": total((1, by["z"]), (-1, at["g"])),
            "z": total((-1, by["w"])),
        }
        for y, v in self.neighbours():
            rate[y] = at[v]
            pull, push = self.product(s["H"], s[y], n), self.product(s["rho"], s[v], n)
            other = self.times((kappa.m[n], kappa.r[n]), self.inverse_k) if y == "y3" else (0, 0)
            rate[v] = total((1, push), (-1, pull), (-1, other))
        return rate

    def neighbours(self):
        return list(zip(self.names[8::2], self.names[9::2]))

    # What is left out. Let t be numbers >= 0, one for each series, and T_N the sums of |coefficients n|, K < n <= N.
    # By the recurrences T_N+1 <= Phi(T_N), Phi growing. If Phi(t) <= t, then T_N <= t for all N: the series converge
    # for |s| <= h, they are the orbit, and t bounds what is left out.

    def bound(self):
        K = self.order
        s = self.series
        sums = {name: sum(x.u) for name, x in s.items()}

        def beyond(a, b, first):
            """Sum over i, j <= K, i + j >= first, of |a_i b_j|."""
            after, total = 0, 0
            u, v = s[a].u, s[b].u
            for i in range(first - K, K + 1):
                after += v[first - i] if first - i <= K else 0
                if i >= 0:
                    total += u[i] * after
            return (total >> self.bits) + 1

        pairs = [("kappa", x) for x in ("p", "r", "d", "twist", "z", "w")]
        for y, v in self.neighbours():
            pairs += [("H", y), ("rho", v)]
        known = {pair: beyond(*pair, K) for pair in pairs}
        squared = beyond("kappa", "kappa", K + 1) if len(self.names) > 8 else 0
        divided = {c: beyond("q", c, K + 1) for c in ("kappa", "rho", "eta")[: 3 if len(self.names) > 8 else 1]}
        lowest = s["q"].m[0] - s["q"].r[0]
        rest_q = sums["q"] - s["q"].u[0]

        def times(a, b):
            return ((a * b) >> self.bits) + 1

        def after(a, b, t):  # of a product: the sum from K on
            return known[a, b] + times(t[a], sums[b] + t[b]) + times(sums[a], t[b])

        def phi(t):
            new = {}
            new["e"] = t["q"] + t["f"]
            new["twist"] = new["e"] + t["f"]
            for c, top in (("kappa", t["p"]), ("rho", t["r"]), ("eta", new["e"] + t["q"])):
                if c not in divided:
                    continue
                free = lowest - rest_q - t["q"]
                need(free > 0, "a step is too long")
                above = times(top, self.size_inverse_k) + divided[c] + times(t["q"], sums[c])
                new[c] = (above << self.bits) // free + 1
            if "rho" in divided:
                new["square"] = squared + 2 * times(t["kappa"], sums["kappa"]) + times(t["kappa"], t["kappa"])
                new["H"] = times(new["square"], self.size_factor) + t["eta"]
            u = {name: s[name].u[K] + t[name] for name in s if s[name].u}
            rate = {
                "q": 2 * u["r"],
                "r": u["f"] + u["q"] + after("kappa", "p", t),
                "p": u["d"] + after("kappa", "r", t),
                "f": 2 * after("kappa", "d", t) + 2 * u["r"],
                "d": after("kappa", "twist", t) + u["p"],
                "g": u["w"],
                "w": after("kappa", "z", t) + u["g"],
                "z": after("kappa", "w", t),
            }
            for y, v in self.neighbours():
                rate[y] = u[v]
                rate[v] = after("H", y, t) + after("rho", v, t)
                rate[v] += times(u["kappa"], self.size_inverse_k) if y == "y3" else 0
            step = abs(self.h[0]) + self.h[1]
            for name, x in rate.items():
                new[name] = times(x, step) // (K + 1) + 1
            return new

        t = {name: 0 for name in s if s[name].u}
        for _ in range(60):
            new = phi(t)
            if all(new[name] <= t[name] for name in new):
                self.tail = t
                return
            t = {name: max(t[name], new[name] + (new[name] >> 3) + 1) for name in t}
        raise Refused("what is left out of a series was not bounded")

    def at(self, name, time):
        """A number of the state at s = time h; time: an interval in [0, 1]."""
        need(0 <= time.lo and time.hi <= 1, "a time outside of its step")
        s, tail = self.series[name], self.tail[name]
        if time.lo == time.hi == 1:
            return self.back(sum(s.m), sum(s.r) + tail)
        t = self.fixed(time)
        m, r = 0, 0
        for c, error in zip(reversed(s.m), reversed(s.r)):
            m, r = self.times((m, r), t)
            m, r = m + c, r + error
        return self.back(m, r + tail)

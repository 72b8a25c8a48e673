"""check.py CERTIFICATE - verifies a certificate of `isoroll prove`, from the file alone.

The format, and what each line claims, stand in lib/doc/prove.md. This program shares no code with the library, and
has an arithmetic of its own: steps are checked in fixed point (flow.py), all else by exact fractions (intervals.py).

The exit status is 0 if all holds, 1 if not: the line that does not hold is told.
"""
import sys
from fractions import Fraction as Q

from mpmath import iv

from flow import Flow
from intervals import (Interval, Refused, ball, both, circle, interval, inverse, matrix_on, matrix_times, need, of_iv,
                       root)

# --- the file -----------------------------------------------------------------------------------------------------


class Lines:
    def __init__(self, text):
        self.lines = [(i, line.split()) for i, line in enumerate(text.split("\n"), 1) if line and line[0] != "#"]
        self.at = 0

    def number(self):
        """Of the line that was read last."""
        return self.lines[max(self.at - 1, 0)][0] if self.lines else 0

    def next(self):
        return self.lines[self.at][1][0] if self.at < len(self.lines) and self.lines[self.at][1] else ""

    def words(self, word, count=None):
        need(self.next() == word, f"'{word}' is missing")
        words = self.lines[self.at][1][1:]
        need(count is None or len(words) == count, f"'{word}' has {len(words)} numbers")
        self.at += 1
        return words

    def balls(self, word, count):
        words = self.words(word, 4 * count)
        return [ball(words[4 * i : 4 * i + 4]) for i in range(count)]


def least_radius(states):
    radii = [(x.hi - x.lo) / 2 for state in states for x in state if x.hi > x.lo]
    return min(radii) if radii else Q(1, 1 << 200)


class Checker:
    def __init__(self, cache=None):
        self.cache = set() if cache is None else cache  # steps that were verified, by all that they depend on
        self.steps = 0

    def run(self, text):
        self.file = Lines(text)
        try:
            return self.certificate()
        except Refused as refused:
            raise Refused(f"line {self.file.number()}: {refused}") from None
        except (ValueError, IndexError, KeyError, ZeroDivisionError, OverflowError) as error:
            raise Refused(f"line {self.file.number()}: {error!r}") from None

    # --- a half return

    def angle(self, part):
        """cos and sin of part pi/parts."""
        exact = {Q(0): (1, 0), Q(1, 2): (0, 1), Q(1): (-1, 0)}.get(Q(part, self.parts))
        if exact:
            return interval(exact[0]), interval(exact[1])
        turn = iv.pi * part / self.parts
        return of_iv(iv.cos(turn)), of_iv(iv.sin(turn))

    @staticmethod
    def turn(state, c, s):
        """gamma and u turned about b: q, r, p, f, d, g, w."""
        q, r, p, f, d, g, w, z = state[:8]
        to, of = q * c + r * s, r * c + f * s  # (gamma, J gamma_0), (gamma, J u_0)
        back, on = r * c - q * s, f * c - r * s
        return [to * c + of * s, back * c + on * s, p * c + d * s, on * c - back * s, d * c - p * s,
                g * c + w * s, w * c - g * s, z]

    def chart(self, l, x, count, part, k):
        """The state at (l, x) and an angle."""
        Ja, Jb, Jc = self.moments
        need(x.lo > -1 and x.hi < 1, "x is not in (-1, 1)")
        c2, s2 = circle(l * 2)
        X = root(1 - x.square())
        A, half = s2 * ((Ja - Jb) / 2), c2 * ((Ja - Jb) / 2)
        q, T = half + (Ja + Jb) / 2, (Ja + Jb) / 2 - half
        state = [q, -x * A, -X * A, x.square() * (T - Jc) + Jc, x * X * (T - Jc), interval(0), X, -x]
        c, s = self.angle(part)
        if part:
            state = self.turn(state, c, s)
        if count == 8:
            return state
        kappa = -state[2] / (k * state[0])
        return state + [X * c, -kappa * x - X * s, s / X, c / X, interval(0), interval(0)][: count - 8]

    def flow(self, bits, start, h, k):
        flow = Flow(k, self.moments, bits)
        flow.expand(start, h, 1 << 12)
        return flow

    def step(self, bits, start, h, end, k):
        """The orbits of `start` are in `end` after h: by one step, or by shorter ones."""
        for cuts in (1, 2, 4):
            state = start
            try:
                for _ in range(cuts):
                    flow = self.flow(bits, state, h / cuts, k)
                    state = [flow.at(name, interval(1)) for name in flow.names]
            except Refused:
                continue
            if all(b.holds(a) for a, b in zip(state, end)):
                return
        raise Refused("a step leads out of its state")

    def half(self, name, part, l_holds, x_holds):
        """Reads and checks one, or a part of one. l_holds, x_holds: what its l and x must hold. Gives what it has."""
        file = self.file
        need(file.words("half", 1) == [name], f"not 'half {name}'")
        count = {"centre": 8, "cone": 12, "set": 12 if self.parts == 1 else 14}[name]
        k = self.middle if name == "centre" else self.k
        (l,), (x,) = file.balls("l", 1), file.balls("x", 1)
        need(l.holds(l_holds) and x.holds(x_holds), f"the set of 'half {name}' is too small")
        begin = file.at
        state = file.balls("state", count)
        chart = self.chart(l, x, count, part, k)
        need(all(a.holds(b) for a, b in zip(state, chart)), "the first state is not that of the chart")
        # how many bits: those of the smallest radius of this half return, and some more
        states, at = [], begin
        while at < len(file.lines) and file.lines[at][1][0] in ("state", "step"):
            words = file.lines[at][1][1:]
            if file.lines[at][1][0] == "state":
                states.append([ball(words[i : i + 4]) for i in range(0, len(words), 4)])
            at += 1
        radius = least_radius(states)
        bits = max(64, radius.denominator.bit_length() - radius.numerator.bit_length()) + 40
        time = Q(0)
        while True:
            line = file.at
            h = file.balls("step", 1)[0].exact()
            need(h > 0, "a step that is not positive")
            if file.next() != "state":
                break
            after = file.balls("state", count)
            words = tuple(tuple(file.lines[i][1]) for i in (line - 1, line, line + 1))
            key = k.lo, k.hi, self.moments, bits, words
            if key not in self.cache:
                self.step(bits, state, h, after, k)
                self.cache.add(key)
            self.steps += 1
            state, time = after, time + h
        return self.crossing(self.angle(part + 1), bits, state, h, time, count, k)

    def crossing(self, angle, bits, state, h, time, count, k):
        """The last step: window, zero, the state at the end, (l, x) there, the derivative."""
        file = self.file
        flow = self.flow(bits, state, h, k)
        (window,), (zero,) = file.balls("window", 1), file.balls("zero", 1)
        need(0 < window.lo and window.hi < h and window.holds(zero), "the window is not in the step")
        c, s = angle

        def ahead(time):
            return flow.at("w", time * (1 / h)) * s - flow.at("g", time * (1 / h)) * c

        def slope(time):
            g, w, p, q, z = (flow.at(key, time * (1 / h)) for key in "gwpqz")
            return (-p / (k * q) * z - g) * s - w * c

        need(slope(window).hi < 0, "the angle does not grow in the window")
        need(ahead(interval(window.lo)).lo > 0 > ahead(interval(window.hi)).hi, "no orbit crosses in the window")
        middle = zero.middle()
        value, found = ahead(interval(middle)), window
        for _ in range(4):  # Newton's method with intervals, from the window
            better = interval(middle) - value / slope(found)
            found = Interval(max(found.lo, better.lo), min(found.hi, better.hi))
            need(found.lo <= found.hi, "no crossing")
        need(zero.holds(found), "the crossing is not in 'zero'")
        end = file.balls("state", count)
        for i, key in enumerate(flow.names):
            there = interval(0) if key == "g" and s.lo == s.hi == 0 else flow.at(key, zero * (1 / h))
            need(end[i].holds(there), f"the state at the crossing: {key}")
        q, _, p, _, _, _, X, z = self.turn(end, c, -s)
        need(X.lo > 0, "it may be the antipode of the end")
        Ja, Jb, _ = self.moments
        to = file.balls("to", 2)
        sine, cosine = p * -2 / (X * (Ja - Jb)), (q * 2 - (Ja + Jb)) / (Ja - Jb)
        need(to[0].hi - to[0].lo < Q(3, 2), "'to' is too wide in l")
        need(-0.8 < to[0].lo and to[0].hi < 2.4, "'to' has l outside of (-pi/4, 3 pi/4)")
        for end_of, sign in ((to[0].lo, 1), (to[0].hi, -1)):  # (cosine, sine) is between the two directions
            cos, sin = circle(interval(2 * end_of))
            need(((sine * cos - cosine * sin) * sign).lo >= 0, "'to' does not hold l")
        cos, sin = circle(interval(2 * to[0].middle()))
        need((cosine * cos + sine * sin).lo > 0, "'to' does not hold l")
        need(to[1].holds(-z), "'to' does not hold x")
        result = {"to": to, "window": window + time, "zero": zero + time}
        if count > 8:
            kappa_x = end[2] * z / (k * end[0])
            d = []
            for y, v in zip(end[8::2], end[9::2]):
                dl = (y * c - v * s) / (X + kappa_x * s)
                d.append((dl, X * (y * s + c * (v + kappa_x * dl))))
            D = file.balls("derivative", count - 8)
            found = (d[0][0], d[1][0], d[0][1], d[1][1], *(d[2] if count > 12 else ()))
            need(all(a.holds(b) for a, b in zip(D, found)), "the derivative")
            result["D"], result["E"] = [D[:2], D[2:4]], D[4:]
        return result

    # --- the claim, and what it rests on

    def certificate(self):
        file = self.file
        need(file.words("isoroll") == ["certificate", "1"], "not 'isoroll certificate 1'")
        A, B = (Q(word) for word in file.words("k", 2))
        need(A <= B and (A > 0 or B < 0), "k")
        self.k = self.middle = Interval(A, B)
        self.parts = 1
        if A < B:
            self.middle = interval(file.balls("middle", 1)[0].exact())
            need(self.k.holds(self.middle), "middle")
            self.parts = int(file.words("parts", 1)[0])
            need(2 <= self.parts <= 1000, "parts")
        self.change = self.k - self.middle if A < B else interval(0)
        self.moments = Ja, Jb, Jc = tuple(Q(word) for word in file.words("moments", 3))
        need(min(self.moments) > 0, "moments that are not positive")
        need(Ja < Jb < Jc if A > 0 else Ja > Jb > Jc, "the order of the moments")
        need(file.words("section", 1)[0] in ("1", "2", "3"), "section")
        need(int(file.words("digits", 1)[0]) > 0, "digits")
        (m,), (x,) = file.balls("m", 1), file.balls("x", 1)
        sign = file.words("sign", 1)[0]
        need(sign in ("positive", "negative", "undecided"), "sign")
        need(sign != "positive" or m.lo > 0, "m is not positive")
        need(sign != "negative" or m.hi < 0, "m is not negative")
        self.precision()
        s, R = self.cone()
        self.piece(s, R, m, x)
        need(file.words("end", 0) == [] and file.at == len(file.lines), "lines after 'end'")
        return m, x, sign

    def precision(self):
        """Of mpmath: more digits than any ball of the file has."""
        lines = (line for _, line in self.file.lines if line[0] in ("state", "x", "l"))
        most = max((-int(word, 16) for line in lines for word in line[4::4]), default=0)
        need(most < 1 << 14, "too many digits")
        iv.prec = most + 120

    def cone(self):
        file = self.file
        s = file.balls("frame-o", 1)[0].exact()
        R = file.balls("size", 1)[0].exact()
        need(s != 0 and R > 0, "frame or size")
        wide = Interval(-2 * R, 2 * R)
        z, D = [wide, wide * s], [[interval(1), interval(0)], [interval(0), interval(1)]]
        for part in range(self.parts):  # O is at (0, 0) at each angle
            by = self.half("cone", part, *z)["D"]
            z, D = matrix_on(by, z), matrix_times(by, D)
        self.alpha = alpha = file.balls("cone", 1)[0].exact()
        A = [[Q(1), Q(1)], [s, -s]]
        (a, b), (c, d) = matrix_times(inverse(A), matrix_times(D, [[interval(v) for v in row] for row in A]))
        rest = a.lo - b.size() * alpha
        need(0 < alpha < 1 and rest > 1, "the cone: |xi| does not grow")
        need(c.size() + d.size() * alpha < alpha * rest, "the cone is not kept")
        return s, R

    def frame(self):
        file = self.file
        centre = [v.exact() for v in file.balls("centre", 2)]
        drift = [v.exact() for v in file.balls("drift", 2)] if self.parts > 1 else [Q(0), Q(0)]
        a = [v.exact() for v in file.balls("frame", 4)]
        parts = [file.balls(word, 2) for word in ("hull", "left", "right")]
        return centre, drift, [a[:2], a[2:]], parts, file.balls("sigma", 1)[0]

    def first(self, s, R):
        centre, drift, A, parts, sigma = self.frame()
        hull, left, right = parts
        X0, change = centre[0], self.change.size() * abs(drift[0])
        need(centre[1] == s * X0 and drift[1] == s * drift[0] and A == [[1, 1], [s, -s]], "the first frame")
        least, most = max(right[0].lo, -left[0].hi), min(right[0].hi, -left[0].lo, R - X0 - change)
        room = X0 - change
        need(0 < most and least <= most and least < room, "the piece is not in the cone")
        W = most if most < room else max(least, room / 2)
        need(0 < W < room and X0 + change + W <= R and right[0].holds(W) and left[0].holds(-W), "the ends of the first piece")
        need(hull[0].holds(Interval(-W, W)), "the hull of the first piece")
        high = self.alpha * (X0 + change + W)
        need(all(part[1].holds(Interval(-high, high)) for part in parts), "the first piece may be higher")
        need(sigma.holds(Interval(-self.alpha, self.alpha)), "the first piece may be steeper")
        return centre, drift, A, parts, sigma

    def piece(self, s, R, m, x):
        file = self.file
        centre, drift, A, parts, sigma = self.first(s, R)
        part = 0
        while file.next() == "half":
            frame = [[interval(v) for v in row] for row in A]
            l, y = self.place(centre, drift, frame, parts[0])
            fat = self.half("set", part, both(l, interval(centre[0])), both(y, interval(centre[1])))
            thin = self.half("centre", part, interval(centre[0]), interval(centre[1]))
            part = (part + 1) % self.parts
            need(fat["window"].holds(thin["zero"]), "the centre crosses outside of the window of the set")
            last, last_sigma, last_drift = parts, sigma, drift
            centre, drift, A, parts, sigma = self.frame()
            back = inverse(A)
            B = matrix_times(back, matrix_times(fat["D"], frame))
            offset = [a - b for a, b in zip(thin["to"], centre)]
            if self.parts > 1:
                image = [a + b for a, b in zip(matrix_on(fat["D"], last_drift), fat["E"])]
                offset = [a + (b - c) * self.change for a, b, c in zip(offset, image, drift)]
            o = matrix_on(back, offset)
            for word, old, new in zip(("hull", "left", "right"), last, parts):
                image = [a + b for a, b in zip(matrix_on(B, old), o)]
                need(all(a.holds(b) for a, b in zip(new, image)), f"'{word}' is not carried along")
            need((B[0][0] + B[0][1] * last_sigma).lo > 0, "the piece turns back")
            need(sigma.holds(self.tangent(B, last_sigma)), "the tangent is not carried along")
        need(part == 0, "a part of half a return is left over")
        half_pi = of_iv(iv.pi / 2)
        A = [[interval(v) for v in row] for row in A]
        ends = [self.place(centre, drift, A, v)[0] for v in parts[1:]]
        need(ends[0].hi < half_pi.lo and ends[1].lo > half_pi.hi, "the piece does not cross l = pi/2")
        need((A[0][0] + A[0][1] * sigma).lo > 0, "l does not grow along the piece")
        need(m.holds(self.tangent(A, sigma)), "m")
        need(x.holds(self.place(centre, drift, A, parts[0])[1]), "x")

    def place(self, centre, drift, A, v):
        return [a + b + self.change * c for a, b, c in zip(matrix_on(A, v), centre, drift)]

    @staticmethod
    def tangent(B, sigma):
        """(B21 + B22 sigma)/(B11 + B12 sigma), whose numbers are independent; in sigma it is monotone."""
        values = [(B[1][0] + B[1][1] * end) / (B[0][0] + B[0][1] * end) for end in (sigma.lo, sigma.hi)]
        return both(*values)


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    with open(sys.argv[1], encoding="ascii") as file:
        text = file.read()
    checker = Checker()
    try:
        m, _, sign = checker.run(text)
    except Refused as refused:
        print(f"refused: {refused}")
        return 1
    error = float((m.hi - m.lo) / 2)
    print(f"verified: {checker.steps} steps; m is in {float(m.middle()):.17g} +- {error:.2g}: {sign}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""third_variation.py N... - the residue rho of the third variation for odd 1/k, exactly.

See lib/doc/why_only_one.md, step 8. For each odd N given, and for -N, it is shown that rho is not 0, whatever the
three different moments: with J3 = a, J2 = a + b, J1 = a + b + c, rho is b c times a polynomial in a, b, c whose
coefficients all have one sign, over powers of J2 and of J1 - J3. (J1 and J3 can change places.) Only whole fractions
are used.

Polynomials in m and J, the numbers (J1 + J3)/2 and J2 by (J1 - J3)/4, are dicts {(power of m, power of J): fraction}.
A series is a pair (s, c): x^s (c[0] + c[1] x + ...).
"""
import sys
from fractions import Fraction as Q
from math import comb


def add(p, q):
    out = dict(p)
    for e, c in q.items():
        out[e] = out.get(e, 0) + c
    return {e: c for e, c in out.items() if c}


def times(p, q):
    out = {}
    for (i, j), a in p.items():
        for (k, l), b in q.items():
            out[i + k, j + l] = out.get((i + k, j + l), 0) + a * b
    return {e: c for e, c in out.items() if c}


def scale(p, a):
    return {e: a * c for e, c in p.items()} if a else {}


def number(a):
    return {(0, 0): Q(a)} if a else {}


M, J = {(1, 0): Q(1)}, {(0, 1): Q(1)}


def product(f, *more):
    for g in more:
        length = len(f[1])
        c = [{} for _ in range(length)]
        for i, a in enumerate(f[1]):
            for j in range(length - i):
                if a and g[1][j]:
                    c[i + j] = add(c[i + j], times(a, g[1][j]))
        f = f[0] + g[0], c
    return f


def total(f, *more):
    for g in more:
        low, high = (f, g) if f[0] <= g[0] else (g, f)
        shift = high[0] - low[0]
        assert shift.denominator == 1
        c = [add(low[1][i], high[1][i - int(shift)] if i >= shift else {}) for i in range(len(low[1]))]
        f = low[0], c
    return f


def by(a, f):
    """a: a fraction or a polynomial."""
    return f[0], [times(a, c) if isinstance(a, dict) else scale(c, a) for c in f[1]]


def slope(f):
    return f[0] - 1, [scale(c, f[0] + i) for i, c in enumerate(f[1])]


def inverse(f):
    """The first coefficient is a number."""
    first = 1 / f[1][0][0, 0]
    c = [number(first)]
    for i in range(1, len(f[1])):
        s = {}
        for j in range(1, i + 1):
            s = add(s, times(f[1][j], c[i - j]))
        c.append(scale(s, -first))
    return -f[0], c


def residues(n):
    """What z^3 adds to z, and p z^2 to p, in units of 4 pi i, for n < 0 times J. p^3 and p^2 z add nothing."""
    length, sign = abs(n) + 2, 1 if n > 0 else -1

    def series(*c):
        return Q(0), list(c) + [{}] * (length - len(c))

    zeros = series(number(sign), M, number(sign))                  # Q
    turn = series(number(2), {}, number(-2))                       # 2 - 2 x^2
    pull = series(add(M, scale(J, -1)), number(2))                 # m - J + 2 x
    x = Q(1), series(number(1))[1]
    upside = inverse(x)

    def solution(s):
        """x Q y'' + (n/4) (turn y' + pull y) = 0, y = x^s (1 + ...)."""
        c = [number(1)]
        for r in range(1, length):
            t = scale(times(M, c[r - 1]), (s + r - 1) * (s + r - 2))
            t = add(t, scale(times(pull[1][0], c[r - 1]), Q(n, 4)))
            if r > 1:
                t = add(t, scale(c[r - 2], sign * (s + r - 2) * (s + r - 3) - Q(n, 2) * (s + r - 2) + Q(n, 2)))
            c.append(scale(t, -1 / ((s + r) * (sign * (s + r - 1) + Q(n, 2)))))
        return s, c

    p, z = solution(Q(0)), solution(1 - Q(abs(n), 2))
    over = inverse(zeros)
    weight = inverse(total(product(p, slope(z)), by(Q(-1), product(slope(p), z))))  # by the Wronskian

    def cubic(a, b, c):
        """The cubic terms of Y'', linear in the first place: n (turn a' + pull a)/(x Q) {...}(b, c)."""
        db, dc, bc = slope(b), slope(c), product(b, c)
        if n > 0:  # x Y'^2 - Y Y' + Y^2/(4 x) + J Y^2/(4 Q)
            mixed = by(Q(-1, 2), total(product(b, dc), product(db, c)))
            t = total(product(x, db, dc), mixed, by(Q(1, 4), product(bc, upside)),
                      by(scale(J, Q(1, 4)), product(bc, over)))
        else:  # J times: (m (x Y' - Y) Y' - (x Y' - Y)^2 - Y'^2)/J + Y^2/(4 x) + (m^2 - 4) Y^2/(4 J Q)
            eb, ec = (total(product(x, slope(f)), by(Q(-1), f)) for f in (b, c))
            mixed = by(scale(M, Q(1, 2)), total(product(eb, dc), product(db, ec)))
            t = total(mixed, by(Q(-1), product(eb, ec)), by(Q(-1), product(db, dc)),
                      by(scale(J, Q(1, 4)), product(bc, upside)),
                      by(scale(add(times(M, M), number(-4)), Q(1, 4)), product(bc, over)))
        line = total(product(turn, slope(a)), product(pull, a))
        return by(Q(n), product(line, upside, over, t))

    def residue(f):
        at = -1 - f[0]
        assert at.denominator == 1 and at < length
        return f[1][int(at)] if at >= 0 else {}

    once = total(cubic(p, z, z), by(Q(2), cubic(z, p, z)))
    twice = total(cubic(z, p, p), by(Q(2), cubic(p, p, z)))
    none = residue(product(p, twice, weight)) or residue(product(z, cubic(p, p, p), weight))
    assert not none, "p^2 z or p^3 adds something"
    return residue(product(p, cubic(z, z, z), weight)), residue(by(Q(-1), product(z, once, weight)))


def in_gaps(p):
    """p by a, b, c, times a power of d = (b + c)/4: {(powers of a, b, c): fraction}."""
    degree = max(i + j for i, j in p)
    out = {}
    for (i, j), value in p.items():  # (a + 2 d)^i (a + b)^j d^(degree - i - j)
        for u in range(i + 1):
            for v in range(j + 1):
                d = degree - j - u
                for w in range(d + 1):
                    e = u + v, j - v + w, d - w
                    many = comb(i, u) * 2 ** (i - u) * comb(j, v) * comb(d, w)
                    out[e] = out.get(e, 0) + value * many * Q(1, 4 ** d)
    return {e: c for e, c in out.items() if c}


def text(p):
    return " + ".join(f"({c}) m^{i} J^{j}" for (i, j), c in sorted(p.items()))


def main():
    good = True
    for n in [sign * int(word) for word in sys.argv[1:] for sign in (1, -1)]:
        assert n % 2, "odd numbers only"
        rho, other = residues(n)
        paired = not add(other, scale(rho, 3))
        if abs(n) == 1:
            right, what = not rho, "rho = 0"
        else:
            gaps = in_gaps(rho)
            signs = {c > 0 for c in gaps.values()}
            right = len(signs) == 1 and all(b > 0 and c > 0 for _, b, c in gaps)
            what = f"rho = b c times {len(gaps)} terms of {'one sign' if right else 'DIFFERENT SIGNS'}"
        if abs(n) == 3:
            what += "; rho = " + text(rho) + (" by J" if n < 0 else "")
        good = good and right and paired
        print(f"1/k = {n}: {what}; p z^2: {'-3 rho' if paired else 'NOT -3 rho'}", flush=True)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())

"""intervals.py - intervals of exact fractions, for check.py. Sines, cosines, roots and pi come from mpmath's `iv`."""
from fractions import Fraction as Q

from mpmath import iv


class Refused(Exception):
    pass


def need(condition, what):
    if not condition:
        raise Refused(what)


class Interval:
    __slots__ = ("lo", "hi")

    def __init__(self, lo, hi=None):
        self.lo, self.hi = lo, lo if hi is None else hi

    def __add__(self, other):
        other = interval(other)
        return Interval(self.lo + other.lo, self.hi + other.hi)

    def __neg__(self):
        return Interval(-self.hi, -self.lo)

    def __sub__(self, other):
        return self + -interval(other)

    def __mul__(self, other):
        other = interval(other)
        ends = [a * b for a in (self.lo, self.hi) for b in (other.lo, other.hi)]
        return Interval(min(ends), max(ends))

    def __truediv__(self, other):
        other = interval(other)
        need(other.lo > 0 or other.hi < 0, "a division by an interval that holds 0")
        return self * Interval(1 / other.hi, 1 / other.lo)

    __radd__, __rmul__ = __add__, __mul__

    def __rsub__(self, other):
        return interval(other) - self

    def __rtruediv__(self, other):
        return interval(other) / self

    def square(self):
        low = Q(0) if self.lo <= 0 <= self.hi else min(self.lo**2, self.hi**2)
        return Interval(low, max(self.lo**2, self.hi**2))

    def holds(self, other):
        other = interval(other)
        return self.lo <= other.lo and other.hi <= self.hi

    def size(self):
        return max(abs(self.lo), abs(self.hi))

    def exact(self):
        need(self.lo == self.hi, "a number that should be exact")
        return self.lo

    def middle(self):
        return (self.lo + self.hi) / 2


def interval(x):
    return x if isinstance(x, Interval) else Interval(Q(x))


def both(a, b):
    return Interval(min(a.lo, b.lo), max(a.hi, b.hi))


def of_iv(x):
    """The ends of a number of mpmath's `iv`, exactly."""
    ends = []
    for sign, man, exp, _ in x._mpi_:
        need(man or not exp, "a number that is not finite")
        ends.append((-1) ** sign * Q(int(man)) * Q(2) ** int(exp))
    return Interval(*ends)


def to_iv(x):
    return iv.mpf([iv.mpf(x.lo.numerator) / x.lo.denominator, iv.mpf(x.hi.numerator) / x.hi.denominator])


def circle(l):
    """cos and sin of an interval."""
    x = to_iv(l)
    return of_iv(iv.cos(x)), of_iv(iv.sin(x))


def root(x):
    return of_iv(iv.sqrt(to_iv(x)))


def ball(words):
    need(len(words) == 4, "a ball is four numbers")
    mantissa, exponent, radius, scale = (int(word, 16) for word in words)
    need(radius >= 0 and max(abs(exponent), abs(scale)) < 1 << 16, "a ball that is none")
    m, r = mantissa * Q(2) ** exponent, radius * Q(2) ** scale
    return Interval(m - r, m + r)


def matrix_times(A, B):
    return [[A[i][0] * B[0][j] + A[i][1] * B[1][j] for j in range(2)] for i in range(2)]


def matrix_on(A, v):
    return [A[i][0] * v[0] + A[i][1] * v[1] for i in range(2)]


def inverse(A):
    """Of exact numbers."""
    det = A[0][0] * A[1][1] - A[0][1] * A[1][0]
    need(det != 0, "a frame without an inverse")
    return [[interval(A[1][1] / det), interval(-A[0][1] / det)], [interval(-A[1][0] / det), interval(A[0][0] / det)]]

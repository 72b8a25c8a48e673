/* crossing_impl.h - where a component of the unit vector passes 0 within a step. */
#include "method/taylor/deviations_impl.h"

/* n_axis at x; *slope: its derivative there, unless NULL. */
static inline real component(const form *T, int axis, real x, real *slope)
{
    real p = zero, dp = zero;
    for (int i = T->S.order + T->is_point; i >= 0; i--) {
        if (slope) dp = dp * x + p;
        p = p * x + AT(T->S.n[i], axis);
    }
    if (slope) *slope = dp;
    return p;
}

/* The zero of n_axis between a (n_axis < 0) and b (n_axis >= 0), by Newton's method, with halving where it leaves the
 * bracket. The error is about the second power of the last change; in s the third, since there n_axis'' = 0 where
 * n_axis = 0. */
static real find_crossing(const form *T, int axis, real a, real at_a, real b, real at_b, mask crosses)
{
    real x = a + (b - a) * (-at_a / (at_b - at_a));
    const real step = magnitude(b - a);
    const NUMBER near = ROOT(EPSILON) / 64;
    mask far = crosses;
    for (int i = 0; i < 60 && any(far); i++) {
        real slope;
        const real g = component(T, axis, x, &slope), next = x - g / slope;
        a = choose(g < zero, x, a);
        b = choose(g < zero, b, x);
        const mask inside = both((next - a) * (next - b) <= zero, next == next);
        const real better = choose(inside, next, (a + b) / 2);
        const real change = magnitude(better - x);
        x = choose(far, better, x);
        far = both(far, change > (NUMBER)near * larger(magnitude(x), step));
    }
    return x;
}

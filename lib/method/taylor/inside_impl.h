/* inside_impl.h - looks inside a step, where the scene writes an effect. Included by step_impl.h.
 *
 * The length of a step comes from the series at its left end. A Gaussian hill, a jump or a wall that lies a part of a
 * radian ahead does not show there: its coefficients are 0, or far below the last digit. A step is taken as it is where
 * it is plain (plain_impl.h). Else it is walked through in parts. In a part the expressions vary by at most 1
 * (iso_inside_variation, intervals over a box around the way), so they have no feature between a few places; at these
 * the series is held against the equations. The step ends before the first part that it gets wrong.
 */
#include "method/taylor/plain_impl.h"

/* The series of one lane in doubles: n (of a point: gamma) and omega (of a point: gamma'). */
typedef struct walk {
    const form *T;
    int lane;
    double n[KEPT][3], w[KEPT][3];
    double bend_n, bend_w; /* |n''| and |w''| are at most so large in the step */
    double h;
} walk;

static void read_series(walk *k)
{
    const form *T = k->T;
    for (int n = 0; n <= T->S.order; n++)
        for (int i = 0; i < 3; i++) {
            k->n[n][i] = (double)LANE(AT(T->S.n[n], i), k->lane);
            k->w[n][i] = T->is_point ? (n + 1) * (double)LANE(AT(T->S.n[n + 1], i), k->lane)
                                     : (double)LANE(AT(T->S.w[n], i), k->lane);
        }
    double power = 1;
    k->bend_n = k->bend_w = 0;
    for (int n = 2; n <= T->S.order; n++, power *= k->h) {
        k->bend_n += n * (n - 1) * length3(k->n[n]) * power;
        k->bend_w += n * (n - 1) * length3(k->w[n]) * power;
    }
}

/* The derivative of a polynomial at x. */
static void slope_of(const double a[][3], int order, double x, double slope[3])
{
    for (int i = 0; i < 3; i++) slope[i] = 0;
    for (int n = order; n > 0; n--)
        for (int i = 0; i < 3; i++) slope[i] = x * slope[i] + n * a[n][i];
}

/* The state at x as the model has it. */
static void place_at(const walk *k, double x, double y[])
{
    const form *T = k->T;
    state s = T->now;
    real at = zero;
    LANE(at, k->lane) = (NUMBER)x;
    channel_at(T, 0, at, &s);
    if (T->has_derived) find_derived(T, &s);
    store(T, k->lane, &s, y);
}

/* How much the expressions vary from a to b. */
static double variation_between(const walk *k, double a, double b)
{
    const form *T = k->T;
    const double x = (a + b) / 2, half = fabs(b - a) / 2;
    double y[ISO_MAX_STATE], dn[3], dw[3];
    place_at(k, x, y);
    slope_of(k->n, T->S.order, x, dn);
    slope_of(k->w, T->S.order, x, dw);
    const double omega = half * (length3(dw) + k->bend_w * half);
    const iso_stretch stretch = {.y = y,
                                 .n = half * (length3(dn) + k->bend_n * half),
                                 .omega = omega,
                                 .e = half * (length3(y) + omega),
                                 .time = k->h};
    return iso_inside_variation(T->inside, T->model[k->lane], &stretch, T->tolerance / 10);
}

/* Whether omega' or M' of the series at x is that of the equations. At the right end of a step the last term alone is
 * `tolerance`, and its derivative `order` times as large. How much may be rounding is seen from the equations for a
 * state that differs in its last digits. */
static bool follows_at(const walk *k, double x)
{
    enum { DIGITS = 16 };
    const form *T = k->T;
    const iso_model *m = T->model[k->lane];
    double y[ISO_MAX_STATE], dy[ISO_MAX_STATE], moved[ISO_MAX_STATE], dy_moved[ISO_MAX_STATE];
    double slope[3], turned[3], off[3], change[3];
    place_at(k, x, y);
    m->own_rhs(m, y, dy);
    slope_of(k->w, T->S.order, x, slope);
    memcpy(turned, slope, sizeof turned);
    if (T->is_point) /* M = gamma' x gamma, M' = gamma'' x gamma */
        for (int i = 0; i < 3; i++)
            turned[i] = slope[(i + 1) % 3] * y[3 + (i + 2) % 3] - slope[(i + 2) % 3] * y[3 + (i + 1) % 3];
    for (int i = 0; i < m->moving; i++) moved[i] = y[i] * (1 + (i % 2 == 0 ? DIGITS : -DIGITS) * DBL_EPSILON);
    m->own_rhs(m, moved, dy_moved);
    for (int i = 0; i < 3; i++) off[i] = turned[i] - dy[i], change[i] = dy_moved[i] - dy[i];
    const double speed = length3(y);
    const double rounding = 4 * length3(change) + 64 * DBL_EPSILON * (length3(turned) + speed / k->h);
    return length3(off) <= 4 * T->S.order * T->tolerance * speed / k->h + rounding;
}

/* How much of a step of length h is right, at most all of it. Where a part fails it is halved, down to an eighth of the
 * way that is behind it. */
static double walk_through(const form *T, int lane, double direction, double h)
{
    enum { MOST_PARTS_WALKED = 1000 }; /* sqrt(x) near x = 0 can need many more; then the step is shorter */
    walk k = {.T = T, .lane = lane, .h = h};
    double passed = 0, part = h;
    if (!(h < INFINITY)) return h;
    read_series(&k);
    for (int i = 0; i < MOST_PARTS_WALKED && passed < h; i++) {
        const double next = fmin(passed + part, h), a = direction * passed, b = direction * next;
        const double variation = variation_between(&k, a, b);
        const bool between = variation == 0 || (variation <= 1 && follows_at(&k, a + 0.3 * (b - a)) &&
                                                follows_at(&k, a + 0.7 * (b - a)));
        if (between && follows_at(&k, b)) {
            passed = next;
            part *= 2;
            continue;
        }
        if (variation <= 1 && passed > 0 && part <= passed / 8) break;
        part /= variation > 4 ? 4 : 2;
        if (part < 1e-14 * h) return fmax(passed, part);
    }
    return passed;
}

/* The step, shortened in the lanes where the series does not follow what the scene writes. */
static real look_inside(const form *T, real direction, real h)
{
    const mask plain = is_plain(T, h);
    if (!any(other(plain))) return h;
    for (int i = 0; i < LANES; i++)
        if (!LANE(plain, i) && !T->idle[i])
            LANE(h, i) = (NUMBER)walk_through(T, i, (double)LANE(direction, i), (double)LANE(h, i));
    return h;
}

/* Whether a step that was taken is too short to lead anywhere (iso_inside_is_lost). */
static inline bool is_lost(const form *T, int lane, double dt)
{
    double y[ISO_MAX_STATE];
    if (!T->inside) return false;
    store(T, lane, &T->now, y);
    return iso_inside_is_lost(T->model[lane], y, dt);
}

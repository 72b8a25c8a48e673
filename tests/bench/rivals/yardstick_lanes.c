/* yardstick_lanes.c - the yardstick of batches (rivals.h): free points side by side, one in each lane of a vector, by
 * Taylor series for these two equations and nothing else. Compiled once for each kind of vectors.
 *
 * Nothing here is clever. The order is a constant of the compilation, all loops are written out by the compiler,
 * squares are computed by halves, and constraints are restored to first order. A lane whose orbit ends takes the next
 * one.
 *
 *     k = -1, in s:   g'' = a (2 q - J) g,  a = -2 eps,  q = (g, J g);  |g'|^2 = 2 eps q;  t' = (det J/k^2) q^(-1/2)
 *     other k, in t:  g'' = (1 + 1/(2k)) r g' + b ((1-k) q^2 - q J) g,  r = q'/q;  |g'|^2 = b k q^2
 */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "rivals.h"

#define ALWAYS static inline __attribute__((always_inline))
#ifdef __clang__
#define WRITTEN_OUT _Pragma("clang loop unroll(full)")
#else
#define WRITTEN_OUT _Pragma("GCC unroll 32")
#endif

enum { MOST = 20, KEPT = MOST + 1, NODES = 6 };

typedef double real __attribute__((vector_size(8 * LANES)));
typedef __typeof__((real){0} < (real){0}) mask;

typedef struct point {
    real g[KEPT][3], w[KEPT][3], x[KEPT][3], q[KEPT], r[KEPT]; /* coefficients */
    real now[6];                                               /* g, g' */
    real J[3], k, a, rate, t;                                  /* rate: of t in s */
    int orbit[LANES];                                          /* -1: none */
} point;

/* Nodes and weights of Gauss and Legendre on [0,1]. */
static const double node[NODES] = {0.033765242898423986, 0.16939530676686774, 0.38069040695840156,
                                   0.61930959304159844,  0.83060469323313226, 0.96623475710157601};
static const double weight[NODES] = {0.085662246189585178, 0.18038078652406930, 0.23395696728634552,
                                     0.23395696728634552,  0.18038078652406930, 0.085662246189585178};

ALWAYS real choose(mask m, real a, real b)
{
    return (real)((m & (mask)a) | (~m & (mask)b));
}

ALWAYS real larger(real a, real b)
{
    return choose(a > b, a, b);
}

ALWAYS real smaller(real a, real b)
{
    return choose(a < b, a, b);
}

ALWAYS real size_of(real a)
{
    return larger(a, -a);
}

ALWAYS real root(real a)
{
    for (int i = 0; i < LANES; i++) a[i] = sqrt(a[i]);
    return a;
}

/* --- coefficients ----------------------------------------------------------------------------------------------- */

/* q_n = sum_i J_i (g_i^2)_n */
ALWAYS void find_q(point *p, const int n)
{
    real sum[3] = {{0}, {0}, {0}};
    WRITTEN_OUT
    for (int j = 0; j < (n + 1) / 2; j++)
        for (int i = 0; i < 3; i++) sum[i] += p->g[j][i] * p->g[n - j][i];
    p->q[n] = (real){0};
    for (int i = 0; i < 3; i++)
        p->q[n] += p->J[i] * (n % 2 != 0 ? 2 * sum[i] : 2 * sum[i] + p->g[n / 2][i] * p->g[n / 2][i]);
}

ALWAYS void in_s(point *p, const int n)
{
    real pull[3] = {{0}, {0}, {0}};
    find_q(p, n);
    WRITTEN_OUT
    for (int j = 0; j <= n; j++)
        for (int i = 0; i < 3; i++) pull[i] += p->q[n - j] * p->g[j][i];
    const real part = p->a * (1.0 / ((n + 1) * (n + 2)));
    for (int i = 0; i < 3; i++) p->g[n + 2][i] = part * (2 * pull[i] - p->J[i] * p->g[n][i]);
}

ALWAYS void in_t(point *p, const int n)
{
    real square = {0}, divided = {0}, drag[3] = {{0}, {0}, {0}}, push[3] = {{0}, {0}, {0}};
    if (n == 0) find_q(p, 0);
    find_q(p, n + 1);
    WRITTEN_OUT
    for (int j = 0; j < (n + 1) / 2; j++) square += p->q[j] * p->q[n - j];
    square = n % 2 != 0 ? 2 * square : 2 * square + p->q[n / 2] * p->q[n / 2];
    for (int i = 0; i < 3; i++) p->x[n][i] = p->a * ((1 - p->k) * square - p->J[i] * p->q[n]);
    WRITTEN_OUT
    for (int j = 1; j <= n; j++) divided += p->q[j] * p->r[n - j];
    p->r[n] = ((n + 1) * p->q[n + 1] - divided) / p->q[0];
    for (int i = 0; i < 3; i++) p->w[n][i] = (n + 1) * p->g[n + 1][i];
    WRITTEN_OUT
    for (int j = 0; j <= n; j++)
        for (int i = 0; i < 3; i++) {
            push[i] += p->x[n - j][i] * p->g[j][i];
            drag[i] += p->r[n - j] * p->w[j][i];
        }
    const real alpha = 1 + 0.5 / p->k;
    for (int i = 0; i < 3; i++) p->g[n + 2][i] = (push[i] + alpha * drag[i]) * (1.0 / ((n + 1) * (n + 2)));
}

ALWAYS void expand(point *p, const int order, const bool s)
{
    for (int i = 0; i < 3; i++) p->g[0][i] = p->now[i], p->g[1][i] = p->now[3 + i];
    WRITTEN_OUT
    for (int n = 0; n < order - 1; n++) s ? in_s(p, n) : in_t(p, n);
}

/* --- steps ------------------------------------------------------------------------------------------------------ */

/* a^(1/n), to some per cent: the bits of a double, read as an integer, are about its logarithm. */
ALWAYS real rough_root(real a, const int n)
{
    const double one = 1;
    int64_t bits[LANES], of_one;
    memcpy(&of_one, &one, sizeof one);
    memcpy(bits, &a, sizeof a);
    for (int i = 0; i < LANES; i++) bits[i] = of_one + (int64_t)((double)(bits[i] - of_one) * (1.0 / n));
    memcpy(&a, bits, sizeof a);
    return a;
}

/* The step for which the last two terms are the tolerance. */
ALWAYS real longest(const point *p, double tolerance, const int order)
{
    const real *last = p->g[order], *before = p->g[order - 1];
    const real a = larger(size_of(last[0]), larger(size_of(last[1]), size_of(last[2])));
    const real b = larger(size_of(before[0]), larger(size_of(before[1]), size_of(before[2])));
    return smaller(rough_root(tolerance / a, order), rough_root(tolerance / b, order - 1));
}

/* The time from 0 to x, and its rate at x. */
ALWAYS real time_to(const point *p, real x, const int order, real *rate)
{
    real q[NODES + 1], sum = {0};
    for (int i = 0; i <= NODES; i++) q[i] = p->q[order - 2];
    WRITTEN_OUT
    for (int n = order - 3; n >= 0; n--) {
        for (int i = 0; i < NODES; i++) q[i] = q[i] * (x * node[i]) + p->q[n];
        q[NODES] = q[NODES] * x + p->q[n];
    }
    for (int i = 0; i < NODES; i++) sum += weight[i] / root(q[i]);
    *rate = p->rate / root(q[NODES]);
    return p->rate * x * sum;
}

/* g and g' at x, with their constraints restored. */
ALWAYS void state_at(const point *p, real x, const int order, const bool s, double eps, real y[6])
{
    for (int i = 0; i < 3; i++) {
        real g = p->g[order][i], w = order * p->g[order][i];
        WRITTEN_OUT
        for (int n = order - 1; n >= 1; n--) g = g * x + p->g[n][i], w = w * x + n * p->g[n][i];
        y[i] = g * x + p->g[0][i], y[3 + i] = w;
    }
    const real part = 0.5 * (y[0] * y[0] + y[1] * y[1] + y[2] * y[2] - 1);
    for (int i = 0; i < 3; i++) y[i] -= part * y[i];
    const real along = y[0] * y[3] + y[1] * y[4] + y[2] * y[5];
    for (int i = 0; i < 3; i++) y[3 + i] -= along * y[i];
    const real q = p->J[0] * y[0] * y[0] + p->J[1] * y[1] * y[1] + p->J[2] * y[2] * y[2];
    const real square = s ? 2 * eps * q : p->a * p->k * q * q;
    const real fast = 0.5 * (y[3] * y[3] + y[4] * y[4] + y[5] * y[5] - square) / square;
    for (int i = 3; i < 6; i++) y[i] -= fast * y[i];
}

/* --- orbits ----------------------------------------------------------------------------------------------------- */

/* d(variable)/ds */
static double pace(const rival_problem *p, const double g[3], bool s)
{
    const double q = p->J[0] * g[0] * g[0] + p->J[1] * g[1] * g[1] + p->J[2] * g[2] * g[2];
    return s ? 1 : p->J[0] * p->J[1] * p->J[2] / (p->k * p->k) * pow(q, -1 - 0.5 / p->k);
}

static void load(point *v, int lane, const rival_problem *p, const double y[6], bool s)
{
    double slope[3];
    rival_cross(y + 3, y, slope);
    const double speed = pace(p, y + 3, s);
    for (int i = 0; i < 3; i++) v->now[i][lane] = y[3 + i], v->now[3 + i][lane] = slope[i] / speed;
    v->t[lane] = 0;
}

static void store(const real y[6], int lane, const rival_problem *p, double to[6], bool s)
{
    const double g[3] = {y[0][lane], y[1][lane], y[2][lane]}, w[3] = {y[3][lane], y[4][lane], y[5][lane]};
    const double speed = pace(p, g, s);
    rival_cross(w, g, to);
    for (int i = 0; i < 3; i++) to[i] *= speed, to[3 + i] = g[i];
}

static void begin(point *v, const rival_problem *p, bool s)
{
    const double factor = p->J[0] * p->J[1] * p->J[2] / (p->k * p->k);
    const real none = {0};
    memset(v, 0, sizeof *v);
    for (int i = 0; i < 3; i++) v->J[i] = p->J[i] - none;
    v->k = p->k - none;
    v->a = (s ? -2 * p->eps : 2 * p->eps / (p->k * factor * factor)) - none;
    v->rate = factor - none;
}

ALWAYS void follow(const rival_problem *p, double tolerance, const int order, const bool s, double end, int count,
                   double y[][6])
{
    point v;
    int next = 0, busy = 0;
    begin(&v, p, s);
    for (int i = 0; i < LANES; i++) {
        v.orbit[i] = next < count ? next : -1;
        load(&v, i, p, y[next < count ? next++ : 0], s);
        busy += v.orbit[i] >= 0;
    }
    while (busy > 0) {
        real to[6], rate, gone;
        bool ends = false;
        expand(&v, order, s);
        const real x = longest(&v, tolerance, order);
        gone = s ? time_to(&v, x, order, &rate) : x;
        for (int i = 0; i < LANES; i++) ends = ends || v.t[i] + gone[i] >= end;
        if (ends) {
            real last = s ? x * ((end - v.t) / gone) : end - v.t;
            for (int pass = 0; pass < 5 && s; pass++) {
                const real t = time_to(&v, last, order, &rate);
                last -= (t - (end - v.t)) / rate;
            }
            state_at(&v, last, order, s, p->eps, to);
        }
        real after[6];
        state_at(&v, x, order, s, p->eps, after);
        memcpy(v.now, after, sizeof after);
        v.t += gone;
        for (int i = 0; i < LANES && ends; i++) {
            if (v.t[i] < end) continue;
            if (v.orbit[i] >= 0) {
                store(to, i, p, y[v.orbit[i]], s);
                busy -= next >= count;
            }
            v.orbit[i] = next < count ? next : -1;
            load(&v, i, p, y[next < count ? next++ : 0], s);
        }
    }
}

void YARDSTICK(const rival_problem *p, double tolerance, int order, double end, int count, double y[][6])
{
    switch (order) {
#define ORDER(n)                                                                                                     \
    case n:                                                                                                          \
        p->k == -1 ? follow(p, tolerance, n, true, end, count, y) : follow(p, tolerance, n, false, end, count, y);   \
        break
        ORDER(12);
        ORDER(14);
        ORDER(16);
        ORDER(18);
        ORDER(20);
    }
}

/* symplectic.c - symplectic compositions of two exact flows for the point (24), H = M^2/2 + V(gamma).
 *
 *     M^2/2 alone:    M stays, gamma turns on a great circle:  gamma cos(x) + (gamma x M)/|M| sin(x),   x = |M| h
 *     V alone:        gamma stays, M += h gamma x dV/dgamma
 *
 * Either keeps |gamma| = 1 and (M,gamma) = 0, so every composition does, up to rounding. A symmetric composition of
 * order p solves a Hamiltonian system whose H differs from ours by O(h^p): with steps of one length the error of the
 * energy stays bounded, and a step back undoes a step forth. Kicks do not depend on M, and the kinetic energy T is
 * quadratic in M, so {V,{V,{V,T}}} = 0: tables of Runge-Kutta-Nystrom type are valid here.
 *
 * Another clock c with dc/ds = r(gamma) is one more coordinate, with a momentum p_c = 0: V + p_c r is again a
 * potential that depends on positions only, its kick adds h r(gamma) to c, and the composition has its order for c
 * too.
 *
 * Steps are fixed in s. This does not suit a potential that spans many decades (method.c). In a run in another clock
 * Newton's method finds the s at which that clock shows a given time. Sums over steps are compensated, which makes
 * the rounding errors ten times smaller or more (by the angle of a stage).
 */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/math_impl.h"
#include "base/vec3_impl.h"
#include "method/integrator_impl.h"
#include "method/methods_impl.h"
#include "model/formula/formula_lines_impl.h"
#include "model/model_impl.h"

/* --- coefficients ---------------------------------------------------------------------------------------------- */

/* The first halves of symmetric lists, in units of the step. The middle number (two, if the count is even) is what
 * the others leave of 1. A table without drifts composes Strang's steps (drift/2, kick, drift/2) of the kicks'
 * lengths. */
typedef struct table {
    int kicks;
    bool kick_first;
    const double *kick, *drift;
} table;

enum { STRANG, BLANES_MOAN4, BLANES_MOAN6, KAHAN_LI8, SOFRONIOU_SPALETTA10, MOST_KICKS = 35 };

static const table tables[] = {
    /* Strang, SIAM J. Numer. Anal. 5 (1968) 506 */
    [STRANG] = {.kicks = 1},
    /* Blanes, Moan, J. Comput. Appl. Math. 142 (2002) 313, table 3: SRKN 6b */
    [BLANES_MOAN4] = {.kicks = 7,
                      .kick_first = true,
                      .kick = (const double[]){0.0829844064174052, 0.396309801498368, -0.0390563049223486},
                      .drift = (const double[]){0.245298957184271, 0.604872665711080}},
    /* the same, table 3: SRKN 14a */
    [BLANES_MOAN6] = {.kicks = 14,
                      .kick = (const double[]){0.09171915262446165, 0.183983170005006, -0.05653436583288827,
                                               0.004914688774712854, 0.143761127168358, 0.328567693746804},
                      .drift = (const double[]){0.0378593198406116, 0.102635633102435, -0.0258678882665587,
                                                0.314241403071447, -0.130144459517415, 0.106417700369543,
                                                -0.00879424312851058}},
    /* Kahan, Li, Math. Comp. 66 (1997) 1089: s17odr8a */
    [KAHAN_LI8] = {.kicks = 17,
                   .kick = (const double[]){0.13020248308889008087881763, 0.56116298177510838456196441,
                                            -0.38947496264484728640807860, 0.15884190655515560089621075,
                                            -0.39590389413323757733623154, 0.18453964097831570709183254,
                                            0.25837438768632204729397911, 0.29501172360931029887096624}},
    /* Sofroniou, Spaletta, Optim. Methods Softw. 20 (2005) 597: order 10, 35 stages */
    [SOFRONIOU_SPALETTA10] = {.kicks = MOST_KICKS,
                              .kick = (const double[]){0.07879572252168641926390768, 0.31309610341510852776481247,
                                                       0.02791838323507806610952027, -0.22959284159390709415121340,
                                                       0.13096206107716486317465686, -0.26973340565451071434460973,
                                                       0.07497334315589143566613711, 0.11199342399981020488957508,
                                                       0.36613344954622675119314812, -0.39910563013603589787862981,
                                                       0.10308739852747107731580277, 0.41143087395589023782070412,
                                                       -0.00486636058313526176219566, -0.39203335370863990644808194,
                                                       0.05194250296244964703718290, 0.05066509075992449633587434,
                                                       0.04967437063972987905456880}},
};

/* A step of given length: drift[0], kick[0], drift[1] ... kick[kicks - 1], drift[kicks] */
typedef struct schedule {
    int kicks;
    double kick[MOST_KICKS], drift[MOST_KICKS + 1];
} schedule;

/* A symmetric list of `count` parts of h */
static void divide(double h, int count, const double half[], double part[])
{
    const int given = (count - 1) / 2, middle = count - 2 * given;
    double rest = h;
    for (int i = 0; i < given; i++) {
        part[i] = part[count - 1 - i] = h * half[i];
        rest -= 2 * part[i];
    }
    for (int i = 0; i < middle; i++) part[given + i] = rest / middle;
}

static void plan(const iso_integrator *it, double h, schedule *s)
{
    const table *t = &tables[it->method->variant];
    const int kicks = s->kicks = t->kicks;
    divide(h, kicks, t->kick, s->kick);
    s->drift[0] = s->drift[kicks] = t->kick_first ? 0 : s->kick[0] / 2;
    for (int i = 1; i < kicks; i++) s->drift[i] = (s->kick[i - 1] + s->kick[i]) / 2;
    if (t->drift) divide(h, kicks + (t->kick_first ? -1 : 1), t->drift, s->drift + t->kick_first);
}

/* --- the two flows --------------------------------------------------------------------------------------------- */

/* (M, gamma) + rest, and how far the clocks have come since the step began */
typedef struct state {
    double y[ISO_STATE], rest[ISO_STATE], clock[ISO_CLOCKS];
} state;

typedef struct splitting {
    double step;                     /* in s, positive                                        */
    schedule whole;                  /* of a step in the direction of the run                 */
    bool clocks;                     /* others than s are wanted                              */
    double rest[ISO_MAX_STATE];      /* what the state at the end of the last step lacks ...  */
    double rest_left[ISO_MAX_STATE]; /* ... and at its beginning                              */
    int until_restored;              /* steps                                                 */
} splitting;

/* *sum + *rest + x without rounding, but for the last bits of the rest */
static inline void add(double *sum, double *rest, double x)
{
    *sum = iso_two_sum(*sum, x + *rest, rest);
}

static inline void add3(double sum[3], double rest[3], const double x[3])
{
    add(&sum[0], &rest[0], x[0]);
    add(&sum[1], &rest[1], x[1]);
    add(&sum[2], &rest[2], x[2]);
}

/* sin(a)/a and (1 - cos a)/a^2 at x = a^2. The angle of a stage is small as a rule, and the series short. Terms are
 * summed in pairs, because a processor computes these at the same time; Horner's rule makes each term wait. */
static inline void turn(double x, double *sine, double *versine)
{
    if (x > 0.25) {
        const double a = sqrt(x), half = sin(a / 2);
        *sine = sin(a) / a;
        *versine = 2 * half * half / x;
        return;
    }
    const double x2 = x * x, x4 = x2 * x2;
    *sine = 1 + ((x * (-1. / 6) + x2 * (1. / 120 + x * (-1. / 5040))) +
                 x4 * ((1. / 362880 + x * (-1. / 39916800)) + x2 * (1. / 6227020800 + x * (-1. / 1307674368000))));
    *versine = (0.5 + x * (-1. / 24) + x2 * (1. / 720 + x * (-1. / 40320))) +
               x4 * ((1. / 3628800 + x * (-1. / 479001600)) + x2 * (1. / 87178291200));
}

static inline void drift(double h, state *z)
{
    const double *M = z->y, x = h * h * dot(M, M);
    double *gamma = z->y + 3, side[3], sine, versine;
    turn(x, &sine, &versine);
    cross(gamma, M, side);
    const double along = x * versine, across = h * sine;
    const double move[3] = {across * side[0] - along * gamma[0], across * side[1] - along * gamma[1],
                            across * side[2] - along * gamma[2]};
    add3(gamma, z->rest + 3, move);
}

/* gamma x dV/dgamma = (2 eps/k) q^(-1/k - 1) gamma x J gamma + effects,   dtau/ds = 1/G = (det J/k^2) q^(-1/k),
 * dt/ds = 1/(G N) = (det J/k^2) q^(-1/k - 1 + 1/(2k)):     one power, v = q^(-1/k), gives them all. */
static inline void kick(const iso_model *m, bool clocks, double h, state *z)
{
    const iso_params *p = &m->problem.p;
    const double *J = p->J, *gamma = z->y + 3, k = p->k, q = dot_diag(gamma, J, gamma);
    const double v = k == -1 ? q : k == 1 ? 1 / q : pow(q, -1 / k), v_q = k == -1 ? 1 : k == 1 ? v * v : v / q;
    const double a = h * (2 * m->problem.eps / k) * v_q;
    double push[3] = {a * ((J[2] - J[1]) * (gamma[1] * gamma[2])), a * ((J[0] - J[2]) * (gamma[2] * gamma[0])),
                      a * ((J[1] - J[0]) * (gamma[0] * gamma[1]))};
    if (m->problem.energy_formula.lines > 0) {
        double T[3];
        const iso_image image = iso_formula_image(&m->problem.energy_formula, p, z->y);
        cross(gamma, image.gradient, T);
        add_scaled(push, h, T);
    }
    add3(z->y, z->rest, push);
    if (!clocks) return;
    const double rate = h * (p->det_J / (k * k));
    z->clock[ISO_CLOCK_TAU] += rate * v;
    z->clock[ISO_CLOCK_T] += rate * (v_q / sqrt(v));
}

static void advance(iso_integrator *it, const schedule *s, state *z)
{
    const splitting *d = it->data;
    for (int i = 0; i < s->kicks; i++) {
        if (s->drift[i] != 0) drift(s->drift[i], z);
        kick(&it->model, d->clocks, s->kick[i], z);
    }
    if (s->drift[s->kicks] != 0) drift(s->drift[s->kicks], z);
    it->statistics.rhs += s->kicks;
}

/* --- how long a step may be ------------------------------------------------------------------------------------ */

/* A trial goes about two turns from the start (RADIANS), once in n steps and once in 2n. At LOOKS places the two may
 * differ by half a tolerance for each radian of the way. */
enum { RADIANS = 12, LOOKS = 4, FIRST_TRIAL = LOOKS, LAST_TRIAL = 512 };

static void trial(iso_integrator *it, double way, int steps, state at[LOOKS])
{
    schedule s;
    state z = {.clock = {0}};
    copy(it->at_right, z.y, ISO_STATE);
    plan(it, way / steps, &s);
    for (int i = 1; i <= steps; i++) {
        advance(it, &s, &z);
        if (i % (steps / LOOKS) == 0) at[i / (steps / LOOKS) - 1] = z;
    }
}

/* Largest difference, in units of the speed, of a radian, and of what a clock shows after one; infinite for NaN */
static double difference(const state a[LOOKS], const state b[LOOKS], double speed)
{
    double most = 0;
    for (int l = 0; l < LOOKS; l++) {
        for (int i = 0; i < ISO_STATE; i++) {
            const double d = fabs(a[l].y[i] - b[l].y[i]) / (i < 3 ? speed : 1);
            if (!(d <= most)) most = d;
        }
        for (int c = 0; c < ISO_CLOCKS; c++) {
            const double d = RADIANS * fabs(a[l].clock[c] - b[l].clock[c]), all = fabs(b[LOOKS - 1].clock[c]);
            if (!(d <= most * all)) most = d / all;
        }
    }
    return isnan(most) ? INFINITY : most;
}

/* The step for which the difference is as large as it may be: interpolated between two trials on logarithmic scales,
 * extrapolated beyond the last by the order; but no step is longer than a radian. */
static double choose_step(iso_integrator *it)
{
    const double speed = it->model.system->speed(&it->model.problem, it->at_right);
    const double may = RADIANS * it->options.tolerance / 2, way = it->direction * RADIANS / speed;
    double n = FIRST_TRIAL, before, now = INFINITY;
    state coarse[LOOKS], fine[LOOKS];
    if (speed == 0) return 1024; /* nothing moves */
    trial(it, way, FIRST_TRIAL, fine);
    do {
        before = now;
        memcpy(coarse, fine, sizeof fine);
        trial(it, way, 2 * (int)n, fine);
        now = difference(coarse, fine, speed);
        n *= 2;
    } while (now > may && n < 2 * LAST_TRIAL);
    n /= 2; /* steps of the coarse one */
    const double order = now < may ? log2(before / now) : it->method->order;
    if (isfinite(order) && order > 0) n *= pow(fmin(now / may, 1e12), 1 / order);
    return fabs(way) / fmax(RADIANS, n);
}

/* --- the method ------------------------------------------------------------------------------------------------ */

static void release(iso_integrator *it)
{
    free(it->data);
}

static iso_status create(iso_integrator *it)
{
    const iso_model *m = &it->model;
    splitting *d = it->data = calloc(1, sizeof *d);
    if (!d) return iso_context_no_memory(it->ctx, "%s", it->method->name);
    d->clocks = m->clock != ISO_CLOCK_S;
    for (int c = 0; c < m->clocks; c++) d->clocks = d->clocks || m->clock_of[c] != ISO_CLOCK_S;
    it->saved = (2 + 2 * (size_t)m->dim) * sizeof(double);
    return ISO_OK;
}

/* After so many steps the rounding errors of |gamma| = 1 and (M,gamma) = 0 are removed. */
enum { STEPS_TO_RESTORE = 1024 };

static void restore(state *z)
{
    double *M = z->y, *gamma = z->y + 3;
    const double longer = (dot(gamma, gamma) - 1) / 2 + dot(gamma, z->rest + 3), along = dot(M, gamma);
    for (int i = 0; i < 3; i++) {
        add(&M[i], &z->rest[i], -along * gamma[i]);
        add(&gamma[i], &z->rest[3 + i], -longer * gamma[i]);
    }
}

static iso_status start(iso_integrator *it)
{
    splitting *d = it->data;
    *d = (splitting){.clocks = d->clocks, .until_restored = STEPS_TO_RESTORE, .step = it->options.fixed_step};
    if (d->step == 0) d->step = choose_step(it);
    plan(it, it->direction * d->step, &d->whole);
    return ISO_OK;
}

/* From y and its rest by the schedule s, which is a step, or a part of one, of length ds; *z is where it arrives. */
static void move(iso_integrator *it, const schedule *s, double ds, double y[], double rest[], state *z)
{
    *z = (state){.clock = {0}};
    copy(y, z->y, ISO_STATE);
    copy(rest, z->rest, ISO_STATE);
    advance(it, s, z);
    z->clock[ISO_CLOCK_S] = ds;
    copy(z->y, y, ISO_STATE);
    copy(z->rest, rest, ISO_STATE);
    for (int c = 0; c < it->model.clocks; c++)
        add(&y[ISO_STATE + c], &rest[ISO_STATE + c], z->clock[it->model.clock_of[c]]);
}

static iso_status step(iso_integrator *it, double y[], double *h)
{
    splitting *d = it->data;
    state z;
    copy(d->rest, d->rest_left, it->model.dim);
    move(it, &d->whole, it->direction * d->step, y, d->rest, &z);
    if (!it->options.no_projection && --d->until_restored == 0) {
        restore(&z);
        copy(z.y, y, ISO_STATE);
        copy(z.rest, d->rest, ISO_STATE);
        d->until_restored = STEPS_TO_RESTORE;
    }
    *h = z.clock[it->model.clock];
    return all_finite(y, it->model.dim) && isfinite(*h) ? ISO_OK
                                                        : iso_integrator_stopped(it, "the state is not finite");
}

/* A part of a step, ds from its left end, is computed as a step of that length. Newton's method on the clock of the
 * model finds ds; in s it has nothing to do. */
static iso_status dense(iso_integrator *it, double dt, double y[])
{
    enum { MAX_ITERATIONS = 20 };
    const iso_model *m = &it->model;
    const splitting *d = it->data;
    double ds = m->clock == ISO_CLOCK_S ? dt : dt / it->h * (it->direction * d->step), reached[ISO_MAX_STATE];
    for (int i = 0; i < MAX_ITERATIONS; i++) {
        double rest[ISO_MAX_STATE];
        schedule s;
        state z;
        copy(it->at_left, reached, m->dim);
        copy(d->rest_left, rest, m->dim);
        plan(it, ds, &s);
        move(it, &s, ds, reached, rest, &z);
        const double miss = dt - z.clock[m->clock], q = m->system->q(&m->problem.p, reached, NULL);
        /* at least one correction: a short dt is wanted exact relative to itself, not to the step */
        if (miss == 0 || (i > 0 && !(fabs(miss) > DBL_EPSILON * fabs(it->h)))) break;
        ds += miss * iso_clock_rate(&m->problem.p, ISO_CLOCK_S, q, NULL) /
              iso_clock_rate(&m->problem.p, m->clock, q, NULL);
    }
    if (!isfinite(ds)) return iso_integrator_stopped(it, "the time is not reached");
    copy(reached, y, m->dim);
    return ISO_OK;
}

/* What the next step depends on: how many steps until it is restored, their length, the state with its rest. */
static void save(const iso_integrator *it, void *to)
{
    const splitting *d = it->data;
    const int dim = it->model.dim;
    double *next = to;
    next[0] = d->until_restored, next[1] = d->step;
    copy(it->at_right, next + 2, dim);
    copy(d->rest, next + 2 + dim, dim);
}

static void recall(iso_integrator *it, const void *from, double y[])
{
    splitting *d = it->data;
    const int dim = it->model.dim;
    const double *next = from;
    d->until_restored = (int)next[0], d->step = next[1];
    copy(next + 2, y, dim);
    copy(next + 2 + dim, d->rest, dim);
    plan(it, it->direction * d->step, &d->whole);
}

#define METHOD                                                                                                       \
    .family = "splitting", .own_equations = true, .splits = true, .system = &iso_system_point,                       \
    .system_why = "only its equations split into flows that are known exactly", .steps_in_s = true, .fixed = true,   \
    .create = create, .start = start, .step = step, .dense = dense, .save = save, .recall = recall, .free = release
#define SPLITTING(id, order_, variant_, doc_)                                                                        \
    const iso_method iso_method_##id = {.name = #id, .order = order_, .variant = variant_, .doc = doc_, METHOD};

SPLITTING(strang, 2, STRANG, "Strang's splitting")
SPLITTING(blanes_moan4, 4, BLANES_MOAN4, "Blanes-Moan splitting SRKN 6b, 7 kicks")
SPLITTING(blanes_moan6, 6, BLANES_MOAN6, "Blanes-Moan splitting SRKN 14a, 14 kicks")
SPLITTING(kahan_li8, 8, KAHAN_LI8, "Kahan-Li composition s17odr8a, 17 kicks")
SPLITTING(sofroniou_spaletta10, 10, SOFRONIOU_SPALETTA10, "Sofroniou-Spaletta composition, 35 kicks")

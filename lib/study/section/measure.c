/* measure.c - a cloud of states carried by the flow in equal times of a clock, and tested against the measure. */
#include "study/section/measure.h"

#include <math.h>
#include <stdlib.h>

#include "base/arithmetic_impl.h"
#include "base/number_impl.h"
#include "base/pi_impl.h"
#include "base/vec3_impl.h"
#include "model/model_impl.h"
#include "orbit/batch.h"
#include "study/section/measure_impl.h"

/* --- test functions --------------------------------------------------------------------------------------------- */

/* The test functions: first the energy, which is the same for all states. Then functions of n alone, of which three
 * have means other than 0. Then functions of n and of v = J^(1/2) omega/|..|, with u = gamma x v. Their means over
 * theta are 0 at each n. */
enum { ENERGY, LN_G, N1_SQUARE, N2_SQUARE, OTHERS, FUNCTIONS = 23 };
/* clang-format off */
static const char *const names[FUNCTIONS] = {
    "h", "ln g", "n1^2", "n2^2", "n1", "n2", "n3", "n1 n2", "n2 n3", "n3 n1", "v1", "v2", "v3", "u1", "u2", "u3",
    "v1^2 - (1 - gamma1^2)/2", "v2^2 - (1 - gamma2^2)/2", "v1 v2 + gamma1 gamma2/2", "v2 v3 + gamma2 gamma3/2",
    "v3 v1 + gamma3 gamma1/2", "v1 u1", "v2 u2"};
/* clang-format on */

static double ln_g(const iso_params *p, const double n[3])
{
    return log(dot_diag(n, p->inv_J, n));
}

/* h: the error of the energy, with its potential part, relative to the kinetic energy at the start */
static void functions(const measure_scene *s, double first_kinetic, const double ball[ISO_STATE],
                      double value[FUNCTIONS])
{
    const double *w = ball, *n = ball + 3, *root = s->params->root_J;
    double v[3], gamma[3], u[3], *next = value + OTHERS;
    for (int i = 0; i < 3; i++) {
        v[i] = root[i] * w[i];
        gamma[i] = n[i] / root[i];
    }
    const double size = make_unit(v), kinetic = size * size / 2;
    make_unit(gamma);
    cross(gamma, v, u);
    value[ENERGY] = (kinetic + iso_measure_potential(s, n) - s->energy) / first_kinetic;
    value[LN_G] = ln_g(s->params, n);
    value[N1_SQUARE] = n[0] * n[0];
    value[N2_SQUARE] = n[1] * n[1];
    for (int i = 0; i < 3; i++) *next++ = n[i];
    for (int i = 0; i < 3; i++) *next++ = n[i] * n[(i + 1) % 3];
    for (int i = 0; i < 3; i++) *next++ = v[i];
    for (int i = 0; i < 3; i++) *next++ = u[i];
    for (int i = 0; i < 2; i++) *next++ = v[i] * v[i] - (1 - gamma[i] * gamma[i]) / 2;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        *next++ = v[i] * v[j] + gamma[i] * gamma[j] / 2;
    }
    for (int i = 0; i < 2; i++) *next++ = v[i] * u[i];
}

static void functions_of_n(double g, const double n2[3], double value[])
{
    value[LN_G] = log(g);
    value[N1_SQUARE] = n2[0];
    value[N2_SQUARE] = n2[1];
}

/* --- the cloud -------------------------------------------------------------------------------------------------- */

typedef struct carrier {
    iso_context *ctx;
    iso_measure_options options;
    measure_scene scene;
    measure_draw draw;
    double times[ISO_MEASURE_ROWS];
    measure_sums sums;
    iso_start start[MEASURE_BLOCK];
    iso_batch_orbit orbit[MEASURE_BLOCK];
    iso_sample sample[MEASURE_BLOCK * ISO_MEASURE_ROWS];
    double kinetic[MEASURE_BLOCK], sharp[MEASURE_BLOCK]; /* of each orbit of the block, at the start */
} carrier;

/* The power of g in the clock's measure, g^power dn dtheta, for this factor of the exponent 1/(2k). It is the power
 * for t, less e, because d clock/dt is proportional to g^-e (iso_clock_rate gives e). */
static double power_of_g(const iso_params *p, iso_clock clock, double factor)
{
    double e;
    iso_clock_rate(p, clock, 1, &e);
    return factor / (2 * p->k) - 0.5 - e;
}

static iso_status draw_block(carrier *c, int cloud, uint64_t first, size_t count)
{
    const iso_params *p = c->scene.params;
    uint64_t shift[3];
    iso_measure_shift(&c->options, cloud, 3, shift);
    for (size_t i = 0; i < count; i++) {
        double n[3], v[3];
        iso_measure_draw_state(&c->draw, shift, first + i, n, v);
        const double T = c->scene.energy - iso_measure_potential(&c->scene, n);
        if (!(T > 0))
            return ISO_FAIL_INPUT(c->ctx, "energy",
                                  "with this energy the ball does not reach n = (%.4g, %.4g, %.4g): the test needs "
                                  "an energy with which it reaches every n",
                                  n[0], n[1], n[2]);
        c->start[i] = (iso_start){.model = ISO_BALL, .eps = NAN};
        for (int j = 0; j < 3; j++) {
            c->start[i].y[j] = sqrt(2 * T) * v[j] / p->root_J[j];
            c->start[i].y[3 + j] = n[j];
        }
        c->orbit[i] = (iso_batch_orbit){p, &c->start[i], c->scene.free ? NULL : &c->scene.effects};
        c->kinetic[i] = T;
        c->sharp[i] = ln_g(p, n) / (2 * p->k);
        double value[FUNCTIONS];
        functions(&c->scene, T, c->start[i].y, value);
        iso_measure_sums_start(&c->sums, c->sharp[i], value);
    }
    return ISO_OK;
}

static iso_status carry_block(void *data, int cloud, uint64_t first, size_t count)
{
    carrier *c = data;
    iso_batch_options o = iso_batch_defaults();
    o.backend = c->options.backend;
    o.tolerance = c->options.tolerance;
    o.clock = c->options.clock;
    o.threads = c->options.threads;
    iso_status status = draw_block(c, cloud, first, count);
    if (status == ISO_OK)
        status = iso_batch_run(c->ctx, c->orbit, count, &o, c->times, ISO_MEASURE_ROWS, c->sample, NULL);
    for (size_t i = 0; i < count && status == ISO_OK; i++)
        for (int row = 0; row < ISO_MEASURE_ROWS; row++) {
            double value[FUNCTIONS];
            functions(&c->scene, c->kinetic[i], c->sample[i * ISO_MEASURE_ROWS + (size_t)row].ball, value);
            iso_measure_sums_add(&c->sums, cloud, row, c->sharp[i], value);
        }
    return status;
}

/* n turns at the rate |k w|, where |w| is about (2 T/J)^(1/2), J the middle moment. Clocks go as fast as at q = J. */
static void choose_times(carrier *c)
{
    const iso_params *p = c->scene.params;
    int axis[3];
    sort_by(p->J, axis);
    const double J = p->J[axis[1]], turn = 2 * ISO_PI / (fabs(p->k) * sqrt(2 * c->scene.kinetic / J));
    const double rate = iso_clock_rate(p, c->options.clock, J, NULL);
    const double end = isnan(c->options.end) ? c->options.turns * turn * rate : c->options.end;
    for (int i = 0; i < ISO_MEASURE_ROWS; i++) c->times[i] = ldexp(end, 2 * (i + 1 - ISO_MEASURE_ROWS));
}

static void judge(carrier *c, iso_measure *m)
{
    double expected[FUNCTIONS] = {0};
    iso_measure_draw_means(&c->draw, OTHERS, functions_of_n, expected);
    *m = (iso_measure){.axis = -1, .clock = c->options.clock, .end = c->times[ISO_MEASURE_ROWS - 1]};
    iso_measure_judge(&c->sums, &c->options, names, expected, c->times, m);
}

static iso_status check_times(iso_context *ctx, const iso_measure_options *o)
{
    if ((int)o->clock < 0 || o->clock >= ISO_CLOCKS) return ISO_FAIL_ARGUMENT(ctx, "clock", "no such clock");
    if (isnan(o->end) && !(o->turns > 0 && o->turns <= 1e6))
        return ISO_FAIL_ARGUMENT(ctx, "turns", "%s turns are not in (0, 1e6]", ISO_SHORT(o->turns));
    if (!isnan(o->end) && !(o->end > 0 && isfinite(o->end)))
        return ISO_FAIL_ARGUMENT(ctx, "end", "the flow ends at a finite time above 0, not at %s", ISO_SHORT(o->end));
    return ISO_OK;
}

iso_status iso_measure_flow(iso_context *ctx, const iso_scene *scene, const iso_measure_options *options,
                            iso_measure *measure)
{
    ISO_DEFAULT_ARITHMETIC;
    carrier *c = calloc(1, sizeof *c);
    if (!c) return iso_context_no_memory(ctx, "%d orbits", MEASURE_BLOCK);
    c->ctx = ctx;
    c->sums.functions = FUNCTIONS;
    iso_status status = iso_measure_open(ctx, scene, options, &c->options, &c->scene);
    if (status == ISO_OK) status = check_times(ctx, &c->options);
    if (status == ISO_OK) {
        iso_measure_draw_prepare(&c->draw, c->scene.params,
                                 power_of_g(c->scene.params, c->options.clock, c->options.exponent));
        choose_times(c);
        status = iso_measure_carry(&c->options, carry_block, c);
    }
    if (status == ISO_OK) judge(c, measure);
    iso_orbit_free(c->scene.orbit);
    free(c);
    return status;
}

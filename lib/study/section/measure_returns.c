/* measure_returns.c - carries a cloud on the section by returns, and tests whether it stays uniform in dL dl. */
#include <math.h>
#include <stdlib.h>

#include "base/arithmetic_impl.h"
#include "map/section_impl.h"
#include "map/state.h"
#include "orbit/crossings_impl.h"
#include "study/section/measure_impl.h"

enum { AT_ONCE = 16 }; /* crossings of one orbit that are kept at a time */

/* --- test functions --------------------------------------------------------------------------------------------- */

/* The energy, which is the same for all states; functions of l whose means are not 0; others, whose means are 0: they
 * are odd under a symmetry of the measure, or have a factor x or x^2 - 1/3. */
enum { ENERGY, LN_G, COS_2L, COS_4L, OTHERS, FUNCTIONS = 15 };
/* clang-format off */
static const char *const names[FUNCTIONS] = {
    "h", "ln G", "cos 2l", "cos 4l", "cos l", "sin l", "sin 2l", "x", "x^2 - 1/3", "x cos l", "x sin l", "x cos 2l",
    "x sin 2l", "(x^2 - 1/3) cos 2l", "(x^2 - 1/3) sin 2l"};
/* clang-format on */

static void functions_of_l(const iso_params *p, int axis, double l, double value[OTHERS])
{
    value[LN_G] = log(iso_section_momentum(iso_free_point(p, 0.5), axis, l)); /* up to a constant */
    value[COS_2L] = cos(2 * l);
    value[COS_4L] = cos(4 * l);
}

/* kinetic: the energy, divided by that of the scene */
static void functions(const iso_params *p, int axis, double l, double x, double kinetic, double value[FUNCTIONS])
{
    const double y = x * x - 1. / 3, c = cos(l), s = sin(l), c2 = cos(2 * l), s2 = sin(2 * l);
    const double others[] = {c, s, s2, x, y, x * c, x * s, x * c2, x * s2, y * c2, y * s2};
    value[ENERGY] = kinetic - 1;
    functions_of_l(p, axis, l, value);
    for (int i = OTHERS; i < FUNCTIONS; i++) value[i] = others[i - OTHERS];
}

/* Means with the density G^exponent, by the trapezoidal rule in u, tan l = e^u (map/quarter_impl.h). */
static void expectations(const iso_params *p, int axis, double exponent, double mean[FUNCTIONS])
{
    double whole = 0;
    for (int i = 0; i < FUNCTIONS; i++) mean[i] = 0;
    for (double u = -46; u <= 46; u += 0.25) {
        double value[OTHERS];
        functions_of_l(p, axis, atan(exp(u)), value);
        const double weight = exp(exponent * value[LN_G]) / cosh(u);
        whole += weight;
        for (int i = LN_G; i < OTHERS; i++) mean[i] += weight * value[i];
    }
    for (int i = LN_G; i < OTHERS; i++) mean[i] /= whole;
}

/* --- the cloud -------------------------------------------------------------------------------------------------- */

typedef struct returner {
    iso_context *ctx;
    iso_measure_options options;
    measure_scene scene;
    int axis, returns[ISO_MEASURE_ROWS];
    size_t lost;
    measure_sums sums;
    iso_start start[MEASURE_BLOCK];
    iso_batch_orbit orbit[MEASURE_BLOCK];
    iso_crossing crossing[MEASURE_BLOCK * AT_ONCE];
    iso_sample sample[MEASURE_BLOCK];
    size_t done[MEASURE_BLOCK];
    iso_status status[MEASURE_BLOCK];
    double sharp[MEASURE_BLOCK]; /* of each orbit, at the start */
} returner;

/* Draws orbits with the density G^exponent, which is G for k/exponent in the place of k. */
static void draw_block(returner *r, int cloud, uint64_t first, size_t count)
{
    const iso_params *p = r->scene.params;
    const double eps = iso_coupling(p, r->scene.energy);
    iso_params drawn = *p;
    drawn.k = p->k / r->options.exponent;
    uint64_t seed;
    iso_section_spread spread;
    iso_measure_shift(&r->options, cloud, 1, &seed);
    iso_section_spread_prepare(&spread, iso_free_point(&drawn, 1), r->axis, seed);
    for (size_t i = 0; i < count; i++) {
        double l, x, point[ISO_STATE];
        iso_section_spread_point(&spread, first + i, &l, &x);
        iso_section_point(iso_free_point(p, eps), r->axis, l, x, point);
        r->start[i] = (iso_start){.model = ISO_BALL, .eps = NAN};
        iso_point_to_ball(p, point, r->start[i].y);
        r->orbit[i] = (iso_batch_orbit){p, &r->start[i], r->scene.free ? NULL : &r->scene.effects};
        r->sharp[i] = log(iso_section_momentum(iso_free_point(p, 0.5), r->axis, l));
        double value[FUNCTIONS];
        functions(p, r->axis, l, x, 1, value);
        iso_measure_sums_start(&r->sums, r->sharp[i], value);
    }
}

/* Adds the last crossing of each orbit, and the ball there, to the sums. */
static void add_row(returner *r, int cloud, int row, size_t count)
{
    const iso_params *p = r->scene.params;
    for (size_t i = 0; i < count; i++) {
        const double kinetic = iso_ball_energy(p, r->sample[i].ball) / r->scene.energy;
        double value[FUNCTIONS];
        functions(p, r->axis, r->crossing[i].l, r->crossing[i].x, kinetic, value);
        iso_measure_sums_add(&r->sums, cloud, row, r->sharp[i], value);
    }
}

/* Finds the next `number` crossings of each orbit. The last of them stays in r->crossing and r->sample. */
static iso_status go(returner *r, iso_crossings *c, int number)
{
    iso_status status = ISO_OK;
    while (status == ISO_OK && number > 1) {
        const int each = number - 1 < AT_ONCE ? number - 1 : AT_ONCE;
        status = iso_crossings_go(c, NULL, (size_t)each, r->crossing, NULL, r->done, r->status);
        number -= each;
    }
    return status == ISO_OK ? iso_crossings_go(c, NULL, 1, r->crossing, r->sample, r->done, r->status) : status;
}

/* Effects may stop a ball before it returns: then there is no return map. One such block ends the test. */
static iso_status carry_block(void *data, int cloud, uint64_t first, size_t count)
{
    returner *r = data;
    iso_crossings *c = NULL;
    iso_crossings_options o = iso_crossings_defaults();
    draw_block(r, cloud, first, count);
    o.backend = r->options.backend;
    o.axis = r->axis;
    o.tolerance = r->options.tolerance;
    o.threads = r->options.threads;
    iso_status status = iso_crossings_create(r->ctx, r->orbit, count, &o, &c);
    for (int row = 0; row < ISO_MEASURE_ROWS && status == ISO_OK; row++) {
        status = go(r, c, r->returns[row] - (row > 0 ? r->returns[row - 1] : 0));
        if (status == ISO_OK) add_row(r, cloud, row, count);
    }
    iso_crossings_free(c);
    for (size_t i = 0; i < count && status == ISO_NUMERICAL && !r->scene.free; i++) r->lost += r->status[i] != ISO_OK;
    return status;
}

static iso_status check_section(returner *r)
{
    const int axis = r->options.axis;
    if (iso_crossings_check_axis(r->ctx, axis) != ISO_OK) return ISO_BAD_ARGUMENT;
    if (r->options.returns < ISO_MEASURE_RETURNS || r->options.returns > 1000000)
        return ISO_FAIL_ARGUMENT(r->ctx, "returns", "%d returns are not in [%d, 1e6]", r->options.returns,
                                 ISO_MEASURE_RETURNS);
    r->axis = axis == ISO_AXIS_AUTO ? iso_section_axis(iso_free_point(r->scene.params, 1)) : axis;
    for (int i = 0; i < ISO_MEASURE_ROWS; i++) r->returns[i] = r->options.returns >> (ISO_MEASURE_ROWS - 1 - i);
    if (r->scene.pulled)
        return ISO_FAIL_INPUT(r->ctx, "effects",
                              "the section of a ball in a potential has another chart: only the flow can be "
                              "tested");
    return ISO_OK;
}

/* The only line says that not every orbit returned. */
static void judge_lost(const returner *r, iso_measure *m)
{
    m->count = r->options.count;
    m->lost = r->lost;
    m->resolution = NAN;
    m->lines = 1;
    m->line[0] = (iso_measure_entry){
        .name = "orbits that return", .time = m->end, .mean = NAN, .expected = 1, .deviation = -INFINITY};
}

static void judge(returner *r, iso_measure *m)
{
    double expected[FUNCTIONS], number[ISO_MEASURE_ROWS];
    expectations(r->scene.params, r->axis, r->options.exponent, expected);
    for (int i = 0; i < ISO_MEASURE_ROWS; i++) number[i] = r->returns[i];
    *m = (iso_measure){.axis = r->axis, .clock = r->options.clock, .end = number[ISO_MEASURE_ROWS - 1]};
    if (r->lost > 0) {
        judge_lost(r, m);
        return;
    }
    iso_measure_judge(&r->sums, &r->options, names, expected, number, m);
}

iso_status iso_measure_returns(iso_context *ctx, const iso_scene *scene, const iso_measure_options *options,
                               iso_measure *measure)
{
    ISO_DEFAULT_ARITHMETIC;
    returner *r = calloc(1, sizeof *r);
    if (!r) return iso_context_no_memory(ctx, "%d orbits", MEASURE_BLOCK);
    r->ctx = ctx;
    r->sums.functions = FUNCTIONS;
    iso_status status = iso_measure_open(ctx, scene, options, &r->options, &r->scene);
    if (status == ISO_OK) status = check_section(r);
    if (status == ISO_OK) status = iso_measure_carry(&r->options, carry_block, r);
    if (r->lost > 0) status = ISO_OK;
    if (status == ISO_OK) judge(r, measure);
    iso_orbit_free(r->scene.orbit);
    free(r);
    return status;
}

/* stability_chart.c - the chart of stable rotations in the plane of k and one moment, or k and the level
 * (stability_chart.h). */
#define _GNU_SOURCE /* functions of _Float128 */
#include "instrument/periodic/stability_chart.h"

#include <math.h>

#include "base/arithmetic_impl.h"
#include "base/context_impl.h"
#include "base/names_impl.h"
#include "base/number_impl.h"
#include "base/pool_impl.h"
#include "base/vec3_impl.h"
#include "instrument/periodic/periodic_impl.h"
#include "map/section_impl.h"

typedef struct chart {
    iso_context *ctx;
    iso_stability_options o;
    iso_record *grid, *borders;
} chart;

/* The half-turn trace of the axis of the least (0) or greatest (1) moment at (k, J). Powers of J must fit a double: off
 * H = 0 the moments get a unit near the largest of them, which changes no trace. */
static double trace_at(const chart *c, int which, const double at[2])
{
    double J[3] = {c->o.J[0], c->o.J[1], c->o.J[2]}, level = c->o.level;
    int axis = 0;
    *(c->o.moment == ISO_CHART_LEVEL ? &level : &J[c->o.moment]) = at[1];
    if (fabs(at[0]) < ISO_LEAST_K) return NAN;
    int exponent = 1;
    if (level != 0) frexp(max3(J), &exponent);
    for (int i = 0; i < 3; i++) J[i] = ldexp(J[i], 1 - exponent);
    for (int i = 1; i < 3; i++)
        if (which == 0 ? J[i] < J[axis] : J[i] > J[axis]) axis = i;
    const double energy =
        level == 0 ? 0 : iso_level_energy(&(iso_params){.k = at[0], .J = {J[0], J[1], J[2]}}, level);
    return iso_hill_trace(at[0], J, energy, axis, NULL);
}

/* Some lines of equal J. */
static bool fill_lines(iso_pool_worker *w, void *data, size_t first, size_t count)
{
    chart *c = data;
    const size_t n = (size_t)c->o.steps + 1;
    for (size_t j = first; j < first + count; j++) {
        if (w->asks && c->o.progress) c->o.progress(c->o.data, (double)j / (double)n);
        for (size_t i = 0; i < n && iso_pool_goes_on(w); i++) {
            double *row = iso_record_row(c->grid, n * j + i);
            for (int which = 0; which < 2; which++) row[2 + which] = trace_at(c, which, row);
        }
    }
    return true;
}

/* Traces at the points of the grid. */
static iso_status fill_grid(chart *c)
{
    const int n = c->o.steps + 1;
    for (int i = 0; i < n * n; i++) {
        const int at[2] = {i % n, i / n};
        double *row;
        ISO_TRY(iso_record_append(c->ctx, c->grid, &row));
        for (int d = 0; d < 2; d++) row[d] = c->o.from[d] + (c->o.to[d] - c->o.from[d]) * at[d] / (n - 1);
        row[2] = row[3] = NAN;
    }
    iso_pool pool = {.what = "orbit", .count = (size_t)n, .chunk = 1, .solve = fill_lines, .data = c};
    return iso_pool_run(c->ctx, &pool, iso_pool_threads(c->o.threads, pool.count - 1, 1), NULL);
}

/* The zero of trace - level between a and b, by halving. A jump is none: the axis changes where moments are equal. */
static iso_status add_border(chart *c, int which, double level, const double a[2], const double b[2])
{
    double low[2] = {a[0], a[1]}, high[2] = {b[0], b[1]}, at[2], *row;
    double off_low = trace_at(c, which, low) - level, off_high = trace_at(c, which, high) - level;
    for (int i = 0; i < 46; i++) {
        for (int d = 0; d < 2; d++) at[d] = (low[d] + high[d]) / 2;
        const double off = trace_at(c, which, at) - level;
        if (isnan(off)) return ISO_OK;
        double *end = (off < 0) == (off_low < 0) ? low : high;
        (end == low ? (off_low = off) : (off_high = off));
        end[0] = at[0], end[1] = at[1];
    }
    if (fabs(off_high - off_low) > 1e-6) return ISO_OK;
    const iso_status status = iso_record_append(c->ctx, c->borders, &row);
    if (status == ISO_OK) row[0] = which, row[1] = level, row[2] = at[0], row[3] = at[1];
    return status;
}

/* The borders between neighbours of the grid. */
static iso_status find_borders(chart *c)
{
    const size_t n = (size_t)c->o.steps + 1;
    for (size_t pair = 0; pair < 2 * n * n; pair++) {
        const size_t i = pair / 2, next = pair % 2 == 0 ? i + 1 : i + n;
        if (pair % 2 == 0 ? next % n == 0 : next >= n * n) continue;
        const double *a = iso_record_const_row(c->grid, i), *b = iso_record_const_row(c->grid, next);
        for (int test = 0; test < 4; test++) {
            const int which = test / 2;
            const double level = test % 2 == 0 ? -2 : 2;
            if (!iso_context_goes_on(c->ctx)) return iso_context_stopped(c->ctx);
            if ((a[2 + which] - level) * (b[2 + which] - level) < 0 && a[0] * b[0] > 0)
                ISO_TRY(add_border(c, which, level, a, b));
        }
    }
    return ISO_OK;
}

static iso_status check(const chart *c)
{
    const iso_stability_options *o = &c->o;
    if (!(o->from[0] < o->to[0]) || !isfinite(o->to[0] - o->from[0]))
        return ISO_FAIL_ARGUMENT(c->ctx, "k", "k from %s to %s: give A:B with A < B", ISO_SHORT(o->from[0]),
                                 ISO_SHORT(o->to[0]));
    if (o->from[0] > -ISO_LEAST_K && o->to[0] < ISO_LEAST_K)
        return ISO_FAIL_ARGUMENT(c->ctx, "k", "k from %s to %s: nothing is computed for |k| < %s",
                                 ISO_SHORT(o->from[0]), ISO_SHORT(o->to[0]), ISO_SHORT(ISO_LEAST_K));
    const bool by_level = o->moment == ISO_CHART_LEVEL;
    if (by_level ? !(o->from[1] < o->to[1]) || !isfinite(o->to[1] - o->from[1]) : !isfinite(o->level))
        return ISO_FAIL_ARGUMENT(c->ctx, "level", "level from %s to %s: give A:B with A < B", ISO_SHORT(o->from[1]),
                                 ISO_SHORT(o->to[1]));
    if (o->moment < 0 || o->moment > ISO_CHART_LEVEL ||
        (!by_level && (!(o->from[1] > 0) || !(o->from[1] < o->to[1]) || !isfinite(o->to[1]))))
        return ISO_FAIL_ARGUMENT(c->ctx, "J", "J%d from %s to %s: give A:B with 0 < A < B", o->moment + 1,
                                 ISO_SHORT(o->from[1]), ISO_SHORT(o->to[1]));
    for (int i = 0; i < 3; i++)
        if (i != o->moment && !(o->J[i] > 0 && isfinite(o->J[i])))
            return ISO_FAIL_ARGUMENT(c->ctx, "J", "J%d = %s is not positive", i + 1, ISO_SHORT(o->J[i]));
    if (o->steps < 2 || o->steps > 2000)
        return ISO_FAIL_ARGUMENT(c->ctx, "steps", "%d steps: give 2 to 2000", o->steps);
    return ISO_OK;
}

ISO_NAMES(iso_chart_name, int, "J1", "J2", "J3", "level")

iso_status iso_stability_chart(iso_context *ctx, const iso_stability_options *options, iso_record **grid,
                               iso_record **borders)
{
    ISO_DEFAULT_ARITHMETIC;
    chart c = {.ctx = ctx, .o = iso_stability_defaults()};
    if (options) c.o = *options;
    iso_status status = check(&c);
    const char *const varies = status == ISO_OK ? iso_chart_name(c.o.moment) : NULL;
    const char *const of_grid[] = {"k", varies, "least", "greatest"};
    const char *const of_borders[] = {"axis", "trace", "k", varies};
    if (status == ISO_OK) status = iso_record_create(ctx, 4, of_grid, &c.grid);
    if (status == ISO_OK) status = iso_record_create(ctx, 4, of_borders, &c.borders);
    if (status == ISO_OK) status = fill_grid(&c);
    if (status == ISO_OK) status = find_borders(&c);
    if (status != ISO_OK) iso_record_free(c.grid), iso_record_free(c.borders), c.grid = c.borders = NULL;
    *grid = c.grid;
    *borders = c.borders;
    return status;
}

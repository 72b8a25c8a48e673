/* sweep_point.c - point i of a sweep: its numbers and its scene. Everything is a pure function of i. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/number_impl.h"
#include "base/random_impl.h"
#include "io/scene_print_impl.h"
#include "map/section_impl.h"
#include "orbit/crossings_impl.h"
#include "orbit/orbit_impl.h"
#include "study/study_impl.h"
#include "sweep/sweep_draft_impl.h"

/* --- the numbers ------------------------------------------------------------------------------------------------ */

/* The number of 12 digits that x misses by rounding alone, by less than `most`, such as 0.3 for 0.1 + 2 0.1; else x.
 * k = 1 must be 1. */
static double tidy(double x, double most)
{
    char digits[ISO_NUMBER_SIZE];
    double number;
    iso_number_print_as(digits, x, 12);
    return iso_number_read(digits, strlen(digits), &number) && fabs(number - x) < most ? number : x;
}

/* Both ends are exact. Of from (to/from)^part the rounding error is that of the power, which the logarithm of the ratio
 * enlarges. */
double iso_sweep_in_range(const iso_sweep_axis *a, size_t j)
{
    const double n = (double)a->count - 1, i = (double)j;
    if (n <= 0 || j == 0) return a->from;
    if (i == n) return a->to;
    if (a->logarithmic) {
        const double ratio = a->to / a->from, x = a->from * pow(ratio, i / n);
        return tidy(x, 1e-15 * fabs(x) * (1 + fabs(log(ratio))));
    }
    return tidy((a->from * (n - i) + a->to * i) / n, 1e-15 * fmax(fabs(a->from), fabs(a->to)));
}

/* Sample s of what is drawn. */
static double drawn(const iso_sweep_file *f, const iso_sweep_axis *a, size_t s)
{
    const uint64_t at = iso_scatter(iso_scatter(f->shift[a->drawn] + 0x5851f42d4c957f2d) + s);
    const double even = iso_recurrence(f->shift[a->drawn], f->step[a->drawn], s);
    const double part = f->random ? iso_recurrence(at, 0, 0) : even;
    if (a->logarithmic) return a->from * pow(a->to / a->from, part);
    return a->from + (a->to - a->from) * part;
}

/* Value j of a triangle: by growing a, then growing b. */
static void in_triangle(const iso_sweep_axis *axis, size_t j, double J[3])
{
    const long sum = axis->sum;
    long a = 1, b;
    for (;; a++) {
        const long least = axis->ordered ? a + 1 : 1;
        const long most = axis->ordered ? (sum - a - 1) / 2 : sum - a - 1;
        const size_t row = most >= least ? (size_t)(most - least + 1) : 0;
        b = least + (long)j;
        if (j < row || a >= sum) break;
        j -= row;
    }
    J[0] = (double)a / (double)sum;
    J[1] = (double)b / (double)sum;
    J[2] = (double)(sum - a - b) / (double)sum;
}

/* Which value of each axis point i has; those that are drawn have sample *sample. */
static void take_apart(const iso_sweep_file *f, size_t i, size_t index[], size_t *sample)
{
    *sample = f->drawn > 0 ? i % f->samples : 0;
    if (f->drawn > 0) i /= f->samples;
    for (int a = f->axes - 1; a >= 0; a--) {
        index[a] = i % f->axis[a].count;
        i /= f->axis[a].count;
    }
}

/* A draft with the numbers of point i in it, and these numbers. l and x are not in it. */
static iso_draft draft_of(iso_context *ctx, const iso_sweep_file *f, size_t i, double numbers[])
{
    iso_draft d = f->draft;
    size_t index[ISO_SWEEP_AXES], sample;
    d.yaml.ctx = ctx;
    take_apart(f, i, index, &sample);
    for (int n = 0; n < f->axes; n++) {
        const iso_sweep_axis *a = &f->axis[n];
        double *value = numbers + a->column, *at = (double *)(void *)((char *)&d + a->offset);
        switch (a->values) {
        case ISO_FROM_LIST:
            memcpy(value, a->list + index[n] * (size_t)a->width, (size_t)a->width * sizeof *value);
            break;
        case ISO_FROM_RANGE: *value = iso_sweep_in_range(a, index[n]); break;
        case ISO_FROM_DRAWING: *value = drawn(f, a, sample); break;
        case ISO_FROM_TRIANGLE: in_triangle(a, index[n], value); break;
        case ISO_FROM_SPREAD: value[0] = value[1] = NAN; break; /* needs k and J: see on_section */
        }
        if (a->target == ISO_TO_NUMBER) memcpy(at, value, (size_t)a->width * sizeof *value);
        if (a->target == ISO_TO_RATIO) at[a->part] = *value * at[a->of];
    }
    return d;
}

/* --- starts on the section -------------------------------------------------------------------------------------- */

/* The start as it is when it is read: it then stays what it is when it is written and read. */
static iso_status as_read(iso_context *ctx, iso_start *start)
{
    const iso_start before = *start;
    if (start->model == ISO_BALL) return iso_start_ball(ctx, before.y, before.y + 3, ISO_SPIN_REMOVE, start);
    return iso_start_point(ctx, before.y, before.y + 3, isnan(before.eps) ? NULL : &before.eps, true, start);
}

/* l and x of the point. */
static void chart_of(const iso_sweep_file *f, size_t i, const iso_orbit *orbit, int axis, double numbers[],
                     double lx[2])
{
    size_t index[ISO_SWEEP_AXES], sample;
    take_apart(f, i, index, &sample);
    for (int n = 0; n < f->axes; n++) {
        const iso_sweep_axis *a = &f->axis[n];
        double *value = numbers + a->column;
        if (a->target != ISO_TO_CHART) continue;
        if (a->values == ISO_FROM_SPREAD) {
            iso_section_spread spread;
            iso_section_spread_prepare(&spread, iso_orbit_motion(orbit), axis, a->seed);
            iso_section_spread_point(&spread, index[n], &value[0], &value[1]);
        }
        if (a->chart != 1) lx[0] = value[0];
        if (a->chart != 0) lx[1] = value[a->width - 1];
    }
}

/* Puts the start on the global section, with the energy that the scene's start has. */
static iso_status on_section(iso_context *ctx, const iso_sweep_file *f, size_t i, iso_scene *scene, double numbers[])
{
    const iso_effects effects = iso_scene_acting(scene);
    const double eps = scene->start.eps;
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    iso_orbit *orbit;
    double lx[1][2];
    o.effects = &effects;
    iso_status status = iso_orbit_create(ctx, &scene->params, &scene->start, &o, &orbit);
    if (status != ISO_OK) return status;
    const int axis = iso_section_axis(iso_orbit_motion(orbit));
    chart_of(f, i, orbit, axis, numbers, *lx);
    status = iso_refuse_rest(ctx, &scene->start, &effects, ISO_NO_RETURN);
    if (status == ISO_OK) status = iso_refuse_starts(ctx, orbit, &effects, axis, (const double(*)[2])lx, 1, false);
    if (status == ISO_OK) {
        scene->start = iso_section_start(orbit, scene->start.model, axis, lx[0][0], lx[0][1]);
        scene->start.eps = eps;
        status = as_read(ctx, &scene->start);
    }
    iso_orbit_free(orbit);
    return status;
}

iso_status iso_sweep_point(iso_context *ctx, const void *file, size_t i, iso_scene *scene, double numbers[])
{
    ISO_DEFAULT_ARITHMETIC;
    const iso_sweep_file *f = file;
    iso_draft d = draft_of(ctx, f, i, numbers);
    iso_status status = iso_draft_make(&d);
    if (status != ISO_OK) return status;
    *scene = d.scene;
    if (f->level) status = iso_scene_on_level(ctx, scene, numbers[f->level->column]);
    if (status == ISO_OK && f->level && scene->start.model == ISO_POINT) status = as_read(ctx, &scene->start);
    if (status != ISO_OK) return status;
    return f->on_section ? on_section(ctx, f, i, scene, numbers) : ISO_OK;
}

iso_status iso_sweep_print_point(iso_context *ctx, const iso_sweep_file *file, size_t i, FILE *to)
{
    double numbers[9 * ISO_SWEEP_AXES];
    iso_scene scene;
    ISO_TRY(iso_sweep_point(ctx, file, i, &scene, numbers));
    iso_scene_print(&scene, to);
    return ISO_OK;
}

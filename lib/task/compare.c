/* The same orbit by every backend, see compare.h: the rows, the drift of the integrals, and the differences. */
#include "task/compare.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/arithmetic_impl.h"
#include "base/resources_impl.h"
#include "base/vec3_impl.h"
#include "method/methods_impl.h"
#include "orbit/watch_impl.h"

typedef struct comparer {
    iso_context *ctx;
    const iso_scene *scene;
    iso_effects effects; /* those that act */
    iso_comparison *out;
    iso_orbit *orbit[ISO_BACKENDS];
} comparer;

/* --- one backend ------------------------------------------------------------------------------------------------ */

/* The scene's method if it can integrate the backend's model; NULL: auto. */
static const iso_method *method_for(const iso_scene *scene, iso_backend backend)
{
    const iso_method *m = iso_method_find(scene->method);
    const iso_system *const system = backend == ISO_BACKEND_BALL ? &iso_system_ball : &iso_system_point;
    return !m || backend == ISO_BACKEND_EXACT || (m->system && m->system != system) ? NULL : m;
}

static iso_status open_backend(comparer *r, iso_backend backend)
{
    const int which = r->out->runs;
    iso_backend_run *run = &r->out->run[which];
    iso_orbit_options o = iso_orbit_defaults(&r->scene->start);
    const char *names[ISO_TRAJECTORY_COLUMNS];
    iso_column_names(names);
    ISO_TRY(iso_record_create(r->ctx, ISO_COLUMN_EFFECTS, names, &run->trajectory));
    ISO_TRY(iso_method_check(r->ctx, r->scene->method));
    o.effects = &r->effects;
    o.backend = run->backend = backend;
    o.method = method_for(r->scene, backend);
    o.tolerance = r->scene->tolerance;
    o.shown = ISO_SHOW_BOTH;
    for (int clock = 0; clock < ISO_CLOCKS; clock++) o.with_clock[clock] = true;
    const double begin = processor_seconds();
    ISO_TRY(iso_orbit_create(r->ctx, &r->scene->params, &r->scene->start, &o, &r->orbit[which]));
    run->seconds = processor_seconds() - begin;
    run->method = iso_orbit_method(r->orbit[which]);
    r->out->clock = o.clock;
    r->out->effects = iso_orbit_effects(r->orbit[which]);
    r->out->h = iso_orbit_energy(r->orbit[which]);
    r->out->eps = iso_orbit_coupling(r->orbit[which]);
    r->out->runs++;
    return ISO_OK;
}

/* It is no failure if there is no closed solution, or if it cannot be found. */
static iso_status open_exact(comparer *r)
{
    const iso_status status = open_backend(r, ISO_BACKEND_EXACT);
    if (status != ISO_BAD_ARGUMENT && status != ISO_NUMERICAL) return status;
    snprintf(r->out->no_exact, sizeof r->out->no_exact, "%s", iso_context_message(r->ctx));
    return ISO_OK;
}

static iso_status find_sample(comparer *r, int which, size_t i, iso_sample *sample)
{
    iso_backend_run *run = &r->out->run[which];
    const double begin = processor_seconds();
    const iso_status status = iso_orbit_at(r->orbit[which], iso_scene_time(r->scene, i), sample);
    run->seconds += processor_seconds() - begin;
    run->statistics = iso_orbit_statistics(r->orbit[which]);
    return status;
}

static iso_status keep(comparer *r, int which, size_t i, const iso_sample *sample)
{
    double *row;
    iso_backend_run *run = &r->out->run[which];
    const iso_orbit *orbit = r->orbit[which];
    ISO_TRY(iso_record_append(r->ctx, run->trajectory, &row));
    for (int c = 0; c < ISO_COLUMN_EFFECTS; c++) row[c] = iso_sample_column(sample, c);
    for (int s = 0; i == 0 && iso_systems[s]; s++)
        run->drifts += iso_watch_begin(orbit, iso_systems[s], s == ISO_POINT ? orbit->level : (double)NAN, sample,
                                       run->drift + run->drifts, ISO_MAX_INTEGRALS - run->drifts);
    iso_watch_follow(orbit, sample, run->drift, run->drifts);
    return ISO_OK;
}

/* A row is kept only when every backend has found it: so all have the same rows when one of them fails. */
static iso_status add_row(comparer *r, size_t i)
{
    iso_sample sample[ISO_BACKENDS];
    for (int which = 0; which < r->out->runs; which++) ISO_TRY(find_sample(r, which, i, &sample[which]));
    for (int which = 0; which < r->out->runs; which++) ISO_TRY(keep(r, which, i, &sample[which]));
    return ISO_OK;
}

static iso_status add_rows(comparer *r, bool (*progress)(void *data, double part), void *data)
{
    const size_t rows = iso_scene_rows(r->scene);
    for (size_t i = 0; i < rows; i++) {
        ISO_TRY(add_row(r, i));
        if (progress && !progress(data, (double)(i + 1) / (double)rows)) break;
    }
    return ISO_OK;
}

/* --- differences ------------------------------------------------------------------------------------------------ */

static double largest_in_column(const iso_record *r, int column)
{
    double most = 0;
    for (size_t i = 0; i < iso_record_rows(r); i++) most = fmax(most, fabs(iso_record_const_row(r, i)[column]));
    return most;
}

/* The differences between runs a and b, row by row, and the largest of each column. */
static iso_status compare_rows(iso_context *ctx, const iso_comparison *c, int run_a, int run_b,
                               iso_record **difference, double worst[ISO_DIFFERENCES])
{
    const iso_record *a = c->run[run_a].trajectory, *b = c->run[run_b].trajectory;
    const iso_clock first = c->clock == ISO_CLOCK_T ? ISO_CLOCK_TAU : ISO_CLOCK_T;
    const iso_clock second = c->clock == ISO_CLOCK_S ? ISO_CLOCK_TAU : ISO_CLOCK_S;
    const char *const names[ISO_DIFFERENCES] = {
        iso_clock_name(c->clock), "omega", "n", "M", "gamma", iso_clock_name(first), iso_clock_name(second)};
    const double scale[2] = {largest_in_column(a, (int)first), largest_in_column(a, (int)second)};
    iso_status status = iso_record_create(ctx, ISO_DIFFERENCES, names, difference);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(a) && i < iso_record_rows(b); i++) {
        const double *x = iso_record_const_row(a, i), *y = iso_record_const_row(b, i);
        double *d;
        status = iso_record_append(ctx, *difference, &d);
        if (status != ISO_OK) break;
        d[0] = x[c->clock];
        for (int v = 0; v < 4; v++)
            d[1 + v] = relative_difference(x + ISO_COLUMN_BALL + 3 * v, y + ISO_COLUMN_BALL + 3 * v);
        d[5] = scale[0] > 0 ? fabs(x[first] - y[first]) / scale[0] : 0;
        d[6] = scale[1] > 0 ? fabs(x[second] - y[second]) / scale[1] : 0;
        worst[0] = d[0];
        for (int j = 1; j < ISO_DIFFERENCES; j++) worst[j] = iso_larger(worst[j], d[j]);
    }
    return status;
}

static iso_status compare_runs(iso_context *ctx, iso_comparison *c)
{
    ISO_TRY(compare_rows(ctx, c, ISO_BALL, ISO_POINT, &c->difference, c->worst));
    for (int b = 0; c->runs == ISO_BACKENDS && b < ISO_INTEGRATED; b++)
        ISO_TRY(compare_rows(ctx, c, ISO_BY_EXACT, b, &c->from_exact[b], c->worst_from_exact[b]));
    return ISO_OK;
}

iso_status iso_compare(iso_context *ctx, const iso_scene *scene, bool (*progress)(void *data, double part),
                       void *data, iso_comparison **comparison)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_comparison *c = *comparison = calloc(1, sizeof *c);
    if (!c) return iso_context_no_memory(ctx, "a comparison");
    comparer r = {.ctx = ctx, .scene = scene, .effects = iso_scene_acting(scene), .out = c};
    iso_status status = iso_scene_check_times(ctx, scene);
    if (status == ISO_OK) status = open_backend(&r, ISO_BACKEND_BALL);
    if (status == ISO_OK) status = iso_orbit_check_time(r.orbit[ISO_BALL], scene->end);
    if (status == ISO_OK) status = open_backend(&r, ISO_BACKEND_POINT);
    if (status == ISO_OK) status = open_exact(&r);
    if (status == ISO_OK) status = add_rows(&r, progress, data);
    for (int b = 0; b < ISO_BACKENDS; b++) iso_orbit_free(r.orbit[b]);
    const iso_record *rows = c->runs > 0 ? c->run[c->runs - 1].trajectory : NULL;
    if (rows && iso_record_rows(rows) > 0 && (status == ISO_OK || status == ISO_NUMERICAL || status == ISO_STOPPED)) {
        const iso_status rows_status = compare_runs(ctx, c);
        if (rows_status == ISO_OK) return status;
        status = rows_status;
    }
    iso_comparison_free(c);
    *comparison = NULL;
    return status;
}

void iso_comparison_free(iso_comparison *c)
{
    if (!c) return;
    for (int b = 0; b < ISO_BACKENDS; b++) iso_record_free(c->run[b].trajectory);
    iso_record_free(c->difference);
    for (int b = 0; b < ISO_INTEGRATED; b++) iso_record_free(c->from_exact[b]);
    free(c);
}

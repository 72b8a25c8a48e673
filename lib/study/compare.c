#include "study/compare.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

#include "base/vec3_impl.h"

static double processor_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* --- integrals along an orbit ------------------------------------------------------------------------------------- */

/* Lists the integrals that hold, with their values at the start. */
static void list_drifts(const iso_orbit *orbit, const iso_sample *start, iso_backend_run *run)
{
    const iso_units *units = iso_orbit_units(orbit);
    for (int s = 0; iso_systems[s]; s++)
        for (const iso_integral *i = iso_systems[s]->integrals; i->name; i++) {
            double size;
            if ((i->holds && !i->holds(&units->own)) || run->drifts == ISO_MAX_INTEGRALS) continue;
            const double own = iso_orbit_integral(orbit, iso_systems[s], i, start, &size);
            run->drift[run->drifts++] = (iso_drift){iso_systems[s], i, own * iso_unit(units, i->dimension), 0};
        }
}

static void follow_drifts(const iso_orbit *orbit, const iso_sample *sample, const double at_start[],
                          iso_backend_run *run)
{
    for (int i = 0; i < run->drifts; i++) {
        iso_drift *d = &run->drift[i];
        double size;
        const double value = iso_orbit_integral(orbit, d->system, d->integral, sample, &size);
        if (size > 0) d->worst = fmax(d->worst, fabs(value - at_start[i]) / size);
    }
}

/* --- one backend -------------------------------------------------------------------------------------------------- */

typedef struct report {
    bool (*progress)(double part, void *data);
    void *data;
    double done, share; /* part done before this backend, and its share of the whole */
} report;

static iso_status append(iso_context *ctx, iso_record *record, const iso_sample *sample)
{
    double *row;
    const iso_status status = iso_record_append(ctx, record, &row);
    for (int c = 0; status == ISO_OK && c < ISO_TRAJECTORY_COLUMNS; c++) row[c] = iso_sample_column(sample, c);
    return status;
}

static iso_status follow(iso_context *ctx, const iso_scene *scene, iso_orbit *orbit, const report *r,
                         iso_backend_run *run)
{
    const size_t rows = iso_scene_rows(scene);
    double at_start[ISO_MAX_INTEGRALS], size;
    for (size_t i = 0; i < rows; i++) {
        iso_sample sample;
        iso_status status = iso_orbit_at(orbit, iso_scene_time(scene, i), &sample);
        if (status == ISO_OK) status = append(ctx, run->trajectory, &sample);
        if (status != ISO_OK) return status;
        if (i == 0) list_drifts(orbit, &sample, run);
        for (int d = 0; i == 0 && d < run->drifts; d++)
            at_start[d] = iso_orbit_integral(orbit, run->drift[d].system, run->drift[d].integral, &sample, &size);
        follow_drifts(orbit, &sample, at_start, run);
        if (r->progress && !r->progress(r->done + r->share * (double)(i + 1) / (double)rows, r->data)) break;
    }
    return ISO_OK;
}

static iso_status run_backend(iso_context *ctx, const iso_scene *scene, iso_picture backend, const report *r,
                              iso_comparison *c)
{
    iso_backend_run *run = &c->run[backend];
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    iso_orbit *orbit;
    iso_status status = iso_record_create(ctx, ISO_TRAJECTORY_COLUMNS, iso_trajectory_columns, &run->trajectory);
    if (status != ISO_OK) return status;
    o.backend = backend;
    o.method = iso_method_find(scene->method);
    o.tolerance = scene->tolerance;
    o.show = ISO_BOTH;
    for (int clock = 0; clock < ISO_CLOCKS; clock++) o.carry[clock] = true;
    const double begin = processor_seconds();
    status = iso_orbit_create(ctx, &scene->params, &scene->start, &o, &orbit);
    if (status != ISO_OK) return status;
    status = follow(ctx, scene, orbit, r, run);
    run->seconds = processor_seconds() - begin;
    run->method = iso_orbit_method(orbit);
    run->statistics = iso_orbit_statistics(orbit);
    c->clock = o.clock;
    c->h = iso_orbit_energy(orbit);
    c->eps = iso_orbit_coupling(orbit);
    iso_orbit_free(orbit);
    return status;
}

/* --- differences -------------------------------------------------------------------------------------------------- */

/* |a - b| / |a| for vectors whose squares may overflow */
static double vector_difference(const double a[3], const double b[3])
{
    const double size = fmax(fabs(a[0]), fmax(fabs(a[1]), fabs(a[2])));
    if (!(size > 0)) return 0;
    double d[3], u[3];
    for (int i = 0; i < 3; i++) {
        d[i] = a[i] / size - b[i] / size;
        u[i] = a[i] / size;
    }
    return norm(d) / norm(u);
}

static double largest_in_column(const iso_record *r, int column)
{
    double largest = 0;
    for (size_t i = 0; i < iso_record_rows(r); i++) largest = fmax(largest, fabs(iso_record_const_row(r, i)[column]));
    return largest;
}

static iso_status compare_rows(iso_context *ctx, iso_comparison *c)
{
    const iso_record *a = c->run[ISO_BALL].trajectory, *b = c->run[ISO_POINT].trajectory;
    const iso_clock first = c->clock == ISO_CLOCK_T ? ISO_CLOCK_TAU : ISO_CLOCK_T;
    const iso_clock second = c->clock == ISO_CLOCK_S ? ISO_CLOCK_TAU : ISO_CLOCK_S;
    const char *const names[ISO_DIFFERENCES] = {
        iso_clock_name(c->clock), "omega", "n", "M", "gamma", iso_clock_name(first), iso_clock_name(second)};
    const double scale[2] = {largest_in_column(a, (int)first), largest_in_column(a, (int)second)};
    iso_status status = iso_record_create(ctx, ISO_DIFFERENCES, names, &c->difference);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(a) && i < iso_record_rows(b); i++) {
        const double *x = iso_record_const_row(a, i), *y = iso_record_const_row(b, i);
        double *d;
        status = iso_record_append(ctx, c->difference, &d);
        if (status != ISO_OK) break;
        d[0] = x[c->clock];
        for (int v = 0; v < 4; v++) d[1 + v] = vector_difference(x + 3 + 3 * v, y + 3 + 3 * v);
        d[5] = scale[0] > 0 ? fabs(x[first] - y[first]) / scale[0] : 0;
        d[6] = scale[1] > 0 ? fabs(x[second] - y[second]) / scale[1] : 0;
        c->worst[0] = d[0];
        for (int j = 1; j < ISO_DIFFERENCES; j++) c->worst[j] = fmax(c->worst[j], d[j]);
    }
    return status;
}

iso_status iso_compare(iso_context *ctx, const iso_scene *scene, bool (*progress)(double part, void *data),
                       void *data, iso_comparison **comparison)
{
    iso_comparison *c = *comparison = calloc(1, sizeof *c);
    if (!c) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for a comparison");
    iso_status status = ISO_OK;
    for (iso_picture backend = ISO_BALL; backend <= ISO_POINT && status == ISO_OK; backend++) {
        const report r = {progress, data, backend / 2.0, 0.5};
        status = run_backend(ctx, scene, backend, &r, c);
    }
    const bool has_rows = c->run[ISO_BALL].trajectory && c->run[ISO_POINT].trajectory &&
                          iso_record_rows(c->run[ISO_POINT].trajectory) > 0;
    if (has_rows && (status == ISO_OK || status == ISO_NUMERICAL)) {
        const iso_status rows_status = compare_rows(ctx, c);
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
    free(c);
}

/* rows.c - along a trajectory, from row to row (rows_impl.h). */
#include "orbit/rows_impl.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "model/effects/effects_impl.h"
#include "model/model_impl.h"
#include "orbit/watch_impl.h"

static void add_sample(iso_rows *r, const double row[])
{
    double own[ISO_STATE];
    iso_row_state(r->columns, r->model, row, own);
    for (int i = 0; i < 3; i++) own[i] /= r->unit;
    iso_two_point_add(r->quadrature, own);
}

/* A gap is measured if nothing but the six numbers of the model goes on from row to row, by equations that have a
 * series. */
iso_status iso_rows_begin(iso_rows *r, const iso_orbit *orbit, const double first[], double tolerance)
{
    const iso_system *system = r->model == ISO_BALL ? &iso_system_ball : &iso_system_point;
    iso_rows_free(r);
    r->last = calloc(r->width + 1, sizeof *r->last);
    r->now = calloc(r->width + 1, sizeof *r->now);
    if (!r->last || !r->now) return iso_context_no_memory(r->ctx, "a row");
    memcpy(r->last, first, r->width * sizeof *first);
    if (!orbit || r->alone) return ISO_OK;
    const iso_model *model = &orbit->model;
    if (model->system != system || model->clock != r->clock || r->clock != system->clock ||
        model->moving != ISO_STATE || orbit->rests || iso_effects_breaking(&orbit->effects))
        return ISO_OK;
    r->unit = r->model == ISO_BALL ? orbit->units.w : orbit->unit_M;
    memcpy(r->unit_clock, orbit->unit_clock, sizeof r->unit_clock);
    memcpy(r->has_clock, orbit->options.with_clock, sizeof r->has_clock);
    return iso_two_point_create(r->ctx, model, tolerance, &r->quadrature);
}

void iso_rows_free(iso_rows *r)
{
    iso_two_point_free(r->quadrature);
    free(r->last);
    free(r->now);
    r->quadrature = NULL;
    r->last = r->now = NULL;
    r->measured = r->last_measured = false;
}

void iso_rows_take(iso_rows *r, const double row[])
{
    memcpy(r->now, row, r->width * sizeof *row);
    r->measured = false;
}

void iso_rows_keep(iso_rows *r)
{
    double *const now = r->now;
    r->now = r->last, r->last = now;
    r->last_measured = r->measured;
}

static double step_of(const iso_rows *r)
{
    const int time = r->columns[r->clock];
    return r->now[time] - r->last[time];
}

bool iso_rows_measure(iso_rows *r, double noise, iso_row_gap *gap)
{
    iso_gap own;
    if (!r->quadrature) return false;
    if (!r->last_measured) add_sample(r, r->last);
    add_sample(r, r->now);
    r->measured = true;
    r->last_measured = false;
    gap->step = step_of(r);
    if (!iso_two_point_measure(r->quadrature, gap->step / r->unit_clock[r->clock], noise, &own)) return false;
    for (int k = 0; k < ISO_CLOCKS; k++) {
        gap->gained[k] = r->has_clock[k] ? own.gained[k] * r->unit_clock[k] : NAN;
        gap->error[k] = own.error[k] * r->unit_clock[k];
    }
    memcpy(gap->off, own.motion, sizeof gap->off);
    gap->miss = own.defect;
    return true;
}

iso_status iso_rows_integrate(iso_rows *r, iso_row_gap *gap)
{
    double here[ISO_STATE];
    iso_orbit *orbit = NULL;
    gap->step = step_of(r);
    iso_status status = r->open(r->data, r->last, &orbit);
    if (status == ISO_OK) status = iso_orbit_at(orbit, gap->step, &gap->reached);
    const double tolerance = status == ISO_OK ? orbit->options.tolerance : 0;
    iso_orbit_free(orbit);
    if (status != ISO_OK) return status;
    for (int k = 0; k < ISO_CLOCKS; k++) {
        gap->gained[k] = gap->reached.clock[k];
        gap->error[k] = fmax(tolerance, 4 * DBL_EPSILON) * fabs(gap->gained[k]);
    }
    iso_row_state(r->columns, r->model, r->now, here);
    const double *there = r->model == ISO_BALL ? gap->reached.ball : gap->reached.point;
    gap->miss = iso_distance(here, there);
    for (int v = 0; v < ISO_STATE; v += 3) {
        const double size = fmax(norm(here + v), norm(there + v));
        for (int i = v; i < v + 3; i++) gap->off[i] = size > 0 ? (here[i] - there[i]) / size : 0;
    }
    return ISO_OK;
}

double iso_rows_largest_miss(iso_context *ctx, const iso_record *header, double row_tolerance)
{
    double tolerance = 0;
    iso_status unused;
    iso_record_get_numbers(ctx, header, "tolerance", 1, &tolerance, &unused);
    const double row = row_tolerance > ISO_ROW_TOLERANCE ? 10 * row_tolerance : 0;
    return fmax(fmax(1e-5, row), 100 * tolerance);
}

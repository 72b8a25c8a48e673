#include "study/error.h"

#include <float.h>
#include <math.h>

#include "base/arithmetic_impl.h"
#include "base/vec3_impl.h"
#include "study/seconds_impl.h"

/* How far from the start the moved orbits begin: far above the error of their method, and still in proportion. */
static const double AWAY = 1e-7;

/* Their directions, in units of AWAY: what moves omega, n and J. One alone may happen to miss what grows. */
enum { MOVED = 4 };
static const double directions[MOVED][3][3] = {
    {{0.6, -0.9, 0.7}, {-0.8, 0.5, 1.0}, {0.9, 0.8, -0.6}},
    {{-0.7, -0.8, 0.5}, {0.9, 1.0, -0.6}, {0.8, -0.7, 0.9}},
    {{0.9, 0.6, 1.0}, {0.7, -0.5, 0.8}, {-0.8, 0.9, 0.7}},
    {{1.0, -0.5, -0.8}, {0.6, 0.9, 0.7}, {0.7, 0.6, 1.0}},
};

/* What the second orbit of the same method, at a hundredth of the tolerance, is taken to have of the first one's
 * error. */
static const double SHARE = 0.1;

/* Of an orbit by steps that checks one without: some five seconds. */
enum { MOST_STEPS = 200000 };

/* --- rows ------------------------------------------------------------------------------------------------------- */

void iso_error_keep(iso_error_rows *rows, const iso_sample *sample)
{
    if (rows->stride == 0) rows->stride = 1;
    if (rows->seen % rows->stride == 0) {
        if (rows->count == ISO_ERROR_ROWS) {
            for (size_t i = 0; 2 * i < ISO_ERROR_ROWS; i++) rows->sample[i] = rows->sample[2 * i];
            rows->count = (ISO_ERROR_ROWS + 1) / 2;
            rows->stride *= 2;
        }
        if (rows->seen % rows->stride == 0) rows->sample[rows->count++] = *sample;
    }
    rows->last = *sample;
    rows->seen++;
}

/* Row i of those kept, the last row after them. */
static const iso_sample *row_of(const iso_error_rows *rows, size_t i)
{
    return i < rows->count ? &rows->sample[i] : &rows->last;
}

/* --- the other orbits ------------------------------------------------------------------------------------------- */

/* Options of the finer orbit; false where there is none. */
static bool make_finer(const iso_orbit *orbit, iso_orbit_options *o)
{
    const iso_method *own = iso_orbit_method(orbit);
    const bool exact = iso_orbit_exact(orbit) != NULL;
    o->backend = iso_orbit_model(orbit)->system == &iso_system_ball ? ISO_BALL : ISO_POINT;
    o->max_steps = exact ? MOST_STEPS : 20 * (iso_orbit_statistics(orbit).steps + 100);
    if (iso_method_auto(iso_orbit_model(orbit))->own_equations) {
        o->method = iso_method_with_more_digits(own->digits > 0 ? own->digits : ISO_DOUBLE_DIGITS);
        o->tolerance = ISO_LEAST_TOLERANCE;
        return o->method && !own->reference;
    }
    o->method = own;
    o->tolerance /= 100;
    return o->tolerance >= ISO_LEAST_TOLERANCE && !own->reference && !exact;
}

/* The start and J, moved by about AWAY, to another valid start. J stays where its neighbours are no body's. */
static iso_status move_start(iso_context *ctx, const iso_orbit_options *o, const double direction[3][3], iso_params *p,
                             iso_start *start)
{
    double y[ISO_STATE];
    iso_params moved;
    iso_body body = p->body;
    const double size = largest(start->y);
    for (int i = 0; i < 3; i++) {
        y[i] = start->y[i] + AWAY * size * direction[0][i];
        y[3 + i] = start->y[3 + i] + AWAY * direction[1][i];
        body.inertia[i] *= 1 + AWAY * direction[2][i];
    }
    make_unit(y + 3);
    if (body.surface == ISO_REDUCED) {
        double J[3];
        for (int i = 0; i < 3; i++) J[i] = p->J[i] * (1 + AWAY * direction[2][i]);
        if (iso_params_reduced(ctx, p->k, J, &moved) == ISO_OK &&
            (p->D == 0 || iso_params_set_D(ctx, p->D, &moved) == ISO_OK)) {
            moved.body = p->body;
            *p = moved;
        }
    } else if (iso_params_physical(ctx, &body, &moved) == ISO_OK) {
        *p = moved;
    }
    const double eps = start->eps;
    if (start->model == ISO_POINT)
        return iso_start_point(ctx, y, y + 3, isnan(eps) ? NULL : &eps, true, start);
    const bool twists = o->effects && iso_effects_twist(o->effects);
    return iso_start_ball(ctx, y, y + 3, twists ? ISO_SPIN_KEEP : ISO_SPIN_REMOVE, start);
}

/* --- errors ----------------------------------------------------------------------------------------------------- */

/* The larger distance of the two vectors of a from those of b, relative to the shorter one; NaN: not shown. */
static double state_distance(const double a[ISO_STATE], const double b[ISO_STATE])
{
    double most = 0;
    if (isnan(a[0])) return NAN;
    for (int v = 0; v < ISO_STATE; v += 3)
        most = fmax(most, fmax(relative_difference(a + v, b + v), relative_difference(b + v, a + v)));
    return most;
}

static void note(iso_error_of *e, double error, double time)
{
    if (!(error <= e->worst)) e->worst = error, e->worst_time = time;
    e->last = error;
}

typedef struct finder {
    iso_orbit *finer, *moved[MOVED];
    iso_clock clock;
    double factor; /* from the distance to the finer orbit to the error */
    double largest_clock[ISO_CLOCKS];
    iso_error *out;
} finder;

static double worst_state(const iso_error *e)
{
    return fmax(e->state[0].worst, e->state[1].worst); /* a NaN is not shown */
}

static const double *six(const iso_sample *s, int picture)
{
    return picture == ISO_BALL ? s->ball : s->point;
}

/* The estimate at one row. */
static iso_status compare_row(finder *f, const iso_sample *row)
{
    const double least = ISO_ERROR_ULPS * DBL_EPSILON, ulps = least / AWAY, time = row->clock[f->clock];
    iso_sample fine, moved[MOVED];
    iso_status status = iso_orbit_at(f->finer, time, &fine);
    for (int m = 0; status == ISO_OK && m < MOVED; m++) status = iso_orbit_at(f->moved[m], time, &moved[m]);
    if (status != ISO_OK) return status;
    for (int picture = ISO_BALL; picture <= ISO_POINT; picture++) {
        const double off = state_distance(six(row, picture), six(&fine, picture)), before = worst_state(f->out);
        double start = least;
        for (int m = 0; m < MOVED; m++) start += ulps * state_distance(six(&fine, picture), six(&moved[m], picture));
        note(&f->out->state[picture], f->factor * off + start, time);
        if (!(worst_state(f->out) <= before)) f->out->start = start;
    }
    for (int c = 0; c < ISO_CLOCKS; c++) {
        if (isnan(row->clock[c]) || c == (int)f->clock || f->largest_clock[c] == 0) continue;
        double start = least * f->largest_clock[c];
        for (int m = 0; m < MOVED; m++) start += ulps * fabs(fine.clock[c] - moved[m].clock[c]);
        const double e = (f->factor * fabs(row->clock[c] - fine.clock[c]) + start) / f->largest_clock[c];
        note(&f->out->clock[c], e < 1 ? e / (1 - e) : e, time); /* the true clock may be smaller by e */
    }
    return ISO_OK;
}

static iso_status open_orbits(iso_context *ctx, const iso_params *params, const iso_start *start,
                              const iso_orbit_options *o, const iso_orbit *orbit, finder *f)
{
    iso_orbit_options moved = *o;
    iso_status status = iso_orbit_create(ctx, params, start, o, &f->finer);
    if (o->method->own_equations) moved.method = iso_method_auto(iso_orbit_model(orbit)); /* exact enough, and faster */
    for (int m = 0; status == ISO_OK && m < MOVED; m++) {
        iso_params p = *params;
        iso_start s = *start;
        status = move_start(ctx, o, directions[m], &p, &s);
        if (status == ISO_OK) status = iso_orbit_create(ctx, &p, &s, &moved, &f->moved[m]);
    }
    return status;
}

iso_status iso_error_find(iso_context *ctx, const iso_params *params, const iso_start *start,
                          const iso_orbit_options *options, const iso_orbit *orbit, const iso_error_rows *rows,
                          iso_error *error)
{
    ISO_DEFAULT_ARITHMETIC;
    static const iso_error_of unknown = {NAN, NAN, NAN};
    const double begin = processor_seconds();
    iso_orbit_options o = *options;
    finder f = {.clock = o.clock, .out = error};
    if (rows->seen == 0) return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "there is no row");
    if (!make_finer(orbit, &o))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "method", "there is nothing finer than %s at %g for this model",
                                iso_orbit_method(orbit)->name, options->tolerance);
    *error = (iso_error){{unknown, unknown}, {unknown, unknown, unknown}, .method = o.method, .tolerance = o.tolerance};
    error->rows = rows->count + ((rows->seen - 1) % rows->stride != 0);
    for (int c = 0; c < ISO_CLOCKS; c++)
        for (size_t i = 0; i < error->rows; i++)
            f.largest_clock[c] = fmax(f.largest_clock[c], fabs(row_of(rows, i)->clock[c]));
    f.factor = o.method->own_equations ? 1 : 1 / (1 - SHARE);
    iso_status status = open_orbits(ctx, params, start, &o, orbit, &f);
    for (size_t i = 0; status == ISO_OK && i < error->rows; i++) status = compare_row(&f, row_of(rows, i));
    iso_orbit_free(f.finer);
    for (int m = 0; m < MOVED; m++) iso_orbit_free(f.moved[m]);
    error->seconds = processor_seconds() - begin;
    return status;
}

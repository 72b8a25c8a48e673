/* The estimated error of an orbit: a finer orbit and four moved ones run beside it, see error.h. */
#include "study/study_impl.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/arithmetic_impl.h"
#include "base/number_impl.h"
#include "base/resources_impl.h"
#include "base/vec3_impl.h"
#include "method/methods_impl.h"
#include "model/model_impl.h"
#include "orbit/watch_impl.h"

/* How far from the start the moved orbits begin, relative: far above the error of their method, but small enough that
 * their distance grows in proportion. */
static const double AWAY = 1e-7;

/* Their directions, in units of AWAY: for omega, n and J. There are four, since a single one may by chance be one in
 * which the distance does not grow. */
enum { MOVED = 4 };
static const double directions[MOVED][3][3] = {
    {{0.6, -0.9, 0.7}, {-0.8, 0.5, 1.0}, {0.9, 0.8, -0.6}},
    {{-0.7, -0.8, 0.5}, {0.9, 1.0, -0.6}, {0.8, -0.7, 0.9}},
    {{0.9, 0.6, 1.0}, {0.7, -0.5, 0.8}, {-0.8, 0.9, 0.7}},
    {{1.0, -0.5, -0.8}, {0.6, 0.9, 0.7}, {0.7, 0.6, 1.0}},
};

/* The assumed error of an orbit by the same method at a hundredth of the tolerance, as a part of the first orbit's
 * error. */
static const double SHARE = 0.1;

/* Below this tolerance methods other than series only collect rounding errors. */
static const double FINEST_OF_OTHERS = 1e-14;

/* The finer orbit may take this many steps for each step of the orbit, and SPARE_STEPS more. Steps of other methods are
 * shorter than those of series. */
enum { STEPS_FOR_ONE = 20, OTHERS_FOR_ONE = 400, SPARE_STEPS = 2000 };

/* It may take this many where the orbit has no steps (backend exact): some five seconds. */
enum { MOST_STEPS = 200000 };

/* `worst` of a clock is an absolute error until the largest value of the clock is known. */
struct iso_error_finder {
    iso_context *ctx;
    const iso_orbit *orbit;
    iso_orbit *finer, *moved[MOVED];
    iso_clock clock;
    double factor; /* from the distance to the finer orbit to the error */
    double largest_clock[ISO_CLOCKS];
    iso_error found;
};

/* --- the other orbits ------------------------------------------------------------------------------------------- */

/* Options of the finer orbit; false where there is none. */
static bool make_finer(const iso_orbit *orbit, iso_orbit_options *o)
{
    const iso_method *own = iso_orbit_method(orbit);
    const bool exact = iso_orbit_exact(orbit) != NULL;
    const iso_method *other = iso_method_of_other_kind(iso_orbit_model(orbit));
    o->backend = iso_orbit_model(orbit)->system == &iso_system_ball ? ISO_BACKEND_BALL : ISO_BACKEND_POINT;
    if (other && own->own_equations && !own->splits) { /* two methods of one kind may miss the same */
        o->method = other;
        o->tolerance = FINEST_OF_OTHERS;
        return !own->reference;
    }
    if (iso_method_auto(iso_orbit_model(orbit))->own_equations) {
        o->method = iso_method_with_more_digits(own->digits > 0 ? own->digits : ISO_DOUBLE_DIGITS);
        o->tolerance = ISO_LEAST_TOLERANCE;
        return o->method && !own->reference;
    }
    o->method = own;
    o->tolerance /= 100;
    return o->tolerance >= ISO_LEAST_TOLERANCE && !own->reference && !exact;
}

/* Moves the start and J by about AWAY, to another valid start. J stays as it is where no body has the moved J. */
static iso_status move_start(iso_context *ctx, const iso_orbit_options *o, const double direction[3][3],
                             iso_params *p, iso_start *start)
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
    if (start->model == ISO_POINT) return iso_start_point(ctx, y, y + 3, isnan(eps) ? NULL : &eps, true, start);
    const bool twists = o->effects && iso_effects_twist(o->effects);
    return iso_start_ball(ctx, y, y + 3, twists ? ISO_SPIN_KEEP : ISO_SPIN_REMOVE, start);
}

/* The steps that the finer and the moved orbits may take, as far as the orbit has come now. */
static void allow_steps(iso_error_finder *f)
{
    const bool exact = iso_orbit_exact(f->orbit) != NULL;
    const bool alike = iso_orbit_method(f->finer)->own_equations == iso_orbit_method(f->orbit)->own_equations;
    const long most =
        exact ? MOST_STEPS
              : (alike ? STEPS_FOR_ONE : OTHERS_FOR_ONE) * iso_orbit_statistics(f->orbit).steps + SPARE_STEPS;
    iso_orbit_allow_steps(f->finer, most);
    for (int m = 0; m < MOVED; m++) iso_orbit_allow_steps(f->moved[m], most);
}

static iso_status open_orbits(iso_error_finder *f, const iso_params *params, const iso_start *start,
                              const iso_orbit_options *o)
{
    iso_orbit_options moved = *o;
    iso_status status = iso_orbit_create(f->ctx, params, start, o, &f->finer);
    if (iso_method_auto(iso_orbit_model(f->orbit))->own_equations) /* it is exact enough, and faster */
        moved.method = iso_method_auto(iso_orbit_model(f->orbit));
    for (int m = 0; status == ISO_OK && m < MOVED; m++) {
        iso_params p = *params;
        iso_start s = *start;
        status = move_start(f->ctx, o, directions[m], &p, &s);
        if (status == ISO_OK) status = iso_orbit_create(f->ctx, &p, &s, &moved, &f->moved[m]);
    }
    return status;
}

/* --- one row ---------------------------------------------------------------------------------------------------- */

static void note(iso_error_of *e, double error, double time)
{
    if (!(error <= e->worst)) e->worst = error, e->worst_time = time;
    e->last = error;
}

static double worst_state(const iso_error *e)
{
    return fmax(e->state[0].worst, e->state[1].worst); /* fmax passes over a NaN, which is not shown */
}

static const double *six(const iso_sample *s, int model)
{
    return model == ISO_BALL ? s->ball : s->point;
}

static void compare_states(iso_error_finder *f, const iso_sample *row, const iso_sample *fine,
                           const iso_sample moved[MOVED])
{
    const double least = ISO_ERROR_ULPS * DBL_EPSILON, ulps = least / AWAY;
    for (int model = ISO_BALL; model <= ISO_POINT; model++) {
        const double off = iso_distance(six(row, model), six(fine, model)), before = worst_state(&f->found);
        double start = least;
        for (int m = 0; m < MOVED; m++) start += ulps * iso_distance(six(fine, model), six(&moved[m], model));
        note(&f->found.state[model], f->factor * off + start, row->clock[f->clock]);
        if (!(worst_state(&f->found) <= before)) f->found.start = start;
    }
}

static void compare_clocks(iso_error_finder *f, const iso_sample *row, const iso_sample *fine,
                           const iso_sample moved[MOVED])
{
    const double ulps = ISO_ERROR_ULPS * DBL_EPSILON / AWAY;
    for (int c = 0; c < ISO_CLOCKS; c++) {
        double start = 0;
        if (isnan(row->clock[c]) || c == (int)f->clock) continue;
        f->largest_clock[c] = fmax(f->largest_clock[c], fabs(row->clock[c]));
        for (int m = 0; m < MOVED; m++) start += ulps * fabs(fine->clock[c] - moved[m].clock[c]);
        note(&f->found.clock[c], f->factor * fabs(row->clock[c] - fine->clock[c]) + start, row->clock[f->clock]);
    }
}

iso_status iso_error_finder_add(iso_error_finder *f, const iso_sample *row)
{
    ISO_DEFAULT_ARITHMETIC;
    const double begin = processor_seconds(), time = row->clock[f->clock];
    iso_sample fine, moved[MOVED];
    allow_steps(f);
    iso_status status = iso_orbit_at(f->finer, time, &fine);
    for (int m = 0; status == ISO_OK && m < MOVED; m++) status = iso_orbit_at(f->moved[m], time, &moved[m]);
    if (status == ISO_OK) {
        compare_states(f, row, &fine, moved);
        compare_clocks(f, row, &fine, moved);
        f->found.rows++;
    }
    f->found.seconds += processor_seconds() - begin;
    return status;
}

/* --- all rows --------------------------------------------------------------------------------------------------- */

iso_status iso_error_finder_create(iso_context *ctx, const iso_params *params, const iso_start *start,
                                   const iso_orbit_options *options, const iso_orbit *orbit,
                                   iso_error_finder **finder)
{
    ISO_DEFAULT_ARITHMETIC;
    static const iso_error_of unknown = {NAN, NAN, NAN};
    iso_orbit_options o = iso_orbit_defaults(start);
    *finder = NULL;
    if (options) o = *options;
    const double tolerance = o.tolerance;
    if (!make_finer(orbit, &o))
        return ISO_FAIL_ARGUMENT(ctx, "method", "there is nothing finer than %s at %s for this model",
                                 iso_orbit_method(orbit)->name, ISO_SHORT(tolerance));
    iso_error_finder *f = calloc(1, sizeof *f);
    if (!f) return iso_context_no_memory(ctx, "the error of an orbit");
    const double begin = processor_seconds();
    f->ctx = ctx;
    f->orbit = orbit;
    f->clock = o.clock;
    f->factor = o.method->own_equations ? 1 : 1 / (1 - SHARE);
    f->found =
        (iso_error){{unknown, unknown}, {unknown, unknown, unknown}, .method = o.method, .tolerance = o.tolerance};
    const iso_status status = open_orbits(f, params, start, &o);
    f->found.seconds = processor_seconds() - begin;
    if (status != ISO_OK) return iso_error_finder_free(f), status;
    *finder = f;
    return ISO_OK;
}

void iso_error_finder_free(iso_error_finder *f)
{
    if (!f) return;
    iso_orbit_free(f->finer);
    for (int m = 0; m < MOVED; m++) iso_orbit_free(f->moved[m]);
    free(f);
}

/* The absolute error of a clock as a relative one. The largest value of the clock may itself be too large by it. */
static double relative_to(double largest_clock, double error)
{
    const double e = error / largest_clock + ISO_ERROR_ULPS * DBL_EPSILON;
    return e < 1 ? e / (1 - e) : e;
}

iso_error iso_error_finder_read(const iso_error_finder *f)
{
    static const iso_error_of unknown = {NAN, NAN, NAN};
    iso_error error = f->found;
    for (int c = 0; c < ISO_CLOCKS; c++) {
        const double most = f->largest_clock[c];
        const iso_error_of *absolute = &f->found.clock[c];
        error.clock[c] = most == 0 ? unknown
                                   : (iso_error_of){relative_to(most, absolute->worst), absolute->worst_time,
                                                    relative_to(most, absolute->last)};
    }
    return error;
}

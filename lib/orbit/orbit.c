#include "orbit/orbit.h"

#include <math.h>
#include <stdlib.h>

#include "base/vec3_impl.h"
#include "map/state.h"

struct iso_orbit {
    iso_context *ctx;
    iso_orbit_options options;
    iso_units units;
    double unit_M, unit_clock[ISO_CLOCKS]; /* one own unit in the caller's */
    double h, eps;                         /* own units                    */
    iso_model model;
    iso_integrator *integrator;
};

iso_orbit_options iso_orbit_defaults(const iso_start *start)
{
    return (iso_orbit_options){.backend = ISO_AUTO,
                               .tolerance = 1e-12,
                               .clock = start->model == ISO_BALL ? ISO_CLOCK_T : ISO_CLOCK_S,
                               .show = start->model};
}

double iso_sample_column(const iso_sample *sample, int column)
{
    if (column < ISO_CLOCKS) return sample->clock[column];
    column -= ISO_CLOCKS;
    return column < ISO_STATE ? sample->ball[column] : sample->point[column - ISO_STATE];
}

static bool all_finite(const double x[], int count)
{
    for (int i = 0; i < count; i++)
        if (!isfinite(x[i])) return false;
    return true;
}

/* --- the start, in own units ------------------------------------------------------------------------------------- */

static void set_units(iso_orbit *o, const iso_params *p, double speed)
{
    iso_units_choose(p, speed, &o->units);
    o->unit_M = iso_unit(&o->units, iso_system_point.fast_dimension);
    for (iso_clock c = 0; c < ISO_CLOCKS; c++) o->unit_clock[c] = iso_unit(&o->units, iso_clock_dimension(c));
}

static double largest(const double a[3])
{
    return fmax(fabs(a[0]), fmax(fabs(a[1]), fabs(a[2])));
}

/* A ball's start in y; every ball that moves has a point. */
static void start_ball(iso_orbit *o, const iso_params *p, const iso_start *start, double y[ISO_STATE])
{
    set_units(o, p, largest(start->y));
    copy(start->y, y, ISO_STATE);
    for (int i = 0; i < 3; i++) y[i] /= o->units.w;
    o->h = iso_ball_energy(&o->units.own, y);
    o->eps = iso_coupling(&o->units.own, o->h);
}

/* The point's potential and start in own units. */
static iso_field point_field(const iso_orbit *o, const iso_start *start, double y[ISO_STATE])
{
    iso_field field = {.p = o->units.own, .eps = start->eps / iso_unit(&o->units, iso_dimension_eps)};
    copy(start->y, y, ISO_STATE);
    for (int i = 0; i < 3; i++) y[i] /= o->unit_M;
    if (isnan(start->eps)) field.eps = iso_coupling(&field.p, iso_point_energy(&field.p, y));
    return field;
}

/* The angular speed of a ball whose M has the size that the start's M reaches on its potential, sqrt(2 |V|); in parts
 * that do not overflow, since the unit of time is not yet chosen. */
static double point_speed(iso_orbit *o, const iso_params *p, const iso_start *start)
{
    double y[ISO_STATE] = {0, 0, 0, start->y[3], start->y[4], start->y[5]};
    set_units(o, p, 0);
    const double eps = fabs(start->eps / iso_unit(&o->units, iso_dimension_eps)), M = largest(start->y) / o->unit_M;
    const double q = iso_system_point.q(&o->units.own, y, NULL);
    const double reached = sqrt(2) * sqrt(eps) * pow(q, -1 / (2 * p->k)); /* NAN on the level H = 0 */
    for (int i = 0; i < 3; i++) y[i] = fmax(M, reached);
    iso_point_to_ball(&o->units.own, y, y);
    return largest(y);
}

/* A point's start in y; gives the level H it lives on, 0 if it is that to 1e-9, and the size of the terms of H. */
static double start_point(iso_orbit *o, const iso_params *p, const iso_start *start, double y[ISO_STATE],
                          double *size)
{
    set_units(o, p, point_speed(o, p, start));
    const iso_field field = point_field(o, start, y);
    o->eps = field.eps;
    o->h = iso_energy(&field.p, field.eps);
    const double H = iso_system_point.integrals[0].value(&field, y, size);
    if (fabs(H) > 1e-9 * *size) return H;
    iso_system_point.project(&field, y);
    return 0;
}

static iso_status refuse_level(iso_context *ctx, double H, double size)
{
    return iso_context_fail(
        ctx, ISO_NOT_MAPPED, "M",
        "this point has energy H = %.6g of M^2/2 + |V|, and only on the level H = 0 is it the twin "
        "of a free ball: change M or eps, or leave eps out to have the one that fits; or stay with "
        "the point (backend point, as point)",
        H / size);
}

/* --- making an orbit --------------------------------------------------------------------------------------------- */

static iso_status set_up(iso_orbit *o, const iso_params *p, const iso_start *start)
{
    double y[ISO_MAX_STATE] = {0}, level = 0, size = 0;
    iso_orbit_options *opt = &o->options;
    if (opt->backend == ISO_AUTO) opt->backend = start->model;
    const bool needs_ball = opt->backend == ISO_BALL || opt->show != ISO_POINT || opt->clock != ISO_CLOCK_S ||
                            opt->carry[ISO_CLOCK_T] || opt->carry[ISO_CLOCK_TAU];
    const bool needs_point = opt->backend == ISO_POINT || opt->show != ISO_BALL;
    if (start->model == ISO_BALL) {
        start_ball(o, p, start, y);
        if (o->h == 0 && needs_point)
            return iso_context_fail(o->ctx, ISO_NOT_MAPPED, "angular_velocity",
                                    "a ball at rest (h = 0) has no twin: the point's potential would vanish");
    } else {
        level = start_point(o, p, start, y, &size);
        if (level != 0 && needs_ball) return refuse_level(o->ctx, level, size);
    }
    if (!all_finite(y, ISO_STATE) || !isfinite(o->eps) || !isfinite(o->h))
        return iso_context_fail(o->ctx, ISO_NUMERICAL, "",
                                "the start is out of the range of doubles in the ball's own "
                                "units: J or k is too extreme");
    if (opt->backend == ISO_POINT && start->model == ISO_BALL) iso_ball_to_point(&o->units.own, y, y);
    if (opt->backend == ISO_BALL && start->model == ISO_POINT) iso_point_to_ball(&o->units.own, y, y);
    const iso_system *system = opt->backend == ISO_BALL ? &iso_system_ball : &iso_system_point;
    const iso_field field = {.p = o->units.own,
                             .eps = opt->backend == ISO_POINT ? o->eps : 0,
                             .energy = opt->backend == ISO_POINT ? level : o->h};
    o->model = iso_model_assemble(system, &field, opt->clock, opt->carry);
    if (!opt->method) opt->method = iso_method_auto(&o->model);
    const iso_method_options m = {.tolerance = opt->tolerance};
    const iso_status status = iso_integrator_create(o->ctx, opt->method, &o->model, &m, &o->integrator);
    return status == ISO_OK ? iso_integrator_start(o->integrator, y) : status;
}

iso_status iso_orbit_create(iso_context *ctx, const iso_params *p, const iso_start *start,
                            const iso_orbit_options *options, iso_orbit **orbit)
{
    *orbit = NULL;
    iso_orbit *o = calloc(1, sizeof *o);
    if (!o) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for an orbit");
    o->ctx = ctx;
    o->options = *options;
    const iso_status status = set_up(o, p, start);
    if (status != ISO_OK) return iso_orbit_free(o), status;
    *orbit = o;
    return ISO_OK;
}

void iso_orbit_free(iso_orbit *o)
{
    if (!o) return;
    iso_integrator_free(o->integrator);
    free(o);
}

/* --- samples ------------------------------------------------------------------------------------------------------ */

static void to_users_units(const double own[ISO_STATE], double unit, double users[ISO_STATE])
{
    for (int i = 0; i < 3; i++) {
        users[i] = own[i] * unit;
        users[3 + i] = own[3 + i];
    }
}

/* A non-zero own number whose user's number is none, or has lost its digits, must not be shown. */
static iso_status check_range(const iso_orbit *o, const iso_sample *s)
{
    for (int c = 0; c < ISO_TRAJECTORY_COLUMNS; c++) {
        const double x = iso_sample_column(s, c);
        if (isinf(x))
            return iso_context_fail(o->ctx, ISO_NUMERICAL, "",
                                    "%s is too large for a double in these units: use "
                                    "other units of mass, length or time",
                                    iso_trajectory_columns[c]);
    }
    return ISO_OK;
}

static iso_status make_sample(const iso_orbit *o, double time, const double y[], iso_sample *s)
{
    const iso_params *own = &o->units.own;
    const bool is_ball = o->options.backend == ISO_BALL;
    double other[ISO_STATE];
    for (int i = 0; i < ISO_STATE; i++) s->ball[i] = s->point[i] = NAN;
    for (iso_clock c = 0; c < ISO_CLOCKS; c++) s->clock[c] = NAN;
    s->clock[o->model.clock] = time;
    for (int i = 0; i < o->model.carried; i++)
        s->clock[o->model.carry[i]] = y[ISO_STATE + i] * o->unit_clock[o->model.carry[i]];
    if (o->options.show != (is_ball ? ISO_BALL : ISO_POINT)) {
        if (is_ball)
            iso_ball_to_point(own, y, other);
        else
            iso_point_to_ball(own, y, other);
    }
    if (o->options.show != ISO_POINT) to_users_units(is_ball ? y : other, o->units.w, s->ball);
    if (o->options.show != ISO_BALL) to_users_units(is_ball ? other : y, o->unit_M, s->point);
    return check_range(o, s);
}

iso_status iso_orbit_at(iso_orbit *o, double time, iso_sample *sample)
{
    double y[ISO_MAX_STATE];
    const double own_time = time / o->unit_clock[o->model.clock];
    if (!isfinite(own_time))
        return iso_context_fail(o->ctx, ISO_BAD_ARGUMENT, "end",
                                "%s = %g is out of range: it is %g turns of this ball",
                                iso_clock_name(o->model.clock), time, own_time);
    const iso_status status = iso_integrator_at(o->integrator, own_time, y);
    return status == ISO_OK ? make_sample(o, time, y, sample) : status;
}

typedef struct sampled_event {
    const iso_orbit *orbit;
    double (*g)(const iso_sample *sample, const void *data);
    const void *data;
} sampled_event;

static double event_function(const iso_model *model, const double y[], const void *data)
{
    const sampled_event *e = data;
    iso_sample sample;
    (void)model;
    make_sample(e->orbit, NAN, y, &sample);
    return e->g(&sample, e->data);
}

iso_status iso_orbit_event(iso_orbit *o, double (*g)(const iso_sample *sample, const void *data), const void *data,
                           int direction, double from, double to, bool *found, iso_sample *sample)
{
    const sampled_event wrapped = {o, g, data};
    const iso_event event = {event_function, &wrapped, direction};
    const double unit = o->unit_clock[o->model.clock];
    double own_time, y[ISO_MAX_STATE];
    const iso_status status =
        iso_integrator_event(o->integrator, &event, from / unit, to / unit, found, &own_time, y);
    return status == ISO_OK && *found ? make_sample(o, own_time * unit, y, sample) : status;
}

iso_status iso_orbit_last(iso_orbit *o, iso_sample *sample)
{
    double own_time, y[ISO_MAX_STATE];
    iso_integrator_last(o->integrator, &own_time, y);
    return make_sample(o, own_time * o->unit_clock[o->model.clock], y, sample);
}

/* --- what it is made of ------------------------------------------------------------------------------------------- */

iso_statistics iso_orbit_statistics(const iso_orbit *o)
{
    return iso_integrator_statistics(o->integrator);
}

const iso_model *iso_orbit_model(const iso_orbit *o)
{
    return &o->model;
}

const iso_units *iso_orbit_units(const iso_orbit *o)
{
    return &o->units;
}

const iso_method *iso_orbit_method(const iso_orbit *o)
{
    return o->options.method;
}

double iso_orbit_energy(const iso_orbit *o)
{
    return o->h * iso_unit(&o->units, iso_dimension_h);
}

double iso_orbit_coupling(const iso_orbit *o)
{
    return o->eps * iso_unit(&o->units, iso_dimension_eps);
}

double iso_orbit_integral(const iso_orbit *o, const iso_system *system, const iso_integral *integral,
                          const iso_sample *sample, double *size)
{
    const bool is_ball = system == &iso_system_ball;
    const iso_field field = {.p = o->units.own, .eps = o->eps, .energy = o->model.field.energy};
    double own[ISO_STATE];
    copy(is_ball ? sample->ball : sample->point, own, ISO_STATE);
    for (int i = 0; i < 3; i++) own[i] /= is_ball ? o->units.w : o->unit_M;
    return integral->value(&field, own, size);
}

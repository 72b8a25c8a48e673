#include "orbit/orbit.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

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

/* What the numbers of an orbit are measured with must fit a double, and not lose digits. */
static iso_status check_units(const iso_orbit *o, const iso_start *start)
{
    const iso_orbit_options *opt = &o->options;
    bool fits = (opt->show == ISO_BALL && start->model == ISO_BALL) || isnormal(o->unit_M);
    for (int c = 0; c < ISO_CLOCKS; c++)
        fits = fits && ((c != (int)opt->clock && !opt->carry[c]) || isnormal(o->unit_clock[c]));
    if (fits) return ISO_OK;
    return iso_context_fail(o->ctx, ISO_NUMERICAL, "",
                            "M (about %g) or a clock (s about %g) does not fit a double in these units: use other "
                            "units of mass, length or time, or ask for the ball in its time t alone",
                            o->unit_M, o->unit_clock[ISO_CLOCK_S]);
}

/* Everything but the ball in its own time has powers of q up to 1 + 1/|k|, times k^2/det J. They must fit a double
 * wherever the orbit may go: q lies between the least and the largest moment of inertia. */
static iso_status check_powers(const iso_orbit *o)
{
    const iso_params *p = &o->units.own;
    const double reach = fmax(fabs(log2(min3(p->J))), fabs(log2(max3(p->J)))), k = fabs(p->k);
    if (reach * (1 + 1 / k) + fabs(2 * log2(k) - log2(p->det_J)) < 960) return ISO_OK;
    return iso_context_fail(
        o->ctx, ISO_NUMERICAL, "k",
        "k = %g is too extreme for the point and the clocks tau and s of a ball with max J/min J = "
        "%.3g: q^(1/k) leaves the range of doubles; the ball in its time t can be had",
        p->k, max3(p->J) / min3(p->J));
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

/* The speed of the ball whose M has the size that M reaches on this potential: w^2 = (k^2/(det J J)) times the larger of
 * q^(1/k) M^2 and 2 eps. By logarithms, since the powers of J need not fit a double in the caller's units. */
static double point_speed(const iso_params *p, const iso_start *start)
{
    const double q = dot_diag(start->y + 3, p->J, start->y + 3);
    const double log_J = (log2(p->J[0]) + log2(p->J[1]) + log2(p->J[2])) / 3;
    const double moving = log2(largest(start->y)) + log2(q) / (2 * p->k);
    const double falling = (1 + log2(fabs(start->eps))) / 2; /* NAN on the level H = 0 */
    return exp2(fmin(fmax(moving, falling) + log2(fabs(p->k)) - 2 * log_J, 1000));
}

/* A point's start in y; gives the level H it lives on, 0 if it is that to 1e-9, and the size of the terms of H. */
static double start_point(iso_orbit *o, const iso_params *p, const iso_start *start, double y[ISO_STATE],
                          double *size)
{
    set_units(o, p, point_speed(p, start));
    copy(start->y, y, ISO_STATE);
    for (int i = 0; i < 3; i++) y[i] /= o->unit_M;
    iso_field field = {.p = o->units.own, .eps = start->eps / iso_unit(&o->units, iso_dimension_eps)};
    if (isnan(start->eps)) field.eps = iso_coupling(&field.p, iso_point_energy(&field.p, y));
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

/* What an orbit is asked for decides what must exist: the ball, the point, powers of q. */
typedef struct needs {
    bool ball, point, powers;
} needs;

static needs what_is_needed(const iso_orbit_options *opt, const iso_start *start)
{
    const bool other_clocks = opt->carry[ISO_CLOCK_TAU] || opt->carry[ISO_CLOCK_S];
    const bool point = opt->backend == ISO_POINT || opt->show != ISO_BALL;
    return (needs){
        .ball = opt->backend == ISO_BALL || opt->show != ISO_POINT || opt->clock != ISO_CLOCK_S ||
                opt->carry[ISO_CLOCK_T] || opt->carry[ISO_CLOCK_TAU],
        .point = point,
        .powers = point || start->model == ISO_POINT || opt->clock != ISO_CLOCK_T || other_clocks,
    };
}

/* The start in the backend's variables and own units, and the energy it lives on there. */
static iso_status find_start(iso_orbit *o, const iso_params *p, const iso_start *start, double y[ISO_STATE],
                             double *energy)
{
    const iso_picture backend = o->options.backend;
    const needs need = what_is_needed(&o->options, start);
    double level = 0, size = 0;
    if (!all_finite(start->y, ISO_STATE) || (start->model == ISO_POINT && isinf(start->eps)))
        return iso_context_fail(o->ctx, ISO_BAD_ARGUMENT, "", "the start is not finite");
    set_units(o, p, 0);
    iso_status status = need.powers ? check_powers(o) : ISO_OK;
    if (status != ISO_OK) return status;
    if (start->model == ISO_BALL)
        start_ball(o, p, start, y);
    else
        level = start_point(o, p, start, y, &size);
    if (start->model == ISO_BALL && o->h == 0 && need.point)
        return iso_context_fail(o->ctx, ISO_NOT_MAPPED, "angular_velocity",
                                "a ball at rest (h = 0) has no twin: the point's potential would vanish");
    if (level != 0 && need.ball) return refuse_level(o->ctx, level, size);
    status = check_units(o, start);
    if (status != ISO_OK) return status;
    if (backend == ISO_POINT && start->model == ISO_BALL) iso_ball_to_point(&o->units.own, y, y);
    if (backend == ISO_BALL && start->model == ISO_POINT) iso_point_to_ball(&o->units.own, y, y);
    *energy = backend == ISO_BALL ? o->h : level;
    if (all_finite(y, ISO_STATE) && isfinite(o->h) && (!need.point || isfinite(o->eps))) return ISO_OK;
    return iso_context_fail(o->ctx, ISO_NUMERICAL, "",
                            "the start is out of the range of doubles in the ball's own units");
}

static iso_status set_up(iso_orbit *o, const iso_params *p, const iso_start *start)
{
    iso_orbit_options *opt = &o->options;
    double y[ISO_MAX_STATE] = {0}, energy = 0;
    if (opt->backend == ISO_AUTO) opt->backend = start->model;
    iso_status status = find_start(o, p, start, y, &energy);
    if (status != ISO_OK) return status;
    const iso_system *system = opt->backend == ISO_BALL ? &iso_system_ball : &iso_system_point;
    const iso_field field = {.p = o->units.own, .eps = opt->backend == ISO_POINT ? o->eps : 0, .energy = energy};
    o->model = iso_model_assemble(system, &field, opt->clock, opt->carry);
    if (!opt->method) opt->method = iso_method_auto(&o->model);
    const iso_method_options m = {.tolerance = opt->tolerance, .max_steps = opt->max_steps};
    status = iso_integrator_create(o->ctx, opt->method, &o->model, &m, &o->integrator);
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

/* `count` numbers in the caller's units. What does not fit a double there, or loses its digits, must not be shown. */
static iso_status to_users_units(const iso_orbit *o, const char *name, double unit, double x[], int count)
{
    double before = 0, after = 0;
    bool finite = true;
    for (int i = 0; i < count; i++) {
        before = fmax(before, fabs(x[i]));
        if (x[i] != 0) x[i] *= unit; /* the unit may be infinite */
        after = fmax(after, fabs(x[i]));
        finite = finite && isfinite(x[i]);
    }
    if (finite && (before == 0 || after >= DBL_MIN)) return ISO_OK;
    return iso_context_fail(
        o->ctx, ISO_NUMERICAL, "",
        "%s is out of the range of doubles in these units: use other units of mass, length or time", name);
}

static void blank(iso_sample *s)
{
    for (int i = 0; i < ISO_STATE; i++) s->ball[i] = s->point[i] = NAN;
    for (int c = 0; c < ISO_CLOCKS; c++) s->clock[c] = NAN;
}

static iso_status make_sample(const iso_orbit *o, double time, const double y[], iso_sample *s)
{
    const iso_params *own = &o->units.own;
    const bool is_ball = o->options.backend == ISO_BALL;
    iso_status status = ISO_OK;
    blank(s);
    s->clock[o->model.clock] = time;
    for (int i = 0; status == ISO_OK && i < o->model.carried; i++) {
        const iso_clock c = o->model.carry[i];
        s->clock[c] = y[ISO_STATE + i];
        status = to_users_units(o, iso_clock_name(c), o->unit_clock[c], &s->clock[c], 1);
    }
    if (o->options.show != ISO_POINT) {
        if (is_ball)
            copy(y, s->ball, ISO_STATE);
        else
            iso_point_to_ball(own, y, s->ball);
        if (status == ISO_OK) status = to_users_units(o, "omega", o->units.w, s->ball, 3);
    }
    if (o->options.show != ISO_BALL) {
        if (is_ball)
            iso_ball_to_point(own, y, s->point);
        else
            copy(y, s->point, ISO_STATE);
        if (status == ISO_OK) status = to_users_units(o, "M", o->unit_M, s->point, 3);
    }
    return status;
}

/* Beyond 1e15 turns a double does not tell one part of a turn from another (and no one would live to see it). */
static iso_status to_own_time(const iso_orbit *o, double time, double *own_time)
{
    const iso_params *own = &o->units.own;
    const iso_clock clock = o->model.clock;
    const double fastest = clock == ISO_CLOCK_T ? 1
                                                : fmax(iso_clock_rate(own, clock, min3(own->J), NULL),
                                                       iso_clock_rate(own, clock, max3(own->J), NULL));
    *own_time = time / o->unit_clock[clock];
    const double turns = fmax(1, fabs(own->k)) * (*own_time / fastest);
    if (fabs(turns) <= 1e15) return ISO_OK;
    return iso_context_fail(o->ctx, ISO_BAD_ARGUMENT, "end",
                            "%s = %g is out of range: it is %g turns of this ball, and 1e15 can be told apart",
                            iso_clock_name(clock), time, turns);
}

iso_status iso_orbit_check_time(const iso_orbit *o, double time)
{
    double own_time;
    return to_own_time(o, time, &own_time);
}

/* An integrator's failure, with the last good time in the caller's units. */
static iso_status to_users_time(const iso_orbit *o, iso_status status)
{
    const char *words = iso_context_message(o->ctx), *cut = strstr(words, "; last good");
    if (status != ISO_NUMERICAL || !cut) return status;
    return iso_context_fail(o->ctx, status, "", "%.*s; last good %s = %.17g", (int)(cut - words), words,
                            iso_clock_name(o->model.clock), iso_orbit_reached(o));
}

iso_status iso_orbit_at(iso_orbit *o, double time, iso_sample *sample)
{
    double own_time, y[ISO_MAX_STATE];
    iso_status status = to_own_time(o, time, &own_time);
    if (status == ISO_OK) status = iso_integrator_at(o->integrator, own_time, y);
    return status == ISO_OK ? make_sample(o, time, y, sample) : to_users_time(o, status);
}

typedef struct sampled_event {
    const iso_orbit *orbit;
    double (*g)(const iso_sample *sample, const void *data);
    const void *data;
    iso_status *status; /* the first failure of a sample or of g */
} sampled_event;

/* The search wants numbers: after a failure, which ends it, it gets zeros. */
static double event_function(const iso_model *model, const double y[], const void *data)
{
    const sampled_event *e = data;
    iso_sample sample;
    (void)model;
    if (*e->status == ISO_OK) *e->status = make_sample(e->orbit, NAN, y, &sample);
    if (*e->status != ISO_OK) return 0;
    const double g = e->g(&sample, e->data);
    if (isfinite(g)) return g;
    *e->status = iso_context_fail(e->orbit->ctx, ISO_NUMERICAL, "", "the event function is not finite");
    return 0;
}

iso_status iso_orbit_event(iso_orbit *o, double (*g)(const iso_sample *sample, const void *data), const void *data,
                           int direction, double from, double to, bool *found, iso_sample *sample)
{
    iso_status sampled = ISO_OK;
    const sampled_event wrapped = {o, g, data, &sampled};
    const iso_event event = {event_function, &wrapped, direction};
    double begin, end, own_time, y[ISO_MAX_STATE];
    *found = false;
    iso_status status = to_own_time(o, from, &begin);
    if (status == ISO_OK) status = to_own_time(o, to, &end);
    if (status == ISO_OK) status = iso_integrator_event(o->integrator, &event, begin, end, found, &own_time, y);
    if (status == ISO_OK) status = sampled;
    if (status != ISO_OK) *found = false;
    if (status != ISO_OK) return to_users_time(o, status);
    return *found ? make_sample(o, own_time * o->unit_clock[o->model.clock], y, sample) : status;
}

double iso_orbit_reached(const iso_orbit *o)
{
    double own_time, y[ISO_MAX_STATE];
    iso_integrator_last(o->integrator, &own_time, y);
    return own_time * o->unit_clock[o->model.clock];
}

iso_status iso_orbit_last(iso_orbit *o, iso_sample *sample)
{
    double own_time, y[ISO_MAX_STATE];
    iso_integrator_last(o->integrator, &own_time, y);
    return make_sample(o, iso_orbit_reached(o), y, sample);
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

bool iso_orbit_has_twin(const iso_orbit *o)
{
    return o->h > 0 && (o->options.backend == ISO_BALL || o->model.field.energy == 0);
}

double iso_orbit_energy(const iso_orbit *o)
{
    return o->h == 0 ? 0 : o->h * iso_unit(&o->units, iso_dimension_h);
}

double iso_orbit_coupling(const iso_orbit *o)
{
    return o->eps == 0 ? 0 : o->eps * iso_unit(&o->units, iso_dimension_eps);
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

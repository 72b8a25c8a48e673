/* NaN, infinity, zeros, subnormals and the largest numbers at every number of every call. */
#include "api/typed_impl.h"
#include "exact/exact_impl.h"
#include "method/integrator_impl.h"
#include "numbers.h"
#include "sweep.h"

/* --- the ball and its start ------------------------------------------------------------------------------------- */

static iso_status reduced(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    iso_params p;
    (void)data;
    iso_status status = iso_params_reduced(ctx, v[0], v + 1, &p);
    if (status == ISO_OK) status = iso_params_set_D(ctx, v[4], &p);
    if (status != ISO_OK) return status;
    sweep_give(a, &p.k, 1);
    sweep_give(a, p.J, 3);
    sweep_give(a, p.inv_J, 3);
    sweep_give(a, p.root_J, 3);
    return status;
}

/* mass, radius, inertia, radius of the surface */
static iso_status body(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    iso_params p;
    const iso_body b = {v[0], v[1], {v[2], v[3], v[4]}, *(const iso_surface *)data, v[5]};
    const iso_status status = iso_params_physical(ctx, &b, &p);
    if (status != ISO_OK) return status;
    sweep_give(a, (double[]){p.k, p.D}, 2);
    sweep_give(a, p.J, 3);
    sweep_give(a, p.inv_J, 3);
    return status;
}

static iso_status start_of_ball(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    iso_start start;
    const iso_status status = iso_start_ball(ctx, v, v + 3, *(const iso_spin *)data, &start);
    sweep_give(a, start.y, ISO_STATE);
    return status;
}

static iso_status start_of_point(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    iso_start start;
    const iso_status status = iso_start_point(ctx, v, v + 3, v + 6, *(const bool *)data, &start);
    sweep_give(a, start.y, ISO_STATE);
    sweep_give(a, &start.eps, 1);
    return status;
}

/* --- orbits ----------------------------------------------------------------------------------------------------- */

/* How an orbit is asked, by a start that nothing has checked. */
typedef struct request {
    iso_model_kind model;
    iso_backend backend;
    bool both;
    iso_clock clock;
} request;

enum { K, J, STATE = 4, TIME = 10, TOLERANCE, EPS, AFTER_ORBIT };

static iso_status make_orbit(iso_context *ctx, const request *r, const double v[], const iso_effects *effects,
                             iso_orbit **orbit)
{
    iso_params p;
    iso_start start = {.model = r->model, .eps = v[EPS]};
    const iso_status status = iso_params_reduced(ctx, v[K], v + J, &p);
    if (status != ISO_OK) return status;
    memcpy(start.y, v + STATE, sizeof start.y);
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.effects = effects, o.backend = r->backend, o.tolerance = v[TOLERANCE], o.clock = r->clock, o.max_steps = 20000;
    if (r->both) o.shown = ISO_SHOW_BOTH;
    for (int c = 0; c < ISO_CLOCKS; c++) o.with_clock[c] = r->both;
    return iso_orbit_create(ctx, &p, &start, &o, orbit);
}

static void give_sample(sweep_answer *a, const iso_sample *s, const request *r)
{
    sweep_give(a, s->clock + r->clock, 1);
    if (r->both) sweep_give(a, s->clock, ISO_CLOCKS);
    if (r->both || r->model == ISO_BALL) sweep_give(a, s->ball, ISO_STATE);
    if (r->both || r->model == ISO_POINT) sweep_give(a, s->point, ISO_STATE);
}

static iso_status orbit_at(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    const request *r = data;
    iso_orbit *orbit;
    iso_sample sample;
    iso_status status = make_orbit(ctx, r, v, NULL, &orbit);
    if (status != ISO_OK) return status;
    status = iso_orbit_at(orbit, v[TIME], &sample);
    if (status == ISO_OK) give_sample(a, &sample, r);
    iso_orbit_free(orbit);
    return status;
}

/* from, to, and what g is there */
static double height(const iso_sample *sample, const void *data)
{
    return sample->ball[5] - *(const double *)data;
}

static iso_status orbit_event(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    static const double usual[AFTER_ORBIT] = {-1, 1.4, 2.1, 3, 0.9, -0.3, -0.225, 0.36, 0.48, 0.8, 1, 1e-9, 1};
    const request *r = data;
    iso_orbit *orbit;
    iso_sample sample;
    bool found;
    iso_status status = make_orbit(ctx, r, usual, NULL, &orbit);
    if (status != ISO_OK) return status;
    status = iso_orbit_event(orbit, height, v + 2, 0, v[0], v[1], &found, &sample);
    if (status == ISO_OK && found) give_sample(a, &sample, r);
    iso_orbit_free(orbit);
    return status;
}

/* mgb, up, C, l, level, twist, resistance, quaternion, D */
enum { MGB, UP, QUADRATIC = 4, LINEAR = 13, LEVEL = 16, TWIST, RESISTANCE, QUATERNION, D = 23, EFFECTS_NUMBERS };

static iso_status with_effects(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    static const double usual[AFTER_ORBIT] = {0.7, 1.4, 2.1, 3, 0.9, -0.3, -0.225, 0.36, 0.48, 0.8, 1, 1e-6, 1};
    const request r = {.model = ISO_BALL, .backend = ISO_BACKEND_BALL, .clock = ISO_CLOCK_T};
    iso_effects e = {.number = {[ISO_GRAVITY] = {v[MGB]},
                                [ISO_LEVEL] = {v[LEVEL]},
                                [ISO_TWIST] = {v[TWIST]},
                                [ISO_ROLLING_RESISTANCE] = {v[RESISTANCE]}}};
    iso_params p;
    iso_start start = {.model = ISO_BALL};
    iso_orbit *orbit;
    iso_sample sample;
    memcpy(e.on, data, sizeof e.on);
    memcpy(GRAVITY_UP(&e), v + UP, 3 * sizeof *v);
    memcpy(FIELD_QUADRATIC(&e), v + QUADRATIC, 9 * sizeof *v);
    memcpy(FIELD_LINEAR(&e), v + LINEAR, 3 * sizeof *v);
    memcpy(QUATERNION(&e), v + QUATERNION, 4 * sizeof *v);
    memcpy(start.y, usual + STATE, sizeof start.y);
    iso_status status = iso_params_reduced(ctx, usual[K], usual + J, &p);
    if (status == ISO_OK) status = iso_params_set_D(ctx, v[D], &p);
    if (status != ISO_OK) return status;
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.effects = &e, o.tolerance = 1e-6, o.max_steps = 20000;
    status = iso_orbit_create(ctx, &p, &start, &o, &orbit);
    if (status != ISO_OK) return status;
    status = iso_orbit_at(orbit, 1, &sample);
    if (status == ISO_OK) give_sample(a, &sample, &r);
    if (status == ISO_OK && e.on[ISO_GRAVITY]) sweep_give(a, sample_of(&sample, "e"), 3);
    if (status == ISO_OK && e.on[ISO_ATTITUDE]) sweep_give(a, sample_of(&sample, "q"), 13);
    if (status == ISO_OK && e.on[ISO_REACTIONS]) sweep_give(a, sample_of(&sample, "N"), 6);
    iso_orbit_free(orbit);
    return status;
}

static iso_status batch(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    const request *r = data;
    iso_params p;
    iso_start start = {.model = r->model, .eps = v[EPS]};
    iso_sample samples[2];
    iso_status status = iso_params_reduced(ctx, v[K], v + J, &p);
    if (status != ISO_OK) return status;
    memcpy(start.y, v + STATE, sizeof start.y);
    iso_batch_options o = iso_batch_defaults();
    o.tolerance = v[TOLERANCE], o.max_steps = 20000, o.backend = r->backend, o.shown = (iso_models)r->model;
    o.threads = 1, o.clock = r->clock;
    status = iso_batch_run(ctx, &(iso_batch_orbit){&p, &start, NULL}, 1, &o, (double[]){v[TIME], v[AFTER_ORBIT]}, 2,
                           samples, NULL);
    for (int i = 0; status == ISO_OK && i < 2; i++) give_sample(a, &samples[i], r);
    return status;
}

/* --- integrators and the closed solution ------------------------------------------------------------------------ */

/* y, time, tolerance, fixed step */
static iso_status integrator(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    iso_problem f = {.energy = 0.7};
    if (iso_params_reduced(ctx, -1, (const double[]){1.4, 2.1, 3}, &f.p) != ISO_OK) abort();
    const iso_model model = iso_model_assemble(&iso_system_ball, &f, ISO_CLOCK_T, (const bool[ISO_CLOCKS]){false});
    const iso_method_options o = {.tolerance = v[7], .fixed_step = v[8], .max_steps = 20000};
    iso_integrator *it;
    double y[ISO_MAX_STATE];
    iso_status status = iso_integrator_create(ctx, iso_method_find(data), &model, &o, &it);
    if (status != ISO_OK) return status;
    status = iso_integrator_start(it, v);
    if (status == ISO_OK) status = iso_integrator_at(it, v[6], y);
    if (status == ISO_OK) sweep_give(a, y, model.dim);
    iso_integrator_free(it);
    return status;
}

/* k, J, point, eps, level, time, step */
static iso_status exact(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    const bool clocks[ISO_CLOCKS] = {true, true, true};
    iso_problem f = {.eps = v[10], .energy = v[11]};
    iso_exact *x;
    double point[ISO_STATE], shown[ISO_CLOCKS];
    iso_exact_walk walk = {0};
    (void)data;
    iso_status status = iso_params_reduced(ctx, v[0], v + 1, &f.p);
    if (status == ISO_OK) status = iso_exact_create(ctx, &f, v + 4, clocks, &x);
    if (status != ISO_OK) return status;
    status = iso_exact_at(ctx, x, ISO_CLOCK_T, v[12], point, shown);
    if (status == ISO_OK) sweep_give(a, point, ISO_STATE), sweep_give(a, shown, ISO_CLOCKS);
    for (int i = 0; i < 4 && status == ISO_OK; i++) {
        status = iso_exact_walk_to(ctx, x, &walk, ISO_CLOCK_S, v[12] + i * v[13], point, shown);
        if (status == ISO_OK) sweep_give(a, point, ISO_STATE), sweep_give(a, shown, ISO_CLOCKS);
    }
    iso_exact_free(x);
    return status;
}

#define BALL -1, 1.4, 2.1, 3, 0.9, -0.3, -0.225, 0.36, 0.48, 0.8, 1, 1e-6, 1
#define POINT -1, 1.4, 2.1, 3, 0.7, -0.3, -0.135, 0.36, 0.48, 0.8, 1, 1e-6, 0.3
#define BODY 6.8, 0.1092, 0.0270, 0.0274, 0.0283
#define EFFECTS 0.7, 0, 0.6, 0.8, 0.3, 0.1, 0, 0.1, 0.2, 0, 0, 0, -0.1, 0.1, 0, 0.2, 0.3, 1, 0.01, 1, 0, 0, 0, 0.5

static const iso_surface on_plane = ISO_PLANE, outside = ISO_OUTSIDE, inside = ISO_INSIDE, around = ISO_SHELL;
static const iso_spin refuse = ISO_SPIN_REFUSE, take_off = ISO_SPIN_REMOVE, keep = ISO_SPIN_KEEP;
static const bool no = false, yes = true;
static const request ball_by_ball = {ISO_BALL, ISO_BACKEND_BALL, false, ISO_CLOCK_T},
                     ball_by_point = {ISO_BALL, ISO_BACKEND_POINT, false, ISO_CLOCK_T},
                     ball_by_exact = {ISO_BALL, ISO_BACKEND_EXACT, false, ISO_CLOCK_T},
                     both_by_ball = {ISO_BALL, ISO_BACKEND_BALL, true, ISO_CLOCK_TAU},
                     both_by_exact = {ISO_BALL, ISO_BACKEND_EXACT, true, ISO_CLOCK_S},
                     point_by_point = {ISO_POINT, ISO_BACKEND_POINT, false, ISO_CLOCK_S},
                     point_by_ball = {ISO_POINT, ISO_BACKEND_BALL, false, ISO_CLOCK_S},
                     point_by_exact = {ISO_POINT, ISO_BACKEND_EXACT, false, ISO_CLOCK_S},
                     both_by_point = {ISO_POINT, ISO_BACKEND_POINT, true, ISO_CLOCK_T};
static const bool with_gravity[ISO_EFFECTS] = {[ISO_GRAVITY] = true, [ISO_REACTIONS] = true},
                  with_field[ISO_EFFECTS] = {[ISO_FIELD] = true, [ISO_ATTITUDE] = true},
                  with_level[ISO_EFFECTS] = {[ISO_LEVEL] = true, [ISO_REACTIONS] = true},
                  with_twist[ISO_EFFECTS] = {[ISO_TWIST] = true, [ISO_REACTIONS] = true},
                  with_resistance[ISO_EFFECTS] = {[ISO_ROLLING_RESISTANCE] = true, [ISO_ATTITUDE] = true};
enum { EPS_BIT = 1 << EPS };

/* What an effect's scene does not name is not read: bits of its numbers. */
#define ONLY(first, count) (~(((1ul << (count)) - 1) << (first)))

static const sweep_call calls[] = {
    {"k, J, D", reduced, NULL, 5, {-1, 1.4, 2.1, 3, 0.5}, 0},
    {"a ball on a plane", body, &on_plane, 5, {BODY}, 0},
    {"outside", body, &outside, 6, {BODY, 0.3}, 0},
    {"inside", body, &inside, 6, {BODY, 0.3}, 0},
    {"a shell", body, &around, 6, {BODY, 0.0546}, 0},
    {"a ball's start", start_of_ball, &refuse, 6, {0.9, -0.3, -0.225, 0.36, 0.48, 0.8}, 0},
    {"with its twist taken off", start_of_ball, &take_off, 6, {0.9, -0.3, -0.2, 0.36, 0.48, 0.8}, 0},
    {"with its twist", start_of_ball, &keep, 6, {0.9, -0.3, -0.2, 0.36, 0.48, 0.8}, 0},
    {"a point's start", start_of_point, &no, 7, {0.7, -0.3, -0.135, 0.36, 0.48, 0.8, 0.3}, 0},
    {"made orthogonal", start_of_point, &yes, 7, {0.7, -0.3, 0.1, 0.36, 0.48, 0.8, 0.3}, 0},
    {"ball by ball", orbit_at, &ball_by_ball, EPS, {BALL}, 0},
    {"ball by point", orbit_at, &ball_by_point, EPS, {BALL}, 0},
    {"ball by exact", orbit_at, &ball_by_exact, EPS, {BALL}, 1 << TOLERANCE},
    {"both by ball, in tau", orbit_at, &both_by_ball, EPS, {BALL}, 0},
    {"both by exact, in s", orbit_at, &both_by_exact, EPS, {BALL}, 1 << TOLERANCE},
    {"point by point", orbit_at, &point_by_point, EPS + 1, {POINT}, EPS_BIT},
    {"point by ball", orbit_at, &point_by_ball, EPS + 1, {POINT}, EPS_BIT},
    {"point by exact", orbit_at, &point_by_exact, EPS + 1, {POINT}, EPS_BIT | 1 << TOLERANCE},
    {"both by point, in t", orbit_at, &both_by_point, EPS + 1, {POINT}, EPS_BIT},
    {"an event by ball", orbit_event, &ball_by_ball, 3, {0, 10, 0.1}, 0},
    {"an event by point", orbit_event, &ball_by_point, 3, {0, 10, 0.1}, 0},
    {"an event by exact", orbit_event, &ball_by_exact, 3, {0, 10, 0.1}, 0},
    {"gravity", with_effects, with_gravity, EFFECTS_NUMBERS, {EFFECTS}, ONLY(MGB, 4) & ~(1ul << D)},
    {"field", with_effects, with_field, EFFECTS_NUMBERS, {EFFECTS}, ONLY(QUADRATIC, 12) & ONLY(QUATERNION, 5)},
    {"level", with_effects, with_level, EFFECTS_NUMBERS, {EFFECTS}, ONLY(LEVEL, 1) & ~(1ul << D)},
    {"twist", with_effects, with_twist, EFFECTS_NUMBERS, {EFFECTS}, ONLY(TWIST, 1) & ~(1ul << D)},
    {"resistance", with_effects, with_resistance, EFFECTS_NUMBERS, {EFFECTS}, ONLY(RESISTANCE, 5) & ~(1ul << D)},
    {"a batch of balls", batch, &ball_by_ball, AFTER_ORBIT + 1, {BALL, 2}, EPS_BIT},
    {"a batch of points", batch, &point_by_point, AFTER_ORBIT + 1, {POINT, 2}, EPS_BIT},
    {"taylor", integrator, "taylor", 8, {0.9, -0.3, -0.225, 0.36, 0.48, 0.8, 1, 1e-6, 0}, 0},
    {"rk8pd", integrator, "rk8pd", 9, {0.9, -0.3, -0.225, 0.36, 0.48, 0.8, 1, 1e-6, 0}, 0},
    {"adams", integrator, "adams", 8, {0.9, -0.3, -0.225, 0.36, 0.48, 0.8, 1, 1e-6, 0}, 0},
    {"bsimp", integrator, "bsimp", 8, {0.9, -0.3, -0.225, 0.36, 0.48, 0.8, 1, 1e-6, 0}, 0},
    {"verner_8_5_6", integrator, "verner_8_5_6", 9, {0.9, -0.3, -0.225, 0.36, 0.48, 0.8, 1, 1e-6, 0}, 0},
    {"the closed solution",
     exact,
     NULL,
     14,
     {-1, 1.4, 2.1, 3, 0.7, -0.3, -0.135, 0.36, 0.48, 0.8, 0.3, 0, 1, 0.1},
     0},
};

/* A check of a moment of inertia that refuses what is known to be wrong: how many of these numbers it takes. */
static int taken_unless_wrong(void)
{
    static const double wrong[] = {NAN, INFINITY, 0.0, -1};
    int taken = 0;
    for (int i = 0; i < 4; i++) taken += !(wrong[i] <= 0);
    return taken;
}

int main(void)
{
    iso_context *ctx = iso_context_create();
    hard_topic("8. Numbers");
    sweep_all(ctx, calls, sizeof calls / sizeof *calls, "orbits");
    hard_naive("if (J <= 0) refuse", taken_unless_wrong(), 0);
    iso_context_free(ctx);
    return hard_summary();
}

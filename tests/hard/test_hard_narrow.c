/* Narrow features of what a scene writes: hills, rings, jumps, walls, high powers, poles next to the real axis, rounded
 * corners, of 1 to 1e-3 radians, placed on the orbit. A method that looks at a few places passes over them.
 *
 * The reference is another statement of the equations and of the features, and another method: the steps of GSL's rk8pd
 * have a given length, at most a twentieth of the feature's width where it acts. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "laws.h"
#include "method/methods_impl.h"
#include "orbit/batch.h"
#include "orbit/orbit.h"

enum { HILL, RING, JUMP, WALL, POWER, POLE, CORNER, SHAPES };
static const char *const shape_name[] = {"hill", "ring", "jump", "wall", "power", "pole", "corner"};
static const double k_of[] = {-1, 1, 0.5, 0.75, -0.4}, J[3] = {1.4, 2.1, 3};

static iso_context *ctx;

typedef struct scene {
    int shape, axis;
    bool torque; /* a drag -a f omega; else the potential a f */
    double k, a, width, c[3], time, y[6];
    double side; /* of a jump and a wall: 1 or -1, so that the start is where there is nothing */
} scene;

/* --- the feature f(n), by itself and as a text ------------------------------------------------------------------ */

/* f; its slope along n; how far the place where it acts is away. */
static double feature(const scene *s, const double n[3], double slope[3], double *away)
{
    const double x = s->side * (n[s->axis] - s->c[s->axis]), w = s->width, m = round(0.5 / w);
    double f = 0, df = 0;
    slope[0] = slope[1] = slope[2] = *away = 0;
    switch (s->shape) {
    case HILL: {
        double square = 0;
        for (int i = 0; i < 3; i++) square += (n[i] - s->c[i]) * (n[i] - s->c[i]);
        f = exp(-square / (2 * w * w));
        for (int i = 0; i < 3; i++) slope[i] = -f * (n[i] - s->c[i]) / (w * w);
        *away = sqrt(square) - 9 * w;
        return f;
    }
    case RING: f = exp(-x * x / (2 * w * w)), df = -f * x / (w * w), *away = fabs(x) - 9 * w; break;
    case JUMP: f = 1 / (1 + exp(-x / w)), df = f * (1 - f) / w, *away = fabs(x) - 40 * w; break;
    case WALL: f = exp(x / w), df = f / w, *away = -x - 40 * w; break;
    case POWER: f = pow(n[s->axis], 2 * m), df = 2 * m * pow(n[s->axis], 2 * m - 1); break;
    case POLE: f = 1 / (1 + x * x / (w * w)), df = -f * f * 2 * x / (w * w), *away = fabs(x) / 4; break;
    default: f = sqrt(x * x + w * w), df = x / f, *away = fabs(x) / 4; break;
    }
    slope[s->axis] = s->shape == POWER ? df : s->side * df;
    return f;
}

static void write_feature(const scene *s, char text[256])
{
    const double c = s->c[s->axis], w = s->width, over = 1 / (2 * w * w);
    const int i = s->axis + 1;
    switch (s->shape) {
    case HILL:
        snprintf(text, 256, "exp(-%.17g*((n1 - (%.17g))^2 + (n2 - (%.17g))^2 + (n3 - (%.17g))^2))", over, s->c[0],
                 s->c[1], s->c[2]);
        break;
    case RING: snprintf(text, 256, "exp(-(n%d - (%.17g))^2/%.17g)", i, c, 2 * w * w); break;
    case JUMP: snprintf(text, 256, "1/(1 + exp(-(n%d - (%.17g))/%.17g))", i, c, s->side * w); break;
    case WALL: snprintf(text, 256, "exp((n%d - (%.17g))/%.17g)", i, c, s->side * w); break;
    case POWER: snprintf(text, 256, "(n%d^2)^%.0f", i, round(0.5 / w)); break;
    case POLE: snprintf(text, 256, "1/(1 + ((n%d - (%.17g))/%.17g)^2)", i, c, w); break;
    default: snprintf(text, 256, "sqrt((n%d - (%.17g))^2 + %.17g)", i, c, w * w); break;
    }
}

/* --- the reference ---------------------------------------------------------------------------------------------- */

/* (9): J w' = Jw x w + MQ + lambda n,  n' = k n x w */
static int equations(double t, const double y[], double dy[], void *data)
{
    const scene *s = data;
    const double *w = y, *n = y + 3;
    double slope[3], away, M[3], Jw[3], u[3];
    (void)t;
    const double f = feature(s, n, slope, &away);
    cross(n, slope, M);
    for (int i = 0; i < 3; i++) {
        M[i] = s->torque ? -s->a * f * w[i] : s->a * s->k * M[i];
        Jw[i] = J[i] * w[i], u[i] = n[i] / J[i];
    }
    double turn[3];
    cross(Jw, w, turn);
    for (int i = 0; i < 3; i++) M[i] += turn[i];
    const double lambda = -dot(M, u) / dot(n, u);
    for (int i = 0; i < 3; i++) dy[i] = (M[i] + lambda * n[i]) / J[i];
    cross(n, w, dy + 3);
    for (int i = 3; i < 6; i++) dy[i] *= s->k;
    return GSL_SUCCESS;
}

static void follow(const scene *s, double time, double y[6])
{
    scene copy_of = *s;
    const gsl_odeiv2_system system = {equations, NULL, 6, &copy_of};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, 6);
    double error[6], slope[3], away, t = 0, lost = 0;
    while (t < time) {
        feature(s, y + 3, slope, &away);
        const double way = fmin(0.02, fmax(s->width / 20, away / 4)), speed = (1 + fabs(s->k)) * norm(y) + 0.3;
        const double h = fmin(way / speed, time - t), to = h - lost, sum = t + to;
        gsl_odeiv2_step_apply(step, 0, h, y, error, NULL, NULL, &system);
        lost = (sum - t) - to;
        t = sum == t ? time : sum;
    }
    gsl_odeiv2_step_free(step);
}

/* How much an error of the start grows: the larger of two. */
static double growth_of(const scene *s, const double end[6])
{
    static const double by[2][6] = {{0.3, -0.5, 0.4, 0.2, 0.6, -0.1}, {-0.6, 0.2, 0.5, -0.4, 0.3, 0.5}};
    const double moved = 1e-8;
    double most = 0;
    for (int i = 0; i < 2; i++) {
        double y[6], sum = 0;
        for (int j = 0; j < 6; j++) y[j] = s->y[j] + moved * by[i][j];
        make_unit(y + 3);
        remove_along(y, y + 3);
        follow(s, s->time, y);
        for (int j = 0; j < 6; j++) sum += (y[j] - end[j]) * (y[j] - end[j]);
        most = fmax(most, sqrt(sum) / moved);
    }
    return most;
}

/* --- scenes ----------------------------------------------------------------------------------------------------- */

/* The feature lies where the free ball is after a random time, or next to there. */
static scene make(iso_random *r, int number)
{
    scene s = {.shape = number % SHAPES, .torque = number / SHAPES % 2 == 1, .time = 6};
    s.k = k_of[number % 5];
    s.axis = number % 3;
    if (s.torque && s.shape == WALL) s.shape = RING; /* a drag without bound stops the ball */
    s.width = pow(10, iso_random_uniform(r, -3, 0));
    iso_random_direction(r, s.y + 3);
    iso_random_direction(r, s.y);
    remove_along(s.y, s.y + 3);
    make_unit(s.y);
    double y[6];
    copy(s.y, y, 6);
    /* powers go up to 250, and exp of a jump does not overflow */
    s.width = fmax(s.width, s.shape == POWER ? 2e-3 : s.shape == JUMP ? 6e-3 : 0);
    follow(&s, iso_random_uniform(r, 0.3, 0.9) * s.time, y);
    for (int i = 0; i < 3; i++) s.c[i] = y[3 + i] + s.width * iso_random_uniform(r, -1, 1);
    s.side = s.y[3 + s.axis] < s.c[s.axis] ? 1 : -1;
    const double h = dot_diag(s.y, J, s.y) / 2;
    s.a = h * iso_random_uniform(r, 0.03, 0.3) * (s.torque ? fmin(1 / s.width, 30) : 1);
    if (s.shape == WALL) s.a /= 10, s.width = fmax(s.width, (1 - s.side * s.c[s.axis]) / 30); /* exp(30) on its top */
    return s;
}

static void write_effects(const scene *s, iso_effects *effects)
{
    char f[256], text[512];
    *effects = iso_effects_default();
    write_feature(s, f);
    static const char *const name[] = {"M1", "M2", "M3"};
    iso_status status = ISO_OK;
    for (int i = 0; i < 3 && s->torque && status == ISO_OK; i++) {
        snprintf(text, sizeof text, "-%.17g*(%s)*omega%d", s->a, f, i + 1);
        status = iso_effects_write(ctx, effects, "torque", name[i], text);
    }
    snprintf(text, sizeof text, "%.17g*(%s)", s->a, f);
    if (!s->torque) status = iso_effects_write(ctx, effects, "potential", "U", text);
    if (status != ISO_OK) gsl_test(1, "an effect is refused: %s", iso_context_message(ctx));
}

/* --- the law ---------------------------------------------------------------------------------------------------- */

enum { BY_BALL, BY_POINT, BY_LANES, BY_OTHER, WAYS };
static const char *const way_name[] = {"ball, taylor", "point, taylor", "ball, lanes", "ball, rk8pd"};

typedef struct found {
    int cases, refused;
    double worst; /* error over what it may be */
    char where[160];
} found;

static iso_status solve(const scene *s, int way, double ball[6])
{
    iso_params p;
    iso_start start;
    iso_effects effects;
    iso_sample sample;
    write_effects(s, &effects);
    iso_status status = iso_params_reduced(ctx, s->k, J, &p);
    if (status == ISO_OK) status = iso_start_ball(ctx, s->y, s->y + 3, ISO_SPIN_REMOVE, &start);
    if (status != ISO_OK) return status;
    if (way == BY_LANES) {
        const iso_batch_orbit orbit = {&p, &start, &effects};
        const iso_batch_options o = iso_batch_defaults();
        iso_status of_orbit = ISO_OK;
        status = iso_batch_run(ctx, &orbit, 1, &o, &s->time, 1, &sample, &of_orbit);
        if (status == ISO_OK) status = of_orbit;
    } else {
        iso_orbit_options o = iso_orbit_defaults(&start);
        iso_orbit *orbit = NULL;
        o.effects = &effects;
        o.backend = way == BY_POINT ? ISO_BACKEND_POINT : ISO_BACKEND_BALL;
        o.method = iso_method_find(way == BY_OTHER ? "rk8pd" : "taylor");
        o.shown = ISO_SHOW_BALL;
        status = iso_orbit_create(ctx, &p, &start, &o, &orbit);
        if (status == ISO_OK) status = iso_orbit_at(orbit, s->time, &sample);
        iso_orbit_free(orbit);
    }
    if (status == ISO_OK) copy(sample.ball, ball, 6);
    return status;
}

static void hold(const scene *s, int way, const double end[6], double growth, found *w)
{
    double ball[6], sum = 0;
    w->cases++;
    if (solve(s, way, ball) != ISO_OK) {
        w->refused++;
        return;
    }
    for (int i = 0; i < 6; i++) sum += (ball[i] - end[i]) * (ball[i] - end[i]);
    const double ratio = sqrt(sum) / (1e-9 * (1 + growth));
    if (ratio <= w->worst) return;
    w->worst = isnan(ratio) ? INFINITY : ratio;
    snprintf(w->where, sizeof w->where, "%s%s of width %.3g, k = %g, error %.2g, growth %.2g", shape_name[s->shape],
             s->torque ? " (torque)" : "", s->width, s->k, sqrt(sum), growth);
}

int main(void)
{
    found found_by[WAYS] = {0};
    iso_random *r = iso_random_create(7);
    const int scenes = tests_length(35, 300);
    gsl_set_error_handler_off();
    ctx = iso_context_create();
    for (int i = 0; i < scenes; i++) {
        const scene s = make(r, i);
        double end[6];
        copy(s.y, end, 6);
        follow(&s, s.time, end);
        const double growth = growth_of(&s, end);
        for (int way = 0; way < WAYS; way++)
            if (way != BY_POINT || !s.torque) hold(&s, way, end, growth, &found_by[way]);
    }
    for (int way = 0; way < WAYS; way++) {
        const found *w = &found_by[way];
        gsl_test(!(w->worst <= 1), "%s: right to 1e-9 times the growth in %d features, worst %.2g of it: %s",
                 way_name[way], w->cases, w->worst, w->where);
        gsl_test(w->refused > w->cases / 30, "%s: %d of %d are refused", way_name[way], w->refused, w->cases);
    }
    iso_random_free(r);
    iso_context_free(ctx);
    return gsl_test_summary();
}

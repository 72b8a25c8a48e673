/* scenes.h - balls on all four surfaces with effects, and derivatives along their motion.
 *
 * The numbers that a test compares with are computed here from mass, signed radii and moments, without the library.
 */
#ifndef ISO_TESTS_SCENES_H
#define ISO_TESTS_SCENES_H

#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/random_impl.h"
#include "base/vec3_impl.h"
#include "laws.h"
#include "numbers.h"
#include "orbit/orbit.h"

/* --- balls ------------------------------------------------------------------------------------------------------ */

/* Half of them are bodies one can hold, half are reduced: D = m b^2 with |b| = 1. */
enum { ROLLINGS = 8 };

typedef struct rolling {
    char name[32];
    iso_params p;
    double m, a, b; /* mass and signed radii; a is infinite on a plane                                  */
    double I[3];    /* central moments                                                                  */
    double side;    /* of the contact as seen from the support: 1, and -1 where it is inside the ball   */
} rolling;

static inline rolling rolling_body(iso_context *ctx, const iso_body *body)
{
    rolling ball = {.m = body->mass, .side = body->surface == ISO_SHELL ? -1 : 1};
    const double A = body->surface_radius, B = body->radius;
    const bool outside = body->surface == ISO_PLANE || body->surface == ISO_OUTSIDE;
    ball.a = body->surface == ISO_PLANE ? INFINITY : A;
    ball.b = outside ? B : -B;
    copy(body->inertia, ball.I, 3);
    snprintf(ball.name, sizeof ball.name, "%s", iso_surface_name((int)body->surface));
    laws_stop_if(ctx, iso_params_physical(ctx, body, &ball.p) != ISO_OK, "a ball is refused");
    return ball;
}

/* a/(a+b) = k with |b| = 1, b < 0 for k < 0 and k > 1 so that a > 0 */
static inline rolling rolling_reduced(iso_context *ctx, double k)
{
    const double J[3] = {1.4, 2.1, 3.0}, D = 0.4;
    rolling ball = {.p = laws_params(k, J), .m = D, .b = k > 0 && k <= 1 ? 1 : -1, .side = k < 0 ? -1 : 1};
    ball.a = k == 1 ? INFINITY : ball.b * k / (1 - k);
    for (int i = 0; i < 3; i++) ball.I[i] = J[i] - D;
    snprintf(ball.name, sizeof ball.name, "k = %g", k);
    laws_stop_if(ctx, iso_params_set_D(ctx, D, &ball.p) != ISO_OK, "a ball is refused");
    return ball;
}

static inline rolling rolling_ball(iso_context *ctx, int which)
{
    static const double surface_radius[ROLLINGS / 2] = {0, 1.1, 1.9, 0.3}, k[ROLLINGS / 2] = {1, 0.35, 3.2, -1.6};
    const int i = which % (ROLLINGS / 2);
    if (which >= ROLLINGS / 2) return rolling_reduced(ctx, k[i]);
    const iso_body body = {1.3, 0.7, {0.3, 0.8, 1.0}, (iso_surface)(ISO_PLANE + i), surface_radius[i]};
    return rolling_body(ctx, &body);
}

static inline bool on_plane(const rolling *ball)
{
    return ball->p.k == 1;
}

/* --- what acts on them, and where they start -------------------------------------------------------------------- */

static const double scene_quadratic[9] = {0.3, 0.1, -0.05, 0.1, -0.2, 0.15, -0.05, 0.15, 0.4};
static const double scene_linear[3] = {0.2, -0.1, 0.15};

static inline void add_gravity(const rolling *ball, double g, const double up[3], iso_effects *e)
{
    e->on[ISO_GRAVITY] = true;
    GRAVITY_MGB(e) = ball->m * g * ball->b;
    copy(up, GRAVITY_UP(e), 3);
}

static inline void add_field(iso_effects *e)
{
    e->on[ISO_FIELD] = true;
    copy(scene_quadratic, FIELD_QUADRATIC(e), 9);
    copy(scene_linear, FIELD_LINEAR(e), 3);
}

static inline void add_twist(double c, iso_effects *e)
{
    e->on[ISO_TWIST] = true;
    TWIST_RESISTANCE(e) = c;
}

static inline void add_attitude(iso_random *random, iso_effects *e)
{
    double square = 0;
    for (int i = 0; i < 4; i++) QUATERNION(e)[i] = iso_random_normal(random);
    for (int i = 0; i < 4; i++) square += QUATERNION(e)[i] * QUATERNION(e)[i];
    for (int i = 0; i < 4; i++) QUATERNION(e)[i] /= sqrt(square);
    e->on[ISO_ATTITUDE] = true;
}

/* Random, of speed |omega| = 1. */
static inline iso_start scene_start(const rolling *ball, iso_random *random)
{
    iso_problem f = {.p = ball->p};
    iso_start start = {.model = ISO_BALL};
    laws_sample(&iso_system_ball, &f, random, start.y);
    make_unit(start.y);
    return start;
}

/* --- orbits ----------------------------------------------------------------------------------------------------- */

/* An orbit in the ball's time. The error of the integrator must be less than that of the differences. */
static inline iso_orbit *scene_orbit(iso_context *ctx, const rolling *ball, const iso_start *start,
                                     const iso_effects *effects, const iso_orbit_options *options)
{
    iso_orbit *orbit;
    iso_orbit_options o = options ? *options : iso_orbit_defaults(start);
    o.effects = effects;
    if (!options) o.tolerance = 1e-14;
    laws_stop_if(ctx, iso_orbit_create(ctx, &ball->p, start, &o, &orbit) != ISO_OK, ball->name);
    return orbit;
}

/* Everything shown and carried. */
static inline iso_orbit_options scene_all(const iso_start *start, iso_backend backend, iso_clock clock)
{
    iso_orbit_options o = iso_orbit_defaults(start);
    o.backend = backend;
    o.clock = clock;
    o.tolerance = 1e-14;
    o.shown = ISO_SHOW_BOTH;
    for (int c = 0; c < ISO_CLOCKS; c++) o.with_clock[c] = true;
    return o;
}

static inline iso_orbit *scene_by(iso_context *ctx, const iso_params *p, const iso_start *start,
                                  const iso_orbit_options *o)
{
    iso_orbit *orbit;
    laws_stop_if(ctx, iso_orbit_create(ctx, p, start, o, &orbit) != ISO_OK, "an orbit is refused");
    return orbit;
}

static inline iso_orbit *scene_whole(iso_context *ctx, const iso_params *p, const iso_start *start,
                                     iso_backend backend, iso_clock clock)
{
    const iso_orbit_options o = scene_all(start, backend, clock);
    return scene_by(ctx, p, start, &o);
}

static inline iso_sample scene_at(iso_context *ctx, iso_orbit *orbit, double time)
{
    iso_sample s;
    laws_stop_if(ctx, iso_orbit_at(orbit, time, &s) != ISO_OK, "an orbit stops");
    return s;
}

/* --- what is seen of them --------------------------------------------------------------------------------------- */

/* v in space: the rotation matrix of the quaternion, written out */
static inline void to_space(const iso_sample *s, const double v[3], double in_space[3])
{
    const double a = sample_of(s, "q")[0], b = sample_of(s, "q")[1], c = sample_of(s, "q")[2],
                 d = sample_of(s, "q")[3];
    const double R[3][3] = {
        {a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)},
        {2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)},
        {2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d},
    };
    for (int i = 0; i < 3; i++) in_space[i] = dot(R[i], v);
}

static inline const double *omega_of(const iso_sample *s)
{
    return s->ball;
}

static inline const double *normal_of(const iso_sample *s)
{
    return s->ball + 3;
}

static inline double spin_of(const iso_sample *s)
{
    return dot(omega_of(s), normal_of(s));
}

/* C n + l */
static inline void field_gradient(const iso_sample *s, double dU[3])
{
    for (int i = 0; i < 3; i++) dU[i] = dot(scene_quadratic + 3 * i, normal_of(s)) + scene_linear[i];
}

/* (1/2)(w,Jw) - (D/2)(w,n)^2, plus m g (a+b)(n,e), or m g times the height on a plane with attitude, plus U(n) */
static inline double energy_of(const rolling *ball, const iso_effects *e, const iso_sample *s)
{
    const double *w = omega_of(s), *n = normal_of(s), spin = dot(w, n), D = ball->m * ball->b * ball->b;
    double h = -D * spin * spin / 2, dU[3];
    for (int i = 0; i < 3; i++) h += (ball->I[i] + D) * w[i] * w[i] / 2;
    const double weight = GRAVITY_MGB(e) / ball->b; /* m g */
    if (e->on[ISO_GRAVITY] && !on_plane(ball)) h += weight * (ball->a + ball->b) * dot(n, sample_of(s, "e"));
    if (e->on[ISO_GRAVITY] && on_plane(ball)) {
        double up[3];
        to_space(s, sample_of(s, "e"), up);
        h += weight * dot(up, sample_of(s, "centre"));
    }
    field_gradient(s, dU);
    if (e->on[ISO_FIELD]) h += (dot(n, dU) + dot(scene_linear, n)) / 2;
    return h;
}

/* --- derivatives along an orbit --------------------------------------------------------------------------------- */

enum { REACH = 4, POINTS = 2 * REACH + 1 };

/* Nine samples around a time, h apart. */
typedef struct stencil {
    double h;
    iso_sample s[POINTS];
} stencil;

static inline stencil stencil_at(iso_context *ctx, iso_orbit *orbit, double time, double h)
{
    stencil st = {.h = h};
    for (int j = 0; j < POINTS; j++) st.s[j] = scene_at(ctx, orbit, time + (j - REACH) * h);
    return st;
}

/* The size of what is compared where the ball has this speed; it starts with 1, and rolls down a plane ever
 * faster. */
static inline double pace_of(const iso_sample *s)
{
    return fmax(1, norm(omega_of(s)));
}

/* Steps in which the ball turns by 1/30: 8-point differences leave about 1e-14. */
static inline stencil stencil_around(iso_context *ctx, iso_orbit *orbit, const rolling *ball, double time)
{
    const iso_sample s = scene_at(ctx, orbit, time);
    return stencil_at(ctx, orbit, time, 1 / (30 * (1 + fabs(ball->p.k)) * pace_of(&s)));
}

static inline const iso_sample *middle(const stencil *st)
{
    return st->s + REACH;
}

/* A vector seen in a sample. */
typedef void seen(const rolling *ball, const iso_sample *s, double v[3]);

static inline void first_derivative(const rolling *ball, const stencil *st, seen *f, double d[3])
{
    static const double weight[REACH] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    for (int i = 0; i < 3; i++) d[i] = 0;
    for (int j = 1; j <= REACH; j++) {
        double before[3], after[3];
        f(ball, middle(st) - j, before);
        f(ball, middle(st) + j, after);
        for (int i = 0; i < 3; i++) d[i] += weight[j - 1] * (after[i] - before[i]) / st->h;
    }
}

static inline void second_derivative(const rolling *ball, const stencil *st, seen *f, double d[3])
{
    static const double weight[REACH] = {8.0 / 5, -1.0 / 5, 8.0 / 315, -1.0 / 560};
    double here[3];
    f(ball, middle(st), here);
    for (int i = 0; i < 3; i++) d[i] = 0;
    for (int j = 1; j <= REACH; j++) {
        double before[3], after[3];
        f(ball, middle(st) - j, before);
        f(ball, middle(st) + j, after);
        for (int i = 0; i < 3; i++)
            d[i] += weight[j - 1] * ((after[i] - here[i]) - (here[i] - before[i])) / (st->h * st->h);
    }
}

static inline void centre_of(const rolling *ball, const iso_sample *s, double v[3])
{
    (void)ball;
    copy(sample_of(s, "centre"), v, 3);
}

#endif

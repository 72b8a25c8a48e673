/* orbits.h - orbits to run the methods on, and errors in the units of their tolerance. */
#ifndef ISO_TESTS_ORBITS_H
#define ISO_TESTS_ORBITS_H

#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/vec3_impl.h"
#include "effects.h"
#include "laws.h"
#include "method/integrator_impl.h"
#include "model/model_impl.h"

typedef struct orbit {
    iso_context *ctx;
    iso_model model; /* in the system's own clock, unless said otherwise       */
    double y0[ISO_MAX_STATE];
    double unit; /* time in which the unit vector moves by about one radian    */
} orbit;

enum { ORBIT_K = 4 };
static const double orbit_k[ORBIT_K] = {1, -1, 0.5, -0.4};
static const double orbit_J[3] = {1.4, 2.1, 3.0};

/* The model in another clock, or with carried clocks (which start at 0). */
static inline void orbit_clocks(orbit *o, iso_clock clock, bool carry_t, bool carry_tau, bool carry_s)
{
    double f[ISO_MAX_STATE];
    o->model =
        iso_model_assemble(o->model.system, &o->model.problem, clock, (const bool[]){carry_t, carry_tau, carry_s});
    o->model.rhs(&o->model, o->y0, f);
    o->unit = norm(f + 3) > 0 ? 1 / norm(f + 3) : 1;
}

/* A random orbit of the system. */
static inline orbit orbit_sample(iso_context *ctx, const iso_system *system, double k, const double J[3],
                                 unsigned long seed)
{
    orbit o = {.ctx = ctx, .model.system = system, .model.problem.p = laws_params(k, J)};
    iso_random *random = iso_random_create(seed);
    laws_sample(system, &o.model.problem, random, o.y0);
    iso_random_free(random);
    orbit_clocks(&o, system->clock, false, false, false);
    return o;
}

/* The same with a rotor in the ball, about as strong as the motion; on the point it is a magnetic field. */
static inline void orbit_add_rotor(orbit *o)
{
    iso_effects *const e = &o->model.problem.effects;
    e->on[ISO_ROTOR] = true;
    copy((const double[]){0.5, -0.3, 0.8}, ROTOR_MOMENTUM(e), 3);
    orbit_clocks(o, o->model.system->clock, false, false, false);
}

/* The ball turning about e3 in the plane n3 = 0: n = (cos k w t, -sin k w t, 0). */
static inline orbit orbit_rotation(iso_context *ctx, double k, double w)
{
    orbit o = {.ctx = ctx, .model.system = &iso_system_ball, .model.problem.p = laws_params(k, orbit_J)};
    o.y0[2] = w;
    o.y0[3] = 1;
    o.model.problem.energy = orbit_J[2] * w * w / 2;
    orbit_clocks(&o, ISO_CLOCK_T, false, false, false);
    return o;
}

/* A case of effects.h in one clock with the others carried; a point at times off the level H = 0. */
static inline orbit orbit_of(iso_context *ctx, const effects_case *c, int variant)
{
    orbit o = {.ctx = ctx, .model = c->model};
    iso_problem *const f = &o.model.problem;
    const iso_clock clock = (iso_clock)(variant % ISO_CLOCKS);
    const bool point = c->system == &iso_system_point, all = variant / ISO_CLOCKS % 2 == 0;
    copy(c->y, o.y0, c->model.dim);
    if (point && variant / (2 * ISO_CLOCKS) % 2 == 1) scale(o.y0, 1.1);
    double unused;
    f->energy = c->system->energy(f, o.y0, &unused);
    if (fabs(f->energy) < 1e-12 * c->kinetic) f->energy = 0;
    orbit_clocks(&o, clock, all && clock != ISO_CLOCK_T, all && clock != ISO_CLOCK_TAU, all && clock != ISO_CLOCK_S);
    return o;
}

/* The time in which the equations change much, in the orbit's clock. */
static inline double orbit_stretch(const effects_case *c, const orbit *o)
{
    double f[ISO_MAX_STATE], own[ISO_MAX_STATE];
    o->model.rhs(&o->model, o->y0, f);
    c->model.rhs(&c->model, c->y, own);
    return 128 * effects_step(c) * norm(own + 3) / norm(f + 3);
}

/* Whether the method can solve the equations of the system. */
static inline bool orbit_served(const iso_method *method, const iso_system *system)
{
    return !method->system || method->system == system;
}

/* An integrator that has been started at y0; ends the test when that is refused. */
static inline iso_integrator *orbit_start(const orbit *o, const iso_method *method, const iso_method_options *options)
{
    iso_integrator *it;
    if (iso_integrator_create(o->ctx, method, &o->model, options, &it) != ISO_OK ||
        iso_integrator_start(it, o->y0) != ISO_OK) {
        gsl_test(1, "%s does not start: %s", method->name, iso_context_message(o->ctx));
        exit(gsl_test_summary());
    }
    return it;
}

/* The state at one time; NaN when the integration fails. */
static inline void orbit_solve(const orbit *o, const iso_method *method, const iso_method_options *options, double t,
                               double y[])
{
    iso_integrator *it = orbit_start(o, method, options);
    if (iso_integrator_at(it, t, y) != ISO_OK)
        for (int i = 0; i < o->model.dim; i++) y[i] = NAN;
    iso_integrator_free(it);
}

/* The reference: the state by the finest method. */
static inline void orbit_reference(const orbit *o, double t, double y[])
{
    orbit_solve(o, iso_method_find("rk8pd"), &(iso_method_options){.tolerance = 1e-15}, t, y);
}

/* Largest error of a component, in units of its size. */
static inline double orbit_error(const orbit *o, const double a[], const double b[])
{
    double size[ISO_MAX_STATE], error[ISO_MAX_STATE];
    iso_model_size(&o->model, b, size);
    for (int i = 0; i < o->model.dim; i++) error[i] = (a[i] - b[i]) / size[i];
    return laws_max(o->model.dim, error);
}

#endif

/* hard_effects.h - shared by the hard cases of the effects: one ball, solved by each backend and method that can. */
#ifndef ISO_TESTS_HARD_EFFECTS_H
#define ISO_TESTS_HARD_EFFECTS_H

#include "hard.h"

/* A ball with J = 1.4, 2.1, 3 and D = 0.4 that turns about once in 5 units of time. */
static const double he_omega[3] = {0.9, -0.3, -0.225}, he_normal[3] = {0.36, 0.48, 0.8};

static inline iso_params he_ball(iso_context *ctx, double k)
{
    iso_params p = laws_params(k, (const double[]){1.4, 2.1, 3.0});
    if (iso_params_set_D(ctx, 0.4, &p) != ISO_OK) abort();
    return p;
}

static inline iso_start he_start(void)
{
    iso_start start = {.model = ISO_BALL};
    copy(he_omega, start.y, 3);
    copy(he_normal, start.y + 3, 3);
    return start;
}

/* The ways of the ball are the first; the others refuse effects that break the isomorphism (see he_refusals).
 *
 *     for (const hard_road *way = hard_way; he_is_ball(way); way++) ... */
static inline bool he_is_ball(const hard_road *way)
{
    return way->backend == ISO_BACKEND_BALL;
}

/* taylor and rk8pd at their least tolerance, where only rounding is left; the others as users run them. */
static inline double he_tolerance(const hard_road *way)
{
    if (way->method == iso_method_find("taylor")) return 1e-15;
    return way->method == iso_method_find("rk8pd") ? 1e-14 : way->tolerance;
}

static inline hard_road he_quad(void)
{
    const iso_method *quad = iso_method_find("taylor_quad");
    return (hard_road){ISO_BACKEND_BALL, quad ? quad : iso_method_find("taylor_extended"), 1e-15};
}

/* The answer of a way at a time t and the number of its steps: the ball, with the columns of its effects. */
typedef struct he_answer {
    iso_status status;
    iso_sample at;
    double steps;
} he_answer;

static inline iso_orbit *he_orbit(iso_context *ctx, const hard_road *way, const iso_params *p, const iso_start *start,
                                  const iso_effects *effects)
{
    iso_orbit *orbit;
    iso_orbit_options o = iso_orbit_defaults(start);
    o.effects = effects;
    o.backend = way->backend;
    o.method = way->method;
    o.tolerance = way->backend == ISO_BACKEND_BALL ? he_tolerance(way) : way->tolerance;
    o.max_steps = 10000000;
    return iso_orbit_create(ctx, p, start, &o, &orbit) == ISO_OK ? orbit : NULL;
}

static inline he_answer he_solve(iso_context *ctx, const hard_road *way, const iso_params *p, const iso_start *start,
                                 const iso_effects *effects, double time)
{
    he_answer a = {.status = ISO_NUMERICAL};
    iso_orbit *orbit = he_orbit(ctx, way, p, start, effects);
    if (!orbit) return a;
    a.status = iso_orbit_at(orbit, time, &a.at);
    a.steps = (double)iso_orbit_statistics(orbit).steps;
    iso_orbit_free(orbit);
    return a;
}

/* The errors of the steps add up: each is at most the tolerance. Rounding adds 100 units in the last place. The
 * orbits here are a turn or two long, or damped: on them errors at most double. */
static inline double he_bound(const hard_road *way, double steps)
{
    return 2 * steps * he_tolerance(way) + 100 * DBL_EPSILON;
}

/* The way answers, with an error of at most the bound. */
static inline void he_hold(const hard_road *way, const he_answer *a, const iso_sample *expected)
{
    hard_hold(way, a->status == ISO_OK ? hard_error(a->at.ball, expected->ball) : NAN, he_bound(way, a->steps));
}

/* The way refuses, and its message contains these words. */
static inline void he_refuses(iso_context *ctx, const hard_road *way, iso_status status, const char *words)
{
    const bool refused = status != ISO_OK && strstr(iso_context_message(ctx), words) != NULL;
    hard_refused(way, refused, refused ? words : iso_context_message(ctx));
}

/* No point has such a ball, and no closed solution is known. All ways of the point and the closed solution refuse. */
static inline void he_refusals(iso_context *ctx, const iso_params *p, const iso_start *start,
                               const iso_effects *effects, double time)
{
    for (const hard_road *way = hard_way; way < hard_way + hard_ways; way++) {
        if (he_is_ball(way)) continue;
        const he_answer a = he_solve(ctx, way, p, start, effects, time);
        he_refuses(ctx, way, a.status,
                   way->backend == ISO_BACKEND_EXACT ? "the closed solution is for a ball on which nothing acts"
                                                     : "breaks the isomorphism");
    }
}

static inline iso_sample he_reference(iso_context *ctx, const iso_params *p, const iso_start *start,
                                      const iso_effects *effects, double time)
{
    const hard_road quad = he_quad();
    const he_answer a = he_solve(ctx, &quad, p, start, effects, time);
    if (a.status != ISO_OK) hard_hold(&quad, NAN, 0);
    return a.at;
}

#endif

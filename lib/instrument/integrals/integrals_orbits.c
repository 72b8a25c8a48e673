/* integrals_orbits.c - the orbits on which functions are tried (integrals.h): starts, times, samples. */
#include <math.h>
#include <stdlib.h>

#include "base/math_impl.h"
#include "base/random_impl.h"
#include "base/vec3_impl.h"
#include "instrument/integrals/integrals_impl.h"
#include "map/section_impl.h"
#include "model/effects/effects_impl.h"
#include "model/model_impl.h"
#include "orbit/batch.h"

/* A time unit with which |M| <= 1, so that no power of it overflows: M^2/2 = H + eps q^(-1/k) has its largest value
 * at the smallest or at the largest q. On H = 0 then eps = 1/2: a free ball's does not matter, and can be 0. unit: of
 * J. */
static iso_status choose_level(iso_context *ctx, const iso_problem *scene, double unit, iso_problem *f)
{
    const double k = f->p.k, *J = f->p.J, H = scene->energy;
    const bool free = H == 0 && iso_effects_are_free(&scene->effects);
    const double eps = free ? 1 : scene->eps * pow(unit, -1 / k);
    const double size = 2 * fmax(H + eps * pow(min3(J), -1 / k), H + eps * pow(max3(J), -1 / k));
    if (!(size > 0 && isfinite(size))) return ISO_FAIL_INPUT(ctx, "M", "on this level the point can only be at rest");
    f->eps = eps / size;
    f->energy = H / size;
    if (free) return ISO_OK;
    const double omega = sqrt(size) * pow(unit, 1 / (2 * k) - 2);
    f->effects = scene->effects;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        for (const iso_effect_number *n = iso_effect_list[e]->numbers; f->effects.on[e] && n && n->name; n++) {
            const iso_dimension d = n->dimension;
            double *x = iso_effect_values(&f->effects, e, n);
            for (int i = 0; i < n->count; i++) x[i] /= pow(unit, d.J + d.J_2k / (2 * k)) * pow(omega, d.w);
        }
    return ISO_OK;
}

iso_point_motion iso_integral_motion(const integral_samples *s)
{
    return (iso_point_motion){&s->problem.p, s->problem.eps, s->problem.energy};
}

iso_status iso_integral_prepare(iso_context *ctx, const iso_problem *scene, uint64_t seed, size_t orbits,
                                integral_samples *s)
{
    const iso_params *p = &scene->p;
    const double unit = p->k > 0 ? min3(p->J) : max3(p->J); /* with it max(q^(-1/k)) = 1 */
    *s = (integral_samples){.orbits = orbits, .rows = orbits * ISO_INTEGRAL_ROWS};
    ISO_TRY(iso_params_check_powers(ctx, p));
    ISO_TRY(iso_params_reduced(ctx, p->k, (double[]){p->J[0] / unit, p->J[1] / unit, p->J[2] / unit}, &s->problem.p));
    ISO_TRY(choose_level(ctx, scene, unit, &s->problem));
    s->axis = iso_section_axis(iso_integral_motion(s));
    iso_section_spread_prepare(&s->spread, iso_integral_motion(s), s->axis, seed);
    return ISO_OK;
}

/* One time at random in each of the equal parts of the whole. A turn of n is at |k w|, with w^2 = 2 h/J of the middle
 * moment J, in t; off H = 0, the time between two crossings of the section, in s. */
static iso_status choose_times(iso_context *ctx, const iso_integral_search_options *o, const integral_samples *s,
                               double times[ISO_INTEGRAL_ROWS])
{
    const iso_params *p = &s->problem.p;
    const double h = iso_energy(p, s->problem.eps);
    int axis[3];
    double W[2];
    iso_random *random = iso_random_create((unsigned long)o->seed + 1);
    if (!random) return iso_context_no_memory(ctx, "random numbers");
    sort_by(p->J, axis);
    iso_section_bounds(iso_integral_motion(s), s->axis, W);
    const double turn =
        s->problem.energy != 0 ? 4 * ISO_PI / (W[0] + W[1]) : 2 * ISO_PI / (fabs(p->k) * sqrt(2 * h / p->J[axis[1]]));
    const double part = o->turns * turn / ISO_INTEGRAL_ROWS;
    for (int i = 0; i < ISO_INTEGRAL_ROWS; i++) times[i] = part * (i + iso_random_uniform(random, 0, 1));
    iso_random_free(random);
    return ISO_OK;
}

/* Takes rounding errors across the surface away: on it, some functions are zero. M is stretched to the level; where it
 * is too small for that, the state goes along the gradient of H. Returns the error of the energy, relative to its
 * terms. */
static double move_to_surface(const iso_problem *f, double y[ISO_STATE])
{
    double size;
    make_unit(y + 3);
    remove_along(y, y + 3);
    const double off = iso_system_point.energy(f, y, &size) - f->energy, T = dot(y, y) / 2;
    const bool stretches = T > 0.1 * size;
    if (stretches) scale(y, sqrt((T - off) / T));
    for (int pass = 0; pass < 2 && !stretches; pass++) {
        const double left = iso_system_point.energy(f, y, &size) - f->energy;
        const double q = dot_diag(y + 3, f->p.J, y + 3), factor = 2 * f->eps / f->p.k * pow(q, -1 - 1 / f->p.k);
        double slope[ISO_STATE], *dV = slope + 3;
        copy(y, slope, 3);
        diag(f->p.J, y + 3, dV);
        scale(dV, factor);
        remove_along(dV, y + 3);
        const double square = dot(slope, slope) + dot(dV, dV);
        for (int i = 0; i < ISO_STATE && square > 0; i++) y[i] -= left / square * slope[i];
        make_unit(y + 3);
        remove_along(y, y + 3);
    }
    return off == 0 ? 0 : off / size;
}

iso_status iso_integral_follow(iso_context *ctx, const iso_integral_search_options *options, integral_samples *s,
                               double *energy)
{
    double times[ISO_INTEGRAL_ROWS];
    iso_start *start = calloc(s->orbits, sizeof *start);
    iso_batch_orbit *orbit = calloc(s->orbits, sizeof *orbit);
    iso_sample *sample = calloc(s->rows, sizeof *sample);
    iso_batch_options o = iso_batch_defaults();
    o.tolerance = options->tolerance;
    o.threads = options->threads;
    o.shown = ISO_SHOW_POINT;
    if (s->problem.energy != 0) o.backend = ISO_BACKEND_POINT, o.clock = ISO_CLOCK_S;
    s->state = calloc(s->rows, sizeof *s->state);
    const bool room = start && orbit && sample && s->state;
    for (size_t i = 0; room && i < s->orbits; i++) {
        double l, x;
        iso_section_spread_point(&s->spread, i, &l, &x);
        start[i] = (iso_start){.model = ISO_POINT, .eps = s->problem.energy == 0 ? NAN : s->problem.eps};
        iso_section_point(iso_integral_motion(s), s->axis, l, x, start[i].y);
        orbit[i] = (iso_batch_orbit){&s->problem.p, &start[i], &s->problem.effects};
    }
    iso_status status =
        room ? choose_times(ctx, options, s, times) : iso_context_no_memory(ctx, "%zu orbits", s->orbits);
    if (status == ISO_OK) status = iso_batch_run(ctx, orbit, s->orbits, &o, times, ISO_INTEGRAL_ROWS, sample, NULL);
    double sum = 0;
    for (size_t i = 0; i < s->rows && status == ISO_OK; i++) {
        copy(sample[i].point, s->state[i], ISO_STATE);
        const double error = move_to_surface(&s->problem, s->state[i]);
        s->state[i][INTEGRAL_V] = iso_integral_v(&s->problem, s->state[i]);
        sum += error * error;
    }
    *energy = sqrt(sum / (double)s->rows);
    free(start);
    free(orbit);
    free(sample);
    if (status != ISO_OK || isfinite(*energy)) return status;
    return ISO_FAIL_NUMERICAL(ctx, "powers of q do not fit a double for this k and J");
}

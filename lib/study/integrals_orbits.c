/* integrals_orbits.c - the orbits on which functions are tried (integrals.h): starts, times, samples. */
#include <math.h>
#include <stdlib.h>

#include "base/pi_impl.h"
#include "base/random.h"
#include "base/vec3_impl.h"
#include "orbit/batch.h"
#include "study/integrals_impl.h"

/* eps = 1/2 and max(q^(-1/k)) = 1: then |M| = q^(-1/(2k)) <= 1, and no power of it overflows. */
iso_status iso_integral_prepare(iso_context *ctx, const iso_params *p, uint64_t seed, size_t orbits,
                                integral_samples *s)
{
    const double low = fmin(p->J[0], fmin(p->J[1], p->J[2])), high = fmax(p->J[0], fmax(p->J[1], p->J[2]));
    const double unit = p->k > 0 ? low : high, J[3] = {p->J[0] / unit, p->J[1] / unit, p->J[2] / unit};
    if (!(log(high / low) / fabs(p->k) < 650))
        return iso_context_fail(
            ctx, ISO_BAD_INPUT, "k",
            "k = %.15g is too near 0 for these moments: (max J/min J)^(1/|k|) does not fit a double", p->k);
    *s = (integral_samples){.orbits = orbits, .rows = orbits * ISO_INTEGRAL_ROWS, .problem = {.eps = 0.5}};
    const iso_status status = iso_params_reduced(ctx, p->k, J, &s->problem.p);
    if (status != ISO_OK) return status;
    s->axis = iso_section_axis(iso_free_point(&s->problem.p, 1));
    iso_section_spread_prepare(&s->spread, iso_free_point(&s->problem.p, 1), s->axis, seed);
    return ISO_OK;
}

/* A turn of n at |k w|, with w^2 = 2 h/J of the middle moment J. */
static double turn_of(const integral_samples *s)
{
    const iso_params *p = &s->problem.p;
    int axis[3];
    sort_by(p->J, axis);
    const double h = iso_energy(p, s->problem.eps);
    return 2 * ISO_PI / (fabs(p->k) * sqrt(2 * h / p->J[axis[1]]));
}

/* One time at random in each of the equal parts of the whole. */
static iso_status choose_times(iso_context *ctx, const iso_integral_search_options *o, const integral_samples *s,
                               double times[ISO_INTEGRAL_ROWS])
{
    iso_random *random = iso_random_create((unsigned long)o->seed + 1);
    if (!random) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for random numbers");
    const double part = o->turns * turn_of(s) / ISO_INTEGRAL_ROWS;
    for (int i = 0; i < ISO_INTEGRAL_ROWS; i++) times[i] = part * (i + iso_random_uniform(random, 0, 1));
    iso_random_free(random);
    return ISO_OK;
}

/* Takes rounding errors across the surface away: on it, some functions are zero. Gives the error of the energy. */
static double put_on_surface(const iso_params *p, double y[ISO_STATE])
{
    make_unit(y + 3);
    remove_along(y, y + 3);
    const double q = dot_diag(y + 3, p->J, y + 3), length = pow(q, -0.5 / p->k), error = norm(y) / length - 1;
    scale(y, 1 / (1 + error));
    return 2 * error;
}

static double keep_samples(integral_samples *s, const iso_sample sample[])
{
    double sum = 0;
    for (size_t i = 0; i < s->rows; i++) {
        copy(sample[i].point, s->state[i], ISO_STATE);
        const double error = put_on_surface(&s->problem.p, s->state[i]);
        sum += error * error;
    }
    return sqrt(sum / (double)s->rows);
}

/* The room of the orbits while they are followed. */
typedef struct room {
    iso_start *start;
    iso_batch_orbit *orbit;
    iso_sample *sample;
} room;

static iso_status follow(iso_context *ctx, const iso_integral_search_options *options, integral_samples *s, room *r)
{
    double times[ISO_INTEGRAL_ROWS];
    iso_batch_options o = iso_batch_defaults();
    o.tolerance = options->tolerance;
    o.threads = options->threads;
    o.shown = ISO_SHOW_POINT;
    for (size_t i = 0; i < s->orbits; i++) {
        double l, x;
        iso_section_spread_point(&s->spread, i, &l, &x);
        r->start[i] = (iso_start){.model = ISO_POINT, .eps = NAN};
        iso_section_point(iso_free_point(&s->problem.p, s->problem.eps), s->axis, l, x, r->start[i].y);
        r->orbit[i] = (iso_batch_orbit){&s->problem.p, &r->start[i], NULL};
    }
    const iso_status status = choose_times(ctx, options, s, times);
    if (status != ISO_OK) return status;
    return iso_batch_run(ctx, r->orbit, s->orbits, &o, times, ISO_INTEGRAL_ROWS, r->sample, NULL);
}

iso_status iso_integral_follow(iso_context *ctx, const iso_integral_search_options *options, integral_samples *s,
                               double *energy)
{
    room r = {calloc(s->orbits, sizeof *r.start), calloc(s->orbits, sizeof *r.orbit),
              calloc(s->rows, sizeof *r.sample)};
    s->state = calloc(s->rows, sizeof *s->state);
    iso_status status = ISO_OK;
    if (!r.start || !r.orbit || !r.sample || !s->state)
        status = iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for %zu orbits", s->orbits);
    if (status == ISO_OK) status = follow(ctx, options, s, &r);
    if (status == ISO_OK) *energy = keep_samples(s, r.sample);
    free(r.start);
    free(r.orbit);
    free(r.sample);
    if (status != ISO_OK || isfinite(*energy)) return status;
    return iso_context_fail(ctx, ISO_NUMERICAL, "", "powers of q do not fit a double for this k and J");
}

/* A ball with a rotor, and the point in its magnetic field: states in quadruple precision by both backends, the
 * motion backwards, and the reversors of the return map. */
#include "base/math_impl.h"
#include "crossed.h"
#include "map/section_impl.h"
#include "numbers.h"
#include "orbit/crossings_impl.h"
#include "orbit/orbit_impl.h"
#include "reference.h"

static iso_context *ctx;

typedef struct rotor_case {
    iso_params p;
    iso_start start;
    iso_effects effects;
} rotor_case;

static iso_effects rotor_of(const double K[3])
{
    iso_effects e = iso_effects_default();
    e.on[ISO_ROTOR] = true;
    copy(K, ROTOR_MOMENTUM(&e), 3);
    return e;
}

static iso_orbit *open_orbit(const rotor_case *c, iso_backend backend, double tolerance)
{
    iso_orbit_options o = iso_orbit_defaults(&c->start);
    iso_orbit *orbit;
    o.backend = backend;
    o.tolerance = tolerance;
    o.effects = &c->effects;
    o.shown = ISO_SHOW_BOTH;
    o.clock = ISO_CLOCK_T;
    o.with_clock[ISO_CLOCK_S] = true;
    laws_stop_if(ctx, iso_orbit_create(ctx, &c->p, &c->start, &o, &orbit) != ISO_OK, "an orbit");
    return orbit;
}

static iso_sample state_at(const rotor_case *c, iso_backend backend, double tolerance, double t)
{
    iso_orbit *orbit = open_orbit(c, backend, tolerance);
    iso_sample s;
    laws_stop_if(ctx, iso_orbit_at(orbit, t, &s) != ISO_OK, "a state");
    iso_orbit_free(orbit);
    return s;
}

static double distance(const double a[ISO_STATE], const double b[ISO_STATE])
{
    double d[ISO_STATE];
    for (int i = 0; i < ISO_STATE; i++) d[i] = a[i] - b[i];
    return laws_max(ISO_STATE, d);
}

static rotor_case ball_case(double k, const double J[3], const double K[3], const double omega[3], const double n[3])
{
    rotor_case c = {.p = laws_params(k, J), .effects = rotor_of(K)};
    laws_stop_if(ctx, iso_start_ball(ctx, omega, n, ISO_SPIN_REMOVE, &c.start) != ISO_OK, "a start");
    return c;
}

/* k from -3 to 3, moments from 0.5 to 3, |K| up to 3 */
static rotor_case random_case(iso_random *r)
{
    const double k = iso_random_uniform(r, 0.3, 3) * (iso_random_uniform(r, -1, 1) < 0 ? -1 : 1);
    double J[3], K[3], omega[3], n[3];
    iso_random_direction(r, K);
    iso_random_direction(r, n);
    scale(K, iso_random_uniform(r, 0, 3));
    for (int i = 0; i < 3; i++) {
        J[i] = iso_random_uniform(r, 0.5, 3);
        omega[i] = iso_random_normal(r);
    }
    return ball_case(k, J, K, omega, n);
}

/* How much a small change of the start has grown by time t, at least 1: by the deviations, and evenly along the orbit,
 * where a change of the energy goes. */
static double growth_of(const rotor_case *c, double t)
{
    iso_crossings_options o = iso_crossings_defaults();
    const iso_batch_orbit of = {&c->p, &c->start, &c->effects};
    iso_crossing at;
    o.backend = ISO_BACKEND_BALL;
    o.kind = ISO_SECTION_CLOCK;
    o.value = t;
    o.deviations = true;
    laws_stop_if(ctx, !crossed(ctx, &of, &o, 1, &at, NULL), "deviations");
    return fmax(1, exp(fmax(at.growth[0], at.growth[1]))) * (1 + t);
}

/* --- states in quadruple precision ------------------------------------------------------------------------------ */

/* k, J, K, w and n at the start; t, s; w, n, M, gamma there */
enum { REFERENCES = 10, NUMBERS = 27 };

static void references(void)
{
    FILE *file = fopen(ISO_TEST_DATA "/rotor.csv", "r");
    char line[4096];
    double x[NUMBERS];
    int count = 0;
    laws_worst worst = {0}, clock = {0};
    while (file && fgets(line, sizeof line, file)) {
        if (strncmp(line, "rot", 3) != 0) continue;
        laws_stop_if(ctx, !reference_numbers(line, NUMBERS, x), "a row of rotor.csv");
        const rotor_case c = ball_case(x[0], x + 1, x + 4, x + 7, x + 10);
        const double t = x[13], bound = 1e-14 * growth_of(&c, t); /* the tolerance, grown */
        for (iso_backend b = ISO_BACKEND_BALL; b <= ISO_BACKEND_POINT; b++) {
            const iso_sample s = state_at(&c, b, 1e-14, t);
            laws_note(&worst, distance(s.ball, x + 15), bound, &c.p, iso_backend_name((int)b));
            laws_note(&worst, distance(s.point, x + 21), bound * norm(x + 21), &c.p, iso_backend_name((int)b));
            laws_note(&clock, fabs(s.clock[ISO_CLOCK_S] / x[14] - 1), bound, &c.p, iso_backend_name((int)b));
        }
        count++;
    }
    if (file) fclose(file);
    gsl_test_int(count, REFERENCES, "rows of rotor.csv");
    laws_report(&worst, "states of rotor.csv by both backends");
    laws_report(&clock, "their clock s");
}

/* --- the motion backwards --------------------------------------------------------------------------------------- */

static rotor_case turned_back(const rotor_case *c, const iso_sample *there, double sign)
{
    rotor_case back = *c;
    copy(there->ball, back.start.y, ISO_STATE);
    scale(back.start.y, -1);
    scale(ROTOR_MOMENTUM(&back.effects), sign);
    return back;
}

/* Home again with -K; and with K not. */
static void backwards(iso_random *r)
{
    laws_worst home = {0};
    double least = INFINITY;
    const double t = 12;
    for (int i = 0; i < 40; i++) {
        const rotor_case c = random_case(r);
        const double bound = 1e-11 * growth_of(&c, t);
        double begin[ISO_STATE];
        copy(c.start.y, begin, ISO_STATE);
        scale(begin, -1);
        for (iso_backend b = ISO_BACKEND_BALL; b <= ISO_BACKEND_POINT; b++) {
            const iso_sample there = state_at(&c, b, 1e-14, t);
            const rotor_case back = turned_back(&c, &there, -1), same = turned_back(&c, &there, 1);
            const iso_sample here = state_at(&back, b, 1e-14, t), elsewhere = state_at(&same, b, 1e-14, t);
            laws_note(&home, distance(here.ball, begin), bound, &c.p, iso_backend_name((int)b));
            if (norm(ROTOR_MOMENTUM(&c.effects)) > 0.3) least = fmin(least, distance(elsewhere.ball, begin));
        }
    }
    laws_report(&home, "backwards with -K: home again");
    gsl_test(!(least > 1e-3), "backwards with K: elsewhere, by %.2g at least", least);
}

/* --- reversors of the return map -------------------------------------------------------------------------------- */

/* f of z on the section n_axis = 0, with the energy of c */
static void return_map(const rotor_case *c, int axis, double z[2])
{
    iso_orbit *orbit = open_orbit(c, ISO_BACKEND_BALL, 1e-14);
    iso_crossings_options o = iso_crossings_defaults();
    iso_crossing crossing;
    const iso_start start = iso_section_start(orbit, ISO_BALL, axis, z[0], z[1]);
    o.axis = axis;
    o.backend = ISO_BACKEND_BALL;
    o.tolerance = 1e-14;
    const iso_batch_orbit of = {&c->p, &start, &c->effects};
    laws_stop_if(ctx, !crossed(ctx, &of, &o, 1, &crossing, NULL), "a crossing");
    z[0] = crossing.l;
    z[1] = crossing.x;
    iso_orbit_free(orbit);
}

/* |S f S f z - z| */
static double off(const rotor_case *c, int axis, int reversor, const double z[2])
{
    double at[2] = {z[0], z[1]};
    for (int i = 0; i < 2; i++) {
        return_map(c, axis, at);
        if (reversor == 0) at[1] = -at[1];
        if (reversor > 0) at[0] = (reversor == 2 ? ISO_PI : 0) - at[0];
    }
    return fmax(fabs(remainder(at[0] - z[0], 2 * ISO_PI)), fabs(at[1] - z[1]));
}

/* K along each axis, and in each principal plane. S1, S2, S3 turn K_a, K_b, K_c over, so these must be 0. */
static void reversors(void)
{
    laws_worst worst = {0};
    double least = INFINITY;
    const double z[2] = {0.7, 0.4};
    for (int some = 0; some < 8; some++)
        for (int axis = 0; axis < 3; axis++) {
            const double K[3] = {some & 1 ? 0.3 : 0, some & 2 ? -0.2 : 0, some & 4 ? 0.25 : 0};
            const rotor_case c = ball_case(0.75, (const double[]){1.4, 2.1, 3}, K, (const double[]){1, 0.2, 0},
                                           (const double[]){0, 0, 1});
            const iso_problem f = {.p = c.p, .effects = c.effects};
            const unsigned held = iso_section_reversors(&f, axis);
            for (int s = 0; s < 3; s++) {
                const bool expected = K[(axis + s) % 3] == 0;
                gsl_test((held >> s & 1) != expected, "S%d of n_%d = 0 with K of kind %d", s + 1, axis + 1, some);
                const double error = off(&c, axis, s, z);
                if (expected) laws_note(&worst, error, 1e-10, &c.p, "S f S f");
                if (!expected) least = fmin(least, error);
            }
        }
    laws_report(&worst, "reversors that hold");
    gsl_test(!(least > 1e-4), "reversors that do not: off by %.2g at least", least);
}

int main(void)
{
    ctx = iso_context_create();
    iso_random *r = iso_random_create(2024);
    references();
    backwards(r);
    reversors();
    iso_random_free(r);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

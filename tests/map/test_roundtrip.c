/* ball -> point -> ball and point -> ball -> point (18): what rounding does in one round trip and in a thousand.
 *
 * Errors are counted in units in the last place of the norm of the vector (w, n, M, gamma) a component belongs to.
 * The bound of one round trip is 4 max(1, 1/|2k|), because M goes with q^(-1/(2k)); of a thousand, 32 times that.
 * One trip that starts from the point is granted twice as much: gamma comes back with each component off by up to 2
 * epsilon (four roundings), q with 4, M therefore with 4/|2k|, and an epsilon of a norm is up to two units in its
 * last place.
 */
#include <float.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>

#include "base/vec3_impl.h"
#include "laws.h"
#include "map/state.h"
#include "model/model_impl.h"

enum { STATES = 3, TRIPS = 1000 };

typedef void state_map(const iso_params *p, const double from[ISO_STATE], double to[ISO_STATE]);

typedef struct trip {
    state_map *there, *back;
    double grant;         /* for one trip */
    const char *names[2]; /* of the two vectors */
    laws_worst once, thousand;
} trip;

/* The largest error of a component, in units in the last place of the vector's norm */
static double ulps(const double y[3], const double start[3])
{
    double largest = 0;
    const double ulp = ldexp(DBL_EPSILON, ilogb(laws_norm(start)));
    for (int i = 0; i < 3; i++) {
        const double error = fabs(y[i] - start[i]) / ulp;
        if (!(error <= largest)) largest = error;
        if (isnan(error)) return error;
    }
    return largest;
}

static void note(trip *t, laws_worst *worst, double factor, const iso_params *p, const double y[ISO_STATE],
                 const double start[ISO_STATE])
{
    const double bound = factor * 4 * fmax(1, 1 / fabs(2 * p->k));
    for (int v = 0; v < 2; v++) laws_note(worst, ulps(y + 3 * v, start + 3 * v), bound, p, t->names[v]);
}

/* On the way to the thousandth trip the error must be within the last one's bound, too. */
static void run(trip *t, const iso_params *p, const double start[ISO_STATE])
{
    double y[ISO_STATE], twin[ISO_STATE];
    copy(start, y, ISO_STATE);
    for (int i = 1; i <= TRIPS; i++) {
        t->there(p, y, twin);
        t->back(p, twin, y);
        if (i == 1) note(t, &t->once, t->grant, p, y, start);
        if (i % 100 == 0) note(t, &t->thousand, 32, p, y, start);
    }
}

/* A random valid ball whose speed is of the order `speed` */
static void sample(const iso_params *p, double speed, iso_random *random, double ball[ISO_STATE])
{
    iso_problem f = {.p = *p};
    laws_sample(&iso_system_ball, &f, random, ball);
    scale(ball, speed);
}

int main(void)
{
    static const double k[] = {0.05, 0.1, 0.25, 0.4, 0.5, 0.75, 1, 1.5, 2, 4, 10, 50};
    static const double J[][3] = {{1.4, 2.1, 3.0}, {3.0, 1.4, 2.1}, {2, 2, 3},     {2, 2, 2},
                                  {1, 30, 1000},   {1e6, 1, 1.3e3}, {1, 1e6, 1e6}, {0.7e-3, 2.3e-4, 3.9e2}};
    static const double speed[] = {1e-150, 1e-80, 1e-9, 1, 3e7, 1e81, 1e150};
    trip there = {.there = iso_ball_to_point, .back = iso_point_to_ball, .grant = 1, .names = {"w", "n"}};
    trip back = {.there = iso_point_to_ball, .back = iso_ball_to_point, .grant = 2, .names = {"M", "gamma"}};
    iso_random *random = iso_random_create(1);
    gsl_test_verbose(1);
    for (size_t i = 0; i < 2 * sizeof k / sizeof *k; i++)
        for (size_t j = 0; j < sizeof J / sizeof *J; j++)
            for (size_t l = 0; l < sizeof speed / sizeof *speed; l++)
                for (int state = 0; state < STATES; state++) {
                    double ball[ISO_STATE], point[ISO_STATE];
                    const iso_params p = laws_params(i % 2 ? -k[i / 2] : k[i / 2], J[j]);
                    sample(&p, speed[l], random, ball);
                    iso_ball_to_point(&p, ball, point);
                    run(&there, &p, ball);
                    run(&back, &p, point);
                }
    iso_random_free(random);
    laws_report(&there.once, "ball -> point -> ball, ulp");
    laws_report(&there.thousand, "ball -> point -> ball 1000 times, ulp");
    laws_report(&back.once, "point -> ball -> point, ulp");
    laws_report(&back.thousand, "point -> ball -> point 1000 times, ulp");
    exit(gsl_test_summary());
}

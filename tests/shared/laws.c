#include "laws.h"

#include <float.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/random_impl.h"
#include "base/vec3_impl.h"
#include "model/model_impl.h"

const double laws_k[LAWS_K] = {1, -1, 0.5, 0.75, -0.4, 1.5, -2, 0.25, 4, 0.05, 50};

const double laws_J[LAWS_J][3] = {
    {1.4, 2.1, 3.0}, {3.0, 1.4, 2.1}, {2.1, 3.0, 1.4},     {3.0, 2.1, 1.4}, {2, 2, 3},     {2, 3, 2},
    {3, 2, 2},       {2, 2, 2},       {1, 1.0001, 1.0002}, {1, 30, 1000},   {1000, 1, 30},
};

void laws_stop_if(const iso_context *ctx, bool failed, const char *what)
{
    if (!failed) return;
    gsl_test(1, "%s: %s", what, iso_context_message(ctx));
    exit(gsl_test_summary());
}

iso_params laws_params(double k, const double J[3])
{
    iso_params p;
    iso_context *ctx = iso_context_create();
    if (!ctx || iso_params_reduced(ctx, k, J, &p) != ISO_OK) {
        gsl_test(1, "parameters k = %g, J = %g %g %g refused", k, J[0], J[1], J[2]);
        exit(gsl_test_summary());
    }
    iso_context_free(ctx);
    return p;
}

void laws_sample(const iso_system *system, iso_problem *f, iso_random *r, double y[ISO_STATE])
{
    const bool ball = system == &iso_system_ball;
    double unused;
    f->energy = 0;
    f->eps = ball ? 0 : iso_random_uniform(r, 0.5, 2) * f->p.det_J / (f->p.k * f->p.k);
    iso_random_direction(r, y + 3);
    if (!ball) iso_random_direction(r, y);
    for (int i = 0; ball && i < 3; i++) y[i] = iso_random_normal(r);
    for (int pass = 0; pass < 2; pass++) remove_along(y, y + 3); /* twice: it may be nearly along n or gamma */
    if (ball) {
        f->energy = system->energy(f, y, &unused);
    } else {
        const double rest[ISO_STATE] = {0, 0, 0, y[3], y[4], y[5]};
        scale(y, sqrt(-2 * system->energy(f, rest, &unused)) / norm(y));
    }
}

void laws_note(laws_worst *worst, double error, double allowed, const iso_params *p, const char *what)
{
    const double ratio = error == 0 && allowed == 0 ? 0 : error / allowed;
    worst->cases++;
    if (isnan(ratio)) worst->nan = true;
    if (worst->cases > 1 && !isnan(ratio) && ratio <= worst->ratio) return;
    if (!isnan(ratio)) worst->ratio = ratio, worst->error = error;
    snprintf(worst->where, sizeof worst->where, "%s k=%.5g J=%.5g,%.5g,%.5g", what ? what : "", p->k, p->J[0],
             p->J[1], p->J[2]);
}

void laws_report(const laws_worst *w, const char *law)
{
    const bool good = w->cases > 0 && !w->nan && w->ratio <= 1;
    gsl_test(!good, "%s: worst %.2g = %.2g of its bound in %ld (%s)%s", law, w->error, w->ratio, w->cases, w->where,
             w->nan ? " NaN" : "");
}

static void run_states(const iso_system *system, const iso_params *p, iso_random *random, laws_law *law,
                       laws_worst *worst)
{
    for (int i = 0; i < LAWS_STATES; i++) {
        laws_case c = {.system = system, .problem = {.p = *p}, .random = random};
        laws_sample(system, &c.problem, random, c.y);
        law(&c, worst);
    }
}

static laws_worst run(const iso_system *system, laws_law *law)
{
    laws_worst worst = {0};
    iso_random *random = iso_random_create(2007);
    for (int i = 0; i < LAWS_K; i++)
        for (int j = 0; j < LAWS_J; j++) {
            const iso_params p = laws_params(laws_k[i], laws_J[j]);
            run_states(system, &p, random, law, &worst);
        }
    iso_random_free(random);
    return worst;
}

void laws_hold(const char *name, const iso_system *system, laws_law *law)
{
    for (int i = 0; iso_systems[i]; i++) {
        if (system && system != iso_systems[i]) continue;
        char title[128];
        const laws_worst worst = run(iso_systems[i], law);
        snprintf(title, sizeof title, "%s: %s", iso_systems[i]->name, name);
        laws_report(&worst, title);
    }
}

void laws_fail(const char *name, const iso_system *system, laws_law *law)
{
    for (int i = 0; iso_systems[i]; i++) {
        if (system && system != iso_systems[i]) continue;
        const laws_worst worst = run(iso_systems[i], law);
        gsl_test(!(worst.cases > 0 && !worst.nan && worst.ratio >= 1), "%s: %s: visible, %.2g (%s)",
                 iso_systems[i]->name, name, worst.error, worst.where);
    }
}

/* f'(0) = sum_j c_j (f(j h) - f(-j h))/h, exact for polynomials of degree 8 */
static const double central[4] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};

void laws_slope(laws_function *f, const void *data, int count, int n, const double y[], const double direction[],
                double h, double slope[])
{
    for (int i = 0; i < count; i++) slope[i] = 0;
    for (int j = 1; j <= 4; j++)
        for (int sign = -1; sign <= 1; sign += 2) {
            double moved[LAWS_MAX], value[LAWS_MAX];
            for (int i = 0; i < n; i++) moved[i] = y[i] + sign * j * h * direction[i];
            f(data, moved, value);
            for (int i = 0; i < count; i++) slope[i] += sign * central[j - 1] * value[i] / h;
        }
}

/* Runge and Kutta's fourth order, short enough steps to leave rounding errors only. */
static void flow(const laws_case *c, double time, double y[ISO_STATE])
{
    enum { STEPS = 16 };
    static const double node[4] = {0, 0.5, 0.5, 1}, weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    const double h = time / STEPS;
    for (int step = 0; step < STEPS; step++) {
        double slope[ISO_STATE] = {0}, stage[ISO_STATE], sum[ISO_STATE] = {0};
        for (int s = 0; s < 4; s++) {
            for (int i = 0; i < ISO_STATE; i++) stage[i] = y[i] + node[s] * h * slope[i];
            c->system->rhs(&c->problem, stage, slope);
            for (int i = 0; i < ISO_STATE; i++) sum[i] += weight[s] * slope[i];
        }
        for (int i = 0; i < ISO_STATE; i++) y[i] += h * sum[i];
    }
}

void laws_slope_flow(laws_function *f, const void *data, int count, const laws_case *c, double h, double slope[])
{
    for (int i = 0; i < count; i++) slope[i] = 0;
    for (int j = 1; j <= 4; j++)
        for (int sign = -1; sign <= 1; sign += 2) {
            double moved[ISO_STATE], value[LAWS_MAX];
            copy(c->y, moved, ISO_STATE);
            flow(c, sign * j * h, moved);
            f(data, moved, value);
            for (int i = 0; i < count; i++) slope[i] += sign * central[j - 1] * value[i] / h;
        }
}

double laws_step(const laws_case *c, const double direction[ISO_STATE])
{
    const double speed = c->system->speed(&c->problem, c->y);
    const double fast = norm(direction) / speed, slow = norm(direction + 3);
    const double way = fmax(fast, slow);
    return way > 0 ? laws_reach(&c->problem.p) / (128 * way) : 1;
}

double laws_reach(const iso_params *p)
{
    return 1 / (sqrt(laws_spread(p)) * (1 + 1 / fabs(p->k)));
}

double laws_rounding(const iso_params *p)
{
    return DBL_EPSILON * (4 + 4 / fabs(p->k));
}

bool laws_regular(const laws_case *c)
{
    const double *J = c->problem.p.J, *x = c->y + 3;
    const bool apart = fabs(J[0] - J[1]) > 0.1 && fabs(J[1] - J[2]) > 0.1 && fabs(J[2] - J[0]) > 0.1;
    return apart && laws_spread(&c->problem.p) < 10 && fmin(fabs(x[0]), fmin(fabs(x[1]), fabs(x[2]))) > 0.2;
}

double laws_conditioning(const iso_params *p)
{
    return 25 * laws_spread(p) * laws_rounding(p);
}

const iso_integral *laws_integral(const iso_system *system, const char *name)
{
    for (const iso_integral *i = system->integrals; i->name; i++)
        if (strcmp(i->name, name) == 0) return i;
    gsl_test(1, "%s has no integral %s", system->name, name);
    exit(gsl_test_summary());
}

double laws_max(int n, const double a[])
{
    double largest = 0;
    for (int i = 0; i < n; i++) {
        if (isnan(a[i])) return a[i]; /* which fmax would hide */
        largest = fmax(largest, fabs(a[i]));
    }
    return largest;
}

double laws_norm(const double a[3])
{
    return hypot(a[0], hypot(a[1], a[2]));
}

double laws_distance(const double a[3], const double b[3])
{
    const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return laws_norm(d);
}

double laws_spread(const iso_params *p)
{
    return max3(p->J) / min3(p->J);
}

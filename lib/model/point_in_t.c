/* point_in_t.c - the point of (24) on the level H = 0, in the ball's time t, where no power of q is left.
 *
 * On this level |M| = sqrt(2 eps) q^(-1/(2k)) is known, but spans hundreds of decades for small |k|. The state here
 * is
 *
 *     p = (k/sqrt(det J)) q^(1/(2k)) M = J^(1/2) omega,     q = (gamma, J gamma)                        by (18)
 *
 * has the length sqrt(2h) of the ball's energy h. With ds/dt = (k^2/det J) q^(1+1/(2k)), (24) becomes
 *
 *     p' = r [ p^2 c - (c,p) p ],     gamma' = k r q gamma x p,     c = gamma x J gamma,     r = 1/sqrt(det J)
 *
 * since q' = 2 (J gamma, gamma') = -2 k r q (c,p).
 */
#include <math.h>

#include "base/vec3_impl.h"
#include "model/model_impl.h"

/* NN of (18). Both directions compute it from gamma. From n in one direction and from gamma in the other, the two
 * would differ by a rounding error, and w would change by it at each round trip. */
static double momentum_factor(const iso_params *p, const double gamma[3])
{
    const double q = dot_diag(gamma, p->J, gamma) / dot(gamma, gamma);
    return sqrt(p->det_J) / p->k * pow(q, -1 / (2 * p->k));
}

void iso_point_to_point_in_t(const iso_params *p, const double point[ISO_STATE], double y[ISO_STATE])
{
    const double NN = momentum_factor(p, point + 3);
    for (int i = 0; i < 3; i++) {
        y[i] = point[i] / NN;
        y[3 + i] = point[3 + i];
    }
}

void iso_point_in_t_to_point(const iso_params *p, const double y[ISO_STATE], double point[ISO_STATE])
{
    const double NN = momentum_factor(p, y + 3);
    for (int i = 0; i < 3; i++) {
        point[i] = NN * y[i];
        point[3 + i] = y[3 + i];
    }
}

void iso_point_in_t_to_ball(const iso_params *p, const double y[ISO_STATE], double ball[ISO_STATE])
{
    for (int i = 0; i < 3; i++) {
        ball[i] = y[i] / p->root_J[i];
        ball[3 + i] = p->root_J[i] * y[3 + i];
    }
    make_unit(ball + 3);
}

static double point_q(const iso_params *p, const double y[ISO_STATE], double gradient[ISO_STATE])
{
    return iso_system_point.q(p, y, gradient);
}

/* A second statement, kept as in ball.c: `point_p` of series/recurrences_impl.h is the same at order 0. */
static void rhs(const iso_problem *f, const double y[ISO_STATE], double dy[ISO_STATE])
{
    const double *p = y, *gamma = y + 3, r = 1 / sqrt(f->p.det_J);
    double Jgamma[3], c[3];
    diag(f->p.J, gamma, Jgamma);
    cross(gamma, Jgamma, c);
    const double square = dot(p, p), along = dot(c, p);
    for (int i = 0; i < 3; i++) dy[i] = r * (square * c[i] - along * p[i]);
    cross(gamma, p, dy + 3);
    scale(dy + 3, f->p.k * r * dot(gamma, Jgamma));
}

/* The ball's, from eps = h det J/k^2 */
static double ball_energy(const iso_problem *f)
{
    return f->eps / f->p.det_J * (f->p.k * f->p.k);
}

/* H = G (p^2/2 - h) in units of G */
static double energy(const iso_problem *f, const double y[], double *size)
{
    const double T = dot(y, y) / 2, h = ball_energy(f);
    *size = T + h;
    return T - h;
}

static double speed(const iso_problem *f, const double y[])
{
    (void)f;
    return norm(y);
}

static double project(const iso_problem *f, double y[])
{
    const double length_error = make_unit(y + 3) - 1, size = norm(y);
    if (size == 0) return fabs(length_error);
    const double correction = fmax(fabs(length_error), fabs(remove_along(y, y + 3)) / size);
    const double stretch = sqrt(2 * ball_energy(f)) / norm(y);
    scale(y, stretch);
    return fmax(correction, fabs(stretch - 1));
}

static const char *const state_names[] = {"p1", "p2", "p3", "gamma1", "gamma2", "gamma3"};

static const iso_integral integrals[] = {
    {.name = "H", .doc = "p^2/2 - eps k^2/det J", .dimension = {1, 0, 2}, .value = energy}, {0}};

const iso_system iso_system_point_in_t = {
    .name = "point",
    .doc = "point on a sphere on the level H = 0, in the ball's time",
    .clock = ISO_CLOCK_T,
    .state = state_names,
    .integrals = integrals,
    .rhs = rhs,
    .q = point_q,
    .energy = energy,
    .project = project,
    .speed = speed,
};

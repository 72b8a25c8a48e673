/* Separation of variables: (lam, mu) at k = 1 and not at k = -1 (paper, after (21)); (u, v) of gamma in b = J at
 * k = -1 and in b = 1/J at k = 1 (lib/doc/theory.md, section 8). */
#include "laws.h"
#include "map/state.h"
#include "reduction.h"

static double A(const double b[3], double z)
{
    return (b[0] - z) * (b[1] - z) * (b[2] - z);
}

/* Staeckel's form of the ball's energy:
 * h (mu - lam) N^2 lam mu/(2 k^2) = -lam A(lam) p_lam^2 + mu A(mu) p_mu^2,
 * N^2 lam mu = det J (lam mu/det J)^(-1+1/k) */
static void staeckel(const laws_case *c, laws_worst *worst)
{
    if (!laws_regular(c)) return;
    const iso_params *p = &c->problem.p;
    iso_conical at;
    double momenta[2];
    reduction_coordinates(p, c->y, &at);
    reduction_momenta(p, &at, momenta);
    const double lam = at.z[0], mu = at.z[1], N = reduction_multiplier(p, &at);
    const double left = c->problem.energy * (mu - lam) * N * N * lam * mu / (2 * p->k * p->k);
    const double right = -lam * A(p->J, lam) * momenta[0] * momenta[0] + mu * A(p->J, mu) * momenta[1] * momenta[1];
    const double power = p->det_J * pow(lam * mu / p->det_J, -1 + 1 / p->k);
    laws_note(worst, fabs(left - right), laws_conditioning(p) * left, p, "energy");
    laws_note(worst, fabs(N * N * lam * mu / power - 1), laws_conditioning(p), p, "N");
}

/* At k = 1 N^2 lam mu = det J, and lam and mu part: z A(z) p_z^2 - h det J z/2 is the same for z = lam and z = mu,
 * and constant. */
static void ball_constants(const void *data, const double y[], double constant[])
{
    const iso_params *p = data;
    const double h = iso_ball_energy(p, y);
    iso_conical at;
    double momenta[2];
    reduction_coordinates(p, y, &at);
    reduction_momenta(p, &at, momenta);
    for (int r = 0; r < 2; r++) {
        const double z = at.z[r];
        constant[r] = z * A(p->J, z) * momenta[r] * momenta[r] - h * p->det_J * z / 2;
    }
}

/* Drift of two constants along the flow, and what they differ by, relative to `size`. The step is that of
 * test_reduction.c: 1/1024 of the way on which the state changes. */
static void note_constants(const laws_case *c, laws_function *constants, const void *data, double size, bool agree,
                           double allowed, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    double dy[ISO_STATE], value[2], slope[2];
    c->system->rhs(&c->problem, c->y, dy);
    const double h = laws_step(c, dy) / 8, time = 1024 * h / laws_reach(p);
    constants(data, c->y, value);
    laws_slope_flow(constants, data, 2, c, h, slope);
    for (int r = 0; r < 2; r++)
        laws_note(worst, fabs(slope[r]) * time, allowed * size, p, r == 0 ? "drift 1" : "drift 2");
    if (agree) laws_note(worst, fabs(value[0] - value[1]), laws_conditioning(p) * size, p, "agree");
}

static double rounding_of_drift(const iso_params *p)
{
    return 1024 / laws_reach(p) * laws_conditioning(p);
}

static double ball_size(const laws_case *c)
{
    return c->problem.energy * c->problem.p.det_J * max3(c->problem.p.J) / 2;
}

static void ball_separates(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    if (p->k == 1 && laws_regular(c))
        note_constants(c, ball_constants, p, ball_size(c), true, rounding_of_drift(p), worst);
}

static void ball_does_not(const laws_case *c, laws_worst *worst)
{
    if (c->problem.p.k == -1 && laws_regular(c))
        note_constants(c, ball_constants, &c->problem.p, ball_size(c), false, 0.1, worst);
}

/* The point's coordinates and what separates in them */
typedef struct separated {
    const iso_problem *f;
    double b[3];
    bool plane; /* k = 1 and b = 1/J, else k = -1 and b = J */
} separated;

static double R(const separated *s, double z)
{
    const double *b = s->b, eps = s->f->eps;
    return s->plane ? -eps * b[0] * b[1] * b[2] / z : eps * z * (b[0] + b[1] + b[2] - z);
}

/* c of 2 A(z) p_z^2 = R(z) + c, from u_s^2 (v - u)^2/(8 A(u)) - R(u), and from v */
static void point_constants(const void *data, const double y[], double constant[])
{
    const separated *s = data;
    iso_conical at;
    double velocity[3];
    cross(y + 3, y, velocity);
    iso_conical_from_vector(s->b, y + 3, velocity, &at);
    const double gap = at.z[1] - at.z[0];
    for (int r = 0; r < 2; r++)
        constant[r] = at.rate[r] * at.rate[r] * gap * gap / (8 * A(s->b, at.z[r])) - R(s, at.z[r]);
}

static separated separate(const laws_case *c, bool plane)
{
    separated s = {.f = &c->problem, .plane = plane};
    copy(plane ? c->problem.p.inv_J : c->problem.p.J, s.b, 3);
    return s;
}

static double point_size(const separated *s)
{
    return fabs(R(s, min3(s->b))) + fabs(R(s, max3(s->b)));
}

static void point_separates(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    if (fabs(p->k) != 1 || !laws_regular(c)) return;
    const separated s = separate(c, p->k == 1);
    note_constants(c, point_constants, &s, point_size(&s), true, rounding_of_drift(p), worst);
}

/* b = J where 1/J belongs and the other way round */
static void point_in_the_wrong_b(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    if (fabs(p->k) != 1 || !laws_regular(c)) return;
    const separated s = separate(c, p->k == -1);
    note_constants(c, point_constants, &s, point_size(&s), false, 0.1, worst);
}

/* At k = -1 the constant is F (11): c = -det J F/2. */
static void point_constant_is_f(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    if (p->k != -1 || !laws_regular(c)) return;
    const separated s = separate(c, false);
    double constant[2], ball[ISO_STATE], size;
    point_constants(&s, c->y, constant);
    iso_point_to_ball(p, c->y, ball);
    const double F = laws_integral(&iso_system_ball, "F_shell")->value(&c->problem, ball, &size);
    laws_note(worst, fabs(constant[0] + p->det_J * F / 2), laws_conditioning(p) * point_size(&s), p, "");
}

int main(void)
{
    laws_hold("Staeckel's form of the energy", &iso_system_ball, staeckel);
    laws_hold("lam and mu separate at k = 1", &iso_system_ball, ball_separates);
    laws_fail("lam and mu do not separate at k = -1", &iso_system_ball, ball_does_not);
    laws_hold("u and v separate at k = 1 and -1", &iso_system_point, point_separates);
    laws_fail("u and v of the other b do not", &iso_system_point, point_in_the_wrong_b);
    laws_hold("at k = -1 their constant is F (11)", &iso_system_point, point_constant_is_f);
    exit(gsl_test_summary());
}

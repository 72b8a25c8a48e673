/* The isomorphism (18)-(24): states, energies, clocks, integrals, and the flow of one system carried to the other. */
#include "laws.h"
#include "map/state.h"
#include "poisson.h"

/* NN, rho of (18), from n */
static double written_factor(const iso_params *p, const double n[3], double *rho)
{
    const double g = dot_diag(n, p->inv_J, n);
    *rho = sqrt(g);
    return sqrt(p->det_J) / p->k * pow(g, 1 / (2 * p->k));
}

/* (18) as it is written, and its inverse */
static void formulas(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    double rho, point[ISO_STATE], ball[ISO_STATE];
    const double NN = written_factor(p, c->y + 3, &rho);
    iso_ball_to_point(p, c->y, point);
    const double g = 1 / dot_diag(point + 3, p->J, point + 3);
    const double back = p->k / sqrt(p->det_J) * pow(g, -1 / (2 * p->k));
    iso_point_to_ball(p, point, ball);
    for (int i = 0; i < 3; i++) {
        const double M = NN * sqrt(p->J[i]) * c->y[i], gamma = c->y[3 + i] / (sqrt(p->J[i]) * rho);
        const double w = point[i] * back / sqrt(p->J[i]), n = sqrt(p->J[i]) * point[3 + i] * sqrt(g);
        laws_note(worst, fabs(point[i] - M), laws_rounding(p) * fabs(M), p, "M");
        laws_note(worst, fabs(point[3 + i] - gamma), 4 * DBL_EPSILON * fabs(gamma), p, "gamma");
        laws_note(worst, fabs(ball[i] - w), laws_rounding(p) * fabs(w), p, "w");
        laws_note(worst, fabs(ball[3 + i] - n), 4 * DBL_EPSILON * fabs(n), p, "n");
    }
}

/* (19): unit vector, orthogonality as good as the ball's, q = 1/g; M along w for k > 0, against it for k < 0 */
static void constraints(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    double rho, point[ISO_STATE], terms = 0;
    const double NN = written_factor(p, c->y + 3, &rho);
    iso_ball_to_point(p, c->y, point);
    for (int i = 0; i < 3; i++) terms += fabs(point[i] * point[3 + i]);
    laws_note(worst, fabs(norm(point + 3) - 1), 2 * DBL_EPSILON, p, "|gamma|");
    laws_note(worst, fabs(dot(point, point + 3) - NN / rho * dot(c->y, c->y + 3)), 6 * DBL_EPSILON * terms, p,
              "(M,gamma)");
    laws_note(worst, fabs(dot_diag(point + 3, p->J, point + 3) * rho * rho - 1), 6 * DBL_EPSILON, p, "q");
    laws_note(worst, dot(point, c->y) * p->k > 0 ? 0 : 1, 0.5, p, "sign of M");
}

/* Of n only the direction counts (4 n: bit for bit), and the result may overwrite the state. */
static void length_and_aliasing(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    double point[ISO_STATE], ball[ISO_STATE], y[ISO_STATE];
    copy(c->y, y, ISO_STATE);
    scale(y + 3, 4);
    iso_ball_to_point(p, c->y, point);
    iso_ball_to_point(p, y, y);
    laws_note(worst, memcmp(y, point, sizeof y) == 0 ? 0 : 1, 0.5, p, "to point");
    iso_point_to_ball(p, point, ball);
    iso_point_to_ball(p, y, y);
    laws_note(worst, memcmp(y, ball, sizeof y) == 0 ? 0 : 1, 0.5, p, "to ball");
}

static void energies(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    double point[ISO_STATE];
    const double h = dot_diag(c->y, p->J, c->y) / 2, eps = h * p->det_J / (p->k * p->k);
    iso_ball_to_point(p, c->y, point);
    laws_note(worst, fabs(iso_ball_energy(p, c->y) / h - 1), 2 * DBL_EPSILON, p, "h");
    laws_note(worst, fabs(iso_coupling(p, h) / eps - 1), 4 * DBL_EPSILON, p, "eps");
    laws_note(worst, fabs(iso_energy(p, eps) / h - 1), 4 * DBL_EPSILON, p, "h of eps");
    laws_note(worst, fabs(iso_energy(p, iso_coupling(p, h)) / h - 1), 4 * DBL_EPSILON, p, "h back");
    laws_note(worst, fabs(poisson_hamiltonian(p, point, NULL) / h - 1), 2 * laws_rounding(p), p, "H (21)");
}

/* The mapped point lives on the level H = 0, and has the ball's integrals (claimed or not: the axis ones agree as
 * functions of the state; F_plane at k = 1, F_shell at k = -1). */
static void integrals(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    iso_problem f = {.p = *p, .eps = iso_coupling(p, iso_ball_energy(p, c->y))};
    double point[ISO_STATE], size, point_size;
    iso_ball_to_point(p, c->y, point);
    for (const iso_integral *i = iso_system_ball.integrals; i->name; i++)
        for (const iso_integral *j = iso_system_point.integrals; j->name; j++) {
            if (strcmp(i->name, j->name) != 0) continue;
            if (strncmp(i->name, "F_axis", 6) != 0 && !i->holds(&c->problem)) continue;
            const double I = i->value(&c->problem, c->y, &size), twin = j->value(&f, point, &point_size);
            laws_note(worst, fabs(I - twin), 2 * laws_rounding(p) * (fabs(I) + point_size), p, i->name);
        }
    const double H = iso_system_point.energy(&f, point, &size);
    laws_note(worst, fabs(H), 2 * laws_rounding(p) * size, p, "H = 0");
}

static void map_to_point(const void *data, const double y[], double point[])
{
    iso_ball_to_point(data, y, point);
}

static void map_to_ball(const void *data, const double y[], double ball[])
{
    iso_point_to_ball(data, y, ball);
}

/* ds/dt = (k^2/det J) q^(1 + 1/(2k)) (24) */
static double written_ds_dt(const iso_params *p, double q)
{
    return p->k * p->k / p->det_J * pow(q, 1 + 1 / (2 * p->k));
}

static void note_vectors(const double a[ISO_STATE], const double b[ISO_STATE], const double size[2], double allowed,
                         const iso_params *p, laws_worst *worst)
{
    for (int v = 0; v < 2; v++)
        laws_note(worst, laws_distance(a + 3 * v, b + 3 * v), allowed * size[v], p, v == 0 ? "fast" : "unit");
}

/* The flow (9) carried over by (18) is the flow (24), in the clock s. */
static void pushed_forward(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    const iso_problem f = {.p = *p, .eps = iso_coupling(p, c->problem.energy)};
    double dy[ISO_STATE], point[ISO_STATE], carried[ISO_STATE], expected[ISO_STATE];
    iso_ball_to_point(p, c->y, point);
    c->system->rhs(&c->problem, c->y, dy);
    const double h = laws_step(c, dy);
    laws_slope(map_to_point, p, ISO_STATE, ISO_STATE, c->y, dy, h, carried);
    iso_system_point.rhs(&f, point, expected);
    const double rate = written_ds_dt(p, iso_system_point.q(p, point, NULL));
    for (int i = 0; i < ISO_STATE; i++) expected[i] *= rate;
    const double size[2] = {norm(point), 1};
    note_vectors(carried, expected, size, laws_rounding(p) / h, p, worst);
}

/* ... and back: (24) carried over by the inverse is (9). */
static void pulled_back(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    const iso_problem f = {.p = *p};
    double dy[ISO_STATE], ball[ISO_STATE], carried[ISO_STATE], expected[ISO_STATE];
    iso_point_to_ball(p, c->y, ball);
    c->system->rhs(&c->problem, c->y, dy);
    const double h = laws_step(c, dy), rate = written_ds_dt(p, iso_system_ball.q(p, ball, NULL));
    laws_slope(map_to_ball, p, ISO_STATE, ISO_STATE, c->y, dy, h, carried);
    iso_system_ball.rhs(&f, ball, expected);
    for (int i = 0; i < ISO_STATE; i++) expected[i] /= rate;
    const double size[2] = {norm(ball), 1};
    note_vectors(carried, expected, size, laws_rounding(p) / h, p, worst);
}

/* dy/dtau of (20)-(21) is dy/ds of (24) times ds/dtau = G, on H = h. */
static void hamiltonian_form(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    const iso_problem f = {.p = *p, .eps = iso_coupling(p, c->problem.energy)};
    double point[ISO_STATE], dtau[ISO_STATE], ds[ISO_STATE];
    iso_ball_to_point(p, c->y, point);
    poisson_hamiltonian_rhs(p, point, dtau);
    iso_system_point.rhs(&f, point, ds);
    const double q = iso_system_point.q(p, point, NULL), G = p->k * p->k / p->det_J * pow(q, 1 / p->k);
    for (int i = 0; i < ISO_STATE; i++) ds[i] *= G;
    const double turn = G * norm(point), spread = sqrt(laws_spread(p));
    const double size[2] = {turn * norm(point) * (1 + spread / fabs(p->k)), turn};
    note_vectors(dtau, ds, size, laws_rounding(p), p, worst);
}

/* t: 1, tau: N (16), s: G N; exponent = d log rate/d log q. Also at k = -1/2, where the exponent of s is 0. */
static void clock_rates(const laws_case *c, laws_worst *worst)
{
    iso_params p = c->problem.p;
    const double q = c->system->q(&p, c->y, NULL);
    for (int half = 0; half < 2; half++, p.k = -0.5) {
        const double N = pow(q, 1 - 1 / (2 * p.k)), G = p.k * p.k / p.det_J * pow(q, 1 / p.k);
        const double rate[ISO_CLOCKS] = {1, N, G * N};
        for (iso_clock i = 0; i < ISO_CLOCKS; i++) {
            double e;
            const double r = iso_clock_rate(&p, i, q, &e);
            laws_note(worst, fabs(r / rate[i] - 1), laws_rounding(&p), &p, iso_clock_name(i));
            const double grown = iso_clock_rate(&p, i, 2 * q, NULL) / r;
            laws_note(worst, fabs(log2(grown) - e), 4 * laws_rounding(&p), &p, "exponent");
            laws_note(worst, fabs(iso_clock_rate(&p, i, q, NULL) - r), DBL_TRUE_MIN, &p, "without exponent");
        }
    }
}

int main(void)
{
    laws_hold("(18) and its inverse", &iso_system_ball, formulas);
    laws_hold("constraints (19) and the sign of M", &iso_system_ball, constraints);
    laws_hold("only the direction of n counts; in place", &iso_system_ball, length_and_aliasing);
    laws_hold("energies and coupling", &iso_system_ball, energies);
    laws_hold("integrals agree with the mapped point's", &iso_system_ball, integrals);
    laws_hold("(9) carried over is (24)", &iso_system_ball, pushed_forward);
    laws_hold("(24) carried back is (9)", &iso_system_point, pulled_back);
    laws_hold("(21) in tau is (24) in s", &iso_system_ball, hamiltonian_form);
    laws_hold("clock rates", NULL, clock_rates);
    exit(gsl_test_summary());
}

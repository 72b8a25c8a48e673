/* Sphero-conical coordinates (12)-(13) and the ball in them: (14)-(17), the second form of (21). */
#include "laws.h"
#include "map/state.h"
#include "reduction.h"

/* A(z) = (J1 - z)(J2 - z)(J3 - z) */
static double A(const iso_params *p, double z)
{
    return (p->J[0] - z) * (p->J[1] - z) * (p->J[2] - z);
}

/* T (14) as written, = h; S (15); N (16) = the rate of tau */
static void as_written(const laws_case *c, laws_worst *worst)
{
    if (!laws_regular(c)) return;
    const iso_params *p = &c->problem.p;
    const double k = p->k;
    iso_conical at;
    reduction_coordinates(p, c->y, &at);
    const double lam = at.z[0], mu = at.z[1], dlam = at.rate[0], dmu = at.rate[1];
    const double T = (mu - lam) / (8 * k * k) * (-mu * dlam * dlam / A(p, lam) + lam * dmu * dmu / A(p, mu));
    const double S = (2 * k - 1) / (8 * k * k * k) * (lam - mu) * (dlam / A(p, lam) + dmu / A(p, mu));
    const double size =
        (fabs(dlam / A(p, lam)) + fabs(dmu / A(p, mu))) * (mu - lam) / (8 * k * k) * (1 + 2 / fabs(k));
    const double N = iso_clock_rate(p, ISO_CLOCK_TAU, iso_system_ball.q(p, c->y, NULL), NULL);
    const double h = iso_ball_energy(p, c->y);
    laws_note(worst, fabs(T - h), laws_conditioning(p) * h, p, "T (14)");
    laws_note(worst, fabs(reduction_energy(p, &at) - h), laws_conditioning(p) * h, p, "T");
    laws_note(worst, fabs(reduction_force(p, &at) - S), laws_conditioning(p) * size, p, "S (15)");
    laws_note(worst, fabs(reduction_multiplier(p, &at) / N - 1), laws_conditioning(p), p, "N (16)");
}

/* lam' and mu' are the derivatives of lam and mu along the flow. */
static void coordinates_of(const void *data, const double y[], double z[])
{
    iso_conical at;
    reduction_coordinates(data, y, &at);
    copy(at.z, z, 2);
}

static void rates(const laws_case *c, laws_worst *worst)
{
    if (!laws_regular(c)) return;
    const iso_params *p = &c->problem.p;
    double dy[ISO_STATE], slope[2];
    iso_conical at;
    reduction_coordinates(p, c->y, &at);
    c->system->rhs(&c->problem, c->y, dy);
    /* lam and mu change on a way of the order of n_i and of the distance of the moments: a shorter step */
    const double h = laws_step(c, dy) / 8;
    laws_slope_flow(coordinates_of, p, 2, c, h, slope);
    for (int r = 0; r < 2; r++)
        laws_note(worst, fabs(slope[r] - at.rate[r]), laws_conditioning(p) / h, p, r == 0 ? "lam'" : "mu'");
}

/* A Lagrangian or Hamiltonian on the coordinates */
typedef double on_coordinates(const iso_params *p, const iso_conical *at, const double momenta[2]);

static double T_of(const iso_params *p, const iso_conical *at, const double unused[2])
{
    (void)unused;
    return reduction_energy(p, at);
}

typedef struct partial {
    on_coordinates *f;
    const iso_params *p;
    const iso_conical *at;
    const double *momenta;
    int r;
} partial;

static void shifted(const void *data, const double by[], double value[])
{
    const partial *d = data;
    iso_conical to = *d->at;
    to.z[d->r] += by[0];
    for (int i = 0; i < 3; i++) to.above[d->r][i] += by[0];
    value[0] = d->f(d->p, &to, d->momenta);
}

/* d/dlam (r = 0) or d/dmu (r = 1) with everything else kept; the nearest singularity of T and H is a J_i, 0 or the
 * other coordinate. */
static double partial_derivative(on_coordinates *f, const iso_params *p, const iso_conical *at,
                                 const double momenta[2], int r)
{
    const double zero = 0, one = 1;
    double nearest = fmin(at->z[0], at->z[1] - at->z[0]), slope;
    for (int i = 0; i < 3; i++) nearest = fmin(nearest, fabs(at->above[r][i]));
    const partial d = {f, p, at, momenta, r};
    laws_slope(shifted, &d, 1, 1, &zero, &one, nearest * laws_reach(p) / 128, &slope);
    return slope;
}

/* dT/dlam', dT/dmu': T is quadratic in the rates, so a difference of any step is exact. */
static void dT_drate(const void *data, const double y[], double momenta[])
{
    const iso_params *p = data;
    iso_conical at;
    reduction_coordinates(p, y, &at);
    for (int r = 0; r < 2; r++) {
        iso_conical up = at, down = at;
        up.rate[r] = 2 * at.rate[r], down.rate[r] = 0;
        momenta[r] = (reduction_energy(p, &up) - reduction_energy(p, &down)) / (2 * at.rate[r]);
    }
}

/* Residuals of (15), relative to their terms: with S, or without */
static void note_motion(const laws_case *c, double with_S, double allowed, laws_worst *worst)
{
    if (!laws_regular(c)) return;
    const iso_params *p = &c->problem.p;
    double dy[ISO_STATE], slope[2];
    iso_conical at;
    reduction_coordinates(p, c->y, &at);
    c->system->rhs(&c->problem, c->y, dy);
    laws_slope_flow(dT_drate, p, 2, c, laws_step(c, dy) / 8, slope);
    const double S = reduction_force(p, &at), force[2] = {at.rate[1] * S, -at.rate[0] * S};
    for (int r = 0; r < 2; r++) {
        const double dT = partial_derivative(T_of, p, &at, NULL, r);
        laws_note(worst, fabs(slope[r] - dT - with_S * force[r]), allowed * (fabs(dT) + fabs(slope[r])), p,
                  r == 0 ? "lam" : "mu");
    }
}

/* (15). The step is laws_step()/8, 1/1024 of the way on which the state changes: rounding times 1024/reach. */
static void equations_of_motion(const laws_case *c, laws_worst *worst)
{
    note_motion(c, 1, 1024 / laws_reach(&c->problem.p) * laws_conditioning(&c->problem.p), worst);
}

static void no_force_at_one(const laws_case *c, laws_worst *worst)
{
    if (c->problem.p.k == 1) note_motion(c, 0, 0.1, worst);
}

static void momenta_of(const void *data, const double y[], double momenta[])
{
    iso_conical at;
    reduction_coordinates(data, y, &at);
    reduction_momenta(data, &at, momenta);
}

/* (17): dlam/dtau = dH/dp, dp/dtau = -dH/dlam, H = T; p = N dT/dlam' */
static void canonical(const laws_case *c, laws_worst *worst)
{
    if (!laws_regular(c)) return;
    const iso_params *p = &c->problem.p;
    double dy[ISO_STATE], momenta[2], slope[2], T_rate[2];
    iso_conical at;
    reduction_coordinates(p, c->y, &at);
    reduction_momenta(p, &at, momenta);
    dT_drate(p, c->y, T_rate);
    c->system->rhs(&c->problem, c->y, dy);
    laws_slope_flow(momenta_of, p, 2, c, laws_step(c, dy) / 8, slope);
    const double N = reduction_multiplier(p, &at), H = reduction_hamiltonian(p, &at, momenta);
    laws_note(worst, fabs(H / iso_ball_energy(p, c->y) - 1), laws_conditioning(p), p, "H = T");
    for (int r = 0; r < 2; r++) {
        double up[2] = {momenta[0], momenta[1]};
        up[r] += momenta[r]; /* H is quadratic in p: dH/dp = (H(p + p) - H(p - p))/(2 p), exactly */
        double down[2] = {momenta[0], momenta[1]};
        down[r] = 0;
        const double dp =
            (reduction_hamiltonian(p, &at, up) - reduction_hamiltonian(p, &at, down)) / (2 * momenta[r]);
        const double size = H / fabs(momenta[r]) + fabs(dp);
        const double dz = partial_derivative(reduction_hamiltonian, p, &at, momenta, r);
        laws_note(worst, fabs(momenta[r] / N - T_rate[r]),
                  laws_conditioning(p) * (fabs(T_rate[r]) + reduction_energy(p, &at) / fabs(at.rate[r])), p, "p");
        laws_note(worst, fabs(at.rate[r] / N - dp), laws_conditioning(p) * size, p, "dH/dp");
        laws_note(worst, fabs(slope[r] / N + dz),
                  1024 / laws_reach(p) * laws_conditioning(p) * (fabs(dz) + fabs(slope[r] / N)), p, "dp/dtau");
    }
}

/* H = (2 k^2/(lam - mu)) (lam mu/det J)^((2k-1)/k) (A(lam) p_lam^2/mu - A(mu) p_mu^2/lam), the second form of (21) */
static void second_form(const laws_case *c, laws_worst *worst)
{
    if (!laws_regular(c)) return;
    const iso_params *p = &c->problem.p;
    double momenta[2];
    iso_conical at;
    reduction_coordinates(p, c->y, &at);
    reduction_momenta(p, &at, momenta);
    const double lam = at.z[0], mu = at.z[1], k = p->k;
    const double H = 2 * k * k / (lam - mu) * pow(lam * mu / p->det_J, (2 * k - 1) / k) *
                     (A(p, lam) * momenta[0] * momenta[0] / mu - A(p, mu) * momenta[1] * momenta[1] / lam);
    laws_note(worst, fabs(H / iso_ball_energy(p, c->y) - 1), laws_conditioning(p), p, "");
}

/* T = h also next to the coordinate planes, where A(lam) or A(mu) -> 0 and the rates with it: n_axis = 1e-1 ...
 * 1e-13, three moments well apart. Rates taken from b2 alone would lose 1e-16/n_axis of their size at the outer
 * planes. */
static void near_planes(void)
{
    const double J[3] = {3, 1.4, 2.1};
    const iso_params p = laws_params(0.75, J);
    double worst = 0;
    for (int axis = 0; axis < 3; axis++)
        for (double near = 0.1; near > 1e-13; near /= 10) {
            double y[ISO_STATE] = {0.3, -0.7, 0.5, 0.6, 0.6, 0.6};
            iso_conical at;
            y[3 + axis] = near;
            make_unit(y + 3);
            for (int pass = 0; pass < 2; pass++) remove_along(y, y + 3);
            reduction_coordinates(&p, y, &at);
            worst = fmax(worst, fabs(reduction_energy(&p, &at) / iso_ball_energy(&p, y) - 1));
        }
    gsl_test(!(worst < 1e-13), "T next to the coordinate planes is h (%.1e)", worst);
}

int main(void)
{
    near_planes();
    laws_hold("T (14) = h, S (15), N (16)", &iso_system_ball, as_written);
    laws_hold("rates of lam and mu", &iso_system_ball, rates);
    laws_hold("equations of motion (15)", &iso_system_ball, equations_of_motion);
    laws_fail("(15) without S at k = 1", &iso_system_ball, no_force_at_one);
    laws_hold("canonical equations (17) in tau", &iso_system_ball, canonical);
    laws_hold("second form of (21)", &iso_system_ball, second_form);
    exit(gsl_test_summary());
}

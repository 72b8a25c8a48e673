/* Balls in potentials that sphero-conical coordinates separate, written as expressions: each has the second integral
 * of section 8 of lib/doc/theory.md at k = 1 and k = -1, and not at k beside. */
#include "laws.h"
#include "orbit/orbit_impl.h"

static iso_context *ctx;

/* --- potentials ------------------------------------------------------------------------------------------------- */

/* What they are made of, at n: g, gamma_i^2, b, s = u + v, p = u v. */
typedef struct place {
    double g, square[3], b[3], s, p;
} place;

static place place_at(const iso_params *ball, bool shell, const double n[3])
{
    place at = {.g = dot_diag(n, ball->inv_J, n)};
    double product = 1;
    for (int i = 0; i < 3; i++) {
        at.square[i] = n[i] * n[i] * ball->inv_J[i] / at.g;
        at.b[i] = shell ? ball->J[i] : ball->inv_J[i];
        product *= at.b[i];
    }
    for (int i = 0; i < 3; i++) {
        at.s += at.b[i] * (1 - at.square[i]);
        at.p += product / at.b[i] * at.square[i];
    }
    return at;
}

static const double rosochatius[3] = {0.02, 0.05, 0.03};

/* V and W of the table. */
enum { QUARTIC, INVERSE, ROSOCHATIUS, FAMILIES };

static void V_and_W(int family, const place *at, double *V, double *W)
{
    *V = family == QUARTIC ? 0.3 * (at->s * at->s - at->p) : family == INVERSE ? 2 / at->p : 0;
    *W = family == QUARTIC ? 0.3 * 2 * at->p * at->s : family == INVERSE ? 2 * 2 * at->s / at->p : 0;
    for (int i = 0; i < 3 && family == ROSOCHATIUS; i++) {
        *V += rosochatius[i] / at->square[i];
        *W += 2 * rosochatius[i] * (at->s - at->b[i]) / at->square[i];
    }
}

/* The same potentials as a scene writes them, U in n. */
static const struct {
    const char *name, *shell, *plane;
} families[FAMILIES] = {
    {"quartic",
     "0.3*((J1+J2+J3 - 1/(n1^2/J1+n2^2/J2+n3^2/J3))^2*(n1^2/J1+n2^2/J2+n3^2/J3)/(J1*J2*J3)"
     " - ((n1/J1)^2+(n2/J2)^2+(n3/J3)^2))",
     "0.3*((1/J1+1/J2+1/J3 - ((n1/J1)^2+(n2/J2)^2+(n3/J3)^2)/(n1^2/J1+n2^2/J2+n3^2/J3))^2"
     " - 1/(J1*J2*J3*(n1^2/J1+n2^2/J2+n3^2/J3)))/(J1*J2*J3*(n1^2/J1+n2^2/J2+n3^2/J3))"},
    {"inverse", "2*(n1^2/J1+n2^2/J2+n3^2/J3)^2/((J1*J2*J3)^2*((n1/J1)^2+(n2/J2)^2+(n3/J3)^2))", NULL},
    {"Rosochatius", "(n1^2/J1+n2^2/J2+n3^2/J3)^2/(J1*J2*J3)*(0.02*J1/n1^2 + 0.05*J2/n2^2 + 0.03*J3/n3^2)",
     "(0.02*J1/n1^2 + 0.05*J2/n2^2 + 0.03*J3/n3^2)/(J1*J2*J3)"},
};

/* --- orbits ----------------------------------------------------------------------------------------------------- */

/* F at a state of the ball, and the size of its terms. */
static double F_of(const iso_params *ball, bool shell, int family, const double y[ISO_STATE], double *size)
{
    const place at = place_at(ball, shell, y + 3);
    const double det = ball->det_J;
    double V, W;
    V_and_W(family, &at, &V, &W);
    const double U = shell ? V * at.g / det : V / (at.g * det);
    const double eps = det * (dot_diag(y, ball->J, y) / 2 + U);
    double Jw[3];
    diag(ball->J, y, Jw);
    const double moving = shell ? det * dot(Jw, Jw) / at.g : det * at.g * dot(y, y);
    const double still = shell ? 2 * eps * at.p : -2 * eps * at.g * at.s;
    *size = moving + fabs(still) + fabs(W);
    return moving + still + W;
}

/* The largest change of F up to t = 20, by its size. */
static double drift_of(const iso_params *ball, bool shell, int family, iso_random *random)
{
    iso_orbit_options o;
    iso_effects effects = iso_effects_default();
    iso_start start;
    iso_orbit *orbit;
    double omega[3], n[3], most = 0, first = 0, size;
    iso_random_direction(random, n);
    for (int i = 0; i < 3; i++) omega[i] = iso_random_normal(random);
    laws_stop_if(ctx, iso_start_ball(ctx, omega, n, ISO_SPIN_REMOVE, &start) != ISO_OK, "a start");
    laws_stop_if(ctx,
                 iso_effects_write(ctx, &effects, "potential", "U",
                                   shell ? families[family].shell : families[family].plane) != ISO_OK,
                 families[family].name);
    o = iso_orbit_defaults(&start);
    o.tolerance = 1e-14;
    o.effects = &effects;
    laws_stop_if(ctx, iso_orbit_create(ctx, ball, &start, &o, &orbit) != ISO_OK, families[family].name);
    for (int t = 0; t <= 20; t++) {
        iso_sample s;
        laws_stop_if(ctx, iso_orbit_at(orbit, t, &s) != ISO_OK, families[family].name);
        const double F = F_of(ball, shell, family, s.ball, &size);
        if (t == 0) first = F;
        most = fmax(most, fabs(F - first) / size);
    }
    iso_orbit_free(orbit);
    return most;
}

static void check_family(bool shell, int family, iso_random *random)
{
    const double k = shell ? -1 : 1;
    double kept = 0, least = INFINITY;
    for (int i = 0; i < 10; i++) {
        double J[3];
        for (int j = 0; j < 3; j++) J[j] = iso_random_uniform(random, 1, 3);
        const iso_params ball = laws_params(k, J), other = laws_params(1.1 * k, J);
        kept = fmax(kept, drift_of(&ball, shell, family, random));
        least = fmin(least, drift_of(&other, shell, family, random));
    }
    gsl_test(!(kept < 1e-11), "%s, k = %g: F is conserved, to %.2g", families[family].name, k, kept);
    gsl_test(!(least > 1e-6), "%s, k = %g: it is not, %.2g at least", families[family].name, 1.1 * k, least);
}

int main(void)
{
    ctx = iso_context_create();
    iso_random *random = iso_random_create(5);
    for (int family = 0; family < FAMILIES; family++) {
        check_family(true, family, random);
        if (families[family].plane) check_family(false, family, random);
    }
    iso_random_free(random);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

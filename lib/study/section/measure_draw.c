/* measure_draw.c - states of a ball distributed by g^power dn dtheta, and exact means (measure_impl.h). */
#include <math.h>

#include "base/low_discrepancy_impl.h"
#include "base/pi_impl.h"
#include "base/vec3_impl.h"
#include "study/section/measure_impl.h"

/* a dphi/du: a = lam^power/(cos^2 phi + m3 sin^2 phi)^(1/2). lam is divided by one of its ends, so that no power
 * overflows. */
static double density_a(const measure_draw *d, double sin2, double cos2)
{
    const double lam = (d->J[0] * cos2 + d->J[1] * sin2) / (d->power < 0 ? d->J[0] : d->J[1]);
    return pow(lam, d->power) * sqrt(sin2 * cos2 / (cos2 + d->m3 * sin2));
}

/* b dpsi/du: b = mu^power/(sin^2 psi + m1 cos^2 psi)^(1/2) */
static double density_b(const measure_draw *d, double sin2, double cos2)
{
    const double mu = (d->J[1] * cos2 + d->J[2] * sin2) / (d->power < 0 ? d->J[1] : d->J[2]);
    return pow(mu, d->power) * sqrt(sin2 * cos2 / (sin2 + d->m1 * cos2));
}

static void density_phi(const void *data, double sin2, double cos2, double value[2])
{
    const measure_draw *d = data;
    value[0] = density_a(d, sin2, cos2) * (d->second[0] * cos2 + d->second[1]);
    value[1] = 0;
}

static void density_psi(const void *data, double sin2, double cos2, double value[2])
{
    const measure_draw *d = data;
    value[1] = density_b(d, sin2, cos2);
    value[0] = d->m3 * sin2 * value[1];
}

void iso_measure_draw_prepare(measure_draw *d, const iso_params *p, double power)
{
    double nothing[ISO_QUARTER_STEPS + 1];
    d->power = power;
    sort_by(p->J, d->axis);
    for (int i = 0; i < 3; i++) {
        d->J[i] = p->J[d->axis[i]];
        d->root[i] = p->root_J[d->axis[i]];
    }
    const double range = d->J[2] - d->J[0];
    d->m1 = range > 0 ? (d->J[1] - d->J[0]) / range : 0.5;
    d->m3 = range > 0 ? (d->J[2] - d->J[1]) / range : 0.5;
    iso_quarter_tabulate(density_psi, d, (double *[2]){d->psi[0], d->psi[1]});
    d->second[0] = d->m1 * d->psi[1][ISO_QUARTER_STEPS];
    d->second[1] = d->psi[0][ISO_QUARTER_STEPS];
    iso_quarter_tabulate(density_phi, d, (double *[2]){d->phi, nothing});
}

/* v = cos theta e1 + sin theta gamma x e1, e1 normal to gamma = J^(-1/2) n/|..| and to an axis */
static void direction(const measure_draw *d, const double n[3], double theta, double v[3])
{
    double gamma[3], e2[3], e1[3];
    for (int i = 0; i < 3; i++) gamma[i] = n[i] / d->root[i];
    make_unit(gamma);
    const double across = hypot(gamma[0], gamma[1]);
    e1[0] = across > 0 ? -gamma[1] / across : 1;
    e1[1] = across > 0 ? gamma[0] / across : 0;
    e1[2] = 0;
    cross(gamma, e1, e2);
    for (int i = 0; i < 3; i++) v[i] = cos(theta) * e1[i] + sin(theta) * e2[i];
}

/* 2^64/r, 2^64/r^2, 2^64/r^3, r^4 = r + 1, to the nearest integers */
static const uint64_t steps[3] = {0xd1b54a32d192ed04, 0xabc98388fb8fac03, 0x8cb92ba72f3d8dd7};

void iso_measure_draw_state(const measure_draw *d, const uint64_t shift[3], uint64_t i, double n[3], double v[3])
{
    const iso_quarter by_phi = {density_phi, d, {d->phi, d->phi}, 0};
    const double phi = iso_quarter_angle(&by_phi, iso_recurrence(shift[0], steps[0], i));
    const double sin_phi = sin(phi), cos_phi = cos(phi);
    const iso_quarter by_psi = {density_psi, d, {d->psi[0], d->psi[1]}, d->m1 * cos_phi * cos_phi};
    const double psi = iso_quarter_angle(&by_psi, iso_recurrence(shift[1], steps[1], i));
    const double sin_psi = sin(psi), cos_psi = cos(psi), theta = 2 * ISO_PI * iso_recurrence(shift[2], steps[2], i);
    double sorted[3] = {sin_phi * sqrt(sin_psi * sin_psi + d->m1 * cos_psi * cos_psi), cos_phi * sin_psi,
                        cos_psi * sqrt(cos_phi * cos_phi + d->m3 * sin_phi * sin_phi)},
           v_sorted[3];
    direction(d, sorted, theta, v_sorted);
    for (int j = 0; j < 3; j++) {
        n[d->axis[j]] = sorted[j];
        v[d->axis[j]] = v_sorted[j];
    }
}

/* The trapezoidal rule in u for both angles (map/quarter_impl.h) is exact to rounding. */
void iso_measure_draw_means(const measure_draw *d, int count, void (*f)(double g, const double n2[3], double value[]),
                            double mean[])
{
    const double J1 = d->J[0], J2 = d->J[1], J3 = d->J[2], step = 0.25, last = 46;
    double whole = 0, value[ISO_MEASURE_FUNCTIONS] = {0};
    for (int i = 0; i < count; i++) mean[i] = 0;
    for (double u = -last; u <= last; u += step) {
        const double e = exp(2 * u), s = e / (1 + e), c = 1 / (1 + e), a = density_a(d, s, c);
        for (double z = -last; z <= last; z += step) {
            const double ez = exp(2 * z), S = ez / (1 + ez), C = 1 / (1 + ez);
            const double weight = a * density_b(d, S, C) * (d->m1 * c + d->m3 * S);
            if (!(weight > 0)) continue;
            const double g = (J1 * c + J2 * s) / J1 * ((J2 * C + J3 * S) / J2) / J3;
            double n2[3];
            n2[d->axis[0]] = s * (S + d->m1 * C);
            n2[d->axis[1]] = c * S;
            n2[d->axis[2]] = C * (c + d->m3 * s);
            f(g, n2, value);
            whole += weight;
            for (int i = 0; i < count; i++) mean[i] += weight * value[i];
        }
    }
    for (int i = 0; i < count; i++) mean[i] /= whole;
}

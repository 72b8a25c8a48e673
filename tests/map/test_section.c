/* The chart of the section gamma_a = 0: forth and back, slopes, Sturm's bounds, the area, points spread evenly. */
#include <gsl/gsl_sf_ellint.h>

#include "laws.h"
#include "map/state.h"
#include "section_area.h"

/* At random places of the chart; every third one is near the boundary. */
static void hold_everywhere(const laws_case *c, laws_worst *worst,
                            void (*law)(const laws_case *, int, double, double, laws_worst *))
{
    for (int axis = 0; axis < 3; axis++) {
        const double l = iso_random_uniform(c->random, -M_PI, M_PI), x = iso_random_uniform(c->random, -1, 1);
        const bool near = iso_random_uniform(c->random, 0, 3) < 1;
        law(c, axis, l, near ? copysign(1 - 1e-12, x) : x, worst);
    }
}

/* (M,gamma) = 0, |gamma| = 1, H = 0, gamma_a = 0 rising; so does n_a of the image; the chart comes back. */
static void crossing_at(const laws_case *c, int axis, double l, double x, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    const double eps = c->problem.eps;
    double point[ISO_STATE], ball[ISO_STATE], rate[ISO_STATE], size, l1, x1;
    iso_section_point(iso_free_point(p, eps), axis, l, x, point);
    const double G = norm(point);
    laws_note(worst, fabs(dot(point, point + 3)), 4 * DBL_EPSILON * G, p, "(M,gamma)");
    laws_note(worst, fabs(norm(point + 3) - 1), 4 * DBL_EPSILON, p, "|gamma|");
    const double H = iso_system_point.energy(&c->problem, point, &size);
    laws_note(worst, fabs(H), 4 * laws_rounding(p) * size, p, "H");
    laws_note(worst, fabs(G / iso_section_momentum(iso_free_point(p, eps), axis, l) - 1), 4 * DBL_EPSILON, p, "G");
    iso_system_point.rhs(&c->problem, point, rate);
    laws_note(worst, fabs(rate[3 + axis] / (G * sqrt((1 - x) * (1 + x))) - 1), 8 * DBL_EPSILON, p, "gamma_a'");
    iso_point_to_ball(p, point, ball);
    iso_system_ball.rhs(&c->problem, ball, rate);
    laws_note(worst, ball[3 + axis] == 0 && rate[3 + axis] > 0 ? 0 : 1, 0.5, p, "n_a");
    iso_section_chart(axis, point, &l1, &x1);
    laws_note(worst, fabs(l1 - l), 4 * DBL_EPSILON * M_PI, p, "l");
    laws_note(worst, fabs(x1 - x), 4 * DBL_EPSILON, p, "x");
}

static void crossing(const laws_case *c, laws_worst *worst)
{
    hold_everywhere(c, worst, crossing_at);
}

typedef struct place_data {
    const iso_params *p;
    double eps;
    int axis;
} place_data;

static void point_of(const void *data, const double chart[], double point[])
{
    const place_data *d = data;
    iso_section_point(iso_free_point(d->p, d->eps), d->axis, chart[0], chart[1], point);
}

/* The deviations against differences; their slopes are the unit vectors, whatever is added along the flow. The step
 * is 1/128 of the distance to the nearest singularity: of q, and of the root at |x| = 1. */
static void slopes_at(const laws_case *c, int axis, double l, double x, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    const double eps = c->problem.eps;
    const place_data data = {p, eps, axis};
    double point[ISO_STATE], d[2][ISO_STATE], seen[ISO_STATE], rate[ISO_STATE], slope[2];
    iso_section_point(iso_free_point(p, eps), axis, l, x, point);
    iso_section_deviations(iso_free_point(p, eps), axis, l, x, d[0], d[1]);
    iso_system_point.rhs(&c->problem, point, rate);
    const double G = norm(point), root = sqrt((1 - x) * (1 + x)), mixed = iso_random_uniform(c->random, -2, 2);
    for (int i = 0; i < 2; i++) {
        const double chart[2] = {l, x}, direction[2] = {i == 0, i == 1};
        const double h = (i == 0 ? laws_reach(p) : 1 - fabs(x)) / 128, steep = i == 0 ? 1 : 1 / root;
        laws_slope(point_of, &data, ISO_STATE, 2, chart, direction, h, seen);
        /* l has an error of epsilon pi itself, and sqrt((1-x)(1+x)) one of epsilon/(1-|x|) at x + h */
        const double rounding = (8 * laws_rounding(p) + (i == 0 ? 0 : DBL_EPSILON / (1 - fabs(x)))) / h * 2;
        laws_note(worst, laws_distance(seen, d[i]), rounding * G * fmax(steep * h, 1), p, i ? "dM/dx" : "dM/dl");
        laws_note(worst, laws_distance(seen + 3, d[i] + 3), 8 * DBL_EPSILON / h, p, i ? "dgamma/dx" : "dgamma/dl");
        for (int j = 0; j < ISO_STATE; j++) d[i][j] += mixed / norm(rate + 3) * rate[j];
        iso_section_slope(axis, point, rate, d[i], slope);
        const double slack = 64 * laws_rounding(p) * (1 + fabs(mixed) * norm(rate) / (G * norm(rate + 3))) / root;
        laws_note(worst, fabs(slope[0] - (i == 0)), slack, p, i ? "dl/dx" : "dl/dl");
        laws_note(worst, fabs(slope[1] - (i == 1)), slack, p, i ? "dx/dx" : "dx/dl");
    }
}

static void slopes(const laws_case *c, laws_worst *worst)
{
    hold_everywhere(c, worst, slopes_at);
}

/* W of (24) at every q of a dense scan is between the bounds, and comes close to both; global axes have W_min > 0 */
static void bounds(const laws_case *c, laws_worst *worst)
{
    enum { SCAN = 20000 };
    const iso_params *p = &c->problem.p;
    for (int axis = 0; axis < 3; axis++) {
        double W[2], least = INFINITY, most = 0;
        iso_section_bounds(iso_free_point(p, c->problem.eps), axis, W);
        const double low = min3(p->J), ratio = max3(p->J) / low;
        for (int i = 0; i <= SCAN; i++) {
            const double q = low * pow(ratio, (double)i / SCAN);
            const double square = 2 * c->problem.eps / p->k * pow(q, -1 - 1 / p->k) * (p->J[axis] - (1 - p->k) * q);
            least = fmin(least, square);
            most = fmax(most, square);
        }
        const double near = 64 * laws_rounding(p) * (1 + 1 / fabs(p->k)), step = log(ratio) / SCAN;
        const double missed = pow((2 + 2 / fabs(p->k)) * step, 2) + near; /* if it were at a stationary point */
        laws_note(worst, sqrt(fmax(least, 0)) >= W[0] * (1 - near) && sqrt(most) <= W[1] * (1 + near) ? 0 : 1, 0.5, p,
                  "inside");
        laws_note(worst, fabs(W[0] * W[0] - fmax(least, 0)), missed * fmax(most, 0), p, "W_min");
        laws_note(worst, fabs(W[1] * W[1] - most), missed * most, p, "W_max");
        if (iso_section_is_global(iso_free_point(p, 1), axis)) laws_note(worst, W[0] > 0 ? 0 : 1, 0.5, p, "global");
    }
    laws_note(worst, iso_section_is_global(iso_free_point(p, 1), iso_section_axis(iso_free_point(p, 1))) ? 0 : 1, 0.5,
              p, "axis");
}

/* W_min and W_max where W^2 < 0 at a stationary point inside: k = 0.5, J = (1, 2, 5), axis 1: q = 3 */
static void stationary(void)
{
    const double J[3] = {1, 2, 5};
    const iso_params p = laws_params(0.5, J);
    double W[2];
    iso_section_bounds(iso_free_point(&p, 1), 0, W);
    gsl_test(W[0] != 0, "W_min of an axis that is not global: %g", W[0]);
    gsl_test_rel(W[1], sqrt(2.0), 4 * DBL_EPSILON, "W_max at q = 1");
    gsl_test_int(iso_section_axis(iso_free_point(&p, 1)), 2, "global axis for k > 0");
    const iso_params shell = laws_params(-0.4, J);
    gsl_test_int(iso_section_axis(iso_free_point(&shell, 1)), 0, "global axis for k < 0");
    /* axis 3, W^2 = 5 eps q^1.5 (1.4 q - 5): q* = 15/7 is a minimum below 0, and the largest value is at q = 5 */
    iso_section_bounds(iso_free_point(&shell, 1), 2, W);
    gsl_test_rel(W[1], sqrt(5 * pow(5, 1.5) * 2), 8 * DBL_EPSILON, "W_max at q = 5");
}

/* P_n(z), n >= 0, z >= 1 */
static double legendre(int n, double z)
{
    double before = 1, now = z;
    if (n == 0) return 1;
    for (int i = 1; i < n; i++) {
        const double next = ((2 * i + 1) * z * now - i * before) / (i + 1);
        before = now;
        now = next;
    }
    return now;
}

/* Laplace's integral: area = 4 pi sqrt(2 eps) (Jb Jc)^(-v/2) P_{v-1}(z), v = 1/(2k), z = (Jb + Jc)/(2 sqrt(Jb Jc)),
 * P_{-n-1} = P_n; and the complete elliptic integrals at k = +-1. To moments of ratio 1e6. */
static void areas(void)
{
    const double list[][3] = {{1.4, 2.1, 3}, {1, 2, 5}, {1e6, 1, 30}, {1, 1e6, 7}, {2, 2, 2}};
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        const double Jb = list[i][0], Jc = list[i][1], z = (Jb + Jc) / 2 / sqrt(Jb * Jc), eps = 0.7;
        for (int v = -10; v <= 10; v++) {
            if (v == 0) continue;
            const iso_params p = laws_params(1 / (2.0 * v), list[i]);
            const double closed = 4 * M_PI * sqrt(2 * eps) * pow(Jb * Jc, -v / 2.0) * legendre(v > 0 ? v - 1 : -v, z);
            gsl_test_rel(section_area(iso_free_point(&p, eps), 2), closed, (8 + 4 * abs(v)) * DBL_EPSILON,
                         "area, 1/(2k) = %d, J = %g %g", v, Jb, Jc);
        }
        const double high = fmax(Jb, Jc), modulus = sqrt((high - fmin(Jb, Jc)) / high);
        const double E = gsl_sf_ellint_Ecomp(modulus, GSL_PREC_DOUBLE),
                     K = gsl_sf_ellint_Kcomp(modulus, GSL_PREC_DOUBLE);
        const iso_params plane = laws_params(1, list[i]), shell = laws_params(-1, list[i]);
        /* K of a modulus near 1 is known to 1e-16/(1 - modulus) of ln */
        gsl_test_rel(section_area(iso_free_point(&plane, eps), 2), 8 * K * sqrt(2 * eps / high), 1e-11,
                     "area, k = 1");
        gsl_test_rel(section_area(iso_free_point(&shell, eps), 2), 8 * E * sqrt(2 * eps * high), 1e-14,
                     "area, k = -1");
    }
}

/* --- the spread ------------------------------------------------------------------------------------------------- */

/* The part of the area with l' < l, by Simpson's rule */
static double part_below(const iso_params *p, int axis, double l)
{
    enum { STEPS = 4000 };
    double sum = 0;
    for (int i = 0; i <= STEPS; i++)
        sum += (i == 0 || i == STEPS ? 1
                : i % 2              ? 4
                                     : 2) *
               iso_section_momentum(iso_free_point(p, 1), axis, -M_PI + (l + M_PI) * i / STEPS);
    return 2 * sum * (l + M_PI) / STEPS / 3 / section_area(iso_free_point(p, 1), axis);
}

/* Part of a turn between point i and the next one, in the integral of G, is 1/r for every i: the integral is inverted
 * exactly. Simpson's rule is exact to 1e-10 here. */
static void inversion(void)
{
    const double r = 1.3247179572447460, J[3] = {1, 2, 5}, k[] = {0.5, -0.4, 0.2, 4};
    for (size_t i = 0; i < sizeof k / sizeof *k; i++) {
        const iso_params p = laws_params(k[i], J);
        iso_section_spread s;
        iso_section_spread_prepare(&s, iso_free_point(&p, 1), 0, 3);
        double worst = 0, before = NAN, x_before = NAN;
        for (uint64_t j = 0; j < 200; j++) {
            double l, x;
            iso_section_spread_point(&s, j, &l, &x);
            const double now = part_below(&p, 0, l), step = now - before - 1 / r,
                         x_step = (x - x_before) / 2 - 1 / r / r;
            if (j > 0) worst = fmax(worst, fabs(step - round(step)) + fabs(x_step - round(x_step)));
            before = now;
            x_before = x;
        }
        gsl_test(!(worst < 1e-9), "steps of the spread, k = %g: off by %.2g", k[i], worst);
    }
}

enum { POINTS = 2000, BOXES = 300 };

/* Largest |share of the points - share of the area| over boxes with a corner at (-pi, -1) */
static double discrepancy(const iso_params *p, int axis, double points[POINTS][2])
{
    double worst = 0;
    iso_random *random = iso_random_create(5);
    for (int b = 0; b < BOXES; b++) {
        const double l = iso_random_uniform(random, -M_PI, M_PI), x = iso_random_uniform(random, -1, 1);
        int inside = 0;
        for (int i = 0; i < POINTS; i++) inside += points[i][0] < l && points[i][1] < x;
        worst = fmax(worst, fabs((double)inside / POINTS - part_below(p, axis, l) * (x + 1) / 2));
    }
    iso_random_free(random);
    return worst;
}

/* R2 has a discrepancy near ln(N)/N; random points one near 1/sqrt(N) = 0.022. */
static void spread(void)
{
    static double points[POINTS][2];
    const double J[3] = {1.4, 2.1, 3};
    for (size_t i = 0; i < 4; i++) {
        const double k[4] = {0.5, -0.4, 0.2, 4};
        const iso_params p = laws_params(k[i], J);
        const int axis = iso_section_axis(iso_free_point(&p, 1));
        iso_section_spread s;
        iso_section_spread_prepare(&s, iso_free_point(&p, 1), axis, i);
        for (uint64_t j = 0; j < POINTS; j++) iso_section_spread_point(&s, j, &points[j][0], &points[j][1]);
        const double found = discrepancy(&p, axis, points);
        gsl_test(!(found < 2 * log(POINTS) / POINTS), "discrepancy of %d points, k = %g: %.2g", POINTS, k[i], found);
    }
}

/* Equal seeds give equal points in any order, others give others; far points are as good. */
static void seeds(void)
{
    const double J[3] = {1, 2, 5};
    const iso_params p = laws_params(0.5, J);
    iso_section_spread a, b, c;
    iso_section_spread_prepare(&a, iso_free_point(&p, 1), 2, 7);
    iso_section_spread_prepare(&b, iso_free_point(&p, 1), 2, 7);
    iso_section_spread_prepare(&c, iso_free_point(&p, 1), 2, 8);
    double z[3][2];
    iso_section_spread_point(&a, 3, &z[1][0], &z[1][1]);
    iso_section_spread_point(&a, 5, &z[0][0], &z[0][1]);
    iso_section_spread_point(&b, 5, &z[1][0], &z[1][1]);
    iso_section_spread_point(&c, 5, &z[2][0], &z[2][1]);
    gsl_test(memcmp(z[0], z[1], sizeof z[0]) != 0, "equal seeds, equal points");
    gsl_test(!(fabs(z[0][0] - z[2][0]) > 1e-3), "other seeds, other points: %g %g", z[0][0], z[2][0]);
    static double points[POINTS][2];
    for (uint64_t j = 0; j < POINTS; j++)
        iso_section_spread_point(&a, UINT64_MAX / 3 + j, &points[j][0], &points[j][1]);
    gsl_test(!(discrepancy(&p, 2, points) < 2 * log(POINTS) / POINTS), "points from 6e18 on");
}

/* Extreme k and J: finite, inside the chart, and the share below the median of l is a half. */
static void extremes(void)
{
    const double k[] = {0.05, -0.05, 1e3, -1e3, 1}, J[3] = {1e-3, 1e3, 30};
    for (size_t i = 0; i < sizeof k / sizeof *k; i++)
        for (int axis = 0; axis < 3; axis++) {
            const iso_params p = laws_params(k[i], J);
            iso_section_spread s;
            iso_section_spread_prepare(&s, iso_free_point(&p, 1), axis, 1);
            bool good = true;
            int positive = 0;
            for (uint64_t j = 0; j < POINTS; j++) {
                double l, x, l1, x1, point[ISO_STATE];
                iso_section_spread_point(&s, j, &l, &x);
                iso_section_point(iso_free_point(&p, 1), axis, l, x, point);
                iso_section_chart(axis, point, &l1, &x1);
                positive += l > 0;
                good = good && l > -M_PI && l <= M_PI && fabs(x) < 1 && fabs(l1 - l) < 1e-15 && fabs(x1 - x) < 1e-15;
            }
            double W[2];
            iso_section_bounds(iso_free_point(&p, 1), axis, W);
            const double area = section_area(iso_free_point(&p, 1), axis);
            good = good && abs(positive - POINTS / 2) < 8 && area > 0 && isfinite(area) && isfinite(W[1]);
            gsl_test(!good, "k = %g, J of ratio 1e6, axis %d", k[i], axis + 1);
        }
}

/* l is in (-pi, pi], never -pi, however the zeros are signed */
static void seam(void)
{
    for (int i = 0; i < 2; i++) {
        const double point[ISO_STATE] = {0, 1, 0.5, -1, i ? -0.0 : 0.0, 0};
        double l, x;
        iso_section_chart(2, point, &l, &x);
        gsl_test(l != M_PI, "l = pi at the seam: %g", l);
    }
}

/* The rotation about axis a has n_a = 0 and omega along a, of any size. A tilt that is larger than rounding is another
 * orbit. */
static void rotation(void)
{
    for (int a = 0; a < 3; a++)
        for (int tilt = 0; tilt < 3; tilt++) {
            double y[ISO_STATE] = {0};
            y[a] = -1e200;
            y[3 + (a + 1) % 3] = 0.6, y[3 + (a + 2) % 3] = 0.8;
            if (tilt == 1) y[(a + 1) % 3] = 1e187;
            if (tilt == 2) y[3 + a] = 1e-13;
            for (int b = 0; b < 3; b++)
                gsl_test_int(iso_section_is_rotation(y, b), b == a && tilt == 0,
                             "rotation about %d: axis %d, tilt %d", a, b, tilt);
        }
}

int main(void)
{
    laws_hold("crossings and their chart", &iso_system_point, crossing);
    laws_hold("slopes of the chart", &iso_system_point, slopes);
    laws_hold("Sturm's bounds", &iso_system_point, bounds);
    stationary();
    areas();
    inversion();
    spread();
    seeds();
    extremes();
    seam();
    rotation();
    exit(gsl_test_summary());
}

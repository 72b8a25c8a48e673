/* The chart of the section on levels H = E, also where a part of its circle is closed: energy, slopes, Sturm's bounds,
 * the area, points spread evenly. */
#include "laws.h"
#include "map/section.h"
#include "map/state.h"
#include "section_area.h"

enum { CASES = 300, STEPS = 20000 };

/* A random motion: every third level is below 0, with a part of the sphere closed, and every third eps is negative. */
static iso_point_motion motion_of(iso_random *r, int i, iso_params *p)
{
    static const double ks[] = {0.5, -0.5, 1, -1, 0.3, -0.3, 2.5, -3};
    const double J[3] = {iso_random_uniform(r, 1, 4), iso_random_uniform(r, 1, 4), iso_random_uniform(r, 1, 4)};
    *p = laws_params(ks[i % 8], J);
    const double eps = i % 3 == 2 ? -iso_random_uniform(r, 0.2, 2) : iso_random_uniform(r, 0.2, 2);
    const double low = -eps * pow(min3(J), -1 / p->k), high = -eps * pow(max3(J), -1 / p->k);
    const double bottom = fmin(low, high), top = fmax(low, high);
    const double energy = i % 3 == 0 ? iso_random_uniform(r, bottom, top) : top + iso_random_uniform(r, 0.1, 5);
    return (iso_point_motion){p, eps, energy};
}

/* A place of the section, open and not at its border. False: there is none. */
static bool place(iso_random *r, iso_point_motion m, int axis, double *l, double *x)
{
    for (int i = 0; i < 100; i++) {
        *l = iso_random_uniform(r, -M_PI, M_PI);
        *x = iso_random_uniform(r, -0.95, 0.95);
        if (iso_section_momentum(m, axis, *l) > 0.2) return true;
    }
    return false;
}

/* H = E, n_a = 0 rising, the chart comes back; deviations against differences, and their slopes. */
static void points(iso_random *r, iso_point_motion m, int axis, double worst[3])
{
    double l, x, l1, x1, point[ISO_STATE], rate[ISO_STATE], moved[2][ISO_STATE], d[2][ISO_STATE], ball[ISO_STATE],
        size, slope[2];
    const iso_problem problem = {.p = *m.p, .eps = m.eps, .energy = m.energy};
    if (!place(r, m, axis, &l, &x)) return;
    iso_section_point(m, axis, l, x, point);
    iso_section_chart(axis, point, &l1, &x1);
    const double H = iso_system_point.energy(&problem, point, &size);
    worst[0] = fmax(worst[0], fabs(H - m.energy) / size + fabs(l1 - l) + fabs(x1 - x));
    iso_point_to_ball(m.p, point, ball);
    if (ball[3 + axis] != 0) worst[0] = INFINITY;
    iso_section_deviations(m, axis, l, x, d[0], d[1]);
    iso_system_point.rhs(&problem, point, rate);
    for (int i = 0; i < 2; i++) {
        const double h = 1e-5;
        for (int side = 0; side < 2; side++)
            iso_section_point(m, axis, l + (i == 0 ? (side ? h : -h) : 0), x + (i == 1 ? (side ? h : -h) : 0),
                              moved[side]);
        for (int j = 0; j < ISO_STATE; j++)
            worst[1] = fmax(worst[1], fabs((moved[1][j] - moved[0][j]) / (2 * h) - d[i][j]) / (1 + norm(d[i])));
        iso_section_slope(axis, point, rate, d[i], slope);
        worst[2] = fmax(worst[2], fabs(slope[0] - (i == 0)) + fabs(slope[1] - (i == 1)));
    }
}

/* W at every q of a scan of the range is between the bounds, which are reached. The global axis has no W^2 < 0. */
static void bounds(iso_point_motion m, int axis, const char *what)
{
    double W[2], q[2], least = INFINITY, most = -INFINITY, J[3] = {m.p->J[0], m.p->J[1], m.p->J[2]};
    iso_section_bounds(m, axis, W);
    iso_section_range(m, q);
    bool allowed = true;
    for (int i = 0; i <= STEPS; i++) {
        const double at = min3(J) + (max3(J) - min3(J)) * i / STEPS, fall = m.eps * pow(at, -1 / m.p->k);
        const double square = 2 * m.energy + 2 / m.p->k * fall / at * (J[axis] - (1 - m.p->k) * at);
        const bool inside = at >= q[0] && at <= q[1], open = m.energy + fall >= 0;
        allowed = allowed && (inside == open || fabs(m.energy + fall) < 1e-3 * fabs(m.energy));
        if (!inside || !open) continue;
        least = fmin(least, square);
        most = fmax(most, square);
    }
    const double slack = 1e-2 * most;
    gsl_test(!allowed, "%s: the range of q is where E >= V", what);
    gsl_test(!(W[0] * W[0] <= fmax(least, 0) + 1e-12 * most && W[0] * W[0] >= fmax(least, 0) - slack),
             "%s: least W^2 %g, scan %g", what, W[0] * W[0], least);
    gsl_test(!(W[1] * W[1] >= most * (1 - 1e-12) && W[1] * W[1] <= most + slack), "%s: most W^2 %g, scan %g", what,
             W[1] * W[1], most);
    if (axis == iso_section_axis(m))
        gsl_test(!(least > -1e-12 * most && iso_section_is_global(m, axis)), "%s: its axis is global, W^2 >= %g",
                 what, least);
}

/* The area, and points spread evenly by dL dl: the part of the integral of G below them goes up by 1/r modulo 1. Where
 * the circle has closed parts, the arcs are filled in another order, and below l there are as many points as area. */
static void spread(iso_point_motion m, int axis, const char *what)
{
    enum { POINTS = 500 };
    static double sum[STEPS + 1];
    double part[POINTS], worst = 0;
    iso_section_spread s;
    sum[0] = 0;
    for (int i = 0; i < STEPS; i++) /* by the middles of the steps */
        sum[i + 1] = sum[i] + iso_section_momentum(m, axis, -M_PI + 2 * M_PI * (i + 0.5) / STEPS) * 2 * M_PI / STEPS;
    gsl_test_rel(section_area(m, axis), 2 * sum[STEPS], 1e-4, "%s: area", what);
    if (sum[STEPS] == 0) return;
    iso_section_spread_prepare(&s, m, axis, 3);
    for (int i = 0; i < POINTS; i++) {
        double l, x;
        iso_section_spread_point(&s, (uint64_t)i, &l, &x);
        const double at = (l + M_PI) / (2 * M_PI) * STEPS, rest = at - floor(at);
        const int step = at >= STEPS ? STEPS - 1 : (int)at;
        if (!(iso_section_is_open(m, axis, l) && l > -M_PI && l <= M_PI && fabs(x) < 1)) worst = INFINITY;
        part[i] = (sum[step] + rest * (sum[step + 1] - sum[step])) / sum[STEPS];
    }
    for (int i = 0; i < 50; i++) {
        int below = 0;
        for (int j = 0; j < POINTS; j++) below += part[j] < (i + 0.5) / 50;
        worst = fmax(worst, fabs((double)below / POINTS - (i + 0.5) / 50));
    }
    gsl_test(!(worst < 4 * log(POINTS) / POINTS), "%s: points below l against the area: off by %.2g", what, worst);
}

int main(void)
{
    iso_random *r = iso_random_create(29);
    double worst[3] = {0, 0, 0};
    for (int i = 0; i < CASES; i++) {
        iso_params p;
        const iso_point_motion m = motion_of(r, i, &p);
        char what[128];
        for (int axis = 0; axis < 3; axis++) {
            snprintf(what, sizeof what, "k = %g, J = %.3g %.3g %.3g, eps %.3g, E %.3g, axis %d", p.k, p.J[0], p.J[1],
                     p.J[2], m.eps, m.energy, axis + 1);
            points(r, m, axis, worst);
            bounds(m, axis, what);
            if (i % 4 == 0) spread(m, axis, what);
        }
    }
    gsl_test(!(worst[0] < 1e-14), "H = E, and the chart comes back: %.2g", worst[0]);
    gsl_test(!(worst[1] < 1e-6), "deviations against differences: %.2g", worst[1]);
    gsl_test(!(worst[2] < 1e-11), "slopes of the deviations: %.2g", worst[2]);
    iso_random_free(r);
    return gsl_test_summary();
}

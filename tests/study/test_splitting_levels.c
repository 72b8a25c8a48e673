/* The splitting on every level of the point's energy: m by difference quotients of crossings, 64 against 128 bits,
 * scans against the level. */
#include "base/math_impl.h"
#include "crossed.h"
#include "instrument/separatrix/separatrix.h"
#include "map/section.h"
#include "map/section_impl.h"

static iso_context *ctx;

/* A section around O = (corner, 0). */
typedef struct plane {
    iso_params p;
    iso_point_motion motion;
    int axis;
    double corner;
} plane;

/* (u, x) after n returns from z, by crossings in doubles. slope: of one return. */
static void go(const plane *a, int n, const double z[2], double to[2], double slope[2][2])
{
    enum { MOST = 60 };
    iso_crossings_options o = iso_crossings_defaults();
    iso_crossing at[MOST];
    iso_start start = {.model = ISO_POINT, .eps = a->motion.eps};
    iso_section_point(a->motion, a->axis, a->corner + z[0], z[1], start.y);
    const iso_batch_orbit orbit = {&a->p, &start, NULL};
    o.axis = a->axis, o.tolerance = 1e-14, o.deviations = slope != NULL;
    if (n > MOST || !crossed(ctx, &orbit, &o, (size_t)n, at, NULL)) exit(gsl_test_summary());
    to[0] = remainder(at[n - 1].l - a->corner, 2 * ISO_PI), to[1] = at[n - 1].x;
    if (slope) memcpy(slope, at[n - 1].slope, sizeof at[n - 1].slope);
}

/* dx/du of W^u(O) at u = pi/2: a start `part` along the unstable direction is followed until it gets there. The
 * direction is linear to part^2 = 1e-12; quotients over 1e-4 of u. */
static double slope_by_differences(const plane *a)
{
    double A[2][2], end[2], unused[2], low = 1e-6, step;
    go(a, 1, (const double[2]){0, 0}, unused, A);
    const double trace = A[0][0] + A[1][1], lambda = (trace + sqrt(trace * trace - 4)) / 2;
    const double length = copysign(hypot(A[0][1], lambda - A[0][0]), A[0][1]),
                 v[2] = {A[0][1] / length, (lambda - A[0][0]) / length};
    const int n = (int)(log(1e6) / log(lambda));
    double high = low;
    for (end[0] = 0; end[0] < ISO_PI / 2 && high < 1e-4;) { /* the first passage */
        low = high, high *= 1.02;
        go(a, n, (const double[2]){high * v[0], high * v[1]}, end, NULL);
    }
    for (int i = 0; i < 45; i++) {
        const double middle = (low + high) / 2;
        go(a, n, (const double[2]){middle * v[0], middle * v[1]}, end, NULL);
        *(end[0] < ISO_PI / 2 ? &low : &high) = middle;
    }
    step = 1e-4 * low;
    double side[2][2];
    for (int i = 0; i < 2; i++) {
        const double at = low + (2 * i - 1) * step;
        go(a, n, (const double[2]){at * v[0], at * v[1]}, side[i], NULL);
    }
    return (side[1][1] - side[0][1]) / (side[1][0] - side[0][0]);
}

static void check_slope(double k, const double J[3], double level)
{
    iso_separatrix_splitting s;
    plane a = {.p = laws_params(k, J)};
    if (iso_separatrix_at(ctx, k, J, level, ISO_SEPARATRIX_DOUBLE, &s) != ISO_OK)
        gsl_test(1, "splitting: %s", iso_context_message(ctx));
    a.motion = (iso_point_motion){&a.p, 1, iso_level_energy(&a.p, level)};
    a.axis = s.section;
    a.corner = s.middle == (s.section + 2) % 3 ? 0 : ISO_PI / 2;
    const double m = slope_by_differences(&a);
    gsl_test(!(s.error < 1e-15 && s.from_zero), "k = %g, level %g: m = %g +- %.1e", k, level, s.m, s.error);
    gsl_test_abs(m, s.section_m, 1e-6, "k = %g, level %g: m by difference quotients", k, level);
}

static void check_splitting(void)
{
    static const double thin[3] = {1.4, 2.1, 3}, wide[3] = {1, 2, 5};
    for (int i = 0; i < tests_length(0, 3); i++) { /* 64 bits and their error against 128 bits, where there are any */
        iso_separatrix_splitting s, q;
        const double k = i % 2 ? -0.5 : 0.5, level = 0.4 - 0.25 * i, *J = i == 2 ? wide : thin;
        iso_separatrix_at(ctx, k, J, level, ISO_SEPARATRIX_DOUBLE, &s);
        if (iso_separatrix_at(ctx, k, J, level, ISO_SEPARATRIX_QUAD, &q) == ISO_BAD_ARGUMENT) break;
        const double apart = fabs((s.m - q.m) + (s.m_tail - q.m_tail));
        gsl_test(!(apart < s.error && q.error < 1e-26),
                 "k = %g, level %g: 64 from 128 bits %.1e, errors %.1e and %.1e", k, level, apart, s.error, q.error);
    }
    check_slope(0.5, thin, -0.25);
    check_slope(0.5, wide, 0.7);
    check_slope(-0.4, thin, 0.1);
    check_slope(-0.5, wide, -0.15);
}

/* A scan against the level. */
static void check_scan(void)
{
    static const double J[3] = {1, 2, 5}, k[] = {-1.5, -1.5, -1.5}, level[] = {0, 0.05, -0.05};
    iso_separatrix_options o = iso_separatrix_defaults();
    iso_separatrix_table *s;
    o.k = k, o.level = level, o.count = 3, o.digits = ISO_SEPARATRIX_DOUBLE;
    memcpy(o.J, J, sizeof o.J);
    if (iso_separatrix_run(ctx, &o, &s) != ISO_OK) gsl_test(1, "a scan: %s", iso_context_message(ctx));
    for (int i = 0; i < 3; i++) {
        iso_separatrix_splitting one;
        iso_separatrix_at(ctx, k[i], J, level[i], ISO_SEPARATRIX_DOUBLE, &one);
        gsl_test(s->row[i].level != level[i] || s->row[i].m != one.m, "row %d is that of its level", i);
    }
    iso_separatrix_free(s);
}

int main(void)
{
    ctx = iso_context_create();
    check_splitting();
    check_scan();
    iso_context_free(ctx);
    return gsl_test_summary();
}

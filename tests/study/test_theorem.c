/* The theorem of doc/why_only_one.md, first variation, by computations that do not know it. The equations (9) are
 * linearised along the rotation about the middle axis and followed on random paths in complex time. Base points,
 * corners of paths, k and J are random. Neither Hill's equation, nor exponents, nor Sturm's comparison are used here.
 *
 *     n = (cos theta, 0, sin theta), w = e2, theta' = k. Loops: A round theta = i infinity, B round the zero of
 *     g = (n, J^-1 n) with Im theta > 0; M from theta to theta + pi below this zero. M = A B.
 */
#define _GNU_SOURCE /* functions of _Float128 */
#include "base/math_impl.h"
#include "complex_paths.h"
#include "instrument/periodic/periodic_impl.h"
#include "laws.h"

typedef struct rotation {
    double k, J[3];
    double torque;       /* of the constraint, by the right one: 1 */
    complex_number zero; /* of g, in the strip 0 <= Re theta < pi  */
} rotation;

/* --- the linearised equations (9) ------------------------------------------------------------------------------- */

/* d/dtheta of (delta w, delta n): J dw' = J dw x w + J w x dw + dlambda n, dn' = k (dn x w + n x dw). On the rotation
 * lambda is 0, whatever n. */
static void slope(const void *rotating, complex_number theta, const complex_number y[], complex_number dy[])
{
    const rotation *r = rotating;
    const complex_number n[3] = {ccos(theta), 0, csin(theta)}, w[3] = {0, 1, 0}, Jw[3] = {0, r->J[1], 0};
    complex_number Jdw[3], a[3], b[3], c[3], d[3], along = 0, g = 0;
    for (int i = 0; i < 3; i++) Jdw[i] = r->J[i] * y[i];
    cross3(Jdw, w, a);
    cross3(Jw, y, b);
    cross3(y + 3, w, c);
    cross3(n, y, d);
    for (int i = 0; i < 3; i++) along += (a[i] + b[i]) * n[i] / r->J[i], g += n[i] * n[i] / r->J[i];
    for (int i = 0; i < 3; i++) {
        dy[i] = (a[i] + b[i] - r->torque * along / g * n[i]) / (r->J[i] * r->k);
        dy[i + 3] = c[i] + d[i];
    }
}

static double distance_to_pole(const rotation *r, complex_number theta)
{
    double least = INFINITY;
    for (int turn = -3; turn <= 3; turn++)
        for (int side = 0; side < 2; side++)
            least = fmin(least, cabs(theta - ISO_PI * turn - (side ? conj(r->zero) : r->zero)));
    return least;
}

/* Coordinates on the energy level across the rotation: y = dn2, v = (dw, dn/dtheta). (w, n) = 0 gives the rest. */
static void along(const rotation *r, const complex_number corner[], int corners, matrix m)
{
    for (int column = 0; column < 2; column++) {
        const complex_number c0 = ccos(corner[0]), s0 = csin(corner[0]), y0 = column == 0, v0 = column == 1;
        complex_number y[6] = {-y0 * c0 - v0 * s0, 0, -y0 * s0 + v0 * c0, 0, y0, 0};
        for (int i = 0; i + 1 < corners; i++) {
            const complex_number side = corner[i + 1] - corner[i];
            for (double done = 0; done < 1;) {
                const complex_number theta = corner[i] + done * side;
                const double length = 0.02 * fmin(distance_to_pole(r, theta), fmin(1, 3 * fabs(r->k)));
                const double part = fmin(length / cabs(side), 1 - done);
                path_step(slope, r, 6, theta, part * side, y);
                done += part;
            }
        }
        const complex_number c = ccos(corner[corners - 1]), s = csin(corner[corners - 1]);
        m[0][column] = y[4];
        m[1][column] = c * y[2] - s * y[0];
    }
}

/* --- the loops -------------------------------------------------------------------------------------------------- */

typedef struct loops {
    matrix A, B, M;
} loops;

/* From a base point left of the zero: A over it, M below it, B round it. All corners are random. */
static void follow(const rotation *r, iso_random *random, loops *l)
{
    enum { ROUND = 7, MOST = ROUND + 4 };
    const double height = cimag(r->zero), free = fmin(1, height);
    const double left = creal(r->zero) - iso_random_uniform(random, 0.9, 2.2);
    const complex_number base = left + I * iso_random_uniform(random, -0.5, 0.5) * height;
    complex_number corner[MOST] = {base};
    for (int i = 1; i < 4; i++) /* to and fro, above the zero */
        corner[i] =
            left + iso_random_uniform(random, -0.5, 3.6) + I * (height + free * iso_random_uniform(random, 0.4, 1.2));
    corner[1] = left + iso_random_uniform(random, -0.4, 0.4) + I * cimag(corner[1]);
    corner[3] = left + ISO_PI + iso_random_uniform(random, -0.4, 0.4) + I * cimag(corner[3]);
    corner[4] = base + ISO_PI;
    along(r, corner, 5, l->A);
    for (int i = 1; i < 3; i++) /* below the zero, and above its mirror image */
        corner[i] = left + iso_random_uniform(random, -0.5, 3.6) + I * height * iso_random_uniform(random, -0.5, 0.5);
    corner[3] = base + ISO_PI;
    along(r, corner, 4, l->M);
    const double turned = iso_random_uniform(random, -2.6, -2.0); /* where the circle is met: below, to the left */
    for (int i = 0; i < ROUND; i++)
        corner[i + 1] =
            r->zero + 0.6 * free * iso_random_uniform(random, 0.7, 1.2) * cexp(I * (turned + 2 * ISO_PI * i / ROUND));
    corner[ROUND + 1] = corner[1];
    corner[ROUND + 2] = base;
    along(r, corner, ROUND + 3, l->B);
}

static rotation rotation_of(double k, const double J[3])
{
    rotation r = {k, {J[0], J[1], J[2]}, 1, 0};
    const double height = atanh(sqrt(fmin(J[0], J[2]) / fmax(J[0], J[2])));
    r.zero = (J[0] < J[2] ? ISO_PI / 2 : 0) + I * height;
    return r;
}

/* --- what the theorem says of them ------------------------------------------------------------------------------ */

static double cosine(double k)
{
    return cos(ISO_PI / (2 * k));
}

/* |A_00 A_11 - 4 cos^2(pi/(2k'))/(2 - T)| by the size of what is added, k' = k/change. */
static double product_error(loops *l, double k, double change)
{
    matrix A;
    const double size = in_eigenbasis(l->M, l->A, A), c = cosine(k / change);
    const complex_number T = l->M[0][0] + l->M[1][1];
    return cabs(A[0][0] * A[1][1] - 4 * c * c / (2 - T)) / (size * size);
}

static double trace_error(matrix m, double k)
{
    const complex_number trace = m[0][0] + m[1][1];
    const double size = pow(cabs(m[0][0]) + cabs(m[0][1]) + cabs(m[1][0]) + cabs(m[1][1]), 2);
    return cabs(trace * trace - 4 * cosine(k) * cosine(k) * det(m)) / (size + cabs(det(m)));
}

static double loop_error(const loops *l)
{
    double off = 0, size = 0;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            const complex_number AB = l->A[i][0] * l->B[0][j] + l->A[i][1] * l->B[1][j];
            off = fmax(off, cabs(AB - l->M[i][j]));
            size += cabs(l->A[i][0] * l->B[0][j]) + cabs(l->A[i][1] * l->B[1][j]);
        }
    return off / (1 + size);
}

/* J1, J2, J3 with J2 between the others, which stand in either order. */
static void draw(iso_random *random, double J[3])
{
    draw_between(random, exp(iso_random_uniform(random, -1, 0.5)), 1.1, 2.1, J);
}

static double draw_k(iso_random *random, double least, double most)
{
    return (iso_random_uniform(random, 0, 1) < 0.5 ? 1 : -1) * exp(iso_random_uniform(random, log(least), log(most)));
}

static void note(laws_worst *w, double error, double allowed, const rotation *r, const char *what)
{
    const iso_params p = laws_params(r->k, r->J);
    laws_note(w, error, allowed, &p, what);
}

static void check_loops(void)
{
    laws_worst product = {0}, traces = {0}, closed = {0}, hill = {0};
    iso_random *random = iso_random_create(35);
    double least_other = INFINITY, least_torque = INFINITY;
    for (int i = 0; i < tests_length(100, 1000); i++) {
        double J[3];
        draw(random, J);
        rotation r = rotation_of(draw_k(random, 0.25, 4), J);
        loops l;
        follow(&r, random, &l);
        const double T = iso_hill_trace(r.k, J, 0, 1, NULL);
        note(&product, product_error(&l, r.k, 1), 1e-8, &r, "A_00 A_11");
        note(&traces, trace_error(l.A, r.k), 1e-8, &r, "tr A");
        note(&traces, trace_error(l.B, r.k), 1e-8, &r, "tr B");
        note(&closed, loop_error(&l), 1e-8, &r, "M - A B");
        note(&closed, cabs(det(l.M) - 1) / (1 + T * T), 1e-8, &r, "det M - 1");
        note(&hill, cabs(l.M[0][0] + l.M[1][1] - T) / (1 + T * T), 1e-8, &r, "T by Hill's equation");
        if (i >= 20) continue; /* an exponent, then the torque, changed by 1 % */
        least_other = fmin(least_other, product_error(&l, r.k, 1.01));
        r.torque = 1.01;
        follow(&r, random, &l);
        least_torque = fmin(least_torque, trace_error(l.A, r.k) + trace_error(l.B, r.k));
    }
    laws_report(&product, "A_00 A_11 = 4 cos^2(pi/(2k))/(2 - T) on random loops");
    laws_report(&traces, "(tr A)^2 = 4 cos^2(pi/(2k)) det A, and B");
    laws_report(&closed, "M = A B, det M = 1");
    laws_report(&hill, "the real half turn is that of Hill's equation");
    gsl_test(!(least_other > 1e-6), "an exponent changed by 1 %% is seen: %.1e", least_other);
    gsl_test(!(least_torque > 1e-6), "a torque changed by 1 %% is seen: %.1e", least_torque);
    iso_random_free(random);
}

/* A is antidiagonal where 1/k is odd, and nowhere else. */
static void check_zeros(void)
{
    iso_random *random = iso_random_create(36);
    double most = 0, least = INFINITY;
    for (int i = 0; i < tests_length(2, 10); i++)
        for (int eighths = -41; eighths <= 41; eighths += 1) {
            if (eighths == 0) continue;
            double J[3];
            matrix A;
            loops l;
            draw(random, J);
            const rotation r = rotation_of(8. / eighths, J);
            const bool odd = eighths % 8 == 0 && eighths / 8 % 2 != 0;
            follow(&r, random, &l);
            const double size = in_eigenbasis(l.M, l.A, A);
            const double diagonal = fmax(cabs(A[0][0]), cabs(A[1][1])) / size;
            if (odd) most = fmax(most, diagonal);
            if (!odd) least = fmin(least, diagonal);
        }
    gsl_test(!(most < 1e-8), "1/k odd: A is antidiagonal, to %.1e", most);
    gsl_test(!(least > 1e-3), "1/k not odd, from -5 to 5: A is not, by %.1e", least);
    iso_random_free(random);
}

int main(void)
{
    check_loops();
    check_zeros();
    return gsl_test_summary();
}

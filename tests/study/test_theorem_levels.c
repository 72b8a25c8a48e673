/* The theorem of doc/why_only_one.md off the level H = 0, by Hill's equation of theory.md, section 12, in complex
 * phi, for 1/k = N a whole number, eps = 1. 1/k even: a loop whose matrix has one eigenvalue and is not diagonal. 1/k
 * odd: loops round zeros of phi'^2, whose square is 1; antidiagonal at k = 1 and -1 alone.
 */
#include "base/math_impl.h"
#include "complex_paths.h"
#include "laws.h"

typedef struct problem {
    int N;
    double J[3], energy;
} problem;

static complex_number whole_power(complex_number q, int n)
{
    complex_number power = 1;
    for (int i = 0; i < (n < 0 ? -n : n); i++) power *= q;
    return n < 0 ? 1 / power : power;
}

/* (q + u) y'' = q' N/2 y' - (N (J2 - (1 - 1/N) q) + u) y, u = E q^(1 + N) */
static void slope(const void *data, complex_number phi, const complex_number y[], complex_number dy[])
{
    const problem *f = data;
    const complex_number c = ccos(phi), q = f->J[2] + (f->J[0] - f->J[2]) * c * c,
                         u = f->energy * whole_power(q, 1 + f->N);
    const complex_number turn = (f->J[2] - f->J[0]) * csin(2 * phi) * f->N / 2;
    const complex_number pull = f->N * (f->J[1] - q) + q + u;
    for (int i = 0; i < 4; i += 2) {
        dy[i] = y[i + 1];
        dy[i + 1] = (turn * y[i + 1] - pull * y[i]) / (q + u);
    }
}

/* m is carried along a straight line, in steps that are a small part of the way. */
static void along(const problem *f, complex_number from, complex_number to, matrix m)
{
    enum { STEPS = 6000 };
    const complex_number h = (to - from) / STEPS;
    complex_number y[4] = {m[0][0], m[1][0], m[0][1], m[1][1]};
    for (int i = 0; i < STEPS; i++) path_runge_kutta(slope, f, 4, from + i * h, h, y);
    m[0][0] = y[0], m[1][0] = y[1], m[0][1] = y[2], m[1][1] = y[3];
}

/* Round a point, from 0: along the real axis, slantwise up to a small circle, once round, and the same way back. */
static void round_point(const problem *f, complex_number point, matrix m)
{
    enum { CORNERS = 12 };
    const double radius = 0.1 * fmin(1, cimag(point)), side = creal(point) - 0.23;
    const complex_number up = (point - side) / cabs(point - side), start = point - radius * up;
    m[0][0] = m[1][1] = 1;
    m[0][1] = m[1][0] = 0;
    along(f, 0, side, m);
    along(f, side, start, m);
    for (int i = 0; i < CORNERS; i++)
        along(f, point + (start - point) * cexp(2 * I * ISO_PI * i / CORNERS),
              point + (start - point) * cexp(2 * I * ISO_PI * (i + 1) / CORNERS), m);
    along(f, start, side, m);
    along(f, side, 0, m);
}

static void half_turn(const problem *f, double height, matrix m)
{
    m[0][0] = m[1][1] = 1;
    m[0][1] = m[1][0] = 0;
    if (height > 0) along(f, 0.4, 0.4 + I * height, m);
    along(f, 0.4 + I * height, ISO_PI + 0.4 + I * height, m);
    if (height > 0) along(f, ISO_PI + 0.4 + I * height, ISO_PI + 0.4, m);
}

/* The upper phi with this q, in 0 <= Re phi < pi. */
static complex_number place_of(const problem *f, complex_number q)
{
    const double mean = (f->J[0] + f->J[2]) / 2, half = (f->J[0] - f->J[2]) / 2;
    complex_number phi = cacos((q - mean) / half) / 2;
    if (cimag(phi) < 0) phi = -phi;
    return creal(phi) < 0 ? phi + ISO_PI : phi;
}

/* Whether m, of determinant 1, has one eigenvalue, and by how much it is not diagonal. */
static void look_at_even(const problem *f, double *eigenvalue, double *off)
{
    matrix m;
    if (f->N > 0)
        round_point(f, place_of(f, 0), m);
    else
        half_turn(f, 3, m);
    const complex_number trace = m[0][0] + m[1][1];
    const double size = cabs(m[0][0]) + cabs(m[0][1]) + cabs(m[1][0]) + cabs(m[1][1]);
    *eigenvalue = fmax(*eigenvalue, cabs(trace * trace / det(m) - 4) / (size * size));
    *off = fmin(*off, (cabs(m[0][1]) + cabs(m[1][0]) + cabs(m[0][0] - m[1][1])) / size);
}

/* The product of the diagonal of the loops round zeros of phi'^2, q^N = -1/E, in the basis of the half turn. Those
 * for which it is neither 0 nor 1 obstruct: the largest distance from 0 and 1. */
static double look_at_odd(const problem *f, double *trace)
{
    const int N = abs(f->N);
    double most = 0;
    matrix M, m, A;
    half_turn(f, 0, M);
    for (int i = 0; i < N; i++) {
        const double turn = ISO_PI * (2 * i + (f->energy > 0)) / f->N;
        round_point(f, place_of(f, pow(fabs(f->energy), -1. / f->N) * cexp(I * turn)), m);
        along(f, 0, 0.4, m); /* from the base point of M */
        matrix back = {{1, 0}, {0, 1}}, at;
        along(f, 0.4, 0, back);
        for (int a = 0; a < 2; a++)
            for (int b = 0; b < 2; b++) at[a][b] = m[a][0] * back[0][b] + m[a][1] * back[1][b];
        in_eigenbasis(M, at, A);
        const complex_number by = A[0][0] * A[1][1];
        const double size = cabs(at[0][0]) + cabs(at[0][1]) + cabs(at[1][0]) + cabs(at[1][1]);
        *trace = fmax(*trace, cabs(at[0][0] + at[1][1]) / size);
        most = fmax(most, fmin(cabs(by), cabs(by - 1)));
    }
    return most;
}

static void draw(iso_random *random, problem *f)
{
    draw_between(random, iso_random_uniform(random, 0.7, 1.5), 1.2, 1.6, f->J);
    /* levels on which the whole circle is allowed: E > -V */
    const double lowest = fmin(pow(f->J[0], -f->N), pow(f->J[2], -f->N));
    f->energy = lowest * iso_random_uniform(random, -0.9, 2);
}

int main(void)
{
    static const int even[] = {2, -2, 4, -4, 6}, odd[] = {3, -3, 1, -1};
    iso_random *random = iso_random_create(77);
    double eigenvalue = 0, off = INFINITY, trace = 0, integrable = 0, other = INFINITY;
    for (int i = 0; i < tests_length(2, 10); i++) {
        problem f;
        for (int j = 0; j < 5; j++) f.N = even[j], draw(random, &f), look_at_even(&f, &eigenvalue, &off);
        for (int j = 0; j < 4; j++) {
            f.N = odd[j];
            draw(random, &f);
            const double found = look_at_odd(&f, &trace);
            if (j < 2)
                other = fmin(other, found);
            else
                integrable = fmax(integrable, found);
        }
    }
    gsl_test(!(eigenvalue < 1e-7), "1/k even, off H = 0: one eigenvalue, to %.1e", eigenvalue);
    gsl_test(!(off > 1e-3), "1/k even, off H = 0: not diagonal, by %.1e", off);
    gsl_test(!(trace < 1e-7), "1/k odd: the loops round zeros of phi'^2 have the trace 0, to %.1e", trace);
    gsl_test(!(integrable < 1e-6), "k = 1, -1: they are antidiagonal, to %.1e", integrable);
    gsl_test(!(other > 1e-4), "1/k = 3, -3: one is neither diagonal nor antidiagonal, by %.1e", other);
    iso_random_free(random);
    return gsl_test_summary();
}

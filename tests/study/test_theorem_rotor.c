/* Is a ball with a rotor along its middle axis integrable (doc/why_only_one.md, "Other levels, and rotors")? To third
 * order, along loops in complex time. An integral meromorphic near the rotation begins with a power of X Y, coordinates
 * in which the full turn M is diagonal. So there is f = X Y + f4 + ..., f4 of fourth degree, which M leaves as it is,
 * and the loop B round g = 0 up to a factor. M gives f4, up to (X Y)^2. B tells whether it can be.
 *
 *     n = (r cos theta, n2, r sin theta), p = (-sin theta, 0, cos theta), v = (w, p): a state is (n2, v).
 */
#include "base/math_impl.h"
#include "complex_paths.h"
#include "laws.h"

typedef struct problem {
    double k, J[3], K; /* the rotor's momentum is (0, K, 0); the rotation is w = (0, 1, 0) */
} problem;

/* X -> diag[0] X + ..., Y -> diag[1] Y + ..., and cubic terms X^3, X^2 Y, X Y^2, Y^3. */
typedef struct jet {
    complex_number linear[2][2], cubic[2][4];
} jet;

static complex_number form(const double J[3], const complex_number a[3], const complex_number b[3])
{
    return J[0] * a[0] * b[0] + J[1] * a[1] * b[1] + J[2] * a[2] * b[2];
}

static const double one[3] = {1, 1, 1};

/* w = v p + u (p x n) on the level (w, J w) = J2, u near 1. */
static void axis_of(const problem *f, const complex_number n[3], const complex_number p[3], complex_number v,
                    complex_number w[3])
{
    complex_number b[3];
    cross3(p, n, b);
    const complex_number a = form(f->J, b, b), half = v * form(f->J, p, b);
    const complex_number root = csqrt(half * half - a * (v * v * form(f->J, p, p) - f->J[1]));
    const complex_number first = (root - half) / a, second = (-root - half) / a;
    const complex_number u = cabs(first - 1) < cabs(second - 1) ? first : second;
    for (int i = 0; i < 3; i++) w[i] = v * p[i] + u * b[i];
}

/* By theta: J w' = (J w + K) x w + lambda n, n' = k n x w. */
static void slope(const void *data, complex_number theta, const complex_number y[], complex_number dy[])
{
    const problem *f = data;
    const complex_number r = csqrt(1 - y[0] * y[0]), c = ccos(theta), s = csin(theta);
    const complex_number n[3] = {r * c, y[0], r * s}, p[3] = {-s, 0, c}, turn[3] = {-c, 0, -s};
    complex_number w[3], Jw[3], torque[3], dw[3], dn[3], lambda = 0, g = 0;
    axis_of(f, n, p, y[1], w);
    for (int i = 0; i < 3; i++) Jw[i] = f->J[i] * w[i] + (i == 1 ? f->K : 0);
    cross3(Jw, w, torque);
    for (int i = 0; i < 3; i++) lambda -= torque[i] * n[i] / f->J[i], g += n[i] * n[i] / f->J[i];
    for (int i = 0; i < 3; i++) dw[i] = (torque[i] + lambda / g * n[i]) / f->J[i];
    cross3(n, w, dn);
    const complex_number rate = f->k * (n[0] * dn[2] - n[2] * dn[0]) / (r * r);
    dy[0] = f->k * dn[1] / rate;
    dy[1] = form(one, dw, p) / rate + form(one, w, turn);
}

/* Where the loop leads from size (X, Y), in the coordinates of the columns of V. */
static void carried(const problem *f, const complex_number corner[], int corners, matrix V, const double by[2],
                    double size, complex_number out[2])
{
    complex_number y[2];
    for (int i = 0; i < 2; i++) y[i] = size * (V[i][0] * by[0] + V[i][1] * by[1]);
    for (int i = 0; i + 1 < corners; i++) { /* along straight lines, with order 5 */
        const int steps = 20 + (int)(400 * cabs(corner[i + 1] - corner[i]));
        const complex_number h = (corner[i + 1] - corner[i]) / steps;
        for (int j = 0; j < steps; j++) path_step(slope, f, 2, corner[i] + j * h, h, y);
    }
    out[0] = (V[1][1] * y[0] - V[0][1] * y[1]) / det(V);
    out[1] = (V[0][0] * y[1] - V[1][0] * y[0]) / det(V);
}

/* Linear and cubic terms: by four directions, and three sizes. Two directions: the linear terms alone. */
static jet jet_of(const problem *f, const complex_number corner[], int corners, matrix V, int directions)
{
    static const double direction[4][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
    const double size = 0.002;
    complex_number third[4][2] = {{0}}, first[2][2];
    jet found;
    for (int d = 0; d < directions; d++) {
        complex_number at[3][2];
        for (int i = 0; i < 3; i++) carried(f, corner, corners, V, direction[d], size * (i + 1), at[i]);
        for (int c = 0; c < 2; c++) { /* a s + b s^3 + c s^5 through three points */
            const complex_number s1 = at[0][c] / size, s2 = at[1][c] / (2 * size), s3 = at[2][c] / (3 * size);
            const complex_number d1 = (s2 - s1) / 3, d2 = (s3 - s2) / 5, e = (d2 - d1) / 8;
            third[d][c] = (d1 - 5 * e) / (size * size);
            if (d < 2) first[d][c] = s1 - d1 + 4 * e;
        }
    }
    for (int c = 0; c < 2; c++) {
        const complex_number even = (third[2][c] + third[3][c]) / 2, odd = (third[2][c] - third[3][c]) / 2;
        for (int d = 0; d < 2; d++) found.linear[c][d] = first[d][c];
        found.cubic[c][0] = third[0][c];
        found.cubic[c][1] = odd - third[1][c];
        found.cubic[c][2] = even - third[0][c];
        found.cubic[c][3] = third[1][c];
    }
    return found;
}

/* The terms of fourth degree that a loop makes of X Y: X^4, X^3 Y, ... */
static void product_of(const jet *j, complex_number out[5])
{
    for (int i = 0; i < 5; i++) {
        out[i] = 0;
        for (int c = 0; c < 2; c++) {
            if (i < 4) out[i] += j->linear[c][0] * j->cubic[1 - c][i];
            if (i > 0) out[i] += j->linear[c][1] * j->cubic[1 - c][i - 1];
        }
    }
}

/* What of f = X Y + f4 the loop B changes, in its best case, by the size of the terms. */
static double change_of(const problem *f, iso_random *random, double *twist, double *diagonal)
{
    enum { ROUND = 9 };
    const double height = atanh(sqrt(fmin(f->J[0], f->J[2]) / fmax(f->J[0], f->J[2])));
    const complex_number zero = (f->J[0] < f->J[2] ? ISO_PI / 2 : 0) + I * height;
    const complex_number base = creal(zero) - iso_random_uniform(random, 1, 2), turn[2] = {base, base + 2 * ISO_PI};
    complex_number round[ROUND + 3] = {base}, V[2][2] = {{1, 0}, {0, 1}}, made[5], by[5], f4[5] = {0};
    for (int i = 0; i <= ROUND; i++)
        round[i + 1] = zero + 0.6 * fmin(1, height) * cexp(I * (-2.3 + 2 * ISO_PI * i / ROUND));
    round[ROUND + 2] = base;
    jet M = jet_of(f, turn, 2, V, 2);
    const complex_number half = (M.linear[0][0] + M.linear[1][1]) / 2, root = csqrt(half * half - 1);
    for (int c = 0; c < 2; c++) { /* an eigenvector of length 1 */
        const complex_number x = M.linear[0][1], y = half + (c ? -root : root) - M.linear[0][0];
        const double length = hypot(cabs(x), cabs(y));
        V[0][c] = x / length;
        V[1][c] = y / length;
    }
    M = jet_of(f, turn, 2, V, 4);
    const jet B = jet_of(f, round, ROUND + 3, V, 4);
    const complex_number b = B.linear[0][1], c = B.linear[1][0], factor = b * c;
    product_of(&M, made);
    product_of(&B, by);
    double size = 0, most = 0;
    for (int i = 0; i < 5; i++) {
        if (i != 2) f4[i] = made[i] / (1 - cpow(M.linear[0][0], 4 - 2 * i));
        size = fmax(size, fmax(cabs(f4[i]), cabs(by[i])));
    }
    for (int i = 0; i < 5; i++) {
        const complex_number moved = f4[4 - i] * cpow(b, i) * cpow(c, 4 - i);
        most = fmax(most, cabs(by[i] + moved - factor * f4[i]));
    }
    *twist = fmax(*twist, cabs(made[2]) / size);
    *diagonal = fmax(*diagonal, cabs(B.linear[0][0]) + cabs(B.linear[1][1]) + cabs(factor - 1));
    return most / size;
}

/* J2 in the middle, and J2 + K too. */
static void draw(iso_random *random, problem *f)
{
    draw_between(random, 1, 1.25, 1.6, f->J);
    const double up = f->J[1], most = fmax(f->J[0], f->J[2]);
    f->K = iso_random_uniform(random, 0.3, 0.8) * (up - 1) * (iso_random_uniform(random, 0, 1) < 0.5 ? 1 : -1);
    if (f->K > 0) f->K *= (most - up) / (up - 1);
}

int main(void)
{
    iso_random *random = iso_random_create(88);
    double twist = 0, diagonal = 0, known = 0, shell = INFINITY;
    for (int i = 0; i < tests_length(2, 10); i++) {
        problem f = {.k = -1};
        draw(random, &f);
        shell = fmin(shell, change_of(&f, random, &twist, &diagonal));
        f.k = 1;
        known = fmax(known, change_of(&f, random, &twist, &diagonal));
        f.k = -1;
        f.K = 0;
        known = fmax(known, change_of(&f, random, &twist, &diagonal));
    }
    gsl_test(!(twist < 1e-5), "the full turn M leaves X Y + f4 as it is, to %.1e", twist);
    gsl_test(!(diagonal < 1e-6), "the loop B exchanges X and Y at k = 1 and -1, to %.1e", diagonal);
    gsl_test(!(known < 1e-5), "k = 1 with a rotor, k = -1 without: B as well, to %.1e", known);
    gsl_test(!(shell > 1e-3), "k = -1 with a rotor: B does not, by %.1e", shell);
    iso_random_free(random);
    return gsl_test_summary();
}

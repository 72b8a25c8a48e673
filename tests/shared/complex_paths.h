/* complex_paths.h - orbits along paths in complex time, by the method of Runge and Kutta, and matrices of loops. */
#ifndef ISO_TESTS_COMPLEX_PATHS_H
#define ISO_TESTS_COMPLEX_PATHS_H

#include <complex.h>
#include <math.h>

#include "base/random_impl.h"

typedef double complex complex_number;
typedef complex_number matrix[2][2];

enum { PATH_MOST = 6 }; /* numbers of a state */

/* dy/dt at (t, y); f: what the equations need to know. */
typedef void path_slope(const void *f, complex_number t, const complex_number y[], complex_number dy[]);

static inline void cross3(const complex_number a[3], const complex_number b[3], complex_number c[3])
{
    for (int i = 0; i < 3; i++) c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* A step h of order 4. */
static inline void path_runge_kutta(path_slope *slope, const void *f, int count, complex_number t, complex_number h,
                                    complex_number y[])
{
    static const double at[4] = {0, 0.5, 0.5, 1}, weight[4] = {1 / 6., 1 / 3., 1 / 3., 1 / 6.};
    complex_number stage[PATH_MOST], dy[PATH_MOST] = {0}, sum[PATH_MOST] = {0};
    for (int s = 0; s < 4; s++) {
        for (int i = 0; i < count; i++) stage[i] = y[i] + at[s] * h * dy[i];
        slope(f, t + at[s] * h, stage, dy);
        for (int i = 0; i < count; i++) sum[i] += weight[s] * dy[i];
    }
    for (int i = 0; i < count; i++) y[i] += h * sum[i];
}

/* A step h of order 5: one step of order 4, and two halves. */
static inline void path_step(path_slope *slope, const void *f, int count, complex_number t, complex_number h,
                             complex_number y[])
{
    complex_number rough[PATH_MOST];
    for (int i = 0; i < count; i++) rough[i] = y[i];
    path_runge_kutta(slope, f, count, t, h, rough);
    path_runge_kutta(slope, f, count, t, h / 2, y);
    path_runge_kutta(slope, f, count, t + h / 2, h / 2, y);
    for (int i = 0; i < count; i++) y[i] += (y[i] - rough[i]) / 15;
}

/* Moments of which the second is between the others, in either order: the least, and the ratios of neighbours. */
static inline void draw_between(iso_random *random, double least, double low, double high, double J[3])
{
    const double middle = least * iso_random_uniform(random, low, high);
    const double most = middle * iso_random_uniform(random, low, high);
    const bool turn = iso_random_uniform(random, 0, 1) < 0.5;
    J[0] = turn ? most : least;
    J[1] = middle;
    J[2] = turn ? least : most;
}

/* --- matrices of loops ------------------------------------------------------------------------------------------ */

static inline complex_number det(matrix m)
{
    return m[0][0] * m[1][1] - m[0][1] * m[1][0];
}

/* m in the basis of the eigenvectors of M, by the root of its determinant. Gives the norm of the work. */
static inline double in_eigenbasis(matrix M, matrix m, matrix out)
{
    const complex_number half = (M[0][0] + M[1][1]) / 2, root = csqrt(half * half - 1);
    matrix V = {{M[0][1], M[0][1]}, {half + root - M[0][0], half - root - M[0][0]}};
    const complex_number d = det(V), scale = csqrt(det(m));
    double size = 0;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            out[i][j] = 0;
            for (int a = 0; a < 2; a++)
                for (int b = 0; b < 2; b++) {
                    const complex_number inverse = (i == a ? V[1 - i][1 - i] : -V[i][a]) / d;
                    const complex_number term = inverse * m[a][b] * V[b][j] / scale;
                    out[i][j] += term;
                    size = fmax(size, cabs(term));
                }
        }
    return 1 + size;
}

#endif

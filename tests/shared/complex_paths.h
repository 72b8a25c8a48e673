/* complex_paths.h - orbits along paths in complex time, by the method of Runge and Kutta. */
#ifndef ISO_TESTS_COMPLEX_PATHS_H
#define ISO_TESTS_COMPLEX_PATHS_H

#include <complex.h>

typedef double complex complex_number;

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

#endif

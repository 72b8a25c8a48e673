/* vectors.h - vectors of R^3 as double[3]. */
#ifndef ISOROLL_PLOT_VECTORS_H
#define ISOROLL_PLOT_VECTORS_H

#include <math.h>
#include <string.h>

static inline double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double norm(const double a[3])
{
    return sqrt(dot(a, a));
}

/* c = a x b; c must be neither a nor b. */
static inline void cross(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void scale(double a[3], double factor)
{
    for (int i = 0; i < 3; i++) a[i] *= factor;
}

static inline void copy(const double *from, double *to, int count)
{
    memcpy(to, from, (size_t)count * sizeof *to);
}

#endif

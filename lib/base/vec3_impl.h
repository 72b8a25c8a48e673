/* vec3_impl.h - vectors of R^3 as double[3]; short names, because the formulas should read like the paper. */
#ifndef ISO_BASE_VEC3_IMPL_H
#define ISO_BASE_VEC3_IMPL_H

#include <math.h>

static inline double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* (a, diag(d) b): every quadratic form of this problem is diagonal in the ball's principal axes. */
static inline double dot_diag(const double a[3], const double d[3], const double b[3])
{
    return a[0] * d[0] * b[0] + a[1] * d[1] * b[1] + a[2] * d[2] * b[2];
}

/* c = a x b; c must be neither a nor b. */
static inline void cross(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/* c = diag(d) a */
static inline void diag(const double d[3], const double a[3], double c[3])
{
    for (int i = 0; i < 3; i++) c[i] = d[i] * a[i];
}

static inline double norm(const double a[3])
{
    return sqrt(dot(a, a));
}

/* the angle between a and b, from 0 to pi, also where it is small */
static inline double angle_between(const double a[3], const double b[3])
{
    double c[3];
    cross(a, b, c);
    return atan2(norm(c), dot(a, b));
}

/* the largest component in size: squares of it need not fit a double */
static inline double largest(const double a[3])
{
    return fmax(fabs(a[0]), fmax(fabs(a[1]), fabs(a[2])));
}

static inline double max3(const double a[3])
{
    return fmax(a[0], fmax(a[1], a[2]));
}

static inline double min3(const double a[3])
{
    return fmin(a[0], fmin(a[1], a[2]));
}

/* The axes in ascending order of a; equal ones stay as they are. */
static inline void sort_by(const double a[3], int axis[3])
{
    for (int i = 0; i < 3; i++) axis[i] = i;
    for (int pass = 0; pass < 3; pass++) {
        const int i = pass % 2, first = axis[i], second = axis[i + 1];
        if (a[first] > a[second]) axis[i] = second, axis[i + 1] = first;
    }
}

/* a += f b */
static inline void add_scaled(double a[3], double f, const double b[3])
{
    for (int i = 0; i < 3; i++) a[i] += f * b[i];
}

static inline void scale(double a[3], double f)
{
    for (int i = 0; i < 3; i++) a[i] *= f;
}

static inline void copy(const double *from, double *to, int count)
{
    for (int i = 0; i < count; i++) to[i] = from[i];
}

/* |a - b| / max(|a|, |b|), 0 for a = b = 0; squares of components may overflow. Powers of two round nothing. */
static inline double relative_difference(const double a[3], const double b[3])
{
    const double size = fmax(largest(a), largest(b));
    if (size == 0) return 0;
    int power = 0;
    double d[3], u[3], v[3];
    frexp(size, &power);
    for (int i = 0; i < 3; i++) {
        u[i] = ldexp(a[i], -power);
        v[i] = ldexp(b[i], -power);
        d[i] = u[i] - v[i];
    }
    return norm(d) / fmax(norm(u), norm(v));
}

/* Makes a a unit vector and returns its old length. */
static inline double make_unit(double a[3])
{
    const double length = norm(a);
    scale(a, 1 / length);
    return length;
}

/* Takes the part along the unit vector u out of a, and returns that part. */
static inline double remove_along(double a[3], const double u[3])
{
    const double part = dot(a, u);
    add_scaled(a, -part, u);
    return part;
}

#endif

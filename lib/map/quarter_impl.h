/* quarter_impl.h - angles with a given density, by inversion of its integral.
 *
 * The density is symmetric about 0 and pi/2. The table holds its integral over a quarter of the circle. The variable
 * is u, tan(angle) = e^u, in steps of 1/2, |u| <= 46; the rest of the integral is 1e-20. Let the density be made of
 * powers of A cos^2 + B sin^2 with A, B >= 0. Then its singularities in the complex plane of u are pi/2 or more away
 * from the real line, for every A/B. So Gauss's rule of 8 points in each step is exact to rounding.
 */
#ifndef ISO_MAP_QUARTER_IMPL_H
#define ISO_MAP_QUARTER_IMPL_H

#include <stdint.h>

enum { ISO_QUARTER_STEPS = 184 };

/* The density is value[0] + mix value[1]. `part`: a table of ISO_QUARTER_STEPS + 1 integrals of each of the two. */
typedef struct iso_quarter {
    /* d(integral)/du at sin^2 and cos^2 of the angle; d(angle)/du = sin cos */
    void (*density)(const void *data, double sin2, double cos2, double value[2]);
    const void *data;
    const double *part[2];
    double mix;
} iso_quarter;

/* Fills the two tables, which start at u = -46. */
void iso_quarter_tabulate(void (*density)(const void *data, double sin2, double cos2, double value[2]),
                          const void *data, double *part[2]);

/* The angle in (-pi, pi) below which this part of the integral over the circle lies; part is in (0, 1). */
double iso_quarter_angle(const iso_quarter *q, double part);

#endif

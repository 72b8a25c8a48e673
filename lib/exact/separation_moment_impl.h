/* separation_moment_impl.h - a state of the separated problem, and what follows from it. Used by separation.c. */
#ifndef ISO_EXACT_SEPARATION_MOMENT_IMPL_H
#define ISO_EXACT_SEPARATION_MOMENT_IMPL_H

#include "exact/separation_impl.h"

enum { U, V };           /* the coordinates         */
enum { AL = 3, BE = 4 }; /* roots beyond b1, b2, b3 */

/* A state in the sorted axes, and what follows from it. */
typedef struct separation_moment {
    real gamma[3], M[3];
    real gap;        /* v - u                                   */
    real z[2];       /* u and v                                 */
    real from[2][3]; /* |b_i - u| and |b_i - v|                 */
    real rate[2];    /* u' and v' of (6), with their signs      */
} separation_moment;

/* Sorts the axes: sets s->axis, b, off, handed and norm. s->k is given. */
void iso_separation_sort_axes(separation *s, const double J[3]);

/* gamma and M in long double and in the order of b. They are put on |gamma| = 1 and (M,gamma) = 0 and, if the level
 * is H = 0, also on that level. The signs of M's components are those of the caller's axes. */
void iso_separation_read(const separation *s, const double point[ISO_STATE], separation_moment *m);

/* The constants of the orbit through a state: sets s->c, distance, unstable, to_al, to_be, width, and m->gap. Where
 * u and v are nearly equal, the state is first carried on for a short time, which s->before then holds. */
void iso_separation_find_constants(separation *s, separation_moment *m);

/* u, v, their distances from b1, b2, b3 and their rates. False: u = v, and there are no such coordinates. */
bool iso_separation_find_coordinates(const separation *s, separation_moment *m);

/* x and y from their sum, their product and, for the signs and to a few digits, their difference. The larger one is
 * found first and the smaller one by division, so both keep all digits. */
void iso_separation_split(real sum, real product, real difference, real *x, real *y);

/* d clock/ds at a point with this q: tau' = (det J/k^2) q^(-1/k) and t' = (det J/k^2) q^(-1 - 1/(2k)), for k = 1 and
 * k = -1. */
real iso_separation_clock_rate(const separation *s, iso_clock clock, real q);

#endif

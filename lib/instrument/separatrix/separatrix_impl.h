/* separatrix_impl.h - what the files of the splitting share: the unstable manifold of the middle axis' rotation.
 *
 *     separatrix_manifold.c  the manifold near its fixed point, as a polynomial
 *     separatrix_crossing.c  the manifold farther out, and where it crosses its symmetry lines
 *     separatrix.c           one k, with its error
 *     separatrix_scan.c      many k, and the zeros between them
 *     separatrix_study.c     what is typed, and the table
 *
 * Coordinates are z = (u, x): u = l - l0, so that the fixed point is 0. The map is g, half a return
 * (return_map_impl.h). Here lambda is its multiplier, the square root of iso_separatrix_splitting.lambda. It is above
 * 1, because the half-turn trace of the middle axis is below -2 (lib/doc/theory.md) and g turns its sign over. g and
 * z -> -z commute.
 */
#ifndef ISO_INSTRUMENT_SEPARATRIX_SEPARATRIX_IMPL_H
#define ISO_INSTRUMENT_SEPARATRIX_SEPARATRIX_IMPL_H

#include <stdbool.h>
#include <stddef.h>

#include "base/number_impl.h"
#include "instrument/separatrix/separatrix.h"
#include "method/wide_impl.h"

enum { ISO_MANIFOLD_TERMS = 24, ISO_MANIFOLD_TERMS_64 = 12 }; /* room; those that suit 64 bits */

/* W(theta) = theta (v r + y sum_i c_i T*_i(y)), y = theta^2, |theta| <= 1, T*_i(y) = cos(i acos(2y - 1)): an odd
 * polynomial with g(W(theta)) = W(lambda theta). v: the unstable direction, v_u > 0, |v| = 1; r: the domain. */
typedef struct iso_manifold {
    iso_context *ctx; /* its monitor is asked at each half return */
    iso_problem problem;
    iso_model model;
    const iso_return_build *code;
    int axis, terms;
    double level, zeros, tolerance;
    iso_wide corner; /* l0 */
    iso_wide lambda, v[2], size, c[2][ISO_MANIFOLD_TERMS];
    double rate; /* |c_(i+1)/c_i|, about */
} iso_manifold;

/* A place on the manifold and its derivative by theta. */
typedef struct iso_manifold_point {
    iso_wide theta, z[2], t[2];
} iso_manifold_point;

/* Where the manifold meets a line of symmetry, after `halves` of g from theta in (1/lambda, 1]. */
typedef struct iso_manifold_crossing {
    int halves;
    iso_wide theta, z[2];
    iso_wide slope;    /* half the difference of the slopes dx/du of both manifolds */
    double scatter[2]; /* how far rounding moves x and the slope                     */
} iso_manifold_crossing;

/* Other numbers: lambda and v anew, and the polynomial stays as a first guess. */
iso_status iso_manifold_use(iso_manifold *m, const iso_return_build *code);

/* Finds the polynomial on the domain m->size with m->terms terms, from the c that there are. */
iso_status iso_manifold_solve(iso_manifold *m);

/* Another domain: the coefficients are 0 again. */
void iso_manifold_resize(iso_manifold *m, iso_wide size, int terms);

/* g^halves(W(theta)). |theta| <= 1. */
iso_status iso_manifold_at(const iso_manifold *m, iso_wide theta, int halves, iso_manifold_point *p);

/* One more half return. */
iso_status iso_manifold_go_on(const iso_manifold *m, iso_manifold_point *p);

/* Checks k, J and the level; finds lambda, v, and in numbers of 64 bits the polynomial on the domain that suits them.
 * Errors: as iso_separatrix_at. */
iso_status iso_manifold_find(iso_context *ctx, double k, const double J[3], double level, iso_manifold *m);

/* The first crossing with the line u = pi/2: roughly, then to the last digit from a guess. */
iso_status iso_manifold_first(const iso_manifold *m, iso_manifold_crossing *c);
iso_status iso_manifold_refine(const iso_manifold *m, iso_manifold_crossing *c);

/* The next point where the manifolds meet, between that and its image. */
iso_status iso_manifold_next(const iso_manifold *m, const iso_manifold_crossing *from, iso_manifold_crossing *c);

/* Records why the splitting at this k is not found, ISO_NUMERICAL. */
static inline iso_status iso_manifold_lost(const iso_manifold *m, const char *why)
{
    return ISO_FAIL_NUMERICAL(m->ctx, "splitting at k = %s: %s", ISO_SHORT(m->problem.p.k), why);
}

/* angle, less whole turns. */
static inline iso_wide iso_wide_turned(iso_wide angle)
{
    return iso_wide_wrap(angle, 2 * WIDE_PI);
}

/* iso_separatrix_at, and with `next` the next crossing as well. */
iso_status iso_separatrix_next_at(iso_context *ctx, double k, const double J[3], double level,
                                  iso_separatrix_digits digits, bool next, iso_separatrix_splitting *s);

#endif

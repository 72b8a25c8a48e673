/* separation_impl.h - the free problem for k = 1 (on H = 0) and k = -1 in sphero-conical coordinates u <= v of gamma.
 *
 * With b = J (k = -1) or 1/J (k = 1), ascending, and D = b1 b2 b3,
 *
 *     k = -1:  q = b1 + b2 + b3 - u - v,   R(z) = eps z (b1 + b2 + b3 - z) + H z
 *     k = 1:   q = u v/D,                  R(z) = -eps D/z
 *
 *     (dz/dsigma)^2 = 8 A(z) (R(z) + c),   A(z) = (b1-z)(b2-z)(b3-z),   z = u and z = v,   ds = (v - u) dsigma.
 *
 * The roots of R + c are al and, at k = -1, be > al. The motion is bounded by b1 <= u <= min(al, b2) and
 * max(al, b2) <= v <= min(be, b3). At the moments R + c is, without cancellation near principal planes,
 *
 *     R(b_j) + c = (1/2) sum_i (b_j - b_i) M_i^2 - E_j (b_j - b_k)(b_j - b_l) gamma_j^2,   E_j = {eps | eps/(q b_j)}
 *
 * and from there on distances between roots are carried, never their differences taken. Two separatrices: al = b2,
 * and at k = -1 be = b3.
 */
#ifndef ISO_EXACT_SEPARATION_IMPL_H
#define ISO_EXACT_SEPARATION_IMPL_H

#include "exact/oscillation_impl.h"
#include "model/system.h"

enum { SEPARATION_ROOTS = 5 }; /* b1, b2, b3, al, be */

/* What a root is to an oscillation. */
typedef enum root_role { ROOT_SN, ROOT_CN, ROOT_DN, ROOT_BASE, ROOT_REST, ROOT_NONE } root_role;

typedef struct separation {
    int k, axis[3], handed;  /* axis[i]: the caller's axis with b[i]; 1: axes are right-handed       */
    int unstable;            /* on a separatrix: the caller's axis of its rotation; else -1          */
    real before[ISO_CLOCKS]; /* clocks at sigma = 0                                                  */
    real b[3], off[3];       /* b_i, and b_i - b2: u and v are counted from b2                       */
    real eps, energy, c, distance, det;
    real to_al[3], to_be[3], width; /* b_j - al; be - b_j; be - al (k = 1: infinite)                        */
    bool librates_low, below_b3;    /* al < b2: u turns at al, else v does; be < b3: v turns there, not at b3 */
    oscillation coordinate[2];      /* u, v                                                                 */
    root_role role[2][SEPARATION_ROOTS];
    double size[2][SEPARATION_ROOTS]; /* what goes with sn, cn, dn or 1; of a rest its distance from cn's root */
    double norm[3], gap, sign[3];     /* sqrt(product of |b_i - b_j|); of the roots between u and v; of gamma */
} separation;

/* From (M, gamma). The caller always releases both oscillations. False: too many terms would be needed. */
bool iso_separation_make(separation *s, const iso_problem *problem, const double point[ISO_STATE]);

/* (M, gamma) at the angles of u and v. */
void iso_separation_state(const separation *s, const real theta[2], double point[ISO_STATE]);

/* d clock/ds at a point with this q: tau' = (det J/k^2) q^(-1/k) and t' = (det J/k^2) q^(-1 - 1/(2k)), for k = 1 and
 * k = -1. */
real iso_separation_clock_rate(const separation *s, iso_clock clock, real q);

#endif

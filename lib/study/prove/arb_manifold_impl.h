/* arb_manifold_impl.h - the rotation O about the middle axis and its unstable manifold, from O to the line l = pi/2. */
#ifndef ISO_STUDY_PROVE_ARB_MANIFOLD_IMPL_H
#define ISO_STUDY_PROVE_ARB_MANIFOLD_IMPL_H

#include "study/prove/arb_flow_impl.h"

/* Near O: (l, x) = (xi + eta, s (xi - eta)). For |xi| <= size the unstable manifold is eta = e(xi) with a slope of at
 * most `slope`. */
typedef struct prove_local {
    arb_t trace, lambda; /* of the half return's derivative at O: its trace, its eigenvalue > 1 */
    arb_t s, size;       /* exact */
    arb_t slope;
} prove_local;

/* Where the manifold meets l = pi/2: start xi (exact), and the number of half returns from there. */
typedef struct prove_start {
    arb_t xi;
    long halves;
} prove_start;

/* What is enclosed at the end. */
typedef struct prove_crossing {
    arb_t x, m; /* of the section n_c = 0 */
} prove_crossing;

/* O and its frame. Errors: those of prove_half_return; ISO_NUMERICAL: O is not hyperbolic in these digits. */
iso_status prove_local_begin(prove_flow *f, prove_local *o);

/* The cone condition on |xi|, |eta| <= size. */
iso_status prove_local_bound(prove_flow *f, prove_local *o);

/* Looks for the start, 0 < xi < o->size, without a proof. */
iso_status prove_search(const prove_flow *f, const prove_local *o, prove_start *start);

/* Follows the piece |xi/start - 1| <= width. *reached: it crosses l = pi/2. */
iso_status prove_follow(prove_flow *f, const prove_local *o, const prove_start *start, const arb_t width,
                        prove_crossing *crossing, bool *reached);

#endif

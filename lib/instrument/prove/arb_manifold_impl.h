/* arb_manifold_impl.h - the rotation O about the middle axis and its unstable manifold, from O to the line l = pi/2. */
#ifndef ISO_INSTRUMENT_PROVE_ARB_MANIFOLD_IMPL_H
#define ISO_INSTRUMENT_PROVE_ARB_MANIFOLD_IMPL_H

#include "instrument/prove/arb_flow_impl.h"

/* Near O: (l, x) = (xi + eta, s (xi - eta)). For |xi| <= size the unstable manifold is eta = e(xi) with a slope of at
 * most `slope`. */
typedef struct prove_local {
    arb_t lambda;  /* of the half return's derivative at O: its eigenvalue > 1 */
    arb_t s, size; /* exact */
    arb_t slope;
} prove_local;

/* Where the manifold meets l = pi/2: start xi (exact), and the number of half returns from there. For another k the
 * start is xi + drift dk, about. */
typedef struct prove_start {
    arb_t xi, drift;
    long halves;
} prove_start;

/* What is enclosed at the end. */
typedef struct prove_crossing {
    arb_t x, m;   /* of the section n_c = 0                                                      */
    slong longer; /* if it is not enclosed: a piece 2^longer times as long may do; 0: none would */
} prove_crossing;

/* x = M v + offset; NULL: 0. X = M N. The result may be one of the others. */
void prove_apply(const arb_struct M[4], const arb_struct v[2], const arb_struct *offset, slong bits, arb_struct x[2]);
void prove_multiply(const arb_struct M[4], const arb_struct N[4], slong bits, arb_struct X[4]);

/* O and its frame. Errors: those of prove_half_return; ISO_NUMERICAL: O is not hyperbolic in these digits. */
iso_status prove_local_begin(prove_flow *f, prove_local *o);

/* Refuses more half returns than f->work allows before they are made: from |xi| = size to l = 1, about. */
iso_status prove_local_foresee(const prove_flow *f, const prove_local *o);

/* The cone condition on |xi|, |eta| <= size. */
iso_status prove_local_bound(prove_flow *f, prove_local *o);

/* Looks for the start, 0 < xi < o->size, without a proof. */
iso_status prove_search(const prove_flow *f, const prove_local *o, bool with_drift, prove_start *start);

/* Follows the piece |xi/start - 1| <= width. one: the flow of one k of the interval of f, or f itself. *reached: it
 * crosses l = pi/2. */
iso_status prove_follow(prove_flow *f, prove_flow *one, const prove_local *o, const prove_start *start,
                        const arb_t width, prove_crossing *crossing, bool *reached);

#endif

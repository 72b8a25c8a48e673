/* arb_manifold_impl.h - the rotation O about the middle axis and its unstable manifold, from O to the line l = pi/2;
 * one proof of a ball in exact numbers. */
#ifndef ISO_STUDY_PROVE_ARB_MANIFOLD_IMPL_H
#define ISO_STUDY_PROVE_ARB_MANIFOLD_IMPL_H

#include "instrument/prove/arb_flow_impl.h"

/* Near O: (l, x) = (xi + eta, s (xi - eta)). For |xi| <= size the unstable manifold is eta = e(xi) with a slope of at
 * most `slope`. */
typedef struct prove_local {
    arb_t trace, lambda; /* of the half return's derivative at O: its trace, its eigenvalue > 1 */
    arb_t s, size;       /* exact */
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

/* --- one proof (arb_ball.c) ------------------------------------------------------------------------------------- */

/* All k from k[0] to k[1], both of one sign. J: that of the axis which is no part of the name, the middle one, that of
 * the section's axis. */
typedef struct prove_ball {
    fmpq_t k[2], J[3];
    int section, middle; /* axes, 0 to 2 */
} prove_ball;

typedef struct prove_found {
    arb_t x, m, multiplier; /* of the section; of a whole return */
    arb_t middle;           /* of an interval of k: the k of the centres, exact */
    int parts;              /* of half a return */
    long halves, steps;
    slong bits;
} prove_found;

/* Encloses m to 10^-digits, or less well where an interval of k allows no more. certificate: NULL, or an empty one.
 * Errors: ISO_NUMERICAL: nothing could be enclosed; ISO_STOPPED. */
iso_status prove_ball_at(iso_context *ctx, const prove_ball *ball, int digits, iso_proof_work *work,
                         prove_certificate *certificate, prove_found *found);

/* iso_proof_expect */
iso_status prove_ball_expect(iso_context *ctx, const prove_ball *ball, iso_proof_work *work, double *decades);

#endif

/* arb_ball_impl.h - one proof: a ball in exact numbers, and what is enclosed (prove.h). */
#ifndef ISO_STUDY_PROVE_ARB_BALL_IMPL_H
#define ISO_STUDY_PROVE_ARB_BALL_IMPL_H

#include "instrument/prove/arb_manifold_impl.h"

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

void prove_found_init(prove_found *f);
void prove_found_clear(prove_found *f);

/* Encloses m to 10^-digits, or less well where an interval of k allows no more. certificate: NULL, or an empty one.
 * Errors: ISO_NUMERICAL: nothing could be enclosed; ISO_STOPPED. */
iso_status prove_ball_at(iso_context *ctx, const prove_ball *ball, int digits, iso_proof_work *work,
                         prove_certificate *certificate, prove_found *found);

/* iso_proof_expect */
iso_status prove_ball_expect(iso_context *ctx, const prove_ball *ball, iso_proof_work *work, double *decades);

#endif

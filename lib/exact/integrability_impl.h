/* integrability_impl.h - what is known about further integrals of a problem: doc/why_only_one.md, "The theorem". */
#ifndef ISO_EXACT_INTEGRABILITY_IMPL_H
#define ISO_EXACT_INTEGRABILITY_IMPL_H

#include "model/effects/effects_impl.h"

typedef enum iso_integrability_kind {
    ISO_SECOND_INTEGRAL,   /* a second integral is known                                   */
    ISO_NO_INTEGRAL,       /* none that is meromorphic and independent of the energy: theorem */
    ISO_INTEGRABILITY_OPEN /* neither is known                                             */
} iso_integrability_kind;

/* "integrable", "no meromorphic integral", "open" */
const char *iso_integrability_name(iso_integrability_kind kind);

typedef struct iso_integrability {
    iso_integrability_kind kind;
    const char *why; /* static text */
} iso_integrability;

/* The largest |1/k| for which the residue of the third variation was computed: tests/prove/third_variation.py. */
enum { ISO_ODD_DONE = 21 };

/* 1/k counts as an odd integer where it differs from one by 4 rounding errors or less: k = 1/3 cannot be written in
 * binary. Two moments count as equal where the integral of a symmetric body counts as one (iso_params_symmetric). */
iso_integrability iso_integrability_of(const iso_params *p, const iso_effects *effects, bool off_level);

#endif

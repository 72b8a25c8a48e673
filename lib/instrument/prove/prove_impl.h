/* prove_impl.h - enclosures of the splitting m: what the study `prove` is asked and what it finds (lib/doc/prove.md).
 *
 * Only the files arb_*.c use Arb; a build without Arb leaves them out. All other files include this header alone.
 */
#ifndef ISO_INSTRUMENT_PROVE_PROVE_IMPL_H
#define ISO_INSTRUMENT_PROVE_PROVE_IMPL_H

#include <stdio.h>

#include "base/field.h"
#include "base/rational_impl.h"
#include "orbit/scene.h"
#include "study/options_impl.h"

enum { ISO_ENCLOSURE_TEXT = 512, ISO_PROOF_TEXT = 240 };

/* A number lies between these two doubles, and in the narrower interval of the text: "0.00614708829 +/- 2.5e-12". */
typedef struct iso_enclosure {
    double low, high;
    char text[ISO_ENCLOSURE_TEXT];
} iso_enclosure;

/* The free ball in exact numbers: all k from k[0] to k[1], both of one sign; J in the order of the scene, three
 * different numbers. */
typedef struct iso_proof_ball {
    iso_rational k[2], J[3];
} iso_proof_ball;

/* Whether it is one k, and no interval. */
static inline bool iso_proof_is_thin(const iso_proof_ball *ball)
{
    return iso_rational_same(&ball->k[0], &ball->k[1]);
}

/* What is known of one k, or of an interval of k. */
typedef struct iso_proof {
    iso_proof_ball ball;
    char exact[2 * ISO_RATIONAL_SIZE]; /* k as a fraction, or A:B                                                 */
    int middle, axis, section;         /* axes, as in iso_separatrix_splitting: m and x belong to n_axis = 0, and */
    iso_enclosure m, x, section_m;     /* section_m to n_section = 0                                              */
    iso_enclosure multiplier;          /* > 1, of a whole return, of the rotation                                 */
    int sign;                          /* of all numbers in m; 0: undecided                                       */
    int digits;                        /* that were asked for                                                     */
    long halves, steps;                /* half returns that were enclosed, and steps of Taylor series             */
    char statement[ISO_PROOF_TEXT];    /* what follows                                                            */
} iso_proof;

/* Half returns that orbits take in all attempts, those of the search among them: how many may begin, how many did. */
typedef struct iso_proof_work {
    long most, begun;
} iso_proof_work;

/* Encloses m of all these k. text: NULL, or gets the certificate, to be freed by free().
 * Errors: ISO_BAD_ARGUMENT: this build has no Arb; ISO_NUMERICAL: nothing could be enclosed, or not with so much work;
 * ISO_NO_MEMORY; ISO_STOPPED. */
iso_status iso_proof_find(iso_context *ctx, const iso_proof_ball *ball, int digits, iso_proof_work *work,
                          iso_proof *proof, char **text);

/* -log10 |m|, roughly, from the multiplier alone: no proof needs it. Errors: those of iso_proof_find. */
iso_status iso_proof_expect(iso_context *ctx, const iso_proof_ball *ball, iso_proof_work *work, double *decades);

/* Whether this build has Arb. */
bool iso_proof_is_possible(void);

/* --- the study -------------------------------------------------------------------------------------------------- */

typedef struct iso_prove_request {
    const char *k;           /* "K" or "A:B", as it is typed; NULL: the scene's       */
    int digits;              /* 0: as many as it takes                                */
    long half_returns;       /* for one k, or for one piece: no more                  */
    long pieces;             /* of an interval of k: try no more                      */
    const char *certificate; /* NULL: none is wanted; else the command's name for it  */
} iso_prove_request;

typedef struct iso_proofs {
    size_t rows;
    iso_proof *row;
    FILE *certificates; /* of all rows, one after the other, in a temporary file; NULL: not wanted */
    bool all;           /* the enclosures cover the interval of k and none holds 0; decided exactly */
    double undecided;   /* the part of an interval of k that is undecided, [0, 1], rounded */
} iso_proofs;

extern const iso_field iso_proof_fields[], iso_proofs_fields[];

/* Its text, and the lines of its table (prove_print.c). */
void iso_prove_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result);

#endif

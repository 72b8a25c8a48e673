/* tail_impl.h - the higher coefficients of a series of more digits, computed in doubles.
 *
 * Within a step the terms a_n x^n of a solution fall like tolerance^(n/order). A term that is 1e-6 of the state adds
 * to a sum of 19 digits with its first 13. So from some n on doubles are enough for coefficient n, and they are many
 * times faster than long double or 128 bits. The lower coefficients come from the compilation that needs them
 * (return_impl.h); the rows below carry them over, and those of the states back.
 *
 * This is a second way to the same coefficients. It stays: without it two of these take more than twice as long, the
 * third 1.8 times (seconds of one core, k = 1/2):
 *
 *     periodic --period 4 --polish    J = (1.4, 2.1, 3)    1.8 -> 4.0
 *     splitting --digits quad         J = (1.4, 2.1, 3)    2.8 -> 6.0
 *     the same                        J = (1, 2, 5)        2.7 -> 4.9
 */
#ifndef ISO_METHOD_TAYLOR_TAIL_IMPL_H
#define ISO_METHOD_TAYLOR_TAIL_IMPL_H

#include "model/model.h"

enum { ISO_TAIL_ORDER = 52 }; /* the highest order */

/* Coefficients of gamma, of the factors x of its acceleration and of gamma_t; of q, r, n q_n, and two powers of q: of
 * the orbit and of two deviations. A form of the point needs some of them. */
typedef struct iso_tail_rows {
    double vector[3][3][ISO_TAIL_ORDER + 3][3], number[5][3][ISO_TAIL_ORDER + 3];
} iso_tail_rows;

typedef struct iso_tail_build {
    void *(*create)(const iso_model *model, int order); /* for free(); NULL: no memory. A free point is wanted */
    /* Rows hold gamma up to coefficient from + 1, the others up to from - 1; here gamma gets all up to order + 1, and
     * q up to order. */
    void (*expand)(void *tail, int from, iso_tail_rows *rows);
} iso_tail_build;

extern const iso_tail_build iso_tail_plain, iso_tail_avx2;

/* The best that this processor can run. */
const iso_tail_build *iso_tail_build_find(void);

#endif

/* arb_tape_impl.h - differential equations written down once, solved in balls: Taylor series with a bound for the rest.
 *
 *     iso_tape f;                                               x' = y,   y' = -c x
 *     iso_tape_init(&f);
 *     const int x = iso_tape_state(&f), y = iso_tape_state(&f);
 *     iso_tape_rate(&f, x, y);
 *     iso_tape_rate(&f, y, iso_tape_scaled(&f, -c, x));
 *
 *     iso_series s;
 *     iso_series_init(&s, &f, bits, order);
 *     iso_series_expand(&s, at);                                coefficients, from the set `at`
 *     if (iso_series_bound(&s, h)) iso_series_at(&s, t, to);    the set to which they come, |t| <= h
 *
 * A tape has nodes. A state is a node, and each other node is made of nodes before it, so that coefficient n of all of
 * them follows from coefficients up to n of the states; the rates then give coefficient n + 1 of the states. A node is
 * named by its number. The same node may be used many times.
 */
#ifndef ISO_METHOD_ENCLOSURE_ARB_TAPE_IMPL_H
#define ISO_METHOD_ENCLOSURE_ARB_TAPE_IMPL_H

#include <stdbool.h>

#include "base/arb_impl.h"
#include "base/context_impl.h"

typedef enum iso_tape_kind {
    ISO_TAPE_STATE,
    ISO_TAPE_CONSTANT, /* number                              */
    ISO_TAPE_SUM,      /* a + b                               */
    ISO_TAPE_LESS,     /* a - b                               */
    ISO_TAPE_SCALED,   /* number a                            */
    ISO_TAPE_PRODUCT,  /* a b                                 */
    ISO_TAPE_QUOTIENT, /* a/b                                 */
    ISO_TAPE_POWER     /* a^number, a > 0                     */
} iso_tape_kind;

typedef struct iso_tape_node {
    iso_tape_kind kind;
    int a, b, rate; /* rate: of a state                                                                */
    bool factor;    /* of a product, a quotient or a power, or one of the last two: its sums are used */
    arb_t number;
} iso_tape_node;

typedef struct iso_tape {
    iso_tape_node *node;
    int nodes, room, states;
    int *state; /* node of each state */
} iso_tape;

void iso_tape_init(iso_tape *f);
void iso_tape_clear(iso_tape *f);

/* A node of this kind. Returns its number. */
int iso_tape_add(iso_tape *f, iso_tape_kind kind, int a, int b, const arb_struct *number);
#define iso_tape_state(f) iso_tape_add(f, ISO_TAPE_STATE, -1, -1, NULL)
#define iso_tape_constant(f, x) iso_tape_add(f, ISO_TAPE_CONSTANT, -1, -1, x)
#define iso_tape_sum(f, a, b) iso_tape_add(f, ISO_TAPE_SUM, a, b, NULL)
#define iso_tape_less(f, a, b) iso_tape_add(f, ISO_TAPE_LESS, a, b, NULL)
#define iso_tape_scaled(f, factor, a) iso_tape_add(f, ISO_TAPE_SCALED, a, -1, factor)
#define iso_tape_product(f, a, b) iso_tape_add(f, ISO_TAPE_PRODUCT, a, b, NULL)
#define iso_tape_quotient(f, a, b) iso_tape_add(f, ISO_TAPE_QUOTIENT, a, b, NULL)
#define iso_tape_power(f, a, exponent) iso_tape_add(f, ISO_TAPE_POWER, a, -1, exponent)

/* The derivative of a state. */
void iso_tape_rate(iso_tape *f, int state, int rate);

/* Three nodes. */
void iso_tape_cross(iso_tape *f, const int a[3], const int b[3], int c[3]);
int iso_tape_dot(iso_tape *f, const int a[3], const int b[3]);
void iso_tape_diagonal(iso_tape *f, const arb_struct factor[3], const int a[3], int c[3]);

/* Adds the first variation: the derivatives of all states with respect to the first `count` ones. They are states of
 * their own, behind those there were; that of state i by state j has the number states + count i + j. Where they begin:
 * 1 if i = j, else 0. */
void iso_tape_differentiate(iso_tape *f, int count);

/* --- series ------------------------------------------------------------------------------------------------------ */

typedef struct iso_series {
    const iso_tape *f;
    slong bits;
    int order, known;      /* known: the coefficients so far                                      */
    iso_monitor monitor;   /* asked at each coefficient of each node; see iso_series_expand       */
    arb_ptr *series;       /* of each node: coefficients 0 ... order                              */
    mag_ptr *term, *sum;   /* |coefficient n| h^n; their sum from n to the order                  */
    mag_ptr known_part;    /* of products, quotients and powers: [A B], see arb_series.c          */
    mag_ptr tail, next;    /* of each node: bounds the sum of |coefficient n| h^n from order + 1   */
    arb_ptr power, weight; /* scratch                                                             */
    arb_ptr inverse;       /* 1/n: a product is faster than a quotient                            */
    mag_t step;            /* h                                                                   */
} iso_series;

void iso_series_init(iso_series *s, const iso_tape *f, slong bits, int order);
void iso_series_clear(iso_series *s);

/* The coefficients of all solutions that begin in this set, one ball for each state. False: the monitor has stopped
 * it, and nothing is known. */
bool iso_series_expand(iso_series *s, arb_srcptr at);

/* Bounds what is left out, for all |t| <= h, and so proves that the solutions are there for these t. False: this h is
 * too large. */
bool iso_series_bound(iso_series *s, const arb_t h);

/* States `first` to first + count - 1 at t, |t| <= h. If the monitor stops it, they are not set. */
void iso_series_at(iso_series *s, const arb_t t, int first, int count, arb_ptr to);

/* log2 |coefficient n| of a state; -INFINITY: it is 0. */
double iso_series_size(const iso_series *s, int state, int n);

#endif

/* expression_impl.h - an expression written as text, such as "0.3*n1^2 + c/(1.2 - n3)", and the tree that it is read
 * as.
 *
 *     sum      product { (+|-) product }
 *     product  factor { (*|/) factor }
 *     factor   (+|-) factor | power
 *     power    atom [ ^ factor ]                       -x^2 = -(x^2), x^y^z = x^(y^z), 2^-1
 *     atom     number | name | function ( sum ) | ( sum )
 *
 * Equal parts of a text are one node: the tree is a list in which each node stands behind those that it is made of.
 */
#ifndef ISO_MODEL_EXPRESSION_EXPRESSION_IMPL_H
#define ISO_MODEL_EXPRESSION_EXPRESSION_IMPL_H

#include <stdbool.h>
#include <stdint.h>

#include "model/problem.h"

enum { ISO_EXPRESSION_NODES = 256, ISO_EXPRESSION_DEPTH = 32 };

typedef enum iso_term {
    ISO_TERM_NUMBER, /* value                                              */
    ISO_TERM_K,      /* k of the ball                                      */
    ISO_TERM_J,      /* J(a+1); likewise the four that follow              */
    ISO_TERM_PARAMETER,
    ISO_TERM_N,
    ISO_TERM_OMEGA,
    ISO_TERM_E,
    ISO_TERM_ADD, /* of nodes a and b; of a alone from NEGATIVE on      */
    ISO_TERM_SUB,
    ISO_TERM_MUL,
    ISO_TERM_DIV,
    ISO_TERM_POWER,
    ISO_TERM_NEGATIVE,
    ISO_TERM_SQRT,
    ISO_TERM_EXP,
    ISO_TERM_LOG,
    ISO_TERM_SIN,
    ISO_TERM_COS
} iso_term;

/* How a node depends on n: not at all, and on nothing else that moves; as a polynomial of degree 1 or 2; otherwise. */
enum { ISO_CONSTANT, ISO_LINEAR, ISO_QUADRATIC, ISO_GENERAL };

typedef struct iso_expression_node {
    uint8_t term, degree;
    int16_t a, b;
    int16_t at; /* where in the text it begins; of an operation: the operator */
    double value;
} iso_expression_node;

typedef struct iso_expression {
    int nodes, root;
    bool reads[ISO_TERM_E + 1]; /* whether there is a node of the kind */
    iso_expression_node node[ISO_EXPRESSION_NODES];
    int at;          /* where in the text a mistake is, from 0 */
    char wrong[448]; /* what it is; "": the text is an expression */
} iso_expression;

/* What an expression may read, beside numbers, k, J and the parameters. */
typedef struct iso_expression_names {
    bool moving;                                 /* omega and e */
    const char (*parameter)[ISO_PARAMETER_SIZE]; /* ISO_PARAMETERS names; "": there are no more */
} iso_expression_names;

/* Reads a text; false: it is none, e->wrong says why and e->at where. */
bool iso_expression_read(const char *text, const iso_expression_names *names, iso_expression *e);

/* Whether a node is made of others: of a, and of b as well. */
static inline bool is_operation(unsigned term)
{
    return term >= ISO_TERM_ADD;
}

static inline bool has_two(unsigned term)
{
    return term >= ISO_TERM_ADD && term < ISO_TERM_NEGATIVE;
}

/* Whether it is the number 0. */
static inline bool iso_expression_is_zero(const iso_expression *e)
{
    return e->node[e->root].term == ISO_TERM_NUMBER && e->node[e->root].value == 0;
}

/* Why `name` cannot be the name of a parameter; NULL: it can. */
const char *iso_expression_bad_name(const char *name);

/* What an expression reads, all in the same units. */
typedef struct iso_expression_state {
    double k, J[3], n[3], omega[3], e[3];
    const double *parameter;
} iso_expression_state;

/* Computes the nodes that are constant, from k, J and the parameters. False: one is not finite; e->wrong says why and
 * e->at where. */
bool iso_expression_constants(iso_expression *e, const iso_expression_state *s);

/* Its value. *size: how much it changes, to first order, if n, omega and e are changed by their own lengths, and not
 * less than the value. A relative error d of the state makes an error of order d times this. */
double iso_expression_value(const iso_expression *e, const iso_expression_state *s, double *size);

/* The values of all its nodes. */
void iso_expression_values(const iso_expression *e, const iso_expression_state *s, double x[ISO_EXPRESSION_NODES]);

/* A box of states: each component of n, omega and e lies at most so far from the middle. */
typedef struct iso_expression_box {
    iso_expression_state middle;
    double n, omega, e;
} iso_expression_box;

/* How much it varies over a box, in radians and factors of e, see expression_range.c. At most 1: it has no narrow
 * feature there. 0: it changes by less than `least`. Infinite: it may have a pole or a corner. */
double iso_expression_variation(const iso_expression *e, const iso_expression_box *box, double least);

/* Its degree as a polynomial in n, omega and e and in the functions that it calls. */
int iso_expression_degree(const iso_expression *e);

/* Whether its form shows a corner: a root of a square, as sqrt(n1^2) = |n1|, or of another even power. Then e->wrong
 * says so, and e->at where in the text. Other forms of |x|, as sqrt(1 - n2^2 - n3^2), are noticed by the error of a
 * step (method/taylor/inside_impl.h). */
bool iso_expression_has_corner(iso_expression *e, const iso_expression_state *s);

/* How far it is from where it is not defined: the least of the numbers that it divides by, or takes the root, the power
 * or the logarithm of, each by its size; 0 where it has no value. e->at: where in the text; e->wrong: what stands
 * there. Infinite: there is no such number. */
double iso_expression_margin(iso_expression *e, const iso_expression_state *s);

#endif

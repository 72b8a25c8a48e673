/* rational_impl.h - numbers as they are written: 1.4 is 14/10 and 1/3 is itself, where a double is neither. */
#ifndef ISO_BASE_RATIONAL_IMPL_H
#define ISO_BASE_RATIONAL_IMPL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/number_impl.h"

/* In lowest terms, below > 0. Both are at most 1e15. */
typedef struct iso_rational {
    int64_t top, below;
} iso_rational;

/* Room for one as text, "-7/5" or "2". */
#define ISO_RATIONAL_SIZE 40

/* Reads the whole of text[0..length): a decimal number as iso_number_read takes it, or a fraction of two of them,
 * "1/3". False: it is neither, is 0, or is too large or too fine. */
bool iso_rational_read(const char *text, size_t length, iso_rational *r);

/* What a double stands for: the decimal number of at most 15 digits that reads as this double, or else the fraction
 * with the smallest denominator, up to 9999. False: it is neither, or is 0. */
bool iso_rational_of(double x, iso_rational *r);

static inline bool iso_rational_same(const iso_rational *a, const iso_rational *b)
{
    return a->top == b->top && a->below == b->below;
}

/* (a + b)/2. False: it does not fit. */
bool iso_rational_middle(const iso_rational *a, const iso_rational *b, iso_rational *middle);

static inline double iso_rational_double(const iso_rational *r)
{
    return (double)r->top / (double)r->below;
}

char *iso_rational_print(char text[ISO_RATIONAL_SIZE], const iso_rational *r);

/* The number nearest to text[0..length), a decimal number or a fraction. False: it is neither, or is not finite. */
bool iso_rational_read_double(const char *text, size_t length, double *x);

/* --- the numbers of a text as they are written there, digit by digit: "1.4", "1/3", "0.1e-5"
 * ----------------------- */

enum { ISO_LITERALS = 64, ISO_LITERAL_NAME = 64 };

/* A number, or a list of three. */
typedef struct iso_literal {
    char name[ISO_LITERAL_NAME]; /* "k", "surface.radius", "rotor.momentum" */
    int count;
    char *text[3];
} iso_literal;

typedef struct iso_literals {
    int count;
    iso_literal one[ISO_LITERALS];
} iso_literals;

/* NULL: it is not written. */
const iso_literal *iso_literal_find(const iso_literals *all, const char *name);

void iso_literals_clear(iso_literals *all);

#endif

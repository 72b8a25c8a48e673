/* integrals_impl.h - what the parts of the search for first integrals share: samples, terms, one part of a space. */
#ifndef ISO_STUDY_INTEGRALS_IMPL_H
#define ISO_STUDY_INTEGRALS_IMPL_H

#include "study/integrals.h"

enum { INTEGRAL_POWERS = ISO_INTEGRAL_DEGREE + 1, INTEGRAL_PARITIES = 8 };

/* M^a gamma^b */
typedef struct integral_term {
    unsigned char exponent[ISO_STATE];
} integral_term;

/* The states at which functions are looked at: ISO_INTEGRAL_ROWS rows for each orbit. */
typedef struct integral_samples {
    size_t orbits, rows;
    double (*state)[ISO_STATE]; /* M, gamma */
} integral_samples;

/* A function: a sum of terms. */
typedef struct integral_function {
    size_t terms;
    integral_term *term;
    double *coefficient;
} integral_function;

/* One parity of V_d. Values grow. `basis` has an orthonormal column for each function found, `rows` numbers each. */
typedef struct integral_part {
    size_t terms, functions, found;
    iso_integral_value *value;
    integral_function *function;
    double *basis;
} integral_part;

/* The terms of V_d of one parity. term: room for them, or NULL: they are only counted. */
size_t iso_integral_terms(int degree, int coefficients, unsigned parity, integral_term term[]);

/* The derivative of a function along a deviation of the state. */
double iso_integral_slope(const integral_function *f, const double state[ISO_STATE],
                          const double deviation[ISO_STATE]);

/* The singular values of one parity of V_d on the samples, see integrals.h. Errors: ISO_NO_MEMORY, ISO_NUMERICAL. */
iso_status iso_integral_search_part(iso_context *ctx, const integral_samples *samples, int degree, int coefficients,
                                    unsigned parity, double delta, double within, integral_part *part);
void iso_integral_free_part(integral_part *part);

/* A value is that of an integral: below its error, which is small enough. */
static inline bool integral_is_found(const iso_integral_value *v, double within)
{
    return v->value <= v->error && v->error <= within;
}

#endif

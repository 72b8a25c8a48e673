/* integrals_impl.h - what the parts of the search for first integrals share: samples, terms, one part of a space. */
#ifndef ISO_INSTRUMENT_INTEGRALS_INTEGRALS_IMPL_H
#define ISO_INSTRUMENT_INTEGRALS_INTEGRALS_IMPL_H

#include "exact/integrability_impl.h"
#include "instrument/integrals/integrals.h"
#include "map/section_impl.h"
#include "study/study.h"

/* What functions are made of: M, gamma, and with a rotor v = q^(-1/(2k)). */
enum { INTEGRAL_V = ISO_STATE, INTEGRAL_NUMBERS, INTEGRAL_POWERS = ISO_INTEGRAL_DEGREE + 1, INTEGRAL_PARITIES = 8 };

/* M^a gamma^b v^c */
typedef struct integral_term {
    unsigned char exponent[INTEGRAL_NUMBERS];
} integral_term;

/* The spaces V_d, but for d. */
typedef struct integral_space {
    int coefficients; /* E                                                                                        */
    bool mirror[3];   /* whether gamma_i -> -gamma_i, with time backwards, carries motions to motions             */
    bool magnetic;    /* not all of them do: V_d has M of all degrees to d, and v                                 */
} integral_space;

/* The states at which functions are looked at: ISO_INTEGRAL_ROWS rows for each orbit. */
typedef struct integral_samples {
    iso_problem problem; /* the point on its level, in units with which |M| <= 1       */
    int axis;            /* of the section on which orbits start                       */
    iso_section_spread spread;
    size_t orbits, rows;
    double (*state)[INTEGRAL_NUMBERS];
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

/* The space of a problem. */
integral_space iso_integral_space_of(const iso_problem *f, int coefficients);

/* Everything but the states, of a problem in any units. */
iso_status iso_integral_prepare(iso_context *ctx, const iso_problem *scene, uint64_t seed, size_t orbits,
                                integral_samples *s);
iso_point_motion iso_integral_motion(const integral_samples *s);

/* The states; *energy: the root mean square of the energy's relative error. Errors: those of iso_batch_run;
 * ISO_NUMERICAL where powers of q do not fit a double. */
iso_status iso_integral_follow(iso_context *ctx, const iso_integral_search_options *options, integral_samples *s,
                               double *energy);

/* The terms of V_d of one parity: bit i is that of a_i + b_i for a mirror i; with a rotor, that of the first i which is
 * no mirror is the parity of |b|. term: room for them, or NULL: they are only counted. */
size_t iso_integral_terms(const integral_space *space, int degree, unsigned parity, integral_term term[]);

/* The derivative of a function along a deviation of (M, gamma), at a state of the problem. */
double iso_integral_slope(const integral_function *f, const iso_problem *problem, const double state[ISO_STATE],
                          const double deviation[ISO_STATE]);

/* v of a state (M, gamma). */
double iso_integral_v(const iso_problem *f, const double state[ISO_STATE]);

/* The singular values of one parity of V_d on the samples, see integrals.h. Errors: ISO_NO_MEMORY, ISO_NUMERICAL. */
iso_status iso_integral_search_part(iso_context *ctx, const integral_samples *samples, const integral_space *space,
                                    int degree, unsigned parity, double delta, double within, integral_part *part);
void iso_integral_free_part(integral_part *part);

/* A value is that of an integral: below its error, which is small enough. */
static inline bool integral_is_found(const iso_integral_value *v, double within)
{
    return v->value <= v->error && v->error <= within;
}

/* "none", "found", "undecided" */
const char *iso_integral_verdict_name(int verdict);

/* The result of the study: what was asked, and the answer. */
typedef struct iso_integrals_found {
    iso_integral_search_options how;
    iso_integral_search search;
    iso_integrability theory;
} iso_integrals_found;

/* The degree in which the energy was found; 0: in none. */
int iso_integral_energy_degree(const iso_integral_search *found);

/* The smallest value that is no integral's, over all degrees; NaN: there is none. */
double iso_integral_smallest(const void *search);

/* Its text, and the lines of its table (integrals_print.c). */
void iso_integrals_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result);

#endif

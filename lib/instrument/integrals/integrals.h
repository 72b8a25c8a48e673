/* integrals.h - are there additional first integrals? A search for polynomials in M that are constant on many orbits.
 *
 *     iso_integral_search found;
 *     iso_integral_search_options o = iso_integral_search_defaults();
 *     o.degree = 4;
 *     status = iso_integral_search_run(ctx, &scene, &o, &found);          found.verdict, found.at[2].further
 *
 * The space of functions. The free point keeps H = M^2/2 - eps q^(-1/k), q = (gamma, J gamma), and its orbits on H =
 * 0 are the ball's. (M, s, eps) -> (c M, s/c, c^2 eps) carries orbits to orbits. So an integral on all levels is a
 * sum of integrals that are homogeneous in M, and each of them is known from one value of eps. With the ball's
 * energy, h = (1/2) (k^2/det J) q^(1/k) M^2, the space of degree d is
 *
 *     V_d:  sums of h^j M^a gamma^b,    |a| + 2 j = d,    |b| <= E         (a, b: exponents of the three components)
 *
 * On one level h is a number, and V_d are the polynomials in M of degrees d, d - 2, ... with polynomials in gamma of
 * degree E or less. The energy itself is the constant 1 in V_2, V_4, ...: it is found there, as any other integral.
 *
 * The orbits are those of the scene's level H = E: of a point, or of a ball with the effect `level`. There eps
 * q^(-1/k) is M^2/2 - E, and the same functions are looked at. What is constant on one level need not be constant on
 * others.
 *
 * With a rotor (on the point a magnetic field, model/effects/effect_rotor.c) the field turns over with M: an integral
 * for all K is a sum of ones that are homogeneous in M, sqrt(h) and K. At one K the numbers h and K count for
 * nothing. v = q^(-1/(2k)) stands beside K in the integrals that are known. So
 *
 *     V_d:  sums of v^c M^a gamma^b,    |a| + c <= d,    c <= 1,    |b| <= E         (v^2 is M^2, up to numbers)
 *
 * which has V_(d-1) in it, and the constant 1 from V_1 on.
 *
 * The search. Orbits start spread evenly over a global section (map/section.h), with one value of eps. Each is
 * sampled at many times. The functions are columns, the samples rows. Relations that hold on the surface (|gamma| =
 * 1, (M, gamma) = 0, the level) make columns dependent. The method of Gram and Schmidt, the largest column first,
 * keeps an independent set and makes an orthonormal basis Q of V_d on the samples. From each column of Q its mean
 * over each orbit is taken away. The singular values of what is left are the sines of the angles between V_d and the
 * functions that are constant on orbits: 0 for an integral. A value is the root mean square of the variation of a
 * function along orbits, if the root mean square of the function itself is 1.
 *
 * Reflections gamma_i -> -gamma_i split V_d into eight parts, by the parity of a_i + b_i for i = 1, 2, 3. Integrals
 * can be chosen in one part each; the parts are searched one by one. With a rotor that has K_i there are fewer parts:
 * by gamma_i -> -gamma_i where K_i = 0, and by gamma -> -gamma.
 *
 * Errors. A unit function has coefficients c in columns of unit length; samples have the relative error delta (of
 * the integration and of rounding), so its value has an error of about delta sum |c|; added to delta is what columns
 * of terms have beside V_d, up to 1e-13, because they were taken for dependent. A value below its error, where
 * the error is below `within`, is an integral. A value above `within` and above its error is none. Others are
 * doubtful: so small a variation can be that of an integral of a neighbouring problem.
 *
 * Where moments are nearly equal, functions of growing degree come ever closer to an integral: with moments 1 %
 * apart (k = 0.5) the smallest values of V_2, V_4, V_6 are 4e-6, 2e-10, 5e-14. A new integral is
 * believed only if its value is at rounding level in one degree, and the values of all lower degrees are not small.
 *
 * A search is evidence, no proof: it says that no function of this space is constant on these orbits.
 */
#ifndef ISO_INSTRUMENT_INTEGRALS_INTEGRALS_H
#define ISO_INSTRUMENT_INTEGRALS_INTEGRALS_H

#include "base/field.h"
#include "orbit/orbit.h"

enum {
    ISO_INTEGRAL_DEGREE = 8, /* the largest degree, in M and in gamma                */
    ISO_INTEGRAL_ROWS = 32,  /* samples of an orbit                                  */
    ISO_INTEGRAL_VALUES = 8, /* the smallest singular values of a degree that are listed */
    ISO_INTEGRAL_KNOWN = 8
};

typedef struct iso_integral_search_options {
    int degree;       /* D, of the polynomials in M: 1 to ISO_INTEGRAL_DEGREE                            */
    int coefficients; /* E, of their coefficients in gamma: 0 to ISO_INTEGRAL_DEGREE; -1: D, at least 2  */
    size_t orbits;    /* to 10000; 0: 64, more where degrees need it                                       */
    double turns;     /* of n, about, for which each orbit is followed, in [1, 1e5]                      */
    uint64_t seed;    /* of the starts and of the times                                                  */
    double within;    /* in (0, 1): a function that varies more is no integral                           */
    double tolerance; /* of the integration                                                              */
    int threads;      /* 0: as many as there are processors to run on                                    */
    void (*progress)(void *data, double share); /* may be NULL; share of the work done, in [0, 1]        */
    void *data;
} iso_integral_search_options;

/* Degree 2, coefficients of degree 2, 64 orbits of 50 turns, seed 0, within 1e-10, tolerance 1e-14. */
static inline iso_integral_search_options iso_integral_search_defaults(void)
{
    return (iso_integral_search_options){
        .degree = 2, .coefficients = -1, .turns = 50, .within = 1e-10, .tolerance = 1e-14};
}

typedef enum iso_integral_verdict {
    ISO_INTEGRALS_NONE,     /* but the energy: every other function varies by more than `within` */
    ISO_INTEGRALS_FOUND,    /* at least one that does not depend on the energy                   */
    ISO_INTEGRALS_UNDECIDED /* a value is doubtful, the search was stopped, or see `near`        */
} iso_integral_verdict;

/* One singular value. */
typedef struct iso_integral_value {
    double value, error;
    unsigned parity; /* bit i: a_i + b_i is odd; with a rotor, of the first i with K_i: |b| is odd */
} iso_integral_value;

/* The space V_d. */
typedef struct iso_integral_degree {
    int degree;
    size_t terms;     /* that are looked at; multiples of |gamma|^2 and of M3 gamma3 are others already */
    size_t functions; /* dimension of V_d on the surface                                                      */
    size_t found;     /* integrals, among them the energy and products of integrals                           */
    size_t further;   /* of them those that are not the energy, nor in V_(d-2), with a rotor V_(d-1)           */
    size_t doubtful;
    double largest;  /* value of those found; NaN: none                                                       */
    double smallest; /* value of the others; NaN: none. smallest/largest is the gap                           */
    size_t values;
    iso_integral_value value[ISO_INTEGRAL_VALUES]; /* growing */
} iso_integral_degree;

/* An integral that the library knows for this k and J (iso_system_point.integrals). */
typedef struct iso_integral_known {
    const char *name, *doc;
    bool constant;   /* on H = 0, as the energy: it says nothing further (three equal moments) */
    int degree;      /* d of the first V_d in which it was found; 0: it was not */
    double residual; /* its distance from what was found there, by its own size */
} iso_integral_known;

typedef struct iso_integral_search {
    iso_integral_verdict verdict;
    int independent; /* integrals that do not depend on each other, nor on the energy: 0, 1 or 2 */
    /* A neighbour is integrable: two moments differ by less than 1e-6 of them, or |k| and 1 by less than 1e-9, or a
     * component of K is below 1e-9 in units of the motion, or lower degrees than that of the first integral have others
     * below 1e-3. What is found and not known can then be the neighbour's: `undecided`. */
    bool near;
    int coefficients;
    size_t orbits;
    double level;  /* of the energy H on which it was searched (study/level.h); 0: H = 0 */
    double delta;  /* relative error of the samples                              */
    double energy; /* relative spread of the energy in the samples               */
    int degrees;   /* V_1 ... V_degrees have been searched: at[1] ... at[degrees] */
    iso_integral_degree at[ISO_INTEGRAL_DEGREE + 1];
    int known_count;
    iso_integral_known known[ISO_INTEGRAL_KNOWN];
} iso_integral_search;

/* Only k, J and the effects of the scene are read, and the level H of its start; with a rotor, its energy.
 * Errors: ISO_BAD_ARGUMENT about "degree", "coefficients", "orbits" (too few for the functions, or more than 10000),
 * "turns", "within", "tolerance", "threads"; ISO_BAD_INPUT about "k" where powers of q do not fit a double, about an
 * effect that acts, other than `level` and `rotor`, about "M" where the point can only rest on its level; those of
 * iso_batch_run;
 * ISO_NO_MEMORY; ISO_STOPPED by the context's monitor: the degrees done are valid. */
iso_status iso_integral_search_run(iso_context *ctx, const iso_scene *scene,
                                   const iso_integral_search_options *options, iso_integral_search *result);

#endif

/* separatrix.h - the splitting of the separatrix, which is 0 at k = 1 and k = -1, where the ball is integrable.
 *
 * The rotation about the middle axis is a hyperbolic fixed point O of the return map (map/section.h), with its mirror
 * O', half a turn of l away. At k = +-1 the unstable manifold of O is the stable manifold of O'. At other k they
 * cross. Of the section n_a = 0 with the middle axis c = a - 1, cyclically, O is (l, x) = (0, 0). The reversor
 * (l, x) -> (pi - l, x) turns W^u(O) into W^s(O'), so they meet wherever one of them meets the line l = pi/2, there
 * with the slopes +m and -m, m = dx/dl of W^u(O). If m != 0 they cross transversally, and there is no further
 * analytic integral (lib/doc/why_only_one.md); m is computed, not proved. All this holds on every level of the
 * point's energy (study/level.h) on which the rotation exists: those on which the point can reach the whole sphere.
 *
 *     iso_separatrix_splitting s;
 *     status = iso_separatrix_at(ctx, 0.5, (double[3]){1.4, 2.1, 3}, 0, ISO_SEPARATRIX_AUTO, &s); s.x, s.m, s.error
 *
 * The manifold near O is a polynomial W with g(W(theta)) = W(lambda^(1/2) theta), g half a return, found by Newton's
 * method; farther out it is followed by half returns with their derivatives. Numbers have 64 bits of mantissa, and
 * 113 where those do not distinguish m from 0; 106 of the 113 are kept. Errors come from a second computation, with
 * another polynomial on another domain, and from what rounding does.
 */
#ifndef ISO_INSTRUMENT_SEPARATRIX_SEPARATRIX_H
#define ISO_INSTRUMENT_SEPARATRIX_SEPARATRIX_H

#include <stdint.h>

#include "base/field.h"
#include "base/record.h"
#include "study/options_impl.h"

/* Numbers of 64 bits of mantissa, of 128 (113 of mantissa), or the first and where |m| < 1000 errors the second. */
typedef enum iso_separatrix_digits {
    ISO_SEPARATRIX_DOUBLE,
    ISO_SEPARATRIX_QUAD,
    ISO_SEPARATRIX_AUTO
} iso_separatrix_digits;

/* "double", "quad", "auto"; NULL past the end. */
const char *iso_separatrix_digits_name(int digits);

/* What is found at one k, on one level. */
typedef struct iso_separatrix_splitting {
    double k, level;
    int middle;                  /* the middle axis, 0 to 2: O is the rotation about it                           */
    int axis;                    /* a = middle + 1, cyclically: x and m belong to n_a = 0, where O is (l, x) = 0  */
    double lambda;               /* O's multiplier > 1 of a whole return                                          */
    double x, x_tail;            /* where W^u(O) first meets l = pi/2: x + x_tail                                 */
    double m, m_tail;            /* its slope dx/dl there, m + m_tail                                             */
    double error, x_error;       /* of m, and of x                                                               */
    int section;                 /* axis of the global section, on which all is computed: a, or another one        */
    double section_x, section_m; /* x and m there                                                        */
    /* On it, the next point at which the manifolds meet, and half the difference of their slopes; NaN: not asked for,
     * or not found. */
    double next_l, next_x, next_m;
    int digits;     /* decimal digits of the numbers: 19 or 32                                       */
    bool from_zero; /* |m| > 100 errors                                                              */
    bool is_zero;   /* a zero of m between two rows of a scan, to k_error or level_error; next_... are there   */
    double k_error, level_error; /* one of them is 0: that of the number in which both rows agree                */
    iso_status status;           /* ISO_OK, or why there is nothing                                               */
    char text[200];              /* of a failure; with ISO_OK: "", or why 128 bits failed where 64 did not         */
} iso_separatrix_splitting;

/* Errors: ISO_BAD_INPUT about "k" or "J": those of iso_params_reduced; two equal moments (the body is integrable, and
 * there is no middle axis); lambda below 1.02 (moments that are nearly equal, large |k|, a high level), where m is
 * estimated at 1e-427 or less and not computed; parameters beyond what the numbers hold; about "level": the middle
 * axis has no rotation, but an oscillation between two places of rest. ISO_NUMERICAL: no crossing was found, or a
 * return failed. ISO_BAD_ARGUMENT about "digits" where this build has no 128 bits. ISO_NO_MEMORY, ISO_STOPPED. The
 * status and its text are in *s as well. */
iso_status iso_separatrix_at(iso_context *ctx, double k, const double J[3], double level,
                             iso_separatrix_digits digits, iso_separatrix_splitting *s);

typedef struct iso_separatrix_options {
    const double *k; /* the values, in any order                                              */
    size_t count;
    double J[3];
    iso_separatrix_digits digits;
    int threads; /* 0: as many as there are processors to run on                           */
    /* progress(part): the part of the work that is done, in [0, 1]; NULL: no calls. */
    void (*progress)(void *data, double part);
    void *data;
    const double *level; /* one for each k; NULL: 0 everywhere */
} iso_separatrix_options;

static inline iso_separatrix_options iso_separatrix_defaults(void)
{
    iso_separatrix_options o = {0};
    o.digits = ISO_SEPARATRIX_AUTO;
    return o;
}

typedef struct iso_separatrix_table {
    size_t rows, zeros;
    int axis, middle; /* those of each row that did not fail; -1: all did */
    bool by_level;    /* the rows differ in the level, not in k           */
    size_t lost;      /* zeros that lie between two rows and were not found: a failure, or +-1 too close  */
    /* One for each k of the options, in their order; status ISO_STOPPED: not done. */
    iso_separatrix_splitting *row;
    /* Zeros of m other than k = +-1, by growing k and level. */
    iso_separatrix_splitting *zero;
} iso_separatrix_table;

/* Other zeros of m than k = 1 and k = -1 are those of r = m exp(2 pi^2/ln lambda)/(k^2 - 1): there is one between two
 * neighbours that are distinguished from 0 if their r have opposite signs. Neighbours have the same level, or else
 * the same k. There the manifolds touch at one point. If they cross at the next one (next_m != 0), there is no
 * additional integral. A failure at one k stands in its row, and is no failure of the call. Errors: ISO_BAD_ARGUMENT
 * (no k; "digits"); ISO_NO_MEMORY; ISO_STOPPED by the context's monitor: *s has the rows that are done. */
iso_status iso_separatrix_run(iso_context *ctx, const iso_separatrix_options *options, iso_separatrix_table **s);
void iso_separatrix_free(void *table);

/* The unstable manifold of O as a line of points, columns u and x, from O for `halves` half returns past the first
 * crossing, in numbers of 64 bits. (pi - u, x) is the stable manifold of O'. Errors: as iso_separatrix_at. */
iso_status iso_separatrix_curve(iso_context *ctx, double k, const double J[3], double level, int halves,
                                iso_record **curve);

/* --- the study (separatrix_study.c, separatrix_print.c) ---------------------------------------------------------- */

/* The study's part of shared refusals (study_impl.h). */
#define ISO_SPLITTING_IS "the splitting is measured"
#define ISO_NO_SPLITTING "no separatrix splits"

/* Values of --k or --level: as they are typed (NULL: not given), and as numbers. */
typedef struct iso_separatrix_list {
    const char *name, *text;
    double *x;
    size_t count;
} iso_separatrix_list;

typedef struct iso_separatrix_request {
    iso_separatrix_list k, level;
    iso_separatrix_options how; /* digits and threads */
} iso_separatrix_request;

/* Its text, and the lines of its table. */
void iso_separatrix_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result);
iso_status iso_separatrix_describe(iso_context *ctx, const iso_scene *scene, const void *options,
                                   iso_study_result *result);

/* The row whose curves are best seen: |m| is about 1/30. NULL: there is none. */
const iso_separatrix_splitting *iso_separatrix_clearest(const iso_separatrix_table *s);

#endif

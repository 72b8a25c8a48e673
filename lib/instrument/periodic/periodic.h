/* periodic.h - the periodic orbits of a free ball, and of the point: rotations about the principal axes, symmetric
 * orbits of the return map, and others.
 *
 *     iso_periodic *found;
 *     status = iso_periodic_run(ctx, &scene, NULL, &found);
 *     found->rotation[1].half_turn_trace;     about axis 2
 *     found->orbit[0].trace;                  of the first orbit
 *     iso_periodic_free(found);
 *
 * The section is n_a = 0 (map/section.h). f is its return map, and S1: (l, x) -> (l, -x), S2: (-l, x), and
 * S3: (pi - l, x) are reversors: S f S = f^-1. The equations are odd in gamma: T (M, gamma) = (M, -gamma). Half a
 * return, from n_a growing to n_a falling, followed by T is a map g of the section with g g = f and S g S = g^-1.
 *
 * An orbit that S or T S maps to itself is symmetric. Each of the six reversors has a line of fixed states, which the
 * orbit, or its image by T, passes: for S1, S2, S3 the lines x = 0, l = 0, l = pi/2 of the section. For T S1, T S2,
 * T S3 these lines lie half way between two crossings: gamma = -e_a, and the planes gamma_b = 0 and gamma_c = 0, met
 * at right angles. Half an orbit later, p half returns for a period p, it is on this line again. The search looks for
 * such orbits along each line. A symmetric orbit can be missed only within 1e-4 of a rotation, or between samples
 * that are too far apart: `unresolved` and `lost` count such places.
 *
 * R: (l, x) -> (l + pi, x) and S1 S2: (l, x) -> (-l, -x) and T carry orbits to orbits of the same kind: copies. One
 * of them is listed.
 *
 * Energy scales out: for the ball on which nothing acts orbits are the same for every energy, and isolated, but for k
 * = 1 and k = -1 and equal moments. A point off H = 0, or a ball with the effect `level`, is on a level that does
 * not scale out: (H/eps) J2^(1/k), J2 the middle moment, a number without a unit (study/level.h). Where the point
 * cannot reach the whole sphere, orbits may come to rest and go back the same way. Those that no S and T S maps to
 * themselves are not on the lines: only a search from a grid finds them.
 */
#ifndef ISO_INSTRUMENT_PERIODIC_PERIODIC_H
#define ISO_INSTRUMENT_PERIODIC_PERIODIC_H

#include <stdint.h>

#include "base/field.h"
#include "model/system.h"
#include "orbit/scene.h"

/* The multipliers of a map of the plane that keeps an area: lambda and 1/lambda, lambda + 1/lambda = trace. */
typedef enum iso_stability {
    ISO_STABLE,             /* |trace| < 2: exp(+-i angle), of first order stable                             */
    ISO_UNSTABLE,           /* trace > 2: a saddle                                                            */
    ISO_INVERSE_HYPERBOLIC, /* trace < -2: a saddle with two negative multipliers                             */
    ISO_DEGENERATE,         /* |trace| is 2 within 4 errors                                                   */
    ISO_STABILITY_UNDECIDED /* the same, and the error is above 2.5e-4: too large to say                      */
} iso_stability;
/* "stable", "unstable", "inverse", "degenerate", "undecided". */
const char *iso_stability_name(int stability);

typedef struct iso_multipliers {
    iso_stability stability;
    double value[2][2]; /* real and imaginary part of each; the larger one first                                 */
    /* Of exp(i angle), 0 < angle < pi: 1 if neighbours turn from l to x, of a rotation from gamma_i to dgamma_i/dphi
     * (the same sense), by this angle; -1: the other way; 0: the multipliers are real. */
    int krein;
} iso_multipliers;

/* The rotation about axis i, in the plane gamma_i = 0: Hill's equation. With q = J_a cos^2 phi + J_b sin^2 phi, for
 * eps = 1 and on the level H = E, u = E q^(1+1/k),
 *
 *     (q + u) d^2 gamma_i/dphi^2 = (q'/(2k)) dgamma_i/dphi - ((1/k) (J_i - (1 - k) q) + u) gamma_i
 *
 * half_turn_trace is the trace of its matrix from phi = 0 to pi: stable for |trace| < 2. It needs the whole circle:
 * where part of it cannot be reached, E + q^(-1/k) <= 0, the motion in the plane is an oscillation between two
 * places of rest.
 */
typedef struct iso_rotation {
    int axis; /* 0 to 2 */
    double half_turn_trace;
    double error; /* of it, or with `polish` of half_turn_trace + tail                                  */
    double tail;  /* half_turn_trace + tail has 30 digits where there are numbers of 128 bits           */
    /* The same by the derivative of g at the fixed point, of the section's own axis by another section. */
    double by_section;
    double turn_trace;        /* half_turn_trace^2 - 2: of a whole turn                                             */
    iso_multipliers half;     /* of half a turn                                                                    */
    double clock[ISO_CLOCKS]; /* of a whole turn, in the scene's units                                            */
    double l, x;              /* its fixed point; x = 1: the boundary of the section                               */
    bool oscillates;          /* there is no rotation: see above. Then the other numbers are NaN */
    bool polished;            /* found with numbers of 128 bits                                                   */
} iso_rotation;

enum { ISO_PERIODIC_MOST = 64 }; /* the longest period that can be asked for */

/* Reversors that map an orbit to itself, as bits; T S: the reversor followed by T. */
enum { ISO_S1 = 1, ISO_S2 = 2, ISO_S3 = 4, ISO_TS1 = 8, ISO_TS2 = 16, ISO_TS3 = 32 };

typedef struct iso_periodic_orbit {
    int line;    /* a symmetry line that it passes, as in iso_symmetry_line_name; -1: none                     */
    double u;    /* where: 0 to pi/2                                                                */
    int period;  /* returns to the section                                                          */
    double l, x; /* a point of it: on the line, or the first one behind a line half way              */
    double l_tail, x_tail;    /* l + l_tail: more digits                                                         */
    double trace, trace_tail; /* of the derivative of f^period                                                   */
    double error;             /* of the trace                                                                    */
    double determinant;       /* of the same derivative, minus 1; likewise                                       */
    /* |f^period z - z| in (l, x), with all digits of z, by the largest number of the derivative of f^period if that
     * is above 1. The second half of a symmetric orbit is the mirror image of the first: how far the middle is from
     * the line is measured, and carried on by the derivative. */
    double closure;
    iso_multipliers multipliers;
    bool torus;   /* k = 1 or -1: on a torus that is full of such orbits                             */
    int symmetry; /* which reversors map it to itself: bits                                          */
    /* Orbits that R, S1 S2, T (and S1, of an orbit without symmetry) make of it, itself among them. */
    int copies;
    double clock[ISO_CLOCKS]; /* its period in t, tau and s, in the scene's units                                */
    double ball[ISO_STATE], point[ISO_STATE]; /* its start at (l, x), with the scene's energy                    */
    double copy[16][2]; /* a point (l, x) of each copy                                                     */
    double (*half)[2];  /* (l, x) of g z, g^2 z = f z, ...: 2 period points, the last is z                 */
    size_t number;      /* in the list, from 1                                                                   */
    bool polished;      /* found with numbers of 128 bits                                                        */
} iso_periodic_orbit;

typedef struct iso_periodic_options {
    int period;    /* the longest, 1 to ISO_PERIODIC_MOST                                                         */
    bool all;      /* orbits without a symmetry as well, by Newton's method from a grid                            */
    long grid;     /* its points                                                                                   */
    bool no_lines; /* with `all`: the grid alone, to test one search by the other                               */
    bool polish;   /* everything in numbers of 128 bits                                                            */
    bool rotations_alone; /* no search: only iso_periodic.rotation is found                                     */
    int threads; /* 0: as many as there are processors to run on                                                 */
    void (*progress)(void *data, double part); /* NULL: no calls                                           */
    void *data;
} iso_periodic_options;

/* Symmetric orbits of period 6 at most. */
static inline iso_periodic_options iso_periodic_defaults(void)
{
    return (iso_periodic_options){.period = 6, .grid = 2000};
}

typedef struct iso_periodic {
    int axis;     /* of the section, 0 to 2             */
    double level; /* (H/eps) J2^(1/k) of the scene      */
    bool closed;  /* the point cannot reach all places  */
    int longest;  /* period that was sought             */
    iso_rotation rotation[3];
    size_t count;
    iso_periodic_orbit *orbit; /* by period, then by trace                                                       */
    size_t unresolved; /* intervals of the lines in which the samples could not be made close enough              */
    size_t lost;       /* sign changes that did not end in an orbit: closer pairs, or a failure                   */
} iso_periodic;

/* options NULL: iso_periodic_defaults(). Errors:
 * - ISO_BAD_ARGUMENT about "period" or "grid", or about "polish" where there are no numbers of 128 bits;
 * - ISO_BAD_INPUT about an effect that acts, other than `level`; about "M" or "angular_velocity" at rest; about "k",
 *   where |k| < 0.02; about "J", where max J/(min J |k|) > 1e5 or two moments are equal: then a rotation carries
 *   every orbit along, and none is isolated;
 * - ISO_NUMERICAL; ISO_NO_MEMORY; ISO_STOPPED by the context's monitor: *found has what is known by then. */
iso_status iso_periodic_run(iso_context *ctx, const iso_scene *scene, const iso_periodic_options *options,
                            iso_periodic **found);
void iso_periodic_free(void *found);

/* The reversor of a symmetry line 0 to 5: "S1", "S2", "S3", "TS1", "TS2", "TS3"; NULL for other numbers. */
const char *iso_symmetry_line_name(int line);

/* head + tail with up to 31 digits, as text; the reversors of `symmetry`: "S1 S3", "none". */
enum { ISO_DIGITS_SIZE = 48 };
void iso_periodic_digits(double head, double tail, char text[ISO_DIGITS_SIZE]);
int iso_symmetry_text(int symmetry, char text[ISO_DIGITS_SIZE]);

#endif

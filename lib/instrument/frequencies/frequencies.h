/* frequencies.h - the frequencies of a motion: exact ones where there is a closed solution, else an estimate.
 *
 *     iso_frequencies f;
 *     iso_frequencies_options o = iso_frequencies_defaults();
 *     status = iso_frequencies_find(ctx, &scene, &o, &f);      f.angle[0].frequency[ISO_CLOCK_T], f.ratio
 *
 * A motion on a torus has two angles that grow uniformly in each of the clocks t, tau and s. Where there is a closed
 * solution (exact/exact.h), it has their frequencies and actions. Elsewhere the frequencies are estimated:
 * - n(t) is computed over many turns, and its lines are found (spectrum.c).
 * - One frequency is the strongest line of the two components of n that turn about an axis. The other is the
 *   strongest line of the third component that is no multiple of the first.
 * - Two such frequencies are determined only up to integer combinations. Where the problem separates and the motion
 *   is not extreme, they are those of the closed solution.
 * - The indicators of chaos (chaos.h) say whether the motion is regular or chaotic. Where they do not decide, both
 *   halves of the orbit are compared: if their frequencies differ, and longer orbits hardly reduce the difference,
 *   the motion is chaotic.
 */
#ifndef ISO_INSTRUMENT_FREQUENCIES_FREQUENCIES_H
#define ISO_INSTRUMENT_FREQUENCIES_FREQUENCIES_H

#include <math.h>

#include "base/field.h"
#include "exact/exact.h"
#include "instrument/frequencies/momentum.h"
#include "orbit/orbit.h"
#include "study/study.h"
#include "study/verdict.h"

enum { ISO_MOST_SAMPLES = 1 << 22 };

typedef struct iso_frequencies_options {
    double turns;   /* of n in the estimate, about, 20 or more; NaN: 1000                                */
    double end;     /* length of the orbit in t, 20 turns or more; NaN: by turns                         */
    double samples; /* of the orbit, rounded up to a power of two, 512 or more; NaN: 32 for each turn    */
    void (*progress)(void *data, double share); /* may be NULL; of the orbit in hand, in [0, 1]          */
    void *data;
} iso_frequencies_options;

/* All NaN: 1000 turns (fewer where |k| < 1/4), up to 16 times as many while the motion is not found regular. */
static inline iso_frequencies_options iso_frequencies_defaults(void)
{
    return (iso_frequencies_options){.turns = NAN, .end = NAN, .samples = NAN};
}

/* One of the two angles. Everything in the caller's units; NaN: not known. */
typedef struct iso_angle {
    char what[96];                /* what turns or swings                                               */
    double frequency[ISO_CLOCKS]; /* > 0, radians per unit of the clock                                 */
    double period[ISO_CLOCKS];    /* 2 pi/frequency                                                     */
    double error[ISO_CLOCKS];     /* of the frequency: estimates only                                   */
    double drift;                 /* of the frequency in t between the halves, relative: estimates only */
    double action;                /* closed solution only, see iso_exact_torus                          */
} iso_angle;

/* p angle[0].frequency is nearly q angle[1].frequency */
typedef struct iso_resonance {
    int p, q;
    double gap;              /* relative: |p f0 - q f1|/(p f0)                                              */
    double beat[ISO_CLOCKS]; /* the time in which p angle[0] - q angle[1] turns once; infinite: never       */
    bool met;                /* the gap is rounding (an estimate: within its error)                         */
} iso_resonance;

enum { ISO_MAX_LINES = 24 };

/* A line of a signal: a exp(i (frequency (t - t0) + phase)), a = amplitude > 0, t0 the time of the first sample. */
typedef struct iso_spectral_line {
    double frequency; /* radians per unit of time, of either sign, |frequency| <= pi/step */
    double amplitude, phase;
} iso_spectral_line;

/* A line of n(t), nu = m angle[0].frequency + n angle[1].frequency where `known`. */
typedef struct iso_identified_line {
    iso_spectral_line line;
    bool known;
    int m, n;
} iso_identified_line;

/* How the frequencies were estimated. */
typedef struct iso_estimate {
    double length, turns; /* of the orbit, in t, and how often n turned, by its strongest line  */
    size_t samples;
    int axis;     /* 0 to 2: about which n turns                                          */
    int lines[2]; /* of n_j + i n_l, (axis, j, l) cyclic, and of n_axis, the largest first */
    iso_identified_line line[2][ISO_MAX_LINES];
    double unexplained;         /* part of the lines' amplitudes that is no combination of the two      */
    double drift, drift_before; /* the larger of the angles', and what it was for the first quarter */
    iso_verdict verdict;
} iso_estimate;

enum { ISO_MAX_RESONANCES = 8, ISO_SEPARATRICES = 2 };

/* Where a motion changes its kind, at a root that meets b2 (and b3). */
typedef struct iso_separatrix {
    char what[96];
    /* (c - c of the separatrix)/(the larger |c| of both). 0: on it; > 0: u turns back before b2, v passes b3. */
    double distance;
} iso_separatrix;

typedef struct iso_frequencies {
    bool estimated;
    bool unresolved;              /* estimated although there is a closed solution, which needs too many terms   */
    char why[256];                /* estimated: why                                                              */
    iso_exact_kind kind;          /* of the closed solution                                                      */
    char motion[160];             /* as text                                                                     */
    double h, eps;                /* energy, coupling (NaN without a twin) ...                           */
    double H;                     /* ... and level of the point                                          */
    const iso_integral *integral; /* of the ball, beyond h: it is integrable; NULL: none is known        */
    double F;                     /* its value                                                           */
    double c;                     /* constant of the separation; NaN: not separated                      */
    int separatrices;
    iso_separatrix separatrix[ISO_SEPARATRICES];
    int angles; /* 0, 1 or 2                                                                            */
    iso_angle angle[2];
    /* angle[0].frequency/angle[1].frequency, the same in every clock; NaN: the motion is chaotic, or two frequencies
     * explain less than half of it. */
    double ratio;
    int resonances; /* best approximations of `ratio` by fractions q/p with p, q <= 100 */
    iso_resonance resonance[ISO_MAX_RESONANCES];
    /* The period of a closed orbit: one angle, or a resonance that is met; NaN: it is open, or only estimated. */
    double closed[ISO_CLOCKS];
    iso_estimate estimate;
} iso_frequencies;

/* Errors:
 * - ISO_BAD_INPUT about an effect that takes energy or lets the ball roll away: no such motion is quasi-periodic;
 * - ISO_BAD_INPUT for a ball or a point at rest;
 * - ISO_BAD_ARGUMENT about the options: for an estimate fewer than 20 turns, fewer than 8 samples a turn, too many
 *   samples;
 * - those of iso_orbit_create and iso_orbit_at. */
iso_status iso_frequencies_find(iso_context *ctx, const iso_scene *scene, const iso_frequencies_options *options,
                                iso_frequencies *frequencies);

/* The estimate alone, whatever solution there is. */
iso_status iso_frequencies_estimate(iso_context *ctx, const iso_scene *scene, const iso_frequencies_options *options,
                                    iso_frequencies *frequencies);

/* Its text (frequencies_print.c). */
void iso_frequencies_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result);

#endif

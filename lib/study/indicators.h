/* indicators.h - is an orbit chaotic? Told from its beats: its returns to a section, or equal steps of a clock.
 *
 *     iso_indicators it;
 *     iso_indicators_begin(&it, 3000);                          no more than 3000 turns
 *     while (iso_indicators_verdict(&it) == ISO_UNDECIDED && it.turns < 3000) {
 *         ... the next crossing
 *         iso_indicators_add(&it, &beat);
 *     }
 *     iso_indicators_tell(&it, &told);                          told.verdict, told.exponent[ISO_CLOCK_T]
 *
 * Each beat tells how long two deviations d1, d2 have become. The length of the derivative of n turns is
 * D_n = sqrt((|d1|^2 + |d2|^2)/2), which does not depend on how the two begin. On a regular orbit D_n^2 is, but for
 * bounded factors that depend on the place alone, a + b n + c n^2; on a chaotic orbit it grows like exp(2 lam n).
 *
 * - Exponent: ln D gained per unit of a clock, without the first eighth; its error from the scatter of 16 to 32
 *   parts.
 * - MEGNO: Y_n = (2/n) sum (j - 1/2) ln(D_j/D_(j-1)), and its mean over all turns so far. Both approach 2 like 1/n on
 *   a regular orbit, and grow like lam n, lam n/2 on a chaotic one.
 * - The limit of MEGNO on a regular orbit: the mean of 2 (j - 1/2) ln(D_j/D_(j-1)) with the smooth weight
 *   exp(-1/(u (1 - u))), u from 0 to 1 over the last three quarters of the turns. On a quasi-periodic orbit such a
 *   mean differs from the true one by less than any power of 1/n; what remains is 2 + A/n, of which A/n is fitted and
 *   taken away. Where D has grown little (the rotation number depends hardly on the torus), a + b n + c n^2 is fitted
 *   instead: the limit is 2 if c > 0, and 0 if neither b nor c differ from 0 (isochronous motion).
 * - GALI_2: the sine of the angle between d1 and d2.
 * - Digits: means of functions of the place, with the same weight, over the first and the second half of those turns.
 *   On a quasi-periodic orbit they agree to many digits (S. Das, Y. Saiki, E. Sander, J. A. Yorke, Nonlinearity 30,
 *   2017), on a chaotic orbit to one or two, on an orbit that sticks to an island for long to three or four.
 *
 * The verdict is looked at again whenever the turns have grown by sqrt(2), so that the last look is at the turns that
 * iso_indicators_begin was told. The conditions stand in indicators.c; tests/README.md has their calibration.
 */
#ifndef ISO_STUDY_INDICATORS_H
#define ISO_STUDY_INDICATORS_H

#include <stdbool.h>

#include "../base/api.h"
#include "../orbit/crossings.h"
#include "verdict.h"

ISO_C_BEGIN

enum { ISO_SEEN = 3, ISO_LOOKS = 4, ISO_PARTS = 32 };

/* One beat. What is not known is NaN. */
typedef struct iso_beat {
    double clock[ISO_CLOCKS];      /* since the start                                                            */
    double growth[ISO_DEVIATIONS]; /* ln |d1|, ln |d2|; 0 at the start                                           */
    double area;                   /* sine of the angle between them                                             */
    double seen[ISO_SEEN];         /* any smooth functions of the place, of order 1, one-valued; NaN: none       */
} iso_beat;

/* Sums of one look; see indicators.c. */
typedef struct iso_look {
    long first, last; /* turns that it takes: first < n <= last */
    double weight[2], megno[2], growth[2], seen[2][ISO_SEEN], square[2][ISO_SEEN]; /* of each half               */
    double whole, megno_whole, inverse[3], power[5], length[3];                    /* of all                     */
} iso_look;

/* What one orbit has shown so far. Memory of fixed size. To be read by iso_indicators_tell only. */
typedef struct iso_indicators {
    long turns, most, number; /* number: of the next look */
    double before, area, step_sum, mean_sum;
    iso_look look[ISO_LOOKS];
    long part; /* beats in one part */
    int parts;
    double sum[ISO_PARTS + 1][1 + ISO_CLOCKS]; /* ln D and the clocks at the ends of the parts */
    double now[1 + ISO_CLOCKS];
    double limit, megno, digits, gain, gain_before, halves[2]; /* of the last look */
    bool looked_regular;
    int verdict;
    long decided;
} iso_indicators;

/* What the orbit has shown, NaN: not known. */
typedef struct iso_indication {
    iso_verdict verdict;                 /* ISO_REGULAR, ISO_CHAOTIC, ISO_UNDECIDED                                 */
    long turns;                          /* it took; undecided: all so far                                          */
    double per_turn, per_turn_error;     /* the largest exponent, per turn ...                                      */
    double exponent[ISO_CLOCKS];         /* ... and per unit of each clock                                          */
    double error[ISO_CLOCKS];            /* its standard error                                                      */
    double megno, megno_now, megno_mean; /* regular: the limit, else as megno_mean; Y_n; its mean                */
    double gali2;
    double digits; /* to how many digits the means over the halves agree                                      */
} iso_indication;

/* most: the turns at which the verdict is looked at last, 1 or more. It may go on; then it is looked at again at
 * sqrt(2) times as many, and so on. */
ISO_API void iso_indicators_begin(iso_indicators *it, long most);

/* Beats are given one after the other, from the first crossing after the start. */
ISO_API void iso_indicators_add(iso_indicators *it, const iso_beat *beat);

/* The turns at which the verdict is looked at next. */
ISO_API long iso_indicators_next(const iso_indicators *it);

/* A verdict stays. */
ISO_API iso_verdict iso_indicators_verdict(const iso_indicators *it);
ISO_API void iso_indicators_tell(const iso_indicators *it, iso_indication *told);

ISO_C_END

#endif

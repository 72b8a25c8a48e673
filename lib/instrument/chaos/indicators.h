/* indicators.h - is an orbit chaotic? The answer comes from its turns: returns to a section, or equal steps of a
 * clock. What is measured at the end of a turn is called a turn.
 *
 *     iso_indicators it;
 *     iso_indicators_begin(&it, 3000);                          no more than 3000 turns
 *     while (iso_indicators_verdict(&it) == ISO_UNDECIDED && it.turns < 3000) {
 *         ... the next crossing
 *         iso_indicators_add(&it, &turn);
 *     }
 *     iso_indicators_read(&it, &result);                          result.verdict, result.exponent[ISO_CLOCK_T]
 *
 * Each sample has the lengths of two deviations d1, d2, which start orthogonal, with length 1. After n turns
 * D_n = sqrt((|d1|^2 + |d2|^2)/2). D_n is the same for every such pair. On a regular orbit D_n^2 is a + b n + c n^2,
 * times a bounded factor that depends on the place only. On a chaotic orbit D_n^2 grows like exp(2 lam n).
 *
 * - Exponent: the gain of ln D per unit of a clock, without the first eighth of the turns. Its error comes from the
 *   scatter of blocks of the other turns, from 28 short ones to 3 long ones, and has a part for the times near
 *   islands that the orbit has missed. At most one orbit in ten should be off by more than two errors. While ln D is
 *   below 400 the orbit is too short to know the error, and none is stated. A regular orbit has the exponent 0: its
 *   error is the estimate itself. An orbit may go on after its verdict, for a better exponent.
 * - MEGNO: Y_n = (2/n) sum (j - 1/2) ln(D_j/D_(j-1)), and its mean over all turns so far. On a regular orbit both
 *   approach 2 like 1/n. On a chaotic orbit Y_n grows like lam n, and its mean like lam n/2.
 * - The limit of MEGNO on a regular orbit: the mean of 2 (j - 1/2) ln(D_j/D_(j-1)) with the smooth weight
 *   exp(-1/(u (1 - u))), where u goes from 0 to 1 over the last three quarters of the turns. On a quasi-periodic
 *   orbit the error of such a mean is smaller than any power of 1/n. The mean is then 2 + A/n; A/n is fitted and
 *   taken away. If D has grown little (the rotation number hardly depends on the torus), a + b n + c n^2 is fitted to
 *   D_n^2 instead: the limit is 2 if c > 0, and 0 if b and c are both 0 (isochronous motion).
 * - GALI_2: the sine of the angle between d1 and d2.
 * - Digits: two means of a function of the place, with the same weight, over the first and over the second half of
 *   those turns. They agree to many digits on a quasi-periodic orbit (S. Das, Y. Saiki, E. Sander, J. A. Yorke,
 *   Nonlinearity 30, 2017), to one or two digits on a chaotic orbit, and to three or four on an orbit that stays near
 *   an island for long.
 *   With five digits one look is enough to call an orbit regular. With six at two looks it is regular, even if MEGNO
 *   has not settled yet, as near a resonance.
 *
 * A look is a judgement of the orbit so far. The number of turns grows by sqrt(2) from look to look, and one look is
 * at the number given to iso_indicators_begin. indicators.c has the conditions of the verdict, lib/doc/measured.md
 * their calibration.
 */
#ifndef ISO_INSTRUMENT_CHAOS_INDICATORS_H
#define ISO_INSTRUMENT_CHAOS_INDICATORS_H

#include <stdbool.h>

#include "base/field.h"
#include "orbit/crossings.h"
#include "study/verdict.h"

/* The indicators of an orbit. NaN: not known. */
typedef struct iso_indication {
    iso_verdict verdict;                 /* ISO_REGULAR, ISO_CHAOTIC, ISO_UNDECIDED                                 */
    long turns;                          /* until the verdict; undecided: all so far                                */
    long exponent_turns;                 /* that the exponent is from; it may be more than `turns`                  */
    double per_turn, per_turn_error;     /* the largest exponent, per turn ...                                      */
    double exponent[ISO_CLOCKS];         /* ... and per unit of each clock                                          */
    double error[ISO_CLOCKS];            /* its error; NaN: the orbit is too short to know it                       */
    double megno, megno_now, megno_mean; /* the limit if regular and known, else megno_mean; Y_n; the mean of Y_n */
    double gali2;
    double digits; /* to which the means over the two halves agree                                            */
} iso_indication;

#endif

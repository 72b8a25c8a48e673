/* indicators_impl.h - the indicators of one orbit, beat by beat. */
#ifndef ISO_STUDY_CHAOS_INDICATORS_IMPL_H
#define ISO_STUDY_CHAOS_INDICATORS_IMPL_H

#include "study/chaos/indicators.h"

enum { ISO_SEEN = 3, ISO_WINDOWS = 4, ISO_PARTS = 32 };

/* One beat. Numbers that are not known are NaN. */
typedef struct iso_turn_sample {
    double clock[ISO_CLOCKS];      /* since the start                                                            */
    double growth[ISO_DEVIATIONS]; /* ln |d1|, ln |d2|; 0 at the start                                           */
    double area;                   /* sine of the angle between them                                             */
    double seen[ISO_SEEN];         /* smooth, one-valued functions of the place, of size 1; NaN: none            */
} iso_turn_sample;

/* Sums of one look; see indicators.c. */
typedef struct iso_window {
    long first, last; /* the turns n that it uses: first < n <= last */
    double weight[2], megno[2], growth[2], seen[2][ISO_SEEN], square[2][ISO_SEEN]; /* of each half               */
    double whole, megno_whole, inverse[3], power[5], length[3];                    /* of all                     */
} iso_window;

/* All that is known of one orbit so far, in memory of fixed size. Read it only with iso_indicators_read. */
typedef struct iso_indicators {
    long turns, most, number; /* number: of the next look */
    double before, area, step_sum, mean_sum;
    iso_window look[ISO_WINDOWS];
    long part; /* beats in one part */
    int parts;
    double sum[ISO_PARTS + 1][1 + ISO_CLOCKS]; /* ln D and the clocks at the ends of the parts */
    double now[1 + ISO_CLOCKS];
    double limit, megno, digits, gain, gain_before, halves[2]; /* of the last look */
    bool looked_regular;
    bool
        integrable; /* set by the caller after iso_indicators_begin: a further integral is known, so the orbit cannot be
                        chaotic, however its deviations grow near a separatrix */
    int verdict;
    long decided;
} iso_indicators;

/* most: the number of turns of the last look, 1 or more. After it the orbit may go on: the next look is at sqrt(2)
 * times as many turns, and so on. */
void iso_indicators_begin(iso_indicators *it, long most);

/* Takes the next beat. The first one is that of the first crossing after the start. */
void iso_indicators_add(iso_indicators *it, const iso_turn_sample *beat);

/* The number of turns at the next look. */
long iso_indicators_next(const iso_indicators *it);

/* Once the verdict is regular or chaotic, it does not change any more. */
iso_verdict iso_indicators_verdict(const iso_indicators *it);
void iso_indicators_read(const iso_indicators *it, iso_indication *told);

#endif

/* chaos_impl.h - what chaos.c and chaos_walk.c share.
 *
 *     chaos.c        options, refusals, the result
 *     chaos_walk.c   groups of orbits, round by round
 */
#ifndef ISO_INSTRUMENT_CHAOS_CHAOS_IMPL_H
#define ISO_INSTRUMENT_CHAOS_CHAOS_IMPL_H

#include "instrument/chaos/chaos.h"
#include "orbit/walk_impl.h"
#include "study/options_impl.h"

typedef struct iso_chaos_walk {
    iso_context *ctx;
    const iso_scene *scene;
    iso_chaos_options options;
    iso_effects effects;     /* that act on the motion */
    iso_orbit *orbit;        /* the scene's            */
    bool sampled;            /* the ball follows only every CHECKED-th of the starts that are spread */
    double spread_tolerance; /* of the starts that are spread */
    iso_starts starts;
    iso_chaos *out;
} iso_chaos_walk;

/* Follows all orbits. Errors: ISO_NO_MEMORY, ISO_STOPPED, those of iso_crossings_create, and the failure of the
 * scene's own orbit. */
iso_status iso_chaos_follow(iso_chaos_walk *w);

/* Follows the own orbits of free scenes together, in the lanes of the same vectors. They have the same options, the
 * same models, and no trace. The numbers are those of iso_chaos_follow, to the bit. Errors: ISO_NO_MEMORY,
 * ISO_STOPPED, those of iso_crossings_create; an orbit that fails says so in its own result. */
iso_status iso_chaos_follow_each(size_t count, iso_chaos_walk *const walk[]);

/* The failure of the scene's own orbit if no model could follow it. */
iso_status iso_chaos_check_own(const iso_chaos_walk *w);

/* The own orbits of many scenes, followed together: as fast as the starts of one scene. options: no starts, no axis.
 * scene[i] may be NULL. chaos[i], status[i]: those of iso_chaos_run for scene i, to the bit, but without a trace.
 * After a failure of scene i, chaos[i]->words says why (chaos[i] may be NULL). The caller frees each chaos[i].
 * Errors of the call: ISO_NO_MEMORY, ISO_STOPPED, and those of iso_crossings_create: then every chaos[i] is NULL. */
iso_status iso_chaos_run_many(iso_context *ctx, size_t count, const iso_scene *const scene[],
                              const iso_chaos_options *options, iso_chaos *chaos[], iso_status status[]);

/* Whether at least one model has followed this orbit for a turn, and none failed before there was a verdict. */
bool iso_chaos_followed(const iso_chaos_orbit *orbit);

/* --- the indicators of one orbit, turn by turn (indicators.c) --------------------------------------------------- */

enum { ISO_OBSERVABLES = 3, ISO_WINDOWS = 4, ISO_PARTS = 32 };

/* One turn. Numbers that are not known are NaN. */
typedef struct iso_turn_sample {
    double clock[ISO_CLOCKS];      /* since the start                                                            */
    double growth[ISO_DEVIATIONS]; /* ln |d1|, ln |d2|; 0 at the start                                           */
    double area;                   /* sine of the angle between them                                             */
    /* Smooth, one-valued functions of the place, of size 1; NaN: none. */
    double observable[ISO_OBSERVABLES];
} iso_turn_sample;

/* Sums of one window; see indicators.c. */
typedef struct iso_window {
    long first, last; /* the turns n that it uses: first < n <= last */
    /* Of each half. */
    double weight[2], megno[2], growth[2], observable[2][ISO_OBSERVABLES], square[2][ISO_OBSERVABLES];
    double whole, megno_whole, inverse[3], power[5], length[3]; /* of all                     */
} iso_window;

/* All that is known of one orbit so far, in memory of fixed size. Read it only with iso_indicators_read. */
typedef struct iso_indicators {
    long turns, most, number; /* number: of the next look */
    double before, area, step_sum, mean_sum;
    iso_window window[ISO_WINDOWS];
    long part; /* turns in one part */
    int parts;
    double sum[ISO_PARTS + 1][1 + ISO_CLOCKS]; /* ln D and the clocks at the ends of the parts */
    double now[1 + ISO_CLOCKS];
    double limit, megno, digits, gain, gain_before, halves[2]; /* of the last look */
    bool looked_regular, looked_smooth;
    /* Set by the caller after iso_indicators_begin: an additional integral is known, so the orbit cannot be chaotic,
     * however its deviations grow near a separatrix. */
    bool integrable;
    int verdict;
    long decided;
} iso_indicators;

/* most: the number of turns of the last look, 1 or more. After it the orbit may go on: the next look is at sqrt(2)
 * times as many turns, and so on. */
void iso_indicators_begin(iso_indicators *it, long most);

/* Takes the next turn. The first one is that of the first crossing after the start. */
void iso_indicators_add(iso_indicators *it, const iso_turn_sample *turn);

/* The number of turns at the next look. */
long iso_indicators_next(const iso_indicators *it);

/* Once the verdict is regular or chaotic, it does not change any more. */
iso_verdict iso_indicators_verdict(const iso_indicators *it);
void iso_indicators_read(const iso_indicators *it, iso_indication *result);

/* --- which share of the area do orbits of some kind have? (share.c) --------------------------------------------- */

enum { ISO_SHIFTS = 16 };

/* found[r] of count[r] starts of copy r are in the set. Without a start: NaN. */
void iso_share_interval(const size_t count[ISO_SHIFTS], const size_t found[ISO_SHIFTS], double *low, double *high);

/* The options of the study. */
typedef struct iso_chaos_request {
    iso_chaos_options how;
    iso_section_words words;
} iso_chaos_request;

/* Its text, and the lines of its table (chaos_print.c). */
void iso_chaos_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result);
iso_status iso_chaos_describe(iso_context *ctx, const iso_scene *scene, const void *options,
                              iso_study_result *result);

#endif

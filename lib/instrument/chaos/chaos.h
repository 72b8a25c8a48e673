/* chaos.h - which orbits of a scene are chaotic: exponents, MEGNO, GALI_2 and a verdict, by each model.
 *
 *     iso_chaos *c;
 *     iso_chaos_options o = iso_chaos_defaults();
 *     status = iso_chaos_run(ctx, &scene, &o, &c);     c->own.verdict, c->own.result[ISO_BALL].exponent[ISO_CLOCK_T]
 *     iso_chaos_free(c);
 *
 * An orbit is followed from turn to turn, with two deviations beside it (orbit/crossings.h), until the indicators
 * (indicators.h) decide, or for at most `turns`. The exponent of so short an orbit is rough, and its error is not
 * known: with `exponent_turns` a chaotic orbit goes on. A turn is a return to the section n_a = 0 (map/section.h), on
 * every level of the point's energy. If effects beyond a level act that keep the energy, a turn is the time
 * 2 pi/|k omega|, with omega at the start; in a potential |omega| is not taken less than the orbit's own unit of it.
 * The deviations have no part along the flow and none along the energy, since these parts tell nothing about chaos.
 *
 * A rotation in a principal plane is periodic. So it is regular, even if its neighbours leave it exponentially. It is
 * not followed.
 *
 * With `starts`, more orbits of the scene's energy begin on the section, spread evenly by the area dL dl. The share
 * of them that is chaotic estimates the chaotic part of the area. Its confidence interval of 95 % comes from the
 * starts themselves: they are 16 copies of one even sequence, each with a random shift of its own, and the scatter of
 * the copies shows the error (share.c). An orbit that stays undecided may be either: at the low end of the
 * interval it counts as not chaotic, at the high end as chaotic. Orbits that were not followed, because they failed
 * or because the call was stopped, do not count. After a stop the orbits that have made a turn count, so that an
 * early verdict has no advantage; those without a verdict are undecided.
 *
 * Ball and point are the same orbits, and the point is followed three times faster. So the point alone follows the
 * spread starts. The ball checks the verdict of every 16th of them, if 750 turns are enough for it. Both follow the
 * scene's own orbit and the starts that are given. With `models` ISO_SHOW_BOTH both follow every orbit.
 */
#ifndef ISO_INSTRUMENT_CHAOS_CHAOS_H
#define ISO_INSTRUMENT_CHAOS_CHAOS_H

#include <math.h>
#include <stdint.h>

#include "base/record.h"
#include "instrument/chaos/indicators.h"
#include "orbit/crossings.h"
#include "orbit/scene.h"

/* Verdicts do not need more: of 5600 starts (7 values of k, two balls) each had the same one at 1e-12.
 * tests/study/test_chaos.c repeats it. */
#define ISO_SPREAD_TOLERANCE 1e-10

typedef struct iso_chaos_options {
    long turns;            /* at most, of each orbit; 1 or more                                          */
    long exponent_turns;   /* an orbit that is chaotic goes on to so many turns, for its exponent; 0: it ends */
    size_t starts;         /* orbits spread over the section                                             */
    uint64_t seed;         /* another seed spreads them in another way                                   */
    const double (*at)[2]; /* (l, x) of further starts, |x| < 1; they are not in the share */
    size_t at_count;
    iso_models models;   /* which models are integrated; ISO_SHOW_START: both, if the isomorphism holds */
    int axis;            /* of the section, 0 to 2, which must be global; ISO_AXIS_AUTO: the global one */
    double tolerance;    /* NAN: the scene's; of spread starts at least ISO_SPREAD_TOLERANCE           */
    int threads;         /* 0: as many as there are processors to run on                               */
    const char *vectors; /* see batch.h                                       */
    /* Called with the part of the work that is done, in [0, 1]. May be NULL. */
    void (*progress)(void *data, double part);
    void *data;
} iso_chaos_options;

/* 3000 turns of the scene's own orbit. */
static inline iso_chaos_options iso_chaos_defaults(void)
{
    return (iso_chaos_options){.turns = 3000, .models = ISO_SHOW_START, .axis = ISO_AXIS_AUTO, .tolerance = NAN};
}

/* One orbit. result[ISO_BALL], result[ISO_POINT]: what each model has found. A model that was not integrated, or that
 * failed, has the verdict ISO_UNDECIDED; one that has not followed the orbit has 0 turns. */
typedef struct iso_chaos_orbit {
    double l, x; /* where it begins on the section; NaN: the scene's own */
    /* Of both models. If one is undecided, that of the other counts. If they disagree, the orbit is undecided. */
    iso_verdict verdict;
    bool disagree; /* one model says regular, the other one says chaotic */
    iso_indication result[2];
    iso_status status[2]; /* ISO_OK, or why it was not followed to its verdict                                 */
    size_t number;        /* 0: the scene's own; then the starts, from 1 on                                    */
} iso_chaos_orbit;

/* Counts of the orbits that were spread over the section. */
typedef struct iso_chaos_fraction {
    size_t asked, count, failed; /* of `asked` starts, `count` were followed, `failed` failed         */
    size_t chaotic, regular, undecided, disagree; /* of those followed; undecided includes disagree   */
    size_t checked;   /* of those followed, the orbits that both models decided; disagree is of these   */
    double tolerance; /* of the steps of these starts */
    /* The share chaotic/count, and the confidence interval of 95 % of the chaotic part, with undecided ones counted
     * both ways; NaN: no orbit was followed. */
    double share, low, high, half_interval; /* (high - low)/2 */
    double regular_share, undecided_share;
} iso_chaos_fraction;

typedef struct iso_chaos {
    bool with[2]; /* whether the ball, the point was integrated                           */
    int axis;     /* of the section n_a = 0; -1: turns are equal steps of time             */
    double turn;  /* ... of this length in t; NaN: the section's                           */
    /* 0 to 2: the scene's orbit is the rotation about this axis, in a principal plane; it is periodic, and not
     * followed. -1: it is no such rotation. */
    int plane;
    /* An additional integral, which excludes chaos: then no verdict is "chaotic"; NULL: none is known, or effects
     * act. */
    const iso_integral *integral;
    iso_chaos_orbit own;    /* the scene's orbit                                                    */
    size_t starts;          /* other orbits that were followed: spread ones, then given ones */
    iso_chaos_orbit *start; /* these orbits */
    iso_chaos_fraction share;
    /* The indicators of the scene's orbit against the turns: columns turn, t (for a point without a ball: s), growth
     * (ln D), megno (Y), mean and gali2. At most some thousand rows, evenly spread. NULL: not integrated. */
    iso_record *trace[2];
    iso_status failure; /* of the first orbit that failed (0: the scene's; i: start i - 1), with its text */
    char words[512];
    int chart; /* of the section on which the starts are: the axis, or that of a section which is not global */
} iso_chaos;

/* Orbits that fail are counted in the result. The call fails only if no model can follow the scene's own orbit.
 * options NULL: iso_chaos_defaults().
 * Errors:
 * - ISO_BAD_ARGUMENT: those of iso_crossings_create; about "turns" (below 1), "exponent_turns" (below 0);
 * - ISO_BAD_INPUT about an effect that takes energy or lets the ball roll away; about "M" or "angular_velocity" at
 *   rest; about "axis": orbits can stay away from its section;
 * - ISO_BAD_INPUT about `at`, `starts` or an effect: those of iso_section_run;
 * - those of iso_orbit_create: ISO_NOT_MAPPED if the point is asked for and there is none;
 * - ISO_STOPPED by the context's monitor: *chaos has what is known by then. */
iso_status iso_chaos_run(iso_context *ctx, const iso_scene *scene, const iso_chaos_options *options,
                         iso_chaos **chaos);
void iso_chaos_free(iso_chaos *chaos);

#endif

/* chaos.h - which orbits of a scene are chaotic: exponents, MEGNO, GALI_2 and a verdict, by both models.
 *
 *     iso_chaos *c;
 *     iso_chaos_options o = iso_chaos_defaults();
 *     status = iso_chaos_run(ctx, &scene, &o, &c);     c->own.verdict, c->own.told[ISO_BALL].exponent[ISO_CLOCK_T]
 *     iso_chaos_free(c);
 *
 * An orbit is followed from turn to turn, with two deviations beside it (orbit/crossings.h), until the indicators
 * (indicators.h) decide, or for `turns`. A turn of a free orbit is a return to the section n_a = 0 (map/section.h).
 * Where effects act that keep the energy, or the point is off its level H = 0, a turn is the time 2 pi/|k omega| of
 * the start. The deviations have no part along the flow nor along the energy: these tell of no chaos.
 *
 * A rotation in a principal plane is periodic, so regular, though its neighbours may leave it exponentially: it is not
 * followed.
 *
 * With `starts`, further orbits of the scene's energy begin on the section, spread evenly by the area dL dl. The
 * part of them that is chaotic estimates the part of the area. Its interval is Wilson's, at 95 %, as if the starts
 * were random; they are spread more evenly than that, so the interval is rather too wide. Orbits that stay undecided
 * are not in this part, but counted beside it.
 */
#ifndef ISO_STUDY_CHAOS_H
#define ISO_STUDY_CHAOS_H

#include <math.h>
#include <stdint.h>

#include "../base/api.h"
#include "../base/record.h"
#include "../orbit/crossings.h"
#include "../orbit/scene.h"
#include "indicators.h"

ISO_C_BEGIN

typedef struct iso_chaos_options {
    size_t size;           /* set by iso_chaos_defaults; see isoroll.h */
    long turns;            /* of each orbit, 1 or more                                                   */
    size_t starts;         /* orbits spread over the section                                             */
    uint64_t seed;         /* of their spreading                                                         */
    const double (*at)[2]; /* (l, x) of further starts, |x| < 1; they are not in the share */
    size_t at_count;
    iso_shown models;    /* that are integrated; ISO_SHOW_START: both, where a ball has a twin         */
    int axis;            /* of the section, 0 to 2, which must be global; ISO_AXIS_AUTO: the global one */
    double tolerance;    /* NAN: the scene's                                                           */
    int threads;         /* 0: as many as there are processors to run on                               */
    const char *vectors; /* see batch.h                                       */
    /* Is told the part of the work that is done, in [0, 1]; NULL: nobody is. */
    void (*progress)(double part, void *data);
    void *data;
} iso_chaos_options;

/* 3000 turns of the scene's own orbit. */
static inline iso_chaos_options iso_chaos_defaults(void)
{
    iso_chaos_options o = ISO_ALL_ZERO;
    o.size = sizeof o;
    o.turns = 3000;
    o.models = ISO_SHOW_START;
    o.axis = ISO_AXIS_AUTO;
    o.tolerance = NAN;
    return o;
}

/* One orbit. told[ISO_BALL], told[ISO_POINT]: what each model shows; of a model that is not asked, or that failed,
 * verdict ISO_UNDECIDED. */
typedef struct iso_chaos_orbit {
    double l, x;         /* where it begins on the section; NaN: the scene's own                              */
    iso_verdict verdict; /* that of the models; chaotic or regular by one and undecided by the other: decided;
                             regular by one and chaotic by the other: undecided                                */
    bool disagree;       /* regular by one, chaotic by the other                                              */
    iso_indication told[2];
    iso_status status[2]; /* ISO_OK, or why it was not followed to its verdict                                 */
} iso_chaos_orbit;

/* Of the orbits that were spread over the section, as many as were followed. */
typedef struct iso_chaos_share {
    size_t count, chaotic, regular, undecided; /* undecided: failed ones and those that disagree as well         */
    size_t disagree, failed;
    double share, low, high; /* chaotic/count, and the interval in which the area's part is, at 95 %            */
} iso_chaos_share;

typedef struct iso_chaos {
    bool with[2];           /* whether the ball, the point was integrated                           */
    int axis;               /* of the section n_a = 0; -1: turns are equal steps of time             */
    double turn;            /* ... of this length in t; NaN: the section's                           */
    int plane;              /* 0 to 2: the scene's orbit is the rotation about this axis, in a principal plane: it is
                               periodic, and not followed; -1: it is not                             */
    iso_chaos_orbit own;    /* the scene's orbit                                                    */
    size_t starts;          /* that were followed: spread ones, then given ones */
    iso_chaos_orbit *start; /* of these */
    iso_chaos_share share;
    /* How the indicators of the scene's orbit went: columns turn, t (of a point's orbit without a ball: s), growth
     * (ln D), megno (Y), mean and gali2. At most some thousand rows, evenly spread; NULL: not integrated. */
    iso_record *trace[2];
    iso_status failure; /* of the first orbit that failed, with its words                         */
    char words[512];
} iso_chaos;

/* A failure of some orbits is told in the result; the call fails if the scene's own orbit has no model that goes on.
 * options NULL: iso_chaos_defaults().
 * Errors:
 * - ISO_BAD_ARGUMENT: those of iso_crossings_create; about "turns" (below 1), "at" (outside of the chart);
 * - ISO_BAD_INPUT: an effect that takes energy or lets the ball roll away (about its name); a ball at rest; `starts`
 *   with effects or off the level H = 0 (about the effect): there the chart has no energy to go with; about
 *   "axis": orbits can stay away from its section;
 * - those of iso_orbit_create: ISO_NOT_MAPPED where the point is asked for and there is none;
 * - ISO_STOPPED by the context's monitor: *chaos has what is known by then. */
ISO_API iso_status iso_chaos_run(iso_context *ctx, const iso_scene *scene, const iso_chaos_options *options,
                                 iso_chaos **chaos);
ISO_API void iso_chaos_free(iso_chaos *chaos);

/* Wilson's interval for the part of a whole, of which `found` were found among `count`, at 95 %. */
ISO_API void iso_chaos_interval(size_t found, size_t count, double *low, double *high);

ISO_C_END

#endif

/* crossings_impl.h - what the files of crossings share.
 *
 *     crossings.c          checks the options, distributes the orbits, keeps the failures
 *     crossings_lanes.c    global sections and steps of a clock, in the lanes of vectors
 *     crossings_alone.c    every other orbit, one by one with iso_orbit_event or iso_orbit_at
 *     crossings_common.c   what these two have in common
 */
#ifndef ISO_ORBIT_CROSSINGS_IMPL_H
#define ISO_ORBIT_CROSSINGS_IMPL_H

#include "orbit/crossings.h"
#include "orbit/orbit_impl.h"

/* One orbit: where it is, and the bounds between its crossings. In own units of the orbit. */
typedef struct iso_crossing_orbit {
    iso_orbit *alone; /* the orbit, if it is followed alone; NULL: not begun                                     */
    iso_context *ctx; /* a context of its own, so that any thread can go on with it */
    struct iso_crossings_lane *lane; /* the orbit, if it is followed in lanes; NULL: not begun                    */
    size_t count;      /* crossings so far                                                                        */
    double time, s;    /* of the last crossing, or 0; time: of the orbit's own clock, in the caller's units       */
    bool begins_on_it; /* the start lies on the section: it is no crossing                                        */
    bool upwards;      /* ... and n_a increases there: a whole return to the first crossing                  */
    double bound[2];   /* least and largest s between two crossings; NaN: no bounds are known                     */
    int axis;          /* of ISO_SECTION_AXIS; -1: another kind */
    iso_status status; /* the failure that ended the orbit, or ISO_OK */
    char *why;         /* the message of this failure */
    char about[32];
} iso_crossing_orbit;

struct iso_crossings {
    iso_context *ctx;
    const iso_batch_orbit *orbits;
    size_t count;
    iso_crossings_options options;
    iso_crossing_orbit *orbit; /* of each */
};

/* A call of iso_crossings_go. */
typedef struct iso_crossings_task {
    const bool *wanted; /* NULL: every one */
    size_t each;
    size_t stride; /* from the first crossing of an orbit to that of the next one: `each` or more */
    iso_crossing *crossing;
    iso_sample *sample; /* NULL: none */
    size_t *done;
    iso_status *status;
} iso_crossings_task;

/* iso_crossings_go with crossing[stride i + j]. */
iso_status iso_crossings_go_apart(iso_crossings *c, const iso_crossings_task *task);

/* Whether orbit i is to go on, and has not failed. */
static inline bool iso_crossings_wants(const iso_crossings *c, const iso_crossings_task *t, size_t i)
{
    return (!t->wanted || t->wanted[i]) && c->orbit[i].status == ISO_OK;
}

/* Refuses options: the errors of iso_crossings_create but ISO_NO_MEMORY. */
iso_status iso_crossings_check(iso_context *ctx, const iso_crossings_options *options);

/* Follows the wanted orbits that lanes can hold; then all others, each by itself. done[], status[], the crossings and
 * samples are filled in. Errors: ISO_NO_MEMORY, ISO_STOPPED; failures of orbits are in status[i]. */
iso_status iso_crossings_in_lanes(iso_crossings *c, const iso_crossings_task *task);
iso_status iso_crossings_alone(iso_crossings *c, const iso_crossings_task *task);

/* Sets status[i]. Keeps a failure of orbit i, with its message, which is in ctx; not ISO_STOPPED: it can go on. */
void iso_crossings_keep(iso_crossings *c, const iso_crossings_task *task, const iso_context *ctx, size_t i,
                        iso_status status);

/* n_axis has at most one zero within 1/(this number) of `variable`: the clock t or s. Own units. */
double iso_crossings_zeros(iso_point_motion m, int axis, iso_clock variable);

/* Whether the distance `apart` in s of two crossings of a free orbit is within the bounds, up to rounding. s: of the
 * second crossing. NaN bounds allow everything. `least` false: the first is no crossing, so only the upper bound
 * counts. */
bool iso_crossings_apart(const double bound[2], bool least, double apart, double s, double tolerance);

/* The first attempt to prepare orbit i. Without an isomorphism there are no other clocks. */
iso_attempt iso_crossings_attempt(const iso_crossings *c, size_t i);

/* The options with which orbit i is created. */
iso_orbit_options iso_crossings_orbit_options(const iso_crossings *c, size_t i, iso_attempt attempt);

/* The model that an orbit integrates. */
static inline iso_model_kind iso_crossings_model(const iso_orbit *orbit)
{
    return orbit->options.backend == ISO_BACKEND_POINT ? ISO_POINT : ISO_BALL;
}

/* Refuses an axis that is neither ISO_AXIS_AUTO nor 0 to 2: ISO_BAD_ARGUMENT about "axis". */
iso_status iso_crossings_check_axis(iso_context *ctx, int axis);

/* Why an orbit, or a start at |x| = 1, does not cross the section n_axis = 0; both numbers are the axis, from 1. */
#define ISO_NEVER_CROSSES                                                                                            \
    "the rotation about axis %d, in the plane n_%d = 0 itself: it is the boundary of the section, and never "        \
    "crosses it"

/* Sets o->axis and o->bound of an orbit that is prepared (NaN if there are no bounds), and whether its start y, (omega,
 * n) or (M, gamma), lies on the section. Refuses an orbit that lies, and stays, in the plane n_axis = 0 itself. */
iso_status iso_crossings_begin(iso_context *ctx, const iso_crossings *c, const iso_params *p, const iso_orbit *orbit,
                               const double y[ISO_STATE], iso_crossing_orbit *o);

/* Fills in clocks and chart of the next crossing: `clock` in the caller's units, s in own units. y: (omega, n) or
 * (M, gamma), in any units. Errors: ISO_NUMERICAL, if it is not within the bounds. */
iso_status iso_crossings_add(iso_context *ctx, const iso_crossings *c, const iso_orbit *orbit,
                             const double clock[ISO_CLOCKS], double s, const double y[ISO_STATE],
                             iso_crossing_orbit *o, iso_crossing *to);

/* Makes NaN of what the caller does not ask for. */
void iso_crossings_hide(const iso_crossings *c, iso_sample *sample);

/* NaN in every number. */
void iso_crossing_blank(iso_crossing *crossing);

/* A start of this model on the section n_axis = 0, at (l, x), with the energy of `orbit`, on which nothing acts but a
 * level. */
iso_start iso_section_start(const iso_orbit *orbit, iso_model_kind model, int axis, double l, double x);

/* Why orbit i has failed: the message without its number. */
const char *iso_crossings_why(const iso_crossings *c, size_t i);

#endif

/* walk_impl.h - many orbits to their next stops (crossings of a section, or equal steps of a clock), each stop given to
 * a visitor.
 *
 *     static void begin(void *user, size_t i, iso_start *start, iso_batch_orbit *orbit);       what orbit i is
 *     static iso_status visit(void *user, size_t i, const iso_walk_stop *stop);                one of its stops
 *
 *     iso_walk w = {.ctx = ctx, .count = 1000, .most = 500, .models = 1, .user = &mine, .begin = begin, .visit = visit};
 *     w.options[0] = iso_crossings_defaults();
 *     status = iso_walk_go(&w);                          w.failed, w.failure and w.text: the orbits that did not get there
 *
 * A group of orbits is in memory at a time. It goes on round by round: all its orbits go to their next stops on all
 * threads, then the stops of the round are visited by one thread, orbit by orbit. So memory is bounded, and the visitor
 * sees the same stops in the same order for any number of threads. The stops of an orbit do not depend, not even in the
 * last bit, on groups and rounds (crossings.h).
 */
#ifndef ISO_ORBIT_WALK_IMPL_H
#define ISO_ORBIT_WALK_IMPL_H

#include "map/section_impl.h"
#include "orbit/crossings.h"
#include "orbit/orbit_impl.h"
#include "orbit/scene.h"

/* --- the walk --------------------------------------------------------------------------------------------------- */

typedef struct iso_walk_stop {
    size_t number;                   /* of the orbit's stops, from 1 on                                */
    const iso_crossing *crossing[2]; /* by the first model, by the second; NULL: it did not get there */
    const iso_sample *sample;        /* by the first model; NULL: none is asked for                    */
} iso_walk_stop;

typedef struct iso_walk {
    iso_context *ctx;
    size_t first, count; /* orbits first, first + 1, ... */
    size_t most;         /* stops of an orbit */
    /* All stops of an orbit are visited before those of the next one. Otherwise that is so only within a round. */
    bool in_order;
    bool samples;
    int models; /* 1 or 2, side by side */
    iso_crossings_options options[2];
    void *user;
    void (*begin)(void *user, size_t i, iso_start *start, iso_batch_orbit *orbit); /* what orbit i is ... */
    const struct iso_starts *starts; /* ... or, if begin is NULL, the orbits of a scene */
    /* How many stops orbit i still wants; 0: it ends. NULL: `most` stops of each. The round ends where the first of its
     * orbits has what it wants. */
    size_t (*wanted)(void *user, size_t i);
    iso_status (*visit)(void *user, size_t i, const iso_walk_stop *stop);                   /* ISO_OK to go on  */
    void (*failed_by)(void *user, size_t i, int model, iso_status status, const char *why); /* may be NULL */
    void (*progress)(void *user, double part); /* of the `most` stops of all orbits; may be NULL  */
    /* Set by iso_walk_go. */
    size_t begun;       /* orbits that it has taken up */
    size_t failed;      /* orbits that failed by at least one model */
    iso_status failure; /* of the first of them, with its text */
    char text[512];
    struct iso_walk_group *group; /* that is in memory, for iso_walk_fail */
    bool stopped;                 /* the monitor has ended the walk: the stops found by then are visited */
} iso_walk;

/* Orbits that fail are counted; the others go on. By two models each goes to its own end, but an orbit that stays away
 * from the section by the first is not followed by the second, which would search as long. Errors: those of
 * iso_crossings_create; of the visitor; ISO_STOPPED; ISO_NO_MEMORY. */
iso_status iso_walk_go(iso_walk *w);

/* For the visitor: orbit i has failed, by what was found at this stop. The walk counts it, and goes on with it. */
void iso_walk_fail(iso_walk *w, size_t i, iso_status status, const char *why);

/* Keeps the first failure, with the number of its orbit. */
void iso_walk_keep(iso_status *failure, char text[512], size_t i, iso_status status, const char *why);

/* About the time in which n or gamma turns once: by the clock t at the rate |k omega|, by s at the rate |M|. In a
 * potential it is at most that of the orbit's own unit. */
double iso_walk_turn(iso_orbit *orbit, iso_clock clock);

/* --- the orbits of a scene -------------------------------------------------------------------------------------- */

/* Orbit 0 is the scene's own. Then come `spread` orbits that begin on a section, spread evenly by its area dL dl, then
 * those at given points (l, x) of it. All have the scene's energy. */
typedef struct iso_starts {
    const iso_scene *scene;
    iso_orbit *orbit;     /* the scene's own */
    iso_effects *effects; /* that act */
    int axis;             /* of the section */
    size_t spread;
    uint64_t seed;
    unsigned copies; /* see map/section_impl.h */
    const double (*at)[2];
    iso_section_spread even;
} iso_starts;

/* Computes `even`, and states the level of the orbit among the effects: then every start is on it, not near it. */
void iso_starts_prepare(iso_starts *s);

/* Orbit i, and where it begins, (l, x); NaN of the scene's own. */
void iso_starts_orbit(const iso_starts *s, size_t i, double *l, double *x, iso_start *start, iso_batch_orbit *orbit);

#endif

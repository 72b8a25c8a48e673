/* study_impl.h - what the files of this folder offer to each other and to the rooms. */
#ifndef ISO_STUDY_STUDY_IMPL_H
#define ISO_STUDY_STUDY_IMPL_H

#include <stdio.h>

#include "map/section.h"
#include "task/analogue.h"
#include "task/compare.h"
#include "study/error.h"
#include "study/level.h"
#include "study/verdict.h"

/* --- words of enumerations, as fields ask for them (base/field.h) ----------------------------------------------- */

static inline const char *iso_clock_word(int clock)
{
    return iso_clock_name((iso_clock)clock);
}

static inline const char *iso_verdict_word(int verdict)
{
    return iso_verdict_name((iso_verdict)verdict);
}

/* --- what studies refuse (refusals.c) --------------------------------------------------------------------------- */

/* One situation has one status and one sentence, whatever the study. Each call is ISO_OK, or ISO_BAD_INPUT with the
 * sentence. `what` is the study's own part of it. A wrong number of an axis is refused by iso_crossings_check_axis,
 * because sections without a study have axes as well. */

/* About an effect that acts, other than a level. what: as in "periodic orbits are sought". */
iso_status iso_refuse_beyond_level(iso_context *ctx, const iso_effects *effects, const char *what);

/* About an effect that acts, other than a level or a magnetic field of the point. what: as above. */
iso_status iso_refuse_off_chart(iso_context *ctx, const iso_effects *effects, const char *what);

/* About "level", where the coupling eps is not above 0: a ball in the potential of a level can have so little energy
 * that its point is driven off, not held. what: as above. */
iso_status iso_refuse_coupling(iso_context *ctx, const iso_orbit *orbit, const char *what);

/* About an effect that takes energy from the ball of this orbit. what: as in "has no frequencies". */
iso_status iso_refuse_losses(iso_context *ctx, const iso_orbit *orbit, const char *what);

/* Losses, and effects that let the ball roll away. what: as above. */
iso_status iso_refuse_unbound(iso_context *ctx, const iso_orbit *orbit, const char *what);

/* About "J", where two moments are equal within rounding. what: as in "no periodic orbit is isolated". */
iso_status iso_refuse_equal_moments(iso_context *ctx, const double J[3], const char *what);

#define ISO_NO_RETURN "comes back to no section"

/* About "angular_velocity" or "M", at rest where no potential is. what: as in "has no frequencies". */
iso_status iso_refuse_rest(iso_context *ctx, const iso_start *start, const iso_effects *effects, const char *what);

/* About the same, at a start at rest in a potential, which will move. what: as in "deviations have no size". */
iso_status iso_refuse_start_at_rest(iso_context *ctx, const iso_start *start, const char *what);

/* Whether other starts can be given on the section n_axis = 0 of this orbit: `count` of them at (l, x), and spread
 * ones anywhere. About an effect with which the section has no chart; about "at" or "starts", where the start is
 * outside of the chart, or where the level closes it. */
iso_status iso_refuse_starts(iso_context *ctx, const iso_orbit *orbit, const iso_effects *effects, int axis,
                             const double (*at)[2], size_t count, bool spread);

/* --- the level of a scene (level.c) ----------------------------------------------------------------------------- */

/* A scene's motion with what fixes it. */
typedef struct iso_on_level {
    iso_units units;
    double h;      /* of the ball, own units                */
    double energy; /* H of the point for eps = 1, own units */
    double H;      /* the same level in the scene's units   */
} iso_on_level;

/* The problem of a scene's point in own units: params, eps of any sign, H, effects. eps is 0 for a ball at rest. what:
 * as in "integrals are sought". Errors: those of iso_refuse_off_chart and iso_orbit_create. */
iso_status iso_level_problem(iso_context *ctx, const iso_scene *scene, const char *what, iso_problem *problem);

/* Errors: those of iso_refuse_beyond_level, iso_refuse_coupling and iso_orbit_create. */
iso_status iso_level_find(iso_context *ctx, const iso_scene *scene, const char *what, iso_on_level *on);

/* --- which backend `auto` means for the questions of a run (backend.c) ------------------------------------------ */

/* What an orbit is asked for. */
typedef struct iso_questions {
    size_t rows;     /* this many times, ...                      */
    double farthest; /* ... this one the farthest, caller's units */
} iso_questions;

/* The orbit, as `how` says. ISO_BACKEND_AUTO there is the cheapest backend for the questions. If it has no such
 * orbit, it is what iso_orbit_create takes for ISO_BACKEND_AUTO. Errors: those of iso_orbit_create. */
iso_status iso_backend_open(iso_context *ctx, const iso_scene *scene, const iso_orbit_options *how,
                            const iso_questions *questions, iso_orbit **orbit);

/* --- the order in which an orbit is followed to times that come in any order (run.c) ---------------------------- */

/* The orbit is followed away from its start, and keeps no ends of steps. For a time that lies behind, it begins at
 * the start again. So the order of the work is: times after the start, then those before it; on each side the nearer
 * times come first, and equal times as they are asked for. */

/* A time asked for, and the row of the result that it belongs to. */
typedef struct iso_asked_time {
    double time;
    size_t row;
} iso_asked_time;

/* Whether the times already stand in the order of the work. */
bool iso_times_in_order(const double times[], size_t count);

/* The times in the order of the work, for the caller to free; count is above 0. NULL: no memory. */
iso_asked_time *iso_times_sorted(const double times[], size_t count);

/* --- the errors of error.h (error.c) ---------------------------------------------------------------------------- */

typedef struct iso_error_finder iso_error_finder;

/* Starts the finer orbit. params, start and options are those that `orbit` was created with; the orbit must outlive
 * the finder. Errors: ISO_BAD_ARGUMENT where there is nothing finer: for taylor_quad, and for taylor_extended where
 * taylor_quad is missing; where series do not serve, for tolerances below 1e-13 and for backend exact. ISO_NO_MEMORY,
 * and the errors of iso_orbit_create. After an error *finder is NULL. */
iso_status iso_error_finder_create(iso_context *ctx, const iso_params *params, const iso_start *start,
                                   const iso_orbit_options *options, const iso_orbit *orbit,
                                   iso_error_finder **finder);
void iso_error_finder_free(iso_error_finder *finder);

/* Compares the next row of the orbit. Rows may come in any order, but are cheap in the order that suits iso_orbit_at.
 * Errors: ISO_NUMERICAL when the finer orbit does not get there, or needs more than twenty times the orbit's steps
 * (backend exact has no steps: more than 200000); ISO_STOPPED. After an error nothing is known of this row. */
iso_status iso_error_finder_add(iso_error_finder *finder, const iso_sample *row);

/* The errors of the rows so far; with rows = 0 nothing is known. */
iso_error iso_error_finder_read(const iso_error_finder *finder);

/* --- in words --------------------------------------------------------------------------------------------------- */

enum { ISO_COMPARISON_WORDS = 512 };

/* The result of a comparison in one sentence, for people. True: it is the same orbit by all backends, since the largest
 * difference, *most, is within what the errors of the steps may add up to. False: the sentence says why not. */
bool iso_comparison_words(const iso_scene *scene, const iso_comparison *c, double *most,
                          char words[ISO_COMPARISON_WORDS]);

/* "k = 1, J = 1 2 5" (effects.c). What was given reads back as the same doubles. What was computed from a body has 15
 * digits: the others are rounding. */
void iso_params_print(FILE *to, const iso_params *params);

/* Prints those that act, with their numbers and, if wanted, what they are. Prints nothing where none acts. */
void iso_effects_print(FILE *to, const iso_effects *effects, bool docs);

/* --- comparisons (compare_fields.c) ----------------------------------------------------------------------------- */

/* Fields of a comparison, whose names depend on it: the largest differences. where: before the name; offset: of the
 * numbers. */
typedef struct iso_worst_fields {
    char name[ISO_DIFFERENCES - 1][ISO_COLUMN_SIZE];
    iso_field field[ISO_DIFFERENCES];
} iso_worst_fields;
void iso_comparison_worst(const iso_comparison *c, const char *where, size_t offset, iso_worst_fields *w);

/* --- the study analogue (analogue_study.c) ---------------------------------------------------------------------- */

typedef struct iso_analogue_request {
    double k, J[3], eps, neumann[3], energy; /* NAN: not given               */
    double mass, radius;                     /* NAN: analogue chooses        */
    bool level;
} iso_analogue_request;

/* Whether the options state a problem. If not, a scene must. */
bool iso_analogue_is_stated(const iso_analogue_request *request);

typedef struct iso_analogue_found {
    iso_analogue analogue;
    iso_analogue_ball ball;
    const char *text; /* the scene of the ball, with a report in # lines; it is freed with the rest */
} iso_analogue_found;

/* --- analogue.c ------------------------------------------------------------------------------------------------- */

/* Chooses what is NAN of mass and radius. a->room and a->reduced are known and have a body; start: of the point. */
void iso_analogue_choose_units(const iso_analogue *a, const double start[ISO_STATE], double *mass, double *radius);

#endif

/* study_impl.h - what the files of this folder offer to each other and to the rooms. */
#ifndef ISO_STUDY_STUDY_IMPL_H
#define ISO_STUDY_STUDY_IMPL_H

#include <stdio.h>

#include "map/section.h"
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
typedef struct iso_motion_level {
    iso_units units;
    double h;      /* of the ball, own units                */
    double energy; /* H of the point for eps = 1, own units */
    double H;      /* the same level in the scene's units   */
} iso_motion_level;

/* The problem of a scene's point in own units: params, eps of any sign, H, effects. eps is 0 for a ball at rest. what:
 * as in "integrals are sought". Errors: those of iso_refuse_off_chart and iso_orbit_create. */
iso_status iso_level_problem(iso_context *ctx, const iso_scene *scene, const char *what, iso_problem *problem);

/* Errors: those of iso_refuse_beyond_level, iso_refuse_coupling and iso_orbit_create. */
iso_status iso_level_find(iso_context *ctx, const iso_scene *scene, const char *what, iso_motion_level *on);

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

/* A number as a fraction where it is one, such as -1/2; else with six digits (effects.c). */
enum { ISO_FRACTION_SIZE = 32 };
char *iso_fraction_text(char text[static ISO_FRACTION_SIZE], double x);

/* "k = 1, J = (1, 2, 5)", with six digits, for titles. */
enum { ISO_BALL_SIZE = 120 };
char *iso_ball_text(char text[static ISO_BALL_SIZE], const iso_params *p);

/* "k = 1, J = 1 2 5" (effects.c). What was given reads back as the same doubles. What was computed from a body has 15
 * digits: the others are rounding. */
void iso_params_print(FILE *to, const iso_params *params);

/* Prints those that act, with their numbers and, if wanted, what they are. Prints nothing where none acts. */
void iso_effects_print(FILE *to, const iso_effects *effects, bool docs);

#endif

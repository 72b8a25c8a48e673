/* orbit_impl.h - what an orbit is made of, for the files of an orbit, exact_method.c and batch.c. */
#ifndef ISO_ORBIT_ORBIT_IMPL_H
#define ISO_ORBIT_ORBIT_IMPL_H

#include "model/model_impl.h"
#include "orbit/batch.h"
#include "orbit/description.h"

struct iso_orbit {
    iso_context *ctx;
    iso_orbit_options options;
    iso_units units;
    double unit_M, unit_clock[ISO_CLOCKS]; /* one own unit in the caller's */
    double h, eps, level;                  /* own units: energies of the ball and of the point, eps */
    iso_effects effects;                   /* own units                    */
    const iso_system *system;              /* that is integrated           */
    double length;                         /* |b|, in the caller's units; 1 for a reduced ball */
    iso_model model;
    bool rests;                                       /* nothing moves: clocks alone go on, evenly ... */
    double still[ISO_MAX_STATE], rate[ISO_MAX_STATE]; /* ... from this state at this rate */
    iso_integrator *integrator;
};

/* Refuses the point, because this effect breaks the isomorphism: ISO_NOT_MAPPED about the effect. */
iso_status iso_orbit_no_point(iso_context *ctx, const iso_effect *breaking);

/* Sets o->units, o->effects, o->h, o->eps, o->level and o->system from a start and what o->options ask for (the
 * backend not ISO_BACKEND_AUTO), and returns the start in that system's variables and own units. Errors: those of
 * iso_orbit_create. */
iso_status iso_orbit_find_start(iso_orbit *o, const iso_params *p, const iso_start *start, double y[ISO_STATE]);

/* All of an orbit but the integrator; returns the start of its model in y. Errors: those of iso_orbit_create. */
iso_status iso_orbit_prepare(iso_orbit *o, iso_context *ctx, const iso_orbit_options *options, const iso_params *p,
                             const iso_start *start, double y[ISO_MAX_STATE]);

/* The sample at `time` (in the caller's units) where the model's state is y. Errors: ISO_NUMERICAL where a number
 * does not fit a double, in own units or in the caller's. */
iso_status iso_orbit_make_sample(const iso_orbit *o, double time, const double y[], iso_sample *s);

/* Fails with ISO_NUMERICAL: what leaves the range of doubles for this k, and what to do about it. */
iso_status iso_orbit_too_extreme(const iso_orbit *o, const char *what, const char *advice);

/* Whether it is better to integrate the point, which needs fewer products than the ball. For |k| < 1/8 it is not:
 * powers q^(1/k) grow large, and the map between the models is steep. */
bool iso_point_is_better(const iso_params *p);

/* How an orbit of a batch, or of crossings, is prepared: one attempt after the other, until one succeeds.
 *
 *     iso_attempt attempt = iso_attempt_first(...);
 *     do
 *         status = ...;   prepares the orbit by attempt.backend, with all clocks if attempt.clocks
 *     while (iso_attempt_next(&attempt, status));
 */
typedef struct iso_attempt {
    iso_backend backend, last; /* now; of the last attempt                    */
    bool clocks, all_clocks;   /* now; of the first attempt with each backend */
} iso_attempt;

/* If `asked` is ISO_BACKEND_AUTO and the point is better, the point comes first. `last` comes last. Each is tried
 * with all clocks if all_clocks. */
iso_attempt iso_attempt_first(const iso_params *p, iso_backend asked, iso_backend last, bool all_clocks);

/* Goes to the next attempt, if one is left after this status: without the other clocks if their numbers do not fit a
 * double (ISO_NUMERICAL), else by the last backend. */
bool iso_attempt_next(iso_attempt *attempt, iso_status status);

/* The most that the orbit's clock gains while t goes on by 1, in own units. */
double iso_orbit_fastest(const iso_orbit *o);

/* From now on the orbit may take this many steps, counted from its start; 0: any number. */
void iso_orbit_allow_steps(iso_orbit *o, long max_steps);

/* The method of backend ISO_BACKEND_EXACT: a model of the point is found by its closed solution. */
extern const iso_method iso_method_exact;

/* The number in a column (iso_column_find); sets it; makes NaN of all. */
double iso_sample_column(const iso_sample *sample, int column);
void iso_sample_set_column(iso_sample *sample, int column, double value);
void iso_sample_blank(iso_sample *s);

/* (M, gamma) where the model's state is y; and the state of the whole model where a sample is. Own units. */
void iso_orbit_as_point(const iso_orbit *o, const double y[], double point[ISO_STATE]);
void iso_orbit_state_of(const iso_orbit *o, const iso_system *system, const iso_sample *sample, double y[]);

/* The ball's integral beyond the energy and the constraints; NULL: none is known. */
const iso_integral *iso_orbit_additional_integral(const iso_orbit *orbit);

/* Whether a time can be asked for: finite, within 1e15 turns of the start, and by an explicit method not through more
 * than 1e6 times in which a stiff motion dies away. Errors: ISO_BAD_ARGUMENT about "end" or "method". */
iso_status iso_orbit_check_time(const iso_orbit *orbit, double time);

/* Tells the orbit that the next times have equal steps. The closed solution is then faster if steps are short, but
 * its last digits depend on the times before. Uneven times still give right states. Other backends ignore this. */
void iso_orbit_expect_even_times(iso_orbit *orbit);

/* The end of the last good step, in the options' clock. */
double iso_orbit_reached(const iso_orbit *orbit);

/* The motion of the point, own units: its coupling, and its level H, which is 0 for the point of a free ball. */
iso_point_motion iso_orbit_motion(const iso_orbit *orbit);

/* --- scenes ----------------------------------------------------------------------------------------------------- */

/* The normal n at a start: that of the ball, or of the ball's image of the point. */
void iso_start_normal(const iso_params *params, const iso_start *start, double n[3]);

/* Finds the effects that are idle from this start on (iso_effects_settle). */
void iso_start_settle(const iso_params *params, const iso_start *start, iso_effects *effects);

/* The effects of a scene, settled. */
iso_effects iso_scene_effects(const iso_scene *scene);

/* Puts the scene on a level of the point's energy, (H/eps) J2^(1/k) (study/level.h); 0 is the free motion. A point
 * keeps eps, gamma and the direction of M. A ball keeps omega and n, and gets the effect `level`, or loses it.
 * Errors: ISO_BAD_INPUT: about "level", where the point cannot be at this gamma on this level; about "M" or
 * "angular_velocity" at rest; about "eps", not above 0; about an effect that acts. Those of iso_orbit_create. */
iso_status iso_scene_on_level(iso_context *ctx, iso_scene *scene, double level);

/* The column called `name`; -1: there is none. All names, for lists of them; returns their number. */
int iso_column_find(const char *name);
int iso_column_names(const char *names[ISO_TRAJECTORY_COLUMNS]);

/* The effect that a column needs; ISO_EFFECTS: none. */
iso_effect_id iso_column_effect(int column);

/* Errors: ISO_BAD_INPUT about "columns" when one of the scene's needs an effect that the scene has not. */
iso_status iso_scene_check_columns(iso_context *ctx, const iso_scene *scene);

/* --- descriptions ----------------------------------------------------------------------------------------------- */

/* The first column, in a trajectory, of a group of an effect's columns, and the group (NULL: not asked). name NULL: the
 * first group that moves. -1: there is none. */
int iso_effect_group(iso_effect_id id, const char *name, const iso_effect_column **group);

/* The column of a record for each number of a sample; -1: it is not there. And a row as a sample: NaN for those. */
void iso_record_find_columns(const iso_record *r, int columns[ISO_TRAJECTORY_COLUMNS]);
void iso_sample_of_row(const int columns[ISO_TRAJECTORY_COLUMNS], const double row[], iso_sample *sample);

/* Whether all columns of a group of an effect are there; name NULL: of the first group that moves. And those of what
 * an effect that acts on nothing begins with: the numbers that turn with the ball, and on a plane the displacement,
 * without which the height is not known. */
bool iso_columns_have_group(const int columns[ISO_TRAJECTORY_COLUMNS], iso_effect_id id, const char *name);
bool iso_columns_have_beginning(const int columns[ISO_TRAJECTORY_COLUMNS], const iso_params *p, iso_effect_id id);

/* The key of the line that states a number or an expression of an effect: "effect.name". */
void iso_effect_line(char key[ISO_NAME_SIZE], const iso_effect *effect, const char *name);

/* Writes the start of an orbit as a scene states it: `initial.normal` and `initial.angular_velocity` of a ball,
 * `initial.gamma` and `initial.M` of a point. */
iso_status iso_record_describe_start(iso_context *ctx, iso_record *record, const iso_start *start);

/* The six columns of a model. Errors: ISO_BAD_INPUT about "columns". */
iso_status iso_record_find_state(iso_context *ctx, const iso_record *record, iso_model_kind model,
                                 int columns[ISO_STATE]);

/* Six numbers of a row as the start of an orbit in `model`; eps of a point, or NULL. Rows of others have few
 * digits: `tolerance` says how far |n| (|gamma|) may be from 1, and how large a part of omega along n (of M along
 * gamma) may be, relative to omega. A ball that twists may have any such part.
 * Errors: ISO_BAD_INPUT: not within the tolerance (the message names one that takes the row), or no state at all. */
iso_status iso_start_from_row(iso_context *ctx, iso_model_kind model, const double y[ISO_STATE], const double *eps,
                              bool twists, double tolerance, iso_start *start);

/* The same of a row that is not in the record: `row` has as many numbers as the record has columns. Messages do not
 * give its place. */
iso_status iso_record_start_at(iso_context *ctx, const iso_record *record, const iso_params *params,
                               iso_model_kind model, const double row[], iso_start *start, iso_effects *effects);

/* Writes the lines without which a record cannot be converted back: model, k and J. An orbit (may be NULL) adds
 * h, eps and the effects. A number that is no normal double in these units is left out: h, eps and the level of a
 * point follow from any row. */
iso_status iso_record_describe(iso_context *ctx, iso_record *record, const char *model, const iso_params *params,
                               const iso_orbit *orbit);

/* Writes only the lines of the effects. */
iso_status iso_record_describe_effects(iso_context *ctx, iso_record *record, const iso_effects *effects);

/* Writes all that a scene says but its times, columns and solver: a table of its orbits begins with these lines, and
 * the scene can be made again from them. They are those of iso_record_describe, the start, and the version of
 * isoroll. */
iso_status iso_record_describe_scene(iso_context *ctx, iso_record *record, const iso_scene *scene);

/* The upward vertical in axes of space, where it is constant: R(Q) u, by the lines `attitude.quaternion` (Q) and
 * `gravity.up` (u), or by the columns q0..3 and e1..3 of the first row. False: the record does not say it, or a line
 * is damaged. */
bool iso_record_up(iso_context *ctx, const iso_record *record, double up[3]);

const iso_model *iso_orbit_model(const iso_orbit *orbit);
const iso_units *iso_orbit_units(const iso_orbit *orbit);

/* The closed solution behind an orbit of backend ISO_BACKEND_EXACT, in own units; NULL for other backends. */
const iso_exact *iso_orbit_exact(const iso_orbit *orbit);

/* The effects that act, in the caller's units: those asked for, and the level of a point off H = 0. */
iso_effects iso_orbit_effects(const iso_orbit *orbit);

/* The effects that act on the motion of a scene: all but observers, and but those that only observe from its start
 * on, as the weight on a horizontal plane does. */
iso_effects iso_scene_acting(const iso_scene *scene);

/* Puts "name:line:column: " before the context's message if the failure is about a key that the scene was read with,
 * or about one that follows from it (k from `surface`). Then it is a mistake in the file, and ISO_BAD_ARGUMENT
 * becomes ISO_BAD_INPUT. Returns the status. */
iso_status iso_scene_blame(iso_context *ctx, const iso_scene *scene, const char *name, iso_status status);

/* What the place of a number is called, before its key, if the number as it is written is not what its double stands
 * for (base/rational_impl.h). */
#define ISO_ROUNDED_KEY "rounded "

/* Whether `k` or `J` of a scene file was rounded so. */
bool iso_scene_is_rounded(const iso_scene *scene, const char *key);

/* The value of this key no longer comes from the file: iso_scene_blame puts no place before failures about it. */
void iso_scene_forget_place(iso_scene *scene, const char *key);

/* Errors: ISO_BAD_ARGUMENT about "end" or "step": not finite, or more than ISO_MOST_ROWS rows. */
iso_status iso_scene_check_times(iso_context *ctx, const iso_scene *scene);

#endif

/* effects_impl.h - the effects for the rest of the library: their rows, what several of them use, and what they do.
 * effect.c asks the rows through the table; the rows in their turn ask which other effects are on. */
#ifndef ISO_MODEL_EFFECTS_EFFECTS_IMPL_H
#define ISO_MODEL_EFFECTS_EFFECTS_IMPL_H

#include <stddef.h>
#include <string.h>

#include "model/effects/effect.h"

#define ISO_EFFECT_ROW(ID, name) extern const iso_effect iso_effect_##name;
ISO_EFFECT_LIST(ISO_EFFECT_ROW)
#undef ISO_EFFECT_ROW

/* The registry, in the order of iso_effect_id. */
extern const iso_effect *const iso_effect_list[ISO_EFFECTS];

/* The row of a group of columns; then further members. */
#define ISO_COLUMN(name_, column_, count_, unit_, doc_, ...)                                                         \
    {                                                                                                                \
        .name = name_, .column = column_, .count = count_, .unit = unit_, .doc = doc_, __VA_ARGS__                   \
    }

/* For the rows: states that are there on a plane alone, and what many of them answer. */
bool iso_is_plane(const iso_problem *f);
iso_work iso_no_work(const iso_problem *f);
iso_work iso_work_lost(const iso_problem *f);

/* The effect called `name`; ISO_EFFECTS: there is none. The name of the effect `id`; NULL past the last. */
iso_effect_id iso_effect_find(const char *name);
const char *iso_effect_name(int id);

/* --- which are on, and which act -------------------------------------------------------------------------------- */

/* Whether there are none: the free ball asks at each step, and should not look through the table. */
static inline bool iso_effects_none(const iso_effects *effects)
{
    static const bool off[ISO_EFFECTS] = {false};
    return memcmp(effects->on, off, sizeof off) == 0;
}

/* *to = *from. Without the texts if nothing is on: nobody reads them then. */
static inline void iso_effects_copy(const iso_effects *from, iso_effects *to)
{
    memcpy(to, from, iso_effects_none(from) ? offsetof(iso_effects, written) : sizeof *to);
}

/* Finds the effects that have no torque from a start with this normal on, up to rounding, and notes them in `idle`:
 * the weight on a horizontal plane only presses the ball down. Orbits settle their effects themselves. */
void iso_effects_settle(const iso_params *params, const double normal[3], iso_effects *effects);

/* Whether an effect that is on changes the motion: it is no observer, and not idle. */
bool iso_effect_acts(const iso_effects *effects, iso_effect_id id);

/* Those that act, and the integrals that are watched, of effects that are settled. Of a scene: iso_scene_acting
 * (orbit/scene.h). */
iso_effects iso_effects_acting(const iso_effects *effects);

/* The first effect of its kind; NULL: none. */
const iso_effect *iso_effects_idle(const iso_effects *effects);
const iso_effect *iso_effects_ball_only(const iso_effects *effects); /* an observer that only backend ball has */
const iso_effect *iso_effects_breaking(const iso_effects *effects);  /* breaks the isomorphism, and why: */
const char *iso_effect_why_broken(const iso_effect *effect);
const iso_effect *iso_effects_beyond_level(const iso_effects *effects);    /* acts, and is no level */
const iso_effect *iso_effects_beyond_rotor(const iso_effects *effects);    /* acts, and is no level and no rotor */
const iso_effect *iso_effects_without_formula(const iso_effects *effects); /* its torque is a function, no formula */
const iso_effect *iso_effects_magnetic(const iso_problem *f);              /* is a magnetic field on the point */
const iso_effect *iso_effects_taking_energy(const iso_problem *f);
const iso_effect *iso_effects_changing_energy(const iso_problem *f); /* in any way: ISO_WORK_UNKNOWN */
/* takes the chart of sections away: on the point it is more than a magnetic field, so that H and gamma do not tell |M|
 * any more, or it has no image */
const iso_effect *iso_effects_off_chart(const iso_effects *effects);
const iso_effect *iso_effects_without_frequencies(const iso_problem *f, const char **why); /* of n(t), and why */

/* Whether an effect that is on has the property; `image`, `pull`, `written`: one that acts. */
bool iso_effects_twist(const iso_effects *effects);  /* the contact is not rigid */
bool iso_effects_clocks(const iso_effects *effects); /* the clocks are asked for */
bool iso_effects_need_D(const iso_effects *effects);
bool iso_effects_need_radius(const iso_effects *effects);
bool iso_effects_have_image(const iso_effects *effects); /* a potential or a field on the point, beyond a level */
bool iso_effects_pull(const iso_effects *effects);       /* a potential, which moves a ball that is at rest */
bool iso_effects_written(const iso_effects *effects);    /* expressions of the scene */

/* Whether nothing acts but a level, which the isomorphism turns into a constant. */
bool iso_effects_are_free(const iso_effects *effects);

/* Whether one of the additional integrals survives all effects. */
bool iso_effects_keep(const iso_problem *f, iso_additional integral);

/* Whether the energy is conserved, and known from the state: on a plane the height is a state of `attitude`. */
bool iso_effects_keep_energy(const iso_problem *f);

/* Whether each motion, backwards in time and with the signs of n's components changed by `sign`, is a motion as well
 * (likewise gamma). A free ball has this for all signs. */
bool iso_effects_reversible(const iso_problem *f, const double sign[3]);

/* --- the level and the rotor, which the isomorphism carries to the point ----------------------------------------- */

/* c of U = -c (n,J^-1 n)^(-1/k), and whether there is one. */
static inline bool iso_effects_have_level(const iso_effects *effects)
{
    return effects->on[ISO_LEVEL];
}

static inline double iso_effects_level(const iso_effects *effects)
{
    return effects->number[ISO_LEVEL][0];
}

static inline void iso_effects_set_level(iso_effects *effects, bool there, double c)
{
    effects->on[ISO_LEVEL] = there;
    effects->number[ISO_LEVEL][0] = c;
}

/* The name of the effect, and the dimension of c. */
const char *iso_level_name(void);
iso_dimension iso_level_dimension(void);

/* K of the rotor, 3 numbers; zeros: none. Sets K of a rotor that is on. */
const double *iso_effects_rotor(const iso_effects *effects);
void iso_effects_set_rotor(iso_effects *effects, const double K[3]);

/* --- their numbers and columns ---------------------------------------------------------------------------------- */

/* Where an effect's number stands: number->count doubles, as const as `effects` is. */
double *iso_effect_values(const iso_effects *effects, iso_effect_id id, const iso_effect_number *number);

/* The effects carried from the caller's units to own ones (power -1), or back (power 1). */
void iso_effects_scale(iso_effects *effects, const iso_units *units, int power);

/* Whether the effect has an expression, or its row a number that is not hidden, of this name. */
bool iso_effect_is_key(const iso_effect *effect, const char *name);

/* Why `name` cannot be the name of a parameter of the effect; NULL: it can. */
const char *iso_effect_bad_parameter(const iso_effect *effect, const char *name);

/* Whether the scene writes expression `which` of an effect: only the first one must be there, if each has a key. */
bool iso_written_has(const iso_effects *effects, iso_effect_id id, int which);

/* Whether an effect that is on acts by expressions of the scene; those of an observer may have corners. */
bool iso_written_drives(const iso_effects *effects, iso_effect_id id);

/* What is wrong with numbers or combinations, as the physics sees it: an effect that cannot matter here (gravity on a
 * horizontal plane, a constant field), numbers that are none, a torque or a potential of the scene's own that is no
 * finite number at the start. `start` is omega, n there. Makes unit vectors of those that are (to 1e-6), and fills in
 * numbers that follow from others: the attitude, where it was not given. Errors: ISO_BAD_INPUT about the effect's name,
 * its number's or its expression's. */
iso_status iso_effects_check(iso_context *ctx, const iso_params *params, const double start[ISO_STATE],
                             iso_effects *effects);

/* The columns of all effects, in the order of the registry: column i, from 0; its effect, its group and which of the
 * group it is (each may be NULL). NULL past the last. */
const char *iso_effect_column_name(int i, iso_effect_id *effect, const iso_effect_column **group, int *in_group);

/* How many columns all effects have, and the first one of effect `id`. */
int iso_effect_columns(void);
int iso_effect_first_column(iso_effect_id id);

/* --- their states and equations --------------------------------------------------------------------------------- */

/* How many states an effect has here. */
int iso_effect_states(const iso_effect *effect, const iso_problem *f);

/* Gives the states of all effects that are on their places in the ball's y; returns how many numbers y then has. */
int iso_effects_place_states(iso_problem *f);

/* The group of states that y[at] belongs to, of which effect it is, and which of the group; NULL: of none. */
const iso_effect_state *iso_effects_state_at(const iso_problem *f, int at, iso_effect_id *effect, int *in_group);

/* Whether `begin` gives its states at any time. Such an effect has no other states. */
bool iso_effect_is_derived(const iso_effect *effect);

/* Writes down the equations of all effects: the ball's motion (`series`: derived states are formulas) and energy, or
 * the image on the point. problem->at must be set. What cannot be computed is `overrun` or `wrong`. */
void iso_effects_record_motion(const iso_problem *f, bool series, iso_formula *F);
void iso_effects_record_energy(const iso_problem *f, iso_formula *F);
void iso_effects_record_image(const iso_problem *f, iso_formula *F);

/* y' in the system's own clock, from the recurrences: the same as m->own_rhs, by the other statement of the
 * equations. Slower: a test holds the two against each other. */
struct iso_model;
void iso_model_rhs_of_recurrences(const struct iso_model *m, const double y[], double dy[]);

/* All torques on the ball but the contact's; the rates of effects' states in dy. */
void iso_effects_torque(const iso_problem *f, const double y[], double T[3], double dy[]);

/* lambda of the torque lambda n by which a contact that is not rigid resists twisting. */
double iso_effects_twist_torque(const iso_problem *f, const double y[]);

/* Sums over the effects of a problem: potential energy of the ball, and of the image of a point; the size of what
 * makes them, for error control. */
double iso_effects_potential(const iso_problem *f, const double y[]);
double iso_effects_image(const iso_problem *f, const double y[]);
double iso_effects_strength(const iso_problem *f, const double y[]);
double iso_effects_range(const iso_problem *f, const double y[]);
double iso_effects_largest(const iso_problem *f, const double y[]); /* that of `range` alone */

/* How many times faster than the ball turns, in its own units, the effects make motion die away: the largest of them.
 * Above ISO_STIFF explicit methods are held up; the torque of a contact that alone is as stiff is a state, lambda. */
enum { ISO_STIFF = 50 };
double iso_effects_stiffness(const iso_problem *f);

/* The turns of the ball, in its own units, for which it moves at most before resistance has brought it to rest, all
 * the way through the range of doubles; infinite where nothing does, or something keeps it moving. */
double iso_effects_moving(const iso_problem *f);

/* In own units a ball that turns more slowly than this, and only loses motion, is at rest: a tolerance of that is
 * still a normal double. */
#define ISO_REST 1e-290
bool iso_effects_at_rest(const iso_problem *f, const double y[]);

/* The integrals that come with an effect, of a system; NULL: none. */
const iso_integral *iso_effect_integrals_of(const iso_effect *effect, const iso_system *system);

/* The integrals of a system that hold for a problem, those of its effects last: at most `most` into list, and how
 * many there are. */
int iso_integrals_holding(const iso_system *system, const iso_problem *f, const iso_integral *list[], int most);

/* --- of single effects ------------------------------------------------------------------------------------------ */

/* The upward vertical of gravity: at the start, in body axes, 3 numbers (without gravity they mean nothing); at y. */
const double *iso_effects_up(const iso_effects *effects);
const double *iso_vertical(const iso_problem *f, const double y[]);

/* Whether a run ends where contact is lost; whether the pressure of the contact changes where it begins at 0. */
bool iso_effects_watch_contact(const iso_effects *effects);
bool iso_effects_change_pressure(const iso_params *params, const iso_effects *effects);

/* The vector v of body axes in space axes, by the quaternion Q of attitude (its rotation times |Q|^2); as a formula. */
void iso_turn_to_space(const double Q[4], const double v[3], double in_space[3]);
iso_vector iso_in_space(iso_formula *F, const iso_problem *f, iso_vector v);

#endif

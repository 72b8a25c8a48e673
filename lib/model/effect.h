/* effect.h - what can act on the ball beyond (9), or be asked of it: the third table of the library.
 *
 * A row is everything the rest of the library knows of an effect. Adding one is one file, its numbers in field.h and
 * one line in effect.c. A function that is NULL is a thing the effect does not do. States y are those of the whole
 * model (model.h): omega, n, then the states of the effects, those of effect e from y[f->at[e]] on.
 *
 *     effect              torque MQ on the ball                 states          isomorphism
 *     gravity             mgb e x n                             e (3)           lost
 *     field               k n x (C n + l)                       none            kept, V + U/G
 *     level               2 c g^(-1/k - 1) n x J^-1 n           none            kept, H = c det J/k^2
 *     twist               -c (omega,n) n, contact not rigid     lambda, stiff   lost
 *     rolling_resistance  -c_r omega                            none            lost
 *     attitude            none                                  Q (4), x (3)    kept
 *     reactions           none                                  none            kept
 *     clock               none                                  tau, s          kept
 */
#ifndef ISO_MODEL_EFFECT_H
#define ISO_MODEL_EFFECT_H

#include "system.h"

/* A number that a scene or a trajectory file states of an effect, and where it stands in iso_effects. */
typedef struct iso_effect_number {
    const char *name;
    size_t offset;
    int count;
    iso_dimension dimension;
} iso_effect_number;

typedef struct iso_effect {
    const char *name, *doc;
    const char *breaks;               /* why no isomorphism survives it; NULL: it does                           */
    const iso_effect_number *numbers; /* ended by a row without a name                                           */

    /* Its own states: names, what they are, how many there are here, where they begin; y' (in dy the system's is
     * there already) and its slope d y'_i/d y_j at jac[dim i + j] (likewise); sizes for error control; what brings
     * them back to their constraints, and the relative correction. */
    const char *const *state, *states_doc;
    int (*states)(const iso_field *f);
    void (*begin)(const iso_field *f, double y[]);
    void (*rates)(const iso_field *f, const double y[], double dy[]);
    void (*rates_slope)(const iso_field *f, const double y[], const double dy[], int dim, double jac[]);
    void (*size)(const iso_field *f, const double y[], double size[]);
    double (*restore)(const iso_field *f, double y[]);

    /* On the ball: MQ, added to T; its slope, added to slope[dim i + j] for i < 3; potential energy; and how large the
     * potential is made, for the speed it can give. */
    void (*torque)(const iso_field *f, const double y[], double T[3]);
    void (*torque_slope)(const iso_field *f, const double y[], int dim, double slope[]);
    double (*potential)(const iso_field *f, const double y[]);
    double (*strength)(const iso_field *f, const double y[]);
    double (*range)(const iso_field *f, const double y[]); /* how large U can be, if more than that */
    double (*stiffness)(const iso_field *f);               /* see iso_effects_stiffness             */

    /* Its image on the point: gamma x dV/dgamma, its slope, and V. */
    void (*image)(const iso_field *f, const double y[], double T[3]);
    void (*image_slope)(const iso_field *f, const double y[], int dim, double slope[]);
    double (*image_potential)(const iso_field *f, const double y[]);

    const iso_integral *integrals; /* that come with it, ended by a row without a name; NULL: none               */
} iso_effect;

/* The registry, in the order of iso_effect_id. */
extern const iso_effect *const iso_effect_list[ISO_EFFECTS];

/* Where an effect's number stands: number->count doubles, as const as `effects` is. */
double *iso_effect_values(const iso_effects *effects, const iso_effect_number *number);

/* What is wrong with numbers or combinations, as the physics sees it: an effect that cannot matter here (gravity on a
 * level plane, a constant field), numbers that are none. `normal` is n at the start. Makes `up` and `quaternion` unit
 * vectors (to 1e-6). Errors: ISO_BAD_INPUT about the effect's name or its number's. */
iso_status iso_effects_check(iso_context *ctx, const iso_params *params, const double normal[3], iso_effects *effects);

/* Whether gravity has no torque, up to rounding: on a plane with `up`, a unit vector, along the normal the weight
 * only presses the ball down. */
bool iso_effects_on_level_plane(const iso_params *params, const double normal[3], const iso_effects *effects);

/* The effects carried from the caller's units to own ones (power -1), or back (power 1). */
iso_effects iso_effects_scaled(const iso_effects *effects, const iso_units *units, int power);

/* Those that act on the motion: without attitude, reactions and clock, which are only asked of it. */
iso_effects iso_effects_acting(const iso_effects *effects);

/* The first effect that breaks the isomorphism; NULL: none. */
const iso_effect *iso_effects_breaking(const iso_effects *effects);

/* Sums over the effects of a field: potential energy of the ball, and of the image of a point; the size of what makes
 * them, for error control. */
double iso_effects_potential(const iso_field *f, const double y[]);
double iso_effects_image(const iso_field *f, const double y[]);
double iso_effects_strength(const iso_field *f, const double y[]);
double iso_effects_range(const iso_field *f, const double y[]);

/* Whether no torque acts but that of `level`, which the isomorphism turns into a constant. */
bool iso_effects_free(const iso_effects *effects);

/* Whether the energy is conserved, and known from the state: on a plane the height is a state of `attitude`. */
bool iso_effects_keep_energy(const iso_field *f);

/* How many times faster than the ball turns, in its own units, the effects make motion die away: the largest of them.
 * Above ISO_STIFF explicit methods are held up; the torque of a contact that alone is as stiff is a state, lambda. */
enum { ISO_STIFF = 50 };
double iso_effects_stiffness(const iso_field *f);

/* The turns of the ball, in its own units, for which it moves at most before resistance has brought it to rest, all the
 * way through the range of doubles; infinite where nothing does, or something keeps it moving. */
double iso_effects_moving(const iso_field *f);

/* In own units a ball that turns more slowly than this, and only loses motion, is at rest: a tolerance of that is still a
 * normal double. */
#define ISO_REST 1e-290
bool iso_effects_at_rest(const iso_field *f, const double y[]);

enum { ISO_MAX_INTEGRALS = 24 };

/* The integrals of a system that hold for a field, those of its effects last: at most `most` into list, and how many
 * there are. */
int iso_integrals_holding(const iso_system *system, const iso_field *f, const iso_integral *list[], int most);

#endif

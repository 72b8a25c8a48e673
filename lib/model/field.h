/* field.h - what distinguishes one orbit's equations from another's: the ball, the level it lives on, and the effects
 * that act on it.
 *
 * The numbers of all effects stand in one plain struct. What `on` does not name is not simulated, and its numbers are
 * not read. What an effect does with its numbers is said in its own file, effect_<name>.c.
 */
#ifndef ISO_MODEL_FIELD_H
#define ISO_MODEL_FIELD_H

#include <stdbool.h>

#include "params.h"

/* In the order in which their states follow the system's six; those from ISO_ATTITUDE on act on nothing. */
typedef enum iso_effect_id {
    ISO_GRAVITY,
    ISO_FIELD,
    ISO_LEVEL,
    ISO_TWIST,
    ISO_ROLLING_RESISTANCE,
    ISO_ATTITUDE,
    ISO_REACTIONS,
    ISO_CLOCK,
    ISO_EFFECTS
} iso_effect_id;

typedef struct iso_effects {
    bool on[ISO_EFFECTS];
    double mgb;           /* gravity: torque of the weight about the contact, m g b, b signed [energy]           */
    double up[3];         /* gravity: unit vertical, upwards, in body axes at time 0                             */
    double quadratic[9];  /* field: symmetric matrix C of U(n) = (n,Cn)/2 + (l,n) [energy]                       */
    double linear[3];     /* field: l [energy]                                                                   */
    double level;         /* level: c of U = -c (n,J^-1 n)^(-1/k) [energy J^(-1/k)]                              */
    double twist;         /* twist: resistance c >= 0 of the contact against twisting [energy time]              */
    double resistance;    /* rolling resistance c_r > 0: torque -c_r omega [energy time]                         */
    double quaternion[4]; /* attitude: from body to space axes at time 0, unit                                   */
    bool two_sided;       /* reactions: the support can pull as well                                             */
} iso_effects;

typedef struct iso_field {
    iso_params p;
    double eps;              /* coupling of the point's potential, (24); 0 for the ball                             */
    double energy;           /* the level the orbit lives on: h of the ball, H of the point                         */
    iso_effects effects;
    int at[ISO_EFFECTS];     /* where in the state those of an effect begin; 0: it has none                         */
} iso_field;

#endif

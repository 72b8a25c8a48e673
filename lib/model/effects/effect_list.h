/* effect_list.h - the registry of effects: one line each, ISO_<ID> and the row iso_effect_<name>.
 *
 * To add an effect, write its row in lib/model/effects/effect_<name>.c and add its line here (lib/README.md shows
 * how). The order is that of the states in a model, of the columns in a trajectory and of the effects in lists.
 */
#ifndef ISO_MODEL_EFFECTS_EFFECT_LIST_H
#define ISO_MODEL_EFFECTS_EFFECT_LIST_H

#define ISO_EFFECT_LIST(X)                                                                                           \
    X(GRAVITY, gravity)                                                                                              \
    X(FIELD, field)                                                                                                  \
    X(LEVEL, level)                                                                                                  \
    X(TWIST, twist)                                                                                                  \
    X(ROLLING_RESISTANCE, rolling_resistance)                                                                        \
    X(ROTOR, rotor)                                                                                                  \
    X(POTENTIAL, potential)                                                                                          \
    X(TORQUE, torque)                                                                                                \
    X(INTEGRALS, integrals)                                                                                          \
    X(ATTITUDE, attitude)                                                                                            \
    X(REACTIONS, reactions)                                                                                          \
    X(CLOCK, clock)

/* The identifiers ISO_GRAVITY, ISO_FIELD, ..., and how many there are. */
typedef enum iso_effect_id {
#define ISO_EFFECT_ID(ID, name) ISO_##ID,
    ISO_EFFECT_LIST(ISO_EFFECT_ID)
#undef ISO_EFFECT_ID
        ISO_EFFECTS
} iso_effect_id;

#endif

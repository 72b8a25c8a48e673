/* numbers.h - the numbers of effects and the columns of samples, by name.
 *
 *     GRAVITY_MGB(&effects) = 0.7;      copy(up, GRAVITY_UP(&effects), 3);      centre = sample_of(&sample,
 *                                       "centre");
 *
 * Initializers have them in the order of the rows: .number[ISO_GRAVITY] = {mgb, up 1 to 3}.
 */
#ifndef ISO_TESTS_NUMBERS_H
#define ISO_TESTS_NUMBERS_H

#include <stdlib.h>
#include <string.h>

#include "model/model_impl.h"
#include "orbit/orbit.h"

static inline double *number_of(const iso_effects *effects, iso_effect_id id, const char *name)
{
    for (const iso_effect_number *n = iso_effect_list[id]->numbers; n && n->name; n++)
        if (strcmp(n->name, name) == 0) return iso_effect_values(effects, id, n);
    abort();
}

#define GRAVITY_MGB(e) (*number_of((e), ISO_GRAVITY, "mgb"))
#define GRAVITY_UP(e) number_of((e), ISO_GRAVITY, "up")
#define FIELD_QUADRATIC(e) number_of((e), ISO_FIELD, "quadratic")
#define FIELD_LINEAR(e) number_of((e), ISO_FIELD, "linear")
#define LEVEL_C(e) (*number_of((e), ISO_LEVEL, "c"))
#define TWIST_RESISTANCE(e) (*number_of((e), ISO_TWIST, "resistance"))
#define ROLLING_COEFFICIENT(e) (*number_of((e), ISO_ROLLING_RESISTANCE, "coefficient"))
#define ROTOR_MOMENTUM(e) number_of((e), ISO_ROTOR, "momentum")
#define QUATERNION(e) number_of((e), ISO_ATTITUDE, "quaternion")
#define TWO_SIDED(e) (*number_of((e), ISO_REACTIONS, "two_sided"))

/* The column where a group of an effect begins ... */
static inline int column_of(const char *group)
{
    const iso_effect_column *g;
    int which, i = 0;
    while (iso_effect_column_name(i, NULL, &g, &which))
        if (strcmp(g->name, group) == 0 && which == 0)
            return ISO_COLUMN_EFFECTS + i;
        else
            i++;
    abort();
}

/* ... and its numbers in a sample. */
static inline const double *sample_of(const iso_sample *s, const char *group)
{
    return s->effect + column_of(group) - ISO_COLUMN_EFFECTS;
}

#endif

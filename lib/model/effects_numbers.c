/* effects_numbers.c - the numbers of effects: where they stand, their units, the level, and whether they make sense. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/vec3_impl.h"
#include "model/effects_impl.h"

/* --- numbers -------------------------------------------------------------------------------------------------------- */

double *iso_effect_values(const iso_effects *effects, iso_effect_id id, const iso_effect_number *number)
{
    return (double *)effects->number[id] + number->at;
}

iso_effects iso_effects_default(void)
{
    iso_effects effects = {.on = {false}};
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        for (const iso_effect_number *n = iso_effect_list[e]->numbers; n && n->name; n++)
            if (n->initially) copy(n->initially, iso_effect_values(&effects, e, n), n->count);
    return effects;
}

iso_status iso_effects_set(iso_context *ctx, iso_effects *effects, const char *effect, const char *name, int count,
                           const double values[])
{
    const iso_effect_id e = iso_effect_find(effect);
    if (e == ISO_EFFECTS) return iso_context_fail(ctx, ISO_BAD_ARGUMENT, effect, "there is no effect '%s'", effect);
    effects->on[e] = true;
    if (!name) return ISO_OK;
    for (const iso_effect_number *n = iso_effect_list[e]->numbers; n && n->name; n++) {
        if (strcmp(n->name, name) != 0) continue;
        if (n->count != count)
            return iso_context_fail(ctx, ISO_BAD_ARGUMENT, name, "'%s' of '%s' has %d numbers, not %d", name, effect,
                                    n->count, count);
        copy(values, iso_effect_values(effects, e, n), count);
        return ISO_OK;
    }
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, name, "the effect '%s' has no number '%s'", effect, name);
}

iso_effects iso_effects_scaled(const iso_effects *effects, const iso_units *units, int power)
{
    iso_effects scaled = *effects;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        for (const iso_effect_number *n = iso_effect_list[e]->numbers; scaled.on[e] && n && n->name; n++) {
            double *x = iso_effect_values(&scaled, e, n);
            const double unit = iso_unit(units, n->dimension);
            for (int i = 0; i < n->count; i++) x[i] = x[i] == 0 ? 0 : power > 0 ? x[i] * unit : x[i] / unit;
        }
    return scaled;
}

/* --- the level: an effect that is the energy of the point ------------------------------------------------------------- */

static iso_effect_id level_id(void)
{
    int e = 0;
    while (e < ISO_EFFECTS && !iso_effect_list[e]->is_level) e++;
    return (iso_effect_id)e;
}

bool iso_effects_have_level(const iso_effects *effects)
{
    return effects->on[level_id()];
}

double iso_effects_level(const iso_effects *effects)
{
    return effects->number[level_id()][0];
}

void iso_effects_set_level(iso_effects *effects, bool there, double c)
{
    effects->on[level_id()] = there;
    effects->number[level_id()][0] = c;
}

const char *iso_level_name(void)
{
    return iso_effect_list[level_id()]->name;
}

iso_dimension iso_level_dimension(void)
{
    return iso_effect_list[level_id()]->numbers->dimension;
}

/* --- do the numbers make sense ---------------------------------------------------------------------------------------- */

static iso_status check_unit(iso_context *ctx, const char *name, int count, double x[])
{
    double square = 0;
    for (int i = 0; i < count; i++) square += x[i] * x[i];
    const double length = sqrt(square);
    char unit[128] = "";
    int used = 0;
    for (int i = 0; i < count && length > 0 && isfinite(length); i++)
        used += snprintf(unit + used, sizeof unit - (size_t)used, "%s%.10g", i ? ", " : ": write [", x[i] / length);
    if (!(fabs(length - 1) <= 1e-6))
        return iso_context_fail(ctx, ISO_BAD_INPUT, name,
                                "'%s' has length %.10g, it must be a unit vector (to 1e-6)%s%s", name, length, unit,
                                used ? "]" : "");
    for (int i = 0; i < count; i++) x[i] /= length;
    return ISO_OK;
}

static iso_status check_number(iso_context *ctx, const char *effect, const iso_effect_number *n, double x[])
{
    for (int i = 0; i < n->count; i++)
        if (!isfinite(x[i]))
            return iso_context_fail(ctx, ISO_BAD_INPUT, n->name, "%s: '%s' is not finite", effect, n->name);
    const bool resists = n->kind == ISO_NUMBER_POSITIVE || n->kind == ISO_NUMBER_NOT_NEGATIVE;
    if (n->kind == ISO_NUMBER_UNIT) return check_unit(ctx, n->name, n->count, x);
    if (resists && x[0] < 0)
        return iso_context_fail(ctx, ISO_BAD_INPUT, n->name, "%s: '%s' is negative, it must resist", effect, n->name);
    if ((n->kind == ISO_NUMBER_POSITIVE || n->kind == ISO_NUMBER_NOT_ZERO) && x[0] == 0)
        return iso_context_fail(ctx, ISO_BAD_INPUT, n->name, "%s: '%s' is 0 and changes nothing: take it out", effect,
                                n->name);
    return ISO_OK;
}

static iso_status check_D(iso_context *ctx, const iso_params *p, const char *effect)
{
    const bool body = p->body.surface != ISO_REDUCED;
    if (body && !isnormal(p->D))
        return iso_context_fail(ctx, ISO_BAD_INPUT, effect,
                                "'%s' needs m b^2, which does not fit a double: use other units", effect);
    if (body && p->D >= min3(p->J))
        return iso_context_fail(
            ctx, ISO_BAD_INPUT, effect,
            "'%s' needs the moments about the centre, which are less than the last digit of m b^2 "
            "= %g: give a ball with larger ones",
            effect, p->D);
    if (p->D > 0) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_INPUT, effect,
                            "'%s' needs the ball's mass and radius: give D = m b^2 ('%s: {D: ...}'), or a ball and a "
                            "surface",
                            effect, effect);
}

/* A row that acts states its equations; what it leaves out of them nobody may guess. */
static iso_status check_row(iso_context *ctx, const iso_effect *effect)
{
    if (iso_effect_columns() > ISO_EFFECT_COLUMNS)
        return iso_context_fail(ctx, ISO_BAD_INPUT, effect->name,
                                "the effects have %d columns, and there is room for %d: set ISO_EFFECT_COLUMNS to %d",
                                iso_effect_columns(), ISO_EFFECT_COLUMNS, iso_effect_columns());
    if (effect->observes || effect->motion || effect->torque) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_INPUT, effect->name,
                            "the row of '%s' is not complete: it acts, but has no equations of motion", effect->name);
}

iso_status iso_effects_check(iso_context *ctx, const iso_params *p, const double normal[3], iso_effects *effects)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_status status = ISO_OK;
    for (iso_effect_id e = 0; status == ISO_OK && e < ISO_EFFECTS; e++) {
        const iso_effect *effect = iso_effect_list[e];
        if (!effects->on[e]) continue;
        status = check_row(ctx, effect);
        for (const iso_effect_number *n = effect->numbers; status == ISO_OK && n && n->name; n++)
            status = check_number(ctx, effect->name, n, iso_effect_values(effects, e, n));
        if (status == ISO_OK && effect->check) status = effect->check(ctx, p, normal, effects);
        if (status == ISO_OK && effect->needs_D) status = check_D(ctx, p, effect->name);
    }
    return status;
}

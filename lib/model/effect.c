#include "model/effect.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/vec3_impl.h"
#include "model/effects_impl.h"

const iso_effect *const iso_effect_list[ISO_EFFECTS] = {
    [ISO_GRAVITY] = &iso_effect_gravity,
    [ISO_FIELD] = &iso_effect_field,
    [ISO_LEVEL] = &iso_effect_level,
    [ISO_TWIST] = &iso_effect_twist,
    [ISO_ROLLING_RESISTANCE] = &iso_effect_rolling_resistance,
    [ISO_ATTITUDE] = &iso_effect_attitude,
    [ISO_REACTIONS] = &iso_effect_reactions,
    [ISO_CLOCK] = &iso_effect_clock,
};

double *iso_effect_values(const iso_effects *effects, const iso_effect_number *number)
{
    return (double *)((char *)effects + number->offset);
}

/* --- do the numbers make sense ------------------------------------------------------------------------------------- */

static iso_status check_finite(iso_context *ctx, const iso_effect *effect, const iso_effects *e)
{
    for (const iso_effect_number *n = effect->numbers; n && n->name; n++) {
        const double *x = iso_effect_values(e, n);
        for (int i = 0; i < n->count; i++)
            if (!isfinite(x[i]))
                return iso_context_fail(ctx, ISO_BAD_INPUT, n->name, "%s: '%s' is not finite", effect->name, n->name);
    }
    return ISO_OK;
}

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

bool iso_effects_on_level_plane(const iso_params *p, const double normal[3], const iso_effects *e)
{
    double e_n[3];
    cross(e->up, normal, e_n);
    return e->on[ISO_GRAVITY] && p->k == 1 && norm(e_n) <= 4 * DBL_EPSILON;
}

static iso_status check_gravity(iso_context *ctx, const iso_params *p, const double n[3], iso_effects *e)
{
    if (e->mgb == 0)
        return iso_context_fail(ctx, ISO_BAD_INPUT, "gravity", "gravity of 0 changes nothing: take it out");
    const iso_status status = check_unit(ctx, "up", 3, e->up);
    if (status != ISO_OK || e->on[ISO_REACTIONS] || !iso_effects_on_level_plane(p, n, e)) return status;
    return iso_context_fail(
        ctx, ISO_BAD_INPUT, "gravity",
        "on a level plane (up along the normal) gravity has no torque and changes nothing: take it "
        "out, tilt the plane, or ask for 'reactions'");
}

static iso_status check_field(iso_context *ctx, iso_effects *e)
{
    double *C = e->quadratic, most = 0, varies = largest(e->linear);
    for (int i = 0; i < 9; i++) most = fmax(most, fabs(C[i]));
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < i; j++) {
            if (!(fabs(C[3 * i + j] - C[3 * j + i]) <= 1e-12 * most))
                return iso_context_fail(ctx, ISO_BAD_INPUT, "quadratic",
                                        "the matrix of a quadratic form is symmetric: C%d%d = %.17g is not C%d%d = "
                                        "%.17g",
                                        i + 1, j + 1, C[3 * i + j], j + 1, i + 1, C[3 * j + i]);
            C[3 * j + i] = C[3 * i + j];
            varies = fmax(varies, fmax(fabs(C[3 * i + j]), fabs(C[4 * i] - C[4 * j])));
        }
    if (varies > 0 && varies < 1e-10 * most)
        return iso_context_fail(
            ctx, ISO_BAD_INPUT, "quadratic",
            "all but %.1g of this matrix is a constant on the unit sphere, which does nothing but "
            "cost digits: subtract it from the diagonal",
            varies / most);
    if (varies > 0) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_INPUT, "field",
                            "this potential is a constant on the unit sphere and changes nothing: take it out");
}

static iso_status check_positive(iso_context *ctx, const char *effect, const char *name, double x, bool zero)
{
    if (x > 0 || (zero && x == 0)) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_INPUT, name,
                            x == 0 ? "%s: '%s' is 0 and changes nothing: take it out"
                                   : "%s: '%s' is negative, it must resist",
                            effect, name);
}

static iso_status check_mass(iso_context *ctx, const iso_params *p, const char *effect)
{
    const bool body = p->body.surface != ISO_REDUCED;
    if (body && !isnormal(p->D))
        return iso_context_fail(ctx, ISO_BAD_INPUT, effect,
                                "'%s' needs m b^2, which does not fit a double: use other units", effect);
    if (body && p->D >= min3(p->J))
        return iso_context_fail(ctx, ISO_BAD_INPUT, effect,
                                "'%s' needs the moments about the centre, which are less than the last digit of m b^2 "
                                "= %g: give a ball with larger ones",
                                effect, p->D);
    if (p->D > 0) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_INPUT, effect,
                            "'%s' needs the ball's mass and radius: give D = m b^2 ('%s: {D: ...}'), or a ball and a "
                            "surface",
                            effect, effect);
}

iso_status iso_effects_check(iso_context *ctx, const iso_params *p, const double normal[3], iso_effects *e)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_status status = ISO_OK;
    for (int i = 0; status == ISO_OK && i < ISO_EFFECTS; i++)
        if (e->on[i]) status = check_finite(ctx, iso_effect_list[i], e);
    if (status == ISO_OK && e->on[ISO_GRAVITY]) status = check_gravity(ctx, p, normal, e);
    if (status == ISO_OK && e->on[ISO_FIELD]) status = check_field(ctx, e);
    if (status == ISO_OK && e->on[ISO_LEVEL] && e->level == 0)
        status = iso_context_fail(ctx, ISO_BAD_INPUT, "c", "level: 'c' is 0 and changes nothing: take it out");
    if (status == ISO_OK && e->on[ISO_LEVEL] && p->J[0] == p->J[1] && p->J[1] == p->J[2])
        status = iso_context_fail(ctx, ISO_BAD_INPUT, "level",
                                  "with equal moments this potential is a constant and changes nothing: take it out");
    if (status == ISO_OK && e->on[ISO_TWIST]) status = check_positive(ctx, "twist", "resistance", e->twist, true);
    if (status == ISO_OK && e->on[ISO_TWIST]) status = check_mass(ctx, p, "twist");
    if (status == ISO_OK && e->on[ISO_ROLLING_RESISTANCE])
        status = check_positive(ctx, "rolling_resistance", "coefficient", e->resistance, false);
    if (status == ISO_OK && e->on[ISO_ATTITUDE]) status = check_unit(ctx, "quaternion", 4, e->quaternion);
    if (status == ISO_OK && e->on[ISO_REACTIONS]) status = check_mass(ctx, p, "reactions");
    return status;
}

/* --- all of them ---------------------------------------------------------------------------------------------------- */

iso_effects iso_effects_scaled(const iso_effects *effects, const iso_units *units, int power)
{
    iso_effects scaled = *effects;
    for (int e = 0; e < ISO_EFFECTS; e++)
        for (const iso_effect_number *n = iso_effect_list[e]->numbers; scaled.on[e] && n && n->name; n++) {
            double *x = iso_effect_values(&scaled, n);
            const double unit = iso_unit(units, n->dimension);
            for (int i = 0; i < n->count; i++) x[i] = x[i] == 0 ? 0 : power > 0 ? x[i] * unit : x[i] / unit;
        }
    return scaled;
}

iso_effects iso_effects_acting(const iso_effects *effects)
{
    iso_effects acting = *effects;
    for (int e = ISO_ATTITUDE; e < ISO_EFFECTS; e++) acting.on[e] = false;
    return acting;
}

const iso_effect *iso_effects_breaking(const iso_effects *effects)
{
    for (int e = 0; e < ISO_EFFECTS; e++)
        if (effects->on[e] && iso_effect_list[e]->breaks) return iso_effect_list[e];
    return NULL;
}

double iso_effects_potential(const iso_field *f, const double y[])
{
    double U = 0;
    for (int e = 0; e < ISO_EFFECTS; e++)
        if (f->effects.on[e] && iso_effect_list[e]->potential) U += iso_effect_list[e]->potential(f, y);
    return U;
}

double iso_effects_image(const iso_field *f, const double y[])
{
    double V = 0;
    for (int e = 0; e < ISO_EFFECTS; e++)
        if (f->effects.on[e] && iso_effect_list[e]->image_potential) V += iso_effect_list[e]->image_potential(f, y);
    return V;
}

double iso_effects_strength(const iso_field *f, const double y[])
{
    double most = 0;
    for (int e = 0; e < ISO_EFFECTS; e++)
        if (f->effects.on[e] && iso_effect_list[e]->strength) most = fmax(most, iso_effect_list[e]->strength(f, y));
    return most;
}

double iso_effects_range(const iso_field *f, const double y[])
{
    double most = iso_effects_strength(f, y);
    for (int e = 0; e < ISO_EFFECTS; e++)
        if (f->effects.on[e] && iso_effect_list[e]->range) most = fmax(most, iso_effect_list[e]->range(f, y));
    return most;
}

double iso_effects_stiffness(const iso_field *f)
{
    double most = 0;
    for (int e = 0; e < ISO_EFFECTS; e++)
        if (f->effects.on[e] && iso_effect_list[e]->stiffness) most = fmax(most, iso_effect_list[e]->stiffness(f));
    return most;
}

bool iso_effects_free(const iso_effects *effects)
{
    return !effects->on[ISO_GRAVITY] && !effects->on[ISO_FIELD] && !effects->on[ISO_TWIST] &&
           !effects->on[ISO_ROLLING_RESISTANCE];
}

bool iso_effects_keep_energy(const iso_field *f)
{
    const iso_effects *e = &f->effects;
    if (e->on[ISO_ROLLING_RESISTANCE] || (e->on[ISO_TWIST] && e->twist > 0)) return false;
    return !e->on[ISO_GRAVITY] || f->p.k != 1 || e->on[ISO_ATTITUDE];
}

/* No potential moves the ball. */
static bool only_resisted(const iso_field *f)
{
    const bool *on = f->effects.on;
    return !on[ISO_GRAVITY] && !on[ISO_FIELD] && !on[ISO_LEVEL] && iso_effects_stiffness(f) > 0;
}

double iso_effects_moving(const iso_field *f)
{
    if (!only_resisted(f) || !f->effects.on[ISO_ROLLING_RESISTANCE]) return INFINITY;
    return -log(ISO_REST) * max3(f->p.J) / f->effects.resistance * fmax(1, fabs(f->p.k));
}

bool iso_effects_at_rest(const iso_field *f, const double y[])
{
    return largest(y) < ISO_REST && only_resisted(f);
}

int iso_integrals_holding(const iso_system *system, const iso_field *f, const iso_integral *list[], int most)
{
    int count = 0;
    for (const iso_integral *i = system->integrals; i->name && count < most; i++)
        if (!i->holds || i->holds(f)) list[count++] = i;
    if (system != &iso_system_ball) return count;
    for (int e = 0; e < ISO_EFFECTS; e++)
        for (const iso_integral *i = iso_effect_list[e]->integrals; f->effects.on[e] && i && i->name; i++)
            if ((!i->holds || i->holds(f)) && count < most) list[count++] = i;
    return count;
}

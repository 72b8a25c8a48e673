/* effects_numbers.c - the numbers of effects: where they stand, their units, the level, whether they make sense; and
 * their columns, counted through. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/math_impl.h"
#include "base/names_impl.h"
#include "base/vec3_impl.h"
#include "model/effects/effects_impl.h"
#include "model/expression/expression_impl.h"
#include "model/expression/written_impl.h"
#include "model/model_impl.h"

/* --- numbers ---------------------------------------------------------------------------------------------------- */

double *iso_effect_values(const iso_effects *effects, iso_effect_id id, const iso_effect_number *number)
{
    return (double *)effects->number[id] + number->at;
}

const char *iso_effect_name(int i)
{
    return i < ISO_EFFECTS ? iso_effect_list[i]->name : NULL;
}

bool iso_effect_number_at(const iso_effects *effects, iso_effect_id effect, int i, iso_effect_number *n)
{
    const iso_effect *e = iso_effect_list[effect];
    for (const iso_effect_number *own = e->numbers; own && own->name; own++)
        if (!own->hidden && i-- == 0) return *n = *own, true;
    if (!e->expressions || i >= ISO_PARAMETERS || !effects->written[e->written].parameter[i][0]) return false;
    *n = (iso_effect_number){.name = effects->written[e->written].parameter[i], .at = i, .count = 1};
    return true;
}

/* Whether its place is within the numbers of an effect. */
static bool has_room(const iso_effect_number *n)
{
    return n->at >= 0 && n->count > 0 && n->at + n->count <= ISO_EFFECT_NUMBERS;
}

iso_effects iso_effects_default(void)
{
    iso_effects effects = {.on = {false}};
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        for (const iso_effect_number *n = iso_effect_list[e]->numbers; n && n->name; n++)
            if (n->initially && has_room(n)) copy(n->initially, iso_effect_values(&effects, e, n), n->count);
    return effects;
}

static iso_status no_effect(iso_context *ctx, const char *effect)
{
    char suggested[ISO_SUGGEST_SIZE];
    return ISO_FAIL_ARGUMENT(ctx, effect, "there is no effect '%s'; %s", effect,
                             iso_suggest_word(suggested, effect, iso_effect_name));
}

bool iso_effect_is_key(const iso_effect *effect, const char *name)
{
    bool is = false;
    for (int i = 0; effect->expressions && effect->expressions[i]; i++)
        is = is || strcmp(effect->expressions[i], name) == 0;
    for (const iso_effect_number *n = effect->numbers; n && n->name; n++)
        is = is || (!n->hidden && strcmp(n->name, name) == 0);
    return is;
}

const char *iso_effect_bad_parameter(const iso_effect *effect, const char *name)
{
    const char *bad = iso_expression_bad_name(name);
    return bad ? bad : iso_effect_is_key(effect, name) ? "this name has a meaning of its own" : NULL;
}

/* A parameter with a new name. */
static iso_status add_parameter(iso_context *ctx, iso_effects *effects, iso_effect_id e, const char *name, double x)
{
    const char *bad = iso_effect_bad_parameter(iso_effect_list[e], name);
    char(*own)[ISO_PARAMETER_SIZE] = effects->written[iso_effect_list[e]->written].parameter;
    int i = 0;
    if (bad) return ISO_FAIL_ARGUMENT(ctx, name, "'%s' cannot be a parameter: %s", name, bad);
    while (i < ISO_PARAMETERS && own[i][0]) i++;
    if (i == ISO_PARAMETERS)
        return ISO_FAIL_ARGUMENT(ctx, name, "'%s' has no room for more than %d parameters", iso_effect_list[e]->name,
                                 ISO_PARAMETERS);
    strcpy(own[i], name);
    effects->number[e][i] = x;
    return ISO_OK;
}

iso_status iso_effects_set(iso_context *ctx, iso_effects *effects, const char *effect, const char *name, int count,
                           const double values[])
{
    const iso_effect_id e = iso_effect_find(effect);
    char suggested[ISO_SUGGEST_SIZE];
    iso_effect_number n;
    if (e == ISO_EFFECTS) return no_effect(ctx, effect);
    effects->on[e] = true;
    if (!name) return ISO_OK;
    for (int i = 0; iso_effect_number_at(effects, e, i, &n); i++) {
        if (strcmp(n.name, name) != 0) continue;
        if (n.of == ISO_OF_BODY)
            return ISO_FAIL_ARGUMENT(
                ctx, name, "'%s' of '%s' is for scenes alone: set the number that is computed from it", name, effect);
        if (n.count != count || !has_room(&n))
            return ISO_FAIL_ARGUMENT(ctx, name, "'%s' of '%s' has %d numbers, not %d", name, effect, n.count, count);
        copy(values, iso_effect_values(effects, e, &n), count);
        return ISO_OK;
    }
    if (iso_effect_list[e]->expressions && count == 1) return add_parameter(ctx, effects, e, name, values[0]);
    const char *names[ISO_EFFECT_NUMBERS];
    size_t known = 0;
    for (int i = 0; known < ISO_EFFECT_NUMBERS && iso_effect_number_at(effects, e, i, &n); i++)
        names[known++] = n.name;
    return ISO_FAIL_ARGUMENT(ctx, name, "the effect '%s' has no number '%s'%s%s", effect, name, known > 0 ? "; " : "",
                             known > 0 ? iso_suggest(suggested, name, known, names) : "");
}

iso_status iso_effects_write(iso_context *ctx, iso_effects *effects, const char *effect, const char *name,
                             const char *text)
{
    const iso_effect_id e = iso_effect_find(effect);
    if (e == ISO_EFFECTS) return no_effect(ctx, effect);
    const char *const *names = iso_effect_list[e]->expressions;
    int which = 0;
    while (names && names[which] && strcmp(names[which], name) != 0) which++;
    if (!names || !names[which])
        return ISO_FAIL_ARGUMENT(ctx, name, "the effect '%s' has no expression '%s'", effect, name);
    if (strlen(text) >= ISO_EXPRESSION_SIZE)
        return ISO_FAIL_ARGUMENT(ctx, name, "%s has %zu characters: there is room for %d", name, strlen(text),
                                 ISO_EXPRESSION_SIZE - 1);
    effects->on[e] = true;
    char *own = effects->written[iso_effect_list[e]->written].expression[which];
    strcpy(own, text);
    for (; *own; own++)
        if (*own == '\n' || *own == '\t') *own = ' '; /* it is one line of a file */
    return ISO_OK;
}

void iso_effects_scale(iso_effects *effects, const iso_units *units, int power)
{
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        for (const iso_effect_number *n = iso_effect_list[e]->numbers; effects->on[e] && n && n->name && has_room(n);
             n++) {
            double *x = iso_effect_values(effects, e, n);
            const double unit = iso_unit(units, n->dimension);
            for (int i = 0; i < n->count; i++) x[i] = x[i] == 0 ? 0 : power > 0 ? x[i] * unit : x[i] / unit;
        }
}

/* --- do the numbers make sense ---------------------------------------------------------------------------------- */

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
        return ISO_FAIL_INPUT(ctx, name, "'%s' has length %.10g, it must be a unit vector (to 1e-6)%s%s", name,
                              length, unit, used ? "]" : "");
    for (int i = 0; i < count; i++) x[i] /= length;
    return ISO_OK;
}

static iso_status check_number(iso_context *ctx, const char *effect, const iso_effect_number *n, double x[])
{
    for (int i = 0; i < n->count; i++)
        if (!isfinite(x[i])) return ISO_FAIL_INPUT(ctx, n->name, "%s: '%s' is not finite", effect, n->name);
    if (n->kind == ISO_NUMBER_UNIT) return check_unit(ctx, n->name, n->count, x);
    const bool resists = n->kind == ISO_NUMBER_POSITIVE || n->kind == ISO_NUMBER_NOT_NEGATIVE;
    int zeros = 0;
    bool negative = false;
    for (int i = 0; i < n->count; i++) {
        zeros += x[i] == 0;
        negative = negative || x[i] < 0;
    }
    if (resists && negative)
        return ISO_FAIL_INPUT(ctx, n->name, "%s: '%s' is negative: it must resist", effect, n->name);
    if ((n->kind == ISO_NUMBER_POSITIVE && zeros > 0) || (n->kind == ISO_NUMBER_NOT_ZERO && zeros == n->count))
        return ISO_FAIL_INPUT(ctx, n->name, "%s: '%s' is 0 and changes nothing: take it out", effect, n->name);
    return ISO_OK;
}

static iso_status check_D(iso_context *ctx, const iso_params *p, const char *effect)
{
    const bool body = p->body.surface != ISO_REDUCED;
    if (body && !isnormal(p->D))
        return ISO_FAIL_INPUT(ctx, effect, "'%s' needs m b^2, which does not fit a double: use other units", effect);
    if (body && p->D >= min3(p->J))
        return ISO_FAIL_INPUT(ctx, effect,
                              "'%s' needs the moments about the centre, which are less than the last digit of m b^2 "
                              "= %g: give a ball with larger ones",
                              effect, p->D);
    if (p->D > 0) return ISO_OK;
    return ISO_FAIL_INPUT(
        ctx, effect,
        "'%s' needs the ball's mass and radius: give D = m b^2 ('%s: {D: ...}'), or a ball and a surface", effect,
        effect);
}

/* What a row lacks, or says twice; NULL: nothing. What is left out, nobody may guess. */
static const char *what_is_wrong(const iso_effect *effect)
{
    const iso_effect_state *s = effect->states;
    const bool derived = iso_effect_is_derived(effect);
    if (!effect->observes && !effect->motion && !effect->torque) return "it acts, but has no equations of motion";
    if (effect->observes && (effect->torque || effect->potential || effect->image || effect->twists))
        return "it observes, but has a torque, a potential, an image or a contact that twists";
    for (const iso_effect_column *c = effect->columns; c && c->name; c++)
        if (!c->unit || !c->doc) return "a column of it has no unit, or no line of documentation";
    if (effect->columns && !effect->show) return "it has columns, but no `show`";
    if (s && !effect->begin) return "it has states, but no `begin`";
    if (s && !effect->motion) return "it has states, but no `motion` with their rates";
    if (s && !derived && !effect->recall) return "it has states, but no `recall`";
    for (; s && s->name; s++)
        if ((s->kind == ISO_STATE_DERIVED) != derived) return "some of its states are derived, others are not";
    for (const iso_effect_number *n = effect->numbers; n && n->name; n++) {
        bool turns = !n->turns_with; /* or a group of columns holds it at later times */
        for (const iso_effect_column *c = effect->columns; c && c->name; c++)
            turns = turns || (strcmp(c->name, n->turns_with) == 0 && c->count == n->count);
        if (!turns) return "a number turns with a group of columns that is not there";
        if (!has_room(n)) return "it has more numbers than there is room for (ISO_EFFECT_NUMBERS)";
    }
    return NULL;
}

static iso_status check_row(iso_context *ctx, const iso_effect *effect)
{
    const char *wrong = what_is_wrong(effect);
    if (iso_effect_columns() > ISO_EFFECT_COLUMNS)
        return ISO_FAIL_INPUT(ctx, effect->name,
                              "the effects have %d columns, and there is room for %d: set ISO_EFFECT_COLUMNS to %d",
                              iso_effect_columns(), ISO_EFFECT_COLUMNS, iso_effect_columns());
    if (!wrong) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, effect->name, "the row of '%s' is not complete: %s", effect->name, wrong);
}

/* Whether the torque, or the energy, that a formula computes is a number at a state of the ball. */
static bool is_finite_at(const iso_formula *F, const iso_params *p, const double y[])
{
    double T[3] = {0}, dy[ISO_MAX_STATE];
    if (F->kind == ISO_FORMULA_ENERGY) return isfinite(iso_formula_energy(F, p, y));
    iso_formula_rates(F, p, y, T, dy);
    return all_finite(T, 3);
}

/* The equations of each effect alone, with its own states in place: they must be equations that all can compute, and
 * what the scene writes must be a number at the start. */
static iso_status check_equations(iso_context *ctx, const iso_params *p, const double start[ISO_STATE],
                                  const iso_effects *effects, iso_effect_id e)
{
    iso_problem f = {.p = *p, .effects = *effects};
    iso_formula F;
    double y[ISO_MAX_STATE] = {0};
    bool finite = true;
    if (iso_effects_place_states(&f) > ISO_MAX_STATE) return ISO_OK; /* the model is refused */
    for (iso_effect_id i = 0; i < ISO_EFFECTS; i++) f.effects.on[i] = i == e;
    copy(start, y, ISO_STATE);
    if (f.at[ISO_GRAVITY] > 0) copy(iso_effects_up(effects), y + f.at[ISO_GRAVITY], 3);
    const bool drives = iso_written_drives(effects, e);
    iso_effects_record_motion(&f, false, &F);
    if (drives && !F.wrong && !F.overrun) finite = is_finite_at(&F, p, y);
    if (!F.wrong && !F.overrun) iso_effects_record_motion(&f, true, &F);
    if (!F.wrong && !F.overrun) iso_effects_record_energy(&f, &F);
    if (drives && !F.wrong && !F.overrun) finite = finite && is_finite_at(&F, p, y);
    if (F.overrun)
        return ISO_FAIL_INPUT(ctx, iso_effect_list[e]->name,
                              "the equations of '%s' have more lines than there is room for: make it shorter",
                              iso_effect_list[e]->name);
    if (!F.wrong) iso_effects_record_image(&f, &F); /* without room for it there is a ball, and no point */
    if (!finite) return iso_written_refuse_start(ctx, &f, e, y);
    if (F.overrun || !F.wrong) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, iso_effect_list[e]->name, "the equations of '%s' cannot be computed: %s",
                          iso_effect_list[e]->name, F.wrong);
}

void iso_effects_settle(const iso_params *p, const double normal[3], iso_effects *effects)
{
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        const iso_effect *effect = iso_effect_list[e];
        effects->idle[e] = effects->on[e] && effect->idle && effect->idle(p, normal, effects);
    }
}

iso_status iso_effects_check(iso_context *ctx, const iso_params *p, const double start[ISO_STATE],
                             iso_effects *effects)
{
    ISO_DEFAULT_ARITHMETIC;
    const double *normal = start + 3;
    iso_status status = ISO_OK;
    iso_effects_settle(p, normal, effects);
    for (iso_effect_id e = 0; status == ISO_OK && e < ISO_EFFECTS; e++) {
        const iso_effect *effect = iso_effect_list[e];
        if (!effects->on[e]) continue;
        status = check_row(ctx, effect);
        if (status == ISO_OK && effect->fill) effect->fill(effects);
        iso_effect_number n;
        for (int i = 0; status == ISO_OK && iso_effect_number_at(effects, e, i, &n); i++)
            status = check_number(ctx, effect->name, &n, iso_effect_values(effects, e, &n));
        if (status == ISO_OK && effect->check) status = effect->check(ctx, p, normal, effects);
        if (status == ISO_OK && effect->needs_D) status = check_D(ctx, p, effect->name);
        if (status == ISO_OK) status = check_equations(ctx, p, start, effects, e);
    }
    return status;
}

/* --- columns ---------------------------------------------------------------------------------------------------- */

const char *iso_effect_column_name(int i, iso_effect_id *effect, const iso_effect_column **group, int *in_group)
{
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        for (const iso_effect_column *c = iso_effect_list[e]->columns; c && c->name; c++) {
            if (i < c->count) {
                if (effect) *effect = e;
                if (group) *group = c;
                if (in_group) *in_group = i;
                return c->column[i];
            }
            i -= c->count;
        }
    return NULL;
}

int iso_effect_columns(void)
{
    return iso_effect_first_column(ISO_EFFECTS);
}

int iso_effect_first_column(iso_effect_id id)
{
    int count = 0;
    for (iso_effect_id e = 0; e < id; e++)
        for (const iso_effect_column *c = iso_effect_list[e]->columns; c && c->name; c++) count += c->count;
    return count;
}

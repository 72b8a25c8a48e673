/* description.c - the # lines of a trajectory: what a record says of its ball and its effects. */
#include "orbit/orbit_impl.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/names_impl.h"
#include "base/vec3_impl.h"
#include "base/version.h"
#include "model/effects/effects_impl.h"
#include "model/model_impl.h"

void iso_effect_line(char key[ISO_NAME_SIZE], const iso_effect *effect, const char *name)
{
    snprintf(key, ISO_NAME_SIZE, "%s.%s", effect->name, name);
}

int iso_effect_group(iso_effect_id id, const char *name, const iso_effect_column **group)
{
    int column = ISO_COLUMN_EFFECTS + iso_effect_first_column(id);
    if (group) *group = NULL;
    for (const iso_effect_column *g = iso_effect_list[id]->columns; g && g->name; column += g->count, g++) {
        if (group) *group = g;
        if (name ? strcmp(g->name, name) == 0 : g->moves) return column;
    }
    return -1;
}

bool iso_columns_have_group(const int columns[ISO_TRAJECTORY_COLUMNS], iso_effect_id id, const char *name)
{
    const iso_effect_column *g;
    const int first = iso_effect_group(id, name, &g);
    for (int i = 0; i < g->count; i++)
        if (columns[first + i] < 0) return false;
    return true;
}

bool iso_columns_have_beginning(const int columns[ISO_TRAJECTORY_COLUMNS], const iso_params *p, iso_effect_id id)
{
    bool has = p->k != 1 || iso_effect_group(id, NULL, NULL) < 0 || iso_columns_have_group(columns, id, NULL);
    for (const iso_effect_number *n = iso_effect_list[id]->numbers; n && n->name; n++)
        if (n->turns_with) has = has && iso_columns_have_group(columns, id, n->turns_with);
    return has;
}

iso_status iso_record_describe_effects(iso_context *ctx, iso_record *r, const iso_effects *effects)
{
    ISO_DEFAULT_ARITHMETIC;
    char names[256] = "", key[ISO_NAME_SIZE];
    iso_effect_number n;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        const iso_effect *effect = iso_effect_list[e];
        if (!effects->on[e] || e == ISO_CLOCK) continue;
        const size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, "%s%s", used ? " " : "", effect->name);
        for (int i = 0; effect->expressions && effect->expressions[i]; i++) {
            if (!iso_written_has(effects, e, i)) continue;
            iso_effect_line(key, effect, effect->expressions[i]);
            ISO_TRY(iso_record_set(ctx, r, key, effects->written[effect->written].expression[i]));
        }
        for (int i = 0; iso_effect_number_at(effects, e, i, &n); i++) {
            const double *x = iso_effect_values(effects, e, &n);
            if (n.scene_only) continue;
            iso_effect_line(key, effect, n.name);
            ISO_TRY(n.kind == ISO_NUMBER_WORD ? iso_record_set(ctx, r, key, n.word((int)x[0]))
                                              : iso_record_set_numbers(ctx, r, key, (size_t)n.count, x));
        }
    }
    return *names ? iso_record_set(ctx, r, "effects", names) : ISO_OK;
}

iso_status iso_record_describe(iso_context *ctx, iso_record *r, const char *model, const iso_params *p,
                               const iso_orbit *orbit)
{
    ISO_DEFAULT_ARITHMETIC;
    ISO_TRY(iso_record_set(ctx, r, "model", model));
    ISO_TRY(iso_record_set_numbers(ctx, r, "k", 1, &p->k));
    ISO_TRY(iso_record_set_numbers(ctx, r, "J", 3, p->J));
    if (!orbit) return ISO_OK;
    const bool twin = iso_orbit_has_twin(orbit);
    const double h = iso_orbit_energy(orbit), eps = iso_orbit_coupling(orbit);
    iso_effects effects = iso_orbit_effects(orbit);
    /* effects that only observe are the ball's: rows of the point have none of their columns */
    if (strcmp(model, iso_model_kind_name(ISO_POINT)) == 0) effects = iso_effects_acting(&effects);
    const double c = iso_effects_level(&effects);
    iso_effects_set_level(&effects, iso_effects_have_level(&effects) && isnormal(c), c);
    if (iso_effects_need_D(&effects)) ISO_TRY(iso_record_set_numbers(ctx, r, "D", 1, &p->D));
    if (iso_effects_need_radius(&effects) && p->body.radius > 0)
        ISO_TRY(iso_record_set_numbers(ctx, r, "radius", 1, &p->body.radius));
    if (twin && isnormal(h)) ISO_TRY(iso_record_set_numbers(ctx, r, "h", 1, &h));
    if (twin && isnormal(eps)) ISO_TRY(iso_record_set_numbers(ctx, r, "eps", 1, &eps));
    return iso_record_describe_effects(ctx, r, &effects);
}

iso_status iso_record_params(iso_context *ctx, const iso_record *r, iso_params *p)
{
    ISO_DEFAULT_ARITHMETIC;
    double k, J[3], D;
    iso_status status;
    const bool has_k = iso_record_get_numbers(ctx, r, "k", 1, &k, &status);
    if (status != ISO_OK) return status;
    const bool has_J = iso_record_get_numbers(ctx, r, "J", 3, J, &status);
    if (status != ISO_OK) return status;
    if (has_k && has_J) {
        ISO_TRY(iso_params_reduced(ctx, k, J, p));
        if (iso_record_get_numbers(ctx, r, "D", 1, &D, &status)) status = iso_params_set_D(ctx, D, p);
        if (status == ISO_OK) iso_record_get_numbers(ctx, r, "radius", 1, &p->body.radius, &status);
        return status;
    }
    return ISO_FAIL_INPUT(ctx, has_k ? "J" : "k",
                          "the trajectory does not say its %s: write it in a line '# %s' of the file, or give --%s",
                          has_k ? "J" : "k", has_k ? "J: J1 J2 J3" : "k: K", has_k ? "J J1,J2,J3" : "k K");
}

iso_status iso_record_find_state(iso_context *ctx, const iso_record *r, iso_model_kind model, int columns[ISO_STATE])
{
    ISO_DEFAULT_ARITHMETIC;
    const char *const *names = (model == ISO_BALL ? &iso_system_ball : &iso_system_point)->state;
    const char *missing;
    if (iso_record_find_all(r, ISO_STATE, names, columns, &missing)) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, "columns", "the trajectory has no column '%s', which a %s has", missing,
                          iso_model_kind_name((int)model));
}

bool iso_record_coupling(iso_context *ctx, const iso_record *r, const iso_params *p, double *eps, iso_status *status)
{
    if (iso_record_get_numbers(ctx, r, "eps", 1, eps, status)) return true;
    if (*status != ISO_OK || !iso_record_get_numbers(ctx, r, "h", 1, eps, status)) return false;
    const double h = *eps;
    *eps = iso_coupling(p, h); /* may not fit a double where h does */
    return h == 0 || isnormal(*eps);
}

/* NAME of "effect.NAME"; NULL: the line is not the effect's. */
static const char *name_of_line(const iso_effect *effect, const char *key)
{
    const size_t length = strlen(effect->name);
    return strncmp(key, effect->name, length) == 0 && key[length] == '.' ? key + length + 1 : NULL;
}

/* Refuses numbers of an effect that the line `effects` does not name, and columns of one that acts: the line is lost
 * or damaged. */
static iso_status check_unnamed(iso_context *ctx, const iso_record *r, const iso_effect *effect)
{
    const char *column = effect->observes || !effect->columns ? NULL : effect->columns->column[0];
    const char *key, *value, *name;
    for (size_t i = 0; iso_record_line(r, i, &key, &value); i++)
        if ((name = name_of_line(effect, key)) && iso_effect_is_key(effect, name))
            return ISO_FAIL_INPUT(ctx, "effects", "there is a line '# %s', but no line '# effects' that names '%s'",
                                  key, effect->name);
    if (!column || iso_record_find(r, column) < 0) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, "effects", "there is a column '%s', but no line '# effects' that names '%s'", column,
                          effect->name);
}

static iso_status missing_line(iso_context *ctx, const iso_effect *effect, const char *key)
{
    return ISO_FAIL_INPUT(ctx, "effects", "effect '%s' needs a line '# %s: ...'", effect->name, key);
}

/* The text of an effect, and its parameters: all other lines that begin with its name. */
static iso_status read_text(iso_context *ctx, const iso_record *r, iso_effect_id e, iso_effects *effects)
{
    const iso_effect *effect = iso_effect_list[e];
    const char *key, *value, *name;
    char line[ISO_NAME_SIZE];
    iso_status status = ISO_OK;
    double x;
    for (int i = 0; effect->expressions[i]; i++) {
        iso_effect_line(line, effect, effect->expressions[i]);
        if (!iso_record_get(r, line) && !iso_written_has(effects, e, i)) continue;
        if (!iso_record_get(r, line)) return missing_line(ctx, effect, line);
        status = iso_effects_write(ctx, effects, effect->name, effect->expressions[i], iso_record_get(r, line));
        if (status != ISO_OK) return ISO_FAIL_INPUT(ctx, line, "%s", iso_context_message(ctx));
    }
    for (size_t i = 0; iso_record_line(r, i, &key, &value); i++) {
        if (!(name = name_of_line(effect, key)) || iso_effect_is_key(effect, name)) continue;
        if (!iso_record_get_numbers(ctx, r, key, 1, &x, &status)) return status;
        status = iso_effects_set(ctx, effects, effect->name, name, 1, &x);
        if (status != ISO_OK) return ISO_FAIL_INPUT(ctx, key, "%s", iso_context_message(ctx));
    }
    return ISO_OK;
}

static iso_status read_effect(iso_context *ctx, const iso_record *r, iso_effect_id e, iso_effects *effects)
{
    const iso_effect *effect = iso_effect_list[e];
    char key[ISO_NAME_SIZE], suggested[ISO_SUGGEST_SIZE];
    iso_status status;
    effects->on[e] = true;
    if (effect->expressions) ISO_TRY(read_text(ctx, r, e, effects));
    for (const iso_effect_number *n = effect->numbers; n && n->name; n++) {
        if (n->scene_only || n->hidden) continue;
        iso_effect_line(key, effect, n->name);
        const char *text = iso_record_get(r, key), *word;
        double *x = iso_effect_values(effects, e, n);
        if (!text) return missing_line(ctx, effect, key);
        if (n->kind != ISO_NUMBER_WORD) {
            if (!iso_record_get_numbers(ctx, r, key, (size_t)n->count, x, &status)) return status;
            continue;
        }
        int i = 0;
        while ((word = n->word(i)) && strcmp(text, word) != 0) i++;
        if (!word)
            return ISO_FAIL_INPUT(ctx, key, "'%s' is '%s'; %s", key, text,
                                  iso_suggest_word(suggested, text, n->word));
        *x = i;
    }
    return ISO_OK;
}

iso_status iso_record_effects(iso_context *ctx, const iso_record *r, iso_effects *effects)
{
    ISO_DEFAULT_ARITHMETIC;
    const char *names = iso_record_get(r, "effects");
    *effects = iso_effects_default();
    if (names) names += strspn(names, " \t");
    for (size_t length; names && *names; names += length + strspn(names + length, " \t")) {
        length = strcspn(names, " \t");
        char name[ISO_NAME_SIZE] = "", suggested[ISO_SUGGEST_SIZE];
        if (length < sizeof name) memcpy(name, names, length);
        const iso_effect_id e = iso_effect_find(name);
        if (e == ISO_EFFECTS)
            return ISO_FAIL_INPUT(ctx, "effects", "there is no effect '%.*s'; %s", (int)length, names,
                                  iso_suggest_word(suggested, name, iso_effect_name));
        ISO_TRY(read_effect(ctx, r, e, effects));
    }
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        if (!effects->on[e]) ISO_TRY(check_unnamed(ctx, r, iso_effect_list[e]));
    return ISO_OK;
}

bool iso_record_up(iso_context *ctx, const iso_record *r, double up[3])
{
    ISO_DEFAULT_ARITHMETIC;
    static const char *const names[] = {"q0", "q1", "q2", "q3", "e1", "e2", "e3"};
    double x[7];
    int columns[7];
    iso_status status;
    const bool lines = iso_record_get_numbers(ctx, r, "attitude.quaternion", 4, x, &status) &&
                       iso_record_get_numbers(ctx, r, "gravity.up", 3, x + 4, &status);
    const bool there = iso_record_rows(r) > 0 && iso_record_find_all(r, 7, names, columns, NULL);
    for (int i = 0; !lines && there && i < 7; i++) x[i] = iso_record_const_row(r, 0)[columns[i]];
    if (!lines && !there) return false;
    iso_turn_to_space(x, x + 4, up);
    const double length = norm(up);
    scale(up, 1 / length);
    return fabs(length - 1) <= 1e-3;
}

/* Numbers that turn with the ball: an orbit that starts at this row starts with the vertical, or quaternion, of the
 * row. */
static iso_status turn_effects(iso_context *ctx, const iso_record *r, const double row[], iso_effects *effects)
{
    int columns[ISO_EFFECT_NUMBERS];
    const char *missing;
    const iso_effect_column *group;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        for (const iso_effect_number *n = iso_effect_list[e]->numbers; effects->on[e] && n && n->name; n++) {
            if (!n->turns_with) continue;
            iso_effect_group(e, n->turns_with, &group);
            if (!iso_record_find_all(r, (size_t)n->count, group->column, columns, &missing))
                return ISO_FAIL_INPUT(ctx, "columns",
                                      "the trajectory has no column '%s', without which '%s' is not known", missing,
                                      iso_effect_list[e]->name);
            for (int i = 0; i < n->count; i++) iso_effect_values(effects, e, n)[i] = row[columns[i]];
        }
    return ISO_OK;
}

/* "; --row-tolerance X takes it", X the next power of ten; "" where no tolerance does. */
static const char *advice(double off, char text[64])
{
    const double wide = pow(10, ceil(log10(off)));
    *text = '\0';
    if (wide <= ISO_MOST_TOLERANCE) snprintf(text, 64, "; --row-tolerance %g takes it", wide);
    return text;
}

iso_status iso_start_from_row(iso_context *ctx, iso_model_kind model, const double y[ISO_STATE], const double *eps,
                              bool twists, double tolerance, iso_start *start)
{
    const bool ball = model == ISO_BALL;
    char text[64];
    double unit[3];
    copy(y + 3, unit, 3);
    const double size = largest(y), length = norm(unit);
    const bool is_near = fabs(length - 1) <= tolerance;
    const double exact = is_near ? 1 : hypot(hypot(unit[0], unit[1]), unit[2]); /* squares may not fit a double */
    if (isfinite(exact) && exact > 0 && !is_near)
        return ISO_FAIL_INPUT(ctx, "", "|%s| = %.10g: a unit vector to %g is expected%s", ball ? "n" : "gamma", exact,
                              tolerance, advice(fabs(exact - 1), text));
    if (is_near) scale(unit, 1 / length);
    const double along = size > 0 ? y[0] / size * unit[0] + y[1] / size * unit[1] + y[2] / size * unit[2] : 0;
    ISO_TRY(ball ? iso_start_ball(ctx, y, unit, twists ? ISO_SPIN_KEEP : ISO_SPIN_REMOVE, start)
                 : iso_start_point(ctx, y, unit, eps, true, start));
    if (twists || fabs(along) <= tolerance) return ISO_OK;
    return ISO_FAIL_INPUT(
        ctx, "", "%s has a part %.3g of its size along %s: this is no %s (a right angle to %g is expected%s)",
        ball ? "omega" : "M", along, ball ? "n" : "gamma", ball ? "rubber ball's motion" : "point on a sphere",
        tolerance, advice(fabs(along), text));
}

iso_status iso_record_start_at(iso_context *ctx, const iso_record *r, const iso_params *p, iso_model_kind model,
                               const double row[], iso_start *start, iso_effects *effects)
{
    ISO_DEFAULT_ARITHMETIC;
    int columns[ISO_STATE];
    double y[ISO_STATE], eps;
    iso_status status = ISO_OK;
    ISO_TRY(iso_record_find_state(ctx, r, model, columns));
    ISO_TRY(turn_effects(ctx, r, row, effects));
    for (int i = 0; i < ISO_STATE; i++) y[i] = row[columns[i]];
    const bool states_eps = model == ISO_POINT && iso_record_coupling(ctx, r, p, &eps, &status);
    if (status != ISO_OK) return status;
    ISO_TRY(iso_start_from_row(ctx, model, y, states_eps ? &eps : NULL, iso_effects_twist(effects),
                               iso_record_row_tolerance(r), start));
    iso_start_settle(p, start, effects);
    return ISO_OK;
}

iso_status iso_record_start(iso_context *ctx, const iso_record *r, const iso_params *p, iso_model_kind model,
                            size_t row, iso_start *start, iso_effects *effects)
{
    const iso_status status = iso_record_start_at(ctx, r, p, model, iso_record_const_row(r, row), start, effects);
    if (status == ISO_OK) return ISO_OK;
    return iso_context_fail(ctx, status, "", "row %zu: %s", row + 1, iso_context_message(ctx));
}

void iso_record_sample(const iso_record *record, size_t row, iso_sample *sample)
{
    int columns[ISO_TRAJECTORY_COLUMNS];
    iso_record_find_columns(record, columns);
    iso_sample_of_row(columns, iso_record_const_row(record, row), sample);
}

void iso_record_find_columns(const iso_record *r, int columns[ISO_TRAJECTORY_COLUMNS])
{
    for (int i = 0; i < ISO_TRAJECTORY_COLUMNS; i++)
        columns[i] = i < iso_columns_count() ? iso_record_find(r, iso_column_name(i)) : -1;
}

void iso_sample_of_row(const int columns[ISO_TRAJECTORY_COLUMNS], const double row[], iso_sample *sample)
{
    for (int i = 0; i < ISO_TRAJECTORY_COLUMNS; i++)
        iso_sample_set_column(sample, i, columns[i] < 0 ? NAN : row[columns[i]]);
}

/* --- tables: the scene that they are of ------------------------------------------------------------------------- */

iso_status iso_record_describe_start(iso_context *ctx, iso_record *r, const iso_start *start)
{
    const bool ball = start->model == ISO_BALL;
    ISO_TRY(iso_record_set_numbers(ctx, r, ball ? "initial.normal" : "initial.gamma", 3, start->y + 3));
    return iso_record_set_numbers(ctx, r, ball ? "initial.angular_velocity" : "initial.M", 3, start->y);
}

iso_status iso_record_describe_scene(iso_context *ctx, iso_record *r, const iso_scene *scene)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_orbit *orbit; /* knows h and eps; NULL: it cannot be computed, but the table may be of others */
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    o.effects = &scene->effects;
    iso_orbit_create(ctx, &scene->params, &scene->start, &o, &orbit);
    const char *model = iso_model_kind_name((int)scene->start.model);
    iso_status status = iso_record_describe(ctx, r, model, &scene->params, orbit);
    if (status == ISO_OK && !orbit) status = iso_record_describe_effects(ctx, r, &scene->effects);
    iso_orbit_free(orbit);
    if (status == ISO_OK) status = iso_record_describe_start(ctx, r, &scene->start);
    return status == ISO_OK ? iso_record_set(ctx, r, "isoroll", ISO_VERSION) : status;
}

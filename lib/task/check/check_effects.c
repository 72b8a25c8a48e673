/* check_effects.c - the columns of effects: each row integrated to the next, and compared; and what
 * lines state of the energy and of the start, against a row. These numbers make no motion of their own, so that no flow
 * shows when they are wrong. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "model/model_impl.h"
#include "orbit/orbit_impl.h"
#include "task/check/check_impl.h"

/* Groups that are side by side and have one name in the report: `count` columns from `first` on. */
typedef struct checked {
    const iso_effect_column *group;
    iso_effect_id effect;
    int first, count;
} checked;

/* What is compared: the number, or the angle of a ratio. */
static double measured(const checked *k, double number)
{
    return k->group->ratio ? atan(number) : number;
}

static void check_columns(checker *c, iso_residuals *found, const checked *k, const iso_sample *flow,
                          const double row[])
{
    bool any = false;
    double error = 0, size = k->group->ratio ? 1 : 0;
    if (k->group->sized_by &&
        !k->group->ratio) { /* the radius carries it into these units: forces times it are torques */
        const double radius = c->params->body.radius > 0 ? c->params->body.radius : 1;
        const iso_effect_column *g;
        const int other = iso_effect_group(k->effect, k->group->sized_by, &g);
        for (int i = 0; i < g->count; i++)
            size = fmax(size, fabs(iso_sample_column(flow, other + i)) * pow(radius, k->group->length - g->length));
    }
    char name[sizeof found->residual[0].name];
    for (int i = k->first; i < k->first + k->count; i++) {
        const double expected = measured(k, iso_sample_column(flow, i));
        if (isnan(expected) || c->columns[i] < 0) continue;
        const double there = measured(k, iso_checker_at(c, row, i));
        any = c->looked[i] = true;
        error = fmax(error, fabs(expected - there));
        size = fmax(size, fmax(fabs(expected), fabs(there)));
    }
    snprintf(name, sizeof name, "%s flow", k->group->checked_as);
    if (any && size > 0) iso_checker_note(found, name, "columns of effects, row to row", error / size, c->number);
}

void iso_checker_effects_flow(checker *c, iso_residuals *found, const iso_sample *flow, const double row[])
{
    int first = ISO_COLUMN_EFFECTS;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        for (const iso_effect_column *g = iso_effect_list[e]->columns; g && g->name; g++) {
            checked k = {.group = g, .effect = e, .first = first, .count = g->count};
            for (; g->checked_as && g[1].name && g[1].checked_as && strcmp(g->checked_as, g[1].checked_as) == 0; g++)
                k.count += g[1].count;
            if (g->checked_as) check_columns(c, found, &k, flow, row);
            first += k.count;
        }
}

void iso_checker_go_on(const checker *c, const double row[], iso_sample *flow)
{
    int column = ISO_COLUMN_EFFECTS;
    for (iso_effect_id e = 0; c->params->k == 1 && e < ISO_EFFECTS; e++)
        for (const iso_effect_column *g = iso_effect_list[e]->columns; g && g->name; column += g->count, g++)
            for (int i = 0; g->moves && i < g->count; i++) {
                const int from =
                    c->columns[iso_effect_group(e, NULL, NULL) + i]; /* the centre lacks only its height b n */
                const double there = iso_sample_column(flow, column + i);
                iso_sample_set_column(flow, column + i, from < 0 ? NAN : there + row[from]);
            }
}

bool iso_checker_has_effects(const checker *c)
{
    for (int i = ISO_COLUMN_EFFECTS; i < ISO_TRAJECTORY_COLUMNS; i++)
        if (c->columns[i] >= 0) return true;
    return false;
}

/* An observer can be asked for because its columns are there, unless a line has to state a number. */
void iso_checker_choose_observers(checker *c)
{
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        const iso_effect *effect = iso_effect_list[e];
        bool stated = false, there = false;
        if (!effect->observes) continue;
        for (const iso_effect_number *n = effect->numbers; n && n->name; n++) stated = stated || !n->scene_only;
        for (int i = iso_effect_first_column(e); i < iso_effect_first_column((iso_effect_id)(e + 1)); i++)
            there = there || c->columns[ISO_COLUMN_EFFECTS + i] >= 0;
        const bool shown = there && !stated && (!effect->needs_D || c->params->D > 0);
        c->effects.on[e] = shown || (c->effects.on[e] && iso_columns_have_beginning(c->columns, c->params, e));
    }
}

/* --- lines: h, eps, c ------------------------------------------------------------------------------------------- */

/* How far the first row is from the energy h, relative to the size of its terms. A point has it if its H is that of
 * its level. */
static double off_energy(const checked_model *m, const double own[], double h)
{
    double size;
    iso_problem f = iso_orbit_model(m->orbit)->problem;
    const bool ball = m->kind == ISO_BALL;
    if (!ball) f.eps = iso_coupling(&f.p, h);
    const double here = m->system->energy(&f, own, &size), wanted = ball ? h : m->level;
    return here == wanted ? 0 : fabs(here - wanted) / fmax(size, fabs(wanted));
}

static void note_line(checker *c, checked_model *m, const char *key, const char *what, double off)
{
    char name[sizeof m->found.residual[0].name];
    snprintf(name, sizeof name, "# %s", key);
    iso_checker_note(&m->found, name, what, off, c->number);
}

iso_status iso_checker_energy(checker *c, checked_model *m, const double first[])
{
    const iso_units *units = iso_orbit_units(m->orbit);
    const bool ball = m->kind == ISO_BALL, level = iso_effects_have_level(&c->stated);
    const bool any_level = !ball && !m->on_level;
    const char *what = any_level ? "h and eps of the file, against each other" : "this line, against the first row";
    double own[ISO_MAX_STATE], least = INFINITY;
    iso_sample sample;
    iso_status status;
    const double h = iso_stated_energy(c->ctx, c->record, units, "h", &status);
    ISO_TRY(status);
    const double eps = iso_stated_energy(c->ctx, c->record, units, "eps", &status);
    const bool has_h = isfinite(h), has_eps = isfinite(eps);
    if (status != ISO_OK || !iso_orbit_has_twin(m->orbit) || (!ball && c->model[ISO_BALL].there)) return status;
    iso_sample_of_row(c->columns, first, &sample);
    iso_orbit_state_of(m->orbit, m->system, &sample, own);
    if (any_level) { /* a free point may have any H: h and eps are compared with each other; the flow depends on eps */
        double size;
        iso_problem f = iso_orbit_model(m->orbit)->problem;
        if (!has_h || !has_eps) return ISO_OK;
        f.eps = iso_coupling(&units->own, eps);
        m->level = m->system->energy(&f, own, &size);
    }
    if (has_h) note_line(c, m, "h", what, least = off_energy(m, own, h));
    if (has_eps) note_line(c, m, "eps", what, off_energy(m, own, any_level ? h : eps));
    if (has_eps) least = fmin(least, off_energy(m, own, eps));
    char key[ISO_NAME_SIZE];
    const iso_effect *of_level = level ? iso_effect_list[iso_effect_find(iso_level_name())] : NULL;
    if (!level || isinf(least)) return ISO_OK;
    iso_effect_line(key, of_level, of_level->numbers->name);
    note_line(c, m, key, "this line, against the first row and h or eps", least);
    return ISO_OK;
}

/* --- lines: the start ------------------------------------------------------------------------------------------- */

void iso_checker_beginning(checker *c, checked_model *ball, const double row[])
{
    char key[ISO_NAME_SIZE];
    if (ball->clock < 0 || iso_checker_at(c, row, ball->clock) != 0) return;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        for (const iso_effect_number *n = iso_effect_list[e]->numbers; c->stated.on[e] && n && n->name; n++) {
            if (!n->turns_with || !iso_columns_have_group(c->columns, e, n->turns_with)) continue;
            const int column = iso_effect_group(e, n->turns_with, NULL);
            double error = 0, size = 0;
            for (int i = 0; i < n->count; i++) {
                const double stated = iso_effect_values(&c->stated, e, n)[i],
                             there = iso_checker_at(c, row, column + i);
                error = fmax(error, fabs(there - stated));
                size = fmax(size, fmax(fabs(there), fabs(stated)));
            }
            iso_effect_line(key, iso_effect_list[e], n->name);
            note_line(c, ball, key, "this line, against the row at time 0", size > 0 ? error / size : 0);
        }
}

/* check_effects.c - the columns of effects: each row integrated to the next, and compared (check_impl.h). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "study/check_impl.h"

/* The first column of a group of an effect, in a trajectory; NULL: that of the first group that moves. -1: none. */
static int column_of(iso_effect_id id, const char *name)
{
    int column = ISO_COLUMN_EFFECTS + iso_effect_first_column(id);
    for (const iso_effect_column *g = iso_effect_list[id]->columns; g && g->name; column += g->count, g++)
        if (name ? strcmp(g->name, name) == 0 : g->moves) return column;
    return -1;
}

/* Groups that are side by side and have one name in the report: `count` columns from `first` on. */
typedef struct checked {
    const iso_effect_column *group;
    iso_effect_id effect;
    int first, count;
} checked;

/* The size of the group that errors are measured by as well: of forces, of which the radius makes torques. */
static double other_size(const checker *c, const checked *k, const iso_sample *flow)
{
    const double radius = c->params->body.radius;
    double size = 0;
    if (!k->group->sized_by) return 0;
    const int first = column_of(k->effect, k->group->sized_by);
    for (const iso_effect_column *g = iso_effect_list[k->effect]->columns; first >= 0 && g->name; g++)
        for (int i = 0; strcmp(g->name, k->group->sized_by) == 0 && i < g->count; i++)
            size = fmax(size, fabs(iso_sample_column(flow, first + i)));
    return size * fmax(1, radius > 0 ? radius : 1);
}

/* What moves along a plane goes on from the row before. */
static void check_columns(const checker *c, iso_residuals *found, const checked *k, const iso_sample *flow,
                          const iso_sample *before, const iso_sample *there)
{
    const bool goes_on = c->params->k == 1 && k->group->moves;
    double error = 0, size = 0;
    char name[sizeof found->residual[0].name];
    for (int i = k->first; i < k->first + k->count; i++) {
        double expected = iso_sample_column(flow, i);
        if (goes_on) expected += iso_sample_column(before, column_of(k->effect, NULL) + (i - k->first));
        if (isnan(expected) || c->columns[i] < 0) continue;
        error = fmax(error, fabs(expected - iso_sample_column(there, i)));
        size = fmax(size, fmax(fabs(expected), fabs(iso_sample_column(there, i))));
    }
    size = fmax(size, other_size(c, k, flow));
    snprintf(name, sizeof name, "%s flow", k->group->checked_as);
    if (size > 0)
        iso_checker_note(found, name, "effects' columns, each row integrated to the next", error / size, c->number);
}

static bool same_report(const iso_effect_column *a, const iso_effect_column *b)
{
    return b->name && a->checked_as && b->checked_as && strcmp(a->checked_as, b->checked_as) == 0;
}

void iso_checker_effects_flow(checker *c, iso_residuals *found, const iso_sample *flow, const double row[])
{
    iso_sample there, before;
    int first = ISO_COLUMN_EFFECTS;
    iso_checker_sample(c, row, &there);
    iso_checker_sample(c, c->last, &before);
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        for (const iso_effect_column *g = iso_effect_list[e]->columns; g && g->name; g++) {
            checked k = {.group = g, .effect = e, .first = first, .count = g->count};
            for (; same_report(g, g + 1); g++) k.count += g[1].count;
            if (g->checked_as) check_columns(c, found, &k, flow, &before, &there);
            first += k.count;
        }
}

bool iso_checker_has_effects(const checker *c)
{
    for (int i = ISO_COLUMN_EFFECTS; i < ISO_TRAJECTORY_COLUMNS; i++)
        if (c->columns[i] >= 0) return true;
    return false;
}

/* Whether the record has what an effect that acts on nothing begins with: the numbers that turn with the ball, and
 * on a plane the displacement, without which the height is not known. */
static bool has_beginning(const checker *c, iso_effect_id id)
{
    const int displacement = column_of(id, NULL);
    bool has = c->params->k != 1 || displacement < 0 || c->columns[displacement] >= 0;
    for (const iso_effect_number *n = iso_effect_list[id]->numbers; n && n->name; n++)
        if (n->turns_with) has = has && c->columns[column_of(id, n->turns_with)] >= 0;
    return has;
}

/* Whether an effect that acts on nothing can be asked for because its columns are there: no line has to state a
 * number. */
static bool is_shown(const checker *c, iso_effect_id id)
{
    const iso_effect *effect = iso_effect_list[id];
    bool stated = false;
    for (const iso_effect_number *n = effect->numbers; n && n->name; n++) stated = stated || !n->scene_only;
    return effect->columns && !stated && (!effect->needs_D || c->params->D > 0) &&
           c->columns[ISO_COLUMN_EFFECTS + iso_effect_first_column(id)] >= 0;
}

void iso_checker_choose_observers(checker *c)
{
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        if (iso_effect_list[e]->observes)
            c->effects.on[e] = (c->effects.on[e] && has_beginning(c, e)) || is_shown(c, e);
}

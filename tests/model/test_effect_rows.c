/* The rows of the registry of effects: each says all that its parts need (lib/model/effects/effect.h). */
#include "laws.h"
#include "orbit/orbit_impl.h"

static void complete(const iso_effect *e, bool holds, const char *what)
{
    gsl_test(!holds, "the row of %s: %s", e->name, what);
}

/* The numbers of the group called `name`; 0: there is none. */
static int group_size(const iso_effect *e, const char *name)
{
    for (const iso_effect_column *g = e->columns; g && g->name; g++)
        if (strcmp(g->name, name) == 0) return g->count;
    return 0;
}

static void complete_numbers(const iso_effect *e)
{
    for (const iso_effect_number *n = e->numbers; n && n->name; n++) {
        complete(e, n->at >= 0 && n->count > 0 && n->at + n->count <= ISO_EFFECT_NUMBERS, n->name);
        complete(e, !n->turns_with || group_size(e, n->turns_with) == n->count, "what a number turns with");
        for (const iso_effect_number *m = e->numbers; m < n; m++)
            complete(e, strcmp(m->name, n->name) != 0 && (m->at + m->count <= n->at || n->at + n->count <= m->at),
                     "numbers apart");
    }
}

static void complete_columns(const iso_effect *e)
{
    bool acts = false;
    for (const iso_effect_column *g = e->columns; g && g->name; g++) {
        complete(e, g->count > 0 && g->column, g->name);
        complete(e, !g->sized_by || group_size(e, g->sized_by) > 0, "what a column is sized by");
        acts = acts || g->moves;
        for (int i = 0; i < g->count; i++) complete(e, iso_column_find(g->column[i]) >= 0, g->column[i]);
    }
    complete(e, !e->columns || e->show, "columns are shown");
    complete(e, !e->columns || !e->states || e->recall, "states are found again from columns");
    complete(e, !acts || e->needs_radius, "what moves is a length");
}

/* Every row says all that its parts need. */
static void complete_rows(void)
{
    for (iso_effect_id id = 0; id < ISO_EFFECTS; id++) {
        const iso_effect *e = iso_effect_list[id];
        complete(e, e->name && *e->name && e->doc && *e->doc, "name and doc");
        complete(e, iso_effect_find(e->name) == id, "its name is its own");
        complete(e, e->observes || e->motion || e->torque, "what acts has equations");
        complete(e, e->observes || e->work, "what acts says what it does to the energy");
        complete(e, !e->states || (e->begin && e->states_doc && e->size && e->motion),
                 "states begin, and have a size");
        complete(e, !e->time_to_rest || e->stiffness, "what ends motion is as fast as it says");
        complete_numbers(e);
        complete_columns(e);
    }
    gsl_test(iso_effect_columns() > ISO_EFFECT_COLUMNS, "room for the columns of all effects");
    gsl_test(iso_columns_count() != ISO_COLUMN_EFFECTS + iso_effect_columns(), "all columns have a name");
}

/* Numbers set by name: the words of what is wrong name it. */
static void numbers_by_name(void)
{
    static const struct {
        const char *effect, *name;
        int count;
        const char *words;
    } wrong[] = {{"gravty", "mgb", 1, "no effect 'gravty'"},
                 {"gravity", "weight", 1, "no number 'weight'"},
                 {"gravity", "up", 2, "has 3 numbers, not 2"},
                 {"gravity", "g", 1, "is for scenes alone"}};
    iso_context *ctx = iso_context_create();
    iso_effects effects = iso_effects_default();
    const double x[] = {0.36, 0.48, 0.8};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        const iso_status status = iso_effects_set(ctx, &effects, wrong[i].effect, wrong[i].name, wrong[i].count, x);
        const char *words = iso_context_message(ctx);
        gsl_test(status != ISO_BAD_ARGUMENT || !strstr(words, wrong[i].words), "%s.%s: %s", wrong[i].effect,
                 wrong[i].name, words);
    }
    gsl_test(iso_effects_set(ctx, &effects, "gravity", "up", 3, x) != ISO_OK || !effects.on[ISO_GRAVITY] ||
                 effects.number[ISO_GRAVITY][3] != x[2],
             "gravity.up is set by its name");
    iso_context_free(ctx);
}

int main(void)
{
    complete_rows();
    numbers_by_name();
    exit(gsl_test_summary());
}

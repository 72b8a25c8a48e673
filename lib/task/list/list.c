/* list.c - what there is, as text: systems, backends, effects, methods and so on; and the lists of studies
 * (study/study.h) and of the tables that they make (see list_impl.h). */
#include "task/list/list_impl.h"

#include <string.h>

#include "base/names_impl.h"
#include "instrument/chaos/chaos.h"
#include "instrument/frequencies/frequencies.h"
#include "instrument/integrals/integrals.h"
#include "instrument/periodic/continuation.h"
#include "instrument/periodic/periodic.h"
#include "instrument/periodic/stability_chart.h"
#include "instrument/section/section.h"
#include "instrument/separatrix/separatrix.h"
#include "method/methods_impl.h"
#include "orbit/orbit_impl.h"
#include "study/fields_impl.h"
#include "study/options_impl.h"
#include "task/cost/cost.h"

/* --- studies and tables ----------------------------------------------------------------------------------------- */

#define ISO_STUDY_ROW(name) &iso_##name##_study,

const iso_study *iso_study_at(int i)
{
    static const iso_study *const studies[] = {ISO_STUDY_LIST(ISO_STUDY_ROW)};
    return i >= 0 && i < (int)(sizeof studies / sizeof *studies) ? studies[i] : NULL;
}

const iso_study *iso_study_find(const char *name)
{
    int i = 0;
    while (iso_study_at(i) && strcmp(iso_study_at(i)->name, name) != 0) i++;
    return iso_study_at(i);
}

const iso_result_table *iso_result_table_at(int i)
{
    static const iso_result_table tables[] = {
        {"section", "a crossing of the section", iso_section_fields, false},
        {"chaos", "an orbit", iso_chaos_orbit_fields, false},
        {"periodic", "a periodic orbit", iso_periodic_orbit_fields, false},
        {"periodic follow", "a point of a branch, or an event on it", iso_branch_row_fields, false},
        {"periodic chart", "a point of the chart, or of a border in it", iso_chart_row_fields, false},
        {"splitting", "a value of k or of the level", iso_separatrix_fields, false},
        {"cost", "a backend with a method and a tolerance", iso_cost_cell_fields, false},
        {"check", "a residual", iso_checked_fields, true},
        {"chaos indicators", "a turn of the scene's own orbit", iso_indicator_fields, true},
        {"compare", "a time of the scene", iso_difference_fields, true},
        {"section area", "an orbit by one model", iso_section_area_fields, true},
    };
    return i >= 0 && i < (int)(sizeof tables / sizeof *tables) ? &tables[i] : NULL;
}

/* --- topics ----------------------------------------------------------------------------------------------------- */

static void list_systems(FILE *to)
{
    for (int s = 0; iso_systems[s]; s++) {
        fprintf(to, "  %-22s %s\n", iso_systems[s]->name, iso_systems[s]->doc);
        fprintf(to, "  %-22s state:", "");
        for (int i = 0; i < ISO_STATE; i++) fprintf(to, " %s", iso_systems[s]->state[i]);
        fprintf(to, "; clock: %s\n", iso_clock_name(iso_systems[s]->clock));
    }
}

static void list_backends(FILE *to)
{
    static const char *const docs[] = {
        [ISO_BACKEND_BALL] = "integrates the ball (9)",
        [ISO_BACKEND_POINT] = "integrates the point (24)",
        [ISO_BACKEND_AUTO] =
            "chooses: the cheapest for the rows of a free orbit; the ball if an effect needs it (see explain)",
        [ISO_BACKEND_EXACT] = "evaluates the closed solution, where there is one; every time costs the same",
    };
    for (int i = 0; iso_backend_name(i); i++) fprintf(to, "  %-22s %s\n", iso_backend_name(i), docs[i]);
}

static void list_integrals(FILE *to)
{
    for (int s = 0; iso_systems[s]; s++)
        for (const iso_integral *i = iso_systems[s]->integrals; i->name; i++)
            fprintf(to, "  %-18s %-10s %s\n", iso_systems[s]->name, i->name, i->doc);
    for (int e = 0; e < ISO_EFFECTS; e++)
        for (const iso_integral *i = iso_effect_list[e]->integrals; i && i->name; i++)
            fprintf(to, "  %-18s %-10s %s\n", iso_effect_list[e]->name, i->name, i->doc);
}

static void list_effects(FILE *to)
{
    for (int e = 0; e < ISO_EFFECTS; e++) {
        const iso_effect *effect = iso_effect_list[e];
        fprintf(to, "  %-22s %s\n", effect->name, effect->doc);
        /* a vector has its length behind its name, a key that may be left out is in brackets */
        if (effect->numbers) fprintf(to, "  %-22s numbers:", "");
        if (effect->expressions)
            fprintf(to, " %s [parameters]",
                    effect->expressions_key ? effect->expressions_key : effect->expressions[0]);
        for (const iso_effect_number *n = effect->numbers; n && n->name; n++) {
            if (n->hidden) continue;
            fprintf(to, n->required ? " %s" : " [%s", n->name);
            if (n->count == 9)
                fprintf(to, "(3x3)");
            else if (n->count > 1)
                fprintf(to, "(%d)", n->count);
            fprintf(to, n->required ? "" : "]");
        }
        if (effect->numbers) fprintf(to, "\n");
        if (effect->states) fprintf(to, "  %-22s states: %s\n", "", effect->states_doc);
        const char *broken = iso_effect_why_broken(effect), *name = effect->point_name; /* of a scene of a point */
        fprintf(to, "  %-22s isomorphism: %s%s%s%s%s\n", "", broken ? "lost, " : "kept", broken ? broken : "",
                name ? "; a scene of a point calls it '" : "", name ? name : "", name ? "'" : "");
    }
}

static void list_methods(FILE *to)
{
    fprintf(to, "  %-22s %-9s order\n", "name", "family");
    for (int i = 0; iso_methods[i]; i++) {
        const iso_method *m = iso_methods[i];
        char order[16] = "varies";
        if (m->order) snprintf(order, sizeof order, "%d", m->order);
        fprintf(to, "  %-22s %-9s %-6s %s%s%s", m->name, m->family, order, m->doc, m->implicit ? "; stiff" : "",
                m->projects ? "" : "; no projection");
        fprintf(to, m->system ? "; %s only\n" : "\n", m->system ? m->system->name : "");
    }
}

static void list_surfaces(FILE *to)
{
    static const char *const docs[] = {
        [ISO_PLANE] = "a ball on a plane, k = 1",
        [ISO_OUTSIDE] = "a ball on the outside of a fixed sphere, k = A/(A+B)",
        [ISO_INSIDE] = "a ball inside a fixed sphere, k = A/(A-B)",
        [ISO_SHELL] = "a hollow sphere around a fixed ball, k = -A/(B-A)",
    };
    for (int i = ISO_PLANE; iso_surface_name(i); i++) fprintf(to, "  %-22s %s\n", iso_surface_name(i), docs[i]);
}

static void list_clocks(FILE *to)
{
    static const char *const docs[] = {
        [ISO_CLOCK_T] = "the ball's time",
        [ISO_CLOCK_TAU] = "the time in which the ball is Hamiltonian, dtau/dt = N (16)",
        [ISO_CLOCK_S] = "the point's time, ds/dt = G N (24)",
    };
    for (iso_clock c = 0; c < ISO_CLOCKS; c++) fprintf(to, "  %-22s %s\n", iso_clock_name(c), docs[c]);
}

static void list_columns(FILE *to)
{
    const char *unit;
    for (int i = 0; i < iso_columns_count(); i++) {
        const char *doc = iso_column_doc(i, &unit);
        fprintf(to, "  %-22s %-10s %s\n", iso_column_name(i), *unit ? unit : "-", doc);
    }
}

static void print_column(void *data, const char *name, const iso_field *field, const iso_value *value)
{
    FILE *to = data;
    (void)value;
    fprintf(to, "    %-20s %-10s %s\n", name, *field->unit ? field->unit : "-", field->doc);
}

static void list_tables(FILE *to)
{
    const iso_result_table *t;
    for (int i = 0; (t = iso_result_table_at(i)); i++) {
        if (t->in_memory) continue;
        fprintf(to, "  %-22s a row is %s\n", t->kind, t->doc);
        iso_columns_visit(t->fields, NULL, print_column, to);
    }
}

static const struct {
    const char *name, *doc;
    void (*list)(FILE *to);
} topics[] = {
    {"systems", "the two models", list_systems},
    {"backends", "what computes an orbit (--backend)", list_backends},
    {"effects", "what can act on the ball, and what can be computed beside its motion (effects:)", list_effects},
    {"methods", "integrators (--method)", list_methods},
    {"surfaces", "what the ball rolls on (surface: kind)", list_surfaces},
    {"integrals", "first integrals, each with the k, J and effects for which it holds", list_integrals},
    {"clocks", "times of an orbit", list_clocks},
    {"columns", "of trajectory files, with unit and meaning", list_columns},
    {"tables", "that commands write: their columns, with unit and meaning", list_tables},
};
enum { TOPICS = sizeof topics / sizeof *topics };

const char *iso_list_topic(int i)
{
    return i >= 0 && i < TOPICS ? topics[i].name : NULL;
}

iso_status iso_list_print(iso_context *ctx, const char *topic, FILE *to)
{
    char suggested[ISO_SUGGEST_SIZE];
    int listed = 0;
    for (int i = 0; i < TOPICS; i++) {
        if (topic && strcmp(topic, topics[i].name) != 0) continue;
        fprintf(to, "%s%s: %s\n", listed++ ? "\n" : "", topics[i].name, topics[i].doc);
        topics[i].list(to);
    }
    if (listed) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "topic", "list: nothing is called '%s'; %s", topic,
                             iso_suggest_word(suggested, topic, iso_list_topic));
}

/* explain.c - tells what would be simulated, and why: explain by its name (study/study.h). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number_impl.h"
#include "base/resources_impl.h"
#include "exact/exact_impl.h"
#include "exact/integrability_impl.h"
#include "instrument/section/section_impl.h"
#include "orbit/orbit_impl.h"
#include "study/options_impl.h"
#include "study/study_impl.h"
#include "task/run.h"

enum { WHY = 512 }; /* room for a message */

/* What is found. */
typedef struct explanation {
    const char *backend, *method; /* method NULL: the closed solution */
    bool twin;
    const char *integrability;
    size_t rows;
    const char *text; /* that of the result */
} explanation;

/* --- the text --------------------------------------------------------------------------------------------------- */

static void explain_ball(FILE *to, const iso_params *p)
{
    static const char *const surfaces[] = {
        [ISO_REDUCED] = "given by k and J",          [ISO_PLANE] = "ball on a plane",
        [ISO_OUTSIDE] = "ball on a sphere",          [ISO_INSIDE] = "ball inside a sphere",
        [ISO_SHELL] = "hollow ball around a sphere",
    };
    const iso_body *b = &p->body;
    fprintf(to, "ball\n  %s\n", surfaces[b->surface]);
    if (b->surface != ISO_REDUCED)
        fprintf(to, "  m = %s, B = %s, I = %s %s %s; m B^2 = %.10g\n", ISO_SHORT(b->mass), ISO_SHORT(b->radius),
                ISO_SHORT(b->inertia[0]), ISO_SHORT(b->inertia[1]), ISO_SHORT(b->inertia[2]),
                b->mass * b->radius * b->radius);
    if (b->surface > ISO_PLANE) fprintf(to, "  on a fixed sphere of radius A = %s\n", ISO_SHORT(b->surface_radius));
    fprintf(to, "  ");
    iso_params_print(to, p);
    if (b->surface == ISO_REDUCED && p->D > 0) fprintf(to, "\n  D = m b^2 = %s", ISO_SHORT(p->D));
    fprintf(to, "\n\n");
}

/* The effects, with their numbers; which of them only observes from this start on: weight on a horizontal plane. */
static void explain_effects(FILE *to, const iso_orbit *orbit)
{
    const iso_effects effects = iso_orbit_effects(orbit);
    const iso_effect *idle = iso_effects_idle(&effects);
    iso_effects_print(to, &effects, true);
    if (idle)
        fprintf(to, "  '%s' has no torque here: it only observes, and the motion is that without it\n\n", idle->name);
}

/* Whether the ball has a twin, and in which potential that point moves. */
static void explain_map(FILE *to, const iso_params *p, const iso_orbit *orbit)
{
    const char *name = p->k == -1 ? ": Neumann's problem" : p->k == 1 ? ": Braden's problem" : "";
    const iso_effects effects = iso_orbit_effects(orbit);
    const iso_effect *breaking = iso_effects_breaking(&effects);
    const iso_effect *magnetic = iso_effects_magnetic(&iso_orbit_model(orbit)->problem);
    const bool pulled = iso_effects_off_chart(&effects);
    fprintf(to, "isomorphism\n");
    if (!breaking)
        fprintf(to, "  point on a sphere: V = -eps (gamma,J gamma)^(%.6g)%s%s%s%s%s\n", -1 / p->k,
                pulled ? " + U/G" : "", magnetic ? ", in the magnetic field of '" : "",
                magnetic ? magnetic->name : "", magnetic ? "'" : "", pulled || magnetic ? "" : name);
    if (iso_orbit_has_twin(orbit))
        fprintf(to, "  holds: (18) of the theory carries the states, the clocks t, tau, s the times%s\n",
                iso_effects_have_level(&effects) ? "; the point is off the level H = 0, at H = c det J/k^2" : "");
    else if (breaking)
        fprintf(to, "  does not hold: '%s' breaks it: %s\n", breaking->name, iso_effect_why_broken(breaking));
    else
        fprintf(to, "  does not hold: a ball at rest (h = 0) has no twin\n");
    fprintf(to, "\n");
}

/* Whether there is a second integral, of all motions of this ball. */
static iso_integrability integrability_of(const iso_scene *scene, const iso_orbit *orbit)
{
    const iso_effects effects = iso_orbit_effects(orbit);
    return iso_integrability_of(&scene->params, &effects, false); /* the level is an effect here */
}

/* What the closed solution is, or in `why` why `run --backend exact` cannot compute these columns: then *kind is NULL.
 * Errors: ISO_NO_MEMORY. */
static iso_status find_exact(iso_context *ctx, const iso_scene *scene, const int columns[], int count,
                             const char **kind, char why[WHY])
{
    static const char *const kinds[ISO_EXACT_KINDS] = {
        [ISO_EXACT_SEPARATED] = "two oscillations in sphero-conical coordinates",
        [ISO_EXACT_SYMMETRIC] = "two equal moments: a swing along the axis, a turning about it",
        [ISO_EXACT_PLANE] = "a motion in a principal plane",
        [ISO_EXACT_SEPARATRIX] = "on the separatrix, to the unstable rotation",
        [ISO_EXACT_REST] = "the point rests",
    };
    iso_orbit *orbit;
    iso_scene closed = *scene;
    closed.backend = ISO_BACKEND_EXACT;
    snprintf(closed.method, sizeof closed.method, "auto");
    *kind = NULL;
    const iso_status status = iso_scene_orbit(ctx, &closed, columns, count, &orbit);
    if (status == ISO_NO_MEMORY) return status;
    if (status != ISO_OK) return snprintf(why, WHY, "%s", iso_context_message(ctx)), ISO_OK;
    *kind = kinds[iso_exact_describe(iso_orbit_exact(orbit)).kind];
    iso_orbit_free(orbit);
    return ISO_OK;
}

/* What matters most: whether there is a twin, whether a closed solution, and what would compute the orbit. */
static void explain_verdict(FILE *to, const iso_scene *scene, const iso_orbit *orbit, bool closed)
{
    const iso_effects effects = iso_orbit_effects(orbit);
    const iso_effect *breaking = iso_effects_breaking(&effects);
    if (iso_orbit_has_twin(orbit))
        fprintf(to, "This orbit has a twin: one motion, as a ball that rolls and as a point on a sphere.\n");
    else
        fprintf(to, "This orbit has no twin: %s%s%s.\n", breaking ? "'" : "", breaking ? breaking->name : "",
                breaking ? "' breaks the isomorphism" : "a ball at rest (h = 0) has none");
    fprintf(to, closed ? "It has a closed solution.\n" : "No closed solution gives it.\n");
    fprintf(to, "`isoroll run` computes %zu rows, to %s = %s: backend %s, %s.\n\n", iso_scene_rows(scene),
            iso_clock_name(iso_orbit_model(orbit)->clock), ISO_SHORT(scene->end),
            iso_backend_name((int)iso_orbit_backend(orbit)),
            iso_orbit_exact(orbit) ? "which evaluates it" : iso_orbit_method(orbit)->name);
}

static const char *reason_of(const iso_model *m, int state)
{
    const char *reason;
    iso_model_state_name(m, state, &reason);
    if (state >= ISO_STATE) return reason;
    return state >= 3 ? "unit vector" : m->system == &iso_system_ball ? "angular velocity" : "momentum";
}

static void explain_states(FILE *to, const iso_scene *scene, const iso_orbit *orbit, const int columns[], int count)
{
    const iso_model *m = iso_orbit_model(orbit);
    fprintf(to, "%s: backend %s, %d states, in the clock %s\n", iso_orbit_exact(orbit) ? "evaluated" : "integrated",
            iso_backend_name((int)iso_orbit_backend(orbit)), m->dim, iso_clock_name(m->clock));
    fprintf(to, "  backend: %s\n", iso_scene_why_backend(scene, orbit));
    for (int i = 0, first = 0; i < m->dim; i++) { /* states with the same reason share a line */
        const char *reason = reason_of(m, i);
        if (i + 1 < m->dim && strcmp(reason, reason_of(m, i + 1)) == 0) continue;
        char names[128];
        int used = 0;
        for (const char *unused; first <= i; first++)
            used +=
                snprintf(names + used, sizeof names - (size_t)used, "%s ", iso_model_state_name(m, first, &unused));
        fprintf(to, "  %-22s %s\n", names, reason);
    }
    if (!iso_orbit_exact(orbit))
        fprintf(to, "  method %s (%s), tolerance %s\n", iso_orbit_method(orbit)->name, iso_orbit_method(orbit)->doc,
                ISO_SHORT(scene->tolerance));
    fprintf(to, "  own units: moment of inertia %g, time %g\n", iso_orbit_units(orbit)->J,
            1 / iso_orbit_units(orbit)->w);
    if (iso_orbit_has_twin(orbit))
        fprintf(to, "  energy of the ball h = %.10g\n  coupling of the point eps = %.10g\n", iso_orbit_energy(orbit),
                iso_orbit_coupling(orbit));
    fprintf(to, "written: %zu rows to %s = %s, columns", iso_scene_rows(scene), iso_clock_name(m->clock),
            ISO_SHORT(scene->end));
    for (int i = 0; i < count; i++) fprintf(to, " %s", iso_column_name(columns[i]));
    fprintf(to, "\n\n");
}

static void explain_integral(FILE *to, const char *whose, const iso_integral *i, const iso_problem *f, bool wanted)
{
    if (!i->claimed && (!i->holds || i->holds(f)) == wanted) fprintf(to, "  %-5s %-10s %s\n", whose, i->name, i->doc);
}

/* The integrals of both models. Without a twin: of the integrated model alone. */
static void explain_integrals(FILE *to, const iso_orbit *orbit)
{
    const iso_problem *f = &iso_orbit_model(orbit)->problem;
    const iso_system *only = iso_orbit_has_twin(orbit) ? NULL : iso_orbit_model(orbit)->system;
    for (int wanted = 1; wanted >= 0; wanted--) {
        fprintf(to, wanted ? "integrals that hold\n" : "integrals that do not hold here\n");
        for (int s = 0; iso_systems[s]; s++)
            for (const iso_integral *i = iso_systems[s]->integrals; i->name; i++)
                if (!only || iso_systems[s] == only) explain_integral(to, iso_systems[s]->name, i, f, wanted);
        for (int s = 0; iso_systems[s]; s++)
            for (int e = 0; e < ISO_EFFECTS && (!only || iso_systems[s] == only); e++)
                for (const iso_integral *i = iso_effect_integrals_of(iso_effect_list[e], iso_systems[s]);
                     i && i->name; i++)
                    if (f->effects.on[e]) explain_integral(to, iso_systems[s]->name, i, f, wanted);
    }
    const iso_integral *list[ISO_MAX_INTEGRALS];
    const int count = iso_integrals_holding(&iso_system_ball, f, list, ISO_MAX_INTEGRALS);
    int claims = 0;
    for (int i = 0; i < count; i++)
        if (list[i]->claimed)
            fprintf(to, "%s %s", claims++ ? "" : "integrals that the scene claims\n ", list[i]->name);
    if (claims > 0) fprintf(to, "   watched by check, compare, plot and view; nobody has proved them\n");
}

/* Seconds for one right-hand side: the least of several rounds. */
static double cost(const iso_model *m, const double y[])
{
    enum { CALLS = 20000, ROUNDS = 7 };
    double dy[ISO_MAX_STATE], x[ISO_MAX_STATE] = {0}, best = INFINITY;
    for (int i = 0; i < m->dim; i++) x[i] = y[i];
    for (int round = 0; round < ROUNDS; round++) {
        const double begin = processor_seconds();
        for (int i = 0; i < CALLS; i++) {
            m->rhs(m, x, dy);
            x[0] += 1e-18 * dy[0]; /* so each call must wait for the one before */
        }
        best = fmin(best, (processor_seconds() - begin) / CALLS);
    }
    return best;
}

static void explain_cost(FILE *to, const iso_model *m)
{
    static const bool none[ISO_CLOCKS] = {false};
    static const double somewhere[ISO_STATE] = {0.9,  -0.3, -0.225,
                                                0.36, 0.48, 0.8}; /* a valid state of either system */
    const iso_problem problem = {.p = m->problem.p};
    const iso_model free_ball = iso_model_assemble(&iso_system_ball, &problem, ISO_CLOCK_T, none);
    double y[ISO_MAX_STATE];
    iso_model_begin(m, somewhere, y);
    const double reference = cost(&free_ball, somewhere);
    fprintf(to, "\ncost of a right-hand side: %.2f times the free ball's in its own time (measured)\n",
            cost(m, y) / reference);
}

static iso_status explain(iso_context *ctx, FILE *to, const iso_scene *scene, const iso_orbit *orbit,
                          const int columns[], int count)
{
    char why[WHY] = "";
    const char *kind;
    const iso_integrability integrable = integrability_of(scene, orbit);
    ISO_TRY(find_exact(ctx, scene, columns, count, &kind, why));
    explain_verdict(to, scene, orbit, kind != NULL);
    explain_ball(to, &scene->params);
    explain_effects(to, orbit);
    explain_map(to, &scene->params, orbit);
    fprintf(to, "integrability\n  %s: %s\n\n", iso_integrability_name(integrable.kind), integrable.why);
    if (iso_orbit_has_twin(orbit) || iso_orbit_energy(orbit) != 0)
        fprintf(to, "section\n  %s\n\n", iso_section_of(orbit, ISO_AXIS_AUTO).words);
    fprintf(to, "closed solution (--backend exact)\n  %s%s\n\n", kind ? "any time at the same cost: " : "",
            kind ? kind : why);
    explain_states(to, scene, orbit, columns, count);
    explain_integrals(to, orbit);
    if (!iso_orbit_exact(orbit)) explain_cost(to, iso_orbit_model(orbit));
    return ISO_OK;
}

/* --- the study -------------------------------------------------------------------------------------------------- */

ISO_STUDY_BEGIN(iso_scene_request, (iso_scene_request){.change = ISO_SCENE_AS_IT_IS})

/* What is said in words, and what of it other programs ask for. */
static const iso_field fields[] = {
    ISO_MEMBER(explanation, "backend", backend, "", "that would compute the orbit"),
    ISO_MEMBER(explanation, "method", method, "", "of integration; none: the closed solution"),
    ISO_MEMBER(explanation, "twin", twin, "", "whether the orbit has both models"),
    ISO_MEMBER(explanation, "integrability", integrability, "",
               "integrable, no meromorphic integral (a theorem of ours), or open"),
    ISO_MEMBER(explanation, "rows", rows, "", "that would be written"),
    {.name = "text",
     .type = ISO_FIELD_NAME,
     .offset = offsetof(explanation, text),
     .unit = "",
     .doc = "all, in words"},
    ISO_FIELD_END,
};

static iso_status run(iso_context *ctx, const iso_study_subject *subject, const void *options,
                      iso_study_result *result)
{
    iso_scene scene = *subject->scene;
    iso_orbit *orbit;
    int columns[ISO_MAX_COLUMNS];
    iso_memory memory;
    explanation *e = iso_study_keep(result, calloc(1, sizeof *e), fields, free);
    if (!e) return iso_context_no_memory(ctx, "words");
    ISO_TRY(iso_scene_apply(ctx, &((const iso_scene_request *)options)->change, &scene));
    const int count = iso_scene_column_list(&scene, columns);
    ISO_TRY(iso_scene_orbit(ctx, &scene, columns, count, &orbit));
    *e = (explanation){.backend = iso_backend_name((int)iso_orbit_backend(orbit)),
                       .method = iso_orbit_exact(orbit) ? NULL : iso_orbit_method(orbit)->name,
                       .twin = iso_orbit_has_twin(orbit),
                       .integrability = iso_integrability_name(integrability_of(&scene, orbit).kind),
                       .rows = iso_scene_rows(&scene)};
    FILE *to = iso_memory_open(&memory);
    iso_status status = to ? explain(ctx, to, &scene, orbit, columns, count) : ISO_OK;
    e->text = result->text = iso_memory_close(to, &memory);
    iso_orbit_free(orbit);
    if (!e->text) return iso_context_no_memory(ctx, "words");
    return status == ISO_OK ? iso_study_table(ctx, "explain", &scene, fields, e, NULL, &result->table[0]) : status;
}

const iso_study iso_explain_study = {ISO_STUDY_AS("explain", iso_scene_request, iso_scene_change_option,
                                                  "say what would be simulated and why, without doing it"),
                                     .run = run, .of = ISO_STUDY_OF_SCENE, .fields = fields};

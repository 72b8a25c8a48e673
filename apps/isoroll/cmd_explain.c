/* isoroll explain - tells what would be simulated, and why. */
#include <math.h>
#include <string.h>

#include "base/seconds_impl.h"
#include "exact/exact_impl.h"
#include "scene_options.h"
#include "study/section/section_impl.h"
#include "sweep_team.h"

typedef struct options {
    scene_options scene;
} options;

static void explain_ball(const iso_params *p)
{
    static const char *const surfaces[] = {
        [ISO_REDUCED] = "given by k and J",          [ISO_PLANE] = "ball on a plane",
        [ISO_OUTSIDE] = "ball on a sphere",          [ISO_INSIDE] = "ball inside a sphere",
        [ISO_SHELL] = "hollow ball around a sphere",
    };
    const iso_body *b = &p->body;
    printf("ball\n  %s\n", surfaces[b->surface]);
    if (b->surface != ISO_REDUCED)
        printf("  m = %g, B = %g, I = %g %g %g; m B^2 = %g\n", b->mass, b->radius, b->inertia[0], b->inertia[1],
               b->inertia[2], b->mass * b->radius * b->radius);
    if (b->surface > ISO_PLANE) printf("  on a fixed sphere of radius A = %g\n", b->surface_radius);
    printf("  k = %.17g, J = %.17g %.17g %.17g\n", p->k, p->J[0], p->J[1], p->J[2]);
    if (b->surface == ISO_REDUCED && p->D > 0) printf("  D = m b^2 = %.17g\n", p->D);
    printf("\n");
}

/* The effects, with their numbers; which of them only observes from this start on: weight on a horizontal plane. */
static void explain_effects(const iso_orbit *orbit)
{
    const iso_effects effects = iso_orbit_effects(orbit);
    const iso_effect *idle = iso_effects_idle(&effects);
    print_effects(&effects, true);
    if (idle)
        printf("  '%s' has no torque here: it only observes, and the motion is that without it\n\n", idle->name);
}

/* Whether the ball has a twin, and in which potential that point moves. */
static void explain_map(const iso_params *p, const iso_orbit *orbit)
{
    const bool symmetric = iso_params_symmetric(p, 0) || iso_params_symmetric(p, 1) || iso_params_symmetric(p, 2);
    const char *kind = p->k == -1  ? "Neumann's problem: integrable"
                       : p->k == 1 ? "Braden's problem: integrable"
                       : symmetric ? "integrable, since two moments are equal"
                                   : "no additional integral is known";
    const iso_effects effects = iso_orbit_effects(orbit);
    const iso_effect *breaking = iso_effects_breaking(&effects);
    const bool pulled = iso_effects_have_image(&effects);
    printf("isomorphism\n");
    if (!breaking)
        printf("  point on a sphere: V = -eps (gamma,J gamma)^(%.6g)%s, %s\n", -1 / p->k, pulled ? " + U/G" : "",
               pulled ? "in a field: see the integrals below" : kind);
    if (iso_orbit_has_twin(orbit))
        printf("  holds: this orbit has both models, (18) and the clocks t, tau, s%s\n",
               iso_effects_have_level(&effects) ? "; the point is off the level H = 0, at H = c det J/k^2" : "");
    else if (breaking)
        printf("  does not hold: '%s' breaks it: %s\n", breaking->name, iso_effect_why_broken(breaking));
    else
        printf("  does not hold: a ball at rest (h = 0) has no twin\n");
    printf("\n");
}

/* Says which Poincare section (`isoroll section`) is global for this orbit. */
static void explain_section(const iso_orbit *orbit)
{
    const iso_section_nature n = iso_section_of(orbit, ISO_AXIS_AUTO);
    if (iso_orbit_has_twin(orbit) || iso_orbit_energy(orbit) != 0) printf("section\n  %s\n\n", n.words);
}

/* Whether `run --backend exact` can compute these columns, and if not, why. Errors: ISO_NO_MEMORY. */
static iso_status explain_exact(iso_context *ctx, const iso_scene *scene, const int columns[], int count)
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
    printf("closed solution (--backend exact)\n");
    const iso_status status = iso_scene_orbit(ctx, &closed, columns, count, &orbit);
    if (status == ISO_NO_MEMORY) return status;
    if (status != ISO_OK) return printf("  %s\n\n", iso_context_message(ctx)), ISO_OK;
    printf("  any time at the same cost: %s\n\n", kinds[iso_exact_describe(iso_orbit_exact(orbit)).kind]);
    iso_orbit_free(orbit);
    return ISO_OK;
}

static const char *reason_of(const iso_model *m, int state)
{
    const char *reason;
    iso_model_state_name(m, state, &reason);
    if (state >= ISO_STATE) return reason;
    return state >= 3 ? "unit vector" : m->system == &iso_system_ball ? "angular velocity" : "momentum";
}

static void explain_states(const iso_scene *scene, const iso_orbit *orbit, const int columns[], int count)
{
    const iso_model *m = iso_orbit_model(orbit);
    printf("%s: backend %s, %d states, in the clock %s\n", iso_orbit_exact(orbit) ? "evaluated" : "integrated",
           iso_backend_name((int)iso_orbit_backend(orbit)), m->dim, iso_clock_name(m->clock));
    printf("  backend: %s\n", iso_scene_why_backend(scene, orbit));
    for (int i = 0, first = 0; i < m->dim; i++) { /* states with the same reason share a line */
        const char *reason = reason_of(m, i);
        if (i + 1 < m->dim && strcmp(reason, reason_of(m, i + 1)) == 0) continue;
        char names[128];
        int used = 0;
        for (const char *unused; first <= i; first++)
            used +=
                snprintf(names + used, sizeof names - (size_t)used, "%s ", iso_model_state_name(m, first, &unused));
        printf("  %-22s %s\n", names, reason);
    }
    if (!iso_orbit_exact(orbit))
        printf("  method %s (%s), tolerance %g\n", iso_orbit_method(orbit)->name, iso_orbit_method(orbit)->doc,
               scene->tolerance);
    printf("  own units: moment of inertia %g, time %g\n", iso_orbit_units(orbit)->J, 1 / iso_orbit_units(orbit)->w);
    if (iso_orbit_has_twin(orbit))
        printf("  energy of the ball h = %.10g\n  coupling of the point eps = %.10g\n", iso_orbit_energy(orbit),
               iso_orbit_coupling(orbit));
    printf("written: %zu rows to %s = %g, columns", iso_scene_rows(scene), iso_clock_name(m->clock), scene->end);
    for (int i = 0; i < count; i++) printf(" %s", iso_column_name(columns[i]));
    printf("\n\n");
}

static void explain_integral(const char *whose, const iso_integral *i, const iso_problem *f, bool wanted)
{
    if ((!i->holds || i->holds(f)) == wanted) printf("  %-5s %-10s %s\n", whose, i->name, i->doc);
}

/* The integrals of both models. Without a twin: of the integrated model alone. */
static void explain_integrals(const iso_orbit *orbit)
{
    const iso_problem *f = &iso_orbit_model(orbit)->problem;
    const iso_system *only = iso_orbit_has_twin(orbit) ? NULL : iso_orbit_model(orbit)->system;
    for (int wanted = 1; wanted >= 0; wanted--) {
        printf(wanted ? "integrals that hold\n" : "integrals that do not hold here\n");
        for (int s = 0; iso_systems[s]; s++)
            for (const iso_integral *i = iso_systems[s]->integrals; i->name; i++)
                if (!only || iso_systems[s] == only) explain_integral(iso_systems[s]->name, i, f, wanted);
        for (int e = 0; e < ISO_EFFECTS; e++)
            for (const iso_integral *i = iso_effect_list[e]->integrals; f->effects.on[e] && i && i->name; i++)
                explain_integral("ball", i, f, wanted);
    }
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

static iso_status explain_cost(iso_context *ctx, const iso_model *m)
{
    static const bool none[ISO_CLOCKS] = {false};
    iso_problem problem = {.p = m->problem.p};
    double six[ISO_STATE], y[ISO_MAX_STATE];
    iso_random *random = iso_random_create(1);
    if (!random) return iso_context_no_memory(ctx, "a sample");
    iso_system_ball.sample(&problem, random, six);
    const iso_model free_ball = iso_model_assemble(&iso_system_ball, &problem, ISO_CLOCK_T, none);
    const double reference = cost(&free_ball, six);
    m->system->sample(&problem, random, six);
    iso_random_free(random);
    iso_model_begin(m, six, y);
    printf("\ncost of a right-hand side: %.2f times the free ball's in its own time (measured)\n",
           cost(m, y) / reference);
    return ISO_OK;
}

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    iso_scene scene = {.places = 0};
    iso_orbit *orbit;
    int columns[ISO_MAX_COLUMNS], count;
    if (file_kind(o->scene.file, (char[ISO_KIND_SIZE]){0}) == FILE_SWEEP) return explain_sweep(ctx, o->scene.file);
    iso_status status = scene_with_options(ctx, &o->scene, &scene);
    if (status != ISO_OK) return finish(ctx, status);
    count = iso_scene_columns(&scene, columns);
    status = iso_scene_orbit(ctx, &scene, columns, count, &orbit);
    if (status != ISO_OK) return finish_scene(ctx, &o->scene, &scene, status);
    explain_ball(&scene.params);
    explain_effects(orbit);
    explain_map(&scene.params, orbit);
    explain_section(orbit);
    status = explain_exact(ctx, &scene, columns, count);
    if (status == ISO_OK) {
        explain_states(&scene, orbit, columns, count);
        explain_integrals(orbit);
        if (!iso_orbit_exact(orbit)) status = explain_cost(ctx, iso_orbit_model(orbit));
    }
    iso_orbit_free(orbit);
    return finish(ctx, status);
}

static const options defaults = {.scene = SCENE_OPTIONS_UNSET};

static const option_row rows[] = {
    ROWS_OF_SCENE(options, scene),
    ROW_END,
};

const command command_explain = {
    COMMAND("explain", "SCENE", "say what would be simulated and why, without doing it", scene.file),
    .takes = FILE_SCENE | FILE_SWEEP,
    .description =
        "Tells the ball's parameters, the effects that act, whether the orbit has a twin, which Poincare section is "
        "global, whether there is a closed solution, the backend and the method, which integrals hold, and the "
        "measured cost of one right-hand side.\n\n"
        "Of a sweep: how many points it has, its columns, what its quantities cost, and how long it takes here. For "
        "this a few of its points are computed.",
    .example = "isoroll explain scene.yaml",
};

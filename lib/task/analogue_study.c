/* analogue_study.c - analogue by its name: a problem in options or in a scene, and the ball as the text of a scene,
 * with a report in # lines (study/study.h). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "io/scene_print_impl.h"
#include "orbit/orbit_impl.h"
#include "study/options_impl.h"
#include "task/task_impl.h"

/* --- the report ------------------------------------------------------------------------------------------------- */

static void print_problem(FILE *to, const iso_analogue *a)
{
    const iso_analogue_problem *p = &a->problem;
    const double *x = p->neumann ? p->c : p->J;
    fprintf(to, "# a ball that realises a point on a sphere\n# point: V = ");
    if (p->neumann)
        fprintf(to, "(1/2) sum c_i gamma_i^2, c = %.10g %.10g %.10g\n", x[0], x[1], x[2]);
    else
        fprintf(to, "-eps (gamma, J gamma)^(-1/k), k = %.10g, J = %.10g %.10g %.10g, eps = %.10g\n", p->k, x[0], x[1],
                x[2], p->eps);
    fprintf(to, "#   energy M^2/2 + V = %.10g; V is between %.10g and %.10g\n", p->energy, a->lowest, a->highest);
    const bool free = a->reduced.level == 0, shifted = p->neumann || p->eps < 0;
    fprintf(to, "# ball: %s", free ? "free" : "in the potential U = -c (n, J^-1 n)^(-1/k)");
    if (a->choice == ISO_ANALOGUE_STATED) fprintf(to, free ? ", since the energy is 0\n" : "; c = E k^2/det J\n");
    if (a->choice == ISO_ANALOGUE_FREE)
        fprintf(to, ": on the sphere V = E - eps (gamma, J gamma) with the ball's J = %s\n",
                shifted ? "2 E - c, eps = 1/2" : "J + E/eps");
    if (a->choice == ISO_ANALOGUE_SHIFTED)
        fprintf(to,
                ": V = d/2 - eps (gamma, J gamma), d = %.10g, and c = (E - d/2) k^2/det J;\n"
                "#   any d with a positive J would do; this one makes max J/min J = 3/2\n",
                2 * a->shift);
    if (a->choice == ISO_ANALOGUE_CONSTANT)
        fprintf(to, ": V is constant: the point turns uniformly, and so does any ball of equal moments\n");
    if (*a->not_free) fprintf(to, "#   %s\n", a->not_free);
}

/* With a body: which other bodies there are. Without: why there is none, and which option gives one. */
static void print_ball(FILE *to, const iso_analogue *a)
{
    const iso_analogue_ball *r = &a->reduced;
    const iso_body *b = &a->body.params.body;
    const double *J = r->params.J;
    fprintf(to, "# reduced: k = %s, J = %s %s %s\n#   eps = %s, h = eps k^2/det J = %s", ISO_SHORT(r->params.k),
            ISO_SHORT(J[0]), ISO_SHORT(J[1]), ISO_SHORT(J[2]), ISO_SHORT(r->eps), ISO_SHORT(r->h));
    if (r->level != 0) fprintf(to, ", c = %s", ISO_SHORT(r->level));
    if (r->h < 0) fprintf(to, "\n#   eps and h are negative: the ball moves by the potential of the level alone");
    fprintf(to, "\n");
    if (!a->has_body) {
        fprintf(to, "# no body:\n#   %s\n", a->no_body);
        if (r->params.k == -1 && a->choice != ISO_ANALOGUE_SHIFTED && !(a->room > 0))
            fprintf(to, "#   --level gives one that has a body, in the potential of a level\n");
        return;
    }
    fprintf(to, "# body: %s, m = %.10g, B = %.10g", iso_surface_name((int)b->surface), b->mass, b->radius);
    if (b->surface != ISO_PLANE) fprintf(to, ", A = %.10g", b->surface_radius);
    fprintf(to, "; J times %.10g, which with eps times %.10g leaves V as it is;\n", a->scale, a->body.eps / r->eps);
    fprintf(to, "#   the triangle inequalities allow m B^2 = D times that for D in (0, J1 + J2 - J3] = (0, %.10g]\n",
            a->room);
}

/* --- the problem ------------------------------------------------------------------------------------------------ */

static void begin(void *options)
{
    iso_analogue_request *r = options;
    *r = (iso_analogue_request){{.c = {NAN}, .k = NAN, .J = {NAN}, .eps = NAN, .energy = NAN}, NAN, NAN};
}

bool iso_analogue_is_stated(const iso_analogue_request *r)
{
    return !isnan(r->problem.c[0]) || !isnan(r->problem.k);
}

/* Options that state half a problem, or two. */
static iso_status prepare(iso_context *ctx, void *options)
{
    const iso_analogue_problem *p = &((const iso_analogue_request *)options)->problem;
    const bool neumann = !isnan(p->c[0]), k = !isnan(p->k), J = !isnan(p->J[0]), eps = !isnan(p->eps);
    if (neumann && (k || J || eps))
        return ISO_FAIL_ARGUMENT(ctx, "neumann",
                                 "analogue: --neumann has k = -1 and needs no --k, --J or --eps: leave them out");
    if (!neumann && (k || J || eps) && !(k && J && eps)) {
        const char *missing = !k ? "k" : !J ? "J" : "eps";
        return ISO_FAIL_ARGUMENT(ctx, missing,
                                 "analogue: --%s is missing: a problem is --k, --J and --eps, or --neumann", missing);
    }
    if (!neumann && !k && !isnan(p->energy))
        return ISO_FAIL_ARGUMENT(ctx, "energy",
                                 "analogue: --energy needs --neumann or --k, --J and --eps; a scene's start has its "
                                 "own");
    return ISO_OK;
}

/* The problem of a point's start: its eps, its energy, and the start on that energy to the last digit. Asks an orbit for
 * the coupling and the level: the scene may not state them. */
static iso_status problem_of(iso_context *ctx, const iso_scene *scene, iso_analogue_problem *problem,
                             double point[ISO_STATE])
{
    iso_orbit *orbit;
    iso_sample sample;
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    iso_effects effects = iso_scene_acting(scene);
    if (scene->start.model != ISO_POINT)
        return ISO_FAIL_INPUT(ctx, "", "this scene is a ball already: an analogue is of a 'point'");
    const iso_effect *more = iso_effects_beyond_level(&effects); /* changes the potential, or there is no twin */
    if (more)
        return iso_context_fail(ctx, ISO_NOT_MAPPED, more->name,
                                "'%s' is more than V = -eps (gamma, J gamma)^(-1/k): take it out", more->name);
    o.effects = &effects;
    ISO_TRY(iso_orbit_create(ctx, &scene->params, &scene->start, &o, &orbit));
    iso_status status = iso_orbit_at(orbit, 0, &sample);
    if (status == ISO_OK) {
        effects = iso_orbit_effects(orbit);
        *problem = (iso_analogue_problem){.k = scene->params.k, .eps = iso_orbit_coupling(orbit)};
        copy(scene->params.J, problem->J, 3);
        const double c = iso_effects_level(&effects);
        problem->energy = iso_effects_have_level(&effects) ? iso_coupling(&scene->params, c) : 0;
        copy(sample.point, point, ISO_STATE);
    }
    iso_orbit_free(orbit);
    return status;
}

/* The problem of the scene, or, NULL, of the options; and the start and end, in s, of its point. */
static iso_status state(iso_context *ctx, const iso_scene *scene, const iso_analogue_request *r, iso_analogue *a,
                        double point[ISO_STATE], double *end)
{
    const bool stated = iso_analogue_is_stated(r);
    iso_analogue_problem p = r->problem;
    if (stated == (scene != NULL))
        return ISO_FAIL_ARGUMENT(ctx, "scene",
                                 stated ? "analogue: a scene and a problem in options: leave one of them out"
                                        : "analogue needs a scene, or a problem in options");
    p.neumann = !isnan(p.c[0]);
    if (isnan(p.energy)) p.energy = 0;
    if (scene) ISO_TRY(problem_of(ctx, scene, &p, point));
    p.level = r->problem.level;
    ISO_TRY(iso_analogue_find(ctx, &p, r->mass, r->radius, a));
    *end = scene ? scene->end : 2 * iso_analogue_start(a, point); /* about twenty turns */
    return ISO_OK;
}

/* --- the study -------------------------------------------------------------------------------------------------- */

/* of: the scene of the point; NULL: options state the problem. */
static void report(FILE *to, const iso_analogue *a, const iso_scene *of, const iso_scene *scene)
{
    print_problem(to, a);
    print_ball(to, a);
    fprintf(to, "# start: %s; the twin's gamma and M are the point's, in its clock s\n",
            of ? "the scene's" : "one that has this energy");
    if (of)
        fprintf(to, "# end: where s = %.10g\n", of->end);
    else
        fprintf(to, "# end: a round time t, 20 turns or more\n");
    iso_scene_print(scene, to);
}

static const iso_field fields[] = {
    ISO_MEMBER(iso_analogue_found, "body", analogue.has_body, "", "whether the ball has mass and radius"),
    ISO_MEMBER(iso_analogue_found, "eps", ball.eps, "", "coupling of its twin"),
    ISO_MEMBER(iso_analogue_found, "h", ball.h, "energy", "of the ball, without that of the level's potential"),
    ISO_MEMBER(iso_analogue_found, "level", ball.level, "", "c of the effect level; 0: the ball is free"),
    {.name = "text",
     .type = ISO_FIELD_NAME,
     .offset = offsetof(iso_analogue_found, text),
     .unit = "",
     .doc = "the scene of the ball, with a report in # lines"},
    ISO_FIELD_END,
};

static iso_status run(iso_context *ctx, const iso_study_subject *subject, const void *options,
                      iso_study_result *result)
{
    const iso_scene *of = subject->scene;
    double point[ISO_STATE], end = 0;
    iso_memory memory;
    iso_scene scene;
    iso_analogue_found *f = iso_study_keep(result, calloc(1, sizeof *f), fields, free);
    if (!f) return iso_context_no_memory(ctx, "a ball");
    ISO_TRY(state(ctx, of, options, &f->analogue, point, &end));
    f->ball = f->analogue.has_body ? f->analogue.body : f->analogue.reduced;
    ISO_TRY(iso_analogue_scene(ctx, &f->ball, point, end, &scene));
    if (!of) scene.end = iso_analogue_round_up(scene.end);
    if (of && of->step > 0 && end != 0) scene.step = fabs(scene.end) / (fabs(end) / of->step);
    FILE *to = iso_memory_open(&memory);
    if (to) report(to, &f->analogue, of, &scene);
    f->text = result->text = iso_memory_close(to, &memory);
    if (!f->text) return iso_context_no_memory(ctx, "words");
    return iso_study_table(ctx, "analogue", &scene, fields, f, NULL, &result->table[0]);
}

#define ROW(name, argument, expected, doc, set, member)                                                              \
    ISO_OPTION(name, argument, expected, doc, set, iso_analogue_request, member)

const iso_option iso_analogue_option[] = {
    ROW("neumann", "C", "three numbers C1,C2,C3", "C1,C2,C3 of Neumann's problem V = (1/2) sum C_i gamma_i^2",
        iso_set_vector, problem.c),
    ROW("k", "K", "a number", "k of the problem V = -eps (gamma, J gamma)^(-1/k)", iso_set_number, problem.k),
    ROW("J", "J1,J2,J3", "three numbers J1,J2,J3", "J of this problem", iso_set_vector, problem.J),
    ROW("eps", "X", "a number", "eps of this problem", iso_set_number, problem.eps),
    ROW("energy", "E", "a number", "energy of the point, M^2/2 + V (default 0)", iso_set_number, problem.energy),
    ROW("level", NULL, NULL, "k = -1: a ball in the potential of a level, even where there is a free one",
        iso_set_flag, problem.level),
    ROW("mass", "M", "a positive number", "mass of the ball (default: chosen)", iso_set_positive, mass),
    ROW("radius", "B", "a positive number", "radius of the ball (default: chosen)", iso_set_positive, radius),
    ISO_OPTION_END,
};

const iso_study iso_analogue_study = {ISO_STUDY_AS("analogue", iso_analogue_request, iso_analogue_option,
                                                   "find a ball that realises a problem of a point on a sphere"),
                                      .prepare = prepare, .run = run, .of = ISO_STUDY_USES_SCENE, .fields = fields};

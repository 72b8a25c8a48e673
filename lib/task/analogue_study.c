/* analogue_study.c - analogue by its name: a problem in options or in a scene, and the ball as the text of a scene,
 * with a report in # lines (study/study.h). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number_impl.h"
#include "orbit/orbit_impl.h"
#include "study/options_impl.h"
#include "task/task_impl.h"

/* --- numbers ---------------------------------------------------------------------------------------------------- */

static void print_number(FILE *to, const char *before, double x)
{
    fprintf(to, "%s%s", before, ISO_SHORT(x + 0.0)); /* no -0 */
}

static void print_vector(FILE *to, const char *before, const double x[3])
{
    fprintf(to, "%s", before);
    for (int i = 0; i < 3; i++) print_number(to, i == 0 ? "[" : ", ", x[i]);
    fprintf(to, "]");
}

/* --- the report ------------------------------------------------------------------------------------------------- */

static void print_problem(FILE *to, const iso_analogue *a)
{
    const iso_analogue_problem *p = &a->problem;
    fprintf(to, "# a ball that realises a point on a sphere\n# point: ");
    if (p->neumann)
        fprintf(to, "V = (1/2) sum c_i gamma_i^2, c = %.10g %.10g %.10g\n", p->c[0], p->c[1], p->c[2]);
    else
        fprintf(to, "V = -eps (gamma, J gamma)^(-1/k), k = %.10g, J = %.10g %.10g %.10g, eps = %.10g\n", p->k,
                p->J[0], p->J[1], p->J[2], p->eps);
    fprintf(to, "#   energy M^2/2 + V = %.10g; V is between %.10g and %.10g\n", p->energy, a->lowest, a->highest);
}

static void print_way(FILE *to, const iso_analogue *a)
{
    const iso_analogue_problem *p = &a->problem;
    const iso_analogue_ball *b = &a->reduced;
    const char *shift = p->neumann || p->eps < 0 ? "2 E - c, eps = 1/2" : "J + E/eps";
    fprintf(to, "# ball: %s", b->level == 0 ? "free" : "in the potential U = -c (n, J^-1 n)^(-1/k)");
    switch (a->way) {
    case ISO_ANALOGUE_STATED: fprintf(to, b->level == 0 ? ", since the energy is 0\n" : "; c = E k^2/det J\n"); break;
    case ISO_ANALOGUE_FREE:
        fprintf(to, ": on the sphere V = E - eps (gamma, J gamma) with the ball's J = %s\n", shift);
        break;
    case ISO_ANALOGUE_SHIFTED:
        fprintf(to,
                ": V = d/2 - eps (gamma, J gamma), d = %.10g, and c = (E - d/2) k^2/det J;\n"
                "#   any d with a positive J would do; this one makes max J/min J = 3/2\n",
                2 * a->shift);
        break;
    case ISO_ANALOGUE_CONSTANT:
        fprintf(to, ": V is constant: the point turns uniformly, and so does any ball of equal moments\n");
        break;
    }
    if (*a->not_free) fprintf(to, "#   %s\n", a->not_free);
}

static void print_reduced(FILE *to, const iso_analogue *a)
{
    const iso_analogue_ball *b = &a->reduced;
    const double *J = b->params.J;
    fprintf(to, "# reduced: k = %s, J = %s %s %s\n#   eps = %s, h = eps k^2/det J = %s", ISO_SHORT(b->params.k),
            ISO_SHORT(J[0]), ISO_SHORT(J[1]), ISO_SHORT(J[2]), ISO_SHORT(b->eps), ISO_SHORT(b->h));
    if (b->level != 0) fprintf(to, ", c = %s", ISO_SHORT(b->level));
    if (b->h < 0) fprintf(to, "\n#   eps and h are negative: the ball moves by the potential of the level alone");
    fprintf(to, "\n");
}

/* With a body: which other bodies there are. Without: why there is none, and which option gives one. */
static void print_body(FILE *to, const iso_analogue *a)
{
    const iso_body *b = &a->body.params.body;
    if (!a->has_body) {
        fprintf(to, "# no body:\n#   %s\n", a->no_body);
        if (a->reduced.params.k == -1 && a->way != ISO_ANALOGUE_SHIFTED && !(a->room > 0))
            fprintf(to, "#   --level gives one that has a body, in the potential of a level\n");
        return;
    }
    fprintf(to, "# body: %s, m = %.10g, B = %.10g", iso_surface_name((int)b->surface), b->mass, b->radius);
    if (b->surface != ISO_PLANE) fprintf(to, ", A = %.10g", b->surface_radius);
    fprintf(to, "; J times %.10g, which with eps times %.10g leaves V as it is;\n", a->scale,
            a->body.eps / a->reduced.eps);
    fprintf(to, "#   the triangle inequalities allow m B^2 = D times that for D in (0, J1 + J2 - J3] = (0, %.10g]\n",
            a->room);
}

/* --- the scene -------------------------------------------------------------------------------------------------- */

static void print_ball(FILE *to, const iso_params *p)
{
    const iso_body *b = &p->body;
    if (b->surface == ISO_REDUCED) {
        print_number(to, "reduced: {k: ", p->k);
        print_vector(to, ", J: ", p->J);
    } else {
        print_number(to, "ball:    {mass: ", b->mass);
        print_number(to, ", radius: ", b->radius);
        print_vector(to, ", inertia: ", b->inertia);
        fprintf(to, "}\nsurface: {kind: %s", iso_surface_name((int)b->surface));
        if (b->surface != ISO_PLANE) print_number(to, ", radius: ", b->surface_radius);
    }
    fprintf(to, "}\n");
}

static void print_scene(FILE *to, const iso_scene *s)
{
    print_ball(to, &s->params);
    print_vector(to, "initial:\n  normal: ", s->start.y + 3);
    print_vector(to, "\n  angular_velocity: ", s->start.y);
    print_number(to, "\ntime:    {end: ", s->end);
    if (s->step > 0) print_number(to, ", step: ", s->step);
    fprintf(to, "}\n");
    if (!iso_effects_have_level(&s->effects)) return;
    fprintf(to, "effects: {%s: ", iso_level_name());
    print_number(to, "{c: ", iso_effects_level(&s->effects));
    fprintf(to, "}}\n");
}

/* --- the problem ------------------------------------------------------------------------------------------------ */

static void begin(void *options)
{
    *(iso_analogue_request *)options = (iso_analogue_request){.k = NAN,
                                                              .J = {NAN, NAN, NAN},
                                                              .eps = NAN,
                                                              .neumann = {NAN, NAN, NAN},
                                                              .energy = NAN,
                                                              .mass = NAN,
                                                              .radius = NAN};
}

bool iso_analogue_is_stated(const iso_analogue_request *r)
{
    return !isnan(r->neumann[0]) || !isnan(r->k);
}

/* Options that state half a problem, or two. */
static iso_status prepare(iso_context *ctx, void *options)
{
    const iso_analogue_request *r = options;
    const bool neumann = !isnan(r->neumann[0]), k = !isnan(r->k), J = !isnan(r->J[0]), eps = !isnan(r->eps);
    if (neumann && (k || J || eps))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "neumann",
                                "analogue: --neumann has k = -1 and needs no --k, --J or --eps: leave them out");
    if (!neumann && (k || J || eps) && !(k && J && eps)) {
        const char *missing = !k ? "k" : !J ? "J" : "eps";
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, missing,
                                "analogue: --%s is missing: a problem is --k, --J and --eps, or --neumann", missing);
    }
    if (!neumann && !k && !isnan(r->energy))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "energy",
                                "analogue: --energy needs --neumann or --k, --J and --eps; a scene's start has its "
                                "own");
    return ISO_OK;
}

/* The problem, and the start of its point. */
typedef struct task {
    iso_analogue_problem problem;
    bool started;                       /* a scene gives the start */
    double point[ISO_STATE], end, rows; /* end: in s; rows: those of a scene, 0 is the usual hundred */
} task;

static iso_status state(iso_context *ctx, const iso_scene *scene, const iso_analogue_request *r, task *t)
{
    const bool stated = iso_analogue_is_stated(r);
    iso_analogue_problem *p = &t->problem;
    *t = (task){.started = !stated};
    if (stated == (scene != NULL))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "scene",
                                stated ? "analogue: a scene and a problem in options: leave one of them out"
                                       : "analogue needs a scene, or a problem in options");
    if (scene) {
        t->end = scene->end;
        t->rows = scene->step > 0 ? fabs(scene->end) / scene->step : 0;
        ISO_TRY(iso_analogue_problem_of(ctx, scene, p, t->point));
    } else {
        *p = (iso_analogue_problem){.neumann = !isnan(r->neumann[0]), .k = r->k, .eps = r->eps};
        memcpy(p->J, r->J, sizeof p->J);
        memcpy(p->c, r->neumann, sizeof p->c);
        p->energy = isnan(r->energy) ? 0 : r->energy;
    }
    p->level = r->level;
    return ISO_OK;
}

/* --- the study -------------------------------------------------------------------------------------------------- */

static void report(FILE *to, const iso_analogue *a, const task *t, const iso_scene *scene)
{
    print_problem(to, a);
    print_way(to, a);
    print_reduced(to, a);
    print_body(to, a);
    fprintf(to, "# start: %s; the twin's gamma and M are the point's, in its clock s\n",
            t->started ? "the scene's" : "one that has this energy");
    if (t->started)
        fprintf(to, "# end: where s = %.10g\n", t->end);
    else
        fprintf(to, "# end: a round time t, 20 turns or more\n");
    print_scene(to, scene);
}

static iso_status answer(iso_context *ctx, const iso_analogue_request *r, task *t, iso_analogue *a, iso_scene *scene)
{
    ISO_TRY(iso_analogue_find(ctx, &t->problem, r->mass, r->radius, a));
    if (!t->started) t->end = 2 * iso_analogue_start(a, t->point); /* about twenty turns */
    ISO_TRY(iso_analogue_scene(ctx, a->has_body ? &a->body : &a->reduced, t->point, t->end, scene));
    if (!t->started) scene->end = iso_analogue_round_up(scene->end);
    if (t->rows > 0 && scene->end != 0) scene->step = fabs(scene->end) / t->rows;
    return ISO_OK;
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

static void free_found(void *found)
{
    free((char *)((iso_analogue_found *)found)->text);
    free(found);
}

static iso_status run(iso_context *ctx, const iso_study_subject *subject, const void *options,
                      iso_study_result *result)
{
    task t;
    char *text = NULL;
    size_t size;
    iso_scene scene;
    iso_analogue_found *f = iso_study_keep(result, calloc(1, sizeof *f), fields, free_found);
    if (!f) return iso_context_no_memory(ctx, "a ball");
    ISO_TRY(state(ctx, subject->scene, options, &t));
    ISO_TRY(answer(ctx, options, &t, &f->analogue, &scene));
    f->ball = f->analogue.has_body ? f->analogue.body : f->analogue.reduced;
    FILE *to = open_memstream(&text, &size);
    if (to) report(to, &f->analogue, &t, &scene);
    if (!to || fclose(to) != 0) return free(text), iso_context_no_memory(ctx, "words");
    f->text = text;
    return iso_study_table(ctx, "analogue", &scene, fields, f, NULL, &result->table[0]);
}

#define ROW(name, argument, expected, doc, set, member)                                                              \
    ISO_OPTION(name, argument, expected, doc, set, iso_analogue_request, member)

const iso_option iso_analogue_option[] = {
    ROW("neumann", "C", "three numbers C1,C2,C3", "C1,C2,C3 of Neumann's problem V = (1/2) sum C_i gamma_i^2",
        iso_set_vector, neumann),
    ROW("k", "K", "a number", "k of the problem V = -eps (gamma, J gamma)^(-1/k)", iso_set_number, k),
    ROW("J", "J1,J2,J3", "three numbers J1,J2,J3", "J of this problem", iso_set_vector, J),
    ROW("eps", "X", "a number", "eps of this problem", iso_set_number, eps),
    ROW("energy", "E", "a number", "energy of the point, M^2/2 + V (default 0)", iso_set_number, energy),
    ROW("level", NULL, NULL, "k = -1: a ball in the potential of a level, even where there is a free one",
        iso_set_flag, level),
    ROW("mass", "M", "a positive number", "mass of the ball (default: chosen)", iso_set_positive, mass),
    ROW("radius", "B", "a positive number", "radius of the ball (default: chosen)", iso_set_positive, radius),
    ISO_OPTION_END,
};

const iso_study iso_analogue_study = {"analogue",
                                      "find a ball that realises a problem of a point on a sphere",
                                      iso_analogue_option,
                                      sizeof(iso_analogue_request),
                                      begin,
                                      .prepare = prepare,
                                      .run = run,
                                      .of = ISO_STUDY_USES_SCENE,
                                      .fields = fields};

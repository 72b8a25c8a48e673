/* isoroll analogue - finds a ball for a problem of a point: a report in # lines, then the ball as a scene. */
#include <math.h>
#include <string.h>

#include "base/number_impl.h"
#include "parameters.h"
#include "scene_options.h"
#include "study/analogue.h"

typedef struct options {
    const char *file;
    double k, J[3], eps, neumann[3], energy; /* NAN: not given               */
    double mass, radius;                     /* NAN: analogue chooses        */
    bool level;
} options;

/* --- numbers ---------------------------------------------------------------------------------------------------- */

/* The fewest digits, 6 or more, that read back as the same double. */
static void print_number(const char *before, double x)
{
    char text[ISO_NUMBER_SIZE];
    double read;
    x += 0.0; /* no -0 */
    for (int digits = 6, same = 0; digits <= 17 && !same; digits++) {
        const int length = iso_number_print_as(text, x, digits);
        same = iso_number_read(text, (size_t)length, &read) && read == x;
    }
    printf("%s%s", before, text);
}

static void print_vector(const char *before, const double x[3])
{
    printf("%s", before);
    for (int i = 0; i < 3; i++) print_number(i == 0 ? "[" : ", ", x[i]);
    printf("]");
}

/* --- the report ------------------------------------------------------------------------------------------------- */

static void print_problem(const iso_analogue *a)
{
    const iso_analogue_problem *p = &a->problem;
    printf("# a ball that realises a point on a sphere\n# point: ");
    if (p->neumann)
        printf("V = (1/2) sum c_i gamma_i^2, c = %.10g %.10g %.10g\n", p->c[0], p->c[1], p->c[2]);
    else
        printf("V = -eps (gamma, J gamma)^(-1/k), k = %.10g, J = %.10g %.10g %.10g, eps = %.10g\n", p->k, p->J[0],
               p->J[1], p->J[2], p->eps);
    printf("#   energy M^2/2 + V = %.10g; V is between %.10g and %.10g\n", p->energy, a->lowest, a->highest);
}

static void print_way(const iso_analogue *a)
{
    const iso_analogue_problem *p = &a->problem;
    const iso_analogue_ball *b = &a->reduced;
    const char *shift = p->neumann || p->eps < 0 ? "2 E - c, eps = 1/2" : "J + E/eps";
    printf("# ball: %s", b->level == 0 ? "free" : "in the potential U = -c (n, J^-1 n)^(-1/k)");
    switch (a->way) {
    case ISO_ANALOGUE_STATED: printf(b->level == 0 ? ", since the energy is 0\n" : "; c = E k^2/det J\n"); break;
    case ISO_ANALOGUE_FREE:
        printf(": on the sphere V = E - eps (gamma, J gamma) with the ball's J = %s\n", shift);
        break;
    case ISO_ANALOGUE_SHIFTED:
        printf(": V = d/2 - eps (gamma, J gamma), d = %.10g, and c = (E - d/2) k^2/det J;\n"
               "#   any d with a positive J would do; this one makes max J/min J = 3/2\n",
               2 * a->shift);
        break;
    case ISO_ANALOGUE_CONSTANT:
        printf(": V is constant: the point turns uniformly, and so does any ball of equal moments\n");
        break;
    }
    if (*a->not_free) printf("#   %s\n", a->not_free);
}

static void print_reduced(const iso_analogue *a)
{
    const iso_analogue_ball *b = &a->reduced;
    const double *J = b->params.J;
    printf("# reduced: k = %.17g, J = %.17g %.17g %.17g\n#   eps = %.17g, h = eps k^2/det J = %.17g", b->params.k,
           J[0], J[1], J[2], b->eps, b->h);
    if (b->level != 0) printf(", c = %.17g", b->level);
    if (b->h < 0) printf("\n#   eps and h are negative: the ball moves by the potential of the level alone");
    printf("\n");
}

/* With a body: which other bodies there are. Without: why there is none, and which option gives one. */
static void print_body(const iso_analogue *a)
{
    const iso_body *b = &a->body.params.body;
    if (!a->has_body) {
        printf("# no body:\n#   %s\n", a->no_body);
        if (a->reduced.params.k == -1 && a->way != ISO_ANALOGUE_SHIFTED && !(a->room > 0))
            printf("#   --level gives one that has a body, in the potential of a level\n");
        return;
    }
    printf("# body: %s, m = %.10g, B = %.10g", iso_surface_name((int)b->surface), b->mass, b->radius);
    if (b->surface != ISO_PLANE) printf(", A = %.10g", b->surface_radius);
    printf("; J times %.10g, which with eps times %.10g leaves V as it is;\n", a->scale,
           a->body.eps / a->reduced.eps);
    printf("#   the triangle inequalities allow m B^2 = D times that for D in (0, J1 + J2 - J3] = (0, %.10g]\n",
           a->room);
}

/* --- the scene -------------------------------------------------------------------------------------------------- */

static void print_ball(const iso_params *p)
{
    const iso_body *b = &p->body;
    if (b->surface == ISO_REDUCED) {
        print_number("reduced: {k: ", p->k);
        print_vector(", J: ", p->J);
    } else {
        print_number("ball:    {mass: ", b->mass);
        print_number(", radius: ", b->radius);
        print_vector(", inertia: ", b->inertia);
        printf("}\nsurface: {kind: %s", iso_surface_name((int)b->surface));
        if (b->surface != ISO_PLANE) print_number(", radius: ", b->surface_radius);
    }
    printf("}\n");
}

static void print_scene(const iso_scene *s)
{
    print_ball(&s->params);
    print_vector("initial:\n  normal: ", s->start.y + 3);
    print_vector("\n  angular_velocity: ", s->start.y);
    print_number("\ntime:    {end: ", s->end);
    if (s->step > 0) print_number(", step: ", s->step);
    printf("}\n");
    if (!iso_effects_have_level(&s->effects)) return;
    printf("effects: {%s: ", iso_level_name());
    print_number("{c: ", iso_effects_level(&s->effects));
    printf("}}\n");
}

/* --- the command ------------------------------------------------------------------------------------------------ */

/* The problem, and the start of its point. */
typedef struct task {
    iso_analogue_problem problem;
    bool started;                       /* a scene gives the start */
    double point[ISO_STATE], end, rows; /* end: in s; rows: those of a scene, 0 is the usual hundred */
} task;

/* True: the options state a problem. False: a scene states it. A wrong mixture gives a message and sets *usage. */
static bool problem_of_options(const options *o, iso_analogue_problem *p, bool *usage)
{
    const bool neumann = !isnan(o->neumann[0]), k = !isnan(o->k), J = !isnan(o->J[0]), eps = !isnan(o->eps);
    *usage = true;
    if (neumann && (k || J || eps))
        return complain("analogue: --neumann has k = -1 and needs no --k, --J or --eps: leave them out"), false;
    if (!neumann && (k || J || eps) && !(k && J && eps))
        return complain("analogue: --%s is missing: a problem is --k, --J and --eps, or --neumann", !k   ? "k"
                                                                                                    : !J ? "J"
                                                                                                         : "eps"),
               false;
    if ((neumann || k) && strcmp(o->file, "-") != 0)
        return complain("analogue: '%s' and a problem in options: leave one of them out", o->file), false;
    if (!neumann && !k && !isnan(o->energy))
        return complain("analogue: --energy needs --neumann or --k, --J and --eps; a scene's start has its own"),
               false;
    *usage = false;
    *p = (iso_analogue_problem){.neumann = neumann, .k = o->k, .eps = o->eps};
    memcpy(p->J, o->J, sizeof p->J);
    memcpy(p->c, o->neumann, sizeof p->c);
    p->energy = isnan(o->energy) ? 0 : o->energy;
    return neumann || k;
}

static iso_status problem_of_scene(iso_context *ctx, const options *o, task *t)
{
    iso_scene scene = {.places = 0};
    iso_status status = iso_scene_read(ctx, o->file, &scene);
    if (status == ISO_OK) status = iso_analogue_problem_of(ctx, &scene, &t->problem, t->point);
    t->started = true;
    t->end = scene.end;
    t->rows = scene.step > 0 ? fabs(scene.end) / scene.step : 0;
    return name_the_file(ctx, o->file, iso_scene_blame(ctx, &scene, iso_text_name(o->file), status));
}

static iso_status answer(iso_context *ctx, const options *o, task *t)
{
    iso_analogue a;
    iso_scene scene;
    t->problem.level = o->level;
    iso_status status = iso_analogue_find(ctx, &t->problem, o->mass, o->radius, &a);
    if (status != ISO_OK) return status;
    if (!t->started) t->end = 2 * iso_analogue_start(&a, t->point); /* about twenty turns */
    status = iso_analogue_scene(ctx, a.has_body ? &a.body : &a.reduced, t->point, t->end, &scene);
    if (status != ISO_OK) return status;
    if (!t->started) scene.end = iso_analogue_round_up(scene.end);
    if (t->rows > 0 && scene.end != 0) scene.step = fabs(scene.end) / t->rows;
    progress_end();
    print_problem(&a);
    print_way(&a);
    print_reduced(&a);
    print_body(&a);
    printf("# start: %s; the twin's gamma and M are the point's, in its clock s\n",
           t->started ? "the scene's" : "one that has this energy");
    if (t->started)
        printf("# end: where s = %.10g\n", t->end);
    else
        printf("# end: a round time t, 20 turns or more\n");
    print_scene(&scene);
    return ISO_OK;
}

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    task t = {.started = false};
    bool usage;
    const bool stated = problem_of_options(o, &t.problem, &usage);
    if (usage) return EXIT_USAGE;
    iso_status status = stated ? ISO_OK : problem_of_scene(ctx, o, &t);
    begin_work(ctx, NULL);
    if (status == ISO_OK) status = answer(ctx, o, &t);
    return finish(ctx, status);
}

static const options defaults = {.file = "-",
                                 .k = NAN,
                                 .J = {NAN, NAN, NAN},
                                 .eps = NAN,
                                 .neumann = {NAN, NAN, NAN},
                                 .energy = NAN,
                                 .mass = NAN,
                                 .radius = NAN};

static const option_row rows[] = {
    ROW("neumann", "C", "three numbers C1,C2,C3", "C1,C2,C3 of Neumann's problem V = (1/2) sum C_i gamma_i^2",
        set_vector, options, neumann),
    ROW("k", "K", "a number", "k of the problem V = -eps (gamma, J gamma)^(-1/k)", iso_set_number, options, k),
    ROW("J", "J1,J2,J3", "three numbers J1,J2,J3", "J of this problem", set_vector, options, J),
    ROW("eps", "X", "a number", "eps of this problem", iso_set_number, options, eps),
    ROW("energy", "E", "a number", "energy of the point, M^2/2 + V (default 0)", iso_set_number, options, energy),
    ROW("level", NULL, NULL, "k = -1: a ball in the potential of a level, even where there is a free one",
        iso_set_flag, options, level),
    ROW("mass", "M", "a positive number", "mass of the ball (default: chosen)", iso_set_positive, options, mass),
    ROW("radius", "B", "a positive number", "radius of the ball (default: chosen)", iso_set_positive, options,
        radius),
    ROW_END,
};

const command command_analogue = {
    COMMAND("analogue", "[SCENE]", "find a ball that realises a problem of a point on a sphere", file),
    .takes = FILE_SCENE,
    .description =
        "The problem is a scene of a 'point', or --neumann, or --k, --J and --eps. If the problem is a "
        "scene, its start is kept; otherwise a start is chosen. The answer is a scene of a ball, with a report in "
        "# lines.\n\n"
        "The ball is free (no potential acts on it) where that is possible. It is a body with mass and radius where "
        "there is one, else k and J alone. Mass and radius that are not given are round numbers, chosen so that the "
        "angular velocity is of order one.",
    .example = "isoroll analogue --neumann 1,2,2.5 --energy 2 > ball.yaml\nisoroll compare ball.yaml",
};

/* test_scene_print.c - the law of scenes as text: what is printed reads as the same scene, to the bit, and prints as
 * the same text. For the scenes of all files of examples and tests, for odd ones, and for random ones over every
 * effect. */
#define _GNU_SOURCE /* nftw */
#include <ftw.h>

#include "effects.h"
#include "io/scene_file.h"
#include "io/scene_print_impl.h"
#include "orbit/orbit_impl.h"

static iso_context *ctx;
static iso_random *rng;
static int files, unlike;

static char *text_of(const iso_scene *scene)
{
    char *text = NULL;
    size_t length;
    FILE *to = open_memstream(&text, &length);
    if (!to) abort();
    iso_scene_print(scene, to);
    if (fclose(to) != 0) abort();
    return text;
}

static bool same_numbers(const double a[], const double b[], int count)
{
    return memcmp(a, b, (size_t)count * sizeof *a) == 0;
}

/* The effects that are on: their numbers, but those that they find by themselves, and what is written of them. */
static const char *different_effects(const iso_effects *a, const iso_effects *b)
{
    iso_effect_number n, other;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        const iso_effect *effect = iso_effect_list[e];
        if (a->on[e] != b->on[e]) return effect->name;
        if (!a->on[e]) continue;
        int i = 0;
        for (; iso_effect_number_at(a, e, i, &n); i++)
            if (!iso_effect_number_at(b, e, i, &other) || strcmp(n.name, other.name) != 0 ||
                !same_numbers(iso_effect_values(a, e, &n), iso_effect_values(b, e, &n), n.count))
                return effect->name;
        if (iso_effect_number_at(b, e, i, &other)) return effect->name;
        for (i = 0; effect->expressions && effect->expressions[i]; i++)
            if (strcmp(a->written[effect->written].expression[i], b->written[effect->written].expression[i]) != 0)
                return effect->name;
    }
    return NULL;
}

/* The first thing in which two scenes differ, other than places; NULL: none. */
static const char *different(const iso_scene *a, const iso_scene *b)
{
    if (memcmp(&a->params, &b->params, sizeof a->params) != 0) return "params";
    if (a->start.model != b->start.model || !same_numbers(a->start.y, b->start.y, ISO_STATE)) return "start";
    if (a->start.model == ISO_POINT && !same_numbers(&a->start.eps, &b->start.eps, 1)) return "eps";
    if (!same_numbers(&a->end, &b->end, 1) || !same_numbers(&a->step, &b->step, 1)) return "times";
    if (a->backend != b->backend || strcmp(a->method, b->method) != 0 || a->tolerance != b->tolerance)
        return "solver";
    if (iso_scene_is_rounded(a, "k") != iso_scene_is_rounded(b, "k")) return "whether k is rounded";
    if (a->as != b->as || a->columns != b->columns) return "output";
    for (size_t i = 0; i < a->columns; i++)
        if (strcmp(a->column[i], b->column[i]) != 0) return "columns";
    return different_effects(&a->effects, &b->effects);
}

static void check(const char *name, const iso_scene *scene)
{
    iso_scene again;
    char *text = text_of(scene), *second = NULL;
    const iso_status status = iso_scene_load_text(ctx, name, text, strlen(text), &again);
    const char *other = status == ISO_OK ? different(scene, &again) : iso_context_message(ctx);
    if (!other) second = text_of(&again);
    if (!other && strcmp(text, second) != 0) other = "the second text";
    if (other && unlike++ < 5) gsl_test(1, "%s: %s differs:\n%s", name, other, text);
    free(text);
    free(second);
}

static int check_file(const char *path, const struct stat *s, int type, struct FTW *f)
{
    iso_scene scene;
    (void)f;
    if (type != FTW_F || s->st_size > 20000) return 0;
    if (iso_scene_load(ctx, path, &scene) != ISO_OK) return 0; /* something else, or a mistake on purpose */
    files++;
    check(path, &scene);
    return 0;
}

#define BALL "ball: {mass: 2, radius: 1, inertia: [2, 3, 4]}\nsurface: {kind: inside, radius: 3}\n"
#define REDUCED "reduced: {k: 1/3, J: [2/7, 3, 0.1]}\n"
#define POINT "point: {k: -1, J: [2, 3, 4], eps: -0.0}\n"
#define START "initial: {normal: [-0.0, 0.6, 0.8], angular_velocity: [1, -0.0, 0]}\ntime: {end: 1}\n"
#define POINT_START "initial: {gamma: [0.6, 0, 0.80000001], M: [1, 1, 1], project: true}\ntime: {end: -0.0}\n"

static void check_odd(void)
{
    static const char *const texts[] = {
        REDUCED START "effects: {field: {linear: [0, 0, 0]}, reactions: {two_sided: true, D: 0.05}}\n",
        REDUCED START "effects: {gravity: {mgb: 0, up: [0, 0, 1]}, rotor: {momentum: [-0.0, 0, 0]}}\n",
        "reduced: {k: 0.33333333333333331, J: [1, 2, 3]}\n" START,
        "reduced: {k: 0.6180339887498949, J: [1e-300, 2e300, 4.9e-308]}\n" START,
        BALL START
        "effects: {gravity: {g: 0, up: [0, 0, 1]}, torque: {M: ['e1', \"omega1\\t*\\n2\", 0], work: any}}\n",
        BALL START "effects: {attitude: {quaternion: [-1, 0, 0, -0.0]}, twist: {resistance: 0}, clock: {}}\n",
        BALL START
        "effects: {gravity: {g: 9.81, up: [0, 0, 1]}, potential: {U: n1 * c, parameters: {c: -0.0, y: 2}}}\n",
        POINT POINT_START "effects: {level: {}, magnetic: {momentum: [1, 2, 3]}, reactions: {D: 0.5}}\n",
        POINT POINT_START "effects: {level: {c: 2}, rotor: {momentum: [0, 0, 1]}, integrals: {F: n1, F3: n2}}\n"
                          "output: {as: point, columns: [s, M1]}\nsolver: {method: rk8, tolerance: 1e-3}\n",
        "point: {k: -1, J: [2, 3, 4]}\n" POINT_START "solver: {backend: exact}\noutput: {as: both}\n",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        iso_scene scene;
        const iso_status status = iso_scene_load_text(ctx, "odd", texts[i], strlen(texts[i]), &scene);
        gsl_test(status != ISO_OK, "odd scene %zu: %s", i, status == ISO_OK ? "is read" : iso_context_message(ctx));
        if (status == ISO_OK) check(texts[i], &scene);
    }
}

/* --- random scenes ---------------------------------------------------------------------------------------------- */

static double number(double low, double high)
{
    return effects_random_sign(rng, low, high) * pow(10, nearbyint(iso_random_uniform(rng, -5, 5)));
}

static bool chance(double part)
{
    return iso_random_uniform(rng, 0, 1) < part;
}

/* A body on one of the surfaces. */
static iso_params random_body(void)
{
    static const iso_surface surfaces[] = {ISO_PLANE, ISO_OUTSIDE, ISO_INSIDE, ISO_SHELL};
    iso_params p;
    iso_body b = {.mass = fabs(number(1, 10)), .radius = fabs(number(1, 10)), .surface = surfaces[rand() % 4]};
    const double size = fabs(number(1, 10));
    for (int i = 0; i < 3; i++) b.inertia[i] = size * iso_random_uniform(rng, 1, 2);
    const double ratio = iso_random_uniform(rng, 1.1, 4);
    if (b.surface != ISO_PLANE) b.surface_radius = b.radius * (b.surface == ISO_SHELL ? 1 / ratio : ratio);
    if (iso_params_physical(ctx, &b, &p) != ISO_OK) abort();
    return p;
}

/* Its ball, effects and start are valid; end, step and solver are any. */
static iso_scene random_scene(void)
{
    static const char *const methods[] = {"auto", "taylor", "rk8pd", "adams", "taylor_extended"};
    const double *J = laws_J[rand() % LAWS_J];
    const bool point = chance(0.3), body = !point && chance(0.5);
    iso_scene s = iso_scene_default();
    s.params = body    ? random_body()
               : point ? laws_params(laws_k[rand() % LAWS_K], J)
                       : effects_params(laws_k[rand() % LAWS_K], J, rng);
    s.effects = effects_random(rng, &s.params, rand() % (1 << ISO_EFFECTS), 1, 1, 1);
    const double sign = s.params.k > 1 || s.params.k < 0 ? -1 : 1, g = number(1, 10);
    if (body) s.effects.number[ISO_GRAVITY][4] = g;
    if (body) GRAVITY_MGB(&s.effects) = s.params.body.mass * g * (sign * s.params.body.radius);
    if (point && s.effects.on[ISO_REACTIONS]) s.params.D = 0.5 * min3(J);
    double unit[3], vector[3];
    const double eps = number(1, 10);
    iso_random_direction(rng, unit);
    for (int i = 0; i < 3; i++) vector[i] = number(1, 10);
    const iso_spin spin = s.effects.on[ISO_TWIST] ? ISO_SPIN_KEEP : ISO_SPIN_REMOVE;
    const iso_status status = point ? iso_start_point(ctx, vector, unit, chance(0.5) ? &eps : NULL, true, &s.start)
                                    : iso_start_ball(ctx, vector, unit, spin, &s.start);
    if (status != ISO_OK) abort();
    s.end = number(1, 10);
    if (chance(0.5)) s.step = fabs(s.end) / (rand() % 1000 + 1);
    s.backend = (iso_backend)(rand() % 4);
    strcpy(s.method, methods[rand() % 5]);
    if (chance(0.5)) s.tolerance = iso_random_uniform(rng, 1e-14, 1e-4);
    s.as = (iso_models)(rand() % 4);
    for (; chance(0.4) && s.columns < 15; s.columns++) strcpy(s.column[s.columns], iso_column_name((int)s.columns));
    return s;
}

int main(void)
{
    enum { RANDOM = 300 };
    ctx = iso_context_create();
    rng = iso_random_create(49);
    nftw(ISO_TEST_DATA "/../../examples", check_file, 16, FTW_PHYS);
    nftw(ISO_TEST_DATA "/..", check_file, 16, FTW_PHYS);
    check_odd();
    for (int i = 0; i < RANDOM; i++) {
        const iso_scene scene = random_scene();
        check("random", &scene);
    }
    gsl_test(unlike > 0, "%d scenes of files, %d random ones: their text reads as they are", files, RANDOM);
    gsl_test(files < 60, "scenes of files: %d", files);
    iso_random_free(rng);
    iso_context_free(ctx);
    return gsl_test_summary();
}

/* test_sweep_file.c - sweeps as files: the points of grids, ranges and samples, and laws of their scenes.
 *
 * - A point is a pure function of its number.
 * - The scene of a point, written as text and read again, is the same scene to the bit.
 * - Starts on the section lie where the file says, with the energy of the scene's start.
 */
#include "io/scene_file.h"
#include "laws.h"
#include "map/section.h"
#include "map/state.h"
#include "sweep/sweep_impl.h"

static const char *const inside = "scene:\n"
                                  "  # a ball in a bowl, in lines of their own\n"
                                  "  ball: {mass: 6.8, radius: 0.1, inertia: [0.027, 0.0274, 0.0283]}\n"
                                  "  surface: {kind: inside, radius: 0.3}\n"
                                  "  initial:\n"
                                  "    normal:\n"
                                  "    - 0.36\n"
                                  "    - 0.48   # \xc3\xa4\n"
                                  "    - 0.8\n"
                                  "    angular_velocity: [0.9, -0.3, -0.225]\n"
                                  "  time: {end: 10}\n"
                                  "  effects: {gravity: {g: 9.81, up: [0, 0.6, 0.8]}}\n"
                                  "vary:\n"
                                  "  surface.radius: {from: 0.2, to: 0.4, count: 5}\n"
                                  "  gravity.g: {from: 0.1, to: 10, count: 3, logarithmic: true}\n"
                                  "  mass: {from: 1, to: 2}\n"
                                  "  normal: [[0.36, 0.48, 0.8], [-0.36, -0.48, -0.8]]\n"
                                  "samples: {count: 7, kind: random, seed: 3}\n"
                                  "measure: {state: {}}\n";

static const char *const chart =
    "scene: {reduced: {k: 0.5, J: [1.5, 2, 5]}, time: {end: 10},\n"
    "        initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}}\n"
    "vary:\n"
    "  k: [0.5, -0.75, 2, 0.06]\n"
    "  J3/J1: {from: 3, to: 7}\n"
    "  J2: [2, 2.5]\n"
    "  start: {spread: 40, seed: 5}\n"
    "samples: {count: 3}\n"
    "measure: {state: {}}\n";

static const char *const point = "scene: {point: {k: -0.75, J: [1, 2, 5]}, time: {end: 10},\n"
                                 "        initial: {gamma: [0.36, 0.48, 0.8], M: [0.9, -0.3, -0.225]}}\n"
                                 "vary:\n"
                                 "  J: {triangle: 12, ordered: true}\n"
                                 "  l: {from: -3, to: 3, count: 9}\n"
                                 "  x: [-0.99, 0.25]\n"
                                 "measure: {state: {}}\n";

static iso_sweep_file *read(iso_context *ctx, const char *text)
{
    iso_sweep_file *f = NULL;
    const iso_status status = iso_sweep_parse(ctx, "test.yaml", text, strlen(text), &f);
    gsl_test(status != ISO_OK, "reading: %s", status == ISO_OK ? "done" : iso_context_message(ctx));
    return f;
}

static bool same(const iso_scene *a, const iso_scene *b)
{
    return memcmp(&a->params, &b->params, sizeof a->params) == 0 &&
           memcmp(a->start.y, b->start.y, sizeof a->start.y) == 0 && a->start.model == b->start.model &&
           memcmp(&a->effects, &b->effects, sizeof a->effects) == 0 && a->end == b->end &&
           a->tolerance == b->tolerance;
}

/* The laws that every sweep obeys; points in an order that jumps. */
static void check_points(iso_context *ctx, const char *name, const char *text, size_t count)
{
    iso_sweep_file *f = read(ctx, text);
    if (!f) return;
    const iso_family *family = &iso_sweep_file_plan(f)->family;
    size_t unlike = 0, unread = 0;
    gsl_test(family->count != count, "%s: %zu points, not %zu", name, family->count, count);
    for (size_t j = 0; j < family->count; j++) {
        const size_t i = j * 7919 % family->count;
        iso_scene one, two, again;
        double numbers[2][32];
        char *scene = NULL;
        size_t length;
        if (family->scene(ctx, family->data, i, &one, numbers[0]) != ISO_OK) {
            gsl_test(1, "%s, point %zu: %s", name, i, iso_context_message(ctx));
            continue;
        }
        family->scene(ctx, family->data, i, &two, numbers[1]);
        unlike += !same(&one, &two) || memcmp(numbers[0], numbers[1], (size_t)family->columns * sizeof(double)) != 0;
        FILE *to = open_memstream(&scene, &length);
        if (!to) return;
        iso_status status = iso_sweep_print_point(ctx, f, i, to);
        fclose(to);
        if (status == ISO_OK) status = iso_scene_load_text(ctx, "point.yaml", scene, strlen(scene), &again);
        if (status != ISO_OK) gsl_test(1, "%s, point %zu: %s", name, i, iso_context_message(ctx));
        if (status == ISO_OK && !same(&one, &again) && unread++ == 0)
            for (int k = 0; k < 6; k++)
                gsl_test(1, "%s, point %zu: %.17g is read as %.17g", name, i, one.start.y[k], again.start.y[k]);
        free(scene);
    }
    gsl_test(unlike > 0, "%s: points are functions of their numbers", name);
    gsl_test(unread > 0, "%s: scenes read back to the bit (%zu do not)", name, unread);
    iso_sweep_file_free(f);
}

static void check_section(iso_context *ctx)
{
    iso_sweep_file *f = read(ctx, chart);
    if (!f) return;
    const iso_family *family = &iso_sweep_file_plan(f)->family;
    double off = 0, energy = 0;
    for (size_t i = 0; i < family->count; i++) {
        iso_scene s;
        double numbers[16], l, x, M[ISO_STATE];
        if (family->scene(ctx, family->data, i, &s, numbers) != ISO_OK) continue;
        const int axis = iso_section_axis(iso_free_point(&s.params, 1));
        iso_ball_to_point(&s.params, s.start.y, M);
        iso_section_chart(axis, M, &l, &x);
        const double h = iso_ball_energy(&s.params, s.start.y),
                     wanted = iso_ball_energy(&s.params, family->base->start.y);
        off = fmax(off, fmax(fabs(l - numbers[3]), fabs(x - numbers[4])));
        energy = fmax(energy, fabs(h / wanted - 1));
        gsl_test_rel(s.params.J[2] / s.params.J[0], numbers[1], 1e-15, "J3/J1 of point %zu", i);
    }
    gsl_test_abs(off, 0, 1e-13, "starts lie at their l and x");
    gsl_test_abs(energy, 0, 1e-13, "starts have the energy");
    iso_sweep_file_free(f);
}

/* Values of a range are those that one writes: 0.1, 0.2, ..., and both ends. */
static void check_range(iso_context *ctx)
{
    iso_sweep_file *f = read(
        ctx, "scene: {reduced: {k: 0.5, J: [1, 2, 5]}, time: {end: 10}, initial:\n"
             " {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}}\n"
             "vary: {k: [{from: -3, to: -0.1, count: 30}, {from: 0, to: 3, count: 31}]}\nmeasure: {state: {}}\n");
    if (!f) return;
    const iso_family *family = &iso_sweep_file_plan(f)->family;
    for (size_t i = 0; i < 61; i++) {
        double k = NAN;
        iso_scene s;
        char text[16];
        family->scene(ctx, family->data, i, &s, &k);
        snprintf(text, sizeof text, "%.1f", ((double)i - 30) / 10);
        gsl_test(k != strtod(text, NULL), "value %zu is %s", i, text);
    }
    iso_sweep_file_free(f);
}

/* Decades, and halves of them, are met by a logarithmic range: k = 1 must be 1. */
static void check_decades(iso_context *ctx, int decades, int parts)
{
    char text[400];
    const int count = 2 * decades * parts + 1;
    snprintf(text, sizeof text,
             "scene: {reduced: {k: 0.5, J: [1, 2, 5]}, time: {end: 10}, initial:\n"
             " {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}}\n"
             "vary: {k: {from: 1e-%d, to: 1e%d, count: %d, logarithmic: true}}\nmeasure: {state: {}}\n",
             decades, decades, count);
    iso_sweep_file *f = read(ctx, text);
    if (!f) return;
    const iso_family *family = &iso_sweep_file_plan(f)->family;
    for (int i = 0; i <= 2 * decades; i++) {
        double k = NAN;
        iso_scene s;
        char wanted[16];
        family->scene(ctx, family->data, (size_t)(i * parts), &s, &k);
        snprintf(wanted, sizeof wanted, "1e%d", i - decades);
        gsl_test(k != strtod(wanted, NULL), "%d decades in %d: %.17g is %s", decades, parts, k, wanted);
    }
    iso_sweep_file_free(f);
}

/* What is drawn fills its range: the largest part without a sample. */
static void check_samples(iso_context *ctx, const char *kind, double most)
{
    enum { COUNT = 400 };
    char text[512], seen[COUNT / 4] = "";
    snprintf(text, sizeof text,
             "scene: {reduced: {k: 0.5, J: [1, 2, 5]}, time: {end: 10}, initial:\n"
             " {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}}\n"
             "vary: {k: {from: 1, to: 2}, J2: {from: 1, to: 2}}\nsamples: {count: %d, kind: %s, seed: 1}\n"
             "measure: {state: {}}\n",
             COUNT, kind);
    iso_sweep_file *f = read(ctx, text);
    if (!f) return;
    const iso_family *family = &iso_sweep_file_plan(f)->family;
    int empty = 0;
    for (size_t i = 0; i < COUNT; i++) {
        double number[2];
        iso_scene s;
        family->scene(ctx, family->data, i, &s, number);
        gsl_test(!(number[0] >= 1 && number[0] < 2 && number[1] >= 1 && number[1] < 2), "sample %zu is inside", i);
        seen[(int)((number[0] - 1) * 10) * 10 + (int)((number[1] - 1) * 10)] = 1;
    }
    for (int i = 0; i < COUNT / 4; i++) empty += !seen[i];
    gsl_test(empty > most, "%s: %d of %d squares have no sample", kind, empty, COUNT / 4);
    iso_sweep_file_free(f);
}

int main(void)
{
    iso_context *ctx = iso_context_create();
    check_points(ctx, "inside", inside, 5 * 3 * 7 * 2);
    check_points(ctx, "chart", chart, 4 * 3 * 2 * 40);
    check_points(ctx, "point", point, 12 * 9 * 2 - 5 * 9 * 2);
    check_section(ctx);
    check_range(ctx);
    for (int parts = 1; parts < 8; parts++)
        for (int decades = 1; decades < 7; decades++) check_decades(ctx, decades, parts);
    check_samples(ctx, "even", 0);
    check_samples(ctx, "random", 8); /* 100 exp(-4) = 2 */
    iso_context_free(ctx);
    return gsl_test_summary();
}

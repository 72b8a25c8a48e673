/* test_scene.c - scene files: valid ones of every kind, and every kind of mistake with its place and its words. */
#include <gsl/gsl_test.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io/scene_file.h"

#define BALL "ball: {mass: 2, radius: 1, inertia: [2, 3, 4]}\n"
#define SURFACE "surface: {kind: shell, radius: 0.5}\n"
#define INITIAL "initial: {normal: [0.6, 0, 0.8], angular_velocity: [0, 1, 0]}\n"
#define TIME "time: {end: 10, step: 0.1}\n"
#define REDUCED "reduced: {k: -1, J: [2, 3, 4]}\n"
#define POINT "point: {k: -1, J: [2, 3, 4]}\n"
#define POINT_INITIAL "initial: {gamma: [0.6, 0, 0.8], M: [0, 1, 0]}\n"

/* A scene with one mistake: where it is, from 1, and a part of what is said about it. The files of tests/cli/bad are
 * the same mistakes as a user meets them. */
static const struct mistake {
    const char *text;
    int line, column;
    const char *says;
} mistakes[] = {
    /* YAML itself */
    {"ball: {mass: 2, radius: 1, inertia: [2, 3, 4}\n" SURFACE INITIAL TIME, 1, 45, "not valid YAML"},
    {BALL SURFACE INITIAL TIME "output: {as: \"ball}\n", 6, 1, "not valid YAML"},
    {BALL SURFACE INITIAL "time:\n  end: 10\n step: 0.1\n", 6, 2, "not valid YAML"},
    {BALL SURFACE INITIAL "time:\n\tend: 10\n", 5, 1, "not valid YAML"},
    {BALL SURFACE INITIAL TIME "effects\n", 6, 1, "not valid YAML"},
    {"", 1, 1, "the file is empty"},
    {"---\n", 2, 1, "has no value"},
    {"- ball\n- surface\n", 1, 1, "should be a mapping with ball"},
    {"just a few words\n", 1, 1, "should be a mapping with ball"},
    {BALL SURFACE INITIAL TIME "---\nball: 1\n", 5, 1, "a second document"},
    {"ball: {mass: 2, radius: 1, inertia: &i [2, 3, 4]}\n" SURFACE INITIAL TIME, 1, 37, "an anchor"},
    {BALL SURFACE INITIAL "time: {end: *end}\n", 4, 13, "an alias"},
    {"ball: {mass: !!float 2, radius: 1, inertia: [2, 3, 4]}\n" SURFACE INITIAL TIME, 1, 14, "a tag"},
    {BALL SURFACE INITIAL "time: {end: [[[[[[[1]]]]]]]}\n", 4, 19, "nested more than 8"},
    {BALL SURFACE INITIAL TIME "# bell \a\n", 5, 8, "control characters"},
    {BALL SURFACE INITIAL TIME "# caf\351 noir\n", 5, 6, "UTF-8"},
    {BALL SURFACE INITIAL TIME "\"\\e[2J\\x9b\": 5\n", 5, 1, "unknown key '?[2J"},

    /* Keys */
    {BALL "surfaec: {kind: plane}\n" SURFACE INITIAL TIME, 2, 1, "unknown key 'surfaec'; did you mean 'surface'?"},
    {BALL SURFACE INITIAL TIME "wheels: 4\n", 5, 1, "unknown key 'wheels'; valid are ball, surface, reduced"},
    {"ball: {mass: 2, radius: 1, inertai: [2, 3, 4]}\n" SURFACE INITIAL TIME, 1, 28,
     "unknown key 'inertai'; did you mean 'inertia'?"},
    {"ball: {Mass: 2, radius: 1, inertia: [2, 3, 4]}\n" SURFACE INITIAL TIME, 1, 8, "did you mean 'mass'?"},
    {BALL SURFACE INITIAL "time:\n  end: 10\n  stpe: 0.1\n", 6, 3, "did you mean 'step'?"},
    {BALL SURFACE "initial:\n  normal: [0.6, 0, 0.8]\n  angular_velocitty: [0, 1, 0]\n" TIME, 5, 3,
     "did you mean 'angular_velocity'?"},
    {BALL SURFACE INITIAL TIME "solver: {tolerence: 1e-9}\n", 5, 10, "did you mean 'tolerance'?"},
    {BALL SURFACE INITIAL TIME "\"\": 5\n", 5, 1, "unknown key ''"},
    {BALL SURFACE INITIAL TIME "? [a, b]\n: 5\n", 5, 3, "a key should be a name"},
    {BALL SURFACE INITIAL TIME "ball: {mass: 3, radius: 1, inertia: [2, 3, 4]}\n", 5, 1,
     "duplicate key 'ball', first written in line"},
    {"ball: {mass: 2, radius: 1, mass: 3, inertia: [2, 3, 4]}\n" SURFACE INITIAL TIME, 1, 28, "duplicate key 'mass'"},
    {BALL SURFACE INITIAL "time: {<<: {end: 10}}\n", 4, 8, "unknown key '<<'"},

    /* Types */
    {"ball: 5\n" SURFACE INITIAL TIME, 1, 7,
     "'ball' should be a mapping {mass: ..., radius: ..., inertia: ...}, not '5'"},
    {"ball:\n" SURFACE INITIAL TIME, 1, 6, "'ball' has no value"},
    {BALL SURFACE INITIAL "time: [10, 0.1]\n", 4, 7, "'time' should be a mapping {end: ..., step: ...}, not a list"},
    {"ball: {mass: [2], radius: 1, inertia: [2, 3, 4]}\n" SURFACE INITIAL TIME, 1, 14,
     "'mass' should be a finite number, not a list"},
    {BALL SURFACE INITIAL "time: {end: {t: 10}}\n", 4, 13, "'end' should be a finite number, not a mapping"},
    {"ball: {mass: 2, radius: 1, inertia: 2}\n" SURFACE INITIAL TIME, 1, 37,
     "'inertia' should be a list of 3 finite numbers, not '2'"},
    {"ball: {mass: 2, radius: 1, inertia: [2, 3]}\n" SURFACE INITIAL TIME, 1, 37,
     "'inertia' should be a list of 3 finite numbers, not of 2"},
    {"ball: {mass: 2, radius: 1, inertia: [2, 3, 4, 5]}\n" SURFACE INITIAL TIME, 1, 37, "not of 4"},
    {"ball: {mass: \"2\", radius: 1, inertia: [2, 3, 4]}\n" SURFACE INITIAL TIME, 1, 14,
     "should be a finite number, not the text '2'"},
    {BALL SURFACE INITIAL "time:\n  end:\n  step: 0.1\n", 5, 7, "'end' has no value, it should be a finite number"},
    {BALL SURFACE INITIAL "time: {end: ~}\n", 4, 13, "should be a finite number, not '~'"},
    {BALL SURFACE "initial: {normal: [0.6, 0, 0.8], angular_velocity: [0, 1, 0], project: yes}\n" TIME, 3, 72,
     "'project' should be true or false, not 'yes'"},
    {BALL SURFACE INITIAL TIME "output: {columns: t}\n", 5, 19,
     "'columns' should be a list of at least one column name"},
    {BALL SURFACE INITIAL TIME "output: {columns: []}\n", 5, 19, "at least one column name, not an empty list"},
    {BALL SURFACE INITIAL TIME "effects: [gravity]\n", 5, 10, "'effects' should be a mapping"},

    /* Numbers */
    {"ball: {mass: 0.5x, radius: 1, inertia: [2, 3, 4]}\n" SURFACE INITIAL TIME, 1, 14, "not '0.5x'"},
    {"ball: {mass: 2 kg, radius: 1, inertia: [2, 3, 4]}\n" SURFACE INITIAL TIME, 1, 14, "not '2 kg'"},
    {"ball: {mass: 2, radius: nan, inertia: [2, 3, 4]}\n" SURFACE INITIAL TIME, 1, 25, "finite number, not 'nan'"},
    {"ball: {mass: 2, radius: 1, inertia: [2, .nan, 4]}\n" SURFACE INITIAL TIME, 1, 41,
     "'inertia[2]' should be a finite number, not '.nan'"},
    {BALL SURFACE INITIAL "time: {end: inf, step: 0.1}\n", 4, 13, "not 'inf'"},
    {BALL SURFACE INITIAL "time: {end: -.inf, step: 0.1}\n", 4, 13, "not '-.inf'"},
    {BALL SURFACE INITIAL "time: {end: 1e400, step: 0.1}\n", 4, 13, "not '1e400'"},
    {"ball: {mass: 0x10, radius: 1, inertia: [2, 3, 4]}\n" SURFACE INITIAL TIME, 1, 14, "not '0x10'"},
    {"ball:\n  mass: 2,5\n  radius: 1\n  inertia: [2, 3, 4]\n" SURFACE INITIAL TIME, 2, 9, "not '2,5'"},
    {BALL SURFACE INITIAL "time: {end: 1_000, step: 0.1}\n", 4, 13, "not '1_000'"},
    {"reduced: {k: 1/2, J: [2, 3, 4]}\n" INITIAL TIME, 1, 14, "'k' should be a finite number, not '1/2'"},

    /* Physics */
    {"ball: {mass: 0, radius: 1, inertia: [2, 3, 4]}\n" SURFACE INITIAL TIME, 1, 14, "mass 0: must be positive"},
    {"ball: {mass: -2, radius: 1, inertia: [2, 3, 4]}\n" SURFACE INITIAL TIME, 1, 14, "mass -2: must be positive"},
    {"ball: {mass: 2, radius: -1, inertia: [2, 3, 4]}\n" SURFACE INITIAL TIME, 1, 25, "radius -1: must be positive"},
    {"ball: {mass: 2, radius: 1, inertia: [0, 3, 4]}\n" SURFACE INITIAL TIME, 1, 37, "inertia 1 is 0"},
    {"ball: {mass: 2, radius: 1, inertia: [1, 2, 4]}\n" SURFACE INITIAL TIME, 1, 37, "triangle inequality"},
    {BALL "surface: {kind: outside, radius: 0}\n" INITIAL TIME, 2, 34, "surface radius 0: must be positive"},
    {BALL "surface: {kind: inside, radius: 0.5}\n" INITIAL TIME, 2, 33, "does not roll inside"},
    {BALL "surface: {kind: shell, radius: 2}\n" INITIAL TIME, 2, 32, "does not go around"},
    {"reduced: {k: 0, J: [2, 3, 4]}\n" INITIAL TIME, 1, 14, "must be finite and not 0"},
    {"reduced: {k: -1, J: [2, -3, 4]}\n" INITIAL TIME, 1, 21, "J2 = -3"},
    {BALL SURFACE "initial: {normal: [1, 1, 0], angular_velocity: [0, 0, 0]}\n" TIME, 3, 19,
     "it must be a unit vector"},
    {BALL SURFACE "initial: {normal: [0, 0, 0], angular_velocity: [0, 1, 0]}\n" TIME, 3, 19, "normal is zero"},
    {BALL SURFACE "initial: {normal: [0.6, 0, 0.8], angular_velocity: [0, 1, 0.5]}\n" TIME, 3, 52,
     "or 'project: true'"},
    {POINT "initial: {gamma: [0.5, 0, 0], M: [0, 1, 0]}\n" TIME, 2, 18, "gamma has length 0.5"},
    {POINT "initial: {gamma: [0.6, 0, 0.8], M: [1, 1, 0]}\n" TIME, 2, 36, "must be orthogonal"},

    /* Sections */
    {"initial: {normal: [0.6, 0, 0.8], angular_velocity: [0, 1, 0]}\n" TIME, 1, 1, "missing 'ball' and 'surface'"},
    {"ball: {mass: 2, radius: 1, inertia: [2, 3, 4]}\n" INITIAL TIME, 1, 1, "'ball' needs a 'surface'"},
    {"surface: {kind: plane}\n" INITIAL TIME, 1, 1, "'surface' needs a 'ball'"},
    {"ball: {mass: 2, radius: 1, inertia: [2, 3, 4]}\n" SURFACE TIME, 1, 1, "missing 'initial' in the scene"},
    {"ball: {mass: 2, radius: 1, inertia: [2, 3, 4]}\n" SURFACE INITIAL, 1, 1, "missing 'time' in the scene"},
    {BALL SURFACE INITIAL "time: {step: 0.1}\n", 4, 1, "missing 'end' in 'time'"},
    {"ball: {mass: 2, radius: 1}\n" SURFACE INITIAL TIME, 1, 1, "missing 'inertia' in 'ball'"},
    {BALL "surface: {radius: 1}\n" INITIAL TIME, 2, 1, "missing 'kind' in 'surface'"},
    {"reduced: {J: [2, 3, 4]}\n" INITIAL TIME, 1, 1, "missing 'k' in 'reduced'"},
    {BALL SURFACE "initial: {angular_velocity: [0, 1, 0]}\n" TIME, 3, 1, "missing 'normal' in 'initial'"},
    {POINT "initial: {gamma: [0.6, 0, 0.8]}\n" TIME, 2, 1, "missing 'M' in 'initial'"},
    {BALL SURFACE "reduced: {k: -1, J: [2, 3, 4]}\n" INITIAL TIME, 3, 1, "'ball' and 'reduced' both"},
    {POINT SURFACE "ball: {mass: 2, radius: 1, inertia: [2, 3, 4]}\n" INITIAL TIME, 3, 1, "'ball' and 'point' both"},
    {"surface: {kind: plane}\n" REDUCED INITIAL TIME, 1, 1, "'surface' goes with 'ball'; 'reduced' has its k"},
    {BALL SURFACE "initial: {normal: [0.6, 0, 0.8], angular_velocity: [0, 1, 0], gamma: [0.6, 0, 0.8]}\n" TIME, 3, 63,
     "'gamma' does not belong here"},
    {POINT "initial: {normal: [0.6, 0, 0.8], angular_velocity: [0, 1, 0]}\n" TIME, 2, 11,
     "a point starts from 'gamma' and 'M'"},
    {BALL "surface: {kind: plane, radius: 5}\n" INITIAL TIME, 2, 24, "a plane has no 'radius'"},
    {BALL "surface: {kind: shell}\n" INITIAL TIME, 2, 1, "missing 'radius' in 'surface'"},

    /* Names and ranges */
    {BALL "surface: {kind: shel, radius: 0.5}\n" INITIAL TIME, 2, 17, "unknown kind 'shel'; did you mean 'shell'?"},
    {BALL "surface: {kind: reduced, radius: 0.5}\n" INITIAL TIME, 2, 17,
     "unknown kind 'reduced'; valid are plane, outside, inside, shell"},
    {BALL SURFACE INITIAL TIME "solver: {backend: bal}\n", 5, 19, "unknown backend 'bal'; did you mean 'ball'?"},
    {BALL SURFACE INITIAL TIME "solver: {backend: both}\n", 5, 19,
     "unknown backend 'both'; valid are ball, point, auto"},
    {BALL SURFACE INITIAL TIME "output: {as: piont}\n", 5, 14, "unknown as 'piont'; did you mean 'point'?"},
    {BALL SURFACE INITIAL TIME "output: {columns: [t, omgea1]}\n", 5, 23,
     "unknown column 'omgea1'; did you mean 'omega1'?"},
    {BALL SURFACE INITIAL TIME "output: {columns: [t, n1, t]}\n", 5, 27, "column 't' is listed twice"},
    {BALL SURFACE INITIAL TIME "solver: {method: adamz}\n", 5, 18, "unknown method 'adamz'; did you mean 'adams'?"},
    {BALL SURFACE INITIAL TIME "solver: {method: magic, tolerance: 1e-9}\n", 5, 18,
     "unknown method 'magic'; valid are auto, adams, bdf"},
    {BALL SURFACE INITIAL TIME "solver: {method: ''}\n", 5, 18, "'method' should be the name of a method"},
    {BALL SURFACE INITIAL TIME "solver: {tolerance: 0}\n", 5, 21, "must be in [1e-15, 0.1]"},
    {BALL SURFACE INITIAL TIME "solver: {tolerance: 1}\n", 5, 21, "must be in [1e-15, 0.1]"},
    {BALL SURFACE INITIAL "time: {end: 10, step: 0}\n", 4, 23, "'step' is 0, it must be positive"},
    {BALL SURFACE INITIAL "time: {end: -10, step: -0.1}\n", 4, 24, "backwards: negative 'end'"},
    {BALL SURFACE INITIAL "time: {end: 1e6, step: 1e-3}\n", 4, 24, "more than 1e+08 rows"},
    {BALL SURFACE INITIAL TIME "effects:\n  gravity: {mgb: 9.81, up: [0, 0, 1]}\n", 6, 13,
     "'mgb' does not belong here: the ball's mass and radius are known, give 'g'"},
    {BALL SURFACE INITIAL TIME "effects: {gravitty: {}}\n", 5, 11,
     "unknown effect 'gravitty'; did you mean 'gravity'?"},
    {BALL SURFACE INITIAL TIME "effects: {wind: {}}\n", 5, 11, "unknown effect 'wind'; valid are gravity, field"},
};

static iso_context *ctx;

/* For gsl_test, which wants 0 for a test passed. */
static int failed(iso_status status)
{
    return status != ISO_OK;
}

static iso_status parse(const char *text, iso_scene *scene)
{
    return iso_scene_parse(ctx, "s.yaml", text, strlen(text), scene);
}

static void test_mistakes(void)
{
    for (size_t i = 0; i < sizeof mistakes / sizeof *mistakes; i++) {
        const struct mistake *m = &mistakes[i];
        iso_scene scene = {.end = 42};
        char place[64];
        const iso_status status = parse(m->text, &scene);
        const char *message = iso_context_message(ctx);
        snprintf(place, sizeof place, "s.yaml:%d:%d: ", m->line, m->column);
        gsl_test(status != ISO_BAD_INPUT, "mistake %zu (%s): %s", i, m->says, iso_status_text(status));
        gsl_test(strncmp(message, place, strlen(place)) != 0, "mistake %zu at %sis said: %s", i, place, message);
        gsl_test(!strstr(message, m->says), "mistake %zu, \"%s\": %s", i, m->says, message);
        gsl_test(strpbrk(message, "\n\r\033") != NULL, "mistake %zu: a message of one line", i);
        gsl_test(scene.end != 42, "mistake %zu leaves the scene alone", i);
    }
}

static void test_ball(void)
{
    iso_scene s;
    gsl_test(failed(parse(BALL SURFACE INITIAL "time: {end: -10, step: 0.5}\neffects: {}\n"
                                               "solver: {backend: point, method: auto, tolerance: 1.0e-9}\n"
                                               "output: {as: both, columns: [t, n1, 'M3']}\n",
                          &s)),
             "a full scene: %s", iso_context_message(ctx));
    gsl_test_rel(s.params.k, -1, 1e-15, "k of the shell");
    gsl_test_rel(s.params.J[0], 4, 1e-15, "J1 = I1 + m B^2");
    gsl_test(s.params.body.surface != ISO_SHELL, "the surface");
    gsl_test(s.start.model != ISO_BALL || s.start.y[1] != 1, "the start");
    gsl_test(s.end != -10 || s.step != 0.5 || s.tolerance != 1e-9, "numbers");
    gsl_test(s.backend != ISO_BACKEND_POINT || s.as != ISO_SHOW_BOTH, "names");
    gsl_test(s.columns != 3 || strcmp(s.column[2], "M3") != 0, "columns");
}

static void test_defaults(void)
{
    iso_scene s;
    gsl_test(failed(parse("# only what is needed\n---\n" INITIAL "time:\n  end: 10\n" REDUCED "...\n", &s)),
             "reduced: %s", iso_context_message(ctx));
    const iso_scene d = iso_scene_default();
    gsl_test(s.params.k != -1 || s.params.J[2] != 4 || s.params.body.surface != ISO_REDUCED, "k and J");
    gsl_test(s.backend != d.backend || s.as != d.as || s.step != 0 || s.tolerance != d.tolerance, "defaults");
    gsl_test(strcmp(s.method, "auto") != 0 || s.columns != 0, "defaults of names");
}

static void test_surfaces(void)
{
    static const struct {
        const char *text;
        double k;
    } rows[] = {
        {"surface: {kind: plane}\n", 1},
        {"surface: {kind: outside, radius: 3}\n", 0.75},
        {"surface: {kind: inside, radius: 3}\n", 1.5},
        {"surface: {kind: shell, radius: 0.5}\n", -1},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[512];
        iso_scene s;
        snprintf(text, sizeof text, "%s", BALL INITIAL TIME);
        strcat(text, rows[i].text);
        gsl_test(failed(parse(text, &s)), "%s%s", rows[i].text, iso_context_message(ctx));
        gsl_test_rel(s.params.k, rows[i].k, 1e-15, "k of %s", rows[i].text);
    }
}

static void test_point(void)
{
    iso_scene s;
    gsl_test(failed(parse(POINT POINT_INITIAL TIME, &s)), "a point: %s", iso_context_message(ctx));
    gsl_test(s.start.model != ISO_POINT || s.start.y[1] != 1, "its start");
    gsl_test(!isnan(s.start.eps), "without eps it is the one of the level H = 0, NAN");
    gsl_test(failed(parse("point: {k: -1, J: [2, 3, 4], eps: 6.5}\n" POINT_INITIAL TIME, &s)), "with eps: %s",
             iso_context_message(ctx));
    gsl_test(s.start.eps != 6.5, "eps as written");
}

static void test_project(void)
{
    iso_scene s;
    const char *twisted = REDUCED TIME "initial: {normal: [0, 0, 1], angular_velocity: [0, 1, 5], project: true}\n";
    gsl_test(failed(parse(twisted, &s)), "project: %s", iso_context_message(ctx));
    gsl_test(s.start.y[2] != 0, "the spin about the normal is gone");
}

/* Text that is no C string, or comes from another system. */
static void test_bytes(void)
{
    static const char nul[] = BALL "\0" SURFACE INITIAL TIME;
    static const char key[] = "ball: {\"ma\\0ss\": 2}\n";
    iso_scene s;
    gsl_test(iso_scene_parse(ctx, "s.yaml", nul, sizeof nul - 1, &s) != ISO_BAD_INPUT, "a NUL byte");
    gsl_test(!strstr(iso_context_message(ctx), "s.yaml:2:1: "), "NUL: %s", iso_context_message(ctx));
    gsl_test(iso_scene_parse(ctx, "s.yaml", "", 0, &s) != ISO_BAD_INPUT, "no text");
    gsl_test(!strstr(iso_context_message(ctx), "s.yaml:1:1: the file is empty"), "%s", iso_context_message(ctx));
    gsl_test(parse(key, &s) != ISO_BAD_INPUT, "a key with a NUL");
    gsl_test(failed(parse("\xEF\xBB\xBF" REDUCED INITIAL TIME, &s)), "a byte order mark: %s",
             iso_context_message(ctx));
    gsl_test(failed(parse("reduced: {k: -1, J: [2, 3, 4]}\r\n" INITIAL "time: {end: 1}\r\n", &s)), "CRLF: %s",
             iso_context_message(ctx));
    gsl_test(parse("# h\xC3\xA9\n" REDUCED INITIAL TIME "\xC3\xA9: 1\n", &s) != ISO_BAD_INPUT, "a key in UTF-8");
    gsl_test(!strstr(iso_context_message(ctx), "s.yaml:5:1: "), "%s", iso_context_message(ctx));
}

/* Every text cut short: any answer but a crash, and none that is silent. */
static void test_cuts(void)
{
    const char *text = BALL SURFACE INITIAL TIME "solver: {method: auto}\noutput: {columns: [t, n1]}\n";
    for (size_t n = 0; n < strlen(text); n++) {
        iso_scene s;
        char *cut = malloc(n + 1); /* exact, for the address sanitizer */
        if (!cut) return;
        memcpy(cut, text, n);
        const iso_status status = iso_scene_parse(ctx, "s.yaml", cut, n, &s);
        gsl_test(status != ISO_OK && status != ISO_BAD_INPUT, "cut at %zu: %s", n, iso_context_message(ctx));
        free(cut);
    }
}

static void test_files(void)
{
    iso_scene s;
    gsl_test(iso_scene_read(ctx, "/nowhere/scene.yaml", &s) != ISO_FILE_TROUBLE, "no such file");
    gsl_test(iso_scene_read(ctx, "/", &s) != ISO_FILE_TROUBLE, "a folder");
    gsl_test(iso_scene_read(ctx, "/dev/zero", &s) != ISO_BAD_INPUT, "an endless file");
    gsl_test(!strstr(iso_context_message(ctx), "/dev/zero:1:1: larger than 16 MiB"), "%s", iso_context_message(ctx));
}

static void test_comma_locale(void)
{
    static const char *const names[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "fr_FR", "ru_RU.UTF-8"};
    iso_scene s;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (!setlocale(LC_NUMERIC, names[i])) continue;
        gsl_test(failed(parse("reduced: {k: -1.5, J: [2.25, 3, 4]}\n" INITIAL TIME, &s)), "under %s", names[i]);
        gsl_test(s.params.k != -1.5 || s.params.J[0] != 2.25, "decimal points under %s", names[i]);
        break;
    }
    setlocale(LC_NUMERIC, "C");
}

int main(void)
{
    ctx = iso_context_create();
    if (!ctx) return 1;
    test_mistakes();
    test_ball();
    test_defaults();
    test_surfaces();
    test_point();
    test_project();
    test_bytes();
    test_cuts();
    test_files();
    test_comma_locale();
    iso_context_free(ctx);
    return gsl_test_summary();
}

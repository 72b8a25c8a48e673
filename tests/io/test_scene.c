/* test_scene.c - scene files: valid ones of every kind, and every kind of mistake with its place and its words. */
#include <dirent.h>
#include <locale.h>

#include "io/scene_file.h"
#include "laws.h"
#include "task/run.h"

#define BALL "ball: {mass: 2, radius: 1, inertia: [2, 3, 4]}\n"
#define SURFACE "surface: {kind: shell, radius: 0.5}\n"
#define INITIAL "initial: {normal: [0.6, 0, 0.8], angular_velocity: [0, 1, 0]}\n"
#define TIME "time: {end: 10, step: 0.1}\n"
#define REDUCED "reduced: {k: -1, J: [2, 3, 4]}\n"
#define POINT "point: {k: -1, J: [2, 3, 4]}\n"
#define POINT_INITIAL "initial: {gamma: [0.6, 0, 0.8], M: [0, 1, 0]}\n"

static iso_context *ctx;

/* For gsl_test, which wants 0 for a test passed. */
static int failed(iso_status status)
{
    return status != ISO_OK;
}

static iso_status parse(const char *text, iso_scene *scene)
{
    return iso_scene_load_text(ctx, "s.yaml", text, strlen(text), scene);
}

/* Scenes with one mistake each (tests/cli/bad_files.txt): the first line of a file tells where it is, and a part of
 * what is said about it. Where a scene can be read, its orbit is refused, without a place. */
static bool check_mistake(const char *name)
{
    char path[512], text[4096] = "", expected[512], *words;
    iso_scene scene = {.end = 42};
    const iso_sink sink = {.data = NULL};
    snprintf(path, sizeof path, "%s/%s", ISO_TEST_BAD, name);
    FILE *from = fopen(path, "re");
    if (!from) return false;
    const size_t size = fread(text, 1, sizeof text - 1, from);
    fclose(from);
    if (sscanf(text, "# expect %511[^\n]", expected) != 1) return false;
    const iso_status status = iso_scene_load_text(ctx, "s.yaml", text, size, &scene);
    words = strchr(expected, ' ');
    *words++ = '\0';
    const bool is_read = status == ISO_OK;
    if (is_read && iso_run(ctx, &scene, NULL, &sink, NULL, NULL) == ISO_OK) gsl_test(1, "%s runs", name);
    const char *message = iso_context_message(ctx);
    gsl_test(!strstr(message, words), "%s, \"%s\": %s", name, words, message);
    if (is_read) return false;
    gsl_test(status != ISO_BAD_INPUT, "%s: %s", name, iso_status_text(status));
    gsl_test(strncmp(message, "s.yaml:", 7) != 0 || strncmp(message + 7, expected, strlen(expected)) != 0,
             "%s at %s is said: %s", name, expected, message);
    gsl_test(strpbrk(message, "\n\r\033") != NULL, "%s: a message of one line", name);
    gsl_test(scene.end != 42, "%s leaves the scene alone", name);
    return true;
}

static void test_mistakes(void)
{
    int mistakes = 0;
    DIR *folder = opendir(ISO_TEST_BAD);
    for (const struct dirent *entry; folder && (entry = readdir(folder));)
        if (!strstr(entry->d_name, "_sweep_")) mistakes += check_mistake(entry->d_name);
    if (folder) closedir(folder);
    gsl_test(mistakes < 180, "%d scenes that cannot be read", mistakes);
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
    gsl_test(iso_scene_load_text(ctx, "s.yaml", nul, sizeof nul - 1, &s) != ISO_BAD_INPUT, "a NUL byte");
    gsl_test(!strstr(iso_context_message(ctx), "s.yaml:2:1: "), "NUL: %s", iso_context_message(ctx));
    gsl_test(iso_scene_load_text(ctx, "s.yaml", "", 0, &s) != ISO_BAD_INPUT, "no text");
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
        const iso_status status = iso_scene_load_text(ctx, "s.yaml", cut, n, &s);
        gsl_test(status != ISO_OK && status != ISO_BAD_INPUT, "cut at %zu: %s", n, iso_context_message(ctx));
        free(cut);
    }
}

static void test_files(void)
{
    iso_scene s;
    gsl_test(iso_scene_load(ctx, "/nowhere/scene.yaml", &s) != ISO_FILE_TROUBLE, "no such file");
    gsl_test(iso_scene_load(ctx, "/", &s) != ISO_FILE_TROUBLE, "a folder");
    gsl_test(iso_scene_load(ctx, "/dev/zero", &s) != ISO_BAD_INPUT, "an endless file");
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
    test_mistakes();
    test_ball();
    test_defaults();
    test_point();
    test_project();
    test_bytes();
    test_cuts();
    test_files();
    test_comma_locale();
    iso_context_free(ctx);
    return gsl_test_summary();
}

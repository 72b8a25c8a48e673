/* iso_section_rotation: circles whose number is known, mirror images, the frequencies of the closed solution; chaos, and
 * too few crossings, have none. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "io/scene_file.h"
#include "study/frequencies/frequencies.h"
#include "study/section/section_impl.h"

static iso_context *ctx;

enum { MOST = 400 };

static double fold(double turns)
{
    return fabs(turns - nearbyint(turns));
}

/* A curve around the axis, and one around (0.4, 0.1), that turn by `turns` in a wavy coordinate. */
static void make_circle(double z[MOST][2], double turns, bool around_axis)
{
    for (int i = 0; i < MOST; i++) {
        const double phase = 2 * M_PI * turns * i, wavy = phase + 0.3 * sin(phase) + 0.05 * cos(2 * phase);
        z[i][0] = around_axis ? remainder(wavy, 2 * M_PI) : 0.4 + 0.5 * cos(wavy);
        z[i][1] = around_axis ? 0.5 + 0.1 * sin(phase) : 0.1 + 0.2 * sin(wavy);
    }
}

/* As a function takes them. */
#define ALL(z) ((const double(*)[2])(const void *)(z))

static void test_circles(void)
{
    static const double turns[] = {0.6180339887498949, 0.123456789, 0.41421356237, -0.271828, 0.487, 0.0123};
    double z[MOST][2], mirror[MOST][2];
    for (size_t n = 0; n < sizeof turns / sizeof *turns; n++)
        for (int around = 0; around < 2; around++) {
            make_circle(z, turns[n], around);
            for (int i = 0; i < MOST; i++)
                mirror[i][0] = remainder(M_PI - z[i][0], 2 * M_PI), mirror[i][1] = -z[i][1];
            const double found = iso_section_rotation(ALL(z), MOST), again = iso_section_rotation(ALL(mirror), MOST);
            gsl_test(!(fabs(found - fold(turns[n])) < 1e-4), "%s: %g turns: %g",
                     around ? "about the axis" : "about a centre", turns[n], found);
            gsl_test(!(fabs(found - again) < 1e-9), "its mirror image: %g", again);
        }
    make_circle(z, turns[0], true);
    gsl_test(!isnan(iso_section_rotation(ALL(z), 23)), "too few crossings");
    for (int i = 0; i < MOST; i++) z[i][0] = remainder(1e4 * sin(i * i + 1), 2 * M_PI);
    gsl_test(!isnan(iso_section_rotation(ALL(z), MOST)), "dice have no number");
}

typedef struct kept {
    size_t count, first; /* first: the column l */
    double z[MOST][2];
} kept;

static iso_status keep_header(void *data, const iso_record *header)
{
    ((kept *)data)->first = (size_t)iso_record_find(header, "l");
    return ISO_OK;
}

static iso_status keep_row(void *data, const double row[], size_t count)
{
    kept *k = data;
    (void)count;
    if (k->count < MOST) memcpy(k->z[k->count++], row + k->first, sizeof *k->z);
    return ISO_OK;
}

static iso_scene scene_of(double k)
{
    char text[300];
    iso_scene scene = iso_scene_default();
    snprintf(text, sizeof text,
             "reduced: {k: %g, J: [1, 2, 5]}\ninitial: {normal: [0.36, 0.48, 0.8], angular_velocity: "
             "[0.9, -0.3, -0.225]}\ntime: {end: 1, step: 1}\n",
             k);
    gsl_test((int)iso_scene_parse(ctx, "test", text, strlen(text), &scene), "a scene");
    return scene;
}

static double rotation_of(const iso_scene *scene)
{
    kept k = {.count = 0};
    iso_section_options o = iso_section_defaults();
    iso_section_result result;
    const iso_section_sink sink = {.header = keep_header, .row = keep_row, .data = &k};
    o.crossings = MOST;
    gsl_test((int)iso_section_run(ctx, scene, &o, &sink, &result), "%s", iso_context_message(ctx));
    return iso_section_rotation(ALL(k.z), k.count);
}

/* While the ball swings once along the axis of the section, it turns about it by frequency 2 : frequency 1. */
static void test_frequencies(void)
{
    iso_scene scene = scene_of(-1);
    iso_frequencies_options o = iso_frequencies_defaults();
    iso_frequencies f;
    gsl_test((int)iso_frequencies_find(ctx, &scene, &o, &f), "%s", iso_context_message(ctx));
    const double found = rotation_of(&scene);
    gsl_test(!(fabs(found - fold(1 / f.rotation)) < 1e-6), "the closed solution: %.10g, by crossings %.10g",
             fold(1 / f.rotation), found);
    scene = scene_of(0.5);
    gsl_test(!isnan(rotation_of(&scene)), "a chaotic orbit has none");
}

int main(void)
{
    ctx = iso_context_create();
    test_circles();
    test_frequencies();
    iso_context_free(ctx);
    return gsl_test_summary();
}

/* iso_section_rotation: circles whose number is known, mirror images, the frequencies of the closed solution; chaos,
 * and too few crossings, have none. */
#include "instrument/frequencies/frequencies.h"
#include "instrument/section/section_impl.h"
#include "studies.h"

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

static double rotation_of(const iso_scene *scene)
{
    static double z[MOST][2];
    iso_record *tables[2] = {NULL, NULL};
    iso_section_options o = iso_section_defaults();
    iso_section_result result;
    o.crossings = MOST;
    must(iso_section_run(ctx, scene, &o, &(iso_sink){.data = NULL}, tables, &result), "a section");
    iso_record *record = tables[0];
    iso_record_free(tables[1]);
    for (size_t i = 0; i < iso_record_rows(record); i++)
        memcpy(z[i], iso_record_const_row(record, i) + iso_record_find(record, "l"), sizeof z[i]);
    const double rotation = iso_section_rotation(ALL(z), iso_record_rows(record));
    iso_record_free(record);
    return rotation;
}

/* While the ball swings once along the axis of the section, it turns about it by frequency 2 : frequency 1. */
static void test_frequencies(void)
{
    const double J[3] = {1, 2, 5};
    iso_scene scene = ball_scene(-1, J);
    iso_frequencies_options o = iso_frequencies_defaults();
    iso_frequencies f;
    must(iso_frequencies_find(ctx, &scene, &o, &f), "frequencies");
    const double found = rotation_of(&scene);
    gsl_test(!(fabs(found - fold(1 / f.ratio)) < 1e-6), "the closed solution: %.10g, by crossings %.10g",
             fold(1 / f.ratio), found);
    scene = ball_scene(0.5, J);
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

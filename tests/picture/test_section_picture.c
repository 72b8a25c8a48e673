/* test_section_picture.c - what the picture of a section draws: every crossing in its shade, images that are orbits of
 * the same return map, a window's rows and no others; and the same in an image. */
#include <gsl/gsl_math.h>

#include "instrument/chaos/chaos.h"
#include "instrument/section/section_impl.h"
#include "io/scene_file.h"
#include "laws.h"
#include "picture/section_impl.h"

static iso_context *ctx;

/* --- what is drawn ---------------------------------------------------------------------------------------------- */

static iso_scene make_scene_of(double k, const char *effects)
{
    char text[500];
    iso_scene scene = iso_scene_default();
    snprintf(text, sizeof text,
             "reduced: {k: %.17g, J: [1, 2, 5], D: 0.5}\ninitial: {normal: [0.36, 0.48, 0.8], angular_velocity: "
             "[0.9, -0.3, -0.225]}\ntime: {end: 1}\neffects: {%s}\n",
             k, effects);
    gsl_test((int)iso_scene_load_text(ctx, "test", text, strlen(text), &scene), "%s", iso_context_message(ctx));
    return scene;
}

static iso_scene make_scene(double k)
{
    return make_scene_of(k, "");
}

static iso_record *make_section(const iso_scene *scene, size_t starts, size_t crossings)
{
    iso_record *tables[2] = {NULL, NULL};
    iso_section_options o = iso_section_defaults();
    o.starts = starts;
    o.crossings = crossings;
    gsl_test((int)iso_section_run(ctx, scene, &o, &(iso_sink){.data = NULL}, tables, NULL), "%s",
             iso_context_message(ctx));
    iso_record_set_kind(tables[0], "section");
    iso_record_free(tables[1]);
    return tables[0];
}

static iso_picture make_picture(const iso_record *const table[], const char *options)
{
    iso_picture p;
    gsl_test((int)iso_picture_make(ctx, table, options, &p), "%s", iso_context_message(ctx));
    return p;
}

static double number_of(const iso_picture *p, const char *key)
{
    const char *text = iso_record_get(p->table[0], key);
    return text ? strtod(text, NULL) : NAN;
}

/* A point (l, x) on a side, by the formulas of the theory: n ~ J^(1/2) gamma, omega ~ J^(-1/2) M. */
static void place(const iso_params *p, double eps, int a, bool ball, double l, double x, double at[2])
{
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    double gamma[3], omega[3];
    const double M[3] = {sqrt(1 - x * x) * sin(l), sqrt(1 - x * x) * cos(l), x};
    const double q = p->J[b] * cos(l) * cos(l) + p->J[c] * sin(l) * sin(l);
    gamma[0] = sqrt(p->J[b]) * cos(l), gamma[1] = sqrt(p->J[c]) * sin(l);
    omega[0] = M[0] / sqrt(p->J[b]), omega[1] = M[1] / sqrt(p->J[c]), omega[2] = M[2] / sqrt(p->J[a]);
    const double size = sqrt(omega[0] * omega[0] + omega[1] * omega[1] + omega[2] * omega[2]);
    at[0] = ball ? atan2(gamma[1], gamma[0]) : l;
    at[1] = ball ? copysign(1, p->k) * omega[2] / size : x * sqrt(2 * eps * pow(q, -1 / p->k));
}

/* The shade of the spot nearest to a place, and how far it is, in cells. */
static int shade_near(const iso_picture *p, const char *side, const double at[2], double *cells)
{
    char x0[32], x1[32], y0[32], y1[32];
    const iso_record *r = iso_picture_table(p, side);
    int shade = -1;
    snprintf(x0, sizeof x0, "%s_x0", side), snprintf(x1, sizeof x1, "%s_x1", side);
    snprintf(y0, sizeof y0, "%s_y0", side), snprintf(y1, sizeof y1, "%s_y1", side);
    const double wide = number_of(p, x1) - number_of(p, x0), high = number_of(p, y1) - number_of(p, y0);
    *cells = INFINITY;
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double *row = iso_record_const_row(r, i);
        const double d = ISO_PICTURE_CELLS * fmax(fabs(row[0] - at[0]) / wide, fabs(row[1] - at[1]) / high);
        if (d < *cells) *cells = d, shade = (int)row[2];
    }
    return shade;
}

/* --- laws ------------------------------------------------------------------------------------------------------- */

/* The verdicts of chaos as a table: each of a first crossing of an orbit. */
static iso_record *make_verdicts(const iso_record *section, const char *const verdict[], size_t orbits)
{
    iso_record *r;
    gsl_test((int)iso_record_create(ctx, 3, (const char *[]){"l", "x", "verdict"}, &r), "a record");
    iso_record_set_kind(r, "chaos");
    iso_record_set_words(r, 2, true);
    for (size_t i = 0, orbit = 0; i < iso_record_rows(section) && orbit < orbits; i++) {
        double row[3];
        if (iso_picture_number(section, i, "orbit") != (double)orbit) continue;
        row[0] = iso_picture_number(section, i, "l"), row[1] = iso_picture_number(section, i, "x");
        iso_record_intern(ctx, r, verdict[orbit % 3], &row[2]);
        iso_record_add(ctx, r, 1, row);
        orbit++;
    }
    return r;
}

/* Every crossing has a spot of its orbit's shade in its cell, unless one of another shade that lies before it. */
static void test_shades(void)
{
    static const char *const verdict[] = {"chaotic", "regular", "undecided"};
    static const int shade_of[] = {ISO_PICTURE_GREY, ISO_PICTURE_COLOURED, ISO_PICTURE_DARK};
    iso_scene scene = make_scene(-1);
    iso_record *section = make_section(&scene, 5, 40), *chaos = make_verdicts(section, verdict, 6);
    iso_picture p = make_picture((const iso_record *[]){section, chaos, NULL}, NULL);
    double eps;
    iso_status status;
    iso_record_get_numbers(ctx, section, "eps", 1, &eps, &status);
    size_t hidden = 0;
    for (size_t i = 0; i < iso_record_rows(section); i++)
        for (int ball = 0; ball < 2; ball++) {
            double at[2], cells;
            const int wanted = shade_of[(int)iso_picture_number(section, i, "orbit") % 3];
            place(&scene.params, eps, iso_picture_axis(section), ball, iso_picture_number(section, i, "l"),
                  iso_picture_number(section, i, "x"), at);
            const int shade = shade_near(&p, ball ? "ball" : "point", at, &cells);
            /* a regular orbit is dark if it has no rotation number */
            const bool same = shade == wanted || (wanted == ISO_PICTURE_COLOURED && shade == ISO_PICTURE_DARK);
            gsl_test(!(cells <= 1), "%s: crossing %zu is %g cells from its spot", ball ? "ball" : "point", i, cells);
            hidden += !same;
        }
    gsl_test(hidden * 20 > iso_record_rows(section), "%zu crossings are hidden", hidden);
    gsl_test(strcmp(iso_record_get(p.table[0], "grey_means"), "chaotic") != 0, "the key");
    iso_picture_free(&p);
    iso_record_free(section);
    iso_record_free(chaos);
}

/* The images of an orbit's crossings are crossings of one orbit of the same return map: their rotation number is the
 * same. */
static void test_images(void)
{
    iso_scene scene = make_scene(-1);
    iso_record *section = make_section(&scene, 0, 400);
    const size_t rows = iso_record_rows(section);
    double(*z)[2] = malloc(rows * sizeof *z);
    double first = NAN;
    for (int n = 0; z && n < 8; n++) {
        for (size_t i = 0; i < rows; i++) { /* a reversor turns the orbit's order */
            const size_t from = (n & 1) != (n >> 2 & 1) ? rows - 1 - i : i;
            iso_picture_image(n, iso_picture_number(section, from, "l"), iso_picture_number(section, from, "x"),
                              z[i]);
            gsl_test(!(fabs(z[i][0]) <= M_PI && fabs(z[i][1]) < 1), "image %d is on the section", n);
        }
        const double rotation = iso_section_rotation((const double(*)[2])z, rows);
        if (n == 0) first = rotation;
        gsl_test(!(fabs(rotation - first) <= 1e-9), "image %d: rotation number %.12g, not %.12g", n, rotation, first);
    }
    free(z);
    iso_picture p = make_picture((const iso_record *[]){section, NULL}, NULL);
    const iso_record *ball = iso_picture_table(&p, "ball");
    for (size_t i = 0; i < iso_record_rows(ball); i++)
        gsl_test(!(fabs(iso_picture_number(ball, i, "colour") - first) <= 1e-9), "spot %zu has this colour", i);
    gsl_test(iso_record_rows(ball) < rows, "there are images");
    iso_picture_free(&p);
    iso_record_free(section);
}

/* A window keeps the spots inside, and no others. */
static void test_window(void)
{
    iso_scene scene = make_scene(0.5);
    iso_record *section = make_section(&scene, 20, 60);
    iso_picture whole = make_picture((const iso_record *[]){section, NULL}, NULL),
                part = make_picture((const iso_record *[]){section, NULL}, "window=-0.5:0.9,-0.3:0.4");
    const iso_record *all = iso_picture_table(&whole, "point"), *kept = iso_picture_table(&part, "point");
    const double left = number_of(&part, "point_x0"), right = number_of(&part, "point_x1"),
                 low = number_of(&part, "point_y0"), high = number_of(&part, "point_y1");
    gsl_test(!(fabs(left + 0.5) <= 1e-14 && fabs(right - 0.9) <= 1e-14), "the window");
    for (size_t i = 0; i < iso_record_rows(kept); i++) {
        const double *row = iso_record_const_row(kept, i);
        gsl_test(!(row[0] >= left && row[0] <= right && row[1] >= low && row[1] <= high), "spot %zu is inside", i);
    }
    size_t inside = 0;
    for (size_t i = 0; i < iso_record_rows(all); i++) {
        const double *row = iso_record_const_row(all, i);
        double cells;
        if (!(row[0] > left && row[0] < right && row[1] > low && row[1] < high)) continue;
        inside++;
        shade_near(&part, "point", row, &cells);
        gsl_test(!(cells <= 1), "a spot inside is kept: %g cells", cells);
    }
    gsl_test(inside == 0 || iso_record_rows(kept) < inside, "%zu spots inside, %zu kept", inside,
             iso_record_rows(kept));
    iso_picture_free(&whole);
    iso_picture_free(&part);
    iso_record_free(section);
}

/* An image has the colour of each spot in its cell. */
static void test_image(void)
{
    iso_scene scene = make_scene(0.5);
    iso_record *section = make_section(&scene, 10, 60);
    iso_picture spots = make_picture((const iso_record *[]){section, NULL}, NULL),
                image = make_picture((const iso_record *[]){section, NULL}, "points=10");
    const iso_record *list = iso_picture_table(&spots, "ball"), *cells = iso_picture_table(&image, "ball");
    size_t empty = 0;
    gsl_test(number_of(&image, "images") != 1 || number_of(&spots, "images") != 0, "which is the image");
    gsl_test(iso_record_rows(cells) != ISO_PICTURE_CELLS || iso_record_columns(cells) != ISO_PICTURE_CELLS,
             "its size");
    for (size_t i = 0; i < iso_record_rows(list); i++) {
        const double *row = iso_record_const_row(list, i);
        const double u = ISO_PICTURE_CELLS * (row[0] + M_PI) / (2 * M_PI), v = ISO_PICTURE_CELLS * (row[1] + 1) / 2;
        const int x = GSL_MIN_INT((int)u, ISO_PICTURE_CELLS - 1), y = GSL_MIN_INT((int)v, ISO_PICTURE_CELLS - 1);
        empty += iso_record_const_row(cells, (size_t)y)[x] == ISO_PICTURE_CELL_EMPTY;
    }
    gsl_test(empty != 0, "%zu spots are missing in the image", empty);
    iso_picture_free(&spots);
    iso_picture_free(&image);
    iso_record_free(section);
}

static size_t count_grey(const iso_record *const table[])
{
    iso_picture p = make_picture(table, NULL);
    const iso_record *ball = iso_picture_table(&p, "ball");
    size_t grey = 0;
    for (size_t i = 0; i < iso_record_rows(ball); i++)
        grey += iso_picture_number(ball, i, "shade") == ISO_PICTURE_GREY;
    iso_picture_free(&p);
    return grey;
}

/* An orbit on which ball and point part is grey. */
static void test_pairs(void)
{
    enum { CROSSINGS = 400 };
    iso_scene scene = make_scene(-1);
    iso_record *section = make_section(&scene, 1, CROSSINGS), *point = make_section(&scene, 1, CROSSINGS);
    const size_t before = count_grey((const iso_record *[]){section, point, NULL});
    iso_record_row(point, 0)[iso_record_find(point, "x")] += 0.01; /* of orbit 0 */
    const size_t grey = count_grey((const iso_record *[]){section, point, NULL}) - before;
    gsl_test(grey < CROSSINGS / 4 || grey > CROSSINGS, "%zu spots are grey", grey);
    iso_record_free(section);
    iso_record_free(point);
}

/* All three reversors hold without a rotor, two with K along axis 1, none with another: more mirrors, more images. */
static void test_mirrors(void)
{
    static const char *const momentum[] = {"0.001, 0.001, 0.001", "0.001, 0, 0", "0, 0, 0"};
    size_t last = 0;
    for (int i = 0; i < 3; i++) {
        char effects[80];
        snprintf(effects, sizeof effects, "rotor: {momentum: [%s]}", momentum[i]);
        iso_scene scene = make_scene_of(1, effects);
        iso_record *section = make_section(&scene, 3, 100);
        iso_picture p = make_picture((const iso_record *[]){section, NULL}, NULL);
        const size_t spots = iso_record_rows(iso_picture_table(&p, "ball"));
        gsl_test(2 * spots < 3 * last || spots == 0, "K = %s: %zu spots behind %zu", momentum[i], spots, last);
        last = spots;
        iso_picture_free(&p);
        iso_record_free(section);
    }
}

int main(void)
{
    ctx = iso_context_create();
    test_shades();
    test_images();
    test_mirrors();
    test_window();
    test_image();
    test_pairs();
    iso_context_free(ctx);
    return gsl_test_summary();
}

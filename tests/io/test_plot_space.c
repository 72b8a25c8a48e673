/* test_plot_space.c - pictures of a path in space: the frame of the views, what is marked, what is not assumed;
 * ticks. Private functions of the library are tested. gnuplot is replaced by a script that keeps its input. */
#include <math.h>

#include "base/random_impl.h"
#include "base/vec3_impl.h"
#include "folder.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

static iso_context *ctx;
static const char *script = ""; /* what the false gnuplot was given */

/* Puts the false gnuplot in front of the true one. read_script() reads what it was given. */
static void replace_gnuplot(void)
{
    char search[9000], body[400];
    snprintf(body, sizeof body, "cat >%s/script\necho '<svg></svg>'", folder);
    put_gnuplot(in_folder("gnuplot"), body);
    snprintf(search, sizeof search, "%s:%s", folder, getenv("PATH") ? getenv("PATH") : "");
    setenv("PATH", search, 1);
}

static const char *read_script(void)
{
    return script = file_text(in_folder("script"));
}

/* --- records ---------------------------------------------------------------------------------------------------- */

enum { T, CENTRE, CONTACT = CENTRE + 3, PRESSURE = CONTACT + 3, MU, COLUMNS };
static const char *const all_names[] = {"t",        "centre1",  "centre2",  "centre3", "contact1",
                                        "contact2", "contact3", "pressure", "mu"};

/* A ball of radius 0.2 on the outside of a sphere of radius 1: contact = n, centre = 1.2 n. */
static iso_record *make_sphere(size_t rows)
{
    iso_record *r;
    double *row;
    if (iso_record_create(ctx, COLUMNS, all_names, &r) != ISO_OK) exit(1);
    for (size_t i = 0; i < rows; i++) {
        const double a = 0.05 * (double)i, b = 0.9 * sin(0.31 * a);
        const double n[3] = {cos(a) * cos(b), sin(a) * cos(b), sin(b)};
        if (iso_record_append(ctx, r, &row) != ISO_OK) exit(1);
        row[T] = 0.1 * (double)i;
        for (int c = 0; c < 3; c++) row[CONTACT + c] = n[c], row[CENTRE + c] = 1.2 * n[c];
        row[PRESSURE] = 1 - 0.01 * (double)i;
        row[MU] = 0.1;
    }
    return r;
}

/* A ball of radius 0.5 on a plane through 0: it rolls along `way`, and swings across. */
static iso_record *make_plane(size_t rows, const double normal[3], const double way[3], double swing)
{
    iso_record *r;
    double *row, across[3];
    cross(normal, way, across);
    if (iso_record_create(ctx, COLUMNS, all_names, &r) != ISO_OK) exit(1);
    for (size_t i = 0; i < rows; i++) {
        const double x = 0.1 * (double)i, y = swing * sin(x);
        if (iso_record_append(ctx, r, &row) != ISO_OK) exit(1);
        row[T] = x, row[PRESSURE] = 1;
        for (int c = 0; c < 3; c++) {
            row[CONTACT + c] = x * way[c] + y * across[c];
            row[CENTRE + c] = row[CONTACT + c] + 0.5 * normal[c];
        }
    }
    return r;
}

static iso_plot_scenery look(const iso_record *r, const double *up, bool plane)
{
    iso_plot_scenery s;
    const iso_plot_space space = {r, up, plane};
    gsl_test((int)iso_plot_look_around(ctx, &space, &s), "%s", iso_context_message(ctx));
    return s;
}

/* --- the frame of the views ------------------------------------------------------------------------------------- */

/* right, away, up are a right-handed orthonormal frame, and up is up. */
static double off_frame(const iso_plot_scenery *s, const double up[3])
{
    double away[3], worst = 0;
    cross(s->up, s->right, away);
    for (int c = 0; c < 3; c++) worst = fmax(worst, fmax(fabs(away[c] - s->away[c]), fabs(s->up[c] - up[c])));
    return fmax(worst, fmax(fabs(norm(s->right) - 1), fabs(dot(s->right, s->up))));
}

static void test_frames(void)
{
    static const double axis_3[3] = {0, 0, 1}, along[3] = {1, 0, 0}, tilted[3] = {0.6, 0, 0.8},
                        steep[3] = {0.8, 0, -0.6};
    iso_random *random = iso_random_create(11);
    iso_record *r = make_sphere(300);
    for (int i = 0; i < 40; i++) {
        double up[3];
        iso_random_direction(random, up);
        if (i == 0) copy((double[]){1, 0, 0}, up, 3);
        if (i == 1) copy((double[]){0, 0, -1}, up, 3);
        const iso_plot_scenery s = look(r, up, false);
        gsl_test(!(off_frame(&s, up) <= 1e-15), "the frame of view %d: %.2g", i, off_frame(&s, up));
        gsl_test(!(fabs(s.support - 1) <= 1e-15 && fabs(s.ball - 0.2) <= 1e-15), "both radii");
        gsl_test(!strstr(s.from_above, "from above") || strcmp(s.up_name, "height") != 0, "up is called up");
    }
    iso_plot_scenery s = look(r, axis_3, false);
    gsl_test(s.right[0] != 1 || s.away[1] != 1 || strcmp(s.up_name, "height (axis 3)") != 0,
             "axes of space as they are");
    s = look(r, NULL, false);
    gsl_test(s.vertical || strstr(s.from_above, "above") || strstr(s.up_name, "height") || s.up[2] != 1,
             "what is not known to be up is not called so: %s, %s", s.from_above, s.up_name);
    iso_record_free(r);
    r = make_plane(100, tilted, steep, 0.1);
    s = look(r, axis_3, true);
    gsl_test(s.level || !(off_frame(&s, axis_3) <= 1e-15) || !(s.right[0] > 0.999), "down the slope is on the right");
    s = look(r, NULL, true);
    gsl_test(!s.level || !(off_frame(&s, tilted) <= 1e-15) || strstr(s.from_above, "above"),
             "up not known: the plane's normal");
    iso_record_free(r);
    /* the path of the contact alone does not tell the normal */
    iso_record *contact = make_plane(100, tilted, steep, 0.1), *place;
    if (iso_record_create(ctx, 3, all_names + CONTACT, &place) != ISO_OK) exit(1);
    for (size_t i = 0; i < 100; i++) {
        double *to;
        if (iso_record_append(ctx, place, &to) != ISO_OK) exit(1);
        copy(iso_record_const_row(contact, i) + CONTACT, to, 3);
    }
    s = look(place, NULL, true);
    gsl_test(s.level || s.normal || strstr(s.from_above, "normal") || s.up[2] != 1, "no normal: %s", s.from_above);
    iso_record_free(contact);
    iso_record_free(place);
    r = make_plane(100, axis_3, along, 0.1);
    s = look(r, axis_3, true);
    gsl_test(!s.level || !iso_plot_is_narrow(&s) || !strstr(s.from_above, "scale across it is larger"),
             "a narrow path says so");
    iso_record_free(r);
    r = make_plane(100, axis_3, along, 5);
    s = look(r, axis_3, true);
    gsl_test(iso_plot_is_narrow(&s) || strstr(s.from_above, "scale across it is larger"), "a wide path does not");
    iso_record_free(r);
    iso_random_free(random);
}

/* No support is drawn if the places are not all equally far from 0, or if only the centre is known. */
static void test_unknown_support(void)
{
    iso_record *r = make_sphere(50);
    iso_record_row(r, 30)[CONTACT] *= 1.01;
    iso_plot_scenery s = look(r, NULL, false);
    gsl_test(s.support != 0 || s.ball != 0, "no sphere, no ball");
    iso_record_free(r);
    if (iso_record_create(ctx, 3, all_names + CENTRE, &r) != ISO_OK) exit(1);
    double *row;
    if (iso_record_append(ctx, r, &row) != ISO_OK) exit(1);
    row[0] = 1;
    s = look(r, NULL, false);
    gsl_test(s.support != 0 || s.ball != 0 || s.contact >= 0 || s.losses != 0, "of a centre nothing else is known");
    iso_record_free(r);
}

/* --- loss of contact -------------------------------------------------------------------------------------------- */

static void test_losses(void)
{
    size_t lost[ISO_PLOT_MARKS];
    iso_record *r = make_sphere(100);
    gsl_test(iso_plot_losses(r, lost) != 0, "pressed all the time");
    iso_record_row(r, 99)[PRESSURE] = 1e-15;
    gsl_test(iso_plot_losses(r, lost) != 1 || lost[0] != 99, "a run that ends where contact is lost");
    for (int i = 40; i < 60; i++) iso_record_row(r, (size_t)i)[PRESSURE] = -1;
    gsl_test(iso_plot_losses(r, lost) != 2 || lost[0] != 40 || lost[1] != 99, "a support that pulls for a while");
    for (int i = 0; i < 100; i++) iso_record_row(r, (size_t)i)[PRESSURE] = i % 2 ? -1 : 1;
    gsl_test(iso_plot_losses(r, lost) != ISO_PLOT_MARKS, "no more than there is room for");
    iso_record_free(r);
}

/* --- the picture ------------------------------------------------------------------------------------------------ */

/* The numbers of the n-th block of data called `name`, x and y side by side; how many pairs. */
static int read_block(const char *name, int n, double xy[][2], int most)
{
    char head[64];
    int count = 0;
    snprintf(head, sizeof head, "$%s << EOD\n", name);
    const char *at = read_script();
    for (; n >= 0 && at; n--) {
        at = strstr(at, head);
        if (at) at += strlen(head);
    }
    for (; at && strncmp(at, "EOD", 3) != 0 && count < most; at = strchr(at, '\n') + 1)
        if (*at != '\n' && sscanf(at, "%lf %lf", &xy[count][0], &xy[count][1]) == 2 && isfinite(xy[count][0]))
            count++;
    return count;
}

static iso_status draw(const iso_plot_orbit *plot)
{
    const char *path = in_folder("a.svg");
    const iso_status status = iso_plot_trajectory(ctx, &(iso_plot_page){.path = path}, plot);
    unlink(path);
    return status;
}

/* The two views are two projections of one place: |from above|^2 + height^2 = |centre|^2, and with axis 3 up they are
 * columns of the file. */
static void test_views(void)
{
    enum { ROWS = 200 };
    static const double axis_3[3] = {0, 0, 1}, other[3] = {0.48, -0.6, 0.64};
    static double above[2][2 * ROWS][2], side[2][2 * ROWS][2];
    iso_record *r = make_sphere(ROWS);
    for (size_t i = 0; i < ROWS; i++) /* inside: nothing is hidden */
        for (int c = 0; c < 3; c++) iso_record_row(r, i)[CENTRE + c] *= 0.8 / 1.2;
    for (int which = 0; which < 2; which++) {
        const iso_plot_space space = {r, which ? other : axis_3, false};
        gsl_test((int)draw(&(iso_plot_orbit){.title = "views", .space = &space}), "%s", iso_context_message(ctx));
        const int a = read_block("way1", 0, above[which], 2 * ROWS), b = read_block("way1", 1, side[which], 2 * ROWS);
        gsl_test(a != ROWS || b != ROWS, "all rows in both views: %d %d", a, b);
        double worst = 0, off = 0;
        for (size_t i = 0; i < ROWS; i++) {
            const double *x = iso_record_const_row(r, i) + CENTRE, *p = above[which][i], height = side[which][i][1];
            worst = fmax(worst, fabs(p[0] * p[0] + p[1] * p[1] + height * height - dot(x, x)));
            off = fmax(off, fabs(height - dot(x, space.up)));
            if (which == 0) off = fmax(off, fmax(fabs(p[0] - x[0]), fabs(p[1] - x[1])));
        }
        gsl_test(!(worst <= 1e-14), "two projections of one place: %.2g", worst);
        gsl_test(!(off <= 1e-15), "the height is up: %.2g", off);
        gsl_test(!strstr(script, "object 1 circle at 0,0 size 1 "), "the support");
        gsl_test(!strstr(script, "size 0.1999999") && !strstr(script, "size 0.2"), "the ball");
    }
    iso_record_free(r);
}

static void test_marks(void)
{
    iso_record *r = make_sphere(150);
    const iso_plot_space space = {r, NULL, false};
    const iso_plot_orbit plot = {.title = "marks", .space = &space};
    gsl_test((int)draw(&plot), "%s", iso_context_message(ctx));
    read_script();
    gsl_test(!strstr(script, "title 'pressure 0'") || !strstr(script, "front point " ISO_PLOT_LOST),
             "no pressure at row 100, and rows behind it");
    gsl_test(!strstr(script, "title 'end'"), "and there is an end");
    for (size_t i = 0; i < 150; i++) iso_record_row(r, i)[PRESSURE] = i < 149 ? 1 : 0;
    gsl_test((int)draw(&plot), "%s", iso_context_message(ctx));
    read_script();
    gsl_test(!strstr(script, "title 'contact lost'") || strstr(script, "title 'end'"), "lost at the end");
    iso_record_row(r, 149)[PRESSURE] = 1;
    gsl_test((int)draw(&plot), "%s", iso_context_message(ctx));
    gsl_test(strstr(read_script(), "contact lost") != NULL, "never lost");
    iso_record_free(r);
}

/* Drifts that are rounding are a line of text. */
static void test_noise(void)
{
    static const char *const names[] = {"t", "h"}, *const path[] = {"n1", "n2", "n3"};
    iso_record *drift, *n;
    double *row;
    if (iso_record_create(ctx, 2, names, &drift) != ISO_OK || iso_record_create(ctx, 3, path, &n) != ISO_OK) exit(1);
    for (int i = 0; i < 9; i++) {
        if (iso_record_append(ctx, drift, &row) != ISO_OK) exit(1);
        row[0] = i, row[1] = 1e-16 * i;
        if (iso_record_append(ctx, n, &row) != ISO_OK) exit(1);
        row[0] = cos(0.1 * i), row[1] = sin(0.1 * i);
    }
    const iso_plot_orbit plot = {.title = "noise", .ball = n, .drift = drift};
    gsl_test((int)draw(&plot), "%s", iso_context_message(ctx));
    read_script();
    gsl_test(!strstr(script, "up to rounding") || !strstr(script, "no drift above 8e-16 of h\"") ||
                 strstr(script, "$difference"),
             "noise is text");
    iso_record_row(drift, 5)[1] = 1e-12;
    gsl_test((int)draw(&plot), "%s", iso_context_message(ctx));
    read_script();
    gsl_test(strstr(script, "up to rounding") || !strstr(script, "$difference1") ||
                 !strstr(script, "'≤10^{-17}' 1e-17"),
             "a drift is a chart, whose lowest tick says what it is");
    gsl_test(strstr(script, "or less than") != NULL, "no words in the chart");
    iso_record_free(drift);
    iso_record_free(n);
}

/* --- what is refused -------------------------------------------------------------------------------------------- */

static void test_refused(void)
{
    static const double bad[] = {NAN, INFINITY}, long_up[3] = {0, 0, 1.01}, nan_up[3] = {NAN, 0, 1};
    iso_plot_scenery s;
    iso_record *r = make_sphere(10), *none = make_sphere(0);
    gsl_test(iso_plot_look_around(ctx, &(iso_plot_space){r, long_up, false}, &s) != ISO_BAD_ARGUMENT, "up too long");
    gsl_test(iso_plot_look_around(ctx, &(iso_plot_space){r, nan_up, false}, &s) != ISO_BAD_ARGUMENT, "up no number");
    gsl_test(iso_plot_look_around(ctx, &(iso_plot_space){none, NULL, false}, &s) != ISO_BAD_ARGUMENT, "no rows");
    for (int i = 0; i < 4; i++) {
        double *x = iso_record_row(r, 7) + (i < 2 ? CENTRE + 1 : CONTACT + 2), kept = *x;
        *x = bad[i % 2];
        gsl_test(iso_plot_look_around(ctx, &(iso_plot_space){r, NULL, false}, &s) != ISO_NUMERICAL ||
                     strcmp(iso_context_about(ctx), i < 2 ? "centre2" : "contact3") != 0,
                 "not finite: %s", iso_context_message(ctx));
        *x = kept;
    }
    iso_record_free(r);
    if (iso_record_create(ctx, 3, all_names, &r) != ISO_OK) exit(1);
    gsl_test(iso_plot_look_around(ctx, &(iso_plot_space){r, NULL, false}, &s) != ISO_BAD_ARGUMENT, "no columns");
    iso_record_free(r);
    iso_record_free(none);
    gsl_test(draw(&(iso_plot_orbit){.title = "nothing"}) != ISO_BAD_ARGUMENT, "nothing to draw");
}

/* --- ticks ------------------------------------------------------------------------------------------------------ */

/* The ticks between low and high are at most 2 most + 1, each with its own short label in the range. */
static void test_ticks(void)
{
    static const struct {
        double low, high;
        const char *name, *some;
    } list[] = {{0, 10, "t", "'4' 4"},
                {0, 1e6, "t / 10⁶", "'0.4' 400000"},
                {0, 1e-5, "t / 10⁻⁵", "'0.4' "},
                {-0.3, 0.3, "t", "'−0.2' "},
                {1e9, 1e9 + 10, "t − 1000000000", "'4' 1000000004"},
                {-1e9, -1e9 + 10, "t + 1000000000", "'4' "},
                {1e6, 1e6 + 1e-3, "(t − 1000000) / 10⁻³", "'0.4' "},
                {0, 0, "t", "'0.0' 0"},
                {5, 5, "t", "'6' 6"},
                {0, 1e-280, "t / 10⁻²⁸⁰", "'0.4' "},
                {0, 1e299, "t / 10²⁹⁹", "'0.4' "}};
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        char name[ISO_PLOT_NAME], text[4000] = "";
        FILE *file = tmpfile();
        const iso_plot_axis axis = {"x", list[i].low, list[i].high, 5, "t", true};
        iso_plot_ticks(file, &axis, name);
        rewind(file);
        text[fread(text, 1, sizeof text - 1, file)] = '\0';
        fclose(file);
        int ticks = 0;
        for (const char *c = strchr(text, '('); c && *c != '\n'; c++) ticks += *c == '\'';
        gsl_test(strcmp(name, list[i].name) != 0, "from %g to %g: '%s'", list[i].low, list[i].high, name);
        gsl_test(ticks < 6 || ticks > 22 || !strstr(text, list[i].some), "%d ticks: %s", ticks / 2,
                 strstr(text, "tics"));
    }
}

int main(void)
{
    ctx = iso_context_create();
    if (!ctx || !mkdtemp(folder)) return 1;
    test_frames();
    test_unknown_support();
    test_losses();
    test_refused();
    test_ticks();
    replace_gnuplot();
    test_views();
    test_marks();
    test_noise();
    unlink(in_folder("gnuplot"));
    unlink(in_folder("script"));
    gsl_test(rmdir(folder) != 0, "an empty folder remains");
    iso_context_free(ctx);
    return gsl_test_summary();
}

/* test_picture_space.c - pictures of a path in space: the frame of the views, what is marked, what is not assumed.
 * Private functions of the library are tested. */
#include "laws.h"
#include "picture/picture_impl.h"

static iso_context *ctx;

/* --- records ---------------------------------------------------------------------------------------------------- */

enum { T, CENTRE, CONTACT = CENTRE + 3, PRESSURE = CONTACT + 3, MU, COLUMNS };
static const char *const all_names[] = {"t",        "centre1",  "centre2",  "centre3", "contact1",
                                        "contact2", "contact3", "pressure", "mu"};

static iso_record *make_record(size_t columns, const char *const names[])
{
    iso_record *r;
    if (iso_record_create(ctx, columns, names, &r) != ISO_OK) exit(1);
    return r;
}

static double *add_row(iso_record *r)
{
    double *row;
    if (iso_record_append(ctx, r, &row) != ISO_OK) exit(1);
    return row;
}

/* A ball of radius 0.2 on the outside of a sphere of radius 1: contact = n, centre = 1.2 n. */
static iso_record *make_sphere(size_t rows)
{
    iso_record *r = make_record(COLUMNS, all_names);
    for (size_t i = 0; i < rows; i++) {
        const double a = 0.05 * (double)i, b = 0.9 * sin(0.31 * a);
        const double n[3] = {cos(a) * cos(b), sin(a) * cos(b), sin(b)};
        double *row = add_row(r);
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
    iso_record *r = make_record(COLUMNS, all_names);
    double across[3];
    cross(normal, way, across);
    for (size_t i = 0; i < rows; i++) {
        const double x = 0.1 * (double)i, y = swing * sin(x);
        double *row = add_row(r);
        row[T] = x, row[PRESSURE] = 1;
        for (int c = 0; c < 3; c++) {
            row[CONTACT + c] = x * way[c] + y * across[c];
            row[CENTRE + c] = row[CONTACT + c] + 0.5 * normal[c];
        }
    }
    return r;
}

/* --- pictures --------------------------------------------------------------------------------------------------- */

static iso_picture picture;

static iso_status make(const iso_record *r, const double *up, bool plane)
{
    iso_picture_free(&picture);
    if (iso_picture_add_curves(ctx, &picture) != ISO_OK) exit(1); /* whose first table has the lines */
    return iso_picture_space(ctx, r, up, plane, &picture);
}

static void look(const iso_record *r, const double *up, bool plane)
{
    gsl_test((int)make(r, up, plane), "%s", iso_context_message(ctx));
}

static const char *line(const char *key)
{
    const char *text = iso_record_get(picture.table[0], key);
    return text ? text : "none";
}

static bool says(const char *key, const char *words)
{
    return strstr(line(key), words);
}

static double number(const char *key)
{
    return strtod(line(key), NULL);
}

/* right, away, up of a row of the path */
static const double *seen(size_t row)
{
    return iso_record_const_row(iso_picture_table(&picture, "path"), row) + 1;
}

/* The rows of the path with this word. */
static size_t count_of(const char *table, const char *column, const char *word)
{
    const iso_record *r = iso_picture_table(&picture, table);
    size_t count = 0;
    for (size_t i = 0; i < iso_record_rows(r); i++) count += iso_picture_is(r, i, column, word);
    return count;
}

/* --- the frame of the views ------------------------------------------------------------------------------------- */

static double volume(const double a[3], const double b[3], const double c[3])
{
    double normal[3];
    cross(a, b, normal);
    return dot(normal, c);
}

/* A right-handed orthonormal frame keeps products and volumes; up is up. The rows are in their order, from the inside
 * of a bowl, where nothing is hidden.*/
static void test_frames(void)
{
    enum { ROWS = 150 };
    iso_random *random = iso_random_create(11);
    iso_record *r = make_sphere(ROWS);
    for (size_t i = 0; i < ROWS; i++)
        for (int c = 0; c < 3; c++) iso_record_row(r, i)[CENTRE + c] *= 0.8 / 1.2;
    for (int k = 0; k < 40; k++) {
        double up[3], worst = 0;
        iso_random_direction(random, up);
        if (k == 0) copy((double[]){1, 0, 0}, up, 3);
        if (k == 1) copy((double[]){0, 0, -1}, up, 3);
        look(r, up, false);
        gsl_test(count_of("path", "of", "centre") != ROWS || count_of("path", "of", "contact") != ROWS, "all rows");
        for (size_t i = 2; i < ROWS; i++) {
            const double *x[3], *y[3];
            for (size_t j = 0; j < 3; j++) x[j] = iso_record_const_row(r, i - j) + CENTRE, y[j] = seen(i - j);
            for (int j = 0; j < 3; j++) worst = fmax(worst, fabs(dot(x[0], x[j]) - dot(y[0], y[j])));
            worst = fmax(worst, fabs(volume(x[0], x[1], x[2]) - volume(y[0], y[1], y[2])));
            worst = fmax(worst, fabs(y[0][2] - dot(x[0], up)));
        }
        gsl_test(!(worst <= 1e-15), "the frame of view %d: %.2g", k, worst);
        gsl_test(!(fabs(number("support") - 1) <= 1e-15 && fabs(number("ball") - 0.2) <= 1e-15), "both radii");
        gsl_test(!says("above", "from above") || strcmp(line("up_name"), "height") != 0, "up is called up");
    }
    look(r, (double[]){0, 0, 1}, false);
    double off = 0;
    for (size_t i = 0; i < ROWS; i++)
        for (int c = 0; c < 3; c++) off = fmax(off, fabs(seen(i)[c] - iso_record_const_row(r, i)[CENTRE + c]));
    gsl_test(off != 0 || strcmp(line("up_name"), "height (axis 3)") != 0, "axes of space as they are");
    look(r, NULL, false);
    gsl_test(says("above", "from above") || says("up_name", "height") ||
                 seen(9)[2] != iso_record_const_row(r, 9)[CENTRE + 2],
             "what is not known to be up is not called so: %s, %s", line("above"), line("up_name"));
    iso_record_free(r);
    iso_random_free(random);
}

static void test_planes(void)
{
    static const double axis_3[3] = {0, 0, 1}, along[3] = {1, 0, 0}, tilted[3] = {0.6, 0, 0.8},
                        steep[3] = {0.8, 0, -0.6};
    iso_record *r = make_plane(100, tilted, steep, 0.1);
    look(r, axis_3, true);
    gsl_test(!says("right_name", "down the slope") || !(seen(9)[0] > seen(0)[0]) ||
                 !(fabs(number("slope") + 0.75) < 1e-12),
             "down the slope is on the right: %s", line("slope"));
    look(r, NULL, true);
    gsl_test(strcmp(line("side"), "") != 0 || says("above", "from above") || !says("above", "normal"),
             "up not known: the plane's normal");
    iso_record *place = make_record(3, all_names + CONTACT); /* the contact alone does not tell the normal */
    for (size_t i = 0; i < 100; i++) copy(iso_record_const_row(r, i) + CONTACT, add_row(place), 3);
    look(place, NULL, true);
    gsl_test(says("above", "normal") || strcmp(line("side"), "") == 0 || strcmp(line("paths"), "contact") != 0,
             "no normal: %s", line("above"));
    iso_record_free(place);
    iso_record_free(r);
    r = make_plane(100, axis_3, along, 0.1);
    look(r, axis_3, true);
    gsl_test(number("strip") != 1 || !says("above", "scale across it is larger") || norm(seen(0)) != 0.5,
             "a narrow path says so, and is counted from its start");
    iso_record_free(r);
    r = make_plane(100, axis_3, along, 5);
    look(r, axis_3, true);
    gsl_test(number("strip") != 0 || says("above", "scale across it is larger"), "a wide path does not");
    iso_record_free(r);
}

/* No support is drawn if the places are not all equally far from 0, or if only the centre is known. */
static void test_unknown_support(void)
{
    iso_record *r = make_sphere(50);
    iso_record_row(r, 30)[CONTACT] *= 1.01;
    look(r, NULL, false);
    gsl_test(number("support") != 0 || number("ball") != 0, "no sphere, no ball");
    iso_record_free(r);
    r = make_record(3, all_names + CENTRE);
    add_row(r)[0] = 1;
    look(r, NULL, false);
    gsl_test(number("support") != 0 || number("ball") != 0 || strcmp(line("paths"), "centre") != 0,
             "of a centre nothing else is known");
    iso_record_free(r);
}

/* --- what is hidden, and where contact is lost ------------------------------------------------------------------ */

/* Outside of a sphere a place is behind it, from above, where it is below its middle, up to a part of its outline;
 * where the path turns there, a row stands twice.*/
static void test_hidden(void)
{
    iso_record *r = make_sphere(400);
    look(r, (double[]){0, 0, 1}, false);
    const iso_record *path = iso_picture_table(&picture, "path");
    size_t wrong = 0, twice = 0, hidden = 0;
    for (size_t i = 0; i < iso_record_rows(path); i++) {
        const double *row = iso_record_const_row(path, i), *before = iso_record_const_row(path, i - (i > 0));
        const bool again = i > 0 && memcmp(row + 1, before + 1, 3 * sizeof *row) == 0;
        const bool next = i + 1 < iso_record_rows(path) &&
                          memcmp(row + 1, iso_record_const_row(path, i + 1) + 1, 3 * sizeof *row) == 0;
        const bool above = row[3] >= -0.1, side = row[2] <= 0.1;
        if (!next) wrong += row[4] != above || row[5] != side; /* of two, the second one has its own side */
        if (i > 0 && !again && row[0] == before[0]) wrong += row[4] != before[4] || row[5] != before[5];
        twice += again, hidden += !above;
    }
    gsl_test(wrong > 0 || twice == 0 || hidden == 0, "%zu rows on a wrong side, %zu twice, %zu hidden", wrong, twice,
             hidden);
    iso_record_free(r);
}

static void test_losses(void)
{
    size_t lost[ISO_PICTURE_LOSSES];
    iso_record *r = make_sphere(100);
    gsl_test(iso_picture_losses(r, lost) != 0, "pressed all the time");
    iso_record_row(r, 99)[PRESSURE] = 1e-15;
    gsl_test(iso_picture_losses(r, lost) != 1 || lost[0] != 99, "a run that ends where contact is lost");
    look(r, NULL, false);
    gsl_test(count_of("marks", "sign", "lost") != 1 || count_of("marks", "sign", "end") != 0,
             "says more than the end");
    for (int i = 40; i < 60; i++) iso_record_row(r, (size_t)i)[PRESSURE] = -1;
    gsl_test(iso_picture_losses(r, lost) != 2 || lost[0] != 40 || lost[1] != 99, "a support that pulls for a while");
    iso_record_row(r, 99)[PRESSURE] = 1;
    look(r, NULL, false);
    gsl_test(count_of("marks", "sign", "lost") != 1 || count_of("marks", "sign", "end") != 1, "and there is an end");
    for (int i = 0; i < 100; i++) iso_record_row(r, (size_t)i)[PRESSURE] = i % 2 ? -1 : 1;
    gsl_test(iso_picture_losses(r, lost) != ISO_PICTURE_LOSSES, "no more than there is room for");
    iso_record_free(r);
}

static void test_refused(void)
{
    static const double bad[] = {NAN, INFINITY}, long_up[3] = {0, 0, 1.01}, nan_up[3] = {NAN, 0, 1};
    iso_record *r = make_sphere(10);
    gsl_test(make(r, long_up, false) != ISO_BAD_ARGUMENT, "up too long");
    gsl_test(make(r, nan_up, false) != ISO_BAD_ARGUMENT, "up no number");
    for (int i = 0; i < 4; i++) {
        double *x = iso_record_row(r, 7) + (i < 2 ? CENTRE + 1 : CONTACT + 2), kept = *x;
        *x = bad[i % 2];
        gsl_test(make(r, NULL, false) != ISO_NUMERICAL ||
                     strcmp(iso_context_about(ctx), i < 2 ? "centre2" : "contact3") != 0,
                 "not finite: %s", iso_context_message(ctx));
        *x = kept;
    }
    iso_record_free(r);
    r = make_record(3, all_names);
    add_row(r);
    gsl_test(make(r, NULL, false) != ISO_BAD_INPUT, "no columns");
    iso_record_free(r);
}

int main(void)
{
    ctx = iso_context_create();
    test_frames();
    test_planes();
    test_unknown_support();
    test_hidden();
    test_losses();
    test_refused();
    iso_picture_free(&picture);
    iso_context_free(ctx);
    return gsl_test_summary();
}

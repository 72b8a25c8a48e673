/* test_picture_paths.c - pictures of paths on spheres, and of curves: what thinning and the sides keep. Private
 * functions of the library are tested. */
#include "laws.h"
#include "picture/picture_impl.h"

static iso_context *ctx;
static iso_picture picture;

/* t, and unit vectors on a curve, `turn` radians between rows or a little more. */
static iso_record *make_path(size_t rows, double turn)
{
    static const char *const names[] = {"t", "n1", "n2", "n3"};
    iso_record *r;
    if (iso_record_create(ctx, 4, names, &r) != ISO_OK) exit(1);
    for (size_t i = 0; i < rows; i++) {
        const double a = turn * (double)i, b = 0.3 + 0.1 * a;
        if (iso_record_add(ctx, r, 1, (double[]){a, cos(a) * cos(b), cos(a) * sin(b), sin(a)}) != ISO_OK) exit(1);
    }
    return r;
}

static const iso_record *draw(const iso_record *r)
{
    iso_picture_free(&picture);
    if (iso_picture_add_curves(ctx, &picture) != ISO_OK) exit(1); /* whose first table has the lines */
    gsl_test((int)iso_picture_path(ctx, &picture, "ball", r, 1), "%s", iso_context_message(ctx));
    gsl_test((int)iso_picture_axes(ctx, &picture, "ball", r, 1, 1), "%s", iso_context_message(ctx));
    return iso_picture_table(&picture, "ball");
}

static double number(const char *key)
{
    const char *text = iso_record_get(picture.table[0], key);
    return text ? strtod(text, NULL) : NAN;
}

/* A path that is joined is on one side from row to row; it goes to the other by a row that stands twice; no piece is
 * long; its ends are those of the rows. */
static void test_sides(void)
{
    enum { ROWS = 1000 };
    static const double turns[] = {0.01, 0.1, 0.5};
    for (size_t k = 0; k < 3; k++) {
        iso_record *r = make_path(ROWS, turns[k]);
        const iso_record *path = draw(r), *ends = iso_picture_table(&picture, "ends");
        size_t wrong = 0, changes = 0;
        double length = 0, seen[3];
        for (size_t i = 1; i < iso_record_rows(path); i++) {
            const double *a = iso_record_const_row(path, i - 1), *b = iso_record_const_row(path, i);
            const double piece = hypot(b[0] - a[0], b[1] - a[1]);
            wrong += piece > 0.16 || hypot(b[0], b[1]) > 1 + 1e-14;
            if (a[2] != b[2]) wrong += piece > 1e-15, changes++;
            length += piece;
        }
        gsl_test(wrong > 0 || changes == 0, "%g between rows: %zu of %zu rows are wrong", turns[k], wrong,
                 iso_record_rows(path));
        gsl_test(!(number("ball_length") > length && number("ball_length") < 5 * length), "a projection is shorter");
        for (size_t end = 0; end < 2; end++) {
            iso_picture_see(iso_record_const_row(r, end ? ROWS - 1 : 0) + 1, seen);
            const double *row = iso_record_const_row(ends, end);
            gsl_test(row[2] != seen[0] || row[3] != seen[1] || (row[4] == 1) != (seen[2] > 0) ||
                         !iso_picture_is(ends, end, "sign", end ? "end" : "start"),
                     "end %zu", end);
        }
        iso_record_free(r);
    }
    iso_record *r = make_path(50, 2);
    gsl_test(iso_record_rows(draw(r)) != 50 || number("ball_length") != 0, "rows far apart are dots");
    iso_record_free(r);
    r = make_path(200000, 0.001);
    gsl_test(iso_record_rows(draw(r)) > 8000 || number("ball_rows") != ISO_PICTURE_ROWS, "200000 rows are thinned");
    iso_record_free(r);
}

/* The number of an axis stands on the page, and keeps away from the path where there is room. */
static void test_axes(void)
{
    iso_record *r = make_path(100, 0.1);
    draw(r);
    const iso_record *axes = iso_picture_table(&picture, "axes");
    gsl_test(iso_record_rows(axes) != 3, "three axes");
    for (size_t i = 0; i < 3; i++) {
        const double x = iso_picture_number(axes, i, "number_right"), y = iso_picture_number(axes, i, "number_up");
        gsl_test(iso_picture_number(axes, i, "number") != (double)(i + 1) || hypot(x, y) > 1.5, "axis %zu", i + 1);
    }
    iso_record_free(r);
}

/* Whatever is left out, the least and the largest number of all rows are drawn, each at its own time. */
static void test_thinning(void)
{
    static const size_t sizes[] = {1, 2, 1999, 2001, 5001, 100000};
    for (size_t k = 0; k < 6; k++) {
        iso_record *r = make_path(sizes[k], 0.003);
        double *peak = iso_record_row(r, sizes[k] / 3), *pit = iso_record_row(r, sizes[k] / 2);
        peak[3] = 7;
        if (sizes[k] > 2) pit[3] = -7;
        for (int thinning = ISO_PICTURE_EXTREMES; thinning <= ISO_PICTURE_LARGEST; thinning++) {
            iso_picture_free(&picture);
            const iso_picture_curve curve = {"chart", NULL, r, 0, 3, false, (iso_picture_thinning)thinning, INFINITY};
            if (iso_picture_add_curves(ctx, &picture) != ISO_OK) exit(1);
            gsl_test((int)iso_picture_add_curve(ctx, &picture, &curve), "%s", iso_context_message(ctx));
            const iso_record *values = iso_picture_table(&picture, "values"),
                             *of = iso_picture_table(&picture, "curves");
            bool top = false, bottom = sizes[k] <= 2, ordered = true;
            for (size_t i = 0; i < iso_record_rows(values); i++) {
                const double *row = iso_record_const_row(values, i);
                top |= row[1] == peak[0] && row[2] == 7;
                bottom |= row[1] == pit[0] && row[2] == -7;
                ordered &= i == 0 || row[1] > iso_record_const_row(values, i - 1)[1];
            }
            gsl_test(!top || (!bottom && thinning == ISO_PICTURE_EXTREMES) || !ordered,
                     "%zu rows: no number is hidden", sizes[k]);
            gsl_test(iso_record_rows(values) > 2000, "%zu rows: at most 2000", sizes[k]);
            gsl_test(iso_picture_number(of, 0, "high") != 7 ||
                         (sizes[k] > 2 && iso_picture_number(of, 0, "low") != -7) ||
                         !iso_picture_is(of, 0, "name", "n₃") || !iso_picture_is(of, 0, "over", "t"),
                     "what the curve is");
        }
        iso_record_free(r);
    }
}

/* Two columns of any table: rows without both numbers are left out. */
static void test_columns(void)
{
    static const struct {
        const char *wish;
        iso_status status;
    } wishes[] = {
        {"columns=t,n9", ISO_BAD_INPUT},   {"columns=t", ISO_BAD_ARGUMENT}, {"columns=t,n1,n2", ISO_BAD_ARGUMENT},
        {"columns=t,t", ISO_BAD_ARGUMENT}, {"columns=n1,n2", ISO_OK},       {"columns=t,n3", ISO_OK}};
    iso_record *r = make_path(20, 0.1);
    const iso_record *const tables[] = {r, NULL};
    iso_record_set_kind(r, "something else");
    iso_record_row(r, 7)[1] = NAN;
    for (size_t i = 0; i < sizeof wishes / sizeof *wishes; i++) {
        iso_picture_free(&picture);
        gsl_test(iso_picture_make(ctx, tables, wishes[i].wish, &picture) != wishes[i].status, "%s: %s",
                 wishes[i].wish, iso_context_message(ctx));
        if (wishes[i].status != ISO_OK) continue;
        const bool vector = wishes[i].wish[8] == 'n';
        gsl_test(number("equal") != vector ||
                     iso_record_rows(iso_picture_table(&picture, "values")) != (vector ? 19 : 20),
                 "%s: what is drawn", wishes[i].wish);
    }
    for (size_t i = 0; i < 20; i++) iso_record_row(r, i)[1] = NAN;
    iso_picture_free(&picture);
    gsl_test(iso_picture_make(ctx, tables, "columns=t,n1", &picture) != ISO_BAD_INPUT, "no number");
    iso_record_free(r);
}

int main(void)
{
    ctx = iso_context_create();
    test_sides();
    test_axes();
    test_thinning();
    test_columns();
    iso_picture_free(&picture);
    iso_context_free(ctx);
    return gsl_test_summary();
}

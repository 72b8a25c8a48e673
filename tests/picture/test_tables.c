/* test_tables.c - laws of the tables that pictures draw: events are those of the table, cells cover the grid, each
 * measured row is in one series, a band holds its value, cells of maps meet and do not overlap, marks and keys. */
#include <gsl/gsl_math.h>

#include "laws.h"
#include "picture/picture.h"

static iso_context *ctx;

static const iso_record *table_of(const iso_picture *p, const char *name)
{
    const iso_record *r = iso_picture_table(p, name);
    if (r) return r;
    gsl_test(1, "%s has no table '%s'", p->layout ? p->layout : "nothing", name);
    exit(1);
}

static double at(const iso_record *r, size_t row, const char *column)
{
    return iso_record_const_row(r, row)[iso_record_find(r, column)];
}

static bool says(const iso_picture *p, const char *key, const char *value)
{
    const char *text = iso_record_get(p->table[0], key);
    return text && strcmp(text, value) == 0;
}

static iso_record *create(const char *kind, size_t columns, const char *const names[])
{
    iso_record *r;
    if (iso_record_create(ctx, columns, names, &r) != ISO_OK) exit(1);
    iso_record_set_kind(r, kind);
    iso_record_set(ctx, r, "k", "0.5");
    iso_record_set(ctx, r, "J", "1 2 5");
    return r;
}

/* Makes the picture, which must have this layout; the table is freed. */
static iso_picture make(iso_record *r, const char *options, const char *layout)
{
    iso_picture p;
    gsl_test((int)iso_picture_make(ctx, (const iso_record *[]){r, NULL}, options, &p), "%s: %s", layout,
             iso_context_message(ctx));
    gsl_test(!p.layout || strcmp(p.layout, layout) != 0, "the layout is %s", layout);
    if (!p.layout) exit(1);
    iso_record_free(r);
    return p;
}

static void add(iso_record *r, const double row[])
{
    if (iso_record_add(ctx, r, 1, row) != ISO_OK) exit(1);
}

static double word(iso_record *r, const char *text)
{
    double number;
    if (iso_record_intern(ctx, r, text, &number) != ISO_OK) exit(1);
    return number;
}

/* --- branches and charts ---------------------------------------------------------------------------------------- */

static void test_branch(void)
{
    static const char *const names[] = {"branch", "line", "point", "k", "u", "trace", "event"}, *const events[] = {
                                                                                                    "",   "fold",
                                                                                                    "",   "end",
                                                                                                    "",   "touch",
                                                                                                    "end"};
    iso_record *r = create("periodic follow", 7, names);
    iso_record_set_words(r, 6, true);
    for (int i = 0; i < 7; i++) add(r, (double[]){i < 4 ? 1 : 2, 0, i, 0.1 * i, M_PI / 4, i, word(r, events[i])});
    iso_picture p = make(r, NULL, "branch");
    const iso_record *points = table_of(&p, "points"), *found = table_of(&p, "events");
    gsl_test(iso_record_rows(points) != 3 || iso_record_rows(found) != 2, "points and events, no ends");
    gsl_test(strcmp(iso_record_word(found, at(found, 0, "event")), "fold") != 0 || at(found, 0, "at") != 0.1 ||
                 at(found, 1, "branch") != 2 || at(found, 1, "trace") != 5,
             "events are those of the table");
    gsl_test_abs(at(points, 0, "place"), 0.5, 1e-15, "u = pi/4 is half of a line");
    gsl_test(!says(&p, "branches", "2") || !says(&p, "over", "k"), "what varies");
    iso_picture_free(&p);
}

/* The part of a side that cells cover, and whether the cell about (k, up) has the class of this trace. */
static double area(const iso_record *cells, int side)
{
    double sum = 0;
    for (size_t i = 0; i < iso_record_rows(cells); i++)
        if (at(cells, i, "side") == side)
            sum += (at(cells, i, "right") - at(cells, i, "left")) * (at(cells, i, "top") - at(cells, i, "bottom"));
    return sum;
}

static double class_at(const iso_record *cells, int side, double k, double up)
{
    int hits = 0;
    double class = 99;
    for (size_t i = 0; i < iso_record_rows(cells); i++)
        if (at(cells, i, "side") == side && at(cells, i, "left") < k && k < at(cells, i, "right") &&
            at(cells, i, "bottom") < up && up < at(cells, i, "top"))
            class = at(cells, i, "class"), hits++;
    return hits == 1 ? class : 99;
}

static double trace_at(int i, int j, int side)
{
    if (i == 3) return NAN;
    return side == 1 ? (i < 2 ? 0 : j < 3 ? 3 : -3) : (i + 2 * j) % 5 - 2;
}

/* k: columns; across: whether rows of the table go along k */
static void check_chart(bool across)
{
    enum { K = 7, UP = 5 };
    static const char *const names[] = {"kind", "k", "J2", "least", "greatest"};
    iso_record *r = create("periodic chart", 5, names);
    iso_record_set_words(r, 0, true);
    for (int n = 0; n < K * UP; n++) {
        const int i = across ? n % K : n / UP, j = across ? n / K : n % UP;
        add(r, (double[]){word(r, "grid"), 0.1 * i, 1 + j, trace_at(i, j, 1), trace_at(i, j, 2)});
    }
    add(r, (double[]){word(r, "border"), 0.15, 2, 2, NAN});
    iso_picture p = make(r, NULL, "chart");
    const iso_record *cells = table_of(&p, "cells"), *borders = table_of(&p, "borders");
    for (int side = 1; side <= 2; side++) {
        int wrong = 0;
        gsl_test_abs(area(cells, side), 0.1 * K * UP, 1e-12, "cells cover the grid");
        for (int n = 0; n < K * UP; n++) {
            const double trace = trace_at(n % K, n / K, side), class = isnan(trace)         ? 2
                                                                       : trace <= -2 - 1e-9 ? -1
                                                                       : trace > 2          ? 1
                                                                                            : 0;
            wrong += class_at(cells, side, 0.1 * (n % K), 1 + n / K) != class;
        }
        gsl_test(wrong != 0, "each grid point is in one cell, of its class: %d are not", wrong);
    }
    gsl_test(iso_record_rows(borders) != 1 || at(borders, 0, "side") != 1, "the border of one side");
    gsl_test(!says(&p, "none", "1") || !says(&p, "up", "J₂"), "no rotation somewhere; the name of the axis");
    iso_picture_free(&p);
}

static void test_cost(void)
{
    static const char *const names[] = {"backend", "method", "error", "total"};
    iso_record *r = create("cost", 4, names);
    char method[8];
    int counts[2] = {0, 0};
    for (size_t c = 0; c < 2; c++) iso_record_set_words(r, c, true);
    for (int i = 0; i < 60; i++) {
        snprintf(method, sizeof method, "m%d", i % 15);
        add(r, (double[]){word(r, i % 2 ? "ball" : "point"), word(r, method), i % 7 ? i * 1e-9 : NAN,
                          i % 11 ? 1e-3 : 0});
    }
    add(r, (double[]){word(r, "exact"), word(r, ""), 0, 1e-6});
    for (size_t i = 0; i < 60; i++) counts[0] += isfinite(at(r, i, "error")) && at(r, i, "total") > 0;
    iso_picture p = make(r, NULL, "cost");
    const iso_record *points = table_of(&p, "points"), *closed = table_of(&p, "closed");
    for (size_t i = 0; i < iso_record_rows(points); i++) {
        counts[1] += at(points, i, "series") >= 1 && at(points, i, "named") >= 0 && at(points, i, "named") <= 10;
        for (size_t j = 0; j < i; j++)
            if (at(points, i, "error") == at(points, j, "error")) gsl_test(1, "a row is in two series");
    }
    gsl_test(counts[0] != counts[1] || iso_record_rows(points) != (size_t)counts[0], "%d measured rows, %d drawn",
             counts[0], counts[1]);
    gsl_test(iso_record_rows(closed) != 1 || at(closed, 0, "error") != 1e-17,
             "the closed solution, error 0 as 1e-17");
    gsl_test(iso_record_rows(table_of(&p, "panels")) != 2 || !says(&p, "nameless", "1"), "two panels, some nameless");
    gsl_test(iso_record_rows(table_of(&p, "methods")) != 10, "ten names");
    iso_picture_free(&p);
}

/* --- sweeps ----------------------------------------------------------------------------------------------------- */

static void test_curve(void)
{
    static const char *const names[] = {"point", "k", "chaos_share", "chaos_share_low", "chaos_share_high", "status"};
    static const double k[] = {-1, 1, 0.5, -0.5, 2, 3};
    iso_record *r = create("sweep", 6, names);
    iso_record_set(ctx, r, "names", "vary/k chaos/share chaos/share_low chaos/share_high");
    for (int i = 0; i < 6; i++) {
        const double share = i == 4 ? NAN : 0.1 * i + 0.2;
        add(r, (double[]){i, k[i], share, share - 0.1, share + 0.05, 0});
    }
    iso_picture p = make(r, NULL, "sweep_curve");
    const iso_record *curve = table_of(&p, "curve");
    int gaps = 0, outside = 0;
    double last = -INFINITY;
    for (size_t i = 0; i < iso_record_rows(curve); i++) {
        const double x = at(curve, i, "at"), value = at(curve, i, "value");
        gaps += isnan(x);
        if (isnan(x)) continue;
        outside += !(at(curve, i, "low") <= value && value <= at(curve, i, "high") && x > last);
        last = x;
    }
    gsl_test(gaps != 2, "gaps where there is no value and across k = 0: %d", gaps);
    gsl_test(outside != 0, "the band holds the value, and x grows");
    gsl_test(iso_record_rows(table_of(&p, "marks")) != 2, "k = 1 and k = -1 are marked");
    gsl_test(!says(&p, "sizes", "0") || !says(&p, "value", "chaotic share of the section"), "what is drawn");
    iso_picture_free(&p);
}

/* A sweep over x and y, by a grid or by moments in a triangle. */
static iso_record *make_sweep(int n, bool moments, bool ordered)
{
    static const char *const flat[] = {"point", "J1", "x", "state_a", "status"}, *const three[] = {
                                                                                     "point", "J1",      "J2",
                                                                                     "J3",    "state_a", "status"};
    iso_record *r = create("sweep", moments ? 6 : 5, moments ? three : flat);
    iso_record_set(ctx, r, "names", moments ? "vary/J1 vary/J2 vary/J3 state/a" : "vary/J1 vary/x state/a");
    int i = 0;
    for (int a = 1; a < n; a++)
        for (int b = 1; b < n; b++) {
            const double c = n - a - b, value = i % 6 == 5 ? NAN : a + 0.1 * b;
            if (!moments) add(r, (double[]){i++, a + 0.1 * a * a, 0.1 * b, value, 0});
            if (moments && c >= 1 && (!ordered || (a < b && b < c))) add(r, (double[]){i++, a, b, c, value, 0});
        }
    return r;
}

typedef struct cell {
    double x[70], y[70], missing, value;
    int corners;
} cell;

/* Reads a closed polygon from row *i on, and the gap behind it. */
static void next_cell(const iso_record *cells, size_t *i, cell *c)
{
    *c = (cell){.missing = at(cells, *i, "missing"), .value = at(cells, *i, "value")};
    for (; !isnan(at(cells, *i, "x")); ++*i) {
        c->x[c->corners] = at(cells, *i, "x"), c->y[c->corners] = at(cells, *i, "y");
        c->corners++;
    }
    ++*i;
}

static double area_of(const cell *c)
{
    double sum = 0;
    for (int i = 0; i + 1 < c->corners; i++) sum += c->x[i] * c->y[i + 1] - c->x[i + 1] * c->y[i];
    return fabs(sum) / 2;
}

static bool holds(const cell *c, double x, double y)
{
    bool inside = false;
    for (int i = 0; i + 1 < c->corners; i++)
        if ((c->y[i] > y) != (c->y[i + 1] > y) &&
            x < c->x[i] + (y - c->y[i]) / (c->y[i + 1] - c->y[i]) * (c->x[i + 1] - c->x[i]))
            inside = !inside;
    return inside;
}

/* On a fine grid of places: each is in at most one cell; cells: their area is the number of places. */
static void check_cells(const iso_picture *p, size_t points, bool inner)
{
    enum { FINE = 83 };
    const iso_record *cells = table_of(p, "cells");
    static cell all[200];
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY}, sum = 0;
    size_t count = 0, grey = 0;
    int twice = 0, once = 0;
    for (size_t i = 0; i < iso_record_rows(cells); count++) {
        next_cell(cells, &i, &all[count]);
        sum += area_of(&all[count]);
        grey += all[count].missing == 1;
        gsl_test(all[count].missing != isnan(all[count].value), "missing is what has no value");
        for (int c = 0; c < all[count].corners; c++) {
            low[0] = fmin(low[0], all[count].x[c]), high[0] = fmax(high[0], all[count].x[c]);
            low[1] = fmin(low[1], all[count].y[c]), high[1] = fmax(high[1], all[count].y[c]);
        }
    }
    for (int i = 0; i < FINE * FINE; i++) {
        const double x = low[0] + (i % FINE + 0.37) / FINE * (high[0] - low[0]),
                     y = low[1] + ((double)(i / FINE) + 0.41) / FINE * (high[1] - low[1]);
        int hits = 0;
        for (size_t c = 0; c < count; c++) hits += holds(&all[c], x, y);
        twice += hits > 1;
        once += hits == 1;
    }
    gsl_test(count != points, "%zu points, %zu cells", points, count);
    gsl_test(grey != points / 6 || !says(p, "missing", "1"), "%zu of %zu are grey", grey, points);
    gsl_test(twice != 0, "no two cells overlap");
    if (inner) gsl_test_rel(once, FINE * FINE, 1e-12, "cells of a grid leave no gap");
    gsl_test_rel(sum, (high[0] - low[0]) * (high[1] - low[1]) * once / (FINE * FINE), 0.03, "areas");
}

static void test_maps(void)
{
    iso_picture p = make(make_sweep(7, false, false), NULL, "sweep_map");
    check_cells(&p, 36, true);
    gsl_test(!says(&p, "x", "J₁") || !says(&p, "value", "state: a"), "names of axes");
    iso_picture_free(&p);
    p = make(make_sweep(12, true, false), "value=state_a", "sweep_map");
    check_cells(&p, 55, false);
    iso_picture_free(&p);
    p = make(make_sweep(18, true, true), NULL, "sweep_map");
    check_cells(&p, 19, false);
    gsl_test(!says(&p, "x", "J₁/J₃"), "ordered moments are ratios");
    iso_picture_free(&p);
}

/* A third number: a map for each of its values; one scale of colours. */
static void test_several_maps(void)
{
    static const char *const names[] = {"point", "k", "x", "J1", "state_a", "status"};
    iso_record *r = create("sweep", 6, names);
    iso_record_set(ctx, r, "columns", "vary/k vary/x vary/J1 state/a");
    for (int i = 0; i < 24; i++) add(r, (double[]){i, i / 12 ? 0.5 : -1, i % 3, i / 3 % 4, i, 0});
    iso_picture p = make(r, NULL, "sweep_map");
    const iso_record *maps = table_of(&p, "maps");
    gsl_test(iso_record_rows(maps) != 2 || strcmp(iso_record_word(maps, at(maps, 1, "name")), "k = 1/2") != 0,
             "two maps with their names");
    gsl_test(!says(&p, "low", "0") || !says(&p, "high", "23") || !says(&p, "missing", "0"), "one scale of colours");
    iso_picture_free(&p);
}

static void test_frequencies(void)
{
    iso_record *r = create("frequencies", 1, (const char *const[]){"none"});
    iso_record_set(ctx, r, "estimate.axis", "3");
    iso_record_set(ctx, r, "estimate.verdict", "regular");
    static const char *const lines[][2] = {{"lines_turning.0.frequency", "1.5"}, {"lines_turning.0.amplitude", "0.5"},
                                           {"lines_turning.0.m", "1"},           {"lines_turning.0.n", "0"},
                                           {"lines_turning.1.frequency", "2"},   {"lines_turning.1.amplitude", "0"},
                                           {"lines_along.0.frequency", "-2"},    {"lines_along.0.amplitude", "1e-3"}};
    char key[64];
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        snprintf(key, sizeof key, "estimate.%s", lines[i][0]);
        iso_record_set(ctx, r, key, lines[i][1]);
    }
    iso_picture p = make(r, NULL, "frequencies");
    const iso_record *found = table_of(&p, "lines");
    gsl_test(iso_record_rows(found) != 2 || at(found, 1, "signal") != 2 || at(found, 1, "frequency") != -2,
             "lines with an amplitude");
    gsl_test(strcmp(iso_record_word(found, at(found, 0, "label")), "1,0") != 0 || !says(&p, "labels", "1"),
             "a label");
    iso_picture_free(&p);

    r = create("frequencies", 1, (const char *const[]){"none"});
    static const char *const map[][2] = {
        {"k", "-1"}, {"h", "1"}, {"H", "0"}, {"integral.name", "F_shell"}, {"integral.value", "18"}};
    for (size_t i = 0; i < 5; i++) iso_record_set(ctx, r, map[i][0], map[i][1]);
    p = make(r, NULL, "momentum");
    const iso_record *parts = table_of(&p, "parts");
    int wrong = 0;
    for (size_t i = 0; i < iso_record_rows(parts); i++) wrong += !(at(parts, i, "low") <= at(parts, i, "high"));
    gsl_test(wrong != 0 || iso_record_rows(table_of(&p, "kinds")) < 2 ||
                 iso_record_rows(table_of(&p, "rotations")) < 3,
             "parts, their names, rotations");
    iso_picture_free(&p);
}

/* --- what is refused -------------------------------------------------------------------------------------------- */

static void refuses(iso_record *r, const char *options, const char *words)
{
    iso_picture p;
    const iso_status status = iso_picture_make(ctx, (const iso_record *[]){r, NULL}, options, &p);
    gsl_test(status != ISO_BAD_INPUT || !strstr(iso_context_message(ctx), words) || p.layout || p.table[0], "%s: %s",
             words, iso_context_message(ctx));
    iso_record_free(r);
}

static void test_refused(void)
{
    static const char *const cost[] = {"backend", "method", "error", "total"};
    refuses(make_sweep(4, false, false), "value=stat_a", "there is no such column; did you mean 'state_a'");
    refuses(make_sweep(4, false, false), "value=status", "there is no such column");
    refuses(make_sweep(4, false, false), "value=J1", "it varies");
    refuses(make_sweep(2, false, false), NULL, "nothing varies");
    iso_record *r = make_sweep(4, false, false);
    iso_record_set_kind(r, "sweep part");
    refuses(r, NULL, "merge the parts first");
    r = create("cost", 4, cost);
    for (size_t c = 0; c < 2; c++) iso_record_set_words(r, c, true);
    add(r, (double[]){word(r, "ball"), word(r, "a"), NAN, 1});
    refuses(r, NULL, "no measurements");
    refuses(create("frequencies", 1, (const char *const[]){"none"}), NULL, "no frequency is estimated");
}

int main(void)
{
    ctx = iso_context_create();
    test_branch();
    check_chart(true);
    check_chart(false);
    test_cost();
    test_curve();
    test_maps();
    test_several_maps();
    test_frequencies();
    test_refused();
    iso_context_free(ctx);
    return gsl_test_summary();
}

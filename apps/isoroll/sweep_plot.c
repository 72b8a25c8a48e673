/* sweep_plot.c - chooses the columns of a result that are drawn, and draws a curve or maps (see sweep_plot.h). */
#include "sweep_plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/nearest_impl.h"
#include "io/table.h"
#include "options.h"
#include "plot/plot.h"
#include "sweep/sweep_store_impl.h"

enum { MOST_KEPT = 64, NAME = ISO_SWEEP_NAME };

/* The columns of a result that the picture may need: all that vary, then the value and its error. */
typedef struct table {
    const iso_sweep_head *head;
    int kept[MOST_KEPT], columns, varying; /* columns of the result; how many of them vary in a sweep */
    iso_record *rows;                      /* with these columns                                        */
    size_t count;
    int axis[MOST_KEPT], axes; /* columns of the record that differ from row to row */
    int value, low, high;      /* likewise; low, high -1: there is no error          */
    bool relative;             /* high is an error +- */
} table;

static int find(const table *t, const char *wanted)
{
    char name[NAME];
    for (int c = 0; wanted && c < t->head->columns; c++) {
        if (strcmp(iso_sweep_column_name(&t->head->column[c], name), wanted) == 0) return c;
    }
    return -1;
}

static double at(const table *t, size_t row, int column)
{
    return iso_record_const_row(t->rows, row)[column];
}

/* --- what is drawn ---------------------------------------------------------------------------------------------- */

static int keep(table *t, int column)
{
    if (column < 0 || t->columns == MOST_KEPT) return -1;
    t->kept[t->columns] = column;
    return t->columns++;
}

static iso_status read_rows(iso_context *ctx, iso_sweep_reader *reader, table *t)
{
    char name[MOST_KEPT][NAME];
    const char *names[MOST_KEPT];
    iso_sweep_rows rows;
    for (int k = 0; k < t->columns; k++) names[k] = iso_sweep_column_name(&t->head->column[t->kept[k]], name[k]);
    iso_status status = iso_record_create(ctx, (size_t)t->columns, names, &t->rows);
    if (status == ISO_OK) status = iso_sweep_rows_create(ctx, t->head->columns, t->head->chunk, &rows);
    if (status != ISO_OK) return status;
    for (size_t c = 0; c < iso_sweep_chunks(t->head) && status == ISO_OK; c++) {
        status = iso_sweep_reader_rows(ctx, reader, iso_sweep_chunk_points(t->head, c), &rows);
        for (size_t i = 0; i < rows.count && status == ISO_OK; i++) {
            double row[MOST_KEPT];
            for (int k = 0; k < t->columns; k++) row[k] = rows.number[i * (size_t)rows.columns + (size_t)t->kept[k]];
            status = iso_record_add(ctx, t->rows, 1, row);
        }
    }
    iso_sweep_rows_free(&rows);
    t->count = iso_record_rows(t->rows);
    return status;
}

static void find_axes(table *t)
{
    for (int c = 0; c < t->varying; c++) {
        bool varies = false;
        for (size_t i = 1; i < t->count && !varies; i++) varies = at(t, i, c) != at(t, 0, c);
        if (varies) t->axis[t->axes++] = c;
    }
}

/* A column, and those of its error. */
static const struct {
    const char *value, *low, *high; /* low NULL: high is an error +- */
} known[] = {{"chaos_share", "chaos_share_low", "chaos_share_high"},
             {"splitting_m", NULL, "splitting_error"},
             {"splitting_x", NULL, "splitting_x_error"},
             {"frequencies_f1_t", NULL, "frequencies_f1_error"},
             {"frequencies_f2_t", NULL, "frequencies_f2_error"},
             {"frequencies_rotation", NULL, NULL},
             {"rotations_trace1", NULL, "rotations_error1"},
             {"rotations_trace2", NULL, "rotations_error2"},
             {"rotations_trace3", NULL, "rotations_error3"},
             {"backends_largest", NULL, NULL},
             {"contact_time", NULL, NULL}};

static iso_status no_such_column(iso_context *ctx, const char *wanted, const table *t)
{
    enum { MOST = 64 };
    char name[MOST][NAME], suggested[ISO_SUGGEST_SIZE];
    const char *names[MOST];
    const int count = t->head->columns < MOST ? t->head->columns : MOST;
    for (int c = 0; c < count; c++) names[c] = iso_sweep_column_name(&t->head->column[c], name[c]);
    return iso_context_fail(ctx, ISO_BAD_INPUT, "value", "--value %s: there is no such column; %s", wanted,
                            iso_suggest(suggested, wanted, (size_t)count, names));
}

static iso_status choose_value(iso_context *ctx, const char *wanted, table *t)
{
    const size_t count = sizeof known / sizeof *known;
    const iso_sweep_column *column = t->head->column;
    char name[NAME];
    int value = find(t, wanted);
    if (wanted && value < 0) return no_such_column(ctx, wanted, t);
    for (size_t i = 0; i < count && value < 0; i++) value = find(t, known[i].value);
    for (int c = 0; c < t->head->columns; c++) {
        const bool clock = strcmp(column[c].group, "state") == 0 && strcmp(column[c].name, "t") == 0,
                   vary = strcmp(column[c].group, "vary") == 0;
        if (vary) t->varying += keep(t, c) >= 0;
        if (value < 0 && !vary && !clock) value = c; /* the clock is often constant */
    }
    if (value < 0) return iso_context_fail(ctx, ISO_BAD_INPUT, "value", "nothing was measured");
    if (strcmp(column[value].group, "vary") == 0)
        return iso_context_fail(ctx, ISO_BAD_INPUT, "value", "--value %s: it varies: name one that was measured",
                                wanted);
    iso_sweep_column_name(&column[value], name);
    t->value = keep(t, value);
    t->low = t->high = -1;
    for (size_t i = 0; i < count; i++) {
        if (strcmp(known[i].value, name) != 0) continue;
        t->low = keep(t, find(t, known[i].low));
        t->high = keep(t, find(t, known[i].high));
        t->relative = !known[i].low;
    }
    return ISO_OK;
}

/* --- one number varies ------------------------------------------------------------------------------------------ */

static int by_x(const void *a, const void *b)
{
    const double *one = a, *other = b;
    return (*one > *other) - (*one < *other);
}

/* Low and high of the error; NaN: not known. */
static void error_of(const table *t, size_t row, double *low, double *high)
{
    *low = *high = NAN;
    if (t->high < 0) return;
    *high = at(t, row, t->high) + (t->relative ? at(t, row, t->value) : 0);
    *low = t->relative ? 2 * at(t, row, t->value) - *high : at(t, row, t->low);
}

static iso_status draw_curve(iso_context *ctx, const table *t, const char *title, const char *output)
{
    const char *const names[] = {iso_record_name(t->rows, (size_t)t->axis[0]),
                                 iso_record_name(t->rows, (size_t)t->value), "low", "high"};
    iso_record *rows;
    iso_status status = iso_record_create(ctx, 4, names, &rows);
    for (size_t i = 0; i < t->count && status == ISO_OK; i++) {
        double row[4] = {at(t, i, t->axis[0]), at(t, i, t->value)};
        error_of(t, i, &row[2], &row[3]);
        status = iso_record_add(ctx, rows, 1, row);
    }
    if (status == ISO_OK) {
        qsort(iso_record_row(rows, 0), t->count, 4 * sizeof(double), by_x);
        status = iso_plot_sweep_curve(ctx, output, title, rows);
    }
    iso_record_free(rows);
    return status;
}

/* --- maps ------------------------------------------------------------------------------------------------------- */

/* What the axes of the maps are, and which column tells the maps apart. */
typedef struct layout {
    int x, y, panel;       /* columns; panel -1: one map */
    bool ratios, triangle; /* x and y come from J: J1/J3 and J2/J3, or places in the triangle of J */
    int J;
    char x_name[NAME], y_name[NAME];
} layout;

static void place(const table *t, const layout *l, size_t row, double *x, double *y)
{
    if (!l->ratios && !l->triangle) {
        *x = at(t, row, l->x);
        *y = at(t, row, l->y);
        return;
    }
    const double a = at(t, row, l->J), b = at(t, row, l->J + 1), c = at(t, row, l->J + 2), sum = a + b + c;
    *x = l->ratios ? a / c : (b + c / 2) / sum;
    *y = l->ratios ? b / c : c * sqrt(0.75) / sum;
}

/* The three moments vary: they are one point of a triangle. */
static bool takes_moments(const table *t, layout *l, int rest[], int *others)
{
    int moments = 0;
    *others = 0;
    for (int i = 0; i < t->axes; i++) {
        const char *name = iso_record_name(t->rows, (size_t)t->axis[i]);
        const bool moment = name[0] == 'J' && name[1] >= '1' && name[1] <= '3' && name[2] == '\0';
        if (moment && moments++ == 0) l->J = t->axis[i];
        if (!moment) rest[(*others)++] = t->axis[i];
    }
    if (moments != 3) return false;
    l->ratios = true;
    for (size_t i = 0; i < t->count; i++)
        l->ratios = l->ratios && at(t, i, l->J) <= at(t, i, l->J + 1) && at(t, i, l->J + 1) <= at(t, i, l->J + 2);
    l->triangle = !l->ratios;
    snprintf(l->x_name, NAME, "%s", l->ratios ? "J1/J3" : "(J2 + J3/2)/(J1 + J2 + J3)");
    snprintf(l->y_name, NAME, "%s", l->ratios ? "J2/J3" : "(sqrt(3)/2) J3/(J1 + J2 + J3)");
    return true;
}

/* Different values of a column, counted no further than what has room. */
static int values_of(const table *t, int column)
{
    double seen[ISO_PLOT_MAPS];
    int count = 0;
    for (size_t i = 0; i < t->count; i++) {
        const double x = at(t, i, column);
        int j = 0;
        while (j < count && seen[j] != x) j++;
        if (j < count) continue;
        if (count == ISO_PLOT_MAPS) return ISO_PLOT_MAPS + 1;
        seen[count++] = x;
    }
    return count;
}

/* Of three numbers that vary the one with the fewest values tells the maps apart. */
static void take_columns(const table *t, layout *l)
{
    int panel = -1, fewest = ISO_PLOT_MAPS + 2, rest[2], others = 0;
    for (int i = 0; i < t->axes && t->axes == 3; i++) {
        const int values = values_of(t, t->axis[i]);
        if (values < fewest) fewest = values, panel = i;
    }
    for (int i = 0; i < t->axes; i++)
        if (i != panel) rest[others++] = t->axis[i];
    if (panel >= 0) l->panel = t->axis[panel];
    l->x = rest[0];
    l->y = rest[1];
}

static iso_status choose_layout(iso_context *ctx, const table *t, layout *l)
{
    int rest[MOST_KEPT], others;
    *l = (layout){.panel = -1};
    const bool moments = takes_moments(t, l, rest, &others);
    const int left = moments ? others : t->axes - 2;
    if (left < 0 || left > 1)
        return iso_context_fail(ctx, ISO_BAD_INPUT, "",
                                "%d numbers vary: a picture shows one, two, or three (J counts as two)", t->axes);
    if (moments) {
        if (left == 1) l->panel = rest[0];
        return ISO_OK;
    }
    take_columns(t, l);
    snprintf(l->x_name, NAME, "%s", iso_record_name(t->rows, (size_t)l->x));
    snprintf(l->y_name, NAME, "%s", iso_record_name(t->rows, (size_t)l->y));
    return ISO_OK;
}

/* The map of a row; -1: there are too many. */
static int map_of(const table *t, const layout *l, iso_plot_panels *m, size_t row)
{
    const double key = l->panel < 0 ? 0 : at(t, row, l->panel);
    for (int i = 0; i < m->count; i++)
        if (m->key[i] == key) return i;
    if (m->count == ISO_PLOT_MAPS) return -1;
    m->key[m->count] = key;
    return m->count++;
}

static iso_status collect(iso_context *ctx, const table *t, const layout *l, iso_plot_panels *m)
{
    for (size_t i = 0; i < t->count; i++) {
        const int map = map_of(t, l, m, i);
        double row[4] = {0, 0, at(t, i, t->value), map};
        if (map < 0)
            return iso_context_fail(ctx, ISO_BAD_INPUT, "", "more than %d values of '%s': a picture has no room",
                                    ISO_PLOT_MAPS, m->key_name);
        place(t, l, i, &row[0], &row[1]);
        const iso_status status = iso_record_add(ctx, m->rows, 1, row);
        if (status != ISO_OK) return status;
    }
    return ISO_OK;
}

static iso_status draw_maps(iso_context *ctx, const table *t, const char *title, const char *output)
{
    layout l;
    iso_plot_panels m = {.title = title};
    iso_status status = choose_layout(ctx, t, &l);
    if (status != ISO_OK) return status;
    m.key_name = l.panel < 0 ? NULL : iso_record_name(t->rows, (size_t)l.panel);
    const char *const names[] = {l.x_name, l.y_name, iso_record_name(t->rows, (size_t)t->value), "panel"};
    status = iso_record_create(ctx, 4, names, &m.rows);
    if (status == ISO_OK) status = collect(ctx, t, &l, &m);
    if (status == ISO_OK) status = iso_plot_sweep_maps(ctx, output, &m);
    iso_record_free(m.rows);
    return status;
}

iso_status plot_sweep(iso_context *ctx, const char *path, const char *value, const char *output)
{
    iso_sweep_reader *reader;
    char title[160];
    table t = {.count = 0};
    iso_status status = iso_sweep_reader_open(ctx, path, &reader);
    if (status != ISO_OK) return status;
    t.head = &reader->head;
    if (reader->share.count > 1)
        status = iso_context_fail(ctx, ISO_BAD_INPUT, "", "'%s' is a part of a sweep: merge the parts first", path);
    if (status == ISO_OK) status = choose_value(ctx, value, &t);
    if (status == ISO_OK) status = read_rows(ctx, reader, &t);
    if (status == ISO_OK) find_axes(&t);
    const char *slash = strrchr(path, '/');
    snprintf(title, sizeof title, "%.60s: %zu points", slash ? slash + 1 : path, t.count);
    if (status == ISO_OK && t.axes == 0)
        status = iso_context_fail(ctx, ISO_BAD_INPUT, "", "nothing varies in '%s'", path);
    if (status == ISO_OK)
        status = t.axes == 1 ? draw_curve(ctx, &t, title, output) : draw_maps(ctx, &t, title, output);
    iso_record_free(t.rows);
    iso_sweep_reader_close(reader);
    return status;
}

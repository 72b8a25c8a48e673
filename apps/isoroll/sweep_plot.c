/* sweep_plot.c - chooses the columns of a result that are drawn, and draws a curve or maps (see sweep_plot.h). */
#include "sweep_plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/nearest.h"
#include "io/table.h"
#include "options.h"
#include "plot/plot.h"
#include "sweep/sweep_store.h"

enum { MOST_AXES = 16, NAME = 2 * ISO_NAME_SIZE + 2 };

/* The columns of a result that the picture may need: all that vary, the value and its error. */
typedef struct table {
    const iso_sweep_head *head;
    size_t count;
    int *kept;      /* of each column of the result: its place in a row here; -1: it is not kept */
    size_t columns; /* that are kept */
    double *number;
    int axis[MOST_AXES], axes; /* columns that vary */
    int value, low, high;      /* columns; low, high -1: there is no error */
    bool relative;             /* high is an error +- */
} table;

static void name_of(const iso_sweep_column *c, char name[NAME])
{
    const bool vary = strcmp(c->group, "vary") == 0;
    snprintf(name, NAME, "%s%s%s", vary ? "" : c->group, vary ? "" : "_", c->name);
}

static int find(const table *t, const char *wanted)
{
    char name[NAME];
    for (int c = 0; c < t->head->columns; c++) {
        name_of(&t->head->column[c], name);
        if (strcmp(name, wanted) == 0) return c;
    }
    return -1;
}

static double at(const table *t, size_t row, int column)
{
    return t->number[row * t->columns + (size_t)t->kept[column]];
}

bool is_sweep_result(const char *path)
{
    char kind[ISO_KIND_SIZE];
    iso_table_kind(path, kind);
    return strcmp(kind, "sweep") == 0 || strcmp(kind, "sweep part") == 0;
}

/* --- what is drawn ---------------------------------------------------------------------------------------------- */

static bool make_room(table *t)
{
    t->kept = malloc(((size_t)t->head->columns + 1) * sizeof *t->kept);
    for (int c = 0; t->kept && c < t->head->columns; c++) {
        const bool keeps =
            strcmp(t->head->column[c].group, "vary") == 0 || c == t->value || c == t->low || c == t->high;
        t->kept[c] = keeps ? (int)t->columns++ : -1;
    }
    t->number =
        calloc(t->head->count + 1, (t->columns + 1) * sizeof *t->number); /* calloc checks the product for overflow */
    return t->kept && t->number;
}

static void keep_row(table *t, const double row[])
{
    double *to = t->number + t->count++ * t->columns;
    for (int c = 0; c < t->head->columns; c++)
        if (t->kept[c] >= 0) *to++ = row[c];
}

static iso_status read_rows(iso_context *ctx, iso_sweep_reader *reader, table *t)
{
    iso_sweep_rows rows;
    iso_status status = iso_sweep_rows_create(ctx, t->head->columns, t->head->chunk, &rows);
    if (status == ISO_OK && !make_room(t)) status = iso_context_no_memory(ctx, "the rows");
    for (size_t c = 0; c < iso_sweep_chunks(t->head) && status == ISO_OK; c++) {
        status = iso_sweep_reader_rows(ctx, reader, iso_sweep_chunk_points(t->head, c), &rows);
        for (size_t i = 0; i < rows.count && status == ISO_OK; i++)
            keep_row(t, rows.number + i * (size_t)rows.columns);
    }
    iso_sweep_rows_free(&rows);
    return status;
}

static void find_axes(table *t)
{
    for (int c = 0; c < t->head->columns && t->axes < MOST_AXES; c++) {
        bool varies = false;
        if (strcmp(t->head->column[c].group, "vary") != 0) continue;
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
    for (int c = 0; c < count; c++) name_of(&t->head->column[c], name[c]), names[c] = name[c];
    return iso_context_fail(ctx, ISO_BAD_INPUT, "value", "--value %s: there is no such column; %s", wanted,
                            iso_suggest(suggested, wanted, (size_t)count, names));
}

static iso_status choose_value(iso_context *ctx, const char *wanted, table *t)
{
    const size_t count = sizeof known / sizeof *known;
    t->value = wanted ? find(t, wanted) : -1;
    if (wanted && t->value < 0) return no_such_column(ctx, wanted, t);
    for (size_t i = 0; !wanted && i < count && t->value < 0; i++) t->value = find(t, known[i].value);
    for (int c = 0; c < t->head->columns && t->value < 0; c++) {
        const iso_sweep_column *column = &t->head->column[c];
        const bool clock = strcmp(column->group, "state") == 0 && strcmp(column->name, "t") == 0; /* often constant */
        if (strcmp(column->group, "vary") != 0 && !clock) t->value = c;
    }
    if (t->value < 0) return iso_context_fail(ctx, ISO_BAD_INPUT, "value", "nothing was measured");
    char name[NAME];
    name_of(&t->head->column[t->value], name);
    t->low = t->high = -1;
    for (size_t i = 0; i < count; i++) {
        if (strcmp(known[i].value, name) != 0) continue;
        t->low = known[i].low ? find(t, known[i].low) : -1;
        t->high = known[i].high ? find(t, known[i].high) : -1;
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
    static const char *const names[] = {"x", "value", "low", "high"};
    char value[NAME];
    const char *name = t->head->column[t->axis[0]].name;
    double(*sorted)[4] = malloc((t->count + 1) * sizeof *sorted);
    iso_record *rows = NULL;
    iso_status status = sorted ? iso_record_create(ctx, 4, names, &rows) : iso_context_no_memory(ctx, "the rows");
    for (size_t i = 0; i < t->count && status == ISO_OK; i++) {
        sorted[i][0] = at(t, i, t->axis[0]);
        sorted[i][1] = at(t, i, t->value);
        error_of(t, i, &sorted[i][2], &sorted[i][3]);
    }
    if (status == ISO_OK) qsort(sorted, t->count, sizeof *sorted, by_x);
    for (size_t i = 0; i < t->count && status == ISO_OK; i++) {
        double *row;
        status = iso_record_append(ctx, rows, &row);
        if (status == ISO_OK) memcpy(row, sorted[i], sizeof sorted[i]);
    }
    name_of(&t->head->column[t->value], value);
    if (status == ISO_OK) status = iso_plot_sweep_curve(ctx, output, title, name, value, rows);
    iso_record_free(rows);
    free(sorted);
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
        const char *name = t->head->column[t->axis[i]].name;
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
    int rest[MOST_AXES], others;
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
    snprintf(l->x_name, NAME, "%s", t->head->column[l->x].name);
    snprintf(l->y_name, NAME, "%s", t->head->column[l->y].name);
    return ISO_OK;
}

typedef struct maps {
    int count;
    double key[ISO_PLOT_MAPS];
    char name[ISO_PLOT_MAPS][NAME];
    iso_record *rows[ISO_PLOT_MAPS];
} maps;

/* The map of a row; -1: there are too many. */
static int map_of(const table *t, const layout *l, maps *m, size_t row)
{
    const double key = l->panel < 0 ? 0 : at(t, row, l->panel);
    for (int i = 0; i < m->count; i++)
        if (m->key[i] == key) return i;
    if (m->count == ISO_PLOT_MAPS) return -1;
    m->key[m->count] = key;
    if (l->panel >= 0) snprintf(m->name[m->count], NAME, "%s = %.6g", t->head->column[l->panel].name, key);
    return m->count++;
}

static iso_status collect(iso_context *ctx, const table *t, const layout *l, maps *m)
{
    static const char *const names[] = {"x", "y", "value"};
    for (size_t i = 0; i < t->count; i++) {
        const int map = map_of(t, l, m, i);
        double *row;
        iso_status status = ISO_OK;
        if (map < 0)
            return iso_context_fail(ctx, ISO_BAD_INPUT, "", "more than %d values of '%s': a picture has no room",
                                    ISO_PLOT_MAPS, t->head->column[l->panel].name);
        if (!m->rows[map]) status = iso_record_create(ctx, 3, names, &m->rows[map]);
        if (status == ISO_OK) status = iso_record_append(ctx, m->rows[map], &row);
        if (status != ISO_OK) return status;
        place(t, l, i, &row[0], &row[1]);
        row[2] = at(t, i, t->value);
    }
    return ISO_OK;
}

static iso_status draw_maps(iso_context *ctx, const table *t, const char *title, const char *output)
{
    layout l;
    maps m = {.count = 0};
    char value[NAME];
    const char *names[ISO_PLOT_MAPS];
    iso_status status = choose_layout(ctx, t, &l);
    if (status == ISO_OK) status = collect(ctx, t, &l, &m);
    name_of(&t->head->column[t->value], value);
    for (int i = 0; i < m.count; i++) names[i] = m.name[i];
    const iso_plot_panels p = {title, l.x_name, l.y_name, value, m.count, names, (const iso_record *const *)m.rows};
    if (status == ISO_OK) status = iso_plot_sweep_maps(ctx, output, &p);
    for (int i = 0; i < m.count; i++) iso_record_free(m.rows[i]);
    return status;
}

iso_status plot_sweep(iso_context *ctx, const char *path, const char *value, const char *output)
{
    iso_sweep_reader *reader;
    char title[160];
    table t = {.count = 0};
    iso_status status = iso_sweep_reader_open(ctx, path, &reader);
    if (status != ISO_OK) return status;
    t.head = iso_sweep_reader_head(reader);
    if (iso_sweep_reader_share(reader).count > 1)
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
    free(t.kept);
    free(t.number);
    iso_sweep_reader_close(reader);
    return status;
}

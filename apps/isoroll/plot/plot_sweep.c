/* plot_sweep.c - the picture of the result of a sweep: chooses what is drawn; plot_maps.c draws it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/nearest_impl.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"
#include "sweep/sweep_store_impl.h"

enum { MOST_AXES = 64, MOST_NAMES = 4096, SUGGESTED = 64, NAME = 64 };

/* The rows of a result, and which columns are drawn. */
typedef struct table {
    const iso_sweep_head *head;
    iso_record *rows;
    int axis[MOST_AXES], axes; /* those that vary, and differ from row to row           */
    int value, low, high;      /* -1: there is none; low -1: high is an error +-        */
    const char *words;         /* what the value is ...                                 */
    char own[NAME];            /* ... of a column that is not `known`                   */
} table;

static double at(const iso_record *rows, size_t row, int column)
{
    return iso_record_const_row(rows, row)[column];
}

/* --- the columns ------------------------------------------------------------------------------------------------ */

/* A column, in words, and those of its error. */
static const struct {
    const char *value, *words, *low, *high; /* low NULL: high is an error +- */
} known[] = {{"chaos_share", "chaotic share of the section", "chaos_share_low", "chaos_share_high"},
             {"splitting_m", "slope m of the splitting", NULL, "splitting_error"},
             {"splitting_x", "place x of the splitting", NULL, "splitting_x_error"},
             {"frequencies_f1_t", "frequency 1, in t", NULL, "frequencies_f1_error"},
             {"frequencies_f2_t", "frequency 2, in t", NULL, "frequencies_f2_error"},
             {"frequencies_rotation", "rotation number", NULL, NULL},
             {"rotations_trace1", "trace of the rotation about axis 1", NULL, "rotations_error1"},
             {"rotations_trace2", "trace of the rotation about axis 2", NULL, "rotations_error2"},
             {"rotations_trace3", "trace of the rotation about axis 3", NULL, "rotations_error3"},
             {"backends_largest", "largest difference of the computations", NULL, NULL},
             {"contact_time", "time at which contact is lost", NULL, NULL}};
enum { KNOWN = sizeof known / sizeof *known };

/* What varies, in words, where its name does not say it. */
static const char *axis_of(const table *t, int column)
{
    static const char *const words[][2] = {{"level", "level H of the point, in ε J₂^(−1/k)"},
                                           {"l", "place l of the start on the section, in rad"},
                                           {"x", "place x of the start on the section"},
                                           {"J1", "J₁"},
                                           {"J2", "J₂"},
                                           {"J3", "J₃"}};
    const char *name = iso_record_name(t->rows, (size_t)column);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(words[i][0], name) == 0) return words[i][1];
    return iso_plot_symbol(name);
}

static int find(const table *t, const char *name)
{
    return name ? iso_record_find(t->rows, name) : -1;
}

static bool varies(const table *t, int column)
{
    return strcmp(t->head->column[column].group, "vary") == 0;
}

static iso_status no_such_column(iso_context *ctx, const char *wanted, const table *t)
{
    char suggested[ISO_SUGGEST_SIZE];
    const char *names[SUGGESTED];
    size_t count = 0;
    for (; count < iso_record_columns(t->rows) && count < SUGGESTED; count++)
        names[count] = iso_record_name(t->rows, count);
    return iso_context_fail(ctx, ISO_BAD_INPUT, "value", "--value %s: there is no such column; %s", wanted,
                            iso_suggest(suggested, wanted, count, names));
}

static iso_status choose_value(iso_context *ctx, const char *wanted, table *t)
{
    const iso_sweep_column *column = t->head->column;
    int value = find(t, wanted);
    if (wanted && value < 0) return no_such_column(ctx, wanted, t);
    for (size_t i = 0; i < KNOWN && value < 0; i++) value = find(t, known[i].value);
    for (int c = 0; c < t->head->columns && value < 0; c++) {
        const bool clock = strcmp(column[c].group, "state") == 0 && strcmp(column[c].name, "t") == 0;
        if (!varies(t, c) && !clock) value = c; /* the clock is often constant */
    }
    if (value < 0) return iso_context_fail(ctx, ISO_BAD_INPUT, "value", "nothing was measured");
    if (varies(t, value))
        return iso_context_fail(ctx, ISO_BAD_INPUT, "value", "--value %s: it varies: name one that was measured",
                                wanted);
    t->value = value;
    t->low = t->high = -1;
    snprintf(t->own, sizeof t->own, "%s: %s", column[value].group, iso_plot_symbol(column[value].name));
    t->words = t->own;
    for (size_t i = 0; i < KNOWN; i++)
        if (find(t, known[i].value) == value)
            t->words = known[i].words, t->low = find(t, known[i].low), t->high = find(t, known[i].high);
    return ISO_OK;
}

/* A record with the columns of the result. */
static iso_status create_rows(iso_context *ctx, const iso_sweep_reader *reader, table *t)
{
    static const char *names[MOST_NAMES];
    const iso_record *header = iso_table_header(reader->table); /* one column more in front */
    t->head = &reader->head;
    for (size_t c = 0; c < (size_t)t->head->columns; c++) names[c] = iso_record_name(header, c + 1);
    return iso_record_create(ctx, (size_t)t->head->columns, names, &t->rows);
}

static iso_status read_rows(iso_context *ctx, iso_sweep_reader *reader, table *t)
{
    iso_sweep_rows rows;
    iso_status status = iso_sweep_rows_create(ctx, t->head->columns, t->head->chunk, &rows);
    for (size_t c = 0; status == ISO_OK && c < iso_sweep_chunks(t->head); c++) {
        status = iso_sweep_reader_rows(ctx, reader, iso_sweep_chunk_points(t->head, c), &rows);
        if (status == ISO_OK) status = iso_record_add(ctx, t->rows, rows.count, rows.number);
    }
    iso_sweep_rows_free(&rows);
    return status;
}

static void find_axes(table *t)
{
    for (int c = 0; c < t->head->columns && t->axes < MOST_AXES; c++) {
        bool differs = false;
        for (size_t i = 1; varies(t, c) && i < iso_record_rows(t->rows) && !differs; i++)
            differs = at(t->rows, i, c) != at(t->rows, 0, c);
        if (differs) t->axis[t->axes++] = c;
    }
}

/* --- one number varies ------------------------------------------------------------------------------------------ */

static int by_x(const void *a, const void *b)
{
    const double *one = a, *other = b;
    return (*one > *other) - (*one < *other);
}

static iso_status draw_curve(iso_context *ctx, const table *t, const iso_plot_page *page)
{
    char title[160];
    const char *const names[] = {axis_of(t, t->axis[0]), t->words, "low",
                                 t->low < 0 ? "± estimated error" : "95 % confidence, undecided orbits included"};
    const size_t count = iso_record_rows(t->rows);
    iso_record *rows;
    iso_status status = iso_record_create(ctx, 4, names, &rows);
    for (size_t i = 0; i < count && status == ISO_OK; i++) {
        const double value = at(t->rows, i, t->value), error = t->high < 0 ? (double)NAN : at(t->rows, i, t->high);
        const double high = t->low < 0 ? error + value : error;
        const double low = t->low < 0 ? 2 * value - high : at(t->rows, i, t->low);
        status = iso_record_add(ctx, rows, 1, (double[]){at(t->rows, i, t->axis[0]), value, low, high});
    }
    if (status == ISO_OK) {
        snprintf(title, sizeof title, "A sweep of %zu values of %s", count, names[0]);
        qsort(iso_record_row(rows, 0), count, 4 * sizeof(double), by_x);
        status = iso_plot_sweep_curve(ctx, page, title, rows);
    }
    iso_record_free(rows);
    return status;
}

/* --- maps ------------------------------------------------------------------------------------------------------- */

/* What the axes of the maps are, and which column tells the maps apart. */
typedef struct layout {
    int x, y, panel;       /* columns of the table; panel -1: one map */
    bool ratios, triangle; /* x and y come from J: J1/J3 and J2/J3, or places in the triangle of J */
    int J;
    char x_name[NAME], y_name[NAME];
    iso_plot_maps maps;
} layout;

static void place(const table *t, const layout *l, size_t row, double to[2])
{
    const double *from = iso_record_const_row(t->rows, row);
    if (!l->ratios && !l->triangle) {
        to[0] = from[l->x], to[1] = from[l->y];
        return;
    }
    const double a = from[l->J], b = from[l->J + 1], c = from[l->J + 2], sum = a + b + c;
    to[0] = l->ratios ? a / c : (b + c / 2) / sum;
    to[1] = l->ratios ? b / c : c * sqrt(0.75) / sum;
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
    for (size_t i = 0; i < iso_record_rows(t->rows); i++) {
        const double *J = iso_record_const_row(t->rows, i) + l->J;
        l->ratios = l->ratios && J[0] <= J[1] && J[1] <= J[2];
    }
    l->triangle = !l->ratios;
    snprintf(l->x_name, NAME, "%s", l->ratios ? "J₁/J₃" : "(J₂ + J₃/2)/(J₁ + J₂ + J₃)");
    snprintf(l->y_name, NAME, "%s", l->ratios ? "J₂/J₃" : "(√3/2) J₃/(J₁ + J₂ + J₃)");
    return true;
}

/* The place of a number in a list, at whose end it is put; -1: the list is full. */
static int place_in(double list[ISO_PLOT_MAPS], int *count, double x)
{
    int i = 0;
    while (i < *count && list[i] != x) i++;
    if (i == ISO_PLOT_MAPS) return -1;
    list[i] = x;
    if (i == *count) ++*count;
    return i;
}

/* Of three numbers that vary the one with the fewest values tells the maps apart. */
static void take_columns(const table *t, layout *l)
{
    int panel = -1, fewest = ISO_PLOT_MAPS + 2, rest[3], others = 0;
    for (int i = 0; i < t->axes && t->axes == 3; i++) {
        double seen[ISO_PLOT_MAPS];
        int values = 0;
        for (size_t row = 0; values <= ISO_PLOT_MAPS && row < iso_record_rows(t->rows); row++)
            if (place_in(seen, &values, at(t->rows, row, t->axis[i])) < 0) values = ISO_PLOT_MAPS + 1;
        if (values < fewest) fewest = values, panel = i;
    }
    for (int i = 0; i < t->axes; i++)
        if (i != panel) rest[others++] = t->axis[i];
    if (panel >= 0) l->panel = t->axis[panel];
    l->x = rest[0];
    l->y = rest[1];
    snprintf(l->x_name, NAME, "%s", axis_of(t, l->x));
    snprintf(l->y_name, NAME, "%s", axis_of(t, l->y));
}

static iso_status choose_layout(iso_context *ctx, const table *t, layout *l)
{
    int rest[MOST_AXES], others;
    const bool moments = takes_moments(t, l, rest, &others);
    const int left = moments ? others : t->axes - 2;
    if (left < 0 || left > 1)
        return iso_context_fail(ctx, ISO_BAD_INPUT, "",
                                "%d numbers vary: a picture shows one, two, or three (J counts as two)", t->axes);
    if (!moments) take_columns(t, l);
    if (moments && left == 1) l->panel = rest[0];
    return ISO_OK;
}

static iso_status collect(iso_context *ctx, const table *t, layout *l)
{
    const char *const names[] = {l->x_name, l->y_name, t->words, "panel"};
    iso_status status = iso_record_create(ctx, 4, names, &l->maps.rows);
    if (l->panel >= 0) l->maps.key_name = axis_of(t, l->panel);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(t->rows); i++) {
        const int map = place_in(l->maps.key, &l->maps.count, l->panel < 0 ? 0 : at(t->rows, i, l->panel));
        double row[4] = {0, 0, at(t->rows, i, t->value), map};
        if (map < 0)
            return iso_context_fail(ctx, ISO_BAD_INPUT, "", "more than %d values of '%s': a picture has no room",
                                    ISO_PLOT_MAPS, l->maps.key_name);
        place(t, l, i, row);
        status = iso_record_add(ctx, l->maps.rows, 1, row);
    }
    return status;
}

static iso_status draw_maps(iso_context *ctx, const table *t, const iso_plot_page *page)
{
    char title[160];
    layout l = {.panel = -1};
    iso_status status = choose_layout(ctx, t, &l);
    if (status == ISO_OK) status = collect(ctx, t, &l);
    snprintf(title, sizeof title, "A sweep of %zu points", iso_record_rows(t->rows));
    if (status == ISO_OK) status = iso_plot_sweep_maps(ctx, page, title, &l.maps);
    iso_record_free(l.maps.rows);
    return status;
}

/* --- the picture ------------------------------------------------------------------------------------------------ */

iso_status iso_plot_sweep(iso_context *ctx, const iso_plot_page *page, const char *file, const char *value)
{
    iso_sweep_reader *reader;
    table t = {.axes = 0};
    ISO_TRY(iso_sweep_reader_open(ctx, file, &reader));
    iso_status status = create_rows(ctx, reader, &t);
    if (reader->shard.count > 1)
        status = iso_context_fail(ctx, ISO_BAD_INPUT, "", "'%s' is a part of a sweep: merge the parts first", file);
    if (status == ISO_OK) status = choose_value(ctx, value, &t);
    if (status == ISO_OK) status = read_rows(ctx, reader, &t);
    if (status == ISO_OK) find_axes(&t);
    if (status == ISO_OK && t.axes == 0)
        status = iso_context_fail(ctx, ISO_BAD_INPUT, "", "nothing varies in '%s'", file);
    if (status == ISO_OK) status = (t.axes == 1 ? draw_curve : draw_maps)(ctx, &t, page);
    iso_record_free(t.rows);
    iso_sweep_reader_close(reader);
    return status;
}

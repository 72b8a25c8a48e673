/* plot_table.c - pictures of the tables that commands write (see plot_table.h). A kind of table is a row of `kinds`. */
#include "plot_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io/table.h"
#include "plot/plot.h"
#include "section_plot.h"

typedef struct table {
    iso_context *ctx;
    const iso_record *rows;
    size_t count; /* of rows */
    iso_params params;
    int axis; /* 0 to 2, of its section; -1: it does not say one */
    const char *output;
    char title[160];
} table;

static double number(const table *t, size_t row, const char *name)
{
    const int column = iso_record_find(t->rows, name);
    return column < 0 ? (double)NAN : iso_record_const_row(t->rows, row)[column];
}

static bool is(const table *t, size_t row, const char *name, const char *word)
{
    return strcmp(iso_record_word(t->rows, number(t, row, name)), word) == 0;
}

/* Adds a row of the first `count` numbers of `values`. */
static iso_status put(const table *t, iso_record *to, const double values[])
{
    double *row;
    const iso_status status = iso_record_append(t->ctx, to, &row);
    if (status == ISO_OK) memcpy(row, values, iso_record_columns(to) * sizeof *row);
    return status;
}

/* --- sections, and what is on them ------------------------------------------------------------------------------ */

static iso_status draw_section(table *t)
{
    iso_scene scene = iso_scene_default();
    scene.params = t->params;
    section_picture *p = section_picture_create(&scene);
    bool room = p != NULL;
    if (room) section_picture_begin(p, t->rows);
    for (size_t i = 0; room && i < t->count; i++) room = section_picture_row(p, iso_record_const_row(t->rows, i));
    const iso_status status =
        room ? section_picture_draw(t->ctx, p, t->output) : iso_context_no_memory(t->ctx, "a picture");
    section_picture_free(p);
    return status;
}

/* By the model that says what the verdict says. 0: regular; NaN: undecided. */
static double exponent_of(const table *t, size_t i)
{
    if (is(t, i, "verdict", "regular")) return 0;
    if (!is(t, i, "verdict", "chaotic")) return NAN;
    return number(t, i, is(t, i, "ball_verdict", "chaotic") ? "ball_per_turn" : "point_per_turn");
}

static iso_status draw_chaos(table *t)
{
    static const char *const names[] = {"l", "x", "exponent"};
    iso_record *spots;
    iso_status status = iso_record_create(t->ctx, 3, names, &spots);
    for (size_t i = 0; i < t->count && status == ISO_OK; i++)
        if (isfinite(number(t, i, "l")))
            status = put(t, spots, (double[]){number(t, i, "l"), number(t, i, "x"), exponent_of(t, i)});
    if (status == ISO_OK && iso_record_rows(spots) == 0)
        status = iso_context_fail(t->ctx, ISO_BAD_INPUT, "", "the table has no orbit that starts on the section");
    if (status == ISO_OK) status = iso_plot_exponents(t->ctx, t->output, t->title, t->axis, spots);
    iso_record_free(spots);
    return status;
}

/* A row has one crossing of its orbit. Drawn are its images, too: by the reversors and half turns. */
static iso_status draw_orbits(table *t)
{
    enum { IMAGES = 8 };
    const double pi = acos(-1);
    double(*at)[2] = calloc(IMAGES * t->count, sizeof *at);
    uint32_t *orbit = calloc(IMAGES * t->count, sizeof *orbit);
    bool *grey = calloc(t->count, sizeof *grey);
    for (size_t n = 0; at && orbit && grey && n < IMAGES * t->count; n++) {
        const size_t i = n / IMAGES;
        const double sign = n & 1 ? -1 : 1;
        grey[i] = is(t, i, "stability", "unstable") || is(t, i, "stability", "inverse");
        orbit[n] = (uint32_t)i;
        at[n][0] = remainder(sign * number(t, i, "l") + (n & 2 ? pi : 0), 2 * pi);
        at[n][1] = (n & 4 ? -sign : sign) * number(t, i, "x");
    }
    snprintf(t->title + strlen(t->title), sizeof t->title - strlen(t->title),
             ": a crossing of each orbit, its images");
    const iso_plot_section plot = {.title = t->title,
                                   .params = &t->params,
                                   .axis = t->axis,
                                   .count = IMAGES * t->count,
                                   .orbit = orbit,
                                   .ball = (const double(*)[2])at,
                                   .point = (const double(*)[2])at,
                                   .orbits = t->count,
                                   .grey = grey,
                                   .grey_means = "unstable"};
    const iso_status status = at && orbit && grey ? iso_plot_sections(t->ctx, t->output, &plot)
                                                  : iso_context_no_memory(t->ctx, "a picture");
    free(at);
    free(orbit);
    free(grey);
    return status;
}

/* --- what varies ------------------------------------------------------------------------------------------------ */

static iso_status draw_branches(table *t)
{
    static const char *const names[] = {"branch", "value", "x", "trace"};
    const char *varies = iso_record_name(t->rows, 3);
    iso_record *points;
    iso_status status = iso_record_create(t->ctx, 4, names, &points);
    for (size_t i = 0; i < t->count && status == ISO_OK; i++)
        if (is(t, i, "event", ""))
            status = put(t, points,
                         (double[]){number(t, i, "branch") - 1, number(t, i, varies),
                                    2 * number(t, i, "u") / acos(-1), number(t, i, "trace")});
    if (status == ISO_OK) status = iso_plot_branches(t->ctx, t->output, t->title, varies, points);
    iso_record_free(points);
    return status;
}

/* A row of a border has a trace for one of the two rotations. */
static iso_status put_chart_row(const table *t, size_t i, const char *varies, iso_record *grid, iso_record *borders)
{
    const double k = number(t, i, "k"), value = number(t, i, varies), least = number(t, i, "least"),
                 greatest = number(t, i, "greatest");
    if (is(t, i, "kind", "grid")) return put(t, grid, (double[]){k, value, least, greatest});
    return put(t, borders, (double[]){isnan(least), isnan(least) ? greatest : least, k, value});
}

static iso_status draw_chart(table *t)
{
    static const char *const of_grid[] = {"k", "value", "least", "greatest"}, *const of_border[] = {"axis", "trace",
                                                                                                    "k", "value"};
    const char *varies = iso_record_name(t->rows, 2);
    iso_record *grid = NULL, *borders = NULL;
    iso_status status = iso_record_create(t->ctx, 4, of_grid, &grid);
    if (status == ISO_OK) status = iso_record_create(t->ctx, 4, of_border, &borders);
    for (size_t i = 0; i < t->count && status == ISO_OK; i++) status = put_chart_row(t, i, varies, grid, borders);
    if (status == ISO_OK) status = iso_plot_stability(t->ctx, t->output, t->title, varies, grid, borders);
    iso_record_free(grid);
    iso_record_free(borders);
    return status;
}

static iso_status draw_splitting(table *t)
{
    const bool by_level = t->count > 1 && number(t, 0, "k") == number(t, 1, "k");
    const char *const names[] = {by_level ? "level" : "k", "m", "error"};
    iso_record *rows;
    iso_status status = iso_record_create(t->ctx, 3, names, &rows);
    for (size_t i = 0; i < t->count && status == ISO_OK; i++)
        status = put(t, rows, (double[]){number(t, i, names[0]), number(t, i, "m"), number(t, i, "error")});
    if (status == ISO_OK) status = iso_plot_splitting(t->ctx, t->output, t->title, rows, NULL, NAN, 0);
    iso_record_free(rows);
    return status;
}

/* --- the kinds -------------------------------------------------------------------------------------------------- */

static const struct kind {
    const char *name;
    const char *columns[5]; /* that the picture needs; NULL ends them */
    bool axis;              /* and the line "axis"                    */
    iso_status (*draw)(table *t);
} kinds[] = {
    {"section", {"orbit", "l", "x"}, true, draw_section},
    {"chaos", {"l", "x", "verdict"}, true, draw_chaos},
    {"periodic", {"l", "x", "stability"}, true, draw_orbits},
    {"periodic follow", {"branch", "u", "trace", "event"}, false, draw_branches},
    {"periodic chart", {"kind", "k", "least", "greatest"}, false, draw_chart},
    {"splitting", {"k", "level", "m", "error"}, false, draw_splitting},
};

static const struct kind *find_kind(const char *name)
{
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (strcmp(kinds[i].name, name) == 0) return &kinds[i];
    return NULL;
}

bool has_table_picture(const char *name)
{
    return find_kind(name) != NULL;
}

static iso_status check(table *t, const struct kind *kind)
{
    for (size_t i = 0; kind->columns[i]; i++)
        if (iso_record_find(t->rows, kind->columns[i]) < 0)
            return iso_context_fail(t->ctx, ISO_BAD_INPUT, "", "no picture: the table has no column '%s'",
                                    kind->columns[i]);
    if (t->count == 0) return iso_context_fail(t->ctx, ISO_BAD_INPUT, "", "no picture: the table has no rows");
    if (!kind->axis || (t->axis >= 0 && t->axis <= 2)) return ISO_OK;
    return iso_context_fail(t->ctx, ISO_BAD_INPUT, "",
                            "no picture: the table does not say its axis, in a line '# axis: 3'");
}

iso_status plot_table(iso_context *ctx, const char *path, const char *output)
{
    iso_record *rows = NULL;
    iso_status status = iso_table_read(ctx, path, NULL, &rows);
    if (status != ISO_OK) return status;
    const char *axis = iso_record_get(rows, "axis");
    table t = {.ctx = ctx, .rows = rows, .count = iso_record_rows(rows), .axis = axis ? axis[0] - '1' : -1};
    const struct kind *kind = find_kind(iso_record_kind(rows));
    t.output = output;
    status = check(&t, kind);
    if (status == ISO_OK) status = iso_record_params(ctx, rows, &t.params);
    const double *J = t.params.J;
    const char *slash = strrchr(path, '/');
    snprintf(t.title, sizeof t.title, "%.60s: k = %.6g, J = %.6g %.6g %.6g", slash ? slash + 1 : path, t.params.k,
             J[0], J[1], J[2]);
    if (status == ISO_OK) status = kind->draw(&t);
    iso_record_free(rows);
    return status;
}

/* isoroll plot - draws a trajectory: the path in space, paths on the spheres, energies, integrals, clocks; or any two
 * of its columns. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/nearest_impl.h"
#include "io/table.h"
#include "orbit/description.h"
#include "parameters.h"
#include "plot/draw.h"
#include "plot/plot.h"
#include "study/check/check_impl.h"
#include "study/energy.h"
#include "sweep/sweep_store_impl.h"

typedef struct options {
    file_options from;
    iso_plot_page page;
    const char *value; /* NULL: not given */
} options;

/* What is drawn: the file, its conversion, and numbers from both. */
typedef struct parts {
    iso_record *file, *twin, *drifts, *paces, *energies;
} parts;

/* The model of the file; the ball if it has both. */
static iso_model_kind model_of(const iso_record *record)
{
    return iso_record_find(record, "n1") >= 0 && iso_record_find(record, "omega1") >= 0 ? ISO_BALL : ISO_POINT;
}

/* ds/dt and dtau/dt in every row, up to their factors: powers of q = (gamma, J gamma), (16) and (24) of the theory. */
static iso_status add_paces(iso_context *ctx, const iso_params *params, const iso_record *r, int clock,
                            iso_record *paces)
{
    const bool ball = model_of(r) == ISO_BALL;
    const int place = iso_record_find(r, ball ? "n1" : "gamma1");
    double first = 0;
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        double y[ISO_STATE] = {0};
        const double *row = iso_record_const_row(r, i), e = 1 / (2 * params->k);
        for (int c = 0; c < 3; c++) y[3 + c] = row[place + c];
        const double q = iso_system_at(ball ? ISO_BALL : ISO_POINT)->q(params, y, NULL);
        if (i == 0) first = q;
        ISO_TRY(iso_record_add(ctx, paces, 1, (double[]){row[clock], pow(q / first, 1 + e), pow(q / first, 1 - e)}));
    }
    return ISO_OK;
}

/* Makes the mean of a column 1. */
static void divide_by_mean(iso_record *r, int column)
{
    double sum = 0;
    const size_t rows = iso_record_rows(r);
    for (size_t i = 0; i < rows; i++) sum += iso_record_const_row(r, i)[column];
    for (size_t i = 0; i < rows; i++) iso_record_row(r, i)[column] *= (double)rows / sum;
}

/* Where there is a twin, there are other clocks. */
static iso_status find_paces(iso_context *ctx, const iso_params *params, parts *p)
{
    const char *names[] = {model_of(p->file) == ISO_BALL ? "t" : "s", "ds/dt", "dtau/dt"};
    const int clock = iso_record_find(p->file, names[0]);
    const bool both = iso_record_find(p->file, "n1") >= 0 && iso_record_find(p->file, "gamma1") >= 0;
    if (clock < 0 || !(p->twin || both)) return ISO_OK;
    ISO_TRY(iso_record_create(ctx, 3, names, &p->paces));
    ISO_TRY(add_paces(ctx, params, p->file, clock, p->paces));
    for (int c = 1; c < 3; c++) divide_by_mean(p->paces, c);
    return ISO_OK;
}

/* Converts the file. A ball at rest, or with effects that break the isomorphism, has no twin and is drawn alone. */
static iso_status find_twin(iso_context *ctx, const iso_params *params, parts *p)
{
    if (iso_record_find(p->file, "n1") >= 0 && iso_record_find(p->file, "gamma1") >= 0) return ISO_OK;
    const iso_model_kind to = model_of(p->file) == ISO_BALL ? ISO_POINT : ISO_BALL;
    const iso_status status = iso_convert(ctx, params, p->file, to, 1e-12, &p->twin);
    if (status != ISO_NOT_MAPPED) return status;
    complain("%s is drawn alone: %s", to == ISO_POINT ? "the ball" : "the point", iso_context_message(ctx));
    return ISO_OK;
}

static const char *name_of(const options *o)
{
    const char *slash = strrchr(o->from.file, '/');
    return slash ? slash + 1 : iso_text_name(o->from.file);
}

/* Whether the file has the path of a ball in space; into `space`, what the file says of it. */
static bool find_space(iso_context *ctx, const iso_params *params, const iso_record *file, double up[3],
                       iso_plot_space *space)
{
    *space = (iso_plot_space){.rows = file, .plane = params->k == 1};
    if (iso_record_up(ctx, file, up)) space->up = up;
    return iso_record_find(file, "centre1") >= 0 || iso_record_find(file, "contact1") >= 0;
}

static iso_status draw(iso_context *ctx, const options *o, const iso_params *params, parts *p)
{
    char title[ISO_PLOT_HEADING];
    double up[3];
    iso_plot_space space;
    iso_status status = find_twin(ctx, params, p);
    if (status == ISO_OK) status = find_paces(ctx, params, p);
    if (status == ISO_OK) status = iso_check_drifts(ctx, params, p->file, &p->drifts);
    /* of a free ball the energy is one of the integrals, whose drift is drawn */
    const bool forced = model_of(p->file) == ISO_BALL && iso_record_get(p->file, "effects");
    if (status == ISO_OK && forced) status = iso_record_energies(ctx, params, p->file, &p->energies);
    if (status != ISO_OK) return status;
    const bool ball = iso_record_find(p->file, "n1") >= 0, point = iso_record_find(p->file, "gamma1") >= 0;
    const bool in_space = find_space(ctx, params, p->file, up, &space);
    const bool twins = (ball || point) && (p->twin || (ball && point));
    const char *seen = in_space ? "The path of a ball"
                       : twins  ? "One orbit on both spheres"
                       : ball   ? "A ball without a twin"
                                : "A point without a twin";
    iso_plot_heading(title, seen, params);
    const iso_plot_orbit plot = {.title = title,
                                 .ball = ball ? p->file : p->twin,
                                 .point = point ? p->file : p->twin,
                                 .drift = p->drifts,
                                 .paces = p->paces,
                                 .energies = p->energies,
                                 .space = in_space ? &space : NULL};
    return iso_plot_trajectory(ctx, &o->page, &plot);
}

/* --- two columns ------------------------------------------------------------------------------------------------ */

enum { NAME = 32 };

/* Whether --columns names two columns; "-" stands for a column that is not read, and is not counted. */
static bool names_two(const char *columns, char name[2][NAME])
{
    int count = 0;
    for (const char *c = columns; c && *c; c += strcspn(c, ","), c += *c == ',') {
        const int length = (int)strcspn(c, ",");
        if (length == 1 && *c == '-') continue;
        if (count < 2 && length < NAME) snprintf(name[count], NAME, "%.*s", length, c);
        if (length >= NAME) return false;
        count++;
    }
    return count == 2;
}

/* Reads a file, and says how many rows of nan it passes over. */
static iso_status read_good(iso_context *ctx, const options *o, const char *columns, iso_record **file)
{
    size_t passed;
    const iso_status status = iso_table_read(ctx, o->from.file, "trajectory", columns, file, &passed);
    if (status != ISO_OK || passed == 0) return status;
    complain("%s: %zu rows of nan were passed over", name_of(o), passed);
    return ISO_OK;
}

/* Reads the file by its own names of columns. If it has none, or if --columns has a "-", by those of --columns. */
static iso_status read_two(iso_context *ctx, const options *o, iso_record **file)
{
    const bool passes = strstr(o->from.columns, "-") != NULL, once = strcmp(o->from.file, "-") == 0;
    const iso_status status = read_good(ctx, o, passes ? o->from.columns : NULL, file);
    if (status == ISO_OK || passes || once) return status;
    if (read_good(ctx, o, o->from.columns, file) == ISO_OK) return ISO_OK;
    return read_good(ctx, o, NULL, file); /* once more, for its words */
}

static iso_status find_column(iso_context *ctx, const iso_record *r, const char *name)
{
    char suggested[ISO_SUGGEST_SIZE];
    const char *names[ISO_TRAJECTORY_COLUMNS];
    size_t count = 0;
    if (iso_record_find(r, name) >= 0) return ISO_OK;
    for (; count < iso_record_columns(r) && count < ISO_TRAJECTORY_COLUMNS; count++)
        names[count] = iso_record_name(r, count);
    return iso_context_fail(ctx, ISO_BAD_INPUT, "columns", "there is no column '%s'; %s", name,
                            iso_suggest(suggested, name, count, names));
}

/* Whether x and y are components of one vector: one unit is then equally long on both axes. */
static bool are_components(const char *x, const char *y)
{
    const size_t length = strlen(x);
    return length > 1 && strlen(y) == length && strncmp(x, y, length - 1) == 0 && x[0] != 'q' &&
           strchr("123", x[length - 1]) && strchr("123", y[length - 1]);
}

/* k and J, if the file says them; else "": the axes have names. */
static void what_is_drawn(iso_context *ctx, const iso_record *r, char title[static ISO_PLOT_TITLE])
{
    iso_params params;
    *title = '\0';
    if (iso_record_params(ctx, r, &params) == ISO_OK) iso_plot_title(title, &params, "%s", "");
}

static iso_status draw_two(iso_context *ctx, const options *o, char name[2][NAME])
{
    char title[ISO_PLOT_TITLE];
    iso_record *file = NULL;
    iso_status status = read_two(ctx, o, &file);
    for (int i = 0; status == ISO_OK && i < 2; i++) status = find_column(ctx, file, name[i]);
    if (status == ISO_OK) {
        what_is_drawn(ctx, file, title);
        status = iso_plot_columns(ctx, &o->page, title, file, name[0], name[1], are_components(name[0], name[1]));
    }
    iso_record_free(file);
    return status;
}

/* --- the command ------------------------------------------------------------------------------------------------ */

static iso_status draw_file(iso_context *ctx, const options *o)
{
    parts p = {NULL, NULL, NULL, NULL, NULL};
    iso_params params;
    iso_status status = read_good(ctx, o, o->from.columns, &p.file);
    if (status == ISO_OK) status = parameters_of_file(ctx, &o->from, p.file, &params);
    if (status == ISO_OK) status = draw(ctx, o, &params, &p);
    iso_record_free(p.file);
    iso_record_free(p.twin);
    iso_record_free(p.drifts);
    iso_record_free(p.paces);
    iso_record_free(p.energies);
    return status;
}

/* A sweep is read with its sum: one that was changed is refused. */
static iso_status draw_table(iso_context *ctx, const options *o, bool sweep)
{
    char value[NAME * 4] = "";
    iso_record *table = NULL;
    if (o->value) snprintf(value, sizeof value, "value=%s", o->value);
    iso_status status = sweep ? iso_sweep_read_table(ctx, o->from.file, &table)
                              : iso_table_read(ctx, o->from.file, NULL, NULL, &table, NULL);
    if (status == ISO_OK)
        status = sweep ? plot_tables(ctx, &o->page, (const iso_record *[]){table, NULL}, value)
                       : iso_plot_table(ctx, &o->page, table);
    iso_record_free(table);
    return sweep ? name_the_file(ctx, o->from.file, status) : status;
}

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    char name[2][NAME], kind[ISO_KIND_SIZE] = "";
    if (strcmp(o->page.path, "-") == 0)
        return complain("plot: -o FILE is missing: name a file that ends in .svg, .png or .pdf"), EXIT_USAGE;
    iso_status status = iso_plot_check_page(ctx, &o->page);
    progress_begin();
    if (status == ISO_OK) iso_table_kind(o->from.file, kind);
    const bool sweep = strcmp(kind, "sweep") == 0 || strcmp(kind, "sweep part") == 0;
    if (sweep && o->from.columns)
        return complain("plot: --columns is for trajectories; of a sweep give --value NAME"), EXIT_USAGE;
    const char *wish = iso_plot_section_wish(&o->page);
    if (wish && !iso_plot_has_kind(kind)) return complain("plot: --%s is for sections", wish), EXIT_USAGE;
    if (*kind && strcmp(kind, "trajectory") != 0 && !iso_plot_has_kind(kind))
        return complain("plot: there is no picture of a table '%s'", kind), EXIT_USAGE;
    if (status == ISO_OK && o->value && !sweep)
        status = iso_context_fail(ctx, ISO_BAD_ARGUMENT, "value", "plot: --value is for results of sweeps");
    if (status == ISO_OK && !o->from.columns && iso_plot_has_kind(kind))
        return finish(ctx, draw_table(ctx, o, sweep));
    if (status == ISO_OK) status = names_two(o->from.columns, name) ? draw_two(ctx, o, name) : draw_file(ctx, o);
    return finish(ctx, name_the_file(ctx, o->from.file, status));
}

static const options defaults = {.from = FILE_OPTIONS_UNSET, .page = {.path = "-"}};

static const option_row rows[] = {
    ROW_OF_FILE("output", "FILE", "a file", "the picture: .svg, .png or .pdf", iso_set_text, options, page.path, 'o',
                OPTION_WRITES),
    ROWS_OF_LOOK(options, page),
    ROWS_OF_SECTION(options, page),
    ROW("value", "NAME", "a name", "of a sweep: which column is drawn, such as splitting_m", iso_set_text, options,
        value),
    ROWS_OF_FILE(options, from),
    ROW_END,
};

const command command_plot = {
    COMMAND("plot", "[FILE]", "draw a trajectory, or any other table", from.file),
    .takes = FILE_ROWS | FILE_RESULT | FILE_TABLE,
    .description =
        "-o FILE is needed; its ending chooses the format. The path and the clock of the other model are "
        "computed, where the orbit has a twin. If the file has the columns of the effect attitude, the "
        "picture also shows the path of the ball from above and from the side; if it has those of "
        "reactions, also the pressure, the friction coefficient mu, and where contact is lost.\n\n"
        "--columns X,Y draws only these two columns: Y upward, X to the right, as in --columns t,n3. If "
        "the file has no names of columns, name its columns from left to right, with - for each that "
        "is not drawn.\n\n"
        "Of a sweep: a value over the number that varies, as a curve with its error; over two numbers, as "
        "a map; over J, as a map of J1/J3 and J2/J3 where J1 < J2 < J3. Further numbers that vary make "
        "several maps. k = 1 and k = -1 are marked.\n\nOther tables are drawn from their columns, without "
        "computing anew: sections; the starts of chaos, coloured by exponent; periodic orbits, by one "
        "crossing of each and its images; branches of --follow; charts; splittings; costs.\n\ngnuplot draws "
        "the picture. On the screen its letters grow with --size. --style print has letters of 8 pt; without "
        "--size it is 86 mm wide if it is one panel, else 178 mm. A px is a pixel of a .png, and 1/96 inch "
        "elsewhere. --script "
        "FILE keeps the script of gnuplot with its data: gnuplot -d FILE >PICTURE draws the same.",
    .example = "isoroll plot trajectory.csv -o trajectory.svg",
};

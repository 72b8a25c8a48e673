/* isoroll plot - draws a trajectory: the path in space, paths on the spheres, energies, integrals, clocks; or any two
 * of its columns. */
#include <stdio.h>
#include <string.h>

#include "command.h"
#include "embedded.h"
#include "io/table.h"
#include "plot/draw.h"
#include "sweep/sweep_store_impl.h"

typedef struct options {
    file_options from;
    iso_plot_page page;
    const char *value; /* NULL: not given */
} options;

static const char *name_of(const options *o)
{
    const char *slash = strrchr(o->from.file, '/');
    return slash ? slash + 1 : iso_text_name(o->from.file);
}

/* --- two columns ------------------------------------------------------------------------------------------------ */

enum { NAME = 32 };
#define TRAJECTORY "trajectory"

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

/* Reads a table of this kind, and says how many rows of nan it passes over. */
static iso_status read_good(iso_context *ctx, const options *o, const char *kind, const char *columns,
                            iso_record **file)
{
    size_t passed;
    const iso_status status = iso_table_read(ctx, o->from.file, kind, columns, file, &passed);
    if (status != ISO_OK || passed == 0) return status;
    warn("%s: %zu rows of nan were passed over", name_of(o), passed);
    return ISO_OK;
}

/* Reads the file by its own names of columns. If it has none, or if --columns has a "-", by those of --columns. */
static iso_status read_two(iso_context *ctx, const options *o, const char *kind, iso_record **file)
{
    if (strcmp(kind, TRAJECTORY) != 0) return read_good(ctx, o, NULL, NULL, file);
    const bool passes = strstr(o->from.columns, "-") != NULL, once = strcmp(o->from.file, "-") == 0;
    const iso_status status = read_good(ctx, o, kind, passes ? o->from.columns : NULL, file);
    if (status == ISO_OK || passes || once) return status;
    if (read_good(ctx, o, kind, o->from.columns, file) == ISO_OK) return ISO_OK;
    return read_good(ctx, o, kind, NULL, file); /* once more, for its words */
}

static iso_status draw_two(iso_context *ctx, const options *o, const char *kind, char name[2][NAME])
{
    char wish[2 * NAME + 16];
    iso_record *file = NULL;
    iso_status status = read_two(ctx, o, kind, &file);
    snprintf(wish, sizeof wish, "columns=%s,%s", name[0], name[1]);
    if (status == ISO_OK) status = plot_tables(ctx, &o->page, (const iso_record *[]){file, NULL}, wish);
    iso_record_free(file);
    return status;
}

/* --- the command ------------------------------------------------------------------------------------------------ */

static iso_status draw_file(iso_context *ctx, const options *o)
{
    iso_params params;
    iso_record *file = NULL;
    iso_status status = read_good(ctx, o, TRAJECTORY, o->from.columns, &file);
    if (status == ISO_OK) status = parameters_of_file(ctx, &o->from, file, &params);
    if (status == ISO_OK) status = plot_tables(ctx, &o->page, (const iso_record *[]){file, NULL}, NULL);
    iso_record_free(file);
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
                       : plot_table(ctx, &o->page, table);
    iso_record_free(table);
    return sweep ? name_the_file(ctx, o->from.file, status) : status;
}

/* A kind of the library's list, or one of which there is a template. */
static bool has_picture(const char *kind)
{
    return iso_picture_has(kind) || embedded_find(picture_files, kind)->name;
}

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    char name[2][NAME], kind[ISO_KIND_SIZE] = "";
    if (strcmp(o->page.path, "-") == 0)
        return warn("plot: -o FILE is missing: name a file that ends in .svg, .png or .pdf"), EXIT_USAGE;
    iso_status status = iso_plot_check_page(ctx, &o->page);
    progress_begin();
    if (status == ISO_OK) iso_table_kind(o->from.file, kind);
    const bool sweep = strcmp(kind, "sweep") == 0 || strcmp(kind, "sweep part") == 0;
    if (sweep && o->from.columns)
        return warn("plot: --columns is for trajectories; of a sweep give --value NAME"), EXIT_USAGE;
    const char *wish = iso_plot_section_wish(&o->page);
    if (!*kind) strcpy(kind, TRAJECTORY); /* a file of others */
    const bool trajectory = strcmp(kind, TRAJECTORY) == 0;
    const char *given = file_option_given(&o->from);
    if (wish && (sweep || trajectory || o->from.columns || !has_picture(kind)))
        return warn("plot: --%s is for sections", wish), EXIT_USAGE;
    if (given && !trajectory && strcmp(given, "columns") != 0)
        return warn("plot: --%s is for trajectories", given), EXIT_USAGE;
    if (!sweep && !has_picture(kind)) return warn("plot: there is no picture of a table '%s'", kind), EXIT_USAGE;
    if (status == ISO_OK && o->value && !sweep)
        status = ISO_FAIL_ARGUMENT(ctx, "value", "plot: --value is for results of sweeps");
    if (status == ISO_OK && !o->from.columns && !trajectory) return finish(ctx, draw_table(ctx, o, sweep));
    if (status == ISO_OK)
        status = names_two(o->from.columns, name) ? draw_two(ctx, o, kind, name) : draw_file(ctx, o);
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
        "FILE keeps the script of gnuplot with its data: gnuplot -d FILE >PICTURE draws the same. --template FILE "
        "draws with a template of your own; copy one of those in share/isoroll/pictures.",
    .example = "isoroll plot trajectory.csv -o trajectory.svg",
};

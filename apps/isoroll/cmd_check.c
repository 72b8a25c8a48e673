/* isoroll check - tests whether a trajectory solves its model. */
#include <math.h>
#include <string.h>

#include "json.h"
#include "parameters.h"
#include "study/check/check_impl.h"

typedef struct options {
    file_options from;
    double tolerance, bound; /* NAN: not given */
    bool json;
} options;

/* What is found out about a file. */
typedef struct findings {
    iso_residuals residuals;
    json_t *unseen; /* names of what is not looked at */
    bool lost;      /* there was no memory for a name in it */
} findings;

static bool is_bad(const options *o, const iso_residual *r)
{
    return !isnan(o->bound) && !(r->worst <= o->bound);
}

static bool any_bad(const options *o, const iso_residuals *r)
{
    bool bad = false;
    for (int i = 0; i < r->count; i++) bad = bad || is_bad(o, &r->residual[i]);
    return bad;
}

/* --- what is printed -------------------------------------------------------------------------------------------- */

/* Names with commas between, in lines of at most WIDTH characters. */
static void print_names(const char *title, const json_t *names)
{
    enum { WIDTH = 100 };
    int used = printf("%s", title);
    for (size_t i = 0; i < json_array_size(names); i++) {
        const char *name = json_string_value(json_array_get(names, i));
        if (used + (int)strlen(name) + 2 > WIDTH) used = printf("\n   ") - 1;
        used += printf(" %s%s", name, i + 1 < json_array_size(names) ? "," : "");
    }
    printf("\n");
}

static void print_table(const options *o, const findings *f)
{
    const iso_residuals *r = &f->residuals;
    printf("%zu rows", r->rows);
    if (r->passed > 0) printf(", %zu of nan passed over", r->passed);
    printf("\n%-22s %10s %9s  %s\n", "residual", "worst", "at row", "of");
    for (int i = 0; i < r->count; i++) {
        const iso_residual *x = &r->residual[i];
        printf("%-22s %10.2e %9zu  %s%s\n", x->name, x->worst, x->row, x->what,
               is_bad(o, x) ? "  ABOVE THE BOUND" : "");
    }
    if (json_array_size(f->unseen) > 0) print_names("not looked at:", f->unseen);
}

static bool print_json(const options *o, const findings *f)
{
    static const iso_field counts[] = {ISO_MEMBER(iso_residuals, "rows", rows, "", "of the file"),
                                       ISO_MEMBER(iso_residuals, "passed_over", passed, "", "rows of nan"),
                                       ISO_FIELD_END},
                           all[] = {ISO_LIST(iso_residuals, "residuals", residual, count, iso_residual_fields, "all"),
                                    ISO_FIELD_END};
    json_t *made = json_of(counts, &f->residuals), *one;
    size_t i;
    json_put(made, "bound", json_number(o->bound));
    json_add(made, all, &f->residuals);
    json_array_foreach(json_object_get(made, "residuals"), i, one)
        json_put(one, "above_the_bound", json_boolean(is_bad(o, &f->residuals.residual[i])));
    json_put(made, "not_looked_at", json_incref(f->unseen));
    return json_print(made);
}

/* --- the check -------------------------------------------------------------------------------------------------- */

static void keep(findings *f, json_t *name)
{
    f->lost = json_array_append_new(f->unseen, name) != 0 || f->lost;
}

static void keep_name(void *data, const char *name)
{
    keep(data, json_string(name));
}

/* Columns that are none of a trajectory never come so far that they could be compared. */
static void keep_ignored(const iso_table_reader *in, findings *f)
{
    const char *ignored = iso_table_at(in)->ignored;
    if (ignored) keep(f, json_sprintf("other columns: %s", ignored));
}

static iso_status end_check(iso_context *ctx, iso_checking *checking, const iso_table_reader *in, findings *f)
{
    iso_status status = iso_checking_end(checking, &f->residuals);
    if (status != ISO_OK) return status;
    f->unseen = json_array();
    keep_ignored(in, f);
    status = iso_checking_unseen(checking, keep_name, f);
    if (status != ISO_OK || (f->unseen && !f->lost)) return status;
    return iso_context_no_memory(ctx, "the names of what is not looked at");
}

/* Checks the rows one after the other, as they are read. A mistake in the first one is told before what the header
 * lacks. */
static iso_status check_rows(iso_context *ctx, const options *o, iso_table_reader *in, findings *f)
{
    double row[ISO_TRAJECTORY_COLUMNS];
    iso_params params;
    iso_checking *checking = NULL;
    iso_record *const header = iso_table_header(in);
    bool more;
    size_t passed = 0;
    iso_status status = iso_table_next(ctx, in, row, &more);
    if (status == ISO_OK) status = parameters_of_file(ctx, &o->from, header, &params);
    if (status == ISO_OK)
        status = iso_checking_create(ctx, &params, header, isnan(o->tolerance) ? 1e-13 : o->tolerance, &checking);
    while (status == ISO_OK) {
        for (; passed < iso_table_at(in)->passed; passed++) iso_checking_pass(checking);
        if (!more) break;
        if (iso_table_at(in)->begins_orbit) iso_checking_begin_orbit(checking);
        status = iso_checking_put(checking, row);
        if (status == ISO_OK) status = iso_table_next(ctx, in, row, &more);
    }
    if (status == ISO_OK) status = end_check(ctx, checking, in, f);
    iso_checking_free(checking);
    return status;
}

static int report(const options *o, const findings *f)
{
    if (o->json) {
        if (!print_json(o, f)) return EXIT_NUMERICAL;
    } else {
        print_table(o, f);
    }
    if (!any_bad(o, &f->residuals)) return EXIT_DONE;
    return complain("%s: a residual is above %g", o->from.file, o->bound), EXIT_SOME_FAILED;
}

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    iso_table_reader *in = NULL;
    findings f = {.residuals = {.rows = 0}};
    json_begin();
    iso_status status = iso_table_reader_open(ctx, o->from.file, "trajectory", o->from.columns, &in);
    if (status == ISO_OK) {
        iso_table_pass_nan(in);
        progress_begin();
        status = check_rows(ctx, o, in, &f);
        progress_end();
    }
    iso_table_reader_close(in);
    const int result = status == ISO_OK ? report(o, &f) : finish(ctx, name_the_file(ctx, o->from.file, status));
    json_decref(f.unseen);
    return result;
}

static const options defaults = {.from = FILE_OPTIONS_UNSET, .tolerance = NAN, .bound = NAN};

static const option_row rows[] = {
    ROW("tol", "X", "a number in " ISO_TOLERANCE_RANGE, "tolerance of the flow from row to row (default 1e-13)",
        iso_set_tolerance, options, tolerance),
    ROWS_OF_FILE(options, from),
    ROW("max", "X", "a number from 0 on", "exit with status 1 if a residual is larger than X", set_bound, options,
        bound),
    ROW_JSON(options, json),
    ROW_END,
};

const command command_check = {
    COMMAND("check", "[FILE]", "test whether a trajectory solves its model", from.file),
    .takes = FILE_ROWS,
    .description =
        "Prints residuals: of constraints, of integrals, of every column, and of the # lines that state an energy "
        "or the start. Residuals are relative. The residual 'flow' integrates each row to the time of the next row "
        "and compares. Rows are read one after the other, in constant memory.\n\n"
        "The last line, 'not looked at', names the columns and # lines on which no residual depends: they may hold "
        "anything. Any other number that is off by a millionth of the size of its vector is noticed.\n\n"
        "A file can hold several orbits of one energy: of section with --as, and of periodic -o, where each row is "
        "an orbit. Another orbit begins where the column 'orbit' changes. No flow goes from one orbit to the "
        "next.\n\n"
        "Rows of nan, which convert writes, are passed over and counted.",
    .example = "isoroll check trajectory.csv --max 1e-9",
    .exits = "1: a residual is larger than --max",
};

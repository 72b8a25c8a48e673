/* cmd_convert.c - `isoroll convert`: a filter that reads a trajectory of one model and writes that of the other. */
#include <math.h>
#include <string.h>

#include "base/number_impl.h"
#include "certified.h"
#include "file_kind.h"
#include "parameters.h"
#include "scene_options.h"
#include "task/convert/convert_impl.h"

typedef struct options {
    file_options from;
    const char *output;
    iso_model_kind to;            /* -1: not given  */
    double tolerance, max_defect; /* NAN: not given */
    int digits;
    bool shift_J, strict, quiet;
} options;

typedef struct filter {
    iso_context *ctx;
    const options *o;
    const char *name; /* of the file, in messages */
    iso_table_reader *in;
    iso_table_writer *out;
    iso_params params;
    iso_conversion *conversion;
    iso_conversion_summary all; /* of the orbits before this one */
    double orbit;               /* its number */
    size_t marks;               /* rows of orbits without a good row, which wait for the header */
    iso_status failure;         /* of the first such orbit */
    iso_record *header;         /* of the result; NULL: not yet written */
    size_t unnamed;             /* bad rows after the first NAMED */
    size_t named;
} filter;

enum { NAMED = 20, ALL_DIGITS = 17 };

/* One file states one energy, by lines of these names: later orbits must have that of the first. */
static iso_status check_energy(const filter *f, const iso_record *header)
{
    static const char *const keys[] = {"h", "eps", "level.c"};
    const double digits = 10 * iso_record_row_tolerance(iso_table_header(f->in));
    for (int i = 0; i < 3; i++) {
        double first = NAN, now = NAN;
        iso_status status = ISO_OK;
        iso_record_get_numbers(f->ctx, f->header, keys[i], 1, &first, &status);
        if (status == ISO_OK) iso_record_get_numbers(f->ctx, header, keys[i], 1, &now, &status);
        ISO_TRY(status);
        if ((isnan(first) && isnan(now)) || fabs(now - first) <= digits * fabs(first)) continue;
        return iso_context_fail(f->ctx, ISO_BAD_INPUT, "",
                                "orbit %s has %s = %.6g, the first one %.6g: convert orbits of different energies "
                                "one by one",
                                ISO_SHORT(f->orbit), keys[i], now, first);
    }
    return ISO_OK;
}

/* A row of nan for each row of orbits without a good one. */
static iso_status put_marks(filter *f)
{
    for (; f->marks > 0; f->marks--) ISO_TRY(iso_table_write_row(f->ctx, f->out, NULL));
    return ISO_OK;
}

/* A file of several orbits has the column `orbit` before the others, and one header. The time at which the first
 * orbit begins is not that of the others. */
static iso_status put_header(void *data, const iso_record *header)
{
    filter *f = data;
    const char *names[1 + ISO_TRAJECTORY_COLUMNS] = {"orbit"};
    const size_t own = iso_table_at(f->in)->orbits, columns = iso_record_columns(header);
    if (f->header) return check_energy(f, header);
    for (size_t i = 0; i < columns; i++) names[own + i] = iso_record_name(header, i);
    ISO_TRY(iso_record_create_like(f->ctx, header, own + columns, names, &f->header));
    if (own) ISO_TRY(iso_record_set(f->ctx, f->header, "t0", NULL));
    if (own) ISO_TRY(iso_record_set(f->ctx, f->header, "s0", NULL));
    ISO_TRY(iso_table_write_header(f->ctx, f->out, f->header));
    return put_marks(f);
}

static iso_status put_row(void *data, const double row[])
{
    filter *f = data;
    double with_orbit[1 + ISO_TRAJECTORY_COLUMNS] = {f->orbit};
    if (!row || !iso_table_at(f->in)->orbits) return iso_table_write_row(f->ctx, f->out, row);
    memcpy(with_orbit + 1, row, (iso_record_columns(f->header) - 1) * sizeof *row);
    return iso_table_write_row(f->ctx, f->out, with_orbit);
}

/* Names a bad row on stderr. After the first NAMED they are only counted. */
static void name_bad_row(filter *f, size_t line, const char *words)
{
    if (f->named == NAMED) {
        f->unnamed++;
        return;
    }
    f->named++;
    if (line > 0)
        complain("%s:%zu: %s", f->name, line, words);
    else
        complain("%s", words); /* they have the place */
}

/* A bad row ends the work only under --strict. */
static iso_status put_bad(void *data, size_t line, iso_status why, const char *words)
{
    filter *f = data;
    if (f->o->strict) return iso_context_fail(f->ctx, why, "", "%s:%zu: %s", f->name, line, words);
    name_bad_row(f, line, words);
    return ISO_OK;
}

static iso_status put_missed(void *data, size_t line, const char *words)
{
    return put_bad(data, line, ISO_BAD_INPUT, words);
}

static iso_status begin_orbit(filter *f)
{
    const iso_conversion_target target = {put_header, put_row, put_bad, put_missed, f};
    iso_conversion_options how = iso_conversion_defaults();
    if (!isnan(f->o->tolerance)) how.tolerance = f->o->tolerance;
    how.shift_J = f->o->shift_J;
    how.max_defect = f->o->max_defect;
    how.row_tolerance = f->o->from.added.row_tolerance;
    return iso_conversion_create(f->ctx, &f->params, iso_table_header(f->in), f->o->to, &how, &target,
                                 &f->conversion);
}

/* Ends an orbit, and adds its summary to that of those before. */
static iso_status end_orbit(filter *f)
{
    iso_conversion_summary one;
    const iso_status status = iso_conversion_end(f->conversion, &one);
    iso_conversion_free(f->conversion);
    f->conversion = NULL;
    iso_conversion_summary_add(&f->all, &one);
    if (status == ISO_OK || !iso_table_at(f->in)->orbits || one.rows == 0 || one.bad < one.rows) return status;
    f->marks += one.rows;
    if (f->failure == ISO_OK) f->failure = status;
    return f->header ? put_marks(f) : ISO_OK;
}

/* One row from in to out. */
static iso_status filter_row(filter *f, double row[], bool *more)
{
    const iso_status status = iso_table_next(f->ctx, f->in, row, more);
    if (status == ISO_OK && *more && iso_table_at(f->in)->begins_orbit) {
        ISO_TRY(end_orbit(f));
        ISO_TRY(begin_orbit(f));
    }
    if (status == ISO_OK) f->orbit = iso_table_at(f->in)->orbit;
    if (status == ISO_OK) return *more ? iso_conversion_put(f->conversion, row, iso_table_at(f->in)->line) : ISO_OK;
    if (status != ISO_BAD_INPUT || f->o->strict) return status;
    name_bad_row(f, 0, iso_context_message(f->ctx));
    return iso_conversion_skip(f->conversion);
}

static iso_status filter_rows(filter *f)
{
    double row[ISO_TRAJECTORY_COLUMNS];
    iso_status status = ISO_OK;
    bool more = true;
    while (status == ISO_OK && more && !interrupted()) status = filter_row(f, row, &more);
    if (status == ISO_OK && more) status = iso_context_stopped(f->ctx);
    iso_context_set_monitor(f->ctx, NULL, NULL);
    const bool settle = status == ISO_OK || status == ISO_STOPPED;
    const iso_status ended = settle && f->conversion ? end_orbit(f) : status;
    if (status == ISO_OK && ended == ISO_OK && !f->header) return f->failure;
    return status == ISO_OK ? ended : status;
}

/* Two lines at the end of the file: how the other clock was computed, and its error. */
static iso_status write_clock(filter *f, const iso_conversion_summary *s)
{
    char key[2][ISO_NAME_SIZE], text[2][160];
    if (!iso_conversion_clock_lines(s, key, text)) return ISO_OK;
    const iso_status status = iso_table_write_line(f->ctx, f->out, key[0], text[0]);
    return status == ISO_OK ? iso_table_write_line(f->ctx, f->out, key[1], text[1]) : status;
}

static void report_summary(const filter *f, const iso_conversion_summary *s)
{
    complain("%s: %zu rows, %zu bad; worst: constraint %.2g (line %zu), energy %.2g (line %zu)", f->name, s->rows,
             s->bad, s->constraint.value, s->constraint.line, s->energy.value, s->energy.line);
    if (!s->checked) {
        complain("%s: no clock, so not known whether the rows lie on one orbit", f->name);
        return;
    }
    complain("%s: rows against the orbit through the ones before: defect %.2g (line %zu), drift %.2g (line %zu)",
             f->name, s->defect.value, s->defect.line, s->drift.value, s->drift.line);
    if (s->computed)
        complain("%s: %s = %.6g at the end, error about %.2g; %zu intervals by two-point Taylor quadrature, %zu by "
                 "integration",
                 f->name, iso_clock_name(s->clock), s->end, s->error, s->between, s->integrated);
}

/* Lines of the file that its first row does not confirm. */
static void warn_of_lines(const filter *f, const iso_conversion_summary *s)
{
    char words[ISO_STATED_SIZE];
    for (int i = 0; iso_conversion_stated_words(s, i, words); i++) complain("%s: %s", f->name, words);
}

/* Says what is wrong with the rows; true: nothing. */
static bool report_verdict(const filter *f, const iso_conversion_summary *s)
{
    char text[ISO_VERDICT_SIZE];
    size_t line;
    if (s->bad > 0)
        complain("%s: %zu of %zu rows could not be converted: nan stands in their place", f->name, s->bad, s->rows);
    if (!iso_conversion_verdict(s, text, &line)) return s->bad == 0;
    complain("%s:%zu: %s (--row-tolerance X is for few digits, --max-defect X sets another bound)", f->name, line,
             text);
    return false;
}

static int finish_filter(filter *f, iso_status status)
{
    const iso_conversion_summary *s = &f->all;
    if (status == ISO_OK || status == ISO_STOPPED) {
        const iso_status written = f->header ? write_clock(f, s) : ISO_OK;
        if (status == ISO_OK) status = written;
    }
    if (f->unnamed > 0) complain("%s: %zu more rows are not named", f->name, f->unnamed);
    const bool keep = f->header && (status == ISO_OK || status == ISO_STOPPED);
    const int result = finish(f->ctx, name_the_file(f->ctx, f->o->from.file, status));
    const iso_status closed = iso_table_writer_close(f->ctx, f->out, keep);
    if (closed != ISO_OK) return result == EXIT_DONE ? finish(f->ctx, closed) : result;
    if (status == ISO_STOPPED) complain("interrupted: %zu rows were converted", s->rows - s->bad);
    if (status != ISO_OK) return result;
    warn_of_lines(f, s);
    if (!f->o->quiet) report_summary(f, s);
    return report_verdict(f, s) ? EXIT_DONE : EXIT_SOME_FAILED;
}

static iso_status open_filter(filter *f)
{
    const options *o = f->o;
    iso_status status = iso_table_reader_open(f->ctx, o->from.file, "trajectory", o->from.columns, &f->in);
    if (status == ISO_OK) status = parameters_of_file(f->ctx, &o->from, iso_table_header(f->in), &f->params);
    if (status == ISO_OK) status = begin_orbit(f);
    if (status != ISO_OK) return status;
    if (iso_table_at(f->in)->ignored && !o->quiet)
        complain("%s: passed over: %s", f->name, iso_table_at(f->in)->ignored);
    begin_work(f->ctx, o->output);
    status = iso_table_writer_open(f->ctx, o->output, "trajectory", &f->out);
    if (status == ISO_OK) iso_table_set_digits(f->out, o->digits);
    return status;
}

/* --- certified orbits ------------------------------------------------------------------------------------------- */

static bool is_certified(const char *path)
{
    char table[ISO_KIND_SIZE];
    return file_kind(path, table) == FILE_CERTIFIED;
}

static iso_status check_certified(iso_context *ctx, const options *o)
{
    const iso_added *added = &o->from.added;
    const certified_option others[] = {{o->digits != ALL_DIGITS, "digits"},
                                       {!isnan(o->tolerance), "tol"},
                                       {!isnan(added->k), "k"},
                                       {!isnan(added->J[0]), "J"},
                                       {!isnan(added->eps), "eps"},
                                       {!isnan(added->h), "h"},
                                       {o->from.scene != NULL, "scene"},
                                       {o->from.columns != NULL, "columns"},
                                       {added->row_tolerance != ISO_ROW_TOLERANCE, "row-tolerance"},
                                       {!isnan(o->max_defect), "max-defect"},
                                       {o->shift_J, "shift-J"},
                                       {iso_table_is_hdf5(o->output), "output"},
                                       {false, NULL}};
    return certified_refuse(
        ctx, others, "a certified orbit has all numbers in its file, and becomes a text file with as many digits");
}

static int convert_certified(iso_context *ctx, const options *o)
{
    certified_file to = {ctx, o->output, NULL};
    const iso_certify_sink sink = {certified_line, NULL, &to};
    iso_status status = check_certified(ctx, o);
    size_t rows = 0;
    FILE *file = status == ISO_OK ? fopen(o->from.file, "re") : NULL;
    if (status == ISO_OK && !file)
        status = iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "'%s': cannot be read", o->from.file);
    if (file) {
        begin_work(ctx, o->output);
        status = iso_certify_convert(ctx, file, o->from.file, o->to, &sink, &rows);
        fclose(file);
    }
    const int result = certified_close(&to, status, status == ISO_OK || status == ISO_STOPPED);
    if (status == ISO_STOPPED) complain("interrupted: %zu rows were converted", rows);
    if (result == EXIT_DONE && !o->quiet) complain("%s: %zu rows, all enclosed", o->from.file, rows);
    return result;
}

/* --- the command ------------------------------------------------------------------------------------------------ */

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    filter f = {.ctx = ctx, .o = o, .name = iso_text_name(o->from.file)};
    if ((int)o->to < 0) return complain("convert: --to ball or --to point is missing"), EXIT_USAGE;
    if (is_certified(o->from.file)) return convert_certified(ctx, o);
    const iso_status status = open_filter(&f);
    const int result =
        status == ISO_OK ? finish_filter(&f, filter_rows(&f)) : finish(ctx, name_the_file(ctx, o->from.file, status));
    iso_conversion_free(f.conversion);
    iso_record_free(f.header);
    iso_table_reader_close(f.in);
    return result;
}

static const options defaults = {.from = FILE_OPTIONS_UNSET,
                                 .output = "-",
                                 .to = (iso_model_kind)-1,
                                 .tolerance = NAN,
                                 .max_defect = NAN,
                                 .digits = ALL_DIGITS};

static const option_row rows[] = {
    ROW_OF_WORDS("to", "MODEL", "ball or point", "the model to convert to: ball, point", set_target, options, to,
                 iso_model_kind_name),
    ROW_OUTPUT(options, output),
    ROW_OF_FILE("digits", "N", "1 to 17, or hex", "significant digits of numbers, 1 to 17 (default), or hex",
                set_digits, options, digits, 'p', OPTION_NO_FILE),
    ROW("tol", "X", "a number in " ISO_TOLERANCE_RANGE, "relative error of the other model's clock (default 1e-14)",
        iso_set_tolerance, options, tolerance),
    ROWS_OF_FILE(options, from),
    ROW("max-defect", "X", "a number from 0 on",
        "name rows farther than X from the orbit of the row before; status 1", iso_set_bound, options, max_defect),
    ROW("shift-J", NULL, NULL, "k = -1: a point off H = 0 becomes a free ball with moments J + E/eps", iso_set_flag,
        options, shift_J),
    ROW("strict", NULL, NULL, "stop at the first row that is named", iso_set_flag, options, strict),
    ROW("quiet", NULL, NULL, "print no summary on stderr", iso_set_flag, options, quiet),
    ROW_END,
};

const command command_convert = {
    COMMAND("convert", "[FILE]", "convert a trajectory of one model into one of the other", from.file),
    .takes = FILE_ROWS | FILE_CERTIFIED,
    .description =
        "A filter: row by row, in constant memory. It reads files of other programs, too. k, J and h or eps come "
        "from the # lines of the file, from --scene, or from --k and --J.\n\n"
        "States are mapped by (18) of the paper. The clock of the other model, unless the file has it, is computed "
        "from the rows by two-point Taylor quadrature to --tol. Where the rows are too far apart it is integrated. "
        "It is 0 at the first row.\n\n"
        "A file may have several orbits of one energy, told apart by a column `orbit`, such as a section with "
        "states. They are converted one after the other. Each begins with the other clock at 0.\n\n"
        "A row that cannot be converted becomes a row of nan. A row that is not on the orbit of the row before is "
        "converted as it stands: one of the two is damaged, and `isoroll check` shows more. The first 20 of both are "
        "named. Rows with few digits need a --row-tolerance.\n\n"
        "If the # line h, eps or level.c does not fit the first row, beyond rounding, a message names it, and the "
        "row's own number is written.\n\n"
        "A point off the level H = 0 becomes a ball in the potential of the effect 'level'; with --shift-J it "
        "becomes a free ball.\n\n"
        "Rows of 'run --certify' become enclosures of the other model, all clocks with them; they are read from a "
        "file, by its name.",
    .example = "isoroll convert --to point ball.csv -o point.csv",
    .exits = "1: a row was bad, or the rows do not lie on one orbit",
};

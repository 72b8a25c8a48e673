/* cmd_convert.c - `isoroll convert`: a filter that reads a trajectory of one model and writes that of the other. */
#include <math.h>
#include <string.h>

#include "parameters.h"
#include "scene_options.h"

/* What convert can be told. */
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
    iso_trajectory_reader *in;
    iso_trajectory_writer *out;
    iso_conversion *conversion;
    size_t columns;
    size_t unnamed; /* bad rows after the first NAMED */
    size_t named;
} filter;

enum { NAMED = 20 };

static iso_status put_header(void *data, const iso_record *header)
{
    filter *f = data;
    f->columns = iso_record_columns(header);
    return iso_trajectory_write_header(f->ctx, f->out, header);
}

static iso_status put_row(void *data, const double row[])
{
    filter *f = data;
    return row ? iso_trajectory_write_row(f->ctx, f->out, row, f->columns)
               : iso_trajectory_write_mark(f->ctx, f->out);
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

/* One row from in to out. */
static iso_status filter_row(filter *f, double row[], bool *more)
{
    const iso_status status = iso_trajectory_next(f->ctx, f->in, row, more);
    if (status == ISO_OK && *more && iso_trajectory_begins_orbit(f->in))
        return iso_context_fail(f->ctx, ISO_BAD_INPUT, "",
                                "line %zu: here another orbit begins; convert takes a file of one orbit",
                                iso_trajectory_line(f->in));
    if (status == ISO_OK) return *more ? iso_conversion_put(f->conversion, row, iso_trajectory_line(f->in)) : ISO_OK;
    if (status != ISO_BAD_INPUT || f->o->strict) return status;
    name_bad_row(f, 0, iso_context_message(f->ctx));
    return iso_conversion_skip(f->conversion);
}

static iso_status filter_rows(filter *f, iso_conversion_summary *summary)
{
    double row[ISO_TRAJECTORY_COLUMNS];
    iso_status status = ISO_OK;
    bool more = true;
    iso_context_set_monitor(f->ctx, not_interrupted, NULL);
    while (status == ISO_OK && more && !interrupted()) status = filter_row(f, row, &more);
    if (status == ISO_OK && more) status = iso_context_stopped(f->ctx);
    iso_context_set_monitor(f->ctx, NULL, NULL);
    const bool settle = status == ISO_OK || status == ISO_STOPPED;
    const iso_status ended = settle ? iso_conversion_end(f->conversion, summary) : status;
    return status == ISO_OK ? ended : status;
}

/* Two lines at the end of the file: how the other clock was computed, and its error. */
static iso_status write_clock(filter *f, const iso_conversion_summary *s)
{
    char key[2][ISO_NAME_SIZE], text[2][160];
    if (!iso_conversion_clock_lines(s, key, text)) return ISO_OK;
    const iso_status status = iso_trajectory_write_line(f->ctx, f->out, key[0], text[0]);
    return status == ISO_OK ? iso_trajectory_write_line(f->ctx, f->out, key[1], text[1]) : status;
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

static double largest_drift(const filter *f)
{
    return iso_conversion_largest_drift(f->ctx, iso_trajectory_header(f->in), f->o->from.row_tolerance);
}

/* Whether all rows could be converted, and follow the equations that the file states. Says why not. */
static bool judge(const filter *f, const iso_conversion_summary *s)
{
    bool good = s->bad == 0;
    if (s->bad > 0)
        complain("%s: %zu of %zu rows could not be converted: nan stands in their place", f->name, s->bad, s->rows);
    if (s->checked && !isnan(f->o->max_defect) && !(s->defect.value <= f->o->max_defect)) {
        complain("%s:%zu: the defect %.2g is above %g", f->name, s->defect.line, s->defect.value, f->o->max_defect);
        good = false;
    }
    if (s->checked && isnan(f->o->max_defect) && !(s->drift.value <= largest_drift(f))) {
        complain(
            "%s:%zu: these rows do not solve the equations that the file or the options state (k, J, eps, clocks), "
            "or have too few digits: they drift off by %.2g in half a radian or one interval, whichever is longer "
            "(--row-tolerance X is for few digits, --max-defect X sets another bound)",
            f->name, s->drift.line, s->drift.value);
        good = false;
    }
    return good;
}

static int finish_filter(filter *f, iso_status status, const iso_conversion_summary *s)
{
    if (status == ISO_OK || status == ISO_STOPPED) {
        const iso_status written = f->columns > 0 ? write_clock(f, s) : ISO_OK;
        if (status == ISO_OK) status = written;
    }
    if (f->unnamed > 0) complain("%s: %zu more bad rows are not named", f->name, f->unnamed);
    const bool keep = f->columns > 0 && (status == ISO_OK || status == ISO_STOPPED);
    const bool has_name = status == ISO_FILE_TROUBLE || status == ISO_CLOSED_PIPE || status == ISO_BAD_ARGUMENT;
    if (status != ISO_OK && !has_name) status = name_the_file(f->ctx, f->o->from.file, status);
    const int result = finish(f->ctx, status);
    const iso_status closed = iso_trajectory_close(f->ctx, f->out, keep);
    if (closed != ISO_OK) return result == EXIT_DONE ? finish(f->ctx, closed) : result;
    if (status == ISO_STOPPED) complain("interrupted: %zu rows were converted", s->rows - s->bad);
    if (status != ISO_OK) return result;
    warn_of_lines(f, s);
    if (!f->o->quiet) report_summary(f, s);
    return judge(f, s) ? EXIT_DONE : EXIT_SOME_FAILED;
}

static iso_status open_filter(filter *f, iso_params *params)
{
    const options *o = f->o;
    const iso_conversion_target target = {put_header, put_row, put_bad, f};
    iso_conversion_options how = iso_conversion_defaults();
    if (!isnan(o->tolerance)) how.tolerance = o->tolerance;
    how.shift_J = o->shift_J;
    iso_status status = iso_trajectory_reader_open(f->ctx, o->from.file, o->from.columns, &f->in);
    if (status == ISO_OK) status = parameters_of_file(f->ctx, &o->from, iso_trajectory_header(f->in), params);
    if (status == ISO_OK)
        status =
            iso_conversion_create(f->ctx, params, iso_trajectory_header(f->in), o->to, &how, &target, &f->conversion);
    if (status != ISO_OK)
        return status == ISO_BAD_ARGUMENT || status == ISO_FILE_TROUBLE ? status
                                                                        : name_the_file(f->ctx, o->from.file, status);
    if (iso_trajectory_ignored(f->in) && !o->quiet)
        complain("%s: passed over: %s", f->name, iso_trajectory_ignored(f->in));
    stop_gently();
    progress_begin_rows(o->output);
    status = iso_trajectory_open(f->ctx, o->output, &f->out);
    if (status == ISO_OK) iso_trajectory_set_digits(f->out, o->digits);
    return status;
}

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    filter f = {.ctx = ctx, .o = o, .name = strcmp(o->from.file, "-") == 0 ? "<stdin>" : o->from.file};
    iso_params params;
    iso_conversion_summary summary = {.rows = 0};
    if ((int)o->to < 0) return complain("convert: --to ball or --to point is missing"), EXIT_USAGE;
    iso_status status = open_filter(&f, &params);
    int result;
    if (status == ISO_OK)
        result = finish_filter(&f, filter_rows(&f, &summary), &summary);
    else
        result = finish(ctx, status);
    iso_conversion_free(f.conversion);
    iso_trajectory_reader_close(f.in);
    return result;
}

static const options defaults = {.from = FILE_OPTIONS_UNSET,
                                 .output = "-",
                                 .to = (iso_model_kind)-1,
                                 .tolerance = NAN,
                                 .max_defect = NAN,
                                 .digits = 17};

static const option_row rows[] = {
    ROW_OF_WORDS("to", "MODEL", "ball or point", "the model to convert to: ball, point", set_target, options, to,
                 target_word),
    ROW_OUTPUT(options, output),
    ROW_OF_FILE("digits", "N", "1 to 17, or hex", "significant digits of numbers, 1 to 17 (default), or hex",
                set_digits, options, digits, 'p', OPTION_NO_FILE),
    ROW("tol", "X", "a number in " ISO_TOLERANCE_RANGE, "relative error of the other model's clock (default 1e-14)",
        set_tolerance, options, tolerance),
    ROWS_OF_FILE(options, from),
    ROW("max-defect", "X", "a number from 0 on",
        "exit with status 1 if a row is farther than X from the orbit before it", set_bound, options, max_defect),
    ROW("shift-J", NULL, NULL, "k = -1: a point off H = 0 becomes a free ball with moments J + E/eps", set_flag,
        options, shift_J),
    ROW("strict", NULL, NULL, "stop at the first bad row", set_flag, options, strict),
    ROW("quiet", NULL, NULL, "print no summary on stderr", set_flag, options, quiet),
    ROW_END,
};

const command command_convert = {
    .name = "convert",
    .argument = "[FILE]",
    .doc = "convert a trajectory of one model into one of the other",
    .rows = rows,
    .defaults = &defaults,
    .size = sizeof defaults,
    .file = offsetof(options, from.file),
    .takes = FILE_ROWS,
    .description =
        "A filter: row by row, in constant memory. It reads files of other programs, too. k, J and h or eps come "
        "from the # lines of the file, from --scene, or from --k and --J.\n\n"
        "States are mapped by (18) of the paper. The clock of the other model, unless the file has it, is computed "
        "from the rows by two-point Taylor quadrature to --tol. Where the rows are too far apart it is integrated. "
        "It is 0 at the first row.\n\n"
        "A row that cannot be converted becomes a row of nan. The first 20 are named, the others are counted. Rows "
        "with few digits need a --row-tolerance.\n\n"
        "If the # line h, eps or level.c does not fit the first row, beyond rounding, a message names it, and the "
        "row's own number is written.\n\n"
        "A point off the level H = 0 becomes a ball in the potential of the effect 'level'; with --shift-J it "
        "becomes a free ball.",
    .example = "isoroll convert --to point ball.csv -o point.csv",
    .exits = "1: a row was bad, or the rows do not lie on one orbit",
    .run = run,
};

/* convert_study.c - convert by its name: the rows of a file or of a record, orbit by orbit, and what it tells people
 * (study/study.h). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_impl.h"
#include "base/number_impl.h"
#include "task/convert/convert_impl.h"

ISO_STUDY_BEGIN(iso_convert_request, (iso_convert_request)ISO_CONVERT_UNSET)

enum { NAMED = 20 };

typedef struct work {
    iso_context *ctx;
    const iso_convert_request *how;
    const iso_study_subject *subject;
    iso_record *in; /* columns and lines, and what is added to them */
    iso_params params;
    iso_conversion *conversion;
    iso_study_result *result;
    const iso_sink *to; /* the result's; its row NULL: rows are added to `out` */
    iso_record *out;    /* the header of the result; NULL: not yet written */
    iso_convert_found *found;
    iso_source_row row;
    size_t marks;       /* bad rows before the first good one, which wait for the header */
    iso_status failure; /* of the first orbit without a good row */
    size_t named;
    bool began; /* the first row was asked for */
} work;

/* --- where rows go ---------------------------------------------------------------------------------------------- */

/* One file states one energy, by lines of these names: later orbits must have that of the first. */
static iso_status check_energy(const work *w, const iso_record *header)
{
    static const char *const keys[] = {"h", "eps", "level.c"};
    const double digits = 10 * iso_record_row_tolerance(w->in);
    for (int i = 0; i < 3; i++) {
        double first = NAN, now = NAN;
        iso_status status = ISO_OK;
        iso_record_get_numbers(w->ctx, w->out, keys[i], 1, &first, &status);
        if (status == ISO_OK) iso_record_get_numbers(w->ctx, header, keys[i], 1, &now, &status);
        ISO_TRY(status);
        if ((isnan(first) && isnan(now)) || fabs(now - first) <= digits * fabs(first)) continue;
        if (isnan(first) || isnan(now))
            return ISO_FAIL_INPUT(
                w->ctx, "",
                "orbit %s has %s %s, unlike the first one: convert orbits of different energies one by one",
                ISO_SHORT(w->row.orbit), isnan(now) ? "no" : "a", keys[i]);
        return ISO_FAIL_INPUT(w->ctx, "",
                              "orbit %s has %s = %.6g, the first one %.6g: convert orbits of different energies "
                              "one by one",
                              ISO_SHORT(w->row.orbit), keys[i], now, first);
    }
    return ISO_OK;
}

static iso_status write_row(const work *w, const double row[])
{
    if (!w->to->row) return iso_record_add(w->ctx, w->out, 1, row);
    return w->to->row(w->to->data, 0, row, iso_record_columns(w->out));
}

/* A file of several orbits has the column `orbit` before the others, and one header. The time at which the first
 * orbit begins is not that of the others. */
static iso_status put_header(void *data, int table, const iso_record *header)
{
    work *w = data;
    const char *names[1 + ISO_TRAJECTORY_COLUMNS] = {ISO_ORBIT_COLUMN};
    const size_t own = w->row.orbits, columns = iso_record_columns(header);
    if (w->out) return check_energy(w, header);
    for (size_t i = 0; i < columns; i++) names[own + i] = iso_record_name(header, i);
    ISO_TRY(iso_record_create_like(w->ctx, header, own + columns, names, &w->out));
    if (own) ISO_TRY(iso_record_set(w->ctx, w->out, "t0", NULL));
    if (own) ISO_TRY(iso_record_set(w->ctx, w->out, "s0", NULL));
    iso_record_set_kind(w->out, "trajectory");
    if (w->to->header) ISO_TRY(w->to->header(w->to->data, table, w->out));
    for (; w->marks > 0; w->marks--) ISO_TRY(write_row(w, NULL));
    return ISO_OK;
}

static iso_status put_row(void *data, int table, const double row[], size_t count)
{
    work *w = data;
    double with_orbit[1 + ISO_TRAJECTORY_COLUMNS] = {w->row.orbit};
    (void)table;
    if (!w->out) return w->marks++, ISO_OK;
    if (!row || !w->row.orbits) return write_row(w, row);
    memcpy(with_orbit + 1, row, count * sizeof *row);
    return write_row(w, with_orbit);
}

/* Names a row. After the first NAMED they are only counted. */
static void name_row(void *data, const char *text)
{
    work *w = data;
    if (w->named++ < NAMED && w->to->note) w->to->note(w->to->data, text);
}

/* --- orbits ----------------------------------------------------------------------------------------------------- */

/* Lines of a file can come before any of its orbits. */
static iso_status begin_orbit(work *w)
{
    iso_record_free(w->in);
    w->in = NULL;
    ISO_TRY(iso_record_create_like(w->ctx, w->subject->record, 0, NULL, &w->in));
    ISO_TRY(iso_file_parameters_apply(w->ctx, &w->how->added, w->subject->scene, w->in, &w->params));
    const iso_sink sink = {.header = put_header, .row = put_row, .note = name_row, .data = w};
    return iso_conversion_create(w->ctx, &w->params, w->in, w->how, w->found->name, &sink, &w->conversion);
}

/* An orbit of several may have no good row. */
static iso_status end_orbit(work *w)
{
    const iso_status status = iso_conversion_end(w->conversion, &w->found->all);
    iso_conversion_free(w->conversion);
    w->conversion = NULL;
    if (status == ISO_OK || !w->row.orbits) return status;
    if (w->failure == ISO_OK) w->failure = status;
    return ISO_OK;
}

static iso_status convert_row(work *w, const iso_row_source *from)
{
    const iso_status status = from->next(w->ctx, from->data, &w->row);
    if (!w->began && w->row.ignored && w->found->name && !w->how->quiet)
        iso_study_note(w->result, "%s: passed over: %s", w->found->name, w->row.ignored);
    w->began = true;
    if (status == ISO_BAD_INPUT && w->found->name && !w->how->strict) {
        name_row(w, iso_context_message(w->ctx)); /* it has the place */
        return iso_conversion_skip(w->conversion);
    }
    if (status != ISO_OK || !w->row.more) return status;
    if (w->row.begins_orbit) {
        ISO_TRY(end_orbit(w));
        ISO_TRY(begin_orbit(w));
    }
    return iso_conversion_put(w->conversion, w->row.number, w->row.line);
}

static iso_status convert_rows(work *w, const iso_row_source *from)
{
    iso_status status = begin_orbit(w);
    if (status != ISO_OK) return status;
    while (status == ISO_OK && w->row.more && iso_context_goes_on(w->ctx)) status = convert_row(w, from);
    if (status == ISO_OK && w->row.more) status = iso_context_stopped(w->ctx);
    const bool settle = status == ISO_OK || status == ISO_STOPPED;
    const iso_status ended = settle && w->conversion ? end_orbit(w) : status;
    if (status == ISO_OK && ended == ISO_OK && !w->out) return w->failure;
    return status == ISO_OK ? ended : status;
}

/* --- the study -------------------------------------------------------------------------------------------------- */

static iso_status prepare(iso_context *ctx, void *options)
{
    if ((int)((const iso_convert_request *)options)->to >= 0) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "to", "convert: --to ball or --to point is missing");
}

/* Of a table: the lines that a file has at its end. Of a record's rows: as notes what print tells of a file. */
static iso_status end_rows(work *w)
{
    const iso_conversion_summary *s = &w->found->all;
    char key[2][ISO_NAME_SIZE], text[2][160], stated[ISO_STATED_SIZE], verdict[ISO_VERDICT_SIZE];
    size_t row;
    const bool wrong = iso_conversion_verdict(s, verdict, &row);
    w->result->failed = wrong || s->bad > 0;
    if (!w->to->row && iso_conversion_clock_lines(s, key, text))
        for (int i = 0; i < 2; i++) ISO_TRY(iso_record_set(w->ctx, w->out, key[i], text[i]));
    if (w->found->name) return ISO_OK;
    for (int i = 0; iso_conversion_stated_text(s, i, stated); i++) iso_study_note(w->result, "%s", stated);
    if (wrong) iso_study_note(w->result, "row %zu: %s", row, verdict);
    return ISO_OK;
}

static iso_status run(iso_context *ctx, const iso_study_subject *subject, const void *options,
                      iso_study_result *result)
{
    iso_kept_rows kept = {.record = subject->record, .sink = &result->sink};
    const iso_row_source own = {iso_kept_rows_next, &kept}, *from = subject->rows ? subject->rows : &own;
    iso_convert_found *found = iso_study_keep(result, calloc(1, sizeof *found), NULL, free);
    iso_convert_request how = *(const iso_convert_request *)options;
    work w = {.ctx = ctx, .subject = subject, .how = &how, .result = result, .to = &result->sink, .found = found};
    if (isnan(how.tolerance)) how.tolerance = ISO_CONVERT_TOLERANCE;
    if (!found) return iso_context_no_memory(ctx, "a conversion");
    found->name = subject->rows && w.to->row ? subject->name : NULL;
    w.row.more = true;
    w.row.number = calloc(iso_record_columns(subject->record) + 1, sizeof *w.row.number);
    iso_status status = w.row.number ? ISO_OK : iso_context_no_memory(ctx, "a row");
    if (status == ISO_OK) status = convert_rows(&w, from);
    if (status == ISO_OK) status = end_rows(&w);
    if (w.named > NAMED) iso_study_note(result, "%s: %zu more rows are not named", found->name, w.named - NAMED);
    if (w.to->row || (status != ISO_OK && status != ISO_STOPPED))
        iso_record_free(w.out);
    else
        result->table[0] = w.out;
    iso_conversion_free(w.conversion);
    iso_record_free(w.in);
    free(w.row.number);
    return status;
}

/* --- what it tells of a file ------------------------------------------------------------------------------------ */

static void print_summary(FILE *to, const char *name, const iso_conversion_summary *s)
{
    fprintf(to, "%s: %zu rows, %zu bad; worst: constraint %.2g (line %zu), energy %.2g (line %zu)\n", name, s->rows,
            s->bad, s->constraint.value, s->constraint.line, s->energy.value, s->energy.line);
    if (!s->checked) {
        fprintf(to, "%s: no clock, so not known whether the rows lie on one orbit\n", name);
        return;
    }
    fprintf(to, "%s: rows against the orbit through the ones before: defect %.2g (line %zu), drift %.2g (line %zu)\n",
            name, s->defect.value, s->defect.line, s->drift.value, s->drift.line);
    if (s->computed)
        fprintf(to,
                "%s: %s = %.6g at the end, error about %.2g; %zu intervals by two-point Taylor quadrature, %zu by "
                "integration\n",
                name, iso_clock_name(s->clock), s->end, s->error, s->between, s->integrated);
}

static void print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result)
{
    const iso_convert_found *f = result->found;
    const iso_conversion_summary *s = &f->all;
    char stated[ISO_STATED_SIZE], verdict[ISO_VERDICT_SIZE];
    size_t line;
    (void)scene;
    if (!f->name) return;
    for (int i = 0; iso_conversion_stated_text(s, i, stated); i++) fprintf(to, "%s: %s\n", f->name, stated);
    if (!((const iso_convert_request *)options)->quiet) print_summary(to, f->name, s);
    if (s->bad > 0)
        fprintf(to, "%s: %zu of %zu rows could not be converted: nan stands in their place\n", f->name, s->bad,
                s->rows);
    if (iso_conversion_verdict(s, verdict, &line))
        fprintf(to, "%s:%zu: %s (--row-tolerance X is for few digits, --max-defect X sets another bound)\n", f->name,
                line, verdict);
}

const iso_option iso_convert_option[] = {
    ISO_OPTION_WORDS("to", "MODEL", "ball or point", "the model to convert to: ball, point", iso_set_model,
                     iso_convert_request, to, iso_model_kind_name),
    ISO_OPTION_TOLERANCE("relative error of the other model's clock (default 1e-14)", iso_convert_request, tolerance),
    ISO_OPTIONS_FILE_PARAMETERS(iso_convert_request, added),
    ISO_OPTION_ROW_TOLERANCE(iso_convert_request, added),
    ISO_OPTION("max-defect", "X", "a number from 0 on",
               "name rows farther than X from the orbit of the row before; status 1", iso_set_bound,
               iso_convert_request, max_defect),
    ISO_OPTION("shift-J", NULL, NULL, "k = -1: a point off H = 0 becomes a free ball with moments J + E/eps",
               iso_set_flag, iso_convert_request, shift_J),
    ISO_OPTION("strict", NULL, NULL, "stop at the first row that is named", iso_set_flag, iso_convert_request,
               strict),
    ISO_OPTION("quiet", NULL, NULL, "print no summary", iso_set_flag, iso_convert_request, quiet),
    ISO_OPTION_END,
};

const iso_study iso_convert_study = {"convert",
                                     "convert a trajectory of one model into one of the other",
                                     iso_convert_option,
                                     sizeof(iso_convert_request),
                                     begin,
                                     .prepare = prepare,
                                     .run = run,
                                     .of = ISO_STUDY_OF_RECORD | ISO_STUDY_USES_SCENE | ISO_STUDY_STREAMS,
                                     .print = print};

iso_status iso_convert(iso_context *ctx, const iso_record *in, iso_model_kind to, double tolerance, iso_record **out)
{
    iso_convert_request how = ISO_CONVERT_UNSET;
    iso_study_result r = {.text = NULL};
    if (isnan(tolerance)) return ISO_FAIL_ARGUMENT(ctx, "tolerance", "the tolerance is nan");
    how.to = to;
    how.tolerance = tolerance;
    how.added.row_tolerance = iso_record_row_tolerance(in);
    const iso_status status = iso_study_answer(ctx, &iso_convert_study, &(iso_study_subject){.record = in}, &how, &r);
    *out = status == ISO_OK ? r.table[0] : NULL;
    if (status == ISO_OK) r.table[0] = NULL;
    iso_study_result_free(&r);
    return status;
}

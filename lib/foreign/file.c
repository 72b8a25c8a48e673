/* file.c - records read from files, written to files, and converted to the other model. */
#include <stdio.h>
#include <string.h>

#include "foreign/foreign_impl.h"
#include "io/table_impl.h"
#include "method/integrator_impl.h"
#include "orbit/convert.h"

/* --- reading ---------------------------------------------------------------------------------------------------- */

iso_status iso_foreign_read(iso_context *ctx, const char *path, const char *columns, iso_record **record, char text[],
                            size_t room)
{
    iso_trajectory_reader *in;
    notes n = iso_notes_begin(text, room);
    char words[320];
    *record = NULL;
    iso_status status = iso_trajectory_reader_open(ctx, path, columns, &in);
    if (status != ISO_OK) return status;
    status = iso_table_read_all(ctx, in, record);
    if (iso_trajectory_ignored(in)) {
        snprintf(words, sizeof words, "%.60s: passed over: %s", path, iso_trajectory_ignored(in));
        iso_notes_add(&n, words);
    }
    iso_trajectory_reader_close(in);
    return status;
}

/* --- writing ---------------------------------------------------------------------------------------------------- */

iso_status iso_foreign_write(iso_context *ctx, const char *path, const iso_record *record, int digits,
                             const char *kind)
{
    iso_trajectory_writer *out;
    if (digits < 0 || digits > 17)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "digits", "%d digits: from 1 to 17, or 0: hexadecimal",
                                digits);
    if (strcmp(kind, "trajectory") != 0 && strcmp(kind, "section") != 0)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "kind", "a file is a trajectory or a section, not '%s'", kind);
    iso_status status = iso_trajectory_open(ctx, path, &out);
    if (status != ISO_OK) return status;
    iso_trajectory_set_digits(out, digits);
    iso_trajectory_set_kind(out, kind);
    status = iso_trajectory_write_header(ctx, out, record);
    const size_t rows = iso_record_rows(record), columns = iso_record_columns(record);
    for (size_t i = 0; status == ISO_OK && i < rows; i++)
        status = iso_trajectory_write_row(ctx, out, iso_record_const_row(record, i), columns);
    const iso_status closed = iso_trajectory_close(ctx, out, status == ISO_OK);
    return status == ISO_OK ? closed : status;
}

/* --- converting ------------------------------------------------------------------------------------------------- */

typedef struct keeper {
    iso_context *ctx;
    iso_record *out;
} keeper;

static iso_status keep_header(void *data, const iso_record *header)
{
    keeper *k = data;
    return iso_record_create_like(k->ctx, header, 0, NULL, &k->out);
}

/* No row is NULL: a bad one has ended the work. */
static iso_status keep_row(void *data, const double row[])
{
    keeper *k = data;
    return iso_foreign_record_append(k->ctx, k->out, 1, row);
}

static iso_status stop_at(void *data, size_t line, iso_status why, const char *words)
{
    return iso_context_fail(((keeper *)data)->ctx, why, "", "row %zu: %s", line - 1, words);
}

/* The two lines that `isoroll convert` writes: how the other clock was computed, and its error. */
static iso_status put_clock(iso_context *ctx, const iso_conversion_summary *s, iso_record *out)
{
    char key[2][ISO_NAME_SIZE], text[2][160];
    if (!iso_conversion_clock_lines(s, key, text)) return ISO_OK;
    const iso_status status = iso_record_set(ctx, out, key[0], text[0]);
    return status == ISO_OK ? iso_record_set(ctx, out, key[1], text[1]) : status;
}

static void judge(iso_context *ctx, const iso_record *in, const iso_conversion_summary *s, double row_tolerance,
                  notes *n)
{
    char words[256];
    char stated[ISO_STATED_SIZE];
    for (int i = 0; iso_conversion_stated_words(s, i, stated); i++) iso_notes_add(n, stated);
    if (!s->checked || s->drift.value <= iso_conversion_largest_drift(ctx, in, row_tolerance)) return;
    snprintf(words, sizeof words,
             "row %zu: these rows do not solve the equations that their lines state (k, J, eps, clocks), or have too "
             "few digits: they drift off by %.2g",
             s->drift.line - 1, s->drift.value);
    iso_notes_add(n, words);
}

static iso_status convert_rows(iso_conversion *c, const iso_record *in, iso_conversion_summary *summary)
{
    iso_status status = ISO_OK;
    for (size_t row = 0; status == ISO_OK && row < iso_record_rows(in); row++)
        status = iso_conversion_put(c, iso_record_const_row(in, row), row + 1);
    return status == ISO_OK ? iso_conversion_end(c, summary) : status;
}

iso_status iso_foreign_convert(iso_context *ctx, const iso_record *in, const char *to, double tolerance,
                               double row_tolerance, bool shift_J, iso_record **out, char text[], size_t room)
{
    keeper k = {.ctx = ctx};
    notes n = iso_notes_begin(text, room);
    const iso_conversion_target target = {keep_header, keep_row, stop_at, &k};
    iso_conversion_options o = iso_conversion_defaults();
    iso_conversion_summary summary = {.rows = 0};
    iso_conversion *c = NULL;
    iso_record *header = NULL;
    iso_params params;
    int model;
    *out = NULL;
    o.tolerance = tolerance;
    o.shift_J = shift_J;
    iso_status status = iso_foreign_word(ctx, "to", iso_model_kind_name, to, &model);
    if (status == ISO_OK && !(row_tolerance > 0 && row_tolerance <= 0.1))
        status = iso_context_fail(ctx, ISO_BAD_ARGUMENT, "row_tolerance", "row_tolerance %g is not in (0, 0.1]",
                                  row_tolerance);
    if (status == ISO_OK) status = iso_tolerance_check(ctx, tolerance);
    if (status == ISO_OK) status = iso_record_params(ctx, in, &params);
    if (status == ISO_OK) status = iso_record_create_like(ctx, in, 0, NULL, &header);
    if (status == ISO_OK) {
        iso_record_set_row_tolerance(header, row_tolerance);
        status = iso_conversion_create(ctx, &params, header, (iso_model_kind)model, &o, &target, &c);
    }
    if (status == ISO_OK) status = convert_rows(c, in, &summary);
    if (status == ISO_OK) status = put_clock(ctx, &summary, k.out);
    if (status == ISO_OK) judge(ctx, in, &summary, row_tolerance, &n);
    iso_conversion_free(c);
    iso_record_free(header);
    if (status != ISO_OK) iso_record_free(k.out), k.out = NULL;
    *out = k.out;
    return status;
}

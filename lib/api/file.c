/* file.c - records read from files, written to files, and converted to the other model. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "api/interface_impl.h"
#include "base/number_impl.h"
#include "io/table_impl.h"
#include "method/integrator_impl.h"
#include "task/convert/convert_impl.h"

/* --- reading ---------------------------------------------------------------------------------------------------- */

/* Whether a file is a table of isoroll that is no trajectory, perhaps a damaged one. */
static bool is_table(const char *path)
{
    char begin[32] = "", kind[ISO_KIND_SIZE];
    struct stat s;
    iso_table_kind(path, kind);
    if (*kind) return strcmp(kind, ISO_TRAJECTORY_KIND) != 0;
    FILE *file = stat(path, &s) == 0 && S_ISREG(s.st_mode) ? fopen(path, "re") : NULL;
    if (file && !fgets(begin, sizeof begin, file)) *begin = '\0';
    if (file) fclose(file);
    return strncmp(begin, "# isoroll ", 10) == 0 &&
           strncmp(begin, ISO_TRAJECTORY_MAGIC, strlen(ISO_TRAJECTORY_MAGIC)) != 0;
}

iso_status iso_record_read(iso_context *ctx, const char *path, const char *columns, iso_record **record, char text[],
                           size_t room)
{
    iso_table_reader *in;
    notes n = iso_notes_begin(text, room);
    char words[320];
    *record = NULL;
    if (!columns && is_table(path)) return iso_table_read(ctx, path, NULL, NULL, record, NULL);
    iso_status status = iso_table_reader_open(ctx, path, "trajectory", columns, &in);
    if (status != ISO_OK) return status;
    status = iso_table_read_all(ctx, in, record);
    if (iso_table_at(in)->ignored) {
        snprintf(words, sizeof words, "%.60s: passed over: %s", path, iso_table_at(in)->ignored);
        iso_notes_add(&n, words);
    }
    iso_table_reader_close(in);
    return status;
}

/* --- writing ---------------------------------------------------------------------------------------------------- */

iso_status iso_record_write(iso_context *ctx, const char *path, const iso_record *record, int digits,
                            const char *kind)
{
    if (digits < 0 || digits > 17)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "digits", "%d digits: from 1 to 17, or 0: hexadecimal",
                                digits);
    if (!*kind || strlen(kind) >= ISO_KIND_SIZE || kind[strspn(kind, "abcdefghijklmnopqrstuvwxyz ")])
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "kind",
                                "the kind of a table is a word such as section, not '%s'", kind);
    return iso_table_write_as(ctx, path, kind, digits, record);
}

/* --- converting ------------------------------------------------------------------------------------------------- */

/* The two lines that `isoroll convert` writes: how the other clock was computed, and its error. */
static iso_status put_clock(iso_context *ctx, const iso_conversion_summary *s, iso_record *out)
{
    char key[2][ISO_NAME_SIZE], text[2][160];
    if (!iso_conversion_clock_lines(s, key, text)) return ISO_OK;
    const iso_status status = iso_record_set(ctx, out, key[0], text[0]);
    return status == ISO_OK ? iso_record_set(ctx, out, key[1], text[1]) : status;
}

/* Lines that the first row does not confirm, and what is wrong with the rows. */
static void note_verdict(const iso_conversion_summary *s, notes *n)
{
    char stated[ISO_STATED_SIZE], verdict[ISO_VERDICT_SIZE], text[ISO_VERDICT_SIZE + 32];
    size_t row;
    for (int i = 0; iso_conversion_stated_words(s, i, stated); i++) iso_notes_add(n, stated);
    if (!iso_conversion_verdict(s, verdict, &row)) return;
    snprintf(text, sizeof text, "row %zu: %s", row - 1, verdict);
    iso_notes_add(n, text);
}

iso_status iso_record_convert(iso_context *ctx, const iso_record *in, const char *to, double tolerance,
                              double row_tolerance, bool shift_J, iso_record **out, char text[], size_t room)
{
    notes n = iso_notes_begin(text, room);
    iso_conversion_options o = iso_conversion_defaults();
    iso_conversion_summary summary = {.rows = 0};
    iso_params params;
    int model;
    *out = NULL;
    o.tolerance = tolerance;
    o.shift_J = shift_J;
    o.row_tolerance = row_tolerance;
    o.first_row = 0;
    iso_status status = iso_word_find(ctx, "to", iso_model_kind_name, to, &model);
    if (status == ISO_OK && !iso_tolerance_is_good(row_tolerance))
        status = iso_context_fail(ctx, ISO_BAD_ARGUMENT, "row_tolerance",
                                  "row_tolerance %s is not in " ISO_TOLERANCE_RANGE, ISO_SHORT(row_tolerance));
    if (status == ISO_OK) status = iso_tolerance_check(ctx, tolerance);
    if (status == ISO_OK) status = iso_record_params(ctx, in, &params);
    if (status == ISO_OK) status = iso_convert_as(ctx, &params, in, (iso_model_kind)model, &o, &summary, out);
    if (status == ISO_OK) status = put_clock(ctx, &summary, *out);
    if (status == ISO_OK) note_verdict(&summary, &n);
    if (status != ISO_OK) iso_record_free(*out), *out = NULL;
    return status;
}

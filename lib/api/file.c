/* file.c - records read from files, and written to files. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "api/interface_impl.h"
#include "io/table_impl.h"

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

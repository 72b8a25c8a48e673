/* view_write.c - the head and the tables of a page, both as JSON, and the page: page.html with its style, three.js, the
 * data and our code in their places (see view.h).
 *
 * page.html has lines "@name@". Each is replaced by a file of view/, which may have such lines itself, or by the data.
 * What only --live needs is left out without it: those of is_of_live(). In the data the characters <, >
 * and & are escaped, so no text of a file can end the script that holds it, or begin another.
 */
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "base/version.h"
#include "embedded.h"
#include "io/output_impl.h"
#include "json.h"
#include "study/study_impl.h"
#include "view/view.h"

void view_page_free(view_page *page)
{
    for (size_t i = 0; i < page->tables; i++) iso_record_free(page->table[i]);
    free(page->table);
}

void view_note(view_page *page, const char *format, ...)
{
    va_list arguments;
    if (page->notes == VIEW_NOTES) return;
    va_start(arguments, format);
    vsnprintf(page->note[page->notes++], VIEW_TEXT, format, arguments);
    va_end(arguments);
}

iso_status view_add(iso_context *ctx, view_page *page, const char *kind, double orbit, iso_record *table)
{
    iso_record **more = realloc(page->table, (page->tables + 1) * sizeof *more);
    if (!more) {
        iso_record_free(table);
        return iso_context_no_memory(ctx, "a table");
    }
    page->table = more;
    page->table[page->tables++] = table;
    iso_record_set_kind(table, kind);
    return orbit < 0 ? ISO_OK : iso_record_set_numbers(ctx, table, "orbit", 1, &orbit);
}

iso_status view_count(iso_context *ctx, iso_record *table, const char *key, size_t count)
{
    return iso_record_set_numbers(ctx, table, key, 1, (double[]){(double)count});
}

/* --- JSON ------------------------------------------------------------------------------------------------------- */

/* Byte i of the numbers of a column, little-endian; 0 behind them. */
static unsigned byte_of(const iso_record *r, size_t column, size_t i)
{
    uint64_t bits = 0;
    if (i / 8 < iso_record_rows(r)) memcpy(&bits, iso_record_const_row(r, i / 8) + column, sizeof bits);
    return (unsigned)(bits >> 8 * (i % 8)) & 0xFF;
}

/* A column: an array of its words, or its numbers in base64. NULL: no memory. */
static json_t *column_of(const iso_record *r, size_t column)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    if (iso_record_has_words(r, column)) {
        json_t *words = json_array();
        for (size_t i = 0; i < iso_record_rows(r); i++)
            json_array_append_new(words, json_text(iso_record_word(r, iso_record_const_row(r, i)[column])));
        return words;
    }
    const size_t bytes = 8 * iso_record_rows(r), length = (bytes + 2) / 3 * 4;
    char *text = json_allocate(length + 1);
    for (size_t i = 0; text && i < length; i++) {
        const size_t first = i / 4 * 3, digit = i % 4;
        const unsigned group =
            byte_of(r, column, first) << 16 | byte_of(r, column, first + 1) << 8 | byte_of(r, column, first + 2);
        text[i] = first + digit > bytes ? '=' : digits[group >> (18 - 6 * digit) & 63];
    }
    json_t *made = text ? json_stringn_nocheck(text, length) : NULL;
    free(text);
    return made;
}

static json_t *table_of(const iso_record *r)
{
    json_t *o = json_object(), *lines = json_object(), *columns = json_object();
    const char *key, *value;
    for (size_t i = 0; iso_record_line(r, i, &key, &value); i++) json_object_set_new(lines, key, json_text(value));
    for (size_t i = 0; i < iso_record_columns(r); i++)
        json_object_set_new(columns, iso_record_name(r, i), column_of(r, i));
    json_put(o, "kind", json_string(iso_record_kind(r)));
    json_put(o, "rows", json_integer((json_int_t)iso_record_rows(r)));
    json_put(o, "lines", lines);
    json_put(o, "columns", columns);
    return o;
}

static const iso_field note_fields[] = {{.name = "", .type = ISO_FIELD_TEXT}, ISO_FIELD_END};

#define FIELD(key, member, ...) ISO_MEMBER(view_page, key, member, __VA_ARGS__)

static const iso_field page_fields[] = {
    FIELD("title", title, "", "the name of the file"),
    FIELD("kind", kind, "", "scene, trajectory or section"),
    FIELD("live", live, "", "whether the library is in the page"),
    FIELD("attitude", attitude, "", "whether the scene or the file states one"),
    FIELD("k", params.k, "", "geometry number"),
    FIELD("J", params.J, "moment of inertia", "about the contact"),
    FIELD("radius", params.body.radius, "length", "of the ball"),
    FIELD("eps", eps, "", "coupling of the point"),
    FIELD("h", h, "energy", "of the ball"),
    FIELD("clock", clock, "", "that runs evenly at first", .word = iso_clock_word),
    FIELD("alone", alone, "", "why there is no point"),
    ISO_LIST(view_page, "notes", note, notes, note_fields, "what the page says"),
    ISO_FIELD_END,
};

/* The head, and the tables, with columns of numbers as base64 of little-endian doubles. The caller releases it. If memory
 * is short, parts are missing; json_whole() then says so. */
static json_t *data_of(const view_page *page)
{
    json_t *o = json_object(), *tables = json_array();
    json_put(o, "version", json_string(ISO_VERSION));
    json_add(o, page_fields, page);
    json_put(o, "effects", json_effects(&page->effects, true));
    for (size_t i = 0; i < page->tables; i++) json_array_append_new(tables, table_of(page->table[i]));
    json_put(o, "tables", tables);
    return o;
}

/* --- the page --------------------------------------------------------------------------------------------------- */

iso_status view_check_build(iso_context *ctx, bool live)
{
    if (live && !embedded_find(view_files, "library")->name)
        return ISO_FAIL_ARGUMENT(
            ctx, "",
            "this isoroll was built without the library as WebAssembly, which --live needs: build "
            "again without cmake -DISO_LIVE=OFF");
    if (embedded_find(view_files, "three")->length > 0) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "",
                             "this isoroll was built without three.js, which a page needs: install it (package "
                             "libjs-three) and build again, or build with cmake -DISO_THREE_JS=three.min.js");
}

/* Writes a piece of the JSON text. It has <, > and & only in its strings, where they may be escaped. */
static int write_escaped(const char *text, size_t length, void *data)
{
    FILE *to = data;
    for (size_t i = 0; i < length; i++)
        if (text[i] == '<' || text[i] == '>' || text[i] == '&')
            fprintf(to, "\\u%04x", (unsigned)text[i]);
        else
            fputc(text[i], to);
    return ferror(to) ? -1 : 0;
}

static bool is_of_live(const char *name)
{
    static const char *const names[] = {"policy", "live", "steps", "panel", "laboratory"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(name, names[i]) == 0) return true;
    return false;
}

/* Writes a file of view/ with what its lines "@name@" stand for. False: there is no memory for it. Errors of writing
 * are found at the end, by iso_output_check. */
static bool write_file(FILE *to, const embedded_file *file, const json_t *data, bool live)
{
    const char *at = (const char *)file->bytes, *end = at + file->length;
    char name[16];
    while (at < end) {
        const char *stop = memchr(at, '\n', (size_t)(end - at));
        const size_t length = (size_t)((stop ? stop : end) - at);
        const bool marker = length >= 3 && length <= 16 && at[0] == '@' && at[length - 1] == '@';
        snprintf(name, sizeof name, "%.*s", marker ? (int)length - 2 : 0, at + 1);
        if (!marker) {
            fwrite(at, 1, length, to);
        } else if (strcmp(name, "data") == 0) {
            if (json_dump_callback(data, write_escaped, to, JSON_COMPACT | JSON_REAL_PRECISION(17)) != 0 &&
                !ferror(to))
                return false;
        } else if ((live || !is_of_live(name)) && !write_file(to, embedded_find(view_files, name), data, live)) {
            return false;
        }
        fputc('\n', to);
        at += length + 1;
    }
    return true;
}

iso_status view_write(iso_context *ctx, const char *path, const view_page *page)
{
    iso_output *out;
    json_begin();
    json_t *data = data_of(page);
    iso_status status = json_whole(data) ? iso_output_open(ctx, path, &out) : iso_context_no_memory(ctx, "the page");
    if (status == ISO_OK) {
        status = write_file(iso_output_stream(out), embedded_find(view_files, "page"), data, page->live)
                     ? iso_output_check(ctx, out)
                     : iso_context_no_memory(ctx, "the page");
        const iso_status closed = iso_output_close(ctx, out, status == ISO_OK);
        if (status == ISO_OK) status = closed;
    }
    json_decref(data);
    return status;
}

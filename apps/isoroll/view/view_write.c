/* view_write.c - writes the page: page.html with its style, three.js, the data and our code in their places.
 *
 * page.html has lines "@name@". Each is replaced by a file of view/, which may have such lines itself, or by the data.
 * What only --live needs is left out without it: those of is_of_live(). In the data the characters <, >
 * and & are escaped, so no text of a file can end the script that holds it, or begin another.
 */
#include <string.h>

#include "embedded.h"
#include "io/output_impl.h"
#include "json.h"
#include "view/view.h"

iso_status view_check_build(iso_context *ctx, bool live)
{
    if (live && !embedded_find(view_files, "library")->name)
        return ISO_FAIL_ARGUMENT(
            ctx, "",
            "this isoroll was built without the library as WebAssembly, which --live needs: install "
            "emscripten and node-acorn, get sources with apps/live/sources.sh, and build again");
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
    json_t *data = view_data(page);
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

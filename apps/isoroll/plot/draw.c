/* draw.c - a picture as a script of gnuplot (see draw.h). */
#define _GNU_SOURCE /* mempcpy */
#include "plot/draw.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number_impl.h"
#include "embedded.h"
#include "io/output_impl.h"
#include "io/table.h"
#include "plot/gnuplot.h"
#include "report.h"

enum { LONGEST = 110, LONGEST_LINE = 150, LONGEST_WORD = 60, MOST_TEMPLATE = 1 << 20 };

/* --- texts ------------------------------------------------------------------------------------------------------ */

enum { QUOTED_SIZE = 1280, NARROW_TITLE = 38 };

/* The length of the character that begins text, 0 if it is none that XML and pango take (controls, broken UTF-8). */
static int character_length(const char *from)
{
    const unsigned char *text = (const unsigned char *)from;
    static const unsigned smallest[] = {0, 0x20, 0xA0, 0x800, 0x10000};
    const int length = text[0] < 0x80 ? 1 : text[0] < 0xC0 ? 0 : text[0] < 0xE0 ? 2 : text[0] < 0xF0 ? 3 : 4;
    if (length == 0 || text[0] >= 0xF8 || text[0] == 0x7F) return 0;
    unsigned code = length == 1 ? text[0] : text[0] & (0x7Fu >> length);
    for (int i = 1; i < length; i++) {
        if ((text[i] & 0xC0) != 0x80) return 0;
        code = code << 6 | (text[i] & 0x3Fu);
    }
    const bool surrogate = code >= 0xD800 && code < 0xE000;
    return code < smallest[length] || code > 0x10FFFF || surrogate || (code & 0xFFFE) == 0xFFFE ? 0 : length;
}

/* Characters that mean nothing to gnuplot in a text; quotes, backslashes, `commands` and @macros are not among
 * them. */
static bool is_plain(unsigned char c)
{
    return c >= 0x80 || (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
           (c && strchr(" -._/,:", c));
}

/* A text as gnuplot takes it, whatever it is (NULL: ""): one quoted string of one line, valid UTF-8, cut after
 * `longest` characters, at most 160. It still needs `noenhanced`. Every character that is not plain is written in
 * octal. (In single quotes gnuplot 5.4 fails on a text that begins with a quote.) gnuplot reads a fourth digit as part
 * of the number: before a digit the text is closed, and joined to the next by a dot. */
static const char *quote(char quoted[static QUOTED_SIZE], const char *text, int longest)
{
    const unsigned char *c = (const unsigned char *)(text ? text : "");
    char *to = quoted;
    *to++ = '"';
    for (int i = 0; *c && i < longest; i++) {
        const int length = character_length((const char *)c);
        if (length == 0)
            *to++ = *c < 0x20 ? ' ' : '.';
        else if (is_plain(*c))
            to = mempcpy(to, c, (size_t)length);
        else
            to += sprintf(to, c[1] >= '0' && c[1] <= '9' ? "\\%03o\".\"" : "\\%03o", *c);
        c += length > 0 ? length : 1;
    }
    strcpy(to, *c ? "…\"" : "\"");
    return quoted;
}

/* Where the first line of a title ends, which is too long for one: where there is a gap, else at the last blank that is
 * near enough, outside of parentheses if there is one. Without such a blank the line is longer. */
static size_t end_of_line(const char *text)
{
    size_t outside = 0, inside = 0;
    int open = 0;
    for (size_t i = 0; text[i] && i <= NARROW_TITLE; i++) {
        open += (text[i] == '(') - (text[i] == ')');
        if (text[i] != ' ' || i == 0) continue;
        if (text[i + 1] == ' ') return i;
        inside = i;
        if (open == 0) outside = i;
    }
    return outside ? outside : inside ? inside : strlen(text);
}

/* The same in lines that are short enough for a narrow page. */
static const char *quote_lines(char quoted[static QUOTED_SIZE], const char *text, int longest)
{
    char line[QUOTED_SIZE], whole[200] = "", part[200];
    for (int i = 0, used = 0, length; text && *text && i < longest && used < (int)sizeof whole - 8; i++) {
        length = character_length(text);
        used += snprintf(whole + used, sizeof whole - (size_t)used, "%.*s", length > 0 ? length : 1,
                         length > 0 ? text : " ");
        text += length > 0 ? length : 1;
    }
    text = whole;
    *quoted = '\0';
    for (; *quoted == '\0' || *text;) {
        const size_t used = strlen(quoted), length = strlen(text) > NARROW_TITLE ? end_of_line(text) : strlen(text);
        snprintf(part, sizeof part, "%.*s", (int)length, text);
        snprintf(quoted + used, QUOTED_SIZE - used, "%s%s", used ? ".\"\\n\"." : "", quote(line, part, longest));
        for (text += length; *text == ' ';) text++;
    }
    return quoted;
}

/* --- variables -------------------------------------------------------------------------------------------------- */

/* The lines of the picture; keys that are no names of gnuplot are left out. */
static void write_lines(FILE *f, const iso_plot_page *page, const iso_record *first)
{
    const char *key, *value, *title = page->title ? page->title : iso_record_get(first, "title");
    const bool narrow = page->style == ISO_PLOT_IN_PRINT && page->size.width == 0; /* one panel: one column wide */
    char quoted[QUOTED_SIZE];
    double x;
    fprintf(f, "title = %s\n", quote(quoted, title, LONGEST));
    fprintf(f, "narrow_title = %s\n", narrow ? quote_lines(quoted, title, LONGEST) : quoted);
    for (size_t i = 0; iso_record_line(first, i, &key, &value); i++) {
        if (strcmp(key, "title") == 0 || !(*key >= 'a' && *key <= 'z') ||
            key[strspn(key, "abcdefghijklmnopqrstuvwxyz0123456789_")])
            continue;
        if (iso_number_read(value, strlen(value), &x))
            fprintf(f, isfinite(x) ? "%s = %.17g\n" : "%s = NaN\n", key, x);
        else
            fprintf(f, "%s = %s\n", key, quote(quoted, value, LONGEST_LINE));
    }
}

/* --- data ------------------------------------------------------------------------------------------------------- */

/* A word in a block of data. There gnuplot reads no octal codes, so quotes and backslashes become other signs. */
static void write_word(FILE *f, const char *word)
{
    fputc('"', f);
    for (int i = 0, length; *word && i<LONGEST_WORD; i++, word += length> 0 ? length : 1) {
        length = character_length(word);
        if (length > 1)
            fwrite(word, 1, (size_t)length, f);
        else
            fputc(length == 0 ? ' ' : *word == '"' || *word == '`' ? '\'' : *word == '\\' ? '/' : *word, f);
    }
    fputc('"', f);
}

/* A number that is not finite is written as NaN, which is missing. */
static void write_block(FILE *f, const iso_record *r)
{
    const size_t columns = iso_record_columns(r);
    fprintf(f, "$%s << EOD\n", iso_record_kind(r));
    for (size_t c = 0; c < columns; c++) {
        write_word(f, iso_record_name(r, c));
        fputc(c + 1 < columns ? ' ' : '\n', f);
    }
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double *row = iso_record_const_row(r, i);
        bool any = false; /* a row of NaN alone is a gap of lines: an empty line */
        for (size_t c = 0; c < columns && !any; c++) any = !isnan(row[c]);
        for (size_t c = 0; any && c < columns; c++) {
            if (iso_record_has_words(r, c))
                write_word(f, iso_record_word(r, row[c]));
            else
                fputs(isfinite(row[c]) ? ISO_SHORT(row[c]) : "NaN", f);
            if (c + 1 < columns) fputc(' ', f);
        }
        fputc('\n', f);
    }
    fputs("EOD\n", f);
}

/* --- the template ----------------------------------------------------------------------------------------------- */

static void write_embedded(FILE *f, const char *name)
{
    const embedded_file *file = embedded_find(picture_files, name);
    fwrite(file->bytes, 1, file->length, f);
}

static iso_status write_template(iso_context *ctx, FILE *f, const iso_plot_page *page, const char *layout)
{
    if (!page->template && !embedded_find(picture_files, layout)->name)
        return ISO_FAIL_ARGUMENT(ctx, "", "this isoroll has no template '%s' of pictures", layout);
    if (!page->template) return write_embedded(f, layout), ISO_OK;
    FILE *from = fopen(page->template, "re");
    char part[4096];
    size_t got, all = 0;
    if (!from) return iso_file_trouble(ctx, "open", page->template);
    while ((got = fread(part, 1, sizeof part, from)) > 0 && (all += got) <= MOST_TEMPLATE) fwrite(part, 1, got, f);
    const iso_status status = ferror(from) ? iso_file_trouble(ctx, "read", page->template) : ISO_OK;
    fclose(from);
    if (status == ISO_OK && all == 0)
        return ISO_FAIL_ARGUMENT(ctx, "template", "--template '%s' is empty", page->template);
    if (status != ISO_OK || all <= MOST_TEMPLATE) return status;
    return ISO_FAIL_ARGUMENT(ctx, "template", "--template '%s' is larger than 1 MB", page->template);
}

iso_status plot_draw(iso_context *ctx, const iso_plot_page *page, const iso_picture *picture)
{
    ISO_TRY(iso_gnuplot_check_files(ctx, page));
    FILE *f = tmpfile();
    if (!f) return iso_file_trouble(ctx, "open", "a temporary file");
    fprintf(f, "# Made by isoroll, for gnuplot 5.4: gnuplot -d SCRIPT >PICTURE%s\n", strrchr(page->path, '.'));
    write_lines(f, page, picture->table[0]);
    iso_gnuplot_write_page(f, page); /* behind them: no line can change it */
    write_embedded(f, "page");
    for (int i = 0; i < ISO_PICTURE_TABLES && picture->table[i]; i++) write_block(f, picture->table[i]);
    iso_status status = write_template(ctx, f, page, picture->layout);
    if (status == ISO_OK) status = iso_gnuplot_run(ctx, page, f);
    fclose(f);
    return status;
}

iso_status plot_tables(iso_context *ctx, const iso_plot_page *page, const iso_record *const table[],
                       const char *options)
{
    iso_picture picture;
    ISO_TRY(iso_picture_make(ctx, table, options, &picture));
    const char *note = iso_record_get(picture.table[0], "note");
    if (note) warn("%s", note);
    const iso_status status = plot_draw(ctx, page, &picture);
    iso_picture_free(&picture);
    return status;
}

/* --- what a page says of sections ------------------------------------------------------------------------------- */

iso_status plot_read_over(iso_context *ctx, const iso_plot_page *page, iso_record *over[ISO_PLOT_OVERS + 1])
{
    for (int i = 0; i <= ISO_PLOT_OVERS; i++) over[i] = NULL;
    for (int i = 0; i < ISO_PLOT_OVERS && page->over[i]; i++) {
        const char *file = page->over[i];
        ISO_TRY(iso_table_read(ctx, file, NULL, NULL, &over[i], NULL));
        const char *kind = iso_record_kind(over[i]);
        if (strcmp(kind, "periodic") != 0 && strcmp(kind, "splitting") != 0)
            return ISO_FAIL_INPUT(ctx, "over", "--over '%s': expected what 'periodic -o' or 'splitting -o' writes",
                                  file);
        ISO_TRY(iso_record_set(ctx, over[i], "file", file));
    }
    return ISO_OK;
}

const char *plot_section_options(const iso_plot_page *page, char text[static PLOT_SECTION_OPTIONS])
{
    const bool png = strcmp(strrchr(page->path, '.'), ".png") == 0;
    snprintf(text, PLOT_SECTION_OPTIONS, "%s%s%s%s", page->window ? "window=" : "", page->window ? page->window : "",
             page->window ? "\n" : "", png ? "" : "points=4000\n");
    return text;
}

iso_status plot_table(iso_context *ctx, const iso_plot_page *page, const iso_record *table)
{
    const char *wish = iso_plot_section_wish(page), *kind = iso_record_kind(table);
    char text[PLOT_SECTION_OPTIONS];
    iso_record *over[ISO_PLOT_OVERS + 1];
    const iso_record *all[ISO_PLOT_OVERS + 2] = {table};
    if (strcmp(kind, "section") != 0)
        return wish ? ISO_FAIL_ARGUMENT(ctx, wish, "--%s is for sections, and this is a table '%s'", wish, kind)
                    : plot_tables(ctx, page, all, NULL);
    iso_status status = plot_read_over(ctx, page, over);
    for (int i = 0; i < ISO_PLOT_OVERS; i++) all[1 + i] = over[i];
    if (status == ISO_OK) status = plot_tables(ctx, page, all, plot_section_options(page, text));
    for (int i = 0; i < ISO_PLOT_OVERS; i++) iso_record_free(over[i]);
    return status;
}

/* draw.c - a picture as a script of gnuplot (see draw.h). */
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

/* --- variables -------------------------------------------------------------------------------------------------- */

/* The lines of the picture; keys that are no names of gnuplot are left out. */
static void put_lines(FILE *f, const iso_plot_page *page, const iso_record *first)
{
    const char *key, *value, *own = iso_record_get(first, "title");
    double x;
    fprintf(f, "title = %s\nnarrow_title = %s\n", QUOTED(iso_plot_titled(page, own), LONGEST),
            TITLE(page, own, LONGEST));
    for (size_t i = 0; iso_record_line(first, i, &key, &value); i++) {
        if (strcmp(key, "title") == 0 || !(*key >= 'a' && *key <= 'z') ||
            key[strspn(key, "abcdefghijklmnopqrstuvwxyz0123456789_")])
            continue;
        if (iso_number_read(value, strlen(value), &x))
            fprintf(f, isfinite(x) ? "%s = %.17g\n" : "%s = NaN\n", key, x);
        else
            fprintf(f, "%s = %s\n", key, QUOTED(value, LONGEST_LINE));
    }
}

/* --- data ------------------------------------------------------------------------------------------------------- */

/* A word in a block of data. There gnuplot reads no octal codes, so quotes and backslashes become other signs. */
static void put_word(FILE *f, const char *word)
{
    fputc('"', f);
    for (int i = 0, length; *word && i<LONGEST_WORD; i++, word += length> 0 ? length : 1) {
        length = iso_gnuplot_character(word);
        if (length > 1)
            fwrite(word, 1, (size_t)length, f);
        else
            fputc(length == 0 ? ' ' : *word == '"' || *word == '`' ? '\'' : *word == '\\' ? '/' : *word, f);
    }
    fputc('"', f);
}

/* A number that is not finite is written as NaN, which is missing. */
static void put_block(FILE *f, const iso_record *r)
{
    const size_t columns = iso_record_columns(r);
    fprintf(f, "$%s << EOD\n", iso_record_kind(r));
    for (size_t c = 0; c < columns; c++) {
        put_word(f, iso_record_name(r, c));
        fputc(c + 1 < columns ? ' ' : '\n', f);
    }
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double *row = iso_record_const_row(r, i);
        bool any = false; /* a row of NaN alone is a gap of lines: an empty line */
        for (size_t c = 0; c < columns && !any; c++) any = !isnan(row[c]);
        for (size_t c = 0; any && c < columns; c++) {
            if (iso_record_has_words(r, c))
                put_word(f, iso_record_word(r, row[c]));
            else
                fputs(isfinite(row[c]) ? ISO_SHORT(row[c]) : "NaN", f);
            if (c + 1 < columns) fputc(' ', f);
        }
        fputc('\n', f);
    }
    fputs("EOD\n", f);
}

/* --- the template ----------------------------------------------------------------------------------------------- */

static void put_embedded(FILE *f, const char *name)
{
    const embedded_file *file = embedded_find(picture_files, name);
    fwrite(file->bytes, 1, file->length, f);
}

static iso_status put_template(iso_context *ctx, FILE *f, const iso_plot_page *page, const char *layout)
{
    if (!page->template && !embedded_find(picture_files, layout)->name)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "this isoroll has no template '%s' of pictures", layout);
    if (!page->template) return put_embedded(f, layout), ISO_OK;
    FILE *from = fopen(page->template, "re");
    char part[4096];
    size_t got, all = 0;
    if (!from) return iso_file_trouble(ctx, "open", page->template);
    while ((got = fread(part, 1, sizeof part, from)) > 0 && (all += got) <= MOST_TEMPLATE) fwrite(part, 1, got, f);
    const iso_status status = ferror(from) ? iso_file_trouble(ctx, "read", page->template) : ISO_OK;
    fclose(from);
    if (status == ISO_OK && all == 0)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "template", "--template '%s' is empty", page->template);
    if (status != ISO_OK || all <= MOST_TEMPLATE) return status;
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "template", "--template '%s' is larger than 1 MB", page->template);
}

iso_status plot_draw(iso_context *ctx, const iso_plot_page *page, const iso_picture *picture)
{
    FILE *f = iso_gnuplot_begin(ctx, page);
    put_lines(f, page, picture->table[0]);
    iso_gnuplot_put_page(f, page); /* behind them: no line can change it */
    put_embedded(f, "page");
    for (int i = 0; i < ISO_PICTURE_TABLES && picture->table[i]; i++) put_block(f, picture->table[i]);
    const iso_status status = put_template(ctx, f, page, picture->layout);
    const iso_status closed = iso_gnuplot_close(ctx, status == ISO_OK);
    return status != ISO_OK ? status : closed;
}

iso_status plot_tables(iso_context *ctx, const iso_plot_page *page, const iso_record *const table[],
                       const char *options)
{
    iso_picture picture;
    ISO_TRY(iso_picture_make(ctx, table, options, &picture));
    const char *note = iso_record_get(picture.table[0], "note");
    if (note) complain("%s", note);
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
            return iso_context_fail(ctx, ISO_BAD_INPUT, "over",
                                    "--over '%s': expected what 'periodic -o' or 'splitting -o' writes", file);
        ISO_TRY(iso_record_set(ctx, over[i], "file", file));
    }
    return ISO_OK;
}

const char *plot_section_options(const iso_plot_page *page, char text[static PLOT_SECTION_OPTIONS])
{
    const size_t length = strlen(page->path);
    const bool png = length > 4 && strcmp(page->path + length - 4, ".png") == 0;
    snprintf(text, PLOT_SECTION_OPTIONS, "%s%s%s%s", page->window ? "window=" : "", page->window ? page->window : "",
             page->window ? "\n" : "", png ? "" : "points=4000\n");
    return text;
}

iso_status plot_section(iso_context *ctx, const iso_plot_page *page, const iso_record *section)
{
    char text[PLOT_SECTION_OPTIONS];
    iso_record *over[ISO_PLOT_OVERS + 1];
    const iso_record *table[ISO_PLOT_OVERS + 2] = {section};
    iso_status status = plot_read_over(ctx, page, over);
    for (int i = 0; i < ISO_PLOT_OVERS; i++) table[1 + i] = over[i];
    if (status == ISO_OK) status = plot_tables(ctx, page, table, plot_section_options(page, text));
    for (int i = 0; i < ISO_PLOT_OVERS; i++) iso_record_free(over[i]);
    return status;
}

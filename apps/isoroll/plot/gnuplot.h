/* gnuplot.h - one run of gnuplot: a script in, a picture file out, whole or not at all.
 *
 *     FILE *script = iso_gnuplot_begin(ctx, &page);
 *     fprintf(script, "plot %.17g\n", 1.5);                      gnuplot commands and data go in here
 *     status = iso_gnuplot_close(ctx, true);                     runs gnuplot
 */
#ifndef ISOROLL_GNUPLOT_H
#define ISOROLL_GNUPLOT_H

#include <stdbool.h>
#include <stdio.h>
#include <sys/types.h>

#include "base/context.h"
#include "plot/page.h"

/* Whether the picture and its script can have these names. Errors: ISO_BAD_ARGUMENT: none of a picture;
 * ISO_FILE_TROUBLE: what has the name is no regular file. */
iso_status iso_gnuplot_check_files(iso_context *ctx, const iso_plot_page *page);

/* Begins a picture that pictures/page.gp lays out: the script begins with what the page is to be. One at a time.
 * Returns the script, never NULL; iso_gnuplot_close tells what went wrong. */
FILE *iso_gnuplot_begin(iso_context *ctx, const iso_plot_page *page);

/* Writes what the page is to be, as variables of pictures/page.gp. */
void iso_gnuplot_put_page(FILE *script, const iso_plot_page *page);

/* The length of the character that begins text, 0 if it is none that XML and pango take (controls, broken UTF-8). */
int iso_gnuplot_character(const char *text);

/* Ends the picture. keep: writes the script if it is asked for, draws the picture and gives it its name; else nothing
 * is left. Errors: ISO_BAD_ARGUMENT
 * (format); ISO_FILE_TROUBLE: no gnuplot, gnuplot's own complaint, or the picture cannot be written. */
iso_status iso_gnuplot_close(iso_context *ctx, bool keep);

/* Starts a program that is searched for in PATH, its name and arguments with NULL behind them, with these standard
 * streams. Gives an errno, 0 if it runs. */
int program_start(const char *const arguments[], const int streams[3], pid_t *child);

/* A text as gnuplot takes it, whatever it is (NULL: ""): one quoted string of one line, valid UTF-8, cut after
 * `longest` characters, at most 160. It still needs `noenhanced`. */
enum { ISO_QUOTED_SIZE = 1280 };
const char *iso_gnuplot_quote(char quoted[static ISO_QUOTED_SIZE], const char *text, int longest);

/* A title as gnuplot takes it, in lines that are short enough for a narrow page; one line on others. */
const char *iso_gnuplot_quote_title(char quoted[static ISO_QUOTED_SIZE], const iso_plot_page *page, const char *own,
                                    int longest);
#define TITLE(page, own, longest) iso_gnuplot_quote_title((char[ISO_QUOTED_SIZE]){0}, page, own, longest)
#define QUOTED(text, longest) iso_gnuplot_quote((char[ISO_QUOTED_SIZE]){0}, text, longest)

#endif

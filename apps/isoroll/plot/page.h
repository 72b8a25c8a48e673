/* page.h - the file of a picture, and its look: what the options --style, --size, --title, --script, --template say.
 *
 * A picture is laid out in pixels of a page 900 wide, the same in every format. On the screen this page grows with
 * --size, and its letters with it. In print the letters are 8 pt high, whatever the size; a page 900 wide is 178 mm
 * wide, two columns of a journal. Pictures of one panel then take a page 435 wide: one column, 86 mm.
 */
#ifndef ISOROLL_PAGE_H
#define ISOROLL_PAGE_H

#include <stdbool.h>

#include "base/context.h"

typedef enum iso_plot_style { ISO_PLOT_ANY_STYLE, ISO_PLOT_ON_SCREEN, ISO_PLOT_IN_PRINT } iso_plot_style;

typedef struct iso_plot_size {
    double width, height; /* 0: not given */
    bool mm;              /* else px      */
} iso_plot_size;

enum { ISO_PLOT_OVERS = 4 };

typedef struct iso_plot_page {
    const char *path;     /* of the picture, which ends in .svg, .png or .pdf; NULL: no picture is asked for */
    const char *title;    /* in place of its own; "": none; NULL: its own                                    */
    const char *script;   /* gets gnuplot's script with its data; NULL: it is not kept                       */
    const char *template; /* a file of gnuplot in place of pictures/LAYOUT.gp; NULL: that one                  */
    iso_plot_style style; /* not given: the screen's                                                         */
    iso_plot_size size;
    const char *window;               /* of a section: "L0:L1,X0:X1"; NULL: the whole                */
    const char *over[ISO_PLOT_OVERS]; /* files that are drawn over a section; NULL: no more of them  */
} iso_plot_page;

/* Whether the picture can have this name, and whether there is one if there are wishes for it: to ask before the
 * work. Errors: ISO_BAD_ARGUMENT; ISO_FILE_TROUBLE: what has its name, or the script's, is no regular file. */
iso_status iso_plot_check_page(iso_context *ctx, const iso_plot_page *page);

/* "over" or "window", if one is given: they are for sections. NULL: none is. */
const char *iso_plot_section_wish(const iso_plot_page *page);

/* Setters of options. */
bool iso_plot_set_style(void *at, const char *text); /* iso_plot_style: a word of iso_plot_style_word */
bool iso_plot_set_size(void *at, const char *text);  /* WIDTHxHEIGHT and mm or px                     */
enum { ISO_PLOT_MOST_TITLE = 95 };
bool iso_plot_set_title(void *at, const char *text); /* const char *; none: ""                        */
bool iso_plot_set_window(void *at, const char *text);
bool iso_plot_set_over(void *at, const char *text); /* one file more */
const char *iso_plot_style_word(int i);             /* "screen", "print"                             */

/* The rows of options that every command with a picture has; `field` is the page's place in the struct `type`. */
#define ROWS_OF_PLOT(type, field)                                                                                    \
    ROW_OF_FILE("plot", "FILE", "a file", "draw a picture: .svg, .png or .pdf", iso_set_text, type, field.path, 0,   \
                OPTION_WRITES),                                                                                      \
        ROWS_OF_LOOK(type, field)
#define ROWS_OF_LOOK(type, field)                                                                                    \
    ROW_WITH("style", "STYLE", "screen or print", "of the picture: screen (default), or print, letters of 8 pt",     \
             iso_plot_set_style, type, field.style, .word = iso_plot_style_word, .aside = true),                     \
        ROW_WITH("size", "WxH",                                                                                      \
                 "WIDTHxHEIGHT such as 86x60mm or 1200x800px, each from 20 to 2000 mm or 100 to 10000 px",           \
                 "of the picture: width and height, as 86x60mm or 1200x800px", iso_plot_set_size, type, field.size,  \
                 .aside = true),                                                                                     \
        ROW_WITH("title", "TEXT", "a text of at most 95 letters",                                                    \
                 "of the picture: its title; none: it has no title", iso_plot_set_title, type, field.title,          \
                 .aside = true),                                                                                     \
        ROW_OF_FILE("script", "FILE", "a file", "of the picture: write gnuplot's script, with its data",             \
                    iso_set_text, type, field.script, 0, OPTION_WRITES),                                             \
        ROW_OF_FILE("template", "FILE", "a file", "of the picture: draw with your own gnuplot template",             \
                    iso_set_text, type, field.template, 0, OPTION_READS)

/* The rows of a command that draws sections. */
#define ROWS_OF_SECTION(type, field)                                                                                 \
    ROW_WITH("window", "L0:L1,X0:X1", "two ranges such as 0.5:1.2,-0.3:0.3, l up to pi and x up to 1",               \
             "of a section: draw only this part of l (in rad) and x", iso_plot_set_window, type, field.window,       \
             .aside = true),                                                                                         \
        ROW_WITH("over", "FILE", "a file, at most 4 times",                                                          \
                 "of a section: draw these periodic orbits, or this splitting, over it", iso_plot_set_over, type,    \
                 field.over, .file = OPTION_READS, .aside = true)

#endif

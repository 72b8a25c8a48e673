/* page.c - what is asked of a picture's page (see page.h). */
#include "plot/page.h"

#include <math.h>
#include <string.h>

#include "base/number_impl.h"
#include "picture/section_impl.h"
#include "plot/gnuplot.h"

/* --- setters ---------------------------------------------------------------------------------------------------- */

static const char *const styles[] = {"screen", "print", NULL};

const char *iso_plot_style_word(int i)
{
    return styles[i];
}

bool iso_plot_set_style(void *at, const char *text)
{
    int i = 0;
    while (styles[i] && strcmp(text, styles[i]) != 0) i++;
    *(iso_plot_style *)at = (iso_plot_style)(i + 1);
    return styles[i] != NULL;
}

bool iso_plot_set_title(void *at, const char *text)
{
    *(const char **)at = strcmp(text, "none") == 0 ? "" : text;
    return strlen(text) <= ISO_PLOT_MOST_TITLE;
}

/* From about the size of a stamp to that of a wall. */
bool iso_plot_set_size(void *at, const char *text)
{
    iso_plot_size size, *to = at;
    const size_t length = strlen(text);
    const char *x = strchr(text, 'x'), *unit = length > 2 ? text + length - 2 : text;
    if (!x || x >= unit) return false;
    size.mm = strcmp(unit, "mm") == 0;
    if ((!size.mm && strcmp(unit, "px") != 0) || !iso_number_read(text, (size_t)(x - text), &size.width) ||
        !iso_number_read(x + 1, (size_t)(unit - x - 1), &size.height))
        return false;
    *to = size;
    const double least = size.mm ? 20 : 100, most = size.mm ? 2000 : 10000;
    return fmin(size.width, size.height) >= least && fmax(size.width, size.height) <= most;
}

bool iso_plot_set_window(void *at, const char *text)
{
    double window[2][2];
    *(const char **)at = text;
    return iso_picture_window(text, window);
}

bool iso_plot_set_over(void *at, const char *text)
{
    const char **over = at;
    int i = 0;
    while (i < ISO_PLOT_OVERS && over[i]) i++;
    if (i < ISO_PLOT_OVERS) over[i] = text;
    return i < ISO_PLOT_OVERS && *text;
}

const char *iso_plot_section_wish(const iso_plot_page *page)
{
    return page->over[0] ? "over" : page->window ? "window" : NULL;
}

/* --- the page --------------------------------------------------------------------------------------------------- */

iso_status iso_plot_check_page(iso_context *ctx, const iso_plot_page *page)
{
    const char *wish = page->style            ? "style"
                       : page->size.width > 0 ? "size"
                       : page->title          ? "title"
                       : page->script         ? "script"
                       : page->template       ? "template"
                                              : iso_plot_section_wish(page);
    if (page->script && strcmp(page->script, "-") == 0)
        return ISO_FAIL_ARGUMENT(ctx, "script",
                                 "--script -: standard output has no room for it: "
                                 "give the name of a file");
    if (page->path) return iso_gnuplot_check_files(ctx, page);
    if (!wish) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, wish, "--%s is about a picture: give --plot FILE, too", wish);
}

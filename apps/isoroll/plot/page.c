/* page.c - what is asked of a picture's page (see page.h). */
#include "plot/page.h"

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
static bool is_good(double length, bool mm)
{
    return mm ? length >= 20 && length <= 2000 : length >= 100 && length <= 10000;
}

bool iso_plot_set_size(void *at, const char *text)
{
    iso_plot_size size, *to = at;
    const char *x = strchr(text, 'x');
    const size_t length = strlen(text);
    if (!x || length < 2) return false;
    size.mm = strcmp(text + length - 2, "mm") == 0;
    if (!size.mm && strcmp(text + length - 2, "px") != 0) return false;
    if (x + 1 > text + length - 2 || !iso_number_read(text, (size_t)(x - text), &size.width) ||
        !iso_number_read(x + 1, (size_t)(text + length - 2 - x - 1), &size.height))
        return false;
    *to = size;
    return is_good(size.width, size.mm) && is_good(size.height, size.mm);
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
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "script",
                                "--script -: standard output has no room for it: "
                                "give the name of a file");
    if (page->path) return iso_gnuplot_check_files(ctx, page);
    if (!wish) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, wish, "--%s is about a picture: give --plot FILE, too", wish);
}

const char *iso_plot_titled(const iso_plot_page *page, const char *own)
{
    return page->title ? page->title : own;
}

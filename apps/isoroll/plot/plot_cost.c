/* plot_cost.c - the work-precision diagram: a panel for each backend, a line for each method. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

enum { WIDTH = 900, HEIGHT = 490, KEY = 96, KEY_COLUMNS = 3, PANELS = 2, SERIES = 128 };
enum { NAMES = 10, NAMED = 6 }; /* methods that have a name, in all, and of each backend */
#define FLOOR 1e-17             /* stands for an error of 0 */

/* The markers of the methods, beside iso_plot_stroke. */
static const int markers[NAMES] = {7, 5, 9, 11, 13, 6, 4, 8, 10, 12};
#define OTHER "lines dt 1 lw 0.8 lc rgb " ISO_PLOT_OTHERS
#define CLOSED "points pt 3 ps 1.5 lw 2 lc rgb 'black'"
#define BAND ISO_PLOT_BAND

/* A line of the picture; name -1: it is one of the others. */
typedef struct series {
    int panel, name;
} series;

typedef struct layout {
    const iso_record *rows;
    int count, panels, names; /* panels: up to the last one that is not empty */
    series one[SERIES];
    const char *name[NAMES];
    bool others;
    double closed[2], uncertainty; /* error and seconds of the closed solution; NaN: none */
    double error[2], seconds[2];   /* least and largest */
} layout;

static const char *const backends[PANELS] = {"ball", "point"};

static bool is_drawn(const iso_record *r, size_t row)
{
    const double seconds = iso_plot_number(r, row, "total");
    return isfinite(iso_plot_number(r, row, "error")) && isfinite(seconds) && seconds > 0;
}

static const char *method_of(const iso_record *r, size_t row)
{
    return iso_record_word(r, iso_plot_number(r, row, "method"));
}

/* The first of a backend, and a method that is named already, have a name. */
static int find_name(layout *l, const char *name, int in_panel)
{
    for (int i = 0; i < l->names; i++)
        if (strcmp(l->name[i], name) == 0) return i;
    if (in_panel >= NAMED || l->names == NAMES) return -1;
    l->name[l->names] = name;
    return l->names++;
}

static void widen(double range[2], double x)
{
    range[0] = fmin(range[0], x);
    range[1] = fmax(range[1], x);
}

/* From whole to whole powers of ten. */
static void round_out(double range[2])
{
    range[0] = pow(10, floor(log10(range[0]) - 0.05));
    range[1] = pow(10, ceil(log10(range[1]) + 0.05));
}

static void put_point(FILE *f, double error, double seconds, int number)
{
    fprintf(f, "%.17g %.17g %d\n", fmax(error, FLOOR), seconds, number);
}

/* The points of a backend. Rows of one method that follow each other are a series. */
static void put_series(FILE *f, layout *l, int panel)
{
    const iso_record *r = l->rows;
    int in_panel = 0;
    bool open = false;
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const bool here = iso_plot_is(r, i, "backend", backends[panel]);
        open = open && here && strcmp(method_of(r, i), method_of(r, i - 1)) == 0;
        if (!here || !is_drawn(r, i) || (!open && l->count == SERIES)) continue;
        if (!open) {
            const int name = find_name(l, method_of(r, i), in_panel++);
            l->one[l->count++] = (series){panel, name};
            l->panels = panel + 1;
            l->others = l->others || name < 0;
            open = true;
        }
        put_point(f, iso_plot_number(r, i, "error"), iso_plot_number(r, i, "total"), l->count - 1);
    }
}

/* Writes the block $series: error, seconds and the number of the series, -1 for the closed solution. False: there is
 * nothing to draw. */
static bool lay_out(FILE *f, const iso_record *r, layout *l)
{
    const char *uncertainty = iso_record_get(r, "uncertainty");
    *l = (layout){.rows = r,
                  .closed = {NAN, NAN},
                  .uncertainty = uncertainty ? strtod(uncertainty, NULL) : 0,
                  .error = {INFINITY, 0},
                  .seconds = {INFINITY, 0}};
    fputs("set datafile missing NaN\n$series << EOD\n", f);
    for (int panel = 0; panel < PANELS; panel++) put_series(f, l, panel);
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double error = iso_plot_number(r, i, "error"), seconds = iso_plot_number(r, i, "total");
        if (!is_drawn(r, i)) continue;
        widen(l->error, fmax(error, FLOOR));
        widen(l->seconds, seconds);
        if (!*method_of(r, i)) l->closed[0] = error, l->closed[1] = seconds;
    }
    if (isfinite(l->closed[0])) put_point(f, l->closed[0], l->closed[1], -1);
    fputs("EOD\n", f);
    l->error[1] = fmin(l->error[1], 0.8); /* larger errors are no results */
    l->error[0] = fmin(l->error[0], l->error[1]);
    round_out(l->error);
    round_out(l->seconds);
    return l->count > 0 || isfinite(l->closed[0]);
}

static void put_axes(FILE *f, const iso_plot_page *page, const char *title, const layout *l)
{
    fprintf(f,
            "set multiplot\n" ISO_PLOT_AXES "unset key; set logscale xy; set format x '10^{%%T}'; unset mxtics\n"
            "set xlabel 'largest relative error of (ω, n)' offset 0,0.3\n"
            "set label 1 %s at screen 0.5,0.96 center noenhanced font ',12'\n"
            "set tmargin at screen 0.88; set bmargin at screen %.17g\n"
            "set xrange [%.17g:%.17g]\nset yrange [%.17g:%.17g]\n",
            QUOTED(iso_plot_titled(page, title), 95), (KEY + 50.0) / HEIGHT, l->error[1], l->error[0], l->seconds[0],
            l->seconds[1]);
    if (!(l->uncertainty > l->error[0])) return;
    fprintf(f,
            "set object 1 rectangle from first %.17g, graph 0 to graph 1, graph 1 behind fs solid 1 noborder fc "
            "rgb " BAND "\n",
            fmin(l->uncertainty, l->error[1]));
}

#define OF_SERIES "%s $series using ($3 == %d ? $1 : NaN):2 title '$series%d' with "

/* name -1: one of the others. */
static void put_stroke(FILE *f, int name)
{
    if (name < 0)
        fputs(OTHER, f);
    else
        fprintf(f, "linespoints ps 0.75 pt %d lw 1.5 %s", markers[name], iso_plot_stroke(name));
}

/* Lines of one panel, the named ones last, on top. */
static void put_lines(FILE *f, const layout *l, int panel)
{
    const char *before = "plot";
    for (int named = 0; named < 2; named++)
        for (int s = 0; s < l->count; s++) {
            if (l->one[s].panel != panel || (l->one[s].name >= 0) != named) continue;
            fprintf(f, OF_SERIES, before, s, s);
            put_stroke(f, l->one[s].name);
            before = ",";
        }
    if (isfinite(l->closed[0]))
        fprintf(f, "%s $series using ($3 == -1 ? $1 : NaN):2 title '$closed' with " CLOSED, before);
    fputc('\n', f);
}

/* Panels side by side; a backend without lines has none. */
static void put_panels(FILE *f, const layout *l)
{
    const bool both = l->panels == PANELS && l->one[0].panel == 0;
    const double gap = both ? 0.05 : 0, width = (0.965 - 0.085 - gap) / (both ? 2 : 1);
    for (int i = 0, panel = both || l->panels == 0 ? 0 : l->panels - 1; i <= both; i++, panel++) {
        const double from = 0.085 + i * (width + gap);
        fprintf(f,
                "set lmargin at screen %.17g; set rmargin at screen %.17g\nset ylabel '%s'; set format y '%s'\n"
                "set title %s noenhanced offset 0,-0.6\n",
                from, from + width, i == 0 ? "processor time in seconds" : "", i == 0 ? "10^{%T}" : "",
                QUOTED(l->panels ? backends[panel] : "", 60));
        put_lines(f, l, panel);
        fputs("unset label\n", f);
    }
}

/* The key below the panels, in a plot of its own. */
static void put_key(FILE *f, const layout *l)
{
    const int entries = l->names + l->others + isfinite(l->closed[0]) + (l->uncertainty > 0);
    fprintf(f,
            ISO_PLOT_PAGE "set key at screen 0.5,%.17g center top Left reverse vertical maxrows %d samplen 3.5 "
                          "spacing 1.05 width -1 noenhanced font ',9'\nplot",
            (double)KEY / HEIGHT, (entries + KEY_COLUMNS - 1) / KEY_COLUMNS);
    for (int n = 0; n < l->names; n++) {
        fputs(" NaN with ", f);
        put_stroke(f, n);
        fprintf(f, " title %s,", QUOTED(l->name[n], 24));
    }
    if (l->others) fputs(" NaN with " OTHER " title 'other methods',", f);
    if (isfinite(l->closed[0])) fputs(" NaN with " CLOSED " title 'closed solution',", f);
    fputs(l->uncertainty > 0 ? " NaN with boxes fs solid 1 noborder lc rgb " BAND " title 'below what is known'\n"
                             : " NaN notitle\n",
          f);
}

iso_status iso_plot_cost(iso_context *ctx, const iso_plot_page *page, const char *title, const iso_record *r)
{
    layout l;
    FILE *f = iso_gnuplot_open(ctx, page, WIDTH, HEIGHT);
    const bool any = lay_out(f, r, &l);
    put_axes(f, page, title, &l);
    put_panels(f, &l);
    put_key(f, &l);
    const iso_status status = iso_gnuplot_close(ctx, any);
    if (status != ISO_OK || any) return status;
    return iso_context_fail(ctx, ISO_BAD_INPUT, "", "there are no measurements to draw");
}

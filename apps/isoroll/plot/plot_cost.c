/* plot_cost.c - the work-precision diagram: a panel for each backend, a line for each method. */
#include <math.h>
#include <string.h>

#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

enum { WIDTH = 900, HEIGHT = 490, KEY = 96, KEY_COLUMNS = 3 };
#define FLOOR 1e-17 /* stands for an error of 0 */

/* In grey methods differ by their markers and dashes. */
static const char *const strokes[ISO_PLOT_NAMES] = {
    "pt 7 dt 1 lw 2 lc rgb " ISO_PLOT_BLUE,       "pt 5 dt (8,3) lw 1.6 lc rgb " ISO_PLOT_VERMILLION,
    "pt 9 dt 1 lw 1.4 lc rgb '#009E73'",          "pt 11 dt (2,3) lw 1.8 lc rgb 'black'",
    "pt 13 dt (8,3,2,3) lw 1.5 lc rgb '#CC79A7'", "pt 6 dt 1 lw 1.4 lc rgb '#E69F00'",
    "pt 4 dt (4,4) lw 1.5 lc rgb '#56B4E9'",      "pt 8 dt (2,2) lw 1.5 lc rgb '#7A5195'",
    "pt 10 dt (8,3) lw 1.4 lc rgb '#404040'",     "pt 12 dt 1 lw 1.4 lc rgb '#8C6D1F'"};
#define OTHER "lines dt 1 lw 0.8 lc rgb '#B4BABF'"
#define CLOSED "points pt 3 ps 1.5 lw 2 lc rgb 'black'"
#define BAND "'#E4E7EA'"

/* The lay-out: panels and names in the order of their first series, and the ranges of the axes. */
typedef struct layout {
    int panels, names;
    const char *panel[ISO_PLOT_PANELS], *name[ISO_PLOT_NAMES];
    bool others;
    double error[2], seconds[2]; /* least and largest */
} layout;

static bool is_drawn(const iso_plot_series *s, int i)
{
    return isfinite(s->error[i]) && isfinite(s->seconds[i]) && s->seconds[i] > 0;
}

static bool has_points(const iso_plot_series *s)
{
    for (int i = 0; i < s->count; i++)
        if (is_drawn(s, i)) return true;
    return false;
}

static bool has_closed(const iso_plot_work *w)
{
    return isfinite(w->closed[0]) && w->closed[1] > 0;
}

/* The index of a name among `count`, which grows when it is new; -1: no room. */
static int find_name(const char *names[], int *count, int room, const char *name)
{
    for (int i = 0; i < *count; i++)
        if (strcmp(names[i], name) == 0) return i;
    if (*count == room) return -1;
    names[*count] = name;
    return (*count)++;
}

static void widen(layout *l, double error, double seconds)
{
    l->error[0] = fmin(l->error[0], fmax(error, FLOOR));
    l->error[1] = fmax(l->error[1], fmax(error, FLOOR));
    l->seconds[0] = fmin(l->seconds[0], seconds);
    l->seconds[1] = fmax(l->seconds[1], seconds);
}

/* From whole to whole powers of ten. */
static void round_out(double range[2])
{
    range[0] = pow(10, floor(log10(range[0]) - 0.05));
    range[1] = pow(10, ceil(log10(range[1]) + 0.05));
}

/* False: more than there is room for, or nothing to draw. */
static bool lay_out(const iso_plot_work *w, layout *l)
{
    *l = (layout){.error = {INFINITY, 0}, .seconds = {INFINITY, 0}};
    if (w->count < 0 || w->count > ISO_PLOT_SERIES) return false;
    for (int s = 0; s < w->count; s++) {
        const iso_plot_series *one = &w->series[s];
        if (!has_points(one)) continue;
        if (find_name(l->panel, &l->panels, ISO_PLOT_PANELS, one->panel) < 0) return false;
        if (one->name && find_name(l->name, &l->names, ISO_PLOT_NAMES, one->name) < 0) return false;
        l->others = l->others || !one->name;
        for (int i = 0; i < one->count; i++)
            if (is_drawn(one, i)) widen(l, one->error[i], one->seconds[i]);
    }
    if (has_closed(w)) {
        widen(l, w->closed[0], w->closed[1]);
        if (l->panels == 0) l->panel[l->panels++] = "";
    }
    if (l->panels == 0) return false;
    l->error[1] = fmin(l->error[1], 0.8); /* larger errors are no results */
    l->error[0] = fmin(l->error[0], l->error[1]);
    round_out(l->error);
    round_out(l->seconds);
    return true;
}

static void put_data(FILE *f, const iso_plot_work *w)
{
    for (int s = 0; s < w->count; s++) {
        const iso_plot_series *one = &w->series[s];
        fprintf(f, "$series%d << EOD\n", s);
        for (int i = 0; i < one->count; i++)
            if (is_drawn(one, i)) iso_gnuplot_pair(f, fmax(one->error[i], FLOOR), one->seconds[i]);
        fputs("EOD\n", f);
    }
    fputs("$closed << EOD\n", f);
    if (has_closed(w)) iso_gnuplot_pair(f, fmax(w->closed[0], FLOOR), w->closed[1]);
    fputs("EOD\n", f);
}

static void put_range(FILE *f, const char *axis, double from, double to)
{
    fprintf(f, "set %srange [", axis);
    iso_gnuplot_number(f, from);
    fputc(':', f);
    iso_gnuplot_number(f, to);
    fputs("]\n", f);
}

static void put_axes(FILE *f, const iso_plot_work *w, const layout *l)
{
    fputs("set border 3 lc rgb '#606060'; set tics nomirror out scale 0.6; unset key\n"
          "set grid back lt 1 lw 0.8 lc rgb '#DDE1E5'\nset logscale xy; set format x '10^{%T}'; unset mxtics\n"
          "set xlabel 'largest relative error of (ω, n)' offset 0,0.3\nset label 1 ",
          f);
    iso_gnuplot_text(f, w->title ? w->title : "", 95);
    fputs(" at screen 0.5,0.96 center noenhanced font ',12'\nset tmargin at screen 0.88; set bmargin at screen ", f);
    iso_gnuplot_number(f, (KEY + 50.0) / HEIGHT);
    fputc('\n', f);
    put_range(f, "x", l->error[1], l->error[0]);
    put_range(f, "y", l->seconds[0], l->seconds[1]);
    if (!(w->uncertainty > l->error[0])) return;
    fputs("set object 1 rectangle from first ", f);
    iso_gnuplot_number(f, fmin(w->uncertainty, l->error[1]));
    fputs(", graph 0 to graph 1, graph 1 behind fs solid 1 noborder fc rgb " BAND "\n", f);
}

/* Lines of one panel, the named ones last, on top. */
static void put_lines(FILE *f, const iso_plot_work *w, layout *l, int panel)
{
    const char *comma = "plot";
    for (int named = 0; named < 2; named++)
        for (int s = 0; s < w->count; s++) {
            const iso_plot_series *one = &w->series[s];
            if ((one->name != NULL) != named || !has_points(one) || strcmp(one->panel, l->panel[panel]) != 0)
                continue;
            fprintf(f, "%s $series%d with ", comma, s);
            if (named)
                fprintf(f, "linespoints ps 0.75 %s",
                        strokes[find_name(l->name, &l->names, ISO_PLOT_NAMES, one->name)]);
            else
                fputs(OTHER, f);
            comma = ",";
        }
    fprintf(f, has_closed(w) ? "%s $closed with " CLOSED "\n" : "\n", comma);
}

static void put_panel(FILE *f, const iso_plot_work *w, layout *l, int panel)
{
    const double left = 0.085, gap = 0.05, width = (0.965 - left - gap * (l->panels - 1)) / l->panels;
    const double from = left + panel * (width + gap);
    fputs("set lmargin at screen ", f);
    iso_gnuplot_number(f, from);
    fputs("; set rmargin at screen ", f);
    iso_gnuplot_number(f, from + width);
    fprintf(f, "\nset ylabel '%s'; set format y '%s'\nset title ", panel == 0 ? "processor time in seconds" : "",
            panel == 0 ? "10^{%T}" : "");
    iso_gnuplot_text(f, l->panel[panel], 60);
    fputs(" noenhanced offset 0,-0.6\n", f);
    put_lines(f, w, l, panel);
    fputs("unset label\n", f);
}

/* The key below the panels, in a plot of its own. */
static void put_key(FILE *f, const iso_plot_work *w, const layout *l)
{
    const int entries = l->names + l->others + has_closed(w) + (w->uncertainty > 0);
    fputs("unset border; unset tics; unset title; unset object; unset logscale; unset xlabel; unset ylabel\n"
          "set xrange [0:1]; set yrange [0:1]; set lmargin at screen 0; set rmargin at screen 1\n"
          "set bmargin at screen 0; set tmargin at screen 1\nset key at screen 0.5,",
          f);
    iso_gnuplot_number(f, (double)KEY / HEIGHT);
    fprintf(
        f,
        " center top Left reverse vertical maxrows %d samplen 3.5 spacing 1.05 width -1 noenhanced font ',9'\nplot",
        (entries + KEY_COLUMNS - 1) / KEY_COLUMNS);
    for (int n = 0; n < l->names; n++) {
        fprintf(f, " NaN with linespoints ps 0.75 %s title ", strokes[n]);
        iso_gnuplot_text(f, l->name[n], 24);
        fputc(',', f);
    }
    if (l->others) fputs(" NaN with " OTHER " title 'other methods',", f);
    if (has_closed(w)) fputs(" NaN with " CLOSED " title 'closed solution',", f);
    fputs(w->uncertainty > 0 ? " NaN with boxes fs solid 1 noborder lc rgb " BAND " title 'below what is known'\n"
                             : " NaN notitle\n",
          f);
}

iso_status iso_plot_cost(iso_context *ctx, const char *path, const iso_plot_work *work)
{
    layout l;
    iso_gnuplot *g;
    if (!lay_out(work, &l))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "there are no measurements to draw, or too many");
    iso_status status = iso_gnuplot_open(ctx, path, WIDTH, HEIGHT, &g);
    if (status != ISO_OK) return status;
    FILE *f = iso_gnuplot_script(g);
    put_data(f, work);
    fputs("set multiplot\n", f);
    put_axes(f, work, &l);
    for (int panel = 0; panel < l.panels; panel++) put_panel(f, work, &l, panel);
    put_key(f, work, &l);
    fputs("unset multiplot\nunset output\n", f);
    return iso_gnuplot_close(ctx, g, true);
}

/* plot_map.c - pictures of frequencies: the map of the kinds of motion, and the lines of a signal. */
#include <math.h>
#include <string.h>

#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

enum { WIDTH = 900, HEIGHT = 560, LINES_HEIGHT = 420, LABELLED = 3 };

/* Pale fills that differ in lightness, and lines that differ in their dashes. */
static const char *const fills[ISO_PLOT_PARTS] = {"'#A9CDE2'", "'#F7E3B0'", "'#D9A9C6'", "'#8FCBB4'"};
static const char *const strokes[ISO_PLOT_LINES] = {
    "dt 1 lw 1.8 lc rgb " ISO_PLOT_BLUE, "dt (8,4) lw 2.2 lc rgb 'black'", "dt 1 lw 1.8 lc rgb " ISO_PLOT_VERMILLION,
    "dt (2,3) lw 2.2 lc rgb '#404040'"};
#define ORBIT "pt 7 ps 1.2 lc rgb 'black'"

/* --- the map ---------------------------------------------------------------------------------------------------- */

/* The columns of the bounds of shape i: two of a part, one of a line; the lines come after the parts. */
static int first_of(const iso_plot_map *map, int i)
{
    return i < map->parts ? 1 + 2 * i : 1 + map->parts + i;
}

/* Block i: h and the bounds of shape i, divided by h for the right picture. Says whether there is any. */
static bool put_block(FILE *f, const iso_plot_map *map, int i, bool over_h)
{
    const int first = first_of(map, i), last = first + (i < map->parts);
    bool any = false;
    fprintf(f, "$shape%d << EOD\n", i);
    for (size_t r = 0; r < iso_record_rows(map->bounds); r++) {
        const double *row = iso_record_const_row(map->bounds, r), by = over_h ? row[0] : 1;
        if (!isfinite(row[first]) || !isfinite(row[last])) continue;
        any = true;
        fprintf(f, "%.17g %.17g %.17g\n", row[0], row[first] / by, row[last] / by);
    }
    fputs("EOD\n", f);
    return any;
}

/* Largest and least F/h, with room. */
static void find_range(const iso_plot_map *map, double range[2])
{
    double low = INFINITY, high = -INFINITY;
    const size_t rows = iso_record_rows(map->bounds);
    for (size_t i = rows / 4; i < rows; i++) /* near h = 0, off H = 0, it grows without bound */
        for (int c = 1; c <= 2 * map->parts; c++) {
            const double *row = iso_record_const_row(map->bounds, i), x = row[c] / row[0];
            if (!isfinite(x)) continue;
            low = fmin(low, x);
            high = fmax(high, x);
        }
    const double room = high > low ? 0.06 * (high - low) : 0.1 * fabs(high);
    range[0] = low - room;
    range[1] = high + room;
}

/* The name of a part, up to its colon, where the part is thickest, if it is thicker than `room`. */
static void put_label(FILE *f, const iso_plot_map *map, int part, double room)
{
    const size_t rows = iso_record_rows(map->bounds);
    const double *best = iso_record_const_row(map->bounds, rows * 2 / 5);
    char name[64];
    const int low = 1 + 2 * part, high = low + 1;
    double thickest = isfinite(best[low]) ? 1.001 * (best[high] - best[low]) / best[0] : 0;
    for (size_t i = rows / 4; i < rows * 3 / 4; i++) {
        const double *row = iso_record_const_row(map->bounds, i), here = (row[high] - row[low]) / row[0];
        if (here > thickest) thickest = here, best = row;
    }
    if (!(thickest > room)) return;
    snprintf(name, sizeof name, "%.*s", (int)strcspn(map->part[part], ":"), map->part[part]);
    fprintf(f, "set label %s at %.17g,%.17g center front noenhanced\n", QUOTED(name, 60), best[0],
            (best[low] + best[high]) / 2 / best[0]);
}

static void put_panel(FILE *f, const iso_plot_map *map, bool over_h, bool key)
{
    bool any[ISO_PLOT_PARTS + ISO_PLOT_LINES];
    const char *const title = key ? "title" : "notitle", *before = "plot";
    for (int i = 0; i < map->parts + map->lines; i++) any[i] = put_block(f, map, i, over_h);
    fprintf(f, "$orbit << EOD\n%.17g %.17g\nEOD\n", map->at[0], over_h ? map->at[1] / map->at[0] : map->at[1]);
    for (int i = 0; i < map->parts + map->lines; i++) {
        const int line = i - map->parts;
        if (!any[i]) continue;
        fprintf(f,
                line < 0 ? "%s $shape%d u 1:2:3 with filledcurves fs solid 1 noborder lc rgb %s %s "
                         : "%s $shape%d with lines %s %s ",
                before, i, line < 0 ? fills[i] : strokes[line], title);
        before = ",";
        if (key) fputs(QUOTED(line < 0 ? map->part[i] : map->line[line], 60), f);
    }
    fprintf(f, "%s $orbit with points " ORBIT " %s\n", before, key ? "title 'this orbit'" : "notitle");
}

iso_status iso_plot_momentum(iso_context *ctx, const char *path, const iso_plot_map *map)
{
    const iso_record *r = map->bounds;
    const size_t columns = 1 + 2 * (size_t)map->parts + (size_t)map->lines;
    double range[2];
    if (!r || iso_record_rows(r) == 0 || iso_record_columns(r) != columns || map->parts > ISO_PLOT_PARTS ||
        map->lines > ISO_PLOT_LINES || !(map->at[0] > 0) || !isfinite(map->at[1]))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a map needs bounds, h > 0 and a finite F");
    FILE *f = iso_gnuplot_open(ctx, path, WIDTH, HEIGHT);
    fprintf(f,
            "set multiplot\n" ISO_PLOT_AXES "set tmargin at screen 0.9; set bmargin at screen 0.36\n"
            "set label 1 %s at screen 0.5,0.96 center noenhanced font ',12'\n"
            "set xlabel 'energy h'; set xrange [0:%.17g]\nset key off; set lmargin at screen 0.1; set rmargin at "
            "screen 0.48; set ylabel '%s'\nset xtics autofreq\n",
            QUOTED(map->title, 95), 2 * map->at[0], map->F);
    put_panel(f, map, false, false);
    fprintf(f,
            "unset label; set lmargin at screen 0.6; set rmargin at screen 0.98; set ylabel '%s / h'\n"
            "set key at screen 0.1,0.24 left top Left reverse vertical maxrows 5 samplen 3 spacing 1.2 noenhanced\n",
            map->F);
    find_range(map, range);
    fprintf(f, "set yrange [%.17g:%.17g]\n", range[0], range[1]);
    for (int i = 0; i < map->parts; i++) put_label(f, map, i, 0.12 * (range[1] - range[0]));
    put_panel(f, map, true, true);
    return iso_gnuplot_close(ctx, true);
}

/* --- lines ------------------------------------------------------------------------------------------------------ */

/* The combinations (m, n) at the strongest lines of each signal, which come first. */
static void put_names(FILE *f, const iso_record *r)
{
    int put[2] = {0};
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double *row = iso_record_const_row(r, i);
        if (isnan(row[3]) || put[(int)row[2] & 1]++ >= LABELLED) continue;
        fprintf(f, "set label '%d,%d' at %.17g,%.17g left rotate by 60 offset 0,0.5 font ',8'\n", (int)row[3],
                (int)row[4], row[0], row[1]);
    }
}

iso_status iso_plot_lines(iso_context *ctx, const char *path, const char *title, int axis, const iso_record *r)
{
    static const char *const stems[2] = {"lw 2 lc rgb " ISO_PLOT_BLUE, "dt (4,2) lw 2 lc rgb " ISO_PLOT_VERMILLION};
    static const char *const heads[2] = {"pt 7 ps 0.6 lc rgb " ISO_PLOT_BLUE,
                                         "pt 6 ps 0.8 lc rgb " ISO_PLOT_VERMILLION};
    char name[2][32];
    double least = 1;
    if (!r || iso_record_rows(r) == 0 || iso_record_columns(r) != 5 || axis < 0 || axis > 2)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "",
                                "a picture of lines needs a record with five columns and at least one row");
    FILE *f = iso_gnuplot_open(ctx, path, WIDTH, LINES_HEIGHT);
    fprintf(f,
            ISO_PLOT_AXES
            "set title %s noenhanced font ',12'\nset logscale y; set format y '10^{%%T}'; set key outside bottom "
            "center horizontal\nset xlabel 'frequency in t; m, n: m times frequency 1 and n times frequency 2'; "
            "set ylabel 'amplitude'\n",
            QUOTED(title, 95));
    snprintf(name[0], sizeof name[0], "n_%d + i n_%d", (axis + 1) % 3 + 1, (axis + 2) % 3 + 1);
    snprintf(name[1], sizeof name[1], "n_%d", axis + 1);
    bool any[2] = {false};
    fputs("$lines << EOD\n", f);
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double *row = iso_record_const_row(r, i);
        if (!(row[1] > 0)) continue;
        any[(int)row[2] & 1] = true;
        least = fmin(least, row[1]);
        fprintf(f, "%.17g %.17g %.0f\n", row[0], row[1], row[2]);
    }
    fputs("EOD\n", f);
    put_names(f, r);
    fprintf(f, "set offsets graph 0.04, graph 0.04, 0, 0\nset yrange [%.17g:4]\n", pow(10, floor(log10(least)) - 1));
    for (int s = 0; s < 2; s++)
        if (any[s])
            fprintf(f,
                    "%s $lines using 1:($3 == %d ? $2 : NaN) with impulses %s title '%s', "
                    "$lines using 1:($3 == %d ? $2 : NaN) with points %s notitle",
                    s == 1 && any[0] ? "," : "plot", s, stems[s], name[s], s, heads[s]);
    return iso_gnuplot_close(ctx, any[0] || any[1]);
}

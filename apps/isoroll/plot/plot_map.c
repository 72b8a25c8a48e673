/* plot_map.c - pictures of frequencies: the map of the kinds of motion, and the lines of a signal. */
#include <math.h>
#include <string.h>

#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

enum { WIDTH = 900, HEIGHT = 560, LINES_HEIGHT = 420, LABELLED = 3 };

/* Pale fills that differ in lightness, and lines that differ in their dashes. */
static const char *const fills[] = {ISO_PLOT_FAR_BLUE, ISO_PLOT_PALE_YELLOW, ISO_PLOT_PALE_PURPLE,
                                    ISO_PLOT_PALE_GREEN};
static const char *const strokes[] = {"dt 1 lw 1.8 lc rgb " ISO_PLOT_BLUE, "dt (8,4) lw 2.2 lc rgb 'black'",
                                      "dt (12,4) lw 1.8 lc rgb " ISO_PLOT_VERMILLION,
                                      "dt (2,3) lw 2.2 lc rgb " ISO_PLOT_INK};
#define ORBIT "pt 7 ps 1.2 lc rgb 'black'"

/* --- the map ---------------------------------------------------------------------------------------------------- */

/* The bounds have h, low and high of each part, and F of each line. */
enum { PARTS = ISO_MOMENTUM_PARTS, SHAPES = PARTS + ISO_MOMENTUM_LINES };

static int first_of(int shape)
{
    return shape < PARTS ? 1 + 2 * shape : 1 + PARTS + shape;
}

/* Block i: h and the bounds of a part or a line, divided by h for the right picture. Says whether there is any. */
static bool put_block(FILE *f, const iso_record *bounds, int i, bool over_h)
{
    const int first = first_of(i), last = first + (i < PARTS);
    bool any = false;
    fprintf(f, "$shape%d << EOD\n", i);
    for (size_t r = 0; r < iso_record_rows(bounds); r++) {
        const double *row = iso_record_const_row(bounds, r), by = over_h ? row[0] : 1;
        if (!isfinite(row[first]) || !isfinite(row[last])) continue;
        any = true;
        fprintf(f, "%.17g %.17g %.17g\n", row[0], row[first] / by, row[last] / by);
    }
    fputs("EOD\n", f);
    return any;
}

/* Largest and least F/h, with room. */
static void find_range(const iso_record *bounds, double range[2])
{
    double low = INFINITY, high = -INFINITY;
    const size_t rows = iso_record_rows(bounds);
    for (size_t i = rows / 4; i < rows; i++) /* near h = 0, off H = 0, it grows without bound */
        for (int c = 1; c <= 2 * PARTS; c++) {
            const double *row = iso_record_const_row(bounds, i), x = row[c] / row[0];
            if (!isfinite(x)) continue;
            low = fmin(low, x);
            high = fmax(high, x);
        }
    const double room = high > low ? 0.06 * (high - low) : 0.1 * fabs(high);
    range[0] = low - room;
    range[1] = high + room;
}

/* The name of a part where the part is thickest, if it is thicker than `room`. */
static void put_label(FILE *f, const iso_momentum *m, const iso_record *bounds, int part, double room)
{
    const size_t rows = iso_record_rows(bounds);
    const double *best = iso_record_const_row(bounds, rows * 2 / 5);
    char name[ISO_MOMENTUM_WORDS];
    const int low = first_of(part), high = low + 1;
    double thickest = isfinite(best[low]) ? 1.001 * (best[high] - best[low]) / best[0] : 0;
    for (size_t i = rows / 4; i < rows * 3 / 4; i++) {
        const double *row = iso_record_const_row(bounds, i), here = (row[high] - row[low]) / row[0];
        if (here > thickest) thickest = here, best = row;
    }
    if (!(thickest > room)) return;
    iso_momentum_name_part(m, (iso_momentum_part)part, name);
    fprintf(f, "set label %s at %.17g,%.17g center front noenhanced\n", QUOTED(name, 60), best[0],
            (best[low] + best[high]) / 2 / best[0]);
}

/* at: h and F of the orbit. Only the right picture, F/h, has a key. */
static void put_panel(FILE *f, const iso_momentum *m, const iso_record *bounds, const double at[2], bool over_h)
{
    bool any[SHAPES];
    char name[ISO_MOMENTUM_WORDS];
    const char *const title = over_h ? "title" : "notitle", *before = "plot";
    for (int i = 0; i < SHAPES; i++) any[i] = put_block(f, bounds, i, over_h);
    fprintf(f, "$orbit << EOD\n%.17g %.17g\nEOD\n", at[0], over_h ? at[1] / at[0] : at[1]);
    for (int i = 0; i < SHAPES; i++) {
        const int line = i - PARTS;
        if (!any[i]) continue;
        fprintf(f,
                line < 0 ? "%s $shape%d u 1:2:3 with filledcurves fs solid 1 noborder lc rgb %s %s "
                         : "%s $shape%d with lines %s %s ",
                before, i, line < 0 ? fills[i] : strokes[line], title);
        before = ",";
        if (line < 0)
            iso_momentum_name_part(m, (iso_momentum_part)i, name);
        else
            iso_momentum_name_line(m, line, name);
        if (over_h) fputs(QUOTED(name, 60), f);
    }
    fprintf(f, "%s $orbit with points " ORBIT " %s\n", before, over_h ? "title 'this orbit'" : "notitle");
}

iso_status iso_plot_momentum(iso_context *ctx, const iso_plot_page *page, const char *title, const iso_momentum *m,
                             const double at[2])
{
    const char *F = m->k == 1 ? "F_{plane}" : "F_{shell}";
    iso_record *bounds;
    double range[2];
    ISO_TRY(iso_momentum_bounds(ctx, m, at[0], &bounds));
    FILE *f = iso_gnuplot_open(ctx, page, WIDTH, HEIGHT);
    fprintf(f,
            "set multiplot\n" ISO_PLOT_AXES "set tmargin at screen 0.9; set bmargin at screen 0.36\n"
            "set label 1 %s at screen 0.5,0.96 center noenhanced font ',12'\n"
            "set xlabel 'energy h'; set xrange [0:%.17g]\nset key off; set lmargin at screen 0.1; set rmargin at "
            "screen 0.48; set ylabel '%s'\nset xtics autofreq\n",
            QUOTED(iso_plot_titled(page, title), 95), 2 * at[0], F);
    put_panel(f, m, bounds, at, false);
    fprintf(f,
            "unset label; set lmargin at screen 0.6; set rmargin at screen 0.98; set ylabel '%s\u2060 / h'\n"
            "set key at screen 0.1,0.24 left top Left reverse vertical maxrows 5 samplen 3 spacing 1.2 noenhanced\n",
            F);
    find_range(bounds, range);
    fprintf(f, "set yrange [%.17g:%.17g]\n", range[0], range[1]);
    for (int i = 0; i < PARTS; i++) put_label(f, m, bounds, i, 0.12 * (range[1] - range[0]));
    put_panel(f, m, bounds, at, true);
    iso_record_free(bounds);
    return iso_gnuplot_close(ctx, true);
}

/* --- lines ------------------------------------------------------------------------------------------------------ */

/* NULL: there is none. */
static const char *warning_of(const iso_estimate *e)
{
    if (e->verdict == ISO_CHAOTIC)
        return "this orbit is chaotic: it has no fixed frequencies, and these lines are of this stretch only";
    if (e->verdict == ISO_UNDECIDED)
        return "it is not decided whether this orbit has fixed frequencies: a longer one may tell";
    return NULL;
}

/* The frequencies at which a combination (m, n) stands, and from the least to the largest of all. */
typedef struct labels {
    double at[2 * LABELLED], span;
    int count;
} labels;

static double span_of(const iso_estimate *e)
{
    double range[2] = {INFINITY, -INFINITY};
    for (int s = 0; s < 2; s++)
        for (int i = 0; i < e->lines[s]; i++) {
            range[0] = fmin(range[0], e->line[s][i].line.frequency);
            range[1] = fmax(range[1], e->line[s][i].line.frequency);
        }
    return range[1] - range[0];
}

/* Whether there is room for a combination; then it stands there. */
static bool take_room(labels *l, double frequency)
{
    for (int i = 0; i < l->count; i++)
        if (fabs(l->at[i] - frequency) < 0.02 * l->span) return false;
    l->at[l->count++] = frequency;
    return true;
}

/* The lines of a signal as a block; then their combinations (m, n) at the strongest of them, which come first, if
 * the orbit is regular. Gives the least amplitude; infinite: there is no line. */
static double put_signal(FILE *f, const iso_estimate *e, int signal, labels *taken)
{
    double least = INFINITY;
    fprintf(f, "$signal%d << EOD\n", signal);
    for (int i = 0; i < e->lines[signal]; i++) {
        const iso_spectral_line *l = &e->line[signal][i].line;
        if (!(l->amplitude > 0)) continue;
        least = fmin(least, l->amplitude);
        fprintf(f, "%.17g %.17g\n", l->frequency, l->amplitude);
    }
    fputs("EOD\n", f);
    for (int i = 0, put = 0; i < e->lines[signal] && put < LABELLED && !warning_of(e); i++) {
        const iso_identified_line *l = &e->line[signal][i];
        if (!l->known) continue;
        put++;
        if (!take_room(taken, l->line.frequency)) continue;
        fprintf(f, "set label '%d,%d' at %.17g,%.17g left rotate by 90 offset 0,0.5 font ',8'\n", l->m, l->n,
                l->line.frequency, l->line.amplitude);
    }
    return least;
}

iso_status iso_plot_lines(iso_context *ctx, const iso_plot_page *page, const char *title, const iso_estimate *e)
{
    const int axis = e->axis, j = (axis + 1) % 3 + 1, l = (axis + 2) % 3 + 1;
    double least[2];
    labels taken = {.span = span_of(e)};
    const char *warning = warning_of(e);
    int width = WIDTH, height = LINES_HEIGHT;
    iso_gnuplot_fit(page, false, &width, &height);
    FILE *f = iso_gnuplot_open(ctx, page, width, height);
    fprintf(
        f,
        ISO_PLOT_AXES "set label 1 %s at screen 0.5,0.95 center noenhanced font ',12'\n"
                      "set lmargin at screen %.17g; set rmargin at screen 0.97; set bmargin at screen %.17g\n"
                      "set tmargin at screen %.17g; set logscale y; set format y '10^{%%T}'; set key at graph 1,1.02 "
                      "right bottom horizontal\nset xlabel '%s'; set ylabel 'amplitude'\n",
        QUOTED(iso_plot_titled(page, title), 95), 80.0 / width, 63.0 / height, 1 - (warning ? 92.0 : 67.0) / height,
        warning ? "frequency in t" : "frequency in t; m,n: m times frequency 1 and n times frequency 2");
    if (warning) fprintf(f, "set label 2 '%s' at screen 0.5,0.885 center tc rgb " ISO_PLOT_VERMILLION "\n", warning);
    for (int s = 0; s < 2; s++) least[s] = put_signal(f, e, s, &taken);
    fprintf(f, "set offsets graph 0.04, graph 0.04, 0, 0\nset yrange [%.17g:4]\n",
            pow(10, floor(log10(fmin(1, fmin(least[0], least[1])))) - 1));
    const bool any[2] = {isfinite(least[0]), isfinite(least[1])};
    if (any[0])
        fprintf(f,
                "plot $signal0 with impulses lw 2 lc rgb " ISO_PLOT_BLUE " title 'n_%d\u2060 + i n_%d', "
                "$signal0 with points pt 7 ps 0.6 lc rgb " ISO_PLOT_BLUE " notitle",
                j, l);
    if (any[1])
        fprintf(f,
                "%s$signal1 with impulses dt (4,2) lw 2 lc rgb " ISO_PLOT_VERMILLION " title 'n_%d', "
                "$signal1 with points pt 6 ps 0.8 lc rgb " ISO_PLOT_VERMILLION " notitle",
                any[0] ? ", " : "plot ", axis + 1);
    if (any[0] || any[1]) return iso_gnuplot_close(ctx, true);
    iso_gnuplot_close(ctx, false);
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a picture of lines needs at least one line");
}

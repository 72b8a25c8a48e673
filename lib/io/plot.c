/* The picture of a comparison: two spheres, and a chart of differences below. */
#include "io/plot.h"

#include <math.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "io/gnuplot_impl.h"
#include "io/plot_impl.h"

enum {
    WIDTH = 900,
    HEIGHT = 800,
    SLOTS = 450, /* of the time axis: in each stands the largest difference, so thinning hides none */
    MOST_DIFFERENCES = 16
};
#define FLOOR 1e-17 /* stands for 0 on the logarithmic axis; below any difference of doubles of order one */

void iso_plot_pair(FILE *script, double x, double y)
{
    iso_gnuplot_number(script, x);
    fputc(' ', script);
    iso_gnuplot_number(script, y);
    fputc('\n', script);
}

/* --- differences ------------------------------------------------------------------------------------------------ */

/* How a column of differences looks; every other name is drawn as the last. In grey they differ by their dashes: the
 * ball's are solid, the point's dashed, clocks dotted. */
typedef struct look {
    const char *name, *symbol, *line;
} look;

/* clang-format off */
static const look looks[] = {
    {"omega", "ω", "dt 1 lw 1.8 lc rgb " ISO_PLOT_BLUE},
    {"n",     "n", "dt 1 lw 1.8 lc rgb " ISO_PLOT_VERMILLION},
    {"M",     "M", "dt (8,4) lw 1.8 lc rgb '#56B4E9'"},
    {"gamma", "γ", "dt (8,4) lw 1.8 lc rgb '#E69F00'"},
    {"t",     "t", "dt (2,3) lw 1.8 lc rgb '#009E73'"},
    {"tau",   "τ", "dt (2,3) lw 1.8 lc rgb '#009E73'"},
    {"s",     "s", "dt (8,3,2,3) lw 1.8 lc rgb '#CC79A7'"},
    {"ball - exact",  "ball−exact",  "dt 1 lw 1.2 lc rgb 'black'"},
    {"point - exact", "point−exact", "dt (8,4) lw 1.2 lc rgb 'black'"},
    {NULL,    NULL, "dt 4 lw 1.8 lc rgb 'black'"},
};
/* clang-format on */

static const look *find_look(const char *name)
{
    const look *l = looks;
    while (l->name && strcmp(l->name, name) != 0) l++;
    return l;
}

static const char *symbol(const char *name)
{
    const look *l = find_look(name);
    return l->name ? l->symbol : name;
}

/* One column over the first: in each slot of rows the largest, at its own time. Answers the largest of all. */
static double put_differences(FILE *f, const iso_record *r, int column, bool *has_floor)
{
    const size_t rows = iso_record_rows(r), slots = rows < SLOTS ? rows : SLOTS;
    double largest = 0;
    fprintf(f, "$difference%d << EOD\n", column);
    for (size_t slot = 0; slot < slots; slot++) {
        const double *worst = iso_record_const_row(r, slot * rows / slots);
        for (size_t i = slot * rows / slots; i < (slot + 1) * rows / slots; i++)
            if (iso_record_const_row(r, i)[column] > worst[column]) worst = iso_record_const_row(r, i);
        iso_plot_pair(f, worst[0], fmax(worst[column], FLOOR));
        *has_floor = *has_floor || worst[column] <= FLOOR;
        largest = fmax(largest, worst[column]);
    }
    fputs("EOD\n", f);
    return largest;
}

#define LEVEL "dt (3,3) lw 1.2 lc rgb '#707070'"

/* A line across. */
static void put_level(FILE *f, int tag, double level)
{
    fprintf(f, "set arrow %d from graph 0, first ", tag);
    iso_gnuplot_number(f, level);
    fputs(" to graph 1, first ", f);
    iso_gnuplot_number(f, level);
    fputs(" nohead back " LEVEL "\n", f);
}

static void put_floor(FILE *f)
{
    put_level(f, 1, FLOOR);
    fputs("set label 1 '0, or less than 10^{-17}' at graph 0.99, first ", f);
    iso_gnuplot_number(f, FLOOR);
    fputs(" offset 0,0.6 right front tc rgb '#404040'\n", f);
}

/* Axes of a chart below the spheres. A single time gets room on both sides. */
static void put_axes(FILE *f, const iso_record *r, double top, const iso_plot_chart *chart)
{
    const double a = iso_record_const_row(r, 0)[0], b = iso_record_const_row(r, iso_record_rows(r) - 1)[0];
    const double room = a == b ? fmax(fabs(a), 1) / 2 : 0;
    fputs(
        "unset label; unset arrow; unset object; set size noratio; set border 3 lc rgb '#606060'; unset title\n"
        "set tmargin at screen 0.345; set bmargin at screen 0.085\n"
        "set logscale y; set format y '10^{%T}'; set xtics nomirror out scale 0.6; set ytics nomirror out scale 0.6\n"
        "set grid ytics back lt 1 lw 0.8 lc rgb '#DDE1E5'\n"
        "set key left top Left reverse vertical maxrows 16 samplen 3 spacing 1.2 noenhanced title 'largest' left "
        "enhanced\n",
        f);
    fprintf(f, "set lmargin at screen 0.%03d; set rmargin at screen 0.%03d; set key at screen 0.%03d,0.36\n",
            chart->left, chart->right, chart->right + 15);
    fprintf(f, "set ylabel '%s' offset 0.5,0\nset xrange [", chart->ylabel);
    iso_gnuplot_number(f, fmin(a, b) - room);
    fputc(':', f);
    iso_gnuplot_number(f, fmax(a, b) + room);
    fputs("]\nset yrange [3e-18:", f);
    iso_gnuplot_number(f, pow(10, ceil(log10(fmax(top, 1e-15)) + 0.3)));
    fputs("]\nset xlabel ", f);
    iso_gnuplot_text(f, symbol(iso_record_name(r, 0)), 31);
    fprintf(f, ".' %s' offset 0,0.3\n", chart->units);
}

/* In the key: the column's symbol and its largest number. */
static void put_name(FILE *f, const char *name, double largest)
{
    char words[64], number[16];
    snprintf(number, sizeof number, "%.0e", largest); /* no decimal mark, which is the locale's */
    snprintf(words, sizeof words, "%s  %s", symbol(name), largest > 0 ? number : "0");
    iso_gnuplot_text(f, words, 60);
}

/* A line for names that have no look of their own. */
static const char *line_of(const char *name, int c)
{
    static const char *const lines[] = {
        "dt 1 lw 1.5 lc rgb " ISO_PLOT_BLUE, "dt 1 lw 1.5 lc rgb " ISO_PLOT_VERMILLION,
        "dt 1 lw 1.5 lc rgb '#009E73'",      "dt 1 lw 1.5 lc rgb '#CC79A7'",
        "dt (8,4) lw 1.5 lc rgb '#56B4E9'",  "dt (8,4) lw 1.5 lc rgb '#E69F00'",
        "dt (2,3) lw 1.5 lc rgb 'black'",
    };
    const look *l = find_look(name);
    return l->name ? l->line : lines[c % (int)(sizeof lines / sizeof *lines)];
}

void iso_plot_differences(FILE *f, const iso_record *r, double tolerance, const iso_plot_chart *chart)
{
    const int columns = (int)iso_record_columns(r);
    double top = tolerance, largest[MOST_DIFFERENCES + 1];
    bool has_floor = false;
    for (int c = 1; c < columns; c++) {
        largest[c] = put_differences(f, r, c, &has_floor);
        top = fmax(top, largest[c]);
    }
    put_axes(f, r, top, chart);
    if (has_floor) put_floor(f);
    if (tolerance > 0) put_level(f, 2, tolerance);
    for (int c = 1; c < columns; c++) {
        const char *name = iso_record_name(r, (size_t)c), *line = line_of(name, c - 1);
        fprintf(f, "%s $difference%d with ", c == 1 ? "plot" : ",", c);
        fprintf(f, iso_record_rows(r) > 1 ? "lines %s title " : "points pt 7 %s title ",
                iso_record_rows(r) > 1 ? line : strstr(line, "lc"));
        put_name(f, name, largest[c]);
    }
    if (tolerance > 0) {
        fputs(", NaN w l " LEVEL " title ", f);
        put_name(f, "tolerance", tolerance);
    }
    fputc('\n', f);
}

/* --- the whole -------------------------------------------------------------------------------------------------- */

/* The title, and between the spheres and the chart what their signs mean: a plot of its own, as wide as the page. */
static void put_heading(FILE *f, const char *title)
{
    fputs("unset border; unset tics; set xrange [0:1]; set yrange [0:1]\n"
          "set lmargin at screen 0; set rmargin at screen 1; set tmargin at screen 1; set bmargin at screen 0\n"
          "set key at screen 0.5,0.408 center center horizontal maxrows 1 samplen 2 Left reverse\n"
          "set label 1 ",
          f);
    iso_gnuplot_text(f, title ? title : "", 95);
    fputs(" at screen 0.5,0.972 center noenhanced font ',12'\n"
          "plot NaN w l lw 1.8 lc rgb " ISO_PLOT_BLUE " title 'backend ball',"
          " NaN w p pt 6 ps 0.85 lw 1.5 lc rgb " ISO_PLOT_VERMILLION " title 'backend point',"
          " NaN w p " ISO_PLOT_START " lc rgb 'black' title 'start',"
          " NaN w p " ISO_PLOT_END " lc rgb 'black' title 'end',"
          " NaN w l lw 1.8 lc rgb " ISO_PLOT_FAR_BLUE " title 'far side'\n",
          f);
}

static iso_status check_finite(iso_context *ctx, const iso_record *r, const int column[], int count)
{
    for (size_t i = 0; i < iso_record_rows(r); i++)
        for (int c = 0; c < count; c++)
            if (!isfinite(iso_record_const_row(r, i)[column[c]]))
                return iso_context_fail(ctx, ISO_NUMERICAL, iso_record_name(r, (size_t)column[c]),
                                        "a picture: %s is not finite in row %zu",
                                        iso_record_name(r, (size_t)column[c]), i + 1);
    return ISO_OK;
}

/* Where a backend's record has n and gamma. */
static iso_status find_vectors(iso_context *ctx, const iso_record *r, int *n, int *gamma)
{
    static const char *const names[] = {"n1", "n2", "n3", "gamma1", "gamma2", "gamma3"};
    const char *missing;
    int column[6];
    if (!r || iso_record_rows(r) == 0) return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a picture of no rows");
    if (!iso_record_find_all(r, 6, names, column, &missing))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, missing, "a picture: the record has no column %s", missing);
    for (int i = 0; i < 6; i++)
        if (column[i] != column[i / 3 * 3] + i % 3)
            return iso_context_fail(ctx, ISO_BAD_ARGUMENT, names[i], "a picture: column %s is out of order",
                                    names[i]);
    *n = column[0];
    *gamma = column[3];
    return check_finite(ctx, r, column, 6);
}

static iso_status check_differences(iso_context *ctx, const iso_plot *plot)
{
    const iso_record *r = plot->difference;
    int column[MOST_DIFFERENCES + 1];
    for (int c = 0; c <= MOST_DIFFERENCES; c++) column[c] = c;
    if (!r || iso_record_rows(r) == 0 || iso_record_columns(r) < 2 || iso_record_columns(r) > MOST_DIFFERENCES + 1)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a picture of no differences, or of more than %d",
                                MOST_DIFFERENCES);
    if (!(plot->tolerance >= 0 && plot->tolerance <= 1))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "tolerance", "a picture: tolerance not in [0, 1]");
    return check_finite(ctx, r, column, (int)iso_record_columns(r));
}

iso_status iso_plot_check_format(iso_context *ctx, const char *path)
{
    return iso_gnuplot_check_format(ctx, path);
}

iso_status iso_plot_comparison(iso_context *ctx, const char *path, const iso_plot *plot)
{
    ISO_DEFAULT_ARITHMETIC;
    int n[2], gamma[2];
    iso_gnuplot *g;
    iso_status status = find_vectors(ctx, plot->ball, &n[0], &gamma[0]);
    if (status == ISO_OK) status = find_vectors(ctx, plot->point, &n[1], &gamma[1]);
    if (status == ISO_OK) status = check_differences(ctx, plot);
    if (status == ISO_OK) status = iso_gnuplot_open(ctx, path, WIDTH, HEIGHT, &g);
    if (status != ISO_OK) return status;
    FILE *f = iso_gnuplot_script(g);
    const bool fine = iso_plot_is_long(plot->ball, n[0]) || iso_plot_is_long(plot->ball, gamma[0]);
    fputs("set multiplot\n", f);
    put_heading(f, plot->title);
    fputs("set lmargin at screen 0.01; set rmargin at screen 0.49\n"
          "set title 'ball: the normal n at the contact'\n",
          f);
    iso_plot_sphere(f, plot->ball, n[0], plot->point, n[1], fine);
    fputs("set lmargin at screen 0.51; set rmargin at screen 0.99\n"
          "set title 'point: its place γ'\n",
          f);
    iso_plot_sphere(f, plot->ball, gamma[0], plot->point, gamma[1], fine);
    static const iso_plot_chart chart = {95, 780, "relative difference", "in the units of the scene"};
    iso_plot_differences(f, plot->difference, plot->tolerance, &chart);
    fputs("unset multiplot\nunset output\n", f);
    return iso_gnuplot_close(ctx, g, true);
}

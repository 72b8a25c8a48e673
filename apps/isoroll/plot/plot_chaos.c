/* plot_chaos.c - pictures of chaos: the indicators of an orbit against the turns, and the section coloured by
 * exponent. */
#include <math.h>

#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

enum { WIDTH = 900, HEIGHT = 640, SECTION_HEIGHT = 520, COLUMNS = 6 };
enum { TURN, TIME, GROWTH, MEGNO, MEAN, GALI };

#define BALL "lw 1.8 lc rgb " ISO_PLOT_BLUE
#define POINT "lw 1.8 lc rgb " ISO_PLOT_VERMILLION

/* --- indicators ------------------------------------------------------------------------------------------------- */

static bool has_rows(const iso_record *r)
{
    return r && iso_record_rows(r) > 0;
}

/* A block with the columns of a model. Values on logarithmic axes are at least 1e-17. */
static void put_trace(FILE *f, const char *name, const iso_record *r)
{
    const size_t rows = has_rows(r) ? iso_record_rows(r) : 0, step = rows / ISO_PLOT_ROWS + 1;
    fprintf(f, "$%s << EOD\n", name);
    for (size_t i = 0; i < rows; i += step) {
        const double *row = iso_record_const_row(r, i);
        for (int c = 0; c < COLUMNS; c++) {
            if (isfinite(row[c]))
                fprintf(f, "%.17g", c == GALI ? fmax(row[c], 1e-17) : row[c]);
            else
                fputc('?', f);
            fputc(' ', f);
        }
        fputc('\n', f);
    }
    fputs("EOD\n", f);
}

/* One column of both models; the other column, if there is one, as a finer, dashed line. */
static void put_lines(FILE *f, const bool there[2], int column, int other, const char *words, const char *other_words)
{
    static const char *const name[2] = {"ball", "point"}, *const line[2] = {BALL, POINT};
    const char *comma = "plot ";
    for (int m = 0; m < 2; m++) {
        if (!there[m]) continue;
        fprintf(f, "%s$%s using 1:%d with lines dt 1 %s title '%s%s'", comma, name[m], column + 1, line[m], name[m],
                words);
        comma = ", ";
        if (other >= 0)
            fprintf(f, ", $%s using 1:%d with lines dt (6,3) %s title '%s%s'", name[m], other + 1, line[m], name[m],
                    other_words);
    }
    fputc('\n', f);
}

iso_status iso_plot_indicators(iso_context *ctx, const char *path, const char *title, const iso_record *ball,
                               const iso_record *point)
{
    const bool there[2] = {has_rows(ball), has_rows(point)};
    if ((!there[0] && !there[1]) || (there[0] && iso_record_columns(ball) != COLUMNS) ||
        (there[1] && iso_record_columns(point) != COLUMNS))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "",
                                "a picture of indicators needs a record with six columns and at least one row");
    FILE *f = iso_gnuplot_open(ctx, path, WIDTH, HEIGHT);
    put_trace(f, "ball", ball);
    put_trace(f, "point", point);
    fprintf(f,
            "set datafile missing '?'\nset multiplot\n" ISO_PLOT_AXES
            "set label 1 %s at screen 0.5,0.965 center noenhanced font ',12'\n"
            "set key left top Left reverse samplen 3 spacing 1.2\n"
            "set lmargin at screen 0.085; set rmargin at screen 0.98; set tmargin at screen 0.92\n"
            "set bmargin at screen 0.575; set xlabel 'turns' offset 0,0.4; set ylabel 'ln |d|' offset 0.5,0\n",
            QUOTED(title, 95));
    put_lines(f, there, GROWTH, -1, "", "");
    fputs("unset label 1; set tmargin at screen 0.475; set bmargin at screen 0.09; set rmargin at screen 0.48\n"
          "set arrow 1 from graph 0, first 2 to graph 1, first 2 nohead back dt (3,3) lw 1.2 lc rgb '#707070'\n"
          "set ylabel 'MEGNO'\n",
          f);
    put_lines(f, there, MEGNO, MEAN, "", ", mean");
    fputs(
        "unset arrow 1; set lmargin at screen 0.585; set rmargin at screen 0.98; set logscale y; set key right top\n"
        "set format y '10^{%T}'; set ylabel 'GALI_2'; set yrange [*:2]\n",
        f);
    put_lines(f, there, GALI, -1, "", "");
    return iso_gnuplot_close(ctx, true);
}

/* --- the section ------------------------------------------------------------------------------------------------ */

typedef enum spot_kind { REGULAR, CHAOTIC, UNDECIDED } spot_kind;

/* By the model that says what the verdict says. 0: regular; NaN: undecided. */
static double exponent_of(const iso_record *r, size_t i)
{
    if (iso_plot_is(r, i, "verdict", "regular")) return 0;
    if (!iso_plot_is(r, i, "verdict", "chaotic")) return NAN;
    return iso_plot_number(r, i, iso_plot_is(r, i, "ball_verdict", "chaotic") ? "ball_per_turn" : "point_per_turn");
}

/* Writes the spots of one kind. Gives their number. */
static size_t put_spots(FILE *f, const iso_record *r, const char *name, spot_kind kind)
{
    size_t count = 0;
    fprintf(f, "$%s << EOD\n", name);
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double l = iso_plot_number(r, i, "l"), x = iso_plot_number(r, i, "x"), exponent = exponent_of(r, i);
        const spot_kind is = isnan(exponent) ? UNDECIDED : exponent > 0 ? CHAOTIC : REGULAR;
        if (is != kind || !isfinite(l) || !isfinite(x)) continue;
        fprintf(f, "%.5f %.5f %.4g\n", l, x, kind == CHAOTIC ? exponent : 0);
        count++;
    }
    fputs("EOD\n", f);
    return count;
}

static void put_chart(FILE *f, const char *title, int axis)
{
    const int b = (axis + 1) % 3 + 1, c = (axis + 2) % 3 + 1;
    fprintf(f,
            "set border 15 lw 0.8 lc rgb '#606060'; set tics out scale 0.6 nomirror\n"
            "set title %s noenhanced font ',12'\nset xrange [-pi:pi]; set yrange [-1:1]; set ytics 0.5\n"
            "set xtics ('−π' -pi, '−π/2' -pi/2, '0' 0, 'π/2' pi/2, 'π' pi)\n"
            "set xlabel 'l,  where γ_%d = cos l, γ_%d = −sin l'; set ylabel 'M_%d / |M|' offset 1,0\n"
            "set cblabel 'exponent per turn'; set cbrange [0:*]; unset grid\n"
            "set palette defined (0 '#F7E3B0', 0.5 '#E69F00', 1 '#8B1A00')\n"
            "set key outside bottom center horizontal samplen 1\n",
            QUOTED(title, 110), b, c, axis + 1);
}

iso_status iso_plot_exponents(iso_context *ctx, const char *path, const char *title, const iso_record *r)
{
    static const char *const name[] = {[REGULAR] = "regular", [CHAOTIC] = "chaotic", [UNDECIDED] = "undecided"};
    static const char *const mark[] = {[REGULAR] = ("1:2 with points pt 7 lc rgb " ISO_PLOT_FAR_BLUE),
                                       [CHAOTIC] = "1:2:3 with points pt 7 palette",
                                       [UNDECIDED] = "1:2 with points pt 2 lc rgb 'black'"};
    FILE *f = iso_gnuplot_open(ctx, path, WIDTH, SECTION_HEIGHT);
    size_t count[3], all = 0;
    for (int kind = REGULAR; kind <= UNDECIDED; kind++)
        all += count[kind] = put_spots(f, r, name[kind], (spot_kind)kind);
    if (all == 0) {
        iso_gnuplot_close(ctx, false);
        return iso_context_fail(ctx, ISO_BAD_INPUT, "", "the table has no orbit that starts on the section");
    }
    put_chart(f, title, iso_plot_axis_of(r));
    if (count[CHAOTIC] == 0) fputs("unset colorbox\n", f);
    const char *before = "plot";
    for (int kind = REGULAR; kind <= UNDECIDED; kind++) {
        if (count[kind] == 0) continue;
        fprintf(f, "%s $%s using %s ps %.17g title '%s'", before, name[kind], mark[kind],
                fmin(fmax(30 / sqrt((double)all), 0.12), 1.6), name[kind]);
        before = ",";
    }
    return iso_gnuplot_close(ctx, true);
}

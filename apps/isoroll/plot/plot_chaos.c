/* plot_chaos.c - pictures of chaos: the indicators of an orbit against the turns, and the section coloured by
 * exponent. */
#include <math.h>

#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

enum { WIDTH = 900, HEIGHT = 640, SECTION_HEIGHT = 520 };

/* --- indicators ------------------------------------------------------------------------------------------------- */

/* One column of the models that have rows; the other column, if there is one, as a dashed line. */
static void put_lines(FILE *f, const iso_record *const model[2], const char *column, const char *other)
{
    static const char *const name[] = {"ball", "point"}, *const colour[] = {ISO_PLOT_BLUE, ISO_PLOT_ORANGE};
    static const char *const dash[2][2] = {{"1", "(6,3)"}, {"1", "(2,3)"}};
    const char *before = "plot";
    for (int m = 0; m < 2; m++) {
        const size_t rows = model[m] ? iso_record_rows(model[m]) : 0, step = rows / ISO_PLOT_ROWS + 1;
        for (int dashed = 0; rows > 0 && dashed < (other ? 2 : 1); dashed++, before = ",")
            fprintf(f, "%s $%s every %zu using 1:%s with lines dt %s lw %s lc rgb %s title '%s%s'", before, name[m],
                    step, dashed ? other : column, dash[m][dashed], m ? "2.4" : "1.6", colour[m], name[m],
                    dashed ? ", mean" : "");
    }
    fputc('\n', f);
}

iso_status iso_plot_indicators(iso_context *ctx, const iso_plot_page *page, const char *title, const iso_record *ball,
                               const iso_record *point)
{
    static const char *const columns[] = {"turn", "growth", "megno", "mean", "gali2", NULL};
    const iso_record *const model[2] = {ball, point};
    if ((!ball || iso_record_rows(ball) == 0) && (!point || iso_record_rows(point) == 0))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a picture of indicators needs at least one row");
    FILE *f = iso_gnuplot_open(ctx, page, WIDTH, HEIGHT);
    iso_plot_block(f, "ball", ball, columns);
    iso_plot_block(f, "point", point, columns);
    fprintf(f,
            "set multiplot\n" ISO_PLOT_AXES "set label 1 %s at screen 0.5,0.965 center noenhanced font ',12'\n"
            "set key left top Left reverse samplen 3 spacing 1.2\n"
            "set lmargin at screen 0.085; set rmargin at screen 0.98; set tmargin at screen 0.92\n"
            "set bmargin at screen 0.575; set xlabel 'turns' offset 0,0.4; set ylabel 'ln |d|, d: a small distance' "
            "offset 0.5,0\n",
            QUOTED(iso_plot_titled(page, title), 95));
    put_lines(f, model, "2", NULL);
    fputs("unset label 1; set tmargin at screen 0.475; set bmargin at screen 0.09; set rmargin at screen 0.48\n"
          "set arrow 1 from graph 0, first 2 to graph 1, first 2 nohead back dt (3,3) lw 1.2 lc rgb " ISO_PLOT_HELP
          "\n"
          "set ylabel 'MEGNO'\n",
          f);
    put_lines(f, model, "3", "4");
    fputs("unset arrow 1; set lmargin at screen 0.585; set rmargin at screen 0.98; set logscale y\n"
          "set key right top; set format y '10^{%T}'; set ylabel 'GALI_2'; set yrange [*:2]\n",
          f);
    put_lines(f, model, "($5 < 1e-17 ? 1e-17 : $5)", NULL);
    return iso_gnuplot_close(ctx, true);
}

/* --- the section ------------------------------------------------------------------------------------------------ */

enum { REGULAR, CHAOTIC, UNDECIDED, KINDS };

/* By the model that says what the verdict says. 0: regular; NaN: undecided. */
static double exponent_of(const iso_record *r, size_t i)
{
    if (iso_plot_is(r, i, "verdict", "regular")) return 0;
    if (!iso_plot_is(r, i, "verdict", "chaotic")) return NAN;
    return iso_plot_number(r, i, iso_plot_is(r, i, "ball_verdict", "chaotic") ? "ball_per_turn" : "point_per_turn");
}

/* Writes the block $spots: a place, the exponent, and the kind. Counts the spots of each kind. */
static size_t put_spots(FILE *f, const iso_record *r, size_t count[KINDS])
{
    fputs("$spots << EOD\n", f);
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double l = iso_plot_number(r, i, "l"), x = iso_plot_number(r, i, "x"), exponent = exponent_of(r, i);
        const int kind = isnan(exponent) ? UNDECIDED : exponent > 0 ? CHAOTIC : REGULAR;
        if (!isfinite(l) || !isfinite(x)) continue;
        fprintf(f, "%.5f %.5f %.4g %d\n", l, x, kind == CHAOTIC ? exponent : 0, kind);
        count[kind]++;
    }
    fputs("EOD\n", f);
    return count[REGULAR] + count[CHAOTIC] + count[UNDECIDED];
}

iso_status iso_plot_exponents(iso_context *ctx, const iso_plot_page *page, const char *title, const iso_record *r)
{
    static const char *const name[] = {"regular", "chaotic", "undecided"};
    static const char *const mark[] = {("pt 7 lc rgb " ISO_PLOT_FAR_BLUE), "pt 7 palette", "pt 2 lc rgb 'black'"};
    const int axis = iso_plot_axis_of(r);
    size_t count[KINDS] = {0};
    const char *before = "plot";
    int width = WIDTH, height = SECTION_HEIGHT;
    iso_gnuplot_fit(page, true, &width, &height);
    FILE *f = iso_gnuplot_open(ctx, page, width, height);
    const size_t all = put_spots(f, r, count);
    fprintf(
        f,
        ISO_PLOT_FRAME ISO_PLOT_ANGLES
        "set title %s noenhanced font ',12'; set yrange [-1:1]; set ytics 0.5; set cblabel 'exponent per turn'\n"
        "set xlabel 'l,  where γ_%d\u2060 = cos l, γ_%d\u2060 = −sin l'; set ylabel 'M_%d\u2060 / |M|' offset 1,0\n"
        "set cbrange [0:*]; set palette defined (0 " ISO_PLOT_PALE_YELLOW ", 0.5 " ISO_PLOT_ORANGE
        ", 1 " ISO_PLOT_DARK_RED ")\n"
        "set key outside bottom center horizontal samplen 1; %s\n",
        TITLE(page, title, 110), (axis + 1) % 3 + 1, (axis + 2) % 3 + 1, axis + 1,
        count[CHAOTIC] ? "" : "unset colorbox");
    for (int kind = 0; kind < KINDS; kind++) {
        if (count[kind] == 0) continue;
        fprintf(f, "%s $spots using ($4 == %d ? $1 : NaN):2%s with points %s ps %.17g title '%s'", before, kind,
                kind == CHAOTIC ? ":3" : "", mark[kind], fmin(fmax(30 / sqrt((double)all), 0.12), 1.6), name[kind]);
        before = ",";
    }
    const iso_status status = iso_gnuplot_close(ctx, all > 0);
    if (status != ISO_OK || all > 0) return status;
    return iso_context_fail(ctx, ISO_BAD_INPUT, "", "the table has no orbit that starts on the section");
}

/* plot_twins.c - the picture of a comparison: one orbit on the ball's sphere and on the point's, coloured by its phase
 * t, with the same number at the same state; below, equal states joined between the two clocks.
 *
 * The whole picture is one plot, in pixels from the lower left corner. The data are in the script as they are, and
 * gnuplot projects them: X(), Y() and D() of plot_sphere.c.
 */
#include <math.h>

#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

enum {
    WIDTH = 900,
    HEIGHT = 670,
    STEP = 8,     /* states from number to number           */
    COLOURS = 96, /* neighbours of one colour are one line  */
    RADIUS = 150,
    CENTRE = 395, /* of both spheres, and their ladder's rails */
    UPPER = 190,
    LOWER = 110,
    MARGIN = 22
};
static const int middle[2] = {190, 710};

/* --- data ------------------------------------------------------------------------------------------------------- */

/* Columns 1 to 8 as they are, the parts of both clocks that have passed (9, 10), the colour (11), the same behind a
 * sphere (12), the colours of a number on both (13, 14), and the number (15). */
static void put_states(FILE *f, const char *name, const iso_record *r)
{
    const size_t rows = iso_record_rows(r);
    const double *last = iso_record_const_row(r, rows - 1);
    fprintf(f, "$%s << EOD\n", name);
    for (size_t i = 0; i < rows; i++) {
        const double *row = iso_record_const_row(r, i);
        for (int c = 0; c < 8; c++) fprintf(f, "%.17g ", row[c]);
        const double t = last[0] == 0 ? 0 : row[0] / last[0], s = last[1] == 0 ? 0 : row[1] / last[1];
        const int colour = iso_plot_scale(floor(fmin(fmax(t, 0), 1) * COLOURS) / COLOURS);
        fprintf(f, "%.17g %.17g %d %d %d %d %zu\n", t, s, colour, iso_plot_mix(colour, ISO_PLOT_SPHERE_CODE, 0.7),
                t < 0.6 ? ISO_PLOT_WHITE_CODE : 0, ISO_PLOT_FAINT_CODE, i / STEP);
    }
    fputs("EOD\n", f);
}

/* --- what stands where ------------------------------------------------------------------------------------------ */

static void put_word(FILE *f, double x, double y, const char *look, const char *words)
{
    fprintf(f, "set label %s at %.17g,%.17g %s\n", words, x, y, look);
}

/* gamma = J^(-1/2) n / |J^(-1/2) n|. No label has two fonts or a blank beside a change of height: renderers of SVG
 * do not agree on the place of what follows. */
static void put_formula(FILE *f)
{
    const double x = (middle[0] + middle[1]) / 2.0, y = CENTRE + 20;
    put_word(f, x - 58, y, "center font ',16'", "'γ ='");
    put_word(f, x + 16, y + 17, "center font ',15'", "'J^{−1/2}n'");
    put_word(f, x + 16, y - 18, "center font ',15'", "'|J^{−1/2}n|'");
    fprintf(f, "set arrow from %.17g,%.17g to %.17g,%.17g nohead lw 1.2 lc rgb 'black'\n", x - 28, y, x + 60, y);
    put_word(f, x, y - 64, "center tc rgb " ISO_PLOT_WORDS, "'same number,'");
    put_word(f, x, y - 82, "center tc rgb " ISO_PLOT_WORDS, "'same state'");
}

/* What rolls on what, from k alone: the radius of the fixed sphere is |k/(1-k)| times that of the ball. */
static void put_ball(FILE *f, double k)
{
    char words[120] = "on a plane", number[ISO_PLOT_FRACTION];
    const double ratio = fabs(k / (1 - k));
    const char *where = k < 0 ? "around" : k < 1 ? "on" : "inside";
    if (ratio == 1)
        snprintf(words, sizeof words, "%s a sphere of its own radius", where);
    else if (k != 1)
        snprintf(words, sizeof words, "%s a sphere of %.3g times its radius", where, ratio);
    fprintf(f, "set label \"k = %s: a %sball %s\" at %d,%d left noenhanced font ',11'\n",
            iso_plot_fraction(number, k), k < 0 ? "hollow " : "", words, MARGIN, HEIGHT - 54);
}

static void put_potential(FILE *f, double k, bool field)
{
    char number[ISO_PLOT_FRACTION], power[40] = "";
    if (k != -1) snprintf(power, sizeof power, "^{%s}", iso_plot_fraction(number, -1 / k));
    fprintf(f, "set label \"a point in the potential V = −ε (γ, Jγ)%s%s\" at %d,%d right font ',11'\n", power,
            field ? " + U/G" : "", WIDTH - MARGIN, HEIGHT - 54);
}

static void put_clock(FILE *f, double y, const char *words, char clock, double last)
{
    char end[40];
    snprintf(end, sizeof end, "%c = %.4g", clock, last);
    put_word(f, 60, y, "left noenhanced", words);
    put_word(f, WIDTH - 60, y, "right noenhanced", QUOTED(end, 40));
}

static void put_words(FILE *f, const iso_plot_page *page, const iso_plot_twins *plot, const double *last)
{
    const double x = WIDTH / 2.0;
    put_word(f, x, HEIGHT - 24, "center noenhanced font ',14'", QUOTED(iso_plot_titled(page, plot->title), 100));
    put_ball(f, plot->params->k);
    put_potential(f, plot->params->k, plot->field);
    put_word(f, MARGIN, HEIGHT - 76, "left tc rgb " ISO_PLOT_WORDS, "'" ISO_PLOT_OF_BALL "'");
    put_word(f, WIDTH - MARGIN, HEIGHT - 76, "right tc rgb " ISO_PLOT_WORDS, "'" ISO_PLOT_OF_POINT "'");
    put_formula(f);
    put_clock(f, UPPER + 27, "'the clock t of the ball: equal steps'", 't', last[0]);
    put_clock(f, LOWER - 27, "'the clock s of the point: the same states; each clock has its own scale'", 's',
              last[1]);
    put_word(f, x, 48, "center noenhanced tc rgb " ISO_PLOT_WORDS, QUOTED(plot->drawn, 150));
    put_word(f, x, 24, "center noenhanced", QUOTED(plot->result, 150));
}

static void put_spheres(FILE *f, const iso_record *states)
{
    for (int side = 0; side < 2; side++) {
        fprintf(f,
                "set object circle at %d,%d size R back fc rgb '#%06X' fs solid border lc rgb " ISO_PLOT_OUTLINE "\n",
                middle[side], CENTRE, ISO_PLOT_SPHERE_CODE);
        iso_plot_put_axes(f, middle[side], CENTRE, RADIUS, &(iso_plot_marks){states, STEP, 2 + 3 * side});
    }
}

/* --- what is drawn ---------------------------------------------------------------------------------------------- */

/* On side 0 n is projected, columns 3 to 5; on side 1 gamma, columns 6 to 8. A line goes on a little behind the
 * outline, where the other half of it begins; a disc there is in front. A hidden number is off the page: gnuplot 5.4
 * ends by a signal where all are NaN. Then the ladder: thin rungs, rungs with numbers, the numbers. */
static const char *const script =
    "set macros; out = -1000; near(i) = depth(i) > -0.1; ring = 'w p pt 7 ps 2.15 lc rgb \"white\"'; disc = 'w p pt "
    "7 "
    "ps 1.85 lc rgb "
    "variable'\n"
    "number = 'w labels center font \",8\" tc rgb variable'\n"
    "column3(i,k) = column(3 + 3*i + k); depth(i) = D(column3(i,0), column3(i,1), column3(i,2))\n"
    "x(i) = middle(i) + R*X(column3(i,0), column3(i,1), column3(i,2))\n"
    "y(i) = centre + R*Y(column3(i,0), column3(i,1), column3(i,2)); rail(c) = 70 + 760*column(c)\n"
    "plot for [i=0:1] $grid0 u (middle(i) + R*$1):(centre + R*$2) w l lw 0.6 lc rgb " ISO_PLOT_GRID ", "
    "for [i=0:1] $curve u (depth(i) < 0.03 ? x(i) : NaN):(y(i)):12 w l lw 2 lc rgb variable, "
    "for [i=0:1] $states u (near(i) ? NaN : x(i)):(y(i)) every 8 @ring, "
    "for [i=0:1] $states u (near(i) ? NaN : x(i)):(y(i)):12 every 8 @disc, "
    "for [i=0:1] $states u (near(i) ? out : x(i)):(y(i)):15:14 every 8 @number, "
    "for [i=0:1] $grid1 u (middle(i) + R*$1):(centre + R*$2) w l lw 0.7 lc rgb " ISO_PLOT_NEAR_GRID ", "
    "for [i=0:1] $curve u (depth(i) > -0.03 ? x(i) : NaN):(y(i)):11 w l lw 3 lc rgb variable, "
    "for [i=0:1] $states u (near(i) ? x(i) : NaN):(y(i)) every 8 @ring, "
    "for [i=0:1] $states u (near(i) ? x(i) : NaN):(y(i)):11 every 8 @disc, "
    "for [i=0:1] $states u (near(i) ? x(i) : out):(y(i)):15:13 every 8 @number, "
    "for [i=0:1] $states u (rail(9)):(upper):(rail(10) - rail(9)):(lower - upper):11 every (i ? 8 : 1) w vectors "
    "nohead lw (i ? 2.5 : 0.8) lc rgb variable, "
    "for [i=0:1] $states u (rail(9 + i)):(i ? lower : upper) every 8 @ring, "
    "for [i=0:1] $states u (rail(9 + i)):(i ? lower : upper):11 every 8 @disc, "
    "for [i=0:1] $states u (rail(9 + i)):(i ? lower : upper):15:13 every 8 @number\n";

static iso_status check(iso_context *ctx, const iso_record *r)
{
    static const char *const names[] = {"t", "s", "n1", "n2", "n3", "gamma1", "gamma2", "gamma3"};
    int first;
    return iso_plot_find(ctx, r, 8, names, &first);
}

/* Of a page of another shape the picture takes the middle: circles stay round. */
static FILE *open_page(iso_context *ctx, const iso_plot_page *page)
{
    int width = WIDTH, height = HEIGHT;
    iso_gnuplot_fit(page, false, &width, &height);
    FILE *f = iso_gnuplot_open(ctx, page, width, height);
    const double grow = fmax((double)WIDTH / width, (double)HEIGHT / height) / 2;
    fprintf(f, ISO_PLOT_PAGE "unset key; set xrange [%.17g:%.17g]; set yrange [%.17g:%.17g]\n",
            WIDTH / 2.0 - grow * width, WIDTH / 2.0 + grow * width, HEIGHT / 2.0 - grow * height,
            HEIGHT / 2.0 + grow * height);
    return f;
}

iso_status iso_plot_comparison(iso_context *ctx, const iso_plot_page *page, const iso_plot_twins *plot)
{
    ISO_TRY(check(ctx, plot->curve));
    ISO_TRY(check(ctx, plot->states));
    FILE *f = open_page(ctx, page);
    fprintf(f, "R = %d; centre = %d; upper = %d; lower = %d; middle(i) = i ? %d : %d\n", RADIUS, CENTRE, UPPER, LOWER,
            middle[1], middle[0]);
    iso_plot_put_globe(f);
    put_states(f, "curve", plot->curve);
    put_states(f, "states", plot->states);
    put_spheres(f, plot->states);
    put_words(f, page, plot, iso_record_const_row(plot->states, iso_record_rows(plot->states) - 1));
    fputs(script, f);
    return iso_gnuplot_close(ctx, true);
}

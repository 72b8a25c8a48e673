/* plot_section.c - the picture of a section: the ball's on the left, the point's on the right.
 *
 * Both sides are drawn from points (l, x) of the chart. At (l, x), for a = 3,
 *
 *     gamma = (cos l, -sin l, 0),     M/|M| = (sqrt(1-x^2) sin l, sqrt(1-x^2) cos l, x)
 *     n ~ J^(1/2) gamma,              omega ~ J^(-1/2) M, for k < 0 against it                                 (18)
 *
 * The ball's coordinates are the angle psi of n = (cos psi, -sin psi, 0) and omega_a/|omega|. The point's are l and
 * L = G(l) x.
 */
#include <math.h>

#include "base/vec3_impl.h"
#include "map/section_impl.h"
#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

enum { WIDTH = 900, HEIGHT = 470, MARGIN = 66, KEY = 46, BOUNDARY = 240 };
#define TOP 1.05      /* of the axis of L, by the largest L               */
#define LIGHTEST 0.92 /* of the scale: yellow dots are not seen on white */
#define ROOM 1.2      /* beyond the crossings, where a picture shows few  */

/* --- colours ---------------------------------------------------------------------------------------------------- */

/* From 0 to 255, of a hue in [0, 1): a colour that is neither pale nor dark. */
static int part_of(double hue, double shift)
{
    const double turn = 2 * M_PI * (hue + shift), light = 0.47 + 0.36 * cos(turn) - 0.03 * cos(2 * turn);
    return (int)(255 * fmin(fmax(light, 0), 1));
}

/* The hues of successive orbits differ by the golden section of the circle. The first is a strong blue. */
static long hue_of(double orbit)
{
    const double hue = fmod(0.6 + orbit * 0.61803398874989485, 1);
    return (long)part_of(hue, 0) << 16 | (long)part_of(hue, -1.0 / 3) << 8 | part_of(hue, -2.0 / 3);
}

/* The scale of the rotation numbers: least and largest; nothing: there are none. */
static bool range_of(const iso_plot_section *s, double range[2])
{
    const int rotation = iso_record_find(s->rows, "rotation");
    range[0] = INFINITY, range[1] = -INFINITY;
    for (size_t i = 0; rotation >= 0 && i < iso_record_rows(s->rows); i++) {
        const double x = iso_record_const_row(s->rows, i)[rotation];
        if (isfinite(x)) range[0] = fmin(range[0], x), range[1] = fmax(range[1], x);
    }
    if (range[0] > range[1]) return false;
    if (range[1] - range[0] < 1e-3) range[0] -= 5e-4, range[1] += 5e-4;
    return true;
}

static long colour_of(const iso_plot_section *s, const double row[], const double range[2])
{
    const int rotation = iso_record_find(s->rows, "rotation");
    const int shade = (int)row[iso_record_find(s->rows, "grey")];
    if (shade == ISO_PLOT_CHAOTIC) return ISO_PLOT_GREY_CODE;
    if (shade == ISO_PLOT_UNDECIDED) return ISO_PLOT_INK_CODE;
    if (rotation < 0) return hue_of(row[iso_record_find(s->rows, "orbit")]);
    return iso_plot_scale(LIGHTEST * (row[rotation] - range[0]) / (range[1] - range[0]));
}

/* --- data ------------------------------------------------------------------------------------------------------- */

static iso_plot_spot of_ball(const iso_plot_section *s, const double chart[2])
{
    const iso_params *p = s->params;
    const int a = s->axis, b = (a + 1) % 3, c = (a + 2) % 3;
    const double l = chart[0], x = chart[1], across = sqrt((1 - x) * (1 + x)), sign = copysign(1, p->k);
    const double omega[3] = {sign * across * sin(l) / p->root_J[b], sign * across * cos(l) / p->root_J[c],
                             sign * x / p->root_J[a]};
    return (iso_plot_spot){atan2(p->root_J[c] * sin(l), p->root_J[b] * cos(l)), omega[2] / norm(omega)};
}

/* G(l). If more acts than a level, 1: then x is drawn in place of L. */
static double largest_momentum(const iso_plot_section *s, double l)
{
    return s->eps > 0 ? iso_section_momentum((iso_point_motion){s->params, s->eps, s->energy}, s->axis, l) : 1;
}

static iso_plot_spot of_point(const iso_plot_section *s, const double chart[2])
{
    return (iso_plot_spot){chart[0], chart[1] * largest_momentum(s, chart[0])};
}

typedef iso_plot_spot place_of(const iso_plot_section *s, const double chart[2]);

/* The rectangle that holds the window on one side, told by its edges. Without a window all is in it. */
static void find_window(const iso_plot_page *page, const iso_plot_section *s, place_of *place,
                        iso_plot_spot corner[2])
{
    const iso_plot_window *w = &page->window;
    const bool given = w->x[0] < w->x[1];
    const double low = given ? INFINITY : -INFINITY;
    corner[0] = (iso_plot_spot){low, low}, corner[1] = (iso_plot_spot){-low, -low};
    for (int i = 0; given && i <= 2 * BOUNDARY + 1; i++) {
        const iso_plot_spot at =
            place(s, (double[]){w->l[0] + (w->l[1] - w->l[0]) * (i / 2) / BOUNDARY, w->x[i % 2]});
        corner[0] = (iso_plot_spot){fmin(corner[0].right, at.right), fmin(corner[0].up, at.up)};
        corner[1] = (iso_plot_spot){fmax(corner[1].right, at.right), fmax(corner[1].up, at.up)};
    }
}

/* False of a spot that is not finite, too. */
static bool is_inside(const iso_plot_spot corner[2], iso_plot_spot at)
{
    return isfinite(at.right) && isfinite(at.up) && at.right >= corner[0].right && at.right <= corner[1].right &&
           at.up >= corner[0].up && at.up <= corner[1].up;
}

/* A block of crossings, of the point where it has columns of its own. The grey ones come first, so that they lie
 * behind the others. Gives how far up they go. */
static double put_crossings(FILE *f, const iso_plot_page *page, const iso_plot_section *s, bool ball)
{
    const int own = ball ? -1 : iso_record_find(s->rows, "point_l");
    const int l = own < 0 ? iso_record_find(s->rows, "l") : own, shade = iso_record_find(s->rows, "grey");
    const int x = iso_record_find(s->rows, own < 0 ? "x" : "point_x");
    double most = 0, range[2];
    iso_plot_spot corner[2];
    find_window(page, s, ball ? of_ball : of_point, corner);
    range_of(s, range);
    fprintf(f, "$%s << EOD\nNaN NaN 0 0\n", ball ? "ball" : "point");
    for (int behind = 1; behind >= 0; behind--)
        for (size_t i = 0; i < iso_record_rows(s->rows); i++) {
            const double *row = iso_record_const_row(s->rows, i), chart[] = {row[l], row[x]};
            if ((row[shade] != 0) != behind) continue;
            const iso_plot_spot at = ball ? of_ball(s, chart) : of_point(s, chart);
            if (!is_inside(corner, at)) continue;
            fprintf(f, "%.5f %.6g %ld %d\n", at.right, at.up, colour_of(s, row, range), (int)row[shade]);
            most = fmax(most, fabs(at.up));
        }
    fputs("EOD\n", f);
    return most;
}

/* Writes the boundary L = G(l). Gives the largest G. */
static double put_boundary(FILE *f, const iso_plot_section *s)
{
    double most = 0;
    fputs("$boundary << EOD\n", f);
    for (int i = 0; i <= BOUNDARY; i++) {
        const double l = M_PI * (2.0 * i / BOUNDARY - 1), G = largest_momentum(s, l);
        fprintf(f, "%.5f %.6g\n", l, G);
        most = fmax(most, G);
    }
    fputs("EOD\n", f);
    return most;
}

/* --- the picture ------------------------------------------------------------------------------------------------ */

/* Spots of a section: the more in the window, the smaller. Periodic orbits are few: those in colours are large. */
static void put_spots(FILE *f, const iso_plot_page *page, const iso_plot_section *s, const char *block)
{
    const double part =
        (page->window.x[1] - page->window.x[0]) * (page->window.l[1] - page->window.l[0]) / (4 * M_PI);
    const double spots = (double)iso_record_rows(s->rows) * (part > 0 ? part : 1);
    const double size = fmin(fmax(9 / sqrt(spots), 0.05), 0.4);
    if (s->few)
        fprintf(f, "$%s using 1:2:($4 > 0 ? 0.45 : 1.1):3 with points pt 7 ps variable lc rgb variable notitle",
                block);
    else
        fprintf(f, "$%s using 1:2:3 with points pt 7 ps %.17g lc rgb variable notitle", block, size);
    iso_plot_draw_over(f, s, block);
    fputc('\n', f);
}

static void put_heading(FILE *f, const iso_plot_page *page, const iso_plot_section *s, int height)
{
    fprintf(f,
            "set multiplot\n" ISO_PLOT_PAGE "set key at screen 0.985,0.962 right center samplen 1 horizontal\n"
            "set label 1 %s at screen 0.015,0.962 left noenhanced font ',12'\nplot NaN notitle",
            QUOTED(iso_plot_titled(page, s->title), 95));
    if (s->grey_means) fprintf(f, ", NaN w p pt 7 ps 1 lc rgb " ISO_PLOT_GREY " title %s", QUOTED(s->grey_means, 60));
    if (s->dark_means) fprintf(f, ", NaN w p pt 7 ps 1 lc rgb " ISO_PLOT_INK " title %s", QUOTED(s->dark_means, 60));
    fprintf(f,
            "\nunset label 1; unset key\n" ISO_PLOT_FRAME
            "set tmargin at screen %.17g\nset bmargin at screen %.17g\n" //
            ISO_PLOT_ANGLES,
            1 - (double)MARGIN / height, (double)(MARGIN + (s->over ? KEY : 0)) / height);
}

/* The colour bar, in the right margin. The spots have their colours already: nothing else is drawn by it. */
static void put_bar(FILE *f, const iso_plot_section *s)
{
    double range[2];
    if (!range_of(s, range)) return;
    iso_plot_put_scale(f, LIGHTEST);
    fprintf(f,
            "set cbrange [%.6g:%.6g]; set cblabel 'rotation number: turns from crossing to crossing' offset 0.5,0\n"
            "set colorbox user origin 0.9,0.2 size 0.014,0.6; set cbtics offset -0.5,0\n",
            range[0], range[1]);
}

/* Where the two sections stand from left to right: with a bar there is less room. */
static const double *sides_of(const iso_plot_section *s)
{
    static const double wide[] = {0.085, 0.485, 0.585, 0.985}, beside_bar[] = {0.085, 0.44, 0.53, 0.885};
    double range[2];
    return range_of(s, range) ? beside_bar : wide;
}

static void put_window(FILE *f, const iso_plot_page *page, const iso_plot_section *s, place_of *place)
{
    iso_plot_spot corner[2];
    if (page->window.x[0] == page->window.x[1]) return;
    find_window(page, s, place, corner);
    fprintf(f, "set xrange [%.17g:%.17g]; set xtics autofreq; set yrange [%.17g:%.17g]\n", corner[0].right,
            corner[1].right, corner[0].up, corner[1].up);
}

static void put_ball(FILE *f, const iso_plot_page *page, const iso_plot_section *s, double top)
{
    const int a = s->axis + 1, b = (s->axis + 1) % 3 + 1, c = (s->axis + 2) % 3 + 1;
    fprintf(f,
            "set lmargin at screen %.17g; set rmargin at screen %.17g; set yrange [-%.17g:%.17g]\n"
            "set ytics autofreq\n"
            "set title 'ball: n_%d\u2060 = 0, n_%d\u2060 increasing' offset 0,-0.5\n"
            "set xlabel 'ψ,  where n_%d\u2060 = cos ψ, n_%d\u2060 = −sin ψ' offset 0,0.3\n"
            "set ylabel 'ω_%d\u2060 / |ω|' offset 1,0\n",
            sides_of(s)[0], sides_of(s)[1], top, top, a, a, b, c, a);
    put_window(f, page, s, of_ball);
    fputs("plot ", f);
    put_spots(f, page, s, "ball");
}

static void put_point(FILE *f, const iso_plot_page *page, const iso_plot_section *s, double top, double most)
{
    const int a = s->axis + 1, b = (s->axis + 1) % 3 + 1, c = (s->axis + 2) % 3 + 1;
    fprintf(f,
            "set lmargin at screen %.17g; set rmargin at screen %.17g; set ytics autofreq; set yrange "
            "[%.17g:%.17g]\nset title '%s: γ_%d\u2060 = 0, γ_%d\u2060 increasing'\n"
            "set xlabel 'l,  where γ_%d\u2060 = cos l, γ_%d\u2060 = −sin l'\n",
            sides_of(s)[2], sides_of(s)[3], -top, top, s->eps > 0 ? "point" : "directions of γ and M", a, a, b, c);
    fprintf(f,
            s->eps > 0 ? "set ylabel 'L = M_%d, in the units of the scene'\n" : "set ylabel 'x = M_%d\u2060 / |M|'\n",
            a);
    put_window(f, page, s, of_point);
    fputs("plot ", f);
    for (int side = 1; side >= -1; side -= 2) { /* outside of the boundaries */
        fprintf(f,
                "$boundary using 1:(%d*$2):(%.17g) with filledcurves fc rgb " ISO_PLOT_BAND
                " notitle, $boundary using "
                "1:(%d*$2) with lines lw 1 lc rgb " ISO_PLOT_LINE " notitle, ",
                side, side * TOP * most, side);
    }
    double range[2];
    if (range_of(s, range)) fputs("$boundary using 1:(NaN):(0) with points lc palette notitle, ", f);
    put_spots(f, page, s, "point");
}

iso_status iso_plot_sections(iso_context *ctx, const iso_plot_page *page, const iso_plot_section *s)
{
    int column[4];
    if (!iso_record_find_all(s->rows, 4, (const char *[]){"orbit", "l", "x", "grey"}, column, NULL) ||
        iso_record_rows(s->rows) == 0 || s->axis < 0 || s->axis > 2)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "",
                                "a picture of a section n_a = 0 needs at least one crossing, and a = 1, 2 or 3");
    const int height = HEIGHT + (s->over ? KEY : 0);
    FILE *f = iso_gnuplot_open(ctx, page, WIDTH, height);
    iso_plot_put_over(f, s, "ball", of_ball);
    iso_plot_put_over(f, s, "point", of_point);
    const double ball = put_crossings(f, page, s, true), point = put_crossings(f, page, s, false),
                 most = put_boundary(f, s);
    put_heading(f, page, s, height);
    put_ball(f, page, s, s->few ? fmin(1, ROOM * ball + 1e-3) : 1);
    put_bar(f, s);
    put_point(f, page, s, TOP * (s->few ? fmin(most, ROOM * point + 1e-3 * most) : most), most);
    if (s->over) iso_plot_over_key(f, s, 25.0 / height);
    return iso_gnuplot_close(ctx, true);
}

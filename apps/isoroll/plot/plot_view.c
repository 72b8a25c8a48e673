/* plot_view.c - the path of the ball from above and from the side, with the support, and the ball at the start and at
 * the end. */
#include <math.h>
#include <stdio.h>

#include "base/vec3_impl.h"
#include "plot/gnuplot.h"
#include "plot/plot_parts.h"

#define OUTLINE 0.1   /* nothing is hidden this near the outline of the support; part of its radius */
#define FLATTEST 0.45 /* least height of a view as a part of its width, and least width as a part of its height */
#define MARGIN 0.06

typedef struct view {
    const iso_plot_scenery *s;
    const double *across, *along, *towards; /* right and up in the picture, and away from the eye (times sign) */
    double sign;
    int along_range; /* 1 or 2: which of low[], high[] */
    bool narrow;
} view;

static view make_view(const iso_plot_scenery *s, bool from_above)
{
    return (view){.s = s,
                  .across = s->right,
                  .along = from_above ? s->away : s->up,
                  .towards = from_above ? s->up : s->away,
                  .sign = from_above ? 1 : -1,
                  .along_range = from_above ? 1 : 2,
                  .narrow = iso_plot_is_narrow(s)};
}

/* The places of a narrow path are counted from its start. */
static void project(const view *v, const double place[3], double at[2])
{
    const iso_plot_scenery *s = v->s;
    const double *origin = iso_record_const_row(s->rows, 0) + s->place;
    at[0] = dot(place, v->across) - (v->narrow ? dot(origin, v->across) : 0);
    at[1] = dot(place, v->along) - (v->narrow ? dot(origin, v->along) : 0);
}

/* Whether the support hides the place: only a sphere on whose outside the ball rolls, or that is inside the ball. */
static bool is_solid(const iso_plot_scenery *s)
{
    if (s->support == 0 || s->ball == 0) return false;
    const double *row = iso_record_const_row(s->rows, 0);
    return norm(row + s->centre) > s->support || s->ball > s->support;
}

/* --- data ------------------------------------------------------------------------------------------------------- */

/* The rows before (near: behind) the middle of the support. */
static void put_path(FILE *f, const view *v, int column, const char *name, bool near)
{
    const bool hides = is_solid(v->s) && v->s->ball <= v->s->support;
    bool open = false;
    iso_plot_begin_side(f, name, near);
    for (size_t i = 0; i < iso_plot_drawn_rows(v->s->rows); i++) {
        const double *place = iso_plot_drawn_row(v->s->rows, i) + column;
        double at[2];
        const bool seen = !hides || v->sign * dot(place, v->towards) >= -OUTLINE * v->s->support;
        project(v, place, at);
        if (seen == near || open)
            fprintf(f, "%.17g %.17g\n", at[0], at[1]); /* a piece ends where the next one begins */
        if (seen != near && open) fputc('\n', f);
        open = seen == near;
    }
    fputs("EOD\n", f);
}

static void put_sign(FILE *f, const view *v, size_t row, const char *type)
{
    double at[2];
    project(v, iso_record_const_row(v->s->rows, row) + v->s->place, at);
    fprintf(f, "set label '' at %.17g,%.17g front point %s\n", at[0], at[1], type);
}

static void put_circle(FILE *f, int tag, const double at[2], double radius, const char *style)
{
    fprintf(f, "set object %d circle at %.17g,%.17g size %.17g %s\n", tag, at[0], at[1], radius, style);
}

/* --- the support, and the ball on it ---------------------------------------------------------------------------- */

/* The plane, seen from the side, is a line through the first contact. */
static void put_plane(FILE *f, const view *v, double range[2][2])
{
    const iso_plot_scenery *s = v->s;
    double contact[2], centre[2];
    project(v, iso_record_const_row(s->rows, 0) + s->contact, contact);
    project(v, iso_record_const_row(s->rows, 0) + s->centre, centre);
    const double slope = -(centre[0] - contact[0]) / (centre[1] - contact[1]);
    fputs("set arrow 1 nohead back lw 3 lc rgb " ISO_PLOT_OUTLINE " from ", f);
    for (int end = 0; end < 2; end++) {
        fprintf(f, "%.17g,%.17g%s", range[0][end], contact[1] + slope * (range[0][end] - contact[0]),
                end ? "\n" : " to ");
    }
}

static void put_support(FILE *f, const view *v, double range[2][2])
{
    const iso_plot_scenery *s = v->s;
    const double middle[2] = {0, 0};
    if (s->support > 0)
        put_circle(f, 1, middle, s->support,
                   is_solid(s) ? "back fc rgb " ISO_PLOT_BAND " fs solid border lc rgb " ISO_PLOT_OUTLINE " lw 1.5"
                               : "back fs empty border lc rgb " ISO_PLOT_OUTLINE " lw 2.5");
    if (s->plane && !s->level && s->ball > 0 && v->along_range == 2) put_plane(f, v, range);
}

static void put_balls(FILE *f, const view *v)
{
    const iso_plot_scenery *s = v->s;
    const size_t last = iso_record_rows(s->rows) - 1;
    if (s->ball == 0 || v->narrow) return;
    double at[2];
    project(v, iso_record_const_row(s->rows, 0) + s->centre, at);
    put_circle(f, 2, at, s->ball, "back fs empty border lc rgb " ISO_PLOT_LINE " dt (4,3)");
    project(v, iso_record_const_row(s->rows, last) + s->centre, at);
    put_circle(f, 3, at, s->ball,
               "back fc rgb " ISO_PLOT_FAR_BLUE " fs transparent solid 0.35 border lc rgb " ISO_PLOT_LINE);
}

/* Not if contact is lost in the last row: that sign says more. */
static bool shows_end(const iso_plot_scenery *s)
{
    return s->losses == 0 || s->lost[s->losses - 1] != iso_record_rows(s->rows) - 1;
}

/* --- the panel -------------------------------------------------------------------------------------------------- */

/* Both views of a sphere have one scale: as wide as the widest of the three directions needs. */
static void fill_square(const iso_plot_scenery *s, double range[2][2])
{
    double width = 0;
    for (int a = 0; a < 3; a++)
        width = fmax(width, fmax(s->high[a] + s->ball, s->support) - fmin(s->low[a] - s->ball, -s->support));
    for (int a = 0; a < 2; a++) {
        const double middle = (range[a][0] + range[a][1]) / 2, half = width * (0.5 + MARGIN);
        range[a][0] = middle - half, range[a][1] = middle + half;
    }
}

/* What must fit into the panel: the path, the ball, the sphere. */
static void find_range(const view *v, double range[2][2])
{
    const iso_plot_scenery *s = v->s;
    const int axis[2] = {0, v->along_range};
    double start[2] = {0, 0};
    if (v->narrow)
        project(&(view){.s = s, .across = v->across, .along = v->along}, iso_record_const_row(s->rows, 0) + s->place,
                start);
    for (int a = 0; a < 2; a++) {
        const double room = v->narrow ? 0 : s->ball;
        range[a][0] = s->low[axis[a]] - start[a] - room;
        range[a][1] = s->high[axis[a]] - start[a] + room;
        if (s->support > 0) range[a][0] = fmin(range[a][0], -s->support);
        if (s->support > 0) range[a][1] = fmax(range[a][1], s->support);
    }
    if (s->support > 0) fill_square(s, range);
    for (int a = 0; a < 2 && s->support == 0; a++) {
        const double other = v->narrow ? 0 : FLATTEST * (range[1 - a][1] - range[1 - a][0]);
        const double width = range[a][1] - range[a][0], room = MARGIN * width + fmax(0, (other - width) / 2);
        range[a][0] -= room, range[a][1] += room;
    }
}

double iso_plot_view_shape(const iso_plot_scenery *s)
{
    double shape = FLATTEST;
    for (int above = 0; above < 2; above++) {
        const view v = make_view(s, above);
        double range[2][2];
        find_range(&v, range);
        const double width = range[0][1] - range[0][0], height = range[1][1] - range[1][0];
        shape = fmax(shape, width > 0 ? fmin(height / width, 1) : 1);
    }
    return shape;
}

static void put_axes(FILE *f, const view *v, double range[2][2])
{
    const iso_plot_scenery *s = v->s;
    char name[ISO_PLOT_NAME];
    const char *along = v->along_range == 1 ? s->away_name : s->up_name;
    iso_plot_ticks(f, &(iso_plot_axis){"x", range[0][0], range[0][1], v->narrow ? 10 : 5, s->right_name, true}, name);
    iso_plot_ticks(f, &(iso_plot_axis){"y", range[1][0], range[1][1], v->narrow ? 4 : 5, along, true}, name);
}

static void put_title(FILE *f, const view *v, bool from_above)
{
    fprintf(f, "set title %s noenhanced offset 0,-0.3\n",
            QUOTED(from_above ? v->s->from_above : v->s->from_side, 90));
}

static void put_signs(FILE *f, const view *v)
{
    const iso_plot_scenery *s = v->s;
    put_sign(f, v, 0, ISO_PLOT_START " lc rgb 'black'");
    if (shows_end(s)) put_sign(f, v, iso_record_rows(s->rows) - 1, ISO_PLOT_END " lc rgb 'black'");
    for (int i = 0; i < s->losses; i++) put_sign(f, v, s->lost[i], ISO_PLOT_LOST);
}

/* The far side first. */
static void put_lines(FILE *f, const char *with, bool both)
{
    fprintf(f, "plot $way0 w %s lw 1 lc rgb " ISO_PLOT_FAR_BLUE, with);
    if (both) fprintf(f, ", $touch0 w %s lw 1 dt (6,3) lc rgb " ISO_PLOT_FAR_VERMILLION, with);
    if (both) fprintf(f, ", $touch1 w %s lw 1 dt (6,3) lc rgb " ISO_PLOT_VERMILLION, with);
    fprintf(f, ", $way1 w %s lw 1.6 lc rgb " ISO_PLOT_BLUE "\nset size noratio; unset grid\n", with);
}

/* Whether the paths of contact and centre are both drawn: on a plane they are the same from above. */
static bool shows_contact(const iso_plot_scenery *s)
{
    return s->centre >= 0 && s->contact >= 0 && !s->plane;
}

void iso_plot_view(FILE *f, const iso_plot_box *box, const iso_plot_scenery *s, bool from_above)
{
    const view v = make_view(s, from_above);
    double range[2][2];
    for (int near = 0; near < 2; near++) {
        put_path(f, &v, s->place, "way", near);
        if (shows_contact(s)) put_path(f, &v, s->contact, "touch", near);
    }
    fprintf(f,
            "unset label; unset arrow; unset object; unset key; unset logscale; set border 3 lc rgb " ISO_PLOT_LINE
            "\n"
            "set grid xtics ytics back lt 1 lw 0.8 lc rgb " ISO_PLOT_GRID "\nset size %s\n",
            v.narrow ? "noratio" : "ratio -1");
    iso_plot_place(f, box);
    find_range(&v, range);
    put_axes(f, &v, range);
    put_title(f, &v, from_above);
    put_support(f, &v, range);
    put_balls(f, &v);
    put_signs(f, &v);
    put_lines(f, s->plane || iso_plot_is_joined(s->rows, s->place) ? "lines" : "points pt 7 ps 0.2",
              shows_contact(s));
}

void iso_plot_view_key(const iso_plot_scenery *s, char text[static 512])
{
    const char *lost = iso_plot_loss_name(s->rows, s->lost, s->losses);
    snprintf(text, 512,
             "NaN w l lw 1.8 lc rgb " ISO_PLOT_BLUE " title '%s'%s"
             ", NaN w p " ISO_PLOT_START " lc rgb 'black' title 'start'"
             "%s%s%s%s",
             s->centre >= 0 ? "centre" : "contact",
             shows_contact(s) ? ", NaN w l lw 1.2 dt (6,3) lc rgb " ISO_PLOT_VERMILLION " title 'contact'" : "",
             shows_end(s) ? ", NaN w p " ISO_PLOT_END " lc rgb 'black' title 'end'" : "",
             lost ? ", NaN w p " ISO_PLOT_LOST " title '" : "", lost ? lost : "", lost ? "'" : "");
}

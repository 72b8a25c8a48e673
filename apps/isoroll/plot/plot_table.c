/* plot_table.c - pictures of the tables that commands write (see plot.h). A kind of table is a row of `kinds`. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "orbit/description.h"
#include "plot/draw.h"
#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

/* --- pictures that are a script of gnuplot ---------------------------------------------------------------------- */

/* Begins one: with the title, and the name of what varies. */
static FILE *begin(iso_context *ctx, const iso_plot_page *page, const char *title, const char *varies, int height)
{
    FILE *f = iso_gnuplot_open(ctx, page, 900, height);
    fprintf(f, "set multiplot; set label 1 %s noenhanced at screen 0.5,0.97 center\n",
            QUOTED(iso_plot_titled(page, title), 120));
    fprintf(f, "varies = %s; set tics nomirror out scale 0.6\n", QUOTED(iso_plot_symbol(varies), 8));
    return f;
}

/* Whether there is a bifurcation: gnuplot 5.4 cannot draw labels of which none is there. */
static bool has_events(const iso_record *r)
{
    for (size_t i = 0; i < iso_record_rows(r); i++)
        if (!iso_plot_is(r, i, "event", "") && !iso_plot_is(r, i, "event", "end")) return true;
    return false;
}

/* A bifurcation diagram. A row with an event repeats a point. */
static iso_status draw_branches(iso_context *ctx, const iso_plot_page *page, const char *title, const iso_record *r)
{
    const char *varies = iso_record_name(r, 3), *const columns[] = {"branch", varies, "trace", "u", "event", NULL};
    static const char script[] =
        "unset key; set lmargin at screen 0.1; set rmargin at screen 0.97; last = int(word($table[|$table|], 1))\n"
        "look(b) = (b - 1) %% 10 + 1\n"
        "x(event) = strcol(5) eq '' ? (event ? NaN : $2) : event && strcol(5) ne 'end' ? $2 : NaN\n"
        "set tmargin at screen 0.93; set bmargin at screen 0.54; set ylabel 'trace' offset 1,0; set yrange [-6:6]\n"
        "set object 1 rectangle from graph 0, first -2 to graph 1, first 2 back fc rgb " ISO_PLOT_PALE_BLUE
        " fs solid noborder\n"
        "set label 2 'stable' at graph 0.01, first 1.5 tc rgb " ISO_PLOT_WORDS "\n"
        "plot for [b=1:last] $table using ($1 == b ? x(0) : NaN):3 w l ls look(b) lw 1.5 title 'trace'%s\n"
        "unset label; unset object; set yrange [0:1]; set tmargin at screen 0.48; set bmargin at screen 0.09\n"
        "set ylabel 'place on the line: 2 u/π' offset 1,0; set xlabel varies\n"
        "plot for [b=1:last] $table using ($1 == b ? x(0) : NaN):(2 / pi * $4) w l ls look(b) lw 1.5 title 'place', "
        "$table using (x(1)):(2 / pi * $4) w p pt 7 ps 0.8 lc rgb 'black'";
    char whole[sizeof script + 200];
    snprintf(whole, sizeof whole, script,
             has_events(r)
                 ? ", $table using (x(1)):3:5 w labels left offset 0.7,0.7 rotate by 15 font ',8' point pt 7 "
                   "ps 0.8 lc rgb 'black'"
                 : "");
    FILE *f = begin(ctx, page, title, varies, 640);
    iso_plot_block(f, "table", r, columns);
    for (int i = 0; i < ISO_PLOT_STROKES; i++) fprintf(f, "set style line %d %s\n", i + 1, iso_plot_stroke(i));
    fputs(whole, f);
    return iso_gnuplot_close(ctx, true);
}

/* The least step of a column of the grid. */
static double step_of(const iso_record *r, int column)
{
    double step = INFINITY;
    for (size_t i = 1; i < iso_record_rows(r); i++) {
        const double d = fabs(iso_record_const_row(r, i)[column] - iso_record_const_row(r, i - 1)[column]);
        if (iso_plot_is(r, i, "kind", "grid") && iso_plot_is(r, i - 1, "kind", "grid") && d > 0) step = fmin(step, d);
    }
    return isfinite(step) ? step : 1;
}

/* -1: unstable, T < -2; 0: stable; 1: unstable, T > 2; 2: not known. With equal moments a trace is -2 up to rounding. */
static int class_of(double trace)
{
    const double edge = 2 + 1e-9;
    return isnan(trace) ? 2 : trace <= -edge ? -1 : trace > edge ? 1 : 0;
}

/* The block $cells of one rotation: neighbours of one class are one rectangle. Its middle, edges, and class. */
static void put_cells(FILE *f, const iso_record *r, const char *column, int k)
{
    const int trace = iso_record_find(r, column);
    const double half[2] = {step_of(r, k) / 2, step_of(r, 2) / 2};
    const size_t rows = iso_record_rows(r);
    fprintf(f, "$%s << EOD\nNaN NaN NaN NaN NaN NaN NaN\n", column);
    for (size_t i = 0, next; i < rows; i = next) {
        const double *first = iso_record_const_row(r, i), *last = first;
        const int class = class_of(first[trace]);
        next = i + 1;
        if (!iso_plot_is(r, i, "kind", "grid") || class == 2) continue;
        for (; next < rows && iso_plot_is(r, next, "kind", "grid"); last = iso_record_const_row(r, next++)) {
            const double *row = iso_record_const_row(r, next);
            if (class_of(row[trace]) != class || (row[k] != first[k] && row[2] != first[2])) break;
        }
        fprintf(f, "%.9g %.9g %.9g %.9g %.9g %.9g %d\n", first[k], first[2], fmin(first[k], last[k]) - half[0],
                fmax(first[k], last[k]) + half[0], fmin(first[2], last[2]) - half[1],
                fmax(first[2], last[2]) + half[1], class);
    }
    fputs("EOD\n", f);
}

/* The block $border: where T is 2 or -2. */
static void put_borders(FILE *f, const iso_record *r, const char *column)
{
    fputs("$border << EOD\nNaN NaN\n", f);
    for (size_t i = 0; i < iso_record_rows(r); i++)
        if (iso_plot_is(r, i, "kind", "border") && isfinite(iso_plot_number(r, i, column)))
            fprintf(f, "%.9g %.9g\n", iso_plot_number(r, i, "k"), iso_record_const_row(r, i)[2]);
    fputs("EOD\n", f);
}

/* One panel; side: 0: the axis of the least moment, 1: of the greatest. */
static void put_stability(FILE *f, const iso_record *r, int side)
{
    static const char *const column[] = {"least", "greatest"};
    fprintf(f,
            "set title 'rotation about the axis of the %s moment'\nset lmargin at screen %.2f; set rmargin at screen "
            "%.2f\n",
            column[side], side ? 0.56 : 0.08, side ? 0.97 : 0.49);
    put_cells(f, r, column[side], iso_record_find(r, "k"));
    put_borders(f, r, column[side]);
    fprintf(
        f,
        "plot for [c=0:2] $%s using ($7 == class[c + 1] ? $1 : NaN):2:3:4:5:6 w boxxyerror fs solid 1 noborder lw 0 "
        "lc rgb colour[c + 1] title name[c + 1], $border w p pt 7 ps 0.25 lc rgb 'black' title 'border, T = ±2 (T: "
        "trace)'\n"
        "unset label 1\n",
        column[side]);
}

/* Where a rotation is stable, and the borders. */
static iso_status draw_stability(iso_context *ctx, const iso_plot_page *page, const char *title, const iso_record *r)
{
    FILE *f = begin(ctx, page, title, iso_record_name(r, 2), 480);
    fputs("set tmargin at screen 0.86; set bmargin at screen 0.2; set xlabel 'k'; set ylabel varies offset 1,0\n"
          "set key at screen 0.5,0.07 center horizontal samplen 1 Left reverse width 2; set autoscale noextend\n"
          "array class[3] = [0, -1, 1]; array colour[3] = [" ISO_PLOT_PALE_BLUE ", " ISO_PLOT_ORANGE
          ", " ISO_PLOT_VERMILLION "]\narray name[3] = ['stable', 'unstable, T < −2', 'unstable, T > 2']\n",
          f);
    for (int side = 0; side < 2; side++) put_stability(f, r, side);
    return iso_gnuplot_close(ctx, true);
}

/* --- the kinds -------------------------------------------------------------------------------------------------- */

static const struct kind {
    const char *name, *shows; /* shows: the title of a table that has none */
    const char *columns[5];   /* that the picture needs; NULL ends them */
    bool axis;                /* and the line "axis"                    */
    iso_status (*draw)(iso_context *ctx, const iso_plot_page *page, const char *title, const iso_record *rows);
} kinds[] = {
    {"periodic follow", "Periodic orbits followed", {"branch", "u", "trace", "event"}, false, draw_branches},
    {"periodic chart", "Where rotations are stable", {"kind", "k", "least", "greatest"}, false, draw_stability},
    {"cost", "Time and error of the methods", {"backend", "method", "error", "total"}, false, iso_plot_cost},
};

static const struct kind *find_kind(const char *name)
{
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (strcmp(kinds[i].name, name) == 0) return &kinds[i];
    return NULL;
}

bool iso_plot_has_kind(const char *name)
{
    for (int i = 0; iso_picture_kind(i); i++)
        if (strcmp(iso_picture_kind(i), name) == 0) return true;
    return find_kind(name) != NULL;
}

static iso_status check(iso_context *ctx, const iso_record *r, const struct kind *kind)
{
    for (size_t i = 0; kind->columns[i]; i++)
        if (iso_record_find(r, kind->columns[i]) < 0)
            return iso_context_fail(ctx, ISO_BAD_INPUT, "", "no picture: the table has no column '%s'",
                                    kind->columns[i]);
    if (iso_record_rows(r) == 0) return iso_context_fail(ctx, ISO_BAD_INPUT, "", "no picture: the table has no rows");
    if (!kind->axis || iso_plot_axis_of(r) >= 0) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_INPUT, "",
                            "no picture: the table does not say its axis, in a line '# axis: 3'");
}

iso_status iso_plot_table(iso_context *ctx, const iso_plot_page *page, const iso_record *r)
{
    char title[ISO_PLOT_HEADING];
    iso_params p;
    const struct kind *kind = find_kind(iso_record_kind(r));
    const char *own = iso_record_get(r, "title"), *wish = iso_plot_section_wish(page);
    if (strcmp(iso_record_kind(r), "section") == 0) return plot_section(ctx, page, r);
    if (wish)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, wish, "--%s is for sections, and this is a table '%s'", wish,
                                iso_record_kind(r));
    if (!kind) return plot_tables(ctx, page, (const iso_record *[]){r, NULL}, NULL);
    ISO_TRY(check(ctx, r, kind));
    ISO_TRY(iso_record_params(ctx, r, &p));
    return kind->draw(ctx, page, own ? own : iso_plot_heading(title, kind->shows, &p), r);
}

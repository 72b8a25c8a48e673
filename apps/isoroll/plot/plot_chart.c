/* plot_chart.c - a chart of drifts over a clock.
 *
 * Each column of a record is one line on a logarithmic axis. A key on the right gives its symbol and its largest
 * value.
 */
#include <math.h>
#include <string.h>

#include "plot/gnuplot.h"
#include "plot/plot_parts.h"

enum {
    LOWEST = -17,
    SLOTS = 450 /* of the time axis; each shows its largest difference, so that thinning hides none */
};
#define FLOOR                                                                                                        \
    1e-17 /* 10^LOWEST, stands for 0 on the logarithmic axis; below any difference of doubles of order one */

/* Names of clocks and vectors; a component, such as gamma1, has its number below. */
const char *iso_plot_symbol(const char *name)
{
    static const char *const symbols[][5] = {{"omega", "ω", "ω₁", "ω₂", "ω₃"}, {"gamma", "γ", "γ₁", "γ₂", "γ₃"},
                                             {"n", "n", "n₁", "n₂", "n₃"},     {"M", "M", "M₁", "M₂", "M₃"},
                                             {"J", "J", "J₁", "J₂", "J₃"},     {"tau", "τ", NULL, NULL, NULL},
                                             {"mu", "μ", NULL, NULL, NULL}};
    for (size_t i = 0; i < sizeof symbols / sizeof *symbols; i++) {
        const size_t length = strlen(symbols[i][0]);
        const char *rest = name + length;
        if (strncmp(symbols[i][0], name, length) != 0) continue;
        const int component = *rest >= '1' && *rest <= '3' && !rest[1] ? *rest - '0' : 0;
        if (*rest == '\0' || (component && symbols[i][1 + component])) return symbols[i][1 + component];
    }
    return name;
}

/* One column over the first: in each slot of rows the largest, at its own time. Answers the largest of all. */
static double put_differences(FILE *f, const iso_record *r, int column)
{
    const size_t rows = iso_record_rows(r), slots = rows < SLOTS ? rows : SLOTS;
    double largest = 0;
    fprintf(f, "$difference%d << EOD\n", column);
    for (size_t slot = 0; slot < slots; slot++) {
        const double *worst = iso_record_const_row(r, slot * rows / slots);
        for (size_t i = slot * rows / slots; i < (slot + 1) * rows / slots; i++)
            if (iso_record_const_row(r, i)[column] > worst[column]) worst = iso_record_const_row(r, i);
        fprintf(f, "%.17g %.17g\n", worst[0], fmax(worst[column], FLOOR));
        largest = fmax(largest, worst[column]);
    }
    fputs("EOD\n", f);
    return largest;
}

/* Axes of the chart. Its lowest tick stands for 0 as well. */
static void put_axes(FILE *f, const iso_record *r, double top, const iso_plot_box *box, const char *title)
{
    const double a = iso_record_const_row(r, 0)[0], b = iso_record_const_row(r, iso_record_rows(r) - 1)[0];
    const int highest = (int)ceil(log10(fmax(top, 1e-15)) + 0.3);
    const iso_plot_axis clock = {.which = "x",
                                 .low = fmin(a, b),
                                 .high = fmax(a, b),
                                 .most = box->right - box->left > 0.4 ? 8 : 4,
                                 .name = iso_plot_symbol(iso_record_name(r, 0)),
                                 .label = true};
    char name[ISO_PLOT_NAME];
    fprintf(f,
            "unset label; unset arrow; unset object; set size noratio; set border 3 lc rgb " ISO_PLOT_LINE "; set "
            "logscale y\nset grid ytics back lt 1 lw 0.8 lc rgb " ISO_PLOT_GRID "; unset ylabel\n"
            "set key left top Left reverse vertical maxrows 16 samplen 2 spacing 1.2 noenhanced title 'largest' "
            "left enhanced\nset key at screen %.17g,%.17g\nunset title; set label 1 '%s' left at graph 0,1.09\n"
            "set yrange [5e-18:1e%d]\n",
            box->right + 0.015, box->top + 0.015, title, highest);
    iso_plot_place(f, box);
    const int step = 1 + (highest - LOWEST) / 8;
    fprintf(f, "set ytics nomirror out scale 0.6 ('≤10^{%d}' 1e%d", LOWEST, LOWEST);
    for (int power = LOWEST + step; power <= highest; power += step) fprintf(f, ", '10^{%d}' 1e%d", power, power);
    fputs(")\n", f);
    iso_plot_ticks(f, &clock, name);
}

/* In the key: the column's symbol and its largest number. */
static void put_name(FILE *f, const char *name, double largest)
{
    char words[64], number[16];
    snprintf(number, sizeof number, "%.0e", largest); /* no decimal mark, which is the locale's */
    snprintf(words, sizeof words, "%s  %s", iso_plot_symbol(name), largest > 0 ? number : "0");
    fputs(QUOTED(words, 60), f);
}

void iso_plot_differences(FILE *f, const iso_record *r, const iso_plot_box *box, const char *title)
{
    const int columns = (int)iso_record_columns(r);
    double top = 0, largest[ISO_PLOT_DIFFERENCES + 1];
    for (int c = 1; c < columns; c++) {
        largest[c] = put_differences(f, r, c);
        top = fmax(top, largest[c]);
    }
    put_axes(f, r, top, box, title);
    for (int c = 1; c < columns; c++) {
        const char *name = iso_record_name(r, (size_t)c), *line = iso_plot_stroke(c - 1);
        fprintf(f, "%s $difference%d with ", c == 1 ? "plot" : ",", c);
        fprintf(f, iso_record_rows(r) > 1 ? "lines lw 1.5 %s title " : "points pt 7 %s title ",
                iso_record_rows(r) > 1 ? line : strstr(line, "lc"));
        put_name(f, name, largest[c]);
    }
    fputc('\n', f);
}

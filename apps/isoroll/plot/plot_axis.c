/* plot_axis.c - a panel's place on the page, and the ticks of its axes.
 *
 * gnuplot's own ticks of long times overlap ("200000400000600000"), and those of late times are all alike. Here the
 * ticks are few, and what they have in common goes into the name of the axis: "t / 10⁶", "t − 1000000".
 */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "plot/gnuplot.h"
#include "plot/plot_parts.h"

void iso_plot_place(FILE *f, const iso_plot_box *box)
{
    static const char *const side[] = {"lmargin", "rmargin", "bmargin", "tmargin"};
    const double at[] = {box->left, box->right, box->bottom, box->top};
    for (int i = 0; i < 4; i++) {
        fprintf(f, "set %s at screen %.17g%s", side[i], at[i], i < 3 ? "; " : "\n");
    }
}

/* --- decimal numbers -------------------------------------------------------------------------------------------- */

/* count * 10^power, exactly, whatever the locale. */
static void print_decimal(char text[64], long long count, int power)
{
    char digits[32];
    const int length =
        snprintf(digits, sizeof digits, "%0*lld", power < 0 ? 1 - power : 1, count < 0 ? -count : count);
    const int whole = power < 0 ? length + power : length;
    int used = snprintf(text, 64, "%s%.*s", count < 0 ? "−" : "", whole, digits);
    if (power < 0) used += snprintf(text + used, (size_t)(64 - used), ".%s", digits + whole);
    for (int i = 0; i < power && count != 0 && used < 60; i++) text[used++] = '0';
    text[used] = '\0';
}

/* "10⁻⁶" */
static void print_power(char text[64], int power)
{
    static const char *const raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    char digits[16];
    int used = snprintf(text, 64, "10%s", power < 0 ? "⁻" : "");
    snprintf(digits, sizeof digits, "%d", power < 0 ? -power : power);
    for (const char *d = digits; *d; d++) used += snprintf(text + used, (size_t)(64 - used), "%s", raised[*d - '0']);
}

/* --- ticks ------------------------------------------------------------------------------------------------------ */

enum {
    MOST_COUNT = 2000, /* ticks this many steps from 0 are counted from the first one */
    LARGE = 5,         /* from 10^5 on, and below 10^-2, a power of ten is taken out  */
    SMALL = -2
};

/* Ticks at i digit 10^power, for i = first ... last. They are written less base, over 10^taken. */
typedef struct ticks {
    long long digit, first, last, base;
    int power, taken;
} ticks;

/* About `most` ticks between low and high, at multiples of 1, 2 or 5 times a power of ten. */
static ticks choose(double low, double high, int most)
{
    ticks t = {.digit = 1};
    const double step = (high - low) / most;
    t.power = (int)floor(log10(step));
    const double part = step / pow(10, t.power);
    const double rounding = 1 + 1e-6;
    t.digit = part > 5 * rounding ? 10 : part > 2 * rounding ? 5 : part > rounding ? 2 : 1;
    if (t.digit == 10) t.digit = 1, t.power++;
    const double unit = (double)t.digit * pow(10, t.power);
    t.first = (long long)ceil(low / unit - 1e-6);
    t.last = (long long)floor(high / unit + 1e-6);
    t.base = llabs(t.first) > MOST_COUNT || llabs(t.last) > MOST_COUNT ? t.first : 0;
    const double largest = fmax(fabs((double)(t.first - t.base)), fabs((double)(t.last - t.base))) * unit;
    const int size = largest > 0 ? (int)floor(log10(largest) + 1e-9) : 0;
    t.taken = size >= LARGE || size < SMALL ? size : 0;
    return t;
}

/* "name", "name / 10⁶", "name − 1000", "(name − 1000) / 10⁻⁴". */
static void put_name(FILE *f, const ticks *t, const iso_plot_axis *axis, char text[static ISO_PLOT_NAME])
{
    char base[64], power[64];
    long long count = (t->base < 0 ? -t->base : t->base) * t->digit;
    int places = t->power;
    for (; places < 0 && count % 10 == 0; places++) count /= 10;
    print_decimal(base, count, places);
    print_power(power, t->taken);
    const bool shifted = t->base != 0, taken = t->taken != 0;
    snprintf(text, ISO_PLOT_NAME, "%s%s%s%s%s%s%s", shifted && taken ? "(" : "", axis->name,
             shifted ? (t->base < 0 ? " + " : " − ") : "", shifted ? base : "", shifted && taken ? ")" : "",
             taken ? " / " : "", taken ? power : "");
    if (!axis->label) return;
    fprintf(f, "set %slabel %s noenhanced offset %s\n", axis->which, QUOTED(text, ISO_PLOT_NAME),
            *axis->which == 'x' ? "0,0.3" : "0.5,0");
}

void iso_plot_ticks(FILE *f, const iso_plot_axis *axis, char name[static ISO_PLOT_NAME])
{
    const double size = fmax(fabs(axis->low), fabs(axis->high)), span = axis->high - axis->low;
    if (!(size < 1e300)) { /* no room for ticks beyond the range of doubles */
        fprintf(f, "set %srange [*:*]; set %stics autofreq\n", axis->which, axis->which);
        put_name(f, &(ticks){.digit = 1}, axis, name);
        return;
    }
    const double room = span > 1e-12 * size && span > DBL_MIN / DBL_EPSILON ? 0 : size > 0 ? size / 2 : 0.5;
    const double low = axis->low - room, high = axis->high + room; /* a single number gets room on both sides */
    const ticks t = choose(low, high, axis->most);
    fprintf(f, "set %srange [%.17g:%.17g]\nset %stics nomirror out scale 0.6 norotate (", axis->which, low, high,
            axis->which);
    for (long long i = t.first; i <= t.last; i++) {
        char text[64];
        print_decimal(text, (i - t.base) * t.digit, t.power - t.taken);
        fprintf(f, "%s'%s' %.17g", i == t.first ? "" : ", ", text, (double)(i * t.digit) * pow(10, t.power));
    }
    fputs(")\n", f);
    put_name(f, &t, axis, name);
}

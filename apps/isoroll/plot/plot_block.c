/* plot_block.c - the numbers and words of a table, and a table as a data block of gnuplot (see plot_parts.h). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "plot/gnuplot.h"
#include "plot/plot_parts.h"

double iso_plot_number(const iso_record *r, size_t row, const char *name)
{
    const int column = iso_record_find(r, name);
    return column < 0 ? (double)NAN : iso_record_const_row(r, row)[column];
}

bool iso_plot_is(const iso_record *r, size_t row, const char *name, const char *word)
{
    return strcmp(iso_record_word(r, iso_plot_number(r, row, name)), word) == 0;
}

int iso_plot_axis_of(const iso_record *r)
{
    const char *axis = iso_record_get(r, "axis");
    return axis && axis[0] >= '1' && axis[0] <= '3' ? axis[0] - '1' : -1;
}

void iso_plot_block(FILE *f, const char *name, const iso_record *r, const char *const columns[])
{
    fprintf(f, "set datafile missing NaN\n$%s << EOD\n", name);
    for (size_t i = 0; r && i < iso_record_rows(r); i++) {
        for (const char *const *c = columns; *c; c++) {
            const int column = iso_record_find(r, *c);
            const double x = iso_plot_number(r, i, *c);
            if (column >= 0 && iso_record_has_words(r, (size_t)column))
                fprintf(f, "%s ", QUOTED(iso_record_word(r, x), 40));
            else
                fprintf(f, isfinite(x) ? "%.17g " : "NaN ", x);
        }
        fputc('\n', f);
    }
    fputs("EOD\n", f);
}

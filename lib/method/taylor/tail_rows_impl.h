/* tail_rows_impl.h - between a series and the rows of tail_impl.h. Included behind recurrences_impl.h. */
#include "method/taylor/tail_impl.h"

/* Carries coefficients first, ..., last of the first vectors and numbers of the list, in all channels, from the series
 * into the rows (`out`), or back. */
static void carry_rows(series *S, iso_tail_rows *rows, bool out, int vectors, int numbers, int first, int last)
{
    vector *const of_vectors[] = {S->n, S->x, S->w};
    real *const of_numbers[] = {S->base, S->r, S->slope, S->v, S->v1};
    for (int c = 0; c < CHANNELS; c++)
        for (int n = first; n <= last; n++) {
            for (int r = 0; r < 3 * vectors; r++) {
                double *there = &rows->vector[r / 3][c][n][r % 3];
                if (out)
                    *there = (double)AT(of_vectors[r / 3][place(c, n)], r % 3);
                else
                    AT(of_vectors[r / 3][place(c, n)], r % 3) = *there;
            }
            for (int r = 0; r < numbers; r++) {
                double *there = &rows->number[r][c][n];
                if (out)
                    *there = (double)of_numbers[r][place(c, n)];
                else
                    of_numbers[r][place(c, n)] = *there;
            }
        }
}

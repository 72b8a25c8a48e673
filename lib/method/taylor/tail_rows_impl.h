/* tail_rows_impl.h - between a series and the rows of tail_impl.h. Included behind recurrences_impl.h. */
#include "method/taylor/tail_impl.h"

/* Coefficients first, ..., last of the first vectors and numbers of the list, in all channels. */
static void give_rows(const series *S, int vectors, int numbers, int first, int last, iso_tail_rows *rows)
{
    const vector *const of_vectors[] = {S->n, S->x, S->w};
    const real *const of_numbers[] = {S->base, S->r, S->slope, S->v, S->v1};
    for (int c = 0; c < CHANNELS; c++)
        for (int n = first; n <= last; n++) {
            for (int r = 0; r < vectors; r++)
                for (int i = 0; i < 3; i++) rows->vector[r][c][n][i] = (double)AT(of_vectors[r][place(c, n)], i);
            for (int r = 0; r < numbers; r++) rows->number[r][c][n] = (double)of_numbers[r][place(c, n)];
        }
}

static void take_rows(series *S, int vectors, int numbers, int first, int last, const iso_tail_rows *rows)
{
    vector *const of_vectors[] = {S->n, S->x, S->w};
    real *const of_numbers[] = {S->base, S->r, S->slope, S->v, S->v1};
    for (int c = 0; c < CHANNELS; c++)
        for (int n = first; n <= last; n++) {
            for (int r = 0; r < vectors; r++)
                for (int i = 0; i < 3; i++) AT(of_vectors[r][place(c, n)], i) = rows->vector[r][c][n][i];
            for (int r = 0; r < numbers; r++) of_numbers[r][place(c, n)] = rows->number[r][c][n];
        }
}

/* tail_code_impl.h - the higher coefficients in doubles: see tail_impl.h. */
#include "method/taylor/form_impl.h"
#include "method/taylor/tail_rows_impl.h"

static void *create_tail(const iso_model *model, int order)
{
    form *T = aligned_alloc(64, (sizeof *T + 63) / 64 * 64);
    if (!T) return NULL;
    set_shape(T, model, NULL, 1e-16);
    set_numbers(T, 0, model);
    T->S.order = order;
    memset(T->S.n, 0, sizeof T->S.n); /* a register of four has a number that nobody sets */
    memset(T->S.x, 0, sizeof T->S.x);
    memset(T->S.w, 0, sizeof T->S.w);
    return T;
}

static void expand_tail(void *tail, int from, iso_tail_rows *rows)
{
    form *T = tail;
    series *S = &T->S;
    carry_rows(S, rows, false, 3, 5, 0, from - 1);
    carry_rows(S, rows, false, 1, 0, from, from + 1);
    S->over_base = 1 / S->base[0];
    for (int c = 0; c < CHANNELS; c++) point_q(S, c, from);
    for (int n = from; n < S->order; n += S->together)
        for (int i = 0; i < S->terms; i++)
            for (int c = 0; c < CHANNELS; c++) S->term[i](S, c, n);
    carry_rows(S, rows, true, 1, 0, from + 2, S->order + 1);
    carry_rows(S, rows, true, 0, 1, from, S->order);
}

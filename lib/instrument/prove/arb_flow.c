/* arb_flow.c - the orbit and its neighbours as a tape, whose series are enclosed (arb_flow_impl.h, arb_tape_impl.h). */
#include <math.h>
#include <stddef.h>

#include "instrument/prove/arb_flow_impl.h"

/* --- memory ----------------------------------------------------------------------------------------------------- */

void prove_flow_init(prove_flow *f, iso_context *ctx, slong bits, iso_proof_work *work)
{
    *f = (prove_flow){.ctx = ctx, .bits = bits, .parts = 1, .work = work};
    iso_balls_init(f, offsetof(prove_flow, ctx));
}

static void forget_equations(prove_flow *f)
{
    if (f->numbers == 0) return;
    iso_series_clear(&f->series);
    iso_tape_clear(&f->tape);
}

void prove_flow_clear(prove_flow *f)
{
    forget_equations(f);
    iso_balls_clear(f, offsetof(prove_flow, ctx));
}

void prove_flow_like(prove_flow *f, const prove_flow *like, slong bits)
{
    prove_flow_init(f, like->ctx, bits, like->work);
    arb_set(f->k, like->k), arb_set(f->inverse_k, like->inverse_k), arb_set(f->trace, like->trace);
    for (int i = 0; i < 3; i++) arb_set(f->J[i], like->J[i]);
}

/* --- the equations ---------------------------------------------------------------------------------------------- */

/* The equations of arb_flow_impl.h. The states of the tape are the numbers of a state, in their order. */
static void write_equations(prove_flow *f, int numbers)
{
    iso_tape *t = &f->tape;
    int y[PROVE_STATE];
    ISO_BALLS(one, two, minus);
    ISO_BALLS(x, rest);
    arb_one(one), arb_set_si(two, 2), arb_set_si(minus, -1), arb_one(rest);
    iso_tape_init(t);
    for (int i = 0; i < numbers; i++) y[i] = iso_tape_state(t);
    const int q = y[PROVE_Q], r = y[PROVE_R], p = y[PROVE_P], d = y[PROVE_D], uu = y[PROVE_F]; /* (u, J u) */
    const int e = iso_tape_less(t, iso_tape_less(t, iso_tape_constant(t, f->trace), q), uu);
    arb_neg(x, f->inverse_k);
    const int kappa = iso_tape_quotient(t, iso_tape_scaled(t, x, p), q);
    iso_tape_rate(t, q, iso_tape_scaled(t, two, r));
    iso_tape_rate(t, r, iso_tape_sum(t, iso_tape_less(t, uu, q), iso_tape_product(t, kappa, p)));
    iso_tape_rate(t, p, iso_tape_less(t, d, iso_tape_product(t, kappa, r)));
    iso_tape_rate(t, uu, iso_tape_scaled(t, two, iso_tape_less(t, iso_tape_product(t, kappa, d), r)));
    iso_tape_rate(t, d, iso_tape_less(t, iso_tape_product(t, kappa, iso_tape_less(t, e, uu)), p));
    iso_tape_rate(t, y[PROVE_G], y[PROVE_W]);
    iso_tape_rate(t, y[PROVE_W], iso_tape_less(t, iso_tape_product(t, kappa, y[PROVE_Z]), y[PROVE_G]));
    iso_tape_rate(t, y[PROVE_Z], iso_tape_scaled(t, minus, iso_tape_product(t, kappa, y[PROVE_W])));
    if (numbers > PROVE_POINT) {
        arb_submul(rest, two, f->k, f->bits); /* 1 - 2 k */
        const int square = iso_tape_scaled(t, rest, iso_tape_product(t, kappa, kappa));
        const int excess = iso_tape_quotient(t, iso_tape_scaled(t, f->inverse_k, iso_tape_less(t, e, q)), q);
        const int H = iso_tape_sum(t, iso_tape_constant(t, one), iso_tape_sum(t, square, excess));
        const int rho = iso_tape_quotient(t, iso_tape_scaled(t, f->inverse_k, r), q);
        for (int i = PROVE_Y1; i < numbers; i += 2) {
            int rate = iso_tape_less(t, iso_tape_product(t, rho, y[i + 1]), iso_tape_product(t, H, y[i]));
            if (i == PROVE_Y3) rate = iso_tape_less(t, rate, iso_tape_scaled(t, f->inverse_k, kappa));
            iso_tape_rate(t, y[i], y[i + 1]);
            iso_tape_rate(t, y[i + 1], rate);
        }
    }
}

/* --- series ----------------------------------------------------------------------------------------------------- */

void prove_flow_expand(prove_flow *f, arb_srcptr y, int numbers)
{
    if (f->numbers != numbers) {
        forget_equations(f);
        write_equations(f, numbers);
        iso_series_init(&f->series, &f->tape, f->bits, (int)(0.33 * (double)f->bits) + 4);
        f->numbers = numbers;
    }
    iso_series_expand(&f->series, y);
}

/* p, d and z are small near O, and are known there to as many digits as the others. */
double prove_flow_guess_step(const prove_flow *f)
{
    const iso_series *s = &f->series;
    const double small =
        fmax(iso_series_size(s, PROVE_P, 0), fmax(iso_series_size(s, PROVE_D, 0), iso_series_size(s, PROVE_Z, 0)));
    double steepest = 0;
    for (int i = 0; i < f->numbers; i++) {
        const bool is_small = i == PROVE_P || i == PROVE_D || i == PROVE_Z;
        const double unit = is_small && isfinite(small) ? small : 0;
        for (int n = s->order - 1; n <= s->order; n++)
            steepest = fmax(steepest, (iso_series_size(s, i, n) - unit + (double)f->bits) / n);
    }
    return exp2(-steepest);
}

/* arb_half_return.c - from a crossing of gamma_c = 0 to the next one in the other direction, or a part of this way,
 * enclosed (arb_flow_impl.h).
 *
 * On the section, psi = 0, with J_a, J_b, J_c, t = (sin l, cos l, 0) and X = sqrt(1 - x^2):
 *
 *     gamma = (cos l, -sin l, 0),   u = -x t + X e_c,   b = -X t - x e_c,   (J gamma, t) = (J_a - J_b) sin l cos l.
 *
 * At another psi, gamma and u are turned about b by psi:
 *
 *     gamma = cos psi gamma_0 + sin psi u_0,   u = cos psi u_0 - sin psi gamma_0,   b = b_0.
 *
 * A change of (l, x) moves gamma by y along b, with y' = v:
 *
 *     y = X cos psi dl + (sin psi/X) dx,   v + kappa x dl = (cos psi/X) dx - X sin psi dl;   the other way round
 *     (X + kappa x sin psi) dl = cos psi y - sin psi v,   dx = X (sin psi y + cos psi (v + kappa x dl)).
 *
 * X sin(psi_end - psi) = sin(psi_end) u_c - cos(psi_end) gamma_c is 0 at the end; so "the end" below.
 */
#include "instrument/prove/arb_flow_impl.h"

/* --- the chart -------------------------------------------------------------------------------------------------- */

/* An angle psi: exact numbers at 0 and pi. */
typedef struct angle {
    arb_t c, s;
} angle;

static void angle_set(const prove_flow *f, int number, int parts, angle *a)
{
    fmpq_t turn;
    fmpq_init(turn);
    fmpq_set_si(turn, number, (ulong)parts);
    arb_sin_cos_pi_fmpq(a->s, a->c, turn, f->bits);
    fmpq_clear(turn);
}

/* x = a c + b s */
static void combine(const arb_t a, const arb_t c, const arb_t b, const arb_t s, slong bits, arb_t x)
{
    ISO_BALLS(first);
    arb_mul(first, a, c, bits);
    arb_mul(x, b, s, bits);
    arb_add(x, x, first, bits);
}

/* gamma and u turned about b by the angle: q, r, p, f, d, g, w. */
static void turn(const angle *by, slong bits, arb_ptr y)
{
    ISO_BALLS(minus_s, part);
    ISO_BALL_ROW(old, PROVE_POINT);
    _arb_vec_set(old, y, PROVE_POINT);
    arb_neg(minus_s, by->s);
    combine(old + PROVE_P, by->c, old + PROVE_D, by->s, bits, y + PROVE_P);
    combine(old + PROVE_D, by->c, old + PROVE_P, minus_s, bits, y + PROVE_D);
    combine(old + PROVE_G, by->c, old + PROVE_W, by->s, bits, y + PROVE_G);
    combine(old + PROVE_W, by->c, old + PROVE_G, minus_s, bits, y + PROVE_W);
    combine(old + PROVE_Q, by->c, old + PROVE_R, by->s, bits, y + PROVE_Q); /* (J gamma_0, gamma) */
    combine(old + PROVE_R, by->c, old + PROVE_F, by->s, bits, part);        /* (J u_0, gamma) */
    combine(old + PROVE_R, by->c, old + PROVE_Q, minus_s, bits, y + PROVE_R);
    combine(old + PROVE_F, by->c, old + PROVE_R, minus_s, bits, y + PROVE_F);
    combine(y + PROVE_Q, by->c, part, by->s, bits, y + PROVE_Q);
    combine(y + PROVE_R, by->c, y + PROVE_F, by->s, bits, part); /* (J u, gamma_0), (J u, u_0) */
    combine(y + PROVE_F, by->c, y + PROVE_R, minus_s, bits, y + PROVE_F);
    arb_set(y + PROVE_R, part);
}

/* The neighbours dl = 1, dx = 1 and dk = 1. */
static void begin_neighbours(const prove_flow *f, const angle *psi, const arb_t X, const arb_t x, arb_ptr y)
{
    const slong bits = f->bits;
    ISO_BALLS(kappa);
    arb_div(kappa, y + PROVE_P, y + PROVE_Q, bits);
    arb_mul(kappa, kappa, f->inverse_k, bits); /* -kappa */
    arb_mul(y + PROVE_Y1, X, psi->c, bits);
    arb_mul(y + PROVE_V1, kappa, x, bits);
    arb_submul(y + PROVE_V1, X, psi->s, bits);
    arb_div(y + PROVE_Y2, psi->s, X, bits);
    arb_div(y + PROVE_V2, psi->c, X, bits);
    arb_zero(y + PROVE_Y3), arb_zero(y + PROVE_V3);
}

static void begin_state(const prove_flow *f, const angle *psi, const arb_t l, const arb_t x, arb_ptr y)
{
    const slong bits = f->bits;
    ISO_BALLS(A, T, half, X);
    arb_mul_2exp_si(T, l, 1);
    arb_sin_cos(A, y + PROVE_Q, T, bits);
    arb_sub(half, f->J[0], f->J[1], bits);
    arb_mul_2exp_si(half, half, -1);
    arb_mul(A, A, half, bits); /* (J gamma, t) */
    arb_mul(y + PROVE_Q, y + PROVE_Q, half, bits);
    arb_add(T, f->J[0], f->J[1], bits);
    arb_mul_2exp_si(half, T, -1);
    arb_add(y + PROVE_Q, y + PROVE_Q, half, bits);
    arb_sub(T, T, y + PROVE_Q, bits); /* (J t, t) */
    arb_zero(y + PROVE_G);
    arb_neg(y + PROVE_Z, x);
    arb_mul(half, x, x, bits);
    arb_sub_ui(half, half, 1, bits);
    arb_neg(half, half);
    arb_sqrt(X, half, bits);
    arb_set(y + PROVE_W, X);
    arb_mul(y + PROVE_R, y + PROVE_Z, A, bits);
    arb_mul(y + PROVE_P, X, A, bits);
    arb_neg(y + PROVE_P, y + PROVE_P);
    arb_sub(T, T, f->J[2], bits); /* f = J_c + x^2 (T - J_c), d = x X (T - J_c) */
    arb_mul(y + PROVE_F, x, x, bits);
    arb_mul(y + PROVE_F, y + PROVE_F, T, bits);
    arb_add(y + PROVE_F, y + PROVE_F, f->J[2], bits);
    arb_mul(y + PROVE_D, x, X, bits);
    arb_mul(y + PROVE_D, y + PROVE_D, T, bits);
    if (!arb_is_zero(psi->s)) turn(psi, bits, y);
    begin_neighbours(f, psi, X, x, y);
}

/* The place (l, x) of a state: it is turned back to psi = 0, where p_0 = -X A and
 * sin 2l = -2 p_0/(X (J_a - J_b)), cos 2l = (2 q_0 - J_a - J_b)/(J_a - J_b); l in (-pi/4, 3 pi/4), near 0 to all
 * digits. */
static void end_place(const prove_flow *f, const angle *psi, arb_srcptr y, arb_t X, arb_struct z[2])
{
    const slong bits = f->bits;
    angle back;
    ISO_BALLS_OF(back);
    ISO_BALLS(s, minus_c, part);
    ISO_BALL_ROW(base, PROVE_POINT);
    _arb_vec_set(base, y, PROVE_POINT);
    arb_set(back.c, psi->c), arb_neg(back.s, psi->s);
    turn(&back, bits, base);
    arb_set(X, base + PROVE_W);
    arb_sub(part, f->J[1], f->J[0], bits);
    arb_div(s, base + PROVE_P, X, bits);
    arb_mul_2exp_si(s, s, 1);
    arb_div(s, s, part, bits);
    arb_add(minus_c, f->J[0], f->J[1], bits);
    arb_mul_2exp_si(base + PROVE_Q, base + PROVE_Q, 1);
    arb_sub(minus_c, base + PROVE_Q, minus_c, bits);
    arb_div(minus_c, minus_c, part, bits);
    if (arb_is_negative(minus_c)) {
        arb_div(part, s, minus_c, bits);
        arb_neg(part, part);
        arb_atan(z, part, bits);
    } else {
        arb_const_pi(part, bits);
        arb_mul_2exp_si(part, part, -1);
        arb_atan2(z, minus_c, s, bits); /* 2l - pi/2 */
        arb_add(z, z, part, bits);
    }
    arb_mul_2exp_si(z, z, -1);
    arb_neg(z + 1, y + PROVE_Z);
}

static void end_derivative(const prove_flow *f, const angle *psi, arb_srcptr y, const arb_t X, int numbers,
                           prove_half *half)
{
    const slong bits = f->bits;
    ISO_BALLS(kappa_x, below, v);
    arb_div(kappa_x, y + PROVE_P, y + PROVE_Q, bits);
    arb_mul(kappa_x, kappa_x, f->inverse_k, bits);
    arb_mul(kappa_x, kappa_x, y + PROVE_Z, bits); /* kappa x */
    arb_mul(below, kappa_x, psi->s, bits);
    arb_add(below, below, X, bits);
    for (int j = 0; PROVE_Y1 + 2 * j < numbers; j++) {
        const arb_srcptr neighbour = y + PROVE_Y1 + 2 * j;
        arb_ptr dl = half->D + (j < 2 ? j : 4), dx = half->D + (j < 2 ? 2 + j : 5);
        arb_mul(v, neighbour + 1, psi->s, bits);
        arb_mul(dl, neighbour, psi->c, bits);
        arb_sub(dl, dl, v, bits);
        arb_div(dl, dl, below, bits);
        arb_mul(v, kappa_x, dl, bits);
        arb_add(v, v, neighbour + 1, bits);
        combine(neighbour, psi->s, v, psi->c, bits, dx);
        arb_mul(dx, dx, X, bits);
    }
}

/* --- the crossing ----------------------------------------------------------------------------------------------- */

/* X sin(psi_end - psi) of a state. */
static void find_ahead(const angle *end, arb_srcptr y, slong bits, arb_t x)
{
    ISO_BALLS(part);
    arb_mul(part, y + PROVE_G, end->c, bits);
    arb_mul(x, y + PROVE_W, end->s, bits);
    arb_sub(x, x, part, bits);
}

/* It and its derivative at s; y: room for a state. w' = kappa z - g. */
static void find_both(prove_flow *f, const angle *end, const arb_t s, arb_ptr y, arb_t ahead, arb_t slope)
{
    iso_series_at(&f->series, s, PROVE_G, arb_is_zero(end->s) ? 2 : 3, y + PROVE_G); /* g, w, z */
    find_ahead(end, y, f->bits, ahead);
    arb_mul(slope, y + PROVE_W, end->c, f->bits);
    arb_neg(slope, slope);
    if (arb_is_zero(end->s)) return;
    iso_series_at(&f->series, s, PROVE_Q, PROVE_P + 1, y); /* q, r, p */
    arb_div(y + PROVE_P, y + PROVE_P, y + PROVE_Q, f->bits);
    arb_mul(y + PROVE_P, y + PROVE_P, f->inverse_k, f->bits); /* -kappa */
    arb_mul(y + PROVE_P, y + PROVE_P, y + PROVE_Z, f->bits);
    arb_add(y + PROVE_P, y + PROVE_P, y + PROVE_G, f->bits);
    arb_submul(slope, y + PROVE_P, end->s, f->bits);
}

/* From a point near the end, which no proof needs to be one, the interval Newton method: if s - g(s)/g'(U) lies in U,
 * where g' < 0 on U, each orbit has one zero of g in U, and it lies there. g is what find_ahead finds. */
static bool find_zero(prove_flow *f, const angle *end, const arb_t h, arb_t zero, arb_t window)
{
    ISO_BALLS(s, g, w, other);
    ISO_BALL_ROW(y, PROVE_POINT);
    arb_mul_2exp_si(s, h, -1);
    for (int i = 0; i < 60; i++) {
        find_both(f, end, s, y, g, w);
        arb_div(g, g, w, f->bits);
        arb_sub(s, s, g, f->bits);
        arb_get_mid_arb(s, s);
        if (!arb_is_finite(g) || arb_contains_zero(g)) break;
    }
    if (!(arb_is_finite(s) && arb_is_positive(s) && arb_lt(s, h))) return false;
    find_both(f, end, s, y, g, w);
    arb_div(zero, g, w, f->bits);
    mag_t size;
    mag_init(size);
    arb_get_mag(size, zero);
    mag_mul_2exp_si(size, size, 1);
    arb_set(window, s);
    arb_add_error_mag(window, size);
    mag_clear(size);
    find_both(f, end, window, y, other, w);
    arb_div(zero, g, w, f->bits);
    arb_sub(zero, s, zero, f->bits);
    return arb_is_positive(window) && arb_lt(window, h) && arb_is_negative(w) && arb_contains(window, zero);
}

/* --- steps ------------------------------------------------------------------------------------------------------ */

enum { HALVINGS = 12, SPARE_BITS = 4 };

void prove_widen(const prove_flow *f, slong part, arb_t x)
{
    mag_t more, size;
    mag_init(more), mag_init(size);
    mag_mul_2exp_si(more, arb_radref(x), -part);
    arb_get_mag(size, x);
    mag_mul_2exp_si(size, size, SPARE_BITS - f->bits);
    mag_add(more, more, size);
    arb_add_error_mag(x, more);
    arb_set_round(x, x, f->bits);
    mag_clear(more), mag_clear(size);
}

/* A step h, exact, with few bits, as long as a bound allows, and shorter where it ends in the zero; *end: the state
 * there, *crossed: beyond the zero. */
static bool go(prove_flow *f, const angle *to, int numbers, arb_t h, arb_ptr end, bool *crossed)
{
    ISO_BALLS(ahead);
    bool good = false;
    *crossed = false;
    arb_set_d(h, prove_flow_guess_step(f));
    arf_set_round(arb_midref(h), arb_midref(h), 8, ARF_RND_DOWN);
    for (int i = 0; i < HALVINGS && !good; i++) {
        if (i > 0) arb_mul_2exp_si(h, h, -1);
        good = iso_series_bound(&f->series, h);
    }
    for (int i = 0; good; i++) {
        iso_series_at(&f->series, h, 0, numbers, end);
        find_ahead(to, end, f->bits, ahead);
        *crossed = arb_is_negative(ahead);
        if (!arb_contains_zero(ahead)) return true;
        arb_mul_2exp_si(h, h, -1);
        good = i + 1 < HALVINGS && iso_series_bound(&f->series, h);
    }
    return false;
}

/* A step. *crossed: the end lies in it, and y is the state there; else y is that at the end of the step. */
static iso_status take_step(prove_flow *f, const angle *to, int numbers, arb_ptr y, prove_half *half, bool *crossed)
{
    ISO_BALLS(h, zero, window);
    ISO_BALL_ROW(end, PROVE_STATE);
    prove_flow_expand(f, y, numbers);
    f->steps++;
    if (!go(f, to, numbers, h, end, crossed) || (*crossed && !find_zero(f, to, h, zero, window)))
        return ISO_FAIL_NUMERICAL(f->ctx, "a step of the orbit could not be enclosed");
    if (*crossed) iso_series_at(&f->series, zero, 0, numbers, end);
    if (!*crossed) arb_set(zero, h);
    for (int i = 0; i < numbers; i++) {
        arb_set(y + i, end + i);
        prove_widen(f, PROVE_EIGHTH, y + i);
    }
    prove_certificate_line(f->certificate, "step", 1, h);
    if (*crossed) prove_certificate_line(f->certificate, "window", 1, window);
    if (*crossed) prove_certificate_line(f->certificate, "zero", 1, zero);
    prove_certificate_line(f->certificate, "state", numbers, y);
    arb_add(half->window, half->time, *crossed ? window : zero, ARF_PREC_EXACT);
    arb_add(half->time, half->time, zero, ARF_PREC_EXACT);
    return ISO_OK;
}

iso_status prove_half_return(prove_flow *f, prove_part part, const arb_t l, const arb_t x, int numbers,
                             prove_half *half)
{
    angle from, to;
    ISO_BALLS_OF(from);
    ISO_BALLS_OF(to);
    ISO_BALLS(X);
    ISO_BALL_ROW(y, PROVE_STATE);
    if (part.number == 0 && f->work->begun++ >= f->work->most) /* the first part counts for all of a half return */
        return ISO_FAIL_NUMERICAL(f->ctx, "it takes more than the %ld half returns of --half-returns", f->work->most);
    angle_set(f, part.number, part.parts, &from), angle_set(f, part.number + 1, part.parts, &to);
    begin_state(f, &from, l, x, y);
    for (int i = 0; i < numbers; i++) prove_widen(f, PROVE_EIGHTH, y + i);
    prove_certificate_line(f->certificate, "l", 1, l);
    prove_certificate_line(f->certificate, "x", 1, x);
    prove_certificate_line(f->certificate, "state", numbers, y);
    arb_zero(half->time);
    for (bool crossed = false; !crossed;) {
        if (!iso_context_goes_on(f->ctx)) return iso_context_stopped(f->ctx);
        ISO_TRY(take_step(f, &to, numbers, y, half, &crossed));
    }
    end_place(f, &to, y, X, half->z);
    end_derivative(f, &to, y, X, numbers, half);
    for (int i = 0; i < 2; i++) prove_widen(f, PROVE_EIGHTH, half->z + i);
    for (int i = 0; i < numbers - PROVE_POINT; i++) prove_widen(f, PROVE_EIGHTH, half->D + i);
    prove_certificate_line(f->certificate, "to", 2, half->z);
    if (numbers > PROVE_POINT) prove_certificate_line(f->certificate, "derivative", numbers - PROVE_POINT, half->D);
    return arb_is_positive(X) ? ISO_OK : ISO_FAIL_NUMERICAL(f->ctx, "a set crosses a section on both sides");
}

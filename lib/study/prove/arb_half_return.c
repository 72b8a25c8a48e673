/* arb_half_return.c - from a crossing of gamma_c = 0 to the next one in the other direction, enclosed (arb_flow_impl.h).
 *
 * On the section, with J_a, J_b, J_c, t = (sin l, cos l, 0) and X = sqrt(1 - x^2):
 *
 *     gamma = (cos l, -sin l, 0),   u = -x t + X e_c,   b = -X t - x e_c,   (J gamma, t) = (J_a - J_b) sin l cos l.
 *
 * A change of (l, x) moves gamma by y = X dl along b, with y' = v = dx/X - kappa x dl, and the other way round
 * dl = y/X, dx = X (v + kappa x dl). The antipode turns gamma, u, y, v, p, d, kappa over and leaves b, q, r, f.
 */
#include "study/prove/arb_flow_impl.h"

void prove_half_init(prove_half *h)
{
    for (int i = 0; i < 2; i++) arb_init(h->z + i);
    for (int i = 0; i < 4; i++) arb_init(h->D + i);
    arb_init(h->time), arb_init(h->window);
}

void prove_half_clear(prove_half *h)
{
    for (int i = 0; i < 2; i++) arb_clear(h->z + i);
    for (int i = 0; i < 4; i++) arb_clear(h->D + i);
    arb_clear(h->time), arb_clear(h->window);
}

/* --- the chart -------------------------------------------------------------------------------------------------- */

/* The state on the section, with the neighbours dl = 1 and dx = 1. */
static void begin_state(const prove_flow *f, const arb_t l, const arb_t x, arb_ptr y)
{
    const slong bits = f->bits;
    arb_t A, T, half;
    arb_init(A), arb_init(T), arb_init(half);
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
    arb_sqrt(y + PROVE_W, half, bits);
    arb_mul(y + PROVE_R, y + PROVE_Z, A, bits);
    arb_mul(y + PROVE_P, y + PROVE_W, A, bits);
    arb_neg(y + PROVE_P, y + PROVE_P);
    arb_sub(T, T, f->J[2], bits); /* f = J_c + x^2 (T - J_c), d = x X (T - J_c) */
    arb_mul(y + PROVE_F, x, x, bits);
    arb_mul(y + PROVE_F, y + PROVE_F, T, bits);
    arb_add(y + PROVE_F, y + PROVE_F, f->J[2], bits);
    arb_mul(y + PROVE_D, x, y + PROVE_W, bits);
    arb_mul(y + PROVE_D, y + PROVE_D, T, bits);
    arb_set(y + PROVE_Y1, y + PROVE_W);
    arb_div(A, y + PROVE_P, y + PROVE_Q, bits);
    arb_mul(A, A, f->inverse_k, bits); /* -kappa */
    arb_mul(y + PROVE_V1, A, x, bits);
    arb_zero(y + PROVE_Y2);
    arb_inv(y + PROVE_V2, y + PROVE_W, bits);
    arb_clear(A), arb_clear(T), arb_clear(half);
}

/* l in (-pi/4, 3 pi/4) from sin 2l and -cos 2l; near 0 to all digits. */
static void find_angle(const arb_t s, const arb_t minus_c, slong bits, arb_t l)
{
    arb_t part;
    arb_init(part);
    if (arb_is_negative(minus_c)) {
        arb_div(part, s, minus_c, bits);
        arb_neg(part, part);
        arb_atan(l, part, bits);
    } else {
        arb_const_pi(part, bits);
        arb_mul_2exp_si(part, part, -1);
        arb_atan2(l, minus_c, s, bits); /* 2l - pi/2 */
        arb_add(l, l, part, bits);
    }
    arb_mul_2exp_si(l, l, -1);
    arb_clear(part);
}

/* (l, x) of the antipode of a state with gamma_c = 0, u_c < 0, and the derivatives.
 * sin 2l = -2 p/(w (J_a - J_b)), cos 2l = (2 q - J_a - J_b)/(J_a - J_b); l in (-pi/4, 3 pi/4). */
static void end_chart(const prove_flow *f, arb_srcptr y, bool with_derivative, prove_half *half)
{
    const slong bits = f->bits;
    arb_t s, c, apart, kappa;
    arb_init(s), arb_init(c), arb_init(apart), arb_init(kappa);
    arb_sub(apart, f->J[1], f->J[0], bits);
    arb_div(s, y + PROVE_P, y + PROVE_W, bits);
    arb_mul_2exp_si(s, s, 1);
    arb_div(s, s, apart, bits);
    arb_add(c, f->J[0], f->J[1], bits);
    arb_mul_2exp_si(kappa, y + PROVE_Q, 1);
    arb_sub(c, kappa, c, bits);
    arb_div(c, c, apart, bits); /* -cos 2l */
    find_angle(s, c, bits, half->z);
    arb_neg(half->z + 1, y + PROVE_Z);
    arb_div(kappa, y + PROVE_P, y + PROVE_Q, bits);
    arb_mul(kappa, kappa, f->inverse_k, bits); /* that of the antipode */
    for (int j = 0; with_derivative && j < 2; j++) {
        arb_div(half->D + j, y + PROVE_Y1 + 2 * j, y + PROVE_W, bits);
        arb_mul(c, kappa, half->z + 1, bits);
        arb_mul(c, c, half->D + j, bits);
        arb_sub(c, c, y + PROVE_V1 + 2 * j, bits);
        arb_mul(half->D + 2 + j, c, y + PROVE_W, bits);
        arb_neg(half->D + 2 + j, half->D + 2 + j);
    }
    arb_clear(s), arb_clear(c), arb_clear(apart), arb_clear(kappa);
}

/* --- the crossing ----------------------------------------------------------------------------------------------- */

/* A point near the zero of gamma_c; no proof needs it to be one. */
static void guess_zero(prove_flow *f, const arb_t h, arb_t s)
{
    arb_t g, w;
    arb_init(g), arb_init(w);
    arb_mul_2exp_si(s, h, -1);
    for (int i = 0; i < 60; i++) {
        prove_series_powers(f, s);
        prove_series_value(f, PROVE_G, g);
        prove_series_value(f, PROVE_W, w);
        arb_div(g, g, w, f->bits);
        arb_sub(s, s, g, f->bits);
        arb_get_mid_arb(s, s);
        if (!arb_is_finite(g) || arb_contains_zero(g)) break;
    }
    arb_clear(g), arb_clear(w);
}

/* The interval Newton method: if s - g(s)/w(U) lies in U, where w < 0 on U, each orbit has one zero of g in U, and it
 * lies there. */
static bool find_zero(prove_flow *f, const arb_t h, arb_t zero, arb_t window)
{
    arb_t s, g, w;
    mag_t size;
    arb_init(s), arb_init(g), arb_init(w), mag_init(size);
    guess_zero(f, h, s);
    bool found = arb_is_finite(s) && arb_is_positive(s) && arb_lt(s, h);
    if (found) {
        prove_series_powers(f, s);
        prove_series_value(f, PROVE_G, g);
        prove_series_value(f, PROVE_W, w);
        arb_div(zero, g, w, f->bits);
        arb_get_mag(size, zero);
        mag_mul_2exp_si(size, size, 1);
        arb_set(window, s);
        arb_add_error_mag(window, size);
        prove_series_powers(f, window);
        prove_series_value(f, PROVE_W, w);
        arb_div(zero, g, w, f->bits);
        arb_sub(zero, s, zero, f->bits);
        found = arb_is_positive(window) && arb_lt(window, h) && arb_is_negative(w) && arb_contains(window, zero);
    }
    arb_clear(s), arb_clear(g), arb_clear(w), mag_clear(size);
    return found;
}

/* --- steps ------------------------------------------------------------------------------------------------------ */

enum { HALVINGS = 12, SPARE_BITS = 4 };

/* h is made exact, with few bits, and small enough for a bound. */
static bool choose_step(prove_flow *f, int numbers, arb_t h)
{
    arf_t length;
    arf_init(length);
    arf_set_d(length, prove_series_guess_step(f, numbers));
    arf_set_round(length, length, 8, ARF_RND_DOWN);
    bool good = false;
    for (int i = 0; i < HALVINGS && !good; i++) {
        arb_set_arf(h, length);
        good = prove_series_bound(f, h, numbers);
        arf_mul_2exp_si(length, length, -1);
    }
    arf_clear(length);
    return good;
}

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

/* A step. *crossed: the zero lies in it, and y is the state there; else y is that at its end. */
static iso_status take_step(prove_flow *f, int numbers, arb_ptr y, prove_half *half, bool *crossed)
{
    arb_t h, zero, window;
    arb_ptr end = _arb_vec_init(PROVE_STATE);
    int shorter = 0;
    arb_init(h), arb_init(zero), arb_init(window);
    prove_series_expand(f, y, numbers);
    bool good = choose_step(f, numbers, h);
    if (good) prove_series_at(f, h, numbers, end);
    while (good && arb_contains_zero(end + PROVE_G)) { /* it ends in the zero: stop before it */
        arb_mul_2exp_si(h, h, -1);
        good = ++shorter < HALVINGS && prove_series_bound(f, h, numbers);
        prove_series_at(f, h, numbers, end);
    }
    *crossed = good && arb_is_negative(end + PROVE_G);
    if (*crossed) good = find_zero(f, h, zero, window);
    if (*crossed && good) prove_series_at(f, zero, numbers, end);
    if (good && !*crossed) arb_set(zero, h);
    for (int i = 0; i < numbers; i++) {
        arb_set(y + i, end + i);
        if (good) prove_widen(f, PROVE_EIGHTH, y + i);
    }
    if (good) {
        prove_certificate_line(f->certificate, "step", 1, h);
        if (*crossed) prove_certificate_line(f->certificate, "window", 1, window);
        if (*crossed) prove_certificate_line(f->certificate, "zero", 1, zero);
        prove_certificate_line(f->certificate, "state", numbers, y);
    }
    arb_add(half->window, half->time, *crossed ? window : zero, ARF_PREC_EXACT);
    arb_add(half->time, half->time, zero, ARF_PREC_EXACT);
    f->steps++;
    _arb_vec_clear(end, PROVE_STATE);
    arb_clear(h), arb_clear(zero), arb_clear(window);
    return good ? ISO_OK : iso_context_fail(f->ctx, ISO_NUMERICAL, "", "a step of the orbit could not be enclosed");
}

iso_status prove_half_return(prove_flow *f, const arb_t l, const arb_t x, bool with_derivative, prove_half *half)
{
    const int numbers = with_derivative ? PROVE_STATE : PROVE_POINT;
    arb_ptr y = _arb_vec_init(PROVE_STATE);
    bool crossed = false;
    iso_status status = ISO_OK;
    begin_state(f, l, x, y);
    for (int i = 0; i < numbers; i++) prove_widen(f, PROVE_EIGHTH, y + i);
    prove_certificate_line(f->certificate, "l", 1, l);
    prove_certificate_line(f->certificate, "x", 1, x);
    prove_certificate_line(f->certificate, "state", numbers, y);
    arb_zero(half->time);
    while (status == ISO_OK && !crossed) {
        status = iso_context_goes_on(f->ctx) ? ISO_OK : iso_context_stopped(f->ctx);
        if (status == ISO_OK) status = take_step(f, numbers, y, half, &crossed);
    }
    if (status == ISO_OK) {
        end_chart(f, y, with_derivative, half);
        for (int i = 0; i < 2; i++) prove_widen(f, PROVE_EIGHTH, half->z + i);
        prove_certificate_line(f->certificate, "to", 2, half->z);
        for (int i = 0; with_derivative && i < 4; i++) prove_widen(f, PROVE_EIGHTH, half->D + i);
        if (with_derivative) prove_certificate_line(f->certificate, "derivative", 4, half->D);
    }
    _arb_vec_clear(y, PROVE_STATE);
    return status;
}

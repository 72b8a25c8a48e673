/* arb_equations.c - the ball (9) and the point (24), each in the clock t or s, as tapes; the map (18) in balls.
 *
 * With g = (n, J^-1 n) = 1/q, q = (gamma, J gamma), P = g^(1/(2k)), Q = q^(1/(2k)), kappa = k^2/det J:
 *
 *     J w' = (J w + K) x w + 2 c/(g P^2) n x J^-1 n + lambda n,   n' = k n x w                               (d/dt)
 *     lambda g = -((J w + K) x w + ..., J^-1 n),   tau' = P/g,   s' = kappa/(g P)
 *
 *     M' = (2 eps/k)/(q Q^2) gamma x J gamma + B gamma',   gamma' = gamma x M                                (d/ds)
 *     B = sqrt(det J)/k^2/(q Q) (J^(1/2) K, gamma),   t' = 1/(kappa q Q),   tau' = 1/(kappa Q^2)
 *
 * In the other clock all rates are multiplied by its pace, g P/kappa or kappa q Q.
 */
#include "instrument/certify/arb_certify_impl.h"

/* A tape that grows. */
typedef struct writer {
    iso_tape *f;
    const certify_ball *b;
    int vector[3], unit[3], clock[CERTIFY_CLOCKS];         /* states */
    int vector_rate[3], unit_rate[3], rate_of[ISO_CLOCKS]; /* rates, but that of its own clock */
} writer;

/* c += factor x, factor: a node */
static void add_scaled(const writer *w, int factor, const int x[3], int c[3])
{
    for (int i = 0; i < 3; i++) c[i] = iso_tape_sum(w->f, c[i], iso_tape_product(w->f, factor, x[i]));
}

/* top/(bottom nodes), top a number */
static int number_over(const writer *w, const arb_t top, int below)
{
    return iso_tape_quotient(w->f, iso_tape_constant(w->f, top), below);
}

static void write_ball(writer *w)
{
    const certify_ball *b = w->b;
    iso_tape *f = w->f;
    int u[3], L[3], torque[3], turn[3], across[3];
    ISO_BALLS(minus, twice_c);
    iso_tape_diagonal(f, b->inverse_J, w->unit, u);
    const int g = iso_tape_dot(f, w->unit, u), P = iso_tape_power(f, g, b->half), g_P = iso_tape_product(f, g, P);
    iso_tape_diagonal(f, b->J, w->vector, L);
    for (int i = 0; i < 3 && b->rotor; i++) L[i] = iso_tape_sum(f, L[i], iso_tape_constant(f, b->K + i));
    iso_tape_cross(f, L, w->vector, torque);
    if (b->level) {
        arb_mul_2exp_si(twice_c, b->c, 1);
        iso_tape_cross(f, w->unit, u, across);
        const int square = iso_tape_product(f, P, P);
        add_scaled(w, number_over(w, twice_c, iso_tape_product(f, g, square)), across, torque);
    }
    arb_set_si(minus, -1);
    add_scaled(w, iso_tape_scaled(f, minus, iso_tape_quotient(f, iso_tape_dot(f, torque, u), g)), w->unit, torque);
    iso_tape_diagonal(f, b->inverse_J, torque, w->vector_rate);
    iso_tape_cross(f, w->unit, w->vector, turn);
    for (int i = 0; i < 3; i++) w->unit_rate[i] = iso_tape_scaled(f, b->k, turn[i]);
    w->rate_of[ISO_CLOCK_TAU] = iso_tape_quotient(f, P, g);
    w->rate_of[ISO_CLOCK_S] = number_over(w, b->kappa, g_P);
}

/* B gamma', B over q Q, added to force */
static void add_field(const writer *w, int q_Q, const int turn[3], int force[3])
{
    const certify_ball *b = w->b;
    ISO_BALLS(factor, x);
    int along = -1;
    arb_sqrt(factor, b->det, b->bits);
    arb_div(factor, factor, b->k, b->bits);
    arb_div(factor, factor, b->k, b->bits);
    for (int i = 0; i < 3; i++) {
        arb_mul(x, b->root_J + i, b->K + i, b->bits);
        arb_mul(x, x, factor, b->bits);
        const int part = iso_tape_scaled(w->f, x, w->unit[i]);
        along = i == 0 ? part : iso_tape_sum(w->f, along, part);
    }
    add_scaled(w, iso_tape_quotient(w->f, along, q_Q), turn, force);
}

static void write_point(writer *w)
{
    const certify_ball *b = w->b;
    iso_tape *f = w->f;
    int u[3], across[3];
    ISO_BALLS(x);
    iso_tape_diagonal(f, b->J, w->unit, u);
    const int q = iso_tape_dot(f, w->unit, u), Q = iso_tape_power(f, q, b->half), q_Q = iso_tape_product(f, q, Q);
    iso_tape_cross(f, w->unit, u, across);
    iso_tape_cross(f, w->unit, w->vector, w->unit_rate);
    arb_div(x, b->eps, b->k, b->bits);
    arb_mul_2exp_si(x, x, 1);
    const int strength = number_over(w, x, iso_tape_product(f, q_Q, Q));
    for (int i = 0; i < 3; i++) w->vector_rate[i] = iso_tape_product(f, strength, across[i]);
    if (b->rotor) add_field(w, q_Q, w->unit_rate, w->vector_rate);
    arb_inv(x, b->kappa, b->bits);
    w->rate_of[ISO_CLOCK_T] = number_over(w, x, q_Q);
    w->rate_of[ISO_CLOCK_TAU] = number_over(w, x, iso_tape_product(f, Q, Q));
}

void certify_equations(const certify_ball *b, iso_model_kind model, iso_clock clock, iso_tape *f)
{
    const iso_clock own = model == ISO_BALL ? ISO_CLOCK_T : ISO_CLOCK_S;
    writer w = {.f = f, .b = b};
    iso_tape_init(f);
    for (int i = 0; i < 3; i++) w.vector[i] = iso_tape_state(f);
    for (int i = 0; i < 3; i++) w.unit[i] = iso_tape_state(f);
    for (int i = 0; i < CERTIFY_CLOCKS; i++) w.clock[i] = iso_tape_state(f);
    (model == ISO_BALL ? write_ball : write_point)(&w);
    if (clock != own) { /* 1/pace of that clock, and its own clock has the pace */
        ISO_BALLS(one);
        arb_one(one);
        const int pace = number_over(&w, one, w.rate_of[clock]);
        for (int i = 0; i < 3; i++)
            w.vector_rate[i] = iso_tape_product(f, w.vector_rate[i], pace),
            w.unit_rate[i] = iso_tape_product(f, w.unit_rate[i], pace);
        w.rate_of[ISO_CLOCK_TAU] = iso_tape_product(f, w.rate_of[ISO_CLOCK_TAU], pace);
        w.rate_of[own] = pace;
    }
    for (int i = 0; i < 3; i++) iso_tape_rate(f, w.vector[i], w.vector_rate[i]);
    for (int i = 0; i < 3; i++) iso_tape_rate(f, w.unit[i], w.unit_rate[i]);
    int i = 0;
    for (iso_clock c = 0; c < ISO_CLOCKS; c++)
        if (c != clock) iso_tape_rate(f, w.clock[i++], w.rate_of[c]);
}

/* --- the map ----------------------------------------------------------------------------------------------------- */

void certify_weigh(const certify_ball *b, const arb_struct weight[3], arb_srcptr u, arb_t sum)
{
    ISO_BALLS(x);
    arb_zero(sum);
    for (int i = 0; i < 3; i++) {
        arb_mul(x, u + i, u + i, b->bits);
        arb_addmul(sum, x, weight + i, b->bits);
    }
}

/* N = sqrt(det J)/k g^(1/(2k));  M = N J^(1/2) w, gamma = J^(-1/2) n/sqrt(g);  back: w = J^(-1/2) M/N,
 * n = J^(1/2) gamma/sqrt(q), g = 1/q */
void certify_map(const certify_ball *b, iso_model_kind from, arb_srcptr y, arb_ptr to)
{
    const bool ball = from == ISO_BALL;
    ISO_BALLS(g, N, root);
    certify_weigh(b, ball ? b->inverse_J : b->J, y + 3, g);
    arb_rsqrt(root, g, b->bits);
    if (!ball) arb_inv(g, g, b->bits);
    arb_pow(N, g, b->half, b->bits);
    arb_sqrt(g, b->det, b->bits);
    arb_mul(N, N, g, b->bits);
    arb_div(N, N, b->k, b->bits);
    for (int i = 0; i < 3; i++) {
        arb_mul(to + 3 + i, y + 3 + i, root, b->bits);
        if (ball) {
            arb_mul(to + i, y + i, N, b->bits);
            arb_mul(to + i, to + i, b->root_J + i, b->bits);
            arb_div(to + 3 + i, to + 3 + i, b->root_J + i, b->bits);
        } else {
            arb_div(to + i, y + i, N, b->bits);
            arb_div(to + i, to + i, b->root_J + i, b->bits);
            arb_mul(to + 3 + i, to + 3 + i, b->root_J + i, b->bits);
        }
    }
}

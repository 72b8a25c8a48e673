/* recurrences_impl.h - the equations of motion of ball and point as recurrences for Taylor coefficients.
 *
 * All series and all Jacobians are made of this statement of the equations. A model calls some of the terms below, in
 * their order, and nothing else is computed. Effects come in as formulas (model/formula/formula.h), between the terms
 * of the ball. There are two uses:
 *
 *     series      `expand` computes the coefficients of a solution, order by order
 *     Jacobians   slopes.c sets coefficients 1 of the states to a direction; coefficients 1 of the right-hand side
 *                 are then the Jacobian times this direction
 *
 * A term computes coefficient n in channel c, which is at i = place(c, n). Channel 0 is the motion, the others are
 * its deviations (products_impl.h). A linear term is the same code in all channels.
 */
#include "model/series/evaluate_impl.h"

enum { TERMS = 8, ROOM = CHANNELS * KEPT };

typedef struct series series;
typedef void recurrence(series *S, int c, int n); /* coefficient n in channel c */
typedef void written_recurrence(series *S);       /* all terms for one n, which is a constant of the compilation */

struct series {
    int order, terms, together; /* together: how many coefficients a call of the terms gives, 1 or 2 */
    recurrence *term[TERMS];
    written_recurrence *const *written; /* [n] does what the terms do; NULL: they are called one by one */
    const iso_formula *formula; /* of the effects: of the ball's motion, or of the point's image; NULL: none */
    /* what distinguishes one orbit's equations from another's */
    real c[ISO_FORMULA_CONSTANTS];
    vector J, inv_J, excess, neumann_c;  /* excess: J - min J */
    real k, D, factor, over_det, energy; /* factor: det J/k^2 */
    real alpha, coupling;                /* each form's own: see its term */
    real count[KEPT], inverse[KEPT];     /* n, 1/n */
    /* coefficients: what terms hand on, vectors, then numbers */
    vector K[ROOM], x[ROOM], z[ROOM], a[ROOM], dV[ROOM]; /* x: the torque, or the point's acceleration factors */
    real slope[ROOM];                                    /* n base[n] */
    real over_base, over_gap;                            /* 1/base[0], 1/gap[0] */
    real pole[ROOM];                                     /* of a ball, terms of 1/g: for its steps */
    real r[ROOM], lambda[ROOM], gap[ROOM], v[ROOM], v1[ROOM], V[ROOM], B[ROOM];
    /* the states, and what formulas are made of */
    union {
        struct {
            real base[ROOM], spin[ROOM]; /* base: g of a ball, q of a point */
        };
        real scalar[ISO_FORMULA_SCALARS * ROOM];
    };
    union {
        struct {
            vector w[ROOM], n[ROOM], u[ROOM], w_dot[ROOM];
        };
        vector vector[ISO_FORMULA_VECTORS * ROOM];
    };
};

static inline nodes nodes_of(series *S)
{
    return (nodes){.kept = ROOM,
                   .c = S->c,
                   .scalar = S->scalar,
                   .vector = S->vector,
                   .count = S->count,
                   .inverse = S->inverse,
                   .slope = S->slope,
                   .over_base = S->over_base,
                   .torque = S->x,
                   .gradient = S->dV,
                   .potential = S->V,
                   .magnetic = S->B};
}

/* --- the ball (9) ----------------------------------------------------------------------------------------------- */

/* u = J^-1 n, g = (n,u) */
static inline void normal(series *S, int c, int n)
{
    const int i = place(c, n);
    S->u[i] = by(S->inv_J, S->n[i]);
    S->base[i] = dot(S->n, S->u, c, n);
    S->slope[i] = S->count[n] * S->base[i];
    if (i == 0) S->over_base = 1 / S->base[0];
}

/* K = J w, n' = k n x w; no torque yet */
static inline void ball(series *S, int c, int n)
{
    const int i = place(c, n);
    normal(S, c, n);
    S->K[i] = by(S->J, S->w[i]);
    S->x[i] = nought;
    S->spin[i] = zero; /* (w,n), which formulas may read */
    S->n[i + 1] = times(S->k * S->inverse[n + 1], cross(S->n, S->w, c, n));
}

/* w' = r z, z = n x K, r = (n,K)/(g det J): see ball.c */
static inline void rigid(series *S, int c, int n)
{
    const int i = place(c, n);
    S->z[i] = cross(S->n, S->K, c, n);
    S->r[i] = quotient(S->over_det * total(by(S->excess, componentwise(S->n, S->w, c, n))), S->base, S->over_base,
                       S->r, c, n);
    S->w[i + 1] = times(S->inverse[n + 1], scaled(S->r, S->z, c, n));
}

/* the same under the torque x: + J^-1 x + lambda u, lambda = -(x,u)/g */
static inline void forced(series *S, int c, int n)
{
    const int i = place(c, n);
    rigid(S, c, n);
    S->lambda[i] = quotient(-dot(S->x, S->u, c, n), S->base, S->over_base, S->lambda, c, n);
    const vector more = plus(by(S->inv_J, S->x[i]), scaled(S->lambda, S->u, c, n));
    S->w[i + 1] = plus(S->w[i + 1], times(S->inverse[n + 1], more));
}

/* A contact that twists, in the place of `ball`: K = J w - D s n, s = (w,n), x = K x w + D s n' ... */
static inline void twisting_ball(series *S, int c, int n)
{
    const int i = place(c, n);
    normal(S, c, n);
    S->spin[i] = dot(S->w, S->n, c, n);
    S->K[i] = minus(by(S->J, S->w[i]), times(S->D, scaled(S->spin, S->n, c, n)));
    S->z[i] = times(S->k, cross(S->n, S->w, c, n));
    S->x[i] = plus(cross(S->K, S->w, c, n), times(S->D, scaled(S->spin, S->z, c, n)));
    S->n[i + 1] = times(S->inverse[n + 1], S->z[i]);
}

/* ... and w' = J^-1 x + D lambda u, lambda = (u,x)/(1 - D g), in that of `forced`. */
static inline void twisting(series *S, int c, int n)
{
    const int i = place(c, n);
    S->gap[i] = (i == 0 ? broadcast(1) : zero) - S->D * S->base[i];
    if (i == 0) S->over_gap = 1 / S->gap[0];
    S->lambda[i] = quotient(dot(S->u, S->x, c, n), S->gap, S->over_gap, S->lambda, c, n);
    S->w[i + 1] = times(S->inverse[n + 1], plus(by(S->inv_J, S->x[i]), times(S->D, scaled(S->lambda, S->u, c, n))));
}

/* r = 1/g of a rigid contact, 1/(1 - D g) of a twisting one: where they have poles, so have the ball's equations. */
static inline void poles_of_rigid(series *S, int c, int n)
{
    const int i = place(c, n);
    S->pole[i] = i == 0 ? S->over_base : quotient(zero, S->base, S->over_base, S->pole, c, n);
}

static inline void poles_of_twisting(series *S, int c, int n)
{
    const int i = place(c, n);
    S->pole[i] = i == 0 ? S->over_gap : quotient(zero, S->gap, S->over_gap, S->pole, c, n);
}

/* --- its effects ------------------------------------------------------------------------------------------------ */

/* Torques added to x, states; before the contact, which gives w'. */
static inline void effects(series *S, int c, int n)
{
    const nodes t = nodes_of(S);
    evaluate(S->formula, &t, false, c, n);
}

/* What needs w'; behind the contact. */
static inline void late_effects(series *S, int c, int n)
{
    const int i = place(c, n);
    const nodes t = nodes_of(S);
    S->w_dot[i] = times(S->count[n + 1], S->w[i + 1]);
    evaluate(S->formula, &t, true, c, n);
}

/* --- the point: n = gamma, second order ------------------------------------------------------------------------- */

/* q = (gamma, J gamma), from the squares of gamma */
static inline void set_q(series *S, int c, int n, vector squared)
{
    const int i = place(c, n);
    S->base[i] = total(by(S->J, squared));
    if (i == 0) S->over_base = 1 / S->base[0];
}

static inline void set_slope(series *S, int c, int n)
{
    S->slope[place(c, n)] = S->count[n] * S->base[place(c, n)];
}

static inline void point_q(series *S, int c, int n)
{
    set_q(S, c, n, squares(S->n, c, n));
    set_slope(S, c, n);
}

/* b^p of the base */
static inline real power_of_base(const series *S, real p, const real v[], int c, int n)
{
    return power(S->base, S->slope, S->over_base, p, v, S->count[n], S->inverse[n], c, n);
}

/* gamma'' = f */
static inline void accelerate(series *S, int c, int n, vector f)
{
    const int i = place(c, n);
    S->n[i + 2] = times(S->inverse[n + 1] * S->inverse[n + 2], f);
}

/* in s, k = -1: gamma'' = 2 a q gamma - (a J + 2 H) gamma,  a = -2 eps; neumann_c = a J + 2 H. Gives coefficients n
 * and n + 1, see pairs_impl.h. */
static inline void neumann(series *S, int c, int n)
{
    const vector_pair square = squares_pair(S->n, c, n);
    set_q(S, c, n, square.now);
    set_q(S, c, n + 1, plus(square.next, componentwise_ends(S->n, S->n, c, n + 1)));
    vector_pair pull = scaled_pair(S->base, S->n, c, n);
    pull.next = plus(pull.next, scaled_ends(S->base, S->n, c, n + 1));
    const real twice = 2 * S->coupling;
    accelerate(S, c, n, minus(times(twice, pull.now), by(S->neumann_c, S->n[place(c, n)])));
    accelerate(S, c, n + 1, minus(times(twice, pull.next), by(S->neumann_c, S->n[place(c, n + 1)])));
}

/* in s: gamma'' = c gamma by components, c_i = a (1-k) q^(alpha+1) - a q^alpha J_i - 2 H,
 * a = 2 eps/k, alpha = -1 - 1/k */
static inline void point_s(series *S, int c, int n)
{
    const int i = place(c, n);
    point_q(S, c, n);
    S->v[i] = power_of_base(S, S->alpha, S->v, c, n);
    S->v1[i] = product(S->base, S->v, c, n);
    const real falling = S->coupling * (1 - S->k) * S->v1[i] - (i == 0 ? 2 * S->energy : zero);
    for (int j = 0; j < 3; j++) AT(S->x[i], j) = falling - S->coupling * AT(S->J, j) * S->v[i];
    if (!S->formula) accelerate(S, c, n, componentwise(S->x, S->n, c, n));
}

/* The image of the effects: V, dV/dgamma and B. */
static inline void image(series *S, int c, int n)
{
    const int i = place(c, n);
    const nodes t = nodes_of(S);
    S->V[i] = S->B[i] = zero;
    S->dV[i] = nought;
    evaluate(S->formula, &t, false, c, n);
}

/* Behind point_s, with effects whose image is V: - V terms of gamma'' = -M^2 gamma - dV/dgamma + (gamma,dV/dgamma)
 * gamma, where M^2 = 2 (H - V) */
static inline void point_effects(series *S, int c, int n)
{
    const int i = place(c, n);
    image(S, c, n);
    S->r[i] = 2 * S->V[i] + dot(S->n, S->dV, c, n);
    accelerate(S, c, n, minus(plus(componentwise(S->x, S->n, c, n), scaled(S->r, S->n, c, n)), S->dV[i]));
}

/* Behind point_effects, with a magnetic field: gamma'' -= B M, M = gamma' x gamma. w = gamma', a = M. */
static inline void magnetic(series *S, int c, int n)
{
    const int i = place(c, n);
    S->w[i] = times(S->count[n + 1], S->n[i + 1]);
    S->a[i] = cross(S->w, S->n, c, n);
    const vector bent = scaled(S->B, S->a, c, n);
    S->n[i + 2] = minus(S->n[i + 2], times(S->inverse[n + 1] * S->inverse[n + 2], bent));
}

/* in t, on H = 0: x_i = B ((1-k) q^2 - q J_i), of a coefficient of q and of q^2 */
static inline vector push_of(const series *S, real q, real square)
{
    const real falling = (1 - S->k) * square;
    vector x = nought;
    for (int i = 0; i < 3; i++) AT(x, i) = S->coupling * (falling - AT(S->J, i) * q);
    return x;
}

/* r = q_t/q; divided: coefficient n of the product q r, without the terms of q_0 */
static inline void set_r(series *S, int c, int n, real divided)
{
    const int i = place(c, n);
    if (is_deviation(c)) divided += S->base[place(c, 0)] * S->r[n];
    set_slope(S, c, n + 1);
    S->r[i] = (S->slope[i + 1] - divided) * S->over_base;
}

/* gamma_tt = (1 + 1/(2k)) r gamma_t + x gamma. Gives coefficients n and n + 1, see pairs_impl.h. The second one needs
 * gamma_t = w, q and r from the first one, but only in the ends of sums. */
static inline void point_t(series *S, int c, int n)
{
    const int i = place(c, n);
    if (n == 0) point_q(S, c, 0);
    const vector_pair square = squares_pair(S->n, c, n + 1);
    set_q(S, c, n + 1, square.now);
    pair q_square = square_pair(S->base, c, n);
    q_square.next += product_ends(S->base, S->base, c, n + 1);
    S->x[i] = push_of(S, S->base[i], q_square.now);
    S->x[i + 1] = push_of(S, S->base[i + 1], q_square.next);
    vector_pair push = componentwise_pair(S->x, S->n, c, n);
    push.next = plus(push.next, componentwise_ends(S->x, S->n, c, n + 1));

    const pair divided = product_pair(S->base + 1, S->r, c, n - 1);
    set_r(S, c, n, divided.now);
    S->w[i] = times(S->count[n + 1], S->n[i + 1]);
    const vector_pair drag = scaled_pair(S->r, S->w, c, n);
    accelerate(S, c, n, plus(push.now, times(S->alpha, drag.now)));

    set_q(S, c, n + 2, plus(square.next, componentwise_ends(S->n, S->n, c, n + 2)));
    set_r(S, c, n + 1, divided.next + product_ends(S->base + 1, S->r, c, n));
    S->w[i + 1] = times(S->count[n + 2], S->n[i + 2]);
    const vector rest = scaled_ends(S->r, S->w, c, n + 1);
    accelerate(S, c, n + 1, plus(push.next, times(S->alpha, plus(drag.next, rest))));
}

/* in t, on H = 0, w = p (point_in_t.c): p' = r (p^2 c - (c,p) p),  gamma' = k r q gamma x p,  c = gamma x J gamma; r =
 * alpha, a = c. Nothing is divided by k; with 2h in the place of p^2 an error of |p| would grow as fast as the ball
 * turns. */
static inline void point_p(series *S, int c, int n)
{
    const int i = place(c, n);
    S->u[i] = by(S->J, S->n[i]);
    S->base[i] = dot(S->n, S->u, c, n);
    S->a[i] = cross(S->n, S->u, c, n);
    S->z[i] = cross(S->n, S->w, c, n);
    S->r[i] = dot(S->a, S->w, c, n);
    S->spin[i] = dot(S->w, S->w, c, n);
    const vector push = minus(scaled(S->spin, S->a, c, n), scaled(S->r, S->w, c, n));
    S->w[i + 1] = times(S->alpha * S->inverse[n + 1], push);
    S->n[i + 1] = times(S->k * S->alpha * S->inverse[n + 1], scaled(S->base, S->z, c, n));
}

/* (24) itself, w = M: M' = a q^alpha gamma x J gamma + gamma x dV/dgamma + B gamma',  gamma' = gamma x M.
 * For Jacobians: series need fewer products in the forms above. */
static inline void point_24(series *S, int c, int n)
{
    const int i = place(c, n);
    point_q(S, c, n);
    S->v[i] = power_of_base(S, S->alpha, S->v, c, n);
    S->u[i] = by(S->J, S->n[i]);
    S->z[i] = cross(S->n, S->u, c, n);
    S->w[i + 1] = times(S->coupling * S->inverse[n + 1], scaled(S->v, S->z, c, n));
    S->n[i + 1] = times(S->inverse[n + 1], cross(S->n, S->w, c, n));
}

static inline void point_24_effects(series *S, int c, int n)
{
    const int i = place(c, n);
    image(S, c, n);
    S->w[i + 1] = plus(S->w[i + 1], times(S->inverse[n + 1], cross(S->n, S->dV, c, n)));
}

/* ... + B gamma', a = gamma' */
static inline void point_24_magnetic(series *S, int c, int n)
{
    const int i = place(c, n);
    S->a[i] = times(S->count[n + 1], S->n[i + 1]);
    S->w[i + 1] = plus(S->w[i + 1], times(S->inverse[n + 1], scaled(S->B, S->a, c, n)));
}

/* Series with the same terms and order, in turns: while one waits for a result, the processor computes another. */
static inline void expand_together(series *const S[], int count)
{
    for (int n = 0; n < S[0]->order; n += S[0]->together)
        if (S[0]->written)
            for (int j = 0; j < count; j++) S[0]->written[n](S[j]);
        else
            for (int i = 0; i < S[0]->terms; i++)
                for (int j = 0; j < count; j++)
                    for (int c = 0; c < CHANNELS; c++) S[j]->term[i](S[j], c, n);
}

static inline void expand(series *S)
{
    expand_together(&S, 1);
}

/* --- what both uses set up -------------------------------------------------------------------------------------- */

/* Sets the terms, in this order; NULL stands for none. A call of each gives `together` coefficients, 1 or 2. The list
 * has room for TERMS: a longer one does not compile. */
typedef struct recurrences {
    recurrence *term[TERMS];
} recurrences;

static inline void set_recurrences(series *S, int together, recurrences list)
{
    S->terms = 0, S->together = together, S->written = NULL;
    for (int i = 0; i < TERMS; i++)
        if (list.term[i]) S->term[S->terms++] = list.term[i];
}

/* The terms of the ball. formula: of its effects, or NULL; poles: the term of its poles, or NULL. */
static inline void set_ball_recurrences(series *S, bool twists, const iso_formula *formula, recurrence *poles)
{
    const bool effective = formula && formula->lines > 0;
    S->formula = effective ? formula : NULL;
    set_recurrences(S, 1,
                    (recurrences){{
                        twists ? twisting_ball : ball,
                        effective ? effects : NULL,
                        twists                          ? twisting
                        : effective && formula->torques ? forced
                                                        : rigid,
                        effective && formula->late ? late_effects : NULL,
                        poles,
                    }});
}

/* n, 1/n */
static inline void set_counts(series *S)
{
    S->count[0] = S->inverse[0] = zero;
    for (int i = 1; i < KEPT; i++) S->count[i] = broadcast((NUMBER)i), S->inverse[i] = 1 / S->count[i];
}

/* The numbers of the ball (or of the point) in a lane, but alpha and coupling; F: its own formula, or NULL. */
static inline void set_ball(series *S, int lane, const iso_params *p, const iso_formula *F)
{
    (void)lane; /* where there is only one */
    const NUMBER k = p->k, J[3] = {p->J[0], p->J[1], p->J[2]};
    const NUMBER least = J[0] < J[1] ? J[0] < J[2] ? J[0] : J[2] : J[1] < J[2] ? J[1] : J[2];
    LANE(S->k, lane) = k;
    LANE(S->D, lane) = p->D;
    LANE(S->factor, lane) = J[0] * J[1] * J[2] / (k * k);
    LANE(S->over_det, lane) = 1 / (J[0] * J[1] * J[2]);
    for (int i = 0; i < 3; i++) {
        LANE(AT(S->J, i), lane) = J[i];
        LANE(AT(S->inv_J, i), lane) = 1 / J[i];
        LANE(AT(S->excess, i), lane) = J[i] - least;
    }
    if (F) set_constants(F, p, lane, S->c);
}

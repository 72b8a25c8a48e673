/* recurrences_impl.h - the equations of motion of ball and point as recurrences for Taylor coefficients.
 *
 * All series and all Jacobians are made of this statement of the equations. A model calls some of the terms below, in
 * their order, and nothing else is computed. Effects come in as formulas (model/formula.h), between the terms of the
 * ball. There are two uses:
 *
 *     series      `expand` computes the coefficients of a solution, order by order
 *     Jacobians   slopes.c sets coefficients 1 of the states to a direction; coefficients 1 of the right-hand side
 *                 are
 *                 then the Jacobian times this direction
 */
#include "model/series/evaluate_impl.h"

/* MOST: the highest order. */
enum { TERMS = 8, KEPT = MOST + 3 };

typedef struct series series;
typedef void recurrence(series *S, int n);

struct series {
    int order, terms;
    recurrence *term[TERMS];
    const iso_formula *formula; /* of the effects: of the ball's motion, or of the point's image; NULL: none */
    /* what distinguishes one orbit's equations from another's */
    real c[ISO_FORMULA_CONSTANTS];
    vector J, inv_J, excess, neumann_c;  /* excess: J - min J */
    real k, D, factor, over_det, energy; /* factor: det J/k^2 */
    real alpha, coupling;                /* each form's own: see its term */
    real count[KEPT], inverse[KEPT];     /* n, 1/n */
    /* coefficients: what terms hand on, vectors, then numbers */
    vector K[KEPT], x[KEPT], z[KEPT], a[KEPT], dV[KEPT]; /* x: the torque, or the point's acceleration factors */
    real slope[KEPT];                                    /* n base[n] */
    real over_base, over_gap;                            /* 1/base[0], 1/gap[0] */
    real pole[KEPT];                                     /* of a ball, terms of 1/g: for its steps */
    real r[KEPT], lambda[KEPT], gap[KEPT], v[KEPT], v1[KEPT], V[KEPT];
    /* the states, and what formulas are made of */
    union {
        struct {
            real base[KEPT], spin[KEPT]; /* base: g of a ball, q of a point */
        };
        real scalar[ISO_FORMULA_SCALARS * KEPT];
    };
    union {
        struct {
            vector w[KEPT], n[KEPT], u[KEPT], w_dot[KEPT];
        };
        vector vector[ISO_FORMULA_VECTORS * KEPT];
    };
};

static inline nodes nodes_of(series *S)
{
    return (nodes){.kept = KEPT,
                   .c = S->c,
                   .scalar = S->scalar,
                   .vector = S->vector,
                   .count = S->count,
                   .inverse = S->inverse,
                   .slope = S->slope,
                   .over_base = S->over_base,
                   .torque = S->x,
                   .gradient = S->dV,
                   .potential = S->V};
}

/* --- the ball (9) ----------------------------------------------------------------------------------------------- */

/* u = J^-1 n, g = (n,u) */
static inline void normal(series *S, int n)
{
    S->u[n] = by(S->inv_J, S->n[n]);
    S->base[n] = dot(S->n, S->u, n);
    S->slope[n] = S->count[n] * S->base[n];
    if (n == 0) S->over_base = 1 / S->base[0];
}

/* K = J w, n' = k n x w; no torque yet */
static inline void ball(series *S, int n)
{
    normal(S, n);
    S->K[n] = by(S->J, S->w[n]);
    S->x[n] = nought;
    S->spin[n] = zero; /* (w,n), which formulas may read */
    S->n[n + 1] = times(S->k * S->inverse[n + 1], cross(S->n, S->w, n));
}

/* w' = r z, z = n x K, r = (n,K)/(g det J): see ball.c */
static inline void rigid(series *S, int n)
{
    S->z[n] = cross(S->n, S->K, n);
    S->r[n] =
        quotient(S->over_det * total(by(S->excess, componentwise(S->n, S->w, n))), S->base, S->over_base, S->r, n);
    S->w[n + 1] = times(S->inverse[n + 1], scaled(S->r, S->z, n));
}

/* the same under the torque x: + J^-1 x + lambda u, lambda = -(x,u)/g */
static inline void forced(series *S, int n)
{
    rigid(S, n);
    S->lambda[n] = quotient(-dot(S->x, S->u, n), S->base, S->over_base, S->lambda, n);
    const vector more = plus(by(S->inv_J, S->x[n]), scaled(S->lambda, S->u, n));
    S->w[n + 1] = plus(S->w[n + 1], times(S->inverse[n + 1], more));
}

/* A contact that twists, in the place of `ball`: K = J w - D s n, s = (w,n), x = K x w + D s n' ... */
static inline void twisting_ball(series *S, int n)
{
    normal(S, n);
    S->spin[n] = dot(S->w, S->n, n);
    S->K[n] = minus(by(S->J, S->w[n]), times(S->D, scaled(S->spin, S->n, n)));
    S->z[n] = times(S->k, cross(S->n, S->w, n));
    S->x[n] = plus(cross(S->K, S->w, n), times(S->D, scaled(S->spin, S->z, n)));
    S->n[n + 1] = times(S->inverse[n + 1], S->z[n]);
}

/* ... and w' = J^-1 x + D lambda u, lambda = (u,x)/(1 - D g), in that of `forced`. */
static inline void twisting(series *S, int n)
{
    S->gap[n] = (n == 0 ? spread(1) : zero) - S->D * S->base[n];
    if (n == 0) S->over_gap = 1 / S->gap[0];
    S->lambda[n] = quotient(dot(S->u, S->x, n), S->gap, S->over_gap, S->lambda, n);
    S->w[n + 1] = times(S->inverse[n + 1], plus(by(S->inv_J, S->x[n]), times(S->D, scaled(S->lambda, S->u, n))));
}

/* r = 1/g of a rigid contact, 1/(1 - D g) of a twisting one: where they have poles, so have the ball's equations. */
static inline void poles_of_rigid(series *S, int n)
{
    S->pole[n] = n == 0 ? S->over_base : quotient(zero, S->base, S->over_base, S->pole, n);
}

static inline void poles_of_twisting(series *S, int n)
{
    S->pole[n] = n == 0 ? S->over_gap : quotient(zero, S->gap, S->over_gap, S->pole, n);
}

/* --- its effects ------------------------------------------------------------------------------------------------ */

/* Torques added to x, states; before the contact, which gives w'. */
static inline void effects(series *S, int n)
{
    const nodes t = nodes_of(S);
    evaluate(S->formula, &t, false, n);
}

/* What needs w'; behind the contact. */
static inline void late_effects(series *S, int n)
{
    const nodes t = nodes_of(S);
    S->w_dot[n] = times(S->count[n + 1], S->w[n + 1]);
    evaluate(S->formula, &t, true, n);
}

/* --- the point: n = gamma, second order ------------------------------------------------------------------------- */

/* q = (gamma, J gamma) */
static inline void point_q(series *S, int n)
{
    S->base[n] = total(by(S->J, squares(S->n, n)));
    S->slope[n] = S->count[n] * S->base[n];
    if (n == 0) S->over_base = 1 / S->base[0];
}

/* b^p of the base */
static inline real power_of_base(const series *S, real p, const real v[], int n)
{
    return power(S->base, S->slope, S->over_base, p, v, S->count[n], S->inverse[n], n);
}

/* gamma'' = f */
static inline void accelerate(series *S, int n, vector f)
{
    S->n[n + 2] = times(S->inverse[n + 1] * S->inverse[n + 2], f);
}

/* in s, k = -1: gamma'' = 2 a q gamma - (a J + 2 H) gamma,  a = -2 eps; neumann_c = a J + 2 H */
static inline void neumann(series *S, int n)
{
    point_q(S, n);
    accelerate(S, n, minus(times(2 * S->coupling, scaled(S->base, S->n, n)), by(S->neumann_c, S->n[n])));
}

/* in s: gamma'' = c gamma by components, c_i = a (1-k) q^(alpha+1) - a q^alpha J_i - 2 H,
 * a = 2 eps/k, alpha = -1 - 1/k */
static inline void point_s(series *S, int n)
{
    point_q(S, n);
    S->v[n] = power_of_base(S, S->alpha, S->v, n);
    S->v1[n] = product(S->base, S->v, n);
    const real falling = S->coupling * (1 - S->k) * S->v1[n] - (n == 0 ? 2 * S->energy : zero);
    for (int i = 0; i < 3; i++) AT(S->x[n], i) = falling - S->coupling * AT(S->J, i) * S->v[n];
    if (!S->formula) accelerate(S, n, componentwise(S->x, S->n, n));
}

/* Behind point_s, with effects whose image is V: - V terms of gamma'' = -M^2 gamma - dV/dgamma + (gamma,dV/dgamma)
 * gamma, where M^2 = 2 (H - V) */
static inline void point_effects(series *S, int n)
{
    const nodes t = nodes_of(S);
    S->V[n] = zero;
    S->dV[n] = nought;
    evaluate(S->formula, &t, false, n);
    S->r[n] = 2 * S->V[n] + dot(S->n, S->dV, n);
    accelerate(S, n, minus(plus(componentwise(S->x, S->n, n), scaled(S->r, S->n, n)), S->dV[n]));
}

/* in t, on H = 0: gamma_tt = (1 + 1/(2k)) r gamma_t + B ((1-k) q^2 - q J_i) gamma_i,  r = q_t/q, B = 2 h k/det J */
static inline void point_t(series *S, int n)
{
    if (n == 0) point_q(S, 0);
    point_q(S, n + 1);
    S->w[n] = times(S->count[n + 1], S->n[n + 1]);
    S->r[n] = quotient(S->slope[n + 1], S->base, S->over_base, S->r, n);
    const real falling = S->coupling * (1 - S->k) * product(S->base, S->base, n);
    for (int i = 0; i < 3; i++) AT(S->x[n], i) = falling - S->coupling * AT(S->J, i) * S->base[n];
    accelerate(S, n, plus(componentwise(S->x, S->n, n), times(S->alpha, scaled(S->r, S->w, n))));
}

/* in t, on H = 0, w = p (point_t.c): p' = r (p^2 c - (c,p) p),  gamma' = k r q gamma x p,  c = gamma x J gamma; r =
 * alpha, a = c. Nothing is divided by k; with 2h in the place of p^2 an error of |p| would grow as fast as the ball
 * turns. */
static inline void point_p(series *S, int n)
{
    S->u[n] = by(S->J, S->n[n]);
    S->base[n] = dot(S->n, S->u, n);
    S->a[n] = cross(S->n, S->u, n);
    S->z[n] = cross(S->n, S->w, n);
    S->r[n] = dot(S->a, S->w, n);
    S->spin[n] = dot(S->w, S->w, n);
    const vector push = minus(scaled(S->spin, S->a, n), scaled(S->r, S->w, n));
    S->w[n + 1] = times(S->alpha * S->inverse[n + 1], push);
    S->n[n + 1] = times(S->k * S->alpha * S->inverse[n + 1], scaled(S->base, S->z, n));
}

/* (24) itself, w = M: M' = a q^alpha gamma x J gamma + gamma x dV/dgamma,  gamma' = gamma x M. For Jacobians: series
 * need fewer products in the forms above. */
static inline void point_24(series *S, int n)
{
    point_q(S, n);
    S->v[n] = power_of_base(S, S->alpha, S->v, n);
    S->u[n] = by(S->J, S->n[n]);
    S->z[n] = cross(S->n, S->u, n);
    S->w[n + 1] = times(S->coupling * S->inverse[n + 1], scaled(S->v, S->z, n));
    S->n[n + 1] = times(S->inverse[n + 1], cross(S->n, S->w, n));
}

static inline void point_24_effects(series *S, int n)
{
    const nodes t = nodes_of(S);
    S->V[n] = zero;
    S->dV[n] = nought;
    evaluate(S->formula, &t, false, n);
    S->w[n + 1] = plus(S->w[n + 1], times(S->inverse[n + 1], cross(S->n, S->dV, n)));
}

static inline void expand(series *S)
{
    for (int n = 0; n < S->order; n++)
        for (int i = 0; i < S->terms; i++) S->term[i](S, n);
}

/* --- what both uses set up -------------------------------------------------------------------------------------- */

/* Sets the terms, in this order; NULL stands for none. The list has room for TERMS: a longer one does not compile. */
typedef struct recurrences {
    recurrence *term[TERMS];
} recurrences;

static inline void set_recurrences(series *S, recurrences list)
{
    S->terms = 0;
    for (int i = 0; i < TERMS; i++)
        if (list.term[i]) S->term[S->terms++] = list.term[i];
}

/* The terms of the ball. formula: of its effects, or NULL; poles: the term of its poles, or NULL. */
static inline void set_ball_recurrences(series *S, bool twists, const iso_formula *formula, recurrence *poles)
{
    const bool effective = formula && formula->lines > 0;
    S->formula = effective ? formula : NULL;
    set_recurrences(S, (recurrences){{
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
    for (int i = 1; i < KEPT; i++) S->count[i] = spread((NUMBER)i), S->inverse[i] = 1 / S->count[i];
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

/* taylor_kernel_impl.h - Taylor coefficients by recurrence, in the numbers of taylor_number_impl.h.
 *
 * A series is an array of coefficients, a[n] of x^n. Of an equation y' = f(y) the recurrences give coefficient n of f
 * from those up to n of y, and with it n+1 of y:
 *
 *     (a b)_n = sum_j a_j b_(n-j)                                                     Cauchy's product
 *     r = a/b:    r_n = (a_n - sum_(j>0) b_j r_(n-j))/b_0                             since b r = a
 *     v = b^p:    v_n = sum_(j>0) ((p+1) j - n) b_j v_(n-j) / (n b_0)                 since b v' = p b' v
 *
 * The equations themselves are the terms below. A model calls for some of them (taylor_form_impl.h); nothing else is
 * computed.
 */
#include "method/taylor_number_impl.h"
#include "model/system.h"

/* The highest order, that of the least tolerance, and the most terms of a model. */
enum { MOST = FINEST_ORDER, TERMS = 9 };

typedef struct series series;
typedef void recurrence(series *S, int n);

struct series {
    int order, terms;
    recurrence *term[TERMS];
    /* what distinguishes one orbit's equations from another's */
    vector J, inv_J, past, C[3], l; /* past: J - min J */
    real k, D, factor, over_det, energy, mgb, level, twist, resistance; /* factor: det J/k^2 */
    real alpha, coupling; /* each form's own: see its term */
    bool in_field;
    real count[MOST + 3], inverse[MOST + 3]; /* n, 1/n */
    /* the states */
    vector w[MOST + 3], n[MOST + 3], e[MOST + 3], Q[MOST + 3], way[MOST + 3];
    real Q0[MOST + 3];
    /* what terms hand on: vectors, then numbers */
    vector K[MOST + 2], u[MOST + 2], x[MOST + 2], c[MOST + 2], z[MOST + 2], a[MOST + 2], y[MOST + 2], b[MOST + 2];
    real base[MOST + 3], slope[MOST + 3]; /* g of a ball, q of a point; n base[n] */
    real over_base, over_gap;             /* 1/base[0], 1/gap[0] */
    real pole[MOST + 2]; /* of a ball, terms of 1/g: for its steps */
    real spin[MOST + 2], r[MOST + 2], lambda[MOST + 2], gap[MOST + 2];
    real v[MOST + 2], v1[MOST + 2], v2[MOST + 2];
    real P[MOST + 2], L[MOST + 2], qP[MOST + 2], qL[MOST + 2];
};

/* --- products: sums in two parts, which the processor adds side by side ----------------------------------------- */

static inline real product(const real a[], const real b[], int n)
{
    real even = zero, odd = zero;
    int j = 0;
    for (; j < n; j += 2) {
        even += a[j] * b[n - j];
        odd += a[j + 1] * b[n - j - 1];
    }
    return j == n ? even + odd + a[n] * b[0] : even + odd;
}

/* (a b)_n for a number a and a vector b */
static inline vector scaled(const real a[], const vector b[], int n)
{
    vector even = nought, odd = nought;
    int j = 0;
    for (; j < n; j += 2) {
        even = plus(even, times(a[j], b[n - j]));
        odd = plus(odd, times(a[j + 1], b[n - j - 1]));
    }
    if (j == n) even = plus(even, times(a[n], b[0]));
    return plus(even, odd);
}

/* the products of components, (a_i b_i)_n */
static inline vector componentwise(const vector a[], const vector b[], int n)
{
    vector even = nought, odd = nought;
    int j = 0;
    for (; j < n; j += 2) {
        even = plus(even, by(a[j], b[n - j]));
        odd = plus(odd, by(a[j + 1], b[n - j - 1]));
    }
    if (j == n) even = plus(even, by(a[n], b[0]));
    return plus(even, odd);
}

/* the squares of components: half as many products */
static inline vector squares(const vector a[], int n)
{
    vector even = nought, odd = nought;
    const int half = (n + 1) / 2;
    int j = 0;
    for (; j + 1 < half; j += 2) {
        even = plus(even, by(a[j], a[n - j]));
        odd = plus(odd, by(a[j + 1], a[n - j - 1]));
    }
    if (j < half) even = plus(even, by(a[j], a[n - j]));
    const vector sum = plus(even, odd), twice = plus(sum, sum);
    return n % 2 == 0 ? plus(twice, by(a[n / 2], a[n / 2])) : twice;
}

static inline real dot(const vector a[], const vector b[], int n)
{
    return total(componentwise(a, b, n));
}

/* (a x b)_n */
static inline vector cross(const vector a[], const vector b[], int n)
{
    vector forth = nought, back = nought;
    for (int j = 0; j <= n; j++) {
        forth = plus(forth, by(a[j], turn(b[n - j])));
        back = plus(back, by(turn(a[j]), b[n - j]));
    }
    return turn(minus(forth, back));
}

/* r_n of r = a/b; over_b = 1/b[0] */
static inline real quotient(real a_n, const real b[], real over_b, const real r[], int n)
{
    real even = zero, odd = zero;
    int j = n;
    for (; j > 1; j -= 2) { /* r[n-1], known last, comes last */
        even += b[j] * r[n - j];
        odd += b[j - 1] * r[n - j + 1];
    }
    if (j == 1) even += b[1] * r[n - 1];
    return (a_n - (even + odd)) * over_b;
}

/* v_n of v = b^p, b = base */
static inline real power(const series *S, real p, const real v[], int n)
{
    const real *b = S->base, *jb = S->slope;
    if (n == 0) return raised(b[0], p);
    real even = zero, odd = zero, plain_even = zero, plain_odd = zero;
    int j = n;
    for (; j > 1; j -= 2) { /* v[n-1], known last, comes last */
        even += jb[j] * v[n - j];
        odd += jb[j - 1] * v[n - j + 1];
        plain_even += b[j] * v[n - j];
        plain_odd += b[j - 1] * v[n - j + 1];
    }
    if (j == 1) {
        even += jb[1] * v[n - 1];
        plain_even += b[1] * v[n - 1];
    }
    return ((p + 1) * (even + odd) - S->count[n] * (plain_even + plain_odd)) * (S->inverse[n] * S->over_base);
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
static void ball(series *S, int n)
{
    normal(S, n);
    S->K[n] = by(S->J, S->w[n]);
    S->x[n] = nought;
    S->n[n + 1] = times(S->k * S->inverse[n + 1], cross(S->n, S->w, n));
}

/* w' = r z, z = n x K, r = (n,K)/(g det J): see ball.c */
static void rigid(series *S, int n)
{
    S->z[n] = cross(S->n, S->K, n);
    S->r[n] = quotient(S->over_det * total(by(S->past, componentwise(S->n, S->w, n))), S->base, S->over_base, S->r, n);
    S->w[n + 1] = times(S->inverse[n + 1], scaled(S->r, S->z, n));
}

/* the same under the torque x: + J^-1 x + lambda u, lambda = -(x,u)/g */
static void forced(series *S, int n)
{
    rigid(S, n);
    S->lambda[n] = quotient(-dot(S->x, S->u, n), S->base, S->over_base, S->lambda, n);
    const vector more = plus(by(S->inv_J, S->x[n]), scaled(S->lambda, S->u, n));
    S->w[n + 1] = plus(S->w[n + 1], times(S->inverse[n + 1], more));
}

/* A contact that twists, in the place of `ball`: K = J w - D s n, s = (w,n), x = K x w - c s n + D s n' ... */
static void twisting_ball(series *S, int n)
{
    normal(S, n);
    S->spin[n] = dot(S->w, S->n, n);
    const vector s_n = scaled(S->spin, S->n, n);
    S->K[n] = minus(by(S->J, S->w[n]), times(S->D, s_n));
    S->z[n] = times(S->k, cross(S->n, S->w, n));
    S->x[n] = plus(cross(S->K, S->w, n), minus(times(S->D, scaled(S->spin, S->z, n)), times(S->twist, s_n)));
    S->n[n + 1] = times(S->inverse[n + 1], S->z[n]);
}

/* ... and w' = J^-1 x + D lambda u, lambda = (u,x)/(1 - D g), in that of `forced`. */
static void loose(series *S, int n)
{
    S->gap[n] = (n == 0 ? spread(1) : zero) - S->D * S->base[n];
    if (n == 0) S->over_gap = 1 / S->gap[0];
    S->lambda[n] = quotient(dot(S->u, S->x, n), S->gap, S->over_gap, S->lambda, n);
    S->w[n + 1] = times(S->inverse[n + 1], plus(by(S->inv_J, S->x[n]), times(S->D, scaled(S->lambda, S->u, n))));
}

/* r = 1/g of a rigid contact, 1/(1 - D g) of a loose one: where they have poles, so have the ball's equations. */
static void poles_of_rigid(series *S, int n)
{
    S->pole[n] = n == 0 ? S->over_base : quotient(zero, S->base, S->over_base, S->pole, n);
}

static void poles_of_loose(series *S, int n)
{
    S->pole[n] = n == 0 ? S->over_gap : quotient(zero, S->gap, S->over_gap, S->pole, n);
}

/* --- its effects: torques added to x, states -------------------------------------------------------------------- */

static void gravity(series *S, int n)
{
    S->x[n] = plus(S->x[n], times(S->mgb, cross(S->e, S->n, n)));
    S->e[n + 1] = times(S->inverse[n + 1], cross(S->e, S->w, n));
}

/* C a, C the matrix of a field */
static inline vector matrix_times(const series *S, vector a)
{
    return plus(times(AT(a, 0), S->C[0]), plus(times(AT(a, 1), S->C[1]), times(AT(a, 2), S->C[2])));
}

/* k n x (C n + l) */
static void field(series *S, int n)
{
    S->c[n] = matrix_times(S, S->n[n]);
    if (n == 0) S->c[0] = plus(S->c[0], S->l);
    S->x[n] = plus(S->x[n], times(S->k, cross(S->n, S->c, n)));
}

/* 2 c g^(-1/k-1) n x u */
static void level(series *S, int n)
{
    S->v[n] = power(S, S->alpha, S->v, n);
    S->a[n] = cross(S->n, S->u, n);
    S->x[n] = plus(S->x[n], times(2 * S->level, scaled(S->v, S->a, n)));
}

static void resistance(series *S, int n)
{
    S->x[n] = minus(S->x[n], times(S->resistance, S->w[n]));
}

/* q0' = -(q,w)/2, q' = (q0 w + q x w)/2 */
static void attitude(series *S, int n)
{
    const real half = S->inverse[n + 1] / 2;
    S->Q0[n + 1] = -dot(S->Q, S->w, n) * half;
    S->Q[n + 1] = times(half, plus(scaled(S->Q0, S->w, n), cross(S->Q, S->w, n)));
}

/* x' = R (w x n) = y + 2 q0 b + 2 q x b,  y = w x n,  b = q x y */
static void roll(series *S, int n)
{
    S->y[n] = cross(S->w, S->n, n);
    S->b[n] = cross(S->Q, S->y, n);
    const vector turned = plus(scaled(S->Q0, S->b, n), cross(S->Q, S->b, n));
    S->way[n + 1] = times(S->inverse[n + 1], plus(S->y[n], plus(turned, turned)));
}

/* --- the point: n = gamma, second order ------------------------------------------------------------------------- */

/* q = (gamma, J gamma) */
static inline void point_q(series *S, int n)
{
    S->base[n] = total(by(S->J, squares(S->n, n)));
    S->slope[n] = S->count[n] * S->base[n];
    if (n == 0) S->over_base = 1 / S->base[0];
}

/* gamma'' = f */
static inline void accelerate(series *S, int n, vector f)
{
    S->n[n + 2] = times(S->inverse[n + 1] * S->inverse[n + 2], f);
}

/* in s, k = -1: gamma'' = 2 a q gamma - (a J + 2 H) gamma,  a = -2 eps; c = a J + 2 H */
static void neumann(series *S, int n)
{
    point_q(S, n);
    accelerate(S, n, minus(times(2 * S->coupling, scaled(S->base, S->n, n)), by(S->c[0], S->n[n])));
}

/* in s: gamma'' = c gamma by components, c_i = a (1-k) q^(alpha+1) - a q^alpha J_i - 2 H,
 * a = 2 eps/k, alpha = -1 - 1/k */
static void point_s(series *S, int n)
{
    point_q(S, n);
    S->v[n] = power(S, S->alpha, S->v, n);
    S->v1[n] = product(S->base, S->v, n);
    const real falling = S->coupling * (1 - S->k) * S->v1[n] - (n == 0 ? 2 * S->energy : zero);
    for (int i = 0; i < 3; i++) AT(S->c[n], i) = falling - S->coupling * AT(S->J, i) * S->v[n];
    if (!S->in_field) accelerate(S, n, componentwise(S->c, S->n, n));
}

/* With a field, V + F [q^alpha P + q^beta L], F = det J/k^2, P = (gamma,B gamma)/2, L = (m,gamma),
 * beta = alpha + 1/2:
 *     gamma'' = c gamma - F (q^alpha B gamma + q^beta m),
 *     c_i += F [ (4 + 2 alpha) q^alpha P + (3 + 2 beta) q^beta L
 *                - 2 J_i (alpha q^(alpha-1) P + beta q^(beta-1) L) ] */
static void point_field(series *S, int n)
{
    const real a = S->alpha, b = S->alpha + spread(0.5), F = S->factor;
    S->x[n] = matrix_times(S, S->n[n]);
    S->P[n] = dot(S->n, S->x, n) / 2;
    S->L[n] = total(by(S->l, S->n[n]));
    S->v2[n] = power(S, b, S->v2, n);
    S->qP[n] = product(S->v, S->P, n);
    S->qL[n] = product(S->v2, S->L, n);
    S->r[n] = quotient(a * S->qP[n] + b * S->qL[n], S->base, S->over_base, S->r, n);
    const real radial = (4 + 2 * a) * S->qP[n] + (3 + 2 * b) * S->qL[n];
    for (int i = 0; i < 3; i++) AT(S->c[n], i) += F * (radial - 2 * AT(S->J, i) * S->r[n]);
    const vector force = plus(scaled(S->v, S->x, n), times(S->v2[n], S->l));
    accelerate(S, n, minus(componentwise(S->c, S->n, n), times(F, force)));
}

/* in t, on H = 0: gamma_tt = (1 + 1/(2k)) r gamma_t + B ((1-k) q^2 - q J_i) gamma_i,  r = q_t/q, B = 2 h k/det J */
static void point_t(series *S, int n)
{
    if (n == 0) point_q(S, 0);
    point_q(S, n + 1);
    S->w[n] = times(S->count[n + 1], S->n[n + 1]);
    S->r[n] = quotient(S->slope[n + 1], S->base, S->over_base, S->r, n);
    const real falling = S->coupling * (1 - S->k) * product(S->base, S->base, n);
    for (int i = 0; i < 3; i++) AT(S->c[n], i) = falling - S->coupling * AT(S->J, i) * S->base[n];
    accelerate(S, n, plus(componentwise(S->c, S->n, n), times(S->alpha, scaled(S->r, S->w, n))));
}

/* in t, on H = 0, w = p (point_t.c): p' = r (p^2 c - (c,p) p),  gamma' = k r q gamma x p,  c = gamma x J gamma; r = alpha.
 * Nothing is divided by k; with 2h in the place of p^2 an error of |p| would grow as fast as the ball turns. */
static void point_p(series *S, int n)
{
    S->u[n] = by(S->J, S->n[n]);
    S->base[n] = dot(S->n, S->u, n);
    S->c[n] = cross(S->n, S->u, n);
    S->z[n] = cross(S->n, S->w, n);
    S->r[n] = dot(S->c, S->w, n);
    S->spin[n] = dot(S->w, S->w, n);
    const vector push = minus(scaled(S->spin, S->c, n), scaled(S->r, S->w, n));
    S->w[n + 1] = times(S->alpha * S->inverse[n + 1], push);
    S->n[n + 1] = times(S->k * S->alpha * S->inverse[n + 1], scaled(S->base, S->z, n));
}

static void expand(series *S)
{
    for (int n = 0; n < S->order; n++)
        for (int i = 0; i < S->terms; i++) S->term[i](S, n);
}

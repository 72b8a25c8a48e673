/* taylor_kernel_impl.h - Taylor coefficients by recurrence, in one kind of number.
 *
 * Included with REAL, the kind of number, ROOT, LOG and EXP of it, and NAME(x), which makes names for it. A series is
 * an array of coefficients, a[n] of x^n; vectors of R^3 are the compiler's, with a fourth number that is 0. Of an
 * equation y' = f(y) the recurrences give coefficient n of f from those up to n of y, and with it n+1 of y:
 *
 *     (a b)_n = sum_j a_j b_(n-j)                                                     Cauchy's product
 *     r = a/b:    r_n = (a_n - sum_(j>0) b_j r_(n-j))/b_0                             since b r = a
 *     v = b^p:    v_n = sum_(j>0) ((p+1) j - n) b_j v_(n-j) / (n b_0)                 since b v' = p b' v
 *
 * The equations themselves are the terms below. A model calls for some of them (taylor_method_impl.h); nothing else is
 * computed.
 */
typedef REAL NAME(vector) __attribute__((vector_size(4 * sizeof(REAL))));

typedef struct NAME(series) NAME(series);
typedef void NAME(recurrence)(NAME(series) *S, int n);

enum { NAME(TERMS) = 12 };

struct NAME(series) {
    int order, terms;
    NAME(recurrence) *term[NAME(TERMS)];
    /* what distinguishes one orbit's equations from another's */
    NAME(vector) J, inv_J, C[3], l;
    REAL k, D, factor, energy, mgb, level, twist, resistance, alpha, coupling;
    REAL rate[ISO_CLOCKS], power[ISO_CLOCKS]; /* clock' = rate base^power, base = q or g */
    bool in_field;
    int clocks;
    iso_clock clock_of[ISO_CLOCKS];
    REAL count[TAYLOR_MOST + 3], inverse[TAYLOR_MOST + 3]; /* n, 1/n */
    /* the states */
    NAME(vector) w[TAYLOR_MOST + 3], n[TAYLOR_MOST + 3], e[TAYLOR_MOST + 3], Q[TAYLOR_MOST + 3], way[TAYLOR_MOST + 3];
    REAL Q0[TAYLOR_MOST + 3], clock[ISO_CLOCKS][TAYLOR_MOST + 3];
    /* what terms hand on: vectors, then numbers */
    NAME(vector) K[TAYLOR_MOST + 2], u[TAYLOR_MOST + 2], x[TAYLOR_MOST + 2], c[TAYLOR_MOST + 2], z[TAYLOR_MOST + 2],
        a[TAYLOR_MOST + 2], y[TAYLOR_MOST + 2], b[TAYLOR_MOST + 2];
    REAL base[TAYLOR_MOST + 3], slope[TAYLOR_MOST + 3]; /* g of a ball, q of a point; n base[n] */
    REAL spin[TAYLOR_MOST + 2], r[TAYLOR_MOST + 2], lambda[TAYLOR_MOST + 2], gap[TAYLOR_MOST + 2];
    REAL v[TAYLOR_MOST + 2], v1[TAYLOR_MOST + 2], v2[TAYLOR_MOST + 2], speed[ISO_CLOCKS][TAYLOR_MOST + 2];
    REAL P[TAYLOR_MOST + 2], L[TAYLOR_MOST + 2], qP[TAYLOR_MOST + 2], qL[TAYLOR_MOST + 2];
};

/* --- products ------------------------------------------------------------------------------------------------------ */

#define ZERO {0}

static inline REAL NAME(product)(const REAL a[], const REAL b[], int n)
{
    REAL even = 0, odd = 0;
    int j = 0;
    for (; j < n; j += 2) {
        even += a[j] * b[n - j];
        odd += a[j + 1] * b[n - j - 1];
    }
    return j == n ? even + odd + a[n] * b[0] : even + odd;
}

/* (a b)_n for a number a and a vector b */
static inline NAME(vector) NAME(scaled)(const REAL a[], const NAME(vector) b[], int n)
{
    NAME(vector) even = ZERO, odd = ZERO;
    int j = 0;
    for (; j < n; j += 2) {
        even += a[j] * b[n - j];
        odd += a[j + 1] * b[n - j - 1];
    }
    if (j == n) even += a[n] * b[0];
    return even + odd;
}

/* the products of components, (a_i b_i)_n */
static inline NAME(vector) NAME(componentwise)(const NAME(vector) a[], const NAME(vector) b[], int n)
{
    NAME(vector) even = ZERO, odd = ZERO;
    int j = 0;
    for (; j < n; j += 2) {
        even += a[j] * b[n - j];
        odd += a[j + 1] * b[n - j - 1];
    }
    if (j == n) even += a[n] * b[0];
    return even + odd;
}

/* the squares of components: half as many products */
static inline NAME(vector) NAME(squares)(const NAME(vector) a[], int n)
{
    NAME(vector) even = ZERO, odd = ZERO;
    const int half = (n + 1) / 2;
    int j = 0;
    for (; j + 1 < half; j += 2) {
        even += a[j] * a[n - j];
        odd += a[j + 1] * a[n - j - 1];
    }
    if (j < half) even += a[j] * a[n - j];
    const NAME(vector) sum = 2 * (even + odd);
    return n % 2 == 0 ? sum + a[n / 2] * a[n / 2] : sum;
}

static inline REAL NAME(sum)(NAME(vector) a)
{
    return a[0] + a[1] + a[2];
}

static inline REAL NAME(dot)(const NAME(vector) a[], const NAME(vector) b[], int n)
{
    return NAME(sum)(NAME(componentwise)(a, b, n));
}

/* (a x b)_n; with T(x) = (x2, x3, x1), a x b = T(a T(b) - T(a) b) by components */
#define TURN(x) __builtin_shufflevector(x, x, 1, 2, 0, 3)

static inline NAME(vector) NAME(cross)(const NAME(vector) a[], const NAME(vector) b[], int n)
{
    NAME(vector) forth = ZERO, back = ZERO;
    for (int j = 0; j <= n; j++) {
        forth += a[j] * TURN(b[n - j]);
        back += TURN(a[j]) * b[n - j];
    }
    return TURN(forth - back);
}

/* r_n of r = a/b */
static inline REAL NAME(quotient)(REAL a_n, const REAL b[], const REAL r[], int n)
{
    REAL even = 0, odd = 0;
    int j = n;
    for (; j > 1; j -= 2) { /* r[n-1], known last, comes last */
        even += b[j] * r[n - j];
        odd += b[j - 1] * r[n - j + 1];
    }
    if (j == 1) even += b[1] * r[n - 1];
    return (a_n - (even + odd)) / b[0];
}

/* v_n of v = b^p; jb[j] = j b[j] */
static inline REAL NAME(power)(const REAL b[], const REAL jb[], REAL p, const REAL v[], const REAL inverse[], int n)
{
    if (n == 0) return EXP(p * LOG(b[0]));
    REAL even = 0, odd = 0, plain_even = 0, plain_odd = 0;
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
    return ((p + 1) * (even + odd) - n * (plain_even + plain_odd)) * (inverse[n] / b[0]);
}

/* --- the ball (9) -------------------------------------------------------------------------------------------------- */

/* x = J w x w, u = J^-1 n, g = (n,u), n' = k n x w */
static void NAME(ball)(NAME(series) *S, int n)
{
    S->u[n] = S->inv_J * S->n[n];
    S->base[n] = NAME(dot)(S->n, S->u, n);
    S->slope[n] = n * S->base[n];
    S->K[n] = S->J * S->w[n];
    S->x[n] = NAME(cross)(S->K, S->w, n);
    S->n[n + 1] = S->k * S->inverse[n + 1] * NAME(cross)(S->n, S->w, n);
}

/* w' = J^-1 x + lambda u, lambda = -(x,u)/g */
static void NAME(rigid)(NAME(series) *S, int n)
{
    S->lambda[n] = NAME(quotient)(-NAME(dot)(S->x, S->u, n), S->base, S->lambda, n);
    S->w[n + 1] = (S->inv_J * S->x[n] + NAME(scaled)(S->lambda, S->u, n)) * S->inverse[n + 1];
}

/* A contact that twists, in the place of `ball`: K = J w - D s n, s = (w,n), x = K x w - c s n + D s n' ... */
static void NAME(twisting_ball)(NAME(series) *S, int n)
{
    S->u[n] = S->inv_J * S->n[n];
    S->base[n] = NAME(dot)(S->n, S->u, n);
    S->slope[n] = n * S->base[n];
    S->spin[n] = NAME(dot)(S->w, S->n, n);
    const NAME(vector) s_n = NAME(scaled)(S->spin, S->n, n);
    S->K[n] = S->J * S->w[n] - S->D * s_n;
    S->z[n] = S->k * NAME(cross)(S->n, S->w, n);
    S->x[n] = NAME(cross)(S->K, S->w, n) + S->D * NAME(scaled)(S->spin, S->z, n) - S->twist * s_n;
    S->n[n + 1] = S->z[n] * S->inverse[n + 1];
}

/* ... and w' = J^-1 x + D lambda u, lambda = (u,x)/(1 - D g), in that of `rigid`. */
static void NAME(loose)(NAME(series) *S, int n)
{
    S->gap[n] = (n == 0) - S->D * S->base[n];
    S->lambda[n] = NAME(quotient)(NAME(dot)(S->u, S->x, n), S->gap, S->lambda, n);
    S->w[n + 1] = (S->inv_J * S->x[n] + S->D * NAME(scaled)(S->lambda, S->u, n)) * S->inverse[n + 1];
}

/* --- its effects: torques added to x, states ------------------------------------------------------------------------ */

static void NAME(gravity)(NAME(series) *S, int n)
{
    S->x[n] += S->mgb * NAME(cross)(S->e, S->n, n);
    S->e[n + 1] = S->inverse[n + 1] * NAME(cross)(S->e, S->w, n);
}

/* k n x (C n + l) */
static void NAME(field)(NAME(series) *S, int n)
{
    S->c[n] = S->C[0] * S->n[n][0] + S->C[1] * S->n[n][1] + S->C[2] * S->n[n][2];
    if (n == 0) S->c[0] += S->l;
    S->x[n] += S->k * NAME(cross)(S->n, S->c, n);
}

/* 2 c g^(-1/k-1) n x u */
static void NAME(level)(NAME(series) *S, int n)
{
    S->v[n] = NAME(power)(S->base, S->slope, S->alpha, S->v, S->inverse, n);
    S->a[n] = NAME(cross)(S->n, S->u, n);
    S->x[n] += 2 * S->level * NAME(scaled)(S->v, S->a, n);
}

static void NAME(resistance)(NAME(series) *S, int n)
{
    S->x[n] -= S->resistance * S->w[n];
}

/* q0' = -(q,w)/2, q' = (q0 w + q x w)/2 */
static void NAME(attitude)(NAME(series) *S, int n)
{
    S->Q0[n + 1] = -NAME(dot)(S->Q, S->w, n) * S->inverse[n + 1] / 2;
    S->Q[n + 1] = (NAME(scaled)(S->Q0, S->w, n) + NAME(cross)(S->Q, S->w, n)) * S->inverse[n + 1] / 2;
}

/* x' = R (w x n) = v + 2 q0 a + 2 q x a,  v = w x n,  a = q x v */
static void NAME(roll)(NAME(series) *S, int n)
{
    S->y[n] = NAME(cross)(S->w, S->n, n);
    S->b[n] = NAME(cross)(S->Q, S->y, n);
    S->way[n + 1] =
        (S->y[n] + 2 * NAME(scaled)(S->Q0, S->b, n) + 2 * NAME(cross)(S->Q, S->b, n)) * S->inverse[n + 1];
}

/* --- the point: n = gamma, second order ----------------------------------------------------------------------------- */

/* q = (gamma, J gamma) */
static void NAME(point_q)(NAME(series) *S, int n)
{
    S->base[n] = NAME(sum)(S->J * NAME(squares)(S->n, n));
    S->slope[n] = n * S->base[n];
}

/* gamma'' = c gamma, by components */
static void NAME(point_end)(NAME(series) *S, int n)
{
    S->n[n + 2] = S->inverse[n + 1] * S->inverse[n + 2] * NAME(componentwise)(S->c, S->n, n);
}

/* in s, k = -1: c_i = a (2 q - J_i) - 2 H,  a = -2 eps */
static void NAME(neumann)(NAME(series) *S, int n)
{
    NAME(point_q)(S, n);
    S->c[n] = 2 * S->coupling * S->base[n] - (NAME(vector))ZERO;
    if (n == 0) S->c[0] -= S->coupling * S->J + 2 * S->energy;
    NAME(point_end)(S, n);
}

/* in s: c_i = a (1-k) q^(alpha+1) - a q^alpha J_i - 2 H,  a = 2 eps/k, alpha = -1 - 1/k */
static void NAME(point_s)(NAME(series) *S, int n)
{
    NAME(point_q)(S, n);
    S->v[n] = NAME(power)(S->base, S->slope, S->alpha, S->v, S->inverse, n);
    S->v1[n] = NAME(product)(S->base, S->v, n);
    S->c[n] = S->coupling * ((1 - S->k) * S->v1[n] - S->J * S->v[n]);
    if (n == 0) S->c[0] -= 2 * S->energy;
    if (!S->in_field) NAME(point_end)(S, n);
}

/* With a field, V + F [q^alpha P + q^beta L], F = det J/k^2, P = (gamma,B gamma)/2, L = (m,gamma), beta = alpha + 1/2:
 *     gamma'' = c gamma - F (q^alpha B gamma + q^beta m),
 *     c_i += F [ (4 + 2 alpha) q^alpha P + (3 + 2 beta) q^beta L - 2 J_i (alpha q^(alpha-1) P + beta q^(beta-1) L) ]     */
static void NAME(point_field)(NAME(series) *S, int n)
{
    const REAL a = S->alpha, b = S->alpha + (REAL)0.5, F = S->factor;
    S->x[n] = S->C[0] * S->n[n][0] + S->C[1] * S->n[n][1] + S->C[2] * S->n[n][2];
    S->P[n] = NAME(dot)(S->n, S->x, n) / 2;
    S->L[n] = NAME(sum)(S->l * S->n[n]);
    S->v2[n] = NAME(power)(S->base, S->slope, b, S->v2, S->inverse, n);
    S->qP[n] = NAME(product)(S->v, S->P, n);
    S->qL[n] = NAME(product)(S->v2, S->L, n);
    S->r[n] = NAME(quotient)(a * S->qP[n] + b * S->qL[n], S->base, S->r, n);
    S->c[n] += F * ((4 + 2 * a) * S->qP[n] + (3 + 2 * b) * S->qL[n] - 2 * S->J * S->r[n]);
    const NAME(vector) force = NAME(scaled)(S->v, S->x, n) + S->v2[n] * S->l;
    S->n[n + 2] = S->inverse[n + 1] * S->inverse[n + 2] * (NAME(componentwise)(S->c, S->n, n) - F * force);
}

/* in t, on H = 0: gamma_tt = (1 + 1/(2k)) r gamma_t + B (( 1-k) q^2 - q J_i) gamma_i,  r = q_t/q, B = 2 h k/det J */
static void NAME(point_t)(NAME(series) *S, int n)
{
    if (n == 0) NAME(point_q)(S, 0);
    NAME(point_q)(S, n + 1);
    S->w[n] = (n + 1) * S->n[n + 1];
    S->r[n] = NAME(quotient)(S->slope[n + 1], S->base, S->r, n);
    S->v[n] = NAME(product)(S->base, S->base, n);
    S->c[n] = S->coupling * ((1 - S->k) * S->v[n] - S->J * S->base[n]);
    S->n[n + 2] = S->inverse[n + 1] * S->inverse[n + 2] *
                  (NAME(componentwise)(S->c, S->n, n) + S->alpha * NAME(scaled)(S->r, S->w, n));
}

/* --- clocks: clock' = rate base^power ------------------------------------------------------------------------------- */

static void NAME(clocks)(NAME(series) *S, int n)
{
    for (int i = 0; i < S->clocks; i++) {
        const iso_clock c = S->clock_of[i];
        S->speed[c][n] = NAME(power)(S->base, S->slope, S->power[c], S->speed[c], S->inverse, n);
        S->clock[c][n + 1] = S->rate[c] * S->speed[c][n] * S->inverse[n + 1];
    }
}

static void NAME(expand)(NAME(series) *S)
{
    for (int n = 0; n < S->order; n++)
        for (int i = 0; i < S->terms; i++) S->term[i](S, n);
}


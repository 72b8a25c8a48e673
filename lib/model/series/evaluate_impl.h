/* evaluate_impl.h - computes formulas (model/formula/formula.h) as power series, one coefficient after the other.
 *
 * The result of each line is a series. Coefficient n of it follows from coefficients 0 to n of what goes into the
 * line. The lines are computed from the first to the last: a line takes results of earlier lines only. Coefficient 0
 * is the plain value. A rate sets coefficient n + 1 of its state.
 */
#include "model/formula/formula.h"
#include "model/series/pairs_impl.h"

/* Where the coefficients are, and where results go. Coefficient n of scalar (or vector) i in channel c is at
 * [i kept + place(c, n)]. */
typedef struct nodes {
    int kept;
    const real *c; /* constants */
    real *scalar;
    vector *vector;
    const real *count, *inverse; /* n, 1/n; not read for n = 0 */
    const real *slope;           /* n times coefficient n of the base, and 1/(its coefficient 0), likewise */
    real over_base;
    vector *torque, *gradient;  /* coefficient n is added at [n] */
    real *potential, *magnetic; /* likewise: U of the ball, V of the point; B of the point */
    real *size;                 /* NULL, or: the sum of the sizes of the potential's terms, n = 0 */
} nodes;

/* The constants of one orbit, in the numbers of this compilation. */
static inline void find_constants(const iso_formula *F, const iso_params *p, NUMBER c[])
{
    for (int i = 0; i < F->constants; i++) {
        const iso_formula_line *l = &F->constant[i];
        switch (l->operation) {
        case ISO_C_K: c[i] = p->k; break;
        case ISO_C_J: c[i] = p->J[l->a]; break;
        case ISO_C_D: c[i] = p->D; break;
        case ISO_C_ADD: c[i] = c[l->a] + c[l->b]; break;
        case ISO_C_SUB: c[i] = c[l->a] - c[l->b]; break;
        case ISO_C_MUL: c[i] = c[l->a] * c[l->b]; break;
        case ISO_C_DIV: c[i] = c[l->a] / c[l->b]; break;
        case ISO_C_ROOT: c[i] = ROOT(c[l->a]); break;
        case ISO_C_POWER: c[i] = POW(c[l->a], c[l->b]); break;
        case ISO_C_EXP: c[i] = EXP(c[l->a]); break;
        case ISO_C_LOG: c[i] = LOG(c[l->a]); break;
        case ISO_C_SIN: c[i] = SIN(c[l->a]); break;
        case ISO_C_COS: c[i] = COS(c[l->a]); break;
        default: c[i] = F->value[i]; break;
        }
    }
}

/* The same into one lane. */
static inline void set_constants(const iso_formula *F, const iso_params *p, int lane, real c[])
{
    NUMBER own[ISO_FORMULA_CONSTANTS];
    (void)lane;
    find_constants(F, p, own);
    for (int i = 0; i < F->constants; i++) LANE(c[i], lane) = own[i];
}

static inline vector three(const real c[])
{
    vector v = nought;
    for (int i = 0; i < 3; i++) AT(v, i) = c[i];
    return v;
}

static inline vector matrix_times(const real M[9], vector a)
{
    vector v = nought;
    for (int i = 0; i < 3; i++) v = plus(v, times(AT(a, i), (three((const real[]){M[i], M[3 + i], M[6 + i]}))));
    return v;
}

/* sum_(j>0) ((p+1) j - n) a_j v_(n-j), in two parts, which the processor adds side by side */
static inline real sum_of_power(const nodes *t, const real a[], real p, const real v[], int n)
{
    real slopes = zero, plain = zero, other_slopes = zero, other_plain = zero;
    int j = n;
    for (; j > 1; j -= 2) {
        const real one = a[j] * v[n - j], two = a[j - 1] * v[n - j + 1];
        slopes += t->count[j] * one, plain += one;
        other_slopes += t->count[j - 1] * two, other_plain += two;
    }
    if (j == 1) slopes += a[1] * v[n - 1], plain += a[1] * v[n - 1];
    return (p + 1) * (slopes + other_slopes) - t->count[n] * (plain + other_plain);
}

/* (a^p)_n. `power` of products_impl.h is the same recurrence for the base of the ball and of the point. It is faster:
 * its caller gives n b_n and 1/b_0. So the two round differently. */
static inline real power_of_series(const nodes *t, const real a[], real p, const real v[], int c, int n)
{
    if (n == 0 && !is_deviation(c)) return raised(a[0], p);
    if (a == t->scalar + ISO_GIVEN_BASE * t->kept)
        return power(a, t->slope, t->over_base, p, v, t->count[n], t->inverse[n], c, n);
    const real *da = a + place(c, 0), *dv = v + place(c, 0);
    if (n == 0) return p * v[0] * da[0] / a[0];
    if (!is_deviation(c)) return sum_of_power(t, a, p, v, n) * (t->inverse[n] / a[0]);
    const real of_da = sum_of_power(t, da, p, v, n) - t->count[n] * da[0] * v[n];
    return (sum_of_power(t, a, p, dv, n) + of_da) * (t->inverse[n] / a[0]);
}

/* The functions of a[0] that a series begins with, lane by lane. */
static inline real function_of(iso_operation operation, real a)
{
    for (int i = 0; i < LANES; i++) {
        const NUMBER x = LANE(a, i);
        LANE(a, i) = operation == ISO_S_EXP   ? EXP(x)
                     : operation == ISO_S_LOG ? LOG(x)
                     : operation == ISO_S_SIN ? SIN(x)
                                              : COS(x);
    }
    return a;
}

/* sum_(j>0) j a_j b_(n-j), over n: coefficient n of the integral of a' b */
static inline real integral_of(const nodes *t, const real a[], const real b[], int n)
{
    real even = zero, odd = zero;
    int j = n;
    for (; j > 1; j -= 2) {
        even += t->count[j] * a[j] * b[n - j];
        odd += t->count[j - 1] * a[j - 1] * b[n - j + 1];
    }
    if (j == 1) even += a[1] * b[n - 1];
    return t->inverse[n] * (even + odd);
}

/* v = exp a:  v' = a' v,  dv = v da */
static inline real exp_of_series(const nodes *t, const real a[], const real v[], int c, int n)
{
    if (is_deviation(c)) return product_of(v, a + place(c, 0), n);
    return n == 0 ? function_of(ISO_S_EXP, a[0]) : integral_of(t, a, v, n);
}

/* v = log a:  a v' = a',  a dv = da */
static inline real log_of_series(const nodes *t, const real a[], const real v[], int c, int n)
{
    if (is_deviation(c)) return (a[place(c, n)] - known_part(a, v + place(c, 0), n)) / a[0];
    if (n == 0) return function_of(ISO_S_LOG, a[0]);
    real sum = zero;
    for (int j = n - 1; j > 0; j--) sum += t->count[j] * v[j] * a[n - j];
    return (a[n] - t->inverse[n] * sum) / a[0];
}

/* v = sin a or cos a, w the other one:  v' = a' w or -a' w,  dv = w da or -w da */
static inline real circle_of_series(const nodes *t, iso_operation operation, const real a[], const real w[], int c,
                                    int n)
{
    if (n == 0 && !is_deviation(c)) return function_of(operation, a[0]);
    const real slope = is_deviation(c) ? product_of(w, a + place(c, 0), n) : integral_of(t, a, w, n);
    return operation == ISO_S_SIN ? slope : -slope;
}

static inline real scalar_line(const iso_formula_line *l, const nodes *t, int c, int n)
{
    const int i = place(c, n);
    const real *a = t->scalar + l->a * t->kept, *b = t->scalar + l->b * t->kept, *own = t->scalar + l->to * t->kept;
    const real *with = t->scalar + l->b * t->kept; /* of ISO_S_TIMES and ISO_S_PLUS, whose a is a constant */
    switch (l->operation) {
    case ISO_S_ADD: return a[i] + b[i];
    case ISO_S_SUB: return a[i] - b[i];
    case ISO_S_MUL: return product(a, b, c, n);
    case ISO_S_DIV: return quotient(a[i], b, 1 / b[0], own, c, n);
    case ISO_S_TIMES: return t->c[l->a] * with[i];
    case ISO_S_PLUS: return i == 0 ? t->c[l->a] + with[0] : with[i];
    case ISO_S_POWER: return power_of_series(t, a, t->c[l->b], own, c, n);
    case ISO_S_EXP: return exp_of_series(t, a, own, c, n);
    case ISO_S_LOG: return log_of_series(t, a, own, c, n);
    case ISO_S_SIN:
    case ISO_S_COS: return circle_of_series(t, (iso_operation)l->operation, a, b, c, n);
    case ISO_S_DOT: return dot(t->vector + l->a * t->kept, t->vector + l->b * t->kept, c, n);
    default: return total(by(three(t->c + l->a), t->vector[l->b * t->kept + i])); /* ISO_S_DOT_C */
    }
}

static inline vector vector_line(const iso_formula_line *l, const nodes *t, int c, int n)
{
    const int i = place(c, n);
    const vector *a = t->vector + l->a * t->kept, *b = t->vector + l->b * t->kept;
    switch (l->operation) {
    case ISO_V_ADD: return plus(a[i], b[i]);
    case ISO_V_SUB: return minus(a[i], b[i]);
    case ISO_V_TIMES: return times(t->c[l->a], b[i]);
    case ISO_V_SCALE: return scaled(t->scalar + l->a * t->kept, b, c, n);
    case ISO_V_SCALE_C: return times(t->scalar[l->b * t->kept + i], three(t->c + l->a));
    case ISO_V_CROSS: return cross(a, b, c, n);
    case ISO_V_BY: return by(three(t->c + l->a), b[i]);
    case ISO_V_MATRIX: return matrix_times(t->c + l->a, b[i]);
    default: return i == 0 ? plus(three(t->c + l->a), b[0]) : b[i]; /* ISO_V_PLUS */
    }
}

static inline void add_to_potential(const nodes *t, real x, int i)
{
    t->potential[i] += x;
    if (t->size) *t->size += magnitude(x);
}

static inline void result_line(const iso_formula_line *l, const nodes *t, int c, int n)
{
    const int i = place(c, n);
    const real factor = t->c[l->a];
    switch (l->operation) {
    case ISO_R_TORQUE: t->torque[i] = plus(t->torque[i], times(factor, t->vector[l->b * t->kept + i])); break;
    case ISO_R_GRADIENT: t->gradient[i] = plus(t->gradient[i], times(factor, t->vector[l->b * t->kept + i])); break;
    case ISO_R_VECTOR_RATE:
        t->vector[l->to * t->kept + i + 1] = times(factor * t->inverse[n + 1], t->vector[l->b * t->kept + i]);
        break;
    case ISO_R_SCALAR_RATE:
        t->scalar[l->to * t->kept + i + 1] = factor * t->inverse[n + 1] * t->scalar[l->b * t->kept + i];
        break;
    case ISO_R_ENERGY:
    case ISO_R_POTENTIAL: add_to_potential(t, factor * t->scalar[l->b * t->kept + i], i); break;
    default: t->magnetic[i] += factor * t->scalar[l->b * t->kept + i]; break; /* ISO_R_MAGNETIC */
    }
}

/* Coefficient n in channel c: of the late lines if `late`, of all others if not. */
static inline void evaluate(const iso_formula *F, const nodes *t, bool late, int c, int n)
{
    const int i = place(c, n);
    for (int j = 0; j < F->lines; j++) {
        const iso_formula_line *l = &F->line[j];
        if (F->late_line[j] != late) continue;
        if (l->operation < ISO_V_ADD)
            t->scalar[l->to * t->kept + i] = scalar_line(l, t, c, n);
        else if (l->operation < ISO_R_TORQUE)
            t->vector[l->to * t->kept + i] = vector_line(l, t, c, n);
        else
            result_line(l, t, c, n);
    }
}

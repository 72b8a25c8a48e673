/* products_impl.h - products, quotients and powers of power series, coefficient by coefficient.
 *
 * A series is an array of coefficients, a[n] of x^n. Of an equation y' = f(y) the recurrences give coefficient n of f
 * from those up to n of y, and with it n+1 of y:
 *
 *     (a b)_n = sum_j a_j b_(n-j)                                                     Cauchy's product
 *     r = a/b:    r_n = (a_n - sum_(j>0) b_j r_(n-j))/b_0                             since b r = a
 *     v = b^p:    v_n = sum_(j>0) ((p+1) j - n) b_j v_(n-j) / (n b_0)                 since b v' = p b' v
 *
 * If CHANNELS > 1, first-order variations are computed beside the motion. Channel 0 of a series is the motion. The
 * other channels are deviations: the changes of the series, to first order, when the start of the orbit is changed.
 * Channel c begins at [c KEPT]. Each operation below is differentiated by the product rule:
 *
 *     d(a b) = a db + da b,     b dr + db r = da,     b dv' + db v' = p (b' dv + db' v)
 */
#include "model/series/number_impl.h"

/* --- coefficient n of a product: sums in two parts, which the processor adds side by side
 * ------------------------ */

static inline real product_of(const real a[], const real b[], int n)
{
    real even = zero, odd = zero;
    int j = 0;
    for (; j < n; j += 2) {
        even += a[j] * b[n - j];
        odd += a[j + 1] * b[n - j - 1];
    }
    return j == n ? even + odd + a[n] * b[0] : even + odd;
}

/* for a number a and a vector b */
static inline vector scaled_by(const real a[], const vector b[], int n)
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

/* the products of components */
static inline vector components_of(const vector a[], const vector b[], int n)
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
static inline vector squares_of(const vector a[], int n)
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

/* a x b */
static inline vector cross_of(const vector a[], const vector b[], int n)
{
    vector forth = nought, back = nought;
    for (int j = 0; j <= n; j++) {
        forth = plus(forth, by(a[j], turn(b[n - j])));
        back = plus(back, by(turn(a[j]), b[n - j]));
    }
    return turn(minus(forth, back));
}

/* --- in a channel
 * ------------------------------------------------------------------------------------------------ */

/* The place of coefficient n in channel c. */
static inline int place(int c, int n)
{
    return CHANNELS > 1 ? c * KEPT + n : n;
}

static inline bool is_deviation(int c)
{
    return CHANNELS > 1 && c > 0;
}

static inline real product(const real a[], const real b[], int c, int n)
{
    if (!is_deviation(c)) return product_of(a, b, n);
    return product_of(a, b + place(c, 0), n) + product_of(a + place(c, 0), b, n);
}

static inline vector scaled(const real a[], const vector b[], int c, int n)
{
    if (!is_deviation(c)) return scaled_by(a, b, n);
    return plus(scaled_by(a, b + place(c, 0), n), scaled_by(a + place(c, 0), b, n));
}

static inline vector componentwise(const vector a[], const vector b[], int c, int n)
{
    if (!is_deviation(c)) return components_of(a, b, n);
    return plus(components_of(a, b + place(c, 0), n), components_of(a + place(c, 0), b, n));
}

static inline vector squares(const vector a[], int c, int n)
{
    if (!is_deviation(c)) return squares_of(a, n);
    const vector half = components_of(a, a + place(c, 0), n);
    return plus(half, half);
}

static inline real dot(const vector a[], const vector b[], int c, int n)
{
    return total(componentwise(a, b, c, n));
}

static inline vector cross(const vector a[], const vector b[], int c, int n)
{
    if (!is_deviation(c)) return cross_of(a, b, n);
    return plus(cross_of(a, b + place(c, 0), n), cross_of(a + place(c, 0), b, n));
}

/* sum_(j>0) b_j r_(n-j) */
static inline real known_part(const real b[], const real r[], int n)
{
    real even = zero, odd = zero;
    int j = n;
    for (; j > 1; j -= 2) { /* r[n-1], known last, comes last */
        even += b[j] * r[n - j];
        odd += b[j - 1] * r[n - j + 1];
    }
    if (j == 1) even += b[1] * r[n - 1];
    return even + odd;
}

/* r_n of r = a/b; a_n is that of the channel, over_b = 1/b[0] */
static inline real quotient(real a_n, const real b[], real over_b, const real r[], int c, int n)
{
    if (!is_deviation(c)) return (a_n - known_part(b, r, n)) * over_b;
    const real *db = b + place(c, 0), *dr = r + place(c, 0);
    return (a_n - known_part(b, dr, n) - product_of(db, r, n)) * over_b;
}

/* sum_(j>0) ((p+1) j - n) b_j v_(n-j); jb: n b_n; count: n */
static inline real power_sum(const real b[], const real jb[], real p, const real v[], real count, int n)
{
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
    return (p + 1) * (even + odd) - count * (plain_even + plain_odd);
}

/* v_n of v = b^p; jb: n b_n; over_b = 1/b[0]; count: n, over_n = 1/n */
static inline real power(const real b[], const real jb[], real over_b, real p, const real v[], real count,
                         real over_n, int c, int n)
{
    const real *db = b + place(c, 0), *dv = v + place(c, 0);
    if (!is_deviation(c)) return n == 0 ? raised(b[0], p) : power_sum(b, jb, p, v, count, n) * (over_n * over_b);
    if (n == 0) return p * v[0] * db[0] * over_b;
    const real of_db = power_sum(db, jb + place(c, 0), p, v, count, n) - count * db[0] * v[n];
    return (power_sum(b, jb, p, dv, count, n) + of_db) * (over_n * over_b);
}

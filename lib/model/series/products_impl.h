/* products_impl.h - products, quotients and powers of power series, coefficient by coefficient.
 *
 * A series is an array of coefficients, a[n] of x^n. Of an equation y' = f(y) the recurrences give coefficient n of f
 * from those up to n of y, and with it n+1 of y:
 *
 *     (a b)_n = sum_j a_j b_(n-j)                                                     Cauchy's product
 *     r = a/b:    r_n = (a_n - sum_(j>0) b_j r_(n-j))/b_0                             since b r = a
 *     v = b^p:    v_n = sum_(j>0) ((p+1) j - n) b_j v_(n-j) / (n b_0)                 since b v' = p b' v
 */
#include "model/series/number_impl.h"

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

/* v_n of v = b^p; jb: n b_n; over_b = 1/b[0]; count: n, over_n = 1/n */
static inline real power(const real b[], const real jb[], real over_b, real p, const real v[], real count,
                         real over_n, int n)
{
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
    return ((p + 1) * (even + odd) - count * (plain_even + plain_odd)) * (over_n * over_b);
}

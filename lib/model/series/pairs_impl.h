/* pairs_impl.h - coefficients n and n + 1 of a product together.
 *
 * A second-order equation a'' = f(a) gives coefficients n + 2 and n + 3 of a from n and n + 1 of f, which need those
 * up to n + 1 of a. So the sums of two coefficients run side by side: each number that is loaded serves both, and the
 * processor adds both at a time. One by one they take 1.2 to 1.5 times as long.
 *
 * The pair's `next` is (a b)_(n+1) without its end terms a_0 b_(n+1) and a_(n+1) b_0, which are added later, when
 * b_(n+1) and a_(n+1) are known.
 * Deviations as in products_impl.h: d(a b) = a db + da b.
 */
#include "model/series/products_impl.h"

typedef struct pair {
    real now, next;
} pair;

typedef struct vector_pair {
    vector now, next;
} vector_pair;

/* a, in a register: two sums need it, and gcc likes to load it for each. */
static inline real held(real a)
{
#if LANES > 1 && defined __x86_64__ && !defined __clang__
    __asm__("" : "+v"(a));
#endif
    return a;
}

static inline vector held_vector(vector a)
{
    for (int i = 0; i < 3; i++) AT(a, i) = held(AT(a, i));
    return a;
}

/* --- of one channel --------------------------------------------------------------------------------------------- */

/* Numbers of a stand a_step apart, those of b b_step: 1, or 3 for a component of vectors. n = -1: both sums are 0 */
static inline pair spaced_pair_of(const real *a, int a_step, const real *b, int b_step, int n)
{
    pair s = {zero, zero};
    for (int j = 0; j < n; j++) {
        const real last = held(b[b_step * (n - j)]);
        s.now += a[a_step * j] * last;
        s.next += a[a_step * (j + 1)] * last;
    }
    if (n >= 0) s.now += a[a_step * n] * b[0];
    return s;
}

static inline pair product_pair_of(const real a[], const real b[], int n)
{
    return spaced_pair_of(a, 1, b, 1, n);
}

#ifdef APART

static inline vector_pair scaled_pair_of(const real a[], const vector b[], int n)
{
    vector_pair s;
    for (int i = 0; i < 3; i++) {
        const pair p = spaced_pair_of(a, 1, &b->at[i], 3, n);
        s.now.at[i] = p.now, s.next.at[i] = p.next;
    }
    return s;
}

static inline vector_pair components_pair_of(const vector a[], const vector b[], int n)
{
    vector_pair s;
    for (int i = 0; i < 3; i++) {
        const pair p = spaced_pair_of(&a->at[i], 3, &b->at[i], 3, n);
        s.now.at[i] = p.now, s.next.at[i] = p.next;
    }
    return s;
}

#else

static inline vector_pair scaled_pair_of(const real a[], const vector b[], int n)
{
    vector_pair s = {nought, nought};
    for (int j = 0; j < n; j++) {
        const vector last = held_vector(b[n - j]);
        s.now = plus(s.now, times(a[j], last));
        s.next = plus(s.next, times(a[j + 1], last));
    }
    s.now = plus(s.now, times(a[n], b[0]));
    return s;
}

static inline vector_pair components_pair_of(const vector a[], const vector b[], int n)
{
    vector_pair s = {nought, nought};
    for (int j = 0; j < n; j++) {
        const vector last = held_vector(b[n - j]);
        s.now = plus(s.now, by(a[j], last));
        s.next = plus(s.next, by(a[j + 1], last));
    }
    s.now = plus(s.now, by(a[n], b[0]));
    return s;
}

#endif

/* Of a^2: half as many products. */
static inline pair square_pair_of(const real a[], int n)
{
    const int half = n / 2;
    pair s = {zero, zero};
    for (int j = 0; j < half; j++) {
        const real last = held(a[n - j]);
        s.now += a[j] * last;
        s.next += a[j + 1] * last;
    }
    if (n % 2 != 0) s.now += a[half] * a[half + 1];
    const real middle = n % 2 != 0 ? a[half + 1] : a[half], square = middle * middle;
    return n % 2 != 0 ? (pair){2 * s.now, 2 * s.next + square} : (pair){2 * s.now + square, 2 * s.next};
}

/* of the squares of components */
static inline vector_pair squares_pair_of(const vector a[], int n)
{
    const int half = n / 2;
    vector_pair s = {nought, nought};
    for (int j = 0; j < half; j++) {
        const vector last = held_vector(a[n - j]);
        s.now = plus(s.now, by(a[j], last));
        s.next = plus(s.next, by(a[j + 1], last));
    }
    if (n % 2 != 0) s.now = plus(s.now, by(a[half], a[half + 1]));
    const vector middle = n % 2 != 0 ? a[half + 1] : a[half], square = by(middle, middle);
    s.now = plus(s.now, s.now), s.next = plus(s.next, s.next);
    return n % 2 != 0 ? (vector_pair){s.now, plus(s.next, square)} : (vector_pair){plus(s.now, square), s.next};
}

/* --- in a channel ----------------------------------------------------------------------------------------------- */

static inline vector_pair sum_of_pairs(vector_pair a, vector_pair b)
{
    return (vector_pair){plus(a.now, b.now), plus(a.next, b.next)};
}

static inline pair product_pair(const real a[], const real b[], int c, int n)
{
    if (!is_deviation(c)) return product_pair_of(a, b, n);
    const pair of_db = product_pair_of(a, b + place(c, 0), n), of_da = product_pair_of(a + place(c, 0), b, n);
    return (pair){of_db.now + of_da.now, of_db.next + of_da.next};
}

static inline vector_pair scaled_pair(const real a[], const vector b[], int c, int n)
{
    if (!is_deviation(c)) return scaled_pair_of(a, b, n);
    return sum_of_pairs(scaled_pair_of(a, b + place(c, 0), n), scaled_pair_of(a + place(c, 0), b, n));
}

static inline vector_pair componentwise_pair(const vector a[], const vector b[], int c, int n)
{
    if (!is_deviation(c)) return components_pair_of(a, b, n);
    return sum_of_pairs(components_pair_of(a, b + place(c, 0), n), components_pair_of(a + place(c, 0), b, n));
}

static inline pair square_pair(const real a[], int c, int n)
{
    if (!is_deviation(c)) return square_pair_of(a, n);
    const pair half = product_pair_of(a, a + place(c, 0), n);
    return (pair){2 * half.now, 2 * half.next};
}

static inline vector_pair squares_pair(const vector a[], int c, int n)
{
    if (!is_deviation(c)) return squares_pair_of(a, n);
    const vector_pair half = components_pair_of(a, a + place(c, 0), n);
    return sum_of_pairs(half, half);
}

/* --- the ends a_0 b_n + a_n b_0, for n > 0 ---------------------------------------------------------------------- */

/* n = 0: a_0 b_0, the only end */
static inline real product_ends(const real a[], const real b[], int c, int n)
{
    const int i = place(c, n), o = place(c, 0);
    real ends = a[0] * b[i], last = a[i] * b[0];
    if (is_deviation(c)) ends += a[o] * b[n], last += a[n] * b[o];
    return n > 0 ? ends + last : ends;
}

static inline vector scaled_ends(const real a[], const vector b[], int c, int n)
{
    const int i = place(c, n), o = place(c, 0);
    const vector ends = plus(times(a[0], b[i]), times(a[i], b[0]));
    return is_deviation(c) ? plus(ends, plus(times(a[n], b[o]), times(a[o], b[n]))) : ends;
}

static inline vector componentwise_ends(const vector a[], const vector b[], int c, int n)
{
    const int i = place(c, n), o = place(c, 0);
    const vector ends = plus(by(a[0], b[i]), by(a[i], b[0]));
    return is_deviation(c) ? plus(ends, plus(by(a[n], b[o]), by(a[o], b[n]))) : ends;
}

/* number_impl.h - the numbers that power series are made of.
 *
 * Included with NUMBER, a kind of number, its functions ROOT, POW, ... (double_impl.h has those of double), and
 * LANES, how many orbits are computed side by side. A `real` is one NUMBER of each orbit, a `mask` one decision for
 * each, a `vector` three reals. With PACKED (one orbit only) the three share a register of four. With APART, sums of
 * products go through one component after the other: the x87 has registers for the two sums of one component, not for
 * six. No operation mixes lanes: what an orbit gets does not depend on its neighbours.
 *
 * KEPT is the number of coefficients of a series. CHANNELS is 1 plus the number of deviations that are computed
 * beside each orbit (products_impl.h).
 */
#ifndef ISO_MODEL_SERIES_NUMBER_IMPL_H
#define ISO_MODEL_SERIES_NUMBER_IMPL_H

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#ifdef __AVX2__
#include <immintrin.h>
#endif

#ifndef CHANNELS
#define CHANNELS 1
#endif

/* --- reals and masks -------------------------------------------------------------------------------------------- */

#if LANES == 1

typedef NUMBER real;
typedef bool mask;
#define LANE(a, i) (a)

static inline mask both(mask a, mask b)
{
    return a && b;
}

static inline mask other(mask a)
{
    return !a;
}

#else

typedef NUMBER real __attribute__((vector_size(LANES * sizeof(NUMBER))));
typedef __typeof__((real){0} < (real){0}) mask;
#define LANE(a, i) ((a)[i])

static inline mask both(mask a, mask b)
{
    return a & b;
}

static inline mask other(mask a)
{
    return ~a;
}

#endif

static const real zero = {0};

static inline real broadcast(NUMBER x)
{
    return x - zero;
}

static inline mask everywhere(void)
{
    return zero == zero;
}

/* choose: a where m holds, else b. any: whether m holds in a lane. larger: b, if one of them is no number. gcc 12 makes
 * several instructions of these in C; processors have one. */
#if defined __AVX512DQ__ && LANES == 8

static inline real choose(mask m, real a, real b)
{
    return _mm512_mask_blend_pd(_mm512_movepi64_mask((__m512i)m), b, a);
}

static inline bool any(mask m)
{
    return _mm512_movepi64_mask((__m512i)m) != 0;
}

static inline real larger(real a, real b)
{
    return _mm512_max_pd(a, b);
}

#elif defined __AVX2__ && LANES == 4

static inline real choose(mask m, real a, real b)
{
    return _mm256_blendv_pd(b, a, (__m256d)m);
}

static inline bool any(mask m)
{
    return _mm256_movemask_pd((__m256d)m) != 0;
}

static inline real larger(real a, real b)
{
    return _mm256_max_pd(a, b);
}

#else

static inline real choose(mask m, real a, real b)
{
#if LANES == 1
    return m ? a : b;
#else
    return (real)((m & (mask)a) | (~m & (mask)b));
#endif
}

static inline bool any(mask m)
{
    int64_t found = 0;
    for (int i = 0; i < LANES; i++) found |= LANE(m, i);
    return found != 0;
}

static inline real larger(real a, real b)
{
    return choose(a > b, a, b);
}

#endif

static inline real magnitude(real a)
{
#if LANES == 1
    return ABS(a);
#else
    return (real)((mask)a & ~(mask)broadcast((NUMBER)-0.0));
#endif
}

static inline real root(real a)
{
    for (int i = 0; i < LANES; i++) LANE(a, i) = ROOT(LANE(a, i));
    return a;
}

/* a b + c, rounded once */
static inline real fused(real a, real b, real c)
{
    for (int i = 0; i < LANES; i++) LANE(c, i) = FMA(LANE(a, i), LANE(b, i), LANE(c, i));
    return c;
}

/* a b - p, where p is a b rounded: exact. By Dekker's product where NUMBER has an even number of bits and FMA is slow:
 * the C library's fmal asks for the rounding mode. */
static inline real lost_in(real a, real b, real p)
{
#ifdef SPLIT
    const real of_a = SPLIT * a, of_b = SPLIT * b, a1 = of_a - (of_a - a), b1 = of_b - (of_b - b);
    const real a2 = a - a1, b2 = b - b1;
    return ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2;
#else
    return fused(a, b, -p);
#endif
}

/* a^(-1/2) for a > 0. With AVX-512 to about two roundings: an estimate of 14 bits, and Newton's method twice. A root
 * and a division take three times as long. */
static inline real over_root(real a)
{
#if defined __AVX512DQ__ && LANES == 8
    real y = _mm512_rsqrt14_pd(a);
    y += y * (0.5 - (0.5 * a * y) * y);
    return y + y * (0.5 - (0.5 * a * y) * y);
#else
    return 1 / root(a);
#endif
}

/* a^(twice/2) for a > 0 */
static inline real half_power(real a, int twice)
{
    if (twice == -1) return over_root(a);
    real power = twice % 2 != 0 ? root(a) : broadcast(1);
    for (int i = abs(twice) / 2; i > 0; i--) power *= a;
    return twice < 0 ? 1 / power : power;
}

/* Twice p, if p is half of an integer from -8 to 8. Otherwise 0. */
static inline int twice_of(NUMBER p)
{
    const int twice = p >= -4 && p <= 4 ? (int)(2 * p) : 0;
    return (NUMBER)twice == 2 * p ? twice : 0;
}

/* a^p for a > 0. Most powers are the same half of a small integer in all lanes. */
static inline real raised(real a, real p)
{
#ifdef ROUND_POWERS_ONCE /* by the C library: slower */
    for (int i = 0; i < LANES; i++) LANE(a, i) = POW(LANE(a, i), LANE(p, i));
    return a;
#endif
    const int first = twice_of(LANE(p, 0));
    real result = half_power(a, first);
    for (int i = 0; i < LANES && any(2 * p != broadcast((NUMBER)first)); i++) {
        const NUMBER own = LANE(p, i);
        const int twice = twice_of(own);
        if (twice == first && 2 * own == (NUMBER)first) continue;
        const real alone = half_power(a, twice);
        LANE(result, i) = (NUMBER)twice == 2 * own ? LANE(alone, i) : POW(LANE(a, i), own);
    }
    return result;
}

/* --- vectors of R^3 --------------------------------------------------------------------------------------------- */

#ifdef PACKED

typedef NUMBER vector __attribute__((vector_size(4 * sizeof(NUMBER))));
#define AT(v, i) ((v)[i])

static inline vector plus(vector a, vector b)
{
    return a + b;
}

static inline vector minus(vector a, vector b)
{
    return a - b;
}

static inline vector times(real a, vector b)
{
    return a * b;
}

static inline vector by(vector a, vector b)
{
    return a * b;
}

static inline vector turn(vector a)
{
    return __builtin_shufflevector(a, a, 1, 2, 0, 3);
}

#else

typedef struct vector {
    real at[3];
} vector;
#define AT(v, i) ((v).at[i])

static inline vector plus(vector a, vector b)
{
    return (vector){{a.at[0] + b.at[0], a.at[1] + b.at[1], a.at[2] + b.at[2]}};
}

static inline vector minus(vector a, vector b)
{
    return (vector){{a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2]}};
}

static inline vector times(real a, vector b)
{
    return (vector){{a * b.at[0], a * b.at[1], a * b.at[2]}};
}

/* by components */
static inline vector by(vector a, vector b)
{
    return (vector){{a.at[0] * b.at[0], a.at[1] * b.at[1], a.at[2] * b.at[2]}};
}

/* (x2, x3, x1): a x b = turn(a turn(b) - turn(a) b) */
static inline vector turn(vector a)
{
    return (vector){{a.at[1], a.at[2], a.at[0]}};
}

#endif

static const vector nought = {0};

static inline real total(vector a)
{
    return AT(a, 0) + AT(a, 1) + AT(a, 2);
}

#endif

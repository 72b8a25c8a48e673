/* taylor_number_impl.h - the numbers Taylor series are made of.
 *
 * Included with NUMBER, a kind of number, ROOT, LOG, EXP and FMA of it, and LANES, how many orbits are computed side by
 * side. A `real` is one NUMBER of each orbit, a `mask` one decision for each, a `vector` three reals. With PACKED (one
 * orbit only) the three share a register of four. No operation mixes lanes: what an orbit gets does not depend on its
 * neighbours.
 */
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* --- reals and masks ----------------------------------------------------------------------------------------------- */

#if LANES == 1

typedef NUMBER real;
typedef bool mask;
#define LANE(a, i) (a)

static inline real choose(mask m, real a, real b)
{
    return m ? a : b;
}

static inline mask both(mask a, mask b)
{
    return a && b;
}

#else

typedef NUMBER real __attribute__((vector_size(LANES * sizeof(NUMBER))));
typedef __typeof__((real){0} < (real){0}) mask;
#define LANE(a, i) ((a)[i])

static inline real choose(mask m, real a, real b)
{
    return (real)((m & (mask)a) | (~m & (mask)b));
}

static inline mask both(mask a, mask b)
{
    return a & b;
}

#endif

static const real zero = {0};

static inline real spread(NUMBER x)
{
    return x - zero;
}

static inline bool any(mask m)
{
    bool found = false;
    for (int i = 0; i < LANES; i++) found |= LANE(m, i) != 0;
    return found;
}

static inline real larger(real a, real b)
{
    return choose(a > b, a, b);
}

static inline real magnitude(real a)
{
    return larger(a, -a);
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

/* a^p for a > 0; most powers are halves of small integers */
static inline NUMBER raised_number(NUMBER a, NUMBER p)
{
    const int twice = p >= -4 && p <= 4 ? (int)(2 * p) : 0;
    if (twice != 2 * p) return EXP(p * LOG(a));
    NUMBER power = twice % 2 != 0 ? ROOT(a) : 1;
    for (int i = abs(twice) / 2; i > 0; i--) power *= a;
    return twice < 0 ? 1 / power : power;
}

static inline real raised(real a, real p)
{
    for (int i = 0; i < LANES; i++) LANE(a, i) = raised_number(LANE(a, i), LANE(p, i));
    return a;
}

/* --- vectors of R^3 ------------------------------------------------------------------------------------------------ */

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

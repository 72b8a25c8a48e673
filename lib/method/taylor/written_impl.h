/* written_impl.h - the recurrences of the free point, written out: one function for each even n, which gives
 * coefficients n and n + 1. n is a constant in it, so the compiler knows the ends of all loops. The source of all of
 * them is model/series/recurrences_impl.h.
 *
 * Only in lanes without deviations (WRITTEN): elsewhere the code is larger and not faster.
 */
#include "model/series/recurrences_impl.h"

#ifdef WRITTEN

_Static_assert(MOST == 28, "one function for each even n below the highest order");

/* clang-format off */
#define FOR_EVEN(X, term) \
    X(term, 0) X(term, 2) X(term, 4) X(term, 6) X(term, 8) X(term, 10) X(term, 12) \
    X(term, 14) X(term, 16) X(term, 18) X(term, 20) X(term, 22) X(term, 24) X(term, 26)
/* clang-format on */
#define FUNCTION(term, n)                                                                                            \
    __attribute__((flatten)) static void term##_##n(series *S)                                                       \
    {                                                                                                                \
        term(S, 0, n);                                                                                               \
    }
#define ROW(term, n) [n] = term##_##n,

FOR_EVEN(FUNCTION, neumann)
FOR_EVEN(FUNCTION, point_t)

static written_recurrence *const written_neumann[MOST] = {FOR_EVEN(ROW, neumann)};
static written_recurrence *const written_point_t[MOST] = {FOR_EVEN(ROW, point_t)};

#endif

/* NULL: it is not written out */
static written_recurrence *const *written_of(recurrence *motion)
{
#ifdef WRITTEN
    if (motion == neumann) return written_neumann;
    if (motion == point_t) return written_point_t;
#endif
    (void)motion;
    return NULL;
}

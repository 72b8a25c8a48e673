/* arithmetic_impl.h - the rules our numbers are computed by, whatever the host program has set for its own.
 *
 *     iso_status iso_orbit_at(...)
 *     {
 *         ISO_DEFAULT_ARITHMETIC;
 *
 * From there to the function's end this thread, and those it starts, round to nearest, keep subnormal numbers and do
 * not trap. They must not trap: a step that is given up, or a lane without an orbit, may overflow or divide by 0, in
 * our code as in SUNDIALS, GSL and the C library. At the function's end the host's rules are back. Every public
 * function that computes and answers an iso_status begins so. It costs 5 ns if the host's rules are the default ones.
 */
#ifndef ISO_BASE_ARITHMETIC_IMPL_H
#define ISO_BASE_ARITHMETIC_IMPL_H

#include <fenv.h>
#include <stdbool.h>

typedef struct iso_arithmetic {
    fenv_t host;
    bool changed; /* and to be restored */
} iso_arithmetic;

void iso_arithmetic_enter(iso_arithmetic *a);
void iso_arithmetic_leave(iso_arithmetic *a);

#define ISO_DEFAULT_ARITHMETIC                                                                                       \
    __attribute__((cleanup(iso_arithmetic_leave))) iso_arithmetic iso_of_host;                                       \
    iso_arithmetic_enter(&iso_of_host)

#endif

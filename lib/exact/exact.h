/* exact.h - the closed solution of the free problem: the state at any time, always at the same cost.
 *
 * An orbit of backend ISO_BACKEND_EXACT has it (iso_orbit_exact).
 *
 * It exists in three cases:
 * - k = 1 on H = 0, and k = -1 on every level: in sphero-conical coordinates of gamma the problem separates into two
 *   oscillations with a clock sigma of their own (theory: section 5 of the paper);
 * - two moments of inertia equal to 4 units in the last place, every k: gamma along the axis swings, the angle about
 *   the axis follows;
 * - a start in a principal plane, every k: gamma never leaves it.
 * The last two hold on every level, and with a rotor: K along the axis (three equal moments: any K), or at right
 * angles to the plane. An orbit on a separatrix leaves an unstable rotation and comes back to it. Where it is that
 * rotation to all digits, the rotation is what is computed.
 *
 * Elliptic functions and Fourier series turn each oscillation into an angle. Each clock is a linear term and a
 * Fourier series of the angles. Newton's method finds the place at which a clock shows the time asked for. Numbers
 * that grow with time are carried in long double.
 */
#ifndef ISO_EXACT_EXACT_H
#define ISO_EXACT_EXACT_H

#include "model/system.h"

typedef struct iso_exact iso_exact;

typedef enum iso_exact_kind {
    ISO_EXACT_SEPARATED,  /* angles of the lower and the upper sphero-conical coordinate                       */
    ISO_EXACT_SYMMETRIC,  /* angles of the swing along the axis and of the turning about it                    */
    ISO_EXACT_PLANE,      /* one angle: of gamma in a principal plane                                          */
    ISO_EXACT_SEPARATRIX, /* none: the orbit leaves an unstable rotation and comes back to it, once            */
    ISO_EXACT_REST,       /* none: the point rests                                                             */
    ISO_EXACT_KINDS
} iso_exact_kind;

#endif

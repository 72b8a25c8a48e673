/* exact.h - the closed solution of the free problem for k = 1 and k = -1: any time, the same cost.
 *
 *     iso_exact *exact;
 *     iso_exact_create(ctx, &field, point, &exact);        field: k, J and eps; H = 0
 *     iso_exact_at(ctx, exact, ISO_CLOCK_T, 1e6, y, clocks);     the point a million units of the ball's time later
 *     iso_exact_free(exact);
 *
 * In sphero-conical coordinates of gamma the problem separates into two oscillations with a clock sigma of their own
 * (theory: section 5 of the paper). Each is brought to an angle that grows evenly with sigma, by elliptic functions
 * and a Fourier series; the clocks are a linear term and a Fourier series of both angles. What is asked at a time is
 * found by Newton's method on sigma. Numbers that grow with time are carried in long double.
 */
#ifndef ISO_EXACT_EXACT_H
#define ISO_EXACT_EXACT_H

#include "../model/system.h"

typedef struct iso_exact iso_exact;

/* From the state (M, gamma) at time 0, in any consistent units; |gamma| and H = 0 are restored. Takes about a
 * millisecond, longer next to the separatrix. Errors: ISO_BAD_ARGUMENT about "k" (neither 1 nor -1), "eps" (not > 0),
 * or an effect that acts; ISO_NUMERICAL on the separatrix, or too close to it; ISO_NO_MEMORY. */
iso_status iso_exact_create(iso_context *ctx, const iso_field *field, const double point[ISO_STATE],
                            iso_exact **exact);
void iso_exact_free(iso_exact *exact);

/* The state (M, gamma) at `time` of `clock`, before or after 0, and the three clocks there.
 * Errors: ISO_BAD_ARGUMENT: a time that is not finite. */
iso_status iso_exact_at(iso_context *ctx, const iso_exact *exact, iso_clock clock, double time,
                        double point[ISO_STATE], double clocks[ISO_CLOCKS]);

/* The motion on its torus. */
typedef struct iso_exact_torus {
    double c;                        /* the separation constant: 2 A(z) p_z^2 = R(z) + c for both coordinates      */
    double distance;                 /* R(b2) + c in units of its terms: 0 on the separatrix; > 0: the lower
                                        coordinate librates, < 0: the upper                                        */
    double frequency[ISO_CLOCKS][2]; /* of the lower and the upper coordinate, radians in each clock, both > 0     */
} iso_exact_torus;

iso_exact_torus iso_exact_describe(const iso_exact *exact);

#endif

/* exact_impl.h - the closed solution (exact.h): states, also in a row, and the torus.
 *
 *     iso_exact *exact;
 *     iso_exact_create(ctx, &problem, point, all_clocks, &exact); problem: k, J, eps and the level H
 *     iso_exact_at(ctx, exact, ISO_CLOCK_T, 1e6, y, clocks);       the point a million units of the ball's time later
 *     iso_exact_free(exact);
 */
#ifndef ISO_EXACT_EXACT_IMPL_H
#define ISO_EXACT_EXACT_IMPL_H

#include "exact/exact.h"

/* The motion on its torus. A number that the kind has not is NaN. */
typedef struct iso_exact_torus {
    iso_exact_kind kind;
    int angles; /* 2, 1 or 0 */
    /* Mean, radians in each clock (NaN: not made). The state returns where both angles have grown by multiples of
     * 2 pi. */
    double frequency[ISO_CLOCKS][2];
    /* (1/2 pi) times the integral of (momentum) d(coordinate) round the loop of each angle, >= 0; about an axis:
     * M along it, with its sign; with a rotor, M along it at the equator. */
    double action[2];
    double c; /* separated: the constant of 2 A(z) p_z^2 = R(z) + c */
    /* 0 on the separatrix of the rotation about the middle axis, or in the equator: (R(b2) + c)/|R(b2) - H b2|, > 0
     * where the lower coordinate librates; or (dx/ds)^2/M^2 at the equator, > 0 where it is crossed. */
    double distance;
} iso_exact_torus;

iso_exact_torus iso_exact_describe(const iso_exact *exact);

/* From the state (M, gamma) at time 0, in any consistent units. gamma is made a unit vector; on the level H = 0 M is
 * scaled to that level.
 * `clocks` are those that will be asked for, as a time or with a state. Takes less than a millisecond, longer next to
 * a separatrix or for extreme bodies.
 * Errors: ISO_BAD_ARGUMENT where there is no closed solution: about "k" (and unequal moments), "eps" (not > 0), or
 * the name of an effect that acts; ISO_NUMERICAL: too many terms would be needed; ISO_NO_MEMORY. */
iso_status iso_exact_create(iso_context *ctx, const iso_problem *problem, const double point[ISO_STATE],
                            const bool clocks[ISO_CLOCKS], iso_exact **exact);
void iso_exact_free(iso_exact *exact);

/* The state (M, gamma) at `time` of `clock`, before or after 0, and the clocks there (NaN: not among those of the
 * creation; NULL: not asked for). Errors: ISO_BAD_ARGUMENT: a time that is not finite, a clock that was not among them; ISO_NUMERICAL: no
 * finite state, or a clock that does not fit a double. */
iso_status iso_exact_at(iso_context *ctx, const iso_exact *exact, iso_clock clock, double time,
                        double point[ISO_STATE], double clocks[ISO_CLOCKS]);

/* At times that follow each other: iso_exact_walk walk = {0}; for (...) iso_exact_walk_to(ctx, exact, &walk, ...).
 * Where steps are short, the places before extrapolate to a guess of the next one, and Newton's method needs fewer
 * steps from there. The states are those of iso_exact_at to rounding, and errors are its errors. Times may be uneven:
 * the guess is then poor, and forgotten. One walk is in one clock. */
enum { ISO_EXACT_TRAIL = 8 };
typedef struct iso_exact_walk {
    long double trail[ISO_EXACT_TRAIL]; /* the places before, less an even motion */
    int known;                          /* how many of them there are */
    double time;                        /* of the last one */
} iso_exact_walk;
iso_status iso_exact_walk_to(iso_context *ctx, const iso_exact *exact, iso_exact_walk *walk, iso_clock clock,
                             double time, double point[ISO_STATE], double clocks[ISO_CLOCKS]);

#endif

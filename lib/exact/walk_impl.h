/* walk_impl.h - the closed solution at times that follow each other in even steps.
 *
 *     iso_exact_walk walk = {.longest = ISO_EXACT_SHORT};
 *     for (...) iso_exact_walk_to(ctx, exact, &walk, clock, time, point, clocks);
 *
 * Where steps are short, the places before extrapolate to a guess of the next one, and Newton's method needs fewer
 * steps from there. The states are those of iso_exact_at to rounding. Times may be uneven: the guess is then poor,
 * and forgotten.
 */
#ifndef ISO_EXACT_WALK_IMPL_H
#define ISO_EXACT_WALK_IMPL_H

#include "exact/exact.h"

enum {
    ISO_EXACT_TRAIL = 8,
    ISO_EXACT_SHORT = 4 /* for longer steps a guess saves little, or nothing */
};

typedef struct iso_exact_walk {
    long double trail[ISO_EXACT_TRAIL]; /* the places before, less an even motion */
    int known;                          /* how many of them there are             */
    /* Step from which a guess is made, in moments in which gamma turns by a tenth of a radian at most. */
    double longest;
    double time; /* of the last one */
} iso_exact_walk;

/* As iso_exact_at. One walk is in one clock. */
iso_status iso_exact_walk_to(iso_context *ctx, const iso_exact *exact, iso_exact_walk *walk, iso_clock clock,
                             double time, double point[ISO_STATE], double clocks[ISO_CLOCKS]);

#endif

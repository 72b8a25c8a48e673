/* continuation.h - follows a symmetric periodic orbit while k, a moment or the level changes.
 *
 * The orbit passes its symmetry line at u (periodic.h), and again half an orbit later: there F(u, value), the
 * distance from the line, is 0. The curve F = 0 is followed by its arc length, through folds, in steps that adapt. D
 * is the derivative over half the orbit in coordinates along and across the line (half way: of the mean of two
 * crossings). The trace is 2 + 4 D_01 D_10/det D = 4 D_00 D_11/det D - 2. Slopes by u are carried along the orbit,
 * those by the parameter are differences.
 *
 *     fold                D_10 = 0, the slope of F along the line: two orbits meet and vanish
 *     symmetry breaking   D_01 = 0: orbits with less symmetry branch off (trace 2)
 *     period doubling     D_00 or D_11 = 0: orbits of twice the period branch off (the trace passes -2)
 *     touch               D_00 = D_11 = 0: the trace touches -2 and does not pass it
 *     collision           u reaches an end of the line, a rotation about a principal axis
 *     torus               k = 1 or -1, or two equal moments: the orbit is one of a torus of them
 */
#ifndef ISO_INSTRUMENT_PERIODIC_CONTINUATION_H
#define ISO_INSTRUMENT_PERIODIC_CONTINUATION_H

#include "instrument/periodic/periodic.h"

typedef enum iso_vary { ISO_VARY_K, ISO_VARY_J1, ISO_VARY_J2, ISO_VARY_J3, ISO_VARY_RATIO, ISO_VARY_LEVEL } iso_vary;
/* "k", "J1", "J2", "J3", "ratio", "level"; NULL past the end. ratio: (J2 - J1)/(J3 - J1), by J2. level: (H/eps)
 * J2^(1/k) (study/level.h); it stays the scene's while the others change. */
const char *iso_vary_name(int vary);

typedef enum iso_branch_kind {
    ISO_BRANCH_FOLD,
    ISO_BRANCH_DOUBLING,
    ISO_BRANCH_BREAKING,
    ISO_BRANCH_COLLISION,
    ISO_BRANCH_TORUS,
    ISO_BRANCH_END,      /* the end of the range                     */
    ISO_BRANCH_FAILURE,  /* it could not be followed: text says why  */
    ISO_BRANCH_TOUCH,    /* the trace touches -2 and does not pass it */
    ISO_BRANCH_UNDECIDED /* a touch, or two period doublings that are too close to say which */
} iso_branch_kind;
/* "fold", "period doubling", "symmetry breaking", "collision", "torus", "end", "failure", "touch", "undecided". */
const char *iso_branch_kind_name(int kind);

typedef struct iso_branch_point {
    double value, u, l, x, trace; /* u: of the line; (l, x): the first point on the section */
    double arc;                   /* along the branch, from the start: negative on one side */
} iso_branch_point;

typedef struct iso_branch_event {
    iso_branch_kind kind;
    bool joins; /* this branch is the one that branches off */
    iso_branch_point at;
    int axis; /* of a collision: the rotation's, 0 to 2 */
    char text[160];
} iso_branch_event;

typedef struct iso_branch {
    int line, period; /* line: as in iso_symmetry_line_name */
    int parent;       /* the branch that it was switched from; -1: none */
    size_t points, events;
    iso_branch_point *point; /* by arc */
    iso_branch_event *event; /* by arc */
} iso_branch;

typedef struct iso_continuation_options {
    iso_vary vary;
    double from, to; /* the range, which holds the scene's own value */
    double longest;  /* step, in parts of the range and radians of the line */
    bool branches;   /* follow what branches off as well; not what branches off from that */
    int threads;     /* that follow orbits side by side; 0: as many as there are processors to run on */
    /* progress(part): the part of the work that is done, in [0, 1]; NULL: no calls. */
    void (*progress)(void *data, double part);
    void *data;
} iso_continuation_options;

static inline iso_continuation_options iso_continuation_defaults(void)
{
    return (iso_continuation_options){.longest = 0.03};
}

typedef struct iso_continuations {
    iso_vary vary;
    size_t count;
    iso_branch *branch;
} iso_continuations;

/* A row of a table of branches: a point, or an event. */
typedef struct iso_branch_row {
    size_t number; /* of the branch, from 1 */
    int line, period;
    iso_branch_point at;
    const iso_branch_event *event; /* NULL: none */
} iso_branch_row;

/* Whether the options suit the scene: the errors of iso_continuation_run about "range". */
iso_status iso_continuation_check(iso_context *ctx, const iso_scene *scene, const iso_continuation_options *options);

/* Follows orbits[0 .. count) of a scene, as iso_periodic_run found them. Errors: ISO_BAD_ARGUMENT about "range": it
 * is none, k = 0 or a moment <= 0 is in it, or the scene's value is not; ISO_BAD_INPUT about "orbit": it has no
 * symmetry line, or there is none; ISO_NO_MEMORY; ISO_STOPPED: *follow has what is known by then. A branch that
 * cannot be followed to its end is kept, with an event. */
iso_status iso_continuation_run(iso_context *ctx, const iso_scene *scene, const iso_periodic_orbit orbits[],
                                size_t count, const iso_continuation_options *options, iso_continuations **follow);
void iso_continuation_free(void *follow);

#endif

/* crossings.h - many orbits, each followed from crossing to crossing of a section.
 *
 *     iso_crossings *c;
 *     iso_crossings_options o = iso_crossings_defaults();
 *     iso_crossings_create(ctx, orbits, 1000, &o, &c);
 *     iso_crossings_go(c, NULL, 500, crossing, NULL, done, status);     crossing[500 i + j]: orbit i, its crossing j
 *     iso_crossings_go(c, NULL, 500, crossing, NULL, done, status);     the next 500 of each
 *     iso_crossings_free(c);
 *
 * The section is n_a = 0, n_a increasing (map/section.h). This is also gamma_a = 0: ball and point
 * cross it at the same events. There are two other kinds: a column of the samples passes a value upwards; or, without
 * a section, equal steps of a clock.
 *
 * With `deviations` the first-order variation of each orbit is computed beside it, for two deviations d1, d2. The
 * metric is |dn|^2 + |dw|^2/|w|^2 of (n, omega), or of (gamma, gamma') for a point. Both deviations begin tangent to
 * the constraints and to the level of the energy, and normal to the flow; they are orthogonal and have length 1.
 * Lengths and angles are given without the part along the flow, which says only how far ahead of the orbit its
 * neighbour is.
 *
 * Orbits on which nothing acts but a level are followed in the lanes of vectors and on all threads (batch.h). The
 * numbers of an orbit depend on the kind of vectors. They do not depend, not even in the last bit, on the other
 * orbits, their order, the number of threads, or the number of crossings asked at a time.
 */
#ifndef ISO_ORBIT_CROSSINGS_H
#define ISO_ORBIT_CROSSINGS_H

#include "orbit/batch.h"

typedef enum iso_section_kind {
    ISO_SECTION_AXIS,   /* n_a = 0, n_a increasing                                  */
    ISO_SECTION_COLUMN, /* a column of the samples passes a value upwards           */
    ISO_SECTION_CLOCK   /* equal steps of a clock                                   */
} iso_section_kind;

/* As in iso_batch_options where the names are the same. */
typedef struct iso_crossings_options {
    iso_backend backend; /* the model that is integrated: ISO_BACKEND_BALL, _POINT, or _AUTO as in batches       */
    iso_section_kind kind;
    int axis;        /* of ISO_SECTION_AXIS: 0 to 2; ISO_AXIS_AUTO: the global one of each orbit             */
    int column;      /* of ISO_SECTION_COLUMN, see iso_column_find                                           */
    double value;    /* of ISO_SECTION_COLUMN: the value that is passed; of ISO_SECTION_CLOCK: the step, > 0 */
    iso_clock clock; /* of ISO_SECTION_CLOCK                                                                 */
    bool deviations;
    double tolerance;
    iso_models shown; /* what samples show                                                                    */
    int threads;
    const char *vectors;
} iso_crossings_options;

enum { ISO_AXIS_AUTO = -1, ISO_DEVIATIONS = 2 };

static inline iso_crossings_options iso_crossings_defaults(void)
{
    iso_crossings_options o = {0};
    o.backend = ISO_BACKEND_AUTO;
    o.axis = ISO_AXIS_AUTO;
    o.tolerance = 1e-12;
    o.clock = ISO_CLOCK_T;
    o.shown = ISO_SHOW_BALL;
    return o;
}

/* One crossing, in the caller's units. Numbers that do not exist are NaN. */
typedef struct iso_crossing {
    double clock[ISO_CLOCKS]; /* since the start; tau and s need the isomorphism                                 */
    /* Chart of ISO_SECTION_AXIS (map/section.h), from the directions of M and gamma. Without the isomorphism
     * J^(1/2) omega (for k < 0: -J^(1/2) omega) stands for M and J^(-1/2) n for gamma; with it the directions are the
     * same. */
    double l, x;
    double growth[ISO_DEVIATIONS]; /* ln of the length of d1 and d2; 0 at the start                              */
    double area; /* sine of the angle between d1 and d2, in [0, 1]: GALI_2                          */
    /* det D, where D carries deviations across the flow from the start to here: the area of (d1, d2), by the measure that
     * a free motion keeps on its level of the energy, divided by that at the start. Between two crossings of a section
     * it is the determinant of the return map in the chart (L, l). NaN for a twist, or where the ball or the point
     * rests. */
    double determinant;
    /* ISO_SECTION_AXIS, if the start lies on the section: the derivative of (l, x) at this crossing (rows) by (l, x)
     * at the start (columns). */
    double slope[2][2];
} iso_crossing;

typedef struct iso_crossings iso_crossings;

/* Errors: ISO_BAD_ARGUMENT about "backend", "axis", "column", "value", "tolerance", "threads", "vectors", or about
 * "deviations" with ISO_SECTION_COLUMN; ISO_NO_MEMORY. Errors of single orbits come from iso_crossings_go. Orbits,
 * parameters, starts and effects must live as long as the object. */
iso_status iso_crossings_create(iso_context *ctx, const iso_batch_orbit orbits[], size_t count,
                                const iso_crossings_options *options, iso_crossings **crossings);
void iso_crossings_free(iso_crossings *c);

/* Each orbit i with wanted[i] (wanted NULL: every orbit) goes on to its next `each` crossings. They are
 * crossing[each i + j] and sample[each i + j] (sample NULL: none), j < done[i]. status[i] is ISO_OK, or says why
 * there are fewer than `each`. An orbit that has failed does not go on: later calls give the same status. The others
 * go on.
 * A start on the section (n_a = 0 up to 1e-8 of its oscillation, and not falling) is no crossing.
 * Errors of one orbit: those of iso_orbit_create and iso_orbit_at; ISO_NUMERICAL if two crossings of a global section
 * are outside the bounds of their distance in s (map/section.h), or if the ball rests; ISO_BAD_INPUT about "axis" or
 * "value" if no further crossing is found within ISO_MOST_BETWEEN turns (the message names what the orbit crosses),
 * about "axis" for an orbit in the plane n_a = 0 itself, the boundary of the chart, and about "deviations" for an orbit
 * that has none. If s does not fit a double (extreme k),
 * distances are not checked. The call returns the error of the first orbit that failed; the message has its number
 * and the reason. Errors of the call: ISO_NO_MEMORY; ISO_STOPPED by the context's monitor: then done[] and the
 * crossings that it counts are valid, and the next call goes on from there. */
enum { ISO_MOST_BETWEEN = 10000 };
iso_status iso_crossings_go(iso_crossings *c, const bool wanted[], size_t each, iso_crossing crossing[],
                            iso_sample sample[], size_t done[], iso_status status[]);

#endif

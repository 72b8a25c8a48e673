/* stability_chart.h - where the rotations about the axes of least and greatest moment are stable, in the plane of k
 * and one moment, or of k and the level (study/level.h): traces of Hill's equation (periodic.h) on a grid, and the
 * borders, where a trace is 2 or -2.
 */
#ifndef ISO_INSTRUMENT_PERIODIC_STABILITY_CHART_H
#define ISO_INSTRUMENT_PERIODIC_STABILITY_CHART_H

#include "base/field.h"
#include "base/record.h"

typedef struct iso_stability_options {
    int moment;  /* which of J varies, 0 to 2; ISO_CHART_LEVEL: the level */
    double J[3]; /* the others, > 0 */
    /* Of k, and of the moment or level: from < to. |k| < ISO_LEAST_K is left out: there the trace has no limit. */
    double from[2], to[2];
    int steps;   /* of the grid, in both directions: 2 to 2000 */
    int threads; /* 0: as many as there are processors to run on */
    /* progress(part): the part of the work that is done, in [0, 1]; NULL: no calls. */
    void (*progress)(void *data, double part);
    void *data;
    double level; /* (H/eps) J2^(1/k), everywhere in the chart; 0: the free ball. Not read where it varies */
} iso_stability_options;
enum { ISO_CHART_LEVEL = 3 };
#define ISO_LEAST_K 0.02
/* "J1", "J2", "J3", "level"; NULL past the end. */
const char *iso_chart_name(int moment);

static inline iso_stability_options iso_stability_defaults(void)
{
    return (iso_stability_options){.moment = 1, .from[0] = -3, .to[0] = 3, .steps = 120};
}

/* A row of the table of a chart. */
typedef struct iso_chart_row {
    const char *kind; /* "grid" or "border" */
    double k, value;  /* value: of the moment, or the level */
    double least, greatest;
} iso_chart_row;

/* grid: columns k, J1 (or J2, J3, level: what varies), least, greatest (half-turn traces of the rotations about these
 * axes; NaN: there is none on this level, see iso_hill_has_rotation). borders: columns axis (0: of the least moment,
 * 1: of the greatest), trace (2 or -2), k and what varies: points of the border curves, where they cross the lines of
 * the grid of equal J and of equal k. The caller frees both records. Errors: ISO_BAD_ARGUMENT about "k", "J",
 * "level", "steps"; ISO_NO_MEMORY; ISO_STOPPED. */
iso_status iso_stability_chart(iso_context *ctx, const iso_stability_options *options, iso_record **grid,
                               iso_record **borders);

#endif

/* lanes_impl.h - Taylor series of many orbits at once: one in each lane of the processor's vectors.
 *
 * Each lane has its own orbit, step and time; when its orbit is done, it takes the next. No operation mixes lanes, so
 * the states of an orbit do not depend, bit for bit, on the orbits beside it, nor on their order.
 */
#ifndef ISO_METHOD_TAYLOR_LANES_IMPL_H
#define ISO_METHOD_TAYLOR_LANES_IMPL_H

#include <stddef.h>

#include "method/method.h"

enum { ISO_LANE_DEVIATIONS = 2 };

/* An orbit at a row, or at a crossing, with its deviations (deviations_impl.h) if the code has them. */
typedef struct iso_lane_event {
    double y[ISO_MAX_STATE];
    double deviation[ISO_LANE_DEVIATIONS][ISO_MAX_STATE]; /* times exp(scale); with the part along the flow      */
    double scale[ISO_LANE_DEVIATIONS];
    double growth[ISO_LANE_DEVIATIONS]; /* ln of its length, without that part; 0 at the start */
    double sine;                        /* of the angle between them                           */
} iso_lane_event;

/* One orbit, from `start` at time 0, to rows or to crossings.
 *
 * Rows are times in the model's clock, all on one side of 0, going away from it. Crossings are the times after 0 at
 * which n_axis (gamma_axis) of a free orbit passes 0 upwards. `zeros` and `longest` bound the distance between them.
 *
 * An orbit can be followed in parts: with `saved` the next call of solve() goes on where the last one ended. The
 * results are the same as those in one part, to the last bit. */
typedef struct iso_lane_job {
    const iso_model *model;
    double start[ISO_MAX_STATE];
    size_t rows;        /* or crossings */
    const double *time; /* NULL: crossings                                                           */
    int axis;           /* 0 to 2                                                                    */
    /* In the variable of the series (iso_lane_clock): n_axis has at most one zero within 1/zeros; two crossings are
     * less than `longest` apart. */
    double zeros, longest;
    double unit;    /* time[i]/unit is in the model's units                                      */
    double *states; /* NULL, or: model->dim numbers at states[row stride]                        */
    size_t stride;
    iso_lane_event *event;        /* NULL, or: one for each row                                                */
    bool on_section;              /* the start lies on the section: it is no crossing, whatever the sign of n_axis */
    double *passed;               /* the times of the crossings, in the model's units                          */
    void *saved;                  /* NULL, or: iso_lane_build.saved bytes, which begin with 0                   */
    size_t done;                  /* how many of the rows have been reached                                    */
    double last;                  /* the last good time, in the model's units ...                              */
    double last_y[ISO_MAX_STATE]; /* ... and the state there, where it ended before the last row             */
    long steps;
    const char *error; /* NULL, or why it ended before the last row                                 */
    double first[ISO_LANE_DEVIATIONS][ISO_MAX_STATE]; /* the deviations at the start                    */
} iso_lane_job;

typedef struct iso_lane_options {
    double tolerance;
    long max_steps;            /* of one orbit; 0: no bound         */
    bool (*go_on)(void *data); /* asked at each step; NULL: nobody  */
    void *data;
} iso_lane_options;

/* One compilation: for processors with vectors of a certain width. */
typedef struct iso_lane_build {
    const char *name;
    int lanes;
    int deviations; /* 0 or ISO_LANE_DEVIATIONS */
    size_t saved;   /* bytes                    */
    bool (*runs_here)(void);
    /* Solves jobs (one at least) of models that are alike and not stiff. False: no memory, or stopped by go_on; jobs
     * that are not done have no error then. */
    bool (*solve)(iso_lane_job *const jobs[], size_t count, const iso_lane_options *options);
} iso_lane_build;

/* The codes of this build without deviations, widest first, ended by NULL; the last runs everywhere. */
extern const iso_lane_build *const iso_lane_builds[];

/* The one called `name`, or for NULL the widest, that this processor can run; NULL: none. With deviations there are
 * also "extended" and "quad", one orbit in numbers of more digits. */
const iso_lane_build *iso_lane_build_find(const char *name, bool deviations);

/* The clock that is the variable of a model's series. */
iso_clock iso_lane_clock(const iso_model *model);

/* Whether two models can share lanes: the same system, effects and clocks, and the same form of the equations. */
bool iso_lanes_alike(const iso_model *a, const iso_model *b);

extern const iso_lane_build iso_lanes_plain, iso_lanes_avx2, iso_lanes_avx512;
extern const iso_lane_build iso_tangent_plain, iso_tangent_avx2, iso_tangent_avx512;
extern const iso_lane_build iso_tangent_extended, iso_tangent_quad;

#endif

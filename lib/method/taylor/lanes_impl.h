/* lanes_impl.h - Taylor series of many orbits at once: one in each lane of the processor's vectors.
 *
 * Each lane has its own orbit, step and time; when its orbit is done, it takes the next. No operation mixes lanes, so
 * the states of an orbit do not depend, bit for bit, on the orbits beside it, nor on their order.
 */
#ifndef ISO_METHOD_LANES_IMPL_H
#define ISO_METHOD_LANES_IMPL_H

#include <stddef.h>

#include "method/method.h"

/* One orbit: from `start` at time 0 to times in the model's clock, all on one side of 0, going away from it. */
typedef struct iso_lane_job {
    const iso_model *model;
    double start[ISO_MAX_STATE];
    size_t rows;
    const double *time;
    double unit;    /* time[i]/unit is in the model's units      */
    double *states; /* model->dim numbers at states[row stride]  */
    size_t stride;
    size_t done; /* how many of them have been reached        */
    double last; /* the last good time, in the model's units  */
    long steps;
    const char *error; /* NULL, or why it ended before the last row */
} iso_lane_job;

typedef struct iso_lane_options {
    double tolerance;
    long max_steps;            /* of one orbit; 0: no bound         */
    bool (*go_on)(void *data); /* asked at each step; NULL: nobody  */
    void *data;
} iso_lane_options;

/* One compilation: for processors with vectors of a certain width. */
typedef struct iso_lane_code {
    const char *name;
    int lanes;
    bool (*runs_here)(void);
    /* Solves jobs (one at least) of models that are alike and not stiff. False: no memory, or stopped by go_on; jobs
     * that are not done have no error then. */
    bool (*solve)(iso_lane_job *const jobs[], size_t count, const iso_lane_options *options);
} iso_lane_code;

/* The codes of this build, widest first, ended by NULL; the last runs everywhere. */
extern const iso_lane_code *const iso_lane_codes[];

/* The one called `name`, or for NULL the widest, that this processor can run; NULL: none. */
const iso_lane_code *iso_lane_code_find(const char *name);

/* Whether two models can share lanes: the same system, effects and clocks, and the same form of the equations. */
bool iso_lanes_alike(const iso_model *a, const iso_model *b);

extern const iso_lane_code iso_lanes_plain, iso_lanes_avx2, iso_lanes_avx512;

#endif

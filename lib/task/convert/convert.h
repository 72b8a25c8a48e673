/* convert.h - converts trajectories from one model to the other.
 *
 * A record can be converted, and converted back, if its lines say `k` and `J` (for a point also `h` or `eps`). Each
 * row's state goes through the map (18). The other model's clock is computed from each row to the next. The columns
 * are those of iso_column_name.
 *
 * Two-point Taylor quadrature gives the gain of the other clock between two rows. It also shows whether the two rows
 * lie on one orbit. Where they are too far apart for it, the orbit is integrated. A row that is not on the orbit of the
 * row before is converted as it stands. Sums of times are compensated.
 */
#ifndef ISO_TASK_CONVERT_CONVERT_H
#define ISO_TASK_CONVERT_CONVERT_H

#include <math.h>

#include "orbit/description.h"

/* The most steps from one row to the next. Without this limit a damaged time could keep a program busy for ever. */
enum { ISO_MAX_ROW_STEPS = 10000000 };

/* The largest value of something, relative, and its line. */
typedef struct iso_worst {
    double value;
    size_t line;
} iso_worst;

/* A line (h, eps, level.c) that the first row does not confirm, beyond rounding: the row's own number is written. */
typedef struct iso_stated {
    char key[ISO_NAME_SIZE];
    double stated, own; /* in the caller's units                                             */
    double off;         /* the difference of the energies, relative to the size of the terms */
} iso_stated;

typedef struct iso_conversion_summary {
    size_t rows, bad;     /* all rows, and those that could not be converted                                */
    size_t missed;        /* rows farther than max_defect from the orbit of the row before, or before it in time */
    size_t missed_line;   /* of the first of them                                                           */
    iso_worst constraint; /* ball: | |n| - 1 | and (omega,n)/|omega|; point: likewise                       */
    /* Ball: h against that of the first row; point: H against its level; relative to the size of the terms. */
    iso_worst energy;
    /* Distance of a row from the orbit through the row before it, relative to the length of each vector. If the
     * record has the other clock: also how far the unit vector moves in the time by which that clock is wrong. */
    iso_worst defect;
    /* The defects added up while the unit vector moves by half a radian. It grows if the rows follow other equations,
     * and averages out if they are only rounded. Rows that are missed are left out. */
    iso_worst drift;
    double max_defect, max_drift; /* that they may have; of the drift infinite where options set that of defects */
    bool checked;                 /* the record has a clock, so defect and drift are known                          */
    size_t between, integrated;   /* intervals by quadrature, and by integration                               */
    bool computed;                /* the other clock was computed                                                   */
    iso_clock clock;              /* the other clock                                                                */
    /* Its last value, and an estimate of its error: from the quadratures, the defects and the rounding of the sums. A
     * wrong k or J is not part of this estimate; it shows as drift. */
    double end, error;
    int stated_count; /* how many lines the first row does not confirm */
    iso_stated stated[3];
} iso_conversion_summary;

/* Converts `in` to the model `to`. *out has the clock, then the six columns, and one row for each row of `in`; a row
 * that is not on the orbit of the row before, or before it in time, as it stands. It is the study `convert`, which
 * also counts such rows. Errors; messages give the number of the row, from 1:
 * - those of iso_record_params;
 * - ISO_BAD_INPUT: a row is no state;
 * - ISO_NOT_MAPPED: a row is at rest; the M of a point does not fit eps or h of the record and the energy of the
 *   first row; or an effect breaks the isomorphism;
 * - ISO_NUMERICAL, ISO_NO_MEMORY. */
iso_status iso_convert(iso_context *ctx, const iso_record *in, iso_model_kind to, double tolerance, iso_record **out);

#endif

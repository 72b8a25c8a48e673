/* form_impl.h - the forms a closed solution can have: one table, used by exact.c. */
#ifndef ISO_EXACT_FORM_IMPL_H
#define ISO_EXACT_FORM_IMPL_H

#include "exact/elliptic_impl.h"
#include "exact/exact_impl.h"

/* A state, its clocks, and `along`: the form's own angle or clock, which grows with time. */
typedef struct form_place {
    double point[ISO_STATE];
    real clock[ISO_CLOCKS], along;
} form_place;

/* What a form makes of a start. */
typedef struct form_motion {
    void *data;            /* its own */
    real rate[ISO_CLOCKS]; /* at which a clock grows with form_place.along, in the mean; of those that are made */
    /* On a separatrix: the axis of the rotation that the orbit leaves and comes back to; else -1, as it is before. The
     * form is right until the orbit has come back, and wrong after that. */
    int unstable;
} form_motion;

typedef struct iso_form {
    bool (*serves)(const iso_problem *problem, const double point[ISO_STATE]);

    /* Errors: ISO_NUMERICAL (too many terms would be needed), ISO_NO_MEMORY; data is then released as well. The caller
     * writes the message. */
    iso_status (*make)(const iso_problem *problem, const double point[ISO_STATE], const bool clocks[ISO_CLOCKS],
                       form_motion *m);
    void (*free)(void *data);

    /* The place where `clock`, one of those made, shows `time`. If p->along is not NaN, it is a good guess. */
    void (*find)(const void *data, iso_clock clock, real time, form_place *p);

    void (*describe)(const void *data, const bool clocks[ISO_CLOCKS], iso_exact_torus *torus);
} iso_form;

extern const iso_form iso_form_rest, iso_form_revolution, iso_form_separated;

#endif

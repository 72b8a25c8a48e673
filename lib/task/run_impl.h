/* run_impl.h - what the study run is asked. */
#ifndef ISO_TASK_RUN_IMPL_H
#define ISO_TASK_RUN_IMPL_H

#include "study/options_impl.h"
#include "task/run.h"

/* The times of the rows are the scene's own, or those of a record of one column. */
typedef struct iso_run_request {
    iso_scene_changes change;
    bool verbose; /* find the errors of the rows, too, and tell */
} iso_run_request;

#endif

/* backend_impl.h - which backend `auto` means for the questions of a run. */
#ifndef ISO_STUDY_BACKEND_IMPL_H
#define ISO_STUDY_BACKEND_IMPL_H

#include "orbit/orbit.h"

/* What an orbit is asked for. */
typedef struct iso_questions {
    size_t rows;     /* this many times, ...                      */
    double farthest; /* ... this one the farthest, caller's units */
} iso_questions;

/* The orbit, as `how` says. ISO_BACKEND_AUTO there is the cheapest backend for the questions. If it has no such
 * orbit, it is what iso_orbit_create takes for ISO_BACKEND_AUTO. Errors: those of iso_orbit_create. */
iso_status iso_backend_open(iso_context *ctx, const iso_scene *scene, const iso_orbit_options *how,
                            const iso_questions *questions, iso_orbit **orbit);

#endif

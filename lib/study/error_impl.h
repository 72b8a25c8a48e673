/* error_impl.h - finds the errors of error.h. */
#ifndef ISO_STUDY_ERROR_IMPL_H
#define ISO_STUDY_ERROR_IMPL_H

#include "study/error.h"

typedef struct iso_error_finder iso_error_finder;

/* Starts the finer orbit. params, start and options are those that `orbit` was created with; the orbit must outlive
 * the finder. Errors: ISO_BAD_ARGUMENT where there is nothing finer: for taylor_quad, and for taylor_extended where
 * taylor_quad is missing; where series do not serve, for tolerances below 1e-13 and for backend exact. ISO_NO_MEMORY,
 * and the errors of iso_orbit_create. After an error *finder is NULL. */
iso_status iso_error_finder_create(iso_context *ctx, const iso_params *params, const iso_start *start,
                                   const iso_orbit_options *options, const iso_orbit *orbit,
                                   iso_error_finder **finder);
void iso_error_finder_free(iso_error_finder *finder);

/* Compares the next row of the orbit. Rows may come in any order, but are cheap in the order that suits iso_orbit_at.
 * Errors: ISO_NUMERICAL when the finer orbit does not get there, or needs more than twenty times the orbit's steps
 * (backend exact has no steps: more than 200000); ISO_STOPPED. After an error nothing is known of this row. */
iso_status iso_error_finder_add(iso_error_finder *finder, const iso_sample *row);

/* The errors of the rows so far; with rows = 0 nothing is known. */
iso_error iso_error_finder_read(const iso_error_finder *finder);

#endif

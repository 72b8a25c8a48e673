/* sweep.h - the rows of a sweep: what is measured at each of many points.
 *
 *     iso_sweep *sweep;
 *     iso_sweep_rows rows;
 *     const iso_sweep_head *head;
 *     status = iso_sweep_create(ctx, plan, &sweep);                     plan: sweep/sweep_file.h
 *     head = iso_sweep_head_of(sweep);
 *     iso_sweep_rows_create(ctx, head->columns, head->chunk, &rows);
 *     status = iso_sweep_compute(ctx, sweep, 3, &rows);                 chunk 3
 *     iso_sweep_free(sweep);
 *
 * or all chunks on many threads: iso_sweep_run.
 *
 * Each quantity calls the function of the library that its command calls. So its numbers are those that the command
 * gives for the scene of the point, to the bit, with the same vectors.
 *
 *     quantity     command                 numbers
 *     state        run, section            the state at the time `until`, or at the turn `until`
 *     chaos        chaos                   verdict, exponents, MEGNO, GALI_2; with starts: the chaotic share
 *     frequencies  frequencies             frequencies and rotation number
 *     splitting    splitting               x and m of the separatrix, and their errors
 *     rotations    periodic                half-turn traces of the rotations about the three axes
 *     backends     compare                 largest differences of the backends
 *     error        run --verbose           largest errors over the rows of `run`
 *     contact      run                     when contact is lost
 *
 * A verdict is 0 (regular), 1 (chaotic), 2 (undecided) or 3 (integrable).
 */
#ifndef ISO_STUDY_SWEEP_H
#define ISO_STUDY_SWEEP_H

#include "../base/api.h"
#include "family.h"

ISO_C_BEGIN

/* What can be measured, ended by NULL; for iso_sweep_read. */
ISO_API const iso_sweep_quantity *const *iso_sweep_quantities(void);

typedef struct iso_sweep iso_sweep;

/* The plan must live as long as the sweep. Errors: ISO_BAD_INPUT about the name of a quantity that the scene does not
 * have; ISO_BAD_ARGUMENT about "vectors"; ISO_NO_MEMORY. */
ISO_API iso_status iso_sweep_create(iso_context *ctx, const iso_sweep_plan *plan, iso_sweep **sweep);
ISO_API void iso_sweep_free(iso_sweep *sweep);

/* What its rows are. It is valid until the sweep is freed. */
ISO_API const iso_sweep_head *iso_sweep_head_of(const iso_sweep *sweep);

/* The same for `count` points from `first` on, at most rows->most. */
ISO_API iso_status iso_sweep_compute_points(iso_context *ctx, const iso_sweep *sweep, size_t first, size_t count,
                                            iso_sweep_rows *rows);

/* --- all chunks ------------------------------------------------------------------------------------------------- */

/* Where chunks come from and where their rows go. Both functions are called by one thread at a time. */
typedef struct iso_sweep_source {
    bool (*next)(void *data, size_t *c); /* the next chunk to be computed; false: there is none */
    /* The rows of a chunk. Any answer but ISO_OK ends the run: chunks that are being computed are thrown away. */
    iso_status (*take)(void *data, iso_context *ctx, size_t c, const iso_sweep_rows *rows);
    void *data;
} iso_sweep_source;

/* Measures chunks on `threads` threads (0: as many as there are processors) until there is no next one.
 * Errors: what `take` answers; ISO_STOPPED by the context's monitor, which is asked often and throws away what is
 * being computed (to let it end, let `next` answer false); ISO_NO_MEMORY. */
ISO_API iso_status iso_sweep_run(iso_context *ctx, const iso_sweep *sweep, int threads,
                                 const iso_sweep_source *source);

ISO_C_END

#endif

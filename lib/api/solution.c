/* solution.c - a solution that is asked for arrays of times, and batches of orbits. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/interface_impl.h"
#include "base/arithmetic_impl.h"
#include "base/context_impl.h"
#include "base/number_impl.h"
#include "orbit/batch.h"
#include "orbit/orbit_impl.h"
#include "task/run.h"
#include "task/task_impl.h"

static void keep_note(void *data, const char *text)
{
    iso_notes_add(data, text);
}

/* --- orbits ----------------------------------------------------------------------------------------------------- */

struct iso_solution {
    iso_context *ctx;
    iso_scene scene;
    iso_orbit *orbit;
    int columns[ISO_MAX_COLUMNS], count;
    bool starts_as_given; /* the row at time 0 has the numbers of the start, as in a run by auto */
};

void iso_solution_free(iso_solution *o)
{
    if (!o) return;
    iso_orbit_free(o->orbit);
    iso_context_free(o->ctx);
    free(o);
}

static iso_status no_orbit(iso_context *ctx)
{
    return iso_context_no_memory(ctx, "an orbit");
}

iso_status iso_solution_create(iso_context *ctx, const iso_scene *scene, iso_solution **solution)
{
    iso_solution *o = calloc(1, sizeof *o);
    *solution = NULL;
    if (!o) return no_orbit(ctx);
    o->ctx = iso_context_create();
    if (!o->ctx) return iso_solution_free(o), no_orbit(ctx);
    o->scene = *scene;
    o->count = iso_scene_columns(&o->scene, o->columns);
    iso_status status = iso_scene_check_columns(o->ctx, &o->scene);
    if (status == ISO_OK) status = iso_scene_orbit(o->ctx, &o->scene, o->columns, o->count, &o->orbit);
    if (status == ISO_OK) {
        o->starts_as_given = o->scene.backend == ISO_BACKEND_AUTO && o->scene.start.model == ISO_BALL;
        o->scene.backend = iso_orbit_backend(o->orbit); /* auto may depend on the rows that are asked for */
        *solution = o;
        return ISO_OK;
    }
    status = iso_blame_scene(o->ctx, scene, status);
    iso_context_fail(ctx, status, iso_context_about(o->ctx), "%s", iso_context_message(o->ctx));
    iso_solution_free(o);
    return status;
}

iso_context *iso_solution_context(const iso_solution *o)
{
    return o->ctx;
}

const char *iso_solution_word(const iso_solution *o, const char *key)
{
    if (strcmp(key, "backend") == 0) return iso_backend_name((int)iso_orbit_backend(o->orbit));
    if (strcmp(key, "method") == 0) return iso_orbit_exact(o->orbit) ? "" : iso_orbit_method(o->orbit)->name;
    if (strcmp(key, "models") == 0) return iso_orbit_has_twin(o->orbit) ? "both" : "ball";
    return NULL;
}

double iso_solution_number(const iso_solution *o, const char *key)
{
    if (strcmp(key, "h") == 0) return iso_orbit_energy(o->orbit);
    return strcmp(key, "eps") == 0 ? iso_orbit_coupling(o->orbit) : (double)NAN;
}

/* --- an orbit at many times ------------------------------------------------------------------------------------- */

static iso_status fill_row(iso_solution *o, double time, double row[])
{
    iso_sample sample;
    if (!iso_context_goes_on(o->ctx)) return iso_context_stopped(o->ctx);
    const iso_status status = iso_orbit_at(o->orbit, time, &sample);
    if (status == ISO_OK && time == 0 && o->starts_as_given && !isnan(sample.ball[0]))
        memcpy(sample.ball, o->scene.start.y, sizeof sample.ball);
    for (int c = 0; status == ISO_OK && c < o->count; c++) row[c] = iso_sample_column(&sample, o->columns[c]);
    return status;
}

/* A ball that can lose contact: a run watches it. Where it has lost it there is no row, which is refused. */
static iso_status fill_watched(iso_solution *o, const double times[], size_t count, double table[], notes *n)
{
    iso_record *rows = NULL;
    const iso_sink sink = {.note = keep_note, .data = n};
    iso_run_options how = iso_run_defaults();
    iso_run_result r;
    how.times = times;
    how.count = count;
    const iso_status status = iso_run(o->ctx, &o->scene, &how, &sink, &rows, &r);
    if (status == ISO_OK && r.rows > 0)
        memcpy(table, iso_record_row(rows, 0), r.rows * (size_t)o->count * sizeof *table);
    iso_record_free(rows);
    if (status != ISO_OK) return status;
    for (size_t i = 0; i < count; i++) {
        const int side = times[i] < 0;
        if (r.lost[side] && fabs(times[i]) > fabs(r.lost_at[side]))
            return iso_context_fail(o->ctx, ISO_NUMERICAL, "reactions",
                                    "contact is lost at %s: at %s the ball is not on its support; "
                                    "'reactions: {two_sided: true}' goes on",
                                    ISO_SHORT(r.lost_at[side]), ISO_SHORT(times[i]));
    }
    return ISO_OK;
}

iso_status iso_solution_at(iso_solution *o, const double times[], size_t count, double table[], char text[],
                           size_t room)
{
    ISO_DEFAULT_ARITHMETIC;
    notes n = iso_notes_begin(text, room);
    iso_status status = ISO_OK;
    if (!times && count > 0) return ISO_FAIL_ARGUMENT(o->ctx, "times", "%zu times are at NULL", count);
    for (size_t i = 0; i < count; i++)
        if (!isfinite(times[i]))
            return iso_context_fail(o->ctx, ISO_BAD_ARGUMENT, "times", "time %zu must be finite, not %s", i,
                                    ISO_SHORT(times[i]));
    if (count > 0 && iso_effects_watch_contact(&o->scene.effects)) return fill_watched(o, times, count, table, &n);
    const bool in_order = iso_times_in_order(times, count);
    iso_asked_time *order = in_order ? NULL : iso_times_sorted(times, count);
    if (!order && !in_order) return no_orbit(o->ctx);
    for (size_t i = 0; status == ISO_OK && i < count; i++) {
        const size_t row = order ? order[i].row : i;
        status = fill_row(o, times[row], table + row * (size_t)o->count);
    }
    free(order);
    return status;
}

/* --- many orbits ------------------------------------------------------------------------------------------------ */

_Static_assert(sizeof(iso_status) == sizeof(int32_t), "a status has 32 bits");

iso_status iso_batch(iso_context *ctx, const iso_scene *const scene[], size_t scenes, size_t count, const double k[],
                     const double J[], const double start[], const double times[], size_t rows, int threads,
                     const char *vectors, double table[], int32_t status[])
{
    return iso_batch_table(ctx, scene, scenes, count, k, J, start, times, rows, threads, vectors, table,
                           (iso_status *)status);
}

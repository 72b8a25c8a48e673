/* sweep_explain.c - says how many points a sweep has, and measures what they cost here. */
#define _GNU_SOURCE /* asprintf */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_impl.h"
#include "base/fold_impl.h"
#include "base/pool_impl.h"
#include "base/resources_impl.h"
#include "sweep/sweep_impl.h"

/* Places of the sweep at which points are computed, how many of each, and for how long at most. A chaotic share is
 * measured with STARTS orbits where it asks for many more: its time grows with them. */
enum { PLACES = 8, POINTS = 64, STARTS = 48 };
static const double patience = 10; /* seconds for each quantity */

/* Seconds of one point: the mean of the places, and the slowest place. */
typedef struct cost {
    double mean, most;
    size_t points, failed, places;
} cost;

/* Every place stands for as many points of the sweep, so it counts the same, however many points were computed there.
 * A point by itself comes first: it shows whether many can be computed, and warms up. */
static iso_status measure(iso_context *ctx, const iso_sweep *sweep, iso_sweep_rows *rows, double scale, cost *c)
{
    static const int order[PLACES] = {4, 1, 6, 3, 7, 0, 5, 2}; /* if time is short, places far from each other */
    const size_t points = iso_sweep_head_of(sweep)->count;
    double total = 0, slowest = 0;
    for (size_t p = 0; p < PLACES && (points >= PLACES || p < points) && total < patience; p++) {
        const size_t first = (size_t)((order[p] + 0.5) / PLACES * (double)points);
        size_t count = points < PLACES ? 1 : rows->most < POINTS ? rows->most : POINTS;
        double time = 0;
        if (count > points - first) count = points - first;
        for (int warm = p == 0; warm >= 0; warm--) {
            if (slowest * (double)count > patience) count = 1; /* they are slow */
            if (p == 0 && !warm && count == 1) break;
            const size_t now = warm ? 1 : count;
            const double before = processor_seconds();
            ISO_TRY(iso_sweep_compute_points(ctx, sweep, first, now, rows));
            time = processor_seconds() - before;
            total += time;
            slowest = fmax(slowest, time / (double)now);
        }
        c->points += count;
        c->mean += scale * time / (double)count;
        c->most = fmax(c->most, scale * time / (double)count);
        for (size_t i = 0; i < count; i++) c->failed += rows->status[i] != ISO_OK;
        c->places++;
    }
    c->mean /= (double)c->places;
    return ISO_OK;
}

/* One quantity by itself. */
static iso_status measure_quantity(iso_context *ctx, const iso_sweep_plan *plan, int which, size_t chunk, cost *c)
{
    iso_sweep_plan one = *plan;
    iso_sweep *sweep;
    iso_sweep_rows rows = {.number = NULL};
    char *options = NULL;
    const char *own = plan->request[which].options, *starts = iso_sweep_option(own, "starts");
    const double scale = starts && strtod(starts, NULL) > 2 * STARTS ? strtod(starts, NULL) / STARTS : 1;
    if (scale > 1 && asprintf(&options, "%sstarts=%d\n", own, STARTS) < 0)
        return iso_context_no_memory(ctx, "a sweep");
    one.requests = 1;
    one.request[0] = plan->request[which];
    if (options) one.request[0].options = options;
    one.chunk = chunk;
    iso_status status = iso_sweep_create(ctx, &one, &sweep);
    if (status == ISO_OK) status = iso_sweep_rows_create(ctx, iso_sweep_head_of(sweep)->columns, chunk, &rows);
    if (status == ISO_OK) status = measure(ctx, sweep, &rows, scale, c);
    iso_sweep_rows_free(&rows);
    iso_sweep_free(sweep);
    free(options);
    return status;
}

static const char *time_text(double seconds, char text[24])
{
    if (seconds < 1)
        snprintf(text, 24, "%.*f ms", seconds < 1e-3 ? 3 : seconds < 0.1 ? 1 : 0, 1e3 * seconds);
    else if (seconds < 120)
        snprintf(text, 24, "%.*f s", seconds < 10, seconds);
    else if (seconds < 7200)
        snprintf(text, 24, "%.0f minutes", seconds / 60);
    else
        snprintf(text, 24, seconds < 172800 ? "%.3g hours" : "%.3g days",
                 seconds / (seconds < 172800 ? 3600 : 86400));
    return text;
}

/* The time first, which is what one asks for; then how it was found. */
static void print(FILE *to, const iso_sweep_file *file, const iso_sweep_head *head, const cost costs[])
{
    const iso_sweep_plan *plan = iso_sweep_file_plan(file);
    const size_t processors = iso_pool_threads(0, SIZE_MAX - 1, 1);
    char one[24], other[24];
    double mean = 0;
    for (int i = 0; i < plan->requests; i++) mean += costs[i].mean;
    const double all = mean * (double)head->count;
    fprintf(to, "time\n  about %s of processor time; here, with %zu threads, about %s\n", time_text(all, one),
            processors, time_text(all / (double)processors, other));
    fprintf(to, "  a chunk takes about %s\n", time_text(mean * (double)iso_sweep_chunk_points(head, 0), one));
    fprintf(to, "  a file of about %.3g MB\n", ((double)head->columns + 0.5) * 8e-6 * (double)head->count);
    fprintf(to, "\nsweep\n  %zu points in %zu chunks of %zu; %d columns; vectors %s\n", head->count,
            iso_sweep_chunks(head), head->chunk, head->columns, head->vectors);
    iso_sweep_print_axes(file, to);
    fprintf(to, "\nmeasured\n");
    for (int i = 0; i < plan->requests; i++) {
        const cost *c = &costs[i];
        const char *name = plan->request[i].name;
        fprintf(to, "  %-12s %s\n  %-12s %s a point, up to %s", name, iso_sweep_study(name)->doc, "",
                time_text(c->mean, one), time_text(c->most, other));
        fprintf(to, " (%zu points, %zu of them failed%s); columns", c->points, c->failed,
                c->places < 2 && head->count > 1 ? "; one place alone: others may take several times as long" : "");
        for (int j = 0; j < head->columns; j++)
            if (strcmp(head->column[j].group, name) == 0) fprintf(to, " %s", head->column[j].name);
        fprintf(to, "\n");
    }
}

iso_status iso_sweep_explain(iso_context *ctx, const iso_sweep_file *file, char **text)
{
    const iso_sweep_plan *plan = iso_sweep_file_plan(file);
    cost costs[ISO_SWEEP_REQUESTS] = {{.mean = 0}};
    iso_sweep *sweep;
    iso_memory memory;
    *text = NULL;
    ISO_TRY(iso_sweep_create(ctx, plan, &sweep));
    const iso_sweep_head *head = iso_sweep_head_of(sweep);
    iso_status status = ISO_OK;
    for (int i = 0; i < plan->requests && status == ISO_OK; i++)
        status = measure_quantity(ctx, plan, i, head->chunk, &costs[i]);
    FILE *to = status == ISO_OK ? iso_memory_open(&memory) : NULL;
    if (to) print(to, file, head, costs);
    if (status == ISO_OK && !(*text = iso_memory_close(to, &memory))) status = iso_context_no_memory(ctx, "a text");
    iso_sweep_free(sweep);
    return status;
}

/* sweep_explain.c - tells how many points a sweep has, and measures what they cost here. */
#define _GNU_SOURCE /* asprintf */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_impl.h"
#include "base/pool_impl.h"
#include "base/seconds_impl.h"
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

static iso_status seconds_of(iso_context *ctx, const iso_sweep *sweep, size_t first, size_t count,
                             iso_sweep_rows *rows, double *seconds)
{
    const double before = processor_seconds();
    const iso_status status = iso_sweep_compute_points(ctx, sweep, first, count, rows);
    *seconds = processor_seconds() - before;
    return status;
}

/* Every place stands for as many points of the sweep, so it counts the same, however many points were computed there.
 * A point by itself comes first: it tells whether many can be computed, and warms up. */
static iso_status measure(iso_context *ctx, const iso_sweep *sweep, iso_sweep_rows *rows, cost *c)
{
    static const int order[PLACES] = {4, 1, 6, 3, 7, 0, 5, 2}; /* if time is short, places far from each other */
    const iso_sweep_head *head = iso_sweep_head_of(sweep);
    double total = 0, slowest = 0;
    *c = (cost){.mean = 0};
    for (size_t p = 0; p < PLACES && total < patience; p++) {
        const size_t first = (size_t)((order[p] + 0.5) / PLACES * (double)head->count);
        if (head->count < PLACES && p >= head->count) break;
        size_t count = head->count < PLACES ? 1 : rows->most < POINTS ? rows->most : POINTS;
        if (count > head->count - first) count = head->count - first;
        double time = 0;
        if (p == 0) ISO_TRY(seconds_of(ctx, sweep, first, 1, rows, &time));
        slowest = fmax(slowest, time);
        total += time;
        if (slowest * (double)count > patience) count = 1; /* they are slow */
        if (p > 0 || count > 1) {
            ISO_TRY(seconds_of(ctx, sweep, first, count, rows, &time));
            total += time;
        }
        const double each = time / (double)count;
        slowest = fmax(slowest, each);
        c->points += count;
        c->mean += each;
        c->most = fmax(c->most, each);
        for (size_t i = 0; i < count; i++) c->failed += rows->status[i] != ISO_OK;
        c->places++;
    }
    c->mean /= (double)c->places;
    return ISO_OK;
}

static void print_time(FILE *to, double seconds)
{
    if (seconds < 1)
        fprintf(to, "%.*f ms", seconds < 1e-3 ? 3 : seconds < 0.1 ? 1 : 0, 1e3 * seconds);
    else if (seconds < 120)
        fprintf(to, "%.*f s", seconds < 10, seconds);
    else if (seconds < 7200)
        fprintf(to, "%.0f minutes", seconds / 60);
    else if (seconds < 172800)
        fprintf(to, "%.3g hours", seconds / 3600);
    else
        fprintf(to, "%.3g days", seconds / 86400);
}

/* Options with few starts in place of many, to be freed. *scale: by how much a point with all its starts takes longer.
 * NULL: no memory. */
static char *with_few_starts(const char *options, double *scale)
{
    const char *text = iso_sweep_option(options, "starts");
    const double starts = text ? strtod(text, NULL) : 0;
    char *few = NULL;
    *scale = starts > 2 * STARTS ? starts / STARTS : 1;
    const int length =
        *scale > 1 ? asprintf(&few, "%sstarts=%d\n", options, STARTS) : asprintf(&few, "%s", options ? options : "");
    return length < 0 ? NULL : few;
}

/* One quantity by itself; *mean: seconds of a point. */
static iso_status explain_quantity(iso_context *ctx, const iso_sweep_plan *plan, int which, size_t chunk, FILE *to,
                                   double *mean)
{
    iso_sweep_plan one = *plan;
    iso_sweep *sweep;
    iso_sweep_rows rows;
    cost c = {.mean = 0};
    one.requests = 1;
    one.request[0] = plan->request[which];
    one.chunk = chunk;
    double scale;
    char *options = with_few_starts(one.request[0].options, &scale);
    if (!options) return iso_context_no_memory(ctx, "words");
    const char *name = one.request[0].name;
    one.request[0].options = options;
    iso_status status = iso_sweep_create(ctx, &one, &sweep);
    if (status != ISO_OK) return free(options), status;
    status = iso_sweep_rows_create(ctx, iso_sweep_head_of(sweep)->columns, chunk, &rows);
    if (status == ISO_OK) status = measure(ctx, sweep, &rows, &c);
    c.mean *= scale;
    c.most *= scale;
    if (status == ISO_OK) {
        fprintf(to, "  %-12s %s\n  %-12s ", name, iso_sweep_study(name)->doc, "");
        print_time(to, c.mean);
        fprintf(to, " a point, up to ");
        print_time(to, c.most);
        const iso_sweep_head *head = iso_sweep_head_of(sweep);
        const bool alone = c.places < 2 && head->count > 1;
        fprintf(to, " (%zu points, %zu of them failed%s); columns", c.points, c.failed,
                alone ? "; one place alone: others may take several times as long" : "");
        for (int i = plan->family.columns; i < head->columns; i++) fprintf(to, " %s", head->column[i].name);
        fprintf(to, "\n");
        *mean = c.mean;
    }
    iso_sweep_rows_free(&rows);
    iso_sweep_free(sweep);
    free(options);
    return status;
}

/* All quantities, in words into `to`; *mean: seconds of a point. */
static iso_status explain_quantities(iso_context *ctx, const iso_sweep_plan *plan, size_t chunk, FILE *to,
                                     double *mean)
{
    iso_status status = ISO_OK;
    *mean = 0;
    for (int i = 0; i < plan->requests && status == ISO_OK; i++) {
        double one = 0;
        status = explain_quantity(ctx, plan, i, chunk, to, &one);
        *mean += one;
    }
    return status;
}

/* The time first, which is what one asks for; then how it was found. */
static void tell(FILE *to, const iso_sweep_file *file, const iso_sweep_head *head, double mean, const char *measured)
{
    const size_t processors = iso_pool_threads(0, SIZE_MAX - 1, 1);
    const double all = mean * (double)head->count;
    char words[ISO_SWEEP_WORDS];
    fprintf(to, "time\n  about ");
    print_time(to, all);
    fprintf(to, " of processor time; here, with %zu threads, about ", processors);
    print_time(to, all / (double)processors);
    fprintf(to, "\n  a chunk takes about ");
    print_time(to, mean * (double)iso_sweep_chunk_points(head, 0));
    fprintf(to, "\n  a file of about %.3g MB\n", ((double)head->columns + 0.5) * 8e-6 * (double)head->count);
    fprintf(to, "\nsweep\n  %zu points in %zu chunks of %zu; %d columns; vectors %s\n", head->count,
            iso_sweep_chunks(head), head->chunk, head->columns, head->vectors);
    for (int i = 0; iso_sweep_axis_words(file, i, words); i++) fprintf(to, "  %s\n", words);
    fprintf(to, "\nmeasured\n%s", measured);
}

/* All words, into `to`. */
static iso_status explain(iso_context *ctx, const iso_sweep_file *file, FILE *to)
{
    const iso_sweep_plan *plan = iso_sweep_file_plan(file);
    iso_sweep *sweep;
    double mean = 0;
    char *measured = NULL;
    size_t size;
    ISO_TRY(iso_sweep_create(ctx, plan, &sweep));
    const iso_sweep_head *head = iso_sweep_head_of(sweep);
    FILE *parts = open_memstream(&measured, &size);
    iso_status status =
        parts ? explain_quantities(ctx, plan, head->chunk, parts, &mean) : iso_context_no_memory(ctx, "words");
    if (parts && fclose(parts) != 0 && status == ISO_OK) status = iso_context_no_memory(ctx, "words");
    if (status == ISO_OK) tell(to, file, head, mean, measured);
    free(measured);
    iso_sweep_free(sweep);
    return status;
}

iso_status iso_sweep_explain(iso_context *ctx, const iso_sweep_file *file, char **text)
{
    size_t size;
    *text = NULL;
    FILE *to = open_memstream(text, &size);
    if (!to) return iso_context_no_memory(ctx, "words");
    iso_status status = explain(ctx, file, to);
    if (fclose(to) != 0 && status == ISO_OK) status = iso_context_no_memory(ctx, "words");
    if (status == ISO_OK) return ISO_OK;
    free(*text);
    *text = NULL;
    return status;
}

/* What a sweep costs beside its orbits, and how it uses threads.
 *
 *     bench_sweep [ORBITS] [TURNS] [THREADS]        default 20000, 100, 2
 *
 * 1. Dispatch: the time of a chunk outside of the orbits: it is chosen, its rows go into the journal.
 * 2. Rate: orbits of k = 0.5, J = (1, 2, 5), spread over the section, with verdicts by the point. First by
 *    iso_chaos_run, as starts of one scene, on one thread; then as points of a sweep, on one thread and on all.
 * 3. Memory: the largest resident set after each.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "bench.h"
#include "io/sweep_file.h"
#include "io/sweep_store.h"
#include "study/chaos.h"
#include "study/sweep.h"

static iso_context *ctx;

static void must(iso_status status)
{
    if (status == ISO_OK) return;
    fprintf(stderr, "%s\n", iso_context_message(ctx));
    exit(1);
}

static double memory(void)
{
    struct rusage r;
    getrusage(RUSAGE_SELF, &r);
    return (double)r.ru_maxrss / 1024;
}

static iso_sweep_file *sweep_of(size_t orbits, long turns, size_t chunk)
{
    char text[512], more[32] = "";
    iso_sweep_file *file;
    if (chunk > 0) snprintf(more, sizeof more, "chunk: %zu\n", chunk);
    snprintf(text, sizeof text,
             "scene: {reduced: {k: 0.5, J: [1, 2, 5]}, time: {end: 1}, initial:\n"
             "  {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}}\n"
             "vary: {start: {spread: %zu}}\nmeasure: {chaos: {model: point}}\nuntil: {turns: %ld}\n%s",
             orbits, turns, more);
    must(iso_sweep_parse(ctx, "bench.yaml", text, strlen(text), iso_sweep_topics(), &file));
    return file;
}

typedef struct work {
    iso_sweep_journal *journal;
    size_t next, chunks;
} work;

static bool next_chunk(void *data, size_t *c)
{
    work *w = data;
    *c = w->next++;
    return *c < w->chunks;
}

static iso_status take_chunk(void *data, iso_context *of, size_t c, const iso_sweep_rows *rows)
{
    const work *w = data;
    return iso_sweep_journal_add(of, w->journal, c, rows);
}

/* Rows that are there already: only the journal works. */
static void dispatch(size_t chunk)
{
    enum { CHUNKS = 4000 };
    char path[64];
    iso_sweep *sweep;
    iso_sweep_rows rows;
    work w = {.chunks = CHUNKS};
    iso_sweep_file *file = sweep_of(CHUNKS * chunk, 100, chunk);
    must(iso_sweep_create(ctx, iso_sweep_file_plan(file), &sweep));
    const iso_sweep_head *head = iso_sweep_head_of(sweep);
    must(iso_sweep_rows_create(ctx, head->columns, chunk, &rows));
    snprintf(path, sizeof path, "/tmp/bench_sweep_%ld.csv", (long)getpid());
    must(iso_sweep_journal_open(ctx, path, head, (iso_sweep_share){0, 1}, false, &w.journal));
    rows.count = chunk;
    const double before = bench_wall_milliseconds();
    for (size_t c; next_chunk(&w, &c);) {
        rows.first = c * chunk;
        must(take_chunk(&w, ctx, c, &rows));
    }
    printf("dispatch: %7.2f us a chunk of %zu points, %d columns\n",
           1e3 * (bench_wall_milliseconds() - before) / CHUNKS, chunk, head->columns);
    iso_sweep_journal_close(w.journal);
    strcat(path, ".part");
    unlink(path);
    iso_sweep_rows_free(&rows);
    iso_sweep_free(sweep);
    iso_sweep_file_free(file);
}

static double by_starts(size_t orbits, long turns)
{
    iso_sweep_file *file = sweep_of(orbits, turns, 0);
    iso_chaos_options o = iso_chaos_defaults();
    iso_chaos *c;
    o.starts = orbits;
    o.turns = turns;
    o.models = ISO_SHOW_POINT;
    o.threads = 1;
    const double before = bench_wall_milliseconds();
    must(iso_chaos_run(ctx, iso_sweep_file_plan(file)->family.base, &o, &c));
    const double time = bench_wall_milliseconds() - before;
    iso_chaos_free(c);
    iso_sweep_file_free(file);
    return (double)orbits / time * 1e3;
}

static double by_sweep(size_t orbits, long turns, int threads)
{
    iso_sweep_file *file = sweep_of(orbits, turns, 0);
    iso_sweep *sweep;
    work w = {.next = 0};
    must(iso_sweep_create(ctx, iso_sweep_file_plan(file), &sweep));
    const iso_sweep_head *head = iso_sweep_head_of(sweep);
    w.chunks = iso_sweep_chunks(head);
    must(iso_sweep_journal_open(ctx, "/dev/null", head, (iso_sweep_share){0, 1}, false, &w.journal));
    const iso_sweep_source source = {next_chunk, take_chunk, &w};
    const double before = bench_wall_milliseconds();
    must(iso_sweep_run(ctx, sweep, threads, &source));
    must(iso_sweep_journal_finish(ctx, w.journal));
    const double time = bench_wall_milliseconds() - before;
    iso_sweep_journal_close(w.journal);
    iso_sweep_free(sweep);
    iso_sweep_file_free(file);
    return (double)orbits / time * 1e3;
}

int main(int argc, char **argv)
{
    const size_t orbits = argc > 1 ? strtoul(argv[1], NULL, 10) : 20000;
    const long turns = argc > 2 ? atol(argv[2]) : 100;
    const int threads = argc > 3 ? atoi(argv[3]) : 2;
    ctx = iso_context_create();
    dispatch(1);
    dispatch(8);
    dispatch(512);
    const double starts = by_starts(orbits, turns), one = by_sweep(orbits, turns, 1);
    printf("starts of one scene, 1 thread: %9.0f orbits/s\n", starts);
    printf("sweep, 1 thread:               %9.0f orbits/s, %.3f of that; %.0f MB\n", one, one / starts, memory());
    const double all = by_sweep(orbits, turns, threads);
    printf("sweep, %d threads:              %9.0f orbits/s, %.3f of %d times that; %.0f MB\n", threads, all,
           all / (threads * one), threads, memory());
    iso_context_free(ctx);
    return 0;
}

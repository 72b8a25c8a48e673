/* What a sweep costs beside its orbits, and how it uses threads.
 *
 *     bench_sweep [ORBITS] [TURNS] [THREADS]        default 20000, 100, 2
 *
 * 1. Dispatch: the time of a chunk outside of the orbits: it is chosen, its rows go into the store. Behind it
 *    stands what the system takes to write as many bytes to a file.
 * 2. Rate: orbits of k = 0.5, J = (1, 2, 5), spread over the section, with verdicts by the point. First by
 *    iso_chaos_run, as starts of one scene, on one thread; then as points of a sweep, on one thread and on all.
 *    Behind the rate on the wall stands that of a second of processor time, which other programs disturb less.
 * 3. Memory: the largest resident set after each.
 */
#include <sys/resource.h>
#include <unistd.h>

#include "bench.h"
#include "instrument/chaos/chaos.h"
#include "sweep/sweep_store_impl.h"

static iso_context *ctx;

static void must(iso_status status)
{
    bench_must(ctx, status);
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
    must(iso_sweep_parse(ctx, "bench.yaml", text, strlen(text), &file));
    return file;
}

typedef struct work {
    iso_sweep_store *store;
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
    (void)c;
    return iso_sweep_store_add(of, w->store, rows);
}

enum { CHUNKS = 4000 };

/* Microseconds of a write of so many bytes to the end of a file, without anything else. */
static double plain_write(const char *path, size_t length)
{
    FILE *file = fopen(path, "w+e");
    char *bytes = calloc(1, length);
    if (!file || !bytes) exit(1);
    const double before = bench_wall_milliseconds();
    for (int i = 0; i < CHUNKS; i++)
        if (pwrite(fileno(file), bytes, length, (off_t)length * i) != (ssize_t)length) exit(1);
    const double time = bench_wall_milliseconds() - before;
    free(bytes);
    fclose(file);
    unlink(path);
    return 1e3 * time / CHUNKS;
}

/* Rows that are there already: only the store works. */
static void dispatch(size_t chunk)
{
    char path[64];
    iso_sweep *sweep;
    iso_sweep_rows rows;
    work w = {.chunks = CHUNKS};
    iso_sweep_file *file = sweep_of(CHUNKS * chunk, 100, chunk);
    must(iso_sweep_create(ctx, iso_sweep_file_plan(file), &sweep));
    const iso_sweep_head *head = iso_sweep_head_of(sweep);
    must(iso_sweep_rows_create(ctx, head->columns, chunk, &rows));
    snprintf(path, sizeof path, "/tmp/bench_sweep_%ld.csv", (long)getpid());
    must(iso_sweep_store_open(ctx, path, head, (iso_sweep_shard){0, 1}, false, &w.store));
    rows.count = chunk;
    const double before = bench_wall_milliseconds();
    for (size_t c; next_chunk(&w, &c);) {
        rows.first = c * chunk;
        must(take_chunk(&w, ctx, c, &rows));
    }
    const double time = 1e3 * (bench_wall_milliseconds() - before) / CHUNKS;
    iso_sweep_store_close(w.store);
    strcat(path, ".part");
    unlink(path);
    const size_t length = chunk * (8 * (size_t)head->columns + 4);
    printf("dispatch: %7.2f us a chunk of %zu points; to write its %zu bytes alone: %.2f us\n", time, chunk, length,
           plain_write(path, length));
    iso_sweep_rows_free(&rows);
    iso_sweep_free(sweep);
    iso_sweep_file_free(file);
}

static double by_starts(size_t orbits, long turns, double *processor)
{
    iso_sweep_file *file = sweep_of(orbits, turns, 0);
    iso_chaos_options o = iso_chaos_defaults();
    iso_chaos *c;
    o.starts = orbits;
    o.turns = turns;
    o.models = ISO_SHOW_POINT;
    o.threads = 1;
    const double before = bench_wall_milliseconds(), busy = bench_busy_milliseconds();
    must(iso_chaos_run(ctx, iso_sweep_file_plan(file)->family.base, &o, &c));
    const double time = bench_wall_milliseconds() - before;
    *processor = (double)orbits / (bench_busy_milliseconds() - busy) * 1e3;
    iso_chaos_free(c);
    iso_sweep_file_free(file);
    return (double)orbits / time * 1e3;
}

static double by_sweep(size_t orbits, long turns, int threads, double *processor)
{
    iso_sweep_file *file = sweep_of(orbits, turns, 0);
    iso_sweep *sweep;
    work w = {.next = 0};
    must(iso_sweep_create(ctx, iso_sweep_file_plan(file), &sweep));
    const iso_sweep_head *head = iso_sweep_head_of(sweep);
    w.chunks = iso_sweep_chunks(head);
    must(iso_sweep_store_open(ctx, "/dev/null", head, (iso_sweep_shard){0, 1}, false, &w.store));
    const iso_sweep_source source = {next_chunk, take_chunk, &w};
    const double before = bench_wall_milliseconds(), busy = bench_busy_milliseconds();
    must(iso_sweep_run(ctx, sweep, threads, &source));
    must(iso_sweep_store_finish(ctx, w.store));
    const double time = bench_wall_milliseconds() - before;
    *processor = (double)orbits / (bench_busy_milliseconds() - busy) * 1e3;
    iso_sweep_store_close(w.store);
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
    double cpu[3];
    const double starts = by_starts(orbits, turns, &cpu[0]);
    printf("starts of one scene, 1 thread: %7.0f orbits/s, %7.0f per processor second\n", starts, cpu[0]);
    const double one = by_sweep(orbits, turns, 1, &cpu[1]);
    printf("sweep, 1 thread:               %7.0f orbits/s, %7.0f: %.3f of the starts; %.0f MB\n", one, cpu[1],
           cpu[1] / cpu[0], memory());
    const double all = by_sweep(orbits, turns, threads, &cpu[2]);
    printf("sweep, %d threads:              %7.0f orbits/s, %7.0f: %.3f of one thread; %.0f MB\n", threads, all,
           cpu[2], cpu[2] / cpu[1], memory());
    iso_context_free(ctx);
    return 0;
}

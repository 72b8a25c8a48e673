/* What efficiency a sweep would reach on many ranks of MPI: a simulation with times that are measured here.
 *
 *     bench_sweep_ranks [FETCH] [MESSAGE]        microseconds; default 5 and 15
 *
 * FETCH: the counter is busy so long for a chunk. MESSAGE: rank 0 is busy so long for a message, besides its rows.
 * `ISOROLL_TIMES=1 mpirun ... isoroll-mpi sweep ...` prints both for a machine.
 *
 * Measured: how the times of chunks are spread (chaotic shares at 60 values of k: their mean is scaled to what the
 * table says), and what a row costs the writer, in FILE.part and in the result.
 *
 * Simulated: every rank fetches a chunk, computes it, and waits until rank 0 has written it. The counter serves one
 * rank at a time, and so does rank 0, which looks for messages every millisecond when it has none. Each rank computes
 * 100 chunks; the time until the first rank finds no chunk gives the rate, what follows is the tail. A day's work is a
 * day at this rate, the tail, and the writing of the result.
 */
#include <unistd.h>

#include "bench.h"
#include "sweep/sweep_impl.h"
#include "sweep/sweep_store_impl.h"

enum { SAMPLES = 60, PER_RANK = 100, DAY = 86400 };

static iso_context *ctx;

static void must(iso_status status)
{
    bench_must(ctx, status);
}

/* --- measuring -------------------------------------------------------------------------------------------------- */

static iso_sweep *sweep_of(const char *text, iso_sweep_file **file)
{
    iso_sweep *sweep;
    must(iso_sweep_parse(ctx, "bench.yaml", text, strlen(text), file));
    must(iso_sweep_create(ctx, iso_sweep_file_plan(*file), &sweep));
    return sweep;
}

#define SCENE                                                                                                        \
    "scene: {reduced: {k: 0.5, J: [1, 2, 5]}, time: {end: 1}, initial:\n"                                            \
    "  {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}}\n"

/* Relative to their mean. */
static void measure_chunks(double times[SAMPLES])
{
    iso_sweep_file *file;
    iso_sweep *sweep = sweep_of(SCENE "vary: {k: [{from: -3, to: -0.1, count: 30}, {from: 0.1, to: 3, count: 30}]}\n"
                                      "measure: {chaos: {starts: 40, model: point}}\nuntil: {turns: 200}\nchunk: 1\n",
                                &file);
    iso_sweep_rows rows;
    double sum = 0, largest = 0;
    must(iso_sweep_rows_create(ctx, iso_sweep_head_of(sweep)->columns, 1, &rows));
    for (size_t i = 0; i < SAMPLES; i++) {
        const double begun = bench_milliseconds();
        must(iso_sweep_compute_points(ctx, sweep, i, 1, &rows));
        times[i] = bench_milliseconds() - begun;
        sum += times[i];
    }
    for (int i = 0; i < SAMPLES; i++) {
        times[i] *= SAMPLES / sum;
        if (times[i] > largest) largest = times[i];
    }
    printf("chunks: mean %.1f ms here, the longest %.2f of it\n", sum / SAMPLES, largest);
    iso_sweep_rows_free(&rows);
    iso_sweep_free(sweep);
    iso_sweep_file_free(file);
}

/* Microseconds of a row in FILE.part, and in the result. */
static void measure_rows(double *part_row, double *result_row)
{
    enum { CHUNKS = 200, CHUNK = 1000 };
    iso_sweep_file *file;
    iso_sweep *sweep = sweep_of(SCENE "vary: {start: {spread: 200000}}\nmeasure: {chaos: {model: point}}\n"
                                      "until: {turns: 1}\nchunk: 1000\n",
                                &file);
    const iso_sweep_head *head = iso_sweep_head_of(sweep);
    char name[] = "/tmp/bench_sweep_XXXXXX", path[64];
    iso_sweep_store *store;
    iso_sweep_rows rows;
    if (!mkdtemp(name)) exit(1);
    snprintf(path, sizeof path, "%s/out.h5", name);
    must(iso_sweep_rows_create(ctx, head->columns, CHUNK, &rows));
    must(iso_sweep_compute_points(ctx, sweep, 0, CHUNK, &rows));
    must(iso_sweep_store_open(ctx, path, head, (iso_sweep_shard){0, 1}, false, &store));
    double begun = bench_wall_milliseconds();
    for (size_t c = 0; c < CHUNKS; c++) {
        rows.first = c * CHUNK;
        must(iso_sweep_store_add(ctx, store, &rows));
    }
    *part_row = 1e3 * (bench_wall_milliseconds() - begun) / (CHUNKS * CHUNK);
    begun = bench_wall_milliseconds();
    must(iso_sweep_store_finish(ctx, store));
    *result_row = 1e3 * (bench_wall_milliseconds() - begun) / (CHUNKS * CHUNK);
    printf("a row of %d numbers: %.3f us in FILE.part, %.3f us in the result\n", head->columns, *part_row,
           *result_row);
    iso_sweep_store_close(store);
    iso_sweep_rows_free(&rows);
    iso_sweep_free(sweep);
    iso_sweep_file_free(file);
    unlink(path);
    rmdir(name);
}

/* --- simulating ------------------------------------------------------------------------------------------------- */

typedef struct costs {
    double fetch, message; /* seconds that the counter, rank 0 are busy for a chunk */
    double chunk;          /* seconds of a chunk, in the mean                       */
    const double *spread;
} costs;

/* A heap of the times at which ranks end their chunks. */
static void sink(double heap[], size_t count, size_t i)
{
    for (;;) {
        size_t least = i;
        for (size_t child = 2 * i + 1; child <= 2 * i + 2 && child < count; child++)
            if (heap[child] < heap[least]) least = child;
        if (least == i) return;
        const double swapped = heap[i];
        heap[i] = heap[least];
        heap[least] = swapped;
        i = least;
    }
}

static uint64_t random_state = 18;

static double time_of_chunk(const costs *cost)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return cost->chunk * cost->spread[(random_state >> 33) % SAMPLES];
}

/* Seconds from the beginning to the moment the chunks are used up (*tail: from then to the end), and the seconds that
 * were spent on chunks. */
static double simulate(const costs *cost, size_t ranks, double *work, double *tail)
{
    const double looks = 1e-3;
    size_t left = ranks * PER_RANK, working = ranks;
    double counter = 0, writer = 0, used_up = 0, end = 0;
    double *heap = malloc(ranks * sizeof *heap);
    if (!heap) exit(1);
    *work = 0;
    for (size_t i = 0; i < ranks; i++, left--) { /* the first fetches come at the same time */
        const double chunk = time_of_chunk(cost);
        counter += cost->fetch;
        heap[i] = counter + chunk;
        *work += chunk;
    }
    for (size_t i = ranks; i-- > 0;) sink(heap, ranks, i);
    while (working > 0) {
        const double ready = heap[0];
        writer = (ready > writer ? ready + looks / 2 : writer) + cost->message;
        end = writer;
        if (left > 0) {
            const double chunk = time_of_chunk(cost);
            counter = (writer > counter ? writer : counter) + cost->fetch;
            heap[0] = counter + chunk;
            *work += chunk;
            if (--left == 0) used_up = counter;
        } else {
            heap[0] = heap[--working];
        }
        sink(heap, working, 0);
    }
    free(heap);
    *tail = end - used_up;
    return used_up;
}

/* The part of a day's processor time that goes into chunks. The tail is idle at worst. */
static double efficiency(const costs *cost, size_t ranks, double rows, double result_row)
{
    double work, tail;
    const double time = simulate(cost, ranks, &work, &tail), in_tail = (double)ranks * tail / 2;
    const double rate = (work - in_tail) / ((double)ranks * time);
    const double chunks = (double)ranks * DAY / cost->chunk;
    return DAY / (DAY / (rate < 1 ? rate : 1) + tail + chunks * rows * result_row);
}

int main(int argc, char **argv)
{
    const double fetch = argc > 1 ? strtod(argv[1], NULL) : 5, message = argc > 2 ? strtod(argv[2], NULL) : 15;
    static const double point[] = {1e-3, 1e-2, 1e-1, 1, 10}, chunk[] = {1, 10};
    static const size_t ranks[] = {100, 1000, 10000};
    double spread[SAMPLES], part_row, result_row;
    ctx = iso_context_create();
    if (!ctx) return 1;
    measure_chunks(spread);
    measure_rows(&part_row, &result_row);
    printf(
        "a fetch takes %.1f us, a message %.1f us\n\nefficiency for a day's work, and chunks a second at which the "
        "writer is full\npoint     chunk  ",
        fetch, message);
    for (int r = 0; r < 3; r++) printf("%6zu ranks", ranks[r]);
    printf("   writer is full at\n");
    for (int c = 0; c < 2; c++)
        for (int p = 0; p < 5; p++) {
            const double rows = point[p] < chunk[c] ? chunk[c] / point[p] : 1, length = rows * point[p];
            const costs cost = {1e-6 * fetch, 1e-6 * (message + rows * part_row), length, spread};
            printf("%6.3f s %6.0f s ", point[p], length);
            for (int r = 0; r < 3; r++)
                printf("%10.1f %%", 100 * efficiency(&cost, ranks[r], rows, 1e-6 * result_row));
            printf("%10.0f ranks\n", length / cost.message);
        }
    iso_context_free(ctx);
    return 0;
}

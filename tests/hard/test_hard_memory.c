/* Memory that is not there, in the library: each call of malloc, calloc, realloc and strdup in our code fails in
 * turn, then that and all after it. (Calls inside of the C library, SUNDIALS and GSL: cli/hard_faults.sh.) */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <pthread.h>
#include <stdint.h>
#include <sys/wait.h>
#include <unistd.h>

#include "asked.h"
#include "batches.h"
#include "hard.h"
#include "instrument/frequencies/frequencies.h"
#include "io/scene_file.h"
#include "io/table.h"
#include "study/study_impl.h"
#include "task/check/check.h"
#include "task/compare.h"
#include "task/convert/convert.h"
#include "task/cost/cost.h"

static iso_context *ctx;
static batch_pool pool;
static iso_params shell, ellipsoid; /* made while there is memory */

#define REST                                                                                                         \
    ", J: [1.4, 2.1, 3.0]}\ninitial: {normal: [0.36, 0.48, 0.8], angular_velocity: "                                 \
    "[0.9, -0.3, -0.225]}\ntime: {end: 10, step: 2.5}\n"
static const char closed[] = "reduced: {k: -1" REST, chaotic[] = "reduced: {k: 0.5" REST;

/* --- a malloc that fails ---------------------------------------------------------------------------------------- */

enum { PLACES = 1 << 16 };
static struct {
    long calls, at;         /* the call that fails; 0: none       */
    bool on;                /* all later ones, too                */
    long held;              /* blocks that have not been freed    */
    void *block[PLACES];    /* these, where their address says    */
    pthread_mutex_t locked; /* by one thread at a time            */
} memory = {.locked = PTHREAD_MUTEX_INITIALIZER};

static bool fails(void)
{
    pthread_mutex_lock(&memory.locked);
    const long call = ++memory.calls;
    pthread_mutex_unlock(&memory.locked);
    return memory.at > 0 && (memory.on ? call >= memory.at : call == memory.at);
}

/* Puts `to` where `from` stands, or nothing where it does not. */
static void exchange(const void *from, void *to, const void *address)
{
    pthread_mutex_lock(&memory.locked);
    for (size_t i = (uintptr_t)address / 16 % PLACES, n = 0; n < PLACES; i = (i + 1) % PLACES, n++) {
        if (memory.block[i] != from) continue;
        memory.block[i] = to;
        memory.held += to ? 1 : -1;
        break;
    }
    pthread_mutex_unlock(&memory.locked);
}

static void *held(void *block)
{
    if (block) exchange(NULL, block, block);
    return block;
}

/* The linker's --wrap=malloc makes each malloc of ours __wrap_malloc, and malloc itself __real_malloc. */
void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
char *__real_strdup(const char *text);
void __real_free(void *block);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
char *__wrap_strdup(const char *text);
void __wrap_free(void *block);

void *__wrap_malloc(size_t size)
{
    return fails() ? NULL : held(__real_malloc(size));
}

void *__wrap_calloc(size_t count, size_t size)
{
    return fails() ? NULL : held(__real_calloc(count, size));
}

void *__wrap_realloc(void *old, size_t size)
{
    if (fails()) return NULL;
    if (old) exchange(old, NULL, old);
    return held(__real_realloc(old, size));
}

char *__wrap_strdup(const char *text)
{
    return fails() ? NULL : held(__real_strdup(text));
}

void __wrap_free(void *block)
{
    if (block) exchange(block, NULL, block); /* what the C library made itself is not there */
    __real_free(block);
}

/* --- what is called: to the end, and all of it freed ------------------------------------------------------------ */

static double digits; /* of the answer, to tell whether it is whole */

static iso_status find_orbit(const hard_road *way)
{
    iso_sample sample;
    const iso_status status = hard_solve(ctx, way, &shell, &batch_usual, NULL, true, ISO_CLOCK_T, 2, &sample);
    digits = status == ISO_OK ? sample.ball[0] : 0;
    return status;
}

/* On a separatrix: a closed solution made of three. */
static iso_status find_separatrix(const hard_road *way)
{
    const hard_road exact = {ISO_BACKEND_EXACT, NULL, 1e-12};
    const double gamma[3] = {sqrt(0.5), 0, sqrt(0.5)}, M[3] = {0, 1, 0};
    iso_start start;
    iso_sample sample;
    (void)way;
    iso_status status = iso_start_point(ctx, M, gamma, NULL, false, &start);
    if (status == ISO_OK) status = hard_solve(ctx, &exact, &ellipsoid, &start, NULL, true, ISO_CLOCK_S, 2, &sample);
    digits = status == ISO_OK ? sample.point[0] : 0;
    return status;
}

enum { ROWS = 2 };

static iso_status run_batch(const hard_road *way)
{
    static iso_sample samples[BATCH_ORBITS * ROWS];
    iso_status one[BATCH_ORBITS];
    iso_batch_options o = iso_batch_defaults();
    o.threads = way ? 1 : 2;
    o.max_steps = 200;
    const iso_status status =
        iso_batch_run(ctx, pool.orbit, (size_t)pool.count, &o, (double[]){0.1, 0.2}, ROWS, samples, one);
    digits = 0;
    bool lacking = status == ISO_NO_MEMORY;
    for (int i = 0; i < pool.count; i++) {
        lacking = lacking || one[i] == ISO_NO_MEMORY;
        if (one[i] == ISO_OK) digits += samples[ROWS * i + 1].ball[0];
    }
    return lacking ? ISO_NO_MEMORY : ISO_OK; /* in the pool are orbits that are refused */
}

static iso_status study(const hard_road *way)
{
    iso_scene scene;
    iso_comparison *c = NULL;
    iso_record *read = NULL, *converted = NULL;
    iso_residuals residuals;
    (void)way;
    digits = 0;
    iso_status status = iso_scene_load_text(ctx, "scene", closed, strlen(closed), &scene);
    if (status == ISO_OK) status = iso_compare(ctx, &scene, NULL, NULL, &c);
    iso_record *const written = c ? c->run[ISO_BALL].trajectory : NULL;
    if (status == ISO_OK) status = iso_record_set_numbers(ctx, written, "k", 1, &scene.params.k);
    if (status == ISO_OK) status = iso_record_set_numbers(ctx, written, "J", 3, scene.params.J);
    if (status == ISO_OK) status = iso_record_set_numbers(ctx, written, "h", 1, &c->h);
    if (status == ISO_OK) status = iso_table_write(ctx, "hard_memory.csv", written);
    if (status == ISO_OK) status = iso_table_read(ctx, "hard_memory.csv", "trajectory", NULL, &read, NULL);
    if (status == ISO_OK) status = iso_convert(ctx, read, ISO_POINT, 1e-12, &converted);
    if (status == ISO_OK) status = iso_check(ctx, &scene.params, read, 1e-12, &residuals);
    if (status == ISO_OK) digits = c->worst[1] + iso_record_const_row(converted, 4)[2] + residuals.residual[0].worst;
    iso_record_free(converted);
    iso_record_free(read);
    iso_comparison_free(c);
    return status;
}

/* The calls for other languages: those that hold memory beside what they call. */
static iso_status call_foreign(const hard_road *way)
{
    iso_scene *scene = NULL;
    iso_solution *one = NULL;
    iso_record *ball = NULL, *point[6] = {NULL}, *section[6] = {NULL}, *chaos[6] = {NULL};
    char notes[80];
    double table[4 * 7];
    (void)way;
    digits = 0;
    iso_status status = iso_scene_parse(ctx, "scene", closed, strlen(closed), &scene);
    if (status == ISO_OK) status = asked_run(ctx, scene, NULL, 0, &ball, notes, sizeof notes);
    if (status == ISO_OK)
        status = asked(ctx, NULL, ball, "convert", "to=point\ntol=1e-12", NULL, NULL, point, notes, 80);
    if (status == ISO_OK) digits = iso_record_row(point[0], 4)[2];
    iso_record_free(point[0]);
    point[0] = NULL;
    if (status == ISO_OK) status = iso_solution_create(ctx, scene, &one);
    if (status == ISO_OK) status = iso_solution_at(one, (double[]){2, 1, -1}, 3, table, notes, sizeof notes);
    if (status != ISO_OK && one) /* it has the words */
        iso_context_fail(ctx, status, "", "%s", iso_context_message(iso_solution_context(one)));
    digits += table[0];
    if (status == ISO_OK)
        status = iso_batch(ctx, (const iso_scene *[]){scene}, 1, 4, (double[]){1, 2, 3, 4}, NULL, NULL, (double[]){1},
                           1, 1, NULL, table, NULL);
    if (status == ISO_OK)
        status =
            asked(ctx, scene, NULL, "section", "crossings=2\nat=0.5,0.2\nthreads=1", NULL, NULL, section, notes, 80);
    if (status == ISO_OK)
        status = asked(ctx, scene, NULL, "chaos", "turns=4\nstarts=1\nthreads=1", NULL, NULL, chaos, notes, 80);
    digits = status == ISO_OK ? digits + table[27] + iso_record_row(section[1], 3)[6] : 0;
    iso_record_free(ball);
    for (int i = 0; i < 6; i++) iso_record_free(section[i]), iso_record_free(chaos[i]);
    iso_solution_free(one);
    iso_scene_free(scene);
    return status;
}

/* Whether table and status say what has become of each orbit, beginning with numbers that nobody writes. */
enum { MANY = 300, WIDTH = 7, NOBODY = 12345 };

static iso_status judge_table(iso_status answer, const double table[], const int32_t status[])
{
    bool lacking = false;
    digits = 0;
    for (int i = 0; i < MANY; i++) {
        const double *first = table + (size_t)i * ROWS * WIDTH;
        for (int j = 0; j < ROWS * WIDTH; j++)
            if (status[i] == ISO_OK ? !isfinite(first[j]) || first[j] == NOBODY : !isnan(first[j]))
                return iso_context_fail(ctx, ISO_NUMERICAL, "", "orbit %d has status %d and %g", i, status[i],
                                        first[j]);
        lacking = lacking || status[i] == ISO_NO_MEMORY;
        digits += status[i] == ISO_OK ? first[1] : 0;
    }
    if (lacking == (answer == ISO_NO_MEMORY)) return answer;
    return iso_context_fail(ctx, ISO_NUMERICAL, "", "the call gives %d, its orbits another status", answer);
}

/* way: one thread, which takes two chunks; NULL: two threads. */
static iso_status fill_table(const hard_road *way)
{
    static double table[MANY * ROWS * WIDTH], k[MANY];
    static int32_t one[MANY];
    iso_scene *scene;
    const iso_status status = iso_scene_parse(ctx, "scene", closed, strlen(closed), &scene);
    digits = 0;
    if (status != ISO_OK) return status;
    for (int i = 0; i < MANY * ROWS * WIDTH; i++) table[i] = NOBODY;
    for (int i = 0; i < MANY; i++) one[i] = -7, k[i] = 0.5 + 0.001 * i;
    const iso_status answer = iso_batch(ctx, (const iso_scene *[]){scene}, 1, MANY, k, NULL, NULL,
                                        (double[]){0.1, 0.2}, ROWS, way ? 1 : 2, NULL, table, one);
    iso_scene_free(scene);
    return judge_table(answer, table, one);
}

static iso_status find_frequencies(const hard_road *way)
{
    static iso_frequencies f;
    iso_frequencies_options o = iso_frequencies_defaults();
    iso_scene scene;
    const char *const text = way ? closed : chaotic;
    o.turns = 24;
    o.samples = 512;
    iso_status status = iso_scene_load_text(ctx, "scene", text, strlen(text), &scene);
    if (status == ISO_OK) status = iso_frequencies_find(ctx, &scene, &o, &f);
    digits = status == ISO_OK ? f.ratio : 0;
    return status;
}

static iso_status find_error(const hard_road *way)
{
    const iso_orbit_options o = iso_orbit_defaults(&batch_usual);
    iso_orbit *made;
    iso_error_finder *finder = NULL;
    iso_sample sample;
    (void)way;
    digits = 0;
    iso_status status = iso_orbit_create(ctx, &shell, &batch_usual, &o, &made);
    if (status != ISO_OK) return status;
    status = iso_orbit_at(made, 2, &sample);
    if (status == ISO_OK) status = iso_error_finder_create(ctx, &shell, &batch_usual, &o, made, &finder);
    if (status == ISO_OK) status = iso_error_finder_add(finder, &sample);
    if (status == ISO_OK) digits = iso_error_finder_read(finder).state[ISO_BALL].worst;
    iso_error_finder_free(finder);
    iso_orbit_free(made);
    return status;
}

static iso_status measure_cost(const hard_road *way)
{
    const iso_method *const method = iso_method_find("rk8pd");
    iso_scene scene;
    iso_cost *cost;
    iso_cost_options o = iso_cost_defaults();
    (void)way;
    o.seconds = 60; /* no timing is tested: a busy machine must not cut it short */
    o.method = method;
    o.tolerance = 1e-6;
    iso_status status = iso_scene_load_text(ctx, "scene", closed, strlen(closed), &scene);
    if (status == ISO_OK) status = iso_cost_measure(ctx, &scene, &o, &cost);
    digits = 0;
    if (status != ISO_OK) return status;
    for (int i = 0; i < cost->cells && status == ISO_OK; i++) status = cost->cell[i].status; /* each says its own */
    iso_cost_free(cost);
    return status;
}

/* --- each call in turn ------------------------------------------------------------------------------------------- */

typedef iso_status call(const hard_road *way);

/* Whether a call with too little memory is answered as it should be. */
static bool is_answered(iso_status status, double whole)
{
    const char *message = iso_context_message(ctx);
    if (status == ISO_OK) return digits == whole;
    if (status == ISO_NO_MEMORY) return true;
    return (status == ISO_NUMERICAL || status == ISO_FILE_TROUBLE) && strstr(message, "memory");
}

/* Wrong answers and leaks, of about `most` failures of each kind. */
static void starve(const char *name, call *made, const hard_road *way, long most)
{
    int wrong = 0;
    memory.at = 0;
    made(way); /* what is made once and kept */
    memory.calls = 0;
    const iso_status full = made(way);
    const long calls = memory.calls, stride = calls / most + 1;
    const long before = memory.held;
    const double whole = digits;
    gsl_test(full != ISO_OK || calls == 0, "%s: answered, with %ld calls: %s", name, calls, iso_context_message(ctx));
    for (int on = 0; on < 2; on++)
        for (long n = 1; n <= calls; n += stride) {
            memory.calls = 0;
            memory.at = n;
            memory.on = on;
            const iso_status status = made(way);
            memory.at = 0;
            if (is_answered(status, whole)) continue;
            wrong++;
            gsl_test(1, "%s: call %ld of %ld: %s: %s", name, n, calls, iso_status_text(status),
                     iso_context_message(ctx));
        }
    const long leaks = memory.held - before;
    gsl_test(leaks != 0, "%s: nothing is left unfreed (%ld)", name, leaks);
    hard_hold(made == find_orbit ? way : NULL, (double)(wrong + labs(leaks)), 0);
}

/* What gsl_odeiv2_driver_alloc_y_new does when it has no memory for a controller, in a process of its own. */
static int naive_crashes(void)
{
    int crashes = 0;
    const pid_t child = fork();
    if (child == 0) {
        gsl_odeiv2_control *none = NULL; /* the answer of gsl_odeiv2_control_alloc, which nobody looks at */
        close(STDERR_FILENO);            /* a sanitizer has much to say */
        _exit(gsl_odeiv2_control_init(none, 1, 0, 1, 0));
    }
    int ended = 0;
    if (child > 0 && waitpid(child, &ended, 0) == child) crashes += WIFSIGNALED(ended) || WEXITSTATUS(ended) != 0;
    return crashes;
}

int main(void)
{
    gsl_set_error_handler_off();
    ctx = iso_context_create();
    iso_random *dice = iso_random_create(12);
    batch_fill(&pool, ctx, dice);
    iso_random_free(dice);
    shell = laws_params(-1, orbit_J);
    ellipsoid = laws_params(-1, (double[]){1, 2, 4});
    hard_topic("12. Faults of memory in the library");
    hard_case("orbits", "answers neither whole nor 'no memory', and blocks not freed: each malloc failing in turn",
              "what is half made must be taken apart");
    for (int i = 0; i < hard_ways; i++)
        starve(hard_way[i].method ? hard_way[i].method->name : "exact", find_orbit, &hard_way[i], 100);
    hard_naive("GSL's own handling of a controller it has no memory for: crashes", naive_crashes(), 0);
    hard_case("studies", "the same of batches, closed solutions, studies, files",
              "threads, lanes and tables that grow hold memory of many owners");
    starve("separatrix", find_separatrix, NULL, 60);
    starve("batch, one thread", run_batch, &hard_way[0], 100);
    starve("batch, two threads", run_batch, NULL, 60);
    starve("compare, write, read, convert, check", study, NULL, 150);
    starve("calls for other languages", call_foreign, NULL, 200);
    starve("table of a batch, one thread", fill_table, &hard_way[0], 60);
    starve("table of a batch, two threads", fill_table, NULL, 30);
    starve("frequencies", find_frequencies, &hard_way[0], 60);
    starve("frequencies, estimated", find_frequencies, NULL, 30);
    starve("error", find_error, NULL, 60);
    starve("cost", measure_cost, NULL, 60);
    unlink("hard_memory.csv");
    iso_context_free(ctx);
    return hard_summary();
}

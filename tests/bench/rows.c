/* bench_rows - what rows cost: `convert`, `check` and `run` of long trajectories, and the start of the command.
 *
 *     bench_rows BEFORE AFTER [ROWS]
 *
 * BEFORE and AFTER are two builds of the command `isoroll`; give one of them twice to see the noise. The trajectory
 * has ROWS rows (300000), k = -1, J = (1.4, 2.1, 3.0), step 0.01, 7 columns of 17 digits.
 *
 * How to read the first table. Microseconds a row, each the median of PASSES passes over all lines in turn, first
 * with BEFORE, then with AFTER.
 * - processor, one: processor time of all threads, the command being bound to one processor.
 * - wall, all: time on the wall with all processors. Where other work runs on the machine this says nothing;
 *   `processor, all` divided by the number of processors is what it would be at best.
 * - ratio: BEFORE by AFTER.
 *
 * The second table shows the start: milliseconds from the start of a process to its end, median of STARTS.
 */
#define _GNU_SOURCE /* sched_setaffinity */
#include <errno.h>
#include <fcntl.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench.h"

enum { PASSES = 7, STARTS = 100, ARGUMENTS = 12 };

typedef struct cost {
    double processor, wall; /* milliseconds */
} cost;

/* One line of a table, with both builds. */
typedef struct row {
    const char *name;
    const char *argument[ARGUMENTS]; /* behind the command's name */
    double one[2][STARTS], all[2][STARTS], wall[2][STARTS];
} row;

static void stop(const char *what)
{
    fprintf(stderr, "bench_rows: %s: %s\n", what, strerror(errno));
    exit(1);
}

/* In the child: one processor, no output, then the command. */
static void become(const char *command, const row *r, bool one)
{
    const char *list[ARGUMENTS + 1] = {command};
    const int nowhere = open("/dev/null", O_WRONLY);
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(0, &set);
    if (one) sched_setaffinity(0, sizeof set, &set);
    dup2(nowhere, STDOUT_FILENO);
    for (int i = 0; i < ARGUMENTS && r->argument[i]; i++) list[i + 1] = r->argument[i];
    execv(command, (char *const *)list);
    _exit(127);
}

static cost measure(const char *command, const row *r, bool one)
{
    struct rusage used;
    int ended = 0;
    const double begin = bench_wall_milliseconds();
    const pid_t child = fork();
    if (child == 0) become(command, r, one);
    if (child < 0 || wait4(child, &ended, 0, &used) != child) stop("fork");
    if (!WIFEXITED(ended) || WEXITSTATUS(ended) != 0) {
        fprintf(stderr, "bench_rows: %s %s: it failed\n", command, r->name);
        exit(1);
    }
    const struct timeval *u = &used.ru_utime, *s = &used.ru_stime;
    return (cost){1e3 * (double)(u->tv_sec + s->tv_sec) + 1e-3 * (double)(u->tv_usec + s->tv_usec),
                  bench_wall_milliseconds() - begin};
}

/* All lines in turn, first one build, then the other. */
static void measure_all(const char *const build[2], row rows[], int count, int passes)
{
    for (int p = 0; p < passes; p++)
        for (int i = 0; i < count; i++)
            for (int b = 0; b < 2; b++) {
                const cost together = measure(build[b], &rows[i], false);
                rows[i].one[b][p] = measure(build[b], &rows[i], true).processor;
                rows[i].all[b][p] = together.processor;
                rows[i].wall[b][p] = together.wall;
            }
}

static void print(row rows[], int count, int passes, double unit, const char *what)
{
    printf("%-28s %26s %26s %26s\n%-28s", what, "processor, one", "processor, all", "wall, all", "");
    for (int i = 0; i < 3; i++) printf(" %9s %9s %6s", "before", "after", "ratio");
    for (int i = 0; i < count; i++) {
        row *r = &rows[i];
        double(*const of[3])[STARTS] = {r->one, r->all, r->wall};
        printf("\n%-28s", r->name);
        for (int k = 0; k < 3; k++) {
            const double before = bench_median(of[k][0], (size_t)passes) / unit,
                         after = bench_median(of[k][1], (size_t)passes) / unit;
            printf(" %9.3f %9.3f %6.2f", before, after, before / after);
        }
    }
    printf("\n");
}

static void write_scene(const char *path, double end)
{
    FILE *file = fopen(path, "w");
    if (!file) stop(path);
    fprintf(file,
            "reduced: {k: -1, J: [1.4, 2.1, 3.0]}\ninitial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, "
            "-0.3, -0.225]}\ntime: {end: %.17g, step: 0.01}\n",
            end);
    fclose(file);
}

static void make_files(const char *command, double count)
{
    const row ball = {"run", {"run", "long.yaml", "-o", "ball.csv"}, {{0}}, {{0}}, {{0}}};
    const row both = {"run", {"run", "long.yaml", "--as", "both", "-o", "both.csv"}, {{0}}, {{0}}, {{0}}};
    write_scene("long.yaml", 0.01 * (count - 1));
    write_scene("short.yaml", 1);
    measure(command, &ball, false);
    measure(command, &both, false);
}

static row rows[] = {
    {.name = "convert", .argument = {"convert", "--quiet", "--to", "point", "ball.csv", "-o", "/dev/null"}},
    {.name = "check", .argument = {"check", "ball.csv"}},
    {.name = "check, both models, 3 clocks", .argument = {"check", "both.csv"}},
    {.name = "run", .argument = {"run", "long.yaml"}},
    {.name = "run, closed solution", .argument = {"run", "long.yaml", "--backend", "exact"}},
};
static row starts[] = {
    {.name = "--version", .argument = {"--version"}},
    {.name = "run, 101 rows", .argument = {"run", "short.yaml"}},
};

int main(int count, char *argument[])
{
    char folder[] = "/tmp/bench_rows.XXXXXX";
    static const char *const files[] = {"long.yaml", "short.yaml", "ball.csv", "both.csv"};
    if (count < 3) return fprintf(stderr, "usage: bench_rows BEFORE AFTER [ROWS]\n"), 2;
    const char *build[2] = {realpath(argument[1], NULL), realpath(argument[2], NULL)};
    const double length = count > 3 ? atof(argument[3]) : 300000;
    if (!build[0] || !build[1]) stop("the commands");
    if (!mkdtemp(folder) || chdir(folder) != 0) stop(folder);
    make_files(build[1], length);
    const int lines = (int)(sizeof rows / sizeof *rows), few = (int)(sizeof starts / sizeof *starts);
    measure_all(build, rows, lines, PASSES);
    print(rows, lines, PASSES, 1e-3 * length, "microseconds a row");
    measure_all(build, starts, few, STARTS);
    print(starts, few, STARTS, 1, "milliseconds");
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) unlink(files[i]);
    return rmdir(folder) != 0;
}

/* Bad input: what the fuzzers in fuzz/ were fed, and what they found, replayed; and numbers that are none, wherever a
 * number can stand.      test_hard_input KIND FILE...: these files alone, with what they print */
#define _GNU_SOURCE /* asprintf, memfd_create */
#include <dirent.h>
#include <getopt.h>
#include <sys/time.h>
#include <sys/wait.h>

#include "fuzz/fuzz.h"
#include "hard.h"
#include "io/scene_file.h"
#include "io/table.h"

enum { MOST_FILES = 4000, MOST_BYTES = 1 << 16, MOST_SECONDS = 60 /* of the processor, for one input */ };

int fuzz_scene(const uint8_t *data, size_t size);
int fuzz_trajectory(const uint8_t *data, size_t size);
int fuzz_command(const uint8_t *data, size_t size);
int fuzz_expression(const uint8_t *data, size_t size);
int isoroll_main(int argc, char **argv);

static const struct kind {
    const char *name;
    int (*target)(const uint8_t *data, size_t size);
    const char *folders[3];
} kinds[] = {
    {"scene", fuzz_scene, {ISO_TEST_DATA "/../fuzz/corpus/scene", ISO_TEST_BAD, NULL}},
    {"trajectory", fuzz_trajectory, {ISO_TEST_DATA "/../fuzz/corpus/trajectory", NULL}},
    {"command", fuzz_command, {ISO_TEST_DATA "/../fuzz/corpus/command", NULL}},
    {"expression", fuzz_expression, {ISO_TEST_DATA "/../fuzz/corpus/expression", NULL}},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

/* --- the corpora ---------------------------------------------------------------------------------------------- */

static char *file[MOST_FILES];
static int files;

static void add_folder(const char *path)
{
    struct dirent **entries;
    const int count = scandir(path, &entries, NULL, alphasort);
    for (int i = 0; i < count; i++) {
        if (entries[i]->d_name[0] != '.' && files < MOST_FILES &&
            asprintf(&file[files], "%s/%s", path, entries[i]->d_name) > 0)
            files++;
        free(entries[i]);
    }
    if (count >= 0) free(entries);
}

/* A hang ends it by SIGPROF. The bytes are in a block of their size: reading past them is seen. */
static void replay_one(const struct kind *kind, const char *path)
{
    const struct itimerval limit = {.it_value = {.tv_sec = MOST_SECONDS}};
    static uint8_t buffer[MOST_BYTES];
    FILE *from = fopen(path, "re");
    if (!from) abort();
    const size_t size = fread(buffer, 1, sizeof buffer, from);
    uint8_t *data = malloc(size ? size : 1);
    fclose(from);
    if (!data) abort();
    memcpy(data, buffer, size);
    setitimer(ITIMER_PROF, &limit, NULL);
    kind->target(data, size);
    free(data);
}

/* In a process of their own, which a finding ends; another one goes on behind it. */
static int findings(const struct kind *kind, int *at)
{
    int found = 0, end;
    for (*at = 0; *at < files; ++*at, found++) {
        fflush(NULL);
        const pid_t child = fork();
        if (child == 0) {
            for (; *at < files; ++*at) replay_one(kind, file[*at]);
            exit(0); /* where leaks are told */
        }
        if (child < 0 || waitpid(child, &end, 0) != child) return -1;
        if (end == 0) break;
        fprintf(stderr, "a finding: %s\n", *at < files ? file[*at] : "a leak");
    }
    return found + (*at == files && end != 0);
}

static void replay(const struct kind *kind)
{
    int *at = mmap(NULL, sizeof *at, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    char quantity[128];
    for (int i = 0; kind->folders[i]; i++) add_folder(kind->folders[i]);
    snprintf(quantity, sizeof quantity, "findings in %d inputs replayed, and numbers accepted that are none", files);
    hard_case(kind->name, quantity, "any bytes can come");
    gsl_test(files < 30, "%s: %d inputs", kind->name, files);
    hard_hold(NULL, findings(kind, at), 0);
    while (files > 0) free(file[--files]);
    munmap(at, sizeof *at);
}

/* --- numbers that are none ------------------------------------------------------------------------------------ */

static const char *const wrong[] = {"0.5x", "nan", "inf", "-inf", "1e400", "0x1g", "1.5.2", "1_000", "2 3"};
enum { WRONG = sizeof wrong / sizeof *wrong };

static bool scene_accepts(const char *number)
{
    char text[256];
    iso_scene scene;
    iso_context *ctx = iso_context_create();
    snprintf(text, sizeof text,
             "reduced: {k: %s, J: [1.4, 2.1, 3]}\ninitial: {normal: [0, 0, 1], angular_velocity: [1, 0, 0]}\n"
             "time: {end: 1}\n",
             number);
    const iso_status status = iso_scene_load_text(ctx, "scene", text, strlen(text), &scene);
    iso_context_free(ctx);
    return status == ISO_OK;
}

static bool trajectory_accepts(const char *number)
{
    char text[64], path[32];
    iso_record *record = NULL;
    iso_context *ctx = iso_context_create();
    snprintf(text, sizeof text, "t,omega1\n0,%s\n", number);
    fuzz_file((const uint8_t *)text, strlen(text), path);
    const iso_status status = iso_table_read(ctx, path, "trajectory", NULL, &record, NULL);
    iso_record_free(record);
    iso_context_free(ctx);
    return status == ISO_OK;
}

static bool command_accepts(const char *number)
{
    char text[32];
    snprintf(text, sizeof text, "%s", number);
    char *argv[] = {"isoroll", "analogue", "--J", "1,2,3", "--eps", "1", "--k", text, NULL};
    optind = 0;
    return isoroll_main(8, argv) == 0;
}

static int accepted(bool (*accepts)(const char *number))
{
    int count = 0;
    for (int i = 0; i < WRONG; i++) count += accepts(wrong[i]);
    return count;
}

/* What C offers to read a number with. */
static bool strtod_accepts(const char *number)
{
    char *end;
    (void)strtod(number, &end);
    return end != number;
}

static bool sscanf_accepts(const char *number)
{
    double value;
    return sscanf(number, "%lf", &value) == 1;
}

static bool atof_accepts(const char *number)
{
    (void)atof(number);
    return true;
}

int main(int argc, char **argv)
{
    static bool (*const ours[])(const char *) = {scene_accepts, trajectory_accepts, command_accepts};
    static bool (*const naive[])(const char *) = {strtod_accepts, sscanf_accepts, atof_accepts};
    static const char *const names[] = {"numbers by strtod", "rows by sscanf", "options by atof"};
    for (int i = 0; argc > 2 && i < KINDS; i++)
        for (int f = 2; f < argc && strcmp(argv[1], kinds[i].name) == 0; f++) replay_one(&kinds[i], argv[f]);
    if (argc > 1) return 0;
    hard_topic("11. Bad input");
    for (int i = 0; i < KINDS; i++) replay(&kinds[i]);
    for (int i = 0; i < (int)(sizeof ours / sizeof *ours); i++) {
        hard_hold(NULL, accepted(ours[i]), 0);
        hard_naive(names[i], accepted(naive[i]), 0);
    }
    gsl_test(!scene_accepts("1") || !trajectory_accepts("1") || !command_accepts("0.5"), "numbers are accepted");
    return hard_summary();
}

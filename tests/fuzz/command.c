/* command.c - bytes as a command line, one argument a line: the command ends with one of its exit statuses and says
 * why; what it printed can be read; nothing but what was asked for is left in the folder.
 *
 * It runs in a folder of its own, with the files below and no gnuplot. What follows a line `<` is standard input and
 * the file `input`. Arguments that name other folders are passed over. Linked with --wrap (CMakeLists.txt): after
 * STEPS steps it looks as if Ctrl-C was pressed. */
#define _GNU_SOURCE /* memfd_create */
#include <dirent.h>
#include <fcntl.h>
#include <getopt.h>
#include <jansson.h>
#include <limits.h>
#include <sys/stat.h>

#include "fuzz.h"
#include "io/table.h"

enum { STEPS = 2000, ARGUMENTS = 24 };

int isoroll_main(int argc, char **argv); /* main of apps/isoroll */

/* --- the long work -------------------------------------------------------------------------------------------- */

static long steps = LONG_MAX;

bool __real_iso_context_goes_on(const iso_context *ctx);
bool __wrap_iso_context_goes_on(const iso_context *ctx);
bool __wrap_interrupted(void);

bool __wrap_iso_context_goes_on(const iso_context *ctx)
{
    return fuzz_goes_on(&steps) && __real_iso_context_goes_on(ctx);
}

bool __wrap_interrupted(void)
{
    return !fuzz_goes_on(&steps);
}

/* --- the folder ----------------------------------------------------------------------------------------------- */

#define BALL                                                                                                         \
    "reduced: {k: -1, J: [1.4, 2.1, 3.0]}\ninitial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, "      \
    "-0.225]}\n"
#define POINT "point: {k: 1, J: [1, 1.5, 2]}\ninitial: {gamma: [0.6, 0, 0.8], M: [0.64, 1.0, -0.48]}\n"
#define FORCED                                                                                                       \
    "reduced: {k: 0.4, J: [1.4, 2.1, 3.0], D: 0.5}\ninitial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, "   \
    "-0.3, -0.225]}\n"
#define EFFECTS                                                                                                      \
    "effects: {gravity: {mgb: 0.7, up: [0, 0.6, 0.8]}, twist: {resistance: 10}, attitude: {}, reactions: {}}\n"
#define SHORT "time: {end: 2, step: 0.5}\n"

static const struct {
    const char *name, *text;
} files[] = {
    {"ball", BALL SHORT},
    {"point", POINT SHORT "solver: {backend: point, method: blanes_moan6, tolerance: 1e-8}\n"},
    {"forced", FORCED EFFECTS SHORT},
    {"bad", BALL "time: {end: 1e400}\n"},
    {"ball.csv",
     "# isoroll trajectory 1\n# model: ball\n# k: -1\n# J: 1.4 2.1 3\n"
     "t,omega1,omega2,omega3,n1,n2,n3\n0,0.9,-0.3,-0.225,0.36,0.48,0.8\n1,0.9,-0.3,-0.225,0.36,0.48,0.8\n"},
    {"point.csv", "# k: 1\n# J: 1 1.5 2\ns,M1,M2,M3,gamma1,gamma2,gamma3\n0,0.64,1,-0.48,0.6,0,0.8\n"},
    {"plain.csv", "n1,n2,n3,omega1,omega2,omega3\n0.36,0.48,0.8,0.9,-0.3,-0.225\n0.36,0.48,0.8,0.9,-0.3,-0.2\n"},
    {"times", "0, 1 -2 # three\n1e-3\n"},
};
enum { FILES = sizeof files / sizeof *files };

static char folder[64];

static void make_file(const char *name, const char *text)
{
    FILE *file = fopen(name, "we");
    if (!file || fputs(text, file) < 0 || fclose(file) != 0) abort();
}

static void make_files(const char *input)
{
    for (int i = 0; i < FILES; i++) make_file(files[i].name, files[i].text);
    make_file("input", input);
    if (!freopen("input", "r", stdin)) abort();
}

/* Takes all files away; none may be one that was not finished. */
static void empty_folder(void)
{
    DIR *here = opendir(".");
    for (struct dirent *entry; here && (entry = readdir(here));) {
        FUZZ_REQUIRE(!strstr(entry->d_name, ".isoroll-"), "%s is left\n", entry->d_name);
        unlink(entry->d_name);
    }
    closedir(here);
}

static void remove_folder(void)
{
    if (chdir(folder) != 0) return;
    empty_folder();
    rmdir(folder);
}

static void make_folder(void)
{
    const char *parent = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%s/isoroll-fuzz-XXXXXX", parent && strlen(parent) < 40 ? parent : "/tmp");
    if (!mkdtemp(folder) || setenv("PATH", folder, 1) != 0) abort();
    atexit(remove_folder);
}

/* --- the command ---------------------------------------------------------------------------------------------- */

/* Whatever was printed as a trajectory or as JSON is one, and has no NaN, but where some rows failed. */
static void check_output(int status, const char *out, size_t size)
{
    if (status == 1) return;
    FUZZ_REQUIRE(!strstr(out, " nan") && !strstr(out, "-nan") && !strstr(out, ",nan"), "%s\n", out);
    if (out[0] == '{') {
        json_error_t error;
        json_t *json = json_loads(out, 0, &error);
        FUZZ_REQUIRE(json, "%s:\n%s\n", error.text, out);
        json_decref(json);
    }
    if (strncmp(out, "# isoroll trajectory", 20) != 0) return;
    iso_context *ctx = iso_context_create();
    iso_record *record = NULL;
    char path[32];
    fuzz_file((const uint8_t *)out, size, path);
    const iso_status read = iso_table_read(ctx, path, "trajectory", NULL, &record, NULL);
    FUZZ_REQUIRE(read == ISO_OK, "%s\n", iso_context_message(ctx));
    iso_record_free(record);
    iso_context_free(ctx);
}

static void check_messages(int status, const char *err)
{
    FUZZ_REQUIRE(status >= 0 && status <= 5, "%d\n", status);
    FUZZ_REQUIRE(status <= 1 || *err, "status %d without a message\n", status);
    for (const char *line = err; *line; line = strchr(line, '\n') + 1)
        FUZZ_REQUIRE(strncmp(line, "isoroll: ", 9) == 0 && strchr(line, '\n'), "%s\n", err);
}

static void command(int argc, char **argv)
{
    char *out = NULL, *err = NULL;
    size_t out_size, err_size;
    FILE *const old_out = stdout, *const old_err = stderr;
    stdout = open_memstream(&out, &out_size);
    stderr = open_memstream(&err, &err_size);
    if (!stdout || !stderr) abort();
    steps = STEPS;
    optind = 0;
    const int status = isoroll_main(argc, argv);
    steps = LONG_MAX;
    fclose(stdout), fclose(stderr);
    stdout = old_out, stderr = old_err;
    check_output(status, out, out_size);
    if (argc > 1) check_messages(status, err);
    free(out);
    free(err);
}

/* The lines as arguments; false: too many, or not for this folder. */
static bool split(char *text, int *argc, char *argv[ARGUMENTS + 1])
{
    static char name[] = "isoroll";
    argv[0] = name;
    *argc = 1;
    if (strchr(text, '/')) return false;
    for (char *line; (line = strsep(&text, "\n")) && (*line || text);) {
        if (*argc == ARGUMENTS || strcmp(line, "..") == 0) return false;
        argv[(*argc)++] = line;
    }
    argv[*argc] = NULL;
    return true;
}

/* Cuts the text at its first line `<`; what follows. */
static const char *cut_input(char *text)
{
    char *mark = strstr(text, "\n<\n");
    if (!mark) return "";
    *mark = '\0';
    return mark + 3;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *argv[ARGUMENTS + 1], *text = strndup((const char *)data, size);
    const char *input = text ? cut_input(text) : "";
    int argc;
    if (text && split(text, &argc, argv)) {
        if (!*folder) make_folder();
        const int before = open(".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (chdir(folder) != 0) abort();
        make_files(input);
        command(argc, argv);
        empty_folder();
        if (before < 0 || fchdir(before) != 0) abort();
        close(before);
    }
    free(text);
    return 0;
}

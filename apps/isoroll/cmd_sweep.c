/* isoroll sweep - measures many orbits or balls, on all cores, in pieces that can be interrupted and resumed. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "command.h"
#include "sweep/sweep_store_impl.h"
#include "sweep_team.h"

extern const command command_sweep;

typedef struct options {
    const char *file;
    file_list parts; /* of --merge */
    const char *output, *shard;
    double point; /* NAN: not given */
    int threads;
    bool resume, merge;
} options;

/* --- the shard -------------------------------------------------------------------------------------------------- */

static bool from_environment(const char *name, double usual, double *x)
{
    const char *text = getenv(name);
    *x = usual;
    return text ? iso_set_whole(x, text) : !isnan(usual);
}

/* The number of a task of a Slurm array begins at any number, and can go in steps. Some tasks that are submitted
 * again are an array of their own: its numbers do not say their shards. */
static iso_status shard_of_slurm(iso_context *ctx, iso_sweep_shard *shard)
{
    double id, count, least, step, most;
    if (!from_environment("SLURM_ARRAY_TASK_ID", NAN, &id) ||
        !from_environment("SLURM_ARRAY_TASK_COUNT", NAN, &count) ||
        !from_environment("SLURM_ARRAY_TASK_MIN", 0, &least) || !from_environment("SLURM_ARRAY_TASK_STEP", 1, &step))
        return ISO_FAIL_ARGUMENT(ctx, "shard",
                                 "--shard slurm: SLURM_ARRAY_TASK_ID and SLURM_ARRAY_TASK_COUNT are not numbers: "
                                 "this is no task of an array");
    const double index = (id - least) / fmax(step, 1);
    if (!(index >= 0 && index < count && index == floor(index)))
        return ISO_FAIL_ARGUMENT(
            ctx, "shard", "--shard slurm: the array has %g tasks from %g in steps of %g, and %g is none of them",
            count, least, fmax(step, 1), id);
    if (count < 2 ||
        (from_environment("SLURM_ARRAY_TASK_MAX", NAN, &most) && most != least + (count - 1) * fmax(step, 1)))
        return ISO_FAIL_ARGUMENT(ctx, "shard",
                                 "--shard slurm: this array has one task or gaps, so N is not known: give "
                                 "--shard slurm/N, N the number of all shards");
    *shard = (iso_sweep_shard){(size_t)index, (size_t)count};
    return ISO_OK;
}

/* "i/n"; "slurm/N": task I of Slurm computes shard I of N, from 1 on, also if only some tasks are submitted
 * again. */
static iso_status read_shard(iso_context *ctx, const char *text, iso_sweep_shard *shard)
{
    *shard = (iso_sweep_shard){0, 1};
    if (!text || iso_sweep_shard_read(text, shard)) return ISO_OK;
    if (strcmp(text, "slurm") == 0) return shard_of_slurm(ctx, shard);
    if (strncmp(text, "slurm/", 6) == 0) {
        char of_task[64];
        const char *task = getenv("SLURM_ARRAY_TASK_ID");
        snprintf(of_task, sizeof of_task, "%s/%s", task ? task : "", text + 6);
        if (iso_sweep_shard_read(of_task, shard)) return ISO_OK;
        return ISO_FAIL_ARGUMENT(ctx, "shard", "--shard %s: SLURM_ARRAY_TASK_ID must be a number from 1 to %s", text,
                                 text + 6);
    }
    return ISO_FAIL_ARGUMENT(ctx, "shard", "--shard '%s': expected i/n with 1 <= i <= n, slurm or slurm/n", text);
}

/* --- the work --------------------------------------------------------------------------------------------------- */

static int warn_interrupted(const options *o, const iso_sweep_store *s)
{
    const char *how = limit_is_near() ? "stopped by SIGTERM or SIGUSR1" : "interrupted";
    const bool gentle = limit_is_near() && (s->part || s->done == 0);
    if (s->done == 0)
        warn("%s: nothing was written", how);
    else if (!s->part)
        warn("%s: %zu of %zu chunks were written", how, s->done, s->wanted);
    else
        warn("%s: %zu of %zu chunks are in '%s'; go on with: isoroll sweep %s -o %s%s%s --resume", how, s->done,
             s->wanted, s->part, o->file, o->output, o->shard ? " --shard " : "", o->shard ? o->shard : "");
    return gentle ? EXIT_DONE : EXIT_SOME_FAILED;
}

static int warn_failures(const iso_sweep_failures *f, const char *of)
{
    if (f->count == 0) return EXIT_DONE;
    warn("%zu %spoints failed; the first is point %zu: %s", f->count, of, f->first, f->reason);
    return EXIT_SOME_FAILED;
}

/* The answer of all members of a team; NULL: this process is alone. */
static int agree(const sweep_team *team, int result)
{
    return team ? team->agree(team->data, result) : result;
}

static int compute(iso_context *ctx, const options *o, const sweep_team *team, const iso_sweep *sweep,
                   iso_sweep_store *store)
{
    const iso_sweep_head *head = iso_sweep_head_of(sweep);
    char of[32];
    const iso_sweep_source source = iso_sweep_store_source(store);
    store->interrupted = interrupted;
    store->progress = progress_sink;
    stop_gently();
    progress_begin();
    progress_show((double)store->done / (double)store->wanted);
    iso_status status = team ? team->run(team->data, ctx, sweep, o->threads, &source)
                             : iso_sweep_run(ctx, sweep, o->threads, &source);
    progress_end();
    if (status != ISO_OK) return finish(ctx, status);
    if (store->done < store->wanted) return warn_interrupted(o, store);
    status = iso_sweep_store_finish(ctx, store);
    snprintf(of, sizeof of, "of %zu ", iso_sweep_shard_points(head, store->shard));
    return status == ISO_OK ? warn_failures(&store->failures, of) : finish(ctx, status);
}

/* A quantity that the scene does not have is refused where the file asks for it. */
static int refused(iso_context *ctx, const options *o, const iso_sweep_plan *plan, iso_status status)
{
    for (int i = 0; i < plan->requests; i++) {
        const iso_place *at = &plan->request[i].place;
        if (status == ISO_BAD_INPUT && strcmp(at->key, iso_context_about(ctx)) == 0)
            iso_context_fail(ctx, status, "", "%s:%d:%d: %s", iso_text_name(o->file), at->line, at->column,
                             iso_context_message(ctx));
    }
    return finish(ctx, status);
}

/* Every member has read the sweep. The one that writes opens the result. */
static int run_file(iso_context *ctx, const options *o, const sweep_team *team, const iso_sweep_file *file)
{
    const iso_sweep_plan *plan = iso_sweep_file_plan(file);
    const size_t zeros = iso_sweep_zeros_of_k(file);
    const bool writes = !team || team->writes;
    iso_sweep_shard shard;
    iso_sweep *sweep = NULL;
    iso_sweep_store *store = NULL;
    iso_status status = read_shard(ctx, o->shard, &shard);
    if (status == ISO_OK) status = iso_sweep_create(ctx, plan, &sweep);
    int result = agree(team, refused(ctx, o, plan, status));
    if (result == EXIT_DONE) {
        if (writes) status = iso_sweep_store_open(ctx, o->output, iso_sweep_head_of(sweep), shard, o->resume, &store);
        result = agree(team, finish(ctx, status));
    }
    if (store && zeros > 0 && store->done < store->wanted) /* before the work begins, not hours later */
        warn("sweep: %zu of %zu points have k = 0, where there is no ball: they will fail", zeros,
             plan->family.count);
    if (result == EXIT_DONE && writes)
        result = compute(ctx, o, team, sweep, store);
    else if (result == EXIT_DONE)
        result = finish(ctx, team->run(team->data, ctx, sweep, o->threads, NULL));
    iso_sweep_store_close(store);
    iso_sweep_free(sweep);
    return result;
}

/* Options that would do nothing. False: one is there. */
static bool fits(const options *o)
{
    const char *alone = o->merge ? "--merge" : isnan(o->point) ? NULL : "--point";
    const char *other = o->resume ? "--resume" : o->shard ? "--shard" : NULL;
    if (!o->merge && !isnan(o->point) && strcmp(o->output, "-") != 0) other = "--output";
    if (o->merge && !isnan(o->point)) other = "--point";
    if (alone && other) warn("sweep: %s does nothing with %s", other, alone);
    return !alone || !other;
}

static int print_point(iso_context *ctx, const options *o, const iso_sweep_file *file)
{
    const size_t count = iso_sweep_file_plan(file)->family.count;
    if (!(o->point < (double)count))
        return warn("sweep: --point %.0f: points are 0 to %zu", o->point, count - 1), EXIT_USAGE;
    if (!fits(o)) return EXIT_USAGE;
    return finish(ctx, iso_sweep_print_point(ctx, file, (size_t)o->point, stdout));
}

static int merge(iso_context *ctx, const options *o)
{
    iso_sweep_failures failures;
    if (!fits(o)) return EXIT_USAGE;
    const char *const *parts = (const char *const *)o->parts.path;
    const iso_status status = iso_sweep_merge(ctx, (size_t)o->parts.count, parts, o->output, &failures);
    return status == ISO_OK ? warn_failures(&failures, "") : finish(ctx, status);
}

int sweep_with(iso_context *ctx, const void *options_given, const sweep_team *team)
{
    const options *o = options_given;
    iso_sweep_file *file;
    struct stat s;
    if (!o->merge && o->parts.count > 1)
        return warn("sweep: one argument too many: %s", o->parts.path[1]), EXIT_USAGE;
    if (!o->merge && !file_fits(&command_sweep, o->file)) return EXIT_BAD_INPUT;
    const bool computes = !o->merge && isnan(o->point); /* else one member is enough */
    const bool many = team && team->members > 1;
    const bool pipe = strcmp(o->file, "-") == 0 || (stat(o->file, &s) == 0 && !S_ISREG(s.st_mode));
    if (computes && many && pipe) /* only one program can read it; who opens a file that is not there tells why */
        return warn("sweep: a pipe reaches one rank alone: give a file"), EXIT_USAGE;
    if (computes && many && strcmp(o->output, "-") == 0)
        return warn("sweep: mpirun does not tell whether its output arrives: give -o FILE"), EXIT_USAGE;
    if (!computes && team && !team->writes) return EXIT_DONE;
    if (o->merge) return merge(ctx, o);
    int result = finish(ctx, iso_sweep_read(ctx, o->file, &file));
    if (computes) result = agree(team, result);
    if (result == EXIT_DONE) result = computes ? run_file(ctx, o, team, file) : print_point(ctx, o, file);
    iso_sweep_file_free(file);
    return result;
}

static int run(iso_context *ctx, const void *options_given)
{
    return sweep_with(ctx, options_given, NULL);
}

static const options defaults = {.file = "-", .output = "-", .point = NAN};

static const option_row rows[] = {
    ROW_OF_FILE("output", "FILE", "a file", "write to FILE: HDF5 if it ends in .h5, else CSV; - is standard output",
                iso_set_text, options, output, 'o', OPTION_WRITES),
    ROW_THREADS(options, threads),
    ROW("resume", NULL, NULL, "go on with what FILE.part has; begin if there is none", iso_set_flag, options, resume),
    ROW("shard", "I/N", "i/n, slurm or slurm/n",
        "compute every N-th chunk, from the I-th on; slurm/N: I is the number of the task of a Slurm array; slurm: "
        "I and N come from the array, which must be whole",
        iso_set_text, options, shard),
    ROW("merge", NULL, NULL, "put the files of all shards together: the arguments are these files", iso_set_flag,
        options, merge),
    ROW("point", "I", "a whole number from 0 on", "print the scene of point I and do nothing else", iso_set_whole,
        options, point),
    ROW_END,
};

const command command_sweep = {
    COMMAND("sweep", "SWEEP", "measure many orbits or balls, on all cores, resumable", file),
    .takes = FILE_SWEEP | FILE_RESULT | FILE_HDF5,
    .files = offsetof(options, parts),
    .description =
        "A sweep is a file in YAML: a scene, the numbers in it that vary, and what is measured at each point "
        "(lib/doc/formats.md). 'isoroll explain SWEEP' tells how many points it has, and how long it takes here.\n\n"
        "Finished chunks of points go to FILE.part (HDF5: FILE.csv.part) in their order; it becomes FILE when all "
        "are "
        "there. Ctrl-C lets the chunks that are being computed end. So do SIGTERM and SIGUSR1, after which the exit "
        "status is 0. Even kill -9 loses only the chunks that are being computed, and those that wait for them. "
        "--resume goes on, with any number of threads. The bytes of FILE do not depend on threads, shards or "
        "interruptions.\n\n"
        "A point that fails is a row with its reason. A file that is there is not overwritten.",
    .example = "isoroll sweep sweep.yaml -o out.h5\n"
               "isoroll sweep sweep.yaml -o out.h5 --resume\n"
               "isoroll sweep sweep.yaml -o out.2.h5 --shard 2/5\n"
               "isoroll sweep --merge out.*.h5 -o out.h5",
    .exits = "0: done, or stopped by SIGTERM or SIGUSR1\n"
             "1: some points failed, or interrupted by Ctrl-C",
};

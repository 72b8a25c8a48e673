/* isoroll run - integrate a scene and write its trajectory. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"

/* The times asked for: a scene's grid, or a list from a file. */
typedef struct times {
    const iso_scene *scene;
    double *list; /* NULL: the scene's grid */
    size_t count;
} times;

static double time_at(const times *t, size_t i)
{
    return t->list ? t->list[i] : iso_scene_time(t->scene, i);
}

static iso_status add_time(iso_context *ctx, times *t, size_t *room, double time)
{
    if (t->count == *room) {
        *room = *room ? 2 * *room : 64;
        double *grown = realloc(t->list, *room * sizeof *grown);
        if (!grown) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for the output times");
        t->list = grown;
    }
    t->list[t->count++] = time;
    return ISO_OK;
}

/* Numbers with blanks, commas or new lines between; # begins a comment. */
static iso_status read_times_line(iso_context *ctx, const char *name, int line, const char *text, times *t,
                                  size_t *room)
{
    iso_status status = ISO_OK;
    const char *end = text + strcspn(text, "#\r\n");
    for (const char *at = text; status == ISO_OK;) {
        double time;
        at += strspn(at, " \t,");
        if (at >= end) break;
        size_t length = strcspn(at, " \t,\r\n#");
        if (!iso_number_read(at, length, &time))
            return iso_context_fail(ctx, ISO_BAD_INPUT, "",
                                    "%s:%d:%d: '%.*s' is not a time: expected a finite number", name, line,
                                    (int)(at - text) + 1, (int)(length < 40 ? length : 40), at);
        status = add_time(ctx, t, room, time);
        at += length;
    }
    return status;
}

static iso_status read_times(iso_context *ctx, const char *path, times *t)
{
    char *text = NULL;
    size_t size = 0, room = 0;
    int line = 0;
    iso_status status = ISO_OK;
    const bool is_stdin = strcmp(path, "-") == 0;
    FILE *file = is_stdin ? stdin : fopen(path, "r");
    if (!file) return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "%s: cannot open the file of times", path);
    while (status == ISO_OK && getline(&text, &size, file) > 0)
        status = read_times_line(ctx, path, ++line, text, t, &room);
    if (status == ISO_OK && ferror(file))
        status = iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "%s: cannot read", path);
    if (status == ISO_OK && t->count == 0)
        status = iso_context_fail(ctx, ISO_BAD_INPUT, "", "%s:1:1: no times in this file: expected numbers", path);
    free(text);
    if (!is_stdin) fclose(file);
    return status;
}

static iso_status describe(iso_context *ctx, const iso_scene *scene, const iso_orbit *orbit, const int columns[],
                           int count, iso_record **header)
{
    const char *names[ISO_TRAJECTORY_COLUMNS];
    for (int i = 0; i < count; i++) names[i] = iso_trajectory_columns[columns[i]];
    const iso_picture as = scene->as == ISO_AUTO ? scene->start.model : scene->as;
    iso_status status = iso_record_create(ctx, (size_t)count, names, header);
    if (status == ISO_OK)
        status = iso_record_describe(ctx, *header, iso_picture_name(as), &scene->params, iso_orbit_energy(orbit),
                                     iso_orbit_coupling(orbit));
    if (status == ISO_OK) status = iso_record_set(ctx, *header, "backend", iso_orbit_model(orbit)->system->name);
    if (status == ISO_OK) status = iso_record_set(ctx, *header, "method", iso_orbit_method(orbit)->name);
    if (status == ISO_OK) status = iso_record_set_numbers(ctx, *header, "tolerance", 1, &scene->tolerance);
    if (status == ISO_OK) status = iso_record_set(ctx, *header, "isoroll", ISO_VERSION);
    return status;
}

static iso_status write_rows(iso_context *ctx, iso_orbit *orbit, const times *t, const int columns[], int count,
                             iso_trajectory_writer *writer, size_t *written)
{
    double row[ISO_TRAJECTORY_COLUMNS];
    for (*written = 0; *written < t->count && !interrupted(); ++*written) {
        iso_sample sample;
        iso_status status = iso_orbit_at(orbit, time_at(t, *written), &sample);
        if (status != ISO_OK) return status;
        for (int c = 0; c < count; c++) row[c] = iso_sample_column(&sample, columns[c]);
        status = iso_trajectory_write_row(ctx, writer, row, (size_t)count);
        if (status != ISO_OK) return status;
        progress_show((double)*written / (double)t->count);
    }
    return ISO_OK;
}

static void tell(const iso_orbit *orbit, size_t rows)
{
    const iso_statistics s = iso_orbit_statistics(orbit);
    complain("%zu rows; backend %s, method %s: %ld steps, %ld rejected, %ld right-hand sides, %ld Jacobians; largest "
             "correction by projection %.2g",
             rows, iso_orbit_model(orbit)->system->name, iso_orbit_method(orbit)->name, s.steps, s.rejected, s.rhs,
             s.jacobians, s.correction);
}

/* Writes all rows it can: what was computed before a failure or an interruption is kept. */
static int write_file(iso_context *ctx, const options *o, iso_orbit *orbit, const times *t, const iso_record *header,
                      const int columns[], int count)
{
    iso_trajectory_writer *writer;
    size_t rows = 0;
    iso_status status = iso_trajectory_open(ctx, o->output, &writer);
    if (status != ISO_OK) return finish(ctx, status);
    status = iso_trajectory_write_header(ctx, writer, header);
    if (status == ISO_OK) status = write_rows(ctx, orbit, t, columns, count, writer, &rows);
    const bool keep = status == ISO_OK || (status == ISO_NUMERICAL && rows > 0);
    int result = finish(ctx, status);
    status = iso_trajectory_close(ctx, writer, keep);
    if (status != ISO_OK) return result == EXIT_DONE ? finish(ctx, status) : result;
    if (o->verbose) tell(orbit, rows);
    if (result == EXIT_NUMERICAL) complain("%zu of %zu rows were written", keep ? rows : 0, t->count);
    if (result != EXIT_DONE || rows == t->count) return result;
    complain("interrupted: %zu of %zu rows were written", rows, t->count);
    return EXIT_SOME_FAILED;
}

static int run(iso_context *ctx, const options *o)
{
    iso_scene scene;
    iso_orbit *orbit = NULL;
    iso_record *header = NULL;
    int columns[ISO_MAX_COLUMNS], count = 0, result;
    times t = {.scene = &scene};
    iso_status status = scene_with_options(ctx, o, &scene);
    if (status == ISO_OK && o->times) status = read_times(ctx, o->times, &t);
    if (status == ISO_OK) {
        if (!t.list) t.count = iso_scene_rows(&scene);
        count = iso_scene_columns(&scene, columns);
        status = orbit_for_columns(ctx, &scene, columns, count, &orbit);
    }
    if (status == ISO_OK) status = describe(ctx, &scene, orbit, columns, count, &header);
    result = status == ISO_OK ? write_file(ctx, o, orbit, &t, header, columns, count) : finish(ctx, status);
    iso_record_free(header);
    iso_orbit_free(orbit);
    free(t.list);
    return result;
}

const command command_run = {
    .name = "run",
    .argument = "SCENE",
    .doc = "integrate a scene and write its trajectory",
    .options = " output backend method tol as t-end step times verbose ",
    .more =
        "The times of --t-end, --step and --times are those of the clock of the scene's model: t of a ball, s of a "
        "point.\nRows do not depend on which other times are asked. Interrupted (Ctrl-C), the rows so far are "
        "kept.",
    .run = run,
};

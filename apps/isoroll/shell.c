/* shell.c - a command that asks a study, from its options to its exit status (see shell.h). */
#include "shell.h"

#include <string.h>

#include "base/record_impl.h"
#include "scene_options.h"
#include "terminal.h"

/* --- before ----------------------------------------------------------------------------------------------------- */

static void tell_note(void *data, const char *words)
{
    (void)data;
    complain("%s", words);
}

/* Refuses `-o -` beside --json: both write to standard output. */
static iso_status check_json_alone(const shell *s, const shell_parts *parts)
{
    const char *table = s->told->table;
    if (!s->told->json || !table || strcmp(table, "-") != 0) return ISO_OK;
    return iso_context_fail(s->ctx, ISO_BAD_ARGUMENT, "output",
                            "%s: -o - and --json both write to standard output: choose one", parts->study->name);
}

iso_status shell_change(shell *s)
{
    const iso_scene_changes *change = s->options;
    return iso_scene_apply(s->ctx, change, &s->scene);
}

/* Reads the scene and opens the file. Refuses wrong options before the work begins. */
static iso_status prepare(shell *s, const shell_parts *parts, iso_table_writer **writer)
{
    const shell_options *o = s->told;
    iso_status status = parts->check ? parts->check(s) : check_json_alone(s, parts);
    if (status == ISO_OK) status = iso_plot_check_page(s->ctx, &o->plot);
    if (status == ISO_OK) status = iso_scene_load(s->ctx, o->file, &s->scene);
    if (status == ISO_OK && parts->change) status = parts->change(s);
    return status == ISO_OK && o->table ? iso_table_writer_open(s->ctx, o->table, parts->kind, writer) : status;
}

/* --- after ------------------------------------------------------------------------------------------------------ */

/* The file's table says of what it is, not all that was found: the scene's numbers, the version of isoroll, and what
 * the study says (iso_study_describe). */
static iso_status describe(shell *s, const shell_parts *parts)
{
    iso_record *table = s->result.table[0];
    iso_record_forget_lines(table);
    const iso_status status = iso_record_describe_scene(s->ctx, table, &s->scene);
    return status == ISO_OK ? iso_study_describe(s->ctx, parts->study, &s->subject, s->options, &s->result) : status;
}

int shell_draw(const shell *s, const iso_record *table)
{
    return finish(s->ctx, plot_table(s->ctx, &s->told->plot, table));
}

/* Prints text or JSON, unless the table goes to standard output. */
static int print(const shell *s, const shell_parts *parts)
{
    const iso_study_result *r = &s->result;
    if (s->told->json) {
        json_t *o = parts->json ? parts->json(s) : json_of_scene(&s->scene, r->fields, r->found);
        return json_print(o) ? EXIT_DONE : EXIT_NUMERICAL;
    }
    if (r->text && !(s->told->table && strcmp(s->told->table, "-") == 0))
        iso_fold(stdout, r->text, terminal_width(stdout));
    return EXIT_DONE;
}

/* Without a row there is no file. */
static int save(shell *s, const shell_parts *parts, iso_table_writer *writer)
{
    iso_status status = describe(s, parts);
    const bool made = status == ISO_OK;
    if (writer && made)
        status = iso_table_write_all(s->ctx, writer, s->result.table[0]);
    else if (writer)
        iso_table_writer_close(s->ctx, writer, false);
    const int result = finish(s->ctx, status);
    if (!s->told->plot.path || !made) return result;
    return worse(result, parts->draw ? parts->draw(s) : shell_draw(s, s->result.table[0]));
}

int shell_run(iso_context *ctx, const shell_parts *parts, const void *options, const shell_options *told)
{
    shell s = {.ctx = ctx,
               .options = options,
               .told = told,
               .result = {.sink = {.note = tell_note, .progress = progress_told}}};
    iso_table_writer *writer = NULL;
    iso_status status = prepare(&s, parts, &writer);
    if (status != ISO_OK) return finish_scene(ctx, told->file, &s.scene, status);
    begin_work(ctx, NULL);
    s.subject = (iso_study_subject){.scene = &s.scene, .command = options_command()};
    status = iso_study_answer(ctx, parts->study, &s.subject, options, &s.result);
    progress_end();
    int result = finish_scene(ctx, told->file, &s.scene, status);
    if (status == ISO_STOPPED && parts->stopped) complain("interrupted: %s", parts->stopped);
    if (status == ISO_STOPPED && parts->interrupted) parts->interrupted(&s);
    if (!s.result.table[0]) {
        iso_table_writer_close(ctx, writer, false);
    } else {
        if (s.result.failed) result = worse(result, EXIT_SOME_FAILED);
        result = worse(result, print(&s, parts));
        if (parts->write) result = worse(result, parts->write(&s));
        result = worse(result, save(&s, parts, writer));
    }
    iso_study_result_free(&s.result);
    return result;
}

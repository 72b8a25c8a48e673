/* shell.c - a command that asks a study, from its options to its exit status (see shell.h). */
#include "shell.h"

#include <string.h>

#include "base/record_impl.h"
#include "command.h"

static void show_note(void *data, const char *text)
{
    (void)data;
    warn("%s", text);
}

iso_status shell_change(shell *s)
{
    return iso_scene_apply(s->ctx, s->options, &s->scene);
}

/* Whether the table goes to standard output. */
static bool prints_table(const shell *s)
{
    return s->common->table && strcmp(s->common->table, "-") == 0;
}

/* Reads the scene and opens the file. Refuses wrong options before the work begins. */
static iso_status prepare(shell *s, const shell_parts *parts, iso_table_writer **writer)
{
    const shell_options *o = s->common;
    if (parts->check)
        ISO_TRY(parts->check(s));
    else if (o->json && prints_table(s))
        return ISO_FAIL_ARGUMENT(s->ctx, "output", "%s: -o - and --json both write to standard output: choose one",
                                 s->study->name);
    ISO_TRY(iso_plot_check_page(s->ctx, &o->plot));
    ISO_TRY(iso_scene_load(s->ctx, o->file, &s->scene));
    if (parts->change) ISO_TRY(parts->change(s));
    return o->table ? iso_table_writer_open(s->ctx, o->table, parts->kind, writer) : ISO_OK;
}

int shell_draw(const shell *s, const iso_record *table)
{
    return finish(s->ctx, plot_table(s->ctx, &s->common->plot, table));
}

/* Writes and draws the table. In a file it says what it is of, not all that was found: the scene's numbers, the version
 * of isoroll, and what the study says (iso_study_describe). */
static int save(shell *s, const shell_parts *parts, iso_table_writer *writer)
{
    iso_record *table = s->result.table[0];
    iso_record_forget_lines(table);
    iso_status status = iso_record_describe_scene(s->ctx, table, &s->scene);
    if (status == ISO_OK) status = iso_study_describe(s->ctx, s->study, &s->subject, s->options, &s->result);
    const bool made = status == ISO_OK;
    if (writer && made)
        status = iso_table_write_all(s->ctx, writer, table);
    else if (writer)
        iso_table_writer_close(s->ctx, writer, false);
    const int result = finish(s->ctx, status);
    if (!s->common->plot.path || !made) return result;
    return worse(result, parts->draw ? parts->draw(s) : shell_draw(s, table));
}

int shell_run(iso_context *ctx, const iso_study *study, const shell_parts *parts, const void *options,
              const shell_options *common)
{
    shell s = {.ctx = ctx,
               .study = study,
               .options = options,
               .common = common,
               .result = {.sink = {.note = show_note, .progress = progress_sink}}};
    iso_table_writer *writer = NULL;
    iso_status status = prepare(&s, parts, &writer);
    if (status != ISO_OK) return finish_scene(ctx, common->file, &s.scene, status);
    begin_work(ctx, NULL);
    s.subject = (iso_study_subject){.scene = &s.scene, .command = options_command()};
    status = iso_study_answer(ctx, study, &s.subject, options, &s.result);
    progress_end();
    int result = finish_scene(ctx, common->file, &s.scene, status);
    if (status == ISO_STOPPED && parts->stopped) warn("interrupted: %s", parts->stopped);
    if (status == ISO_STOPPED && parts->interrupted) parts->interrupted(&s);
    if (!s.result.table[0]) {
        iso_table_writer_close(ctx, writer, false);
    } else {
        if (s.result.failed) result = worse(result, EXIT_SOME_FAILED);
        if (common->json) {
            json_t *o = parts->json ? parts->json(&s) : json_of_scene(&s.scene, s.result.fields, s.result.found);
            result = worse(result, json_print(o) ? EXIT_DONE : EXIT_NUMERICAL);
        } else if (s.result.text && !prints_table(&s)) {
            iso_fold(stdout, s.result.text, terminal_width(stdout));
        }
        if (parts->write) result = worse(result, parts->write(&s));
        result = worse(result, save(&s, parts, writer));
    }
    iso_study_result_free(&s.result);
    return result;
}

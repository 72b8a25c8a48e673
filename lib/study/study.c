/* study.c - asking a study: its options, its tables, what it tells people (see study.h). */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fold_impl.h"
#include "orbit/orbit_impl.h"
#include "study/options_impl.h"

/* --- asking ----------------------------------------------------------------------------------------------------- */

static iso_status refuse_subject(iso_context *ctx, const iso_study *study, const iso_study_subject *subject)
{
    if (study->of & ISO_STUDY_OF_SCENE && !subject->scene)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "scene", "%s needs a scene", study->name);
    if (study->of & ISO_STUDY_OF_RECORD && !subject->record)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "record", "%s needs a trajectory", study->name);
    if (subject->scene && !(study->of & (ISO_STUDY_OF_SCENE | ISO_STUDY_USES_SCENE)))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "scene", "%s takes no scene", study->name);
    if (subject->record && !(study->of & (ISO_STUDY_OF_RECORD | ISO_STUDY_USES_RECORD)))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "record", "%s takes no trajectory", study->name);
    return ISO_OK;
}

/* Ends the words of text, which then are names and values in turn. */
static iso_status set_options(iso_context *ctx, const iso_study *study, char *text, void *how)
{
    iso_status status = ISO_OK;
    for (char *name = text, *next; status == ISO_OK && *name; name = next) {
        next = name + strcspn(name, "\n");
        if (*next) *next++ = '\0';
        char *value = strchr(name, '=');
        if (!value) return iso_context_fail(ctx, ISO_BAD_ARGUMENT, name, "'%s' is no option: write NAME=VALUE", name);
        *value++ = '\0';
        status = iso_study_set(ctx, study, name, value, how);
    }
    return status;
}

iso_status iso_study_read(iso_context *ctx, const iso_study *study, char *text, void *how)
{
    study->begin(how);
    iso_status status = set_options(ctx, study, text, how);
    if (status == ISO_OK && study->prepare) status = study->prepare(ctx, how);
    return status == ISO_BAD_INPUT ? ISO_BAD_ARGUMENT : status; /* it is the call that is wrong, no file */
}

/* The text that a study prints for people, if it has made something. */
static iso_status print_text(iso_context *ctx, const iso_study *study, const iso_study_subject *subject,
                             const void *options, iso_study_result *result)
{
    iso_memory memory;
    const bool made = result->table[0] || study->of & ISO_STUDY_STREAMS;
    if (!study->print || !result->found || !made) return ISO_OK;
    FILE *to = iso_memory_open(&memory);
    if (to) study->print(to, subject->scene, options, result);
    result->text = iso_memory_close(to, &memory);
    return result->text ? ISO_OK : iso_context_no_memory(ctx, "a text");
}

iso_status iso_study_describe(iso_context *ctx, const iso_study *study, const iso_study_subject *subject,
                              const void *options, iso_study_result *result)
{
    iso_record *table = result->table[0];
    const bool says = subject->command && !(study->of & ISO_STUDY_STREAMS);
    iso_status status = says ? iso_record_set(ctx, table, "command", subject->command) : ISO_OK;
    return status == ISO_OK && study->describe ? study->describe(ctx, subject->scene, options, result) : status;
}

iso_status iso_study_answer(iso_context *ctx, const iso_study *study, const iso_study_subject *subject,
                            const void *options, iso_study_result *result)
{
    ISO_TRY(refuse_subject(ctx, study, subject));
    const iso_status status = study->run(ctx, subject, options, result);
    iso_status told = print_text(ctx, study, subject, options, result);
    if (told == ISO_OK && result->table[0]) told = iso_study_describe(ctx, study, subject, options, result);
    return status == ISO_OK ? told : status;
}

/* "isoroll chaos --turns 500 --starts 20 scene.yaml": what makes the table again. Options that change no number are
 * left out. NULL: no memory. */
static char *command_of(const iso_study *study, const char *name, const char *options)
{
    iso_memory memory;
    FILE *to = iso_memory_open(&memory);
    if (!to) return NULL;
    fprintf(to, "isoroll %s", study->name);
    for (const char *o = options; *o; o += *o == '\n') {
        const size_t length_of_name = strcspn(o, "=\n"), line = strcspn(o, "\n");
        const iso_option *row = iso_study_option_find(study, o, length_of_name);
        if (row && !row->aside && o[length_of_name] == '=') { /* without "=" it will be refused */
            const char *value = o + length_of_name + 1;
            const int rest = (int)(line - length_of_name - 1);
            const bool quoted = strcspn(value, " ;*?&|<>()$'\"\n") < (size_t)rest;
            fprintf(to, " --%s", row->name);
            if (row->argument) fprintf(to, quoted ? " '%.*s'" : " %.*s", rest, value);
        }
        o += line;
    }
    if (name) fprintf(to, " %s", name);
    return iso_memory_close(to, &memory);
}

static iso_status ask(iso_context *ctx, const iso_study *study, const iso_study_subject *subject, char *text,
                      void *how, iso_study_result *result)
{
    iso_study_subject asked = *subject;
    char *command = asked.command ? NULL : command_of(study, asked.name, text);
    if (command) asked.command = command;
    iso_status status = iso_study_read(ctx, study, text, how);
    if (status == ISO_OK) status = iso_study_answer(ctx, study, &asked, how, result);
    if (study->end) study->end(how);
    free(command);
    return status;
}

iso_status iso_study_ask_text(iso_context *ctx, const iso_study *study, const iso_study_subject *subject,
                              const char *options, iso_study_result *result)
{
    char *text = strdup(options ? options : "");
    void *how = malloc(study->size);
    const iso_status status =
        text && how ? ask(ctx, study, subject, text, how, result) : iso_context_no_memory(ctx, "a study");
    free(how);
    free(text);
    if (status != ISO_OK && (!result->table[0] || iso_record_rows(result->table[0]) == 0))
        iso_study_result_free(result);
    return status;
}

void *iso_study_keep(iso_study_result *result, void *found, const iso_field *fields, void (*free)(void *found))
{
    result->found = found;
    result->fields = fields;
    result->free = found ? free : NULL;
    return found;
}

void iso_study_result_free(iso_study_result *result)
{
    for (int i = 0; i < ISO_STUDY_TABLES; i++) {
        iso_record_free(result->table[i]);
        result->table[i] = NULL;
    }
    if (result->free) result->free(result->found);
    free(result->text);
    result->text = NULL;
    result->found = NULL;
    result->free = NULL;
}

iso_status iso_study_title(iso_context *ctx, const iso_study_result *result, const char *format, ...)
{
    char title[320];
    va_list args;
    va_start(args, format);
    vsnprintf(title, sizeof title, format, args);
    va_end(args);
    return iso_record_set(ctx, result->table[0], "title", title);
}

void iso_study_note(const iso_study_result *result, const char *format, ...)
{
    char words[1536];
    va_list args;
    va_start(args, format);
    vsnprintf(words, sizeof words, format, args);
    va_end(args);
    if (result->sink.note) result->sink.note(result->sink.data, words);
}

void iso_study_progress(void *result, double part)
{
    const iso_sink *sink = &((const iso_study_result *)result)->sink;
    if (sink->progress) sink->progress(sink->data, part);
}

/* --- rows of a record ------------------------------------------------------------------------------------------- */

static bool is_nan(const double row[], size_t columns)
{
    size_t known = 0;
    for (size_t i = 0; i < columns; i++) known += isnan(row[i]) ? 0 : 1;
    return known == 0;
}

iso_status iso_kept_rows_next(iso_context *ctx, void *kept, iso_source_row *row)
{
    iso_kept_rows *at = kept;
    const iso_record *r = at->record;
    const size_t columns = iso_record_columns(r), rows = iso_record_rows(r);
    const int orbit = iso_record_find(r, "orbit");
    (void)ctx;
    for (; at->passes_nan && at->row < rows && is_nan(iso_record_const_row(r, at->row), columns); at->row++)
        row->passed++;
    row->more = at->row < rows;
    if (!row->more) return ISO_OK;
    memcpy(row->number, iso_record_const_row(r, at->row), columns * sizeof *row->number);
    row->line = ++at->row;
    row->orbits = orbit >= 0;
    row->begins_orbit = orbit >= 0 && at->row > 1 && row->number[orbit] != row->orbit;
    if (orbit >= 0) row->orbit = row->number[orbit];
    const iso_sink *sink = at->sink;
    if (at->row % 1024 == 0 && sink->progress) sink->progress(sink->data, (double)at->row / (double)rows);
    return ISO_OK;
}

/* --- tables ----------------------------------------------------------------------------------------------------- */

void iso_fields_rename(const iso_field *fields, const char *old, const char *name, iso_field copy[ISO_MOST_FIELDS])
{
    iso_fields_copy(fields, NULL, copy);
    for (iso_field *f = copy; f->name; f++)
        if (strcmp(f->name, old) == 0) f->name = name;
}

iso_status iso_study_table(iso_context *ctx, const char *kind, const iso_scene *scene, const iso_field *fields,
                           const void *found, const iso_field *rows, iso_record **table)
{
    static const iso_field none[] = {ISO_FIELD_END};
    ISO_TRY(iso_columns_create(ctx, rows ? rows : none, table));
    iso_record_set_kind(*table, kind);
    const iso_status status = scene ? iso_record_describe_scene(ctx, *table, scene) : ISO_OK;
    return status == ISO_OK && fields ? iso_record_set_fields(ctx, *table, fields, found) : status;
}

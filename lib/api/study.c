/* study.c - any study by its name and options as text; and what studies, options and tables there are. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/interface_impl.h"
#include "base/names_impl.h"
#include "base/record_impl.h"
#include "picture/picture.h"
#include "study/study.h"
#include "sweep/sweep_store_impl.h"
#include "task/list/list_impl.h"

/* --- asking ----------------------------------------------------------------------------------------------------- */

iso_status iso_study_ask(iso_context *ctx, const char *name, const iso_scene *scene, const iso_record *record,
                         const char *options, const iso_sink *sink, iso_record *table[ISO_TABLES])
{
    char suggested[ISO_SUGGEST_SIZE];
    const iso_study *study = iso_study_find(name);
    iso_study_result result = {.text = NULL};
    const iso_study_subject subject = {.scene = scene, .name = scene ? scene->name : NULL, .record = record};
    if (sink) result.sink = *sink;
    for (int i = 0; i < ISO_TABLES; i++) table[i] = NULL;
    if (!study)
        return ISO_FAIL_ARGUMENT(ctx, "study", "there is no study '%s'; %s", name,
                                 iso_suggest_word(suggested, name, iso_study_name));
    iso_status status = iso_study_ask_text(ctx, study, &subject, options, &result);
    const bool of_scene = status != ISO_OK && status != ISO_BAD_ARGUMENT && scene && !result.table[0];
    if (of_scene) status = iso_blame_scene(ctx, scene, status);
    if (result.table[0]) iso_record_keep_text(result.table[0], result.text), result.text = NULL;
    for (int i = 0; i < ISO_TABLES; i++) {
        table[i] = result.table[i];
        result.table[i] = NULL;
    }
    iso_study_result_free(&result);
    return status;
}

_Static_assert((int)ISO_TABLES == (int)ISO_STUDY_TABLES, "tables of a study");

iso_status iso_study_text(iso_context *ctx, const iso_record *table, int width, char text[], size_t room,
                          size_t *length)
{
    iso_memory memory;
    FILE *to = iso_memory_open(&memory);
    const char *raw = iso_record_text(table);
    if (to && raw) iso_fold(to, raw, width);
    return iso_text_give(ctx, to, &memory, text, room, length);
}

/* --- what there is ---------------------------------------------------------------------------------------------- */

const char *iso_study_name(int i)
{
    return iso_study_at(i) ? iso_study_at(i)->name : NULL;
}

const char *iso_study_doc(const char *name)
{
    return iso_study_find(name) ? iso_study_find(name)->doc : NULL;
}

int iso_study_of(const char *name)
{
    return iso_study_find(name) ? (int)iso_study_find(name)->of : 0;
}

static const iso_option *option_at(const char *study, int i)
{
    const iso_study *s = iso_study_find(study);
    const iso_option *o = s ? s->options : NULL;
    for (; o && o->name && i > 0; o++) i--;
    return o && o->name && i == 0 ? o : NULL;
}

bool iso_study_option(const char *study, int i, const char *text[5])
{
    const iso_option *o = option_at(study, i);
    if (!o) return false;
    text[0] = o->name;
    text[1] = iso_option_type(o);
    text[2] = o->argument ? o->argument : "";
    text[3] = o->expected ? o->expected : "";
    text[4] = o->doc;
    return true;
}

const char *iso_study_option_word(const char *study, int i, int word)
{
    const iso_option *o = option_at(study, i);
    for (int w = 0; o && o->word && o->word(w); w++)
        if (w == word) return o->word(w);
    return NULL;
}

iso_status iso_list(iso_context *ctx, const char *topic, char text[], size_t room, size_t *length)
{
    iso_memory memory;
    FILE *to = iso_memory_open(&memory);
    const iso_status status = to ? iso_list_print(ctx, topic, to) : ISO_OK,
                     given = iso_text_give(ctx, to, &memory, text, room, length);
    return status == ISO_OK ? given : status;
}

/* --- tables ----------------------------------------------------------------------------------------------------- */

const char *iso_kind_name(int i)
{
    int of_studies = 0;
    while (iso_result_table_at(of_studies)) of_studies++;
    return i == of_studies ? ISO_SWEEP_KIND : iso_result_table_at(i) ? iso_result_table_at(i)->kind : NULL;
}

typedef struct column {
    int wanted;
    char *name;
    const char **text; /* unit and doc */
} column;

static void look(void *data, const char *name, const iso_field *field, const iso_value *value)
{
    column *c = data;
    (void)value;
    if (c->wanted-- != 0) return;
    c->text[0] = field->unit;
    c->text[1] = field->doc;
    memcpy(c->name, name, strlen(name) + 1);
}

bool iso_kind_column(const char *kind, int i, char name[64], const char *text[2])
{
    column c = {i, name, text};
    for (int t = 0; iso_result_table_at(t); t++)
        if (strcmp(iso_result_table_at(t)->kind, kind) == 0)
            iso_columns_visit(iso_result_table_at(t)->fields, NULL, look, &c);
    if (strcmp(kind, ISO_SWEEP_KIND) == 0) iso_sweep_columns_visit(look, &c);
    return i >= 0 && c.wanted < 0;
}

/* --- pictures --------------------------------------------------------------------------------------------------- */

_Static_assert((int)ISO_PICTURE_MOST == (int)ISO_PICTURE_TABLES, "tables of a picture");

iso_status iso_picture_of(iso_context *ctx, const iso_record *const table[], const char *options, const char **layout,
                          iso_record *made[ISO_PICTURE_MOST])
{
    iso_picture picture = {.layout = ""};
    const iso_status status = iso_picture_make(ctx, table, options, &picture);
    *layout = picture.layout;
    memcpy(made, picture.table, sizeof picture.table);
    return status;
}

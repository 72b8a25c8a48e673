/* study.c - any study of a scene, by its name and options as text. */
#include <stdlib.h>
#include <string.h>

#include "base/nearest_impl.h"
#include "foreign/foreign_impl.h"
#include "study/study.h"

static void keep_note(void *data, const char *words)
{
    iso_notes_add(data, words);
}

static const char *study_name(int i)
{
    return iso_study_at(i) ? iso_study_at(i)->name : NULL;
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

static iso_status run(iso_context *ctx, const iso_foreign_scene *scene, const iso_study *study, char *text, void *how,
                      iso_study_result *result)
{
    study->begin(how);
    iso_status status = set_options(ctx, study, text, how);
    if (status == ISO_OK && study->prepare) status = study->prepare(ctx, how);
    if (status == ISO_OK) {
        status = study->run(ctx, &scene->scene, how, result);
        if (!result->table[0]) status = iso_foreign_blame(ctx, scene, status);
    }
    if (study->end) study->end(how);
    return status;
}

iso_status iso_foreign_study(iso_context *ctx, const iso_foreign_scene *scene, const char *name, const char *options,
                             iso_record *table[ISO_STUDY_TABLES], char notes_[], size_t room)
{
    notes n = iso_notes_begin(notes_, room);
    const iso_study *study = iso_study_find(name);
    iso_study_result result = {.note = keep_note, .data = &n};
    char suggested[ISO_SUGGEST_SIZE];
    for (int i = 0; i < ISO_STUDY_TABLES; i++) table[i] = NULL;
    if (!study)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "study", "there is no study '%s'; %s", name,
                                iso_suggest_word(suggested, name, study_name));
    char *text = strdup(options ? options : "");
    void *how = malloc(study->size);
    const iso_status status =
        text && how ? run(ctx, scene, study, text, how, &result) : iso_context_no_memory(ctx, "a study");
    free(how);
    free(text);
    const bool none = status != ISO_OK && (!result.table[0] || iso_record_rows(result.table[0]) == 0);
    for (int i = 0; i < ISO_STUDY_TABLES; i++)
        if (none)
            iso_record_free(result.table[i]);
        else
            table[i] = result.table[i];
    return status;
}

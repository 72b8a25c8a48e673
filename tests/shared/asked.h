/* asked.h - studies asked through the public interface, with their notes as lines of one text. */
#ifndef ISO_TESTS_ASKED_H
#define ISO_TESTS_ASKED_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/interface.h"

typedef struct asked_notes {
    char *text;
    size_t room;
    void (*progress)(void *data, double part);
    void *data;
} asked_notes;

static inline void asked_note(void *data, const char *text)
{
    const asked_notes *n = data;
    const size_t used = n->room > 0 ? strlen(n->text) : 0;
    if (n->room > 0) snprintf(n->text + used, n->room - used, "%s%s", used > 0 ? "\n" : "", text);
}

static inline void asked_progress(void *data, double part)
{
    const asked_notes *n = data;
    if (n->progress) n->progress(n->data, part);
}

/* iso_study_ask with notes[room]; progress may be NULL. */
static inline iso_status asked(iso_context *ctx, const iso_scene *scene, const iso_record *record, const char *name,
                               const char *options, void (*progress)(void *data, double part), void *data,
                               iso_record *table[ISO_TABLES], char notes[], size_t room)
{
    asked_notes n = {notes, room, progress, data};
    const iso_sink sink = {.note = asked_note, .progress = asked_progress, .data = &n};
    if (room > 0) *notes = '\0';
    return iso_study_ask(ctx, name, scene, record, options, &sink, table);
}

/* The rows of a run at these times (NULL: the scene's). */
static inline iso_status asked_run(iso_context *ctx, const iso_scene *scene, const double times[], size_t count,
                                   iso_record **rows, char notes[], size_t room)
{
    iso_record *table[ISO_TABLES], *asked_for = NULL;
    iso_status status = ISO_OK;
    if (times) status = iso_record_create(ctx, 1, (const char *const[]){"time"}, &asked_for);
    if (times && status == ISO_OK) status = iso_record_add(ctx, asked_for, count, times);
    if (status == ISO_OK) status = asked(ctx, scene, asked_for, "run", NULL, NULL, NULL, table, notes, room);
    iso_record_free(asked_for);
    *rows = table[0];
    return status;
}

#endif

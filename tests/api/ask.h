/* ask.h - what the tests of the interface share: scenes of texts, studies asked by text, their tables. */
#ifndef ISO_TESTS_ASK_H
#define ISO_TESTS_ASK_H

#include "asked.h"
#include "runs.h"
#include "study/study.h"

#define FREE REDUCED("0.5") TIME
enum { WIDTH = 7 }; /* of a row of the ball: t, omega, n */

static char notes[400];
static iso_record *table[ISO_STUDY_TABLES];

static inline iso_scene *made(const char *text)
{
    iso_scene *scene;
    laws_stop_if(ctx, iso_scene_parse(ctx, "scene", text, strlen(text), &scene) != ISO_OK, text);
    return scene;
}

static inline bool about(const char *words)
{
    return strcmp(iso_context_about(ctx), words) == 0;
}

/* Whether the message begins with these words. */
static inline bool begins(const char *words)
{
    return strncmp(iso_context_message(ctx), words, strlen(words)) == 0;
}

/* Threads may tell progress at the same time: the flag only rises. */
static inline void look(void *wrong, double part)
{
    if (!(part >= 0 && part <= 1)) *(bool *)wrong = true;
}

/* Runs a study into `table`; the tables of the one before are freed. */
static inline iso_status ask_of(const iso_scene *scene, const iso_record *record, const char *name,
                                const char *options)
{
    bool wrong = false;
    for (int i = 0; i < ISO_STUDY_TABLES; i++) iso_record_free(table[i]);
    const iso_status status = asked(ctx, scene, record, name, options, look, &wrong, table, notes, sizeof notes);
    gsl_test(wrong, "%s: progress is in [0, 1]", name);
    return status;
}

static inline iso_status ask(const iso_scene *scene, const char *name, const char *options)
{
    return ask_of(scene, NULL, name, options);
}

static inline void forget_tables(void)
{
    for (int i = 0; i < ISO_STUDY_TABLES; i++) iso_record_free(table[i]), table[i] = NULL;
}

#endif

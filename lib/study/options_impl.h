/* options_impl.h - what the options of studies are made of: setters, and rows that several of them have. */
#ifndef ISO_STUDY_OPTIONS_IMPL_H
#define ISO_STUDY_OPTIONS_IMPL_H

#include "base/field.h"
#include "method/method.h"
#include "study/study.h"

/* The studies and their options. Each stands in the room of its study. Their tables: of chaos the orbits and both
 * traces; of periodic the orbits; of section the crossings, and those that the point finds; frequencies and integrals
 * have one without rows. */
extern const iso_study iso_chaos_study, iso_frequencies_study, iso_integrals_study, iso_periodic_study,
    iso_section_study;
extern const iso_option iso_chaos_option[], iso_frequencies_option[], iso_integrals_option[], iso_periodic_option[],
    iso_section_option[];

/* Setters: each reads one kind of argument into the member at `at`. Whole numbers are below 9e15; an int becomes at
 * most 1e9. */
bool iso_set_text(void *at, const char *text);      /* const char *, not empty              */
bool iso_set_flag(void *at, const char *text);      /* bool                                 */
bool iso_set_number(void *at, const char *text);    /* double, finite                       */
bool iso_set_positive(void *at, const char *text);  /* double, > 0                          */
bool iso_set_tolerance(void *at, const char *text); /* double, as the methods take it       */
bool iso_set_whole(void *at, const char *text);     /* double, a whole number from 0 on     */
bool iso_set_count(void *at, const char *text);     /* double, a whole number from 1 on     */
bool iso_set_whole_int(void *at, const char *text); /* the same for int, long and size_t   */
bool iso_set_count_int(void *at, const char *text);
bool iso_set_whole_long(void *at, const char *text);
bool iso_set_count_long(void *at, const char *text);
bool iso_set_whole_size(void *at, const char *text); /* size_t                              */
bool iso_set_count_size(void *at, const char *text);
bool iso_set_seed(void *at, const char *text);   /* uint64_t, from 0 on                      */
bool iso_set_models(void *at, const char *text); /* iso_models: a word of iso_models_word    */
const char *iso_models_word(int i);              /* "ball", "point", "both"                  */
bool iso_set_at(void *at, const char *text);     /* one more of iso_section_words  */

#define ISO_AT_EXPECTED "l,x, at most 64 times"
#define ISO_SEED_SPREADS "another number spreads --starts in another way (default 0)"
#define ISO_MODELS_INTEGRATED "which model is integrated (default: both, where the ball has a twin)"
#define ISO_TOLERANCE_OF_STEPS "largest relative error of one step, in " ISO_TOLERANCE_RANGE

#define ISO_OPTION_END                                                                                               \
    {                                                                                                                \
        .name = NULL                                                                                                 \
    }
#define ISO_OPTION_MODELS(key, argument_, doc_, type, member)                                                        \
    {                                                                                                                \
        .name = key, .argument = argument_, .expected = "ball, point or both", .doc = doc_, .set = iso_set_models,   \
        .offset = offsetof(type, member), .word = iso_models_word                                                    \
    }
#define ISO_OPTION_SEED(doc, type, member)                                                                           \
    ISO_OPTION("seed", "N", "a whole number from 0 on", doc, iso_set_seed, type, member)
#define ISO_OPTION_TOLERANCE(doc, type, member)                                                                      \
    ISO_OPTION("tol", "X", "a number in " ISO_TOLERANCE_RANGE, doc, iso_set_tolerance, type, member)
#define ISO_OPTION_THREADS(type, member)                                                                             \
    {                                                                                                                \
        .name = "threads", .argument = "N", .expected = "a whole number from 1 on",                                  \
        .doc = "threads that work (default: one for each processor)", .set = iso_set_count_int,                      \
        .offset = offsetof(type, member), .letter = 'j', .aside = true                                               \
    }

/* begin() of a study whose options are the struct T. */
#define ISO_STUDY_BEGIN(T, defaults)                                                                                 \
    static void begin(void *options)                                                                                 \
    {                                                                                                                \
        *(T *)options = defaults();                                                                                  \
    }

/* A table of a study: its kind, the scene, the result in its lines, and the columns of `rows` (NULL: none). Later
 * calls add rows. Errors: ISO_NO_MEMORY. */
iso_status iso_study_table(iso_context *ctx, const char *kind, const iso_scene *scene, const iso_field *fields,
                           const void *result, const iso_field *rows, iso_record **table);

/* The texts given for axis and starts; NULL: not given. `points`: those of `at`, allocated by prepare, freed by
 * end. */
typedef struct iso_section_words {
    const char *axis, *at[ISO_STUDY_MOST_AT + 1];
    double (*points)[2];
} iso_section_words;

#endif

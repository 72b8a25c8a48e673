/* options_impl.h - what the options of studies are made of: setters, and rows that several of them have. */
#ifndef ISO_STUDY_OPTIONS_IMPL_H
#define ISO_STUDY_OPTIONS_IMPL_H

#include "base/field.h"
#include "base/fold_impl.h"
#include "method/method.h"
#include "study/study.h"

/* The studies and their options. Each stands in the room of its study. Their tables: of chaos the orbits and both
 * traces; of periodic the orbits, the branches or the chart; of section the crossings, and those that the point finds,
 * or the areas; of splitting, prove and cost their rows; of compare the differences, and those of ball and point from
 * the closed solution; of check the residuals. Those of the others have no rows. */
#define ISO_STUDY_LIST(X) X(run) X(convert) ISO_INSTRUMENT_LIST(X) X(compare) X(check) X(explain)
/* Those that have a command in the group "study" of the command's help, in its order. */
#define ISO_INSTRUMENT_LIST(X)                                                                                       \
    X(section)                                                                                                       \
    X(chaos) X(frequencies) X(periodic) X(splitting) X(prove) X(integrals) X(analogue) X(cost)
#define ISO_STUDY_DECLARE(name)                                                                                      \
    extern const iso_study iso_##name##_study;                                                                       \
    extern const iso_option iso_##name##_option[];
ISO_STUDY_LIST(ISO_STUDY_DECLARE)

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
bool iso_set_seed(void *at, const char *text);    /* uint64_t, from 0 on                      */
bool iso_set_models(void *at, const char *text);  /* iso_models: a word of iso_models_word    */
const char *iso_models_word(int i);               /* "ball", "point", "both"                  */
bool iso_set_at(void *at, const char *text);      /* one more of iso_section_words  */
bool iso_set_bound(void *at, const char *text);   /* double, >= 0                           */
bool iso_set_vector(void *at, const char *text);  /* double[3], three numbers and commas    */
bool iso_set_method(void *at, const char *text);  /* const char *, a method or auto         */
bool iso_set_backend(void *at, const char *text); /* iso_backend: a word of iso_backend_word */
const char *iso_backend_word(int i);              /* "ball", "point", "exact", "auto"       */
bool iso_set_model(void *at, const char *text);   /* iso_model_kind: ball, point            */

/* Reads options, lines NAME=VALUE, into a study's struct of them, to be ended by study->end also after an error. The
 * text is changed, and must live as long as they do. Errors: ISO_BAD_ARGUMENT, ISO_NO_MEMORY. */
iso_status iso_study_read(iso_context *ctx, const iso_study *study, char *text, void *options);

/* What to use in place of an option that this study or command had before; NULL: it had none of this name. */
const char *iso_option_gone(const char *command, const char *name);

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

/* --- what changes something in a scene --------------------------------------------------------------------------- */

typedef struct iso_scene_changes {
    const char *method;          /* NULL: as the scene says */
    iso_backend backend;         /* -1: as the scene says   */
    iso_models as;               /* likewise                */
    double tolerance, end, step; /* NAN: as the scene says  */
} iso_scene_changes;

#define ISO_SCENE_AS_IT_IS                                                                                           \
    {                                                                                                                \
        .backend = (iso_backend)-1, .as = (iso_models)-1, .tolerance = NAN, .end = NAN, .step = NAN                  \
    }

/* Their rows; `change` is the place of an iso_scene_changes in the struct `type`. */
#define ISO_OPTION_WORDS(key, argument_, expected_, doc_, set_, type, member, word_)                                 \
    {                                                                                                                \
        .name = key, .argument = argument_, .expected = expected_, .doc = doc_, .set = set_,                         \
        .offset = offsetof(type, member), .word = word_                                                              \
    }
#define ISO_OPTION_BACKEND(type, change)                                                                             \
    ISO_OPTION_WORDS("backend", "B", "ball, point, exact or auto",                                                   \
                     "what computes the orbit: ball, point, exact, auto", iso_set_backend, type, change.backend,     \
                     iso_backend_word)
#define ISO_OPTION_METHOD(type, change)                                                                              \
    ISO_OPTION_WORDS("method", "NAME", "a method of 'isoroll list methods'" ISO_WITHOUT_SUNDIALS ", or auto",        \
                     "the integrator, or auto", iso_set_method, type, change.method, iso_method_word)
#define ISO_OPTION_T_END(type, change)                                                                               \
    ISO_OPTION("t-end", "T", "a number", "last time, in place of the scene's", iso_set_number, type, change.end)
#define ISO_OPTION_STEP(type, change)                                                                                \
    ISO_OPTION("step", "DT", "a positive number", "time between rows, in place of the scene's", iso_set_positive,    \
               type, change.step)

/* All of them. */
#define ISO_OPTIONS_OF_SCENE(type, change)                                                                           \
    ISO_OPTION_BACKEND(type, change), ISO_OPTION_METHOD(type, change),                                               \
        ISO_OPTION_TOLERANCE(ISO_TOLERANCE_OF_STEPS, type, change.tolerance),                                        \
        ISO_OPTION_MODELS("as", "WHAT", "which model is written: ball, point, both", type, change.as),               \
        ISO_OPTION_T_END(type, change), ISO_OPTION_STEP(type, change)

/* Options that only change the scene, and all their rows. */
typedef struct iso_scene_request {
    iso_scene_changes change;
} iso_scene_request;
extern const iso_option iso_scene_change_option[];

/* Puts the changes into the scene. Errors: those of iso_scene_check_times. */
iso_status iso_scene_apply(iso_context *ctx, const iso_scene_changes *change, iso_scene *scene);

/* --- results ---------------------------------------------------------------------------------------------------- */

/* begin() of a study whose options are the struct T. */
#define ISO_STUDY_BEGIN(T, ...)                                                                                      \
    static void begin(void *options)                                                                                 \
    {                                                                                                                \
        *(T *)options = __VA_ARGS__;                                                                                 \
    }

/* What every study begins with; begin() is in its file. */
#define ISO_STUDY_AS(name_, request, rows, doc_)                                                                     \
    .name = name_, .doc = doc_, .options = rows, .size = sizeof(request), .begin = begin

/* Makes `found` the struct of the result, with what describes and frees it, and returns it; NULL, for which there was
 * no memory, is never freed. */
void *iso_study_keep(iso_study_result *result, void *found, const iso_field *fields, void (*free)(void *found));

/* The line "title" of the first table, in printf's words. */
iso_status iso_study_title(iso_context *ctx, const iso_study_result *result, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Passes a remark on, in printf's words. */
void iso_study_note(const iso_study_result *result, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The part of the work that is done; `result` is the study's. */
void iso_study_progress(void *result, double part);

/* Copies fields, one of them with another name. */
void iso_fields_rename(const iso_field *fields, const char *old, const char *name, iso_field copy[ISO_MOST_FIELDS]);

/* The first table of a study: its kind, the scene (NULL: none), what is found in its lines (fields NULL: nothing), and
 * the columns of `rows` (NULL: none). Later calls add rows. Errors: ISO_NO_MEMORY. */
iso_status iso_study_table(iso_context *ctx, const char *kind, const iso_scene *scene, const iso_field *fields,
                           const void *found, const iso_field *rows, iso_record **table);

/* The texts given for axis and starts; NULL: not given. `points`: those of `at`, allocated by prepare, freed by
 * end. */
typedef struct iso_section_words {
    const char *axis, *at[ISO_STUDY_MOST_AT + 1];
    double (*points)[2];
} iso_section_words;

/* Reads them: the axis, and points l,x with semicolons between. Errors: ISO_BAD_ARGUMENT. */
iso_status iso_section_words_read(iso_context *ctx, iso_section_words *words, int *axis, const double (**at)[2],
                                  size_t *count);

#endif

/* chaos_study.c - chaos by its name: its options and its tables (study/study.h). */
#include <stdlib.h>

#include "instrument/chaos/chaos_impl.h"
#include "study/fields_impl.h"
#include "study/options_impl.h"

ISO_STUDY_BEGIN(iso_chaos_request, (iso_chaos_request){.how = iso_chaos_defaults()})

static void end(void *options)
{
    free(((iso_chaos_request *)options)->words.points);
}

static iso_status prepare(iso_context *ctx, void *options)
{
    iso_chaos_request *r = options;
    return iso_section_words_read(ctx, &r->words, &r->how.axis, &r->how.at, &r->how.at_count);
}

/* The traces are tables of the result. */
static void free_chaos(void *found)
{
    iso_chaos *c = found;
    if (c) c->trace[ISO_BALL] = c->trace[ISO_POINT] = NULL;
    iso_chaos_free(c);
}

/* A row for each orbit that was followed, that of the scene first. */
static iso_status put_orbits(iso_context *ctx, const iso_scene *scene, const iso_chaos *c, iso_record **table)
{
    iso_field fields[ISO_MOST_FIELDS];
    iso_chaos_columns(c, fields);
    iso_status status = iso_study_table(ctx, "chaos", scene, iso_chaos_fields, c, fields, table);
    if (status == ISO_OK && c->failure != ISO_OK) status = iso_record_set(ctx, *table, "failure", c->words);
    if (status == ISO_OK) status = iso_columns_append(ctx, fields, &c->own, *table);
    for (size_t i = 0; status == ISO_OK && i < c->starts; i++)
        if (iso_chaos_followed(&c->start[i])) status = iso_columns_append(ctx, fields, &c->start[i], *table);
    return status;
}

static iso_status run(iso_context *ctx, const iso_study_subject *subject, const void *options,
                      iso_study_result *result)
{
    iso_chaos_options how = ((const iso_chaos_request *)options)->how;
    iso_chaos *c = NULL;
    how.progress = result->sink.progress;
    how.data = result->sink.data;
    const iso_status status = iso_chaos_run(ctx, subject->scene, &how, &c);
    if (!iso_study_keep(result, c, iso_chaos_fields, free_chaos)) return status;
    result->failed = c->failure != ISO_OK;
    if (result->failed) iso_study_note(result, "an orbit was not followed to the end: %s", c->words);
    const iso_status made = put_orbits(ctx, subject->scene, c, &result->table[0]);
    for (int m = 0; m < 2; m++) result->table[1 + m] = c->trace[m];
    return status == ISO_OK ? made : status;
}

#define ROW(name, argument, expected, doc, set, member)                                                              \
    ISO_OPTION(name, argument, expected, doc, set, iso_chaos_request, member)

const iso_option iso_chaos_option[] = {
    ROW("turns", "N", "a whole number from 1 on",
        "follow each orbit for at most N turns (default 3000); it ends earlier once there is a verdict",
        iso_set_count_long, how.turns),
    ROW("exponent-turns", "N", "a whole number from 0 on",
        "go on with a chaotic orbit until it has N turns, for its exponent; default 0: it ends with the verdict",
        iso_set_whole_long, how.exponent_turns),
    ROW("starts", "M", "a whole number from 0 on",
        "M more orbits of the same energy, spread evenly over the section: tells which part of it is chaotic",
        iso_set_whole_size, how.starts),
    ISO_OPTION_SEED(ISO_SEED_SPREADS, iso_chaos_request, how.seed),
    ISO_OPTION_MODELS("model", "M",
                      ISO_MODELS_INTEGRATED ". Of the starts the ball follows every 16th, as a check; with both, all",
                      iso_chaos_request, how.models),
    ROW("axis", "A", "auto, 1, 2 or 3",
        "a turn is a return to n_A = 0, n_A increasing, which must be global; auto (default): one that is",
        iso_set_text, words.axis),
    ISO_OPTION_TOLERANCE(ISO_TOLERANCE_OF_STEPS, iso_chaos_request, how.tolerance),
    ISO_OPTION_THREADS(iso_chaos_request, how.threads),
    ROW("at", "L,X", ISO_AT_EXPECTED, "one more orbit, which starts at (l, x); it is not in the share", iso_set_at,
        words.at),
    ISO_OPTION_END,
};

const iso_study iso_chaos_study = {"chaos",
                                   "tell whether an orbit is chaotic, and which part of the section is chaotic",
                                   iso_chaos_option,
                                   sizeof(iso_chaos_request),
                                   begin,
                                   end,
                                   prepare,
                                   run,
                                   ISO_STUDY_OF_SCENE,
                                   iso_chaos_fields,
                                   .print = iso_chaos_print,
                                   .describe = iso_chaos_describe};

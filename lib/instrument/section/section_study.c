/* section_study.c - the section by its name: its options, as text first, and its tables (study/study.h). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/names_impl.h"
#include "base/rational_impl.h"
#include "instrument/section/section.h"
#include "instrument/section/section_impl.h"
#include "orbit/orbit_impl.h"
#include "study/fields_impl.h"
#include "study/options_impl.h"

/* --- what is typed ---------------------------------------------------------------------------------------------- */

/* COLUMN=VALUE */
static iso_status read_event(iso_context *ctx, const char *text, iso_section_options *how)
{
    char name[ISO_NAME_SIZE] = "", suggested[ISO_SUGGEST_SIZE];
    const size_t length = text ? strcspn(text, "=") : 0;
    if (!text) return ISO_OK;
    if (length < sizeof name) memcpy(name, text, length);
    if (text[length] != '=' || !iso_rational_read_double(text + length + 1, strlen(text + length + 1), &how->value))
        return ISO_FAIL_ARGUMENT(ctx, "", "--event '%s': expected COLUMN=VALUE, such as omega1=0.5", text);
    how->column = iso_column_find(name);
    if (how->column >= ISO_CLOCKS) return ISO_OK;
    if (how->column >= 0)
        return ISO_FAIL_ARGUMENT(ctx, "", "--event: the clock '%s' passes each value only once", name);
    return ISO_FAIL_ARGUMENT(ctx, "", "--event: there is no column '%s'; %s", name,
                             iso_suggest_word(suggested, name, iso_column_name));
}

static iso_status prepare(iso_context *ctx, void *options)
{
    iso_section_request *r = options;
    iso_status status = iso_section_words_read(ctx, &r->words, &r->how.axis, &r->how.at, &r->how.at_count);
    if (status == ISO_OK) status = read_event(ctx, r->event, &r->how);
    if (status == ISO_OK && r->words.axis && r->event)
        return ISO_FAIL_ARGUMENT(ctx, "", "section: --axis or --event, not both");
    if (status == ISO_OK && r->area && r->event)
        return ISO_FAIL_ARGUMENT(ctx, "", "section: --area or --event, not both: an event has no chart");
    if (status == ISO_OK && r->area && r->how.shown != ISO_SHOW_START)
        return ISO_FAIL_ARGUMENT(ctx, "", "section: --area or --as, not both: its rows have no states");
    return status;
}

ISO_STUDY_BEGIN(iso_section_request, (iso_section_request){.how = iso_section_defaults()})

static void end(void *options)
{
    free(((iso_section_request *)options)->words.points);
}

/* --- tables ----------------------------------------------------------------------------------------------------- */

#define FIELD(key, member, ...) ISO_MEMBER(iso_section_area, key, member, __VA_ARGS__)

const iso_field iso_section_area_fields[] = {
    FIELD("orbit", orbit, "", "number of the orbit; 0 is the scene's own"),
    FIELD("model", model, "", "that was integrated", .word = iso_model_kind_name),
    FIELD("turns", turns, "", "returns, or steps of about a turn, that could be told"),
    FIELD("worst", worst, "", "|det D - 1|, at the return where it is largest against its bound"),
    FIELD("bound", bound, "", "what errors of the integration explain there"),
    FIELD("area", kept, "", "kept, not kept or undecided"),
    FIELD("failure", why, "", "why it ended early", .how = ISO_QUOTED),
    ISO_FIELD_END,
};
#undef FIELD

static const iso_field areas_fields[] = {
    ISO_MEMBER(iso_section_areas, "returns", returns, "", "whether det D is told at returns"),
    ISO_LIST_AT(iso_section_areas, "areas", orbit, count, iso_section_area_fields, "of the orbits"), ISO_FIELD_END};

static void free_areas(void *found)
{
    iso_section_areas_free(found);
    free(found);
}

static iso_status find_areas(iso_context *ctx, const iso_scene *scene, const iso_section_request *r,
                             iso_study_result *result)
{
    iso_section_areas *found = iso_study_keep(result, calloc(1, sizeof *found), areas_fields, free_areas);
    if (!found) return iso_context_no_memory(ctx, "areas");
    const iso_status status = iso_section_areas_find(ctx, scene, &r->how, iso_study_progress, result, found);
    if (*found->words) iso_study_note(result, "%s", found->words);
    if (found->count == 0) return status;
    iso_status made =
        iso_study_table(ctx, "section area", scene, NULL, NULL, iso_section_area_fields, &result->table[0]);
    for (size_t i = 0; made == ISO_OK && i < found->count; i++) {
        made = iso_columns_append(ctx, iso_section_area_fields, &found->orbit[i], result->table[0]);
        result->failed = result->failed || strcmp(found->orbit[i].kept, "kept") != 0;
    }
    return status == ISO_OK ? made : status;
}

static iso_status run(iso_context *ctx, const iso_study_subject *subject, const void *options,
                      iso_study_result *result)
{
    const iso_section_request *request = options;
    if (request->area) return find_areas(ctx, subject->scene, request, result);
    iso_section_result *r = iso_study_keep(result, calloc(1, sizeof *r), NULL, free);
    if (!r) return iso_context_no_memory(ctx, "a section");
    const iso_status status = iso_section_run(ctx, subject->scene, &request->how, &result->sink,
                                              result->sink.row ? NULL : result->table, r);
    for (int i = 0; i < 2; i++)
        if (result->table[i]) iso_record_set_kind(result->table[i], "section");
    result->failed = r->failed > 0;
    if (r->failed > 0 && r->rows > 0)
        iso_study_note(result, "%zu of %zu orbits did not get to the end; %s", r->failed, r->orbits, r->words);
    return status;
}

#define ROW(name, argument, expected, doc, set, member)                                                              \
    ISO_OPTION(name, argument, expected, doc, set, iso_section_request, member)

const iso_option iso_section_option[] = {
    ROW("crossings", "N", "a whole number from 1 on", "crossings of each orbit (default 500)", iso_set_count_size,
        how.crossings),
    ROW("axis", "A", "auto, 1, 2 or 3", "which section n_A = 0, n_A increasing; auto (default): a global one",
        iso_set_text, words.axis),
    ROW("event", "COLUMN=VALUE", "COLUMN=VALUE",
        "in place of --axis: crossings where this column passes this value upwards", iso_set_text, event),
    ROW("starts", "M", "a whole number from 0 on", "M more orbits of the same energy, spread evenly over the section",
        iso_set_whole_size, how.starts),
    ISO_OPTION_SEED(ISO_SEED_SPREADS, iso_section_request, how.seed),
    ROW("at", "L,X", ISO_AT_EXPECTED, "one more orbit, which starts at (l, x); for several: L,X;L,X or --at again",
        iso_set_at, words.at),
    ROW("area", NULL, NULL, "write no crossings: for each orbit, whether the return map keeps the area dL dl",
        iso_set_flag, area),
    ISO_OPTION_MODELS("model", "M", ISO_MODELS_INTEGRATED, iso_section_request, how.models),
    ISO_OPTION_MODELS("as", "WHAT", "add the states of a model to each row: ball, point, both", iso_section_request,
                      how.shown),
    ISO_OPTION_TOLERANCE(ISO_TOLERANCE_OF_STEPS, iso_section_request, how.tolerance),
    ISO_OPTION_THREADS(iso_section_request, how.threads),
    ISO_OPTION_END,
};

const iso_study iso_section_study = {"section",
                                     "compute the Poincare section of both models",
                                     iso_section_option,
                                     sizeof(iso_section_request),
                                     begin,
                                     end,
                                     prepare,
                                     run,
                                     ISO_STUDY_OF_SCENE | ISO_STUDY_STREAMS,
                                     iso_section_fields,
                                     .print = iso_section_print};

/* chaos_study.c - chaos by its name: the numbers of its result with their meaning, its options and its tables
 * (study/study.h). */
#include <stdlib.h>

#include "instrument/chaos/chaos_impl.h"
#include "study/fields_impl.h"
#include "study/options_impl.h"
#include "study/study_impl.h"

/* --- what one model has found ----------------------------------------------------------------------------------- */

#define FIELD(key, member, ...) ISO_MEMBER(iso_indication, key, member, __VA_ARGS__)

const iso_field iso_indication_fields[] = {
    FIELD("verdict", verdict, "", "regular, chaotic or undecided, by this model", .word = iso_verdict_word),
    FIELD("turns", turns, "", "turns until the verdict; undecided: all; 0: this model did not follow it"),
    FIELD("exponent_turns", exponent_turns, "", "turns that the exponent is from"),
    FIELD("megno", megno, "", "MEGNO: its limit if regular and known, else its mean"),
    FIELD("megno_now", megno_now, "", "MEGNO after the last turn", .how = ISO_IN_TREE),
    FIELD("megno_mean", megno_mean, "", "the mean of MEGNO", .how = ISO_IN_TREE),
    FIELD("gali2", gali2, "", "GALI_2: sine of the angle between the deviations"),
    FIELD("exponent_per_turn", per_turn, "1/turn", "the largest exponent", .column = "per_turn"),
    FIELD("error_per_turn", per_turn_error, "1/turn", "its error", .column = "per_turn_error"),
    FIELD("exponent", exponent, "1/time", "the largest exponent, in this clock", .word = iso_clock_word),
    FIELD("error", error, "1/time", "its error; NaN: the orbit is too short to know it", .word = iso_clock_word),
    FIELD("digits", digits, "", "digits to which the means over the two halves agree"),
    ISO_FIELD_END,
};
#undef FIELD

/* --- indicators by turns ---------------------------------------------------------------------------------------- */

const iso_field iso_indicator_fields[] = {
    {.name = "turn", .unit = "", .doc = "number of the turn"},
    {.name = "t", .unit = "time", .doc = "the ball's time then; of a point without a ball its time s"},
    {.name = "growth", .unit = "", .doc = "ln of how many times longer the deviation is than at the start"},
    {.name = "megno", .unit = "", .doc = "MEGNO"},
    {.name = "mean", .unit = "", .doc = "the mean of MEGNO"},
    {.name = "gali2", .unit = "", .doc = "GALI_2: sine of the angle between the deviations"},
    ISO_FIELD_END,
};

/* --- one orbit -------------------------------------------------------------------------------------------------- */

#define FIELD(key, member, ...) ISO_MEMBER(iso_chaos_orbit, key, member, __VA_ARGS__)

const iso_field iso_chaos_orbit_fields[] = {
    FIELD("orbit", number, "", "0: the scene's own; others that were not followed have no row"),
    FIELD("l", l, "rad", "where it begins on the section (l, x); NaN: the scene's own"),
    FIELD("x", x, "", "the other coordinate"),
    FIELD("verdict", verdict, "", "regular, chaotic or undecided, by all models", .word = iso_verdict_word),
    FIELD("disagree", disagree, "", "1: one model says regular, the other one chaotic"),
    FIELD("ball.status", status[ISO_BALL], "", "0, or why the ball was not followed: a number of iso_status"),
    ISO_STRUCT(iso_chaos_orbit, "ball", result[ISO_BALL], iso_indication_fields, "what the ball tells"),
    FIELD("point.status", status[ISO_POINT], "", "the same of the point"),
    ISO_STRUCT(iso_chaos_orbit, "point", result[ISO_POINT], iso_indication_fields, "what the point tells"),
    ISO_FIELD_END,
};
#undef FIELD

/* --- the shares ------------------------------------------------------------------------------------------------- */

#define FIELD(key, member, ...) ISO_MEMBER(iso_chaos_fraction, key, member, __VA_ARGS__)

const iso_field iso_chaos_fraction_fields[] = {
    FIELD("chaotic", share, "",
          "the chaotic share of the section, by its area; undecided orbits count as not chaotic", .column = "share"),
    FIELD("error", half_interval, "", "half the interval of 95 %, in which undecided orbits count both ways",
          .how = ISO_IN_TREE),
    FIELD("low", low, "", "the low end of the interval: undecided orbits are not chaotic", .column = "share_low"),
    FIELD("high", high, "", "the high end: undecided orbits are chaotic", .column = "share_high"),
    FIELD("regular", regular_share, "", "the regular share"),
    FIELD("undecided", undecided_share, "", "the share that is undecided"),
    FIELD("starts", asked, "", "orbits that were asked for", .how = ISO_IN_TREE),
    FIELD("followed", count, "", "orbits that were followed", .how = ISO_IN_TREE),
    FIELD("chaotic_starts", chaotic, "", "how many of them are chaotic", .how = ISO_IN_TREE),
    FIELD("regular_starts", regular, "", "regular", .how = ISO_IN_TREE),
    FIELD("undecided_starts", undecided, "", "undecided", .how = ISO_IN_TREE),
    FIELD("disagree", disagree, "", "undecided because the models disagree", .how = ISO_IN_TREE),
    FIELD("checked", checked, "", "orbits that both models decided", .how = ISO_IN_TREE),
    FIELD("failed", failed, "", "orbits that failed"),
    FIELD("tolerance", tolerance, "", "largest relative error of one step of these starts", .how = ISO_IN_TREE),
    ISO_FIELD_END,
};
#undef FIELD

/* --- the whole -------------------------------------------------------------------------------------------------- */

static bool has_section(const void *row)
{
    return ((const iso_chaos *)row)->axis >= 0;
}

static bool has_share(const void *row)
{
    return ((const iso_chaos *)row)->share.asked > 0;
}

/* The larger of both models' numbers of turns. */
static double turns_of(const void *row)
{
    const iso_chaos *c = row;
    double turns = 0;
    for (int m = 0; m < 2; m++)
        if (c->with[m]) turns = fmax(turns, (double)c->own.result[m].turns);
    return turns;
}

#define FIELD(key, member, ...) ISO_MEMBER(iso_chaos, key, member, __VA_ARGS__)
#define STRUCT(key, member, fields, ...) ISO_STRUCT(iso_chaos, key, member, fields, __VA_ARGS__)

static const iso_field integral_fields[] = {
    ISO_MEMBER(iso_integral, "integral", name, "", "an additional integral, which excludes chaos"), ISO_FIELD_END};
static const iso_field section_fields[] = {FIELD("axis", axis, "", "a of n_a = 0", .how = ISO_FROM_ONE),
                                           ISO_FIELD_END};

const iso_field iso_chaos_fields[] = {
    ISO_GROUP("section", section_fields, "to which a turn returns", .there = has_section),
    FIELD("turn", turn, "time", "length of a turn, if there is no section"),
    STRUCT("", integral, integral_fields, "what excludes chaos", .pointer = true),
    FIELD("verdict", own.verdict, "", "on the scene's orbit; in sweeps 0 regular, 1 chaotic, 2 undecided",
          .word = iso_verdict_word),
    FIELD("disagree", own.disagree, "", "whether the models contradict each other"),
    ISO_COUNT("turns", turns_of, "", "turns until the verdict"),
    STRUCT("ball", own.result[ISO_BALL], iso_indication_fields, "what the ball tells",
           ISO_WHEN(iso_chaos, with[ISO_BALL])),
    STRUCT("point", own.result[ISO_POINT], iso_indication_fields, "what the point tells",
           ISO_WHEN(iso_chaos, with[ISO_POINT])),
    STRUCT("share", share, iso_chaos_fraction_fields, "of orbits spread over the section", .there = has_share,
           .how = ISO_OPTIONAL),
    ISO_FIELD_END,
};

/* --- the study -------------------------------------------------------------------------------------------------- */

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

/* The first table has a row for each orbit that was followed, that of the scene first. */
static iso_status run(iso_context *ctx, const iso_study_subject *subject, const void *options,
                      iso_study_result *result)
{
    iso_chaos_options how = ((const iso_chaos_request *)options)->how;
    iso_field fields[ISO_MOST_FIELDS];
    iso_chaos *c = NULL;
    iso_record **table = &result->table[0];
    how.progress = result->sink.progress;
    how.data = result->sink.data;
    const iso_status status = iso_chaos_run(ctx, subject->scene, &how, &c);
    if (!iso_study_keep(result, c, iso_chaos_fields, free_chaos)) return status;
    result->failed = c->failure != ISO_OK;
    if (result->failed) iso_study_note(result, "an orbit was not followed to the end: %s", c->words);
    for (int m = 0; m < 2; m++) result->table[1 + m] = c->trace[m];
    iso_fields_copy(iso_chaos_orbit_fields, c->with[ISO_BALL] ? c->with[ISO_POINT] ? NULL : "point" : "ball", fields);
    iso_status made = iso_study_table(ctx, "chaos", subject->scene, iso_chaos_fields, c, fields, table);
    if (made == ISO_OK && result->failed) made = iso_record_set(ctx, *table, "failure", c->words);
    if (made == ISO_OK) made = iso_columns_append(ctx, fields, &c->own, *table);
    for (size_t i = 0; made == ISO_OK && i < c->starts; i++)
        if (iso_chaos_followed(&c->start[i])) made = iso_columns_append(ctx, fields, &c->start[i], *table);
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

/* chaos_fields.c - what the result of chaos holds: its numbers with their meaning (chaos.h, indicators.h). */
#include "instrument/chaos/chaos_impl.h"
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

void iso_chaos_columns(const iso_chaos *c, iso_field fields[ISO_MOST_FIELDS])
{
    iso_fields_copy(iso_chaos_orbit_fields, c->with[ISO_BALL] ? c->with[ISO_POINT] ? NULL : "point" : "ball", fields);
}

/* --- the shares ------------------------------------------------------------------------------------------------- */

static double half_interval(const void *row)
{
    const iso_chaos_fraction *s = row;
    return (s->high - s->low) / 2;
}

/* If none was followed, every part of it is NaN. */
static double regular_share(const void *row)
{
    const iso_chaos_fraction *s = row;
    return (double)s->regular / (double)s->count;
}

static double undecided_share(const void *row)
{
    const iso_chaos_fraction *s = row;
    return (double)s->undecided / (double)s->count;
}

#define FIELD(key, member, ...) ISO_MEMBER(iso_chaos_fraction, key, member, __VA_ARGS__)

const iso_field iso_chaos_fraction_fields[] = {
    FIELD("chaotic", share, "",
          "the chaotic share of the section, by its area; undecided orbits count as not chaotic", .column = "share"),
    ISO_NUMBER("error", half_interval, "", "half the interval of 95 %, in which undecided orbits count both ways",
               .how = ISO_IN_TREE),
    FIELD("low", low, "", "the low end of the interval: undecided orbits are not chaotic", .column = "share_low"),
    FIELD("high", high, "", "the high end: undecided orbits are chaotic", .column = "share_high"),
    ISO_NUMBER("regular", regular_share, "", "the regular share"),
    ISO_NUMBER("undecided", undecided_share, "", "the share that is undecided"),
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

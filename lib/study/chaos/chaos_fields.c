/* chaos_fields.c - what the result of chaos holds: its numbers with their meaning (chaos.h, indicators.h). */
#include "study/chaos/chaos.h"

static const char *verdict_word(int verdict)
{
    return iso_verdict_name((iso_verdict)verdict);
}

static const char *clock_word(int clock)
{
    return iso_clock_name((iso_clock)clock);
}

/* --- what one model has found ------------------------------------------------------------------------------------ */

#define FIELD(key, member, ...) ISO_FIELD(iso_indication, key, member, __VA_ARGS__)

const iso_field iso_indication_fields[] = {
    FIELD("verdict", verdict, "", "regular, chaotic or undecided, by this model", .word = verdict_word),
    FIELD("turns", turns, "", "turns until the verdict; undecided: all"),
    FIELD("exponent_turns", exponent_turns, "", "turns that the exponent is from", .how = ISO_IN_TREE),
    FIELD("megno", megno, "", "MEGNO: its limit if regular, else its mean"),
    FIELD("megno_now", megno_now, "", "MEGNO after the last turn", .how = ISO_IN_TREE),
    FIELD("megno_mean", megno_mean, "", "the mean of MEGNO", .how = ISO_IN_TREE),
    FIELD("gali2", gali2, "", "GALI_2: sine of the angle between the deviations"),
    FIELD("exponent_per_turn", per_turn, "1/turn", "the largest exponent", .column = "per_turn"),
    FIELD("error_per_turn", per_turn_error, "1/turn", "its error", .how = ISO_IN_TREE),
    FIELD("exponent", exponent, "1/time", "the largest exponent, in this clock", .word = clock_word),
    FIELD("error", error, "1/time", "its error; nan: the orbit is too short to know it", .word = clock_word),
    FIELD("digits", digits, "", "digits to which the means over the two halves agree", .how = ISO_IN_TREE),
    ISO_FIELD_END,
};
#undef FIELD

/* --- one orbit --------------------------------------------------------------------------------------------------- */

#define FIELD(key, member, ...) ISO_FIELD(iso_chaos_orbit, key, member, __VA_ARGS__)

const iso_field iso_chaos_orbit_fields[] = {
    FIELD("orbit", number, "", "0: the scene's own; others that were not followed have no row"),
    FIELD("l", l, "rad", "where it begins on the section (l, x); nan: the scene's own"),
    FIELD("x", x, "", "the other coordinate"),
    FIELD("verdict", verdict, "", "regular, chaotic or undecided, by all models", .word = verdict_word),
    ISO_STRUCT(iso_chaos_orbit, "ball", told[ISO_BALL], iso_indication_fields, "what the ball tells"),
    ISO_STRUCT(iso_chaos_orbit, "point", told[ISO_POINT], iso_indication_fields, "what the point tells"),
    ISO_FIELD_END,
};
#undef FIELD

/* --- the shares -------------------------------------------------------------------------------------------------- */

static void find_error(const void *row, int i, iso_value *v)
{
    const iso_chaos_fraction *s = row;
    (void)i;
    v->number = (s->high - s->low) / 2;
}

/* If none was followed, every part of it is NaN. */
static void find_regular(const void *row, int i, iso_value *v)
{
    const iso_chaos_fraction *s = row;
    (void)i;
    v->number = (double)s->regular / (double)s->count;
}

static void find_undecided(const void *row, int i, iso_value *v)
{
    const iso_chaos_fraction *s = row;
    (void)i;
    v->number = (double)s->undecided / (double)s->count;
}

#define FIELD(key, member, ...) ISO_FIELD(iso_chaos_fraction, key, member, __VA_ARGS__)
#define FOUND(key, find, ...) ISO_FOUND(key, ISO_FIELD_REAL, find, __VA_ARGS__)

const iso_field iso_chaos_fraction_fields[] = {
    FIELD("chaotic", share, "", "the chaotic share of the section, by its area", .column = "share"),
    FOUND("error", find_error, "", "half the interval of 95 %", .how = ISO_IN_TREE),
    FIELD("low", low, "", "the low end of the interval", .column = "share_low"),
    FIELD("high", high, "", "the high end", .column = "share_high"),
    FOUND("regular", find_regular, "", "the regular share"),
    FOUND("undecided", find_undecided, "", "the share that is not decided"),
    FIELD("starts", asked, "", "orbits that were asked for", .how = ISO_IN_TREE),
    FIELD("followed", count, "", "orbits that were followed", .how = ISO_IN_TREE),
    FIELD("chaotic_starts", chaotic, "", "how many of them are chaotic", .how = ISO_IN_TREE),
    FIELD("regular_starts", regular, "", "regular", .how = ISO_IN_TREE),
    FIELD("undecided_starts", undecided, "", "undecided", .how = ISO_IN_TREE),
    FIELD("disagree", disagree, "", "undecided because the models disagree", .how = ISO_IN_TREE),
    FIELD("failed", failed, "", "orbits that failed"),
    ISO_FIELD_END,
};
#undef FIELD

/* --- the whole --------------------------------------------------------------------------------------------------- */

static bool has_section(const void *row)
{
    return ((const iso_chaos *)row)->axis >= 0;
}

static bool has_ball(const void *row)
{
    return ((const iso_chaos *)row)->with[ISO_BALL];
}

static bool has_point(const void *row)
{
    return ((const iso_chaos *)row)->with[ISO_POINT];
}

static bool has_share(const void *row)
{
    return ((const iso_chaos *)row)->share.asked > 0;
}

static void find_integral(const void *row, int i, iso_value *v)
{
    const iso_chaos *c = row;
    (void)i;
    v->text = c->integral ? c->integral->name : NULL;
}

/* Those of the model with more of them. */
static void find_turns(const void *row, int i, iso_value *v)
{
    const iso_chaos *c = row;
    (void)i;
    v->number = 0;
    for (int m = 0; m < 2; m++)
        if (c->with[m]) v->number = fmax(v->number, (double)c->own.told[m].turns);
}

#define FIELD(key, member, ...) ISO_FIELD(iso_chaos, key, member, __VA_ARGS__)
#define STRUCT(key, member, fields, ...) ISO_STRUCT(iso_chaos, key, member, fields, __VA_ARGS__)

static const iso_field section_fields[] = {FIELD("axis", axis, "", "a of n_a = 0", .how = ISO_FROM_ONE),
                                           ISO_FIELD_END};

const iso_field iso_chaos_fields[] = {
    ISO_GROUP("section", section_fields, "to which a turn returns", .there = has_section),
    FIELD("turn", turn, "time", "length of a turn, if there is no section"),
    ISO_FOUND("integral", ISO_FIELD_NAME, find_integral, "", "a further integral, which excludes chaos"),
    FIELD("verdict", own.verdict, "", "on the scene's orbit", .word = verdict_word),
    FIELD("disagree", own.disagree, "", "whether the models contradict each other"),
    ISO_FOUND("turns", ISO_FIELD_LONG, find_turns, "", "turns until the verdict"),
    STRUCT("ball", own.told[ISO_BALL], iso_indication_fields, "what the ball tells", .there = has_ball),
    STRUCT("point", own.told[ISO_POINT], iso_indication_fields, "what the point tells", .there = has_point),
    STRUCT("share", share, iso_chaos_fraction_fields, "of orbits spread over the section", .there = has_share,
           .how = ISO_OPTIONAL),
    ISO_FIELD_END,
};

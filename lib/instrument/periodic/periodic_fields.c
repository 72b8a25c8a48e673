/* periodic_fields.c - what the results of periodic orbits hold: their numbers with their meaning (periodic.h,
 * continuation.h, stability_chart.h). */
#include "instrument/periodic/periodic_study_impl.h"
#include "study/study_impl.h"

static const iso_field pair[] = {
    {.name = "", .type = ISO_FIELD_REAL, .count = 2, .unit = "", .doc = "l and x, or real and imaginary part"},
    ISO_FIELD_END,
};

/* --- multipliers ------------------------------------------------------------------------------------------------ */

static bool is_stable(const void *row)
{
    return ((const iso_multipliers *)row)->stability == ISO_STABLE;
}

static bool has_krein(const void *row)
{
    return ((const iso_multipliers *)row)->krein != 0;
}

#define FIELD(key, member, ...) ISO_MEMBER(iso_multipliers, key, member, __VA_ARGS__)

static const iso_field multipliers[] = {
    ISO_IS("stable", is_stable, "whether it is stable", .how = ISO_IN_TREE),
    FIELD("stability", stability, "", "stable, unstable (trace > 2), inverse (< -2), degenerate (2 or -2), undecided",
          .word = iso_stability_name),
    ISO_ARRAY(iso_multipliers, "multipliers", value, pair, "real and imaginary part of both"),
    FIELD("krein", krein, "", "Krein's sign of the first multiplier", .how = ISO_IN_TREE, .there = has_krein),
    ISO_FIELD_END,
};
#undef FIELD

/* --- rotations -------------------------------------------------------------------------------------------------- */

static bool rotates(const void *row)
{
    return !((const iso_rotation *)row)->oscillates;
}

static bool is_inside(const void *row)
{
    return ((const iso_rotation *)row)->x < 1;
}

static void find_rotation_digits(const void *row, int i, iso_value *v)
{
    const iso_rotation *r = row;
    (void)i;
    iso_periodic_digits(r->half_turn_trace, r->tail, v->room);
    v->text = v->room;
}

#define FIELD(key, member, ...) ISO_MEMBER(iso_rotation, key, member, __VA_ARGS__)

static const iso_field rotation_fields[] = {
    FIELD("axis", axis, "", "about which it turns", .how = ISO_FROM_ONE),
    FIELD("half_turn_trace", half_turn_trace, "", "trace of Hill's equation over half a turn"),
    FIELD("error", error, "", "its error"),
    FIELD("by_section", by_section, "", "the same trace by the return map"),
    FIELD("turn_trace", turn_trace, "", "of a whole turn"),
    FIELD("l", l, "rad", "its point (l, x) of the section", .there = is_inside),
    FIELD("x", x, "", "1: on the boundary"),
    FIELD("oscillates", oscillates, "", "there is no rotation, but an oscillation between two places of rest"),
    ISO_STRUCT(iso_rotation, "", half, multipliers, "of half a turn", .there = rotates, .how = ISO_OPTIONAL),
    FIELD("", clock, "time", "a whole turn in this clock", .word = iso_clock_word, .there = rotates,
          .how = ISO_OPTIONAL),
    ISO_FOUND("half_turn_trace_digits", ISO_FIELD_TEXT, find_rotation_digits, "", "all digits",
              ISO_WHEN(iso_rotation, polished), .how = ISO_OPTIONAL),
    ISO_FIELD_END,
};
#undef FIELD

/* --- orbits ----------------------------------------------------------------------------------------------------- */

static void find_symmetry(const void *row, int i, iso_value *v)
{
    (void)i;
    iso_symmetry_text(((const iso_periodic_orbit *)row)->symmetry, v->room);
    v->text = v->room;
}

static double determinant_of(const void *row)
{
    return 1 + ((const iso_periodic_orbit *)row)->determinant;
}

/* From the point (l, x) on, return by return. */
static const void *point_of(const void *row, size_t i)
{
    const iso_periodic_orbit *o = row;
    if (i >= (size_t)o->period) return NULL;
    return o->half[i == 0 ? 2 * o->period - 1 : 2 * (int)i - 1];
}

static const char *digits_word(int i)
{
    static const char *const words[] = {"l_digits", "x_digits", "trace_digits"};
    return words[i];
}

static void find_digits(const void *row, int i, iso_value *v)
{
    const iso_periodic_orbit *o = row;
    const double head[] = {o->l, o->x, o->trace}, tail[] = {o->l_tail, o->x_tail, o->trace_tail};
    iso_periodic_digits(head[i], tail[i], v->room);
    v->text = v->room;
}

#define FIELD(key, member, ...) ISO_MEMBER(iso_periodic_orbit, key, member, __VA_ARGS__)
#define VECTOR(key, member, ...) ISO_NUMBERS(iso_periodic_orbit, key, member, 3, __VA_ARGS__)

const iso_field iso_periodic_orbit_fields[] = {
    FIELD("orbit", number, "", "its number in the list", .how = ISO_IN_TABLE),
    FIELD("period", period, "", "returns to the section"),
    FIELD("l", l, "rad", "a point (l, x) of it on the section"),
    FIELD("x", x, "", "the other coordinate"),
    FIELD("trace", trace, "", "trace of the derivative of the return map over the period"),
    FIELD("error", error, "", "error of the trace", .digits = 3),
    ISO_STRUCT(iso_periodic_orbit, "", multipliers, multipliers, "over the period"),
    ISO_FOUND("symmetry", ISO_FIELD_TEXT, find_symmetry, "", "reversors that map it to itself"),
    FIELD("copies", copies, "", "orbits that R, S1 S2 and T make of it, itself among them", .how = ISO_IN_TABLE),
    ISO_LIST(iso_periodic_orbit, "copies", copy, copies, pair, "a point (l, x) of each copy"),
    FIELD("", clock, "time", "its period in this clock", .word = iso_clock_word),
    FIELD("closure", closure, "", "distance in (l, x) after a period, by the derivative's size if above 1",
          .digits = 3),
    ISO_NUMBER("determinant", determinant_of, "", "of the same derivative", .how = ISO_IN_TREE),
    FIELD("torus", torus, "", "k = 1 or -1: on a torus full of such orbits", .how = ISO_IN_TREE),
    FIELD("line", line, "", "the reversor whose line it passes", .word = iso_symmetry_line_name, .how = ISO_IN_TREE),
    VECTOR("omega", ball[0], "1/time", "its start: angular velocity of the ball"),
    VECTOR("n", ball[3], "", "its start: normal at the contact"),
    VECTOR("M", point[0], "1/time", "its start: momentum of the point"),
    VECTOR("gamma", point[3], "", "its start: place of the point"),
    ISO_ITEMS("points", point_of, pair, "its points (l, x), return by return"),
    ISO_FOUND("", ISO_FIELD_TEXT, find_digits, "", "all digits", .count = 3, .word = digits_word,
              ISO_WHEN(iso_periodic_orbit, polished), .how = ISO_OPTIONAL | ISO_IN_TREE),
    ISO_FIELD_END,
};
#undef FIELD

#define FIELD(key, member, ...) ISO_MEMBER(iso_periodic, key, member, __VA_ARGS__)

const iso_field iso_periodic_fields[] = {
    FIELD("level", level, "", "(H/eps) J2^(1/k), J2 the middle moment"),
    FIELD("section.axis", axis, "", "a of the section n_a = 0", .how = ISO_FROM_ONE),
    FIELD("longest_period", longest, "", "the longest period that was sought"),
    ISO_ARRAY(iso_periodic, "rotations", rotation, rotation_fields, "about the principal axes"),
    ISO_LIST_AT(iso_periodic, "orbits", orbit, count, iso_periodic_orbit_fields, "by period, then by trace"),
    FIELD("unresolved", unresolved, "", "intervals of the lines where the samples are too far apart"),
    FIELD("lost", lost, "", "sign changes that did not end in an orbit"),
    ISO_FIELD_END,
};
#undef FIELD

/* --- branches --------------------------------------------------------------------------------------------------- */

static bool is_point(const void *row)
{
    return ((const iso_branch_row *)row)->event != NULL;
}

static void find_event(const void *row, int i, iso_value *v)
{
    (void)i;
    v->text = iso_branch_kind_name((int)((const iso_branch_row *)row)->event->kind);
}

#define FIELD(key, member, ...) ISO_MEMBER(iso_branch_point, key, member, __VA_ARGS__)

static const iso_field point_fields[] = {
    FIELD("value", value, "", "what varies: k, J1, J2, J3, ratio or level"),
    FIELD("l", l, "rad", "a point (l, x) of the orbit on the section"),
    FIELD("x", x, "", "the other coordinate"),
    FIELD("trace", trace, "", "trace of the derivative of the return map over the period"),
    ISO_FIELD_END,
};
#undef FIELD

#define FIELD(key, member, ...) ISO_MEMBER(iso_branch_event, key, member, __VA_ARGS__)

static const iso_field event_fields[] = {
    ISO_STRUCT(iso_branch_event, "", at, point_fields, "where"),
    FIELD("kind", kind, "", "what happens", .word = iso_branch_kind_name),
    FIELD("joins", joins, "", "this branch is the one that branches off"),
    FIELD("words", text, "", "more about it"),
    FIELD("axis", axis, "", "of a collision: the rotation's", .how = ISO_FROM_ONE | ISO_OPTIONAL),
    ISO_FIELD_END,
};
#undef FIELD

#define FIELD(key, member, ...) ISO_MEMBER(iso_branch, key, member, __VA_ARGS__)

static const iso_field branch_fields[] = {
    FIELD("period", period, "", "returns to the section"),
    FIELD("line", line, "", "the reversor whose line is followed", .word = iso_symmetry_line_name),
    FIELD("parent", parent, "", "the branch that it comes from", .how = ISO_FROM_ONE),
    ISO_LIST_AT(iso_branch, "points", point, points, point_fields, "along the branch"),
    ISO_LIST_AT(iso_branch, "events", event, events, event_fields, "what happens along it"),
    ISO_FIELD_END,
};
#undef FIELD

const iso_field iso_continuation_fields[] = {
    ISO_MEMBER(iso_continuations, "parameter", vary, "", "what varies", .word = iso_vary_name),
    ISO_LIST_AT(iso_continuations, "branches", branch, count, branch_fields, "of orbits"),
    ISO_FIELD_END,
};

#define FIELD(key, member, ...) ISO_MEMBER(iso_branch_row, key, member, __VA_ARGS__)

const iso_field iso_branch_row_fields[] = {
    FIELD("branch", number, "", "its number, from 1"),
    FIELD("line", line, "", "the reversor whose line is followed", .word = iso_symmetry_line_name),
    FIELD("period", period, "", "returns to the section"),
    FIELD("k", at.value, "", "what varies: k, J1, J2, J3, ratio or level, by its name"),
    FIELD("l", at.l, "rad", "a point (l, x) of the orbit on the section"),
    FIELD("x", at.x, "", "the other coordinate"),
    FIELD("trace", at.trace, "", "trace of the derivative of the return map over the period"),
    ISO_FOUND("event", ISO_FIELD_NAME, find_event, "", "what happens there; empty: nothing", .there = is_point),
    FIELD("u", at.u, "rad", "its place on the line of the reversor", .how = ISO_IN_TABLE),
    ISO_FIELD_END,
};
#undef FIELD

/* --- the chart -------------------------------------------------------------------------------------------------- */

#define FIELD(key, member, ...) ISO_MEMBER(iso_chart_row, key, member, __VA_ARGS__)

const iso_field iso_chart_row_fields[] = {
    FIELD("kind", kind, "", "grid: traces at a point of the grid; border: where one of them is 2 or -2"),
    FIELD("k", k, "", "geometry number"),
    FIELD("J2", value, "", "the moment that varies, or the level, by its name"),
    FIELD("least", least, "", "half-turn trace of the rotation about the axis of the least moment"),
    FIELD("greatest", greatest, "", "the same about the axis of the greatest moment"),
    ISO_FIELD_END,
};
#undef FIELD

#define FIELD(key, member, ...) ISO_MEMBER(iso_chart_found, key, member, __VA_ARGS__)

const iso_field iso_chart_fields[] = {
    FIELD("moment", how.moment, "", "what varies", .word = iso_chart_name),
    FIELD("level", level, "", "on which it is drawn"),
    FIELD("grid", grid, "", "traces at its points"),
    FIELD("borders", borders, "", "where a trace is 2 or -2"),
    ISO_FIELD_END,
};

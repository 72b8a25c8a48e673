/* compare_fields.c - what a comparison holds: its numbers with their meaning (compare.h). */
#include "study/compare.h"
#include "study/study_impl.h"

/* --- one backend ------------------------------------------------------------------------------------------------ */

static const iso_field system_fields[] = {ISO_MEMBER(iso_system, "system", name, "", "ball or point"), ISO_FIELD_END};
static const iso_field method_fields[] = {ISO_MEMBER(iso_method, "method", name, "", "of integration"),
                                          ISO_FIELD_END};
static const iso_field integral_fields[] = {
    ISO_MEMBER(iso_integral, "name", name, "", "of the integral"),
    ISO_MEMBER(iso_integral, "doc", doc, "", "what it is"),
    ISO_FIELD_END,
};

static const iso_field drift_fields[] = {
    ISO_STRUCT(iso_drift, "", system, system_fields, "of which model", .pointer = true),
    ISO_STRUCT(iso_drift, "", integral, integral_fields, "which integral", .pointer = true),
    ISO_MEMBER(iso_drift, "start", start, "", "its value at the start"),
    ISO_MEMBER(iso_drift, "drift", worst, "", "its largest relative drift"),
    ISO_FIELD_END,
};

#define FIELD(key, member, ...) ISO_MEMBER(iso_backend_run, key, member, __VA_ARGS__)

static const iso_field run_fields[] = {
    ISO_STRUCT(iso_backend_run, "", method, method_fields, "by which", .pointer = true),
    FIELD("steps", statistics.steps, "", "steps"),
    FIELD("rejected", statistics.rejected, "", "steps that were rejected"),
    FIELD("right_hand_sides", statistics.rhs, "", "evaluations of the equations"),
    FIELD("states", statistics.states, "", "states that were found without steps"),
    FIELD("correction", statistics.correction, "", "largest relative correction by projection"),
    FIELD("seconds", seconds, "s", "processor time"),
    ISO_LIST(iso_backend_run, "integrals", drift, drifts, drift_fields, "that hold"),
    FIELD("trajectory", trajectory, "", "its columns"),
    ISO_FIELD_END,
};
#undef FIELD

/* --- all -------------------------------------------------------------------------------------------------------- */

static bool has_exact(const void *row)
{
    return ((const iso_comparison *)row)->runs == ISO_BACKENDS;
}

static bool has_no_exact(const void *row)
{
    return !has_exact(row);
}

#define FIELD(key, member, ...) ISO_MEMBER(iso_comparison, key, member, __VA_ARGS__)
#define EXACT .there = has_exact, .how = ISO_OPTIONAL

const iso_field iso_comparison_fields[] = {
    FIELD("h", h, "energy", "of the ball"),
    FIELD("eps", eps, "", "coupling of the point"),
    FIELD("clock", clock, "", "in which the scene counts its times", .word = iso_clock_word),
    FIELD("difference", difference, "", "of ball and point, row by row"),
    ISO_STRUCT(iso_comparison, "backends.ball", run[ISO_BALL], run_fields, "the ball"),
    ISO_STRUCT(iso_comparison, "backends.point", run[ISO_POINT], run_fields, "the point"),
    ISO_STRUCT(iso_comparison, "backends.exact", run[ISO_BY_EXACT], run_fields, "the closed solution", EXACT),
    FIELD("no_exact", no_exact, "", "why there is no closed solution", .there = has_no_exact, .how = ISO_OPTIONAL),
    FIELD("from_exact.ball.difference", from_exact[ISO_BALL], "", "of ball and closed solution", EXACT),
    FIELD("from_exact.point.difference", from_exact[ISO_POINT], "", "of point and closed solution", EXACT),
    ISO_FIELD_END,
};

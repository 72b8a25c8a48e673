/* cost_fields.c - what the measurements of cost hold: their numbers with their meaning (cost.h). */
#include "task/cost/cost_impl.h"

static const iso_field method_fields[] = {
    ISO_MEMBER(iso_method, "method", name, "", "of integration; none: the closed solution"), ISO_FIELD_END};

#define FIELD(key, member, ...) ISO_MEMBER(iso_cost_cell, key, member, __VA_ARGS__)
#define MEASURED(key, member, ...)                                                                                   \
    FIELD(key, member, __VA_ARGS__, .there = iso_cost_is_measured, .how = ISO_EMPTY | ISO_OPTIONAL)

const iso_field iso_cost_cell_fields[] = {
    FIELD("backend", backend, "", "ball, point or exact", .word = iso_backend_name),
    ISO_STRUCT(iso_cost_cell, "", method, method_fields, "of integration", .pointer = true),
    FIELD("tolerance", tolerance, "", "relative error of a step", .how = ISO_EMPTY),
    ISO_IS("measured", iso_cost_is_measured, "whether there is a result", .how = ISO_IN_TREE),
    MEASURED("error", error, "", "the largest relative error of (omega, n)"),
    MEASURED("clock_error", clock_error, "", "the same of the other model's clock"),
    MEASURED("energy_drift", energy_drift, "", "relative drift of the energy"),
    MEASURED("constraint_drift", constraint_drift, "", "drift of the constraints"),
    MEASURED("setup", setup, "s", "processor time before the first step"),
    MEASURED("fastest", fastest, "s", "of the repeats: the least time for all steps"),
    MEASURED("median", median, "s", "the median"),
    MEASURED("slowest", slowest, "s", "the longest"),
    MEASURED("total", total, "s", "setup and median"),
    FIELD("repeats", repeats, "", "how often it was run"),
    FIELD("steps", statistics.steps, "", "steps"),
    FIELD("rejected", statistics.rejected, "", "steps that were rejected"),
    FIELD("right_hand_sides", statistics.rhs, "", "evaluations of the equations", .column = "rhs"),
    FIELD("jacobians", statistics.jacobians, "", "evaluations of their Jacobian"),
    FIELD("states", statistics.states, "", "states that were found without steps"),
    FIELD("below", below, "", "1: the reference is not exact enough to tell the error"),
    FIELD("pareto", pareto, "", "1: nothing else is as exact and faster"),
    FIELD("failure", why, "", "why there is no result", .how = ISO_QUOTED),
    ISO_FIELD_END,
};
#undef FIELD

#define FIELD(key, member, ...) ISO_MEMBER(iso_cost_series, key, member, __VA_ARGS__)

static const iso_field series_fields[] = {
    FIELD("backend", backend, "", "ball, point or exact", .word = iso_backend_name),
    ISO_STRUCT(iso_cost_series, "", method, method_fields, "of integration", .pointer = true),
    FIELD("time_of_a_digit", digit, "", "factor in time for one more digit"),
    FIELD("order", order, "", "error ~ steps^-order"),
    FIELD("least_error", least, "", "the least error"),
    FIELD("stops_at", stops_at, "", "tolerance at which it stops gaining"),
    ISO_FIELD_END,
};
#undef FIELD

#define FIELD(key, member, ...) ISO_MEMBER(iso_cost, key, member, __VA_ARGS__)

const iso_field iso_cost_fields[] = {
    FIELD("end", end, "time", "the last time"),
    FIELD("turns", turns, "", "turns until then, about"),
    FIELD("reference", reference, "", "against which errors are measured"),
    FIELD("second_reference", second, "", "against which the reference is"),
    FIELD("uncertainty", uncertainty, "", "of the reference"),
    FIELD("seconds", seconds, "s", "that all took"),
    FIELD("complete", complete, "", "whether all was measured"),
    ISO_LIST_AT(iso_cost, "cells", cell, cells, iso_cost_cell_fields, "the measurements"),
    ISO_LIST_AT(iso_cost, "lines", series, series_count, series_fields, "of a backend and a method"),
    ISO_FIELD_END,
};
#undef FIELD

/* separatrix_fields.c - what the splitting of the separatrix holds: its numbers with their meaning (separatrix.h). */
#include "instrument/separatrix/separatrix.h"

static bool is_found(const void *row)
{
    return ((const iso_separatrix_splitting *)row)->status == ISO_OK;
}

static bool is_lost(const void *row)
{
    return !is_found(row);
}

static bool is_zero(const void *row)
{
    return is_found(row) && ((const iso_separatrix_splitting *)row)->is_zero;
}

static bool is_undone(const void *row)
{
    return ((const iso_separatrix_splitting *)row)->status == ISO_STOPPED;
}

#define FIELD(key, member, ...) ISO_MEMBER(iso_separatrix_splitting, key, member, __VA_ARGS__)
enum { AXIS = ISO_OPTIONAL | ISO_IN_TREE | ISO_FROM_ONE };
#define FOUND(key, member, ...) FIELD(key, member, __VA_ARGS__, .there = is_found)
#define MORE(key, member, ...) FOUND(key, member, __VA_ARGS__, .how = ISO_OPTIONAL | ISO_IN_TREE)
#define ZERO(key, member, ...) FIELD(key, member, __VA_ARGS__, .there = is_zero, .how = ISO_OPTIONAL | ISO_IN_TREE)

const iso_field iso_separatrix_fields[] = {
    FIELD("k", k, "", "geometry number"),
    FOUND("x", x, "", "where the unstable manifold meets l = pi/2: x = M_a/|M|"),
    FOUND("m", m, "", "its slope dx/dl there; the stable manifold has -m"),
    FOUND("error", error, "", "error of m", .digits = 3),
    FIELD("x_error", x_error, "", "error of x", .digits = 3, .there = is_found, .how = ISO_OPTIONAL),
    FIELD("multiplier", lambda, "", "of a return, of the rotation", .there = is_found, .how = ISO_OPTIONAL),
    FOUND("digits", digits, "", "decimal digits of the numbers: 19 or 32"),
    FIELD("zero", is_zero, "", "1: a further zero of m, between two rows", .how = ISO_IN_TABLE),
    FIELD("level", level, "", "(H/eps) J2^(1/k), J2 the middle moment"),
    MORE("x_tail", x_tail, "", "more digits of x"),
    MORE("m_tail", m_tail, "", "more digits of m"),
    MORE("from_zero", from_zero, "", "m is more than 100 errors from 0"),
    FIELD("global.axis", section, "", "axis of the global section", .there = is_found, .how = AXIS),
    MORE("global.x", section_x, "", "x there"),
    MORE("global.m", section_m, "", "m there"),
    MORE("words", text, "", "why 128 bits failed where 64 did not"),
    ZERO("k_error", k_error, "", "error of k, at a zero of m"),
    ZERO("level_error", level_error, "", "error of the level, at a zero of m"),
    FIELD("next.axis", section, "", "axis of the section of the next point", .there = is_zero, .how = AXIS),
    ZERO("next.l", next_l, "rad", "the next point where the manifolds meet"),
    ZERO("next.x", next_x, "", "its other coordinate"),
    ZERO("next.m", next_m, "", "half the difference of the slopes there"),
    FIELD("failed", text, "", "why there is nothing", .there = is_lost, .how = ISO_OPTIONAL | ISO_IN_TREE),
    ISO_FIELD_END,
};
#undef FIELD

#define LIST(key, member, number, doc)                                                                               \
    ISO_LIST_AT(iso_separatrix_table, key, member, number, iso_separatrix_fields, doc, .skip = is_undone)

const iso_field iso_separatrix_table_fields[] = {
    ISO_MEMBER(iso_separatrix_table, "axis", axis, "", "a of the section n_a = 0 of x and m", .how = ISO_FROM_ONE),
    ISO_MEMBER(iso_separatrix_table, "middle", middle, "", "the axis of the middle moment", .how = ISO_FROM_ONE),
    LIST("rows", row, rows, "one for each k or level"),
    LIST("zeros", zero, zeros, "zeros of m between them"),
    ISO_MEMBER(iso_separatrix_table, "lost", lost, "", "zeros that were not found"),
    ISO_FIELD_END,
};

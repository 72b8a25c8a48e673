/* prove_fields.c - what a proof holds: its numbers with their meaning (prove_impl.h). */
#include "instrument/prove/prove_impl.h"

static double low_k(const void *row)
{
    return iso_rational_double(&((const iso_proof *)row)->ball.k[0]);
}

static double high_k(const void *row)
{
    return iso_rational_double(&((const iso_proof *)row)->ball.k[1]);
}

static const iso_field enclosure_fields[] = {
    ISO_MEMBER(iso_enclosure, "low", low, "", "lower bound"),
    ISO_MEMBER(iso_enclosure, "high", high, "", "upper bound"),
    ISO_MEMBER(iso_enclosure, "text", text, "", "middle and radius, with all digits", .how = ISO_IN_TREE),
    ISO_FIELD_END,
};

#define FIELD(key, member, ...) ISO_MEMBER(iso_proof, key, member, "", __VA_ARGS__)
#define ENCLOSED(key, member, doc) ISO_STRUCT(iso_proof, key, member, enclosure_fields, doc)

const iso_field iso_proof_fields[] = {
    ISO_NUMBER("k", low_k, "", "geometry number, rounded; of an interval the lower end"),
    ISO_NUMBER("k_to", high_k, "", "the upper end; k if it is no interval"),
    FIELD("exact", exact, "k as a fraction, or A:B", .how = ISO_IN_TREE),
    FIELD("statement", statement, "what follows", .how = ISO_IN_TREE),
    ENCLOSED("m", m, "the slope dx/dl of the unstable manifold where it meets l = pi/2; the stable one has -m"),
    FIELD("sign", sign, "of m: 1 or -1, proved; 0: undecided"),
    FIELD("digits", digits, "digits that were asked for"),
    ENCLOSED("x", x, "where it meets l = pi/2: x = M_a/|M|"),
    FIELD("section", axis, "a of the section n_a = 0 of x and m", .how = ISO_FROM_ONE | ISO_IN_TREE),
    FIELD("global.axis", section, "axis of the section on which all was enclosed", .how = ISO_FROM_ONE | ISO_IN_TREE),
    ENCLOSED("global.m", section_m, "m there"),
    ENCLOSED("multiplier", multiplier, "of a return, of the rotation"),
    FIELD("half_returns", halves, "from near the rotation to l = pi/2"),
    FIELD("steps", steps, "steps of Taylor series", .how = ISO_IN_TREE),
    ISO_FIELD_END,
};

const iso_field iso_proofs_fields[] = {
    ISO_LIST_AT(iso_proofs, "rows", row, rows, iso_proof_fields, "one for k, or for each piece of an interval of k"),
    ISO_MEMBER(iso_proofs, "undecided", undecided, "", "the part of the interval of k that is undecided"),
    ISO_FIELD_END,
};

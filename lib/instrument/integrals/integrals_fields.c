/* integrals_fields.c - what a search for integrals holds: its numbers with their meaning (integrals.h). */
#include <math.h>
#include <stdlib.h>

#include "instrument/integrals/integrals_impl.h"
#include "orbit/orbit_impl.h"
#include "study/options_impl.h"

static void find_parity(const void *row, int i, iso_value *v)
{
    v->number = ((const iso_integral_value *)row)->parity >> i & 1;
}

static const char *theory_word(int kind)
{
    return iso_integrability_name((iso_integrability_kind)kind);
}

static const iso_field value_fields[] = {
    ISO_MEMBER(iso_integral_value, "value", value, "", "variation along orbits by size"),
    ISO_MEMBER(iso_integral_value, "error", error, "", "its error"),
    ISO_FOUND("parity", ISO_FIELD_INT, find_parity, "",
              "under gamma_i -> -gamma_i, at the first K_i of a rotor gamma -> -gamma: 1 is odd", .count = 3),
    ISO_FIELD_END,
};

/* --- degrees ---------------------------------------------------------------------------------------------------- */

static double gap_of(const void *row)
{
    const iso_integral_degree *at = row;
    return at->smallest / at->largest;
}

#define FIELD(key, member, ...) ISO_MEMBER(iso_integral_degree, key, member, __VA_ARGS__)

static const iso_field degree_fields[] = {
    FIELD("degree", degree, "", "in M"),
    FIELD("terms", terms, "", "monomials that were looked at"),
    FIELD("functions", functions, "", "dimension of the space"),
    FIELD("integrals", found, "", "integrals in it"),
    FIELD("further", further, "", "of them neither the energy nor of a lower degree"),
    FIELD("doubtful", doubtful, "", "functions that may be integrals"),
    FIELD("largest_of_integrals", largest, "", "the largest value of an integral"),
    FIELD("smallest_of_others", smallest, "", "the smallest value of another function"),
    ISO_NUMBER("gap", gap_of, "", "the second by the first"),
    ISO_LIST(iso_integral_degree, "values", value, values, value_fields, "the smallest values"),
    ISO_FIELD_END,
};
#undef FIELD

/* --- known integrals -------------------------------------------------------------------------------------------- */

static bool is_found(const void *row)
{
    return ((const iso_integral_known *)row)->degree > 0;
}

#define FIELD(key, member, ...) ISO_MEMBER(iso_integral_known, key, member, __VA_ARGS__)

static const iso_field known_fields[] = {
    FIELD("name", name, "", "its name"),
    FIELD("doc", doc, "", "what it is"),
    ISO_IS("found", is_found, "whether it was found"),
    FIELD("constant", constant, "", "a constant on the level"),
    FIELD("degree", degree, "", "in which it was found", .there = is_found),
    FIELD("residual", residual, "", "its distance from what was found"),
    ISO_FIELD_END,
};
#undef FIELD

/* --- the search ------------------------------------------------------------------------------------------------- */

double iso_integral_smallest(const void *search)
{
    const iso_integral_search *r = search;
    double smallest = NAN;
    for (int d = 1; d <= r->degrees; d++) smallest = fmin(smallest, r->at[d].smallest);
    return smallest;
}

/* The energy is found in V_2, with a rotor in V_1. What is found in these and is not further, is the energy. */
int iso_integral_energy_degree(const iso_integral_search *r)
{
    for (int d = 1; d <= 2 && d <= r->degrees; d++)
        if (r->at[d].found > r->at[d].further) return d;
    return 0;
}

static bool has_energy(const void *row)
{
    return iso_integral_energy_degree(row) > 0;
}

static double samples_of(const void *row)
{
    (void)row;
    return ISO_INTEGRAL_ROWS;
}

static const void *degree_of(const void *row, size_t i)
{
    const iso_integral_search *r = row;
    return i < (size_t)r->degrees ? &r->at[i + 1] : NULL;
}

#define FIELD(key, member, ...) ISO_MEMBER(iso_integral_search, key, member, __VA_ARGS__)

const iso_field iso_integral_search_fields[] = {
    FIELD("level", level, "", "(H/eps) J2^(1/k), J2 the middle moment"),
    FIELD("coefficients", coefficients, "", "degree in gamma"),
    FIELD("orbits", orbits, "", "that were followed"),
    ISO_COUNT("samples", samples_of, "", "of each orbit"),
    FIELD("delta", delta, "", "relative error of a sample"),
    FIELD("verdict", verdict, "", "none, found or undecided", .word = iso_integral_verdict_name),
    FIELD("independent", independent, "", "independent integrals beside the energy"),
    FIELD("near", near, "", "a neighbour is integrable"),
    ISO_IS("energy", has_energy, "whether the energy was found"),
    FIELD("energy_spread", energy, "", "relative spread of the energy in the samples"),
    ISO_NUMBER("smallest", iso_integral_smallest, "", "smallest value that is no integral's"),
    ISO_LIST(iso_integral_search, "known", known, known_count, known_fields, "integrals that are known"),
    ISO_ITEMS("degrees", degree_of, degree_fields, "the spaces that were searched"),
    ISO_FIELD_END,
};

/* --- the study -------------------------------------------------------------------------------------------------- */

ISO_STUDY_BEGIN(iso_integral_search_options, iso_integral_search_defaults())

#define ASKED(key, member, ...) ISO_MEMBER(iso_integrals_found, key, how.member, __VA_ARGS__)

static const iso_field found_fields[] = {
    ASKED("degree", degree, "", "the largest, in M"),
    ASKED("turns", turns, "", "of each orbit"),
    ASKED("within", within, "", "which varies more is no integral"),
    ISO_MEMBER(iso_integrals_found, "theory", theory.kind, "", "integrable, no meromorphic integral, or open",
               .word = theory_word),
    ISO_MEMBER(iso_integrals_found, "theory_why", theory.why, "", "why"),
    ISO_STRUCT(iso_integrals_found, "", search, iso_integral_search_fields, "what was found"),
    ISO_FIELD_END,
};

static iso_status run(iso_context *ctx, const iso_study_subject *subject, const void *options,
                      iso_study_result *result)
{
    iso_integrals_found *found = iso_study_keep(result, malloc(sizeof *found), found_fields, free);
    if (!found) return iso_context_no_memory(ctx, "integrals");
    *found = (iso_integrals_found){.how = *(const iso_integral_search_options *)options};
    found->how.progress = result->sink.progress;
    found->how.data = result->sink.data;
    const iso_status status = iso_integral_search_run(ctx, subject->scene, &found->how, &found->search);
    if (status != ISO_OK && status != ISO_STOPPED) return status;
    const iso_effects acting = iso_scene_acting(subject->scene);
    found->theory = iso_integrability_of(&subject->scene->params, &acting, found->search.level != 0);
    const iso_status made =
        iso_study_table(ctx, "integrals", subject->scene, found_fields, found, NULL, &result->table[0]);
    return status == ISO_OK ? made : status;
}

#define ROW(name, argument, expected, doc, set, member)                                                              \
    ISO_OPTION(name, argument, expected, doc, set, iso_integral_search_options, member)

const iso_option iso_integrals_option[] = {
    ROW("degree", "D", "a whole number from 1 on", "largest degree in M, to 8 (default 2)", iso_set_count_int,
        degree),
    ROW("coefficients", "E", "a whole number from 0 on",
        "largest degree in gamma of the coefficients, to 8 (default D, at least 2)", iso_set_whole_int, coefficients),
    ROW("orbits", "N", "a whole number from 1 on", "orbits that are sampled (default 64, more for high degrees)",
        iso_set_count_size, orbits),
    ROW("turns", "T", "a positive number", "turns of each orbit, about, 1 to 1e5 (default 50)", iso_set_positive,
        turns),
    ISO_OPTION_SEED("other starts and times (default 0)", iso_integral_search_options, seed),
    ROW("within", "X", "a positive number", "a function that varies by more than X is no integral (default 1e-10)",
        iso_set_positive, within),
    ISO_OPTION_TOLERANCE("largest relative error of one step (default 1e-14)", iso_integral_search_options,
                         tolerance),
    ISO_OPTION_THREADS(iso_integral_search_options, threads),
    ISO_OPTION_END,
};

const iso_study iso_integrals_study = {"integrals",
                                       "search for additional first integrals",
                                       iso_integrals_option,
                                       sizeof(iso_integral_search_options),
                                       begin,
                                       .run = run,
                                       .of = ISO_STUDY_OF_SCENE,
                                       .fields = found_fields,
                                       .print = iso_integrals_print};

/* frequencies_fields.c - what frequencies hold: their numbers with their meaning (frequencies.h). */
#include <stdlib.h>

#include "base/names_impl.h"
#include "instrument/frequencies/frequencies.h"
#include "study/options_impl.h"
#include "study/study_impl.h"

static ISO_NAMES(kind_word, int, "separated", "symmetric", "plane", "separatrix", "rest", "unknown")

/* --- the motion ------------------------------------------------------------------------------------------------- */

#define FIELD(key, member, ...) ISO_MEMBER(iso_angle, key, member, __VA_ARGS__)

    static const iso_field angle_fields[] = {
        FIELD("what", what, "", "what turns or swings"),
        FIELD("frequency", frequency, "rad/time", "in each clock", .word = iso_clock_word),
        FIELD("period", period, "time", "in each clock", .word = iso_clock_word),
        FIELD("error", error, "rad/time", "of the frequency, if estimated", .word = iso_clock_word),
        FIELD("drift", drift, "", "of the frequency in t between halves of the orbit, if estimated"),
        FIELD("action", action, "", "of a closed solution"),
        ISO_FIELD_END,
};
#undef FIELD

#define FIELD(key, member, ...) ISO_MEMBER(iso_resonance, key, member, __VA_ARGS__)

static const iso_field resonance_fields[] = {
    FIELD("p", p, "", "times the first frequency is nearly"),
    FIELD("q", q, "", "times the second one"),
    FIELD("gap", gap, "", "the relative difference"),
    FIELD("beat", beat, "time", "in which p angle 1 - q angle 2 turns once", .word = iso_clock_word),
    FIELD("met", met, "", "the gap is within the error"),
    ISO_FIELD_END,
};
#undef FIELD

static const iso_field separatrix_fields[] = {
    ISO_MEMBER(iso_separatrix, "of", what, "", "the rotation"),
    ISO_MEMBER(iso_separatrix, "distance", distance, "", "relative distance from its separatrix"),
    ISO_FIELD_END,
};

/* --- the estimate ----------------------------------------------------------------------------------------------- */

#define FIELD(key, member, ...) ISO_MEMBER(iso_identified_line, key, member, __VA_ARGS__)

static const iso_field line_fields[] = {
    FIELD("frequency", line.frequency, "rad/time", "of the line"),
    FIELD("amplitude", line.amplitude, "", "of the line"),
    FIELD("m", m, "", "multiple of the first frequency", ISO_WHEN(iso_identified_line, known)),
    FIELD("n", n, "", "and of the second one", ISO_WHEN(iso_identified_line, known)),
    ISO_FIELD_END,
};
#undef FIELD

#define FIELD(key, member, ...) ISO_MEMBER(iso_estimate, key, member, __VA_ARGS__)

static const iso_field found_fields[] = {
    FIELD("verdict", verdict, "", "on the orbit; in sweeps 0 regular, 1 chaotic, 2 undecided, 3 integrable",
          .word = iso_verdict_word),
    FIELD("length", length, "time", "of the orbit, in t"),
    FIELD("turns", turns, "", "of n"),
    FIELD("samples", samples, "", "of the orbit"),
    FIELD("axis", axis, "", "about which n turns", .how = ISO_FROM_ONE),
    FIELD("drift", drift, "", "of the frequencies between halves of the orbit"),
    FIELD("drift_before", drift_before, "", "the same in its first quarter"),
    FIELD("unexplained", unexplained, "", "part of the amplitudes that is no combination of both"),
    ISO_LIST(iso_estimate, "lines_turning", line[0], lines[0], line_fields, "of the components that turn"),
    ISO_LIST(iso_estimate, "lines_along", line[1], lines[1], line_fields, "of the component along the axis"),
    ISO_FIELD_END,
};
#undef FIELD

/* --- all -------------------------------------------------------------------------------------------------------- */

static ISO_NAMES(solution_word, int, "closed", "estimated")

    static double solution_of(const void *row)
{
    return ((const iso_frequencies *)row)->estimated;
}

static const iso_field name_field[] = {ISO_MEMBER(iso_integral, "name", name, "", "of the integral"), ISO_FIELD_END};

static bool has_integral(const void *row)
{
    return ((const iso_frequencies *)row)->integral != NULL;
}

#define FIELD(key, member, ...) ISO_MEMBER(iso_frequencies, key, member, __VA_ARGS__)
#define LIST(key, member, count, fields, ...) ISO_LIST(iso_frequencies, key, member, count, fields, __VA_ARGS__)

static const iso_field estimate_fields[] = {
    FIELD("why", why, "", "why there is no closed solution"),
    ISO_STRUCT(iso_frequencies, "", estimate, found_fields, "how"),
    ISO_FIELD_END,
};

static const iso_field integral_fields[] = {
    ISO_STRUCT(iso_frequencies, "", integral, name_field, "which", .pointer = true),
    FIELD("value", F, "", "its value"),
    ISO_FIELD_END,
};

const iso_field iso_frequencies_fields[] = {
    FIELD("h", h, "energy", "of the ball"),
    FIELD("eps", eps, "", "coupling of the point"),
    FIELD("H", H, "energy", "of the point"),
    ISO_COUNT("solution", solution_of, "", "closed or estimated", .word = solution_word),
    FIELD("kind", kind, "", "of the closed solution", .word = kind_word),
    FIELD("motion", motion, "", "in words"),
    ISO_GROUP("integral", integral_fields, "beyond the energy", .there = has_integral),
    FIELD("c", c, "", "constant of the separation"),
    LIST("angles", angle, angles, angle_fields, "of the torus"),
    FIELD("frequency_ratio", ratio, "", "frequency 1 by frequency 2"),
    LIST("resonances", resonance, resonances, resonance_fields, "that are near"),
    LIST("separatrices", separatrix, separatrices, separatrix_fields, "that are near"),
    FIELD("closed_orbit", closed, "time", "period of a closed orbit", .word = iso_clock_word),
    ISO_GROUP("estimate", estimate_fields, "how the frequencies were found", ISO_WHEN(iso_frequencies, estimated)),
    ISO_FIELD_END,
};

/* --- the study -------------------------------------------------------------------------------------------------- */

ISO_STUDY_BEGIN(iso_frequencies_options, iso_frequencies_defaults())

static iso_status run(iso_context *ctx, const iso_study_subject *subject, const void *options,
                      iso_study_result *result)
{
    iso_frequencies_options how = *(const iso_frequencies_options *)options;
    iso_frequencies *f = iso_study_keep(result, malloc(sizeof *f), iso_frequencies_fields, free);
    if (!f) return iso_context_no_memory(ctx, "frequencies");
    how.progress = result->sink.progress;
    how.data = result->sink.data;
    ISO_TRY(iso_frequencies_find(ctx, subject->scene, &how, f));
    return iso_study_table(ctx, "frequencies", subject->scene, result->fields, f, NULL, &result->table[0]);
}

#define ROW(name, argument, expected, doc, set, member)                                                              \
    ISO_OPTION(name, argument, expected, doc, set, iso_frequencies_options, member)

const iso_option iso_frequencies_option[] = {
    ROW("turns", "N", "a positive number", "length of the orbit in turns, 20 or more (default 1000, more if needed)",
        iso_set_positive, turns),
    ROW("t-end", "T", "a positive number", "length of the orbit in time t, in place of --turns", iso_set_positive,
        end),
    ROW("samples", "N", "a whole number from 1 on",
        "number of samples of the orbit, at most 4194304, rounded up to a power of 2 (default 32 each turn)",
        iso_set_count, samples),
    ISO_OPTION_END,
};

const iso_study iso_frequencies_study = {"frequencies",
                                         "compute frequencies, their ratio, actions and near resonances",
                                         iso_frequencies_option,
                                         sizeof(iso_frequencies_options),
                                         begin,
                                         .run = run,
                                         .of = ISO_STUDY_OF_SCENE,
                                         .fields = iso_frequencies_fields,
                                         .print = iso_frequencies_print};

/* isoroll integrals - searches for additional first integrals: polynomials in M that are constant on many orbits. */
#include <math.h>

#include "base/number_impl.h"
#include "instrument/integrals/integrals_impl.h"
#include "terminal.h"
#include "shell.h"
#include "study/study_impl.h"

/* What integrals can be told. */
typedef struct options {
    iso_integral_search_options study;
    shell_options shell;
} options;

/* --- the table -------------------------------------------------------------------------------------------------- */

static void print_head(const options *o, const iso_scene *scene, const iso_integral_search *r)
{
    iso_params_print(say_to(), &scene->params);
    if (r->level != 0) say("; level (H/eps) J2^(1/k) = %.10g", r->level);
    say("\n"
        "%zu orbits of %s turns, %d samples of each; relative error of a sample about %.0e\n"
        "functions %s, |b| <= %d; a value is the variation of a function along orbits, divided by its size: 0 "
        "for an integral\n\n",
        r->orbits, ISO_SHORT(o->study.turns), ISO_INTEGRAL_ROWS, r->delta,
        iso_integral_energy_degree(r) == 1 ? "v^c M^a gamma^b, v = q^(-1/(2k)), |a| + c <= degree, c <= 1"
                                           : "h^j M^a gamma^b, |a| + 2 j = degree",
        r->coefficients);
}

static void print_value(double x)
{
    if (isnan(x))
        say("\t-");
    else
        say("\t%.1e", x);
}

static void print_degree(const iso_integral_degree *at)
{
    say("%d\t%zu\t%zu\t%zu\t%zu", at->degree, at->functions, at->found, at->further, at->doubtful);
    print_value(at->largest);
    print_value(at->smallest);
    say("\n");
}

static void print_known(const iso_integral_search *r)
{
    const int energy = iso_integral_energy_degree(r);
    if (energy > 0) say("  the energy, a constant on the level: found in degree %d\n", energy);
    for (int i = 0; i < r->known_count; i++) {
        const iso_integral_known *known = &r->known[i];
        say("  %s = %s: ", known->name, known->doc);
        if (known->degree > 0)
            say("found in degree %d, to %.1e\n", known->degree, known->residual);
        else
            say(known->constant ? "a constant on the level\n" : "not in this space\n");
    }
}

static void print_verdict(const options *o, const iso_integral_search *r)
{
    if (r->verdict == ISO_INTEGRALS_FOUND)
        say("found: %d independent integral%s beside the energy\n", r->independent, r->independent > 1 ? "s" : "");
    else if (r->verdict == ISO_INTEGRALS_NONE)
        say("none beside the energy up to degree %d within %s: the smallest value is %.1e\n", r->degrees,
            ISO_SHORT(o->study.within), iso_integral_smallest(r));
    else if (r->degrees < o->study.degree)
        say("undecided: stopped after degree %d\n", r->degrees);
    else if (r->independent > 0)
        say("undecided: k and J are so near those of an integrable ball that its integral is constant here\n");
    else
        say("undecided: there are values between their error and %s\n", ISO_SHORT(o->study.within));
}

static void print_table(const shell *s)
{
    const options *o = s->options;
    const iso_integrals_found *found = s->result.found;
    const iso_integral_search *r = &found->search;
    print_verdict(o, r);
    say("theory: %s: %s\n\n", iso_integrability_name(found->theory.kind), found->theory.why);
    print_head(o, &s->scene, r);
    say_table(1);
    say("degree\tfunctions\tintegrals\tfurther\tdoubtful\ttheir values up to\tsmallest other value\n");
    for (int d = 1; d <= r->degrees; d++) print_degree(&r->at[d]);
    say_table_end();
    say("\n");
    print_known(r);
}

/* --- the command ------------------------------------------------------------------------------------------------ */

static int run(iso_context *ctx, const void *options_given)
{
    static const shell_parts parts = {
        .study = &iso_integrals_study, .stopped = "what is known by now is printed", .print = print_table};
    return shell_run(ctx, &parts, options_given, &((const options *)options_given)->shell);
}

static const options defaults = {.shell = {.file = "-"}};

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_integrals_option),
    ROW_JSON(options, shell.json),
    ROW_END,
};

const command command_integrals = {
    COMMAND_OF_STUDY(integrals, "SCENE", shell.file),
    .takes = FILE_SCENE,
    .description =
        "Looks for functions of the point's state that are constant along orbits: polynomials in M of degree D or "
        "less, with coefficients that are polynomials in gamma of degree E or less. Of the scene it reads k, J and "
        "the level of the energy: that of a point, or of a ball with the effect 'level'. With the effect 'rotor' it "
        "also reads the energy and the rotor's momentum; functions then have the factor q^(-1/(2k)) as well, and "
        "degree 4 takes 10 seconds and more. Orbits start spread evenly over a section and are sampled at many "
        "times. The singular values of the samples tell how little a function of this space can vary along orbits, "
        "relative to its own size.\n\n"
        "The table has a line for each degree: how many independent functions there are, how many of them are "
        "integrals, how many are new (not the energy, and not found two degrees lower, with a rotor one; products of "
        "integrals are counted as new), and the smallest value of the others. On each level the energy is constant; "
        "it is the one integral of degree 2, with a rotor of degree 1, that every ball has.\n\n"
        "Integrals that are known for this k and J are named where they are found. 'undecided': a value lies "
        "between its own error and --within, or k and J are almost those of an integrable ball, or the search was "
        "stopped.\n\n"
        "The line 'theory' does not depend on the search. It says 'integrable' (a second integral is known), 'no "
        "meromorphic integral' (a theorem of ours, not reviewed) or 'open', and why.",
    .example = "isoroll integrals scene.yaml --degree 4",
    .exits = "1: interrupted\n"
             "3: bad input: an effect that acts, other than 'level' and 'rotor', or k too near 0\n"
             "4: the computation failed, or no memory",
};

/* isoroll integrals - searches for additional first integrals: polynomials in M that are constant on many orbits. */
#include <math.h>

#include "shell.h"
#include "study/integrals/integrals_impl.h"

/* What integrals can be told. */
typedef struct options {
    iso_integral_search_options study;
    shell_options shell;
} options;

/* --- the table -------------------------------------------------------------------------------------------------- */

static void print_head(const options *o, const iso_scene *scene, const iso_integral_search *r)
{
    const double *J = scene->params.J;
    printf("k = %.15g, J = %.15g %.15g %.15g", scene->params.k, J[0], J[1], J[2]);
    if (r->level != 0) printf("; level (H/eps) J2^(1/k) = %.10g", r->level);
    printf("\n"
           "%zu orbits of %g turns, %d samples of each; relative error of a sample about %.0e\n"
           "functions h^j M^a gamma^b, |a| + 2 j = degree, |b| <= %d; a value is the variation of a function along\n"
           "orbits by its size: 0 for an integral\n\n"
           "  degree  functions  integrals  further  doubtful   their values up to  smallest other value\n",
           r->orbits, o->study.turns, ISO_INTEGRAL_ROWS, r->delta, r->coefficients);
}

static void print_value(int width, double x)
{
    if (isnan(x))
        printf("  %*s", width, "-");
    else
        printf("  %*.1e", width, x);
}

static void print_degree(const iso_integral_degree *at)
{
    printf("  %6d  %9zu  %9zu  %7zu  %8zu", at->degree, at->functions, at->found, at->further, at->doubtful);
    print_value(19, at->largest);
    print_value(20, at->smallest);
    printf("\n");
}

static void print_known(const iso_integral_search *r)
{
    if (r->degrees >= 2) printf("  the energy, a constant on the level: found in degree 2\n");
    for (int i = 0; i < r->known_count; i++) {
        const iso_integral_known *known = &r->known[i];
        printf("  %s = %s: ", known->name, known->doc);
        if (known->degree > 0)
            printf("found in degree %d, to %.1e\n", known->degree, known->residual);
        else
            printf(known->constant ? "a constant on the level\n" : "not in this space\n");
    }
}

static void print_verdict(const options *o, const iso_integral_search *r)
{
    if (r->verdict == ISO_INTEGRALS_FOUND)
        printf("found: %d independent integral%s beside the energy\n", r->independent, r->independent > 1 ? "s" : "");
    else if (r->verdict == ISO_INTEGRALS_NONE)
        printf("none beside the energy up to degree %d within %g: the smallest value is %.1e\n", r->degrees,
               o->study.within, iso_integral_smallest(r));
    else if (r->degrees < o->study.degree)
        printf("undecided: stopped after degree %d\n", r->degrees);
    else if (r->independent > 0)
        printf("undecided: k and J are so near those of an integrable ball that its integral is constant here\n");
    else
        printf("undecided: there are values between their error and %g\n", o->study.within);
}

static void print_table(const shell *s)
{
    const options *o = s->options;
    const iso_integral_search *r = &((const iso_integrals_found *)s->result.found)->search;
    print_head(o, &s->scene, r);
    for (int d = 1; d <= r->degrees; d++) print_degree(&r->at[d]);
    printf("\n");
    print_known(r);
    print_verdict(o, r);
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
    ROWS_OF_STUDY(iso_integrals_option, 0, 8),
    ROW_JSON(options, shell.json),
    ROW_END,
};

const command command_integrals = {
    COMMAND_OF_STUDY(integrals, "SCENE", shell.file),
    .takes = FILE_SCENE,
    .description =
        "Looks for functions of the point's state that are constant along orbits: polynomials in M of degree D or "
        "less, with coefficients that are polynomials in gamma of degree E or less. Of the scene it reads k, J and "
        "the level of the energy: that of a point, or of a ball with the effect 'level'. Orbits start spread "
        "evenly over a section and are sampled at many times. The singular values of the samples tell how little a "
        "function of this space can vary along orbits, relative to its own size.\n\n"
        "The table has a line for each degree: how many independent functions there are, how many of them are "
        "integrals, how many are new (not the energy, and not found two degrees lower; products of integrals are "
        "counted as new), and the smallest value of the others. On each level the energy is constant; it is the "
        "one integral of degree 2 that every ball has.\n\n"
        "Integrals that are known for this k and J are named where they are found. 'undecided': a value lies "
        "between its own error and --within, or k and J are almost those of an integrable ball, or the search was "
        "stopped.",
    .example = "isoroll integrals scene.yaml --degree 4",
    .exits = "1: interrupted\n"
             "3: bad input: an effect that acts, other than 'level', or k too near 0\n"
             "4: the computation failed, or no memory",
};

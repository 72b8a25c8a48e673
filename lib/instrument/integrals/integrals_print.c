/* integrals_print.c - the text of integrals (study/study.h). */
#include <math.h>

#include "base/number_impl.h"
#include "instrument/integrals/integrals_impl.h"
#include "study/options_impl.h"
#include "study/study_impl.h"

static void print_verdict(FILE *to, const iso_integral_search_options *o, const iso_integral_search *r)
{
    if (r->verdict == ISO_INTEGRALS_FOUND)
        fprintf(to, "found: %d independent integral%s beside the energy\n", r->independent,
                r->independent > 1 ? "s" : "");
    else if (r->verdict == ISO_INTEGRALS_NONE)
        fprintf(to, "none beside the energy up to degree %d within %s: the smallest value is %.1e\n", r->degrees,
                ISO_SHORT(o->within), iso_integral_smallest(r));
    else if (r->degrees < o->degree)
        fprintf(to, "undecided: stopped after degree %d\n", r->degrees);
    else if (r->independent > 0)
        fputs("undecided: k and J are so near those of an integrable ball that its integral is constant here\n", to);
    else
        fprintf(to, "undecided: there are values between their error and %s\n", ISO_SHORT(o->within));
}

static void print_known(FILE *to, const iso_integral_search *r, int energy)
{
    if (energy > 0) fprintf(to, "  the energy, a constant on the level: found in degree %d\n", energy);
    for (const iso_integral_known *known = r->known; known < r->known + r->known_count; known++) {
        fprintf(to, "  %s = %s: ", known->name, known->doc);
        if (known->degree > 0)
            fprintf(to, "found in degree %d, to %.1e\n", known->degree, known->residual);
        else
            fputs(known->constant ? "a constant on the level\n" : "not in this space\n", to);
    }
}

void iso_integrals_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result)
{
    const iso_integral_search_options *o = options;
    const iso_integrals_found *found = result->found;
    const iso_integral_search *r = &found->search;
    print_verdict(to, o, r);
    fprintf(to, "theory: %s: %s\n\n", iso_integrability_name(found->theory.kind), found->theory.why);
    const int energy = iso_integral_energy_degree(r);
    iso_params_print(to, &scene->params);
    if (r->level != 0) fprintf(to, "; level (H/eps) J2^(1/k) = %.10g", r->level);
    fprintf(to,
            "\n"
            "%zu orbits of %s turns, %d samples of each; relative error of a sample about %.0e\n"
            "functions %s, |b| <= %d; a value is the variation of a function along orbits, divided by its size: 0 "
            "for an integral\n\n",
            r->orbits, ISO_SHORT(o->turns), ISO_INTEGRAL_ROWS, r->delta,
            energy == 1 ? "v^c M^a gamma^b, v = q^(-1/(2k)), |a| + c <= degree, c <= 1"
                        : "h^j M^a gamma^b, |a| + 2 j = degree",
            r->coefficients);
    iso_table_begin(to, 1);
    fputs("degree\tfunctions\tintegrals\tfurther\tdoubtful\ttheir values up to\tsmallest other value\n", to);
    for (const iso_integral_degree *at = &r->at[1]; at <= &r->at[r->degrees]; at++) {
        fprintf(to, "%d\t%zu\t%zu\t%zu\t%zu", at->degree, at->functions, at->found, at->further, at->doubtful);
        for (int i = 0; i < 2; i++) {
            const double x = i == 0 ? at->largest : at->smallest;
            fprintf(to, "\t%s", isnan(x) ? "-" : "");
            if (!isnan(x)) fprintf(to, "%.1e", x);
        }
        fputs("\n", to);
    }
    iso_table_end(to);
    fputs("\n", to);
    print_known(to, r, energy);
}

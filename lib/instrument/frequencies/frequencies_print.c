/* frequencies_print.c - the text of frequencies (study/study.h). */
#include <math.h>

#include "instrument/frequencies/frequencies.h"
#include "study/options_impl.h"
#include "study/study_impl.h"

static void print_head(FILE *to, const iso_scene *scene, const iso_frequencies *f)
{
    iso_params_print(to, &scene->params);
    fprintf(to, "\nh = %.15g", f->h);
    if (!isnan(f->eps)) fprintf(to, ", eps = %.15g", f->eps);
    if (f->integral) fprintf(to, ", %s = %.15g", f->integral->name, f->F);
    fputs("\n\n", to);
    if (!f->estimated) {
        fprintf(to, "closed solution: %s\n", f->motion);
        if (!isnan(f->c))
            fprintf(to, "  it separates in sphero-conical coordinates u and v, with the constant c = %.15g\n", f->c);
        return;
    }
    fprintf(to, "ESTIMATED from an orbit: %s\n  %s: %s\n", f->motion,
            f->unresolved ? "the closed solution was not resolved" : "no closed solution", f->why);
    fprintf(to, "  orbit: %.6g turns, to t = %.10g, %zu samples\n", f->estimate.turns, f->estimate.length,
            f->estimate.samples);
    fprintf(
        to,
        "  a frequency differs between the halves of the orbit by %.1e, between the halves of its first quarter by "
        "%.1e\n",
        f->estimate.drift, f->estimate.drift_before);
    if (f->estimate.verdict == ISO_CHAOTIC)
        fputs("  a chaotic motion has no fixed frequencies: the numbers below hold for this orbit only\n", to);
    if (f->estimate.unexplained > 1e-4)
        fprintf(to, "  part of the amplitudes that two frequencies do not explain: %.2g\n", f->estimate.unexplained);
    if (f->angles == 2 && isnan(f->ratio) && f->estimate.verdict != ISO_CHAOTIC)
        fputs("  that is most of them: there is no frequency ratio\n", to);
}

/* One line: a number in each clock, - where it is not known. */
static void print_clocks(FILE *to, const char *what, const double x[ISO_CLOCKS])
{
    fprintf(to, "%s", what);
    for (int c = 0; c < ISO_CLOCKS; c++)
        if (isnan(x[c]))
            fputs("\t-", to);
        else
            fprintf(to, "\t%.15g", x[c]);
    fputs("\n", to);
}

static void print_resonances(FILE *to, const iso_frequencies *f)
{
    if (!isnan(f->ratio)) fprintf(to, "\nfrequency ratio, frequency 1 / frequency 2: %.15g\n", f->ratio);
    if (f->resonances > 0) {
        fputs("near resonances: p times frequency 1 is almost q times frequency 2\n", to);
        iso_table_begin(to, 1);
        fputs("p:q\trelative gap\tp angle 1 - q angle 2 makes one turn in\n", to);
    }
    for (int i = 0; i < f->resonances; i++) {
        const iso_resonance *r = &f->resonance[i];
        fprintf(to, "%d:%d\t%.1e\t", r->p, r->q, r->gap);
        if (r->met)
            fprintf(to, f->estimated ? "- (the gap is within the error of the estimate)\n" : "- (resonant)\n");
        else
            fprintf(to, "t = %.6g\n", r->beat[ISO_CLOCK_T]);
    }
    if (f->resonances > 0) iso_table_end(to);
    if (isnan(f->closed[ISO_CLOCK_T])) return;
    fputs("\nthe orbit is closed\n", to);
    iso_table_begin(to, 1);
    fputs("in\tt\ttau\ts\n", to);
    print_clocks(to, "period", f->closed);
    iso_table_end(to);
}

void iso_frequencies_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result)
{
    const iso_frequencies *f = result->found;
    (void)options;
    print_head(to, scene, f);
    if (f->separatrices > 0) fputs("\nrelative distance from the separatrix of an unstable rotation\n", to);
    for (int i = 0; i < f->separatrices; i++)
        fprintf(to, "  %s: %.15g\n", f->separatrix[i].what, f->separatrix[i].distance);
    if (f->angles > 0) {
        fputs("\n", to);
        iso_table_begin(to, 1);
        fputs("angles in rad\tt\ttau\ts\n", to);
    }
    for (int i = 0; i < f->angles; i++) {
        const iso_angle *a = &f->angle[i];
        fprintf(to, "angle %d: %s\n", i + 1, a->what);
        print_clocks(to, "frequency", a->frequency);
        if (f->estimated) print_clocks(to, "its error", a->error);
        print_clocks(to, "period", a->period);
        if (!isnan(a->action)) fprintf(to, "action\t%.15g\t\t\n", a->action);
    }
    if (f->angles > 0) iso_table_end(to);
    print_resonances(to, f);
}

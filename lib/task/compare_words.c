/* compare_words.c - the result of a comparison in one sentence (study_impl.h). */
#include <float.h>
#include <math.h>
#include <stdio.h>

#include "base/number_impl.h"
#include "orbit/orbit_impl.h"
#include "task/task_impl.h"

/* The largest difference in row i: of states and clocks, between any two backends. */
static double row_worst(const iso_comparison *c, size_t i)
{
    double worst = 0;
    for (int j = 1; j < ISO_DIFFERENCES; j++) {
        worst = fmax(worst, iso_record_const_row(c->difference, i)[j]);
        for (int b = 0; c->runs == ISO_BACKENDS && b < ISO_INTEGRATED; b++)
            worst = fmax(worst, iso_record_const_row(c->from_exact[b], i)[j]);
    }
    return worst;
}

/* What the steps of the integrations may add up to, where errors do not grow by themselves. */
static double allowed(const iso_scene *scene, const iso_comparison *c)
{
    long steps = 1;
    for (int b = 0; b < ISO_INTEGRATED; b++)
        if (c->run[b].statistics.steps > steps) steps = c->run[b].statistics.steps;
    return (double)steps * fmax(scene->tolerance, 16 * DBL_EPSILON);
}

static double worst_of(const iso_comparison *c, size_t rows)
{
    double worst = 0;
    for (size_t i = 0; i < rows; i++) worst = fmax(worst, row_worst(c, i));
    for (int j = 1; j < ISO_DIFFERENCES; j++)
        if (rows == iso_record_rows(c->difference) && !isfinite(c->worst[j])) worst = INFINITY;
    return worst;
}

/* The time of the last row before which all differences are within `bound`. */
static double agree_until(const iso_comparison *c, double bound)
{
    size_t i = 0;
    while (i + 1 < iso_record_rows(c->difference) && row_worst(c, i + 1) <= bound) i++;
    return iso_record_const_row(c->difference, i)[0];
}

bool iso_comparison_words(const iso_scene *scene, const iso_comparison *c, double *most,
                          char words[ISO_COMPARISON_WORDS])
{
    enum { GROWTH = 30 }; /* errors that grow like the cube of the time are 8 times those of the first half */
    const size_t rows = iso_record_rows(c->difference), all = iso_scene_rows(scene);
    const char *who = c->runs == ISO_BACKENDS ? "both models and the closed solution" : "both models";
    const char *clock = iso_clock_name(c->clock);
    const double worst = worst_of(c, rows), half = worst_of(c, rows / 2), bound = allowed(scene, c);
    const double same = fmin(bound, 1e-3); /* what differs by more is not called the same, whatever the tolerance */
    char part[128] = "";
    *most = worst;
    if (rows < all) snprintf(part, sizeof part, " in the %zu of %zu rows that were compared", rows, all);
    if (worst <= same)
        snprintf(words, ISO_COMPARISON_WORDS, "the same orbit%s: %s agree to %.1e", part, who, worst);
    else if (!isfinite(worst))
        snprintf(words, ISO_COMPARISON_WORDS, "no result%s: a difference is not finite", part);
    else if (worst > bound && worst > GROWTH * half)
        snprintf(words, ISO_COMPARISON_WORDS,
                 "the orbits part%s: %s agree to %.1e until %s = %s, then the difference grows to %.1e, as on a "
                 "chaotic orbit, where it multiplies with every turn; this says nothing against the isomorphism "
                 "(see 'isoroll chaos')",
                 part, who, bound, clock, ISO_ROUNDED(agree_until(c, bound), 6), worst);
    else
        snprintf(
            words, ISO_COMPARISON_WORDS,
            "not shown to be the same orbit%s: %s differ by %.1e; steps of tolerance %s may add up to %.1e; if a "
            "smaller --tol makes the difference smaller, it is the error of the method",
            part, who, worst, ISO_SHORT(scene->tolerance), bound);
    return worst <= same;
}

/* measure_test.c - sums of test functions over clouds, and whether their means are those of the measure. */
#include <gsl/gsl_cdf.h>
#include <math.h>

#include "study/section/measure_impl.h"

void iso_measure_sums_start(measure_sums *sums, double sharp, const double value[])
{
    sums->sharp += sharp;
    sums->sharp_square += sharp * sharp;
    for (int i = 0; i < sums->functions; i++) {
        sums->first[i] += value[i];
        sums->first_product[i] += sharp * value[i];
    }
}

void iso_measure_sums_add(measure_sums *sums, int cloud, int row, double sharp, const double value[])
{
    double *sum = sums->value[cloud] + row * sums->functions, *product = sums->product + row * sums->functions;
    for (int i = 0; i < sums->functions; i++) {
        sum[i] += value[i];
        product[i] += sharp * value[i];
    }
}

/* The mean of the clouds' means, its standard error from their scatter, and d(mean - expected)/d(exponent). Here
 * d(mean)/d(exponent) is the covariance of the values with d ln(density)/d(exponent) at the start, and
 * d(expected)/d(exponent) is the same covariance of the values at the start. */
static void find_mean(const measure_sums *sums, double count, int at, iso_measure_entry *line)
{
    const int f = at % sums->functions;
    const double each = count / ISO_MEASURE_CLOUDS;
    double mean = 0, square = 0;
    for (int c = 0; c < ISO_MEASURE_CLOUDS; c++) mean += sums->value[c][at] / each / ISO_MEASURE_CLOUDS;
    for (int c = 0; c < ISO_MEASURE_CLOUDS; c++) square += pow(sums->value[c][at] / each - mean, 2);
    line->mean = mean;
    line->error = sqrt(square / (ISO_MEASURE_CLOUDS - 1) / ISO_MEASURE_CLOUDS);
    line->slope =
        (sums->product[at] - sums->first_product[f]) / count - sums->sharp / count * (mean - sums->first[f] / count);
}

void iso_measure_judge(const measure_sums *sums, const iso_measure_options *o, const char *const name[],
                       const double expected[], const double time[ISO_MEASURE_ROWS], iso_measure *m)
{
    const double freedom = ISO_MEASURE_CLOUDS - 1, count = (double)o->count;
    const double least = fmax(1e3 * o->tolerance, 1e-11); /* of the integration, which does not show as scatter */
    const bool flat = sums->sharp_square / count - pow(sums->sharp / count, 2) < 1e-13 * sums->sharp_square / count;
    m->count = o->count;
    m->lines = sums->functions * ISO_MEASURE_ROWS;
    m->worst = 0;
    m->resolution = INFINITY;
    const double critical = gsl_cdf_tdist_Qinv(o->significance / 2 / m->lines, freedom);
    for (int i = 0; i < m->lines; i++) {
        const int f = i % sums->functions;
        iso_measure_entry *line = &m->line[i];
        *line = (iso_measure_entry){.name = name[f], .time = time[i / sums->functions], .expected = expected[f]};
        find_mean(sums, count, i, line);
        line->error = fmax(line->error, least);
        line->deviation = (line->mean - line->expected) / line->error;
        line->p = 2 * gsl_cdf_tdist_Q(fabs(line->deviation), freedom);
        if (!(fabs(line->deviation) <= fabs(m->line[m->worst].deviation))) m->worst = i;
        if (!flat) m->resolution = fmin(m->resolution, critical * line->error / fabs(line->slope));
    }
    m->p = fmin(1, m->line[m->worst].p * m->lines);
    m->kept = m->p >= o->significance;
}

/* The starts and the interval of lib/instrument/chaos/share.c: how often the interval holds the true share, for sets
 * of many shapes whose share of the section's area is known. */
#include "base/math_impl.h"
#include "instrument/chaos/chaos_impl.h"
#include "laws.h"

/* u: the part of the area below the angle, v = (1 + x)/2; both are uniform on (0, 1). */
typedef struct set {
    const char *name;
    bool (*holds)(double u, double v);
} set;

static double around(double a, double b)
{
    const double d = fabs(a - b);
    return fmin(d, 1 - d);
}

static bool half(double u, double v)
{
    (void)u;
    return v < 0.5;
}

static bool most(double u, double v)
{
    (void)v;
    return u < 0.9;
}

static bool slanted(double u, double v)
{
    return v < 0.35 + 0.4 * u;
}

static bool island(double u, double v)
{
    return hypot(around(u, 0.4), around(v, 0.6)) < 0.3;
}

/* A thin layer around a curve, as around a separatrix. */
static bool layer(double u, double v)
{
    return fabs(v - 0.5 - 0.2 * sin(2 * ISO_PI * u)) < 0.025;
}

/* Chains of small islands: 7 and 12 of them. */
static bool chains(double u, double v)
{
    const double one = hypot(around(fmod(7 * u, 1), 0.3) / 7, v - 0.4 - 0.1 * sin(2 * ISO_PI * u)),
                 other = hypot(around(fmod(12 * u, 1), 0.8) / 12, v - 0.8);
    return one < 0.03 || other < 0.015;
}

/* All but the islands. */
static bool sea(double u, double v)
{
    return !island(u, v) && !chains(u, v);
}

/* Points without any order: a cell of a fine grid belongs to the set or not. */
static bool dust(double u, double v)
{
    const unsigned long cell = (unsigned long)(u * 400) * 1009 + (unsigned long)(v * 400);
    return fmod((double)(cell * 2654435761 % 4294967296) * 0x1p-32 * 7919, 1) < 0.2;
}

static const set sets[] = {{"half", half},   {"most", most},     {"slanted", slanted}, {"island", island},
                           {"layer", layer}, {"chains", chains}, {"sea", sea},         {"dust", dust}};
enum { SETS = sizeof sets / sizeof *sets };

/* The share of a set, from a grid of 1500 x 1500 cells. */
static double true_share(const set *s)
{
    enum { CELLS = 1500 };
    long found = 0;
    for (int i = 0; i < CELLS; i++)
        for (int j = 0; j < CELLS; j++) found += s->holds((i + 0.5) / CELLS, (j + 0.5) / CELLS);
    return (double)found / CELLS / CELLS;
}

/* The interval must hold the share in 90 to 99 of 100 repetitions with other seeds. The bounds are those that were
 * asked for; 95 are meant. With fewer starts than two for each copy the counts are too coarse for such a law. */
static void check_coverage(int repetitions)
{
    enum { NUMBERS = 3, MOST = 1000 };
    static const size_t numbers[NUMBERS] = {60, 200, MOST};
    const iso_params p = laws_params(0.5, (double[]){3, 3, 3}); /* equal moments: u is (l + pi)/(2 pi) */
    int within[SETS][NUMBERS] = {{0}};
    double share[SETS], width[SETS][NUMBERS] = {{0}};
    iso_section_spread spread;
    for (int s = 0; s < SETS; s++) share[s] = true_share(&sets[s]);
    for (int seed = 0; seed < repetitions; seed++) {
        size_t count[ISO_SHIFTS] = {0}, found[SETS][ISO_SHIFTS] = {{0}};
        iso_section_spread_prepare(&spread, iso_free_point(&p, 1), 2, (uint64_t)seed);
        spread.copies = ISO_SHIFTS;
        for (size_t i = 0, n = 0; i < MOST; i++) {
            double l, x, low, high;
            iso_section_spread_point(&spread, i, &l, &x);
            count[i % ISO_SHIFTS]++;
            for (int s = 0; s < SETS; s++)
                found[s][i % ISO_SHIFTS] += sets[s].holds((l + ISO_PI) / (2 * ISO_PI), (1 + x) / 2);
            if (i + 1 != numbers[n]) continue;
            for (int s = 0; s < SETS; s++) {
                iso_share_interval(count, found[s], &low, &high);
                within[s][n] += low <= share[s] && share[s] <= high;
                width[s][n] += (high - low) / repetitions;
            }
            n++;
        }
    }
    for (int s = 0; s < SETS; s++)
        for (int n = 0; n < NUMBERS; n++) {
            const double part = (double)within[s][n] / repetitions;
            gsl_test(!(part >= 0.9 && part <= 0.99),
                     "%s, share %.4f, %zu starts: held %.1f %% of the time, width %.4f", sets[s].name, share[s],
                     numbers[n], 100 * part, width[s][n]);
        }
}

/* --- edges ------------------------------------------------------------------------------------------------------ */

static void interval_of(size_t starts, bool found, double *low, double *high)
{
    size_t count[ISO_SHIFTS] = {0}, none[ISO_SHIFTS] = {0};
    for (size_t i = 0; i < starts; i++) count[i % ISO_SHIFTS]++;
    iso_share_interval(count, found ? count : none, low, high);
}

/* None or all are found: the other end is near 3.3/n, and 0 is never certain. Nothing is known without starts. */
static void check_edges(void)
{
    double low, high;
    for (size_t n = 1; n <= 3000; n = n * 3 + 1) {
        const double copies = fmin((double)n, ISO_SHIFTS), edge = copies * (1 - pow(0.025, 1 / copies)) / (double)n;
        interval_of(n, false, &low, &high);
        gsl_test(!(low == 0 && fabs(high - edge) < 1e-12), "none of %zu: %g to %g", n, low, high);
        interval_of(n, true, &low, &high);
        gsl_test(!(high == 1 && fabs(low - 1 + edge) < 1e-12), "all of %zu: %g to %g", n, low, high);
    }
    interval_of(0, false, &low, &high);
    gsl_test(!isnan(low) || !isnan(high), "no starts: %g to %g", low, high);
    size_t count[ISO_SHIFTS], found[ISO_SHIFTS];
    for (int r = 0; r < ISO_SHIFTS; r++) count[r] = 10, found[r] = 4;
    iso_share_interval(count, found, &low, &high);
    gsl_test(!(low < 0.4 - 3 / 160. && high > 0.4 + 3 / 160.), "copies that agree: %g to %g", low, high);
    found[0]++;
    iso_share_interval(count, found, &low, &high);
    gsl_test(!(low < 0.4 && high > 0.4 && high - low < 0.05), "one more: %g to %g", low, high);
}

/* Start i is the same for every number of starts; another seed gives others. */
static void check_starts(void)
{
    const iso_params p = laws_params(0.5, (double[]){1, 2, 5});
    iso_section_spread spread[2];
    double l[2], x[2], again[2];
    for (int seed = 0; seed < 2; seed++) {
        iso_section_spread_prepare(&spread[seed], iso_free_point(&p, 1), 2, (uint64_t)seed);
        spread[seed].copies = ISO_SHIFTS;
    }
    for (size_t i = 0; i < 40; i++) {
        for (int seed = 0; seed < 2; seed++) iso_section_spread_point(&spread[seed], i, &l[seed], &x[seed]);
        iso_section_spread_point(&spread[0], i, &again[0], &again[1]);
        gsl_test(l[0] != again[0] || x[0] != again[1], "start %zu is always the same", i);
        gsl_test(l[0] == l[1] || x[0] == x[1], "start %zu of two seeds", i);
    }
}

int main(void)
{
    check_edges();
    check_starts();
    check_coverage(tests_length(1000, 4000));
    return gsl_test_summary();
}

/* indicators.c - exponent, MEGNO, GALI_2 and the verdict from the turns of an orbit, see indicators.h.
 *
 * A look at N turns uses the turns from N/4 to N. Its sums grow while the turns pass. The sums of the looks at N,
 * sqrt(2) N, 2 N and 2 sqrt(2) N grow at the same time. Those of the look at 4 N begin when the look at N ends.
 */
#include "base/math_impl.h"
#include "base/names_impl.h"
#include "instrument/chaos/chaos_impl.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <string.h>

/* There is no look at fewer turns: the sums would say too little. */
static const long LEAST_TURNS = 90;

ISO_NAMES(iso_verdict_name, iso_verdict, "regular", "chaotic", "undecided", "integrable")

/* --- the sums of a look ----------------------------------------------------------------------------------------- */

/* The turns of look i: most 2^(i/2). */
static long turns_of(const iso_indicators *it, long i)
{
    const double turns = (double)it->most * exp2((double)i / 2);
    return turns < 1e15 ? (long)ceil(turns) : (long)1e15;
}

static void begin_look(iso_indicators *it, long i)
{
    iso_window *window = &it->window[(unsigned long)i % ISO_WINDOWS];
    memset(window, 0, sizeof *window);
    window->last = turns_of(it, i);
    window->first = window->last / 4;
}

/* step: ln(D_n/D_(n-1)). D_n^2 is cut off where it is so large that no polynomial will be fitted to it. */
static void add_to_window(iso_window *window, long n, double growth, double step,
                          const double observable[ISO_OBSERVABLES])
{
    static const double MOST_GROWTH = 100;
    const double turn = (double)n, last = (double)window->last;
    const double u = (turn - 0.5 - (double)window->first) / (last - (double)window->first), v = turn / last;
    const double megno = (2 * turn - 1) * step, square = exp(2 * fmin(growth, MOST_GROWTH));
    const int h = u > 0.5;
    const double w = iso_smooth_weight(h ? 2 * u - 1 : 2 * u), all = iso_smooth_weight(u);
    window->weight[h] += w;
    window->megno[h] += w * megno;
    window->growth[h] += w * growth;
    for (int i = 0; i < ISO_OBSERVABLES; i++) {
        window->observable[h][i] += w * observable[i];
        window->square[h][i] += w * observable[i] * observable[i];
    }
    window->whole += all;
    window->megno_whole += all * megno;
    window->inverse[0] += all / v;
    window->inverse[1] += all / (v * v);
    window->inverse[2] += all / v * megno;
    double term = all;
    for (int i = 0; i < 5; i++, term *= v) {
        window->power[i] += term;
        if (i < 3) window->length[i] += term * square;
    }
}

/* --- the results of a look -------------------------------------------------------------------------------------- */

/* To how many digits the means over the two halves agree. Differences are divided by the spread of the function. */
static double digits_of(const iso_window *window)
{
    static const double LEAST_SPREAD = 1e-4, ROUNDING = 1e-16;
    double largest = ROUNDING;
    for (int i = 0; i < ISO_OBSERVABLES; i++) {
        const double one = window->observable[0][i] / window->weight[0],
                     other = window->observable[1][i] / window->weight[1];
        const double spread = sqrt(fmax(0, window->square[0][i] / window->weight[0] - one * one));
        const double difference = fabs(one - other) / (spread + LEAST_SPREAD);
        if (!(difference <= largest)) largest = difference;
    }
    return -log10(largest);
}

/* The limit of MEGNO where D has grown little; NaN: not known. D_n^2 = c0 + c1 v + c2 v^2, v = n/last, by least squares
 * (Cramer's rule). The coefficients are as accurate as the smooth means, which agree to `digits`. */
static double limit_of_square(const iso_window *window, double digits)
{
    static const double FLAT = 1e-4, GROWING = 1e-3;
    const double *p = window->power, *y = window->length;
    const double m00 = p[2] * p[4] - p[3] * p[3], m01 = p[1] * p[4] - p[2] * p[3], m02 = p[1] * p[3] - p[2] * p[2],
                 m11 = p[0] * p[4] - p[2] * p[2], m12 = p[0] * p[3] - p[1] * p[2], m22 = p[0] * p[2] - p[1] * p[1];
    const double det = p[0] * m00 - p[1] * m01 + p[2] * m02;
    const double c[3] = {(m00 * y[0] - m01 * y[1] + m02 * y[2]) / det, (-m01 * y[0] + m11 * y[1] - m12 * y[2]) / det,
                         (m02 * y[0] - m12 * y[1] + m22 * y[2]) / det};
    const double size = fabs(c[0]);
    if (c[2] > fmax(GROWING, pow(10, 1 - digits)) * size && c[0] + c[1] + c[2] > 0) return 2;
    return fabs(c[1]) < FLAT * size && fabs(c[2]) < FLAT * size ? 0 : (double)NAN;
}

/* --- the exponent ----------------------------------------------------------------------------------------------- */

/* The parts after the first eighth of the turns: their number, and the gain of each sum over them. */
static int late_parts(const iso_indicators *it, int *first, double gained[1 + ISO_CLOCKS])
{
    *first = it->parts / 8;
    for (int i = 0; i <= ISO_CLOCKS; i++) gained[i] = it->sum[it->parts][i] - it->sum[*first][i];
    return it->parts - *first;
}

/* The gain of ln D per unit of clock c (-1: per turn). NaN: too few turns. */
static double rate(const iso_indicators *it, int c)
{
    int first;
    double gained[1 + ISO_CLOCKS];
    const int parts = late_parts(it, &first, gained);
    return parts < 4 ? (double)NAN : gained[0] / (c < 0 ? (double)(parts * it->part) : gained[1 + c]);
}

/* The standard error of the rate lam, from the scatter of blocks of `wide` parts each; *blocks: their number. ln D
 * also changes with the place: 1 stands for that. */
static double scatter(const iso_indicators *it, int c, double lam, int wide, int *blocks)
{
    int first;
    double gained[1 + ISO_CLOCKS], square = 0, length = 0;
    *blocks = late_parts(it, &first, gained) / wide;
    for (int i = it->parts - wide * *blocks; i < it->parts; i += wide) {
        const double *now = it->sum[i + wide], *before = it->sum[i];
        const double unit = c < 0 ? (double)(wide * it->part) : now[1 + c] - before[1 + c];
        const double rest = now[0] - before[0] - lam * unit;
        square += rest * rest;
        length += unit;
    }
    return *blocks > 1 ? sqrt(1 + square * *blocks / (*blocks - 1)) / fabs(length) : (double)NAN;
}

/* The error that is stated for a chaotic orbit. It has two parts.
 *
 * - An orbit of the sea stays near islands again and again, for times of all lengths. So neighbouring blocks are not
 *   independent, and long blocks scatter more than short ones. Blocks of 1, 2 and 4 parts are tried. The standard
 *   error from m blocks is multiplied by half of Student's quantile of 95 % for m - 1 degrees of freedom. The largest
 *   counts.
 * - Stays that are as long as the orbit do not show as scatter. So a gain g of ln D is not known better than
 *   MISSED sqrt(g).
 *
 * MISSED and LEAST_GAIN, below which no error is stated, were chosen once, by many orbits of the standard map
 * (K = 1.3 to 5) and of four seas (tests/bench/exponent.c): at every length from 300 to 20000 turns at most one orbit
 * in ten should be off by more than two errors. Near K = 1 this fails: leaky barriers divide the sea, and for very
 * long its parts have exponents of their own. */
static double error_of(const iso_indicators *it, int c, double lam)
{
    static const double MISSED = 2.5, LEAST_GAIN = 400, OUTSIDE = 0.025;
    double largest = 0;
    if (it->before < LEAST_GAIN) return NAN;
    for (int wide = 1; wide <= 4; wide *= 2) {
        int blocks;
        const double error = scatter(it, c, lam, wide, &blocks);
        largest = fmax(largest, error * gsl_cdf_tdist_Qinv(OUTSIDE, blocks - 1) / 2);
    }
    return hypot(largest, MISSED * lam / sqrt(it->before));
}

/* The exponent of a regular orbit is 0, so its estimate is its error. */
static double read_rate(const iso_indicators *it, int c, double *error)
{
    const double found = rate(it, c), lam = isfinite(found) ? found : (double)NAN; /* it may not fit a double */
    *error = it->verdict == ISO_REGULAR ? fabs(lam) : it->verdict == ISO_CHAOTIC ? error_of(it, c, lam) : (double)NAN;
    return lam;
}

/* --- the verdict ------------------------------------------------------------------------------------------------ */

/* Limits for the verdict. Two successive looks must agree, unless the digits are enough (below). `gain` is the growth
 * of ln D between the middles of the two halves, at 7/16 and 13/16 of the turns: ln(13/7) = 0.62 on a regular orbit,
 * 3/8 lam n on a chaotic one. Next to the separatrix of a resonance a regular orbit looks chaotic for a while. So ln D
 * itself must be large as well, GALI_2 small, and the exponent larger than its error. */
static const double ERRORS = 1, MOST_REGULAR_GAIN = 0.8, LEAST_CHAOTIC_GAIN = 2.5, LEAST_GAIN_BEFORE = 1.25,
                    LEAST_GROWTH = 9, MOST_AREA = 1e-4;

/* For a regular orbit: how close to 2 must be MEGNO, MEGNO of each half, and a rough limit; the least number of
 * digits. If the steps show no limit, D must grow like a polynomial. Then DIGITS_FLAT is the least number of digits;
 * DIGITS_LITTLE while ln D is below LITTLE. */
static const double MEGNO = 0.02, HALF = 0.4, ROUGHLY = 1.2, DIGITS = 0.5, DIGITS_FLAT = 7, LITTLE = 3.5,
                    DIGITS_LITTLE = 2.5;

/* A look at fewer turns does not tell a regular orbit from one that sticks to an island. A look that may be followed by
 * the verdict needs less. */
static const long LEAST_REGULAR = 180, LEAST_BEFORE = 120;

/* Digits that say more than MEGNO, which settles late near a resonance: with DIGITS_ONE_LOOK one look is enough. Two
 * looks with DIGITS_ALONE need no limit of MEGNO, which is then not known. Less is not safe: with 3 and with 5 digits
 * some orbits of the standard map at K = 0.9 are called regular that leave their islands after 10,000 turns. */
static const double DIGITS_ONE_LOOK = 5, DIGITS_ALONE = 6;

static bool is_two(double megno, double within)
{
    return fabs(megno - 2) < within;
}

static bool may_be_regular(const iso_indicators *it, const iso_window *window, long least)
{
    return it->gain < MOST_REGULAR_GAIN && it->digits >= DIGITS && window->last >= least;
}

/* within HALF: whether this look says that the orbit is regular. within ROUGHLY: whether it may be regular. */
static bool looks_regular(iso_indicators *it, const iso_window *window, double within)
{
    const double *half = it->halves;
    if (!may_be_regular(it, window, within > HALF ? LEAST_BEFORE : LEAST_REGULAR)) return false;
    if (is_two(it->limit, ROUGHLY) && is_two(half[0], within) && is_two(half[1], within)) {
        if (!is_two(it->limit, MEGNO)) it->limit = window->megno_whole / window->whole;
        return within > HALF || is_two(it->limit, MEGNO);
    }
    const bool flat = fmin(half[0], half[1]) > -ROUGHLY && fmax(half[0], half[1]) < 2 + ROUGHLY;
    if (!flat || it->digits < (it->before < LITTLE ? DIGITS_LITTLE : DIGITS_FLAT)) return false;
    it->limit = limit_of_square(window, it->digits);
    return !isnan(it->limit);
}

static bool looks_chaotic(const iso_indicators *it)
{
    const bool gains = it->gain > LEAST_CHAOTIC_GAIN && it->gain_before > LEAST_GAIN_BEFORE;
    if (it->integrable || !(gains && it->before > LEAST_GROWTH && it->area < MOST_AREA)) return false;
    int parts;
    const double exponent = rate(it, -1);
    return exponent > ERRORS * scatter(it, -1, exponent, 1, &parts);
}

static void look(iso_indicators *it, const iso_window *window)
{
    const bool before = it->looked_regular, smooth_before = it->looked_smooth;
    /* 2 (n - 1/2) ln(D_n/D_(n-1)) = limit + A/n by least squares */
    const double w = window->whole, x = window->inverse[0] / w, y = window->megno_whole / w;
    const double slope = (window->inverse[2] / w - x * y) / (window->inverse[1] / w - x * x);
    it->gain_before = it->gain;
    it->digits = digits_of(window);
    it->limit = y - slope * x;
    it->gain = window->growth[1] / window->weight[1] - window->growth[0] / window->weight[0];
    for (int h = 0; h < 2; h++) it->halves[h] = window->megno[h] / window->weight[h];
    const bool regular = (before || it->digits >= DIGITS_ONE_LOOK) && looks_regular(it, window, HALF);
    it->looked_regular = regular || looks_regular(it, window, ROUGHLY);
    it->looked_smooth = it->digits >= DIGITS_ALONE && may_be_regular(it, window, LEAST_REGULAR);
    if (it->verdict != ISO_UNDECIDED) return;
    if (regular || (smooth_before && it->looked_smooth))
        it->verdict = ISO_REGULAR, it->megno = regular ? it->limit : NAN;
    if (looks_chaotic(it)) it->verdict = ISO_CHAOTIC;
    if (it->verdict != ISO_UNDECIDED) it->decided = it->turns;
}

/* --- turns ------------------------------------------------------------------------------------------------------ */

void iso_indicators_begin(iso_indicators *it, long most)
{
    memset(it, 0, sizeof *it);
    it->most = most;
    while (turns_of(it, it->number - 1) >= LEAST_TURNS) it->number--;
    for (int i = 0; i < ISO_WINDOWS; i++) begin_look(it, it->number + i);
    it->area = 1;
    it->part = 1;
    it->verdict = ISO_UNDECIDED;
    it->limit = it->digits = it->gain = it->gain_before = NAN;
}

void iso_indicators_add(iso_indicators *it, const iso_turn_sample *turn)
{
    const double larger = fmax(turn->growth[0], turn->growth[1]), smaller = fmin(turn->growth[0], turn->growth[1]);
    const double growth = larger + log1p(exp(2 * (smaller - larger))) / 2 - log(2) / 2; /* ln D_n */
    const double step = growth - it->before;
    const long n = ++it->turns;
    it->before = it->now[0] = growth;
    memcpy(it->now + 1, turn->clock, sizeof turn->clock);
    it->area = turn->area;
    it->step_sum += ((double)n - 0.5) * step;
    it->mean_sum += 2 * it->step_sum / (double)n;
    if (n % it->part == 0) { /* the end of a part; when there is no more room, every two parts become one */
        if (it->parts == ISO_PARTS) {
            for (int i = 1; i <= ISO_PARTS / 2; i++) memcpy(it->sum[i], it->sum[2 * i], sizeof it->sum[i]);
            it->parts /= 2;
            it->part *= 2;
        }
        if (n % it->part == 0) memcpy(it->sum[++it->parts], it->now, sizeof it->now);
    }
    for (int i = 0; i < ISO_WINDOWS; i++)
        if (n > it->window[i].first && n <= it->window[i].last)
            add_to_window(&it->window[i], n, growth, step, turn->observable);
    iso_window *window = &it->window[(unsigned long)it->number % ISO_WINDOWS];
    if (n < window->last) return;
    look(it, window);
    begin_look(it, it->number++ + ISO_WINDOWS);
}

long iso_indicators_next(const iso_indicators *it)
{
    return it->window[(unsigned long)it->number % ISO_WINDOWS].last;
}

iso_verdict iso_indicators_verdict(const iso_indicators *it)
{
    return (iso_verdict)it->verdict;
}

void iso_indicators_read(const iso_indicators *it, iso_indication *result)
{
    const double n = (double)it->turns;
    *result = (iso_indication){.verdict = iso_indicators_verdict(it)};
    result->turns = it->decided > 0 ? it->decided : it->turns;
    result->exponent_turns = it->turns;
    result->per_turn = read_rate(it, -1, &result->per_turn_error);
    for (int c = 0; c < ISO_CLOCKS; c++) result->exponent[c] = read_rate(it, c, &result->error[c]);
    result->megno_now = n > 0 ? 2 * it->step_sum / n : NAN;
    result->megno_mean = n > 0 ? it->mean_sum / n : NAN;
    result->megno = result->verdict == ISO_REGULAR && !isnan(it->megno) ? it->megno : result->megno_mean;
    result->gali2 = n > 0 ? it->area : NAN;
    result->digits = it->digits;
}

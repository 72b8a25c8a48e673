/* How often the error of an exponent (lib/instrument/chaos/indicators.h) covers: many orbits of one chaotic sea,
 * against the mean of all of them over a long time.
 *
 *     bench_exponent [ORBITS] [TURNS] [SEED]      orbits that begin on the section (default 150), turns of each
 *                                                 (default 32000)
 *
 * The sea's exponent is the mean over the second half of the turns of all chaotic orbits. Orbits that then have less
 * than half of the median belong to another sea, and are left out. For each length: the scatter of the exponents
 * about that of the sea, the mean error that is stated, and how many of the orbits are off by more than two and three
 * errors, in turns and in t; how many state no error.
 */
#include "bench.h"
#include "instrument/chaos/chaos.h"
#include "instrument/chaos/chaos_impl.h"

enum { EACH = 250, LENGTHS = 16 };

typedef struct sea {
    double k, J[3];
} sea;

static const sea seas[] = {{0.5, {1, 2, 5}}, {-0.5, {1, 2, 5}}, {0.3, {1.4, 2.1, 3}}, {0.3, {1, 2, 5}}};

typedef struct work {
    size_t count;
    long turns;
    int lengths;
    long length[LENGTHS];
    iso_batch_orbit *orbit;
    iso_start *start;
    iso_indicators *shown;
    iso_crossing *found, *half; /* half: at turns/2 */
    size_t *done;
    iso_status *status;
    bool *wanted;
    iso_indication *result; /* [length][orbit] */
} work;

static void add(work *w, size_t i, const iso_crossing *c)
{
    iso_indicators *shown = &w->shown[i];
    iso_turn_sample turn = {.area = c->area, .observable = {NAN, NAN, NAN}};
    for (int n = 0; n < ISO_CLOCKS; n++) turn.clock[n] = c->clock[n];
    for (int n = 0; n < ISO_DEVIATIONS; n++) turn.growth[n] = c->growth[n];
    iso_indicators_add(shown, &turn);
    for (int n = 0; n < w->lengths; n++)
        if (shown->turns == w->length[n]) iso_indicators_read(shown, &w->result[(size_t)n * w->count + i]);
    if (shown->turns == w->turns / 2) w->half[i] = *c;
}

/* Orbits that are not chaotic after 4000 turns end. */
static void follow(iso_context *ctx, const sea *s, uint64_t seed, work *w)
{
    const iso_params p = bench_params(ctx, s->k, s->J);
    iso_crossings_options o = iso_crossings_defaults();
    iso_crossings *crossings;
    iso_section_spread spread;
    const int axis = iso_section_axis(iso_free_point(&p, 1));
    iso_section_spread_prepare(&spread, iso_free_point(&p, 1), axis, seed);
    for (size_t i = 0; i < w->count; i++) {
        double l, x;
        iso_section_spread_point(&spread, i, &l, &x);
        w->start[i] = bench_section_start(&p, l, x);
        w->orbit[i] = (iso_batch_orbit){&p, &w->start[i], NULL};
        iso_indicators_begin(&w->shown[i], 3000);
        w->wanted[i] = true;
    }
    o.backend = ISO_BACKEND_POINT;
    o.deviations = true;
    bench_must(ctx, iso_crossings_create(ctx, w->orbit, w->count, &o, &crossings));
    for (long turn = 0; turn < w->turns; turn += EACH) {
        bench_must(ctx, iso_crossings_go(crossings, w->wanted, EACH, w->found, NULL, w->done, w->status));
        for (size_t i = 0; i < w->count; i++) {
            if (!w->wanted[i]) continue;
            for (size_t j = 0; j < EACH; j++) add(w, i, &w->found[EACH * i + j]);
            w->wanted[i] = turn < 4000 || iso_indicators_verdict(&w->shown[i]) == ISO_CHAOTIC;
        }
    }
    iso_crossings_free(crossings);
}

/* Of the second half of orbit i: its exponent per turn, or per t. */
static double late_rate(const work *w, size_t i, bool t)
{
    const double *now = w->shown[i].now;
    const iso_crossing *h = &w->half[i];
    const double before = fmax(h->growth[0], h->growth[1]);
    return (now[0] - before) / (t ? now[1] - h->clock[ISO_CLOCK_T] : (double)(w->turns - w->turns / 2));
}

/* The exponent of the sea, and its standard error. Takes the orbits of other seas out of `wanted`. */
static double find_sea(work *w, bool t, double *error)
{
    double *rate = calloc(w->count, sizeof *rate), sum = 0, square = 0;
    size_t n = 0;
    for (size_t i = 0; i < w->count; i++)
        if (w->wanted[i]) rate[n++] = late_rate(w, i, t);
    const double median = n > 0 ? bench_median(rate, n) : NAN;
    free(rate);
    n = 0;
    for (size_t i = 0; i < w->count; i++) {
        const double one = late_rate(w, i, t);
        w->wanted[i] = w->wanted[i] && one > median / 2;
        if (!w->wanted[i]) continue;
        n++;
        sum += one;
        square += (one - median) * (one - median);
    }
    *error = sqrt(square) / (double)n;
    return sum / (double)n;
}

static void print(const work *w, int length, bool t, double truth)
{
    size_t stated = 0, none = 0, two = 0, three = 0;
    double square = 0, mean = 0, worst = 0;
    for (size_t i = 0; i < w->count; i++) {
        const iso_indication *result = &w->result[(size_t)length * w->count + i];
        const double x = t ? result->exponent[ISO_CLOCK_T] : result->per_turn,
                     error = t ? result->error[ISO_CLOCK_T] : result->per_turn_error, off = fabs(x - truth);
        if (!w->wanted[i]) continue;
        if (isnan(error)) {
            none++;
            continue;
        }
        stated++;
        square += off * off;
        mean += error;
        two += off > 2 * error;
        three += off > 3 * error;
        worst = fmax(worst, off / error);
    }
    const double n = (double)stated;
    printf("  %-4s %6ld turns | scatter %8.5f, error %8.5f | of %3zu beyond 2: %4.1f %%, 3: %4.1f %%, worst %5.1f | "
           "none: %zu\n",
           t ? "t" : "turn", w->length[length], sqrt(square / n), mean / n, stated, 100 * (double)two / n,
           100 * (double)three / n, worst, none);
    fflush(stdout);
}

int main(int argc, char **argv)
{
    work w = {.count = argc > 1 ? strtoul(argv[1], NULL, 10) : 150};
    w.turns = argc > 2 ? strtol(argv[2], NULL, 10) : 32000;
    const uint64_t seed = argc > 3 ? strtoull(argv[3], NULL, 10) : 1;
    iso_context *ctx = iso_context_create();
    if (!ctx || w.count == 0 || w.turns < EACH || w.turns % EACH != 0) return 2;
    for (long n = 500; n <= w.turns / 2 && w.lengths < LENGTHS; n *= 2) w.length[w.lengths++] = n;
    w.orbit = calloc(w.count, sizeof *w.orbit);
    w.start = calloc(w.count, sizeof *w.start);
    w.shown = calloc(w.count, sizeof *w.shown);
    w.found = calloc(w.count * EACH, sizeof *w.found);
    w.half = calloc(w.count, sizeof *w.half);
    w.done = calloc(w.count, sizeof *w.done);
    w.status = calloc(w.count, sizeof *w.status);
    w.wanted = calloc(w.count, sizeof *w.wanted);
    w.result = calloc(w.count * LENGTHS, sizeof *w.result);
    for (size_t s = 0; s < sizeof seas / sizeof *seas; s++) {
        follow(ctx, &seas[s], seed, &w);
        for (int t = 0; t < 2; t++) {
            double error;
            const double truth = find_sea(&w, t, &error);
            printf("k = %g, J = %g %g %g: the sea's exponent per %s %.5f +- %.5f\n", seas[s].k, seas[s].J[0],
                   seas[s].J[1], seas[s].J[2], t ? "t" : "turn", truth, error);
            for (int n = 0; n < w.lengths; n++) print(&w, n, t, truth);
        }
    }
    free(w.orbit), free(w.start), free(w.shown), free(w.found), free(w.half);
    free(w.done), free(w.status), free(w.wanted), free(w.result);
    iso_context_free(ctx);
    return 0;
}

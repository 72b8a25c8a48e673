/* How often the interval of `isoroll chaos --starts` holds the share: the same run with other seeds.
 *
 *     bench_share [RUNS] [STARTS] [TURNS] [TRUTH]      runs of each row (default 200), starts of each (default 100), turns of
 *                                                      each orbit (default 300), starts of the share that counts as
 *                                                      true (default 200000; 0: those of all the runs)
 *
 * Orbits are followed by the point. In so few turns many orbits stay undecided. So two intervals are counted: that of
 * the orbits that are called chaotic, for their share; and the one that is printed, with the undecided counted both
 * ways, which is wider.
 */
#include "bench.h"
#include "instrument/chaos/chaos.h"
#include "instrument/chaos/chaos_impl.h"

typedef struct motion {
    double k, J[3];
} motion;

static const motion motions[] = {{0.5, {1, 2, 5}}, {0.5, {1.4, 2.1, 3}}, {-0.5, {1, 2, 5}}};

typedef struct answer {
    double share, undecided, low, high; /* of the orbits called chaotic */
    double printed[2];                  /* low and high                 */
} answer;

static answer ask(iso_context *ctx, const motion *m, size_t starts, long turns, uint64_t seed)
{
    iso_scene scene = iso_scene_default();
    iso_chaos_options o = iso_chaos_defaults();
    iso_chaos *c;
    size_t count[ISO_SHIFTS] = {0}, chaotic[ISO_SHIFTS] = {0};
    scene.params = bench_params(ctx, m->k, m->J);
    scene.start = bench_start(ctx);
    o.starts = starts;
    o.turns = turns;
    o.seed = seed;
    o.models = ISO_SHOW_POINT;
    bench_must(ctx, iso_chaos_run(ctx, &scene, &o, &c));
    const iso_chaos_fraction *s = &c->share;
    answer a = {s->share, (double)s->undecided / (double)s->count, 0, 0, {s->low, s->high}};
    for (size_t i = 0; i < c->starts; i++) {
        if (!iso_chaos_followed(&c->start[i])) continue;
        count[i % ISO_SHIFTS]++;
        chaotic[i % ISO_SHIFTS] += c->start[i].verdict == ISO_CHAOTIC;
    }
    iso_share_interval(count, chaotic, &a.low, &a.high);
    iso_chaos_free(c);
    return a;
}

int main(int argc, char **argv)
{
    const size_t runs = argc > 1 ? strtoul(argv[1], NULL, 10) : 200,
                 starts = argc > 2 ? strtoul(argv[2], NULL, 10) : 100,
                 truth = argc > 4 ? strtoul(argv[4], NULL, 10) : 200000;
    const long turns = argc > 3 ? strtol(argv[3], NULL, 10) : 300;
    iso_context *ctx = iso_context_create();
    answer *of = calloc(runs + 1, sizeof *of);
    if (!ctx || !of || runs < 2 || starts == 0 || turns < 1) return 2;
    for (size_t i = 0; i < sizeof motions / sizeof *motions; i++) {
        const motion *m = &motions[i];
        double mean = 0, undecided = 0, width = 0, square = 0;
        size_t within = 0, printed = 0;
        for (size_t n = 0; n < runs; n++) {
            of[n] = ask(ctx, m, starts, turns, n + 1);
            mean += of[n].share / (double)runs;
            undecided += of[n].undecided / (double)runs;
        }
        const double share = truth > 0 ? ask(ctx, m, truth, turns, 0).share : mean;
        for (size_t n = 0; n < runs; n++) {
            within += of[n].low <= share && share <= of[n].high;
            printed += of[n].printed[0] <= share && share <= of[n].printed[1];
            width += (of[n].high - of[n].low) / (double)runs;
            square += (of[n].share - share) * (of[n].share - share);
        }
        printf(
            "k = %g, J = %g %g %g: share %.5f, undecided %.3f; runs scatter by %.4f; intervals of width %.4f hold it "
            "in %.1f %%, the printed ones in %.1f %%\n",
            m->k, m->J[0], m->J[1], m->J[2], share, undecided, sqrt(square / (double)runs), width,
            100 * (double)within / (double)runs, 100 * (double)printed / (double)runs);
        fflush(stdout);
    }
    free(of);
    iso_context_free(ctx);
    return 0;
}

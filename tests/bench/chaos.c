/* Calibration of the verdicts of lib/instrument/chaos/chaos.h, on orbits that are known to be regular or chaotic.
 *
 *     bench_chaos [ORBITS] [TURNS] [ROWS]        orbits of each row (default 300), turns of each (default 3000);
 *                                                rows: all, integrable, others
 *
 * Regular orbits have an additional integral: k = 1, k = -1, two or three equal moments. They are spread over the
 * section, or next to the separatrix, at distances of 1e-3 to 1e-6 of F. Chaotic orbits are those of k = 0.5, 0.3 and
 * -0.5 whose deviations grow by exp(60) within five times as many turns. This is found by a separate run of the
 * point, without the indicators.
 */
#include <string.h>

#include "base/math_impl.h"
#include "base/random_impl.h"
#include "bench.h"
#include "instrument/chaos/chaos.h"

typedef struct family {
    double k, J[3];
    bool integrable, near; /* near: next to the separatrix */
} family;

static const family families[] = {
    {1, {1.4, 2.1, 3}, true, false},     {1, {1.4, 2.1, 3}, true, true},     {-1, {1.4, 2.1, 3}, true, false},
    {-1, {1.4, 2.1, 3}, true, true},     {1, {1, 2, 5}, true, false},        {1, {1, 2, 5}, true, true},
    {-1, {1, 2, 5}, true, false},        {-1, {1, 2, 5}, true, true},        {0.5, {2, 2, 5}, true, false},
    {-0.5, {1, 4, 4}, true, false},      {0.3, {3, 3, 3}, true, false},      {0.5, {1.4, 2.1, 3}, false, false},
    {0.5, {1, 2, 5}, false, false},      {0.3, {1.4, 2.1, 3}, false, false}, {0.3, {1, 2, 5}, false, false},
    {-0.5, {1.4, 2.1, 3}, false, false}, {-0.5, {1, 2, 5}, false, false},
};

typedef struct counts {
    size_t verdict[2][3]; /* of truly regular, truly chaotic orbits */
    size_t disagree, failed, off;
    double turns[2];
} counts;

/* Points around the saddle, the rotation about the middle axis. F differs from that of the separatrix by about the
 * square of the distance. */
static void place(const iso_params *p, size_t count, double at[][2], iso_random *r)
{
    const int axis = iso_section_axis(iso_free_point(p, 1)), b = (axis + 1) % 3, c = (axis + 2) % 3;
    const double *J = p->J;
    const int middle = (J[b] - J[axis]) * (J[b] - J[c]) < 0 ? b : c;
    for (size_t i = 0; i < count; i++) {
        const double distance = pow(10, iso_random_uniform(r, -3, -1.5)), phi = iso_random_uniform(r, 0, 2 * ISO_PI);
        at[i][0] = (middle == b ? ISO_PI / 2 : 0) + distance * cos(phi);
        at[i][1] = distance * sin(phi);
    }
}

/* Whether the deviations of each orbit grow by exp(60) within `turns`. */
static void find_truth(iso_context *ctx, const family *f, const iso_chaos *c, long turns, bool chaotic[])
{
    enum { EACH = 500 };
    const size_t n = c->starts;
    const iso_params p = bench_params(ctx, f->k, f->J);
    iso_crossings_options o = iso_crossings_defaults();
    iso_crossings *crossings;
    iso_start *start = calloc(n, sizeof *start);
    iso_batch_orbit *orbit = calloc(n, sizeof *orbit);
    iso_crossing *found = malloc(n * EACH * sizeof *found);
    size_t *done = calloc(n, sizeof *done);
    iso_status *status = calloc(n, sizeof *status);
    bool *wanted = calloc(n, sizeof *wanted);
    for (size_t i = 0; i < n; i++) {
        start[i] = bench_section_start(&p, c->start[i].l, c->start[i].x);
        orbit[i] = (iso_batch_orbit){&p, &start[i], NULL};
        wanted[i] = !(chaotic[i] = false);
    }
    o.backend = ISO_BACKEND_POINT;
    o.deviations = true;
    o.axis = c->axis;
    bench_must(ctx, iso_crossings_create(ctx, orbit, n, &o, &crossings));
    for (long turn = 0; turn < turns; turn += EACH) {
        bench_must(ctx, iso_crossings_go(crossings, wanted, EACH, found, NULL, done, status));
        for (size_t i = 0; i < n; i++) {
            if (!wanted[i]) continue;
            const double *growth = found[EACH * i + EACH - 1].growth;
            chaotic[i] = fmax(growth[0], growth[1]) > 60;
            wanted[i] = !chaotic[i];
        }
    }
    iso_crossings_free(crossings);
    free(start), free(orbit), free(found), free(done), free(status), free(wanted);
}

static void measure(iso_context *ctx, const family *f, size_t count, long turns, iso_random *r, counts *out)
{
    iso_scene scene = iso_scene_default();
    iso_chaos_options o = iso_chaos_defaults();
    iso_chaos *c;
    double(*at)[2] = calloc(count, sizeof *at);
    bool *chaotic = calloc(count, sizeof *chaotic);
    scene.params = bench_params(ctx, f->k, f->J);
    scene.start = bench_start(ctx);
    o.turns = turns;
    o.models = ISO_SHOW_BOTH;
    o.starts = f->near ? 0 : count;
    o.at = (const double(*)[2])at;
    o.at_count = f->near ? count : 0;
    if (f->near) place(&scene.params, count, at, r);
    bench_must(ctx, iso_chaos_run(ctx, &scene, &o, &c));
    if (!f->integrable) find_truth(ctx, f, c, 5 * turns, chaotic);
    for (size_t i = 0; i < c->starts; i++) {
        const iso_chaos_orbit *one = &c->start[i];
        out->verdict[chaotic[i]][one->verdict]++;
        out->disagree += one->disagree;
        out->failed += one->status[0] != ISO_OK || one->status[1] != ISO_OK;
        for (int m = 0; m < 2; m++) {
            const double megno = one->result[m].megno;
            out->turns[m] += (double)one->result[m].turns / (double)count;
            const bool known = megno != one->result[m].megno_mean; /* the limit of MEGNO */
            out->off +=
                one->result[m].verdict == ISO_REGULAR && known && fabs(megno - 2) > 0.02 && fabs(megno) > 0.02;
        }
    }
    iso_chaos_free(c);
    free(at);
    free(chaotic);
}

static void print(const char *what, const counts *c)
{
    printf("%-34s | %6zu %6zu %6zu | %6zu %6zu %6zu | %4zu %4zu %4zu | %5.0f %5.0f\n", what,
           c->verdict[0][ISO_REGULAR], c->verdict[0][ISO_UNDECIDED], c->verdict[0][ISO_CHAOTIC],
           c->verdict[1][ISO_REGULAR], c->verdict[1][ISO_UNDECIDED], c->verdict[1][ISO_CHAOTIC], c->disagree,
           c->failed, c->off, c->turns[0], c->turns[1]);
    fflush(stdout);
}

int main(int argc, char **argv)
{
    const size_t count = argc > 1 ? strtoul(argv[1], NULL, 10) : 300;
    const long turns = argc > 2 ? strtol(argv[2], NULL, 10) : 3000;
    const char *rows = argc > 3 ? argv[3] : "all";
    iso_context *ctx = iso_context_create();
    iso_random *r = iso_random_create(7);
    counts sum = {.disagree = 0};
    if (!ctx || !r || count == 0 || turns < 1) return 2;
    printf("%-34s | %20s | %20s | %14s | %11s\n%-34s | %6s %6s %6s | %6s %6s %6s | %4s %4s %4s | %5s %5s\n", "",
           "truly regular", "truly chaotic", "", "mean turns", "k; J", "reg", "und", "chaos", "reg", "und", "chaos",
           "diff", "fail", "off", "ball", "point");
    for (size_t i = 0; i < sizeof families / sizeof *families; i++) {
        const family *f = &families[i];
        if (strcmp(rows, f->integrable ? "others" : "integrable") == 0) continue;
        char what[128];
        counts c = {.disagree = 0};
        measure(ctx, f, count, turns, r, &c);
        snprintf(what, sizeof what, "%g; %g %g %g%s", f->k, f->J[0], f->J[1], f->J[2],
                 f->near ? ", near separatrix" : "");
        print(what, &c);
        for (int truth = 0; truth < 2; truth++)
            for (int v = 0; v < 3; v++) sum.verdict[truth][v] += c.verdict[truth][v];
        sum.disagree += c.disagree;
        sum.failed += c.failed;
        sum.off += c.off;
    }
    print("all", &sum);
    iso_random_free(r);
    iso_context_free(ctx);
    return 0;
}

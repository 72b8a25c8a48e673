/* Thousands of balls at once: on which spheres do they roll chaotically?
 *
 *     cc main.c $(pkg-config --cflags --libs isoroll) -Wl,-rpath,$(pkg-config --variable=libdir isoroll) -lm -o chaos
 *     ./chaos
 *
 * For each k, 200 pairs of balls start with energy h = 1. The two balls of a pair differ by 1e-10 in the direction of
 * their angular velocity. At t = 1000, after some 200 turns, a pair on a regular orbit is about a thousand times
 * farther apart; a pair on a chaotic orbit can be anywhere. Pairs farther apart than 1e-5 are counted. There are none
 * where the problem is integrable: on a plane (k = 1), and for a shell around a ball half its size (k = -1).
 */
#include <math.h>
#include <stdio.h>

#include <isoroll/isoroll.h>
#include <isoroll/map/state.h>

enum { PAIRS = 200, BALLS = 2 * PAIRS };

/* The chaotic ones among PAIRS random orbits; -1: failed. */
static int chaotic(iso_context *ctx, double k)
{
    static const double J[3] = {1, 2, 5}, end = 1000;
    static iso_start starts[BALLS];
    static iso_batch_orbit orbits[BALLS];
    static iso_sample samples[BALLS];
    iso_params p;
    if (iso_params_reduced(ctx, k, J, &p) != ISO_OK) return -1;
    iso_problem problem = {.p = p};
    iso_random *random = iso_random_create(1);
    for (int i = 0; random && i < BALLS; i += 2) {
        iso_start *one = &starts[i], *other = &starts[i + 1];
        one->model = ISO_BALL;
        iso_system_at(ISO_BALL)->sample(&problem, random, one->y);
        const double scale = sqrt(1 / iso_ball_energy(&p, one->y));
        for (int c = 0; c < 3; c++) one->y[c] *= scale;
        *other = *one;
        const double *w = one->y, *n = one->y + 3;
        for (int c = 0; c < 3; c++) {
            const int d = (c + 1) % 3, e = (c + 2) % 3;
            other->y[c] += 1e-10 * (n[d] * w[e] - n[e] * w[d]);
        }
        orbits[i] = (iso_batch_orbit){&p, one, NULL};
        orbits[i + 1] = (iso_batch_orbit){&p, other, NULL};
    }
    iso_random_free(random);
    iso_batch_options options = iso_batch_defaults();
    options.tolerance = 1e-14;
    if (!random || iso_batch_run(ctx, orbits, BALLS, &options, &end, 1, samples, NULL) != ISO_OK) return -1;
    int count = 0;
    for (int i = 0; i < BALLS; i += 2) {
        const double *a = samples[i].ball + 3, *b = samples[i + 1].ball + 3;
        count += hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]) > 1e-5;
    }
    return count;
}

int main(void)
{
    static const double ks[] = {-1, -0.4, -0.25, 0.2, 0.3, 0.5, 2. / 3, 0.75, 1, 1.5};
    int lanes, wrong = 0;
    const char *vectors = iso_batch_vectors(0, &lanes);
    iso_context *ctx = iso_context_create();
    printf("J = (1, 2, 5); %d orbits at a time (%s)\n%8s   chaotic of %d\n", lanes, vectors, "k", PAIRS);
    for (size_t i = 0; ctx && i < sizeof ks / sizeof *ks; i++) {
        const int count = chaotic(ctx, ks[i]);
        if (count < 0) return fprintf(stderr, "chaos: %s\n", iso_context_message(ctx)), 1;
        printf("%8.3g   %d\n", ks[i], count);
        wrong += ks[i] == 1 || ks[i] == -1 ? count > 0 : 0;
    }
    iso_context_free(ctx);
    return ctx && wrong == 0 ? 0 : 1;
}

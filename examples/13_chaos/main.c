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
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <isoroll/isoroll.h>

enum { PAIRS = 200, BALLS = 2 * PAIRS };

static const char text[] = "reduced: {k: 1, J: [1, 2, 5]}\n"
                           "initial: {normal: [0, 0, 1], angular_velocity: [1, 0, 0]}\n"
                           "time: {end: 1000}\n"
                           "solver: {tolerance: 1e-14}\n"
                           "output: {columns: [n1, n2, n3]}\n";

/* A random number in (-1, 1). */
static double dice(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return 2 * (double)(*state >> 11) / 9007199254740992.0 - 1;
}

/* A random unit vector. */
static void direction(uint64_t *state, double v[3])
{
    double size;
    do {
        for (int i = 0; i < 3; i++) v[i] = dice(state);
        size = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    } while (size > 1 || size < 0.1);
    for (int i = 0; i < 3; i++) v[i] /= size;
}

/* A random start omega, n with (omega, n) = 0 and energy 1, and one beside it. */
static void draw_pair(const iso_scene *scene, uint64_t *state, double one[6], double other[6])
{
    double *w = one, *n = one + 3, along;
    direction(state, n);
    direction(state, w);
    along = w[0] * n[0] + w[1] * n[1] + w[2] * n[2];
    for (int i = 0; i < 3; i++) w[i] -= along * n[i];
    const double scale = sqrt(1 / iso_scene_energy(scene, one));
    for (int i = 0; i < 3; i++) w[i] *= scale;
    memcpy(other, one, 6 * sizeof *one);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        other[i] += 1e-10 * (n[j] * w[k] - n[k] * w[j]);
    }
}

/* The chaotic ones among PAIRS random orbits; -1: failed. */
static int chaotic(iso_context *ctx, const iso_scene *scene, double k)
{
    static const double end = 1000;
    static double starts[BALLS][6], ks[BALLS], n[BALLS][3];
    uint64_t state = 1;
    int count = 0;
    for (int i = 0; i < BALLS; i++) ks[i] = k;
    for (int i = 0; i < BALLS; i += 2) draw_pair(scene, &state, starts[i], starts[i + 1]);
    if (iso_batch(ctx, &scene, 1, BALLS, ks, NULL, starts[0], &end, 1, 0, NULL, n[0], NULL) != ISO_OK) return -1;
    for (int i = 0; i < BALLS; i += 2)
        count += hypot(hypot(n[i][0] - n[i + 1][0], n[i][1] - n[i + 1][1]), n[i][2] - n[i + 1][2]) > 1e-5;
    return count;
}

int main(void)
{
    static const double ks[] = {-1, -0.4, -0.25, 0.2, 0.3, 0.5, 2. / 3, 0.75, 1, 1.5};
    iso_context *ctx = iso_context_create();
    iso_scene *scene = NULL;
    int wrong = 0;
    if (!ctx || iso_scene_parse(ctx, "ball", text, strlen(text), &scene))
        return fprintf(stderr, "chaos: %s\n", ctx ? iso_context_message(ctx) : "no memory"), 1;
    printf("J = (1, 2, 5)\n%8s   chaotic of %d\n", "k", PAIRS);
    for (size_t i = 0; i < sizeof ks / sizeof *ks; i++) {
        const int count = chaotic(ctx, scene, ks[i]);
        if (count < 0) return fprintf(stderr, "chaos: %s\n", iso_context_message(ctx)), 1;
        printf("%8.3g   %d\n", ks[i], count);
        wrong += ks[i] == 1 || ks[i] == -1 ? count > 0 : 0;
    }
    iso_scene_free(scene);
    iso_context_free(ctx);
    return wrong == 0 ? 0 : 1;
}

/* batches.h - pools of random and of odd orbits, and how the tests run them as a batch. */
#ifndef ISO_TESTS_BATCHES_H
#define ISO_TESTS_BATCHES_H

#include "base/random_impl.h"
#include "effects.h"
#include "model/model_impl.h"
#include "orbit/batch.h"
#include "orbits.h"

enum { BATCH_ORBITS = 66, BATCH_ROWS = 8 };

typedef struct batch_pool {
    int count;
    iso_params p[BATCH_ORBITS];
    iso_start start[BATCH_ORBITS];
    iso_effects effects[BATCH_ORBITS];
    iso_batch_orbit orbit[BATCH_ORBITS];
} batch_pool;

static const iso_start batch_usual = {.model = ISO_BALL, .y = {0.9, -0.3, -0.225, 0.36, 0.48, 0.8}};

static inline iso_start batch_start(double w1, double w2, double w3, double n1, double n2, double n3)
{
    return (iso_start){.model = ISO_BALL, .y = {w1, w2, w3, n1, n2, n3}};
}

static inline void batch_add(batch_pool *all, iso_params p, iso_start start, const iso_effects *effects)
{
    const int i = all->count++;
    all->p[i] = p;
    all->start[i] = start;
    if (effects) all->effects[i] = *effects;
    all->orbit[i] = (iso_batch_orbit){&all->p[i], &all->start[i], effects ? &all->effects[i] : NULL};
}

/* A random orbit that turns by about a radian while `clock` goes on by 1/speed; moments of inertia of size J_unit. */
static inline void batch_add_random(batch_pool *all, iso_random *dice, double k, const double J[3], double J_unit,
                                    double speed, iso_clock clock, int subset)
{
    const double scaled[3] = {J[0] * J_unit, J[1] * J_unit, J[2] * J_unit};
    const iso_params p = effects_params(k, scaled, dice);
    iso_problem f = {.p = p};
    iso_start start = {.model = ISO_BALL};
    laws_sample(&iso_system_ball, &f, dice, start.y);
    const double q = iso_system_ball.q(&p, start.y, NULL);
    scale(start.y, speed * iso_clock_rate(&p, clock, q, NULL) / fmax(1, fabs(k)) / laws_norm(start.y));
    const iso_effects e = effects_random(dice, &p, subset, iso_ball_energy(&p, start.y), laws_norm(start.y), q);
    batch_add(all, p, start, subset ? &e : NULL);
}

/* The samples of a batch. The caller frees them. The status of the batch goes to *all. */
static inline iso_sample *batch_run(iso_context *ctx, const iso_batch_orbit orbits[], int count,
                                    const iso_batch_options *o, const double times[], int rows, iso_status status[],
                                    iso_status *all)
{
    iso_sample *samples = malloc(((size_t)count * (size_t)rows + 1) * sizeof *samples);
    if (!samples) exit(1);
    *all = iso_batch_run(ctx, orbits, (size_t)count, o, times, (size_t)rows, samples, status);
    return samples;
}

/* Neighbours of every kind: in principal planes with zeros of both signs, stiff, at rest, refused, and so fast that
 * the series has no numbers. */
static inline void batch_add_odd(batch_pool *all, iso_context *ctx, int i, const iso_params *p)
{
    static iso_effects stiff = {.on[ISO_TWIST] = true, .number[ISO_TWIST] = {1e6}},
                       wrong = {.on[ISO_GRAVITY] = true, .number[ISO_GRAVITY] = {NAN}};
    iso_params loose = laws_params(0.5, p->J);
    iso_params_set_D(ctx, 0.5 * min3(p->J), &loose);
    switch (i % 8) {
    case 0: batch_add(all, *p, batch_start(0.0, -0.0, -0.7, 0.6, 0.8, -0.0), NULL); return;
    case 1: batch_add(all, *p, batch_start(-0.0, 0.0, 0.7, -0.6, 0.8, 0.0), NULL); return;
    case 2: batch_add(all, *p, batch_start(0.9, -0.0, 0.0, -0.0, 0.0, -1), NULL); return;
    case 3: batch_add(all, loose, batch_usual, &stiff); return;
    case 4: batch_add(all, *p, batch_start(0, 0, 0, 0.36, 0.48, 0.8), NULL); return;
    case 5: batch_add(all, *p, batch_usual, &wrong); return;
    case 6: batch_add(all, laws_params(1e12, p->J), batch_usual, NULL); return;
    default: batch_add(all, *p, batch_start(NAN, 0, 0, 0, 0, 1), NULL); return;
    }
}

/* Random orbits in random effects, each third place an odd one. */
static inline void batch_fill(batch_pool *all, iso_context *ctx, iso_random *dice)
{
    static const double J[][3] = {{1.4, 2.1, 3.0}, {3.0, 1.4, 2.1}, {2, 2, 3}};
    static const double ks[] = {1, -1, 0.5, -0.4, 0.3};
    all->count = 0;
    for (int i = 0; i < BATCH_ORBITS; i++) {
        const double k = ks[i % 5], *own = J[i / 5 % 3];
        if (i % 3 == 2) {
            const iso_params p = laws_params(k, own);
            batch_add_odd(all, ctx, i / 3, &p);
        } else
            batch_add_random(all, dice, k, own, 1, 1, ISO_CLOCK_T,
                             i % 4 == 1 ? (int)iso_random_uniform(dice, 1, 1 << ISO_CLOCK) : 0);
    }
}

#endif

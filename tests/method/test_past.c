/* test_past.c - a time gives the same bits in whatever order times are asked, and costs little if it was passed
 * before. */
#include "orbits.h"

enum { TIMES = 20, TURN = 3 };

static iso_context *ctx;

/* The memory of an integrator: none, room for some 20 places, as much as it wants. */
enum { MEMORIES = 3 };
static size_t memory_of(int kind, const orbit *o)
{
    const size_t some = 20 * (24 + 2 * sizeof(double) * (size_t)o->model.dim + 64);
    return (const size_t[MEMORIES]){0, some, (size_t)1 << 20}[kind];
}

static iso_method_options options_for(const iso_method *m, size_t memory)
{
    return (iso_method_options){.tolerance = m->order == 2 ? 1e-3 : m->order == 3 ? 1e-4 : 1e-6, .memory = memory};
}

typedef struct moment {
    double t, y[ISO_MAX_STATE];
    iso_status status;
} moment;

/* Times forwards and backwards, each way run through in order, without memory. Every fourth is the end of a step. */
static long expect(const orbit *o, const iso_method *m, moment all[2 * TIMES])
{
    memset(all, 0, 2 * TIMES * sizeof *all);
    long steps = 0;
    for (int side = 0; side < 2; side++) {
        const iso_method_options options = options_for(m, 0);
        iso_integrator *it = orbit_start(o, m, &options);
        for (int i = 0; i < TIMES; i++) {
            moment *a = &all[side * TIMES + i];
            double end, y[ISO_MAX_STATE];
            a->t = (side ? -1 : 1) * TURN * o->unit * (i + 1) / TIMES;
            if (i % 4 == 3) iso_integrator_last(it, &end, y);
            if (i % 4 == 3 && fabs(end) < 2 * TURN * o->unit) a->t = end; /* a ball at rest has one endless step */
            a->status = iso_integrator_at(it, a->t, a->y);
        }
        steps += iso_integrator_statistics(it).steps;
        iso_integrator_free(it);
    }
    return steps;
}

static void note_true(laws_worst *worst, const orbit *o, const iso_method *m, bool good, const char *what)
{
    char text[96];
    snprintf(text, sizeof text, "%s %s, %s", m->name, o->model.system->name, what);
    laws_note(worst, !good, 0.5, &o->model.problem.p, text);
}

static void ask(const orbit *o, const iso_method *m, iso_integrator *it, const moment *a, laws_worst *worst,
                const char *what)
{
    double y[ISO_MAX_STATE] = {0};
    const iso_status status = iso_integrator_at(it, a->t, y);
    note_true(worst, o, m, status == a->status && !memcmp(y, a->y, (size_t)o->model.dim * sizeof *y), what);
}

static void any_order(const orbit *o, const iso_method *m, laws_worst *worst)
{
    moment all[2 * TIMES];
    const long steps = expect(o, m, all);
    for (int kind = 0; kind < MEMORIES; kind++) {
        const iso_method_options options = options_for(m, memory_of(kind, o));
        iso_integrator *it = orbit_start(o, m, &options);
        iso_random *random = iso_random_create(7);
        for (int i = 0; i < (kind == 0 ? 6 : 2 * TIMES); i++) {
            const int which = (int)(iso_random_uniform(random, 0, 2 * TIMES));
            ask(o, m, it, &all[which], worst, "at random");
        }
        for (int i = TIMES; kind > 0 && i-- > 0;) ask(o, m, it, &all[i], worst, "backwards");
        for (int i = 0; i < 2 * TIMES; i++) ask(o, m, it, &all[i], worst, "forwards");
        note_true(worst, o, m, iso_integrator_statistics(it).steps == steps, "steps counted once");
        const size_t place = 24 + (m->save ? it->saved : sizeof(double) * (size_t)o->model.dim);
        for (int side = 0; side < 2; side++)
            note_true(worst, o, m, it->past[side].room * place <= options.memory, "memory");
        iso_random_free(random);
        iso_integrator_free(it);
    }
}

static void for_every_method(void (*check)(const orbit *, const iso_method *, laws_worst *), const char *name)
{
    laws_worst worst = {0};
    for (int i = 0; iso_methods[i]; i++)
        for (int s = 0; iso_systems[s]; s++)
            for (int k = 0; k < ORBIT_K; k++) {
                if (tests_length(1, 0) && (i + s + k / 2) % 2) continue; /* half of the k */
                orbit o = orbit_sample(ctx, iso_systems[s], orbit_k[k], orbit_J, 5 + (unsigned long)k);
                if (k % 2) orbit_clocks(&o, (iso_clock)(k % 3), k % 3 != 0, k % 3 != 1, k % 3 != 2);
                if (orbit_served(iso_methods[i], iso_systems[s])) check(&o, iso_methods[i], &worst);
            }
    laws_report(&worst, name);
}

/* Splittings restore the constraints once in 1024 steps. */
static void many_steps(void)
{
    laws_worst worst = {0};
    orbit o = orbit_sample(ctx, &iso_system_point, 0.5, orbit_J, 5);
    o.unit *= 100;
    any_order(&o, iso_method_find("kahan_li8"), &worst);
    laws_report(&worst, "many steps");
}

/* With effects, their states and every clock. */
static void effects_in_any_order(const effects_case *c, laws_worst *worst)
{
    static int variant;
    static const char *const names[] = {"taylor", "rk8pd", "adams", "bsimp"};
    const int number = variant++;
    if (number % tests_length(101, 31) || iso_effects_stiffness(&c->model.problem) > ISO_STIFF) return;
    orbit o = orbit_of(ctx, c, number);
    o.unit = orbit_stretch(c, &o) / 2;
    if (iso_params_steep(&c->model.problem.p)) return; /* no time suits all parts of such an orbit */
    any_order(&o, iso_method_find(names[number / 3 % 4]), worst);
}

/* A time passed before takes up to four steps of taylor, and where memory is short, as many as two places lie apart.
 * */
static void check_work(size_t memory, long most)
{
    const orbit o = orbit_sample(ctx, &iso_system_ball, -1, orbit_J, 3);
    const iso_method_options options = {.tolerance = 1e-12, .memory = memory};
    iso_integrator *it = orbit_start(&o, iso_method_find("taylor"), &options);
    iso_random *random = iso_random_create(5);
    const double end = 1000 * o.unit;
    double y[ISO_MAX_STATE];
    long work = 0;
    iso_integrator_at(it, end, y);
    const iso_statistics there = iso_integrator_statistics(it);
    const long order = there.rhs / there.steps;
    for (int i = 0; i < 200; i++) {
        const long before = iso_integrator_statistics(it).rhs;
        iso_integrator_at(it, iso_random_uniform(random, 0, end), y);
        const long rhs = iso_integrator_statistics(it).rhs - before;
        work = rhs > work ? rhs : work;
    }
    gsl_test(work > most * order, "%ld steps, %zu bytes: %ld steps again for a time, at most %ld", there.steps,
             memory, work / order, most);
    iso_random_free(random);
    iso_integrator_free(it);
}

/* --- events ----------------------------------------------------------------------------------------------------- */

static double third(const iso_model *m, const double y[], const void *data)
{
    (void)m, (void)data;
    return y[5];
}

/* Events in stretches asked in any order are those found on the way. */
static void events_in_any_order(const orbit *o, const iso_method *m, laws_worst *worst)
{
    enum { STRETCHES = 12 };
    const iso_event event = {.g = third};
    double t[MEMORIES][2 * STRETCHES], y[ISO_MAX_STATE];
    for (int kind = 0; kind < MEMORIES; kind++) {
        const iso_method_options options = options_for(m, memory_of(kind, o));
        iso_integrator *it = orbit_start(o, m, &options);
        for (int i = 0; i < 2 * STRETCHES; i++) {
            const int at = kind == 0 ? i : 7 * i % (2 * STRETCHES), sign = at < STRETCHES ? 1 : -1;
            const double from = sign * (at % STRETCHES) * o->unit;
            bool found = false;
            t[kind][at] = 0;
            if (from == 0 && sign < 0) continue;
            const iso_status status =
                iso_integrator_event(it, &event, from, from + sign * o->unit, &found, &t[kind][at], y);
            if (status != ISO_OK || !found) t[kind][at] = status == ISO_OK ? 0 : NAN;
        }
        note_true(worst, o, m, !memcmp(t[kind], t[0], sizeof t[0]), "events");
        iso_integrator_free(it);
    }
}

int main(void)
{
    ctx = iso_context_create();
    for_every_method(any_order, "any order");
    for_every_method(events_in_any_order, "events in any order");
    effects_hold("effects in any order", NULL, 1, effects_in_any_order);
    many_steps();
    check_work((size_t)1 << 23, 4);
    check_work((size_t)1 << 13, 64);
    iso_context_free(ctx);
    return gsl_test_summary();
}

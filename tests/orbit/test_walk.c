/* The walk of many orbits, lib/orbit/walk_impl.h: the same stops in the same order for all groups, rounds and
 * threads; an orbit that fails ends alone; a stop keeps what is found. */
#include "laws.h"
#include "orbit/crossings_impl.h"
#include "orbit/walk_impl.h"

enum { ORBITS = 40, STOPS = 12, FAILS = 7 };

static iso_context *ctx;
static iso_scene scene;
static iso_effects effects;
static iso_starts starts;

/* What a visitor sees. */
typedef struct diary {
    size_t round;                 /* stops that an orbit wants at a time */
    size_t found[ORBITS], visits; /* stops of an orbit; all */
    size_t orbit[ORBITS * STOPS]; /* in the order of visits */
    iso_crossing stop[ORBITS][STOPS], twin[ORBITS][STOPS];
    bool fails; /* orbit FAILS is the rotation in the plane of the section */
} diary;

static void begin(void *user, size_t i, iso_start *start, iso_batch_orbit *orbit)
{
    const diary *d = user;
    double l, x;
    iso_starts_orbit(&starts, i, &l, &x, start, orbit);
    if (d->fails && i == FAILS) *start = iso_section_start(starts.orbit, ISO_BALL, starts.axis, 0.3, 1);
}

static size_t wanted(void *user, size_t i)
{
    const diary *d = user;
    const size_t left = STOPS - d->found[i];
    return left < d->round ? left : d->round;
}

static iso_status visit(void *user, size_t i, const iso_walk_stop *stop)
{
    diary *d = user;
    gsl_test(stop->number != d->found[i] + 1, "stop %zu of orbit %zu comes after stop %zu", stop->number, i,
             d->found[i]);
    d->orbit[d->visits++] = i;
    if (stop->crossing[0]) d->stop[i][d->found[i]] = *stop->crossing[0];
    if (stop->crossing[1]) d->twin[i][d->found[i]] = *stop->crossing[1];
    d->found[i]++;
    return ISO_OK;
}

static iso_walk walk_of(diary *d, size_t round, int threads)
{
    iso_walk w = {.ctx = ctx, .count = ORBITS, .most = STOPS, .models = 1, .user = d, .begin = begin, .visit = visit};
    memset(d, 0, sizeof *d);
    d->round = round;
    w.wanted = round > 0 ? wanted : NULL;
    w.options[0] = iso_crossings_defaults();
    w.options[0].backend = ISO_BACKEND_BALL;
    w.options[0].axis = starts.axis;
    w.options[0].threads = threads;
    w.options[1] = w.options[0];
    w.options[1].backend = ISO_BACKEND_POINT;
    return w;
}

static void alike(const diary *a, const diary *b, const char *what)
{
    gsl_test(memcmp(a->stop, b->stop, sizeof a->stop) != 0, "%s: the same stops", what);
    gsl_test(memcmp(a->found, b->found, sizeof a->found) != 0, "%s: as many stops", what);
}

/* Rounds of 5 of all orbits; in order: all stops of an orbit before the next one's. */
static void check_order(const diary *d, size_t round, const char *what)
{
    size_t n = 0;
    for (size_t from = 0; from < STOPS; from += round)
        for (size_t i = 0; i < ORBITS; i++)
            for (size_t j = from; j < STOPS && j < from + round; j++, n++)
                if (d->orbit[n] != i) {
                    gsl_test(1, "%s: visit %zu is of orbit %zu, not %zu", what, n, d->orbit[n], i);
                    return;
                }
    gsl_test(n != d->visits, "%s: %zu visits", what, d->visits);
}

static void check_alike(const diary *right)
{
    static diary d, parts;
    for (int threads = 1; threads <= 3; threads += 2) {
        iso_walk w = walk_of(&d, 5, threads);
        gsl_test(iso_walk_go(&w) != ISO_OK, "rounds of 5, threads: %d", threads);
        alike(&d, right, "rounds of 5");
        check_order(&d, 5, "rounds of 5");
        w = walk_of(&d, STOPS, threads);
        w.most = 1 << 18; /* two orbits fit the memory */
        w.in_order = true;
        gsl_test(iso_walk_go(&w) != ISO_OK, "groups of two, threads: %d", threads);
        alike(&d, right, "groups of two");
        check_order(&d, STOPS, "groups of two");
        w = walk_of(&d, 0, threads);
        w.in_order = true;
        w.models = 2;
        gsl_test(iso_walk_go(&w) != ISO_OK, "two models, threads: %d", threads);
        alike(&d, right, "two models");
        check_order(&d, STOPS, "two models");
        gsl_test(memcmp(d.stop[3], d.twin[3], sizeof d.stop[3]) == 0, "the models are integrated apart");
    }
    iso_walk w = walk_of(&parts, 0, 1);
    for (w.first = 0; w.first < ORBITS; w.first += w.count) {
        w.count = w.first + 9 < ORBITS ? 9 : ORBITS - w.first;
        gsl_test(iso_walk_go(&w) != ISO_OK, "orbits from %zu on", w.first);
    }
    alike(&parts, right, "nine orbits at a time");
}

static void check_failure(const diary *right)
{
    static const char text[] = "orbit 7: this orbit is the rotation about axis";
    static diary d;
    for (int models = 1; models <= 2; models++) {
        iso_walk w = walk_of(&d, 5, 2);
        w.models = models;
        d.fails = true;
        gsl_test(iso_walk_go(&w) != ISO_OK, "a walk with an orbit that fails");
        gsl_test(w.failed != 1 || w.failure != ISO_BAD_INPUT, "%zu orbits failed", w.failed);
        gsl_test(strncmp(w.text, text, sizeof text - 1) != 0, "text: %s", w.text);
        for (size_t i = 0; i < ORBITS; i++)
            gsl_test(d.found[i] != (i == FAILS ? 0 : STOPS) ||
                         (i != FAILS && memcmp(d.stop[i], right->stop[i], sizeof d.stop[i]) != 0),
                     "orbit %zu beside one that fails", i);
    }
}

/* A round in order is computed part by part: what the parts before the end have found is visited. */
static void check_stop(const diary *right)
{
    static diary d;
    enum { MANY = 1 << 30 };
    int left = MANY;
    iso_context_set_monitor(ctx, some_times, &left);
    iso_walk w = walk_of(&d, 0, 1);
    w.in_order = true;
    gsl_test(iso_walk_go(&w) || w.stopped, "a walk with a monitor");
    left = (MANY - left) / 2;
    w = walk_of(&d, 0, 1);
    w.in_order = true;
    gsl_test(iso_walk_go(&w) != ISO_STOPPED || !w.stopped, "the monitor ends the walk");
    iso_context_set_monitor(ctx, NULL, NULL);
    gsl_test(d.visits < ORBITS || d.visits >= ORBITS * STOPS, "%zu stops before it ended", d.visits);
    gsl_test(w.failed != 0, "an orbit that is ended has not failed");
    for (size_t i = 0; i < ORBITS; i++)
        gsl_test(memcmp(d.stop[i], right->stop[i], d.found[i] * sizeof *d.stop[i]) != 0,
                 "orbit %zu: what was found before the end", i);
}

static iso_status refuse(void *user, size_t i, const iso_walk_stop *stop)
{
    diary *d = user;
    (void)i, (void)stop;
    return ++d->visits < 3 ? ISO_OK : ISO_FILE_TROUBLE;
}

int main(void)
{
    static diary right, d;
    static size_t done[ORBITS];
    static iso_status status[ORBITS];
    static iso_crossing crossing[ORBITS * STOPS];
    static iso_start start[ORBITS];
    static iso_batch_orbit orbit[ORBITS];
    iso_orbit *own;
    iso_crossings *c;
    ctx = iso_context_create();
    scene = iso_scene_default();
    scene.params = laws_params(0.5, (double[]){1, 2, 5});
    iso_start_ball(ctx, (double[]){0.9, -0.3, -0.225}, (double[]){0.36, 0.48, 0.8}, ISO_SPIN_REMOVE, &scene.start);
    effects = iso_effects_default();
    const iso_orbit_options o = iso_orbit_defaults(&scene.start);
    gsl_test(iso_orbit_create(ctx, &scene.params, &scene.start, &o, &own) != ISO_OK, "the scene's orbit");
    starts = (iso_starts){.scene = &scene, .orbit = own, .effects = &effects, .axis = 2, .spread = ORBITS - 1};
    iso_starts_prepare(&starts);

    /* Without a walk: all orbits at once. */
    for (size_t i = 0; i < ORBITS; i++) begin(&right, i, &start[i], &orbit[i]);
    const iso_walk w = walk_of(&d, 0, 1);
    iso_crossings_create(ctx, orbit, ORBITS, &w.options[0], &c);
    gsl_test(iso_crossings_go(c, NULL, STOPS, crossing, NULL, done, status) != ISO_OK, "the crossings");
    memcpy(right.stop, crossing, sizeof crossing);
    memcpy(right.found, done, sizeof done);
    iso_crossings_free(c);

    check_alike(&right);
    check_failure(&right);
    check_stop(&right);
    iso_walk refused = walk_of(&d, 0, 1);
    refused.visit = refuse;
    gsl_test(iso_walk_go(&refused) != ISO_FILE_TROUBLE || d.visits != 3, "the visitor ends the walk");
    iso_orbit_free(own);
    iso_context_free(ctx);
    return gsl_test_summary();
}

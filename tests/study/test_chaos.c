/* Verdicts of lib/instrument/chaos/chaos.h by both models, on orbits that are known to be regular or chaotic; shares;
 * refusals. */
#include "instrument/chaos/chaos.h"
#include "instrument/chaos/chaos_impl.h"
#include "studies.h"

static void check_indication(const iso_indication *i, const char *what)
{
    gsl_test(!(i->turns > 0), "%s: turns", what);
    for (int c = 0; c < ISO_CLOCKS; c++)
        gsl_test(!(isfinite(i->exponent[c]) && i->error[c] > 0), "%s: exponent %g +- %g", what, i->exponent[c],
                 i->error[c]);
    gsl_test(!(i->gali2 >= 0 && i->gali2 <= 1), "%s: GALI_2 = %g", what, i->gali2);
}

/* --- one orbit -------------------------------------------------------------------------------------------------- */

/* The sea of k = 0.5, J = 1 2 5, per turn: the mean of 196 orbits over 40000 turns, by Jacobi's scalar equation
 * y'' + K y = 0 on the sphere with the metric -2 V |dgamma|^2 (lib/doc/theory.md, section 10), with Taylor series of
 * its own. How often stated errors cover: test_indicators.c. */
static const double sea_per_turn = 0.798;

/* Both models call it chaotic, and their exponents are the same within the stated errors. */
static void check_chaotic(void)
{
    const iso_scene scene = ball_scene(0.5, (const double[]){1, 2, 5});
    iso_chaos_options o = iso_chaos_defaults();
    iso_chaos *c;
    o.exponent_turns = 1500;
    must(iso_chaos_run(ctx, &scene, &o, &c), "a chaotic orbit");
    gsl_test_int((int)c->own.verdict, ISO_CHAOTIC, "k = 0.5, J = 1 2 5: verdict");
    gsl_test_int(c->axis, 2, "its section is that of the largest moment");
    gsl_test(!isnan(c->turn), "its turns are returns");
    for (int m = 0; m < 2; m++) {
        const iso_indication *i = &c->own.result[m];
        check_indication(i, "a chaotic orbit");
        gsl_test_int((int)i->verdict, ISO_CHAOTIC, "verdict of model %d", m);
        gsl_test_abs(i->per_turn, sea_per_turn, 4 * i->per_turn_error, "model %d: exponent per turn", m);
        gsl_test_rel(i->exponent[ISO_CLOCK_TAU], i->exponent[ISO_CLOCK_T], 1e-9, "k = 1/2: tau = t");
        gsl_test(!(i->megno > 10 && i->gali2 < 1e-6), "MEGNO %g, GALI_2 %g", i->megno, i->gali2);
        gsl_test_int((int)i->exponent_turns, 1500, "turns of the exponent");
        gsl_test(!(i->turns < 500), "turns until the verdict: %ld", i->turns);
        gsl_test_int((int)iso_record_rows(c->trace[m]), 1500, "rows of the trace");
    }
    const iso_indication *one = &c->own.result[ISO_BALL], *other = &c->own.result[ISO_POINT];
    for (int clock = 0; clock < ISO_CLOCKS; clock++)
        gsl_test_abs(one->exponent[clock], other->exponent[clock], 4 * hypot(one->error[clock], other->error[clock]),
                     "exponents of both models in clock %d", clock);
    iso_chaos_free(c);
}

/* A longer exponent changes no verdict, nor the turns until it. At the verdict no error of it is known. */
static void check_end(void)
{
    const iso_scene scene = ball_scene(0.5, (const double[]){1, 2, 5});
    iso_chaos_options o = iso_chaos_defaults();
    iso_chaos *brief, *far;
    o.models = ISO_SHOW_POINT;
    o.starts = 12;
    o.turns = 600;
    must(iso_chaos_run(ctx, &scene, &o, &brief), "until the verdict");
    o.exponent_turns = 700;
    must(iso_chaos_run(ctx, &scene, &o, &far), "beyond the verdict");
    for (size_t i = 0; i < o.starts; i++) {
        const iso_indication *a = &brief->start[i].result[ISO_POINT], *b = &far->start[i].result[ISO_POINT];
        gsl_test(a->verdict != b->verdict || a->turns != b->turns, "start %zu: %d after %ld turns, %d after %ld", i,
                 (int)a->verdict, a->turns, (int)b->verdict, b->turns);
        gsl_test_int((int)b->exponent_turns, b->verdict == ISO_CHAOTIC ? 700 : (int)b->turns, "start %zu: its end",
                     i);
        gsl_test(a->verdict == ISO_REGULAR ? !(a->per_turn_error >= fabs(a->per_turn)) : !isnan(a->per_turn_error),
                 "start %zu: %g +- %g at the verdict", i, a->per_turn, a->per_turn_error);
    }
    iso_chaos_free(brief);
    iso_chaos_free(far);
}

static void check_regular(void)
{
    static const double k[] = {1, -1};
    for (int j = 0; j < 2; j++) {
        const iso_scene scene = ball_scene(k[j], (const double[]){1.4, 2.1, 3});
        iso_chaos *c;
        must(iso_chaos_run(ctx, &scene, NULL, &c), "a regular orbit");
        gsl_test_int((int)c->own.verdict, ISO_REGULAR, "k = %g: verdict", k[j]);
        for (int m = 0; m < 2; m++) {
            check_indication(&c->own.result[m], "a regular orbit");
            gsl_test_abs(c->own.result[m].megno, 2, 0.02, "k = %g: MEGNO of model %d", k[j], m);
        }
        iso_chaos_free(c);
    }
    const iso_scene scene = ball_scene(0.7, (const double[]){2, 2, 2});
    iso_chaos *c;
    must(iso_chaos_run(ctx, &scene, NULL, &c), "three equal moments");
    gsl_test_int((int)c->own.verdict, ISO_REGULAR, "three equal moments: verdict");
    gsl_test_abs(c->own.result[ISO_BALL].megno, 0, 0.02, "three equal moments: MEGNO");
    iso_chaos_free(c);
}

/* Rotations in principal planes are periodic, stable or not. */
static void check_planes(void)
{
    for (int a = 0; a < 3; a++) {
        iso_scene scene = ball_scene(0.5, (const double[]){1, 2, 5});
        double omega[3] = {0, 0, 0}, normal[3] = {0, 0, 0};
        iso_chaos *c;
        omega[a] = 2;
        normal[(a + 1) % 3] = 0.6;
        normal[(a + 2) % 3] = 0.8;
        must(iso_start_ball(ctx, omega, normal, ISO_SPIN_REFUSE, &scene.start), "a start");
        must(iso_chaos_run(ctx, &scene, NULL, &c), "a rotation");
        gsl_test(c->own.verdict != ISO_REGULAR || c->plane != a, "a rotation about axis %d is regular", a + 1);
        iso_chaos_free(c);
    }
}

/* --- many ------------------------------------------------------------------------------------------------------- */

static void check_shares(void)
{
    static const struct {
        double k, J[3], low, high;
    } family[] = {
        {1, {1.4, 2.1, 3}, 0, 0}, {-1, {1, 2, 5}, 0, 0}, {0.5, {2, 2, 5}, 0, 0}, {0.5, {1, 2, 5}, 0.45, 0.7}};
    for (size_t j = 0; j < sizeof family / sizeof *family; j++) {
        const iso_scene scene = ball_scene(family[j].k, family[j].J);
        iso_chaos_options o = iso_chaos_defaults();
        iso_chaos *c;
        o.starts = (size_t)tests_length(24, 150);
        o.models = ISO_SHOW_BOTH;
        must(iso_chaos_run(ctx, &scene, &o, &c), "starts");
        const iso_chaos_fraction *s = &c->share;
        gsl_test_int((int)s->count, (int)o.starts, "k = %g: starts", family[j].k);
        gsl_test(!(s->share >= family[j].low && s->share <= family[j].high), "k = %g: chaotic part %g", family[j].k,
                 s->share);
        const double undecided = 0.02 * (double)s->count; /* and three of its standard deviations, by chance */
        gsl_test((double)s->undecided > undecided + 3 * sqrt(undecided), "k = %g: %zu of %zu undecided", family[j].k,
                 s->undecided, s->count);
        gsl_test_int((int)(s->chaotic + s->regular + s->undecided), (int)s->count, "the parts are the whole");
        gsl_test_int((int)s->failed, 0, "k = %g: none fails: %s", family[j].k, c->words);
        gsl_test(s->disagree > s->count / 500, "k = %g: ball and point disagree about %zu", family[j].k, s->disagree);
        gsl_test(!(s->low <= s->share && s->share <= s->high), "the interval holds the part");
        iso_chaos_free(c);
    }
}

static int decided_by_both(const iso_chaos *c)
{
    int count = 0;
    for (size_t i = 0; i < c->starts; i++)
        count += c->start[i].result[ISO_BALL].verdict != ISO_UNDECIDED &&
                 c->start[i].result[ISO_POINT].verdict != ISO_UNDECIDED;
    return count;
}

/* Unless both are asked for, the ball follows every 16th start that has a verdict. What it follows is the same to the
 * bit; what it does not follow has no turns, and no numbers. The verdicts are those of both. */
static void check_sample(void)
{
    const iso_scene scene = ball_scene(0.5, (const double[]){1, 2, 5});
    iso_chaos_options o = iso_chaos_defaults();
    iso_chaos *all, *some;
    o.starts = 40;
    must(iso_chaos_run(ctx, &scene, &o, &some), "some by the ball");
    o.models = ISO_SHOW_BOTH;
    must(iso_chaos_run(ctx, &scene, &o, &all), "all by the ball");
    gsl_test_int((int)some->share.checked, decided_by_both(some), "checked: of starts 1, 17 and 33");
    gsl_test_int((int)all->share.checked, decided_by_both(all), "checked: of all");
    gsl_test(some->share.checked < 2 || all->share.checked < 30, "most are decided by both");
    for (size_t i = 0; i < o.starts; i++) {
        const iso_indication *a = &all->start[i].result[ISO_BALL], *b = &some->start[i].result[ISO_BALL],
                             *c = &all->start[i].result[ISO_POINT], *d = &some->start[i].result[ISO_POINT];
        const bool same = b->turns == a->turns && memcmp(b->exponent, a->exponent, sizeof a->exponent) == 0,
                   none = b->turns == 0 && b->verdict == ISO_UNDECIDED && isnan(b->exponent[ISO_CLOCK_T]) &&
                          isnan(b->per_turn) && isnan(b->megno) && isnan(b->gali2) && isnan(b->digits);
        gsl_test(!(i % 16 == 0 ? same : none), "start %zu by the ball: %ld turns of %ld", i, b->turns, a->turns);
        gsl_test(memcmp(c->exponent, d->exponent, sizeof c->exponent) != 0, "start %zu by the point: the same", i);
        gsl_test(some->start[i].verdict != d->verdict && some->start[i].verdict != b->verdict, "its verdict");
    }
    gsl_test_int((int)some->share.chaotic, (int)all->share.chaotic, "as many are chaotic");
    iso_chaos_free(all);
    o.turns = 120; /* too few to decide */
    must(iso_chaos_run(ctx, &scene, &o, &all), "few turns");
    gsl_test_int((int)all->share.checked, decided_by_both(all), "checked: not what the ball left undecided");
    iso_chaos_free(all);
    iso_chaos_free(some);
}

/* As a check the ball follows no orbit for long: start 112 takes the point more than 750 turns. */
static void check_long_checks(void)
{
    const iso_scene scene = ball_scene(-0.5, (const double[]){1, 2, 5});
    iso_chaos_options o = iso_chaos_defaults();
    iso_chaos *c;
    size_t skipped = 0;
    o.starts = 128;
    must(iso_chaos_run(ctx, &scene, &o, &c), "starts");
    for (size_t i = 0; i < o.starts; i++) {
        const iso_indication *ball = &c->start[i].result[ISO_BALL], *point = &c->start[i].result[ISO_POINT];
        gsl_test(ball->turns > 750, "start %zu: %ld turns by the ball", i, ball->turns);
        if (i % 16 == 0) gsl_test_int(ball->turns > 0, point->turns <= 750, "start %zu is checked", i);
        skipped += i % 16 == 0 && ball->turns == 0;
    }
    gsl_test(skipped == 0, "starts that are not checked: %zu", skipped);
    iso_chaos_free(c);
}

/* The tolerance of the spread starts is enough for their verdicts. */
static void check_spread_tolerance(void)
{
    const double k[] = {-1, -0.5, 0.3, 0.5, 1};
    for (size_t j = 0; j < sizeof k / sizeof *k; j++) {
        const iso_scene scene = ball_scene(k[j], (const double[]){1.4, 2.1, 3});
        iso_chaos_options o = iso_chaos_defaults();
        iso_chaos *usual, *fine;
        o.starts = (size_t)tests_length(20, 100);
        o.models = ISO_SHOW_POINT;
        must(iso_chaos_run(ctx, &scene, &o, &usual), "as usual");
        o.tolerance = 1e-13;
        must(iso_chaos_run(ctx, &scene, &o, &fine), "finer");
        gsl_test(!(usual->share.tolerance == ISO_SPREAD_TOLERANCE && fine->share.tolerance == 1e-13), "as said");
        for (size_t i = 0; i < o.starts; i++)
            gsl_test_int((int)usual->start[i].verdict, (int)fine->start[i].verdict, "k = %g, start %zu", k[j], i);
        iso_chaos_free(usual);
        iso_chaos_free(fine);
    }
}

/* The low end of the interval is that of the chaotic orbits, the high end that of all that are not known to be
 * regular. So few turns leave most of them undecided. */
static void check_undecided(void)
{
    enum { STARTS = 90, TURNS = 150 };
    const iso_scene scene = ball_scene(-0.5, (const double[]){1.4, 2.1, 3});
    iso_chaos_options o = iso_chaos_defaults();
    iso_chaos *c;
    size_t count[ISO_SHIFTS] = {0}, chaotic[ISO_SHIFTS] = {0}, other[ISO_SHIFTS] = {0};
    double low, high, unused;
    o.starts = STARTS;
    o.turns = TURNS;
    o.models = ISO_SHOW_POINT;
    must(iso_chaos_run(ctx, &scene, &o, &c), "starts");
    for (size_t i = 0; i < STARTS; i++) {
        count[i % ISO_SHIFTS]++;
        chaotic[i % ISO_SHIFTS] += c->start[i].verdict == ISO_CHAOTIC;
        other[i % ISO_SHIFTS] += c->start[i].verdict != ISO_REGULAR;
    }
    iso_share_interval(count, chaotic, &low, &unused);
    iso_share_interval(count, other, &unused, &high);
    gsl_test(c->share.undecided < STARTS / 2, "%zu of %d undecided", c->share.undecided, STARTS);
    gsl_test(c->share.low != low || c->share.high != high, "undecided both ways: %g to %g", c->share.low,
             c->share.high);
    gsl_test(!(c->share.high >= c->share.share + (double)c->share.undecided / STARTS), "%g is too low",
             c->share.high);
    iso_chaos_free(c);
}

/* Stopped after any number of calls: the orbits that nobody followed are not in the share. If there is none, there is
 * no share. */
static void check_stopped(void)
{
    const iso_scene scene = ball_scene(-1, (const double[]){1.4, 2.1, 3});
    iso_chaos_options o = iso_chaos_defaults();
    o.starts = 60;
    o.turns = 400;
    o.threads = 1;
    o.models = ISO_SHOW_POINT;
    bool none = false, some = false, stopped = true;
    for (int calls = 2; stopped; calls += calls / 2) {
        int left = calls - 1;
        iso_chaos *c;
        iso_context_set_monitor(ctx, some_times, &left);
        stopped = iso_chaos_run(ctx, &scene, &o, &c) == ISO_STOPPED;
        iso_context_set_monitor(ctx, NULL, NULL);
        const iso_chaos_fraction *s = &c->share;
        size_t followed = 0;
        for (size_t i = 0; i < c->starts; i++) followed += c->start[i].result[ISO_POINT].turns > 0;
        gsl_test(s->asked != o.starts || s->count != followed || s->failed > 0, "%d calls: %zu of %zu followed",
                 calls, s->count, followed);
        gsl_test_int((int)(s->chaotic + s->regular + s->undecided), (int)s->count, "%d calls: the parts", calls);
        if (s->count == 0)
            gsl_test(!isnan(s->share) || !isnan(s->low) || !isnan(s->high), "no orbit, no share: %g", s->share);
        else
            gsl_test(!c->integral && !(s->high >= (double)s->undecided / (double)s->count),
                     "undecided are possible, unless an additional integral excludes chaos: %g", s->high);
        none = none || s->count == 0;
        some = some || (s->count > 0 && s->count < o.starts);
        iso_chaos_free(c);
    }
    gsl_test(!none || !some, "stopped before the first orbit: %d, between two orbits: %d", none, some);
}

/* --- refusals --------------------------------------------------------------------------------------------------- */

static void refuse(const iso_scene *scene, const iso_chaos_options *o, iso_status wanted, const char *about)
{
    iso_chaos *c = NULL;
    const iso_status status = iso_chaos_run(ctx, scene, o, &c);
    gsl_test(status != wanted || strcmp(iso_context_about(ctx), about) != 0, "refused about '%s': %d, '%s': %s",
             about, (int)status, iso_context_about(ctx), iso_context_message(ctx));
    gsl_test(c != NULL, "no result after a refusal");
    iso_chaos_free(c);
}

/* What others refuse as well: foreign/test_refusals.c. */
static void check_refusals(void)
{
    static const char *const about[] = {"turns", "exponent_turns", "axis"};
    const iso_scene scene = ball_scene(0.5, (const double[]){1, 2, 5});
    for (int i = 0; i < 3; i++) {
        iso_chaos_options o = iso_chaos_defaults();
        if (i == 0) o.turns = 0;
        if (i == 1) o.exponent_turns = -1;
        if (i == 2) o.axis = 1; /* that is not global */
        refuse(&scene, &o, i < 2 ? ISO_BAD_ARGUMENT : ISO_BAD_INPUT, about[i]);
    }
}

int main(void)
{
    ctx = iso_context_create();
    check_chaotic();
    check_end();
    check_regular();
    check_planes();
    check_shares();
    check_sample();
    check_long_checks();
    check_spread_tolerance();
    check_undecided();
    check_stopped();
    check_refusals();
    iso_context_free(ctx);
    return gsl_test_summary();
}

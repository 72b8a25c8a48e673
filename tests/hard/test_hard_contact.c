/* Contact that is nearly lost: pressure that touches 0, or passes it by little, or is 0 all along. */
#include "hard_effects.h"
#include "numbers.h"
#include "orbit/orbit_impl.h"

static iso_context *ctx;

static iso_effects weight(double mgb, const double up[3])
{
    iso_effects e = {.number[ISO_GRAVITY] = {mgb}};
    e.on[ISO_GRAVITY] = e.on[ISO_REACTIONS] = true;
    copy(up, GRAVITY_UP(&e), 3);
    return e;
}

typedef struct loss {
    bool answered;
    double time, steps; /* NAN: none */
} loss;

/* The first loss of contact up to `end`. */
static loss find_loss(const hard_road *way, const iso_params *p, const iso_start *start, const iso_effects *e,
                      double end)
{
    iso_sample s;
    bool lost = false;
    iso_orbit *orbit = he_orbit(ctx, way, p, start, e);
    const bool answered = orbit && iso_orbit_lost_contact(orbit, 0, end, &lost, &s) == ISO_OK;
    const loss l = {answered, lost ? s.clock[ISO_CLOCK_T] : NAN,
                    orbit ? (double)iso_orbit_statistics(orbit).steps : 0};
    iso_orbit_free(orbit);
    return l;
}

/* --- a loop inside a sphere ------------------------------------------------------------------------------------- */

/* In the plane of e and n, w = w3: with k = 2, J3 = 1, D = 1/2, mgb = -3/2 and (e,n) = -1, w3^2 = 9 + d at the lowest
 * place: w3^2 = 6 + d - 3 (e,n), and the pressure is 3 + d/2 - 3 (e,n). At the top it touches 0 for d = 0, and
 * passes it for d < 0 at (e,n) = 1 + d/6. The angle between e and n turns at (k-1) w3. */
typedef struct loop {
    iso_params p;
    iso_start start;
    iso_effects e;
    double d, top, lost; /* times of the top, and of the loss, if any */
} loop;

/* dt of the angle from the top */
static double pace(const loop *l, double angle)
{
    return 1 / sqrt(6 + l->d - 3 * cos(angle));
}

/* from the top to an angle by Simpson's rule; around it the sum over a period converges geometrically */
static double time_between(const loop *l, double angle)
{
    const double h = angle / 64;
    double sum = pace(l, 0) + pace(l, angle);
    for (int i = 1; i < 64; i++) sum += (i % 2 ? 4 : 2) * pace(l, i * h);
    return sum * h / 3;
}

static loop loop_with(double d)
{
    loop l = {.p = laws_params(2, (const double[]){0.8, 0.9, 1}), .e = weight(-1.5, (const double[]){-1, 0, 0})};
    if (iso_params_set_D(ctx, 0.5, &l.p) != ISO_OK) abort();
    l.start = (iso_start){.model = ISO_BALL, .y = {0, 0, sqrt(9 + d), 1, 0, 0}};
    l.d = (l.start.y[2] - 3) * (l.start.y[2] + 3); /* of the double */
    for (int i = 0; i < 256; i++) l.top += M_PI / 256 * pace(&l, M_PI * (i + 0.5) / 128);
    const double angle = 2 * asin(sqrt(fmax(0, -l.d / 12))); /* 1 - cos = -d/6 */
    l.lost = l.top - time_between(&l, angle);
    return l;
}

static loss loss_in_loop(const hard_road *way, const loop *l)
{
    return find_loss(way, &l->p, &l->start, &l->e, 2);
}

/* By d as small as the energy is known: 100 errors of steps; 1e-12 for taylor. Whether contact is lost is exact;
 * the time of a loss is off by the error of the pressure over its slope there, 3 w sin(angle) = about 3 sqrt(-d). */
static void grazing(void)
{
    double missed = 0;
    hard_case("passing by",
              "wrong answers, and the time of a loss, by d = +-1e-12 (or 100 errors) past a double zero",
              "the pressure touches 0 from above at the top of a loop");
    for (const hard_road *way = hard_way; he_is_ball(way); way++) {
        const loop touch = loop_with(0);
        const double error = he_bound(way, loss_in_loop(way, &touch).steps), d = fmax(1e-12, 100 * error);
        const loop below = loop_with(-d), above = loop_with(d);
        const loss some = loss_in_loop(way, &below), none = loss_in_loop(way, &above);
        hard_hold(way, some.answered && none.answered ? (double)(isnan(some.time) + !isnan(none.time)) : NAN, 0);
        hard_hold(way, fabs(some.time - below.lost), error + error / sqrt(d));
        for (int row = 0; row <= 20; row++) missed += fabs(row / 10.0 - below.top) < below.top - below.lost;
    }
    hard_naive("losses missed by looking at rows of 0.1", hard_ways - missed, 0);
}

/* d = 0: a touch is no loss where rounding is all the error; the pressure at the top is 0 to each way's error. */
static void touching(void)
{
    const loop l = loop_with(0);
    hard_case("touching", "pressure at the top of the loop, and losses of contact in rounding",
              "a double zero of the pressure");
    double raw = 0;
    for (const hard_road *way = hard_way; he_is_ball(way); way++) {
        const he_answer a = he_solve(ctx, way, &l.p, &l.start, &l.e, l.top);
        /* pressure's terms are of size 3, their errors those of the state's largest, w = 3 */
        hard_hold(way, a.status == ISO_OK ? fabs(iso_sample_get(&a.at, "pressure")) : NAN,
                  9 * he_bound(way, a.steps));
        if (way->method == iso_method_find("taylor")) {
            const loss none = loss_in_loop(way, &l);
            hard_hold(way, isnan(none.time) && none.answered ? 0 : 1, 0);
        }
        if (way->method != iso_method_find("rk8pd")) continue;
        for (int j = -50; j <= 50; j++) { /* -D (1-k) w^2 + mgb (e,n) as it comes */
            const he_answer near = he_solve(ctx, way, &l.p, &l.start, &l.e, l.top + j * 1e-9);
            const double w = norm(near.at.ball), c = dot(sample_of(&near.at, "e"), near.at.ball + 3);
            raw += w * w / 2 - 1.5 * c < 0;
        }
    }
    hard_naive("times around the top at which rounding says that the support pulls", raw, 0);
}

/* Contact is lost at d < 0, and found again as long after the top: a two-sided contact goes on. */
static double pressure_of(const iso_sample *s, const void *data)
{
    (void)data;
    return iso_sample_get(s, "pressure");
}

static void again(void)
{
    const loop l = loop_with(-1e-3);
    hard_case("separating, touching again", "sum of the two times, twice that of the top",
              "two zeros 0.02 apart in one step");
    double late = 0;
    for (const hard_road *way = hard_way; he_is_ball(way); way++) {
        iso_sample down, up;
        bool lost = false, found = false;
        iso_orbit *orbit = he_orbit(ctx, way, &l.p, &l.start, &l.e);
        iso_status status = iso_orbit_event(orbit, pressure_of, NULL, -1, 0, 2, &lost, &down);
        if (status == ISO_OK) status = iso_orbit_event(orbit, pressure_of, NULL, 1, 0, 2, &found, &up);
        const double error = he_bound(way, (double)iso_orbit_statistics(orbit).steps);
        const double sum = lost && found ? down.clock[ISO_CLOCK_T] + up.clock[ISO_CLOCK_T] : NAN;
        hard_hold(way, status == ISO_OK ? fabs(sum - 2 * l.top) : NAN, 2 * (error + error / sqrt(1e-3)));
        late = fmax(late, lost ? fabs(2 * down.clock[ISO_CLOCK_T] - 2 * l.top) : 0);
        iso_orbit_free(orbit);
    }
    hard_naive("both at the top", late, 1e-3);
}

/* --- surfaces --------------------------------------------------------------------------------------------------- */

/* A start that has pressure and loses it later, with spin out of the plane of e and n; where: by halving on
 * taylor_quad. */
static double halved(const iso_params *p, const iso_start *start, const iso_effects *e, double end, double *slope)
{
    const hard_road quad = he_quad();
    iso_orbit *orbit = he_orbit(ctx, &quad, p, start, e);
    double a = 0, b = 0;
    iso_sample s = {.clock = {0}};
    iso_sample_set_column(&s, iso_column_find("pressure"), 1);
    while (orbit && iso_sample_get(&s, "pressure") >= 0 && b < end) /* pressure does not come back within 1/64 */
        a = b, b += 1.0 / 64, iso_orbit_at(orbit, b, &s);
    for (int i = 0; orbit && i < 60; i++) {
        const double middle = a + (b - a) / 2;
        iso_orbit_at(orbit, middle, &s);
        if (iso_sample_get(&s, "pressure") > 0)
            a = middle;
        else
            b = middle;
    }
    iso_sample before = s, after = s;
    if (orbit) iso_orbit_at(orbit, a - 1e-4, &before), iso_orbit_at(orbit, a + 1e-4, &after);
    *slope = (iso_sample_get(&after, "pressure") - iso_sample_get(&before, "pressure")) / 2e-4;
    iso_orbit_free(orbit);
    return b < end ? a : NAN;
}

static void on_surface(const char *name, double k, double mgb, double side, const double omega[3])
{
    const iso_params p = he_ball(ctx, k);
    iso_start start = he_start();
    copy(omega, start.y, 3);
    remove_along(start.y, start.y + 3);
    const double end = 6;
    const iso_effects e = weight(mgb, (const double[]){0, 0.6 * side, 0.8 * side});
    double slope;
    const double expected = halved(&p, &start, &e, end, &slope);
    hard_case(name, "time of the loss against halving on taylor_quad; none if the end is 1e-6 before",
              "the time is the quotient of two errors");
    for (const hard_road *way = hard_way; he_is_ball(way); way++) {
        const loss l = find_loss(way, &p, &start, &e, end);
        const double error = he_bound(way, l.steps) * (1 + 9 / fabs(slope));
        hard_hold(way, l.answered ? fabs(l.time - expected) : NAN, error);
        const loss none = find_loss(way, &p, &start, &e, expected - error - 1e-6),
                   just = find_loss(way, &p, &start, &e, expected + error + 1e-6);
        hard_hold(way, just.answered && none.answered ? (double)(!isnan(none.time) + isnan(just.time)) : NAN, 0);
    }
    he_refusals(ctx, &p, &start, &e, end);
    hard_naive("the row before, rows of 0.1", expected - floor(10 * expected) / 10, 1e-3);
}

/* On an upright plane nothing presses the ball, ever, and rounding must not say otherwise; nor pull it. */
static void wall(void)
{
    const iso_params p = he_ball(ctx, 1);
    const iso_start start = he_start();
    const iso_effects e = weight(1, (const double[]){0.8, -0.6, 0});
    double pulled = 0;
    hard_case("an upright plane", "losses of contact up to t = 50, and the pressure at t = 0",
              "pressure mgb (e,n) is 0 but for rounding");
    for (const hard_road *way = hard_way; he_is_ball(way); way++) {
        const loss l = find_loss(way, &p, &start, &e, 50);
        const he_answer begin = he_solve(ctx, way, &p, &start, &e, 0);
        const bool presses = l.answered && isnan(l.time) && begin.status == ISO_OK;
        hard_hold(way, presses ? fabs(iso_sample_get(&begin.at, "pressure")) : NAN, 0);
        const he_answer later = he_solve(ctx, way, &p, &start, &e, 50);
        pulled += dot(sample_of(&later.at, "e"), later.at.ball + 3) < 0;
    }
    hard_naive("ways in which (e,n) < 0 at t = 50", pulled, 0);
}

int main(void)
{
    ctx = iso_context_create();
    hard_topic("6c. Effects at their limits: contact");
    grazing();
    touching();
    again();
    on_surface("outside", 0.5, 1, 1, (const double[]){0.3, -0.2, 0.1});
    on_surface("inside", 1.6, -1, -1, (const double[]){1.2, -1.2, 0.1});
    on_surface("shell", -1, -1, 1, (const double[]){0.9, -0.6, 0.1});
    wall();
    iso_context_free(ctx);
    exit(hard_summary());
}

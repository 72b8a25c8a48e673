/* Rest, speeds of 1e-300 and 1e300, subnormal ones, and zeros of either sign. */
#include "api/typed_impl.h"
#include "hard.h"
#include "map/state.h"
#include "orbit/orbit_impl.h"

static iso_context *ctx;
static iso_params params;
static const double J[3] = {1.4, 2.1, 3.0}, omega[3] = {0.9, -0.3, -0.225}, normal[3] = {0.36, 0.48, 0.8};

static iso_start start_at(double speed)
{
    iso_start start = {.model = ISO_BALL};
    for (int i = 0; i < 3; i++) start.y[i] = speed * omega[i], start.y[3 + i] = normal[i];
    return start;
}

/* How many of a sample's first 3 + 12 numbers differ in a bit from those of another times their units. */
static int differing(const iso_sample *a, const iso_sample *b, double speed)
{
    int count = 0;
    for (int c = 0; c < ISO_COLUMN_EFFECTS; c++) {
        const bool fast =
            (c >= ISO_COLUMN_BALL && c < ISO_COLUMN_BALL + 3) || (c >= ISO_COLUMN_POINT && c < ISO_COLUMN_POINT + 3);
        const double unit = c < ISO_CLOCKS ? 1 / speed : fast ? speed : 1;
        const double x = iso_sample_column(a, c), y = unit * iso_sample_column(b, c);
        count += !(x == y || (isnan(x) && isnan(y)));
    }
    return count;
}

/* --- rest ------------------------------------------------------------------------------------------------------- */

static double height(const iso_sample *sample, const void *data)
{
    (void)data;
    return sample->ball[5] - 0.5;
}

static bool is_start(const iso_sample *sample, const iso_start *start)
{
    for (int i = 0; i < ISO_STATE; i++)
        if (sample->ball[i] != start->y[i]) return false;
    return true;
}

/* A ball that stays where it is: at rest, or (effects) in the balance of gravity. */
static void check_resting(const hard_road *way, const iso_start *start, const iso_effects *effects)
{
    static const double times[] = {0, 1, -1, 1e15, 1e300, -1e300, DBL_MAX};
    iso_orbit *orbit;
    iso_sample sample;
    bool found = true;
    int moved = 0;
    iso_orbit_options o = iso_orbit_defaults(start);
    o.backend = way->backend, o.method = way->method, o.tolerance = way->tolerance, o.effects = effects;
    const iso_status status = iso_orbit_create(ctx, &params, start, &o, &orbit);
    if (way->backend != ISO_BACKEND_BALL) {
        hard_refused(way, status == ISO_NOT_MAPPED, "a ball at rest (h = 0) has no twin");
        return;
    }
    for (size_t i = 0; i < sizeof times / sizeof *times; i++)
        moved += iso_orbit_at(orbit, times[i], &sample) != ISO_OK || !is_start(&sample, start) ||
                 sample.clock[0] != times[i];
    moved += iso_orbit_event(orbit, height, NULL, 0, 0, 1e300, &found, &sample) != ISO_OK || found;
    hard_hold(way, moved, 0);
    iso_orbit_free(orbit);
}

static void check_rest(void)
{
    iso_start start = start_at(0);
    hard_case("rest", "numbers that are not those of the start, up to t = 1e308",
              "h = 0: what is divided by it is none");
    for (int w = 0; w < hard_ways; w++) check_resting(&hard_way[w], &start, NULL);
    hard_naive("omega times the root of h over its energy", sqrt(0.0 / iso_ball_energy(&params, start.y)), 0);
    iso_sample sample;
    const iso_batch_options o = iso_batch_defaults();
    const iso_status status =
        iso_batch_run(ctx, &(iso_batch_orbit){&params, &start, NULL}, 1, &o, (double[]){1e15}, 1, &sample, NULL);
    gsl_test(status != ISO_OK || !is_start(&sample, &start), "a batch of it: %s", iso_context_message(ctx));
    iso_effects gravity = {.on = {[ISO_GRAVITY] = true}, .number[ISO_GRAVITY] = {0.7, 0, 0, 1}};
    start = (iso_start){.model = ISO_BALL, .y = {0, 0, 0, 0, 0, -1}};
    hard_case("balance", "the same of a ball that gravity holds where it is", "it turns for ever, but not at all");
    for (int w = 0; w < hard_ways; w++)
        if (hard_way[w].backend == ISO_BACKEND_BALL) check_resting(&hard_way[w], &start, &gravity);
}

/* --- speeds ----------------------------------------------------------------------------------------------------- */

/* (omega, t) -> (c omega, t/c) is the same orbit, for a power of two to the last bit. */
static void check_speeds(void)
{
    static const int power[] = {997, -996, 512, -540};
    hard_case("speeds of 1e300 and 1e-300", "numbers that differ in a bit from those at speed 1, in their units",
              "the energy is no double");
    for (int w = 0; w < hard_ways; w++) {
        iso_sample one, other;
        const iso_start usual = start_at(1);
        int different = hard_solve(ctx, &hard_way[w], &params, &usual, NULL, true, ISO_CLOCK_T, 3, &one) != ISO_OK;
        for (size_t i = 0; i < sizeof power / sizeof *power; i++) {
            const double c = ldexp(1, power[i]);
            const iso_start start = start_at(c);
            const iso_status status =
                hard_solve(ctx, &hard_way[w], &params, &start, NULL, true, ISO_CLOCK_T, 3 / c, &other);
            different += status == ISO_OK ? differing(&other, &one, c) : 1;
        }
        hard_hold(&hard_way[w], different, 0);
    }
    const iso_start fast = start_at(1e300);
    hard_naive("(omega, J omega)/2", iso_ball_energy(&params, fast.y), 1e300);
}

/* A subnormal speed has few digits left, and its unit of time is no double. */
static void check_subnormal(void)
{
    const iso_start start = start_at(ldexp(1, -1040));
    iso_start checked;
    hard_case("subnormal speeds", "refused", "a subnormal number has lost digits that a motion needs");
    for (int w = 0; w < hard_ways; w++) {
        iso_sample sample;
        const iso_status status =
            hard_solve(ctx, &hard_way[w], &params, &start, NULL, false, ISO_CLOCK_T, 1, &sample);
        hard_refused(&hard_way[w], status == ISO_NUMERICAL, "does not fit a double in these units");
    }
    for (iso_spin spin = ISO_SPIN_REFUSE; spin <= ISO_SPIN_KEEP; spin++) {
        const iso_status status = iso_start_ball(ctx, start.y, normal, spin, &checked);
        gsl_test(status != ISO_BAD_INPUT || !strstr(iso_context_message(ctx), "unit of time"), "a start: %s",
                 iso_context_message(ctx));
    }
    const double lost = start.y[0] / 3 * 3;
    hard_naive("a third of it, three times", fabs(lost / start.y[0] - 1), DBL_EPSILON);
}

/* The rotation in a principal plane, its three zeros of either sign: the same orbit. */
static void check_zeros(void)
{
    hard_case("signed zeros", "numbers that differ with the signs of the start's zeros",
              "which side of a plane is it on, and which branch does an angle take?");
    for (int w = 0; w < hard_ways; w++) {
        int different = 0;
        iso_sample one, other;
        for (int signs = 0; signs < 8; signs++) {
            iso_start start = {.model = ISO_BALL, .y = {0.7, 0, 0, 0, 0.6, 0.8}};
            for (int i = 0; i < 3; i++) start.y[1 + i] = signs >> i & 1 ? -0.0 : 0.0;
            iso_sample *const s = signs == 0 ? &one : &other;
            if (hard_solve(ctx, &hard_way[w], &params, &start, NULL, true, ISO_CLOCK_T, 3, s) != ISO_OK) different++;
            if (signs > 0) different += differing(&other, &one, 1);
        }
        hard_hold(&hard_way[w], different, 0);
    }
    hard_naive("a longitude by atan2", fabs(atan2(0.0, -1) - atan2(-0.0, -1)), 0);
}

int main(void)
{
    ctx = iso_context_create();
    params = laws_params(-1, J);
    hard_topic("8c. Speeds");
    check_rest();
    check_speeds();
    check_subnormal();
    check_zeros();
    iso_context_free(ctx);
    return hard_summary();
}

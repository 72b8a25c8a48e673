/* Enclosures of the splitting, lib/instrument/prove/prove_impl.h: laws at k = 1 and -1, known values, the same number
 * as the splitting that is measured, refusals. */
#include "instrument/prove/prove_impl.h"
#include "instrument/separatrix/separatrix.h"
#include "io/scene_file.h"
#include "studies.h"

static iso_proof_work work = {.most = 1000000};

static iso_proof_ball ball_of(const char *k, const char *J1, const char *J2, const char *J3)
{
    iso_proof_ball b;
    const char *J[3] = {J1, J2, J3};
    bool read = iso_rational_read(k, strlen(k), &b.k[0]);
    b.k[1] = b.k[0];
    for (int i = 0; i < 3; i++) read = iso_rational_read(J[i], strlen(J[i]), &b.J[i]) && read;
    gsl_test(!read, "k = %s, J = %s, %s, %s are read", k, J1, J2, J3);
    return b;
}

static iso_proof prove(const iso_proof_ball *b, int digits)
{
    iso_proof p = {.sign = 9};
    const iso_status status = iso_proof_find(ctx, b, digits, &work, &p, NULL);
    gsl_test(status != ISO_OK, "k = %g, %d digits: enclosed %s", iso_rational_double(&b->k[0]), digits,
             status == ISO_OK ? "" : iso_context_message(ctx));
    return p;
}

static double width(const iso_proof *p)
{
    return p->m.high - p->m.low;
}

static void test_numbers(void)
{
    static const struct {
        const char *text;
        int64_t top, below;
    } good[] = {{"1.4", 7, 5},      {"-2.10", -21, 10}, {"1/3", 1, 3},
                {"-3e-2", -3, 100}, {"0.5/1.5", 1, 3},  {"25e1", 250, 1}};
    static const char *const bad[] = {"",
                                      "0",
                                      "1/0",
                                      "1/",
                                      "/3",
                                      "1/2/3",
                                      "nan",
                                      "1e-20",
                                      "0.12345678901234567",
                                      "1 ",
                                      "0e99999999999999999999",
                                      "1.5e-99999999999999999999"};
    iso_rational r, of;
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        const bool read = iso_rational_read(good[i].text, strlen(good[i].text), &r);
        gsl_test(!(read && r.top == good[i].top && r.below == good[i].below), "%s is exact", good[i].text);
        gsl_test(!(iso_rational_of(iso_rational_double(&r), &of) && iso_rational_same(&r, &of)), "%s by its double",
                 good[i].text);
    }
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        gsl_test(iso_rational_read(bad[i], strlen(bad[i]), &r), "'%s' is refused", bad[i]);
    gsl_test(iso_rational_of(0.1234567890123456789, &r), "a double with 17 digits is no such number");
    const iso_rational a = {1, 3}, b = {1, 2};
    gsl_test(!(iso_rational_middle(&a, &b, &r) && r.top == 5 && r.below == 12), "middle");
}

/* --- laws ------------------------------------------------------------------------------------------------------- */

/* k = 1 and -1 are integrable: m = 0 is in every enclosure, and more digits enclose it better. More J, and up to 120
 * digits: tests/prove/integrable.py, by hand. */
static void test_integrable(void)
{
    enum { LENGTHS = 2 };
    const int count = tests_length(1, 2), digits[LENGTHS] = {tests_length(8, 15), tests_length(16, 24)};
    iso_random *random = iso_random_create(35);
    for (int i = 0; i < count; i++) {
        iso_proof_ball b = {.k = {{i % 2 ? -1 : 1, 1}, {i % 2 ? -1 : 1, 1}}};
        double last = INFINITY;
        for (int j = 0; j < 3; j++) {
            const int top = 100 + 100 * j + (int)iso_random_uniform(random, 0, 90);
            char text[16];
            snprintf(text, sizeof text, "%d/100", top);
            iso_rational_read(text, strlen(text), &b.J[j]);
        }
        for (int j = 0; j < LENGTHS; j++) {
            const iso_proof p = prove(&b, digits[j]);
            gsl_test(!(p.m.low <= 0 && p.m.high >= 0 && p.sign == 0), "k = %d: 0 is in it at %d digits",
                     i % 2 ? -1 : 1, digits[j]);
            gsl_test(!(width(&p) < 2.1 * pow(10, -digits[j]) && width(&p) < last), "its width %.1e falls", width(&p));
            last = width(&p);
        }
    }
    iso_random_free(random);
}

/* The value was found before by another program, with another equation, in 128 bits. */
static void test_value(void)
{
    const iso_proof_ball b = ball_of("1/2", "1.4", "2.1", "3");
    const iso_proof p = prove(&b, 16);
    gsl_test(!(p.m.low <= 0.00614708829830125277 && p.m.high >= 0.00614708829830125277), "k = 1/2: m is in it");
    gsl_test(!(width(&p) < 1e-15 && p.sign == 1 && p.axis == 2), "k = 1/2: it is narrow, and m > 0 is proved");
}

/* What another k does that is a double: some times its rounding error. */
#define ROUNDED 2e-16

/* The measured m has an error; both intervals meet. 1/k = 3 and -3, where the theorem is silent, are proved. */
static void test_measured(void)
{
    static const struct {
        const char *k, *J[3];
    } balls[] = {{"1/3", {"1.4", "2.1", "3"}}, {"-1/3", {"1.4", "2.1", "3"}}, {"1/5", {"1", "2", "5"}},
                 {"-1/5", {"2", "5", "1"}},    {"3/4", {"3", "1.4", "2.1"}},  {"2.3", {"1", "2", "5"}},
                 {"-2", {"1.4", "2.1", "3"}}};
    const int count = tests_length(3, (int)(sizeof balls / sizeof *balls));
    for (int i = 0; i < count; i++) {
        const iso_proof_ball b = ball_of(balls[i].k, balls[i].J[0], balls[i].J[1], balls[i].J[2]);
        double J[3];
        iso_separatrix_splitting s;
        for (int j = 0; j < 3; j++) J[j] = iso_rational_double(&b.J[j]);
        if (iso_separatrix_at(ctx, iso_rational_double(&b.k[0]), J, 0, ISO_SEPARATRIX_DOUBLE, &s) != ISO_OK) continue;
        const iso_proof p = prove(&b, 14);
        gsl_test(!(p.axis == s.axis && p.middle == s.middle && p.section == s.section), "k = %s: the same sections",
                 balls[i].k);
        const double m_error = s.error + ROUNDED, x_error = s.x_error + ROUNDED;
        gsl_test(!(p.m.low - m_error <= s.m && s.m <= p.m.high + m_error), "k = %s: the measured m is in it",
                 balls[i].k);
        gsl_test(!(p.x.low - x_error <= s.x && s.x <= p.x.high + x_error), "k = %s: x likewise", balls[i].k);
        gsl_test(!(p.sign == (s.m > 0) - (s.m < 0) || p.sign == 0), "k = %s: no wrong sign", balls[i].k);
    }
}

/* All k of an interval at once: their enclosure holds that of each k. */
static void test_interval(void)
{
    static const char *const ends[][2] = {{"0.5", "0.50001"}, {"-0.5", "-0.49999"}};
    const int count = tests_length(1, 2);
    for (int i = 0; i < count; i++) {
        iso_proof_ball b = ball_of(ends[i][0], "1.4", "2.1", "3");
        const iso_proof low = prove(&b, 12);
        iso_rational_read(ends[i][1], strlen(ends[i][1]), &b.k[1]);
        const iso_proof all = prove(&b, 8);
        b.k[0] = b.k[1];
        const iso_proof high = prove(&b, 12);
        gsl_test(!(all.m.low <= low.m.low && low.m.high <= all.m.high), "%s to %s: m of the first", ends[i][0],
                 ends[i][1]);
        gsl_test(!(all.m.low <= high.m.low && high.m.high <= all.m.high), "m of the last");
        gsl_test(!(all.sign == 1 && all.m.high < 2 * high.m.low), "all are proved");
    }
}

/* --- what is asked ---------------------------------------------------------------------------------------------- */

static void refuses(const char *text, const char *options, const char *words)
{
    iso_scene scene;
    iso_study_result result = {.text = NULL};
    iso_status status = iso_scene_load_text(ctx, "scene", text, strlen(text), &scene);
    gsl_test(status != ISO_OK, "a scene: %s", iso_context_message(ctx));
    if (status != ISO_OK) return;
    status =
        iso_study_ask_text(ctx, iso_study_find("prove"), &(iso_study_subject){.scene = &scene}, options, &result);
    gsl_test(!(status != ISO_OK && strstr(iso_context_message(ctx), words)), "refused: %s", iso_context_message(ctx));
    iso_study_result_free(&result);
}

#define START "\ninitial: {normal: [0, 0, 1], angular_velocity: [1, 0, 0]}\ntime: {end: 1}\n"
#define BALL "reduced: {k: 1/2, J: [1, 2, 3]}" START

static void test_refusals(void)
{
    refuses(BALL, "digits=0", "digits");
    refuses(BALL, "k=0", "expected a number or an interval");
    refuses(BALL, "k=-1:1", "that does not hold 0");
    refuses(BALL, "k=0.6:0.5", "A < B");
    refuses(BALL "effects: {field: {linear: [1, 0, 0]}}\n", NULL, "remove 'field'");
    refuses(BALL "effects: {level: {c: -0.1}}\n", NULL, "only of the free ball");
    refuses("reduced: {k: 1/2, J: [1, 2, 2]}" START, NULL, "equal");
    refuses("reduced: {k: 0.33333333333333333, J: [1, 2, 3]}" START, NULL, "at most 15 digits");
    refuses("reduced: {k: 0.3333333333333333, J: [1, 2, 3]}" START, NULL, "at most 15 digits");
    refuses("ball: {mass: 2, radius: 1, inertia: [2, 3, 4]}\nsurface: {kind: plane}" START, NULL, "'reduced'");
}

static void test_stop(void)
{
    const iso_proof_ball b = ball_of("1/2", "1.4", "2.1", "3");
    iso_proof p;
    int left = 30;
    iso_context_set_monitor(ctx, some_times, &left);
    gsl_test(iso_proof_find(ctx, &b, 12, &work, &p, NULL) != ISO_STOPPED, "it stops on request");
    iso_context_set_monitor(ctx, NULL, NULL);
}

int main(void)
{
    ctx = iso_context_create();
    test_numbers();
    if (!iso_proof_is_possible()) {
        printf("SKIP proofs: this build has no Arb\n");
    } else {
        test_value();
        test_integrable();
        test_measured();
        test_interval();
        test_refusals();
        test_stop();
    }
    iso_context_free(ctx);
    return gsl_test_summary();
}

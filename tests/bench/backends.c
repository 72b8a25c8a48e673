/* bench_backends - the same free ball's orbit by the equations of the ball and by those of the point.
 *
 *     cmake -S . -B .build/release && cmake --build .build/release -j 2 && .build/release/tests/bench_backends
 *
 * For each k there are 9 random starts of a ball with J = (1.4, 2.1, 3.0), and 9 with random J up to max J/min J =
 * 10. Each is followed to t = 1000 by method taylor. The reference is taylor_extended by the ball.
 *
 * How to read the output. `time` is the processor time of the ball divided by that of the point, to t = 1000, with 1,
 * 1000, 2000 and 10000 rows; n turns by about one radian in a time of 1, and passes of the two alternate. `error` is
 * the largest error of (omega, n) at t = 1000 in units of their size: the medians by the ball and by the point, and
 * the median and the largest of the ratios point/ball, at tolerances 1e-12 and 1e-15.
 */
#include "api/typed_impl.h"
#include "base/random_impl.h"
#include "bench.h"

enum { STARTS = 18, PASSES = 5, END = 1000, QUESTIONS = 4 };
static const int rows_asked[QUESTIONS] = {1, 1000, 2000, 10000};

typedef struct ball {
    iso_params p;
    iso_start start;
} ball;

static ball sample(iso_context *ctx, double k, int i)
{
    iso_random *random = iso_random_create(100 + (unsigned long)i);
    double J[3] = {1.4, 2.1, 3.0}, n[3], w[3], length = 0, along = 0;
    ball b;
    for (int j = 0; j < 3 && i % 2; j++) J[j] = pow(10, iso_random_uniform(random, 0, 1));
    for (int j = 0; j < 3; j++) n[j] = iso_random_normal(random), w[j] = iso_random_normal(random);
    for (int j = 0; j < 3; j++) length += n[j] * n[j];
    for (int j = 0; j < 3; j++) n[j] /= sqrt(length), along += n[j] * w[j];
    for (int j = 0; j < 3; j++) w[j] -= along * n[j];
    length = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) * fabs(k); /* n turns at rate 1 */
    for (int j = 0; j < 3; j++) w[j] /= length;
    b.p = bench_params(ctx, k, J);
    bench_must(ctx, iso_start_ball(ctx, w, n, ISO_SPIN_REMOVE, &b.start));
    iso_random_free(random);
    return b;
}

/* Milliseconds for an orbit to END, with so many rows; its last state in y. Negative: it cannot be had. */
static double follow(iso_context *ctx, const ball *b, iso_backend backend, const char *method, double tolerance,
                     int rows, double y[ISO_STATE])
{
    iso_orbit *orbit;
    iso_sample s;
    iso_orbit_options o = iso_orbit_defaults(&b->start);
    o.backend = backend, o.method = iso_method_find(method), o.tolerance = tolerance;
    const double begin = bench_milliseconds();
    iso_status status = iso_orbit_create(ctx, &b->p, &b->start, &o, &orbit);
    for (int i = 1; i <= rows && status == ISO_OK; i++) status = iso_orbit_at(orbit, (double)END * i / rows, &s);
    const double end = bench_milliseconds();
    iso_orbit_free(orbit);
    for (int i = 0; i < ISO_STATE; i++) y[i] = status == ISO_OK ? s.ball[i] : NAN;
    return status == ISO_OK ? end - begin : -1;
}

/* ball/point, the median of PASSES */
static double time_ratio(iso_context *ctx, const ball *b, int rows)
{
    double ratio[PASSES], y[ISO_STATE], time[2];
    for (int pass = 0; pass < PASSES; pass++) {
        for (int i = 0; i < 2; i++) {
            const iso_backend backend = (i + pass) % 2 ? ISO_BACKEND_POINT : ISO_BACKEND_BALL;
            time[backend] = follow(ctx, b, backend, "taylor", 1e-12, rows, y);
        }
        ratio[pass] = time[ISO_BACKEND_BALL] / time[ISO_BACKEND_POINT];
    }
    return bench_median(ratio, PASSES);
}

static void row(iso_context *ctx, double k)
{
    static const double tolerances[2] = {1e-12, 1e-15};
    double time[QUESTIONS][STARTS], error[2][2][STARTS], ratio[2][STARTS], y[ISO_STATE], truth[ISO_STATE];
    for (int i = 0; i < STARTS; i++) {
        const ball b = sample(ctx, k, i);
        follow(ctx, &b, ISO_BACKEND_BALL, "taylor_extended", 1e-15, 1, truth);
        for (int q = 0; q < QUESTIONS; q++) time[q][i] = time_ratio(ctx, &b, rows_asked[q]);
        for (int t = 0; t < 2; t++) {
            for (int backend = 0; backend < 2; backend++) {
                follow(ctx, &b, (iso_backend)backend, "taylor", tolerances[t], 1, y);
                error[t][backend][i] = bench_error(y, truth);
            }
            ratio[t][i] = error[t][ISO_BACKEND_POINT][i] / error[t][ISO_BACKEND_BALL][i];
        }
    }
    printf("%8g ", k);
    for (int q = 0; q < QUESTIONS; q++) printf(" %5.2f", bench_median(time[q], STARTS));
    for (int t = 0; t < 2; t++) {
        for (int backend = 0; backend < 2; backend++) printf("  %8.1e", bench_median(error[t][backend], STARTS));
        printf(" %5.2f", bench_median(ratio[t], STARTS));
        printf(" %6.2f", ratio[t][STARTS - 1]);
    }
    printf("\n");
    fflush(stdout);
}

int main(void)
{
    static const double ks[] = {-1, 1, 0.5, 0.75, -0.4, -3, 2, 0.25, 0.125, 0.05, -0.05, 50, -50};
    iso_context *ctx = iso_context_create();
    printf("%8s  %-29s  %-32s  %s\n", "k", "time: end, rows", "error at 1e-12: ball point ratio",
           "the same at 1e-15");
    for (size_t i = 0; i < sizeof ks / sizeof *ks; i++) row(ctx, ks[i]);
    iso_context_free(ctx);
    return 0;
}

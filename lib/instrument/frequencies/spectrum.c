/* spectrum.c - the lines of a quasi-periodic signal: frequency analysis (J. Laskar, Physica D 67, 1993, 257).
 *
 *     x(t) = sum_l a_l exp(i nu_l t),   found one after the other, the largest first: nu maximises
 *     |phi(nu)|,   phi(nu) = (1/2T) int_-T^T x(t) exp(-i nu t) chi_p(t) dt,
 *     chi_p(t) = 2^p (p!)^2/(2p)! (1 + cos(pi t/T))^p,   p = 3,
 *
 * First the largest bin of a discrete Fourier transform is taken, then Newton's method refines it. Then the
 * amplitudes of all lines found so far are fitted anew (they are not orthogonal) and taken out of x. Two lines at a
 * distance d disturb each other like (1/dT)^(2p+1). So the frequencies are exact nearly to rounding if each pair of
 * lines beats a few dozen times in the signal; a Fourier transform alone finds them to 1/T.
 */
#include "instrument/frequencies/frequencies_impl.h"

#include <complex.h>
#include <gsl/gsl_fft_complex.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/context_impl.h"
#include "base/math_impl.h"

static const double LEAST = 1e-14; /* amplitudes that count, relative to the largest */

enum {
    POWER = 3,       /* p of the window */
    BLOCK = 32,      /* samples over which a phase factor is carried by products */
    ITERATIONS = 12, /* Newton's method has converged long before */
};

/* Times are y = t/T in (-1, 1), counted from the middle; a frequency s = nu T. */
typedef struct analysis {
    const iso_context *ctx;
    bool stopped;
    size_t count;
    const double *signal;
    double *window, *rest, *work; /* chi(y_j); what is left of the signal; for the transform */
    gsl_fft_complex_wavetable *table;
    gsl_fft_complex_workspace *space;
    int lines;
    double s[ISO_MAX_LINES], least;
    double complex a[ISO_MAX_LINES], projection[ISO_MAX_LINES]; /* amplitudes, with the phase in the middle; <e, x> */
} analysis;

static double y_of(const analysis *z, size_t j)
{
    return (2 * (double)j + 1) / (double)z->count - 1;
}

/* --- one line --------------------------------------------------------------------------------------------------- */

/* exp(i s y_j), j = 0, 1, ...: each is the product of the one before with a constant factor; every BLOCK samples it
 * is computed anew. (In real numbers, because the product of C's complex numbers also checks for infinities.) */
typedef struct wave {
    double s, re, im, turn_re, turn_im;
} wave;

static wave wave_of(const analysis *z, double s)
{
    return (wave){.s = s, .turn_re = cos(2 * s / (double)z->count), .turn_im = sin(2 * s / (double)z->count)};
}

static inline void wave_to(const analysis *z, size_t j, wave *w)
{
    if (j % BLOCK == 0) {
        w->re = cos(w->s * y_of(z, j));
        w->im = sin(w->s * y_of(z, j));
        return;
    }
    const double re = w->re * w->turn_re - w->im * w->turn_im;
    w->im = w->re * w->turn_im + w->im * w->turn_re;
    w->re = re;
}

/* phi(s) and its first two derivatives: (1/N) sum_j chi x (-i y)^m exp(-i s y) */
static void fourier(const analysis *z, const double x[], double s, double complex phi[3])
{
    wave w = wave_of(z, s);
    double sum[6] = {0};
    for (size_t j = 0; j < z->count; j++) {
        const double y = y_of(z, j), a = z->window[j] * x[2 * j], b = z->window[j] * x[2 * j + 1];
        wave_to(z, j, &w);
        const double re = a * w.re + b * w.im, im = b * w.re - a * w.im;
        sum[0] += re, sum[1] += im;
        sum[2] += y * re, sum[3] += y * im;
        sum[4] += y * y * re, sum[5] += y * y * im;
    }
    const double n = (double)z->count;
    phi[0] = (sum[0] + I * sum[1]) / n;
    phi[1] = (sum[3] - I * sum[2]) / n;
    phi[2] = -(sum[4] + I * sum[5]) / n;
}

/* The maximum of |phi|^2 near s, by Newton's method on its slope, at most two bins of the transform (pi) from s. */
static double refine(const analysis *z, const double x[], double s)
{
    double complex phi[3];
    const double begin = s;
    for (int i = 0; i < ITERATIONS; i++) {
        fourier(z, x, s, phi);
        const double slope = creal(conj(phi[0]) * phi[1]);
        const double bend = creal(conj(phi[1]) * phi[1] + conj(phi[0]) * phi[2]);
        const double step = bend < 0 ? -slope / bend : copysign(ISO_PI / 4, slope);
        const double next = fmin(fmax(s + step, begin - 2 * ISO_PI), begin + 2 * ISO_PI);
        const double moved = fabs(next - s);
        s = next;
        if (!(moved > 1e-13 * fmax(1, fabs(s)))) break;
    }
    return s;
}

/* --- all lines -------------------------------------------------------------------------------------------------- */

/* <e_k, e_l> in the window: a sum of Dirichlet's kernels, as (1 + cos x)^p = 2^-p sum_m binomial(2p, p+m) e^(imx). */
static double overlap(size_t count, double s)
{
    const double n = (double)count;
    double sum = 0, weight = 1;
    for (int m = 0; m <= POWER; m++) {
        for (int sign = -1; sign <= (m > 0 ? 1 : -1); sign += 2) {
            const double x = 2 * (s + sign * m * ISO_PI) / n, down = n * sin(x / 2);
            sum += weight * (fabs(down) < 1e-12 * n ? 1 : sin(n * x / 2) / down);
        }
        weight *= (double)(POWER - m) / (POWER + m + 1);
    }
    return sum;
}

/* x += a exp(i s y) */
static void add_line(const analysis *z, double x[], double s, double complex a)
{
    const double re = creal(a), im = cimag(a);
    wave w = wave_of(z, s);
    for (size_t j = 0; j < z->count; j++) {
        wave_to(z, j, &w);
        x[2 * j] += re * w.re - im * w.im;
        x[2 * j + 1] += re * w.im + im * w.re;
    }
}

/* <e, x> in the window, for the frequency of line l. */
static void project(analysis *z, int l)
{
    double complex phi[3];
    fourier(z, z->signal, z->s[l], phi);
    z->projection[l] = phi[0];
}

/* The amplitudes that fit the signal best in the window (least squares), and what is left of the signal. */
static void fit(analysis *z)
{
    const size_t n = (size_t)z->lines;
    double gram[ISO_MAX_LINES * ISO_MAX_LINES], b[2][ISO_MAX_LINES];
    for (size_t k = 0; k < n; k++) {
        b[0][k] = creal(z->projection[k]);
        b[1][k] = cimag(z->projection[k]);
        for (size_t l = 0; l < n; l++) gram[k * n + l] = overlap(z->count, z->s[k] - z->s[l]);
    }
    gsl_matrix_view G = gsl_matrix_view_array(gram, n, n);
    if (gsl_linalg_cholesky_decomp1(&G.matrix) != 0) return;
    for (int part = 0; part < 2; part++) {
        gsl_vector_view v = gsl_vector_view_array(b[part], n);
        gsl_linalg_cholesky_svx(&G.matrix, &v.vector);
    }
    memcpy(z->rest, z->signal, 2 * z->count * sizeof *z->rest);
    for (size_t k = 0; k < n; k++) {
        z->a[k] = b[0][k] + I * b[1][k];
        add_line(z, z->rest, z->s[k], -z->a[k]);
    }
}

/* False once a stop was asked for. It is asked for each line, because a pass over many samples takes long. */
static bool goes_on(analysis *z)
{
    z->stopped = z->stopped || !iso_context_goes_on(z->ctx);
    return !z->stopped;
}

/* Takes the largest line out of the rest: from the largest bin of its transform in the window. False: the rest is
 * rounding, or too near to a line found before. */
static bool find_line(analysis *z)
{
    const size_t N = z->count;
    size_t best = 0;
    double size = 0;
    for (size_t j = 0; j < N; j++) {
        z->work[2 * j] = z->window[j] * z->rest[2 * j];
        z->work[2 * j + 1] = z->window[j] * z->rest[2 * j + 1];
    }
    gsl_fft_complex_forward(z->work, 1, N, z->table, z->space);
    for (size_t j = 0; j < N; j++) {
        const double re = z->work[2 * j], im = z->work[2 * j + 1], here = re * re + im * im;
        if (here > size) size = here, best = j;
    }
    size = sqrt(size) / (double)N;
    if (z->lines == 0) z->least = LEAST * size;
    if (!(size > z->least)) return false;
    const double s = refine(z, z->rest, ISO_PI * (best < N / 2 ? (double)best : (double)best - (double)N));
    for (int l = 0; l < z->lines; l++)
        if (fabs(s - z->s[l]) < 2 * ISO_PI) return false;
    z->s[z->lines] = s;
    project(z, z->lines++);
    fit(z);
    return true;
}

/* In the window chi(y) = prod_{m<=p} 2m/(2m-1) cos^2p(pi y/2), of mean 1. Each line is refined once more after the
 * others were taken out, which had shifted it when it was found. */
static void find_lines(analysis *z, int most)
{
    double peak = 1;
    for (int m = 1; m <= POWER; m++) peak *= 2.0 * m / (2.0 * m - 1);
    for (size_t j = 0; j < z->count; j++) z->window[j] = peak * pow(cos(ISO_PI / 2 * y_of(z, j)), 2 * POWER);
    memcpy(z->rest, z->signal, 2 * z->count * sizeof *z->signal);
    while (z->lines < most && goes_on(z) && find_line(z)) continue;
    for (int l = 0; l < z->lines && goes_on(z); l++) {
        add_line(z, z->rest, z->s[l], z->a[l]);
        z->s[l] = refine(z, z->rest, z->s[l]);
        add_line(z, z->rest, z->s[l], -z->a[l]);
        project(z, l);
    }
    if (z->lines > 0) fit(z);
}

static int by_amplitude(const void *a, const void *b)
{
    const double x = ((const iso_spectral_line *)a)->amplitude, y = ((const iso_spectral_line *)b)->amplitude;
    return (x < y) - (x > y);
}

iso_status iso_spectrum_find(iso_context *ctx, const double signal[], size_t count, double step, int most,
                             iso_spectral_line line[], int *found)
{
    ISO_DEFAULT_ARITHMETIC;
    *found = 0;
    if (count < 64 || (count & (count - 1)) != 0 || !(step > 0) || !isnormal(step) ||
        !isfinite(step * (double)count) || most < 1 || most > ISO_MAX_LINES)
        return ISO_FAIL_ARGUMENT(ctx, "",
                                 "a spectrum needs a power of two samples, 64 or more, a step > 0, and 1 to %d lines",
                                 ISO_MAX_LINES);
    for (size_t j = 0; j < 2 * count; j++)
        if (!isfinite(signal[j])) return ISO_FAIL_NUMERICAL(ctx, "a sample of the signal is not finite");
    analysis z = {.ctx = ctx, .count = count, .signal = signal, .window = malloc(5 * count * sizeof *z.window)};
    z.table = gsl_fft_complex_wavetable_alloc(count);
    z.space = gsl_fft_complex_workspace_alloc(count);
    const bool memory = z.window && z.table && z.space;
    if (memory) {
        z.rest = z.window + count;
        z.work = z.window + 3 * count;
        find_lines(&z, most);
        for (int l = 0; l < z.lines; l++) {
            const double complex at_start = z.a[l] * cexp(I * z.s[l] * y_of(&z, 0));
            line[l] = (iso_spectral_line){z.s[l] / (step * (double)count / 2), cabs(at_start), carg(at_start)};
        }
        qsort(line, (size_t)z.lines, sizeof *line, by_amplitude);
        *found = z.stopped ? 0 : z.lines;
    }
    gsl_fft_complex_workspace_free(z.space);
    gsl_fft_complex_wavetable_free(z.table);
    free(z.window);
    if (!memory) return iso_context_no_memory(ctx, "a spectrum");
    return z.stopped ? iso_context_stopped(ctx) : ISO_OK;
}

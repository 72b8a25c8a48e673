/* frequencies_impl.h - what the closed and the estimated frequencies share. */
#ifndef ISO_STUDY_FREQUENCIES_IMPL_H
#define ISO_STUDY_FREQUENCIES_IMPL_H

#include "base/math_impl.h"
#include "instrument/frequencies/frequencies.h"
#include "instrument/frequencies/momentum.h"
#include "instrument/frequencies/spectrum.h"

/* Of a motion that is refused (refusals.c). */
#define ISO_NO_FREQUENCIES "has no frequencies"

/* Errors: ISO_BAD_ARGUMENT. */
iso_status iso_frequencies_check(iso_context *ctx, const iso_frequencies_options *options);

/* Nothing known. */
void iso_frequencies_blank(iso_frequencies *f);

/* An orbit of the scene's start with both models where there are both, at its start. The effects that act must stay
 * where they are as long as the orbit lives. Errors: those of iso_refuse_rest, iso_orbit_create and iso_orbit_at. */
iso_status iso_frequencies_open(iso_context *ctx, const iso_scene *scene, const iso_effects *effects,
                                iso_orbit **orbit, iso_sample *sample);

/* h, eps, H and F from the orbit at its start. */
void iso_frequencies_place(const iso_orbit *orbit, const iso_sample *start, iso_frequencies *f);

/* From the frequencies: periods, rotation number, resonances, period of a closed orbit. */
void iso_frequencies_finish(iso_frequencies *f);

/* --- the lines of a signal (spectrum.c) ------------------------------------------------------------------------- */

/* Up to `most` <= ISO_MAX_LINES lines of the signal with real parts signal[2 j] and imaginary parts signal[2 j + 1]
 * at the times j step, j < count; count a power of 2, 64 or more. The largest come first. There are fewer (*found <
 * most) where what is left is rounding (amplitudes below 1e-14 of the largest), or where the largest bin of it lies
 * within the resolution 4 pi/(count step) of a line found before.
 * Errors: ISO_BAD_ARGUMENT (count, step, most), ISO_NUMERICAL (a sample that is not finite), ISO_NO_MEMORY,
 * ISO_STOPPED. */
iso_status iso_spectrum_find(iso_context *ctx, const double signal[], size_t count, double step, int most,
                             iso_spectral_line line[], int *found);

/* --- the two frequencies of which the lines of n(t) are combinations (frequencies_common.c) --------------------- */

enum { ISO_LINES = 16, ISO_PART_LINES = 8, ISO_MOST_FACTOR = 16 /* of a frequency in a combination */ };

/* A line is taken for a combination when it differs from it by less than this part of the resolution. */
#define ISO_NEAR 0.02

/* Samples of n in one clock, as complex signals. */
typedef struct series {
    size_t count;
    double step;
    double *pair, *third; /* n_j + i n_l; n_axis */
} series;

/* The two basic lines of a signal. */
typedef struct basis {
    int angles;
    bool of_pair[2];     /* in which signal the line is */
    double frequency[2]; /* of either sign */
} basis;

/* Lines of both signals of a part of a series. */
typedef struct line_list {
    int count[2];
    iso_spectral_line line[2][ISO_MAX_LINES]; /* of the pair, of the third */
    double resolution;
} line_list;

/* The lines of count samples of the series, from the first on. */
iso_status iso_basis_lines(iso_context *ctx, const series *s, size_t first, size_t count, int most, line_list *l);

/* The strongest line of the pair, and the strongest line that is no multiple of it: of the third, or else of the
 * pair. Where these two leave much unexplained: the two of the strongest lines that explain most. */
basis iso_basis_find(const line_list *l);

/* The basic frequencies of `whole` in a part of the series: the lines nearest to them. */
iso_status iso_basis_in_part(iso_context *ctx, const series *s, const basis *whole, size_t first, size_t count,
                             double frequency[2]);

/* The line of the pair, or of the third, that is nearest to nu; NaN: there is none. */
double iso_basis_nearest(const line_list *l, bool pair, double nu);

/* nu = m f0 + n f1 with the least |m| + |n|; f1 = 0: with n = 0. False: it is none. */
bool iso_basis_combine(double nu, const double f[2], double within, int *m, int *n);

/* The part of the amplitudes that is no combination of two frequencies. */
double iso_basis_unexplained(const line_list *l, const double f[2]);

/* --- rotations (momentum.c) ------------------------------------------------------------------------------------- */

/* F of the rotation about axis i = 0, 1, 2; i = 3: where the roots meet (infinite for k = 1). */
double iso_momentum_rotation(const iso_momentum *m, double h, int i);

#endif

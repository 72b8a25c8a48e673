/* frequencies_impl.h - what the closed and the estimated frequencies share. */
#ifndef ISO_INSTRUMENT_FREQUENCIES_FREQUENCIES_IMPL_H
#define ISO_INSTRUMENT_FREQUENCIES_FREQUENCIES_IMPL_H

#include "base/math_impl.h"
#include "instrument/frequencies/frequencies.h"

/* Of a motion that is refused (refusals.c). */
#define ISO_NO_FREQUENCIES "has no frequencies"

/* Errors: ISO_BAD_ARGUMENT. */
iso_status iso_frequencies_check(iso_context *ctx, const iso_frequencies_options *options);

/* An orbit of the scene's start with both models where there are both, at its start; f: nothing known. The effects that
 * act must stay where they are as long as the orbit lives. Errors: those of iso_refuse_rest, iso_orbit_create and
 * iso_orbit_at. */
iso_status iso_frequencies_open(iso_context *ctx, const iso_scene *scene, const iso_effects *effects,
                                iso_orbit **orbit, iso_sample *sample, iso_frequencies *f);

/* h, eps, H and F from the orbit at its start. */
void iso_frequencies_place(const iso_orbit *orbit, const iso_sample *start, iso_frequencies *f);

/* From the frequencies: periods, frequency ratio, resonances, period of a closed orbit. */
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

/* --- rotations (momentum.c) ------------------------------------------------------------------------------------- */

/* F of the rotation about axis i = 0, 1, 2; i = 3: where the roots meet (infinite for k = 1). */
double iso_momentum_rotation(const iso_momentum *m, double h, int i);

#endif

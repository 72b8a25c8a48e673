/* spectrum_impl.h - finds the lines of spectrum.h. */
#ifndef ISO_STUDY_FREQUENCIES_SPECTRUM_IMPL_H
#define ISO_STUDY_FREQUENCIES_SPECTRUM_IMPL_H

#include "study/frequencies/spectrum.h"

/* Up to `most` <= ISO_MAX_LINES lines of the signal with real parts signal[2 j] and imaginary parts signal[2 j + 1]
 * at the times j step, j < count; count a power of 2, 64 or more. The largest come first. There are fewer (*found <
 * most) where what is left is rounding (amplitudes below 1e-14 of the largest), or where the largest bin of it lies
 * within the resolution 4 pi/(count step) of a line found before.
 * Errors: ISO_BAD_ARGUMENT (count, step, most), ISO_NUMERICAL (a sample that is not finite), ISO_NO_MEMORY,
 * ISO_STOPPED. */
iso_status iso_spectrum_find(iso_context *ctx, const double signal[], size_t count, double step, int most,
                             iso_spectral_line line[], int *found);

#endif

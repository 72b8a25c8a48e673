/* frequencies_basis_impl.h - the two frequencies of which the lines of n(t) are combinations. */
#ifndef ISO_STUDY_BASIS_IMPL_H
#define ISO_STUDY_BASIS_IMPL_H

#include "study/frequencies/spectrum.h"

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
typedef struct lines {
    int count[2];
    iso_spectral_line line[2][ISO_MAX_LINES]; /* of the pair, of the third */
    double resolution;
} lines;

/* The lines of count samples of the series, from the first on. */
iso_status iso_basis_lines(iso_context *ctx, const series *s, size_t first, size_t count, int most, lines *l);

/* The strongest line of the pair, and the strongest line that is no multiple of it: of the third, or else of the
 * pair. Where these two leave much unexplained: the two of the strongest lines that explain most. */
basis iso_basis_find(const lines *l);

/* The basic frequencies of `whole` in a part of the series: the lines nearest to them. */
iso_status iso_basis_in_part(iso_context *ctx, const series *s, const basis *whole, size_t first, size_t count,
                             double frequency[2]);

/* The line of the pair, or of the third, that is nearest to nu; NaN: there is none. */
double iso_basis_nearest(const lines *l, bool pair, double nu);

/* nu = m f0 + n f1 with the least |m| + |n|; f1 = 0: with n = 0. False: it is none. */
bool iso_basis_combine(double nu, const double f[2], double within, int *m, int *n);

/* The part of the amplitudes that is no combination of two frequencies. */
double iso_basis_unexplained(const lines *l, const double f[2]);

#endif

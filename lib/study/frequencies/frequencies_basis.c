/* frequencies_basis.c - from the lines of n(t) to the two frequencies that they are combinations of. */
#include "study/frequencies/frequencies_impl.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

iso_status iso_basis_lines(iso_context *ctx, const series *s, size_t first, size_t count, int most, line_list *l)
{
    l->resolution = 2 * ISO_PI / ((double)count * s->step);
    ISO_TRY(iso_spectrum_find(ctx, s->pair + 2 * first, count, s->step, most, l->line[0], &l->count[0]));
    return iso_spectrum_find(ctx, s->third + 2 * first, count, s->step, most, l->line[1], &l->count[1]);
}

bool iso_basis_combine(double nu, const double f[2], double within, int *m, int *n)
{
    int least = INT_MAX;
    for (int j = -ISO_MOST_FACTOR; j <= ISO_MOST_FACTOR; j++) {
        if (j != 0 && f[1] == 0) continue;
        const double i = round((nu - j * f[1]) / f[0]);
        const int size = abs(j) + (fabs(i) <= ISO_MOST_FACTOR ? abs((int)i) : INT_MAX / 2);
        if (size >= least || size >= INT_MAX / 2 || fabs(nu - j * f[1] - i * f[0]) > within) continue;
        least = size;
        *m = (int)i;
        *n = j;
    }
    return least < INT_MAX;
}

double iso_basis_unexplained(const line_list *l, const double f[2])
{
    double all = 0, unknown = 0;
    int m, n;
    for (int s = 0; s < 2; s++)
        for (int i = 0; i < l->count[s]; i++) {
            all += l->line[s][i].amplitude;
            if (!iso_basis_combine(l->line[s][i].frequency, f, ISO_NEAR * l->resolution, &m, &n))
                unknown += l->line[s][i].amplitude;
        }
    return all > 0 ? unknown / all : 0;
}

/* The strongest line of signal s that is no multiple of f (f = 0: the strongest that is not constant); -1: there is
 * none. Lines with an amplitude below 1e-10 are ignored. */
static int strongest(const line_list *l, int s, double f)
{
    for (int i = 0; i < l->count[s] && l->line[s][i].amplitude > 1e-10; i++) {
        const double nu = l->line[s][i].frequency, times = f != 0 ? round(nu / f) : 0;
        if (fabs(nu - times * f) > l->resolution || fabs(times) > ISO_MOST_FACTOR) return i;
    }
    return -1;
}

/* The strongest line of the pair, and the strongest line that is no multiple of it: of the third, or else of the
 * pair. */
static basis first_basis(const line_list *l)
{
    basis b = {.angles = 0};
    const int one = strongest(l, 0, 0);
    if (one < 0) return b;
    b = (basis){.angles = 1, .of_pair = {true}, .frequency = {l->line[0][one].frequency}};
    for (int s = 1; s >= 0 && b.angles == 1; s--) {
        const int other = strongest(l, s, b.frequency[0]);
        if (other < 0) continue;
        b.angles = 2;
        b.of_pair[1] = s == 0;
        b.frequency[1] = l->line[s][other].frequency;
    }
    return b;
}

basis iso_basis_find(const line_list *l)
{
    enum { STRONGEST = 12 };
    basis b = first_basis(l);
    double rest = iso_basis_unexplained(l, b.frequency);
    if (b.angles < 2 || rest < 1e-3) return b;
    for (int i = 0; i < 2 * STRONGEST; i++)
        for (int j = 0; j < i; j++) {
            const int s[2] = {i % 2, j % 2}, at[2] = {i / 2, j / 2};
            if (at[0] >= l->count[s[0]] || at[1] >= l->count[s[1]]) continue;
            const double f[2] = {l->line[s[0]][at[0]].frequency, l->line[s[1]][at[1]].frequency};
            if (fabs(f[0]) < l->resolution || fabs(f[1]) < l->resolution) continue;
            const double left = iso_basis_unexplained(l, f);
            if (left >= rest / 2) continue;
            rest = left;
            b = (basis){.angles = 2, .of_pair = {s[0] == 0, s[1] == 0}, .frequency = {f[0], f[1]}};
        }
    return b;
}

double iso_basis_nearest(const line_list *l, bool pair, double nu)
{
    const int s = pair ? 0 : 1;
    double best = NAN;
    for (int i = 0; i < l->count[s]; i++)
        if (!(fabs(l->line[s][i].frequency - nu) >= fabs(best - nu))) best = l->line[s][i].frequency;
    return best;
}

iso_status iso_basis_in_part(iso_context *ctx, const series *s, const basis *whole, size_t first, size_t count,
                             double frequency[2])
{
    line_list l;
    const iso_status status = iso_basis_lines(ctx, s, first, count, ISO_PART_LINES, &l);
    for (int i = 0; status == ISO_OK && i < whole->angles; i++)
        frequency[i] = iso_basis_nearest(&l, whole->of_pair[i], whole->frequency[i]);
    return status;
}

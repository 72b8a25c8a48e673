/* frequencies_common.c - what the closed and the estimated frequencies share: the check of the options, the orbit at
 * its start, where the motion lies in its family, and what follows from two frequencies (rotation number,
 * resonances); the two frequencies of which the lines of n(t) are combinations. */
#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "instrument/frequencies/frequencies_impl.h"
#include "orbit/orbit_impl.h"
#include "study/study_impl.h"

iso_status iso_frequencies_check(iso_context *ctx, const iso_frequencies_options *o)
{
    if (o->samples > ISO_MOST_SAMPLES)
        return ISO_FAIL_ARGUMENT(ctx, "samples", "an estimate takes %d samples at most", ISO_MOST_SAMPLES);
    if (!(o->turns <= 0) && !(o->end <= 0) && !(o->samples <= 0)) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "", "turns, the end and samples are numbers > 0");
}

void iso_frequencies_blank(iso_frequencies *f)
{
    *f = (iso_frequencies){
        .kind = ISO_EXACT_KINDS, .h = NAN, .eps = NAN, .H = NAN, .F = NAN, .c = NAN, .rotation = NAN};
    for (int c = 0; c < ISO_CLOCKS; c++) f->closed[c] = NAN;
    for (int i = 0; i < 2; i++) {
        iso_angle *a = &f->angle[i];
        a->drift = a->action = NAN;
        for (int c = 0; c < ISO_CLOCKS; c++) a->frequency[c] = a->period[c] = a->error[c] = NAN;
    }
    f->estimate.axis = -1;
}

/* --- rotation number and resonances ----------------------------------------------------------------------------- */

/* A fraction q/p near the rotation number. Frequencies from the closed solution are known to rounding. */
static iso_resonance resonance_of(const iso_frequencies *f, int p, int q)
{
    iso_resonance r = {.p = p, .q = q, .gap = INFINITY, .met = true};
    for (int c = 0; c < ISO_CLOCKS; c++) {
        const double one = p * f->angle[0].frequency[c], other = q * f->angle[1].frequency[c],
                     gap = fabs(one - other);
        const double errors = p * f->angle[0].error[c] + q * f->angle[1].error[c];
        const bool met = gap <= 1e-14 * one + (f->estimated ? errors : 0);
        r.beat[c] = isnan(gap) ? NAN : met ? INFINITY : 2 * ISO_PI / gap;
        if (isnan(gap)) continue;
        r.gap = fmin(r.gap, gap / one);
        r.met = r.met && met;
    }
    return r;
}

/* The convergents of the rotation number's continued fraction. */
static void find_resonances(iso_frequencies *f)
{
    double rest = f->rotation;
    int q = 1, p = 0, q_before = 0, p_before = 1; /* q/p, from 1/0 and 0/1 */
    while (f->resonances < ISO_MAX_RESONANCES && rest < 1e3) {
        const int whole = (int)floor(rest), q_next = whole * q + q_before, p_next = whole * p + p_before;
        if (q_next > 100 || p_next > 100) return;
        q_before = q, p_before = p, q = q_next, p = p_next;
        if (q > 0) f->resonance[f->resonances++] = resonance_of(f, p, q);
        if (f->resonances > 0 && f->resonance[f->resonances - 1].met) return;
        rest = 1 / (rest - whole);
    }
}

/* An orbit is closed if it has one angle, or if a resonance is met exactly, which an estimate cannot decide. */
static void find_closed(iso_frequencies *f)
{
    const iso_resonance *last = f->resonances > 0 ? &f->resonance[f->resonances - 1] : NULL;
    const double turns = f->angles == 1 ? 1 : last && last->met ? last->q * 1.0 : (double)NAN;
    for (int c = 0; c < ISO_CLOCKS && !f->estimated; c++) f->closed[c] = turns * f->angle[0].period[c];
}

/* Whether two frequencies explain most of the motion. */
static bool is_steady(const iso_frequencies *f)
{
    static const double MOST_UNEXPLAINED = 0.5;
    return !f->estimated || (f->estimate.verdict != ISO_CHAOTIC && !(f->estimate.unexplained > MOST_UNEXPLAINED));
}

void iso_frequencies_finish(iso_frequencies *f)
{
    for (int i = 0; i < f->angles; i++)
        for (int c = 0; c < ISO_CLOCKS; c++) f->angle[i].period[c] = 2 * ISO_PI / f->angle[i].frequency[c];
    if (f->angles == 2 && is_steady(f)) {
        f->rotation = f->angle[0].frequency[ISO_CLOCK_T] / f->angle[1].frequency[ISO_CLOCK_T];
        find_resonances(f);
    }
    find_closed(f);
}

/* --- where the motion lies in its family --------------------------------------------------------------------- */

void iso_frequencies_place(const iso_orbit *orbit, const iso_sample *start, iso_frequencies *f)
{
    double size;
    f->h = iso_orbit_energy(orbit);
    f->eps = iso_orbit_has_twin(orbit) ? iso_orbit_coupling(orbit) : NAN;
    if (iso_orbit_has_twin(orbit)) { /* then the model is the point's, and its level is H */
        const iso_dimension M = iso_system_point.fast_dimension;
        f->H = iso_orbit_model(orbit)->problem.energy *
               iso_unit(iso_orbit_units(orbit), (iso_dimension){2 * M.J, 2 * M.J_2k, 2 * M.w});
    }
    f->integral = iso_orbit_additional_integral(orbit);
    if (!f->integral) return;
    f->F = iso_orbit_integral(orbit, &iso_system_ball, f->integral, start, &size);
    f->F *= iso_unit(iso_orbit_units(orbit), f->integral->dimension);
}

iso_status iso_frequencies_open(iso_context *ctx, const iso_scene *scene, const iso_effects *effects,
                                iso_orbit **orbit, iso_sample *sample)
{
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    const bool twin = !iso_effects_breaking(effects);
    *orbit = NULL;
    o.effects = effects;
    o.backend = twin ? ISO_BACKEND_POINT : ISO_BACKEND_BALL;
    o.shown = twin ? ISO_SHOW_BOTH : ISO_SHOW_BALL;
    ISO_TRY(iso_refuse_rest(ctx, &scene->start, effects, ISO_NO_FREQUENCIES));
    ISO_TRY(iso_orbit_create(ctx, &scene->params, &scene->start, &o, orbit));
    return iso_orbit_at(*orbit, 0, sample);
}

/* --- basis ------------------------------------------------------------------------------------------------------ */

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

/* frequencies_estimate.c - the frequencies of a motion from the lines of its n(t), see frequencies.h. */
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/vec3_impl.h"
#include "instrument/frequencies/frequencies_impl.h"
#include "orbit/orbit_impl.h"
#include "study/study.h"
#include "study/study_impl.h"

/* Relative differences between the halves of an orbit below this are rounding. */
static const double ROUNDING = 1e-14;

static const double LEAST_TURNS = 20;

/* A line is taken for a combination when it differs from it by less than this part of the resolution. */
static const double NEAR = 0.02;

/* MOST_TURNS: for the study of chaos; the caller may ask for fewer. MOST_FACTOR: of a frequency in a combination. */
enum { MOST_TURNS = 3000, LINES = 16, PART_LINES = 8, MOST_FACTOR = 16 };

/* Samples of n in one clock, as complex signals: the pair n_j + i n_l, and the third, n_axis. */
typedef struct series {
    size_t count;
    double step, *pair, *third;
} series;

/* Lines of both signals of a part of a series. */
typedef struct line_list {
    int count[2];
    iso_spectral_line line[2][ISO_MAX_LINES]; /* of the pair, of the third */
    double resolution;
} line_list;

/* The two basic lines of a series. */
typedef struct basis {
    int angles;
    int of[2];           /* in which signal the line is: 0 the pair, 1 the third */
    double frequency[2]; /* of either sign */
} basis;

typedef struct estimator {
    iso_context *ctx;
    const iso_scene *scene;
    const iso_frequencies_options *options;
    iso_effects effects;
    bool twin, fixed; /* whether there is a point, and so other clocks; whether the caller gave the length */
    size_t count;
    double end[ISO_CLOCKS];
    long turns;            /* in which the study of chaos may decide */
    iso_verdict indicated; /* what it says                               */
    iso_frequencies *f;
} estimator;

/* --- the signals ------------------------------------------------------------------------------------------------ */

/* n at the samples, three numbers each, and the mean of omega. In t it also finds the ends of the other clocks. */
static iso_status sample(estimator *e, iso_clock clock, double n[], double mean[3])
{
    iso_orbit_options o = iso_orbit_defaults(&e->scene->start);
    iso_orbit *orbit;
    iso_sample s;
    o.effects = &e->effects;
    o.clock = clock;
    o.shown = ISO_SHOW_BALL;
    o.backend = e->twin ? ISO_BACKEND_AUTO : ISO_BACKEND_BALL;
    o.tolerance = fmin(e->scene->tolerance, 1e-13);
    for (int c = 0; c < ISO_CLOCKS; c++) o.with_clock[c] = e->twin && clock == ISO_CLOCK_T && c != (int)clock;
    iso_status status = iso_orbit_create(e->ctx, &e->scene->params, &e->scene->start, &o, &orbit);
    for (size_t j = 0; status == ISO_OK && j < e->count; j++) {
        status = iso_orbit_at(orbit, e->end[clock] * (double)j / (double)e->count, &s);
        if (status != ISO_OK) break;
        copy(s.ball + 3, n + 3 * j, 3);
        if (e->options->progress) e->options->progress(e->options->data, (double)j / (double)e->count);
        add_scaled(mean, 1 / (double)e->count, s.ball);
    }
    if (status == ISO_OK && clock == ISO_CLOCK_T) {
        status = iso_orbit_at(orbit, e->end[clock], &s);
        for (int c = ISO_CLOCK_TAU; e->twin && c < ISO_CLOCKS; c++) e->end[c] = s.clock[c];
    }
    iso_orbit_free(orbit);
    return status;
}

/* The signals of one clock. The axis of the estimate is that along which the mean of omega is largest. */
static iso_status make_series(estimator *e, iso_clock clock, series *s)
{
    int *const axis = &e->f->estimate.axis;
    double mean[3] = {0}, *const n = malloc(7 * e->count * sizeof *n);
    *s = (series){.count = e->count, .step = e->end[clock] / (double)e->count};
    s->pair = malloc(4 * e->count * sizeof *s->pair);
    s->third = s->pair ? s->pair + 2 * e->count : NULL;
    const iso_status status = n && s->pair ? sample(e, clock, n, mean) : iso_context_no_memory(e->ctx, "the samples");
    if (*axis < 0)
        for (int i = *axis = 0; i < 3; i++)
            if (fabs(mean[i]) > fabs(mean[*axis])) *axis = i;
    for (size_t j = 0; status == ISO_OK && j < s->count; j++) {
        s->pair[2 * j] = n[3 * j + (size_t)(*axis + 1) % 3];
        s->pair[2 * j + 1] = n[3 * j + (size_t)(*axis + 2) % 3];
        s->third[2 * j] = n[3 * j + (size_t)*axis];
        s->third[2 * j + 1] = 0;
    }
    free(n);
    return status;
}

/* --- the two frequencies of which the lines of n(t) are combinations -------------------------------------------- */

/* The lines of count samples of the series, from the first on. */
static iso_status find_lines(iso_context *ctx, const series *s, size_t first, size_t count, int most, line_list *l)
{
    l->resolution = 2 * ISO_PI / ((double)count * s->step);
    ISO_TRY(iso_spectrum_find(ctx, s->pair + 2 * first, count, s->step, most, l->line[0], &l->count[0]));
    return iso_spectrum_find(ctx, s->third + 2 * first, count, s->step, most, l->line[1], &l->count[1]);
}

/* nu = m f0 + n f1 with the least |m| + |n|; f1 = 0: with n = 0. False: it is none. */
static bool combine(double nu, const double f[2], double within, int *m, int *n)
{
    int least = INT_MAX;
    for (int j = -MOST_FACTOR; j <= MOST_FACTOR; j++) {
        if (j != 0 && f[1] == 0) continue;
        const double i = round((nu - j * f[1]) / f[0]);
        const int size = abs(j) + (fabs(i) <= MOST_FACTOR ? abs((int)i) : INT_MAX / 2);
        if (size >= least || size >= INT_MAX / 2 || fabs(nu - j * f[1] - i * f[0]) > within) continue;
        least = size;
        *m = (int)i;
        *n = j;
    }
    return least < INT_MAX;
}

/* The part of the amplitudes that is no combination of two frequencies. */
static double unexplained(const line_list *l, const double f[2])
{
    double all = 0, unknown = 0;
    int m, n;
    for (int s = 0; s < 2; s++)
        for (int i = 0; i < l->count[s]; i++) {
            all += l->line[s][i].amplitude;
            if (!combine(l->line[s][i].frequency, f, NEAR * l->resolution, &m, &n))
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
        if (fabs(nu - times * f) > l->resolution || fabs(times) > MOST_FACTOR) return i;
    }
    return -1;
}

/* The strongest line of the pair, and the strongest line that is no multiple of it: of the third, or else of the
 * pair. Where these two leave much unexplained: the two of the strongest lines that explain most. */
static basis find_basis(const line_list *l)
{
    enum { STRONGEST = 12 };
    const int one = strongest(l, 0, 0);
    if (one < 0) return (basis){.angles = 0};
    basis b = {.angles = 1, .frequency = {l->line[0][one].frequency}};
    for (int s = 1; s >= 0 && b.angles == 1; s--) {
        const int other = strongest(l, s, b.frequency[0]);
        if (other >= 0) b = (basis){2, {0, s}, {b.frequency[0], l->line[s][other].frequency}};
    }
    double rest = unexplained(l, b.frequency);
    if (b.angles < 2 || rest < 1e-3) return b;
    for (int i = 0; i < 2 * STRONGEST; i++)
        for (int j = 0; j < i; j++) {
            const int s[2] = {i % 2, j % 2}, at[2] = {i / 2, j / 2};
            if (at[0] >= l->count[s[0]] || at[1] >= l->count[s[1]]) continue;
            const double f[2] = {l->line[s[0]][at[0]].frequency, l->line[s[1]][at[1]].frequency};
            if (fabs(f[0]) < l->resolution || fabs(f[1]) < l->resolution) continue;
            const double left = unexplained(l, f);
            if (left >= rest / 2) continue;
            rest = left;
            b = (basis){2, {s[0], s[1]}, {f[0], f[1]}};
        }
    return b;
}

/* The line of signal s that is nearest to nu; NaN: there is none. */
static double nearest(const line_list *l, int s, double nu)
{
    double best = NAN;
    for (int i = 0; i < l->count[s]; i++)
        if (!(fabs(l->line[s][i].frequency - nu) >= fabs(best - nu))) best = l->line[s][i].frequency;
    return best;
}

/* --- regular or chaotic ----------------------------------------------------------------------------------------- */

/* The largest relative change of a basic frequency between two neighbouring parts of `count` samples each. */
static iso_status find_drift(estimator *e, const series *s, const basis *b, size_t count, double drift[2],
                             double error[2])
{
    line_list part[2];
    for (size_t p = 0; p < 2; p++) ISO_TRY(find_lines(e->ctx, s, p * count, count, PART_LINES, &part[p]));
    for (int i = 0; i < b->angles; i++) {
        const double f = b->frequency[i], one = nearest(&part[0], b->of[i], f),
                     other = nearest(&part[1], b->of[i], f);
        drift[i] = fabs((one - other) / f);
        error[i] = fmax(fmax(fabs(one - f), fabs(other - f)), ROUNDING * fabs(f));
    }
    return ISO_OK;
}

/* The longer the orbit, the smaller the drift of a regular motion's frequencies, once the orbit has a dozen beats.
 * The frequencies of a chaotic motion go on changing. An integrable problem has no chaotic motion. */
static iso_verdict verdict_of(const iso_estimate *e, const basis *b, bool integrable)
{
    static const double SAME = 1e-8, WANDERING = 1e-6, BEATS = 12;
    double slowest = b->angles == 1 ? fabs(b->frequency[0]) : INFINITY; /* of the small combinations of both */
    if (b->angles > 0 && e->drift <= SAME) return ISO_REGULAR;
    if (integrable) return ISO_INTEGRABLE;
    for (int m = -3; m <= 3; m++)
        for (int n = 0; n <= 3; n++)
            if (b->angles == 2 && (m != 0 || n != 0))
                slowest = fmin(slowest, fabs(m * b->frequency[0] + n * b->frequency[1]));
    const bool wanders = b->angles > 0 && e->drift >= WANDERING && e->drift > e->drift_before / 8;
    return wanders && slowest * e->length / 2 / (2 * ISO_PI) > BEATS ? ISO_CHAOTIC : ISO_UNDECIDED;
}

/* The study "chaos" is sharper than the drift of frequencies. The drift decides only where chaos does not, or cannot be
 * computed (effects without deviations). */
static iso_status ask_chaos(estimator *e)
{
    const bool point = e->twin && iso_point_is_better(&e->scene->params);
    const iso_study *chaos = iso_study_find("chaos");
    const iso_study_subject subject = {.scene = e->scene};
    iso_study_result result = {.found = NULL};
    char options[64];
    e->indicated = ISO_UNDECIDED;
    if (e->f->integral || !chaos) return ISO_OK;
    snprintf(options, sizeof options, "turns=%ld\nmodel=%s", e->turns,
             iso_model_kind_name(point ? ISO_POINT : ISO_BALL));
    const iso_status status = iso_study_ask_text(e->ctx, chaos, &subject, options, &result);
    const char *verdict = status == ISO_OK ? iso_record_get(result.table[0], "verdict") : NULL;
    for (iso_verdict v = ISO_REGULAR; verdict && v <= ISO_CHAOTIC; v++)
        if (strcmp(verdict, iso_verdict_name(v)) == 0) e->indicated = v;
    iso_study_result_free(&result);
    return status == ISO_STOPPED || status == ISO_NO_MEMORY ? status : ISO_OK;
}

/* Names each line by its combination of the frequencies of the angles. These are > 0, and in the order of the angles,
 * which is the reverse of that of the basis. */
static void name_lines(iso_frequencies *f, const line_list *l)
{
    iso_estimate *e = &f->estimate;
    const double one = f->angle[0].frequency[ISO_CLOCK_T], other = f->angle[1].frequency[ISO_CLOCK_T];
    const double basic[2] = {one, f->angles == 2 ? other : 0};
    for (int s = 0; s < 2; s++) {
        e->lines[s] = l->count[s];
        for (int i = 0; i < l->count[s]; i++) {
            iso_identified_line *named = &e->line[s][i];
            named->line = l->line[s][i];
            named->known =
                f->angles > 0 && combine(named->line.frequency, basic, NEAR * l->resolution, &named->m, &named->n);
        }
    }
    e->unexplained = f->angles > 0 ? unexplained(l, basic) : 0;
}

/* --- one clock after the other ---------------------------------------------------------------------------------- */

/* In the clock t: finds the basis, its drift and all lines. angle[0] swings, angle[1] turns. */
static iso_status estimate_in_t(estimator *e, const series *s, basis *b)
{
    iso_frequencies *f = e->f;
    iso_estimate *out = &f->estimate;
    double drift[2], before[2], error[2], unused[2];
    line_list l;
    ISO_TRY(find_lines(e->ctx, s, 0, s->count, LINES, &l));
    *b = find_basis(&l);
    ISO_TRY(find_drift(e, s, b, s->count / 2, drift, error));
    ISO_TRY(find_drift(e, s, b, s->count / 8, before, unused));
    f->angles = b->angles;
    out->drift = out->drift_before = 0;
    for (int i = 0; i < b->angles; i++) {
        iso_angle *a = &f->angle[b->angles - 1 - i];
        a->frequency[ISO_CLOCK_T] = fabs(b->frequency[i]);
        a->error[ISO_CLOCK_T] = error[i];
        a->drift = drift[i];
        out->drift = fmax(out->drift, isnan(drift[i]) ? INFINITY : drift[i]);
        out->drift_before = fmax(out->drift_before, before[i]);
    }
    out->length = e->end[ISO_CLOCK_T];
    out->samples = s->count;
    out->turns = b->angles > 0 ? fabs(b->frequency[0]) * out->length / (2 * ISO_PI) : 0;
    out->verdict = e->indicated == ISO_CHAOTIC ? ISO_CHAOTIC : verdict_of(out, b, f->integral != NULL);
    name_lines(f, &l);
    return ISO_OK;
}

/* In another clock: the same lines, whose frequencies differ from those in t by about the ratio of the clocks. */
static iso_status estimate_in(estimator *e, iso_clock clock, const series *s, const basis *in_t)
{
    const double ratio = e->end[ISO_CLOCK_T] / e->end[clock];
    line_list l;
    basis b = *in_t;
    double drift[2], error[2];
    ISO_TRY(find_lines(e->ctx, s, 0, s->count, PART_LINES, &l));
    for (int i = 0; i < b.angles; i++) b.frequency[i] = nearest(&l, b.of[i], b.frequency[i] * ratio);
    ISO_TRY(find_drift(e, s, &b, s->count / 2, drift, error));
    for (int i = 0; i < b.angles; i++) {
        iso_angle *a = &e->f->angle[b.angles - 1 - i];
        const bool same = fabs(b.frequency[i] - in_t->frequency[i] * ratio) < 4 * l.resolution;
        a->frequency[clock] = same ? fabs(b.frequency[i]) : NAN;
        a->error[clock] = same ? error[i] : NAN;
    }
    return ISO_OK;
}

static void describe(iso_frequencies *f)
{
    static const char *const motion[] = {
        [ISO_REGULAR] = "regular, as far as this orbit shows",
        [ISO_CHAOTIC] = "chaotic",
        [ISO_UNDECIDED] = "undecided: a longer orbit may tell",
        [ISO_INTEGRABLE] = "this orbit is too short to settle its frequencies",
    };
    const int axis = f->estimate.axis + 1;
    if (f->angles == 2)
        snprintf(f->angle[0].what, sizeof f->angle[0].what,
                 "strongest line of n%d that is no multiple of frequency 2", axis);
    if (f->angles > 0)
        snprintf(f->angle[f->angles - 1].what, sizeof f->angle[0].what, "strongest line of n%d + i n%d", axis % 3 + 1,
                 (axis + 1) % 3 + 1);
    snprintf(f->motion, sizeof f->motion, "%s%s%s", f->integral ? "integrable; " : "", motion[f->estimate.verdict],
             f->estimate.verdict == ISO_REGULAR && f->estimate.unexplained > 1e-3 ? "; more than two frequencies"
                                                                                  : "");
}

static iso_status in_clock(estimator *e, iso_clock clock, basis *b)
{
    series s;
    iso_status status = make_series(e, clock, &s);
    if (status == ISO_OK) status = clock == ISO_CLOCK_T ? estimate_in_t(e, &s, b) : estimate_in(e, clock, &s, b);
    free(s.pair);
    return status;
}

/* A motion that is not found regular is followed over a longer orbit, unless the caller gave the length. */
static iso_status estimate(estimator *e)
{
    enum { LEVELS = 3, MOST = 1 << 20 };
    basis b;
    iso_estimate *out = &e->f->estimate;
    ISO_TRY(ask_chaos(e));
    for (int level = 0; level < (e->fixed ? 1 : LEVELS); level++) {
        if (level > 0 && e->count > MOST / 4) break;
        if (level > 0) e->end[ISO_CLOCK_T] *= 4, e->count *= level == 1 || fabs(e->scene->params.k) < 0.5 ? 4 : 2;
        ISO_TRY(in_clock(e, ISO_CLOCK_T, &b));
        const bool wild = level > 0 && out->verdict == ISO_CHAOTIC && out->drift > 1e-4;
        if (out->verdict == ISO_REGULAR || e->indicated == ISO_CHAOTIC || wild) break;
    }
    if (e->indicated == ISO_REGULAR) out->verdict = ISO_REGULAR;
    const bool others = e->twin && out->verdict == ISO_REGULAR;
    for (iso_clock clock = ISO_CLOCK_TAU; others && clock < ISO_CLOCKS; clock++) ISO_TRY(in_clock(e, clock, &b));
    describe(e->f);
    iso_frequencies_finish(e->f);
    return ISO_OK;
}

/* --- what there is to estimate ---------------------------------------------------------------------------------- */

/* n turns at the rate |k omega|. Where |k| is small omega turns faster, at a rate of about |omega|. */
static iso_status choose_length(estimator *e, double speed)
{
    const iso_frequencies_options *o = e->options;
    const double k = fabs(e->scene->params.k), turn = 2 * ISO_PI / (k * speed),
                 fast = fmax(k, 1) * speed / (2 * ISO_PI);
    const double turns = isnan(o->turns) ? 1000 * fmin(fmax(4 * k, 0.05), 1) : o->turns;
    const double length = e->end[ISO_CLOCK_T] = isnan(o->end) ? turns * turn : o->end;
    if (!(length >= LEAST_TURNS * turn * (1 - ROUNDING)))
        return ISO_FAIL_ARGUMENT(e->ctx, isnan(o->end) ? "turns" : "end",
                                 "an orbit to t = %g is %g turns: frequencies are estimated from %g or more", length,
                                 length / turn, LEAST_TURNS);
    e->turns = e->fixed && length / turn < MOST_TURNS ? (long)(length / turn) : MOST_TURNS;
    const double samples = isnan(o->samples) ? fmax(32 * length / turn, 12 * length * fast) : o->samples;
    e->count = 512;
    while (e->count < ISO_MOST_SAMPLES && (double)e->count < samples) e->count *= 2;
    const double needed = 8 * length * fast; /* for each turn of the ball */
    if ((double)e->count >= needed) return ISO_OK;
    if (needed <= ISO_MOST_SAMPLES)
        return ISO_FAIL_ARGUMENT(
            e->ctx, "samples",
            "%zu samples of %g turns of the ball are fewer than 8 for each turn: take %.0f or more", e->count,
            length * fast, ceil(needed));
    const double most = ISO_MOST_SAMPLES / (8 * fast); /* in t */
    return ISO_FAIL_ARGUMENT(e->ctx, isnan(o->end) ? "turns" : "end",
                             "an estimate takes at most %d samples, 8 for each turn of the ball: take %.0f turns or "
                             "fewer, or t = %.6g or less",
                             ISO_MOST_SAMPLES, floor(most / turn), most * (1 - 1e-6));
}

iso_status iso_frequencies_estimate(iso_context *ctx, const iso_scene *scene, const iso_frequencies_options *options,
                                    iso_frequencies *f)
{
    ISO_DEFAULT_ARITHMETIC;
    const iso_frequencies_options *o = options;
    estimator e = {.ctx = ctx, .scene = scene, .options = o, .effects = iso_scene_acting(scene), .f = f};
    e.fixed = !isnan(o->turns) || !isnan(o->end) || !isnan(o->samples);
    iso_orbit *orbit;
    iso_sample start;
    ISO_TRY(iso_frequencies_check(ctx, o));
    iso_status status = iso_frequencies_open(ctx, scene, &e.effects, &orbit, &start, f);
    f->estimated = true;
    if (status == ISO_OK) status = iso_refuse_unbound(ctx, orbit, ISO_NO_FREQUENCIES);
    if (status == ISO_OK) {
        const double moving = norm(start.ball), falling = iso_orbit_units(orbit)->w;
        e.twin = iso_orbit_has_twin(orbit);
        iso_frequencies_place(orbit, &start, f);
        status = choose_length(&e, iso_effects_pull(&iso_orbit_model(orbit)->problem.effects) ? fmax(moving, falling)
                                                                                              : moving);
    }
    iso_orbit_free(orbit);
    return status == ISO_OK ? estimate(&e) : status;
}

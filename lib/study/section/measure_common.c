/* measure_common.c - what the two tests of the measure share: options, the scene, shifts of clouds; sums of test
 * functions over clouds, and whether their means are those of the measure. */
#include <gsl/gsl_cdf.h>
#include <math.h>

#include "base/low_discrepancy_impl.h"
#include "base/number_impl.h"
#include "base/options_impl.h"
#include "map/state.h"
#include "model/model_impl.h"
#include "orbit/orbit_impl.h"
#include "study/section/measure_impl.h"
#include "study/study_impl.h"

static iso_status check_options(iso_context *ctx, iso_measure_options *o)
{
    if (o->count < ISO_MEASURE_LEAST || o->count > SIZE_MAX / 2)
        return ISO_FAIL_ARGUMENT(ctx, "count", "a cloud has %d orbits or more", ISO_MEASURE_LEAST);
    if (!isfinite(o->exponent) || fabs(o->exponent) > 10)
        return ISO_FAIL_ARGUMENT(ctx, "exponent", "exponent %s is not in [-10, 10]", ISO_SHORT(o->exponent));
    if (!(o->significance > 0 && o->significance < 1))
        return ISO_FAIL_ARGUMENT(ctx, "significance", "significance %s is not in (0, 1)", ISO_SHORT(o->significance));
    const size_t clouds = ISO_MEASURE_CLOUDS;
    o->count = (o->count + clouds - 1) / clouds * clouds;
    return ISO_OK;
}

/* A potential must depend on n only: then it has an image on the point, or is its level. */
static iso_status check_effects(iso_context *ctx, measure_scene *s)
{
    s->free = true;
    for (int i = 0; i < ISO_EFFECTS; i++) {
        const iso_effect *e = iso_effect_list[i];
        if (!s->effects.on[i]) continue;
        s->free = false;
        if (!e->potential) continue;
        s->pulled = true;
        if (e->breaks)
            return ISO_FAIL_INPUT(ctx, e->name,
                                  "the measure (10) is one of omega and n, but the potential of %s depends on "
                                  "more than n",
                                  e->name);
    }
    return ISO_OK;
}

double iso_measure_potential(const measure_scene *s, const double n[3])
{
    if (!s->pulled) return 0;
    double y[ISO_MAX_STATE] = {0};
    for (int i = 0; i < 3; i++) y[3 + i] = n[i];
    return iso_effects_potential(&iso_orbit_model(s->orbit)->problem, y) *
           iso_unit(iso_orbit_units(s->orbit), iso_dimension_h);
}

iso_status iso_measure_open(iso_context *ctx, const iso_scene *scene, const iso_measure_options *given,
                            iso_measure_options *options, measure_scene *s)
{
    *options = iso_measure_defaults();
    *s = (measure_scene){.params = &scene->params};
    ISO_TRY(iso_options_take(ctx, "iso_measure_options", options, sizeof *options, given));
    ISO_TRY(check_options(ctx, options));
    iso_effects acting = iso_scene_acting(scene);
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    o.effects = &acting;
    o.backend = ISO_BACKEND_BALL;
    o.shown = ISO_SHOW_BALL;
    iso_sample sample;
    ISO_TRY(iso_refuse_rest(ctx, &scene->start, &acting, "has no cloud of its energy"));
    ISO_TRY(iso_orbit_create(ctx, &scene->params, &scene->start, &o, &s->orbit));
    ISO_TRY(iso_orbit_at(s->orbit, 0, &sample));
    s->effects = iso_orbit_effects(s->orbit);
    s->kinetic = iso_ball_energy(s->params, sample.ball);
    if (!(s->kinetic > 0)) return iso_refuse_start_at_rest(ctx, &scene->start, "a cloud of its energy is not known");
    iso_status status = check_effects(ctx, s);
    s->energy = s->kinetic + (status == ISO_OK ? iso_measure_potential(s, sample.ball + 3) : 0);
    return status;
}

void iso_measure_shift(const iso_measure_options *o, int cloud, int count, uint64_t shift[])
{
    uint64_t number = iso_scatter(iso_scatter(o->seed) + (uint64_t)cloud);
    for (int i = 0; i < count; i++) shift[i] = number = iso_scatter(number);
}

iso_status iso_measure_carry(const iso_measure_options *o,
                             iso_status (*block)(void *data, int cloud, uint64_t first, size_t count), void *data)
{
    const size_t each = o->count / ISO_MEASURE_CLOUDS;
    for (int cloud = 0; cloud < ISO_MEASURE_CLOUDS; cloud++)
        for (size_t first = 0; first < each; first += MEASURE_BLOCK) {
            const size_t count = each - first < MEASURE_BLOCK ? each - first : MEASURE_BLOCK;
            ISO_TRY(block(data, cloud, first, count));
            if (o->progress)
                o->progress((cloud + (double)(first + count) / (double)each) / ISO_MEASURE_CLOUDS, o->data);
        }
    return ISO_OK;
}

/* --- the test --------------------------------------------------------------------------------------------------- */

void iso_measure_sums_start(measure_sums *sums, double sharp, const double value[])
{
    sums->sharp += sharp;
    sums->sharp_square += sharp * sharp;
    for (int i = 0; i < sums->functions; i++) {
        sums->first[i] += value[i];
        sums->first_product[i] += sharp * value[i];
    }
}

void iso_measure_sums_add(measure_sums *sums, int cloud, int row, double sharp, const double value[])
{
    double *sum = sums->value[cloud] + row * sums->functions, *product = sums->product + row * sums->functions;
    for (int i = 0; i < sums->functions; i++) {
        sum[i] += value[i];
        product[i] += sharp * value[i];
    }
}

/* The mean of the clouds' means, its standard error from their scatter, and d(mean - expected)/d(exponent). Here
 * d(mean)/d(exponent) is the covariance of the values with d ln(density)/d(exponent) at the start, and
 * d(expected)/d(exponent) is the same covariance of the values at the start. */
static void find_mean(const measure_sums *sums, double count, int at, iso_measure_entry *line)
{
    const int f = at % sums->functions;
    const double each = count / ISO_MEASURE_CLOUDS;
    double mean = 0, square = 0;
    for (int c = 0; c < ISO_MEASURE_CLOUDS; c++) mean += sums->value[c][at] / each / ISO_MEASURE_CLOUDS;
    for (int c = 0; c < ISO_MEASURE_CLOUDS; c++) square += pow(sums->value[c][at] / each - mean, 2);
    line->mean = mean;
    line->error = sqrt(square / (ISO_MEASURE_CLOUDS - 1) / ISO_MEASURE_CLOUDS);
    line->slope =
        (sums->product[at] - sums->first_product[f]) / count - sums->sharp / count * (mean - sums->first[f] / count);
}

void iso_measure_judge(const measure_sums *sums, const iso_measure_options *o, const char *const name[],
                       const double expected[], const double time[ISO_MEASURE_ROWS], iso_measure *m)
{
    const double freedom = ISO_MEASURE_CLOUDS - 1, count = (double)o->count;
    const double least = fmax(1e3 * o->tolerance, 1e-11); /* of the integration, which does not show as scatter */
    const bool flat = sums->sharp_square / count - pow(sums->sharp / count, 2) < 1e-13 * sums->sharp_square / count;
    m->count = o->count;
    m->lines = sums->functions * ISO_MEASURE_ROWS;
    m->worst = 0;
    m->resolution = INFINITY;
    const double critical = gsl_cdf_tdist_Qinv(o->significance / 2 / m->lines, freedom);
    for (int i = 0; i < m->lines; i++) {
        const int f = i % sums->functions;
        iso_measure_entry *line = &m->line[i];
        *line = (iso_measure_entry){.name = name[f], .time = time[i / sums->functions], .expected = expected[f]};
        find_mean(sums, count, i, line);
        line->error = fmax(line->error, least);
        line->deviation = (line->mean - line->expected) / line->error;
        line->p = 2 * gsl_cdf_tdist_Q(fabs(line->deviation), freedom);
        if (!(fabs(line->deviation) <= fabs(m->line[m->worst].deviation))) m->worst = i;
        if (!flat) m->resolution = fmin(m->resolution, critical * line->error / fabs(line->slope));
    }
    m->p = fmin(1, m->line[m->worst].p * m->lines);
    m->kept = m->p >= o->significance;
}

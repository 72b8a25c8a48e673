/* integrals.c - the search for additional first integrals, see integrals.h: what is refused, and what the parts of
 * the spaces show together. Samples are taken in integrals_orbits.c, linear algebra is in integrals_part.c. */
#include "instrument/integrals/integrals.h"
#include "base/number_impl.h"
#include "model/model_impl.h"

#include <math.h>
#include <stdlib.h>

#include "base/arithmetic_impl.h"
#include "base/context_impl.h"
#include "base/names_impl.h"
#include "instrument/integrals/integrals_impl.h"
#include "map/section_impl.h"
#include "model/effects/effects_impl.h"
#include "study/study_impl.h"

enum { LEAST_ORBITS = 64, MOST_ORBITS = 10000, PROBES = 16 };

typedef struct search {
    iso_context *ctx;
    iso_integral_search_options options;
    iso_integral_search *out;
    integral_space space;
    integral_samples samples;
    size_t done, all;              /* parts searched, of how many                        */
    double gradient[PROBES][2][2]; /* sums of grad f grad f^T over functions f, in the chart of the section */
    const iso_integral *known[ISO_INTEGRAL_KNOWN];
} search;

ISO_NAMES(iso_integral_verdict_name, int, "none", "found", "undecided")

/* --- what is refused -------------------------------------------------------------------------------------------- */

/* Twice as many conditions as there are terms. */
static iso_status choose_orbits(iso_context *ctx, const integral_space *space, iso_integral_search_options *o)
{
    size_t most = 0;
    for (int d = o->degree; d >= o->degree - 1; d--)
        for (unsigned parity = 0; parity < INTEGRAL_PARITIES; parity++) {
            const size_t terms = iso_integral_terms(space, d, parity, NULL);
            if (terms > most) most = terms;
        }
    const size_t least = 4 + 2 * most / (ISO_INTEGRAL_ROWS - 1);
    if (o->orbits == 0) o->orbits = least > LEAST_ORBITS ? least : LEAST_ORBITS;
    if (o->orbits >= least && o->orbits <= MOST_ORBITS) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "orbits", "%zu orbits: these degrees need %zu to %d", o->orbits, least,
                             MOST_ORBITS);
}

static iso_status check_options(iso_context *ctx, iso_integral_search_options *o)
{
    if (o->degree < 1 || o->degree > ISO_INTEGRAL_DEGREE)
        return ISO_FAIL_ARGUMENT(ctx, "degree", "degree %d of the polynomials in M: give 1 to %d", o->degree,
                                 ISO_INTEGRAL_DEGREE);
    if (o->coefficients == -1) o->coefficients = o->degree > 2 ? o->degree : 2;
    if (o->coefficients < 0 || o->coefficients > ISO_INTEGRAL_DEGREE)
        return ISO_FAIL_ARGUMENT(ctx, "coefficients", "degree %d of the coefficients in gamma: give 0 to %d",
                                 o->coefficients, ISO_INTEGRAL_DEGREE);
    if (!(o->turns >= 1 && o->turns <= 1e5))
        return ISO_FAIL_ARGUMENT(ctx, "turns", "%s turns are not in [1, 1e5]", ISO_SHORT(o->turns));
    if (!(o->within > 0 && o->within < 1))
        return ISO_FAIL_ARGUMENT(ctx, "within", "within %s is not in (0, 1)", ISO_SHORT(o->within));
    return ISO_OK;
}

/* --- integrals that are known ----------------------------------------------------------------------------------- */

/* The distance of a known integral, less its mean, from the functions found in this part, by the size of what it
 * varies. NaN: it is a constant, to rounding. work: room for a number of each sample. */
static double residual_of(const search *s, const iso_integral *known, const integral_part *part, double *work)
{
    const size_t rows = s->samples.rows;
    double mean = 0, varies = 0, largest = 0, rest = 0, size;
    for (size_t i = 0; i < rows; i++) {
        work[i] = known->value(&s->samples.problem, s->samples.state[i], &size);
        mean += work[i], largest = fmax(largest, size);
    }
    mean /= (double)rows;
    for (size_t i = 0; i < rows; i++) varies += (work[i] - mean) * (work[i] - mean);
    if (varies == 0 || sqrt(varies / (double)rows) < 10 * s->out->delta * largest) return NAN;
    for (size_t f = 0; f < part->found; f++) {
        const double *basis = part->basis + f * rows;
        double along = 0;
        for (size_t i = 0; i < rows; i++) along += basis[i] * work[i];
        for (size_t i = 0; i < rows; i++) work[i] -= along * basis[i];
    }
    for (size_t i = 0; i < rows; i++) rest += work[i] * work[i];
    return sqrt(rest / varies);
}

static iso_status compare_with_known(search *s, int degree, const integral_part *part)
{
    double *work = malloc(s->samples.rows * sizeof *work);
    if (!work) return iso_context_no_memory(s->ctx, "%zu samples", s->samples.rows);
    for (int i = 0; i < s->out->known_count; i++) {
        iso_integral_known *known = &s->out->known[i];
        if (known->degree > 0) continue;
        const double residual = residual_of(s, s->known[i], part, work);
        known->constant = known->constant || isnan(residual);
        if (!(residual < known->residual)) continue;
        known->residual = residual;
        if (residual < 1e-6) known->degree = degree;
    }
    free(work);
    return ISO_OK;
}

/* --- how many do not depend on each other ----------------------------------------------------------------------- */

/* The gradients of the functions found, at points of the section. A function of integrals changes with them alone. */
static void add_gradients(search *s, const integral_part *part)
{
    for (uint64_t i = 0; i < PROBES; i++) {
        double l, x, y[ISO_STATE], by[2][ISO_STATE], slope[2];
        iso_section_spread_point(&s->samples.spread, i, &l, &x);
        iso_section_point(iso_integral_motion(&s->samples), s->samples.axis, l, x, y);
        iso_section_deviations(iso_integral_motion(&s->samples), s->samples.axis, l, x, by[0], by[1]);
        for (size_t f = 0; f < part->found; f++) {
            for (int c = 0; c < 2; c++)
                slope[c] = iso_integral_slope(&part->function[f], &s->samples.problem, y, by[c]) *
                           (c == 1 ? sqrt(1 - x * x) : 1);
            for (int a = 0; a < 2; a++)
                for (int b = 0; b < 2; b++) s->gradient[i][a][b] += slope[a] * slope[b];
        }
    }
}

/* --- the spaces ------------------------------------------------------------------------------------------------- */

static void add_part(const search *s, const integral_part *part, iso_integral_degree *at)
{
    at->terms += part->terms;
    at->functions += part->functions;
    at->found += part->found;
    for (size_t i = 0; i < part->functions; i++) {
        const iso_integral_value *v = &part->value[i];
        const bool found = integral_is_found(v, s->options.within);
        double *end = found ? &at->largest : &at->smallest;
        *end = found ? fmax(*end, v->value) : fmin(*end, v->value);
        at->doubtful += !found && v->value <= fmax(v->error, s->options.within);
        /* among the smallest, in order */
        size_t place = at->values;
        while (place > 0 && v->value < at->value[place - 1].value) place--;
        if (place == ISO_INTEGRAL_VALUES) continue;
        if (at->values < ISO_INTEGRAL_VALUES) at->values++;
        for (size_t j = at->values - 1; j > place; j--) at->value[j] = at->value[j - 1];
        at->value[place] = *v;
    }
}

static iso_status search_degree(search *s, int degree)
{
    iso_integral_degree *at = &s->out->at[degree];
    *at = (iso_integral_degree){.degree = degree, .largest = NAN, .smallest = NAN};
    for (unsigned parity = 0; parity < INTEGRAL_PARITIES; parity++) {
        integral_part part;
        if (!iso_context_goes_on(s->ctx))
            return iso_context_fail(s->ctx, ISO_STOPPED, "", "stopped in degree %d", degree);
        iso_status status = iso_integral_search_part(s->ctx, &s->samples, &s->space, degree, parity, s->out->delta,
                                                     s->options.within, &part);
        if (status == ISO_OK) {
            add_part(s, &part, at);
            add_gradients(s, &part);
            status = compare_with_known(s, degree, &part);
        }
        iso_integral_free_part(&part);
        if (status != ISO_OK) return status;
        if (s->options.progress) s->options.progress(s->options.data, (double)++s->done / (double)s->all);
    }
    const int step = s->space.magnetic ? 1 : 2; /* V_d has V_(d - step); constants, so the energy, are in V_step */
    const size_t known = degree <= step ? (size_t)(degree == step) : s->out->at[degree - step].found;
    at->further = at->found > known ? at->found - known : 0;
    s->out->degrees = degree;
    return ISO_OK;
}

/* Integrals of a neighbour are constant here within rounding: they change by the square of such a difference of
 * moments, by 1/100 of such a difference of k, and by about such a number of an effect, in units of the motion. */
static bool has_neighbour(const iso_problem *f)
{
    const iso_params *p = &f->p;
    const double k = fabs(fabs(p->k) - 1);
    bool near = k > 0 && k < 1e-9;
    for (int i = 0; i < 3; i++) {
        const double one = p->J[i], other = p->J[(i + 1) % 3];
        near = near || (one != other && fabs(one - other) < 1e-6 * fmax(one, other));
    }
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        for (const iso_effect_number *n = iso_effect_list[e]->numbers; f->effects.on[e] && n && n->name; n++)
            for (int i = 0; i < n->count; i++) {
                const double x = fabs(iso_effect_values(&f->effects, e, n)[i]);
                near = near || (x > 0 && x < 1e-9);
            }
    return near;
}

/* How many integrals do not depend on each other: the rank of the gradients, at most 2, where it is largest. */
static void find_verdict(search *s)
{
    const double small = 1e-10; /* the square of 1e-5: rounding errors are smaller */
    iso_integral_search *out = s->out;
    for (int i = 0; i < PROBES; i++) {
        double(*g)[2] = s->gradient[i];
        const double half = (g[0][0] + g[1][1]) / 2, root = hypot((g[0][0] - g[1][1]) / 2, g[0][1]);
        const int rank = half + root < small ? 0 : half - root < small * (half + root) ? 1 : 2;
        if (rank > out->independent) out->independent = rank;
    }
    size_t doubtful = 0;
    bool known = false;
    double before = INFINITY; /* the smallest other value in lower degrees than that of the first integral */
    int first = 1;
    for (; first <= out->degrees && out->at[first].further == 0; first++)
        before = fmin(before, out->at[first].smallest);
    for (int d = 1; d <= out->degrees; d++) doubtful += out->at[d].doubtful;
    for (int i = 0; i < out->known_count; i++) known = known || out->known[i].degree > 0;
    out->near = has_neighbour(&s->samples.problem) || (first <= out->degrees && before < 1e-3);
    out->verdict = ISO_INTEGRALS_NONE;
    if (out->independent > 0 && (known || !out->near))
        out->verdict = ISO_INTEGRALS_FOUND;
    else if (out->independent > 0 || doubtful > 0 || out->degrees < s->options.degree)
        out->verdict = ISO_INTEGRALS_UNDECIDED;
}

static iso_status run(search *s, const iso_scene *scene)
{
    iso_problem of_scene;
    ISO_TRY(check_options(s->ctx, &s->options));
    ISO_TRY(iso_level_problem(s->ctx, scene, "integrals are sought", &of_scene));
    s->space = iso_integral_space_of(&of_scene, s->options.coefficients);
    ISO_TRY(choose_orbits(s->ctx, &s->space, &s->options));
    ISO_TRY(iso_integral_prepare(s->ctx, &of_scene, s->options.seed, s->options.orbits, &s->samples));
    const iso_problem *f = &s->samples.problem;
    s->out->level = f->energy == 0 ? 0 : iso_level_of(&f->p, f->energy / f->eps);
    s->out->coefficients = s->options.coefficients;
    s->out->orbits = s->options.orbits;
    /* What steps of this tolerance do to an integral, with a margin (measured at k = 1 and k = -1, see the test). */
    s->out->delta = 5e-15 + 1e-4 * s->options.tolerance * s->options.turns;
    s->all = (size_t)s->options.degree * INTEGRAL_PARITIES;
    const iso_integral *list[ISO_MAX_INTEGRALS];
    const int count = iso_integrals_holding(&iso_system_point, f, list, ISO_MAX_INTEGRALS);
    for (int i = 0; i < count && s->out->known_count < ISO_INTEGRAL_KNOWN; i++) {
        if (!list[i]->holds || list[i]->claimed) continue; /* the energy, and the constraints */
        s->known[s->out->known_count] = list[i];
        s->out->known[s->out->known_count++] = (iso_integral_known){list[i]->name, list[i]->doc, false, 0, INFINITY};
    }
    iso_status status = iso_integral_follow(s->ctx, &s->options, &s->samples, &s->out->energy);
    for (int d = 1; d <= s->options.degree && status == ISO_OK; d++) status = search_degree(s, d);
    if (status == ISO_OK || status == ISO_STOPPED) find_verdict(s);
    return status;
}

iso_status iso_integral_search_run(iso_context *ctx, const iso_scene *scene,
                                   const iso_integral_search_options *options, iso_integral_search *result)
{
    ISO_DEFAULT_ARITHMETIC;
    search s = {.ctx = ctx, .options = iso_integral_search_defaults(), .out = result};
    *result = (iso_integral_search){.verdict = ISO_INTEGRALS_UNDECIDED};
    if (options) s.options = *options;
    iso_status status = run(&s, scene);
    free(s.samples.state);
    return status;
}

/* convert_row.c - one row of the file: whether it is a state of the model and has the energy of the others, and its
 * state in the other model. The first good row also gives the units and the level. And marks in the place of bad
 * rows. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/context_impl.h"
#include "base/vec3_impl.h"
#include "map/state.h"
#include "model/model_impl.h"
#include "orbit/orbit_impl.h"
#include "task/convert/convert_impl.h"

/* --- states ----------------------------------------------------------------------------------------------------- */

static iso_status start_of(const iso_conversion *c, const double y[ISO_STATE], iso_start *start)
{
    return iso_start_from_row(c->ctx, c->from, y, isnan(c->stated_eps) ? NULL : &c->stated_eps, false,
                              c->row_tolerance, start);
}

static iso_status open_orbit(const iso_conversion *c, iso_start start, bool clock, iso_orbit **orbit)
{
    if (c->from == ISO_POINT && c->first) start.eps = NAN; /* the level gives it; check_energy has seen the row's */
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.effects = &c->effects;
    o.tolerance = c->how->tolerance;
    o.with_clock[c->other] = clock;
    o.max_steps = c->max_steps;
    return iso_orbit_create(c->ctx, c->params, &start, &o, orbit);
}

iso_status iso_conversion_open(void *data, const double row[], iso_orbit **orbit)
{
    const iso_conversion *c = data;
    iso_start start;
    double y[ISO_STATE];
    iso_row_state(c->columns, c->from, row, y);
    ISO_TRY(start_of(c, y, &start));
    return open_orbit(c, start, true, orbit);
}

/* H of a point, in own units, minus the value of the level c (own units; 0: none), relative. */
static double off_level(const iso_conversion *c, const double own[ISO_STATE], double eps, double level_c)
{
    double size;
    iso_problem problem = iso_orbit_model(c->first)->problem;
    problem.eps = eps;
    const double level = iso_coupling(&problem.p, level_c);
    const double H = iso_system_point.energy(&problem, own, &size);
    return H == level ? 0 : (H - level) / fmax(size, fabs(level));
}

/* A point's H must equal its level, up to the digits with which eps is written. Otherwise the row belongs to another
 * trajectory. A ball's energy is only noted. */
static iso_status check_energy(iso_conversion *c, conversion_row *r)
{
    double size;
    if (c->from == ISO_BALL) {
        const double h = iso_system_ball.energy(&iso_orbit_model(c->first)->problem, r->own, &size);
        if (c->good == 0) c->energy = h;
        iso_worst_note(&c->summary.energy, h == c->energy ? 0 : (h - c->energy) / size, r->line);
        return ISO_OK;
    }
    const iso_problem *first = &iso_orbit_model(c->first)->problem;
    const bool stated = !isnan(c->stated_eps);
    const double eps = stated ? c->stated_eps / iso_unit(&c->units, iso_dimension_eps) : first->eps;
    const double level = iso_effects_have_level(&c->effects) ? iso_effects_level(&first->effects) : 0;
    const double off = off_level(c, r->own, eps, level), most = fmax(1e-3, iso_conversion_digits(c));
    r->other_energy = stated && !(fabs(off) <= most); /* methods of low order reach that */
    if (r->other_energy && c->good == 1 &&
        fabs(off_level(c, r->own, eps, c->stated_level / iso_unit(&c->units, iso_level_dimension()))) <= most)
        return iso_context_fail(c->ctx, ISO_NOT_MAPPED, "eps",
                                "this point has the energy that the lines state, but line %zu has another one: leave "
                                "out that row, it is damaged",
                                c->last.line);
    if (r->other_energy)
        return iso_context_fail(
            c->ctx, ISO_NOT_MAPPED, "eps",
            "the energy of this point is not that of the rows before: its M does not fit eps = %.10g; leave out "
            "--eps and --h (or the lines # eps, # h) to take them from the first row",
            c->stated_eps);
    iso_worst_note(&c->summary.energy, off, r->line);
    return ISO_OK;
}

/* The state in the other model, from the row as it stands: it is not made orthogonal first. */
static iso_status map_state(const iso_conversion *c, conversion_row *r)
{
    double *const to = r->out + (c->own_column >= 0 || c->other_column >= 0);
    const bool rest = largest(r->y) == 0;
    if (rest && !iso_effects_pull(&c->effects))
        return iso_context_fail(c->ctx, ISO_NOT_MAPPED, "", "at rest (h = 0): the other model has no such orbit");
    (c->from == ISO_BALL ? iso_ball_to_point : iso_point_to_ball)(&c->units.own, r->own, to);
    double size = 0;
    bool fits = isnormal(c->unit_to) && isnormal(c->unit_from);
    for (int i = 0; i < 3; i++) {
        to[i] *= c->unit_to;
        size = fmax(size, fabs(to[i]));
        fits = fits && isfinite(to[i]) && isfinite(to[3 + i]);
    }
    if (fits && (rest || size >= DBL_MIN)) return ISO_OK;
    return ISO_FAIL_NUMERICAL(c->ctx, "the result does not fit a double: use other units of time");
}

/* --- the first row ---------------------------------------------------------------------------------------------- */

static iso_status create_first(iso_conversion *c, const iso_start *start, bool clock)
{
    iso_orbit_free(c->first);
    c->first = NULL;
    iso_status status = open_orbit(c, *start, clock, &c->first);
    if (status == ISO_OK) c->units = *iso_orbit_units(c->first);
    return status;
}

/* The orbit of the first row. Where its energy is not the stated one, it gets its own. But a point whose energy is
 * far from the stated one is another one: without a level in the lines it gets the level of its energy, with one it
 * is refused. */
static iso_status open_first(iso_conversion *c, const conversion_row *r)
{
    iso_start start;
    const bool clock = c->own_column >= 0, level = iso_effects_have_level(&c->effects);
    ISO_TRY(start_of(c, r->y, &start));
    const double eps = start.eps;
    if (level) start.eps = NAN;
    ISO_TRY(create_first(c, &start, clock));
    const bool own = iso_conversion_reconcile(c, r);
    const iso_effects found = iso_orbit_effects(c->first);
    const bool fits = own ? !c->replaces && iso_effects_have_level(&found) == level : !level;
    start.eps = own ? NAN : eps;
    if (!fits) ISO_TRY(create_first(c, &start, clock));
    if (c->from == ISO_BALL) return ISO_OK;
    if (own && !isnan(c->stated_eps)) c->stated_eps = iso_orbit_coupling(c->first);
    if (!level) c->effects = iso_orbit_effects(c->first);
    return ISO_OK;
}

/* On |gamma| = 1, eps (gamma,J gamma) + E = eps (gamma,(J + E/eps) gamma): the energy becomes a part of J. */
static iso_status shift_moments(iso_conversion *c, const conversion_row *r)
{
    const double eps = c->stated_eps, *J = c->params->J, kinetic = dot(r->y, r->y) / 2;
    const double E = kinetic - eps * dot_diag(r->y + 3, J, r->y + 3);
    if (!c->how->shift_J || isnan(eps) || fabs(E) <= iso_conversion_digits(c) * kinetic) return ISO_OK;
    const iso_status status =
        iso_params_reduced(c->ctx, -1, (double[]){J[0] + E / eps, J[1] + E / eps, J[2] + E / eps}, &c->shifted);
    if (status == ISO_OK) {
        c->params = &c->shifted;
        iso_effects_set_level(&c->effects, false, NAN);
        return ISO_OK;
    }
    return iso_context_fail(
        c->ctx, ISO_NOT_MAPPED, "",
        "no free ball has this energy, J + E/eps: %s; without a shift there is one in the potential of a level",
        iso_context_message(c->ctx));
}

static iso_status open_units(iso_conversion *c, const conversion_row *r)
{
    ISO_TRY(shift_moments(c, r));
    ISO_TRY(open_first(c, r));
    const double unit_M = iso_unit(&c->units, iso_system_point.fast_dimension);
    c->unit_from = c->from == ISO_BALL ? c->units.w : unit_M;
    c->unit_to = c->from == ISO_BALL ? unit_M : c->units.w;
    c->unit_own = iso_unit(&c->units, iso_clock_dimension(c->own));
    return ISO_OK;
}

iso_status iso_conversion_read_row(iso_conversion *c, const double row[], conversion_row *r)
{
    iso_start start;
    iso_row_state(c->columns, c->from, row, r->y);
    r->time = c->own_column >= 0 ? row[c->own_column] : 0;
    for (size_t i = 0; i < iso_record_columns(c->in); i++)
        if (!isfinite(row[i])) return ISO_FAIL_INPUT(c->ctx, "", "%s is not finite", iso_record_name(c->in, i));
    ISO_TRY(start_of(c, r->y, &start));
    if (!c->begun) ISO_TRY(open_units(c, r));
    copy(r->y, r->own, ISO_STATE);
    for (int i = 0; i < 3; i++) r->own[i] /= c->unit_from;
    ISO_TRY(check_energy(c, r));
    ISO_TRY(map_state(c, r));
    iso_worst_note(&c->summary.constraint, iso_conversion_constraint(r->y), r->line);
    if (c->other_column >= 0) r->out[0] = row[c->other_column];
    return ISO_OK;
}

/* --- what leaves a conversion ----------------------------------------------------------------------------------- */

void iso_worst_note(iso_worst *worst, double value, size_t line)
{
    if (worst->line > 0 && !(fabs(value) > worst->value) && !isnan(value)) return;
    worst->value = isnan(value) ? INFINITY : fabs(value);
    worst->line = line;
}

/* If so many rows at the beginning of a file are all bad, the conversion ends. */
enum { HOPELESS = 20 };

iso_status iso_conversion_write(const iso_conversion *c, const double row[])
{
    return c->sink.row(c->sink.data, 0, row, c->width);
}

iso_status iso_conversion_mark(iso_conversion *c)
{
    if (c->begun || c->summary.bad != HOPELESS) return iso_conversion_write(c, NULL);
    return iso_context_fail(c->ctx, c->first_text ? c->first_failure : ISO_BAD_INPUT, "",
                            "not one of the first %d rows can be converted: %s", HOPELESS,
                            c->first_text ? c->first_text : "none can be read");
}

iso_status iso_conversion_name(const iso_conversion *c, size_t line, iso_status why, const char *text)
{
    char named[1536];
    if (!c->name) return iso_context_fail(c->ctx, why, "", "row %zu: %s", line, text);
    if (c->how->strict)
        return iso_context_placed(c->ctx, iso_context_fail(c->ctx, why, "", "%s:%zu: %s", c->name, line, text));
    snprintf(named, sizeof named, "%s:%zu: %s", c->name, line, text);
    if (c->sink.note) c->sink.note(c->sink.data, named);
    return ISO_OK;
}

iso_status iso_conversion_bad(iso_conversion *c, size_t line, iso_status why)
{
    const bool ends = why == ISO_NO_MEMORY || why == ISO_STOPPED || why == ISO_FILE_TROUBLE || why == ISO_CLOSED_PIPE;
    if (ends) return why;
    if (why == ISO_BAD_ARGUMENT) why = ISO_BAD_INPUT; /* the argument comes from the file */
    if (!c->begun && !c->first_text) {
        c->first_failure = why;
        c->first_text = strdup(iso_context_message(c->ctx));
    }
    c->summary.bad++;
    ISO_TRY(iso_conversion_name(c, line, why, iso_context_message(c->ctx)));
    return iso_conversion_mark(c);
}

/* convert.c - rows of a trajectory, and whole ones, from one model to the other. */
#include "orbit/convert.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/vec3_impl.h"
#include "map/state.h"
#include "orbit/convert_impl.h"

/* --- bad rows, good rows ----------------------------------------------------------------------------------------- */

/* A file of which nothing can be used is not complained of row by row. */
enum { HOPELESS = 20 };

static iso_status give_up(const iso_conversion *c)
{
    const char *words = c->first_words ? c->first_words : "none can be read";
    return iso_context_fail(c->ctx, c->first_words ? c->first_failure : ISO_BAD_INPUT, "",
                            "not one of the first %d rows can be converted: %s", HOPELESS, words);
}

static iso_status write_mark(iso_conversion *c)
{
    if (!c->begun && c->summary.bad == HOPELESS) return give_up(c);
    if (c->begun && !c->is_held && !c->unwritten) return c->target.row(c->target.data, NULL);
    ++*(c->unwritten && !c->is_held ? &c->first_marks : &c->marks);
    return ISO_OK;
}

iso_status iso_conversion_bad(iso_conversion *c, size_t line, iso_status why)
{
    if (why == ISO_NO_MEMORY || why == ISO_STOPPED || why == ISO_FILE_TROUBLE) return why;
    if (why == ISO_BAD_ARGUMENT) why = ISO_BAD_INPUT; /* what a call does not take is here what the file says */
    if (!c->begun && !c->first_words) {
        c->first_failure = why;
        c->first_words = strdup(iso_context_message(c->ctx));
    }
    c->summary.bad++;
    const iso_status status = c->target.bad(c->target.data, line, why, iso_context_message(c->ctx));
    return status == ISO_OK ? write_mark(c) : status;
}

iso_status iso_conversion_skip(iso_conversion *c)
{
    c->summary.rows++;
    c->summary.bad++;
    return write_mark(c);
}

iso_status iso_conversion_emit(iso_conversion *c, conversion_row *row)
{
    return c->target.row(c->target.data, row->out);
}

double iso_conversion_digits(const iso_conversion *c)
{
    const double tolerance = iso_record_row_tolerance(c->in);
    return tolerance > ISO_ROW_TOLERANCE ? 10 * tolerance : 1e-6;
}

/* --- states ------------------------------------------------------------------------------------------------------ */

iso_status iso_conversion_start(const iso_conversion *c, const double y[ISO_STATE], iso_start *start)
{
    return iso_start_from_row(c->ctx, c->from, y, isnan(c->stated_eps) ? NULL : &c->stated_eps, false,
                              iso_record_row_tolerance(c->in), start);
}

iso_status iso_conversion_orbit(const iso_conversion *c, const iso_start *row, bool clock, iso_orbit **orbit)
{
    iso_start start = *row;
    if (c->from == ISO_POINT && c->first) start.eps = NAN; /* that of its level, which has been looked at */
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.effects = &c->effects;
    o.tolerance = c->tolerance;
    o.carry[c->other] = clock;
    o.max_steps = ISO_MAX_ROW_STEPS;
    return iso_orbit_create(c->ctx, c->params, &start, &o, orbit);
}

/* H of a point in own units from the level it should have, relative. */
static double off_level(const iso_conversion *c, const double own[ISO_STATE], double eps)
{
    double size;
    iso_field field = iso_orbit_model(c->first)->field;
    field.eps = eps;
    const double level = c->effects.on[ISO_LEVEL] ? iso_coupling(&field.p, field.effects.level) : 0;
    const double H = iso_system_point.integrals[0].value(&field, own, &size);
    return H == level ? 0 : (H - level) / fmax(size, fabs(level));
}

/* A point's own coupling is the one of its level, from which the record's may differ by the digits it is written with;
 * by more, the row is none of this trajectory. A ball's energy is only noted. */
static iso_status check_energy(iso_conversion *c, const conversion_row *r)
{
    double size;
    if (c->from == ISO_BALL) {
        const double h = iso_system_ball.integrals[0].value(&iso_orbit_model(c->first)->field, r->own, &size);
        if (c->summary.energy.line == 0) c->energy = h;
        iso_worst_note(&c->summary.energy, h == c->energy ? 0 : (h - c->energy) / size, r->line);
        return ISO_OK;
    }
    const bool stated = !isnan(c->stated_eps);
    const double eps = stated ? c->stated_eps / iso_unit(&c->units, iso_dimension_eps)
                              : iso_orbit_model(c->first)->field.eps; /* the first row's */
    const double off = off_level(c, r->own, eps);
    if (stated && !(fabs(off) <= fmax(1e-3, iso_conversion_digits(c)))) /* low orders keep energy no better */
        return iso_context_fail(c->ctx, ISO_NOT_MAPPED, "eps",
                                "the energy of this point is not that of the rows before: its M does not belong to "
                                "eps = %.10g (leave --eps and --h out, and the first row says them)",
                                c->stated_eps);
    iso_worst_note(&c->summary.energy, off, r->line);
    return ISO_OK;
}

static void note_constraints(iso_conversion *c, const conversion_row *r)
{
    const double size = largest(r->y), length = norm(r->y + 3) - 1;
    double along = 0;
    for (int i = 0; i < 3 && size > 0; i++) along += r->y[i] / size * r->y[3 + i];
    iso_worst_note(&c->summary.constraint, fmax(fabs(length), fabs(along)), r->line);
}

/* The row carried over as it stands: what a start makes orthogonal is for integration. */
static iso_status map_state(const iso_conversion *c, conversion_row *r)
{
    double *const to = r->out + (c->own_column >= 0 || c->other_column >= 0);
    const bool rest = largest(r->y) == 0;
    if (rest && !c->effects.on[ISO_FIELD] && !c->effects.on[ISO_LEVEL])
        return iso_context_fail(c->ctx, ISO_NOT_MAPPED, "", "at rest (h = 0): a resting ball has no twin");
    (c->from == ISO_BALL ? iso_ball_to_point : iso_point_to_ball)(&c->units.own, r->own, to);
    double size = 0;
    bool fits = isnormal(c->unit_to) && isnormal(c->unit_from);
    for (int i = 0; i < 3; i++) {
        to[i] *= c->unit_to;
        size = fmax(size, fabs(to[i]));
        fits = fits && isfinite(to[i]) && isfinite(to[3 + i]);
    }
    if (fits && (rest || size >= DBL_MIN)) return ISO_OK;
    return iso_context_fail(c->ctx, ISO_NUMERICAL, "", "the result does not fit a double in these units");
}

/* The other clock, where the file has it. */
static void given_clock(const iso_conversion *c, const double row[], conversion_row *r)
{
    if (c->other_column >= 0) r->out[0] = row[c->other_column];
}

/* --- the first row ----------------------------------------------------------------------------------------------- */

static iso_status create_first(iso_conversion *c, const iso_start *start, bool clock)
{
    iso_orbit_free(c->first);
    c->first = NULL;
    const iso_status status = iso_conversion_orbit(c, start, clock, &c->first);
    if (status == ISO_OK) c->units = *iso_orbit_units(c->first);
    return status;
}

/* How far the first row is off the level stated, or 0, by the coupling eps in own units. */
static double first_off_level(const iso_conversion *c, const iso_start *start, double eps)
{
    double own[ISO_STATE];
    copy(start->y, own, ISO_STATE);
    for (int i = 0; i < 3; i++) own[i] /= iso_unit(&c->units, iso_system_point.fast_dimension);
    return off_level(c, own, eps);
}

/* The orbit of the first row. A point may be off the level stated, or off H = 0 where none is, by the digits a record
 * is written with: its own coupling is then the one of that level. Farther off, it has a level if none is stated. */
static iso_status open_first(iso_conversion *c, const conversion_row *r)
{
    iso_start start;
    const bool clock = c->own_column >= 0, stated = c->effects.on[ISO_LEVEL];
    iso_status status = iso_conversion_start(c, r->y, &start);
    const double eps = start.eps;
    if (stated) start.eps = NAN;
    if (status == ISO_OK) status = create_first(c, &start, clock);
    if (status != ISO_OK || !iso_orbit_effects(c->first).on[ISO_LEVEL] || isnan(c->stated_eps)) return status;
    const double own_eps = c->stated_eps / iso_unit(&c->units, iso_dimension_eps);
    const bool agrees = fabs(first_off_level(c, &start, own_eps)) <= iso_conversion_digits(c);
    if (agrees && stated) return ISO_OK;
    start.eps = agrees ? NAN : eps; /* a level stated that is another one is refused there */
    if (agrees || stated) return create_first(c, &start, clock);
    c->effects = iso_orbit_effects(c->first);
    return ISO_OK;
}

/* On |gamma| = 1, eps (gamma,J gamma) + E = eps (gamma,(J + E/eps) gamma): the energy becomes a part of J. */
static iso_status shift_moments(iso_conversion *c, const conversion_row *r)
{
    const double eps = c->stated_eps, *J = c->params->J, kinetic = dot(r->y, r->y) / 2;
    const double E = kinetic - eps * dot_diag(r->y + 3, J, r->y + 3);
    if (!c->shift_J || isnan(eps) || fabs(E) <= iso_conversion_digits(c) * kinetic) return ISO_OK;
    const iso_status status =
        iso_params_reduced(c->ctx, -1, (double[]){J[0] + E / eps, J[1] + E / eps, J[2] + E / eps}, &c->shifted);
    if (status == ISO_OK) {
        c->params = &c->shifted;
        c->effects.on[ISO_LEVEL] = false;
        return ISO_OK;
    }
    return iso_context_fail(c->ctx, ISO_NOT_MAPPED, "",
                            "no free ball has this energy, J + E/eps: %s; without a shift "
                            "there is one in the potential of a level",
                            iso_context_message(c->ctx));
}

static iso_status open_units(iso_conversion *c, const conversion_row *r)
{
    iso_status status = shift_moments(c, r);
    if (status == ISO_OK) status = open_first(c, r);
    if (status != ISO_OK) return status;
    const double unit_M = iso_unit(&c->units, iso_system_point.fast_dimension);
    c->unit_from = c->from == ISO_BALL ? c->units.w : unit_M;
    c->unit_to = c->from == ISO_BALL ? unit_M : c->units.w;
    c->unit_own = iso_unit(&c->units, iso_clock_dimension(c->own));
    c->unit_other = iso_unit(&c->units, iso_clock_dimension(c->other));
    return ISO_OK;
}

/* The header, and the marks of rows before the first good one. */
static iso_status begin(iso_conversion *c, const conversion_row *r)
{
    iso_record *header;
    iso_status status = ISO_OK;
    if (c->own_column >= 0) status = iso_between_create(c->ctx, iso_orbit_model(c->first), c->tolerance, &c->between);
    if (status == ISO_OK) status = iso_conversion_describe(c, r->time, &header);
    if (status != ISO_OK) return status;
    status = c->target.header(c->target.data, header);
    iso_record_free(header);
    c->begun = true;
    for (; status == ISO_OK && c->marks > 0; c->marks--) status = c->target.row(c->target.data, NULL);
    return status;
}

/* --- rows -------------------------------------------------------------------------------------------------------- */

static iso_status check_finite(const iso_conversion *c, const double row[])
{
    for (size_t i = 0; i < iso_record_columns(c->in); i++)
        if (!isfinite(row[i]))
            return iso_context_fail(c->ctx, ISO_BAD_INPUT, "", "%s is not finite", iso_record_name(c->in, i));
    return ISO_OK;
}

/* Everything of a row but its place among the others. */
static iso_status make_row(iso_conversion *c, const double row[], conversion_row *r)
{
    iso_start start;
    for (int i = 0; i < ISO_STATE; i++) r->y[i] = row[c->state[i]];
    r->time = c->own_column >= 0 ? row[c->own_column] : 0;
    iso_status status = check_finite(c, row);
    if (status == ISO_OK) status = iso_conversion_start(c, r->y, &start);
    if (status == ISO_OK && !c->begun) status = open_units(c, r);
    if (status != ISO_OK) return status;
    copy(r->y, r->own, ISO_STATE);
    for (int i = 0; i < 3; i++) r->own[i] /= c->unit_from;
    status = check_energy(c, r);
    if (status == ISO_OK) status = map_state(c, r);
    if (status == ISO_OK) note_constraints(c, r);
    given_clock(c, row, r);
    return status;
}

/* Rows behind the first are of other energies, one after the other: what is stated of them all is wrong. */
static bool is_strange(iso_conversion *c, iso_status status)
{
    if (status != ISO_NOT_MAPPED || c->good != 1 || strcmp(iso_context_field(c->ctx), "eps") != 0) return false;
    return ++c->strangers == 3;
}

iso_status iso_conversion_put(iso_conversion *c, const double row[], size_t line)
{
    ISO_DEFAULT_ARITHMETIC;
    conversion_row r = {.line = line};
    c->summary.rows++;
    iso_status status = make_row(c, row, &r);
    if (status != ISO_OK) return is_strange(c, status) ? status : iso_conversion_bad(c, line, status);
    c->good++;
    if (!c->begun) status = begin(c, &r);
    if (status != ISO_OK) return status;
    return c->between ? iso_conversion_follow(c, &r) : iso_conversion_emit(c, &r);
}

iso_status iso_conversion_end(iso_conversion *c, iso_conversion_summary *summary)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_status status = c->between ? iso_conversion_settle(c) : ISO_OK;
    c->summary.checked = c->between != NULL;
    c->summary.clock = c->other;
    if (summary) *summary = c->summary;
    if (status != ISO_OK || c->begun) return status;
    if (c->first_words) return iso_context_fail(c->ctx, c->first_failure, "", "%s", c->first_words);
    return iso_context_fail(c->ctx, ISO_BAD_INPUT, "",
                            c->summary.rows ? "no row could be read" : "the trajectory has no rows");
}

/* --- beginning and end ------------------------------------------------------------------------------------------- */

static iso_status refuse_effect(const iso_conversion *c)
{
    const iso_effect *e = iso_effects_breaking(&c->effects);
    if (!e) return ISO_OK;
    return iso_context_fail(c->ctx, ISO_NOT_MAPPED, "effects",
                            "this trajectory was made with '%s', which breaks the isomorphism: %s", e->name,
                            e->breaks);
}

static iso_status find_columns(iso_conversion *c)
{
    int columns[ISO_STATE];
    const iso_picture to = c->from == ISO_BALL ? ISO_POINT : ISO_BALL;
    const iso_status status = iso_record_find_state(c->ctx, c->in, c->from, c->state);
    if (status != ISO_OK && iso_record_find_state(c->ctx, c->in, to, columns) == ISO_OK)
        return iso_context_fail(c->ctx, ISO_BAD_INPUT, "columns", "this is a %s's trajectory already",
                                iso_picture_name((int)to));
    if (status != ISO_OK) return iso_record_find_state(c->ctx, c->in, c->from, c->state);
    c->own = c->from == ISO_BALL ? ISO_CLOCK_T : ISO_CLOCK_S;
    c->other = c->from == ISO_BALL ? ISO_CLOCK_S : ISO_CLOCK_T;
    c->own_column = iso_record_find(c->in, iso_clock_name(c->own));
    c->other_column = iso_record_find(c->in, iso_clock_name(c->other));
    c->summary.computed = c->own_column >= 0 && c->other_column < 0;
    return ISO_OK;
}

static iso_status read_lines(iso_conversion *c)
{
    iso_status status = iso_record_effects(c->ctx, c->in, &c->effects);
    if (status == ISO_OK) status = refuse_effect(c);
    c->effects = iso_effects_acting(&c->effects);
    c->stated_eps = NAN;
    if (status == ISO_OK && c->from == ISO_POINT) {
        double eps;
        if (iso_record_coupling(c->ctx, c->in, c->params, &eps, &status)) c->stated_eps = eps;
    }
    return status;
}

iso_status iso_conversion_create(iso_context *ctx, const iso_params *params, const iso_record *header, iso_picture to,
                                 const iso_conversion_options *options, const iso_conversion_target *target,
                                 iso_conversion **conversion)
{
    iso_conversion *c = *conversion = calloc(1, sizeof *c);
    if (!c) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for a conversion");
    c->ctx = ctx;
    c->params = params;
    c->in = header;
    c->target = *target;
    c->from = to == ISO_BALL ? ISO_POINT : ISO_BALL;
    c->tolerance = options->tolerance;
    c->shift_J = options->shift_J;
    iso_status status = find_columns(c);
    if (status == ISO_OK && c->shift_J && (c->from != ISO_POINT || params->k != -1))
        status =
            iso_context_fail(ctx, ISO_BAD_ARGUMENT, "shift-J", "energy can shift J for a point with k = -1 alone");
    if (status == ISO_OK) status = read_lines(c);
    if (status == ISO_OK) return ISO_OK;
    iso_conversion_free(c);
    *conversion = NULL;
    return status;
}

void iso_conversion_free(iso_conversion *c)
{
    if (!c) return;
    iso_between_free(c->between);
    iso_orbit_free(c->first);
    free(c->first_words);
    free(c);
}

/* --- whole records ----------------------------------------------------------------------------------------------- */

typedef struct whole {
    iso_context *ctx;
    iso_record *out;
} whole;

static iso_status keep_header(void *data, const iso_record *header)
{
    whole *w = data;
    const char *names[1 + ISO_STATE], *key, *value;
    for (size_t i = 0; i < iso_record_columns(header); i++) names[i] = iso_record_name(header, i);
    iso_status status = iso_record_create(w->ctx, iso_record_columns(header), names, &w->out);
    for (size_t i = 0; status == ISO_OK && iso_record_line(header, i, &key, &value); i++)
        status = iso_record_set(w->ctx, w->out, key, value);
    return status;
}

static iso_status keep_row(void *data, const double row[])
{
    whole *w = data;
    double *to;
    const iso_status status = iso_record_append(w->ctx, w->out, &to);
    if (status == ISO_OK) copy(row, to, (int)iso_record_columns(w->out));
    return status;
}

static iso_status stop_at(void *data, size_t line, iso_status why, const char *words)
{
    return iso_context_fail(((whole *)data)->ctx, why, "", "row %zu: %s", line, words);
}

iso_status iso_convert(iso_context *ctx, const iso_params *params, const iso_record *in, iso_picture to,
                       double tolerance, iso_record **out)
{
    ISO_DEFAULT_ARITHMETIC;
    whole w = {.ctx = ctx};
    const iso_conversion_target target = {keep_header, keep_row, stop_at, &w};
    iso_conversion *c;
    *out = NULL;
    const iso_conversion_options options = {.tolerance = tolerance};
    iso_status status = iso_conversion_create(ctx, params, in, to, &options, &target, &c);
    if (status != ISO_OK) return status;
    for (size_t row = 0; status == ISO_OK && row < iso_record_rows(in); row++)
        status = iso_conversion_put(c, iso_record_const_row(in, row), row + 1);
    if (status == ISO_OK) status = iso_conversion_end(c, NULL);
    iso_conversion_free(c);
    if (status == ISO_OK)
        *out = w.out;
    else
        iso_record_free(w.out);
    return status;
}

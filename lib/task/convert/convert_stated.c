/* convert_stated.c - what the lines state of the energy (h, eps, c of the level), against the first row; and the
 * header of the result.
 *
 * With a level's c (0 without one) a row has one energy h, and eps = h det J/k^2. So of h, eps and c one that is off
 * is known by the other two. What the row does not confirm is printed, and the row's own number takes its place. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "model/model_impl.h"
#include "orbit/orbit_impl.h"
#include "task/convert/convert_impl.h"

/* Energies h of the ball, in own units. */
typedef struct account {
    double row, h, eps;      /* of the row; stated, by h and by eps (NAN: not)                            */
    double size, slope;      /* of the terms of h; h of the row falls by so much for each unit of c       */
    double rounding, growth; /* what rounding makes of h, relative to its size; and the steps to the row  */
} account;

double iso_conversion_digits(const iso_conversion *c)
{
    return c->row_tolerance > ISO_ROW_TOLERANCE ? 10 * c->row_tolerance : 1e-6;
}

/* --- how exact a row is ----------------------------------------------------------------------------------------- */

double iso_conversion_constraint(const double y[ISO_STATE])
{
    const double size = largest(y);
    double along = 0;
    for (int i = 0; i < 3 && size > 0; i++) along += y[i] / size * y[3 + i];
    return fmax(fabs(norm(y + 3) - 1), fabs(along));
}

/* A row is as exact as its constraints show. Energies are squares, with powers 1/k, of vectors that may lie along the
 * axis of the least moment. */
static double rounding_of(const iso_conversion *c, const conversion_row *r)
{
    const double *J = c->params->J, digits = fmax(2 * DBL_EPSILON, iso_conversion_constraint(r->y));
    return 8 * (1 + 1 / fabs(c->params->k)) * sqrt(max3(J) / min3(J)) * digits;
}

/* A row behind the start has the error of the steps to it: ten in the time in which a ball turns by an angle of 1,
 * each of the stated tolerance. */
static double growth_of(const iso_conversion *c, const conversion_row *r)
{
    double tolerance = 0;
    iso_status unused;
    iso_record_get_numbers(c->ctx, c->in, "tolerance", 1, &tolerance, &unused);
    return 10 * fmax(tolerance, DBL_EPSILON) * fabs(r->time) / c->first->unit_clock[c->own];
}

/* --- the account ------------------------------------------------------------------------------------------------ */

/* The point's M^2/2 + V must be its level and eps q^(-1/k). */
static void count_row(const iso_conversion *c, const conversion_row *r, account *a)
{
    const bool ball = c->from == ISO_BALL;
    const iso_system *system = ball ? &iso_system_ball : &iso_system_point;
    iso_problem f = iso_orbit_model(c->first)->problem;
    double own[ISO_STATE];
    copy(r->y, own, ISO_STATE);
    for (int i = 0; i < 3; i++) own[i] /= ball ? c->first->units.w : c->first->unit_M;
    const double q = ball ? 1 / dot_diag(own + 3, f.p.inv_J, own + 3) : dot_diag(own + 3, f.p.J, own + 3);
    a->slope = pow(q, 1 / f.p.k);
    if (!ball) f.eps = 0;
    a->row = system->energy(&f, own, &a->size);
    if (ball) return;
    const double unit = iso_unit(&c->first->units, iso_level_dimension());
    const double level = iso_effects_have_level(&c->effects) ? iso_effects_level(&c->effects) / unit : 0;
    a->row = iso_energy(&f.p, a->row * a->slope) - level * a->slope;
    a->size = fmax(iso_energy(&f.p, a->size * a->slope), fabs(level) * a->slope);
}

static account account_of(const iso_conversion *c, const conversion_row *r)
{
    account a = {.rounding = rounding_of(c, r), .growth = growth_of(c, r)};
    count_row(c, r, &a);
    const bool shifted = c->params == &c->shifted; /* h belongs to the moments before */
    iso_status unused;
    a.h = shifted ? NAN : iso_stated_energy(c->ctx, c->in, &c->first->units, "h", &unused);
    a.eps = iso_stated_energy(c->ctx, c->in, &c->first->units, "eps", &unused);
    return a;
}

/* Whether two energies are the same up to this, relative to the size of the terms; NAN is like none. */
static bool alike(const account *a, double x, double y, double most)
{
    return fabs(x - y) <= most * a->size;
}

/* --- the verdict ------------------------------------------------------------------------------------------------ */

static void note(iso_conversion *c, const char *key, double stated, double own, double off)
{
    iso_stated *s = &c->summary.stated[c->summary.stated_count++];
    *s = (iso_stated){.stated = stated, .own = own, .off = off};
    snprintf(s->key, sizeof s->key, "%s", key);
}

/* One of h and eps, `number` in the caller's units for each unit of energy, against the energy that is taken: it is
 * replaced if they differ, and printed if the steps to the row do not explain it. */
static void compare_stated(iso_conversion *c, const account *a, const char *key, double number, double stated,
                           double taken)
{
    if (isnan(stated) || alike(a, stated, taken, a->rounding)) return;
    c->replaces = true;
    if (!alike(a, stated, taken, a->rounding + a->growth))
        note(c, key, stated * number, taken * number, fabs(stated - taken) / a->size);
}

/* The c that h and eps say. */
static void mend_level(iso_conversion *c, const account *a)
{
    char key[ISO_NAME_SIZE];
    const double unit = iso_unit(&c->first->units, iso_level_dimension());
    const double stated = iso_effects_level(&c->effects), own = stated + (a->row - a->h) / a->slope * unit;
    const iso_effect *level = iso_effect_list[iso_effect_find(iso_level_name())];
    iso_effect_line(key, level, level->numbers->name);
    note(c, key, stated, own, fabs(a->h - a->row) / a->size);
    iso_effects_set_level(&c->effects, true, own);
    c->replaces = true;
}

bool iso_conversion_reconcile(iso_conversion *c, const conversion_row *r)
{
    const iso_params *p = &c->first->units.own;
    const double digits = iso_conversion_digits(c);
    account a = account_of(c, r);
    c->summary.stated_count = 0; /* the row before may have been bad */
    c->replaces = c->params == &c->shifted || (isnan(a.h) && isnan(a.eps));
    if (iso_effects_have_level(&c->effects) && alike(&a, a.h, a.eps, a.rounding) &&
        !alike(&a, a.h, a.row, a.rounding + a.growth)) { /* h and eps agree with each other, not with the row */
        mend_level(c, &a);
        a.row = a.h;
    }
    const bool own = c->from == ISO_BALL || alike(&a, a.h, a.row, digits) || alike(&a, a.eps, a.row, digits);
    const double taken = own ? a.row : isnan(a.eps) ? a.h : a.eps;
    compare_stated(c, &a, "h", iso_unit(&c->first->units, iso_dimension_h), a.h, taken);
    compare_stated(c, &a, "eps", iso_coupling(p, 1) * iso_unit(&c->first->units, iso_dimension_eps), a.eps, taken);
    return own;
}

bool iso_conversion_stated_text(const iso_conversion_summary *s, int i, char text[ISO_STATED_SIZE])
{
    if (i >= s->stated_count) return false;
    const iso_stated *x = &s->stated[i];
    snprintf(text, ISO_STATED_SIZE,
             "# %s: %s does not fit the first row (off by %.2g of the terms of its energy); %s fits, and is written",
             x->key, ISO_SHORT(x->stated), x->off, ISO_SHORT(x->own));
    return true;
}

bool iso_conversion_verdict(const iso_conversion_summary *s, char text[ISO_VERDICT_SIZE], size_t *at)
{
    static const char *const equations = "these rows do not solve the equations that are stated for them (k, J, eps, "
                                         "clocks), or have too few digits";
    enum { FEW = 4 }; /* damaged rows of a short file */
    const bool most = isfinite(s->max_drift) && s->missed > FEW && s->missed > (s->between + s->integrated) / 10;
    if (!s->checked) return false;
    if (!(s->drift.value <= s->max_drift)) {
        *at = s->drift.line;
        snprintf(text, ISO_VERDICT_SIZE,
                 "%s: they drift off by %.2g in half a radian or one interval, whichever is longer", equations,
                 s->drift.value);
        return true;
    }
    *at = s->missed_line;
    if (s->missed > 0)
        snprintf(text, ISO_VERDICT_SIZE,
                 "%s%srows away from the orbit through the row before, or before it in time: %zu, the farthest by "
                 "%.2g; they were converted as they stand",
                 most ? equations : "", most ? ": " : "", s->missed, s->defect.value);
    return s->missed > 0;
}

/* --- the header of the result ----------------------------------------------------------------------------------- */

/* Lines for the first value of a clock that the result has no column for. */
static const char *const origin_line[] = {[ISO_CLOCK_T] = "t0", [ISO_CLOCK_S] = "s0"};

/* h and eps are those that the record states, if its first row confirms them; else those of the first row. */
static iso_status describe_energy(const iso_conversion *c, iso_model_kind to, iso_record *out)
{
    char key[ISO_NAME_SIZE];
    snprintf(key, sizeof key, "%s.c", iso_level_name());
    const bool named = !iso_effects_have_level(&c->effects) || iso_record_get(out, key);
    return iso_record_describe(c->ctx, out, iso_model_kind_name((int)to), c->params,
                               !c->replaces && named ? NULL : c->first);
}

/* Lines that do not hold for the result: of effects that only observe, of how a clock was computed. */
static bool is_left_behind(const iso_conversion *c, const char *key)
{
    static const char *const keys[] = {"effects", "s.from", "s.error", "t.from", "t.error", "radius"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (strcmp(key, keys[i]) == 0) return true;
    for (int e = 0; e < ISO_EFFECTS; e++) {
        const iso_effect *effect = iso_effect_list[e];
        const size_t length = strlen(effect->name);
        const bool its_line = strncmp(key, effect->name, length) == 0 && key[length] == '.';
        if (its_line && (!c->effects.on[e] || e == ISO_LEVEL)) return true;
    }
    return false;
}

static iso_status set_lines(const iso_conversion *c, iso_model_kind to, double begin, iso_record *out)
{
    const char *key, *value, *origin = origin_line[c->own];
    for (size_t i = 0; iso_record_line(c->in, i, &key, &value); i++)
        if (!is_left_behind(c, key)) ISO_TRY(iso_record_set(c->ctx, out, key, value));
    ISO_TRY(iso_record_describe_effects(c->ctx, out, &c->effects));
    ISO_TRY(describe_energy(c, to, out));
    if (c->own_column >= 0 && (begin != 0 || iso_record_get(out, origin)))
        ISO_TRY(iso_record_set_numbers(c->ctx, out, origin, 1, &begin));
    return ISO_OK;
}

iso_status iso_conversion_describe(iso_conversion *c, double begin, iso_record **header)
{
    const iso_model_kind to = c->from == ISO_BALL ? ISO_POINT : ISO_BALL;
    const iso_system *target = to == ISO_BALL ? &iso_system_ball : &iso_system_point;
    const int has_clock = c->own_column >= 0 || c->other_column >= 0;
    const char *names[1 + ISO_STATE] = {iso_clock_name(c->other)};
    for (int i = 0; i < ISO_STATE; i++) names[has_clock + i] = target->state[i];
    iso_status status = iso_record_create(c->ctx, (size_t)(has_clock + ISO_STATE), names, header);
    if (status == ISO_OK) status = set_lines(c, to, begin, *header);
    c->sum = 0; /* the first value of the computed clock */
    if (status == ISO_OK) iso_record_get_numbers(c->ctx, c->in, origin_line[c->other], 1, &c->sum, &status);
    if (status == ISO_OK) return ISO_OK;
    iso_record_free(*header);
    *header = NULL;
    return status;
}

bool iso_conversion_clock_lines(const iso_conversion_summary *s, char key[2][ISO_NAME_SIZE], char value[2][160])
{
    if (!s->computed) return false;
    snprintf(key[0], ISO_NAME_SIZE, "%s.from", iso_clock_name(s->clock));
    snprintf(value[0], 160, "the rows, %zu intervals by two-point Taylor quadrature, %zu by integration", s->between,
             s->integrated);
    snprintf(key[1], ISO_NAME_SIZE, "%s.error", iso_clock_name(s->clock));
    snprintf(value[1], 160, "%.2g", s->error);
    return true;
}

/* convert_clock.c - from row to row of a conversion: the other clock's way, the defect, and which row is damaged. */
#include <float.h>
#include <math.h>

#include "base/sum_impl.h"
#include "base/vec3_impl.h"
#include "orbit/convert_impl.h"

/* Defects up to here are nobody's damage: numbers written with ten digits. */
#define SMALL_DEFECT 1e-9

void iso_worst_note(iso_worst *worst, double value, size_t line)
{
    if (worst->line > 0 && !(fabs(value) > worst->value) && !isnan(value)) return;
    worst->value = isnan(value) ? INFINITY : fabs(value);
    worst->line = line;
}

/* Whether b comes after a, or at the same time, in the direction of the rows before. */
static bool in_order(const iso_conversion *c, const conversion_row *a, const conversion_row *b)
{
    const double step = b->time - a->time;
    return isfinite(step) && step * c->direction >= 0;
}

/* What would be no rows of the same orbit. */
static double unusual(const iso_conversion *c)
{
    return fmax(SMALL_DEFECT, 100 * c->typical);
}

static bool breaks_off(const iso_conversion *c, double defect)
{
    return !(defect <= unusual(c));
}

/* How far n moves in the time by which the file's other clock, if it has one, is wrong from a to b. */
static double late(const iso_conversion *c, const conversion_row *a, const conversion_row *b, const iso_gap *gap)
{
    const double there = gap->gained[c->other], *n = b->y + 3, *m = a->y + 3;
    if (c->other_column < 0 || there == 0) return 0;
    return ((b->out[0] - a->out[0]) / there - 1) * norm((double[]){n[0] - m[0], n[1] - m[1], n[2] - m[2]});
}

/* From a to b by integration. */
static iso_status integrate(const iso_conversion *c, const conversion_row *a, const conversion_row *b, iso_gap *gap)
{
    iso_start start;
    iso_orbit *orbit = NULL;
    iso_sample sample;
    *gap = (iso_gap){.defect = 0};
    iso_status status = iso_conversion_start(c, a->y, &start);
    if (status == ISO_OK) status = iso_conversion_orbit(c, &start, true, &orbit);
    if (status == ISO_OK) status = iso_orbit_at(orbit, b->time - a->time, &sample);
    iso_orbit_free(orbit);
    if (status != ISO_OK) return status;
    const double *y = c->from == ISO_BALL ? sample.ball : sample.point;
    for (int v = 0; v < ISO_STATE; v += 3) {
        const double size = v == 0 ? fmax(largest(y), largest(b->y)) : 1;
        for (int i = v; i < v + 3; i++) gap->motion[i] = size > 0 ? b->y[i] / size - y[i] / size : 0;
        gap->defect = fmax(gap->defect, norm(gap->motion + v));
    }
    gap->gained[c->other] = sample.clock[c->other];
    gap->defect = fmax(gap->defect, fabs(late(c, a, b, gap)));
    gap->error[c->other] = fmax(c->tolerance, 4 * DBL_EPSILON) * fabs(sample.clock[c->other]);
    return ISO_OK;
}

/* From a to b, which the quadrature knows as its last two samples, or again is shown. */
static bool measure(iso_conversion *c, const conversion_row *a, const conversion_row *b, iso_gap *gap)
{
    if (!iso_between_measure(c->between, (b->time - a->time) / c->unit_own, c->typical, gap)) return false;
    gap->gained[c->other] *= c->unit_other;
    gap->error[c->other] *= c->unit_other;
    gap->defect = fmax(gap->defect, fabs(late(c, a, b, gap)));
    return true;
}

static bool measure_anew(iso_conversion *c, const conversion_row *a, const conversion_row *b, iso_gap *gap)
{
    iso_between_take(c->between, a->own);
    iso_between_take(c->between, b->own);
    return measure(c, a, b, gap);
}

/* The same by whatever serves; *by_steps tells. */
static iso_status judge(iso_conversion *c, const conversion_row *a, const conversion_row *b, iso_gap *gap,
                        bool *by_steps)
{
    *by_steps = !measure_anew(c, a, b, gap);
    const iso_status status = *by_steps ? integrate(c, a, b, gap) : ISO_OK;
    if (status == ISO_NO_MEMORY || status == ISO_STOPPED) c->trouble = status;
    return status;
}

/* How much a relative error of the state changes the clock's rate, q^e with |grad q| <= 2 sqrt(max J/min J) q. */
static double sensitivity(const iso_conversion *c)
{
    const double *J = c->params->J;
    double e;
    iso_clock_rate(c->params, ISO_CLOCK_S, 1, &e);
    return 2 * fabs(e) * sqrt(fmax(J[0], fmax(J[1], J[2])) / fmin(J[0], fmin(J[1], J[2])));
}

/* What the rows' equations make of the clock, if they are others than those stated: about as wrong as the drift. */
static void close_drift(iso_conversion *c)
{
    const double drift = fmax(norm(c->drift), norm(c->drift + 3));
    if (c->moved > 0) c->summary.error += (3 + sensitivity(c)) * drift / c->moved * fabs(c->gained);
    for (int i = 0; i < ISO_STATE; i++) c->drift[i] = 0;
    c->moved = c->gained = c->late = 0;
}

static void add_drift(iso_conversion *c, const conversion_row *row, const iso_gap *gap)
{
    const double *n = row->y + 3, *m = c->last.y + 3;
    for (int i = 0; i < ISO_STATE; i++) c->drift[i] += gap->motion[i];
    c->late += late(c, &c->last, row, gap);
    c->moved += norm((double[]){n[0] - m[0], n[1] - m[1], n[2] - m[2]});
    c->gained += gap->gained[c->other];
    iso_worst_note(&c->summary.drift, fmax(fabs(c->late), fmax(norm(c->drift), norm(c->drift + 3))), row->line);
    if (c->moved >= 0.5) close_drift(c);
}

static iso_status write_marks(iso_conversion *c, size_t *marks)
{
    iso_status status = ISO_OK;
    for (; status == ISO_OK && *marks > 0; --*marks) status = c->target.row(c->target.data, NULL);
    return status;
}

/* The marks that waited for the held row; they wait on where the first one does. */
static iso_status release_marks(iso_conversion *c)
{
    if (!c->unwritten) return write_marks(c, &c->marks);
    c->first_marks += c->marks;
    c->marks = 0;
    return ISO_OK;
}

/* The first row is good: it is written, with the marks behind it. */
static iso_status write_first(iso_conversion *c)
{
    c->unwritten = false;
    const iso_status status = iso_conversion_emit(c, &c->last);
    return status == ISO_OK ? write_marks(c, &c->first_marks) : status;
}

/* The row follows the last one, and becomes it. */
static iso_status accept(iso_conversion *c, const conversion_row *row, const iso_gap *gap, bool by_steps)
{
    const double there = gap->gained[c->other], step = row->time - c->last.time;
    double lost;
    iso_conversion_summary *s = &c->summary;
    if (c->trouble != ISO_OK) return c->trouble;
    if (c->unwritten) {
        const iso_status status = write_first(c);
        if (status != ISO_OK) return status;
    }
    c->doubted = 0;
    by_steps ? s->integrated++ : s->between++;
    iso_worst_note(&s->defect, gap->defect, row->line);
    add_drift(c, row, gap);
    c->typical = 0.9 * c->typical + 0.1 * fmin(gap->defect, unusual(c)); /* one that breaks off hides no others */
    if (c->direction == 0 && step != 0) c->direction = step > 0 ? 1 : -1;
    c->sum = iso_two_sum(c->sum, there, &lost);
    c->lost += lost;
    s->error += gap->error[c->other] + sensitivity(c) * gap->defect * fabs(there);
    c->last = *row;
    if (s->computed) {
        c->last.out[0] = c->sum + c->lost;
        if (!isfinite(c->last.out[0])) {
            iso_context_fail(c->ctx, ISO_NUMERICAL, "", "%s is too large for a double", iso_clock_name(c->other));
            return iso_conversion_bad(c, row->line, ISO_NUMERICAL);
        }
    }
    return iso_conversion_emit(c, &c->last);
}

static iso_status refuse_time(iso_conversion *c, const conversion_row *row)
{
    if (c->trouble != ISO_OK) return c->trouble;
    iso_context_fail(c->ctx, ISO_BAD_INPUT, "", "%s turns back; sort the rows by time", iso_clock_name(c->own));
    return iso_conversion_bad(c, row->line, ISO_BAD_INPUT);
}

static iso_status refuse_defect(iso_conversion *c, const conversion_row *row)
{
    if (c->trouble != ISO_OK) return c->trouble;
    iso_context_fail(c->ctx, ISO_BAD_INPUT, "",
                     "this row is damaged: it does not lie on the orbit of the rows beside it");
    return iso_conversion_bad(c, row->line, ISO_BAD_INPUT);
}

/* Whether a row and the next lie on one orbit, as far as others of the file do. */
static bool agree(iso_conversion *c, const conversion_row *a, const conversion_row *b)
{
    iso_gap gap;
    bool by_steps;
    return in_order(c, a, b) && a->time != b->time && judge(c, a, b, &gap, &by_steps) == ISO_OK &&
           !breaks_off(c, gap.defect);
}

/* The first row is damaged: the held one takes its place. */
static iso_status replace_first(iso_conversion *c, const conversion_row *held)
{
    const iso_status status = refuse_defect(c, &c->last);
    c->last = *held;
    if (c->summary.computed) c->last.out[0] = c->sum;
    return status == ISO_OK ? write_marks(c, &c->first_marks) : status;
}

/* A row that breaks off both from the last and from the next: damaged, where the file has been better so far. */
static bool is_doubtful(iso_conversion *c, const conversion_row *held, const conversion_row *next)
{
    enum { KNOWN = 10, MOST = 8 };
    if (c->summary.between + c->summary.integrated < KNOWN || c->doubted == MOST) return false;
    if (next && agree(c, held, next)) return false;
    c->doubted++;
    return true;
}

/* The held row is accepted, or (damaged) refused; c->is_held falls first, so that its own mark is written at once. */
static iso_status decide(iso_conversion *c, const conversion_row *next)
{
    const conversion_row held = c->held;
    const bool behind = in_order(c, &c->last, &held);
    const bool before = next && in_order(c, &c->last, next) && next->time != c->last.time;
    iso_gap gap = {.defect = INFINITY}, over;
    bool by_steps = false, steps_over;
    const size_t marks = c->marks;
    c->is_held = false;
    c->marks = 0;
    iso_status status = ISO_OK, reach = ISO_BAD_INPUT;
    const bool jumps = next && (!behind || !in_order(c, &held, next));
    if (behind && !(jumps && before)) reach = judge(c, &c->last, &held, &gap, &by_steps);
    if (reach == ISO_OK && !breaks_off(c, gap.defect)) {
        status = accept(c, &held, &gap, by_steps);
    } else if (before && judge(c, &c->last, next, &over, &steps_over) == ISO_OK && over.defect < gap.defect / 10 &&
               !breaks_off(c, over.defect)) {
        status = behind ? refuse_defect(c, &held) : refuse_time(c, &held);
    } else if (c->unwritten && next && agree(c, &held, next)) {
        status = replace_first(c, &held);
    } else if (!behind) {
        status = refuse_time(c, &held);
    } else if (is_doubtful(c, &held, next)) {
        status = refuse_defect(c, &held);
    } else {
        if (reach != ISO_OK) reach = judge(c, &c->last, &held, &gap, &by_steps);
        status = reach == ISO_OK ? accept(c, &held, &gap, by_steps) : iso_conversion_bad(c, held.line, reach);
    }
    c->marks = marks;
    iso_between_take(c->between, c->last.own);
    return status == ISO_OK ? release_marks(c) : status;
}

iso_status iso_conversion_follow(iso_conversion *c, const conversion_row *row)
{
    iso_gap gap;
    iso_status status = c->is_held ? decide(c, row) : ISO_OK;
    if (status != ISO_OK) return status;
    if (!c->has_last) {
        c->has_last = true;
        c->last = *row;
        iso_between_take(c->between, row->own);
        c->unwritten = true;
        if (c->summary.computed) c->last.out[0] = c->sum;
        return ISO_OK;
    }
    iso_between_take(c->between, row->own);
    if (in_order(c, &c->last, row) && measure(c, &c->last, row, &gap) && !breaks_off(c, gap.defect))
        return accept(c, row, &gap, false);
    c->held = *row;
    c->is_held = true;
    return ISO_OK;
}

iso_status iso_conversion_settle(iso_conversion *c)
{
    iso_status status = c->is_held ? decide(c, NULL) : ISO_OK;
    if (status == ISO_OK && c->unwritten) status = write_first(c);
    close_drift(c);
    c->summary.error += 2 * DBL_EPSILON * fabs(c->sum + c->lost);
    c->summary.end = c->sum + c->lost;
    return status;
}

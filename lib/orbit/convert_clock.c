/* convert_clock.c - from one row of a conversion to the next: the gain of the other clock, the defect (the distance
 * of a row from the orbit of the row before it), and which of two rows is damaged. */
#include <float.h>
#include <math.h>

#include "base/sum_impl.h"
#include "base/vec3_impl.h"
#include "model/model_impl.h"
#include "orbit/convert_impl.h"

/* Defects up to here come from rounding to ten digits, not from damage. */
#define SMALL_DEFECT 1e-9

/* Whether b comes after a, or at the same time, in the direction of the rows before. */
static bool in_order(const iso_conversion *c, const conversion_row *a, const conversion_row *b)
{
    const double step = b->time - a->time;
    return isfinite(step) && step * c->direction >= 0;
}

/* A larger defect means: these rows do not lie on one orbit. */
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

/* From a to b by quadrature, whose last two samples they must be. False: they are too far apart. */
static bool measure(iso_conversion *c, const conversion_row *a, const conversion_row *b, iso_gap *gap)
{
    if (!iso_two_point_measure(c->quadrature, (b->time - a->time) / c->unit_own, c->typical, gap)) return false;
    gap->gained[c->other] *= c->unit_other;
    gap->error[c->other] *= c->unit_other;
    gap->defect = fmax(gap->defect, fabs(late(c, a, b, gap)));
    return true;
}

/* The same, with the samples given again. */
static bool measure_anew(iso_conversion *c, const conversion_row *a, const conversion_row *b, iso_gap *gap)
{
    iso_two_point_add(c->quadrature, a->own);
    iso_two_point_add(c->quadrature, b->own);
    return measure(c, a, b, gap);
}

/* From a to b by quadrature or, if they are too far apart, by integration (*by_steps). */
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

/* Ends one piece of the drift. If the rows follow other equations than the stated ones, the clock is wrong by about
 * as much as the state drifts: this goes into the estimate of the error. */
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

/* The marks that waited for the held row. They go on waiting if the first row is not yet written. */
static iso_status release_marks(iso_conversion *c)
{
    if (!c->unwritten) return iso_conversion_write_marks(c, &c->marks);
    c->first_marks += c->marks;
    c->marks = 0;
    return ISO_OK;
}

/* The first row is good: writes it, and the marks behind it. */
static iso_status write_first(iso_conversion *c)
{
    c->unwritten = false;
    ISO_TRY(iso_conversion_emit(c, &c->last));
    return iso_conversion_write_marks(c, &c->first_marks);
}

/* The row follows the last one, and becomes it. */
static iso_status accept(iso_conversion *c, const conversion_row *row, const iso_gap *gap, bool by_steps)
{
    const double there = gap->gained[c->other], step = row->time - c->last.time;
    double lost;
    iso_conversion_summary *s = &c->summary;
    if (c->trouble != ISO_OK) return c->trouble;
    if (c->unwritten) ISO_TRY(write_first(c));
    c->doubted = 0;
    by_steps ? s->integrated++ : s->between++;
    iso_worst_note(&s->defect, gap->defect, row->line);
    add_drift(c, row, gap);
    c->typical = 0.9 * c->typical + 0.1 * fmin(gap->defect, unusual(c)); /* a large one must not hide the next */
    if (c->direction == 0 && step != 0) c->direction = step > 0 ? 1 : -1;
    c->sum = iso_two_sum(c->sum, there, &lost);
    c->lost += lost;
    s->error += gap->error[c->other] + sensitivity(c) * gap->defect * fabs(there);
    c->last = *row;
    if (s->computed) {
        c->last.out[0] = c->sum + c->lost;
        if (!isfinite(c->last.out[0])) {
            ISO_FAIL_NUMERICAL(c->ctx, "%s is too large for a double", iso_clock_name(c->other));
            return iso_conversion_bad(c, row->line, ISO_NUMERICAL);
        }
    }
    return iso_conversion_emit(c, &c->last);
}

static iso_status refuse_time(iso_conversion *c, const conversion_row *row)
{
    if (c->trouble != ISO_OK) return c->trouble;
    ISO_FAIL_INPUT(c->ctx, "", "%s turns back: sort the rows by time", iso_clock_name(c->own));
    return iso_conversion_bad(c, row->line, ISO_BAD_INPUT);
}

static iso_status refuse_defect(iso_conversion *c, const conversion_row *row)
{
    if (c->trouble != ISO_OK) return c->trouble;
    ISO_FAIL_INPUT(c->ctx, "", "this row is damaged: it does not lie on the orbit of the rows beside it");
    return iso_conversion_bad(c, row->line, ISO_BAD_INPUT);
}

/* Whether two rows lie on one orbit, as well as the other rows of the file do. */
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
    return status == ISO_OK ? iso_conversion_write_marks(c, &c->first_marks) : status;
}

/* Whether a row that fits neither the last nor the next is damaged. It is, if the rows so far were better; but not
 * more than MOST rows one after the other, since then the orbit itself has changed. */
static bool is_doubtful(iso_conversion *c, const conversion_row *held, const conversion_row *next)
{
    enum { KNOWN = 10, MOST = 8 };
    if (c->summary.between + c->summary.integrated < KNOWN || c->doubted == MOST) return false;
    if (next && agree(c, held, next)) return false;
    c->doubted++;
    return true;
}

/* Whether the row after the held one lies on the orbit of the last row, much better than the held row does. */
static bool goes_on_without(iso_conversion *c, const conversion_row *next, double defect)
{
    iso_gap over;
    bool by_steps;
    return judge(c, &c->last, next, &over, &by_steps) == ISO_OK && over.defect < defect / 10 &&
           !breaks_off(c, over.defect);
}

/* What becomes of the held row. */
typedef enum verdict {
    FOLLOWS,       /* it lies on the orbit, or nothing shows that it is damaged   */
    DAMAGED,       /* it does not lie on the orbit of the rows beside it          */
    TURNS_BACK,    /* its time is before that of the last row                     */
    FIRST_DAMAGED, /* the last row is the first, and does not lie on the orbit    */
    UNREACHABLE    /* the orbit of the last row cannot be integrated to its time  */
} verdict;

/* The orbit from the last row to the held one. */
typedef struct way {
    iso_gap gap;
    bool by_steps;
    iso_status reach; /* ISO_OK: gap is known */
} way;

static verdict weigh(iso_conversion *c, const conversion_row *held, const conversion_row *next, way *w)
{
    const bool behind = in_order(c, &c->last, held);
    const bool before = next && in_order(c, &c->last, next) && next->time != c->last.time;
    const bool jumps = next && (!behind || !in_order(c, held, next));
    *w = (way){.gap = {.defect = INFINITY}, .reach = ISO_BAD_INPUT};
    if (behind && !(jumps && before)) w->reach = judge(c, &c->last, held, &w->gap, &w->by_steps);
    if (w->reach == ISO_OK && !breaks_off(c, w->gap.defect)) return FOLLOWS;
    if (before && goes_on_without(c, next, w->gap.defect)) return behind ? DAMAGED : TURNS_BACK;
    if (c->unwritten && next && agree(c, held, next)) return FIRST_DAMAGED;
    if (!behind) return TURNS_BACK;
    if (is_doubtful(c, held, next)) return DAMAGED;
    if (w->reach != ISO_OK) w->reach = judge(c, &c->last, held, &w->gap, &w->by_steps);
    return w->reach == ISO_OK ? FOLLOWS : UNREACHABLE;
}

static iso_status carry_out(iso_conversion *c, const conversion_row *held, verdict v, const way *w)
{
    switch (v) {
    case FOLLOWS: return accept(c, held, &w->gap, w->by_steps);
    case DAMAGED: return refuse_defect(c, held);
    case TURNS_BACK: return refuse_time(c, held);
    case FIRST_DAMAGED: return replace_first(c, held);
    case UNREACHABLE: break;
    }
    return iso_conversion_bad(c, held->line, w->reach);
}

/* Decides about the held row. It is no longer held then, so that its mark is written at once, before the marks that
 * wait behind it. */
static iso_status decide(iso_conversion *c, const conversion_row *next)
{
    const conversion_row held = c->held;
    const size_t marks = c->marks;
    way w;
    c->is_held = false;
    c->marks = 0;
    const verdict v = weigh(c, &held, next, &w);
    const iso_status status = carry_out(c, &held, v, &w);
    c->marks = marks;
    iso_two_point_add(c->quadrature, c->last.own);
    return status == ISO_OK ? release_marks(c) : status;
}

iso_status iso_conversion_follow(iso_conversion *c, const conversion_row *row)
{
    iso_gap gap;
    ISO_TRY(c->is_held ? decide(c, row) : ISO_OK);
    if (!c->has_last) {
        c->has_last = true;
        c->last = *row;
        iso_two_point_add(c->quadrature, row->own);
        c->unwritten = true;
        if (c->summary.computed) c->last.out[0] = c->sum;
        return ISO_OK;
    }
    iso_two_point_add(c->quadrature, row->own);
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

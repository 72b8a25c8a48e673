/* convert_clock.c - from one row of a conversion to the next: the gain of the other clock, and whether the orbit
 * through the row before misses the row. */
#include <float.h>
#include <math.h>
#include <stdio.h>

#include "base/math_impl.h"
#include "base/vec3_impl.h"
#include "orbit/watch_impl.h"
#include "task/convert/convert_impl.h"

/* The error of the file's other clock since the last row, as a way of n; 0: it has none. */
static double late(const iso_conversion *c, const conversion_row *r, double gained)
{
    const double *n = r->y + 3, *m = c->last.y + 3;
    if (c->other_column < 0 || gained == 0) return 0;
    return ((r->out[0] - c->last.out[0]) / gained - 1) * norm((double[]){n[0] - m[0], n[1] - m[1], n[2] - m[2]});
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

static void add_drift(iso_conversion *c, const conversion_row *r, const iso_row_gap *gap)
{
    const double *n = r->y + 3, *m = c->last.y + 3, gained = gap->gained[c->other];
    for (int i = 0; i < ISO_STATE; i++) c->drift[i] += gap->off[i];
    c->late += late(c, r, gained);
    c->moved += norm((double[]){n[0] - m[0], n[1] - m[1], n[2] - m[2]});
    c->gained += gained;
    iso_worst_note(&c->summary.drift, fmax(fabs(c->late), fmax(norm(c->drift), norm(c->drift + 3))), r->line);
    if (c->moved >= 0.5) close_drift(c);
}

/* Names a row that is converted as it stands. It is not known whether it or the row before is damaged. What rows drift
 * is counted anew behind it. */
static iso_status name_missed(iso_conversion *c, const conversion_row *r, const char *text)
{
    iso_conversion_summary *s = &c->summary;
    if (s->missed++ == 0) s->missed_line = r->line;
    close_drift(c);
    return c->name ? iso_conversion_name(c, r->line, ISO_BAD_INPUT, text) : ISO_OK;
}

/* The row becomes the last one, and is written. */
static iso_status keep(iso_conversion *c, conversion_row *r)
{
    iso_rows_keep(&c->rows);
    if (c->summary.computed) r->out[0] = c->sum + c->lost;
    c->last = *r;
    if (isfinite(r->out[0])) return iso_conversion_write(c, r->out);
    ISO_FAIL_NUMERICAL(c->ctx, "%s is too large for a double", iso_clock_name(c->other));
    return iso_conversion_bad(c, r->line, ISO_NUMERICAL);
}

/* The orbit of the row before does not get to this one. If that happens to two rows one after the other, the row before
 * is the damaged one: the next gap begins behind it, and how long the other clock took is not known. */
static iso_status cannot_reach(iso_conversion *c, conversion_row *r, iso_status why)
{
    char text[160];
    const bool ends = why == ISO_NO_MEMORY || why == ISO_STOPPED;
    if (ends || !c->unreached) return c->unreached = true, iso_conversion_bad(c, r->line, why);
    c->unreached = false;
    c->summary.error = INFINITY;
    snprintf(text, sizeof text,
             "the orbit through the row before cannot be followed to this one: %s goes on without the time between",
             iso_clock_name(c->other));
    ISO_TRY(name_missed(c, r, text));
    return keep(c, r);
}

/* Limits the steps to this row, which may be damaged: very fast, or far away in time. Ten steps are allowed for each
 * radian that the slower of both rows turns meanwhile; an angle counts up to LONG times the longest one so far. Returns
 * the angle. */
static double bound_steps(iso_conversion *c, const conversion_row *r)
{
    const double LONG = 1e4, FEW = 1e4;
    const double angle = fabs(r->time - c->last.time) / c->unit_own * fmin(largest(r->own), largest(c->last.own));
    c->max_steps =
        (long)fmin(ISO_MAX_ROW_STEPS, FEW + 10 * (c->longest > 0 ? fmin(angle, LONG * c->longest) : angle));
    return angle;
}

iso_status iso_conversion_follow(iso_conversion *c, const double row[], conversion_row *r)
{
    iso_row_gap gap;
    double lost;
    char text[160];
    iso_conversion_summary *s = &c->summary;
    iso_rows_take(&c->rows, row);
    if (c->good == 1) return keep(c, r);
    const double angle = bound_steps(c, r);
    const bool by_steps = !iso_rows_measure(&c->rows, c->typical, &gap);
    const iso_status reached = by_steps ? iso_rows_integrate(&c->rows, &gap) : ISO_OK;
    if (reached != ISO_OK) return cannot_reach(c, r, reached);
    c->unreached = false;
    c->longest = fmax(c->longest, angle);
    const double gained = gap.gained[c->other], off = late(c, r, gained);
    const double defect = iso_larger(iso_larger(0, gap.miss), off);
    const bool back = gap.step * c->direction < 0, missed = back || !(defect <= s->max_defect);
    by_steps ? s->integrated++ : s->between++;
    iso_worst_note(&s->defect, defect, r->line);
    if (!missed) {
        add_drift(c, r, &gap);
        if (c->direction == 0 && gap.step != 0) c->direction = gap.step > 0 ? 1 : -1;
    } else if (back) {
        snprintf(text, sizeof text, "%s turns back: sort the rows by time", iso_clock_name(c->own));
        ISO_TRY(name_missed(c, r, text));
    } else {
        snprintf(text, sizeof text, "this row is %.2g away from the orbit through the row before", defect);
        ISO_TRY(name_missed(c, r, text));
    }
    /* what rows miss as a rule; a large defect must not hide the next */
    c->typical = 0.9 * c->typical + 0.1 * fmin(defect, fmax(1e-9, 100 * c->typical));
    c->sum = iso_two_sum(c->sum, gained, &lost);
    c->lost += lost;
    s->error += gap.error[c->other] + sensitivity(c) * defect * fabs(gained);
    if (!(defect <= s->max_defect)) s->error += fabs(gained); /* nothing is known of it */
    return keep(c, r);
}

void iso_conversion_settle(iso_conversion *c)
{
    close_drift(c);
    c->summary.error += 2 * DBL_EPSILON * fabs(c->sum + c->lost);
    c->summary.end = c->sum + c->lost;
}

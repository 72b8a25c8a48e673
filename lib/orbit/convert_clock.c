/* convert_clock.c - from one row of a conversion to the next: the gain of the other clock, and whether the orbit through
 * the row before misses the row. */
#include <float.h>
#include <math.h>
#include <stdio.h>

#include "base/sum_impl.h"
#include "base/vec3_impl.h"
#include "model/model_impl.h"
#include "orbit/convert_impl.h"

/* How far n moves in the time by which the file's other clock, if it has one, is wrong since the last row. */
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

/* Names a row whose time turns back, or that is not on the orbit of the row before it. It is not known which of the two
 * is damaged. What rows drift is counted anew behind it. */
static iso_status name_missed(iso_conversion *c, const conversion_row *r, double step, double defect)
{
    char text[160];
    const bool back = step * c->direction < 0;
    if (!back && defect <= c->summary.max_defect) return ISO_OK;
    if (back)
        snprintf(text, sizeof text, "%s turns back: sort the rows by time", iso_clock_name(c->own));
    else
        snprintf(text, sizeof text, "this row is %.2g away from the orbit through the row before", defect);
    c->summary.missed++;
    close_drift(c);
    return c->target.missed(c->target.data, r->line, text);
}

/* The row becomes the last one, and is written. */
static iso_status keep(iso_conversion *c, conversion_row *r)
{
    iso_rows_keep(&c->rows);
    if (c->summary.computed) r->out[0] = c->sum + c->lost;
    c->last = *r;
    if (isfinite(r->out[0])) return c->target.row(c->target.data, r->out);
    ISO_FAIL_NUMERICAL(c->ctx, "%s is too large for a double", iso_clock_name(c->other));
    return iso_conversion_bad(c, r->line, ISO_NUMERICAL);
}

iso_status iso_conversion_follow(iso_conversion *c, const double row[], conversion_row *r)
{
    iso_row_gap gap;
    double lost;
    iso_conversion_summary *s = &c->summary;
    iso_rows_take(&c->rows, row);
    if (c->good == 1) return keep(c, r);
    const bool by_steps = !iso_rows_measure(&c->rows, c->typical, &gap);
    const iso_status reached = by_steps ? iso_rows_integrate(&c->rows, &gap) : ISO_OK;
    if (reached != ISO_OK) return iso_conversion_bad(c, r->line, reached); /* the next gap begins at the row before */
    const double gained = gap.gained[c->other], defect = fmax(gap.miss, fabs(late(c, r, gained)));
    by_steps ? s->integrated++ : s->between++;
    iso_worst_note(&s->defect, defect, r->line);
    const size_t missed = s->missed;
    ISO_TRY(name_missed(c, r, gap.step, defect));
    if (s->missed == missed) add_drift(c, r, &gap);
    /* what rows miss as a rule; a large defect must not hide the next */
    c->typical = 0.9 * c->typical + 0.1 * fmin(defect, fmax(1e-9, 100 * c->typical));
    if (c->direction == 0 && gap.step != 0) c->direction = gap.step > 0 ? 1 : -1;
    c->sum = iso_two_sum(c->sum, gained, &lost);
    c->lost += lost;
    s->error += gap.error[c->other] + sensitivity(c) * defect * fabs(gained);
    return keep(c, r);
}

void iso_conversion_settle(iso_conversion *c)
{
    close_drift(c);
    c->summary.error += 2 * DBL_EPSILON * fabs(c->sum + c->lost);
    c->summary.end = c->sum + c->lost;
}

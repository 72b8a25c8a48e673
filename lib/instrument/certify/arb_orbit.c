/* arb_orbit.c - the rows of a certified orbit (certify_impl.h).
 *
 * The set is carried with numbers of more digits than the rows are to hold. If it grows too wide before the last row,
 * all is done again with more; rows that were passed on stay as they are.
 */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_impl.h"
#include "base/version.h"
#include "instrument/certify/arb_certify_impl.h"

#define DIGIT_BITS 3.3219280948873623

iso_status iso_certify_is_possible(iso_context *ctx)
{
    (void)ctx;
    return ISO_OK;
}

typedef struct work {
    iso_context *ctx;
    const iso_certify_problem *p;
    const iso_certify_sink *sink;
    iso_certify_result *result;
    certify_exact exact;
    iso_clock clock; /* of the times */
    certify_ball ball;
    certify_set set;
    bool stopped; /* by the caller's monitor: the set is no longer valid                       */
    bool wide;    /* the attempt failed because the set became too large; more digits may help */
    int noted;    /* coefficients in this step when progress was last reported                 */
} work;

static iso_models shown(const work *w)
{
    const iso_scene *scene = w->p->scene;
    return scene->as == ISO_SHOW_START ? (iso_models)scene->start.model : scene->as;
}

iso_status certify_pass(iso_context *ctx, const iso_certify_sink *sink, FILE *to, char **text)
{
    const bool whole = fclose(to) == 0 && *text;
    const iso_status status = whole ? sink->line(sink->data, *text) : iso_context_no_memory(ctx, "a row");
    free(*text);
    return status;
}

/* --- the head ---------------------------------------------------------------------------------------------------- */

static void print_fraction(FILE *to, const char *key, int count, fmpq_t x[])
{
    fprintf(to, "# %s:", key);
    for (int i = 0; i < count; i++) {
        char *text = fmpq_get_str(NULL, 10, x[i]);
        fprintf(to, " %s", text);
        flint_free(text);
    }
    fputc('\n', to);
}

/* # key: midpoint radius */
static void print_energy(FILE *to, const char *key, const arb_t x, int digits)
{
    fprintf(to, "# %s: ", key);
    certify_print(to, x, certify_magnitude(x, 1) - digits - 2, ' ');
    fputc('\n', to);
}

void certify_print_columns(FILE *to, iso_models as)
{
    static const iso_models models[] = {ISO_SHOW_BALL, ISO_SHOW_POINT};
    for (int c = 0; c < ISO_CLOCKS; c++)
        fprintf(to, "%s%s,%s_radius", c > 0 ? "," : "", iso_column_name(c), iso_column_name(c));
    for (int m = 0; m < 2; m++)
        for (int i = 0; i < ISO_STATE && (as == models[m] || as == ISO_SHOW_BOTH); i++) {
            const char *name = iso_column_name((m == 0 ? ISO_COLUMN_BALL : ISO_COLUMN_POINT) + i);
            fprintf(to, ",%s,%s_radius", name, name);
        }
    fputc('\n', to);
}

static iso_status write_head(work *w)
{
    char *text = NULL;
    size_t length = 0;
    FILE *to = open_memstream(&text, &length);
    if (!to) return iso_context_no_memory(w->ctx, "a head");
    fprintf(to, "# isoroll %s 1\n# model: %s\n", ISO_CERTIFIED_KIND, iso_models_name((int)shown(w)));
    fprintf(to, "# start: %s\n", iso_model_kind_name((int)w->exact.model));
    print_fraction(to, "k", 1, &w->exact.k);
    print_fraction(to, "J", 3, w->exact.J);
    print_energy(to, "h", w->ball.h, w->p->options.digits);
    print_energy(to, "eps", w->ball.eps, w->p->options.digits);
    if (w->exact.rotor) print_fraction(to, "rotor.momentum", 3, w->exact.K);
    if (w->exact.level) print_energy(to, "level.c", w->ball.c, w->p->options.digits);
    fprintf(to, "# backend: %s\n# digits: %d\n", iso_model_kind_name((int)w->p->backend), w->p->options.digits);
    fprintf(to, "# isoroll: %s\n", ISO_VERSION);
    certify_print_columns(to, shown(w));
    return certify_pass(w->ctx, w->sink, to, &text);
}

/* --- failures ---------------------------------------------------------------------------------------------------- */

static double time_now(const work *w)
{
    return fabs(arf_get_d(arb_midref(w->set.time), ARF_RND_NEAR));
}

static iso_status too_wide(work *w)
{
    w->wide = true;
    return ISO_FAIL_NUMERICAL(w->ctx, "the enclosures hold %d digits until %s = %.6g: computed with %d digits",
                              w->p->options.digits, iso_clock_name(w->clock), copysign(time_now(w), w->p->scene->end),
                              w->result->work_digits);
}

/* The end needs so many steps; INFINITY: a step does not fit a double. */
static iso_status too_long(const work *w, double steps)
{
    const double end = w->p->scene->end, limit = ISO_MOST_CERTIFIED_WORK / pow(w->result->work_digits, 3);
    const char *clock = iso_clock_name(w->clock);
    char needs[96] = "steps that are too short for a double";
    if (isfinite(steps))
        snprintf(needs, sizeof needs, "about %.2g steps, and with %d digits the limit is %.2g", steps,
                 w->result->work_digits, limit);
    return ISO_FAIL_NUMERICAL(
        w->ctx,
        "too much work: %ld steps came to %s = %.6g; %s = %.6g needs %s: take an earlier end, moments that differ "
        "less, or fewer digits",
        w->result->steps, clock, copysign(time_now(w), end), clock, end, needs);
}

/* --- rows -------------------------------------------------------------------------------------------------------- */

/* A group of numbers, with as many digits as are asked for, and two more. False: it does not hold them. */
static bool print_group(FILE *to, arb_srcptr x, int count, int digits)
{
    const slong e = certify_magnitude(x, count);
    for (int i = 0; i < count; i++) {
        if (i > 0) fputc(',', to);
        certify_print(to, x + i, e - digits - 2, ',');
    }
    return certify_holds(x, count, e - digits);
}

bool certify_write_row(const certify_ball *b, arb_srcptr clock, iso_model_kind model, arb_srcptr y, iso_models as,
                       int digits, FILE *to)
{
    ISO_BALL_ROW(state, CERTIFY_STATE);
    bool holds = true;
    for (int c = 0; c < ISO_CLOCKS; c++) {
        if (c > 0) fputc(',', to);
        holds = print_group(to, clock + c, 1, digits) && holds;
    }
    for (int m = ISO_BALL; m <= ISO_POINT; m++) {
        if (as != ISO_SHOW_BOTH && (int)as != m) continue;
        _arb_vec_set(state, y, CERTIFY_STATE);
        if (m != (int)model) certify_map(b, model, state, state);
        for (int vector = 0; vector < CERTIFY_STATE; vector += 3) {
            fputc(',', to);
            holds = print_group(to, state + vector, 3, digits) && holds;
        }
    }
    fputc('\n', to);
    return holds;
}

/* Row i of the scene's grid. */
static void time_of(const work *w, size_t i, fmpq_t t)
{
    fmpq_t step;
    fmpq_set_si(t, w->p->end.top, (ulong)w->p->end.below);
    if (w->p->end_text) certify_rational_read(w->p->end_text, t);
    if (i + 1 == w->result->asked) return;
    fmpq_init(step);
    fmpq_set_si(step, w->p->step.top, (ulong)w->p->step.below);
    fmpq_set_si(t, (slong)i, 1);
    fmpq_mul(t, t, step);
    if (w->p->scene->end < 0) fmpq_neg(t, t);
    fmpq_clear(step);
}

/* Within a step: progress is measured by the last step's length, and asks the caller's monitor. */
static bool in_step(void *data)
{
    work *w = data;
    const double end = fabs(w->p->scene->end), last = arf_get_d(arb_midref(w->set.h), ARF_RND_NEAR);
    if (w->sink->progress && w->set.thin.known != w->noted) {
        const double at = time_now(w) + last * certify_set_done(&w->set);
        w->noted = w->set.thin.known;
        w->sink->progress(w->sink->data, end > 0 ? fmin(at / end, 1) : 1);
    }
    w->stopped = w->stopped || !iso_context_goes_on(w->ctx);
    return !w->stopped;
}

/* The next row, if its time is in this step. *status: ISO_NUMERICAL if it holds too few digits. */
static bool next_row(work *w, iso_status *status)
{
    if (w->result->rows == w->result->asked) return false;
    ISO_BALL_ROW(y, CERTIFY_ALL);
    ISO_BALL_ROW(clock, ISO_CLOCKS);
    fmpq_t t;
    fmpq_init(t);
    time_of(w, w->result->rows, t);
    arb_set_fmpq(clock + w->clock, t, w->ball.bits);
    fmpq_clear(t);
    const bool inside = certify_set_at(&w->set, clock + w->clock, y);
    for (int c = 0, i = CERTIFY_STATE; c < ISO_CLOCKS; c++)
        if (c != (int)w->clock) arb_set(clock + c, y + i++);
    if (!in_step(w)) return *status = iso_context_stopped(w->ctx), false;
    if (!inside) return false;
    char *text = NULL;
    size_t length = 0;
    FILE *to = open_memstream(&text, &length);
    if (!to)
        *status = iso_context_no_memory(w->ctx, "a row");
    else if (certify_write_row(&w->ball, clock, w->p->backend, y, shown(w), w->p->options.digits, to))
        *status = certify_pass(w->ctx, w->sink, to, &text);
    else
        fclose(to), free(text), *status = too_wide(w);
    w->result->rows += *status == ISO_OK;
    return *status == ISO_OK;
}

/* --- an attempt -------------------------------------------------------------------------------------------------- */

/* Steps until all rows are there, if the end can be reached at the pace so far. The work of a step is about the cube of
 * the digits. *reached: the time to which it came. */
static iso_status follow(work *w, double end, double *reached)
{
    const double step = pow(w->result->work_digits, 3);
    iso_status status = ISO_OK;
    while (w->result->rows < w->result->asked) {
        *reached = time_now(w);
        if (!in_step(w)) return iso_context_stopped(w->ctx);
        switch (certify_set_expand(&w->set, fmax(1.1 * (end - *reached), 1e-3 * end + 1e-300))) {
        case CERTIFY_STEP: break;
        case CERTIFY_TOO_WIDE: return too_wide(w);
        case CERTIFY_TOO_SHORT: return too_long(w, INFINITY);
        case CERTIFY_STOPPED: return iso_context_stopped(w->ctx);
        }
        while (next_row(w, &status)) continue;
        certify_set_move(&w->set);
        const double steps = (double)++w->result->steps, needed = steps * fmax(end / time_now(w), 1);
        const bool measured = steps >= ISO_PACE_STEPS && steps * step >= ISO_PACE_WORK;
        ISO_TRY(status);
        if (w->result->rows < w->result->asked && !((measured ? needed : steps) * step <= ISO_MOST_CERTIFIED_WORK))
            return too_long(w, needed);
    }
    return ISO_OK;
}

static iso_status attempt(work *w, int work_digits, double *reached, double *lost)
{
    const double end = fabs(w->p->scene->end);
    iso_balls_init(&w->ball, offsetof(certify_ball, bits));
    w->ball.bits = (slong)(DIGIT_BITS * work_digits) + 8;
    ISO_BALL_ROW(start, CERTIFY_STATE);
    certify_start(&w->exact, w->p->backend, &w->ball, start);
    certify_set_init(&w->set, &w->ball, w->p->backend, w->clock, start, w->p->scene->end < 0 ? -1 : 1,
                     (iso_monitor){in_step, w});
    w->wide = false;
    w->result->work_digits = work_digits;
    w->result->steps = 0;
    iso_status status = w->result->attempts++ == 0 ? write_head(w) : ISO_OK;
    *reached = 0;
    if (status == ISO_OK) status = follow(w, end, reached);
    *lost = certify_set_lost(&w->set);
    certify_set_clear(&w->set);
    iso_balls_clear(&w->ball, offsetof(certify_ball, bits));
    return status;
}

iso_status iso_certify_orbit(iso_context *ctx, const iso_certify_problem *p, const iso_certify_sink *sink,
                             iso_certify_result *result)
{
    enum { SPARE = 14, MORE = 200 };
    const double end = fabs(p->scene->end);
    work w = {.ctx = ctx, .p = p, .sink = sink, .result = result};
    w.clock = p->scene->start.model == ISO_BALL ? ISO_CLOCK_T : ISO_CLOCK_S;
    double reached = 0, lost = 0, furthest = -1;
    certify_exact_init(&w.exact);
    iso_status status = certify_exact_read(ctx, p->scene, p->literals, &w.exact);
    int digits = p->options.work_digits ? p->options.work_digits : p->options.digits + SPARE;
    int enough = digits; /* to come the furthest */
    bool again = status == ISO_OK;
    while (again) {
        status = attempt(&w, digits, &reached, &lost);
        again = w.wide && !p->options.work_digits && digits < ISO_MOST_WORK_DIGITS;
        const bool further = reached > furthest;
        if (further) furthest = reached, enough = digits;
        if (again && digits >= enough + MORE) { /* what stops these attempts is not rounding */
            again = false;
            status =
                ISO_FAIL_NUMERICAL(ctx,
                                   "no step from %s = %.6g can be enclosed, with %d digits or with %d: more digits "
                                   "do not help; take an earlier end, moments that differ less, or k further from 0",
                                   iso_clock_name(w.clock), copysign(reached, p->scene->end), enough, digits);
        }
        /* digits are lost about evenly */
        const double all = 1.1 * (lost + 2) * (reached > 0 ? end / reached : 1) + SPARE;
        const double needed = further ? all : INFINITY;
        const double spare = digits - p->options.digits;
        const double next = p->options.digits + fmin(fmax(needed, spare + SPARE), 3 * spare + MORE);
        digits = (int)fmin(next, ISO_MOST_WORK_DIGITS);
    }
    certify_exact_clear(&w.exact);
    return status;
}

/* integrator.c - one contract for all methods, see method.h: it takes steps, keeps the exact time, and reaches any
 * time within a step. */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/arithmetic_impl.h"
#include "base/context_impl.h"
#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "method/integrator_impl.h"
#include "method/methods_impl.h"
#include "model/model_impl.h"

iso_status iso_tolerance_check(iso_context *ctx, double tolerance)
{
    if (iso_tolerance_is_good(tolerance)) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "tolerance", "tolerance %s is not in " ISO_TOLERANCE_RANGE, ISO_SHORT(tolerance));
}

/* Whether the method serves the model, and takes the fixed steps that the options ask for. */
static iso_status check_method(iso_context *ctx, const iso_method *method, const iso_model *model,
                               const iso_method_options *options)
{
    char why[ISO_WHY_SIZE];
    if (!iso_method_serves(method, model, why)) {
        const iso_method *other = iso_method_auto(model);
        return ISO_FAIL_ARGUMENT(ctx, "method", "%s %s%s%s", method->name, why, other ? "; take " : "",
                                 other ? other->name : "");
    }
    if (!(options->fixed_step > 0)) return ISO_OK;
    if (!method->fixed)
        return ISO_FAIL_ARGUMENT(ctx, "", "%s takes no fixed steps: it chooses its own", method->name);
    if (!method->steps_in_s || model->clock == ISO_CLOCK_S) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "method", "the steps of %s are fixed in s: they cannot be in %s", method->name,
                             iso_clock_name(model->clock));
}

iso_status iso_integrator_create(iso_context *ctx, const iso_method *method, const iso_model *model,
                                 const iso_method_options *options, iso_integrator **integrator)
{
    ISO_DEFAULT_ARITHMETIC;
    *integrator = NULL;
    iso_method_options o = *options;
    if (iso_model_too_large(model)) return ISO_FAIL_INPUT(ctx, "effects", "%s", iso_model_too_large(model));
    if (!method) return ISO_FAIL_ARGUMENT(ctx, "method", "no such method");
    if (!(o.fixed_step >= 0 && isfinite(o.fixed_step)))
        return ISO_FAIL_ARGUMENT(ctx, "", "a fixed step must be finite and >= 0, not %s", ISO_SHORT(o.fixed_step));
    if (check_method(ctx, method, model, &o) != ISO_OK) return ISO_BAD_ARGUMENT;
    if (o.fixed_step > 0 && o.tolerance == 0) o.tolerance = 1e-14; /* of dense output */
    if (iso_tolerance_check(ctx, o.tolerance) != ISO_OK) return ISO_BAD_ARGUMENT;
    iso_integrator *it = calloc(1, sizeof *it);
    if (!it) return iso_context_no_memory(ctx, "an integrator");
    it->ctx = ctx;
    it->method = method;
    it->model = *model;
    it->options = o;
    const bool room = iso_inside_create(&it->model.problem, &it->inside);
    iso_status status = room ? method->create(it) : iso_context_no_memory(ctx, "an integrator");
    if (status == ISO_OK && !it->method->dense) status = iso_dense_create(it);
    if (status != ISO_OK) return iso_integrator_free(it), status;
    *integrator = it;
    return ISO_OK;
}

void iso_integrator_free(iso_integrator *it)
{
    if (!it) return;
    if (it->data) it->method->free(it);
    iso_inside_free(it->inside);
    iso_past_forget(it);
    iso_dense_free(it->dense);
    free(it);
}

/* Goes back to time 0, to take steps in the given direction from there. */
static iso_status set_out(iso_integrator *it, int direction)
{
    it->direction = direction;
    it->fast = iso_model_fast(&it->model, direction, it->y0);
    it->stopped = false;
    it->resting = false;
    it->end = NULL;
    it->left = (iso_instant){0, 0};
    it->h = 0;
    it->number = it->method_number = 0;
    it->method_direction = direction;
    copy(it->y0, it->at_left, it->model.dim);
    copy(it->y0, it->at_right, it->model.dim);
    return direction == 0 ? ISO_OK : it->method->start(it);
}

iso_status iso_integrator_start(iso_integrator *it, const double y0[])
{
    ISO_DEFAULT_ARITHMETIC;
    double f[ISO_MAX_STATE];
    it->statistics = (iso_statistics){0};
    copy(y0, it->y0, it->model.dim);
    iso_past_forget(it);
    it->claims = iso_model_has_claim(&it->model);
    set_out(it, 0);
    if (!iso_integrator_rhs(it, y0, f))
        return ISO_FAIL_ARGUMENT(it->ctx, "", "the equations of motion are not finite at the start");
    return it->method->at ? it->method->start(it) : ISO_OK;
}

static void rest(iso_integrator *it, double dt, double y[])
{
    it->statistics.rhs++;
    iso_model_rest(&it->model, dt, y);
}

static iso_status take_step(iso_integrator *it, double y[], double *h)
{
    it->resting = it->direction > 0 && iso_model_at_rest(&it->model, y);
    if (it->resting) {
        *h = fmax(1e18, 1e3 * it->left.head); /* longer than any time that is asked, as a rule */
        rest(it, *h, y);
        return ISO_OK;
    }
    /* Series look inside their steps themselves. The others see an effect that the scene writes at their stages alone.
     * Steps of fixed length, as splittings have, stay as they are. */
    const bool any = !it->inside || it->method->own_equations || it->options.fixed_step > 0;
    it->longest =
        any ? INFINITY : iso_inside_longest(it->inside, &it->model, it->direction, y, it->options.tolerance / 10);
    return it->method->step(it, y, h);
}

/* Why no further step makes sense after one that led to y and was moved so far by projection; NULL: it does. */
static const char *find_end(const iso_integrator *it, const double y[], double moved)
{
    if (it->options.fixed_step == 0 && moved > ISO_FALSE_CORRECTION(it->options.tolerance)) return ISO_MOVED_TOO_FAR;
    const bool projects = it->method->projects && !it->options.no_projection;
    const char *why = norm(y) > it->fast ? iso_model_speeds_up(&it->model, it->direction, it->y0, y) : NULL;
    if (!why && !projects) why = iso_model_lost(&it->model, y, it->options.tolerance);
    return why;
}

/* Looks into the current step for a place where the scene's claim about a torque fails. The step then ends there, and
 * is the last one. Where the method has no `dense`, such a place costs much to compute, and steps are shorter. */
static iso_status test_claim(iso_integrator *it)
{
    const int places = it->method->dense ? ISO_CLAIM_PLACES : 2;
    const double h = it->h;
    char where[ISO_BLAME_SIZE];
    double y[ISO_MAX_STATE];
    it->end = NULL;
    for (int i = 0; i <= places && !it->end; i++) {
        const double dt = i < places ? h * i / places : h;
        ISO_TRY(iso_integrator_within(it, dt, y));
        it->end = iso_model_false_claim(&it->model, y, where);
        if (!it->end) continue;
        it->h = dt;
        copy(y, it->at_right, it->model.dim);
    }
    return it->h == 0 ? iso_integrator_stopped(it, it->end) : ISO_OK;
}

/* The current step becomes the next one, which the method takes. */
static iso_status take_next_step(iso_integrator *it)
{
    double y[ISO_MAX_STATE], h = 0;
    iso_past *past = iso_past_of(it, it->direction);
    const bool is_new = it->number == past->steps;
    if (!iso_context_goes_on(it->ctx)) return iso_context_stopped(it->ctx);
    if (it->end && it->number > past->steps) return iso_integrator_stopped(it, it->end);
    if (it->stopped) return iso_integrator_stopped(it, "it has failed before");
    it->stopped = true; /* until the step has succeeded: a method that has failed cannot go on from where it stands */
    if (is_new && it->options.max_steps > 0 && it->statistics.steps >= it->options.max_steps)
        return iso_integrator_stopped(it, "more steps than allowed");
    copy(it->at_right, y, it->model.dim);
    const double before = it->statistics.correction;
    it->statistics.correction = 0;
    const iso_status status = take_step(it, y, &h);
    const double moved = it->statistics.correction;
    it->statistics.correction = fmax(before, moved);
    if (status != ISO_OK) return status;
    const char *end = find_end(it, y, moved);
    if (end) return iso_integrator_stopped(it, end);
    /* some methods never end before a place that they cannot pass: their steps hardly move the clock */
    const bool lost = it->inside && it->options.fixed_step == 0 &&
                      iso_inside_is_lost(&it->model, y, it->method->own_equations ? h : it->longest);
    if (lost || fabs(h) <= 64 * DBL_EPSILON * fabs(it->left.head))
        return iso_integrator_stopped(it, "steps shrink to nothing");
    it->left = iso_instant_later(it->left, it->h);
    it->h = h;
    copy(it->at_right, it->at_left, it->model.dim);
    copy(y, it->at_right, it->model.dim);
    if (it->claims && !it->resting) ISO_TRY(test_claim(it));
    it->stopped = false;
    it->method_number = ++it->number;
    if (!is_new || it->end) return ISO_OK; /* the method's own state is later than the end: it cannot go on from it */
    it->statistics.steps++;
    past->steps++;
    iso_past_keep(it);
    return ISO_OK;
}

iso_status iso_integrator_advance(iso_integrator *it)
{
    if (iso_past_next(it)) return ISO_OK;
    const long number = it->number;
    iso_status status = ISO_OK;
    if (it->method_number != number || it->method_direction != it->direction) { /* bring it there from the start */
        status = set_out(it, it->direction);
        while (status == ISO_OK && it->number < number) status = take_next_step(it);
    }
    return status == ISO_OK ? take_next_step(it) : status;
}

/* For methods with `at`: the current step begins at t, and has no length yet. */
static iso_status jump(iso_integrator *it, int direction, double t)
{
    double y[ISO_MAX_STATE];
    if (!iso_context_goes_on(it->ctx)) return iso_context_stopped(it->ctx);
    if (t == 0) copy(it->y0, y, it->model.dim);
    ISO_TRY(t == 0 ? ISO_OK : it->method->at(it, t, y));
    it->direction = direction;
    it->stopped = false;
    it->left = (iso_instant){t, 0};
    it->h = 0;
    it->number = it->method_number = iso_past_of(it, direction)->steps; /* such methods go on from anywhere */
    it->method_direction = direction;
    copy(y, it->at_left, it->model.dim);
    copy(y, it->at_right, it->model.dim);
    return ISO_OK;
}

/* t minus the time of the step's right end. Whether t belongs to this step or to the next is always decided by this
 * difference, so that a time equal to the end up to rounding is found in the same step whichever way it is
 * reached. */
static double since_end(const iso_integrator *it, double t)
{
    return iso_instant_since(iso_instant_later(it->left, it->h), t);
}

iso_status iso_integrator_reach(iso_integrator *it, int direction, double t)
{
    iso_status status = ISO_OK;
    if (it->method->at) return jump(it, direction, t);
    it->called = true;
    const bool newest = it->number == iso_past_of(it, direction)->steps; /* beyond it only new steps lead */
    const bool ahead = direction == it->direction && !(direction * iso_integrator_since(it, t) < 0) &&
                       (newest || direction * since_end(it, t) <= 0);
    if (!ahead && !iso_past_recall(it, direction, t)) status = set_out(it, direction);
    while (status == ISO_OK && it->direction * since_end(it, t) > 0) status = iso_integrator_advance(it);
    return status;
}

iso_status iso_integrator_within(iso_integrator *it, double dt, double y[])
{
    if (it->resting) {
        copy(it->at_left, y, it->model.dim);
        return rest(it, dt, y), ISO_OK;
    }
    if (dt != 0 && dt != it->h) return it->method->dense ? it->method->dense(it, dt, y) : iso_dense_at(it, dt, y);
    copy(dt == 0 ? it->at_left : it->at_right, y, it->model.dim);
    return ISO_OK;
}

iso_status iso_integrator_at(iso_integrator *it, double t, double y[])
{
    ISO_DEFAULT_ARITHMETIC;
    if (!isfinite(t)) return ISO_FAIL_ARGUMENT(it->ctx, "", "a time is not finite");
    ISO_TRY(iso_integrator_reach(it, t > 0 ? 1 : t < 0 ? -1 : it->direction, t));
    return iso_integrator_within(it, since_end(it, t) == 0 ? it->h : iso_integrator_since(it, t), y);
}

iso_statistics iso_integrator_statistics(const iso_integrator *it)
{
    return it->statistics;
}

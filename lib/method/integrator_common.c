/* integrator_common.c - what methods, dense output and the search for events use of an integrator. It calls none of
 * them. */
#include <math.h>

#include "base/math_impl.h"
#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "method/integrator_impl.h"
#include "model/model_impl.h"

bool iso_integrator_rhs(iso_integrator *it, const double y[], double dy[])
{
    it->statistics.rhs++;
    it->model.rhs(&it->model, y, dy);
    return all_finite(dy, it->model.dim);
}

void iso_integrator_project(iso_integrator *it, double y[])
{
    if (it->options.no_projection) return;
    const double correction = iso_model_project(&it->model, y);
    it->statistics.correction = fmax(it->statistics.correction, correction);
}

iso_status iso_integrator_stopped(iso_integrator *it, const char *reason)
{
    const double unit = it->options.time_unit != 0 ? it->options.time_unit : 1;
    double t, y[ISO_MAX_STATE];
    char blame[ISO_BLAME_SIZE];
    iso_integrator_last(it, &t, y);
    iso_model_blame(&it->model, y, blame);
    return ISO_FAIL_NUMERICAL(it->ctx, "%s stopped after %ld steps: %s; last good %s = %s%s", it->method->name,
                              it->statistics.steps, reason, iso_clock_name(it->model.clock), ISO_SHORT(t * unit),
                              blame);
}

double iso_integrator_rate(iso_integrator *it, const double y[])
{
    double f[ISO_MAX_STATE], size[ISO_MAX_STATE], fastest = 0;
    iso_integrator_rhs(it, y, f);
    iso_model_size(&it->model, y, size);
    for (int i = 0; i < it->model.dim; i++) fastest = fmax(fastest, fabs(f[i]) / size[i]);
    return fastest;
}

double iso_integrator_first_step(iso_integrator *it, int order)
{
    const double h = pow(it->options.tolerance, 1.0 / (order + 1)) / 4, rate = iso_integrator_rate(it, it->at_right);
    return it->direction * (rate > 0 && isfinite(rate) ? h / rate : 1);
}

void iso_integrator_last(const iso_integrator *it, double *t, double y[])
{
    *t = iso_instant_later(it->left, it->h).head;
    copy(it->at_right, y, it->model.dim);
}

/* kutta38.c - Kutta's 3/8 rule, order 4, with errors by step doubling. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "method/integrator_impl.h"
#include "method/methods_impl.h"
#include "model/model_impl.h"

/* The method's own data: the length of the next step. */
static iso_status create(iso_integrator *it)
{
    it->data = calloc(1, sizeof(double));
    return it->data ? ISO_OK : iso_context_fail(it->ctx, ISO_NO_MEMORY, "", "no memory for %s", it->method->name);
}

static void release(iso_integrator *it)
{
    free(it->data);
}

static iso_status start(iso_integrator *it)
{
    *(double *)it->data = iso_integrator_first_step(it, 4);
    return ISO_OK;
}

/* y after h; false where the equations are not finite. */
static bool one_step(iso_integrator *it, const double y[], double h, double after[])
{
    static const double a[3][3] = {{1.0 / 3}, {-1.0 / 3, 1}, {1, -1, 1}}, b[4] = {1.0 / 8, 3.0 / 8, 3.0 / 8, 1.0 / 8};
    const int dim = it->model.dim;
    double k[4][ISO_MAX_STATE], at[ISO_MAX_STATE];
    for (int stage = 0; stage < 4; stage++) {
        for (int i = 0; i < dim; i++) {
            at[i] = y[i];
            for (int j = 0; j < stage; j++) at[i] += h * a[stage - 1][j] * k[j][i];
        }
        if (!iso_integrator_rhs(it, at, k[stage])) return false;
    }
    for (int i = 0; i < dim; i++)
        after[i] = y[i] + h * (b[0] * k[0][i] + b[1] * k[1][i] + b[2] * k[2][i] + b[3] * k[3][i]);
    return true;
}

/* Two steps of h/2 into `after`; gives their error in units of what may be, infinite where there is none. */
static double two_steps(iso_integrator *it, const double y[], double h, double after[])
{
    double once[ISO_MAX_STATE], half[ISO_MAX_STATE], size[ISO_MAX_STATE], worst = 0;
    if (!one_step(it, y, h, once) || !one_step(it, y, h / 2, half) || !one_step(it, half, h / 2, after))
        return INFINITY;
    iso_model_size(&it->model, y, size);
    for (int i = 0; i < it->model.dim; i++) {
        const double error = fabs(after[i] - once[i]) / 15 / (it->options.tolerance * size[i]);
        worst = error > worst || isnan(error) ? error : worst;
    }
    return isnan(worst) ? INFINITY : worst;
}

static iso_status step(iso_integrator *it, double y[], double *h)
{
    double *next = it->data, after[ISO_MAX_STATE];
    *h = it->options.fixed_step > 0 ? it->direction * it->options.fixed_step : *next;
    if (it->options.fixed_step > 0) {
        if (!one_step(it, y, *h, after)) return iso_integrator_stopped(it, "the equations of motion are not finite");
    } else {
        double error = two_steps(it, y, *h, after);
        for (; error > 1; error = two_steps(it, y, *h, after)) {
            it->statistics.rejected++;
            *h *= fmax(0.2, 0.9 * pow(error, -0.2));
            if (fabs(*h) < DBL_MIN) return iso_integrator_stopped(it, "steps shrink to nothing");
        }
        *next = *h * fmin(5, 0.9 * pow(fmax(error, 1e-10), -0.2));
    }
    memcpy(y, after, (size_t)it->model.dim * sizeof *y);
    iso_integrator_project(it, y);
    return ISO_OK;
}

const iso_method iso_method_kutta38 = {
    .name = "kutta38",
    .family = "mine",
    .doc = "Kutta's 3/8 rule, error by step doubling",
    .order = 4,
    .projects = true,
    .fixed = true,
    .create = create,
    .start = start,
    .step = step,
    .free = release,
};

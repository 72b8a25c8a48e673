/* gsl.c - the methods of GSL's ode-initval2. */
#include <stdlib.h>

#include "method/gsl_impl.h"
#include "method/methods_impl.h"
#include "model/model_impl.h"

enum { RK4, RKF45, RKCK, RK8PD, MSADAMS, MSBDF, BSIMP };

static const gsl_odeiv2_step_type *step_type(int variant)
{
    const gsl_odeiv2_step_type *types[] = {
        [RK4] = gsl_odeiv2_step_rk4,     [RKF45] = gsl_odeiv2_step_rkf45,     [RKCK] = gsl_odeiv2_step_rkck,
        [RK8PD] = gsl_odeiv2_step_rk8pd, [MSADAMS] = gsl_odeiv2_step_msadams, [MSBDF] = gsl_odeiv2_step_msbdf,
        [BSIMP] = gsl_odeiv2_step_bsimp,
    };
    return types[variant];
}

static void release(iso_integrator *it)
{
    if (it->data) iso_gsl_close(it->data);
    free(it->data);
}

static iso_status create(iso_integrator *it)
{
    it->data = calloc(1, sizeof(iso_gsl));
    if (!it->data) return iso_context_no_memory(it->ctx, "%s", it->method->name);
    return iso_gsl_open(it, step_type(it->method->variant), it->data);
}

static iso_status start(iso_integrator *it)
{
    const int order = it->method->order ? it->method->order : 2;
    iso_gsl_start(it->data, it->at_right, iso_integrator_first_step(it, order));
    return ISO_OK;
}

static iso_status step(iso_integrator *it, double y[], double *h)
{
    iso_gsl *g = it->data;
    iso_status status = ISO_OK;
    if (it->options.fixed_step > 0)
        status = iso_gsl_fixed_step(it, g, y, h);
    else
        status = iso_gsl_step(it, g, it->direction * 1e300, y, h);
    if (status != ISO_OK || !it->method->projects || it->options.no_projection) return status;
    iso_integrator_project(it, y);
    return iso_gsl_renew_slope(it, g, y);
}

/* It serves every model, and among the library's explicit methods needs the least time (the table in
 * taylor/method.c). */
static iso_suits rk8pd_suits(const iso_model *m)
{
    return iso_effects_stiffness(&m->problem) > ISO_STIFF ? ISO_IF_NEED_BE : ISO_WELL;
}

/* Of the methods for stiff models the most exact for its time; from ISO_VERY_STIFF on bdf needs fewer right-hand
 * sides. */
static iso_suits bsimp_suits(const iso_model *m)
{
    const double stiffness = iso_effects_stiffness(&m->problem);
    return stiffness > ISO_VERY_STIFF ? ISO_WELL : stiffness > ISO_STIFF ? ISO_BEST : ISO_NEVER;
}

#define METHOD .family = "gsl", .create = create, .start = start, .step = step, .free = release
#define GSL(id, variant_, doc_, ...)                                                                                 \
    const iso_method iso_method_##id = {.name = #id, .variant = variant_, .doc = doc_, METHOD, __VA_ARGS__};
#define FIXED .fixed = true, .projects = true

GSL(rk4, RK4, "classical Runge-Kutta 4, error by step doubling", .order = 4, FIXED)
GSL(rkf45, RKF45, "Runge-Kutta-Fehlberg 4(5)", .order = 5, FIXED)
GSL(rkck, RKCK, "Runge-Kutta Cash-Karp 4(5)", .order = 5, FIXED)
GSL(rk8pd, RK8PD, "Runge-Kutta Prince-Dormand 8(9)", .order = 8, FIXED, .suits = rk8pd_suits, .witness = 1)
GSL(msadams, MSADAMS, "variable-order Adams in Nordsieck form, orders 1-12", .order = 0)
GSL(msbdf, MSBDF, "variable-order BDF in Nordsieck form, orders 1-5", .implicit = true)
GSL(bsimp, BSIMP, "implicit Bulirsch-Stoer of Bader and Deuflhard, seven columns", .implicit = true, FIXED,
    .suits = bsimp_suits, .witness = 3)

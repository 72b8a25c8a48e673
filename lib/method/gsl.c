/* gsl.c - the methods of GSL's ode-initval2; and the state at a time within a step, for methods without `dense`: from
 * the step's left end by GSL's rk8pd, or by its bsimp where "auto" would take an implicit method. */
#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <stdlib.h>

#include "base/context_impl.h"
#include "base/resources_impl.h"
#include "base/vec3_impl.h"
#include "method/integrator_impl.h"
#include "method/methods_impl.h"
#include "model/model_impl.h"

/* GSL's loop over the steps of a model. An implicit method sees y_i/unit_i, numbers of order one. Its LU decomposition
 * chooses pivots by size: without units a small component would lose its digits beside a large one. Units are powers of
 * two, so that they cause no rounding. */
struct iso_gsl {
    iso_integrator *it;
    bool implicit;
    double unit[ISO_MAX_STATE];
    gsl_odeiv2_system system;
    gsl_odeiv2_driver *driver; /* step, control and evolve; msadams and msbdf insist on a driver */
    gsl_odeiv2_control control;
    double h; /* proposed next step */
    double t; /* GSL's own clock    */
};

/* --- the model as GSL sees it ---------------------------------------------------------------------------------- */

/* z in the model's units, into y; explicit methods have these: z itself. */
static const double *from_units(const iso_gsl *g, const double z[], double y[])
{
    if (!g->implicit) return z;
    for (int i = 0; i < g->it->model.dim; i++) y[i] = z[i] * g->unit[i];
    return y;
}

static void to_units(const iso_gsl *g, double y[])
{
    for (int i = 0; g->implicit && i < g->it->model.dim; i++) y[i] /= g->unit[i];
}

/* Any failure but GSL_EBADFUNC makes the evolution try a shorter step. */
static int function(double t, const double z[], double dzdt[], void *gsl)
{
    const iso_gsl *g = gsl;
    double y[ISO_MAX_STATE];
    (void)t;
    const bool finite = iso_integrator_rhs(g->it, from_units(g, z, y), dzdt);
    to_units(g, dzdt);
    return finite ? GSL_SUCCESS : GSL_FAILURE;
}

static double sum_of_sizes(int count, const double x[])
{
    double sum = 0;
    for (int i = 0; i < count; i++) sum += fabs(x[i]);
    return sum;
}

/* GSL solves linear systems with the matrix 1 - h J. Where a pivot is 0 it calls its error handler, which by default
 * ends the program, and which belongs to the program, not to the library. A pivot can be 0 where the rows of J depend
 * on each other and h J is so large that the 1 is lost:
 * - in slow motions, whose steps would be that long: longest_step bounds them;
 * - in the stiffest models: here the diagonal of J is moved by a few of its last digits, against the direction of
 *   time. If a row is larger than HOPELESS there is no step. */
static int jacobian(double t, const double z[], double *dfdz, double dfdt[], void *gsl)
{
    static const double HOPELESS = 1e17;
    const iso_gsl *g = gsl;
    const int dim = g->it->model.dim;
    double y[ISO_MAX_STATE];
    (void)t;
    g->it->statistics.jacobians++;
    g->it->model.jacobian(&g->it->model, from_units(g, z, y), dfdz);
    for (int i = 0; i < dim; i++)
        for (int j = 0; j < dim; j++) dfdz[dim * i + j] *= g->unit[j] / g->unit[i];
    for (int i = 0; i < dim; i++) dfdt[i] = 0;
    for (int i = 0; i < dim; i++) {
        const double row = sum_of_sizes(dim, dfdz + dim * i);
        if (!(row <= HOPELESS)) return GSL_FAILURE;
        dfdz[dim * i + i] -= g->it->direction * 16 * DBL_EPSILON * row;
    }
    return GSL_SUCCESS;
}

/* --- error control: GSL's standard rule, measured in units of tolerance * iso_model_size() --------------------- */

static int control_hadjust(void *state, size_t dim, unsigned int order, const double y[], const double yerr[],
                           const double dydt[], double *h)
{
    const iso_gsl *g = state;
    double own[ISO_MAX_STATE], size[ISO_MAX_STATE], worst = 0;
    (void)dydt;
    iso_model_size(&g->it->model, from_units(g, y, own), size);
    to_units(g, size);
    for (size_t i = 0; i < dim; i++) {
        const double r = fabs(yerr[i]) / (g->it->options.tolerance * size[i]);
        if (!(r <= worst)) worst = r; /* a NaN wins */
    }
    if (!isfinite(worst)) {
        *h *= 0.2;
        return GSL_ODEIV_HADJ_DEC;
    }
    if (worst > 1.1) {
        *h *= fmax(0.2, 0.9 * pow(worst, -1.0 / order));
        return GSL_ODEIV_HADJ_DEC;
    }
    if (worst < 0.5) {
        *h *= fmin(5, fmax(1, 0.9 * pow(fmax(worst, 1e-10), -1.0 / (order + 1.0))));
        return GSL_ODEIV_HADJ_INC;
    }
    return GSL_ODEIV_HADJ_NIL;
}

static int control_errlevel(void *state, const double y, const double dydt, const double h, const size_t i,
                            double *level)
{
    const iso_gsl *g = state;
    double size[ISO_MAX_STATE];
    (void)y, (void)dydt, (void)h;
    iso_model_size(&g->it->model, g->it->at_right, size); /* where the step begins */
    *level = g->it->options.tolerance * size[i] / g->unit[i];
    return GSL_SUCCESS;
}

static const gsl_odeiv2_control_type model_control = {
    .name = "isoroll", .hadjust = control_hadjust, .errlevel = control_errlevel};

/* --- steps ------------------------------------------------------------------------------------------------------ */

/* The driver's own control is replaced by one that stands in the iso_gsl. Errors: ISO_NO_MEMORY. */
static iso_status create_gsl(iso_integrator *it, const gsl_odeiv2_step_type *type, iso_gsl **gsl)
{
    iso_gsl *g = *gsl = calloc(1, sizeof *g);
    if (!g) return iso_context_no_memory(it->ctx, "GSL's %s", type->name);
    *g = (iso_gsl){.it = it, .implicit = type == gsl_odeiv2_step_bsimp || type == gsl_odeiv2_step_msbdf};
    g->system = (gsl_odeiv2_system){function, jacobian, (size_t)it->model.dim, g};
    g->control = (gsl_odeiv2_control){&model_control, g};
    if (iso_room()) g->driver = gsl_odeiv2_driver_alloc_y_new(&g->system, type, 1, it->options.tolerance, 0);
    if (!g->driver) return iso_context_no_memory(it->ctx, "GSL's %s", type->name);
    gsl_odeiv2_control_free(g->driver->c);
    g->driver->c = &g->control;
    return ISO_OK;
}

void iso_dense_free(iso_gsl *g)
{
    if (g && g->driver) {
        g->driver->c = NULL;
        gsl_odeiv2_driver_free(g->driver);
    }
    free(g);
}

/* Begins anew at y with a proposed first step. */
static void start_gsl(iso_gsl *g, const double y[], double first_step)
{
    double size[ISO_MAX_STATE];
    iso_model_size(&g->it->model, y, size);
    for (int i = 0; i < g->it->model.dim; i++)
        g->unit[i] = g->implicit && isnormal(size[i]) ? ldexp(1, ilogb(size[i])) : 1;
    gsl_odeiv2_step_reset(g->driver->s);
    gsl_odeiv2_evolve_reset(g->driver->e);
    g->h = first_step;
    g->t = 0;
}

/* Methods that solve linear systems take memory in some of their steps, and give it back. So it is enough to check
 * once in each call of the library. A check in each step took 3.4 % of the instructions of msbdf. */
static iso_status check_room(iso_gsl *g)
{
    if (!g->implicit || !g->it->called) return ISO_OK;
    g->it->called = false;
    return iso_room() ? ISO_OK : iso_context_no_memory(g->it->ctx, "GSL's %s", g->driver->s->type->name);
}

/* bsimp divides the error of each component by the component's size when the step begins (by 1 where it is 0). A tiny
 * component so makes tiny steps, and where its square underflows there is no result at all. So tiny components are
 * set to 0: at the start those that are tiny in the ball's own units, later (a ball may come to rest) those that are
 * tiny beside the rest of their vector. */
static void drop_traces(const iso_gsl *g, double y[ISO_STATE])
{
    for (int i = 0; g->driver->s->type == gsl_odeiv2_step_bsimp && i < ISO_STATE; i++) {
        const double size = g->it->statistics.steps == 0 ? 1 : largest(y + i / 3 * 3);
        if (fabs(y[i]) < 1e-130 * size) y[i] = copysign(0, y[i]);
    }
}

/* The longest step that keeps four digits of the 1 in 1 - h J; at least 1, about the time of one turn. */
static double longest_step(iso_gsl *g, const double z[])
{
    const int dim = g->it->model.dim;
    double dfdz[ISO_MAX_STATE * ISO_MAX_STATE], dfdt[ISO_MAX_STATE];
    return jacobian(0, z, dfdz, dfdt, g) == GSL_SUCCESS ? fmax(1, 1e12 / sum_of_sizes(dim * dim, dfdz)) : 1;
}

/* One accepted step of y towards `limit` (GSL's clock, not beyond it), its length in *h. */
static iso_status step_to(iso_gsl *g, double limit, double y[], double *h)
{
    ISO_TRY(check_room(g));
    gsl_odeiv2_evolve *e = g->driver->e;
    const unsigned long failed = e->failed_steps;
    to_units(g, y);
    if (g->implicit && fabs(g->h) > 1) g->h = copysign(fmin(fabs(g->h), longest_step(g, y)), g->h);
    drop_traces(g, y);
    const int status = gsl_odeiv2_evolve_apply(e, g->driver->c, g->driver->s, &g->system, &g->t, limit, &g->h, y);
    from_units(g, y, y);
    g->it->statistics.rejected += (long)(e->failed_steps - failed);
    *h = e->last_step;
    if (status == GSL_SUCCESS) return ISO_OK;
    return iso_integrator_stopped(g->it, g->implicit
                                             ? "no step is short enough for the tolerance, or this is too stiff "
                                               "for it (bdf may do)"
                                             : "no step is short enough for the tolerance");
}

/* A step of length h. bsimp reports an infinite error where it has no result, because a
 * component was next to zero (see drop_traces). Two half steps then lead past that place. */
static bool fixed_part(iso_gsl *g, double h, int divisions, double y[])
{
    const int dim = g->it->model.dim;
    double error[ISO_MAX_STATE], sum = 0, reached[ISO_MAX_STATE];
    copy(y, reached, dim);
    const int status = gsl_odeiv2_step_apply(g->driver->s, 0, h, reached, error, NULL, NULL, &g->system);
    for (int i = 0; i < dim; i++) sum += error[i];
    if (status == GSL_SUCCESS && isfinite(sum)) return copy(reached, y, dim), true;
    if (status != GSL_SUCCESS || divisions == 0) return false;
    return fixed_part(g, h / 2, divisions - 1, y) && fixed_part(g, h / 2, divisions - 1, y);
}

/* One step of y of the length options.fixed_step, whatever its error. */
static iso_status fixed_step(iso_gsl *g, double y[], double *h)
{
    enum { MOST_DIVISIONS = 20 };
    const bool divides = g->driver->s->type == gsl_odeiv2_step_bsimp;
    ISO_TRY(check_room(g));
    *h = g->it->direction * g->it->options.fixed_step;
    to_units(g, y);
    const bool done = fixed_part(g, *h, divides ? MOST_DIVISIONS : 0, y);
    from_units(g, y, y);
    return done ? ISO_OK : iso_integrator_stopped(g->it, "the step failed");
}

/* --- dense output ----------------------------------------------------------------------------------------------- */

iso_status iso_dense_create(iso_integrator *it)
{
    const iso_method *best = iso_method_auto(&it->model);
    return create_gsl(it, best && best->implicit ? gsl_odeiv2_step_bsimp : gsl_odeiv2_step_rk8pd, &it->dense);
}

iso_status iso_dense_at(iso_integrator *it, double dt, double y[])
{
    enum { MOST_STEPS = 100000 }; /* as a rule it needs one */
    iso_gsl *g = it->dense;
    double state[ISO_MAX_STATE], h;
    copy(it->at_left, state, it->model.dim);
    start_gsl(g, state, dt);
    for (long steps = 0; g->t != dt; steps++) {
        if (!iso_context_goes_on(it->ctx)) return iso_context_stopped(it->ctx);
        ISO_TRY(step_to(g, dt, state, &h));
        if (steps > MOST_STEPS) return iso_integrator_stopped(it, "too many steps between its own");
        if (g->t != dt && fabs(h) <= 64 * DBL_EPSILON * fabs(g->t))
            return iso_integrator_stopped(it, "steps between its own shrink to nothing");
    }
    if (it->method->projects) iso_integrator_project(it, state);
    copy(state, y, it->model.dim);
    return ISO_OK;
}

/* --- the methods ----------------------------------------------------------------------------------------------- */

enum { RK4, RKF45, RKCK, RK8PD, MSADAMS, MSBDF, BSIMP };

static void release(iso_integrator *it)
{
    iso_dense_free(it->data);
}

static iso_status create(iso_integrator *it)
{
    const gsl_odeiv2_step_type *types[] = {
        [RK4] = gsl_odeiv2_step_rk4,     [RKF45] = gsl_odeiv2_step_rkf45,     [RKCK] = gsl_odeiv2_step_rkck,
        [RK8PD] = gsl_odeiv2_step_rk8pd, [MSADAMS] = gsl_odeiv2_step_msadams, [MSBDF] = gsl_odeiv2_step_msbdf,
        [BSIMP] = gsl_odeiv2_step_bsimp,
    };
    iso_gsl *g;
    const iso_status status = create_gsl(it, types[it->method->variant], &g);
    it->data = g;
    return status;
}

static iso_status start(iso_integrator *it)
{
    const int order = it->method->order ? it->method->order : 2;
    start_gsl(it->data, it->at_right, iso_integrator_first_step(it, order));
    return ISO_OK;
}

static iso_status step(iso_integrator *it, double y[], double *h)
{
    iso_gsl *g = it->data;
    const double limit = g->t + it->direction * fmin(it->longest, 1e300);
    const iso_status status = it->options.fixed_step > 0 ? fixed_step(g, y, h) : step_to(g, limit, y, h);
    if (status != ISO_OK || !it->method->projects || it->options.no_projection) return status;
    iso_integrator_project(it, y);
    double *slope = g->driver->e->dydt_out; /* GSL begins its next step with it: it must be that of the new y */
    if (!iso_integrator_rhs(it, y, slope)) return iso_integrator_stopped(it, "not finite");
    to_units(g, slope);
    return ISO_OK;
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

/* gsl.c - the methods of GSL's ode-initval2, and its loop over steps, which dense output takes as well. */
#include <float.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdlib.h>

#include "base/resources_impl.h"
#include "base/vec3_impl.h"
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
        status = iso_gsl_step(it, g, g->t + it->direction * fmin(it->longest, 1e300), y, h);
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

/* --- the model as GSL sees it ---------------------------------------------------------------------------------- */

static void to_units(const iso_gsl *g, const double y[], double z[])
{
    for (int i = 0; i < g->it->model.dim; i++) z[i] = y[i] / g->unit[i];
}

static void from_units(const iso_gsl *g, const double z[], double y[])
{
    for (int i = 0; i < g->it->model.dim; i++) y[i] = z[i] * g->unit[i];
}

/* Any failure but GSL_EBADFUNC makes the evolution try a shorter step. */
static int function(double t, const double y[], double dydt[], void *gsl)
{
    const iso_gsl *g = gsl;
    (void)t;
    return iso_integrator_rhs(g->it, y, dydt) ? GSL_SUCCESS : GSL_FAILURE;
}

static int function_in_units(double t, const double z[], double dzdt[], void *gsl)
{
    const iso_gsl *g = gsl;
    double y[ISO_MAX_STATE];
    from_units(g, z, y);
    const int status = function(t, y, dzdt, gsl);
    to_units(g, dzdt, dzdt);
    return status;
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
static const double HOPELESS = 1e17;

static bool keep_regular(const iso_integrator *it, double *dfdz)
{
    const int dim = it->model.dim;
    for (int i = 0; i < dim; i++) {
        const double row = sum_of_sizes(dim, dfdz + dim * i);
        if (!(row <= HOPELESS)) return false;
        dfdz[dim * i + i] -= it->direction * 16 * DBL_EPSILON * row;
    }
    return true;
}

static int jacobian_in_units(double t, const double z[], double *dfdz, double dfdt[], void *gsl)
{
    const iso_gsl *g = gsl;
    const int dim = g->it->model.dim;
    double y[ISO_MAX_STATE];
    (void)t;
    g->it->statistics.jacobians++;
    from_units(g, z, y);
    g->it->model.jacobian(&g->it->model, y, dfdz);
    for (int i = 0; i < dim; i++)
        for (int j = 0; j < dim; j++) dfdz[dim * i + j] *= g->unit[j] / g->unit[i];
    for (int i = 0; i < dim; i++) dfdt[i] = 0;
    return keep_regular(g->it, dfdz) ? GSL_SUCCESS : GSL_FAILURE;
}

/* --- error control: GSL's standard rule, measured in units of tolerance * iso_model_size() --------------------- */

static void *control_alloc(void)
{
    return malloc(1); /* GSL asks for a pointer; iso_gsl_open replaces it by the iso_gsl */
}

static int control_init(void *state, double eps_abs, double eps_rel, double a_y, double a_dydt)
{
    (void)state, (void)eps_abs, (void)eps_rel, (void)a_y, (void)a_dydt;
    return GSL_SUCCESS;
}

/* The sizes of the components of y, in the units in which GSL has them */
static void sizes(const iso_gsl *g, const double y[], double size[])
{
    double state[ISO_MAX_STATE];
    if (g->implicit) from_units(g, y, state);
    iso_model_size(&g->it->model, g->implicit ? state : y, size);
    if (g->implicit) to_units(g, size, size);
}

static int control_hadjust(void *state, size_t dim, unsigned int order, const double y[], const double yerr[],
                           const double dydt[], double *h)
{
    const iso_gsl *g = state;
    double size[ISO_MAX_STATE], worst = 0;
    (void)dydt;
    sizes(g, y, size);
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

static int control_set_driver(void *state, const gsl_odeiv2_driver *driver)
{
    (void)state, (void)driver;
    return GSL_SUCCESS;
}

static void control_free(void *state)
{
    (void)state; /* it belongs to the integrator */
}

static const gsl_odeiv2_control_type model_control = {
    .name = "isoroll",
    .alloc = control_alloc,
    .init = control_init,
    .hadjust = control_hadjust,
    .errlevel = control_errlevel,
    .set_driver = control_set_driver,
    .free = control_free,
};

iso_status iso_gsl_open(iso_integrator *it, const gsl_odeiv2_step_type *type, iso_gsl *g)
{
    const double tolerance = it->options.tolerance;
    const size_t dim = (size_t)it->model.dim;
    const bool room = iso_room();
    *g = (iso_gsl){.it = it, .implicit = type == gsl_odeiv2_step_bsimp || type == gsl_odeiv2_step_msbdf};
    g->system = (gsl_odeiv2_system){g->implicit ? function_in_units : function, jacobian_in_units, dim, g};
    if (room) g->driver = gsl_odeiv2_driver_alloc_y_new(&g->system, type, 1, tolerance, 0);
    gsl_odeiv2_control *control = room ? gsl_odeiv2_control_alloc(&model_control) : NULL;
    if (!g->driver || !control) {
        iso_gsl_close(g);
        free(control);
        return iso_context_no_memory(it->ctx, "GSL's %s", type->name);
    }
    free(control->state);
    control->state = g;
    gsl_odeiv2_control_free(g->driver->c);
    g->driver->c = control;
    return ISO_OK;
}

void iso_gsl_close(iso_gsl *g)
{
    if (g->driver) gsl_odeiv2_driver_free(g->driver);
    g->driver = NULL;
}

void iso_gsl_start(iso_gsl *g, const double y[], double first_step)
{
    double size[ISO_MAX_STATE];
    iso_model_size(&g->it->model, y, size);
    for (int i = 0; i < g->it->model.dim; i++) {
        const bool has_size = isnormal(size[i]);
        g->unit[i] = g->implicit && has_size ? ldexp(1, ilogb(size[i])) : 1;
    }
    gsl_odeiv2_step_reset(g->driver->s);
    gsl_odeiv2_evolve_reset(g->driver->e);
    g->h = first_step;
    g->t = 0;
}

/* Methods that solve linear systems take memory in some of their steps, and give it back. So it is enough to check
 * once in each call of the library. A check in each step took 3.4 % of the instructions of msbdf. */
static iso_status check_room(iso_integrator *it, const iso_gsl *g)
{
    if (!g->implicit || !it->called) return ISO_OK;
    it->called = false;
    if (iso_room()) return ISO_OK;
    return iso_context_no_memory(it->ctx, "GSL's %s", g->driver->s->type->name);
}

/* bsimp divides the error of each component by the component's size when the step begins (by 1 where it is 0). A tiny
 * component so makes tiny steps, and where its square underflows there is no result at all. So tiny components are
 * set to 0: at the start those that are tiny in the ball's own units, later (a ball may come to rest) those that are
 * tiny beside the rest of their vector. */
static void drop_traces(const iso_integrator *it, const gsl_odeiv2_step *s, double y[ISO_STATE])
{
    for (int i = 0; s->type == gsl_odeiv2_step_bsimp && i < ISO_STATE; i++) {
        const double size = it->statistics.steps == 0 ? 1 : largest(y + i / 3 * 3);
        if (fabs(y[i]) < 1e-130 * size) y[i] = copysign(0, y[i]);
    }
}

/* The longest step that keeps four digits of the 1 in 1 - h J; at least 1, about the time of one turn. */
static double longest_step(iso_gsl *g, const double z[])
{
    const int dim = g->it->model.dim;
    double dfdz[ISO_MAX_STATE * ISO_MAX_STATE], dfdt[ISO_MAX_STATE];
    return jacobian_in_units(0, z, dfdz, dfdt, g) == GSL_SUCCESS ? fmax(1, 1e12 / sum_of_sizes(dim * dim, dfdz)) : 1;
}

iso_status iso_gsl_step(iso_integrator *it, iso_gsl *g, double limit, double y[], double *h)
{
    if (check_room(it, g) != ISO_OK) return ISO_NO_MEMORY;
    gsl_odeiv2_evolve *e = g->driver->e;
    const unsigned long failed = e->failed_steps;
    if (g->implicit) to_units(g, y, y);
    if (g->implicit && fabs(g->h) > 1) g->h = copysign(fmin(fabs(g->h), longest_step(g, y)), g->h);
    drop_traces(it, g->driver->s, y);
    const int status = gsl_odeiv2_evolve_apply(e, g->driver->c, g->driver->s, &g->system, &g->t, limit, &g->h, y);
    if (g->implicit) from_units(g, y, y);
    it->statistics.rejected += (long)(e->failed_steps - failed);
    if (status != GSL_SUCCESS)
        return iso_integrator_stopped(
            it, g->implicit ? "no step is short enough for the tolerance, or this is too stiff for it (bdf may do)"
                            : "no step is short enough for the tolerance");
    *h = e->last_step;
    return ISO_OK;
}

/* A step of given length h, whatever its error. bsimp reports an infinite error where it has no result, because a
 * component was next to zero (see drop_traces). Two half steps then lead past that place. */
static bool fixed_part(iso_integrator *it, iso_gsl *g, double h, int divisions, double y[])
{
    double error[ISO_MAX_STATE], sum = 0, reached[ISO_MAX_STATE];
    copy(y, reached, it->model.dim);
    const int status = gsl_odeiv2_step_apply(g->driver->s, 0, h, reached, error, NULL, NULL, &g->system);
    for (int i = 0; i < it->model.dim; i++) sum += error[i];
    if (status == GSL_SUCCESS && isfinite(sum)) return copy(reached, y, it->model.dim), true;
    if (status != GSL_SUCCESS || divisions == 0) return false;
    return fixed_part(it, g, h / 2, divisions - 1, y) && fixed_part(it, g, h / 2, divisions - 1, y);
}

iso_status iso_gsl_fixed_step(iso_integrator *it, iso_gsl *g, double y[], double *h)
{
    enum { MOST_DIVISIONS = 20 };
    const bool divides = g->driver->s->type == gsl_odeiv2_step_bsimp;
    if (check_room(it, g) != ISO_OK) return ISO_NO_MEMORY;
    *h = it->direction * it->options.fixed_step;
    if (g->implicit) to_units(g, y, y);
    const bool done = fixed_part(it, g, *h, divides ? MOST_DIVISIONS : 0, y);
    if (g->implicit) from_units(g, y, y);
    return done ? ISO_OK : iso_integrator_stopped(it, "the step failed");
}

iso_status iso_gsl_renew_slope(iso_integrator *it, iso_gsl *g, const double y[])
{
    double *slope = g->driver->e->dydt_out;
    if (!iso_integrator_rhs(it, y, slope)) return iso_integrator_stopped(it, "not finite");
    if (g->implicit) to_units(g, slope, slope);
    return ISO_OK;
}

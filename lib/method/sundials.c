/* sundials.c - the methods of SUNDIALS. CVODE: Adams for smooth motion, BDF with the analytic Jacobian and projection
 * for stiff. ARKODE: the embedded explicit Runge-Kutta tables of ERKStep, orders 2 to 8. */
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <cvode/cvode_proj.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdlib.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "base/resources_impl.h"
#include "base/sundials_impl.h"
#include "base/vec3_impl.h"
#include "method/integrator_impl.h"
#include "method/methods_impl.h"
#include "model/model_impl.h"

/* y' = f(y); a derivative that is not finite asks for a shorter step. The user data are the integrator. */
static int rhs(sunrealtype t, N_Vector y, N_Vector dydt, void *integrator)
{
    (void)t;
    return iso_integrator_rhs(integrator, N_VGetArrayPointer(y), N_VGetArrayPointer(dydt)) ? 0 : 1;
}

/* Error weights 1 / (tolerance * iso_model_size()). */
static int weights(N_Vector y, N_Vector weight, void *integrator)
{
    const iso_integrator *it = integrator;
    double *w = N_VGetArrayPointer(weight);
    iso_model_size(&it->model, N_VGetArrayPointer(y), w);
    for (int i = 0; i < it->model.dim; i++) w[i] = 1 / (it->options.tolerance * w[i]);
    return 0;
}

/* iso_integrator_stopped with a name that SUNDIALS allocated; frees it. */
static iso_status stopped(iso_integrator *it, char *flag_name)
{
    const iso_status status = iso_integrator_stopped(it, flag_name ? flag_name : "unknown reason");
    free(flag_name);
    return status;
}

typedef struct solver {
    void *memory; /* of CVODE or ARKODE */
    void (*free)(void **memory);
    N_Vector y;
    N_Vector between;            /* BDF: the state at a time within a step */
    SUNMatrix matrix;            /* BDF   */
    SUNLinearSolver linear;      /* BDF   */
    SUNNonlinearSolver iterator; /* Adams */
} solver;

/* With y alone, for the code that frees its memory by `code_free`. NULL: no memory. */
static solver *create_solver(iso_integrator *it, SUNContext sun, void (*code_free)(void **memory))
{
    solver *s = it->data = calloc(1, sizeof *s);
    if (!sun || !s) return NULL;
    s->free = code_free;
    s->y = N_VNew_Serial(it->model.dim, sun);
    if (!s->y) return NULL;
    N_VConst(1, s->y);
    return s;
}

static void release(iso_integrator *it)
{
    solver *s = it->data;
    if (s->memory) s->free(&s->memory);
    if (s->iterator) SUNNonlinSolFree(s->iterator);
    if (s->linear) SUNLinSolFree(s->linear);
    if (s->matrix) SUNMatDestroy(s->matrix);
    if (s->between) N_VDestroy(s->between);
    if (s->y) N_VDestroy(s->y);
    free(s);
}

/* --- CVODE ------------------------------------------------------------------------------------------------------ */

static int jacobian(sunrealtype t, N_Vector y, N_Vector fy, SUNMatrix J, void *integrator, N_Vector a, N_Vector b,
                    N_Vector c)
{
    iso_integrator *it = integrator;
    const int dim = it->model.dim;
    double rows[ISO_MAX_STATE * ISO_MAX_STATE];
    (void)t, (void)fy, (void)a, (void)b, (void)c;
    it->statistics.jacobians++;
    it->model.jacobian(&it->model, N_VGetArrayPointer(y), rows);
    for (int i = 0; i < dim; i++)
        for (int j = 0; j < dim; j++) SM_ELEMENT_D(J, i, j) = rows[dim * i + j];
    return 0;
}

/* CVODE asks for the correction. Its error estimate could be projected as well: that is not needed. */
static int projection(sunrealtype t, N_Vector y, N_Vector correction, sunrealtype tolerance, N_Vector error,
                      void *integrator)
{
    iso_integrator *it = integrator;
    double state[ISO_MAX_STATE];
    (void)t, (void)tolerance, (void)error;
    copy(N_VGetArrayPointer(y), state, it->model.dim);
    iso_integrator_project(it, state);
    for (int i = 0; i < it->model.dim; i++) N_VGetArrayPointer(correction)[i] = state[i] - N_VGetArrayPointer(y)[i];
    return 0;
}

static int set_up_bdf(const iso_integrator *it, solver *c, SUNContext sun)
{
    c->between = N_VClone(c->y);
    if (!c->between) return -1;
    c->matrix = SUNDenseMatrix(it->model.dim, it->model.dim, sun);
    c->linear = c->matrix ? SUNLinSol_Dense(c->y, c->matrix, sun) : NULL;
    if (!c->linear || CVodeSetLinearSolver(c->memory, c->linear, c->matrix) != 0) return -1;
    if (CVodeSetJacFn(c->memory, jacobian) != 0) return -1;
    /* A Jacobian some steps old points the stiff direction the wrong way, and Newton's iteration fails. */
    if (CVodeSetJacEvalFrequency(c->memory, 1) != 0 || CVodeSetLSetupFrequency(c->memory, 1) != 0) return -1;
    if (it->options.no_projection) return 0;
    if (CVodeSetProjFn(c->memory, projection) != 0) return -1;
    return CVodeSetProjErrEst(c->memory, SUNFALSE);
}

static iso_status cvode_create(iso_integrator *it)
{
    const SUNContext sun = iso_context_sundials(it->ctx);
    solver *c = create_solver(it, sun, CVodeFree);
    if (c) c->memory = CVodeCreate(it->method->variant, sun);
    if (!c || !c->memory) return iso_context_no_memory(it->ctx, "CVODE");
    ISO_SUN_QUIET(CVodeSetErrHandlerFn, c->memory);
    int failed = CVodeInit(c->memory, rhs, 0, c->y);
    if (!failed) failed = CVodeSetUserData(c->memory, it);
    if (!failed) failed = CVodeWFtolerances(c->memory, weights);
    if (!failed && it->method->implicit) failed = set_up_bdf(it, c, sun);
    if (!failed && !it->method->implicit) {
        c->iterator = SUNNonlinSol_FixedPoint(c->y, 0, sun);
        failed = c->iterator ? CVodeSetNonlinearSolver(c->memory, c->iterator) : -1;
    }
    return failed ? iso_context_fail(it->ctx, ISO_NO_MEMORY, "", "CVODE cannot be set up (%d)", failed) : ISO_OK;
}

static iso_status cvode_start(iso_integrator *it)
{
    solver *c = it->data;
    if (!iso_room()) return iso_context_no_memory(it->ctx, "CVODE"); /* for the first step */
    copy(it->at_right, N_VGetArrayPointer(c->y), it->model.dim);
    const double first = iso_integrator_first_step(it, 1);
    int failed = CVodeReInit(c->memory, 0, c->y);
    /* CVODE chooses its first step itself, but never one below 1e-14 of the time in which the ball turns */
    if (!failed) failed = CVodeSetInitStep(c->memory, fabs(first) < 1e-12 ? first : 0);
    return failed ? stopped(it, CVodeGetReturnFlagName(failed)) : ISO_OK;
}

static iso_status cvode_step(iso_integrator *it, double y[], double *h)
{
    solver *c = it->data;
    sunrealtype t;
    long before = 0, after = 0, unsolved_before = 0, unsolved_after = 0;
    CVodeGetNumErrTestFails(c->memory, &before);
    CVodeGetNumNonlinSolvConvFails(c->memory, &unsolved_before);
    CVodeGetCurrentTime(c->memory, &t);
    if (it->longest < INFINITY) CVodeSetStopTime(c->memory, t + it->direction * it->longest);
    const int flag = CVode(c->memory, it->direction, c->y, &t, CV_ONE_STEP); /* the time only tells the direction */
    CVodeGetNumErrTestFails(c->memory, &after);
    CVodeGetNumNonlinSolvConvFails(c->memory, &unsolved_after);
    it->statistics.rejected += after - before + unsolved_after - unsolved_before;
    if (flag < 0) return stopped(it, CVodeGetReturnFlagName(flag));
    CVodeGetLastStep(c->memory, h);
    copy(N_VGetArrayPointer(c->y), y, it->model.dim);
    return ISO_OK;
}

/* By BDF's own interpolant: the steps may be too long for dense output by an explicit method. */
static iso_status dense(iso_integrator *it, double dt, double y[])
{
    solver *c = it->data;
    sunrealtype t, last; /* not it->h, which a claim that fails makes shorter */
    CVodeGetCurrentTime(c->memory, &t);
    CVodeGetLastStep(c->memory, &last);
    const int failed = CVodeGetDky(c->memory, t - (last - dt), 0, c->between);
    if (failed) return stopped(it, CVodeGetReturnFlagName(failed));
    copy(N_VGetArrayPointer(c->between), y, it->model.dim);
    iso_integrator_project(it, y);
    return ISO_OK;
}

/* For the stiffest models: see ISO_VERY_STIFF. */
static iso_suits bdf_suits(const iso_model *m)
{
    const double stiffness = iso_effects_stiffness(&m->problem);
    return stiffness > ISO_VERY_STIFF ? ISO_BEST : stiffness > ISO_STIFF ? ISO_WELL : ISO_NEVER;
}

#define CVODE_METHOD                                                                                                 \
    .family = "cvode", .create = cvode_create, .start = cvode_start, .step = cvode_step, .free = release
#define CVODE(id, variant_, doc_, ...)                                                                               \
    const iso_method iso_method_##id = {.name = #id, .variant = variant_, .doc = doc_, CVODE_METHOD, __VA_ARGS__};

CVODE(adams, CV_ADAMS, "CVODE, variable-order Adams-Moulton, orders 1-12", .order = 0)
CVODE(bdf, CV_BDF, "CVODE, variable-order BDF, orders 1-5, analytic Jacobian, projection", .implicit = true,
      .projects = true, .suits = bdf_suits, .witness = 4, .dense = dense)

/* --- ARKODE ----------------------------------------------------------------------------------------------------- */

/* ERKStep 6.4.1 uses the last stage of a step again as the first of the next. That is wrong for tables that are not
 * "first same as last" (sundials#311): Verner's 6th order then measures 3.0. With a post-processing function ERKStep
 * evaluates anew; the projection is such a function, so it is always set. test_order measures every table. */

static int after_step(sunrealtype t, N_Vector y, void *integrator)
{
    (void)t;
    iso_integrator_project(integrator, N_VGetArrayPointer(y));
    return 0;
}

static iso_status arkode_create(iso_integrator *it)
{
    const SUNContext sun = iso_context_sundials(it->ctx);
    solver *a = create_solver(it, sun, ARKodeFree);
    if (a) a->memory = ERKStepCreate(rhs, 0, a->y, sun);
    if (!a || !a->memory) return iso_context_no_memory(it->ctx, "ARKODE");
    ISO_SUN_QUIET(ERKStepSetErrHandlerFn, a->memory);
    int failed = ARKodeSetUserData(a->memory, it);
    if (!failed) failed = ERKStepSetTableNum(a->memory, (ARKODE_ERKTableID)it->method->variant);
    if (!failed) failed = ARKodeWFtolerances(a->memory, weights);
    if (!failed) failed = ARKodeSetPostprocessStepFn(a->memory, after_step);
    return failed ? iso_context_fail(it->ctx, ISO_NO_MEMORY, "", "ARKODE cannot be set up (%d)", failed) : ISO_OK;
}

static iso_status arkode_start(iso_integrator *it)
{
    solver *a = it->data;
    if (!iso_room()) return iso_context_no_memory(it->ctx, "ARKODE"); /* for the first step */
    copy(it->at_right, N_VGetArrayPointer(a->y), it->model.dim);
    int failed = ERKStepReInit(a->memory, rhs, 0, a->y);
    if (!failed && it->options.fixed_step > 0)
        failed = ARKodeSetFixedStep(a->memory, it->direction * it->options.fixed_step);
    return failed ? stopped(it, ARKodeGetReturnFlagName(failed)) : ISO_OK;
}

static iso_status arkode_step(iso_integrator *it, double y[], double *h)
{
    solver *a = it->data;
    sunrealtype t;
    long before = 0, after = 0;
    ARKodeGetNumErrTestFails(a->memory, &before);
    ARKodeGetCurrentTime(a->memory, &t);
    if (it->longest < INFINITY) ARKodeSetStopTime(a->memory, t + it->direction * it->longest);
    const int flag =
        ARKodeEvolve(a->memory, it->direction, a->y, &t, ARK_ONE_STEP); /* the time only tells the direction */
    ARKodeGetNumErrTestFails(a->memory, &after);
    it->statistics.rejected += after - before;
    if (flag < 0) return stopped(it, ARKodeGetReturnFlagName(flag));
    ARKodeGetLastStep(a->memory, h);
    copy(N_VGetArrayPointer(a->y), y, it->model.dim);
    return ISO_OK;
}

#define ARKODE                                                                                                       \
    .family = "arkode", .projects = true, .fixed = true, .create = arkode_create, .start = arkode_start,             \
    .step = arkode_step, .free = release
#define ERK(id, order_, table, ...)                                                                                  \
    const iso_method iso_method_##id = {                                                                             \
        .name = #id, .order = order_, .variant = ARKODE_##table, ARKODE, .doc = __VA_ARGS__};

/* name, order, SUNDIALS table */
ERK(heun_euler_2_1_2, 2, HEUN_EULER_2_1_2, "ERKStep, Heun-Euler 2(1)")
ERK(bogacki_shampine_4_2_3, 3, BOGACKI_SHAMPINE_4_2_3, "ERKStep, Bogacki-Shampine 3(2)")
ERK(ark324l2sa_erk_4_2_3, 3, ARK324L2SA_ERK_4_2_3, "ERKStep, explicit part of ARK3(2)4L[2]SA")
ERK(zonneveld_5_3_4, 4, ZONNEVELD_5_3_4, "ERKStep, Zonneveld 4(3)")
ERK(ark436l2sa_erk_6_3_4, 4, ARK436L2SA_ERK_6_3_4, "ERKStep, explicit part of ARK4(3)6L[2]SA")
ERK(ark437l2sa_erk_7_3_4, 4, ARK437L2SA_ERK_7_3_4, "ERKStep, explicit part of ARK4(3)7L[2]SA")
ERK(sayfy_aburub_6_3_4, 4, SAYFY_ABURUB_6_3_4, "ERKStep, Sayfy-Aburub 4(3)")
ERK(cash_karp_6_4_5, 5, CASH_KARP_6_4_5, "ERKStep, Cash-Karp 5(4)")
ERK(fehlberg_6_4_5, 5, FEHLBERG_6_4_5, "ERKStep, Fehlberg 5(4)")
ERK(dormand_prince_7_4_5, 5, DORMAND_PRINCE_7_4_5, "ERKStep, Dormand-Prince 5(4)")
ERK(ark548l2sa_erk_8_4_5, 5, ARK548L2SA_ERK_8_4_5, "ERKStep, explicit part of ARK5(4)8L[2]SA")
ERK(ark548l2sab_erk_8_4_5, 5, ARK548L2SAb_ERK_8_4_5, "ERKStep, explicit part of ARK5(4)8L[2]SAb")
ERK(verner_8_5_6, 6, VERNER_8_5_6, "ERKStep, Verner 6(5)")
ERK(fehlberg_13_7_8, 8, FEHLBERG_13_7_8, "ERKStep, Fehlberg 8(7)", .witness = 2)

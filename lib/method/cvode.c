/* cvode.c - SUNDIALS CVODE: Adams for smooth motion, BDF with the analytic Jacobian and projection for stiff. */
#include <cvode/cvode.h>
#include <cvode/cvode_proj.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdlib.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "base/room_impl.h"
#include "base/sundials_impl.h"
#include "base/vec3_impl.h"
#include "method/integrator_impl.h"
#include "method/methods_impl.h"
#include "method/sundials_vector_impl.h"
#include "model/model_impl.h"

typedef struct cvode {
    void *memory;
    N_Vector y;
    N_Vector between;            /* BDF: the state at a time within a step */
    SUNMatrix matrix;            /* BDF   */
    SUNLinearSolver linear;      /* BDF   */
    SUNNonlinearSolver iterator; /* Adams */
} cvode;

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

static void release(iso_integrator *it)
{
    cvode *c = it->data;
    if (!c) return;
    if (c->memory) CVodeFree(&c->memory);
    if (c->iterator) SUNNonlinSolFree(c->iterator);
    if (c->linear) SUNLinSolFree(c->linear);
    if (c->matrix) SUNMatDestroy(c->matrix);
    if (c->between) N_VDestroy(c->between);
    if (c->y) N_VDestroy(c->y);
    free(c);
}

static int set_up_adams(cvode *c, SUNContext sun)
{
    c->iterator = SUNNonlinSol_FixedPoint(c->y, 0, sun);
    return c->iterator ? CVodeSetNonlinearSolver(c->memory, c->iterator) : -1;
}

static int set_up_bdf(const iso_integrator *it, cvode *c, SUNContext sun)
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

static iso_status create(iso_integrator *it)
{
    const SUNContext sun = iso_context_sundials(it->ctx);
    cvode *c = it->data = calloc(1, sizeof *c);
    if (sun && c) c->y = N_VNew_Serial(it->model.dim, sun);
    if (c && c->y) c->memory = CVodeCreate(it->method->variant, sun);
    if (!c || !c->memory) return iso_context_no_memory(it->ctx, "CVODE");
    ISO_SUN_QUIET(CVodeSetErrHandlerFn, c->memory);
    N_VConst(1, c->y);
    int failed = CVodeInit(c->memory, iso_sundials_rhs, 0, c->y);
    if (!failed) failed = CVodeSetUserData(c->memory, it);
    if (!failed) failed = CVodeWFtolerances(c->memory, iso_sundials_weights);
    if (!failed) failed = it->method->implicit ? set_up_bdf(it, c, sun) : set_up_adams(c, sun);
    return failed ? iso_context_fail(it->ctx, ISO_NO_MEMORY, "", "CVODE cannot be set up (%d)", failed) : ISO_OK;
}

#define SHORT 1e-12

static iso_status start(iso_integrator *it)
{
    cvode *c = it->data;
    if (!iso_room()) /* the first step takes more */
        return iso_context_no_memory(it->ctx, "CVODE");
    copy(it->at_right, N_VGetArrayPointer(c->y), it->model.dim);
    const double first = iso_integrator_first_step(it, 1);
    int failed = CVodeReInit(c->memory, 0, c->y);
    /* CVODE chooses its first step itself, but never one below 1e-14 of the time in which the ball turns */
    if (!failed) failed = CVodeSetInitStep(c->memory, fabs(first) < SHORT ? first : 0);
    return failed ? iso_sundials_stopped(it, CVodeGetReturnFlagName(failed)) : ISO_OK;
}

static iso_status step(iso_integrator *it, double y[], double *h)
{
    cvode *c = it->data;
    sunrealtype t;
    long before = 0, after = 0, unsolved_before = 0, unsolved_after = 0;
    CVodeGetNumErrTestFails(c->memory, &before);
    CVodeGetNumNonlinSolvConvFails(c->memory, &unsolved_before);
    const int flag = CVode(c->memory, it->direction, c->y, &t, CV_ONE_STEP); /* the time only tells the direction */
    CVodeGetNumErrTestFails(c->memory, &after);
    CVodeGetNumNonlinSolvConvFails(c->memory, &unsolved_after);
    it->statistics.rejected += after - before + unsolved_after - unsolved_before;
    if (flag < 0) return iso_sundials_stopped(it, CVodeGetReturnFlagName(flag));
    CVodeGetLastStep(c->memory, h);
    copy(N_VGetArrayPointer(c->y), y, it->model.dim);
    return ISO_OK;
}

/* By BDF's own interpolant: the steps may be too long for dense output by an explicit method. */
static iso_status dense(iso_integrator *it, double dt, double y[])
{
    cvode *c = it->data;
    sunrealtype t;
    CVodeGetCurrentTime(c->memory, &t);
    const int failed = CVodeGetDky(c->memory, t - (it->h - dt), 0, c->between);
    if (failed) return iso_sundials_stopped(it, CVodeGetReturnFlagName(failed));
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

#define METHOD .family = "cvode", .create = create, .start = start, .step = step, .free = release
#define CVODE(id, variant_, doc_, ...)                                                                               \
    const iso_method iso_method_##id = {.name = #id, .variant = variant_, .doc = doc_, METHOD, __VA_ARGS__};

CVODE(adams, CV_ADAMS, "CVODE, variable-order Adams-Moulton, orders 1-12", .order = 0)
CVODE(bdf, CV_BDF, "CVODE, variable-order BDF, orders 1-5, analytic Jacobian, projection", .implicit = true,
      .projects = true, .suits = bdf_suits, .witness = 4, .dense = dense)

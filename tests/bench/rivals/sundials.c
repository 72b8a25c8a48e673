/* sundials.c - SUNDIALS: CVODE with Adams' formulas, and ARKODE with its explicit table of order 8. */
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <string.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "base/sundials_impl.h"
#include "rivals.h"

static int rhs(sunrealtype t, N_Vector y, N_Vector dy, void *problem)
{
    (void)t;
    rival_rhs(problem, N_VGetArrayPointer(y), N_VGetArrayPointer(dy));
    return 0;
}

/* What both solvers need: the state y as a vector, and the problem, which SUNDIALS takes without const. */
typedef struct run {
    rival_problem problem;
    SUNContext sun;
    N_Vector at;
} run;

static bool begin(run *r, const rival_problem *p, double y[6])
{
    r->problem = *p;
    if (ISO_SUN_CONTEXT_CREATE(&r->sun) != 0) return false;
    ISO_SUN_CONTEXT_QUIET(r->sun);
    r->at = N_VMake_Serial(6, y, r->sun);
    return true;
}

static void end_run(run *r)
{
    N_VDestroy(r->at);
    SUNContext_Free(&r->sun);
}

bool rival_cvode_adams(const rival_problem *p, double tolerance, double end, double y[6])
{
    run r;
    sunrealtype t;
    if (!begin(&r, p, y)) return false;
    SUNNonlinearSolver iterator = SUNNonlinSol_FixedPoint(r.at, 0, r.sun);
    void *memory = CVodeCreate(CV_ADAMS, r.sun);
    ISO_SUN_QUIET(CVodeSetErrHandlerFn, memory);
    const bool done = CVodeInit(memory, rhs, 0, r.at) == 0 && CVodeSetUserData(memory, &r.problem) == 0 &&
                      CVodeSStolerances(memory, tolerance, tolerance) == 0 &&
                      CVodeSetNonlinearSolver(memory, iterator) == 0 &&
                      CVodeSetMaxNumSteps(memory, lround(RIVAL_STEPS * end)) == 0 &&
                      CVodeSetStopTime(memory, end) == 0 && CVode(memory, end, r.at, &t, CV_NORMAL) >= 0;
    CVodeFree(&memory);
    SUNNonlinSolFree(iterator);
    end_run(&r);
    return done;
}

/* Without such a function version 6.4 loses the order of this table (SUNDIALS' issue 311). */
static int nothing(sunrealtype t, N_Vector y, void *problem)
{
    (void)t, (void)y, (void)problem;
    return 0;
}

bool rival_arkode_fehlberg(const rival_problem *p, double tolerance, double end, double y[6])
{
    run r;
    sunrealtype t;
    if (!begin(&r, p, y)) return false;
    void *memory = ERKStepCreate(rhs, 0, r.at, r.sun);
    ISO_SUN_QUIET(ERKStepSetErrHandlerFn, memory);
    const bool done =
        ARKodeSetUserData(memory, &r.problem) == 0 && ERKStepSetTableNum(memory, ARKODE_FEHLBERG_13_7_8) == 0 &&
        ARKodeSetPostprocessStepFn(memory, nothing) == 0 && ARKodeSStolerances(memory, tolerance, tolerance) == 0 &&
        ARKodeSetMaxNumSteps(memory, lround(RIVAL_STEPS * end)) == 0 && ARKodeSetStopTime(memory, end) == 0 &&
        ARKodeEvolve(memory, end, r.at, &t, ARK_NORMAL) >= 0;
    ARKodeFree(&memory);
    end_run(&r);
    return done;
}

/* sundials_impl.h - the one place that knows which SUNDIALS this is (6.4.1 and later 6.x, 7.x). */
#ifndef ISO_BASE_SUNDIALS_IMPL_H
#define ISO_BASE_SUNDIALS_IMPL_H

#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_types.h>

#include "base/context.h"

/* The context's SUNContext, made at the first call; NULL when it cannot be made, or when there is no room for more
 * (resources_impl.h). */
SUNContext iso_context_sundials(iso_context *ctx);

#if SUNDIALS_VERSION_MAJOR >= 7
/* 7.x: a communicator is passed, error handlers live in the SUNContext (where context.c clears them). */
#define ISO_SUN_CONTEXT_CREATE(pointer) SUNContext_Create(SUN_COMM_NULL, (pointer))
#define ISO_SUN_CONTEXT_QUIET(sun) SUNContext_ClearErrHandlers(sun)
#define ISO_SUN_QUIET(set_err_handler, memory) ((void)0)
#else
#define ISO_SUN_CONTEXT_CREATE(pointer) SUNContext_Create(NULL, (pointer))
#define ISO_SUN_CONTEXT_QUIET(sun) ((void)(sun))
#define ISO_SUN_QUIET(set_err_handler, memory) ((void)set_err_handler((memory), iso_sundials_quiet, NULL))
/* An error handler that says nothing: the library reports through its context. */
void iso_sundials_quiet(int code, const char *module, const char *function, char *message, void *user);
#endif

/* Until 7.1 the functions that ARKODE's steppers share had a name for each stepper. */
#if SUNDIALS_VERSION_MAJOR < 7 || (SUNDIALS_VERSION_MAJOR == 7 && SUNDIALS_VERSION_MINOR < 1)
#define ARKodeFree ERKStepFree
#define ARKodeSetUserData ERKStepSetUserData
#define ARKodeSStolerances ERKStepSStolerances
#define ARKodeWFtolerances ERKStepWFtolerances
#define ARKodeSetMaxNumSteps ERKStepSetMaxNumSteps
#define ARKodeSetStopTime ERKStepSetStopTime
#define ARKodeSetPostprocessStepFn ERKStepSetPostprocessStepFn
#define ARKodeSetFixedStep ERKStepSetFixedStep
#define ARKodeGetReturnFlagName ERKStepGetReturnFlagName
#define ARKodeGetNumErrTestFails ERKStepGetNumErrTestFails
#define ARKodeEvolve ERKStepEvolve
#define ARKodeGetCurrentTime ERKStepGetCurrentTime
#define ARKodeGetLastStep ERKStepGetLastStep
#endif

#endif

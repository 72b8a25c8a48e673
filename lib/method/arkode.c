/* arkode.c - SUNDIALS ARKODE: the embedded explicit Runge-Kutta tables of ERKStep, orders 2 to 8.
 *
 * ERKStep 6.4.1 uses the last stage of a step again as the first of the next. That is wrong for tables that are not
 * "first same as last" (sundials#311): Verner's 6th order then measures 3.0. With a post-processing function ERKStep
 * evaluates anew; the projection is such a function, so it is always set. test_order measures every table.
 */
#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>
#include <stdlib.h>

#include "base/room_impl.h"
#include "base/vec3_impl.h"
#include "method/methods_impl.h"
#include "method/sundials_vector_impl.h"

typedef struct arkode {
    void *memory;
    N_Vector y;
} arkode;

static int after_step(sunrealtype t, N_Vector y, void *integrator)
{
    (void)t;
    iso_integrator_project(integrator, N_VGetArrayPointer(y));
    return 0;
}

static void release(iso_integrator *it)
{
    arkode *a = it->data;
    if (!a) return;
    if (a->memory) ARKodeFree(&a->memory);
    if (a->y) N_VDestroy(a->y);
    free(a);
}

static iso_status create(iso_integrator *it)
{
    const SUNContext sun = iso_context_sundials(it->ctx);
    arkode *a = it->data = calloc(1, sizeof *a);
    if (sun && a) a->y = N_VNew_Serial(it->model.dim, sun);
    if (!a || !a->y) return iso_context_no_memory(it->ctx, "ARKODE");
    N_VConst(1, a->y);
    a->memory = ERKStepCreate(iso_sundials_rhs, 0, a->y, sun);
    if (!a->memory) return iso_context_no_memory(it->ctx, "ARKODE");
    ISO_SUN_QUIET(ERKStepSetErrHandlerFn, a->memory);
    int failed = ARKodeSetUserData(a->memory, it);
    if (!failed) failed = ERKStepSetTableNum(a->memory, (ARKODE_ERKTableID)it->method->variant);
    if (!failed) failed = ARKodeWFtolerances(a->memory, iso_sundials_weights);
    if (!failed) failed = ARKodeSetPostprocessStepFn(a->memory, after_step);
    return failed ? iso_context_fail(it->ctx, ISO_NO_MEMORY, "", "ARKODE cannot be set up (%d)", failed) : ISO_OK;
}

static iso_status start(iso_integrator *it)
{
    arkode *a = it->data;
    if (!iso_room()) /* the first step takes more */
        return iso_context_no_memory(it->ctx, "ARKODE");
    copy(it->at_right, N_VGetArrayPointer(a->y), it->model.dim);
    int failed = ERKStepReInit(a->memory, iso_sundials_rhs, 0, a->y);
    if (!failed && it->options.fixed_step > 0)
        failed = ARKodeSetFixedStep(a->memory, it->direction * it->options.fixed_step);
    return failed ? iso_sundials_stopped(it, ARKodeGetReturnFlagName(failed)) : ISO_OK;
}

static iso_status step(iso_integrator *it, double y[], double *h)
{
    arkode *a = it->data;
    sunrealtype t;
    long before = 0, after = 0;
    ARKodeGetNumErrTestFails(a->memory, &before);
    const int flag =
        ARKodeEvolve(a->memory, it->direction, a->y, &t, ARK_ONE_STEP); /* the time only tells the direction */
    ARKodeGetNumErrTestFails(a->memory, &after);
    it->statistics.rejected += after - before;
    if (flag < 0) return iso_sundials_stopped(it, ARKodeGetReturnFlagName(flag));
    ARKodeGetLastStep(a->memory, h);
    copy(N_VGetArrayPointer(a->y), y, it->model.dim);
    return ISO_OK;
}

#define METHOD                                                                                                       \
    .family = "arkode", .projects = true, .fixed = true, .create = create, .start = start, .step = step,             \
    .free = release
#define ERK(id, name_, order_, table, ...)                                                                           \
    const iso_method iso_method_##id = {                                                                             \
        .name = name_, .order = order_, .variant = ARKODE_##table, METHOD, .doc = __VA_ARGS__};

/*  identifier        name               order, SUNDIALS table                                                   */
ERK(heun_euler, "heun_euler_2_1_2", 2, HEUN_EULER_2_1_2, "ERKStep, Heun-Euler 2(1)")
ERK(bogacki_shampine, "bogacki_shampine_4_2_3", 3, BOGACKI_SHAMPINE_4_2_3, "ERKStep, Bogacki-Shampine 3(2)")
ERK(ark324, "ark324l2sa_erk_4_2_3", 3, ARK324L2SA_ERK_4_2_3, "ERKStep, explicit part of ARK3(2)4L[2]SA")
ERK(zonneveld, "zonneveld_5_3_4", 4, ZONNEVELD_5_3_4, "ERKStep, Zonneveld 4(3)")
ERK(ark436, "ark436l2sa_erk_6_3_4", 4, ARK436L2SA_ERK_6_3_4, "ERKStep, explicit part of ARK4(3)6L[2]SA")
ERK(ark437, "ark437l2sa_erk_7_3_4", 4, ARK437L2SA_ERK_7_3_4, "ERKStep, explicit part of ARK4(3)7L[2]SA")
ERK(sayfy_aburub, "sayfy_aburub_6_3_4", 4, SAYFY_ABURUB_6_3_4, "ERKStep, Sayfy-Aburub 4(3)")
ERK(cash_karp, "cash_karp_6_4_5", 5, CASH_KARP_6_4_5, "ERKStep, Cash-Karp 5(4)")
ERK(fehlberg45, "fehlberg_6_4_5", 5, FEHLBERG_6_4_5, "ERKStep, Fehlberg 5(4)")
ERK(dormand_prince, "dormand_prince_7_4_5", 5, DORMAND_PRINCE_7_4_5, "ERKStep, Dormand-Prince 5(4)")
ERK(ark548, "ark548l2sa_erk_8_4_5", 5, ARK548L2SA_ERK_8_4_5, "ERKStep, explicit part of ARK5(4)8L[2]SA")
ERK(ark548b, "ark548l2sab_erk_8_4_5", 5, ARK548L2SAb_ERK_8_4_5, "ERKStep, explicit part of ARK5(4)8L[2]SAb")
ERK(verner, "verner_8_5_6", 6, VERNER_8_5_6, "ERKStep, Verner 6(5)")
ERK(fehlberg78, "fehlberg_13_7_8", 8, FEHLBERG_13_7_8, "ERKStep, Fehlberg 8(7)", .witness = 2)

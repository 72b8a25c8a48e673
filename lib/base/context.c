/* context.c - the context: the message of the last failure, the monitor (context.h); and what every call begins
 * with: default arithmetic. */
#include "base/context_impl.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/resources_impl.h"

struct iso_context {
    void *attached; /* see iso_context_attach */
    void (*release)(void *attached);
    iso_monitor monitor;
    char message[1024];
    char about[32];
    bool has_place; /* the message begins with one */
};

const char *iso_status_text(iso_status status)
{
    static const char *const texts[] = {
#define ISO_STATUS_TEXT(name, text) text,
        ISO_STATUS_LIST(ISO_STATUS_TEXT)
#undef ISO_STATUS_TEXT
    };
    const unsigned i = (unsigned)status;
    return i < sizeof texts / sizeof *texts ? texts[i] : "unknown status";
}

iso_context *iso_context_create(void)
{
    return calloc(1, sizeof(iso_context));
}

void iso_context_free(iso_context *ctx)
{
    if (!ctx) return;
    if (ctx->attached) ctx->release(ctx->attached);
    free(ctx);
}

void iso_context_set_monitor(iso_context *ctx, bool (*go_on)(void *data), void *data)
{
    ctx->monitor = (iso_monitor){go_on, data};
}

iso_monitor iso_context_monitor(const iso_context *ctx)
{
    return ctx->monitor;
}

bool iso_context_goes_on(const iso_context *ctx)
{
    return iso_monitor_goes_on(&ctx->monitor);
}

const char *iso_context_message(const iso_context *ctx)
{
    return ctx->message;
}

const char *iso_context_about(const iso_context *ctx)
{
    return ctx->about;
}

bool iso_context_has_place(const iso_context *ctx)
{
    return ctx->has_place;
}

iso_status iso_context_placed(iso_context *ctx, iso_status status)
{
    ctx->has_place = true;
    return status;
}

iso_status iso_context_fail(iso_context *ctx, iso_status status, const char *about, const char *format, ...)
{
    va_list args;
    char message[sizeof ctx->message]; /* the arguments may point into the old message */
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    snprintf(ctx->message, sizeof ctx->message, "%s", message);
    if (about != ctx->about) snprintf(ctx->about, sizeof ctx->about, "%s", about); /* else it stays */
    ctx->has_place = false;
    return status;
}

iso_status iso_context_no_memory(iso_context *ctx, const char *what, ...)
{
    va_list args;
    char words[256];
    va_start(args, what);
    vsnprintf(words, sizeof words, what, args);
    va_end(args);
    return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for %s", words);
}

iso_status iso_context_stopped(iso_context *ctx)
{
    return iso_context_fail(ctx, ISO_STOPPED, "", "stopped on request");
}

bool iso_room(void)
{
    enum { ROOM = 65536 };
    void *volatile room = malloc(ROOM); /* which the compiler would else take for granted */
    free(room);
    return room != NULL;
}

void *iso_context_attached(const iso_context *ctx)
{
    return ctx->attached;
}

void iso_context_attach(iso_context *ctx, void *thing, void (*release)(void *thing))
{
    ctx->attached = thing;
    ctx->release = release;
}

/* --- arithmetic ------------------------------------------------------------------------------------------------- */

#if defined(__x86_64__) && defined(__GLIBC__)
#include <fpu_control.h>
#include <xmmintrin.h>

/* Asking the control words costs a hundredth of setting them. */
static bool is_default(void)
{
    enum {
        FLAGS = 0x3F,
        NO_TRAPS_TO_NEAREST = 0x1F80
    }; /* of MXCSR: what has happened; flush-to-zero is in its rest */
    fpu_control_t x87;
    _FPU_GETCW(x87);
    return x87 == _FPU_DEFAULT && (_mm_getcsr() & ~(unsigned)FLAGS) == NO_TRAPS_TO_NEAREST;
}
#else
static bool is_default(void)
{
    return false;
}
#endif

void iso_arithmetic_enter(iso_arithmetic *a)
{
    a->changed = !is_default() && fegetenv(&a->host) == 0;
    if (a->changed) fesetenv(FE_DFL_ENV);
}

void iso_arithmetic_leave(iso_arithmetic *a)
{
    if (a->changed) fesetenv(&a->host);
}

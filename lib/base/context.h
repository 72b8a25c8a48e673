/* context.h - one per thread: carries the words of the last failure, and who monitors long work.
 *
 *     iso_context *ctx = iso_context_create();
 *     if (iso_params_reduced(ctx, k, J, &p) != ISO_OK) puts(iso_context_message(ctx));
 *     iso_context_free(ctx);
 *
 * Contexts share nothing; objects made with a context must not outlive it. GSL's error handler is global and
 * aborts by default: the library keeps away from calls that raise it, but a program that must survive a failing
 * malloc inside GSL calls gsl_set_error_handler_off() once at its start.
 */
#ifndef ISO_BASE_CONTEXT_H
#define ISO_BASE_CONTEXT_H

#include <stdbool.h>

#include "api.h"
#include "status.h"

ISO_C_BEGIN

typedef struct iso_context iso_context;

/* A new context, or NULL when there is no memory. */
ISO_API iso_context *iso_context_create(void);

/* Releases it; NULL is allowed. */
ISO_API void iso_context_free(iso_context *ctx);

/* Long work asks `go_on` now and then, at each step of an integrator at least, and ends with ISO_STOPPED when it
 * answers false: for Ctrl-C, a time limit, or to show progress. NULL, as at the beginning: no calls. */
ISO_API void iso_context_set_monitor(iso_context *ctx, bool (*go_on)(void *data), void *data);

/* What went wrong last, one line without a newline; "" when nothing did. Valid until the next failing call. */
ISO_API const char *iso_context_message(const iso_context *ctx);

/* The name of the input quantity the last failure is about ("inertia", "normal", ...); "" when there is none.
 * Readers of files use it to point at the place where that quantity was written. */
ISO_API const char *iso_context_about(const iso_context *ctx);

/* Whether the last failure's message begins with the place in a file that it is about ("scene.yaml:3:1: ..."). */
ISO_API bool iso_context_has_place(const iso_context *ctx);

/* Records a failure about `about` ("" for none) in printf's words and returns `status`, so that a check reads
 * `return iso_context_fail(ctx, ISO_BAD_INPUT, "mass", "...", ...)`. */
ISO_API iso_status iso_context_fail(iso_context *ctx, iso_status status, const char *about, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 4, 5)))
#endif
    ;

/* The three most frequent: a call with numbers or names that it does not take, a scene or a file that says what cannot
 * be, and numbers that do not get there. */
#define ISO_FAIL_ARGUMENT(ctx, about, ...) iso_context_fail(ctx, ISO_BAD_ARGUMENT, about, __VA_ARGS__)
#define ISO_FAIL_INPUT(ctx, about, ...) iso_context_fail(ctx, ISO_BAD_INPUT, about, __VA_ARGS__)
#define ISO_FAIL_NUMERICAL(ctx, ...) iso_context_fail(ctx, ISO_NUMERICAL, "", __VA_ARGS__)

/* Two frequent failures: ISO_NO_MEMORY, "no memory for " and what, in printf's words; ISO_STOPPED, "stopped on
 * request". */
ISO_API iso_status iso_context_no_memory(iso_context *ctx, const char *what, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 2, 3)))
#endif
    ;
ISO_API iso_status iso_context_stopped(iso_context *ctx);

ISO_C_END

#endif

/* context_impl.h - what only the library asks of a context. */
#ifndef ISO_BASE_CONTEXT_IMPL_H
#define ISO_BASE_CONTEXT_IMPL_H

#include "base/context.h"

/* Who monitors a context (iso_context_set_monitor), for code that puts a monitor of its own before it. */
typedef struct iso_monitor {
    bool (*go_on)(void *data); /* NULL: there is no monitor */
    void *data;
} iso_monitor;

iso_monitor iso_context_monitor(const iso_context *ctx);

/* What its go_on answers; true without a monitor. */
static inline bool iso_monitor_goes_on(const iso_monitor *w)
{
    return !w->go_on || w->go_on(w->data);
}

/* What `go_on` answers; true without a monitor. */
bool iso_context_goes_on(const iso_context *ctx);

/* The message just recorded begins with the name of the file, and the place in it: iso_context_has_place() answers
 * true until the next failure. Returns the status, for `return iso_context_placed(ctx, iso_context_fail(...))`. */
iso_status iso_context_placed(iso_context *ctx, iso_status status);

/* One thing that the context keeps for a library below it, until its end: SUNDIALS' own context. NULL: nothing yet. */
void *iso_context_attached(const iso_context *ctx);
void iso_context_attach(iso_context *ctx, void *thing, void (*release)(void *thing));

#endif

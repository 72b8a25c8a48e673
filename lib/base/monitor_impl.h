/* monitor_impl.h - who monitors a context (iso_context_set_monitor), for code that puts a monitor of its own before
 * it.
 */
#ifndef ISO_BASE_MONITOR_IMPL_H
#define ISO_BASE_MONITOR_IMPL_H

#include "base/context.h"

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

#endif

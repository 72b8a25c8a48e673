/* watch_impl.h - who watches a context (iso_context_watch), for code that puts a watch of its own before it.
 */
#ifndef ISO_BASE_WATCH_IMPL_H
#define ISO_BASE_WATCH_IMPL_H

#include "base/context.h"

typedef struct iso_watch {
    bool (*go_on)(void *data); /* NULL: nobody watches */
    void *data;
} iso_watch;

iso_watch iso_context_watched(const iso_context *ctx);

/* What its go_on answers; true when nobody watches. */
static inline bool iso_watch_goes_on(const iso_watch *w)
{
    return !w->go_on || w->go_on(w->data);
}

#endif

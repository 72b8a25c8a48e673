/* place_impl.h - marks a failure whose message begins with a place in a file. */
#ifndef ISO_BASE_PLACE_IMPL_H
#define ISO_BASE_PLACE_IMPL_H

#include "base/context.h"

/* The message just recorded begins with the name of the file, and the place in it: iso_context_has_place() answers
 * true until the next failure. Gives the status, for `return iso_context_placed(ctx, iso_context_fail(...))`. */
iso_status iso_context_placed(iso_context *ctx, iso_status status);

#endif

/* options_impl.h - takes an option struct from a program that may know an older one.
 *
 * Option structs begin with `size_t size`. The *_defaults functions are compiled into the program and set it: so it
 * is the size of the struct in the program's own headers. New members are added at the end, where they must make the
 * struct larger. An older program does not know them, and gets their defaults.
 */
#ifndef ISO_BASE_OPTIONS_IMPL_H
#define ISO_BASE_OPTIONS_IMPL_H

#include <stddef.h>

#include "base/context.h"

/* Copies what the program gives over the defaults in `own`, whose size is `known`. given NULL: the defaults stay.
 * A size of 0 means the size in version 0.2, which is still `known`: when a struct grows, keep the old size for it.
 * `name` is the struct's, for the message.
 * Errors: ISO_BAD_ARGUMENT about "size": larger than `known`. */
iso_status iso_options_take(iso_context *ctx, const char *name, void *own, size_t known, const void *given);

#endif

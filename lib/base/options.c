/* options.c - takes an option struct of any known size (see options_impl.h). */
#include "base/options_impl.h"

#include <string.h>

#include "base/version.h"

iso_status iso_options_take(iso_context *ctx, const char *name, void *own, size_t known, const void *given)
{
    size_t size;
    if (!given) return ISO_OK;
    memcpy(&size, given, sizeof size);
    if (size > known)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "size",
                                "%s has %zu bytes, isoroll %s knows %zu: the program was compiled against a newer "
                                "isoroll, or did not set size",
                                name, size, ISO_VERSION, known);
    memcpy(own, given, size > 0 ? size : known);
    memcpy(own, &known, sizeof known);
    return ISO_OK;
}

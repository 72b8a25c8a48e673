/* sundials.c - SUNDIALS' own context, which a context of ours keeps (sundials_impl.h). Left out with
 * ISO_SUNDIALS=OFF. */
#include "base/sundials_impl.h"

#include "base/context_impl.h"
#include "base/resources_impl.h"

static void release(void *sun)
{
    SUNContext context = sun;
    SUNContext_Free(&context);
}

SUNContext iso_context_sundials(iso_context *ctx)
{
    SUNContext sun = iso_context_attached(ctx);
    if (!iso_room()) return NULL;
    if (!sun) {
        if (ISO_SUN_CONTEXT_CREATE(&sun) != 0) return NULL;
        iso_context_attach(ctx, sun, release);
    }
    ISO_SUN_CONTEXT_QUIET(sun);
    return sun;
}

#if SUNDIALS_VERSION_MAJOR < 7
void iso_sundials_quiet(int code, const char *module, const char *function, char *message, void *user)
{
    (void)code, (void)module, (void)function, (void)message, (void)user;
}
#endif

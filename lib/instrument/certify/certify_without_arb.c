/* certify_without_arb.c - in place of the files arb_*.c where Arb is missing (certify_impl.h). */
#include "instrument/certify/certify_impl.h"

iso_status iso_certify_is_possible(iso_context *ctx)
{
    return ISO_FAIL_ARGUMENT(ctx, "",
                             "this build has no Arb, which encloses numbers: install it (package libflint-arb-dev; "
                             "Debian 13: libflint-dev) and build isoroll again");
}

iso_status iso_certify_orbit(iso_context *ctx, const iso_certify_problem *p, const iso_certify_sink *sink,
                             iso_certify_result *result)
{
    (void)p, (void)sink, (void)result;
    return iso_certify_is_possible(ctx);
}

iso_status iso_certify_convert(iso_context *ctx, FILE *file, const char *name, iso_model_kind to,
                               const iso_certify_sink *sink, size_t *rows)
{
    (void)file, (void)name, (void)to, (void)sink, (void)rows;
    return iso_certify_is_possible(ctx);
}

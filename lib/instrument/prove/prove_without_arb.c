/* prove_without_arb.c - in place of the files arb_*.c where Arb is missing (prove_impl.h). */
#include "instrument/prove/prove_impl.h"

bool iso_proof_is_possible(void)
{
    return false;
}

iso_status iso_proof_expect(iso_context *ctx, const iso_proof_ball *ball, iso_proof_work *work, double *decades)
{
    (void)decades;
    return iso_proof_find(ctx, ball, 0, work, NULL, NULL);
}

iso_status iso_proof_find(iso_context *ctx, const iso_proof_ball *ball, int digits, iso_proof_work *work,
                          iso_proof *proof, char **text)
{
    (void)ball, (void)digits, (void)work, (void)proof, (void)text;
    return ISO_FAIL_ARGUMENT(ctx, "",
                             "prove: this build has no Arb, which encloses numbers: install it (package "
                             "libflint-arb-dev; Debian 13: libflint-dev) and build isoroll again");
}

/* isoroll prove - encloses the splitting of the separatrix: a proof that there is no further integral. */
#include <string.h>

#include "command.h"
#include "instrument/prove/prove_impl.h"
#include "io/output_impl.h"

OPTIONS_OF_SCENE(iso_prove_request);

/* One k: its numbers; an interval: rows of them. */
static json_t *json(const shell *s)
{
    const iso_proofs *f = s->result.found;
    return iso_proof_is_thin(&f->row[0].ball) ? json_of(iso_proof_fields, &f->row[0]) : json_of(iso_proofs_fields, f);
}

/* The certificates of all rows, one after the other. */
static int write_certificates(const shell *s)
{
    const iso_proofs *f = s->result.found;
    const char *path = ((const options *)s->options)->study.certificate;
    iso_output *out;
    if (!path) return EXIT_DONE;
    iso_status status = iso_output_open(s->ctx, path, &out);
    if (status != ISO_OK) return finish(s->ctx, status);
    status = iso_output_copy(s->ctx, out, f->certificates);
    const iso_status closed = iso_output_close(s->ctx, out, status == ISO_OK);
    return finish(s->ctx, status == ISO_OK ? closed : status);
}

static iso_status check(const shell *s)
{
    const char *path = ((const options *)s->options)->study.certificate;
    if (!path || strcmp(path, "-") != 0) return ISO_OK;
    return ISO_FAIL_ARGUMENT(s->ctx, "output", "prove: a certificate needs a file: -o FILE");
}

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_prove_option),
    ROW_OF_FILE("output", "FILE", "a file", "write a certificate to FILE", iso_set_text, options, study.certificate,
                'o', OPTION_WRITES),
    ROW_JSON(options, shell.json),
    ROW_END,
};

const command command_prove = {
    COMMAND_OF_SCENE(prove),
    .parts = {.check = check, .stopped = "what was proved so far is kept", .json = json, .write = write_certificates},
    .description =
        "Encloses the slope m that 'isoroll splitting' measures: numbers become intervals, and all rounding errors "
        "stay in them. If 0 is not in the enclosure of m, it is proved that the unstable and the stable manifold of "
        "the rotation about the middle axis cross. Then there is a horseshoe, and no real-analytic integral other "
        "than functions of the energy. If 0 is in the enclosure, nothing is proved: 'undecided'.\n\n"
        "k and J are taken exactly as the scene writes them: 1.4 is 14/10, and k: 1/3 is one third. A body with mass "
        "and radius has rounded k and J and is refused, as are effects, and levels other than H = 0 of the point.\n\n"
        "--k A:B proves it for all k of an interval at once. Where the interval is too long, it is halved. -o FILE "
        "writes a certificate: another program can check the proof from it alone. lib/doc/prove.md has the "
        "argument and the format. After Ctrl-C it prints what was proved so far.\n\n"
        "Where the multiplier of the rotation is near 1 (nearly equal moments, or large |k|), m is tiny and far "
        "away. So there is a limit, --half-returns: a proof ends there as undecided, or before it begins if it would "
        "take more.\n\n"
        "This needs Arb (package libflint-arb-dev; Debian 13: libflint-dev) when isoroll is built.",
    .example = "isoroll prove scene.yaml\nisoroll prove scene.yaml --k 1/3 --digits 40 -o third.cert",
    .exits = "0: proved, or undecided: 0 is in the enclosure\n"
             "1: interrupted\n"
             "2: wrong usage, or this build has no Arb\n"
             "3: bad input: an effect, a level, equal moments, a body, or numbers with more than 15 digits\n"
             "4: nothing could be enclosed, or not with so many half returns; or no memory",
};

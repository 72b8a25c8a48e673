/* expression.c - bytes as an expression of a scene: refused with a place within the text and words, or a potential and
 * a torque whose formulas can be computed, and whose text is read back from the lines of a file. */
#define _GNU_SOURCE /* memfd_create */
#include "fuzz.h"
#include "model/expression/written_impl.h"
#include "orbit/orbit_impl.h"

static const double J[3] = {1.4, 2.1, 3}, start[ISO_STATE] = {0.9, -0.3, -0.225, 0.36, 0.48, 0.8};

/* Whatever the numbers are, finite or not: they are computed within the formula's room. */
static void compute(iso_context *ctx, const iso_params *p, const iso_effects *effects)
{
    static const bool none[ISO_CLOCKS] = {false};
    const iso_problem f = {.p = *p, .effects = *effects, .eps = 1};
    double y[ISO_MAX_STATE] = {0.9, -0.3, -0.225, 0.36, 0.48, 0.8, 0, 0.6, 0.8}, dy[ISO_MAX_STATE];
    double jac[ISO_MAX_STATE * ISO_MAX_STATE];
    for (int s = 0; iso_systems[s]; s++) {
        const iso_model m = iso_model_assemble(iso_systems[s], &f, iso_systems[s]->clock, none);
        if (iso_model_too_large(&m)) continue;
        FUZZ_REQUIRE(m.problem.motion.lines <= ISO_FORMULA_LINES && m.dim <= ISO_STATE + 3, "%d\n", m.dim);
        m.rhs(&m, y, dy);
        m.jacobian(&m, y, jac);
    }
    (void)ctx;
}

/* What a file says of it is the same again. */
static void describe(iso_context *ctx, const iso_effects *effects)
{
    iso_record *record;
    iso_effects again;
    if (iso_record_create(ctx, 0, NULL, &record) != ISO_OK) return;
    const iso_status status = iso_record_describe_effects(ctx, record, effects);
    FUZZ_REQUIRE(status == ISO_OK, "%s\n", iso_context_message(ctx));
    FUZZ_REQUIRE(iso_record_effects(ctx, record, &again) == ISO_OK, "%s\n", iso_context_message(ctx));
    for (int i = 0; i < ISO_WRITTEN; i++)
        for (int j = 0; j < ISO_EXPRESSIONS; j++)
            FUZZ_REQUIRE(strcmp(effects->written[i].expression[j], again.written[i].expression[j]) == 0, "%s\n",
                         again.written[i].expression[j]);
    iso_record_free(record);
}

static void try_as(iso_context *ctx, const iso_params *p, const char *effect, const char *text)
{
    const bool torque = strcmp(effect, "torque") == 0;
    const double none = 0, up[3] = {0, 0.6, 0.8}, c = 0.3;
    iso_effects e = iso_effects_default();
    iso_expression x;
    iso_effects_set(ctx, &e, effect, "c", 1, &c);
    if (iso_effects_write(ctx, &e, effect, torque ? "M1" : "U", text) != ISO_OK) {
        fuzz_failed(ctx, ISO_BAD_ARGUMENT);
        return;
    }
    if (torque) {
        iso_effects_write(ctx, &e, effect, "M2", "-c*omega2");
        iso_effects_write(ctx, &e, effect, "M3", "0");
        iso_effects_set(ctx, &e, "gravity", "mgb", 1, &none);
        iso_effects_set(ctx, &e, "gravity", "up", 3, up);
    }
    const bool read = iso_written_read(&e, torque ? ISO_TORQUE : ISO_POTENTIAL, 0, &x);
    FUZZ_REQUIRE(read == (x.wrong[0] == '\0') && x.at >= 0 && x.at <= (int)strlen(text), "%d: %s\n", x.at, x.wrong);
    iso_status status = iso_effects_check(ctx, p, start, &e);
    FUZZ_REQUIRE(read || status == ISO_BAD_INPUT, "status %d\n", (int)status);
    if (status != ISO_OK) fuzz_failed(ctx, status);
    if (read) compute(ctx, p, &e);
    if (status == ISO_OK) describe(ctx, &e);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    iso_context *ctx = iso_context_create();
    char *text = calloc(size + 1, 1); /* up to the first byte that is 0 */
    iso_params p;
    if (ctx && text && iso_params_reduced(ctx, 0.5, J, &p) == ISO_OK) {
        memcpy(text, data, size);
        try_as(ctx, &p, "potential", text);
        try_as(ctx, &p, "torque", text);
    }
    free(text);
    iso_context_free(ctx);
    return 0;
}

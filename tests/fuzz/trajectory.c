/* trajectory.c - bytes as a trajectory file: refused with words, or carried over and checked, with finite numbers. */
#define _GNU_SOURCE /* memfd_create */
#include <math.h>

#include "fuzz.h"
#include "io/table.h"
#include "task/check/check.h"
#include "task/convert/convert.h"

enum { STEPS = 3000, ROWS = 200 };

static void check_record(const iso_record *record)
{
    for (size_t i = 0; i < iso_record_rows(record); i++)
        for (size_t c = 0; c < iso_record_columns(record); c++)
            FUZZ_REQUIRE(isfinite(iso_record_const_row(record, i)[c]), "%s = %g in row %zu\n",
                         iso_record_name(record, c), iso_record_const_row(record, i)[c], i + 1);
}

static void use(iso_context *ctx, const iso_record *record)
{
    iso_params params;
    iso_status status = iso_record_params(ctx, record, &params);
    if (status != ISO_OK) {
        fuzz_failed(ctx, status);
        return;
    }
    for (int to = ISO_BALL; to <= ISO_POINT; to++) {
        iso_record *out = NULL;
        long steps = STEPS;
        iso_context_set_monitor(ctx, fuzz_goes_on, &steps);
        status = iso_convert(ctx, record, (iso_model_kind)to, 1e-12, &out);
        if (status != ISO_OK)
            fuzz_failed(ctx, status);
        else
            check_record(out);
        iso_record_free(out);
    }
    iso_residuals residuals;
    long steps = STEPS;
    iso_context_set_monitor(ctx, fuzz_goes_on, &steps);
    status = iso_check(ctx, &params, record, 1e-12, &residuals);
    if (status != ISO_OK) fuzz_failed(ctx, status);
    for (int i = 0; status == ISO_OK && i < residuals.count; i++)
        FUZZ_REQUIRE(residuals.residual[i].worst >= 0, "%s: %g\n", residuals.residual[i].name,
                     residuals.residual[i].worst);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    iso_context *ctx = iso_context_create();
    iso_record *record = NULL;
    char path[32];
    if (!ctx) return 0;
    fuzz_file(data, size, path);
    const iso_status status = iso_table_read(ctx, path, "trajectory", NULL, &record, NULL);
    if (status != ISO_OK) {
        fuzz_failed(ctx, status);
        FUZZ_REQUIRE(status == ISO_BAD_INPUT && strstr(iso_context_message(ctx), path), "status %d says '%s'\n",
                     (int)status, iso_context_message(ctx));
    } else {
        check_record(record);
        if (iso_record_rows(record) <= ROWS) use(ctx, record);
        iso_record_free(record);
    }
    iso_context_free(ctx);
    return 0;
}

/* family.c - rows and chunks of sweeps, and the hash that tells sweeps apart (see family.h). */
#include "base/low_discrepancy_impl.h"
#include "sweep/family.h"
#include "sweep/sweep_impl.h"

#include <stdlib.h>


iso_status iso_sweep_rows_create(iso_context *ctx, int columns, size_t most, iso_sweep_rows *rows)
{
    *rows = (iso_sweep_rows){.columns = columns, .most = most};
    rows->number = calloc(most + 1, ((size_t)columns + 1) * sizeof *rows->number);
    rows->status = calloc(most + 1, sizeof *rows->status);
    rows->reason = calloc(most + 1, sizeof *rows->reason);
    if (rows->number && rows->status && rows->reason) return ISO_OK;
    iso_sweep_rows_free(rows);
    return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for the rows of %zu points", most);
}

void iso_sweep_rows_free(iso_sweep_rows *rows)
{
    free(rows->number);
    free(rows->status);
    free(rows->reason);
    *rows = (iso_sweep_rows){.columns = 0};
}

size_t iso_sweep_chunks(const iso_sweep_head *head)
{
    return head->count / head->chunk + (head->count % head->chunk > 0);
}

size_t iso_sweep_chunk_points(const iso_sweep_head *head, size_t c)
{
    const size_t first = c * head->chunk;
    return head->count - first < head->chunk ? head->count - first : head->chunk;
}

/* Each byte goes through splitmix64, once for each half. */
void iso_sweep_hash(uint64_t hash[2], const void *bytes, size_t length)
{
    const unsigned char *byte = bytes;
    for (size_t i = 0; i < length; i++) {
        hash[0] = iso_scatter(hash[0] ^ byte[i]);
        hash[1] = iso_scatter(hash[1] + hash[0]);
    }
}

/* sweep_record.c - the rows of a chunk as bytes, with a checksum; for journals, and for sending them elsewhere. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "sweep/sweep_impl.h"
#include "sweep/sweep_store_impl.h"

size_t iso_sweep_shard_points(const iso_sweep_head *head, iso_sweep_shard shard)
{
    const size_t chunks = iso_sweep_chunks(head);
    if (shard.index >= chunks) return 0;
    const size_t mine = (chunks - shard.index - 1) / shard.count + 1, last = shard.index + (mine - 1) * shard.count;
    return (mine - 1) * head->chunk + iso_sweep_chunk_points(head, last);
}

/* All its chunks are full, but perhaps the last one. */
size_t iso_sweep_shard_point(const iso_sweep_head *head, iso_sweep_shard shard, size_t i)
{
    return (shard.index + i / head->chunk * shard.count) * head->chunk + i % head->chunk;
}

const char *iso_sweep_column_name(const iso_sweep_column *c, char name[ISO_SWEEP_NAME])
{
    const bool vary = strcmp(c->group, "vary") == 0;
    snprintf(name, ISO_SWEEP_NAME, "%s%s%s", vary ? "" : c->group, vary ? "" : "_", c->name);
    return name;
}

size_t iso_sweep_rows_bytes(const iso_sweep_rows *rows, size_t count)
{
    return count * ((size_t)rows->columns * sizeof(double) + sizeof(int32_t) + 1 + ISO_REASON_SIZE);
}

size_t iso_sweep_rows_pack(const iso_sweep_rows *rows, unsigned char bytes[])
{
    const size_t numbers = rows->count * (size_t)rows->columns * sizeof(double);
    unsigned char *at = bytes;
    memcpy(at, rows->number, numbers);
    at += numbers;
    for (size_t i = 0; i < rows->count; i++, at += sizeof(int32_t))
        memcpy(at, &(int32_t){(int32_t)rows->status[i]}, sizeof(int32_t));
    for (size_t i = 0; i < rows->count; i++) {
        if (rows->status[i] == ISO_OK) continue;
        const size_t length = strnlen(rows->reason[i], ISO_REASON_SIZE - 1);
        *at++ = (unsigned char)length;
        memcpy(at, rows->reason[i], length);
        at += length;
    }
    return (size_t)(at - bytes);
}

bool iso_sweep_rows_unpack(const unsigned char bytes[], size_t length, iso_sweep_rows *rows)
{
    const unsigned char *at = bytes, *end = bytes + length;
    const size_t numbers = rows->count * (size_t)rows->columns * sizeof(double);
    if (length < numbers + rows->count * sizeof(int32_t)) return false;
    memcpy(rows->number, at, numbers);
    at += numbers;
    for (size_t i = 0; i < rows->count; i++, at += sizeof(int32_t)) {
        int32_t status;
        memcpy(&status, at, sizeof status);
        rows->status[i] = (iso_status)status;
    }
    for (size_t i = 0; i < rows->count; i++) {
        rows->reason[i][0] = '\0';
        if (rows->status[i] == ISO_OK) continue;
        const size_t size = at < end ? *at++ : ISO_REASON_SIZE;
        if (size >= ISO_REASON_SIZE || (size_t)(end - at) < size) return false;
        memcpy(rows->reason[i], at, size);
        rows->reason[i][size] = '\0';
        at += size;
    }
    return at == end;
}

static uint64_t mix(uint64_t x, uint64_t word)
{
    const uint64_t y = (x ^ word) * 0x9e3779b97f4a7c15;
    return y << 29 | y >> 35;
}

/* Four sums side by side, of eight bytes at a time. The last bytes are filled up with zeros. */
uint64_t iso_sweep_checksum(const void *bytes, size_t length, uint64_t salt)
{
    enum { LANES = 4, BYTES = 8 * LANES };
    uint64_t x[LANES] = {salt, ~salt, salt + length, 1}, word[LANES];
    const char *at = bytes, *end = at + length - length % BYTES;
    for (; at < end; at += BYTES) {
        memcpy(word, at, sizeof word);
        for (int i = 0; i < LANES; i++) x[i] = mix(x[i], word[i]);
    }
    if (length % BYTES > 0) {
        memset(word, 0, sizeof word);
        memcpy(word, at, length % BYTES);
        for (int i = 0; i < LANES; i++) x[i] = mix(x[i], word[i]);
    }
    uint64_t hash[2] = {0, 0};
    iso_sweep_hash(hash, x, sizeof x);
    return hash[1];
}

uint64_t iso_sweep_sum(uint64_t before, const iso_sweep_rows *rows)
{
    uint64_t sum = before;
    for (size_t i = 0; i < rows->count; i++) {
        const double *row = rows->number + i * (size_t)rows->columns;
        sum = mix(sum, (uint64_t)rows->status[i]);
        for (int c = 0; c < rows->columns; c++) {
            const double x = isnan(row[c]) ? (double)NAN : row[c];
            uint64_t word;
            memcpy(&word, &x, sizeof word);
            sum = mix(sum, word);
        }
        if (rows->status[i] != ISO_OK)
            sum = mix(sum, iso_sweep_checksum(rows->reason[i], strnlen(rows->reason[i], ISO_REASON_SIZE), 0));
    }
    return sum;
}

/* --- records ---------------------------------------------------------------------------------------------------- */

uint64_t iso_sweep_record_sum(const iso_sweep_record *r, const unsigned char bytes[])
{
    return iso_sweep_checksum(bytes, r->length, r->chunk * 0x9e3779b97f4a7c15 + r->length + 1);
}

/* Few places hold a possible chunk and length, so few checksums are computed. */
bool iso_sweep_record_inside(const iso_sweep_head *head, const unsigned char bytes[], size_t length)
{
    const size_t chunks = iso_sweep_chunks(head), least = (size_t)head->columns * sizeof(double) + sizeof(int32_t);
    iso_sweep_record r;
    for (size_t at = 0; at + sizeof r < length; at++) {
        memcpy(&r, bytes + at, sizeof r);
        const size_t left = length - at - sizeof r;
        if (r.chunk >= chunks || r.length > left || r.length < least * iso_sweep_chunk_points(head, r.chunk))
            continue;
        if (r.checksum == iso_sweep_record_sum(&r, bytes + at + sizeof r)) return true;
    }
    return false;
}

/* The failure of the lowest number counts as the first. */
void iso_sweep_failures_add(iso_sweep_failures *f, const iso_sweep_rows *rows)
{
    for (size_t i = 0; i < rows->count; i++) {
        if (rows->status[i] == ISO_OK) continue;
        if (f->count++ > 0 && f->first < rows->first + i) continue;
        f->first = rows->first + i;
        snprintf(f->reason, sizeof f->reason, "%s", rows->reason[i]);
    }
}

/* sweep_hash.c - the hash of a sweep: of its texts, and of all else that its rows depend on. A result that is read is
 * hashed again: texts that were changed later are found out. */
#include <math.h>
#include <string.h>

#include "base/random_impl.h"
#include "sweep/sweep_store_impl.h"

/* Each byte goes through splitmix64, once for each half. */
static void add_bytes(uint64_t hash[2], const void *bytes, size_t length)
{
    const unsigned char *byte = bytes;
    for (size_t i = 0; i < length; i++) {
        hash[0] = iso_scatter(hash[0] ^ byte[i]);
        hash[1] = iso_scatter(hash[1] + hash[0]);
    }
}

/* A text by its lines, each with an end "\n": CSV keeps no others. */
static void hash_text(uint64_t hash[2], const char *text)
{
    while (*text) {
        const size_t length = strcspn(text, "\r\n");
        add_bytes(hash, text, length);
        add_bytes(hash, "\n", 1);
        text += length;
        text += text[0] == '\r' && text[1] == '\n' ? 2 : *text != '\0';
    }
}

void iso_sweep_hash_texts(uint64_t hash[2], const char *version, const char *text, const char *scene)
{
    add_bytes(hash, version, strlen(version) + 1);
    hash_text(hash, text);
    add_bytes(hash, "", 1);
    if (scene) hash_text(hash, scene);
}

/* A number as its bytes, the low ones first; swapped: the high ones. */
static void add_size(uint64_t hash[2], uint64_t size, bool swapped)
{
    for (int i = 0; i < 8; i++)
        add_bytes(hash, &(unsigned char){(unsigned char)(size >> 8 * (swapped ? 7 - i : i))}, 1);
}

void iso_sweep_hash_head(uint64_t hash[2], const iso_sweep_head *h, bool alone, bool swapped)
{
    add_size(hash, h->count, swapped);
    add_size(hash, h->chunk, swapped);
    add_bytes(hash, h->vectors, strlen(h->vectors));
    add_bytes(hash, &(unsigned char){alone}, 1);
    for (int i = 0; i < h->columns; i++) {
        add_bytes(hash, h->column[i].group, strlen(h->column[i].group));
        add_bytes(hash, h->column[i].name, strlen(h->column[i].name));
    }
}

bool iso_sweep_head_fits(const iso_sweep_head *h)
{
    uint64_t texts[2] = {0, 0};
    iso_sweep_hash_texts(texts, h->version, h->text, h->scene);
    for (int machine = 0; machine < 4; machine++) {
        uint64_t hash[2] = {texts[0], texts[1]};
        iso_sweep_hash_head(hash, h, machine & 1, machine & 2);
        if (memcmp(hash, h->hash, sizeof hash) == 0) return true;
    }
    return false;
}

/* --- sums ------------------------------------------------------------------------------------------------------- */

static uint64_t mix(uint64_t x, uint64_t word)
{
    const uint64_t y = (x ^ word) * 0x9e3779b97f4a7c15;
    return y << 29 | y >> 35;
}

/* Four sums side by side, of eight bytes at a time. The last bytes are filled up with zeros. */
static uint64_t sum_of_text(const char *text, size_t length)
{
    enum { LANES = 4 };
    uint64_t x[LANES] = {0, ~(uint64_t)0, length, 1};
    for (size_t at = 0; at < length; at += sizeof x) {
        uint64_t word[LANES] = {0};
        memcpy(word, text + at, length - at < sizeof word ? length - at : sizeof word);
        for (int i = 0; i < LANES; i++) x[i] = mix(x[i], word[i]);
    }
    uint64_t hash[2] = {0, 0};
    add_bytes(hash, x, sizeof x);
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
            sum = mix(sum, sum_of_text(rows->reason[i], strnlen(rows->reason[i], ISO_REASON_SIZE)));
    }
    return sum;
}

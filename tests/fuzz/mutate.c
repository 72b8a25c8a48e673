/* mutate.c - half of the fuzzer's changes put another number where one stands: bytes changed at random seldom leave a
 * text that reaches the physics. */
#define _GNU_SOURCE /* memfd_create */
#include <ctype.h>

#include "fuzz.h"

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed);

/* The length of the number at data[at], 0 if none begins there. */
static size_t number_at(const uint8_t *data, size_t size, size_t at)
{
    size_t end = at;
    if (at > 0 && (isalnum(data[at - 1]) || strchr(".-_", data[at - 1]))) return 0;
    if (!isdigit(data[at]) && (data[at] != '-' || at + 1 == size || !isdigit(data[at + 1]))) return 0;
    while (end < size && (isdigit(data[end]) || (data[end] && strchr(".eE+-", data[end])))) end++;
    return end - at;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed)
{
    static const char numbers[] =
        "0 -0 1 -1 0.5 -0.4 2 3.5 10 1e3 1e-3 1e-9 1e-15 1e15 1e-60 1e60 1e-300 1e300 5e-324 "
        "1.7e308 1e-6 0.999 1.0000000000000002 -1e9 0.6 0.8 100 7 1e-150 1e150 -0.25 ";
    enum { NUMBERS = 31 };
    const char *text = numbers;
    for (unsigned i = seed / 2 % NUMBERS; i > 0; i--) text = strchr(text, ' ') + 1;
    const size_t start = size ? seed / 64 % size : 0, length = strcspn(text, " ");
    for (size_t i = 0; seed % 2 && i < size; i++) {
        const size_t at = (start + i) % size, old = number_at(data, size, at);
        if (old == 0 || size - old + length > max_size) continue;
        memmove(data + at + length, data + at + old, size - at - old);
        memcpy(data + at, text, length);
        return size - old + length;
    }
    return LLVMFuzzerMutate(data, size, max_size);
}

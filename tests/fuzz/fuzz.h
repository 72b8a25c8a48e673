/* fuzz.h - what the targets share. A target takes any bytes: it must neither crash, leak, hang nor break a promise of
 * the headers, whatever they say. Each is compiled twice: into test_hard_input, which replays the corpus, and with
 * -DISO_FUZZ=ON into a fuzzer (README.md in this folder). */
#ifndef ISO_TESTS_FUZZ_H
#define ISO_TESTS_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/context.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* A promise that was broken is a finding: it ends the program. */
#define FUZZ_REQUIRE(promise, ...)                                                                                   \
    do {                                                                                                             \
        if (!(promise)) dprintf(2, "%s:%d: %s: ", __FILE__, __LINE__, #promise), dprintf(2, __VA_ARGS__), abort();   \
    } while (0)

/* Steps of integrators that an input may take: a hang is where none are taken for seconds. */
static inline bool fuzz_goes_on(void *steps)
{
    return --*(long *)steps > 0;
}

/* A failure has words for it, in one line. */
static inline void fuzz_failed(const iso_context *ctx, iso_status status)
{
    const char *words = iso_context_message(ctx);
    FUZZ_REQUIRE(*words && !strchr(words, '\n'), "status %d says '%s'\n", (int)status, words);
}

/* A file that holds these bytes, and has the name *path; always the same one. */
static inline void fuzz_file(const uint8_t *data, size_t size, char path[32])
{
    static int fd = -1;
    if (fd < 0) fd = memfd_create("input", MFD_CLOEXEC);
    if (fd < 0 || ftruncate(fd, 0) != 0 || pwrite(fd, data, size, 0) != (ssize_t)size) abort();
    snprintf(path, 32, "/proc/self/fd/%d", fd);
}

#endif

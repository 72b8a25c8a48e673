/* no_memory.so, to be preloaded: malloc, calloc, realloc and their like fail, from main() on, as the environment
 * says:
 *
 *     ISO_FAIL_AT=n          the n-th call alone, but for those that SUNDIALS and GSL make themselves, which do not
 *                            survive it (lib/base/resources_impl.h); calls of the C library, libyaml and jansson count
 *     ISO_FAIL_FROM=n        that and all later ones, theirs too
 *     ISO_FAIL_ANY=n         the n-th call alone, theirs counted
 *     ISO_FAIL_COUNT=FILE    gets the number of calls when the program ends
 */
#define _GNU_SOURCE /* dl_iterate_phdr, RTLD_NEXT */
#include <dlfcn.h>
#include <errno.h>
#include <link.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static long fail_at, fail_from, fail_any;
static bool counting;
static atomic_long calls;

/* ---- SUNDIALS and GSL in memory ---- */

enum { SPANS = 16 };
static struct span {
    uintptr_t begin, end;
} spans[SPANS];
static int span_count;

static int note_library(struct dl_phdr_info *library, size_t size, void *unused)
{
    (void)size, (void)unused;
    if (!strstr(library->dlpi_name, "sundials") && !strstr(library->dlpi_name, "libgsl.")) return 0;
    for (int i = 0; i < library->dlpi_phnum && span_count < SPANS; i++) {
        const ElfW(Phdr) *part = &library->dlpi_phdr[i];
        if (part->p_type != PT_LOAD || !(part->p_flags & PF_X)) continue;
        spans[span_count].begin = library->dlpi_addr + part->p_vaddr;
        spans[span_count].end = spans[span_count].begin + part->p_memsz;
        span_count++;
    }
    return 0;
}

static bool is_theirs(const void *caller)
{
    for (int i = 0; i < span_count; i++)
        if ((uintptr_t)caller >= spans[i].begin && (uintptr_t)caller < spans[i].end) return true;
    return false;
}

/* ---- The calls ---- */

static bool fails(const void *caller)
{
    if (!counting) return false;
    const bool theirs = fail_any == 0 && is_theirs(caller);
    const long call = theirs ? calls : ++calls;
    const bool failing = (!theirs && (call == fail_at || call == fail_any)) || (fail_from > 0 && call >= fail_from);
    if (failing) errno = ENOMEM;
    return failing;
}

#define FAILS fails(__builtin_return_address(0))

void *malloc(size_t size)
{
    return FAILS ? NULL : __libc_malloc(size);
}

void *calloc(size_t count, size_t size)
{
    return FAILS ? NULL : __libc_calloc(count, size);
}

void *realloc(void *old, size_t size)
{
    return FAILS ? NULL : __libc_realloc(old, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    return FAILS ? NULL : __libc_memalign(alignment, size);
}

int posix_memalign(void **block, size_t alignment, size_t size)
{
    if (FAILS) return ENOMEM;
    *block = __libc_memalign(alignment, size);
    return *block ? 0 : ENOMEM;
}

/* ---- Before and after main ---- */

static int (*program)(int argc, char **argv, char **environment);

static long number(const char *name)
{
    const char *text = getenv(name);
    return text ? strtol(text, NULL, 10) : 0;
}

static void tell(void)
{
    const char *path = getenv("ISO_FAIL_COUNT");
    counting = false;
    FILE *file = path ? fopen(path, "w") : NULL;
    if (!file) return;
    fprintf(file, "%ld\n", (long)calls);
    fclose(file);
}

static int counted(int argc, char **argv, char **environment)
{
    dl_iterate_phdr(note_library, NULL);
    fail_at = number("ISO_FAIL_AT");
    fail_from = number("ISO_FAIL_FROM");
    fail_any = number("ISO_FAIL_ANY");
    atexit(tell);
    counting = true;
    return program(argc, argv, environment);
}

typedef int entry(int (*main)(int, char **, char **), int argc, char **argv, void (*init)(void), void (*fini)(void),
                  void (*loader)(void), void *stack);

int __libc_start_main(int (*main)(int, char **, char **), int argc, char **argv, void (*init)(void),
                      void (*fini)(void), void (*loader)(void), void *stack)
{
    union {
        void *data;
        entry *call;
    } next = {dlsym(RTLD_NEXT, "__libc_start_main")};
    program = main;
    return next.call(counted, argc, argv, init, fini, loader, stack);
}

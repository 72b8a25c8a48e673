/* length.h - short and full tests.
 *
 * `ctest` alone runs every test at a short length: fewer random orbits, shorter times. ISO_TEST_LENGTH=full in the
 * environment asks for the full length; `sh tests/run.sh --all` sets it. Both lengths check the same laws, with the
 * same bounds or, where a bound grows with the length, with the bound of that length.
 */
#ifndef ISO_TESTS_LENGTH_H
#define ISO_TESTS_LENGTH_H

#include <stdlib.h>
#include <string.h>

static inline int tests_length(int brief, int full)
{
    const char *wanted = getenv("ISO_TEST_LENGTH");
    return wanted && strcmp(wanted, "full") == 0 ? full : brief;
}

#endif

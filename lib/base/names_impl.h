/* names_impl.h - the names of an enumeration, and what to write in place of a wrong name. */
#ifndef ISO_BASE_NAMES_IMPL_H
#define ISO_BASE_NAMES_IMPL_H

#include <stddef.h>

/* Defines the function that returns the name of `type` i: the i-th of those that follow; NULL past the end. */
#define ISO_NAMES(function, type, ...)                                                                               \
    const char *function(type i)                                                                                     \
    {                                                                                                                \
        static const char *const names[] = {__VA_ARGS__};                                                            \
        return (size_t)i < sizeof names / sizeof *names ? names[(size_t)i] : NULL;                                   \
    }

enum { ISO_SUGGEST_SIZE = 384 };

/* The name that is nearest to `wrong`; NULL: none is near, half of the letters differ or more. */
const char *iso_nearest(const char *wrong, size_t count, const char *const names[]);

/* The end of a message about a wrong name: "did you mean 'x'?" with the nearest of the names, or, if none is near,
 * "valid are" and the names. Returns out. */
const char *iso_suggest(char out[ISO_SUGGEST_SIZE], const char *wrong, size_t count, const char *const names[]);

/* The same for the names word(0), word(1), ..., before the first NULL; iso_nearest_word: word NULL is none. */
const char *iso_nearest_word(const char *wrong, const char *(*word)(int i));
const char *iso_suggest_word(char out[ISO_SUGGEST_SIZE], const char *wrong, const char *(*word)(int i));

#endif

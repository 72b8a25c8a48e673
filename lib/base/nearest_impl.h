/* nearest_impl.h - what to write in place of a wrong word. Messages about a word that is none of a list end with
 * it. */
#ifndef ISO_BASE_NEAREST_IMPL_H
#define ISO_BASE_NEAREST_IMPL_H

#include <stddef.h>

enum { ISO_SUGGEST_SIZE = 384 };

/* The name that is nearest to `wrong`; NULL: none is near, half of the letters differ or more. */
const char *iso_nearest(const char *wrong, size_t count, const char *const names[]);

/* "did you mean 'x'?" with the nearest of the names, or, if none is near, "valid are" and the names. Gives out. */
const char *iso_suggest(char out[ISO_SUGGEST_SIZE], const char *wrong, size_t count, const char *const names[]);

/* The same for the names word(0), word(1), ..., before the first NULL; iso_nearest_word: word NULL is none. */
const char *iso_nearest_word(const char *wrong, const char *(*word)(int i));
const char *iso_suggest_word(char out[ISO_SUGGEST_SIZE], const char *wrong, const char *(*word)(int i));

#endif

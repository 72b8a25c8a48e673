/* digits_impl.h - the digits of doubles by the C++ library: the bytes of printf and strtod, in any locale, and several
 * times faster. Functions for the rest of isoroll are in number_impl.h. */
#ifndef ISO_BASE_DIGITS_IMPL_H
#define ISO_BASE_DIGITS_IMPL_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Writes value as %.*g does, without an end mark; digits: 1 to 17, or 0 for the exact hexadecimal %a. Returns its end.
 * `text` has room for 31 characters. */
char *iso_digits_print(char *text, double value, int digits);

/* Reads the decimal or hexadecimal number, without a sign and without 0x, at the beginning of [from, to). Returns its
 * end. What is too small becomes 0. NULL: there is none, or it is too large for a double. */
const char *iso_digits_read(const char *from, const char *to, bool hexadecimal, double *value);

#ifdef __cplusplus
}
#endif

#endif

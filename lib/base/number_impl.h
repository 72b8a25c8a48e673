/* number_impl.h - numbers as text, the same in every locale: a host program may have set a decimal comma. */
#ifndef ISO_BASE_NUMBER_IMPL_H
#define ISO_BASE_NUMBER_IMPL_H

#include <stdbool.h>
#include <stddef.h>

#include "base/api.h"

/* Room for one number written by iso_number_print, with its end mark. */
#define ISO_NUMBER_SIZE 32

/* Reads the whole of text[0..length) as one finite decimal number ("1", "-2.5e-3"). False for anything else: an
 * empty text, blanks, trailing characters, hexadecimal, nan, inf, and what overflows a double.
 * What underflows becomes the nearest double, subnormal or zero. */
bool iso_number_read(const char *text, size_t length, double *value);

/* Reads a finite number at the beginning of [from, to): decimal, with a sign or without, or hexadecimal as %a prints
 * it. Returns its end; NULL: there is none, or it is too large. What is too small becomes the nearest double. */
const char *iso_number_scan(const char *from, const char *to, double *value);

/* Writes value in %.17g (reads back as the same double) with a decimal point, and returns the length. */
int iso_number_print(char text[ISO_NUMBER_SIZE], double value);

/* The same with 1 to 17 significant digits; 0: hexadecimal, as %a, which reads back exactly, too. */
int iso_number_print_as(char text[ISO_NUMBER_SIZE], double value, int digits);

/* For people: the shortest decimal that reads back as the same double, 0.1 and not 0.10000000000000001. Returns text.
 * ISO_SHORT makes the room for it, until the end of the block. */
char *iso_number_short(char text[ISO_NUMBER_SIZE], double value);
#define ISO_SHORT(value) iso_number_short((char[ISO_NUMBER_SIZE]){""}, value)

/* What was computed, to the digits that it is worth. */
char *iso_number_rounded(char text[ISO_NUMBER_SIZE], double value, int digits);
#define ISO_ROUNDED(value, digits) iso_number_rounded((char[ISO_NUMBER_SIZE]){""}, value, digits)

/* --- digits by the C++ library (digits.cpp): the bytes of printf and strtod, in any locale, several times faster
 * ---- */

ISO_C_BEGIN

/* Writes value as %.*g does, without an end mark; digits: 1 to 17, or 0 for the exact hexadecimal %a. Returns its end.
 * `text` has room for 31 characters. */
char *iso_digits_print(char *text, double value, int digits);

/* Reads the decimal or hexadecimal number, without a sign and without 0x, at the beginning of [from, to). Returns its
 * end. What is too small becomes 0. NULL: there is none, or it is too large for a double. */
const char *iso_digits_read(const char *from, const char *to, bool hexadecimal, double *value);

ISO_C_END

#endif

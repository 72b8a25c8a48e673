/* number.c - reads and prints doubles, the same in any locale (number_impl.h). */
#include "base/number_impl.h"

#include <ctype.h>
#include <float.h>
#include <math.h>

#include "base/arithmetic_impl.h"

const char *iso_number_scan(const char *from, const char *to, double *value)
{
    const bool minus = from < to && *from == '-';
    if (from < to && (*from == '-' || *from == '+')) from++;
    if (from == to || (!isdigit((unsigned char)*from) && *from != '.')) return NULL; /* nor "nan", "inf" */
    const bool hexadecimal = to - from > 2 && from[0] == '0' && (from[1] | 0x20) == 'x';
    if (hexadecimal && !isxdigit((unsigned char)from[2]) && from[2] != '.') return NULL;
    const char *end = iso_digits_read(from + 2 * hexadecimal, to, hexadecimal, value);
    if (end && minus) *value = -*value;
    return end;
}

bool iso_number_read(const char *text, size_t length, double *value)
{
    ISO_DEFAULT_ARITHMETIC;
    for (size_t i = 0; i < length; i++)
        if ((text[i] | 0x20) == 'x') return false; /* decimal alone */
    return iso_number_scan(text, text + length, value) == text + length;
}

int iso_number_print_as(char text[ISO_NUMBER_SIZE], double value, int digits)
{
    char *const end = iso_digits_print(text, value, digits);
    *end = '\0';
    return (int)(end - text);
}

int iso_number_print(char text[ISO_NUMBER_SIZE], double value)
{
    ISO_DEFAULT_ARITHMETIC; /* else a host may take subnormal numbers for 0 */
    return iso_number_print_as(text, value, 17);
}

/* A decimal of 15 digits or fewer is what %.15g prints for the double that it reads as, unless that is subnormal. */
char *iso_number_short(char text[ISO_NUMBER_SIZE], double value)
{
    ISO_DEFAULT_ARITHMETIC;
    double read = NAN;
    int digits = fabs(value) >= DBL_MIN ? 15 : 1;
    size_t length = (size_t)iso_number_print_as(text, value, digits);
    while (digits < 17 && !(iso_number_read(text, length, &read) && read == value))
        length = (size_t)iso_number_print_as(text, value, ++digits);
    return text;
}

char *iso_number_rounded(char text[ISO_NUMBER_SIZE], double value, int digits)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_number_print_as(text, value, digits);
    return text;
}

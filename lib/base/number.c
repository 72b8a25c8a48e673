#include "base/number.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool iso_number_read(const char *text, size_t length, double *value)
{
    char copy[512], *end = copy;
    if (length == 0 || length >= sizeof copy) return false;
    /* strtod also takes blanks, hexadecimal, "nan" and "infinity": a decimal number has none of their letters */
    if (strspn(text, "0123456789+-.eE") < length) return false;
    memcpy(copy, text, length);
    copy[length] = '\0';
    const locale_t c = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
    if (!c) return false;
    *value = strtod_l(copy, &end, c);
    freelocale(c);
    return end == copy + length && isfinite(*value);
}

int iso_number_print(char text[ISO_NUMBER_SIZE], double value)
{
    const int length = snprintf(text, ISO_NUMBER_SIZE, "%.17g", value);
    char *comma = strpbrk(text, ",");
    if (comma) *comma = '.';
    return length;
}

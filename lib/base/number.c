/* number.c - reads and prints doubles, in any locale (number_impl.h). */
#define _GNU_SOURCE /* strtod_l, strfromd */
#include "base/number_impl.h"

#include <float.h>
#include <limits.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"

bool iso_number_read(const char *text, size_t length, double *value)
{
    ISO_DEFAULT_ARITHMETIC;
    char copy[512], *end = copy;
    if (length == 0 || length >= sizeof copy) return false;
    memcpy(copy, text, length); /* text need not be terminated */
    copy[length] = '\0';
    /* strtod also takes blanks, hexadecimal, "nan" and "infinity": a decimal number has none of their letters */
    if (strspn(copy, "0123456789+-.eE") != length) return false;
    const locale_t c = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
    if (!c) return false;
    *value = strtod_l(copy, &end, c);
    freelocale(c);
    return end == copy + length && isfinite(*value);
}

/* glibc's strfromd is snprintf without the reading of a format: a quarter less time. */
static int print(char *text, size_t size, int digits, double value)
{
#ifdef __GLIBC__
    if (digits == 17) return strfromd(text, size, "%.17g", value);
#endif
    return digits == 0 ? snprintf(text, size, "%a", value) : snprintf(text, size, "%.*g", digits, value);
}

int iso_number_print_as(char text[ISO_NUMBER_SIZE], double value, int digits)
{
    /* In any locale: whatever stands where the decimal point should, one character or several, is made a point. */
    static const char plain[] = "0123456789abcdefpx+-";
    char local[ISO_NUMBER_SIZE + MB_LEN_MAX];
    const int length = print(local, sizeof local, digits, value);
    const bool pointed =
        (length > 2 && (local[1] == '.' || local[2] == '.')) || memchr(local, '.', (size_t)length) != NULL;
    const size_t before = pointed ? 0 : strspn(local, plain);
    const size_t mark = pointed || !isfinite(value) ? 0 : strcspn(local + before, plain);
    if (mark > 0) return snprintf(text, ISO_NUMBER_SIZE, "%.*s.%s", (int)before, local, local + before + mark);
    memcpy(text, local, (size_t)length + 1);
    return length;
}

int iso_number_print(char text[ISO_NUMBER_SIZE], double value)
{
    ISO_DEFAULT_ARITHMETIC;
    return iso_number_print_as(text, value, 17);
}

/* A decimal of 15 digits or fewer is what %.15g gives for the double that it reads as, unless that is subnormal. */
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

/* rational.c - numbers as they are written (rational_impl.h). */
#include "base/rational_impl.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const int64_t most = 1000000000000000;

/* Of a text that iso_number_read takes: more than it has digits. */
static const long largest_exponent = 1000;

static bool reduce(int64_t top, int64_t below, iso_rational *r)
{
    int64_t a = top < 0 ? -top : top, b = below < 0 ? -below : below;
    while (b != 0) {
        const int64_t rest = a % b;
        a = b, b = rest;
    }
    if (top == 0 || below == 0) return false;
    if (below < 0) a = -a;
    *r = (iso_rational){top / a, below / a};
    return true;
}

/* *x times 10^power; false: it does not fit. */
static bool scale(int64_t *x, long power)
{
    for (; power > 0 && llabs(*x) <= most / 10; power--) *x *= 10;
    return power == 0;
}

/* A decimal number that iso_number_read has taken. */
static bool read_decimal(const char *text, size_t length, iso_rational *r)
{
    int64_t top = 0, below = 1;
    long power = 0;
    bool point = false;
    const bool minus = *text == '-';
    size_t i = minus || *text == '+';
    for (; i < length && text[i] != 'e' && text[i] != 'E'; i++) {
        if (text[i] == '.') {
            point = true;
            continue;
        }
        if (top > most / 10 - 1) return false;
        top = 10 * top + (text[i] - '0');
        power -= point;
    }
    const long exponent = i < length ? strtol(text + i + 1, NULL, 10) : 0;
    if (top == 0 || exponent > largest_exponent || exponent < -largest_exponent) return false;
    for (power += exponent; power < 0 && top % 10 == 0; power++) top /= 10;
    if (!scale(&top, power > 0 ? power : 0) || !scale(&below, power < 0 ? -power : 0)) return false;
    return reduce(minus ? -top : top, below, r);
}

static bool read_one(const char *text, size_t length, iso_rational *r)
{
    double x;
    return iso_number_read(text, length, &x) && read_decimal(text, length, r);
}

/* a/b; false: it does not fit. */
static bool divide(const iso_rational *a, const iso_rational *b, iso_rational *r)
{
    iso_rational x, y;
    if (!reduce(a->top, b->top, &x) || !reduce(b->below, a->below, &y)) return false;
    if (llabs(x.top) > most / y.top || x.below > most / y.below) return false;
    return reduce(x.top * y.top, x.below * y.below, r);
}

bool iso_rational_read(const char *text, size_t length, iso_rational *r)
{
    iso_rational top, below;
    const char *slash = memchr(text, '/', length);
    if (!slash) return read_one(text, length, r);
    const size_t first = (size_t)(slash - text);
    return read_one(text, first, &top) && read_one(slash + 1, length - first - 1, &below) && divide(&top, &below, r);
}

bool iso_rational_of(double x, iso_rational *r)
{
    enum { DIGITS = 15, LARGEST = 9999 };
    char text[ISO_NUMBER_SIZE];
    double back;
    const size_t length = (size_t)iso_number_print_as(text, x, DIGITS);
    if (iso_number_read(text, length, &back) && back == x) return read_decimal(text, length, r);
    for (int64_t below = 1; below <= LARGEST; below++) {
        const double top = nearbyint(x * (double)below);
        if (fabs(top) < (double)most && top / (double)below == x) return reduce((int64_t)top, below, r);
    }
    return false;
}

char *iso_rational_print(char text[ISO_RATIONAL_SIZE], const iso_rational *r)
{
    const int used = snprintf(text, ISO_RATIONAL_SIZE, "%" PRId64, r->top);
    if (r->below != 1) snprintf(text + used, (size_t)(ISO_RATIONAL_SIZE - used), "/%" PRId64, r->below);
    return text;
}

bool iso_rational_middle(const iso_rational *a, const iso_rational *b, iso_rational *middle)
{
    iso_rational ratio;
    if (!reduce(a->below, b->below, &ratio)) return false; /* a = top/(ratio.top c), b = top/(ratio.below c) */
    const int64_t common = a->below / ratio.top;
    if (a->below > most / (2 * ratio.below)) return false;
    const double size = fabs((double)a->top * (double)ratio.below) + fabs((double)b->top * (double)ratio.top);
    if (size > (double)most) return false;
    return reduce(a->top * ratio.below + b->top * ratio.top, 2 * ratio.top * ratio.below * common, middle);
}

bool iso_rational_read_double(const char *text, size_t length, double *x)
{
    double below;
    const char *slash = memchr(text, '/', length);
    if (!slash) return iso_number_read(text, length, x);
    const size_t first = (size_t)(slash - text);
    if (!iso_number_read(text, first, x) || !iso_number_read(slash + 1, length - first - 1, &below)) return false;
    *x /= below;
    return isfinite(*x);
}

const iso_literal *iso_literal_find(const iso_literals *all, const char *name)
{
    for (int i = 0; i < all->count; i++)
        if (strcmp(all->one[i].name, name) == 0) return &all->one[i];
    return NULL;
}

void iso_literals_clear(iso_literals *all)
{
    for (int i = 0; i < all->count; i++)
        for (int j = 0; j < all->one[i].count; j++) free(all->one[i].text[j]);
    all->count = 0;
}

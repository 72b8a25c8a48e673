/* test_number.c - numbers as text: what is read, what is refused, that printing and reading give the same double, and
 * that neither depends on the locale or on what stands behind the text. */
#include <locale.h>
#include <stdint.h>

#include "base/number_impl.h"
#include "laws.h"

/* Reads from a buffer that ends where the text does, so that AddressSanitizer sees a step beyond. */
static bool read_exactly(const char *text, size_t length, double *value)
{
    char *copy = malloc(length ? length : 1);
    if (!copy) abort();
    memcpy(copy, text, length);
    const bool read = iso_number_read(copy, length, value);
    free(copy);
    return read;
}

static bool same(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0; /* -0 is not 0 */
}

static void test_values(void)
{
    static const struct {
        const char *text;
        double value;
    } good[] = {
        {"0", 0},
        {"-0", -0.0},
        {"1", 1},
        {"+1", 1},
        {".5", 0.5},
        {"5.", 5},
        {"007", 7},
        {"-2.5e-3", -2.5e-3},
        {"1E+2", 100},
        {"0.1", 0.1},
        {"1.7976931348623157e308", DBL_MAX},
        {"2.2250738585072014e-308", DBL_MIN},
        {"4.9406564584124654e-324", 0x1p-1074},
        {"-1e-310", -1e-310},
        {"1e-400", 0},
    };
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        double value = NAN;
        const bool read = read_exactly(good[i].text, strlen(good[i].text), &value);
        gsl_test(!read || !same(value, good[i].value), "'%s' is %.17g", good[i].text, good[i].value);
    }
}

static void test_refusals(void)
{
    static const char *const bad[] = {
        "",    " ",   "1 ",        " 1",    "1\n",    "+",   ".",     "e5",    "1e",
        "1e+", "--1", "1.2.3",     "1,5",   "1;",     "1-",  "0x1",   "0x1p3", "nan",
        "NAN", "inf", "-infinity", "1e309", "-1e400", "1d0", "1_000", "1f",    "\xd9\xa1",
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        double value;
        gsl_test(read_exactly(bad[i], strlen(bad[i]), &value), "'%s' is no number", bad[i]);
    }
}

static void test_length(void)
{
    double value = NAN;
    gsl_test(!iso_number_read("12345", 3, &value) || value != 123, "only text[0..length) counts");
    gsl_test(!iso_number_read("1x", 1, &value) || value != 1, "a letter behind the text does not matter");
    gsl_test(read_exactly("1\0", 2, &value), "a zero byte is no part of a number");
    gsl_test(read_exactly("1\0002", 3, &value), "nor does it hide what follows");

    char zeros[600];
    memset(zeros, '0', sizeof zeros);
    zeros[0] = '1';
    zeros[1] = '.';
    zeros[599] = '1';
    gsl_test(!read_exactly(zeros, sizeof zeros, &value) || value != 1, "600 characters are read");
    zeros[0] = '0';
    gsl_test(!read_exactly(zeros, sizeof zeros, &value) || value != 0, "10^-598 is 0");
    memset(zeros, '9', sizeof zeros);
    gsl_test(read_exactly(zeros, sizeof zeros, &value), "10^600 is refused");
    memcpy(zeros + 595, "e-400", 5);
    gsl_test(!read_exactly(zeros, sizeof zeros, &value) || !same(value, 1e195),
             "595 digits of 9 and e-400 are 1e195");
}

/* The C library is the other eye: printf for 1 to 17 digits and %a, strtod for decimals of any length. */
static void test_c_library(void)
{
    iso_random *random = iso_random_create(11);
    int printed = 0, read = 0;
    if (!random) abort();
    for (int i = 0; i < 20000; i++) {
        char text[ISO_NUMBER_SIZE], wanted[64], *end = wanted;
        const int digits = i % 18;
        const double x = ldexp(iso_random_uniform(random, -1, 1), (int)iso_random_uniform(random, -1073, 1025));
        iso_number_print_as(text, x, digits);
        digits > 0 ? snprintf(wanted, sizeof wanted, "%.*g", digits, x) : snprintf(wanted, sizeof wanted, "%a", x);
        /* libraries write subnormal numbers in %a in two ways */
        const bool same_number = digits == 0 && fabs(x) < DBL_MIN && strtod(text, NULL) == x;
        printed += strcmp(text, wanted) != 0 && !same_number;
        const int length = (int)iso_random_uniform(random, 1, 30), point = (int)iso_random_uniform(random, 0, 30);
        for (int j = 0; j < length; j++) {
            *end++ = (char)('0' + (int)iso_random_uniform(random, 0, 10));
            if (j == point) *end++ = '.';
        }
        sprintf(end, "e%d", (int)iso_random_uniform(random, -360, 320));
        double value = NAN;
        const bool finite = isfinite(strtod(wanted, NULL));
        read +=
            read_exactly(wanted, strlen(wanted), &value) != finite || (finite && !same(value, strtod(wanted, NULL)));
    }
    gsl_test(printed, "%d of 20000 doubles are printed as printf does not", printed);
    gsl_test(read, "%d of 20000 decimals are read as strtod does not", read);
    iso_random_free(random);
}

/* Whether value, printed, is plain, has the length told, and reads back as the same double. */
static bool returns(double value)
{
    char text[ISO_NUMBER_SIZE];
    double back = NAN;
    const int length = iso_number_print(text, value);
    return length > 0 && (size_t)length == strlen(text) && strspn(text, "0123456789.+-e") == (size_t)length &&
           read_exactly(text, (size_t)length, &back) && same(back, value);
}

static void test_round_trip(const char *locale)
{
    static const double special[] = {0.0,          -0.0,          1,         0.1,      -1.0 / 3,    1e15,
                                     1e17,         123456789.125, DBL_MAX,   -DBL_MAX, DBL_EPSILON, -DBL_MIN,
                                     -0x1.8p-1050, 0x1p-1074,     -0x1p-1074};
    iso_random *random = iso_random_create(2007);
    int wrong = 0;
    if (!random) abort();
    for (size_t i = 0; i < sizeof special / sizeof *special; i++) wrong += !returns(special[i]);
    gsl_test(wrong, "locale %s: special values come back (%d do not)", locale, wrong);
    wrong = 0;
    for (int i = 0; i < 20000; i++) {
        uint64_t bits = (uint64_t)iso_random_uniform(random, 0, 0x1p32) << 32;
        bits |= (uint64_t)iso_random_uniform(random, 0, 0x1p32);
        if (i % 4 == 0) bits &= ~(UINT64_C(0x7ff) << 52); /* subnormal */
        double value;
        memcpy(&value, &bits, sizeof value);
        if (isfinite(value)) wrong += !returns(value);
    }
    gsl_test(wrong, "locale %s: random doubles come back (%d do not)", locale, wrong);
    iso_random_free(random);
}

static void test_text(const char *locale)
{
    static const struct {
        double value;
        const char *text;
    } printed[] = {
        {0.5, "0.5"}, {-1.5e300, "-1.5000000000000001e+300"}, {3, "3"}, {1e22, "1e+22"}, {INFINITY, "inf"}};
    for (size_t i = 0; i < sizeof printed / sizeof *printed; i++) {
        char text[ISO_NUMBER_SIZE];
        const int length = iso_number_print(text, printed[i].value);
        gsl_test(strcmp(text, printed[i].text) != 0 || (size_t)length != strlen(text), "locale %s: '%s' is '%s'",
                 locale, text, printed[i].text);
    }
}

/* The shortest decimal: it reads back as the same double, and no decimal of fewer digits does. */
static void check_short(double x)
{
    char text[ISO_NUMBER_SIZE], fewer[ISO_NUMBER_SIZE];
    double read = NAN;
    iso_number_short(text, x);
    gsl_test(!iso_number_read(text, strlen(text), &read) || !same(read, x), "%.17g: '%s' reads back", x, text);
    int digits = 0, seen = 0; /* significant ones, without zeros at the end of a whole number */
    for (const char *c = text; *c && *c != 'e'; c++) {
        seen = seen || (*c >= '1' && *c <= '9');
        digits += seen && *c >= '0' && *c <= '9';
    }
    if (!strchr(text, '.') || digits < 2) return;
    const int length = iso_number_print_as(fewer, x, digits - 1);
    gsl_test(iso_number_read(fewer, (size_t)length, &read) && same(read, x), "'%s' is the shortest, not '%s'", text,
             fewer);
}

static void test_short(void)
{
    static const double values[] = {0.1,       0.3,     1e-5,    0.1 + 0.2, 1.0 / 3,      DBL_MAX,
                                    -DBL_MAX,  DBL_MIN, 0x1p-44, 0x1p-24,   123456.78901, 9007199254740993.0,
                                    0x1p-1074, 3e-310,  1e22,    -2.5};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) check_short(values[i]);
    iso_random *random = iso_random_create(7);
    if (!random) abort();
    for (int i = 0; i < 2000; i++) {
        const double x = ldexp(iso_random_uniform(random, -1, 1), (int)iso_random_uniform(random, -1000, 1000));
        check_short(x);
        check_short(round(1e6 * iso_random_uniform(random, -10, 10)) / 1e6);
        check_short((double)(i - 1000) / 1000);
    }
    iso_random_free(random);
    gsl_test(strcmp(ISO_SHORT(0.1), "0.1") != 0 || strcmp(ISO_SHORT(1e22), "1e+22") != 0, "0.1, and 1e+22");
}

int main(void)
{
    /* a comma, and a mark of two bytes (U+066B): those that are installed */
    static const char *const locales[] = {"C", "de_DE.UTF-8", "fr_FR.UTF-8", "ps_AF.UTF-8", "ps_AF"};
    test_values();
    test_refusals();
    test_length();
    test_c_library();
    test_short();
    for (size_t i = 0; i < sizeof locales / sizeof *locales; i++) {
        if (!setlocale(LC_ALL, locales[i])) continue;
        test_text(locales[i]);
        test_round_trip(locales[i]);
        test_values();
        test_refusals();
    }
    return gsl_test_summary();
}

/* digits.cpp - digits of doubles: the one file in C++ (number_impl.h). */
#include "base/number_impl.h"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#if defined __cpp_lib_to_chars && __cpp_lib_to_chars >= 201611L

enum { ROOM = 31 };

char *iso_digits_print(char *text, double value, int digits)
{
    char *const end = text + ROOM;
    if (digits > 0) return std::to_chars(text, end, value, std::chars_format::general, digits).ptr;
    if (!std::isfinite(value)) return std::to_chars(text, end, value).ptr;
    if (std::signbit(value)) *text++ = '-';
    *text++ = '0', *text++ = 'x';
    return std::to_chars(text, end, std::fabs(value), std::chars_format::hex).ptr;
}

/* Of a number that no double can hold: whether it is too small. Only the place of its first digit matters. */
static bool is_small(const char *from, const char *to, bool hexadecimal)
{
    const char *const marks = hexadecimal ? "pP" : "eE";
    long place = 0, exponent = 0;
    bool point = false, begun = false;
    for (; from < to && !std::strchr(marks, *from); from++) {
        begun = begun || (*from != '0' && *from != '.');
        if (*from == '.')
            point = true;
        else if (point != begun)
            place += point ? -1 : 1;
    }
    if (from < to) from += 1 + (from + 1 < to && from[1] == '+');
    const bool huge = std::from_chars(from, to, exponent).ec == std::errc::result_out_of_range;
    return huge ? *from == '-' : (hexadecimal ? 4 * place : place) + exponent < 0;
}

const char *iso_digits_read(const char *from, const char *to, bool hexadecimal, double *value)
{
    const auto format = hexadecimal ? std::chars_format::hex : std::chars_format::general;
    const std::from_chars_result result = std::from_chars(from, to, *value, format);
    const bool out_of_range = result.ec == std::errc::result_out_of_range;
    if (out_of_range && is_small(from, result.ptr, hexadecimal)) return *value = 0, result.ptr;
    return result.ec == std::errc() ? result.ptr : nullptr;
}

#elif defined __EMSCRIPTEN__ /* its C library has one locale */

char *iso_digits_print(char *text, double value, int digits)
{
    return text +
           (digits > 0 ? std::snprintf(text, 32, "%.*g", digits, value) : std::snprintf(text, 32, "%a", value));
}

const char *iso_digits_read(const char *from, const char *to, bool hexadecimal, double *value)
{
    const std::size_t length = static_cast<std::size_t>(to - from), before = hexadecimal ? 2 : 0;
    char *const text = static_cast<char *>(std::malloc(before + length + 1)), *end = text;
    if (!text) return nullptr;
    std::memcpy(text, "0x", before);
    std::memcpy(text + before, from, length);
    text[before + length] = '\0';
    *value = std::strtod(text, &end);
    const std::ptrdiff_t read = end - text - static_cast<std::ptrdiff_t>(before);
    std::free(text);
    return read > 0 && std::isfinite(*value) ? from + read : nullptr;
}

#else
#error "std::to_chars and std::from_chars of doubles are missing: compile with GCC 11 or later, or with its C++ library"
#endif

/* api.h - marks what the library offers to programs.
 *
 * - ISO_API stands before each function and variable that a program can use. The shared library exports these alone.
 * - ISO_C_BEGIN and ISO_C_END enclose the declarations of a public header: C++ programs then read them as C.
 */
#ifndef ISO_BASE_API_H
#define ISO_BASE_API_H

#ifndef ISO_API
#if defined(__GNUC__)
#define ISO_API __attribute__((visibility("default")))
#else
#define ISO_API
#endif
#endif

#ifdef __cplusplus
/* clang-format off */
#define ISO_C_BEGIN extern "C" {
#define ISO_C_END }
#else
#define ISO_C_BEGIN
#define ISO_C_END
/* clang-format on */
#endif

#endif

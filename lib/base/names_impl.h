/* names_impl.h - the names of an enumeration. */
#ifndef ISO_BASE_NAMES_IMPL_H
#define ISO_BASE_NAMES_IMPL_H

#include <stddef.h>

/* Defines the function that gives the name of `type` i: the i-th of those that follow; NULL past the end. */
#define ISO_NAMES(function, type, ...)                                                                               \
    const char *function(type i)                                                                                     \
    {                                                                                                                \
        static const char *const names[] = {__VA_ARGS__};                                                            \
        return (size_t)i < sizeof names / sizeof *names ? names[(size_t)i] : NULL;                                   \
    }

#endif

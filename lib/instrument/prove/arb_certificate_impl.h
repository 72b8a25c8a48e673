/* arb_certificate_impl.h - the certificate of a proof, a text that grows line by line (lib/doc/prove.md). */
#ifndef ISO_STUDY_PROVE_ARB_CERTIFICATE_IMPL_H
#define ISO_STUDY_PROVE_ARB_CERTIFICATE_IMPL_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arb_impl.h"

typedef struct prove_certificate {
    char *text;
    size_t length, room;
    bool lost; /* there was no memory for all of it */
} prove_certificate;

/* A line of words, as printf makes it. c NULL: nothing is done, here and below. */
void prove_certificate_words(prove_certificate *c, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 2, 3)))
#endif
    ;

/* A line: a word, then balls, exactly. */
void prove_certificate_line(prove_certificate *c, const char *word, int count, arb_srcptr x);

/* All lines of another one. */
void prove_certificate_append(prove_certificate *c, const prove_certificate *more);

/* Forgets what was written after the first `length` bytes. */
void prove_certificate_cut(prove_certificate *c, size_t length);

#endif

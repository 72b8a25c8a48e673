/* literal_impl.h - the numbers of a text as they are written there, digit by digit: "1.4", "1/3", "0.1e-5". */
#ifndef ISO_BASE_LITERAL_IMPL_H
#define ISO_BASE_LITERAL_IMPL_H

enum { ISO_LITERALS = 64, ISO_LITERAL_NAME = 64 };

/* A number, or a list of three. */
typedef struct iso_literal {
    char name[ISO_LITERAL_NAME]; /* "k", "surface.radius", "rotor.momentum" */
    int count;
    char *text[3];
} iso_literal;

typedef struct iso_literals {
    int count;
    iso_literal one[ISO_LITERALS];
} iso_literals;

/* NULL: it is not written. */
const iso_literal *iso_literal_find(const iso_literals *all, const char *name);

void iso_literals_clear(iso_literals *all);

#endif

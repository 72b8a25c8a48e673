/* arb_certificate.c - the text of a certificate (arb_flow_impl.h). */
#include "instrument/prove/arb_flow_impl.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void add(prove_certificate *c, const char *text)
{
    const size_t length = strlen(text);
    if (!c->lost && c->length + length >= c->room) {
        const size_t room = 2 * (c->room + length) + 1024;
        char *larger = realloc(c->text, room);
        c->lost = !larger;
        if (larger) c->text = larger, c->room = room;
    }
    if (c->lost) return;
    memcpy(c->text + c->length, text, length + 1);
    c->length += length;
}

void prove_certificate_text(prove_certificate *c, const char *format, ...)
{
    char line[512];
    if (!c) return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    add(c, line);
    add(c, "\n");
}

void prove_certificate_line(prove_certificate *c, const char *word, int count, arb_srcptr x)
{
    if (!c) return;
    add(c, word);
    for (int i = 0; i < count; i++) {
        char *ball = arb_dump_str(x + i);
        add(c, " ");
        add(c, ball);
        flint_free(ball);
    }
    add(c, "\n");
}

void prove_certificate_append(prove_certificate *c, const prove_certificate *more)
{
    c->lost = c->lost || more->lost;
    if (more->text) add(c, more->text);
}

void prove_certificate_cut(prove_certificate *c, size_t length)
{
    if (!c || length > c->length) return;
    c->length = length;
    if (c->text) c->text[length] = '\0';
}

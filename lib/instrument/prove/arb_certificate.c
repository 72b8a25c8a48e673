/* arb_certificate.c - the lines of a certificate (arb_flow_impl.h). */
#include "instrument/prove/arb_flow_impl.h"

#include <stdarg.h>

void prove_certificate_text(FILE *c, const char *format, ...)
{
    if (!c) return;
    va_list arguments;
    va_start(arguments, format);
    vfprintf(c, format, arguments);
    va_end(arguments);
    fputc('\n', c);
}

void prove_certificate_line(FILE *c, const char *word, int count, arb_srcptr x)
{
    if (!c) return;
    fputs(word, c);
    for (int i = 0; i < count; i++) {
        char *ball = arb_dump_str(x + i);
        fprintf(c, " %s", ball);
        flint_free(ball);
    }
    fputc('\n', c);
}

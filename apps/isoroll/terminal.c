/* terminal.c - how wide the terminal is (see terminal.h). */
#include "terminal.h"

#include <stdbool.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { LEAST_WIDTH = 40, MOST_WIDTH = 10000 };

int terminal_width(FILE *stream)
{
    struct winsize size;
    const char *columns = getenv("COLUMNS");
    const bool is_terminal = isatty(fileno(stream));
    const long wanted = columns ? strtol(columns, NULL, 10) : 0;
    long width = is_terminal ? USUAL_WIDTH : ISO_ANY_WIDTH;
    if (is_terminal && ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        width = size.ws_col;
    else if (wanted > 0 && wanted <= MOST_WIDTH)
        width = wanted;
    return width == ISO_ANY_WIDTH || width >= LEAST_WIDTH ? (int)width : LEAST_WIDTH;
}

/* terminal.h - text for people on standard output, as wide as the terminal.
 *
 * A pipe or a file gets each line whole, so that `grep` finds what stands in it, unless the environment's COLUMNS says
 * how wide it should be.
 */
#ifndef ISOROLL_TERMINAL_H
#define ISOROLL_TERMINAL_H

#include <stdio.h>

#include "base/fold_impl.h"

enum { USUAL_WIDTH = 80 };

/* The width of the terminal behind a stream; for others COLUMNS, else ISO_ANY_WIDTH. */
int terminal_width(FILE *stream);

#endif

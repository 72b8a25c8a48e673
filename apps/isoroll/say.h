/* say.h - text for people on standard output, as wide as the terminal.
 *
 * terminal_width decides how wide that is. On a terminal text is folded between words. Further lines begin below what
 * follows two blanks; without two blanks, below the line's beginning. A pipe or a file gets each line whole, so that
 * `grep` finds what stands in it, unless the environment's COLUMNS says how wide it should be.
 *
 *     say("k = %s\n", ISO_SHORT(k));
 *     say_table(1);                              a table, whose first column is repeated when it must be cut
 *     say("method\ttime\n");                     its header; the cells of a row have tabs between
 *     say("%s\t%.1e\n", name, seconds);
 *     say_table_end();
 */
#ifndef ISOROLL_SAY_H
#define ISOROLL_SAY_H

#include <stdbool.h>
#include <stdio.h>

enum { USUAL_WIDTH = 80, ANY_WIDTH = 0 };

/* The width of the terminal behind a stream; for others COLUMNS, else ANY_WIDTH. */
int terminal_width(FILE *stream);

/* One line (the first `length` characters of text), folded; the end of the line is added. */
void fold_line(FILE *to, const char *text, size_t length, int width);

/* Like printf. What is incomplete waits for the end of its line. */
void say(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Where others can print what is said next. It appears with the next line that is said, or at the end. */
FILE *say_to(void);
void say_end(void);

/* Whether something could not be said, for lack of memory. */
bool say_failed(void);

/* From here on each line is a row of a table. Columns of numbers stand to the right, others to the left. A column that
 * has no room goes on below, behind the first `keys` columns again; the last one is folded, if it has words. A row with
 * fewer cells than the header ends with words that may be long, and stands in the first part alone. One without a tab
 * is a title. */
void say_table(int keys);
void say_table_end(void);

#endif

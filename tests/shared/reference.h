/* reference.h - the rows of reference/free_ball.csv, quadruple-precision states of the free ball; rows of other
 * files. */
#ifndef ISO_TESTS_REFERENCE_H
#define ISO_TESTS_REFERENCE_H

#include "laws.h"
#include "orbit/orbit.h"

enum { REFERENCE_ROWS = 29, REFERENCE_NUMBERS = 18 };

/* One row: k, J, the start n and w, then t, w, n and s. */
typedef struct reference {
    iso_params p;
    iso_start start;
    double t, ball[ISO_STATE], s;
} reference;

/* The numbers of a row behind its name, in any file of reference/. False: there are fewer. */
static inline bool reference_numbers(const char *line, int count, double x[])
{
    for (int i = 0; i < count; i++) {
        line = strchr(line, ',');
        if (!line) return false;
        x[i] = strtod(++line, NULL);
    }
    return true;
}

static inline bool reference_read_row(iso_context *ctx, const char *line, reference *r)
{
    double x[REFERENCE_NUMBERS];
    if (!reference_numbers(line, REFERENCE_NUMBERS, x)) return false;
    r->p = laws_params(x[0], x + 1);
    for (int i = 0; i < 3; i++) {
        r->ball[i] = x[11 + i];
        r->ball[3 + i] = x[14 + i];
    }
    r->t = x[10];
    r->s = x[17];
    return iso_start_ball(ctx, x + 7, x + 4, false, &r->start) == ISO_OK;
}

/* Reads all rows. Ends the test when a row cannot be read. */
static inline int reference_read(iso_context *ctx, reference rows[REFERENCE_ROWS])
{
    FILE *file = fopen(ISO_TEST_DATA "/free_ball.csv", "r");
    char line[2048];
    int count = 0;
    while (file && fgets(line, sizeof line, file)) {
        if (strncmp(line, "open", 4) != 0) continue; /* comments and names */
        if (count == REFERENCE_ROWS || !reference_read_row(ctx, line, &rows[count++])) {
            gsl_test(1, "free_ball.csv, row %d is not understood: %s", count, iso_context_message(ctx));
            exit(gsl_test_summary());
        }
    }
    if (file) fclose(file);
    gsl_test_int(count, REFERENCE_ROWS, "rows of free_ball.csv");
    return count;
}

#endif

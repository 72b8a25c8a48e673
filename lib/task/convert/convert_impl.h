/* convert_impl.h - the study `convert`, and what a conversion is made of. The files call each other in one direction
 * only: convert_study.c -> convert.c -> convert_clock.c -> convert_row.c -> convert_stated.c. */
#ifndef ISO_TASK_CONVERT_CONVERT_IMPL_H
#define ISO_TASK_CONVERT_CONVERT_IMPL_H

#include "base/sink.h"
#include "orbit/rows_impl.h"
#include "study/file_parameters_impl.h"
#include "task/convert/convert.h"

typedef struct iso_convert_request {
    iso_model_kind to; /* -1: not given */
    double tolerance;  /* of the other clock's gain from row to row, relative; NAN: ISO_CONVERT_TOLERANCE */
    iso_file_parameters added;
    double max_defect; /* NAN: by the tolerances and digits of the rows, 1e-5 or more */
    /* For points with k = -1 off the level H = 0. true: the point becomes the free ball with the moments J + E/eps,
     * where E is the energy of the first row: the same motion. false: it becomes a ball in the potential of the effect
     * `level`. */
    bool shift_J;
    bool strict, quiet;
} iso_convert_request;

#define ISO_CONVERT_TOLERANCE 1e-14
#define ISO_CONVERT_UNSET                                                                                            \
    {                                                                                                                \
        .to = (iso_model_kind)-1, .tolerance = NAN, .added = ISO_FILE_PARAMETERS_UNSET, .max_defect = NAN            \
    }

/* What the study finds. */
typedef struct iso_convert_found {
    iso_conversion_summary all;
    const char *name; /* of the file whose rows go to a sink; NULL: a record's rows */
} iso_convert_found;

/* --- one orbit, row by row ----------------------------------------------------------------------------------------
 *
 *     iso_conversion_create(ctx, &params, header, &how, name, &sink, &c);
 *     while (next(row)) status = iso_conversion_put(c, row, ++line);
 *     status = iso_conversion_end(c, &all);
 *     iso_conversion_free(c); */

typedef struct iso_conversion iso_conversion;

/* A good row. */
typedef struct conversion_row {
    size_t line;
    double time;               /* of its own clock, the caller's units; 0 without one          */
    double y[ISO_STATE];       /* its own model, the caller's units: as it stands              */
    double own[ISO_STATE];     /* the same in own units                                        */
    double out[1 + ISO_STATE]; /* the clock (if there is one) and the other model              */
    bool other_energy;         /* refused: its energy is not that of the rows before           */
} conversion_row;

struct iso_conversion {
    iso_context *ctx;
    const iso_params *params;
    const iso_record *in;
    const iso_convert_request *how;
    const char *name;
    iso_sink sink;
    size_t width; /* of the rows of the result */
    iso_model_kind from;
    double row_tolerance;
    iso_params shifted;                  /* what params then points to                                          */
    int columns[ISO_TRAJECTORY_COLUMNS]; /* of `in`; -1: not there                                      */
    iso_clock own, other;                /* the clocks of the two models                                        */
    int own_column, other_column;        /* their columns in `in`, -1: not there                                */
    double stated_eps;                   /* by the lines, or the first row's own; NAN: not                      */
    double stated_level;                 /* c by the lines, 0: none                                             */
    bool replaces;                       /* the result states the first row's own h and eps                     */
    iso_effects effects;                 /* of the lines, and the level of a point off H = 0; the caller's units */

    bool settled; /* which of them act is known: from the first row on that is a start   */

    /* from the first good row on, which has begun the result */
    bool begun;
    size_t good;   /* rows so far                                        */
    int strangers; /* behind the first, and before the next, of another energy */
    iso_orbit *first;
    iso_units units;
    double unit_from, unit_to;            /* of the fast vectors   */
    double unit_own;                      /* of its own clock */
    double energy;                        /* of the first row      */
    iso_rows rows;                        /* not used without own clock */
    conversion_row last;                  /* the row before             */
    long max_steps;                       /* from it to the row in hand          */
    double longest;                       /* angle from a row to the next so far */
    bool unreached;                       /* its orbit did not get to the row behind it */
    double direction, typical;            /* of time; size of defects                                   */
    double drift[ISO_STATE], late, moved; /* see iso_conversion_summary.drift                            */
    double gained;                        /* by the other clock meanwhile                                */
    double sum, lost;                     /* the other clock, and what its roundings lost               */
    iso_status first_failure;
    char *first_text;
    iso_conversion_summary summary;
};

/* --- convert_row.c: what leaves --- */

/* Sends a row to the sink; NULL: a mark in the place of a bad one. */
iso_status iso_conversion_write(const iso_conversion *c, const double row[]);

/* Marks the place of a bad row; if too many are bad before the first good one, this fails. */
iso_status iso_conversion_mark(iso_conversion *c);

/* Names a row of a file: a note, or with `strict` the error `why`. */
iso_status iso_conversion_name(const iso_conversion *c, size_t line, iso_status why, const char *text);

/* A row cannot be converted; the context's message says why. */
iso_status iso_conversion_bad(iso_conversion *c, size_t line, iso_status why);

/* Notes a value at a line, if it is the worst so far. */
void iso_worst_note(iso_worst *worst, double value, size_t line);

/* --- convert_stated.c: what the lines state of the energy; calls none of the others --- */

/* Holds the lines against the first row, whose orbit c->first gives the units: notes in the summary what is off,
 * mends c of the level. True: the orbit of the row has the row's own energy, which is near the stated one or takes
 * its place; false: that of a point is another. */
bool iso_conversion_reconcile(iso_conversion *c, const conversion_row *r);

/* How far a row is from a state: the larger of | |n| - 1 | and (omega,n)/|omega|, of a point likewise. */
double iso_conversion_constraint(const double y[ISO_STATE]);

/* How well energies of rows agree, relative: 1e-6. With a wider row tolerance the caller says that the rows have
 * fewer digits; an energy is then off by several times that tolerance. */
double iso_conversion_digits(const iso_conversion *c);

/* --- convert_row.c: one row of the file; calls convert_stated.c --- */

/* Everything of a row but its place among the others: r->line is given. */
iso_status iso_conversion_read_row(iso_conversion *c, const double row[], conversion_row *r);

/* An orbit of the record's own model from a row on, with the other clock: iso_rows.open. */
iso_status iso_conversion_open(void *conversion, const double row[], iso_orbit **orbit);

/* The columns and lines of the result. */
iso_status iso_conversion_describe(iso_conversion *c, double begin, iso_record **header);

/* --- convert_clock.c: rows one after the other; calls convert_row.c --- */

/* Adds a good row: finds its clock and its defect, and writes it. */
iso_status iso_conversion_follow(iso_conversion *c, const double row[], conversion_row *r);

/* After the last row: the other clock's end and error. */
void iso_conversion_settle(iso_conversion *c);

/* header: columns, lines and row tolerance of what is converted. It, params, how and name must outlive the conversion;
 * lines may be added to it meanwhile. name: of the file, in the names of rows; NULL: these are a record's, of which a
 * bad one ends the work, and missed ones are only counted. sink: its row can be NULL, a mark in the place of a bad
 * row, also before the header. The header must have the six columns of one model. The clock of the result is
 * - the column of the header, if it has the other model's clock;
 * - else computed, from the line `t0` or `s0` of an earlier conversion on, or from 0;
 * - none, if the header has no clock.
 * Errors: ISO_BAD_INPUT about columns or lines, ISO_NOT_MAPPED about an effect that breaks the isomorphism,
 * ISO_BAD_ARGUMENT (shift_J without a point, or with k other than -1), ISO_NO_MEMORY. */
iso_status iso_conversion_create(iso_context *ctx, const iso_params *params, const iso_record *header,
                                 const iso_convert_request *how, const char *name, const iso_sink *sink,
                                 iso_conversion **conversion);
void iso_conversion_free(iso_conversion *conversion);

/* The next row. The first good row is compared with the lines: where h, eps or c of a level differs by more than
 * rounding, the result has the row's number, and the summary says so. The wrong one of the three is the one
 * that the other two and the row contradict. A point off the level H = 0 becomes a ball in the potential of the
 * effect `level`, which the lines of the result then name. A bad row is no state, it is at rest, its energy is not
 * that of the rows before, or the orbit of the row before does not reach it. A row that this orbit misses, or whose
 * time turns back, is converted as it stands. Both are named. Errors: the status of the sink; ISO_NO_MEMORY,
 * ISO_STOPPED. */
iso_status iso_conversion_put(iso_conversion *conversion, const double row[], size_t line);

/* Call this in the place of a row that could not even be read. */
iso_status iso_conversion_skip(iso_conversion *conversion);

/* Call this after the last row. Adds the summary to that of the orbits before: sums, and the worst of all. Errors: as
 * for a row; if no row could be converted, the reason for the first one. */
iso_status iso_conversion_end(iso_conversion *conversion, iso_conversion_summary *all);

/* What is wrong with the rows as a whole, most at line *at; false: nothing. */
enum { ISO_VERDICT_SIZE = 400 };
bool iso_conversion_verdict(const iso_conversion_summary *summary, char text[ISO_VERDICT_SIZE], size_t *at);

/* The two lines that say how the other clock was computed, and its error. False: it was not computed. */
bool iso_conversion_clock_lines(const iso_conversion_summary *summary, char key[2][ISO_NAME_SIZE],
                                char value[2][160]);

/* The text about the line summary->stated[i]; false: there is none. */
enum { ISO_STATED_SIZE = 240 };
bool iso_conversion_stated_text(const iso_conversion_summary *summary, int i, char text[ISO_STATED_SIZE]);

#endif

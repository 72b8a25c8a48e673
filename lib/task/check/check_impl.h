/* check_impl.h - what a check is made of. Each file calls those below it, and notes what it finds by iso_checker_note.
 *
 *     check_study.c       what is typed, rows, the table, and which columns and lines no residual depends on
 *     check.c             rows come in, residuals go out; constraints and integrals at each row
 *     check_flow.c        from each row to the next: state and clocks
 *     check_effects.c     the same for the columns of effects; what lines state, against a row
 */
#ifndef ISO_TASK_CHECK_CHECK_IMPL_H
#define ISO_TASK_CHECK_CHECK_IMPL_H

#include "orbit/description.h"
#include "orbit/rows_impl.h"
#include "orbit/watch_impl.h"
#include "study/file_parameters_impl.h"
#include "task/check/check.h"

/* --- row by row ---------------------------------------------------------------------------------------------------
 *
 *     iso_checking_create(ctx, &params, header, 1e-13, &c);
 *     while (next(row)) status = iso_checking_put(c, row);      c->begins = true before it: of another orbit
 *     status = iso_checking_end(c, &residuals);
 *     iso_checking_free(c);
 *
 * The same as iso_check, in constant memory. Where two rows are near each other, two-point Taylor quadrature
 * finds the rows that are worst, and these alone are integrated. */
typedef struct iso_checking iso_checking;

/* header: columns, lines and row tolerance; it and params must outlive the check. Errors: those of iso_check about
 * columns and lines; *checking is then NULL. */
iso_status iso_checking_create(iso_context *ctx, const iso_params *params, const iso_record *header, double tolerance,
                               iso_checking **checking);
void iso_checking_free(iso_checking *checking);

/* The next row: as many numbers as the header has columns. Errors: those of iso_check. */
iso_status iso_checking_put(iso_checking *checking, const double row[]);

/* After the last row. Errors: ISO_BAD_INPUT, if there was none. */
iso_status iso_checking_end(iso_checking *checking, iso_residuals *residuals);

/* What the check does not look at: columns that nothing was compared with, and lines that are neither compared with
 * rows nor part of the equations that were followed. Calls `note` for each: "mu", "# tolerance"; and "the flow from
 * row to row" where no orbit has two rows, or no clock. Call it after iso_checking_end. */
void iso_checking_unseen(iso_checking *checking, void (*note)(void *data, const char *name), void *data);

/* The drifts of the integrals that hold, row by row, as a new record; of the model whose states the record must have,
 * or (-1) of the ball if it has both. The first column is the model's first clock, or
 * "row", the row's number. The others ("h", "F_shell", ...) are |I(row) - I(first row)| / size; for a constraint its
 * exact value stands in the place of I(first row). Of those that are no constraints, lines say what they are: h.doc,
 * h.model, h.dimension (exponents a, b, c of the unit (mass length^2)^(a + b/(2k)) / time^c), h.start and h.worst.
 * Errors: those of iso_check. */
iso_status iso_check_drifts(iso_context *ctx, const iso_params *params, const iso_record *record, int model,
                            iso_record **drifts);

typedef struct iso_checking checker;

/* One of the two models, as the rows have it. */
typedef struct checked_model {
    iso_model_kind kind;
    bool there;
    const iso_system *system;
    int first;    /* its first column, in a trajectory           */
    int clock;    /* that is followed; -1: the record has none   */
    bool has_eps; /* the lines state eps, for a point            */
    double eps;
    iso_orbit *orbit; /* of the first row */
    int count;        /* of integrals that hold, each with the value that it should have */
    iso_drift integral[ISO_MAX_INTEGRALS];
    bool on_level; /* a point: its H is known, and is ... */
    double level;
    double energy; /* of all orbits of the file; NaN: that of its first row */
    iso_rows rows;
    const iso_method *method; /* that integrates from row to row; NULL: auto */
    struct iso_checking *checker;
    double seen, seen_clock[ISO_CLOCKS]; /* the largest it found, of the intervals that were integrated */
    bool followed;                       /* an interval was integrated: the first one always is          */
    iso_residuals found;
} checked_model;

struct iso_checking {
    iso_context *ctx;
    const iso_params *params;
    const iso_record *record;    /* its names, lines and row tolerance; no rows */
    iso_effects stated, effects; /* by the lines; of these, what can be checked */
    double tolerance;
    int columns[ISO_TRAJECTORY_COLUMNS]; /* of the record, -1: not there           */
    bool looked[ISO_TRAJECTORY_COLUMNS]; /* the column was compared with something */
    size_t width;                        /* of a row                               */
    size_t rows, passed;                 /* so far; rows of nan that were passed over, counted by who reads them */
    size_t number, before;               /* of the row in hand, and of the last                           */
    /* The next row is the first of its orbit: no flow goes to it from the row before, and the integrals but the energy
     * may have other values. */
    bool begins;
    double span[ISO_CLOCKS]; /* largest |clock| so far                 */
    iso_units units;         /* for the map                            */
    checked_model model[2];
    iso_residuals map;
};

/* --- check.c ------------------------------------------------------------------------------------------------------- */

/* Notes a value of the residual `name`, and makes the residual at its first value. A NaN counts as infinite. */
void iso_checker_note(iso_residuals *found, const char *name, const char *what, double value, size_t row);

/* A number of the row in the column of a trajectory. */
static inline double iso_checker_at(const checker *c, const double row[], int column)
{
    return row[c->columns[column]];
}

/* The effects of a model's orbit. A point shows nothing that belongs to the ball alone, and its level follows from
 * each row if eps is known. */
iso_effects iso_checker_effects(const checker *c, iso_model_kind kind);

/* --- check_flow.c ----------------------------------------------------------------------------------------------- */

/* At the first row. Errors: ISO_NO_MEMORY. */
iso_status iso_checker_flow_begin(checker *c, checked_model *m, const double first[]);

/* From the last row to this one. Errors: those of iso_check. */
iso_status iso_checker_flow(checker *c, checked_model *m, const double row[]);

/* --- check_effects.c -------------------------------------------------------------------------------------------- */

/* Of the effects of the lines, and of those whose columns are there, keeps the observers that can be checked. */
void iso_checker_choose_observers(checker *c);

/* Whether any column of an effect is checked. */
bool iso_checker_has_effects(const checker *c);

/* What moves along a plane goes on from the row in which the flow began. */
void iso_checker_go_on(const checker *c, const double row[], iso_sample *flow);

/* Compares the columns of effects in a row with the flow from the last row, relative to the group's largest. */
void iso_checker_effects_flow(checker *c, iso_residuals *found, const iso_sample *flow, const double row[]);

/* The energy that lines state (h, eps, the level's c), against the first row of a model. Errors: ISO_BAD_INPUT about
 * a line. */
iso_status iso_checker_energy(checker *c, checked_model *m, const double first[]);

/* The numbers of lines that turn with the ball, such as `# gravity.up`, against the columns of a row at time 0. */
void iso_checker_beginning(checker *c, checked_model *ball, const double row[]);

/* --- the study (check_study.c) ---------------------------------------------------------------------------------- */

typedef struct iso_check_request {
    iso_file_parameters added;
    double tolerance, bound; /* bound NAN: not given */
} iso_check_request;

#define ISO_CHECK_UNSET                                                                                              \
    {                                                                                                                \
        .added = ISO_FILE_PARAMETERS_UNSET, .tolerance = 1e-13, .bound = NAN                                         \
    }

/* A residual, and the bound that it is held to. */
typedef struct iso_checked {
    iso_residual residual;
    double bound;
} iso_checked;

/* What the study finds; a name of what is not looked at. */
enum { ISO_UNSEEN_SIZE = 560 };
typedef struct iso_check_found {
    size_t rows, passed;
    double bound;
    int count;
    iso_checked checked[ISO_MAX_RESIDUALS];
    size_t unseen_count;
    char (*unseen)[ISO_UNSEEN_SIZE];
} iso_check_found;

#endif

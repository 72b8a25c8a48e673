/* convert.h - trajectories from one model to the other, row by row or whole.
 *
 * A record with the lines `k` and `J` (and `h` or `eps`) can be carried over and back: states row by row through (18),
 * the other model's clock from each row to the next. The columns are those of iso_column_name.
 */
#ifndef ISO_ORBIT_CONVERT_H
#define ISO_ORBIT_CONVERT_H

#include "description.h"

/* The most steps from one row of a record to the next: a damaged time must not keep a program busy for ever. */
enum { ISO_MAX_ROW_STEPS = 10000000 };

/* --- row by row ---------------------------------------------------------------------------------------------------
 *
 *     iso_conversion_create(ctx, &params, header, ISO_POINT, 1e-14, &target, &c);
 *     while (next(row)) status = iso_conversion_put(c, row, ++line);
 *     status = iso_conversion_end(c, &summary);
 *     iso_conversion_free(c);
 *
 * Between two rows the other clock goes on by two-point Taylor quadrature (method/between.h), which also tells whether
 * they lie on one orbit; where they are too far apart for it, the orbit is integrated. A row that breaks off from the
 * one before it is held until the next shows which of the two is damaged. Sums of times are compensated. */

/* Where results go, in the order of the rows. Each answers ISO_OK to go on; anything else ends the call with it. */
typedef struct iso_conversion_target {
    iso_status (*header)(void *data, const iso_record *header); /* columns and lines, once, before all rows */
    iso_status (*row)(void *data, const double row[]);          /* NULL: in the place of a bad one          */
    iso_status (*bad)(void *data, size_t line, iso_status why, const char *words);
    void *data;
} iso_conversion_target;

/* The worst of something, relative, and the line it was found at. */
typedef struct iso_worst {
    double value;
    size_t line;
} iso_worst;

typedef struct iso_conversion_summary {
    size_t rows, bad;      /* all rows, and those that could not be converted                                */
    iso_worst constraint;  /* | |n| - 1 |, (omega,n)/|omega| of a ball, and likewise of a point              */
    iso_worst energy;      /* |h - h of the first row|/(size of its terms); of a point H, from its level     */
    iso_worst defect;      /* from one row to the next: the orbit through the one against the other,
                              relative to each vector's length; of the other clock, if the record has it, the
                              way that the unit vector makes in the time by which it is wrong               */
    iso_worst drift;       /* the same, added up while the unit vector moves by half a radian: it grows where
                              the rows follow other equations, and averages where they are only rounded     */
    bool checked;          /* there was a clock to see defect and drift by                                   */
    size_t between, integrated; /* intervals by quadrature, and by integration                               */
    bool computed;         /* the other clock was                                                            */
    iso_clock clock;       /* that clock,                                                                    */
    double end, error;     /* where it ended, and its error there for the k and J stated, estimated from the
                              quadratures, the defects and the rounding of the sums: what a wrong k or J does
                              to it is not in it, but shows as drift                                        */
} iso_conversion_summary;

typedef struct iso_conversion iso_conversion;

typedef struct iso_conversion_options {
    double tolerance; /* relative, of the other clock's gain from row to row                                  */
    bool shift_J;     /* k = -1: a point off H = 0, of energy E by its first row, becomes the free ball with
                         moments J + E/eps, the same motion; else a ball in the potential of the effect level */
} iso_conversion_options;

/* header: columns and lines of what is converted; it must outlive the conversion and may gain lines. Its columns hold one
 * model's six. A clock of the other model that is there already is taken as it is; else it begins at 0 (or where
 * the line `t0` or `s0`, left by an earlier conversion, says); without any clock there is none in the result.
 * Errors: ISO_BAD_INPUT about columns or lines, ISO_NOT_MAPPED about an effect that breaks the isomorphism,
 * ISO_BAD_ARGUMENT (J cannot be shifted: k is not -1, or it is no point's), ISO_NO_MEMORY. */
iso_status iso_conversion_create(iso_context *ctx, const iso_params *params, const iso_record *header, iso_picture to,
                                 const iso_conversion_options *options, const iso_conversion_target *target,
                                 iso_conversion **conversion);
void iso_conversion_free(iso_conversion *conversion);

/* The next row. A point whose rows have one energy H off 0 becomes a ball in the potential of the effect `level`, which
 * the lines of the result then name. A row that is none (no state, at rest, a time that turns back, an energy that is
 * not that of the rows before) goes to target->bad. Errors: what the target answers; ISO_NO_MEMORY, ISO_STOPPED. */
iso_status iso_conversion_put(iso_conversion *conversion, const double row[], size_t line);

/* In the place of a row that could not even be read. */
iso_status iso_conversion_skip(iso_conversion *conversion);

/* After the last row. summary may be NULL. Errors: as for a row; where not one row could be converted, the reason why
 * the first could not. */
iso_status iso_conversion_end(iso_conversion *conversion, iso_conversion_summary *summary);

/* --- whole -------------------------------------------------------------------------------------------------------- */

/* Carries `in` over to the model `to`: clock, then the six columns, one row for each row of `in`. Lines are rows here.
 * Errors: ISO_BAD_INPUT with the row (a state that is none, times that do not run one way), ISO_NOT_MAPPED with the row
 * (at rest; a point whose M does not belong to the record's eps or h and to the energy of the first row), or about an
 * effect that breaks the isomorphism, ISO_NUMERICAL, ISO_NO_MEMORY. */
iso_status iso_convert(iso_context *ctx, const iso_params *params, const iso_record *in, iso_picture to,
                       double tolerance, iso_record **out);

#endif

/* file_parameters_impl.h - what options add to a trajectory that does not say it itself: k, J, eps or h. */
#ifndef ISO_STUDY_FILE_PARAMETERS_IMPL_H
#define ISO_STUDY_FILE_PARAMETERS_IMPL_H

#include <math.h>

#include "study/options_impl.h"

typedef struct iso_file_parameters {
    double k, J[3], eps, h; /* NAN: not given                        */
    double row_tolerance;   /* how far a row may be from a state */
} iso_file_parameters;

#define ISO_FILE_PARAMETERS_UNSET                                                                                    \
    {                                                                                                                \
        .k = NAN, .J = {NAN, NAN, NAN}, .eps = NAN, .h = NAN, .row_tolerance = ISO_ROW_TOLERANCE                     \
    }

/* Their rows, the last one by itself; `from` is the place of an iso_file_parameters in the struct `type`. */
#define ISO_OPTIONS_FILE_PARAMETERS(type, from)                                                                      \
    ISO_OPTION("k", "K", "a number", "geometry number k, if the file does not say it", iso_set_number, type,         \
               from.k),                                                                                              \
        ISO_OPTION("J", "J1,J2,J3", "three numbers J1,J2,J3",                                                        \
                   "moments about the contact point, if the file does not say them", iso_set_vector, type, from.J),  \
        ISO_OPTION("eps", "X", "a number", "coupling of the point's potential, if the file does not say it",         \
                   iso_set_number, type, from.eps),                                                                  \
        ISO_OPTION("h", "X", "a number", "energy of the ball, in place of eps", iso_set_number, type, from.h)
#define ISO_OPTION_ROW_TOLERANCE(type, from)                                                                         \
    ISO_OPTION("row-tolerance", "X", "a number in " ISO_TOLERANCE_RANGE,                                             \
               "largest error of a row's state (default 1e-5); more for rows of few digits", iso_set_tolerance,      \
               type, from.row_tolerance)

/* Puts into the record what is added (its lines, its row tolerance), and what the scene (NULL: none) says of k, J, D,
 * the effects that act and a point's eps, where the record does not. Then reads the parameters from the lines.
 * Errors: ISO_BAD_INPUT about a line that says something else; ISO_BAD_ARGUMENT about "eps" beside h; those of
 * iso_record_params. */
iso_status iso_file_parameters_apply(iso_context *ctx, const iso_file_parameters *added, const iso_scene *scene,
                                     iso_record *record, iso_params *params);

/* The energy h in own units that the line "h" states, or "eps" by its coupling. NAN: there is no such line, or *status
 * is an error. */
double iso_stated_energy(iso_context *ctx, const iso_record *record, const iso_units *units, const char *key,
                         iso_status *status);

#endif

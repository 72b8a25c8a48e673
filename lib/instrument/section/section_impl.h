/* section_impl.h - what the files of iso_section_run share.
 *
 *     section.c           what kind of section it is, what is refused
 *     section_walk.c      the orbits: the header, rows, the comparison of both models
 *     section_area.c      in place of rows: whether the return map keeps the area
 */
#ifndef ISO_INSTRUMENT_SECTION_SECTION_IMPL_H
#define ISO_INSTRUMENT_SECTION_SECTION_IMPL_H

#include "instrument/section/section.h"
#include "orbit/walk_impl.h"
#include "study/options_impl.h"

/* What is known of the orbit whose rows are given. */
typedef struct iso_section_member {
    size_t orbit;
    bool unequal, parted; /* one model has a crossing that the other one lacks  */
    double distance;      /* the largest so far between the models; its crossing */
    size_t crossing;
} iso_section_member;

typedef struct iso_section_walk {
    iso_context *ctx;
    const iso_scene *scene;
    const iso_sink *sink;
    iso_record **tables; /* NULL: no rows are kept */
    iso_section_result *result;
    iso_section_options options;
    iso_effects effects; /* of the scene; observers only if a column needs them   */
    iso_orbit *orbit;    /* the scene's own: its units, its energy                */
    iso_starts starts;
    bool areas;                          /* det D is asked for, with losses as well; no rows      */
    bool clocks, chart;                  /* rows have tau and s; l and x                          */
    int columns[ISO_MAX_COLUMNS], count; /* of the samples, behind those                   */
    int models;                          /* 1 or 2 ... */
    iso_model_kind model[2];             /* ... that are integrated; rows are the first one's     */
    bool begun[2];                       /* the sink has the header of this table */
    iso_walk walk;
    iso_section_member member;
} iso_section_walk;

/* Checks the options, and opens the scene's own orbit, which the caller frees, also after an error. Errors: those of
 * iso_section_run before the header. */
iso_status iso_section_begin(iso_section_walk *w, iso_context *ctx, const iso_scene *scene,
                             const iso_section_options *options);

/* Whether deviations can be carried from return to return: on a global section of a motion on which nothing acts but a
 * level. */
bool iso_section_has_returns(const iso_section_walk *w);

/* The walk of all orbits by one model (0: the first). Its visitor is to be set. */
iso_walk iso_section_plan(iso_section_walk *w, int model);

/* Finds all crossings and passes the rows to the sink. Errors: of the sink, ISO_STOPPED, ISO_NO_MEMORY. */
iso_status iso_section_walk_all(iso_section_walk *w);

/* The nature of n_a = 0 for this orbit (axis: 0 to 2, or ISO_AXIS_AUTO). */
iso_section_nature iso_section_of(const iso_orbit *orbit, int axis);

/* Whether an event is a section n_a = 0: the column is n_a or gamma_a, and the value is 0. Sets *axis if so. */
bool iso_section_is_of_axis(int column, double value, int *axis);

/* The distance of two crossings in the chart: the larger one of |dl|, modulo 2 pi, and |dx|. */
double iso_section_distance(const iso_crossing *a, const iso_crossing *b);

/* The rotation number of an orbit by its crossings (l, x) in their order: the mean turn from one to the next, from 0 to
 * 1/2, about the axis; of an orbit that stays in a part of the circle of l, about its centre. NaN: there is none, as of
 * a chaotic orbit, or there are too few crossings to tell. */
double iso_section_rotation(const double (*z)[2], size_t count);

/* The options of the study. */
typedef struct iso_section_request {
    iso_section_options how;
    iso_section_words words;
    const char *event; /* COLUMN=VALUE */
    bool area;
} iso_section_request;

/* --- whether the return map keeps the area dL dl (section_area.c) --------------------------------------------- */

/* One orbit by one model. */
typedef struct iso_section_area {
    size_t orbit;
    iso_model_kind model;
    long turns;       /* that were computed                                                                       */
    double worst;     /* |det D - 1|, where it is largest against its bound: what ...                             */
    double bound;     /* ... errors of the integration explain there                                              */
    const char *kept; /* "kept", "not kept" or "undecided"                                                        */
    const char *why;  /* it ended early; NULL: it did not                                                         */
} iso_section_area;

typedef struct iso_section_areas {
    bool returns; /* det D is computed at the returns; else at equal steps of a clock, about a turn each */
    size_t count;
    iso_section_area *orbit;
    char words[512]; /* of the first orbit that failed */
} iso_section_areas;

/* The orbits of the section, each by all models that are asked for. Without the section's chart (an effect beyond the
 * level), by equal steps of a clock: det D is that of the flow between planes across it. Errors: those of
 * iso_section_run, but effects that take energy are welcome; ISO_BAD_INPUT about an effect with states of its own, or
 * a twist. iso_section_areas_free also after an error. */
iso_status iso_section_areas_find(iso_context *ctx, const iso_scene *scene, const iso_section_options *options,
                                  void (*progress)(void *data, double part), void *data, iso_section_areas *areas);
void iso_section_areas_free(iso_section_areas *areas);

/* Its text (section_print.c). */
void iso_section_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result);

#endif

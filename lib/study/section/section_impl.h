/* section_impl.h - what the files of iso_section_run share.
 *
 *     section.c           checks, the groups of orbits
 *     section_walk.c      one group: its starts, its crossings by one model or two, its rows; the header
 */
#ifndef ISO_STUDY_SECTION_IMPL_H
#define ISO_STUDY_SECTION_IMPL_H

#include "map/section_impl.h"
#include "study/options_impl.h"
#include "study/section/measure.h"
#include "study/section/section.h"

/* What is known of one orbit of the group. */
typedef struct iso_section_member {
    size_t found[2]; /* crossings, by the first model and by the second       */
    bool failed, parted;
    double distance; /* the largest so far between the models; its crossing   */
    size_t crossing;
} iso_section_member;

/* The axis and the starts that are typed; the caller frees words->points. Errors: ISO_BAD_ARGUMENT. */
iso_status iso_section_words_read(iso_context *ctx, iso_section_words *words, int *axis, const double (**at)[2],
                                  size_t *count);

typedef struct iso_section_walk {
    iso_context *ctx;
    const iso_scene *scene;
    const iso_section_sink *sink;
    iso_section_result *result;
    iso_section_options options;
    iso_effects effects; /* of the scene; observers only if a column needs them   */
    iso_orbit *orbit;    /* the scene's own: its units, its energy                */
    iso_section_spread spread;
    bool clocks, chart;                  /* rows have tau and s; l and x                          */
    int columns[ISO_MAX_COLUMNS], count; /* of the samples, behind those                   */
    int models;                          /* 1 or 2 ... */
    iso_model_kind model[2];             /* ... that are integrated; rows are the first one's     */
    bool begun;                          /* the sink has the header */
    /* the group */
    size_t group, slice, slices; /* orbits in it; crossings asked for at a time; slices kept in memory */
    size_t first, members;
    iso_start *start;
    iso_batch_orbit *batch;
    iso_section_member *member;
    iso_crossings *crossings[2];
    iso_crossing *crossing[2]; /* [slice][orbit][crossing]                              */
    iso_sample *sample;        /* likewise, of the first model; NULL: no column needs it */
    size_t *done[2];           /* [slice][orbit]                                        */
    iso_status *status[2];
} iso_section_walk;

/* Gives the header to the sink. This is done just before the first row: a scene without crossings opens no file. */
iso_status iso_section_give_header(iso_section_walk *w);

/* Room for a group. Errors: ISO_NO_MEMORY. */
iso_status iso_section_make_room(iso_section_walk *w);
void iso_section_free_room(iso_section_walk *w);

/* Begins the group whose first orbit is w->first. Errors: those of iso_crossings_create. */
iso_status iso_section_open_group(iso_section_walk *w);
void iso_section_close_group(iso_section_walk *w);

/* Finds the crossings of the group and gives the rows to the sink. Errors: of the sink, ISO_STOPPED,
 * ISO_NO_MEMORY. */
iso_status iso_section_walk_group(iso_section_walk *w);

/* States the level of the orbit among the effects: then every start is on it, not near it. */
void iso_section_state_level(const iso_orbit *orbit, iso_effects *effects);

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

/* What the options of the study hold. */
typedef struct iso_section_request {
    iso_section_options how;
    iso_section_words words;
    const char *event; /* COLUMN=VALUE */
    double cloud;      /* 0: not given */
} iso_section_request;

/* A test of the invariant measure, and those that the study finds: by the flow in t, by the flow in s if the ball has
 * a twin, and by returns to the section. */
typedef struct iso_cloud {
    const char *what;
    iso_measure measure;
    char why[256]; /* why it was not tried; "": it was */
} iso_cloud;

enum { ISO_CLOUDS = 3 };
typedef struct iso_clouds {
    int count;
    iso_cloud cloud[ISO_CLOUDS];
} iso_clouds;

#endif

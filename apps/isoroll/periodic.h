/* periodic.h - what `isoroll periodic` can be told, and its parts: the list of orbits, --follow and --chart. */
#ifndef ISOROLL_PERIODIC_H
#define ISOROLL_PERIODIC_H

#include "scene_options.h"
#include "study/periodic/periodic.h"
#include "table.h"

typedef struct periodic_options {
    iso_periodic_options study;
    scene_options scene;       /* only its file is used                                             */
    const char *output, *plot; /* NULL: not given, also of the others                               */
    const char *follow;        /* "k=0.4:0.6"                                                       */
    const char *chart;         /* "J2", "J3=1:4", "level=-1:1": which one varies, and where         */
    const char *k, *level;     /* of the chart: "A:B", -3:3 if it is not given; the scene's level if not */
    int steps;                 /* of the chart                                                      */
    double orbit;              /* to follow, from 1; 0: all with a symmetry                         */
    bool json, branches;
} periodic_options;

void periodic_print(const periodic_options *o, const iso_scene *scene, const iso_periodic *found);

/* A table to be freed, with a row for each orbit; whole: for each crossing of each orbit, as it is drawn. */
iso_status periodic_table(iso_context *ctx, const iso_scene *scene, const iso_periodic *found, bool whole,
                          iso_record **table);

/* "A:B", A < B. False: it is none. */
bool read_range(const char *text, double range[2]);

/* Whether "k=0.4:0.6" can be followed from this scene. */
iso_status follow_check(iso_context *ctx, const iso_scene *scene, const char *range);

/* Both write their table to `rows` (NULL: nowhere), close it, and give the exit status. */
int follow_orbits(iso_context *ctx, const periodic_options *o, const iso_scene *scene, const iso_periodic *found,
                  iso_table_writer *rows);
int draw_chart(iso_context *ctx, const periodic_options *o, const iso_scene *scene, iso_table_writer *rows);

#endif

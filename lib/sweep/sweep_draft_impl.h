/* sweep_draft_impl.h - a sweep's text, as its files share it: sweep_file.c reads its keys, sweep_vary.c what varies,
 * sweep_point.c makes the points. */
#ifndef ISO_SWEEP_SWEEP_DRAFT_IMPL_H
#define ISO_SWEEP_SWEEP_DRAFT_IMPL_H

#include "io/scene_draft_impl.h"
#include "map/section.h"
#include "sweep/sweep_impl.h"

enum { ISO_SWEEP_AXES = 24, ISO_SWEEP_NAMES = 64, ISO_SWEEP_DRAWN = 8, ISO_SWEEP_SETTINGS = 6 };

/* A number or a word in a mapping of a sweep file. */
typedef struct iso_sweep_setting {
    const char *name;           /* NULL ends a list                                                     */
    const char *(*word)(int i); /* the words that it can be: the setting is then i; NULL: it is a number */
    double usual;               /* where the file does not say it                                       */
    double least, most;         /* of a number; both 0: any                                              */
    bool whole, flag;           /* the number is whole; true or false                                    */
    const char *missing;        /* it must be there, or it is "missing in ..."; NULL: it may be absent   */
} iso_sweep_setting;

/* Where the values of an axis go. */
typedef enum iso_axis_target {
    ISO_TO_NUMBER, /* numbers of the draft  */
    ISO_TO_RATIO,  /* J[part] = value J[of] */
    ISO_TO_LEVEL,  /* iso_scene_on_level    */
    ISO_TO_CHART   /* l, x, or both         */
} iso_axis_target;

/* Where they come from. */
typedef enum iso_axis_values {
    ISO_FROM_LIST,
    ISO_FROM_RANGE,
    ISO_FROM_DRAWING, /* a range without a count */
    ISO_FROM_TRIANGLE,
    ISO_FROM_SPREAD
} iso_axis_values;

/* One key of `vary`. */
typedef struct iso_sweep_axis {
    char name[2 * ISO_NAME_SIZE]; /* as in the file                          */
    iso_axis_target target;
    iso_axis_values values;
    int width;  /* numbers of one value: 1, 2 (l, x), 3 or 9                   */
    int column; /* of its first number                                         */
    size_t offset;
    int part;     /* it sets the numbers from this one on, of one or of a vector   */
    int of;       /* ISO_TO_RATIO                                                  */
    int moments;  /* of inertia that it sets, as bits                              */
    int chart;    /* ISO_TO_CHART: 0 l, 1 x, 2 both                                */
    size_t count; /* of values; 1 of those that are drawn                          */
    double *list; /* count * width                                                 */
    double from, to;
    bool logarithmic, ordered;
    long sum; /* of a triangle */
    uint64_t seed;
    int drawn; /* its number among those that are drawn */
} iso_sweep_axis;

struct iso_sweep_file {
    char *name, *text, *scene_name, *scene_text; /* scene_*: of the scene's own file; NULL: it is part of the sweep */
    iso_draft draft; /* of the scene; its yaml is read by all threads, with contexts of their own */
    iso_yaml yaml;   /* of the sweep                                                              */
    iso_scene base;  /* of the text as it is */
    int axes;
    iso_sweep_axis axis[ISO_SWEEP_AXES];
    bool on_section;             /* l and x are among them */
    const iso_sweep_axis *level; /* NULL: it does not vary */
    size_t samples;
    bool random;
    int drawn;
    uint64_t step[ISO_SWEEP_DRAWN], shift[ISO_SWEEP_DRAWN];
    char (*column)[ISO_NAME_SIZE]; /* room for 9 of each axis */
    iso_sweep_plan plan;
};

/* sweep_vary.c: reads `vary` and `samples` (NULL: not there), after the scene. Errors: ISO_BAD_INPUT,
 * ISO_NO_MEMORY. */
iso_status iso_sweep_read_vary(iso_sweep_file *f, const yaml_node_t *vary, const yaml_node_t *samples);

/* Reads a mapping, which has no other keys than these settings: setting i becomes value[i]. settings NULL: it is
 * empty. Errors: ISO_BAD_INPUT. */
iso_status iso_sweep_read_mapping(iso_yaml *y, const yaml_node_t *mapping, const char *what,
                                  const iso_sweep_setting settings[], double value[]);

/* Value j of a range of a->count values; with equal steps 0.1, 0.2, ... are what one writes. */
double iso_sweep_in_range(const iso_sweep_axis *a, size_t j);

/* sweep_point.c: the scene of point i, and its numbers. */
iso_status iso_sweep_point(iso_context *ctx, const void *file, size_t i, iso_scene *scene, double numbers[]);

#endif

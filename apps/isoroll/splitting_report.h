/* splitting_report.h - how `isoroll splitting` shows what it has found. */
#ifndef ISOROLL_SPLITTING_REPORT_H
#define ISOROLL_SPLITTING_REPORT_H

#include <stdbool.h>
#include <stdio.h>

#include "io/output.h"
#include "isoroll.h"
#include "study/separatrix/separatrix.h"

/* What is shown. */
typedef struct splitting_report {
    const iso_scene *scene;
    const double *J;
    const iso_separatrix_table *found;
} splitting_report;

/* Whether the rows differ in the level, not in k. */
bool splitting_is_by_level(const iso_separatrix_table *s);

/* False: every row failed, and there is nothing to show. */
bool splitting_has_rows(const splitting_report *r);

void splitting_print(const splitting_report *r);

/* False: there is no memory. */
bool splitting_print_json(const splitting_report *r);

/* One row for each k or level that did not fail, then one for each zero. */
iso_status splitting_write_csv(iso_context *ctx, const splitting_report *r, iso_output *to);

/* |m| over k or the level, where there are several rows, and both curves of one of them. */
iso_status splitting_draw(iso_context *ctx, const splitting_report *r, const char *path);

#endif

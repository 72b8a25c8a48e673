/* periodic_report.h - how `isoroll periodic` shows what it has found. */
#ifndef ISOROLL_PERIODIC_REPORT_H
#define ISOROLL_PERIODIC_REPORT_H

#include <stdbool.h>
#include <stdio.h>

#include "io/output.h"
#include "isoroll.h"
#include "study/periodic/periodic.h"

/* What the table is made of; polish: all digits. */
typedef struct periodic_report {
    const iso_scene *scene;
    const iso_periodic *found;
    bool polish, all; /* all: orbits without a symmetry as well */
} periodic_report;

void periodic_print(const periodic_report *r);

/* One row for each orbit. Ends the file. */
iso_status periodic_write_csv(iso_context *ctx, const periodic_report *r, iso_output *to);

/* All orbits and their copies on the section. */
iso_status periodic_draw(iso_context *ctx, const periodic_report *r, const char *path);

#endif

/* splitting_report.h - how `isoroll splitting` shows what it has found. */
#ifndef ISOROLL_SPLITTING_REPORT_H
#define ISOROLL_SPLITTING_REPORT_H

#include "study/separatrix/separatrix.h"
#include "table.h"

/* Whether the rows differ in the level, not in k. */
bool splitting_is_by_level(const iso_separatrix_table *s);

/* False: every row failed, and there is nothing to show. */
bool splitting_has_rows(const iso_separatrix_table *s);

void splitting_print(const iso_scene *scene, const iso_separatrix_table *s);

/* False: there is no memory. */
bool splitting_print_json(const iso_scene *scene, const iso_separatrix_table *s);

/* Writes the table to the open file (NULL: there is none), with a row for each k or level that did not fail and
 * one for each zero, and draws it (plot NULL: not): |m| over k or the level, where there are several rows, and
 * both curves of one of them. Without rows no trace of the file is left. Gives the exit status. */
int splitting_save(iso_context *ctx, const iso_scene *scene, const iso_separatrix_table *s, iso_table_writer *to,
                   const char *plot);

#endif

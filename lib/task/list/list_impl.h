/* list_impl.h - what there is: the text of `isoroll list`, and the tables that studies make, with their columns.
 *
 *     const iso_result_table *t;
 *     for (int i = 0; (t = iso_result_table_at(i)); i++) iso_columns_visit(t->fields, NULL, show, NULL);
 */
#ifndef ISO_TASK_LIST_LIST_IMPL_H
#define ISO_TASK_LIST_LIST_IMPL_H

#include <stdio.h>

#include "base/context.h"
#include "base/field.h"

/* The i-th topic: "systems", "backends", ...; NULL past the last. */
const char *iso_list_topic(int i);

/* Writes all of a topic (NULL: of every topic). Errors: ISO_BAD_ARGUMENT about "topic": there is no such one. */
iso_status iso_list_print(iso_context *ctx, const char *topic, FILE *to);

typedef struct iso_result_table {
    const char *kind; /* as in the first line of its file, "# isoroll KIND 1" */
    const char *doc;  /* what a row is                                        */
    const iso_field *fields;
    bool in_memory; /* iso_study_ask_text makes it, but no command writes it to a file */
} iso_result_table;

/* The i-th table; NULL past the end. */
const iso_result_table *iso_result_table_at(int i);

#endif

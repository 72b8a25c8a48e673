/* list_impl.h - what there is, in words: what `isoroll list` prints. */
#ifndef ISO_STUDY_LIST_IMPL_H
#define ISO_STUDY_LIST_IMPL_H

#include <stdio.h>

#include "base/context.h"

/* The i-th topic: "systems", "backends", ...; NULL past the last. */
const char *iso_list_topic(int i);

/* Writes all of a topic (NULL: of every topic). Errors: ISO_BAD_ARGUMENT about "topic": there is no such one. */
iso_status iso_list_print(iso_context *ctx, const char *topic, FILE *to);

#endif

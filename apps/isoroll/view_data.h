/* view_data.h - the data of a page as JSON: numbers one by one, columns as base64 of little-endian doubles. */
#ifndef ISOROLL_VIEW_DATA_H
#define ISOROLL_VIEW_DATA_H

#include <jansson.h>

#include "view.h"

/* The caller releases it. If memory is short, parts are missing; json_whole() then says so. */
json_t *view_data(const view_page *page);

#endif

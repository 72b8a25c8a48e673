/* json.h - what the commands need to print JSON, beside jansson. */
#ifndef ISOROLL_JSON_H
#define ISOROLL_JSON_H

#include <jansson.h>
#include <stdbool.h>

/* Call it before any other function of jansson. */
void json_begin(void);

/* A number. JSON has no infinity and no nan: they become null. */
json_t *json_number(double x);

/* Memory for what goes into JSON; release it by free(). NULL: no memory. Then json_whole() and json_print() return
 * false. */
void *json_allocate(size_t size);

/* Whether o is complete. False: memory was short at some time since json_begin(). */
bool json_whole(const json_t *o);

/* Prints o and frees it. False: there is no memory for all of it; then nothing is printed, and a message says so. */
bool json_print(json_t *o);

#endif

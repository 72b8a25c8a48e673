/* json.h - what the commands need to print JSON: results become JSON through their fields (base/field.h). */
#ifndef ISOROLL_JSON_H
#define ISOROLL_JSON_H

#include <jansson.h>
#include <stdbool.h>

#include "api/typed_impl.h"
#include "study/fields_impl.h"

/* Call it before any other function of jansson. */
void json_begin(void);

/* A number. JSON has no infinity and no nan: they become null. */
json_t *json_number(double x);

/* A text in which bytes that are no UTF-8 become question marks: JSON has only UTF-8. */
json_t *json_text(const char *text);

/* An object: the version of isoroll, then a result. JSON has no infinity and no nan: they become null. */
json_t *json_of(const iso_field *fields, const void *row);

/* The same, with k and J behind the version. */
json_t *json_of_scene(const iso_scene *scene, const iso_field *fields, const void *row);

/* Adds the members of a struct to an object. */
void json_add(json_t *o, const iso_field *fields, const void *row);

/* Adds one member, "a.b": to the object a in o. */
void json_put(json_t *o, const char *name, json_t *value);

/* The effects that act, with their numbers: those of trajectory files, or all. */
json_t *json_effects(const iso_effects *effects, bool all);

/* Memory for what goes into JSON; release it by free(). NULL: no memory. Then json_whole() and json_print() return
 * false. */
void *json_allocate(size_t size);

/* Whether o is complete. False: memory was short at some time since json_begin(). */
bool json_whole(const json_t *o);

/* Prints o and frees it. False: there is no memory for all of it; then nothing is printed, and a message says so. */
bool json_print(json_t *o);

#endif

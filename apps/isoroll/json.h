/* json.h - what --json prints, made with jansson. */
#ifndef ISOROLL_JSON_H
#define ISOROLL_JSON_H

#include <jansson.h>
#include <stdbool.h>

/* Before any other call of jansson. */
void json_begin(void);

/* Prints o and gives it back. False: no memory for all of it; nothing is printed, and that is complained of. */
bool json_print(json_t *o);

#endif

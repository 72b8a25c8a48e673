/* json.c - prints JSON: all of it, or nothing (see json.h). */
#include "json.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "report.h"

static bool lacking; /* jansson leaves out what it has no memory for, and does not say so */

void *json_allocate(size_t size)
{
    void *block = malloc(size);
    lacking = lacking || !block;
    return block;
}

void json_begin(void)
{
    json_set_alloc_funcs(json_allocate, free);
}

json_t *json_number(double x)
{
    return isfinite(x) ? json_real(x) : json_null();
}

bool json_whole(const json_t *o)
{
    return o && !lacking;
}

bool json_print(json_t *o)
{
    char *text = o ? json_dumps(o, JSON_INDENT(1) | JSON_REAL_PRECISION(17)) : NULL;
    const bool whole = text && !lacking;
    if (whole)
        puts(text);
    else
        complain("no memory for --json");
    free(text);
    json_decref(o);
    return whole;
}

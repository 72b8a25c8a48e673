/* json.c - makes JSON of results and prints it: all of it, or nothing (see json.h). */
#include "json.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

json_t *json_text(const char *text)
{
    json_t *made = json_string(text);
    if (made) return made;
    char *copy = json_allocate(strlen(text) + 1);
    if (copy) memcpy(copy, text, strlen(text) + 1);
    for (char *c = copy; c && *c; c++)
        if ((unsigned char)*c >= 0x80) *c = '?';
    made = copy ? json_string(copy) : NULL;
    free(copy);
    return made;
}

/* All columns of a record. */
static json_t *columns_of(const iso_record *r)
{
    json_t *o = json_object();
    for (size_t c = 0; c < iso_record_columns(r); c++) {
        json_t *column = json_array();
        for (size_t i = 0; i < iso_record_rows(r); i++)
            json_array_append_new(column, json_number(iso_record_const_row(r, i)[c]));
        json_object_set_new(o, iso_record_name(r, c), column);
    }
    return o;
}

json_t *json_effects(const iso_effects *effects, bool all)
{
    json_t *o = json_object();
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        if (!effects->on[e]) continue;
        json_t *numbers = json_object();
        const char *const *name = iso_effect_list[e]->expressions;
        iso_effect_number n;
        for (int i = 0; name && name[i]; i++)
            if (iso_written_has(effects, e, i))
                json_object_set_new(numbers, name[i],
                                    json_text(effects->written[iso_effect_list[e]->written].expression[i]));
        for (int j = 0; iso_effect_number_at(effects, e, j, &n); j++) {
            json_t *list = json_array();
            const double *x = iso_effect_values(effects, e, &n);
            const bool word = n.kind == ISO_NUMBER_WORD;
            for (int i = 0; i < n.count; i++)
                json_array_append_new(list, word ? json_text(n.word((int)x[i])) : json_number(x[i]));
            if (all || !n.scene_only) json_object_set(numbers, n.name, list);
            json_decref(list);
        }
        json_object_set_new(o, iso_effect_list[e]->name, numbers);
    }
    return o;
}

/* --- results ---------------------------------------------------------------------------------------------------- */

static json_t *value_of(const iso_field *f, const void *row, int i)
{
    iso_value v;
    iso_field_read(f, row, i, &v);
    if (!v.there) return json_null();
    if (v.text) return json_text(v.text);
    if (f->type == ISO_FIELD_BOOL) return json_boolean(v.number != 0);
    return f->type == ISO_FIELD_REAL ? json_number(v.number) : json_integer((json_int_t)v.number);
}

/* Several numbers are an object if each has a name, else an array. */
static json_t *values_of(const iso_field *f, const void *row)
{
    if (f->count <= 1) return value_of(f, row, 0);
    json_t *all = f->word ? json_object() : json_array();
    for (int i = 0; i < f->count; i++)
        if (f->word)
            json_object_set_new(all, f->word(i), value_of(f, row, i));
        else
            json_array_append_new(all, value_of(f, row, i));
    return all;
}

/* A struct of one member without a name is that member. */
static json_t *struct_of(const iso_field *fields, const void *row)
{
    if (!*fields->name && !fields[1].name) return values_of(fields, row);
    json_t *o = json_object();
    json_add(o, fields, row);
    return o;
}

static json_t *member_of(const iso_field *f, const void *row)
{
    if (f->type == ISO_FIELD_STRUCT) {
        const void *inner = iso_field_struct(f, row); /* NULL: without a name, its members are null */
        return inner || !*f->name ? struct_of(f->fields, inner) : json_null();
    }
    if (!iso_field_is_there(f, row)) return json_null();
    if (f->type == ISO_FIELD_RECORD)
        return columns_of(*(iso_record *const *)(const void *)((const char *)row + f->offset));
    if (f->type != ISO_FIELD_LIST) return values_of(f, row);
    json_t *list = json_array();
    const void *item;
    for (size_t i = 0; (item = iso_field_item(f, row, i)); i++)
        if (!f->skip || !f->skip(item)) json_array_append_new(list, struct_of(f->fields, item));
    return list;
}

/* Puts a member at its place: "a.b" is the member b of the object a. */
void json_put(json_t *o, const char *name, json_t *value)
{
    char outer[ISO_COLUMN_SIZE];
    for (const char *dot; (dot = strchr(name, '.')); name = dot + 1) {
        snprintf(outer, sizeof outer, "%.*s", (int)(dot - name), name);
        if (!json_object_get(o, outer)) json_object_set_new(o, outer, json_object());
        o = json_object_get(o, outer);
    }
    json_object_set_new(o, name, value);
}

void json_add(json_t *o, const iso_field *fields, const void *row)
{
    for (const iso_field *f = fields; f->name; f++) {
        if (f->how & ISO_IN_TABLE) continue;
        iso_value v = {.there = true};
        const bool many = f->type >= ISO_FIELD_STRUCT || f->count > 1;
        if (f->how & ISO_OPTIONAL && !many) iso_field_read(f, row, 0, &v); /* a nan is not there */
        if (f->how & ISO_OPTIONAL && !(many ? iso_field_is_there(f, row) : v.there)) continue;
        json_t *value = member_of(f, row);
        if (*f->name)
            json_put(o, f->name, value);
        else
            json_object_update_new(o, value);
    }
}

json_t *json_of(const iso_field *fields, const void *row)
{
    json_t *o = json_object();
    json_put(o, "isoroll", json_string(iso_version()));
    json_add(o, fields, row);
    return o;
}

json_t *json_of_scene(const iso_scene *scene, const iso_field *fields, const void *row)
{
    static const iso_field numbers[] = {ISO_MEMBER(iso_params, "k", k, "", "geometry number"),
                                        ISO_MEMBER(iso_params, "J", J, "moment of inertia", "about the contact"),
                                        ISO_FIELD_END};
    json_t *o = json_of(numbers, &scene->params);
    json_add(o, fields, row);
    return o;
}

/* --- printing --------------------------------------------------------------------------------------------------- */

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
        warn("no memory for --json");
    free(text);
    json_decref(o);
    return whole;
}

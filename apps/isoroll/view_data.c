/* view_data.c - the data of a page as JSON (see view_data.h). */
#include "view_data.h"

#include <stdlib.h>
#include <string.h>

#include "base/version.h"
#include "json.h"

/* --- base64 ----------------------------------------------------------------------------------------------------- */

/* The bytes of numbers in base64; a json string, NULL: no memory. */
static json_t *base64(const unsigned char *bytes, size_t count)
{
    static const char digit[] = VIEW_BASE64;
    char *text = json_allocate((count + 2) / 3 * 4 + 1), *to = text;
    if (!text) return NULL;
    for (size_t i = 0; i < count; i += 3) {
        const unsigned second = i + 1 < count ? bytes[i + 1] : 0, third = i + 2 < count ? bytes[i + 2] : 0;
        const unsigned group = (unsigned)bytes[i] << 16 | second << 8 | third;
        *to++ = digit[group >> 18];
        *to++ = digit[group >> 12 & 63];
        *to++ = i + 1 < count ? digit[group >> 6 & 63] : '=';
        *to++ = i + 2 < count ? digit[group & 63] : '=';
    }
    json_t *made = json_stringn_nocheck(text, (size_t)(to - text));
    free(text);
    return made;
}

/* Numbers, little-endian. */
static json_t *packed(size_t count, const double numbers[])
{
    unsigned char *bytes = json_allocate(8 * count + 1);
    if (!bytes) return NULL;
    for (size_t i = 0; i < count; i++) {
        uint64_t bits;
        memcpy(&bits, &numbers[i], sizeof bits);
        for (size_t b = 0; b < 8; b++) bytes[8 * i + b] = (unsigned char)(bits >> 8 * b);
    }
    json_t *made = base64(bytes, 8 * count);
    free(bytes);
    return made;
}

static json_t *column_of(const iso_record *r, size_t column)
{
    const size_t rows = iso_record_rows(r);
    double *numbers = json_allocate(rows * sizeof *numbers + 1);
    for (size_t i = 0; numbers && i < rows; i++) numbers[i] = iso_record_const_row(r, i)[column];
    json_t *made = numbers ? packed(rows, numbers) : NULL;
    free(numbers);
    return made;
}

static json_t *columns_of(const iso_record *r)
{
    json_t *o = json_object();
    for (size_t i = 0; i < iso_record_columns(r); i++) json_object_set_new(o, iso_record_name(r, i), column_of(r, i));
    return o;
}

/* --- text ------------------------------------------------------------------------------------------------------- */

/* A text in which bytes that are no UTF-8 become question marks: JSON has only UTF-8. */
static json_t *text_of(const char *text)
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

static json_t *numbers(size_t count, const double x[])
{
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++) json_array_append_new(list, json_number(x[i]));
    return list;
}

/* --- parts of the page ------------------------------------------------------------------------------------------ */

static json_t *effects_of(const iso_effects *effects)
{
    json_t *o = json_object();
    for (int e = 0; e < ISO_EFFECTS; e++) {
        if (!effects->on[e]) continue;
        json_t *of_one = json_object();
        for (const iso_effect_number *n = iso_effect_list[e]->numbers; n && n->name; n++)
            json_object_set_new(of_one, n->name,
                                numbers((size_t)n->count, iso_effect_values(effects, (iso_effect_id)e, n)));
        json_object_set_new(o, iso_effect_list[e]->name, of_one);
    }
    return o;
}

static json_t *integrals_of(const view_page *page)
{
    json_t *list = json_array();
    for (int i = 0; i < page->integrals; i++) {
        const view_integral *v = &page->integral[i];
        const iso_dimension d = v->integral->dimension;
        json_t *o = json_pack("{s:s,s:s,s:s,s:[i,i,i]}", "name", v->integral->name, "doc", v->integral->doc, "model",
                              iso_model_kind_name((int)v->model), "dimension", d.J, d.J_2k, d.w);
        json_object_set_new(o, "start", json_number(v->start));
        json_object_set_new(o, "worst", json_number(v->worst));
        json_array_append_new(list, o);
    }
    return list;
}

static json_t *rows_of(const view_page *page)
{
    json_t *columns = columns_of(page->rows);
    if (page->drifts) json_object_update_new(columns, columns_of(page->drifts));
    if (page->apart) json_object_update_new(columns, columns_of(page->apart));
    json_t *o = json_object();
    json_object_set_new(o, "count", json_integer((json_int_t)iso_record_rows(page->rows)));
    json_object_set_new(o, "total", json_integer((json_int_t)page->total));
    json_object_set_new(o, "every", json_integer((json_int_t)page->every));
    json_object_set_new(o, "between", json_integer((json_int_t)page->between));
    json_object_set_new(o, "columns", columns);
    return o;
}

/* [number of the orbit, number of its crossings], one after the other. */
static json_t *counts_of(const iso_record *crossings)
{
    json_t *list = json_array();
    const size_t rows = iso_record_rows(crossings);
    for (size_t i = 0, first = 0; i < rows; i++) {
        const double orbit = iso_record_const_row(crossings, i)[0];
        if (i + 1 < rows && iso_record_const_row(crossings, i + 1)[0] == orbit) continue;
        json_array_append_new(list, json_pack("[I,I]", (json_int_t)orbit, (json_int_t)(i + 1 - first)));
        first = i + 1;
    }
    return list;
}

static json_t *section_of(const view_section *s)
{
    json_t *o = json_object(), *list = json_array();
    json_object_set_new(o, "axis", json_integer(s->axis));
    json_object_set_new(o, "total", json_integer((json_int_t)s->total));
    json_object_set_new(o, "orbits", json_integer((json_int_t)s->orbits));
    json_object_set_new(o, "counts", counts_of(s->crossings));
    json_object_set_new(o, "crossings", columns_of(s->crossings));
    json_object_del(json_object_get(o, "crossings"), "orbit");
    for (size_t i = 0; i < s->count; i++) {
        json_t *one = json_object();
        json_object_set_new(one, "number", json_integer((json_int_t)s->number[i]));
        json_object_set_new(one, "count", json_integer((json_int_t)iso_record_rows(s->orbit[i])));
        json_object_set_new(one, "columns", columns_of(s->orbit[i]));
        json_array_append_new(list, one);
    }
    json_object_set_new(o, "list", list);
    return o;
}

/* --- the whole -------------------------------------------------------------------------------------------------- */

json_t *view_data(const view_page *page)
{
    json_t *o = json_object(), *notes = json_array();
    for (int i = 0; i < page->notes; i++) json_array_append_new(notes, text_of(page->note[i]));
    json_object_set_new(o, "title", text_of(page->title));
    json_object_set_new(o, "kind", json_string(page->kind));
    json_object_set_new(o, "version", json_string(ISO_VERSION));
    json_object_set_new(o, "k", json_number(page->params.k));
    json_object_set_new(o, "J", numbers(3, page->params.J));
    json_object_set_new(o, "radius", json_number(page->params.body.radius));
    json_object_set_new(o, "eps", json_number(page->eps));
    json_object_set_new(o, "h", json_number(page->h));
    json_object_set_new(o, "clock", json_string(iso_clock_name(page->clock)));
    json_object_set_new(o, "alone", text_of(page->alone));
    json_object_set_new(o, "notes", notes);
    json_object_set_new(o, "effects", effects_of(&page->effects));
    json_object_set_new(o, "integrals", integrals_of(page));
    if (page->rows) json_object_set_new(o, "rows", rows_of(page));
    if (page->section) json_object_set_new(o, "section", section_of(page->section));
    return o;
}

/* view_data.c - the data of a page as JSON (see view.h). */
#include <stdlib.h>
#include <string.h>

#include "base/version.h"
#include "json.h"
#include "view.h"

/* --- columns ---------------------------------------------------------------------------------------------------- */

/* Byte i of the numbers of a column, little-endian; 0 behind them. */
static unsigned byte_of(const iso_record *r, size_t column, size_t i)
{
    uint64_t bits = 0;
    if (i / 8 < iso_record_rows(r)) memcpy(&bits, iso_record_const_row(r, i / 8) + column, sizeof bits);
    return (unsigned)(bits >> 8 * (i % 8)) & 0xFF;
}

/* A column in base64; a json string, NULL: no memory. */
static json_t *column_of(const iso_record *r, size_t column)
{
    const size_t bytes = 8 * iso_record_rows(r), length = (bytes + 2) / 3 * 4;
    char *text = json_allocate(length + 1);
    for (size_t i = 0; text && i < length; i++) {
        const size_t first = i / 4 * 3, digit = i % 4;
        const unsigned group =
            byte_of(r, column, first) << 16 | byte_of(r, column, first + 1) << 8 | byte_of(r, column, first + 2);
        text[i] = first + digit > bytes ? '=' : VIEW_BASE64[group >> (18 - 6 * digit) & 63];
    }
    json_t *made = text ? json_stringn_nocheck(text, length) : NULL;
    free(text);
    return made;
}

static json_t *columns_of(const iso_record *r)
{
    json_t *o = json_object();
    for (size_t i = 0; i < iso_record_columns(r); i++) json_put(o, iso_record_name(r, i), column_of(r, i));
    return o;
}

/* What is known of an orbit's fate, and its neighbour: into the object of its rows. */
static void put_fate(json_t *o, const view_fate *fate, const iso_record *beside)
{
    if (beside) json_object_update_new(json_object_get(o, "columns"), columns_of(beside));
    if (!fate->known) return;
    json_put(o, "verdict", json_string(iso_verdict_name(fate->verdict)));
    json_put(o, "exponent", json_number(fate->exponent));
}

/* --- parts of the page ------------------------------------------------------------------------------------------ */

static json_t *rows_of(const view_page *page)
{
    static const iso_field fields[] = {
        ISO_MEMBER(view_page, "total", total, "", "rows of the file"),
        ISO_MEMBER(view_page, "every", every, "", "of which each so-and-so-many-th is here"),
        ISO_MEMBER(view_page, "between", between, "", "rows put between two"), ISO_FIELD_END};
    json_t *columns = columns_of(page->rows);
    if (page->drifts) json_object_update_new(columns, columns_of(page->drifts));
    if (page->apart) json_object_update_new(columns, columns_of(page->apart));
    json_t *o = json_object();
    json_put(o, "count", json_number((double)iso_record_rows(page->rows)));
    json_add(o, fields, page);
    json_put(o, "columns", columns);
    put_fate(o, &page->fate, page->beside);
    return o;
}

/* Number of the orbit, number of its crossings, one after the other. */
static json_t *counts_of(const iso_record *crossings)
{
    json_t *list = json_array();
    const size_t rows = iso_record_rows(crossings);
    for (size_t i = 0, first = 0; i < rows; i++) {
        const double orbit = iso_record_const_row(crossings, i)[0];
        if (i + 1 < rows && iso_record_const_row(crossings, i + 1)[0] == orbit) continue;
        json_t *pair = json_array();
        json_array_append_new(pair, json_number(orbit));
        json_array_append_new(pair, json_number((double)(i + 1 - first)));
        json_array_append_new(list, pair);
        first = i + 1;
    }
    return list;
}

static json_t *section_of(const view_section *s)
{
    static const iso_field fields[] = {ISO_MEMBER(view_section, "axis", axis, "", "of n_a = 0"),
                                       ISO_MEMBER(view_section, "total", total, "", "crossings of the file"),
                                       ISO_MEMBER(view_section, "orbits", orbits, "", "orbits of the file"),
                                       ISO_FIELD_END};
    json_t *o = json_object(), *list = json_array();
    json_add(o, fields, s);
    json_put(o, "counts", counts_of(s->crossings));
    json_put(o, "crossings", columns_of(s->crossings));
    json_object_del(json_object_get(o, "crossings"), "orbit");
    for (size_t i = 0; i < s->count; i++) {
        json_t *one = json_object();
        json_put(one, "number", json_number((double)s->number[i]));
        json_put(one, "count", json_number((double)iso_record_rows(s->orbit[i])));
        json_put(one, "columns", columns_of(s->orbit[i]));
        put_fate(one, &s->fate[i], s->beside[i]);
        json_array_append_new(list, one);
    }
    json_put(o, "list", list);
    return o;
}

/* --- the whole -------------------------------------------------------------------------------------------------- */

static const char *clock_word(int clock)
{
    return iso_clock_name((iso_clock)clock);
}

/* Exponents of the units of an integral. */
static void find_dimension(const void *row, int i, iso_value *v)
{
    const iso_dimension d = ((const iso_drift *)row)->integral->dimension;
    v->number = i == 0 ? d.J : i == 1 ? d.J_2k : d.w;
}

static const iso_field name_fields[] = {ISO_MEMBER(iso_integral, "name", name, "", "of the integral"),
                                        ISO_MEMBER(iso_integral, "doc", doc, "", "what it is"), ISO_FIELD_END};

static const iso_field model_fields[] = {ISO_MEMBER(iso_system, "model", name, "", "ball or point"), ISO_FIELD_END};

static const iso_field integral_fields[] = {
    ISO_STRUCT(iso_drift, "", integral, name_fields, "which", .pointer = true),
    ISO_STRUCT(iso_drift, "", system, model_fields, "of which model", .pointer = true),
    ISO_FOUND("dimension", ISO_FIELD_INT, find_dimension, "", "exponents of its unit", .count = 3),
    ISO_MEMBER(iso_drift, "start", start, "", "its value at the start; 0 within rounding"),
    ISO_MEMBER(iso_drift, "worst", worst, "", "its largest drift"),
    ISO_FIELD_END,
};

static const iso_field note_fields[] = {{.name = "", .type = ISO_FIELD_TEXT}, ISO_FIELD_END};

#define FIELD(key, member, ...) ISO_MEMBER(view_page, key, member, __VA_ARGS__)

static const iso_field page_fields[] = {
    FIELD("title", title, "", "the name of the file"),
    FIELD("kind", kind, "", "scene, trajectory or section"),
    FIELD("live", live, "", "whether the library is in the page"),
    FIELD("attitude", attitude, "", "whether the scene or the file states one"),
    FIELD("k", params.k, "", "geometry number"),
    FIELD("J", params.J, "moment of inertia", "about the contact"),
    FIELD("radius", params.body.radius, "length", "of the ball"),
    FIELD("eps", eps, "", "coupling of the point"),
    FIELD("h", h, "energy", "of the ball"),
    FIELD("clock", clock, "", "that runs evenly at first", .word = clock_word),
    FIELD("alone", alone, "", "why there is no point"),
    ISO_LIST(view_page, "notes", note, notes, note_fields, "what the page says"),
    ISO_LIST(view_page, "integrals", integral, integrals, integral_fields, "that hold"),
    ISO_FIELD_END,
};

json_t *view_data(const view_page *page)
{
    json_t *o = json_object();
    json_put(o, "version", json_string(ISO_VERSION));
    json_add(o, page_fields, page);
    json_put(o, "effects", json_effects(&page->effects, true));
    if (page->rows) json_put(o, "rows", rows_of(page));
    if (page->section) json_put(o, "section", section_of(page->section));
    return o;
}

/* section_header.c - the columns and the lines of a section. */
#include <inttypes.h>
#include <stdio.h>

#include "base/version.h"
#include "orbit/orbit_impl.h"
#include "study/fields_impl.h"
#include "study/section/section_impl.h"

/* Of the columns before the states; the clocks are those of a trajectory. */
const iso_field iso_section_fields[] = {
    {.name = "orbit", .unit = "", .doc = "number of the orbit; 0 is the scene's own"},
    {.name = "crossing", .unit = "", .doc = "number of the crossing, from 1 on"},
    {.name = "t", .unit = "time", .doc = "the ball's time since the start of the orbit"},
    {.name = "tau", .unit = "time", .doc = "the same in the time in which the ball is Hamiltonian"},
    {.name = "s", .unit = "time", .doc = "the same in the point's time"},
    {.name = "l", .unit = "rad", .doc = "angle of the crossing on the section, in (-pi, pi]"},
    {.name = "x", .unit = "", .doc = "the other coordinate, M_a/|M| on the section n_a = 0, in (-1, 1)"},
    ISO_FIELD_END,
};

static iso_status create_header(const iso_section_walk *w, iso_record **header)
{
    const char *names[ISO_MAX_COLUMNS] = {"orbit", "crossing"};
    size_t n = 2;
    for (iso_clock c = 0; c < (w->clocks ? ISO_CLOCKS : 1); c++) names[n++] = iso_clock_name(c);
    if (w->chart) names[n++] = "l";
    if (w->chart) names[n++] = "x";
    for (int c = 0; c < w->count; c++) names[n++] = iso_column_name(w->columns[c]);
    iso_status status = iso_record_create(w->ctx, n, names, header);
    if (status == ISO_OK)
        status =
            iso_record_describe(w->ctx, *header, iso_shown_name((int)w->result->models), &w->scene->params, w->orbit);
    return status;
}

/* Numbers that are whole, as text. */
static iso_status set_whole(const iso_section_walk *w, iso_record *r, const char *key, uint64_t value)
{
    char text[32];
    snprintf(text, sizeof text, "%" PRIu64, value);
    return iso_record_set(w->ctx, r, key, text);
}

static iso_status set_section(const iso_section_walk *w, iso_record *r)
{
    const iso_section_options *o = &w->options;
    char text[96];
    if (w->chart)
        snprintf(text, sizeof text, "n%d = 0, increasing; %s", o->axis + 1,
                 w->result->nature.global ? "global" : "not known to be global");
    else
        snprintf(text, sizeof text, "%s = %.17g, increasing", iso_column_name(o->column), o->value);
    const iso_status status = iso_record_set(w->ctx, r, "section", text);
    return status == ISO_OK && w->chart ? set_whole(w, r, "axis", (size_t)o->axis + 1) : status;
}

/* A line of a file has room for MOST points; of more points only the number is written. */
static iso_status set_at(const iso_section_walk *w, iso_record *r)
{
    enum { MOST = 500 };
    const iso_section_options *o = &w->options;
    char text[64];
    if (o->at_count <= MOST) return iso_record_set_numbers(w->ctx, r, "at", 2 * o->at_count, o->at[0]);
    snprintf(text, sizeof text, "%zu points l, x", o->at_count);
    return iso_record_set(w->ctx, r, "at", text);
}

static iso_status describe(const iso_section_walk *w, iso_record *r)
{
    const iso_section_options *o = &w->options;
    iso_status status = iso_record_describe_start(w->ctx, r, &w->scene->start);
    if (status == ISO_OK) status = set_section(w, r);
    if (status == ISO_OK) status = set_whole(w, r, "crossings", o->crossings);
    if (status == ISO_OK && o->starts > 0) status = set_whole(w, r, "starts", o->starts);
    if (status == ISO_OK && o->starts > 0) status = set_whole(w, r, "seed", o->seed);
    if (status == ISO_OK && o->at_count > 0) status = set_at(w, r);
    if (status == ISO_OK) status = iso_record_set(w->ctx, r, "backend", iso_backend_name((int)w->model[0]));
    if (status == ISO_OK) status = iso_record_set_numbers(w->ctx, r, "tolerance", 1, &o->tolerance);
    return status == ISO_OK ? iso_record_set(w->ctx, r, "isoroll", ISO_VERSION) : status;
}

iso_status iso_section_give_header(iso_section_walk *w)
{
    iso_record *header = NULL;
    iso_status status = create_header(w, &header);
    if (status == ISO_OK) status = describe(w, header);
    if (status == ISO_OK && w->sink->header) status = w->sink->header(w->sink->data, header);
    if (status == ISO_OK && w->sink->record)
        *w->sink->record = header;
    else
        iso_record_free(header);
    w->begun = true;
    return status;
}

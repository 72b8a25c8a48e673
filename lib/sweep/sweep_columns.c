/* sweep_columns.c - the columns of a quantity: which numbers of its study they are, and what they mean. */
#include <stdio.h>
#include <string.h>

#include "orbit/orbit_impl.h"
#include "sweep/sweep_impl.h"

/* The next of columns with blanks between: its name, and the number of the study that it is. NULL: no more. */
static const char *next_column(const char *columns, char name[ISO_COLUMN_SIZE], char number[ISO_COLUMN_SIZE])
{
    int used = 0;
    if (sscanf(columns, "%63[^= ]%n", name, &used) != 1) return NULL;
    columns += used;
    strcpy(number, name);
    if (*columns == '=' && sscanf(++columns, "%63[^ ]%n", number, &used) == 1) columns += used;
    return columns + strspn(columns, " ");
}

void iso_sweep_add(iso_sweep_job *job, const char *columns)
{
    iso_sweep_column c;
    char name[ISO_COLUMN_SIZE], number[ISO_COLUMN_SIZE];
    while ((columns = next_column(columns, name, number)) && job->count < ISO_SWEEP_NUMBERS) {
        snprintf(c.group, sizeof c.group, "%s", job->quantity.name);
        snprintf(c.name, sizeof c.name, "%s", name);
        bool there = job->quantity.has && !job->quantity.has(job, name);
        for (int i = 0; i < job->count; i++) there = there || strcmp(job->column[i].name, c.name) == 0;
        if (there) continue;
        strcpy(job->number[job->count], number);
        job->column[job->count++] = c;
    }
}

static void add_column(void *data, const char *name, const iso_field *field, const iso_value *value)
{
    (void)field, (void)value;
    iso_sweep_add(data, name);
}

void iso_sweep_add_columns(iso_sweep_job *job)
{
    const iso_sweep_quantity *q = &job->quantity;
    if (q->add)
        q->add(job);
    else if (q->columns)
        iso_sweep_add(job, q->columns);
    else
        iso_numbers_visit(q->study->fields, NULL, add_column, job);
}

/* --- what the columns are ----------------------------------------------------------------------------------------- */

typedef struct described {
    iso_sweep_quantity quantity;
    const char *name, *number; /* of the column that is sought; NULL: all are */
    iso_column_visitor *visit;
    void *data;
} described;

/* "angles2_error" is as "angles1_error". */
static bool is_like(const char *a, const char *b)
{
    for (; *a && *b; a++, b++)
        if (*a != *b && !(*a >= '0' && *a <= '9' && *b >= '0' && *b <= '9')) return false;
    return *a == *b;
}

static void describe(void *data, const char *name, const iso_field *field, const iso_value *value)
{
    described *d = data;
    char full[ISO_COLUMN_SIZE];
    if (d->number && !is_like(name, d->number)) return;
    snprintf(full, sizeof full, "%s_%s", d->quantity.name, d->name ? d->name : name);
    if (d->number) d->number = "";
    d->visit(d->data, full, field, value);
}

void iso_sweep_columns_visit(iso_column_visitor *visit, void *data)
{
    static const iso_field of_row[] = {
        {.name = "point", .unit = "", .doc = "number of the point, from 0 on"},
        {.name = "status", .unit = "", .doc = "0, or why the point failed: a number of iso_status"},
        {.name = "reason", .unit = "", .doc = "the same in words"},
        ISO_FIELD_END,
    };
    described d = {.visit = visit, .data = data};
    char name[ISO_COLUMN_SIZE], number[ISO_COLUMN_SIZE];
    iso_columns_visit(of_row, NULL, visit, data);
    for (int i = 0; iso_sweep_quantity_at(i, &d.quantity); i++) {
        const iso_sweep_quantity *q = &d.quantity;
        d.name = d.number = NULL;
        if (!q->columns) iso_numbers_visit(q->study->fields, NULL, describe, &d);
        for (const char *c = q->columns; c && (c = next_column(c, name, number));) {
            d.name = name, d.number = number;
            iso_numbers_visit(q->study->fields, NULL, describe, &d);
        }
        for (int c = 0; q->add && c < iso_columns_count(); c++) {
            iso_field field = {.name = iso_column_name(c)};
            field.doc = iso_column_doc(c, &field.unit);
            describe(&d, field.name, &field, NULL);
        }
    }
}

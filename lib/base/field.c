/* field.c - reads the members of structs through their fields: as values, as columns, as rows of records. */
#include "base/field.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number_impl.h"
#include "base/record_impl.h"

/* --- values ----------------------------------------------------------------------------------------------------- */

static void read_member(const iso_field *f, const char *at, int i, iso_value *v)
{
    switch (f->type) {
    case ISO_FIELD_REAL: v->number = ((const double *)(const void *)at)[i]; break;
    case ISO_FIELD_INT: v->number = *(const int *)(const void *)at; break;
    case ISO_FIELD_LONG: v->number = (double)*(const long *)(const void *)at; break;
    case ISO_FIELD_SIZE: v->number = (double)*(const size_t *)(const void *)at; break;
    case ISO_FIELD_BOOL: v->number = *(const bool *)(const void *)at; break;
    case ISO_FIELD_TEXT: v->text = at; break;
    case ISO_FIELD_NAME: v->text = *(const char *const *)(const void *)at; break;
    case ISO_FIELD_STRUCT:
    case ISO_FIELD_RECORD:
    case ISO_FIELD_LIST: break;
    }
}

static bool is_text(const iso_field *f)
{
    return f->type == ISO_FIELD_TEXT || f->type == ISO_FIELD_NAME || (f->type == ISO_FIELD_INT && f->word);
}

bool iso_field_is_there(const iso_field *f, const void *row)
{
    if (!row || (f->there && !f->there(row))) return false;
    return f->when == 0 || *((const bool *)row + f->when - 1);
}

void iso_field_read(const iso_field *f, const void *row, int i, iso_value *v)
{
    *v = (iso_value){.there = iso_field_is_there(f, row), .number = NAN};
    if (!v->there) return;
    if (f->number)
        v->number = f->number(row);
    else if (f->is)
        v->number = f->is(row);
    else if (f->find)
        f->find(row, i, v);
    else
        read_member(f, (const char *)row + f->offset, i, v);
    if (f->type == ISO_FIELD_INT && f->word) v->text = f->word((int)v->number);
    if (is_text(f)) v->there = v->text && *v->text;
    if (!(f->how & ISO_FROM_ONE)) return;
    v->there = v->number >= 0;
    v->number++;
}

const void *iso_field_struct(const iso_field *f, const void *row)
{
    if (!iso_field_is_there(f, row)) return NULL;
    const void *at = (const char *)row + f->offset;
    return f->pointer ? *(const void *const *)at : at;
}

static size_t count_of(const iso_field *f, const char *row)
{
    const void *at = row + f->counter;
    if (f->counter_size == 0) return (size_t)f->count;
    return f->counter_size == sizeof(int) ? (size_t) * (const int *)at : *(const size_t *)at;
}

const void *iso_field_item(const iso_field *f, const void *row, size_t i)
{
    if (f->item) return f->item(row, i);
    if (i >= count_of(f, row)) return NULL;
    const void *at = (const char *)row + f->offset;
    return (f->pointer ? *(const char *const *)at : (const char *)at) + i * f->size;
}

static bool is_below(const char *name, const char *outer)
{
    const size_t length = strlen(outer);
    return strncmp(name, outer, length) == 0 && (name[length] == '\0' || name[length] == '.');
}

void iso_fields_copy(const iso_field *fields, const char *without, iso_field copy[ISO_MOST_FIELDS])
{
    int count = 0;
    for (; fields->name && count < ISO_MOST_FIELDS - 1; fields++)
        if (!without || !is_below(fields->name, without)) copy[count++] = *fields;
    copy[count] = (iso_field)ISO_FIELD_END;
}

/* --- columns ---------------------------------------------------------------------------------------------------- */

/* The name of a column: that of the outer structs, the field's, and of several numbers that of the one. */
static void name_column(char name[ISO_COLUMN_SIZE], const char *outer, const iso_field *f, int i)
{
    const char *own = f->column ? f->column : f->name, *last = f->count > 1 && f->word ? f->word(i) : "";
    int length = snprintf(name, ISO_COLUMN_SIZE, "%s%s%s", outer, *outer && *own ? "_" : "", own);
    if (*last)
        snprintf(name + length, ISO_COLUMN_SIZE - (size_t)length, "%s%s", length > 0 ? "_" : "", last);
    else if (f->count > 1)
        snprintf(name + length, ISO_COLUMN_SIZE - (size_t)length, "%s%d", *own ? "" : "_", i + 1);
    for (char *c = name; *c; c++)
        if (*c == '.') *c = '_';
}

/* The columns of a table, or all numbers of a struct, with those that JSON alone has. */
static void visit_fields(const char *outer, const iso_field *fields, const void *row, bool numbers,
                         iso_column_visitor *visit, void *data)
{
    char name[ISO_COLUMN_SIZE], item[ISO_COLUMN_SIZE + 4];
    iso_value value;
    for (const iso_field *f = fields; f->name; f++) {
        iso_field own = *f;
        if (numbers) own.column = NULL;
        if (f->type >= ISO_FIELD_STRUCT) own.count = 0;
        if (!numbers && f->how & ISO_IN_TREE) continue;
        name_column(name, outer, &own, 0);
        if (f->type == ISO_FIELD_STRUCT)
            visit_fields(name, f->fields, iso_field_struct(f, row), numbers, visit, data);
        const int known = f->item || f->counter_size ? 1 : f->count;
        for (int i = 0; numbers && f->type == ISO_FIELD_LIST && i < ISO_MOST_FIELDS; i++) {
            const void *at = row ? iso_field_item(f, row, (size_t)i) : NULL;
            if (row ? !at : i == known) break;
            snprintf(item, sizeof item, "%s%d", name, i + 1);
            visit_fields(item, f->fields, at, numbers, visit, data);
        }
        const bool number = f->type < ISO_FIELD_TEXT && strcmp(f->unit ? f->unit : "", "s") != 0;
        for (int i = 0; (numbers ? number : f->type < ISO_FIELD_STRUCT) && (i == 0 || i < f->count); i++) {
            name_column(name, outer, &own, i);
            iso_field_read(f, row, i, &value);
            visit(data, name, f, &value);
        }
    }
}

void iso_columns_visit(const iso_field *fields, const void *row, iso_column_visitor *visit, void *data)
{
    visit_fields("", fields, row, false, visit, data);
}

void iso_numbers_visit(const iso_field *fields, const void *row, iso_column_visitor *visit, void *data)
{
    visit_fields("", fields, row, true, visit, data);
}

/* --- records ---------------------------------------------------------------------------------------------------- */

typedef struct columns {
    char name[ISO_MOST_FIELDS][ISO_COLUMN_SIZE];
    const iso_field *field[ISO_MOST_FIELDS];
    size_t count;
} columns;

static void keep(void *data, const char *name, const iso_field *field, const iso_value *value)
{
    columns *c = data;
    (void)value;
    if (c->count++ >= ISO_MOST_FIELDS) return;
    memcpy(c->name[c->count - 1], name, strlen(name) + 1);
    c->field[c->count - 1] = field;
}

iso_status iso_columns_create(iso_context *ctx, const iso_field *fields, iso_record **record)
{
    columns c = {.count = 0};
    const char *names[ISO_MOST_FIELDS];
    *record = NULL;
    iso_columns_visit(fields, NULL, keep, &c);
    if (c.count > ISO_MOST_FIELDS)
        return ISO_FAIL_ARGUMENT(ctx, "", "%zu columns are too many: at most %d", c.count, ISO_MOST_FIELDS);
    for (size_t i = 0; i < c.count; i++) names[i] = c.name[i];
    const iso_status status = iso_record_create(ctx, c.count, names, record);
    for (size_t i = 0; status == ISO_OK && i < c.count; i++) {
        const iso_field *f = c.field[i];
        iso_record_set_words(*record, i, is_text(f));
        *iso_record_format(*record, i) =
            (iso_column_format){f->digits, f->type != ISO_FIELD_REAL || f->how & ISO_EMPTY, !(f->how & ISO_QUOTED)};
    }
    return status;
}

typedef struct filling {
    iso_context *ctx;
    iso_record *record;
    double *cell;
    size_t column;
    iso_status status;
} filling;

static void fill(void *data, const char *name, const iso_field *field, const iso_value *value)
{
    filling *to = data;
    (void)name, (void)field;
    double *const cell = &to->cell[to->column];
    *cell = value->there ? value->number : (double)NAN;
    if (to->status == ISO_OK && iso_record_has_words(to->record, to->column++))
        to->status = iso_record_intern(to->ctx, to->record, value->there ? value->text : "", cell);
}

iso_status iso_columns_append(iso_context *ctx, const iso_field *fields, const void *row, iso_record *record)
{
    filling to = {.ctx = ctx, .record = record};
    to.status = iso_record_append(ctx, record, &to.cell);
    if (to.status == ISO_OK) iso_columns_visit(fields, row, fill, &to);
    return to.status;
}

static iso_status set_fields(iso_context *ctx, iso_record *record, const char *outer, const iso_field *f,
                             const void *row)
{
    char key[2 * ISO_COLUMN_SIZE], inner[4 * ISO_COLUMN_SIZE];
    const void *item;
    iso_value v;
    for (; f->name; f++) {
        snprintf(key, sizeof key, "%s%s%s", outer, *outer && *f->name ? "." : "", f->name);
        if (f->how & ISO_IN_TABLE || !iso_field_is_there(f, row)) continue;
        if (f->type == ISO_FIELD_STRUCT && (item = iso_field_struct(f, row)))
            ISO_TRY(set_fields(ctx, record, key, f->fields, item));
        for (size_t i = 0; f->type == ISO_FIELD_LIST && (item = iso_field_item(f, row, i)); i++) {
            snprintf(inner, sizeof inner, "%s.%zu", key, i);
            if (!f->skip || !f->skip(item)) ISO_TRY(set_fields(ctx, record, inner, f->fields, item));
        }
        for (int i = 0; f->type < ISO_FIELD_STRUCT && (i == 0 || i < f->count); i++) {
            if (f->count > 1 && f->word)
                snprintf(inner, sizeof inner, "%s.%s", key, f->word(i));
            else if (f->count > 1)
                snprintf(inner, sizeof inner, "%s.%d", key, i);
            else
                snprintf(inner, sizeof inner, "%s", key);
            iso_field_read(f, row, i, &v);
            if (v.there)
                ISO_TRY(v.text ? iso_record_set(ctx, record, inner, v.text)
                               : iso_record_set_numbers(ctx, record, inner, 1, &v.number));
        }
    }
    return ISO_OK;
}

iso_status iso_record_set_fields(iso_context *ctx, iso_record *record, const iso_field *fields, const void *row)
{
    return set_fields(ctx, record, "", fields, row);
}

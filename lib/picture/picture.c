/* picture.c - the kinds of pictures, and what they share (see picture.h). */
#include "picture/picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "orbit/description.h"
#include "picture/picture_impl.h"

static const iso_picture_maker *const makers[] = {
    &iso_picture_branch,    &iso_picture_chaos,       &iso_picture_chart,      &iso_picture_compare,
    &iso_picture_cost,      &iso_picture_frequencies, &iso_picture_indicators, &iso_picture_periodic,
    &iso_picture_section,   &iso_picture_splitting,   &iso_picture_sweep,      &iso_picture_sweep_part,
    &iso_picture_trajectory};
enum { MAKERS = sizeof makers / sizeof *makers };

const char *iso_picture_kind(int i)
{
    return i >= 0 && i < MAKERS ? makers[i]->kind : NULL;
}

/* --- what is asked for ------------------------------------------------------------------------------------------ */

const iso_record *iso_picture_given(const iso_picture_request *q, const char *kind)
{
    for (const iso_record *const *t = q->table + 1; *t; t++)
        if (strcmp(iso_record_kind(*t), kind) == 0) return *t;
    return NULL;
}

bool iso_picture_option(const iso_picture_request *q, const char *name, char value[static ISO_PICTURE_OPTION])
{
    const size_t length = strlen(name);
    for (const char *line = q->options; line && *line; line += strcspn(line, "\n"), line += *line == '\n') {
        if (strncmp(line, name, length) != 0 || line[length] != '=') continue;
        snprintf(value, ISO_PICTURE_OPTION, "%.*s", (int)strcspn(line + length + 1, "\n"), line + length + 1);
        return true;
    }
    return false;
}

/* Each option must be one that this kind of picture takes. */
static iso_status check_options(iso_context *ctx, const iso_picture_request *q, const iso_picture_maker *m)
{
    for (const char *line = q->options; line && *line; line += strcspn(line, "\n"), line += *line == '\n') {
        char name[ISO_PICTURE_OPTION];
        const int length = (int)strcspn(line, "=\n");
        snprintf(name, sizeof name, " %.*s ", length, line);
        if (length > 0 && m->options && strstr(m->options, name)) continue;
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "options", "--%.*s is not for a picture of a table '%s'",
                                length, line, m->kind);
    }
    return ISO_OK;
}

static iso_status check_table(iso_context *ctx, const iso_record *r, const iso_picture_maker *m)
{
    for (size_t i = 0; i < sizeof m->columns / sizeof *m->columns && m->columns[i]; i++)
        if (iso_record_find(r, m->columns[i]) < 0)
            return ISO_FAIL_INPUT(ctx, "", "no picture: the table has no column '%s'", m->columns[i]);
    if (iso_record_rows(r) == 0 && !m->alone) return ISO_FAIL_INPUT(ctx, "", "no picture: the table has no rows");
    if (!m->axis || iso_picture_axis(r) >= 0) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, "", "no picture: the table does not say its axis, in a line '# axis: 3'");
}

/* --- the picture ------------------------------------------------------------------------------------------------ */

iso_status iso_picture_make(iso_context *ctx, const iso_record *const table[], const char *options,
                            iso_picture *picture)
{
    char title[ISO_PICTURE_TITLE], columns[ISO_PICTURE_OPTION];
    iso_picture_request q = {.table = table, .options = options, .title = iso_record_get(table[0], "title")};
    const iso_picture_maker *m = iso_picture_option(&q, "columns", columns) ? &iso_picture_columns : NULL;
    const char *kind = *iso_record_kind(table[0]) ? iso_record_kind(table[0]) : "trajectory"; /* of others */
    const iso_picture_maker plain = {.kind = kind, .shows = kind, .make = iso_picture_as_it_is};
    *picture = (iso_picture){.layout = NULL};
    for (int i = 0; i < MAKERS && !m; i++)
        if (strcmp(makers[i]->kind, kind) == 0) m = makers[i];
    if (!m && iso_record_rows(table[0]) == 0)
        return ISO_FAIL_INPUT(ctx, "", "there is no picture of a table '%s'", kind);
    if (!m) m = &plain;
    ISO_TRY(check_options(ctx, &q, m));
    ISO_TRY(check_table(ctx, table[0], m));
    if (!q.title && iso_record_get(table[0], "k")) {
        iso_params p;
        ISO_TRY(iso_record_params(ctx, table[0], &p));
        q.title = iso_picture_title(title, m->shows, &p);
    }
    if (!q.title) q.title = m->shows;
    picture->layout = m->kind;
    iso_status status = m->make(ctx, &q, picture);
    if (status == ISO_OK && !iso_record_get(picture->table[0], "title"))
        status = iso_picture_say(ctx, picture, "title", q.title);
    if (status != ISO_OK) iso_picture_free(picture);
    return status;
}

void iso_picture_free(iso_picture *picture)
{
    for (int i = 0; i < ISO_PICTURE_TABLES; i++) iso_record_free(picture->table[i]);
    *picture = (iso_picture){.layout = NULL};
}

iso_record *iso_picture_table(const iso_picture *picture, const char *name)
{
    for (int i = 0; i < ISO_PICTURE_TABLES && picture->table[i]; i++)
        if (strcmp(iso_record_kind(picture->table[i]), name) == 0) return picture->table[i];
    return NULL;
}

iso_status iso_picture_add(iso_context *ctx, iso_picture *picture, const char *name, size_t columns,
                           const char *const names[], iso_record **table)
{
    int i = 0;
    while (i < ISO_PICTURE_TABLES - 1 && picture->table[i]) i++;
    if (picture->table[i]) return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a picture has too many tables");
    ISO_TRY(iso_record_create(ctx, columns, names, &picture->table[i]));
    iso_record_set_kind(picture->table[i], name);
    *table = picture->table[i];
    return ISO_OK;
}

iso_status iso_picture_say(iso_context *ctx, iso_picture *picture, const char *key, const char *text)
{
    return iso_record_set(ctx, picture->table[0], key, text);
}

iso_status iso_picture_count(iso_context *ctx, iso_picture *picture, const char *key, double number)
{
    return iso_record_set_numbers(ctx, picture->table[0], key, 1, &number);
}

iso_status iso_picture_as_it_is(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    const iso_record *r = q->table[0];
    iso_record **copy = &picture->table[0];
    double *row;
    const char *names[ISO_PICTURE_MOST_COLUMNS];
    const size_t columns = iso_record_columns(r);
    if (columns > ISO_PICTURE_MOST_COLUMNS)
        return ISO_FAIL_INPUT(ctx, "", "no picture: there are %zu columns", columns);
    for (size_t c = 0; c < columns; c++) names[c] = iso_record_name(r, c);
    ISO_TRY(iso_record_create(ctx, columns, names, copy)); /* no lines: they would become variables */
    for (size_t c = 0; c < columns; c++) iso_record_set_words(*copy, c, iso_record_has_words(r, c));
    iso_record_set_kind(*copy, "table");
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        ISO_TRY(iso_record_append(ctx, *copy, &row));
        for (size_t c = 0; c < columns; c++) {
            row[c] = iso_record_const_row(r, i)[c];
            if (iso_record_has_words(r, c))
                ISO_TRY(iso_record_intern(ctx, *copy, iso_record_word(r, row[c]), &row[c]));
        }
    }
    return ISO_OK;
}

/* --- tables ----------------------------------------------------------------------------------------------------- */

double iso_picture_number(const iso_record *r, size_t row, const char *name)
{
    const int column = iso_record_find(r, name);
    return column < 0 ? (double)NAN : iso_record_const_row(r, row)[column];
}

bool iso_picture_is(const iso_record *r, size_t row, const char *name, const char *word)
{
    return strcmp(iso_record_word(r, iso_picture_number(r, row, name)), word) == 0;
}

int iso_picture_axis(const iso_record *r)
{
    const char *axis = iso_record_get(r, "axis");
    return axis && axis[0] >= '1' && axis[0] <= '3' ? axis[0] - '1' : -1;
}

/* --- words ------------------------------------------------------------------------------------------------------ */

char *iso_picture_title(char title[static ISO_PICTURE_TITLE], const char *seen, const iso_params *p)
{
    char ball[ISO_BALL_SIZE];
    snprintf(title, ISO_PICTURE_TITLE, "%s        %s", seen, iso_ball_text(ball, p));
    return title;
}

const char *iso_picture_symbol(const char *name)
{
    static const char *const symbols[][5] = {{"omega", "ω", "ω₁", "ω₂", "ω₃"}, {"gamma", "γ", "γ₁", "γ₂", "γ₃"},
                                             {"n", "n", "n₁", "n₂", "n₃"},     {"M", "M", "M₁", "M₂", "M₃"},
                                             {"J", "J", "J₁", "J₂", "J₃"},     {"tau", "τ", NULL, NULL, NULL},
                                             {"mu", "μ", NULL, NULL, NULL}};
    for (size_t i = 0; i < sizeof symbols / sizeof *symbols; i++) {
        const size_t length = strlen(symbols[i][0]);
        const char *rest = name + length;
        if (strncmp(symbols[i][0], name, length) != 0) continue;
        const int component = *rest >= '1' && *rest <= '3' && !rest[1] ? *rest - '0' : 0;
        if (*rest == '\0' || (component && symbols[i][1 + component])) return symbols[i][1 + component];
    }
    return name;
}

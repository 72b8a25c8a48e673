/* picture.c - the kinds of pictures, and what they share (see picture.h). */
#define _GNU_SOURCE /* vasprintf */
#include "picture/picture.h"

#include <math.h>
#include <stdarg.h>
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
enum {
    MAKERS = sizeof makers / sizeof *makers,
    NAMES = 1000 /* an image of a section has 640 */,
    MOST_COLUMNS = 200
};

static const iso_picture_maker *maker_of(const char *kind)
{
    for (int i = 0; i < MAKERS; i++)
        if (strcmp(makers[i]->kind, kind) == 0) return makers[i];
    return NULL;
}

bool iso_picture_has(const char *kind)
{
    return maker_of(kind);
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
        return ISO_FAIL_ARGUMENT(ctx, "options", "--%.*s is not for a picture of a table '%s'", length, line,
                                 m->kind);
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

static void free_all(int count, iso_record *table[])
{
    for (int i = 0; i < count; i++) iso_record_free(table[i]), table[i] = NULL;
}

/* The table as it is, called `table`. */
static iso_status make_plain(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    const iso_record *r = q->table[0];
    iso_record **copy = &picture->table[0];
    double *row;
    const char *names[MOST_COLUMNS];
    const size_t columns = iso_record_columns(r);
    if (columns > MOST_COLUMNS) return ISO_FAIL_INPUT(ctx, "", "no picture: there are %zu columns", columns);
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

iso_status iso_picture_make(iso_context *ctx, const iso_record *const table[], const char *options,
                            iso_picture *picture)
{
    char columns[ISO_PICTURE_OPTION];
    const iso_picture_request q = {.table = table, .options = options};
    const char *kind = *iso_record_kind(table[0]) ? iso_record_kind(table[0]) : "trajectory"; /* of others */
    const iso_picture_maker *m = iso_picture_option(&q, "columns", columns) ? &iso_picture_columns : maker_of(kind);
    const char *title = iso_record_get(table[0], "title");
    const bool of_ball = !title && iso_record_get(table[0], "k");
    const iso_picture_maker plain = {.kind = kind, .shows = kind, .make = make_plain};
    iso_params p;
    *picture = (iso_picture){.layout = NULL};
    if (!m && iso_record_rows(table[0]) == 0)
        return ISO_FAIL_INPUT(ctx, "", "there is no picture of a table '%s'", kind);
    if (!m) m = &plain;
    ISO_TRY(check_options(ctx, &q, m));
    ISO_TRY(check_table(ctx, table[0], m));
    if (of_ball) ISO_TRY(iso_record_params(ctx, table[0], &p));
    picture->layout = m->kind;
    iso_status status = m->make(ctx, &q, picture);
    if (status == ISO_OK && !iso_record_get(picture->table[0], "title"))
        status = of_ball ? iso_picture_title(ctx, &q, picture, m->shows, &p)
                         : iso_picture_line(ctx, picture, "title", "%s", title ? title : m->shows);
    free_all(ISO_PICTURE_ASIDE, picture->aside);
    if (status != ISO_OK) iso_picture_free(picture);
    return status;
}

void iso_picture_free(iso_picture *picture)
{
    free_all(ISO_PICTURE_TABLES, picture->table);
    free_all(ISO_PICTURE_ASIDE, picture->aside);
    picture->layout = NULL;
}

iso_record *iso_picture_table(const iso_picture *picture, const char *name)
{
    for (int i = 0; i < ISO_PICTURE_TABLES && picture->table[i]; i++)
        if (strcmp(iso_record_kind(picture->table[i]), name) == 0) return picture->table[i];
    return NULL;
}

iso_status iso_picture_add(iso_context *ctx, iso_picture *picture, const char *name, const char *columns,
                           iso_record **table)
{
    char *text = strdup(columns), *rest = NULL;
    const char *names[NAMES];
    bool words[NAMES];
    size_t count = 0;
    if (!text) return iso_context_no_memory(ctx, "a picture");
    for (char *word = strtok_r(text, " ", &rest); word && count < NAMES; word = strtok_r(NULL, " ", &rest)) {
        const size_t length = strcspn(word, "'");
        words[count] = word[length] != '\0';
        word[length] = '\0';
        names[count++] = word;
    }
    int i = 0;
    while (i < ISO_PICTURE_TABLES && picture->table[i]) i++;
    if (i == ISO_PICTURE_TABLES) return free(text), ISO_FAIL_INPUT(ctx, "", "a picture has too many tables");
    const iso_status status = iso_record_create(ctx, count, names, &picture->table[i]);
    free(text);
    ISO_TRY(status);
    *table = picture->table[i];
    for (size_t c = 0; c < count; c++) iso_record_set_words(*table, c, words[c]);
    iso_record_set_kind(*table, name);
    return ISO_OK;
}

iso_record **iso_picture_aside(iso_picture *picture)
{
    int i = 0;
    while (i < ISO_PICTURE_ASIDE - 1 && picture->aside[i]) i++; /* makers use five */
    return &picture->aside[i];
}

iso_status iso_picture_line(iso_context *ctx, iso_picture *picture, const char *key, const char *format, ...)
{
    char *text;
    va_list arguments;
    va_start(arguments, format);
    const int length = vasprintf(&text, format, arguments);
    va_end(arguments);
    if (length < 0) return iso_context_no_memory(ctx, "a picture");
    const iso_status status = iso_record_set(ctx, picture->table[0], key, text);
    free(text);
    return status;
}

iso_status iso_picture_title(iso_context *ctx, const iso_picture_request *q, iso_picture *picture, const char *seen,
                             const iso_params *p)
{
    char ball[ISO_BALL_SIZE];
    const char *own = iso_record_get(q->table[0], "title");
    if (own) return iso_picture_line(ctx, picture, "title", "%s", own);
    return iso_picture_line(ctx, picture, "title", ISO_PICTURE_TITLE, seen, iso_ball_text(ball, p));
}

iso_status iso_picture_set(iso_context *ctx, iso_picture *picture, const char *keys, const double numbers[])
{
    char key[64];
    for (int used; sscanf(keys, "%63s%n", key, &used) == 1; keys += used)
        ISO_TRY(iso_record_set_numbers(ctx, picture->table[0], key, 1, numbers++));
    return ISO_OK;
}

/* --- tables ----------------------------------------------------------------------------------------------------- */

double iso_picture_number(const iso_record *r, size_t row, const char *name)
{
    const int column = iso_record_find(r, name);
    return column < 0 ? (double)NAN : iso_picture_at(r, row, column);
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

void iso_picture_range(const iso_record *r, int column, double range[2])
{
    range[0] = INFINITY, range[1] = -INFINITY;
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        range[0] = fmin(range[0], iso_picture_at(r, i, column));
        range[1] = fmax(range[1], iso_picture_at(r, i, column));
    }
}

/* --- text ------------------------------------------------------------------------------------------------------- */

const char *const iso_picture_index[6] = {"₁", "₂", "₃", "₁", "₂", "₃"};

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

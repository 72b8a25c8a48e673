/* check_unseen.c - which numbers of a file its check does not depend on (check_impl.h).
 *
 * A column is looked at if something was compared with it. For a line this is tried: a small check, of the first row
 * and of one a little later that solves the equations exactly, is made again with another number in the line. If no
 * residual grows, that number is not looked at. So what is said here is right for lines of any program, and nothing
 * has to be kept up to date. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "study/check/check_impl.h"

/* By so much a number is changed, relative, or absolute where it is 0; a residual grows if that is more than what
 * rounding makes of it. */
static const double CHANGE = 1e-6, ROUNDING = 1e-13;

enum { MOST_NUMBERS = 16 };

typedef struct trial {
    checker *c;
    iso_record *header; /* a copy, in which a line is changed */
    double *later;      /* the second row; NULL: there is none */
    iso_residuals usual;
    iso_status trouble; /* what is no answer: no memory, stopped */
} trial;

/* --- the two rows ----------------------------------------------------------------------------------------------- */

/* Writes into the later row what an orbit gives: its own columns, and the clocks that it has. */
static void put_sample(const checker *c, iso_sample *sample, double later[])
{
    iso_checker_go_on(c, c->first, sample);
    for (int i = 0; i < ISO_TRAJECTORY_COLUMNS; i++) {
        const double x = iso_sample_column(sample, i);
        if (c->columns[i] < 0 || isnan(x)) continue;
        later[c->columns[i]] = i < ISO_CLOCKS ? c->first[c->columns[i]] + x : x;
    }
}

/* The clock of the later row: that of the second one, or a time in which a ball turns by about an angle of 1. */
static double later_time(const checker *c, const checked_model *m, const iso_orbit *orbit)
{
    const int column = c->columns[m->clock];
    const double step = c->second[column] - c->first[column], unit = orbit->unit_clock[m->clock];
    return c->first[column] + (step == 0 || fabs(step) > unit ? copysign(unit, step) : step);
}

/* The other model goes to the time to which this one went. */
static iso_status go_later(const trial *t, const checked_model *m, bool *gone)
{
    const checker *c = t->c;
    iso_orbit *orbit = NULL;
    iso_sample sample;
    if (!m->followed) return ISO_OK;
    ISO_TRY(iso_checker_open(c, m, c->first, &orbit));
    const int column = c->columns[m->clock];
    if (!*gone) t->later[column] = later_time(c, m, orbit);
    iso_status status = iso_orbit_at(orbit, t->later[column] - c->first[column], &sample);
    iso_orbit_free(orbit);
    if (status == ISO_OK) put_sample(c, &sample, t->later);
    *gone = true;
    return status;
}

/* Whether any row was integrated to the next. */
static bool followed(const checker *c)
{
    return c->model[ISO_BALL].followed || c->model[ISO_POINT].followed;
}

static iso_status make_later(trial *t)
{
    const checker *c = t->c;
    bool gone = false;
    if (!followed(c)) return ISO_OK;
    t->later = calloc(c->width + 1, sizeof *t->later);
    if (!t->later) return iso_context_no_memory(c->ctx, "a check");
    memcpy(t->later, c->first, c->width * sizeof *t->later);
    for (int k = 0; k < 2; k++) ISO_TRY(go_later(t, &c->model[k], &gone));
    return ISO_OK;
}

/* --- one small check -------------------------------------------------------------------------------------------- */

static iso_status find_params(const trial *t, iso_params *params)
{
    *params = *t->c->params;
    const bool stated = iso_record_get(t->header, "k") && iso_record_get(t->header, "J");
    return stated ? iso_record_params(t->c->ctx, t->header, params) : ISO_OK;
}

static iso_status check_again(const trial *t, iso_residuals *residuals)
{
    iso_params params;
    iso_checking *again = NULL;
    iso_status status = find_params(t, &params);
    if (status == ISO_OK) status = iso_checking_create(t->c->ctx, &params, t->header, t->c->tolerance, &again);
    if (status == ISO_OK) status = iso_checking_put(again, t->c->first);
    if (status == ISO_OK && t->later) status = iso_checking_put(again, t->later);
    if (status == ISO_OK) status = iso_checking_end(again, residuals);
    iso_checking_free(again);
    return status;
}

static double usual(const trial *t, const char *name)
{
    int i = 0;
    while (i < t->usual.count && strcmp(t->usual.residual[i].name, name) != 0) i++;
    return i < t->usual.count ? t->usual.residual[i].worst : 0;
}

/* Whether the check of the changed header is another one: refused, or with larger residuals. */
static bool shows(trial *t)
{
    iso_residuals r;
    bool grows = false;
    const iso_status status = check_again(t, &r);
    if (status == ISO_NO_MEMORY || status == ISO_STOPPED) t->trouble = status;
    if (status != ISO_OK) return true;
    for (int i = 0; i < r.count; i++)
        grows = grows || r.residual[i].worst > 2 * usual(t, r.residual[i].name) + ROUNDING;
    return grows || r.count != t->usual.count;
}

/* --- lines ------------------------------------------------------------------------------------------------------ */

/* The numbers of a line; 0: they are words, or too many. */
static size_t read_numbers(const char *text, double number[MOST_NUMBERS])
{
    size_t count = 0;
    for (size_t length; *(text += strspn(text, " \t")); text += length) {
        length = strcspn(text, " \t");
        if (count == MOST_NUMBERS || !iso_number_read(text, length, &number[count++])) return 0;
    }
    return count;
}

/* Whether the check shows that the words of a line are others. */
static bool shows_words(trial *t, const char *key)
{
    t->trouble = iso_record_set(t->c->ctx, t->header, key, "?");
    return t->trouble != ISO_OK || shows(t);
}

/* Tells which of the numbers of a line are not looked at. */
static void try_numbers(trial *t, const char *key, size_t count, const double number[],
                        void (*tell)(void *data, const char *name), void *data)
{
    bool seen[MOST_NUMBERS], any = false;
    double changed[MOST_NUMBERS];
    char name[ISO_NAME_SIZE + 32];
    for (size_t i = 0; i < count && t->trouble == ISO_OK; i++) {
        memcpy(changed, number, count * sizeof *changed);
        changed[i] = number[i] == 0 ? CHANGE : number[i] * (1 + CHANGE);
        t->trouble = iso_record_set_numbers(t->c->ctx, t->header, key, count, changed);
        seen[i] = t->trouble != ISO_OK || shows(t);
        any = any || seen[i];
    }
    for (size_t i = 0; i < count && t->trouble == ISO_OK; i++) {
        if (any)
            snprintf(name, sizeof name, "# %.*s, number %zu", ISO_NAME_SIZE, key, i + 1);
        else
            snprintf(name, sizeof name, "# %.*s", ISO_NAME_SIZE, key);
        if (any ? !seen[i] : i == 0) tell(data, name);
    }
}

/* A residual has the name of the line: it was compared, if only at a later row. */
static bool is_compared(const trial *t, const char *key)
{
    char name[ISO_NAME_SIZE + 8];
    snprintf(name, sizeof name, "# %.*s", ISO_NAME_SIZE, key);
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < t->c->model[k].found.count; i++)
            if (strcmp(t->c->model[k].found.residual[i].name, name) == 0) return true;
    return false;
}

static void try_line(trial *t, const char *key, const char *value, void (*tell)(void *data, const char *name),
                     void *data)
{
    double number[MOST_NUMBERS];
    char name[ISO_NAME_SIZE + 8];
    const size_t count = read_numbers(value, number);
    if (is_compared(t, key)) return;
    if (count > 0) {
        try_numbers(t, key, count, number, tell, data);
    } else if (!shows_words(t, key)) {
        snprintf(name, sizeof name, "# %.*s", ISO_NAME_SIZE, key);
        tell(data, name);
    }
    if (t->trouble == ISO_OK) t->trouble = iso_record_set(t->c->ctx, t->header, key, value);
}

/* --- all of a file ---------------------------------------------------------------------------------------------- */

static iso_status try_lines(trial *t, void (*tell)(void *data, const char *name), void *data)
{
    const char *key, *value;
    ISO_TRY(iso_record_create_like(t->c->ctx, t->c->record, 0, NULL, &t->header));
    ISO_TRY(make_later(t));
    ISO_TRY(check_again(t, &t->usual));
    for (size_t i = 0; t->trouble == ISO_OK && iso_record_line(t->c->record, i, &key, &value); i++)
        try_line(t, key, value, tell, data);
    return t->trouble;
}

iso_status iso_checking_unseen(iso_checking *c, void (*tell)(void *data, const char *name), void *data)
{
    ISO_DEFAULT_ARITHMETIC;
    trial t = {.c = c};
    if (!followed(c)) tell(data, "the flow from row to row");
    for (size_t i = 0; i < c->width; i++) {
        const int column = iso_column_find(iso_record_name(c->record, i));
        if (column < 0 || !c->looked[column]) tell(data, iso_record_name(c->record, i));
    }
    const iso_status status = try_lines(&t, tell, data);
    iso_record_free(t.header);
    free(t.later);
    return status;
}

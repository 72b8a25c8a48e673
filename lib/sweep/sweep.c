/* sweep.c - the rows of a sweep: columns, points, and what is noted of those that fail (see sweep.h). */
#include "sweep/sweep.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "orbit/batch.h"
#include "sweep/sweep_impl.h"

#define QUANTITY(name) &iso_sweep_##name,
static const iso_sweep_computation *const quantities[] = {ISO_SWEEP_LIST(QUANTITY) NULL};

#define TOPIC(name) &iso_sweep_##name.topic,
static const iso_sweep_quantity *const topics[] = {ISO_SWEEP_LIST(TOPIC) NULL};

struct iso_sweep {
    const iso_sweep_plan *plan;
    iso_sweep_head head;
    int asks;
    iso_sweep_job ask[ISO_SWEEP_REQUESTS];
    iso_sweep_column *column;
};

const iso_sweep_quantity *const *iso_sweep_quantities(void)
{
    return topics;
}

/* --- what the quantities share ---------------------------------------------------------------------------------- */

void iso_sweep_note(iso_context *ctx, const iso_sweep_job *ask, iso_sweep_batch *batch, size_t i, iso_status status)
{
    iso_sweep_rows *rows = batch->rows;
    if (rows->status[i] != ISO_OK) return;
    rows->status[i] = status;
    snprintf(rows->reason[i], sizeof rows->reason[i], "%s%s%s", ask ? ask->quantity->topic.name : "", ask ? ": " : "",
             iso_context_message(ctx));
    for (char *c = rows->reason[i]; *c; c++)
        if (*c == '"' || (unsigned char)*c < ' ') *c = '\'';
}

double *iso_sweep_numbers(const iso_sweep_job *ask, const iso_sweep_batch *batch, size_t i)
{
    return batch->rows->number + i * (size_t)batch->rows->columns + ask->first;
}

int iso_sweep_names(const char *name[], int count, const char *const names[])
{
    for (int i = 0; i < count; i++) name[i] = names[i];
    return count;
}

/* --- columns ---------------------------------------------------------------------------------------------------- */

static void add_column(iso_sweep *s, const char *group, const char *name)
{
    iso_sweep_column *c = &s->column[s->head.columns++];
    snprintf(c->group, sizeof c->group, "%s", group);
    snprintf(c->name, sizeof c->name, "%s", name);
}

static void make_columns(iso_sweep *s)
{
    const iso_family *f = &s->plan->family;
    for (int i = 0; i < f->columns; i++) add_column(s, "vary", f->name[i]);
    for (int i = 0; i < s->asks; i++) {
        iso_sweep_job *ask = &s->ask[i];
        const char *names[ISO_SWEEP_NUMBERS];
        ask->first = s->head.columns;
        ask->count = ask->quantity->columns(ask, names);
        for (int c = 0; c < ask->count; c++) add_column(s, ask->quantity->topic.name, names[c]);
    }
    s->head.column = s->column;
}

static void make_asks(iso_sweep *s)
{
    for (int i = 0; i < s->plan->wishes; i++) {
        const iso_sweep_request *wish = &s->plan->wish[i];
        iso_sweep_job *ask = &s->ask[s->asks++];
        ask->quantity = quantities[wish->topic];
        memcpy(ask->setting, wish->setting, sizeof ask->setting);
        ask->turns = s->plan->turns;
        ask->time = s->plan->time;
        ask->vectors = s->head.vectors;
        ask->base = s->plan->family.base;
    }
}

/* The size that the quantities suggest. A sweep of few points gets smaller chunks, so that every thread has some.
 * Multiples of 8 fill the lanes of vectors. */
static size_t chunk_of(const iso_sweep *s)
{
    enum { CHUNKS = 64, LANES = 8 };
    size_t chunk = s->head.count / CHUNKS + 1;
    if (chunk > LANES / 2) chunk = (chunk + LANES - 1) / LANES * LANES;
    for (int i = 0; i < s->asks; i++) {
        const size_t fits = s->ask[i].quantity->chunk(&s->ask[i]);
        if (fits < chunk) chunk = fits;
    }
    return chunk;
}

/* An orbit that is alone takes AVX2 where it is, whatever `vectors` says. */
static bool has_avx2(void)
{
    const char *kind;
    for (int i = 0; (kind = iso_batch_vectors(i, NULL)) != NULL; i++)
        if (strcmp(kind, "avx2") == 0) return true;
    return false;
}

/* Everything that the rows depend on. */
static void make_head(iso_sweep *s)
{
    iso_sweep_head *h = &s->head;
    const unsigned char alone = has_avx2();
    h->count = s->plan->family.count;
    h->chunk = s->plan->chunk > 0 ? s->plan->chunk : chunk_of(s);
    h->text = s->plan->text ? s->plan->text : "";
    h->scene = s->plan->scene;
    memcpy(h->hash, s->plan->hash, sizeof h->hash);
    iso_sweep_hash(h->hash, &h->count, sizeof h->count);
    iso_sweep_hash(h->hash, &h->chunk, sizeof h->chunk);
    iso_sweep_hash(h->hash, h->vectors, strlen(h->vectors));
    iso_sweep_hash(h->hash, &alone, 1);
    for (int i = 0; i < h->columns; i++) {
        iso_sweep_hash(h->hash, h->column[i].group, strlen(h->column[i].group));
        iso_sweep_hash(h->hash, h->column[i].name, strlen(h->column[i].name));
    }
}

static iso_status choose_vectors(iso_context *ctx, iso_sweep *s)
{
    const char *asked = s->plan->vectors, *kind;
    for (int i = 0; (kind = iso_batch_vectors(i, NULL)) != NULL; i++) {
        if (*asked && strcmp(asked, kind) != 0) continue;
        snprintf(s->head.vectors, sizeof s->head.vectors, "%s", kind);
        return ISO_OK;
    }
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "vectors", "this processor has no vectors '%s'", asked);
}

static iso_status check(iso_context *ctx, const iso_sweep *s)
{
    iso_status status = ISO_OK;
    for (int i = 0; i < s->asks && status == ISO_OK; i++) {
        const iso_sweep_computation *q = s->ask[i].quantity;
        if (q->refuse && s->ask[i].base) status = q->refuse(ctx, &s->ask[i]);
        if (status == ISO_BAD_INPUT)
            status = iso_context_fail(ctx, status, q->topic.name, "%s: %s", q->topic.name, iso_context_message(ctx));
    }
    return status;
}

iso_status iso_sweep_create(iso_context *ctx, const iso_sweep_plan *plan, iso_sweep **sweep)
{
    ISO_DEFAULT_ARITHMETIC;
    *sweep = NULL;
    iso_sweep *s = calloc(1, sizeof *s);
    if (s) s->column = calloc((size_t)plan->family.columns + ISO_SWEEP_REQUESTS * ISO_SWEEP_NUMBERS, sizeof *s->column);
    if (!s || !s->column) {
        iso_sweep_free(s);
        return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for a sweep");
    }
    s->plan = plan;
    iso_status status = choose_vectors(ctx, s);
    if (status == ISO_OK) {
        make_asks(s);
        status = check(ctx, s);
    }
    if (status == ISO_OK) {
        make_columns(s);
        make_head(s);
        *sweep = s;
    } else {
        iso_sweep_free(s);
    }
    return status;
}

void iso_sweep_free(iso_sweep *s)
{
    if (!s) return;
    free(s->column);
    free(s);
}

const iso_sweep_head *iso_sweep_head_of(const iso_sweep *s)
{
    return &s->head;
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

/* Errors: ISO_NO_MEMORY, ISO_STOPPED; a point without a scene is a failed row. */
static iso_status make_points(iso_context *ctx, const iso_sweep *s, size_t first, iso_sweep_batch *b)
{
    const iso_family *f = &s->plan->family;
    iso_sweep_rows *r = b->rows;
    for (size_t i = 0; i < b->count; i++) {
        double *row = r->number + i * (size_t)r->columns;
        for (int c = 0; c < r->columns; c++) row[c] = NAN;
        r->status[i] = ISO_OK;
        r->reason[i][0] = '\0';
        const iso_status status = f->scene(ctx, f->data, first + i, &b->scene[i], row);
        if (status == ISO_STOPPED || status == ISO_NO_MEMORY) return status;
        if (status != ISO_OK) iso_sweep_note(ctx, NULL, b, i, status);
    }
    return ISO_OK;
}

/* A point that has failed in an earlier quantity is still asked for the others, but not if it has no scene. */
static iso_status find_each(iso_context *ctx, const iso_sweep_job *ask, iso_sweep_batch *b)
{
    for (size_t i = 0; i < b->count; i++) {
        if (!b->made[i]) continue;
        const iso_status status = ask->quantity->find(ctx, ask, &b->scene[i], iso_sweep_numbers(ask, b, i));
        if (status == ISO_STOPPED || status == ISO_NO_MEMORY) return status;
        if (status != ISO_OK) iso_sweep_note(ctx, ask, b, i, status);
    }
    return ISO_OK;
}

static iso_status find_all(iso_context *ctx, const iso_sweep *s, iso_sweep_batch *b)
{
    iso_status status = ISO_OK;
    for (int i = 0; i < s->asks && status == ISO_OK; i++) {
        const iso_sweep_job *ask = &s->ask[i];
        const iso_sweep_computation *q = ask->quantity;
        status = q->find_all && q->together(ask) ? q->find_all(ctx, ask, b) : find_each(ctx, ask, b);
    }
    return status;
}

iso_status iso_sweep_compute_points(iso_context *ctx, const iso_sweep *s, size_t first, size_t count,
                                    iso_sweep_rows *rows)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_sweep_batch b = {.count = count, .rows = rows};
    iso_status status = ISO_OK;
    rows->first = first;
    rows->count = count;
    b.scene = malloc((count + 1) * sizeof *b.scene);
    bool *made = malloc((count + 1) * sizeof *made);
    if (b.scene && made) {
        status = make_points(ctx, s, first, &b);
        for (size_t i = 0; i < count; i++) made[i] = rows->status[i] == ISO_OK;
        b.made = made;
        if (status == ISO_OK) status = find_all(ctx, s, &b);
    } else {
        status = iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for %zu points", count);
    }
    free(b.scene);
    free(made);
    return status;
}

iso_status iso_sweep_compute(iso_context *ctx, const iso_sweep *s, size_t c, iso_sweep_rows *rows)
{
    return iso_sweep_compute_points(ctx, s, c * s->head.chunk, iso_sweep_chunk_points(&s->head, c), rows);
}

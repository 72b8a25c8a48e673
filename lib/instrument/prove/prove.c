/* prove.c - the study `prove`: which balls are enclosed, and how an interval of k is cut into pieces (prove_impl.h). */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "instrument/prove/prove_impl.h"
#include "orbit/orbit_impl.h"
#include "study/study_impl.h"

/* Digits that are tried, if none are asked for; how often an interval is halved. */
enum { ATTEMPTS = 3, FIRST_DIGITS = 18, MOST_DIGITS = 400, HALVINGS = 40 };

#define WHAT "an enclosure of m is computed"

/* --- what is asked ---------------------------------------------------------------------------------------------- */

static iso_status prepare(iso_context *ctx, void *options)
{
    const iso_prove_request *r = options;
    if (r->digits <= MOST_DIGITS) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "", "--digits %d: expected a whole number from 1 to %d", r->digits, MOST_DIGITS);
}

/* One double of the scene as the number in its text. */
static iso_status read_exactly(iso_context *ctx, const iso_scene *scene, const char *key, double x, iso_rational *r)
{
    if (scene->params.body.surface != ISO_REDUCED)
        return ISO_FAIL_INPUT(
            ctx, "inertia",
            "prove takes k and J exactly as they are written, and those of a body are computed: give "
            "them in 'reduced'");
    if (!iso_scene_is_rounded(scene, key) && iso_rational_of(x, r)) return ISO_OK;
    return ISO_FAIL_INPUT(
        ctx, key, "prove takes %s exactly: write a number with at most 15 digits, or a fraction, such as 1/3", key);
}

/* "K" or "A:B" */
static iso_status read_k(iso_context *ctx, const char *text, iso_rational k[2])
{
    const char *colon = strchr(text, ':'), *second = colon ? colon + 1 : text;
    const size_t first = colon ? (size_t)(colon - text) : strlen(text);
    if (!iso_rational_read(text, first, &k[0]) || !iso_rational_read(second, strlen(second), &k[1]) ||
        (k[0].top < 0) != (k[1].top < 0) || (colon && !(iso_rational_double(&k[0]) < iso_rational_double(&k[1]))))
        return ISO_FAIL_ARGUMENT(ctx, "",
                                 "--k '%s': expected a number or an interval A:B that does not hold 0, A < B also as "
                                 "doubles, such as 1/3 or 0.5:0.500001",
                                 text);
    return ISO_OK;
}

static iso_status read_ball(iso_context *ctx, const iso_scene *scene, const iso_prove_request *r,
                            iso_proof_ball *ball)
{
    const iso_effects acting = iso_scene_acting(scene);
    double level = 0;
    ISO_TRY(iso_refuse_beyond_level(ctx, &acting, WHAT));
    ISO_TRY(iso_level_of_scene(ctx, scene, WHAT, &level));
    if (level != 0)
        return ISO_FAIL_INPUT(ctx, iso_level_name(), WHAT " only of the free ball, on the level H = 0 of its point");
    for (int i = 0; i < 3; i++) ISO_TRY(read_exactly(ctx, scene, "J", scene->params.J[i], &ball->J[i]));
    ISO_TRY(iso_refuse_equal_moments(ctx, scene->params.J, "there is no middle axis and no m"));
    if (r->k) return read_k(ctx, r->k, ball->k);
    ISO_TRY(read_exactly(ctx, scene, "k", scene->params.k, &ball->k[0]));
    ball->k[1] = ball->k[0];
    return ISO_OK;
}

/* --- one k, or one piece ---------------------------------------------------------------------------------------- */

static double length_of(const iso_proof_ball *ball)
{
    return iso_rational_double(&ball->k[1]) - iso_rational_double(&ball->k[0]);
}

/* What is tried for one k: digits, one after the other, with so much work in all. */
typedef struct plan {
    int digits[ATTEMPTS], attempts;
    double decades; /* -log10 |m|, roughly; 0: not asked */
    iso_proof_work work;
} plan;

/* The digits that are asked for; or 18, 36, 72, without those that are too few for an m of the expected size; or, if it
 * is smaller than all of these show, enough for it. As m can change by as much as k does, an interval asks for some
 * more digits than its length has. */
static iso_status make_plan(iso_context *ctx, const iso_proof_ball *ball, const iso_prove_request *r, plan *p)
{
    enum { LARGER = 6, SPARE = 12 };
    *p = (plan){.work.most = r->half_returns};
    if (r->digits || !iso_proof_is_thin(ball)) {
        const double part = length_of(ball) / fabs(iso_rational_double(&ball->k[0]));
        p->digits[p->attempts++] = r->digits ? r->digits : (int)fmax(6, ceil(4 - log10(part)));
        return ISO_OK;
    }
    ISO_TRY(iso_proof_expect(ctx, ball, &p->work, &p->decades));
    for (int i = 0, digits = FIRST_DIGITS; i < ATTEMPTS; i++, digits *= 2)
        if (digits > p->decades - LARGER) p->digits[p->attempts++] = digits;
    if (p->attempts == 0) p->digits[p->attempts++] = (int)fmin(MOST_DIGITS, ceil(p->decades) + SPARE);
    return ISO_OK;
}

/* *failed: the digits with which nothing was enclosed, 0: all were enclosed. What is known stays known if more digits
 * fail. *proof is empty before, and with digits = 0 still after. */
static iso_status find(iso_context *ctx, const iso_proof_ball *ball, const iso_prove_request *r, plan *p,
                       iso_proof *proof, char **text, int *failed)
{
    *failed = 0;
    for (int i = 0; i < p->attempts && proof->sign == 0; i++) {
        iso_proof next;
        char *next_text = NULL;
        const iso_status status =
            iso_proof_find(ctx, ball, p->digits[i], &p->work, &next, r->certificate ? &next_text : NULL);
        if (status != ISO_OK) {
            *failed = p->digits[i];
            return proof->digits > 0 && status == ISO_NUMERICAL ? ISO_OK : status;
        }
        *proof = next;
        free(*text);
        *text = next_text;
    }
    return ISO_OK;
}

/* --- an interval ------------------------------------------------------------------------------------------------ */

typedef struct work {
    iso_context *ctx;
    const iso_prove_request *request;
    iso_study_result *result;
    iso_proofs *found;
    double length, done; /* of the interval */
    long tried;          /* intervals */
} work;

/* Certificates go to a file: an interval may have more of them than the memory holds. */
static iso_status add(work *w, const iso_proof *proof, char *text)
{
    iso_proofs *f = w->found;
    if (text && !f->certificates) f->certificates = tmpfile();
    const bool kept = !text || (f->certificates && fputs(text, f->certificates) != EOF);
    free(text);
    if (!kept)
        return iso_context_fail(w->ctx, ISO_FILE_TROUBLE, "", "cannot write a temporary file: %s", strerror(errno));
    iso_proof *row = realloc(f->row, (f->rows + 1) * sizeof *row);
    if (!row) return iso_context_no_memory(w->ctx, "%zu pieces", f->rows + 1);
    f->row = row;
    row += f->rows++;
    *row = *proof;
    char k[2][ISO_RATIONAL_SIZE];
    for (int i = 0; i < 2; i++) iso_rational_print(k[i], &row->ball.k[i]);
    const bool thin = iso_proof_is_thin(&row->ball);
    snprintf(row->exact, sizeof row->exact, "%s%s%s", k[0], thin ? "" : ":", thin ? "" : k[1]);
    return ISO_OK;
}

/* A piece that stays undecided, at the end of all halvings or where the middle has too many digits, is kept as such. */
static iso_status divide(work *w, const iso_proof_ball *ball, int depth)
{
    const long most = w->request->pieces;
    iso_proof proof = {.digits = 0};
    iso_proof_ball half[2] = {*ball, *ball};
    plan p;
    int failed;
    char *text = NULL;
    iso_status status = make_plan(w->ctx, ball, w->request, &p);
    if (status == ISO_OK)
        status = w->tried < most ? find(w->ctx, ball, w->request, &p, &proof, &text, &failed) : ISO_NUMERICAL;
    w->tried++;
    if (status != ISO_OK && status != ISO_NUMERICAL) return status;
    const bool decided = status == ISO_OK && proof.sign != 0;
    if (!decided && depth > 0 && w->tried < most && iso_rational_middle(&ball->k[0], &ball->k[1], &half[0].k[1])) {
        free(text);
        half[1].k[0] = half[0].k[1];
        status = divide(w, &half[0], depth - 1);
        if (status == ISO_OK) status = divide(w, &half[1], depth - 1);
    } else {
        w->found->all = w->found->all && decided;
        w->found->undecided += decided ? 0 : length_of(ball) / w->length;
        w->done += length_of(ball);
        status = proof.digits > 0 ? add(w, &proof, text) : ISO_OK;
    }
    iso_study_progress(w->result, w->done / w->length);
    return status;
}

static iso_status find_interval(work *w, const iso_proof_ball *ball)
{
    w->found->all = true;
    const iso_status status = divide(w, ball, HALVINGS);
    w->found->all = w->found->all && status == ISO_OK;
    w->found->undecided += fmax(0, 1 - w->done / w->length);
    if (w->tried >= w->request->pieces && !w->found->all)
        iso_study_note(w->result, "it stopped after %ld pieces: --pieces allows more", w->request->pieces);
    return status;
}

static iso_status find_one(work *w, const iso_proof_ball *ball)
{
    iso_proof proof = {.digits = 0};
    char *text = NULL, why[3 * ISO_PROOF_TEXT], expected[ISO_PROOF_TEXT] = "";
    plan p;
    int failed;
    ISO_TRY(make_plan(w->ctx, ball, w->request, &p));
    const iso_status status = find(w->ctx, ball, w->request, &p, &proof, &text, &failed);
    w->found->undecided = proof.sign == 0;
    if (p.decades > 2 * FIRST_DIGITS) snprintf(expected, sizeof expected, "; |m| should be about 1e-%.0f", p.decades);
    if (failed)
        snprintf(why, sizeof why, "undecided at %d digits: %s%s", failed, iso_context_message(w->ctx), expected);
    if (proof.digits == 0) return status == ISO_NUMERICAL ? ISO_FAIL_NUMERICAL(w->ctx, "%s", why) : status;
    if (failed && status == ISO_OK) iso_study_note(w->result, "%s", why);
    const iso_status added = add(w, &proof, text);
    return status == ISO_OK ? added : status;
}

/* --- the study -------------------------------------------------------------------------------------------------- */

static void free_proofs(void *found)
{
    iso_proofs *f = found;
    if (f->certificates) fclose(f->certificates);
    free(f->row);
    free(f);
}

/* In the lines of the table: all of one k, or the sum of the pieces. */
static iso_status fill(iso_context *ctx, const iso_scene *scene, iso_study_result *result)
{
    iso_field fields[ISO_MOST_FIELDS];
    const iso_proofs *f = result->found;
    const bool one = iso_proof_is_thin(&f->row[0].ball);
    iso_fields_copy(one ? iso_proof_fields : iso_proofs_fields, "rows", fields);
    const void *lines = one ? (const void *)&f->row[0] : f;
    ISO_TRY(iso_study_table(ctx, "prove", scene, fields, lines, iso_proof_fields, &result->table[0]));
    for (size_t i = 0; i < f->rows; i++)
        ISO_TRY(iso_columns_append(ctx, iso_proof_fields, &f->row[i], result->table[0]));
    return ISO_OK;
}

static iso_status run(iso_context *ctx, const iso_study_subject *subject, const void *options,
                      iso_study_result *result)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_proof_ball ball;
    if (!iso_proof_is_possible()) return iso_proof_find(ctx, NULL, 0, NULL, NULL, NULL);
    ISO_TRY(read_ball(ctx, subject->scene, options, &ball));
    iso_proofs *f = iso_study_keep(result, calloc(1, sizeof *f), iso_proofs_fields, free_proofs);
    if (!f) return iso_context_no_memory(ctx, "a proof");
    work w = {ctx, options, result, f, length_of(&ball), 0, 0};
    const iso_status status = iso_proof_is_thin(&ball) ? find_one(&w, &ball) : find_interval(&w, &ball);
    if (f->rows == 0 && status == ISO_OK)
        return ISO_FAIL_NUMERICAL(ctx, "no part of this interval of k could be enclosed");
    if (f->rows == 0) return status;
    const iso_status made = fill(ctx, subject->scene, result);
    return status == ISO_OK ? made : status;
}

ISO_STUDY_BEGIN(iso_prove_request, (iso_prove_request){.half_returns = 20000, .pieces = 20000})

#define ROW(name, argument, expected, doc, set, member)                                                              \
    ISO_OPTION(name, argument, expected, doc, set, iso_prove_request, member)

const iso_option iso_prove_option[] = {
    ROW("k", "A:B", "a number or an interval A:B",
        "another k than the scene's, such as 1/3, or an interval: all k from A to B; it is halved where it must be",
        iso_set_text, k),
    ROW("digits", "D", "a whole number from 1 to 400",
        "enclose m to 1e-D (default: 18, 36, 72, until 0 is excluded, without those too few for m, or more where m "
        "is tiny; for an interval as its length asks for)",
        iso_set_count_int, digits),
    ROW("half-returns", "N", "a whole number from 1 on",
        "give up on a k, or on a piece of an interval, after N half returns in all attempts (default 20000)",
        iso_set_count_long, half_returns),
    ROW("pieces", "N", "a whole number from 1 on", "try at most N pieces of an interval of k (default 20000)",
        iso_set_count_long, pieces),
    ISO_OPTION_END,
};

const iso_study iso_prove_study = {
    "prove",
    "enclose the splitting of the separatrix: a proof that there is no further integral",
    iso_prove_option,
    sizeof(iso_prove_request),
    begin,
    .prepare = prepare,
    .run = run,
    .of = ISO_STUDY_OF_SCENE,
    .fields = iso_proofs_fields,
    .print = iso_prove_print};

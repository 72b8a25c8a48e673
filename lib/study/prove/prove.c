/* prove.c - the study `prove`: which balls are enclosed, and how an interval of k is cut into pieces (prove_impl.h). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "orbit/orbit_impl.h"
#include "study/prove/prove_impl.h"
#include "study/study_impl.h"

/* Digits that are tried, if none are asked for; how many intervals are tried, and how often one is halved. */
static const int digits_tried[] = {18, 36, 72};
enum { INTERVALS = 20000, HALVINGS = 40, MOST_DIGITS = 400 };

#define WHAT "an enclosure of m is computed"

/* --- what is asked ---------------------------------------------------------------------------------------------- */

static iso_status prepare(iso_context *ctx, void *options)
{
    const iso_prove_request *r = options;
    if (r->digits <= MOST_DIGITS) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "", "--digits %d: expected a whole number from 1 to %d", r->digits, MOST_DIGITS);
}

/* One double of the scene as the number that was written. */
static iso_status take(iso_context *ctx, const iso_scene *scene, const char *key, double x, iso_rational *r)
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

static iso_status bad_k(iso_context *ctx, const char *text)
{
    return ISO_FAIL_ARGUMENT(ctx, "",
                             "--k '%s': expected a number or an interval A:B that does not hold 0, A < B also as "
                             "doubles, such as 1/3 or 0.5:0.500001",
                             text);
}

/* "K" or "A:B" */
static iso_status read_k(iso_context *ctx, const char *text, iso_rational k[2])
{
    const char *colon = strchr(text, ':'), *second = colon ? colon + 1 : text;
    const size_t first = colon ? (size_t)(colon - text) : strlen(text);
    if (!iso_rational_read(text, first, &k[0]) || !iso_rational_read(second, strlen(second), &k[1]) ||
        (k[0].top < 0) != (k[1].top < 0) || (colon && !(iso_rational_double(&k[0]) < iso_rational_double(&k[1]))))
        return bad_k(ctx, text);
    return ISO_OK;
}

static iso_status take_ball(iso_context *ctx, const iso_scene *scene, const iso_prove_request *r,
                            iso_proof_ball *ball)
{
    const iso_effects acting = iso_scene_acting(scene);
    double level = 0;
    ISO_TRY(iso_refuse_beyond_level(ctx, &acting, WHAT));
    ISO_TRY(iso_level_of_scene(ctx, scene, WHAT, &level));
    if (level != 0)
        return ISO_FAIL_INPUT(ctx, iso_level_name(), WHAT " only of the free ball, on the level H = 0 of its point");
    for (int i = 0; i < 3; i++) ISO_TRY(take(ctx, scene, "J", scene->params.J[i], &ball->J[i]));
    ISO_TRY(iso_refuse_equal_moments(ctx, scene->params.J, "there is no middle axis and no m"));
    if (r->k) return read_k(ctx, r->k, ball->k);
    ISO_TRY(take(ctx, scene, "k", scene->params.k, &ball->k[0]));
    ball->k[1] = ball->k[0];
    return ISO_OK;
}

/* --- one k, or one piece ---------------------------------------------------------------------------------------- */

static void print_exact(iso_proof *p)
{
    const iso_rational *k = p->ball.k;
    char text[2][ISO_RATIONAL_SIZE];
    const bool one = iso_proof_is_thin(&p->ball);
    for (int i = 0; i < 2; i++) iso_rational_print(text[i], &k[i]);
    snprintf(p->exact, sizeof p->exact, "%s%s%s", text[0], one ? "" : ":", one ? "" : text[1]);
}

static double length_of(const iso_proof_ball *ball)
{
    return iso_rational_double(&ball->k[1]) - iso_rational_double(&ball->k[0]);
}

/* As m can change by as much as k does, an interval asks for some more digits than its length has. */
static int digits_of(const iso_proof_ball *ball, const iso_prove_request *r, int attempt)
{
    if (r->digits) return r->digits;
    if (iso_proof_is_thin(ball)) return digits_tried[attempt];
    return (int)fmax(6, ceil(4 - log10(length_of(ball) / fabs(iso_rational_double(&ball->k[0])))));
}

/* With the digits that are asked for, or with more and more until 0 is excluded. What is known stays known if more
 * digits fail. *proof is empty before, and with digits = 0 still after. */
static iso_status find(iso_context *ctx, const iso_proof_ball *ball, const iso_prove_request *r, int tries,
                       iso_proof *proof, char **text)
{
    iso_status status = ISO_OK;
    for (int i = 0; i < tries && status == ISO_OK && proof->sign == 0; i++) {
        iso_proof next;
        char *next_text = NULL;
        const int digits = digits_of(ball, r, i);
        status = iso_proof_find(ctx, ball, digits, &next, r->certificate ? &next_text : NULL);
        if (status != ISO_OK) continue;
        *proof = next;
        print_exact(proof);
        free(*text);
        *text = next_text;
    }
    return proof->digits > 0 && status == ISO_NUMERICAL ? ISO_OK : status;
}

/* Why nothing was enclosed at these digits. */
static iso_status tell_undecided(iso_context *ctx, int digits)
{
    char why[ISO_PROOF_WORDS];
    snprintf(why, sizeof why, "%s", iso_context_message(ctx));
    return iso_context_fail(ctx, ISO_NUMERICAL, "", "undecided at %d digits: %s", digits, why);
}

/* --- an interval ------------------------------------------------------------------------------------------------ */

typedef struct work {
    iso_context *ctx;
    const iso_prove_request *request;
    const iso_study_result *result;
    iso_proofs *found;
    double length, done; /* of the interval */
    long tried;          /* intervals */
} work;

static iso_status add(work *w, const iso_proof *proof, char *text)
{
    iso_proofs *f = w->found;
    iso_proof *row = realloc(f->row, (f->rows + 1) * sizeof *row);
    if (row) f->row = row;
    char **texts = realloc(f->certificate, (f->rows + 1) * sizeof *texts);
    if (texts) f->certificate = texts;
    if (!row || !texts) return free(text), iso_context_no_memory(w->ctx, "%zu pieces", f->rows + 1);
    f->certificate[f->rows] = text;
    f->row[f->rows++] = *proof;
    return ISO_OK;
}

/* Both halves. False: the middle has too many digits. */
static bool halve(const iso_proof_ball *ball, iso_proof_ball half[2])
{
    half[0] = half[1] = *ball;
    if (!iso_rational_middle(&ball->k[0], &ball->k[1], &half[0].k[1])) return false;
    half[1].k[0] = half[0].k[1];
    return true;
}

/* A piece that stays undecided, at the end of all halvings. */
static iso_status give_up(work *w, const iso_proof_ball *ball, const iso_proof *proof, char *text)
{
    w->found->all = false;
    w->found->undecided += length_of(ball) / w->length;
    w->done += length_of(ball);
    return proof->digits > 0 ? add(w, proof, text) : ISO_OK;
}

static iso_status divide(work *w, const iso_proof_ball *ball, int depth)
{
    iso_proof proof = {.digits = 0};
    iso_proof_ball half[2];
    char *text = NULL;
    iso_status status = w->tried < INTERVALS ? find(w->ctx, ball, w->request, 1, &proof, &text) : ISO_NUMERICAL;
    w->tried++;
    if (status != ISO_OK && status != ISO_NUMERICAL) return status;
    if (status == ISO_OK && proof.sign != 0) {
        status = add(w, &proof, text);
        w->done += length_of(ball);
    } else if (depth == 0 || w->tried >= INTERVALS || !halve(ball, half)) {
        status = give_up(w, ball, &proof, text);
    } else {
        free(text);
        status = divide(w, &half[0], depth - 1);
        if (status == ISO_OK) status = divide(w, &half[1], depth - 1);
    }
    iso_study_progress(w->result, w->done / w->length);
    return status;
}

static iso_status find_all(iso_context *ctx, const iso_proof_ball *ball, const iso_prove_request *r,
                           const iso_study_result *result, iso_proofs *found)
{
    iso_proof proof = {.digits = 0};
    char *text = NULL;
    work w = {ctx, r, result, found, length_of(ball), 0, 0};
    if (!iso_proof_is_thin(ball)) {
        found->all = true;
        const iso_status status = divide(&w, ball, HALVINGS);
        found->all = found->all && status == ISO_OK;
        found->undecided += fmax(0, 1 - w.done / w.length);
        return status;
    }
    const int tries = r->digits ? 1 : (int)(sizeof digits_tried / sizeof *digits_tried);
    const iso_status status = find(ctx, ball, r, tries, &proof, &text);
    found->undecided = proof.sign == 0;
    if (proof.digits == 0) return status == ISO_NUMERICAL ? tell_undecided(ctx, digits_of(ball, r, 0)) : status;
    const iso_status added = add(&w, &proof, text);
    return status == ISO_OK ? added : status;
}

/* --- the study -------------------------------------------------------------------------------------------------- */

static void free_proofs(void *found)
{
    iso_proofs *f = found;
    for (size_t i = 0; i < f->rows; i++) free(f->certificate[i]);
    free(f->certificate);
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
    if (!iso_proof_is_possible()) return iso_proof_find(ctx, NULL, 0, NULL, NULL);
    ISO_TRY(take_ball(ctx, subject->scene, options, &ball));
    iso_proofs *f = iso_study_keep(result, calloc(1, sizeof *f), iso_proofs_fields, free_proofs);
    if (!f) return iso_context_no_memory(ctx, "a proof");
    const iso_status status = find_all(ctx, &ball, options, result, f);
    if (f->rows == 0 && status == ISO_OK)
        return iso_context_fail(ctx, ISO_NUMERICAL, "", "no part of this interval of k could be enclosed");
    if (f->rows == 0) return status;
    const iso_status made = fill(ctx, subject->scene, result);
    return status == ISO_OK ? made : status;
}

ISO_STUDY_BEGIN(iso_prove_request, (iso_prove_request){.digits = 0})

#define ROW(name, argument, expected, doc, set, member)                                                              \
    ISO_OPTION(name, argument, expected, doc, set, iso_prove_request, member)

const iso_option iso_prove_option[] = {
    ROW("k", "A:B", "a number or an interval A:B",
        "another k than the scene's, such as 1/3, or an interval: all k from A to B; it is halved where it must be",
        iso_set_text, k),
    ROW("digits", "D", "a whole number from 1 to 400",
        "enclose m to 1e-D (default: 18, then 36, then 72, until 0 is excluded; for an interval as its length asks "
        "for)",
        iso_set_count_int, digits),
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
    .of = ISO_STUDY_OF_SCENE};

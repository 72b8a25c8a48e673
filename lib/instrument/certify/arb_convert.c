/* arb_convert.c - certified rows of one model as rows of the other: the map (18) in balls (certify_impl.h).
 *
 * A file that is read is checked as far as its rows allow: n (or gamma) can be a unit vector, and omega (or M)
 * orthogonal to it. The clocks are in the file, and stay.
 */
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_impl.h"
#include "instrument/certify/arb_certify_impl.h"

typedef struct reader {
    iso_context *ctx;
    FILE *file;
    const char *name;
    const iso_certify_sink *sink;
    iso_model_kind to, from;
    char *line;
    size_t room, number;
    FILE *head; /* of the result, which is passed on when the whole head is known to be good */
    int digits; /* 0: not yet stated */
    certify_exact exact;
    bool has_k, has_J;
    int columns;
    int at[ISO_CLOCKS + CERTIFY_STATE]; /* column of each number that is read */
    certify_ball ball;
} reader;

static iso_status fail(const reader *r, const char *at, const char *text)
{
    return iso_context_placed(r->ctx, ISO_FAIL_INPUT(r->ctx, "", "%s:%zu:%zu: %s", r->name, r->number,
                                                     (size_t)(at ? at - r->line : 0) + 1, text));
}

/* The next line, without its end. */
static bool next_line(reader *r)
{
    const ssize_t got = getline(&r->line, &r->room, r->file);
    if (got < 0) return false;
    r->number++;
    r->line[strcspn(r->line, "\r\n")] = '\0';
    return true;
}

/* --- the head ---------------------------------------------------------------------------------------------------- */

static bool read_fractions(const char *text, int count, fmpq_t x[])
{
    char word[128];
    int used = 0;
    for (int i = 0; i < count; i++, text += used)
        if (sscanf(text, "%127s%n", word, &used) != 1 || !certify_rational_read(word, x[i]) || fmpq_is_zero(x[i]))
            return false;
    return text[strspn(text, " ")] == '\0';
}

/* A line "# key: value". */
static void read_line(reader *r)
{
    const char *line = r->line;
    if (strncmp(line, "# model: ", 9) == 0)
        fprintf(r->head, "# model: %s\n", iso_model_kind_name((int)r->to));
    else
        fprintf(r->head, "%s\n", line);
    if (strncmp(line, "# k: ", 5) == 0) r->has_k = read_fractions(line + 5, 1, &r->exact.k);
    if (strncmp(line, "# J: ", 5) == 0) {
        r->has_J = read_fractions(line + 5, 3, r->exact.J);
        for (int i = 0; i < 3 && r->has_J; i++) r->has_J = fmpq_sgn(r->exact.J[i]) > 0;
    }
    if (strncmp(line, "# digits: ", 10) == 0) r->digits = atoi(line + 10);
}

static bool find_columns(reader *r)
{
    enum { NAMES = ISO_CLOCKS + CERTIFY_STATE };
    const int first = r->from == ISO_BALL ? ISO_COLUMN_BALL : ISO_COLUMN_POINT;
    bool all = true;
    for (int i = 0; i < NAMES; i++) {
        const char *name = iso_column_name(i < ISO_CLOCKS ? i : first + i - ISO_CLOCKS), *at = r->line;
        size_t length = strcspn(at, ",");
        r->at[i] = 0;
        while (at[length] && !(length == strlen(name) && strncmp(at, name, length) == 0))
            at += length + 1, length = strcspn(at, ","), r->at[i]++;
        all = all && length == strlen(name) && strncmp(at, name, length) == 0;
    }
    r->columns = 1;
    for (const char *at = r->line; *at; at++) r->columns += *at == ',';
    return all;
}

static iso_status read_head(reader *r)
{
    bool more = next_line(r);
    if (!more || strcmp(r->line, "# isoroll " ISO_CERTIFIED_KIND " 1") != 0)
        return fail(r, NULL, "expected '# isoroll " ISO_CERTIFIED_KIND " 1', as 'run --certify' writes it");
    for (; more && *r->line == '#'; more = next_line(r)) read_line(r);
    if (!more) return fail(r, NULL, "expected a line of column names");
    if (!r->has_k || !r->has_J) return fail(r, NULL, "expected lines '# k: 1/2' and '# J: 7/5 21/10 3' before this");
    if (r->digits < 1 || r->digits > ISO_MOST_CERTIFIED_DIGITS)
        return fail(r, NULL, "expected a line '# digits: D' before this, D from 1 to 1000");
    if (find_columns(r)) return ISO_OK;
    return fail(r, NULL,
                r->from == ISO_BALL ? "expected the clocks and the columns of the ball, which become the point's"
                                    : "expected the clocks and the columns of the point, which become the ball's");
}

static iso_status convert_head(reader *r)
{
    char *text = NULL;
    size_t length = 0;
    r->head = open_memstream(&text, &length);
    if (!r->head) return iso_context_no_memory(r->ctx, "a head");
    const iso_status status = read_head(r);
    certify_print_columns(r->head, (iso_models)r->to);
    if (status == ISO_OK) return certify_pass(r->ctx, r->sink, r->head, &text);
    fclose(r->head);
    free(text);
    return status;
}

/* --- rows -------------------------------------------------------------------------------------------------------- */

/* One cell, which then ends with '\0'. */
static iso_status read_cell(const reader *r, char *at, fmpq_t x)
{
    at[strcspn(at, ",")] = '\0';
    if (*at && strspn(at, "0123456789+-.eE") == strlen(at) && certify_rational_read(at, x)) return ISO_OK;
    return fail(r, at, "expected a decimal number");
}

static iso_status read_row(reader *r, arb_ptr x)
{
    ISO_BALLS(error);
    fmpq_t number;
    char **cell = malloc((size_t)r->columns * sizeof *cell), *at = r->line;
    int found = 0;
    iso_status status = ISO_OK;
    if (!cell) return iso_context_no_memory(r->ctx, "a row");
    fmpq_init(number);
    for (; at; found++) {
        if (found < r->columns) cell[found] = at;
        at = strchr(at, ',');
        if (at) at++;
    }
    if (found != r->columns) status = fail(r, NULL, "expected one number for each column");
    for (int i = 0; i < ISO_CLOCKS + CERTIFY_STATE && status == ISO_OK; i++) {
        const int c = r->at[i];
        if (c + 1 == r->columns) status = fail(r, NULL, "expected a radius behind each number");
        if (status == ISO_OK) status = read_cell(r, cell[c], number);
        if (status == ISO_OK) arb_set_fmpq(x + i, number, r->ball.bits);
        if (status == ISO_OK) status = read_cell(r, cell[c + 1], number);
        if (status == ISO_OK && fmpq_sgn(number) < 0) status = fail(r, cell[c + 1], "expected a radius >= 0");
        arb_set_fmpq(error, number, 64);
        arb_add_error(x + i, error);
    }
    free(cell);
    fmpq_clear(number);
    return status;
}

static iso_status convert_row(reader *r, arb_ptr x)
{
    char *text = NULL;
    size_t length = 0;
    ISO_BALLS(along, square);
    ISO_TRY(read_row(r, x));
    arb_srcptr y = x + ISO_CLOCKS, unit = y + 3;
    arb_dot(along, NULL, 0, y, 1, unit, 1, 3, r->ball.bits);
    arb_dot(square, NULL, 0, unit, 1, unit, 1, 3, r->ball.bits);
    if (!(arb_contains_zero(along) && arb_contains_si(square, 1)))
        return fail(r, NULL, "this is no state: no unit vector, or the other vector is not orthogonal to it");
    certify_map(&r->ball, r->from, x + ISO_CLOCKS, x + ISO_CLOCKS);
    for (int i = 0; i < CERTIFY_STATE; i++)
        if (!arb_is_finite(x + ISO_CLOCKS + i)) return fail(r, NULL, "the enclosures of this row are too wide");
    FILE *to = open_memstream(&text, &length);
    if (!to) return iso_context_no_memory(r->ctx, "a row");
    certify_write_row(&r->ball, x, r->to, x + ISO_CLOCKS, (iso_models)r->to, r->digits, to);
    return certify_pass(r->ctx, r->sink, to, &text);
}

iso_status iso_certify_convert(iso_context *ctx, FILE *file, const char *name, iso_model_kind to,
                               const iso_certify_sink *sink, size_t *rows)
{
    reader r = {.ctx = ctx, .file = file, .name = name, .sink = sink, .to = to};
    *rows = 0;
    r.from = to == ISO_BALL ? ISO_POINT : ISO_BALL;
    ISO_BALL_ROW(x, ISO_CLOCKS + CERTIFY_STATE);
    certify_exact_init(&r.exact);
    iso_status status = convert_head(&r);
    iso_balls_init(&r.ball, offsetof(certify_ball, bits));
    r.ball.bits = (slong)(3.4 * r.digits) + 80;
    if (status == ISO_OK) certify_ball_set(&r.ball, &r.exact);
    while (status == ISO_OK && next_line(&r)) {
        status = iso_context_goes_on(ctx) ? convert_row(&r, x) : iso_context_stopped(ctx);
        *rows += status == ISO_OK;
    }
    iso_balls_clear(&r.ball, offsetof(certify_ball, bits));
    certify_exact_clear(&r.exact);
    free(r.line);
    return status;
}

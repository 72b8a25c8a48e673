/* expression.c - reads expressions that a scene has as text (expression_impl.h): recursive descent, with bounds on
 * depth and size. */
#include "model/expression/expression_impl.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/math_impl.h"
#include "base/names_impl.h"
#include "base/number_impl.h"

typedef struct reader {
    const char *text;
    int at, depth; /* at: of the next character that is no blank */
    const iso_expression_names *names;
    iso_expression *e;
} reader;

/* What stands for a node that could not be made. All later failures are silent: the first one is the mistake. */
enum { FAILED = -1 };

__attribute__((format(printf, 3, 4))) static int fail(reader *r, int at, const char *format, ...)
{
    va_list arguments;
    if (r->e->wrong[0]) return FAILED;
    r->e->at = at;
    va_start(arguments, format);
    vsnprintf(r->e->wrong, sizeof r->e->wrong, format, arguments);
    va_end(arguments);
    return FAILED;
}

/* --- nodes ------------------------------------------------------------------------------------------------------ */

/* The degree of a node of degrees a and b. */
static int degree_of(iso_term term, int a, int b)
{
    const int larger = a > b ? a : b;
    switch (term) {
    case ISO_TERM_N: return ISO_LINEAR;
    case ISO_TERM_OMEGA:
    case ISO_TERM_E: return ISO_GENERAL;
    case ISO_TERM_ADD:
    case ISO_TERM_SUB:
    case ISO_TERM_NEGATIVE: return larger;
    case ISO_TERM_MUL: return a + b < ISO_GENERAL ? a + b : ISO_GENERAL;
    case ISO_TERM_DIV: return b == ISO_CONSTANT ? a : ISO_GENERAL;
    default: return larger == ISO_CONSTANT ? ISO_CONSTANT : ISO_GENERAL;
    }
}

/* The node, an old one where there is the same. a and b: nodes of an operation, or which number of J, n, ... */
static int make(reader *r, int at, iso_term term, int a, int b, double value)
{
    iso_expression *e = r->e;
    if (e->wrong[0] || a == FAILED || b == FAILED) return FAILED;
    for (int i = 0; i < e->nodes; i++) {
        const iso_expression_node *old = &e->node[i];
        if (old->term == term && old->a == a && old->b == b && memcmp(&old->value, &value, sizeof value) == 0)
            return i;
    }
    if (e->nodes == ISO_EXPRESSION_NODES)
        return fail(r, at, "an expression has at most %d numbers, names and operations", ISO_EXPRESSION_NODES);
    const int of_a = is_operation(term) ? e->node[a].degree : 0, of_b = has_two(term) ? e->node[b].degree : 0;
    const bool is_square = term == ISO_TERM_POWER && of_a == ISO_LINEAR && e->node[b].term == ISO_TERM_NUMBER &&
                           e->node[b].value == 2; /* two factors of degree 1 that are one power: n1^2 */
    const int degree = is_square ? ISO_QUADRATIC : degree_of(term, of_a, of_b);
    if (term <= ISO_TERM_E) e->reads[term] = true;
    e->node[e->nodes] =
        (iso_expression_node){(uint8_t)term, (uint8_t)degree, (int16_t)a, (int16_t)b, (int16_t)at, value};
    return e->nodes++;
}

/* --- names ------------------------------------------------------------------------------------------------------ */

/* What a name means: a node, or a function (of tan: the quotient of sin and cos). */
typedef struct meaning {
    const char *name;
    iso_term term;
    int which;
} meaning;

static const meaning known[] = {
    {"n1", ISO_TERM_N, 0},         {"n2", ISO_TERM_N, 1},         {"n3", ISO_TERM_N, 2},
    {"omega1", ISO_TERM_OMEGA, 0}, {"omega2", ISO_TERM_OMEGA, 1}, {"omega3", ISO_TERM_OMEGA, 2},
    {"e1", ISO_TERM_E, 0},         {"e2", ISO_TERM_E, 1},         {"e3", ISO_TERM_E, 2},
    {"k", ISO_TERM_K, 0},          {"J1", ISO_TERM_J, 0},         {"J2", ISO_TERM_J, 1},
    {"J3", ISO_TERM_J, 2},         {"pi", ISO_TERM_NUMBER, 0},    {"sqrt", ISO_TERM_SQRT, 0},
    {"exp", ISO_TERM_EXP, 0},      {"log", ISO_TERM_LOG, 0},      {"sin", ISO_TERM_SIN, 0},
    {"cos", ISO_TERM_COS, 0},      {"tan", ISO_TERM_DIV, 0}};
enum { KNOWN = sizeof known / sizeof *known };

/* What people write, and what to write instead. */
static const struct {
    const char *name, *instead;
} others[] = {
    {"abs", "a function with a corner has no series there; sqrt(x^2 + a^2) with a small a is smooth"},
    {"sign", "a function with a jump has no series there; x/sqrt(x^2 + a^2) with a small a is smooth"},
    {"min", "a function with a corner has no series there"},
    {"max", "a function with a corner has no series there"},
    {"t", "the equations do not change with time"},
    {"time", "the equations do not change with time"},
    {"ln", "the natural logarithm is written log"},
    {"pow", "a power is written x^y"},
};
enum { OTHERS = sizeof others / sizeof *others };

/* NULL: it has none. */
static const meaning *find_meaning(const char *name)
{
    for (int i = 0; i < KNOWN; i++)
        if (strcmp(known[i].name, name) == 0) return &known[i];
    return NULL;
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

const char *iso_expression_bad_name(const char *name)
{
    const meaning *own = find_meaning(name);
    bool good = is_letter(name[0]) && strlen(name) < ISO_PARAMETER_SIZE;
    for (const char *c = name; *c; c++) good = good && (is_letter(*c) || is_digit(*c));
    if (!good) return "a name has a letter first, then letters, digits and _, at most 15 in all";
    if (own && is_operation(own->term)) return "this is the name of a function";
    return own || strcmp(name, "t") == 0 ? "this name has a meaning of its own" : NULL;
}

static bool is_allowed(const reader *r, iso_term term)
{
    return r->names->moving || (term != ISO_TERM_OMEGA && term != ISO_TERM_E);
}

static int fail_name(reader *r, int at, const char *name, bool function)
{
    const char *names[KNOWN + ISO_PARAMETERS];
    char suggested[ISO_SUGGEST_SIZE];
    size_t count = 0;
    for (int i = 0; i < OTHERS; i++)
        if (strcmp(others[i].name, name) == 0) return fail(r, at, "there is no '%s': %s", name, others[i].instead);
    for (int i = 0; !function && i < ISO_PARAMETERS && r->names->parameter[i][0]; i++)
        names[count++] = r->names->parameter[i];
    for (int i = 0; i < KNOWN; i++)
        if (is_operation(known[i].term) == function && known[i].term != ISO_TERM_NUMBER &&
            is_allowed(r, known[i].term))
            names[count++] = known[i].name;
    iso_suggest(suggested, name, count, names);
    if (function) return fail(r, at, "unknown function '%s'; %s", name, suggested);
    return fail(r, at, "unknown name '%s'; %s%s names of your own stand in 'parameters'", name, suggested,
                suggested[strlen(suggested) - 1] == '?' ? "" : ";");
}

/* --- the grammar ------------------------------------------------------------------------------------------------ */

static void skip_blanks(reader *r)
{
    while (r->text[r->at] == ' ' || r->text[r->at] == '\t' || r->text[r->at] == '\n') r->at++;
}

/* Whether the next character is c, which is then behind. */
static bool take(reader *r, char c)
{
    if (r->text[r->at] != c) return false;
    r->at++;
    skip_blanks(r);
    return true;
}

/* "'x'", or "the end": what stands there. */
static const char *what_stands(const reader *r, char out[16])
{
    const unsigned char c = (unsigned char)r->text[r->at];
    if (c == '\0') return "the end";
    snprintf(out, 16, c > ' ' && c < 0x7f ? "'%c'" : "byte 0x%02X", c);
    return out;
}

static int sum(reader *r);
static int factor(reader *r);

static int number(reader *r)
{
    const int begin = r->at;
    const char *t = r->text;
    int end = begin;
    double value;
    while (is_digit(t[end]) || t[end] == '.') end++;
    if (t[end] == 'e' || t[end] == 'E') {
        end += t[end + 1] == '+' || t[end + 1] == '-' ? 2 : 1;
        while (is_digit(t[end])) end++;
    }
    if (!iso_number_read(t + begin, (size_t)(end - begin), &value))
        return fail(r, begin, "'%.*s' is no number of double precision", end - begin > 32 ? 32 : end - begin,
                    t + begin);
    r->at = end;
    skip_blanks(r);
    return make(r, begin, ISO_TERM_NUMBER, 0, 0, value);
}

/* The sum in parentheses that are open, behind a name that begins at `at`. */
static int argument(reader *r, int at, const char *name)
{
    char there[16];
    const int a = sum(r), open = at + (int)strlen(name) + 1;
    if (a != FAILED && !take(r, ')'))
        return fail(r, r->at, "expected ')' that closes the '(' in column %d of the text, not %s", open,
                    what_stands(r, there));
    return a;
}

static int word(reader *r)
{
    const int at = r->at;
    char name[ISO_PARAMETER_SIZE];
    while (is_letter(r->text[r->at]) || is_digit(r->text[r->at])) r->at++;
    snprintf(name, sizeof name, "%.*s", r->at - at, r->text + at);
    if (r->at - at >= (int)sizeof name) return fail_name(r, at, name, false);
    skip_blanks(r);
    for (int i = 0; i < ISO_PARAMETERS && r->names->parameter[i][0]; i++)
        if (strcmp(r->names->parameter[i], name) == 0) return make(r, at, ISO_TERM_PARAMETER, i, 0, 0);
    const meaning *m = find_meaning(name);
    if (m && !is_operation(m->term)) {
        if (is_allowed(r, m->term)) return make(r, at, m->term, m->which, 0, m->term == ISO_TERM_NUMBER ? ISO_PI : 0);
        return fail(r, at, "a potential depends on n alone: '%s' is for 'torque'", name);
    }
    if (!take(r, '('))
        return m ? fail(r, at + (int)strlen(name), "expected '(': '%s' is a function", name)
                 : fail_name(r, at, name, false);
    if (!m) return fail_name(r, at, name, true);
    const int a = argument(r, at, name);
    if (m->term != ISO_TERM_DIV) return make(r, at, m->term, a, 0, 0);
    return make(r, at, ISO_TERM_DIV, make(r, at, ISO_TERM_SIN, a, 0, 0), make(r, at, ISO_TERM_COS, a, 0, 0), 0);
}

static int atom(reader *r)
{
    const char c = r->text[r->at];
    char there[16];
    const int at = r->at;
    if (is_digit(c) || c == '.') return number(r);
    if (is_letter(c)) return word(r);
    if (take(r, '(')) return argument(r, at, "");
    return fail(r, at, "expected a number, a name or '(', not %s", what_stands(r, there));
}

static int power(reader *r)
{
    const int base = atom(r), at = r->at;
    if (base == FAILED || !take(r, '^')) return base;
    const int exponent = factor(r);
    const iso_expression_node *number = exponent == FAILED ? NULL : &r->e->node[exponent];
    if (number && number->term == ISO_TERM_NUMBER && number->value == 0) /* 1, also of a base of 0 */
        return make(r, at, ISO_TERM_NUMBER, 0, 0, 1);
    return make(r, at, ISO_TERM_POWER, base, exponent, 0);
}

static int factor(reader *r)
{
    const int at = r->at;
    int a = FAILED;
    if (++r->depth > ISO_EXPRESSION_DEPTH)
        fail(r, at, "parentheses, powers and signs are nested more than %d deep", ISO_EXPRESSION_DEPTH);
    else if (take(r, '-'))
        a = make(r, at, ISO_TERM_NEGATIVE, factor(r), 0, 0);
    else
        a = take(r, '+') ? factor(r) : power(r);
    r->depth--;
    return a;
}

/* operand { (sign) operand }, from left to right. The two signs stand for `first` and for the term behind it. */
static int left_to_right(reader *r, int (*operand)(reader *r), const char signs[2], iso_term first)
{
    int a = operand(r);
    while (a != FAILED) {
        const int at = r->at;
        if (strncmp(r->text + at, "**", 2) == 0) return fail(r, at, "a power is written x^y");
        if (take(r, signs[0]))
            a = make(r, at, first, a, operand(r), 0);
        else if (take(r, signs[1]))
            a = make(r, at, first + 1, a, operand(r), 0);
        else
            break;
    }
    return a;
}

static int product(reader *r)
{
    return left_to_right(r, factor, "*/", ISO_TERM_MUL);
}

static int sum(reader *r)
{
    return left_to_right(r, product, "+-", ISO_TERM_ADD);
}

bool iso_expression_read(const char *text, const iso_expression_names *names, iso_expression *e)
{
    reader r = {.text = text, .names = names, .e = e};
    char there[16];
    e->nodes = e->at = 0;
    e->wrong[0] = '\0';
    memset(e->reads, 0, sizeof e->reads);
    skip_blanks(&r);
    if (text[r.at] == '\0') fail(&r, 0, "the text is empty: expected an expression");
    e->root = sum(&r);
    const char c = text[r.at];
    if (c == ')') fail(&r, r.at, "')' closes no '('");
    if (c != '\0')
        fail(&r, r.at,
             is_letter(c) || is_digit(c) || c == '(' || c == '.'
                 ? "expected an operator before %s: a product is written a*b"
                 : "expected an operator (+ - * / ^) or the end, not %s",
             what_stands(&r, there));
    return e->wrong[0] == '\0';
}

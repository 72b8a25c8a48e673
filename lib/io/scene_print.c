/* scene_print.c - prints a scene (scene_print_impl.h), a line for each section and for each effect. */
#include "io/scene_print_impl.h"

#include <math.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/math_impl.h"
#include "base/number_impl.h"
#include "base/rational_impl.h"
#include "orbit/orbit_impl.h"

typedef struct printer {
    FILE *to;
    const char *section; /* that is open; NULL: none */
    int keys;            /* in it so far             */
} printer;

/* --- keys and values -------------------------------------------------------------------------------------------- */

static void close_section(printer *p)
{
    if (p->section) fputs("}\n", p->to);
    p->section = NULL;
}

static void open_section(printer *p, const char *before, const char *section)
{
    close_section(p);
    fprintf(p->to, "%s%s: {", before, section);
    p->section = section;
    p->keys = 0;
}

/* Begins the value of a key in a section, which may be open. The six numbers of a start are too long for one line. */
static void print_key(printer *p, const char *section, const char *key)
{
    if (!p->section || strcmp(p->section, section) != 0) open_section(p, "", section);
    const char *comma = strcmp(section, "initial") == 0 ? ",\n          " : ", ";
    fprintf(p->to, "%s%s: ", p->keys++ > 0 ? comma : "", key);
}

static void print_word(printer *p, const char *section, const char *key, const char *word)
{
    print_key(p, section, key);
    fputs(word, p->to);
}

/* A number, a list, or a matrix of nine. */
static void print_numbers(printer *p, const char *section, const char *key, int count, const double x[])
{
    const int row = count == 9 ? 3 : count;
    print_key(p, section, key);
    if (count == 9) fputc('[', p->to);
    for (int i = 0; i < count; i++)
        fprintf(p->to, "%s%s%s%s", i > 0 ? ", " : "", count > 1 && i % row == 0 ? "[" : "", ISO_SHORT(x[i]),
                count > 1 && i % row == row - 1 ? "]" : "");
    if (count == 9) fputc(']', p->to);
}

/* Numbers that may be written as fractions: 1/3 if that is what the double stands for. */
static void print_ratios(printer *p, const iso_scene *s, const char *section, const char *key, int count,
                         const double x[])
{
    enum { LONG = 17, LARGEST = 9999 }; /* characters of a decimal; below */
    print_key(p, section, key);
    for (int i = 0; i < count; i++) {
        iso_rational r;
        char fraction[ISO_RATIONAL_SIZE];
        const char *text = ISO_SHORT(x[i]);
        if (strlen(text) > LONG && !iso_scene_is_rounded(s, key) && iso_rational_of(x[i], &r) && r.below <= LARGEST)
            text = iso_rational_print(fraction, &r);
        fprintf(p->to, "%s%s%s", i > 0 ? ", " : count > 1 ? "[" : "", text, count > 1 && i == count - 1 ? "]" : "");
    }
}

static void print_quoted(printer *p, const char *text)
{
    fputc('"', p->to);
    for (; *text; text++) {
        const bool special = *text == '"' || *text == '\\' || (unsigned char)*text < ' ';
        fprintf(p->to, special ? "\\x%02x" : "%c", (unsigned)(unsigned char)*text);
    }
    fputc('"', p->to);
}

/* --- effects ---------------------------------------------------------------------------------------------------- */

/* Whether a scene states the number: it must, it is not as usual, or `all` are. */
static bool is_stated(const iso_scene *s, iso_effect_id id, const iso_effect_number *n, bool all)
{
    const iso_effects usual = iso_effects_default();
    const double *x = iso_effect_values(&s->effects, id, n);
    if (n->hidden || !all_finite(x, n->count)) return false;
    if (n->of != ISO_OF_ANY_BALL) return (n->of == ISO_OF_BODY) == (s->params.body.surface != ISO_REDUCED);
    return all || n->required || memcmp(x, iso_effect_values(&usual, id, n), (size_t)n->count * sizeof *x) != 0;
}

/* What the scene writes of an effect: its expressions, each with a key or all in a list, and its parameters. */
static void print_written(printer *p, const iso_scene *s, iso_effect_id id)
{
    const iso_effect *e = iso_effect_list[id];
    const iso_written *w = &s->effects.written[e->written];
    if (e->expressions_key) print_key(p, p->section, e->expressions_key);
    for (int i = 0; e->expressions[i]; i++) {
        if (!iso_written_has(&s->effects, id, i)) continue;
        if (e->expressions_key)
            fputs(i > 0 ? ", " : "[", p->to);
        else
            print_key(p, p->section, e->expressions[i]);
        print_quoted(p, w->expression[i]);
    }
    if (e->expressions_key) fputc(']', p->to);
    for (int i = 0; i < ISO_PARAMETERS && w->parameter[i][0]; i++) {
        if (i == 0) print_key(p, p->section, "parameters");
        fprintf(p->to, "%s%s: %s", i > 0 ? ", " : "{", w->parameter[i], ISO_SHORT(s->effects.number[id][i]));
    }
    if (w->parameter[0][0]) fputc('}', p->to);
}

/* Where nothing is stated, as of a field of zeros, `complete` may still want a number: then all are. */
static void print_effect(printer *p, const iso_scene *s, iso_effect_id id)
{
    const iso_effect *e = iso_effect_list[id];
    const bool point = s->start.model == ISO_POINT;
    const char *name = point && e->point_name ? e->point_name : e->name;
    int stated = 0;
    open_section(p, "  ", name);
    if (e->expressions) print_written(p, s, id);
    for (int all = 0; all <= (e->complete != NULL) && stated == 0; all++)
        for (const iso_effect_number *n = e->numbers; n && n->name; n++) {
            const double *x = iso_effect_values(&s->effects, id, n);
            if (!is_stated(s, id, n, all > 0)) continue;
            stated++;
            if (n->kind == ISO_NUMBER_FLAG)
                print_word(p, name, n->name, *x != 0 ? "true" : "false");
            else if (n->kind == ISO_NUMBER_WORD)
                print_word(p, name, n->name, n->word((int)*x));
            else
                print_numbers(p, name, n->name, n->count, x);
        }
    if (point && e->needs_D && s->params.D > 0) print_numbers(p, name, "D", 1, &s->params.D);
}

/* --- the scene -------------------------------------------------------------------------------------------------- */

static void print_model(printer *p, const iso_scene *s)
{
    const iso_body *b = &s->params.body;
    const bool point = s->start.model == ISO_POINT;
    const char *model = point ? "point" : "reduced";
    if (b->surface != ISO_REDUCED && !point) {
        print_numbers(p, "ball", "mass", 1, &b->mass);
        print_numbers(p, "ball", "radius", 1, &b->radius);
        print_numbers(p, "ball", "inertia", 3, b->inertia);
        print_word(p, "surface", "kind", iso_surface_name((int)b->surface));
        if (b->surface != ISO_PLANE) print_numbers(p, "surface", "radius", 1, &b->surface_radius);
        return;
    }
    print_ratios(p, s, model, "k", 1, &s->params.k);
    print_ratios(p, s, model, "J", 3, s->params.J);
    if (!point && s->params.D > 0) print_numbers(p, model, "D", 1, &s->params.D);
    if (point && !isnan(s->start.eps)) print_numbers(p, model, "eps", 1, &s->start.eps);
}

static void print_how(printer *p, const iso_scene *s)
{
    const iso_scene usual = iso_scene_default();
    if (s->backend != usual.backend) print_word(p, "solver", "backend", iso_backend_name((int)s->backend));
    if (strcmp(s->method, usual.method) != 0) print_word(p, "solver", "method", s->method);
    if (s->tolerance != usual.tolerance) print_numbers(p, "solver", "tolerance", 1, &s->tolerance);
    if (s->as != usual.as) print_word(p, "output", "as", iso_models_name((int)s->as));
    if (s->columns > 0) print_key(p, "output", "columns");
    for (size_t i = 0; i < s->columns; i++)
        fprintf(p->to, "%s%s%s", i > 0 ? ", " : "[", s->column[i], i + 1 == s->columns ? "]" : "");
}

void iso_scene_print(const iso_scene *s, FILE *to)
{
    ISO_DEFAULT_ARITHMETIC;
    printer p = {.to = to};
    const bool point = s->start.model == ISO_POINT;
    bool effects = false;
    print_model(&p, s);
    print_numbers(&p, "initial", point ? "gamma" : "normal", 3, s->start.y + 3);
    print_numbers(&p, "initial", point ? "M" : "angular_velocity", 3, s->start.y);
    print_numbers(&p, "time", "end", 1, &s->end);
    if (s->step > 0) print_numbers(&p, "time", "step", 1, &s->step);
    close_section(&p);
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        if (!s->effects.on[e]) continue;
        if (!effects) fputs("effects:\n", to);
        effects = true;
        print_effect(&p, s, e);
    }
    close_section(&p);
    print_how(&p, s);
    close_section(&p);
}

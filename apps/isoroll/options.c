/* options.c - one table of options: how each is read, and how --help shows it. */
#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "command.h"

static bool set_text(void *at, const char *text)
{
    *(const char **)at = text;
    return *text != '\0';
}

static bool set_flag(void *at, const char *text)
{
    (void)text;
    return *(bool *)at = true;
}

static bool set_number(void *at, const char *text)
{
    return iso_number_read(text, strlen(text), at);
}

static bool set_tolerance(void *at, const char *text)
{
    return set_number(at, text) && *(double *)at >= ISO_LEAST_TOLERANCE && *(double *)at <= ISO_MOST_TOLERANCE;
}

static bool set_positive(void *at, const char *text)
{
    return set_number(at, text) && *(double *)at > 0;
}

static bool set_count(void *at, const char *text)
{
    return set_number(at, text) && *(double *)at >= 1 && *(double *)at == floor(*(double *)at);
}

/* The number is optional. */
static bool set_horizons(void *at, const char *text)
{
    const bool set = set_count(at, text ? text : "6");
    return set && *(double *)at <= ISO_COST_HORIZONS;
}

static bool set_bound(void *at, const char *text)
{
    return set_number(at, text) && *(double *)at >= 0;
}

/* Three numbers with commas between. */
static bool set_vector(void *at, const char *text)
{
    double *x = at;
    for (int i = 0; i < 3; i++) {
        const size_t length = strcspn(text, ",");
        if (!iso_number_read(text, length, &x[i]) || (text[length] == ',') != (i < 2)) return false;
        text += length + 1;
    }
    return true;
}

static bool set_picture(void *at, const char *text)
{
    for (int i = 0; iso_picture_name(i); i++)
        if (strcmp(text, iso_picture_name(i)) == 0) return *(iso_picture *)at = (iso_picture)i, true;
    return false;
}

static bool set_backend(void *at, const char *text)
{
    return strcmp(text, "both") != 0 && set_picture(at, text);
}

static bool set_as(void *at, const char *text)
{
    return strcmp(text, "auto") != 0 && strcmp(text, "exact") != 0 && set_picture(at, text);
}

static bool set_target(void *at, const char *text)
{
    return set_as(at, text) && set_backend(at, text);
}

static bool set_method(void *at, const char *text)
{
    if (strcmp(text, "auto") != 0 && !iso_method_find(text)) return false;
    return set_text(at, text);
}

static bool set_digits(void *at, const char *text)
{
    double digits = ISO_HEXADECIMAL;
    const bool set = strcmp(text, "hex") == 0 || (set_count(&digits, text) && digits <= 17);
    *(int *)at = (int)digits;
    return set;
}

static const struct row {
    const char *name, *argument, *expected, *doc;
    bool (*set)(void *at, const char *text);
    size_t offset;
} table[] = {
#define AT(field) offsetof(options, field)
    {"output", "FILE", "a file", "write there, - is standard output (-o FILE)", set_text, AT(output)},
    {"backend", "B", "ball, point, exact or auto", "what finds the orbit: ball, point, exact, auto", set_backend,
     AT(backend)},
    {"method", "NAME", "a method of 'isoroll list methods', or auto", "integrator, or auto", set_method, AT(method)},
    {"tol", "X", "a number in [1e-15, 0.1]", "largest relative error of one step, in [1e-15, 0.1]", set_tolerance,
     AT(tolerance)},
    {"as", "WHAT", "ball, point or both", "what is written: ball, point, both", set_as, AT(as)},
    {"to", "MODEL", "ball or point", "the model converted to: ball, point", set_target, AT(to)},
    {"t-end", "T", "a number", "last time, in place of the scene's", set_number, AT(end)},
    {"step", "DT", "a positive number", "between rows, in place of the scene's", set_positive, AT(step)},
    {"times", "FILE", "a file", "output times from a file, in any order; # begins a comment", set_text, AT(times)},
    {"rows", "N", "a whole number from 1 on", "rows of the table that are printed (default 6)", set_count, AT(rows)},
    {"turns", "N", "a positive number",
     "length of the orbit of an estimate, in turns, 20 or more (default 1000, more if needed)", set_positive,
     AT(turns)},
    {"samples", "N", "a whole number from 1 on", "of that orbit, made a power of 2 (default 32 each turn)", set_count,
     AT(samples)},
    {"quick", NULL, NULL, "three tolerances, a few seconds", set_flag, AT(quick)},
    {"want", "X", "a positive number", "print only the cheapest choice with an error of at most X", set_positive,
     AT(want)},
    {"horizons", "[=N]", "a whole number from 1 to 24", "growth over N orbits (6), each twice as long as the one before",
     set_horizons, AT(horizons)},
    {"csv", "FILE", "a file", "write the table as CSV, - is standard output", set_text, AT(csv)},
    {"plot", "FILE", "a file", "draw a picture: .svg, .png or .pdf", set_text, AT(plot)},
    {"json", NULL, NULL, "print everything as JSON", set_flag, AT(json)},
    {"k", "K", "a number", "geometry number (where a file does not say)", set_number, AT(k)},
    {"J", "J1,J2,J3", "three numbers J1,J2,J3", "moments about the contact point (likewise)", set_vector, AT(J)},
    {"eps", "X", "a number", "coupling of the point's potential (likewise)", set_number, AT(eps)},
    {"h", "X", "a number", "energy of the ball, in place of eps", set_number, AT(h)},
    {"neumann", "C", "three numbers C1,C2,C3", "C1,C2,C3: Neumann's problem V = (1/2) sum C_i gamma_i^2", set_vector,
     AT(neumann)},
    {"energy", "E", "a number", "of the point, M^2/2 + V (default 0)", set_number, AT(energy)},
    {"level", NULL, NULL, "k = -1: a ball in the potential of a level, also where there is a free one", set_flag,
     AT(level)},
    {"mass", "M", "a positive number", "of the ball (default 1)", set_positive, AT(mass)},
    {"radius", "B", "a positive number", "of the ball (default 1)", set_positive, AT(radius)},
    {"max", "X", "a number from 0 on", "exit with 1 if any residual is larger", set_bound, AT(bound)},
    {"digits", "N", "1 to 17, or hex", "significant digits of numbers, 1 to 17 (default), or hex (-p N)", set_digits,
     AT(digits)},
    {"scene", "FILE", "a file", "a scene that says k, J and the effects", set_text, AT(scene)},
    {"columns", "NAMES", "names with commas between", "the file's columns from left to right, - for others", set_text,
     AT(columns)},
    {"max-defect", "X", "a number from 0 on", "exit with 1 if a row is farther off the orbit of the one before", set_bound,
     AT(max_defect)},
    {"shift-J", NULL, NULL, "k = -1: a point off H = 0 becomes a free ball, of moments J + E/eps", set_flag, AT(shift_J)},
    {"strict", NULL, NULL, "stop at the first bad row", set_flag, AT(strict)},
    {"quiet", NULL, NULL, "no summary on stderr", set_flag, AT(quiet)},
    {"verbose", NULL, NULL, "tell on stderr how it went, and the error", set_flag, AT(verbose)},
    {"help", NULL, NULL, "this text (-h)", set_flag, AT(help)},
#undef AT
};
enum { ROWS = sizeof table / sizeof *table, LONG = 256 /* above all letters */ };

static bool takes(const command *c, const struct row *r)
{
    char name[32];
    snprintf(name, sizeof name, " %s ", r->name);
    return strstr(c->options, name) || strcmp(r->name, "help") == 0;
}

void options_help(const command *c, FILE *to)
{
    fprintf(to, "usage: isoroll %s [options] %s\n%s\n\n", c->name, c->argument, c->doc);
    for (int i = 0; i < ROWS; i++)
        if (takes(c, &table[i]))
            fprintf(to, "  --%-10s %-9s %s\n", table[i].name, table[i].argument ? table[i].argument : "",
                    table[i].doc);
    if (c->more) fprintf(to, "\n%s\n", c->more);
}

static bool set_option(const command *c, const struct row *r, const char *text, options *o)
{
    if (r->set((char *)o + r->offset, text)) return true;
    complain("%s: --%s '%s': expected %s", c->name, r->name, text, r->expected);
    return false;
}

static bool usage(const command *c, const char *what, const char *which)
{
    complain("%s: %s%s; see 'isoroll %s --help'", c->name, what, which, c->name);
    return false;
}

/* What getopt_long did not know: a letter, which it tells, or a long option. */
static bool unknown(const command *c, char **argv)
{
    const char letter[] = {'-', (char)optopt, '\0'};
    return usage(c, "unknown or ambiguous option ", optopt > 0 && optopt < LONG ? letter : argv[optind - 1]);
}

/* The row of what getopt_long found: LONG + its index, -o, -p or -h. */
static const struct row *found_row(int found)
{
    const struct row *r = &table[found < LONG ? 0 : found - LONG];
    const char *name = found == 'o' ? "output" : found == 'p' ? "digits" : "help";
    while (found < LONG && strcmp(r->name, name) != 0) r++;
    return r;
}

/* The one argument after the options. */
static bool set_file(const command *c, int argc, char **argv, options *o)
{
    const bool optional = c->argument[0] == '[';
    if (argc > optind + 1) return usage(c, "one argument too many: ", argv[optind + 1]);
    if (argc == optind && !optional && !o->help) return usage(c, "missing argument ", c->argument);
    o->file = argc > optind ? argv[optind] : "-";
    return true;
}

/* Whether two paths (NULL: none, "-": the standard stream that is given) name the same regular file. */
static bool same_file(const char *a, const char *b, const char *stream)
{
    struct stat x, y;
    if (!a || !b || stat(strcmp(a, "-") == 0 ? stream : a, &x) != 0 || stat(strcmp(b, "-") == 0 ? stream : b, &y) != 0)
        return false;
    return S_ISREG(x.st_mode) && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

/* What is written takes nothing's place that is read, or written too. */
static bool files_are_apart(const command *c, const options *o)
{
    const char *const written[] = {o->output, o->plot, o->csv};
    for (int i = 0; i < 3; i++) {
        const char *path = written[i];
        if (!path || strcmp(path, "-") == 0) continue;
        if (same_file(o->file, path, "/dev/stdin") || same_file(o->times, path, "/dev/stdin"))
            return complain("%s: '%s' would overwrite what is read", c->name, path), false;
        for (int j = 0; j < i; j++)
            if (written[j] && (strcmp(path, written[j]) == 0 || same_file(path, written[j], "/dev/null")))
                return complain("%s: '%s' would be two files in one", c->name, path), false;
    }
    return true;
}

static int argument_of(const struct row *r)
{
    return !r->argument ? no_argument : r->argument[0] == '[' ? optional_argument : required_argument;
}

bool options_read(const command *c, int argc, char **argv, options *o)
{
    struct option known[ROWS + 1] = {{0}};
    int count = 0, found;
    for (int i = 0; i < ROWS; i++)
        if (takes(c, &table[i]))
            known[count++] = (struct option){table[i].name, argument_of(&table[i]), NULL, LONG + i};
    *o = (options){.output = "-",
                   .method = NULL,
                   .backend = (iso_picture)-1,
                   .as = (iso_picture)-1,
                   .to = (iso_picture)-1,
                   .tolerance = NAN,
                   .end = NAN,
                   .step = NAN,
                   .k = NAN,
                   .eps = NAN,
                   .h = NAN,
                   .bound = NAN,
                   .J = {NAN, NAN, NAN},
                   .neumann = {NAN, NAN, NAN},
                   .energy = NAN,
                   .mass = 1,
                   .radius = 1,
                   .rows = 6,
                   .turns = NAN,
                   .samples = NAN,
                   .want = NAN,
                   .digits = 17,
                   .max_defect = NAN};
    opterr = 0;
    const bool has_output = strstr(c->options, " output ") != NULL, has_digits = strstr(c->options, " digits ") != NULL;
    const char *letters = has_digits ? ":ho:p:" : has_output ? ":ho:" : ":h";
    while ((found = getopt_long(argc, argv, letters, known, NULL)) != -1) {
        if (found == ':') return usage(c, "an argument is missing after ", argv[optind - 1]);
        if (found == '?') return unknown(c, argv);
        if (!set_option(c, found_row(found), optarg, o)) return false;
    }
    return set_file(c, argc, argv, o) && (o->help || files_are_apart(c, o));
}

iso_status scene_with_options(iso_context *ctx, const options *o, iso_scene *scene)
{
    const iso_status status = iso_scene_read(ctx, o->file, scene);
    if (status != ISO_OK) return status;
    if ((int)o->backend >= 0) scene->backend = o->backend;
    if ((int)o->as >= 0) scene->as = o->as, scene->columns = 0;
    if (o->method) snprintf(scene->method, sizeof scene->method, "%s", o->method);
    if (!isnan(o->tolerance)) scene->tolerance = o->tolerance;
    if (!isnan(o->end)) scene->end = o->end;
    if (!isnan(o->step)) scene->step = o->step;
    return iso_scene_check_times(ctx, scene);
}

int finish_scene(iso_context *ctx, const options *o, const iso_scene *scene, iso_status status)
{
    const char *field = iso_context_field(ctx);
    const bool time = strcmp(field, "end") == 0 || strcmp(field, "step") == 0;
    const bool method = strcmp(field, "method") == 0 && o->method;
    const bool from_option = method || (time && (!isnan(o->end) || !isnan(o->step)));
    const char *name = strcmp(o->file, "-") == 0 ? "<stdin>" : o->file;
    return finish(ctx, from_option ? status : iso_scene_blame(ctx, scene, name, status));
}

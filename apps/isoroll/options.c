/* options.c - reads the options of a command by its table of rows (see options.h). */
#include "options.h"

#include <getopt.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/names_impl.h"
#include "base/number_impl.h"
#include "command.h"
#include "io/output_impl.h"

/* --- setters ---------------------------------------------------------------------------------------------------- */

bool set_digits(void *at, const char *text)
{
    double digits = ISO_HEXADECIMAL;
    const bool set = strcmp(text, "hex") == 0 || (iso_set_count(&digits, text) && digits <= 17);
    *(int *)at = (int)digits;
    return set;
}

/* --- the command line ------------------------------------------------------------------------------------------- */

/* A longer line is cut and ends in " ...". */
static char command_line[4096];

const char *options_command(void)
{
    return command_line;
}

static void add(const char *text)
{
    static const char dots[] = " ...";
    const size_t used = strlen(command_line), room = sizeof command_line - sizeof dots - used;
    if (used + sizeof dots >= sizeof command_line) return;
    snprintf(command_line + used, room, "%s", text);
    if (strlen(text) >= room) strcpy(command_line + strlen(command_line), dots);
}

/* One word as a shell reads it. Control characters, which a line has no place for, become question marks. */
static void add_word(const char *before, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./:=,+-@%";
    const bool quoted = !*word || word[strspn(word, plain)];
    add(before);
    add(quoted ? "'" : "");
    for (const char *c = word; *c; c++) {
        const char letter[] = {(unsigned char)*c < ' ' || *c == 0x7f ? '?' : *c, '\0'};
        add(*c == '\'' ? "'\\''" : letter);
    }
    add(quoted ? "'" : "");
}

/* --- reading ---------------------------------------------------------------------------------------------------- */

enum { MOST_ROWS = 32, LONG = 256 /* above all letters */ };

static const option_row help_row = {.name = "help", .doc = "print this text", .letter = 'h'};

const option_row *options_row(const command *c, int i)
{
    for (const option_row *r = c->rows; r->name; r++) {
        if (!r->rows && i-- == 0) return r;
        for (const option_row *of = r->rows; of && of->name; of++)
            if (i-- == 0) return of;
    }
    return i == 0 ? &help_row : NULL;
}

static bool set_option(const command *c, const option_row *r, const char *text, char *options)
{
    if (r->set(options + r->offset, text)) return true;
    const char *near = iso_nearest_word(text, r->word);
    warn("%s: --%s '%s': expected %s%s%s%s", c->name, r->name, text, r->expected, near ? "; did you mean '" : "",
         near ? near : "", near ? "'?" : "");
    return false;
}

static options_result wrong(const command *c, const char *what, const char *which)
{
    warn("%s: %s%s; see 'isoroll %s --help'", c->name, what, which, c->name);
    return OPTIONS_WRONG;
}

/* A long option that is not known, fits more than one, or has an argument that it does not take. */
static options_result wrong_long(const command *c, const char *text)
{
    const char *names[MOST_ROWS], *name = text + strspn(text, "-");
    const size_t length = strcspn(name, "=");
    size_t count = 0;
    int fit = 0; /* options that begin with the name */
    char list[200] = "", bare[64];
    for (int i = 0; options_row(c, i); i++) {
        const char *one = options_row(c, i)->name;
        if (strncmp(one, name, length) != 0 || strlen(list) + strlen(one) + 8 > sizeof list) continue;
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s--%s", fit++ > 0 ? ", " : "", one);
    }
    if (fit > 1) return warn("%s: ambiguous option %s: it fits %s", c->name, text, list), OPTIONS_WRONG;
    if (fit == 1) return warn("%s: %s: the option %s takes no argument", c->name, text, list), OPTIONS_WRONG;
    for (int i = 0; options_row(c, i) && count < MOST_ROWS; i++) names[count++] = options_row(c, i)->name;
    snprintf(bare, sizeof bare, "%.*s", (int)(length < sizeof bare ? length : 0), name);
    const char *gone = iso_option_gone(c->name, bare), *near = iso_nearest(bare, count, names);
    if (gone) return warn("%s: there is no option --%s any more: %s", c->name, bare, gone), OPTIONS_WRONG;
    if (!near) return wrong(c, "unknown option ", text);
    return warn("%s: unknown option %s; did you mean '--%s'?", c->name, text, near), OPTIONS_WRONG;
}

/* What getopt_long is given: the long names, and the letters after the colon that makes it silent. --csv is a
 * second name of --output. */
static void make_known(const command *c, struct option known[MOST_ROWS + 2], char letters[2 * MOST_ROWS])
{
    *letters++ = ':';
    for (int i = 0; i < MOST_ROWS && options_row(c, i); i++) {
        const option_row *r = options_row(c, i);
        const int takes = !r->argument ? no_argument : r->argument[0] == '[' ? optional_argument : required_argument;
        *known++ = (struct option){r->name, takes, NULL, LONG + i};
        if (strcmp(r->name, "output") == 0) *known++ = (struct option){"csv", required_argument, NULL, LONG + i};
        if (r->letter) *letters++ = r->letter;
        if (r->letter && r->argument) *letters++ = ':';
    }
}

/* The one argument after the options. */
static options_result set_file(const command *c, int argc, char **argv, bool help, char *options)
{
    const bool optional = c->argument[0] == '[';
    if (c->files) *(file_list *)(void *)(options + c->files) = (file_list){argv + optind, argc - optind};
    if (argc > optind + 1 && !c->files) return wrong(c, "one argument too many: ", argv[optind + 1]);
    if (argc == optind && !optional && !help) return wrong(c, "missing argument ", c->argument);
    *(const char **)(void *)(options + c->file) = argc > optind ? argv[optind] : "-";
    return help ? OPTIONS_HELP : OPTIONS_DONE;
}

iso_status refuse_given(iso_context *ctx, const given_option list[], const char *why)
{
    while (list->name && !list->given) list++;
    return list->name ? ISO_FAIL_ARGUMENT(ctx, list->name, "--%s: %s", list->name, why) : ISO_OK;
}

/* --- files ------------------------------------------------------------------------------------------------------ */

bool is_regular(const char *path)
{
    struct stat s;
    return stat(path, &s) == 0 && S_ISREG(s.st_mode);
}

bool ends_with(const char *path, const char *ending)
{
    const size_t length = strlen(path), n = strlen(ending);
    return length > n && strcmp(path + length - n, ending) == 0;
}

/* Whether two paths (NULL: none, "-": the standard stream that is given) name the same regular file. */
static bool same_file(const char *a, const char *b, const char *stream)
{
    struct stat x, y;
    if (!a || !b || stat(strcmp(a, "-") == 0 ? stream : a, &x) != 0 ||
        stat(strcmp(b, "-") == 0 ? stream : b, &y) != 0)
        return false;
    return S_ISREG(x.st_mode) && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

/* The path that a row of this kind has been given; NULL: none, or the row is of another kind. */
static const char *path_of(const option_row *r, option_file kind, const char *options)
{
    return r->file == (int)kind ? *(const char *const *)(const void *)(options + r->offset) : NULL;
}

/* Whether `path` names a file that is read: the argument, or one of an option. */
static bool is_read(const command *c, const char *path, const char *options)
{
    const char *argument = *(const char *const *)(const void *)(options + c->file);
    bool found = !c->word && same_file(argument, path, "/dev/stdin");
    for (int i = 0; options_row(c, i); i++)
        found = found || same_file(path_of(options_row(c, i), OPTION_READS, options), path, "/dev/stdin");
    return found;
}

static const char *without_dot(const char *path)
{
    while (strncmp(path, "./", 2) == 0) path += 2 + strspn(path + 2, "/");
    return path;
}

/* No file is written in the place of one that is read, also not before it gets its name; and no two in one place. */
static options_result keep_files_apart(const command *c, const char *options)
{
    for (int i = 0; options_row(c, i); i++) {
        const char *path = path_of(options_row(c, i), OPTION_WRITES, options);
        if (!path || strcmp(path, "-") == 0) continue;
        char *part = iso_file_part(path);
        const bool read = is_read(c, path, options) || (part && is_read(c, part, options));
        free(part);
        if (read) return warn("%s: '%s' would overwrite what is read", c->name, path), OPTIONS_WRONG;
        for (int before = 0; before < i; before++) {
            const char *other = path_of(options_row(c, before), OPTION_WRITES, options);
            if (other && (strcmp(without_dot(path), without_dot(other)) == 0 || same_file(path, other, "/dev/null")))
                return warn("%s: '%s' would be two files in one", c->name, path), OPTIONS_WRONG;
        }
    }
    return OPTIONS_DONE;
}

options_result options_read(const command *c, int argc, char **argv, void *options)
{
    struct option known[MOST_ROWS + 2] = {{0}};
    char letters[2 * MOST_ROWS] = "";
    bool help = false;
    make_known(c, known, letters);
    opterr = 0;
    *command_line = '\0';
    add("isoroll ");
    add(c->name);
    for (int found; (found = getopt_long(argc, argv, letters, known, NULL)) != -1;) {
        if (found == ':') return wrong(c, "an argument is missing after ", argv[optind - 1]);
        if (found == '?' && optopt > 0 && optopt < LONG)
            return wrong(c, "unknown option ", (char[]){'-', (char)optopt, '\0'});
        if (found == '?') return wrong_long(c, argv[optind - 1]);
        int i = found >= LONG ? found - LONG : 0; /* of a letter it is sought */
        while (found < LONG && options_row(c, i)->letter != found) i++;
        const option_row *r = options_row(c, i);
        if (r == &help_row)
            help = true;
        else if (!set_option(c, r, optarg, options))
            return OPTIONS_WRONG;
        if (r->aside || r->file == OPTION_WRITES) continue; /* it changes no number of a table */
        add(" --");
        add(r->name);
        if (optarg) add_word(r->argument[0] == '[' ? "=" : " ", optarg);
    }
    for (int i = optind; i < argc; i++) add_word(strncmp(argv[i], "-", 1) == 0 && argv[i][1] ? " ./" : " ", argv[i]);
    const options_result result = set_file(c, argc, argv, help, options);
    return result == OPTIONS_DONE ? keep_files_apart(c, options) : result;
}

/* isoroll manual - prints the man pages and the completions for shells; the build installs what it prints. */
#include <ctype.h>
#include <string.h>

#include "base/names_impl.h"
#include "command.h"
#include "io/output_impl.h"

/* --- pages in the format man(7), made from the tables of the commands ------------------------------------------- */

/* Prints `length` characters as plain text of roff: a backslash, a dash and a quote have other meanings there. */
static void put_part(const char *text, size_t length, FILE *to)
{
    for (; length > 0; text++, length--) switch (*text) {
        case '\\': fputs("\\e", to); break;
        case '-': fputs("\\-", to); break;
        case '\'': fputs("\\(aq", to); break;
        case '"': fputs("\\(dq", to); break;
        case '^': fputs("\\(ha", to); break;
        case '~': fputs("\\(ti", to); break;
        default: fputc(*text, to);
        }
}

static void put(const char *text, FILE *to)
{
    put_part(text, strlen(text), to);
}

/* Prints lines of text, each after \&, so that none is taken for a request; an empty line begins a paragraph. */
static void put_lines(const char *text, const char *paragraph, FILE *to)
{
    while (*text) {
        const size_t length = strcspn(text, "\n");
        if (length == 0) fputs(paragraph, to);
        if (length > 0) fputs("\\&", to);
        put_part(text, length, to);
        if (length > 0) fputc('\n', to);
        text += length + (text[length] == '\n');
    }
}

static void put_head(const char *name, const char *doc, FILE *to)
{
    char upper[64];
    snprintf(upper, sizeof upper, "ISOROLL%s%s", name ? "-" : "", name ? name : "");
    for (char *c = upper; *c; c++) *c = (char)toupper((unsigned char)*c);
    fputs(".\\\" made by 'isoroll manual' from the tables of the commands\n.TH ", to);
    fprintf(to, "%s 1 \"\" \"isoroll %s\" \"User Commands\"\n.SH NAME\nisoroll%s%s \\- ", upper, iso_version(),
            name ? "\\-" : "", name ? name : "");
    put(doc, to);
    fputc('\n', to);
}

static void put_row(const option_row *r, FILE *to)
{
    fputs(".TP\n", to);
    if (r->letter && r->argument) fprintf(to, "\\fB\\-%c\\fR \\fI%s\\fR, ", r->letter, r->argument);
    if (r->letter && !r->argument) fprintf(to, "\\fB\\-%c\\fR, ", r->letter);
    fputs("\\fB\\-\\-", to);
    put(r->name, to);
    fputs("\\fR", to);
    if (r->argument) fprintf(to, "%s\\fI", r->argument[0] == '[' ? "" : " ");
    if (r->argument) put(r->argument, to);
    fputs(r->argument ? "\\fR\n" : "\n", to);
    put_lines(r->doc, "", to);
    if (!r->expected || r->file) return;
    fputs(".br\nExpects ", to);
    put(r->expected, to);
    fputs(".\n", to);
}

/* Lines as they are. */
static void put_block(const char *head, const char *lines, FILE *to)
{
    fprintf(to, "%s.nf\n", head);
    put_lines(lines, "", to);
    fputs(".fi\n", to);
}

static void put_exits(const char *special, FILE *to)
{
    put_block(".SH EXIT STATUS\n", about_exits, to);
    if (special) put_block(".PP\nFor this command:\n.PP\n", special, to);
}

static void manual_command(const command *c, FILE *to)
{
    put_head(c->name, command_doc(c), to);
    fprintf(to, ".SH SYNOPSIS\n.B isoroll %s\n[\\fIoptions\\fR] \\fI%s\\fR\n.SH DESCRIPTION\n", c->name, c->argument);
    put_lines(c->description, ".PP\n", to);
    if (!c->word)
        fprintf(to, ".PP\n\\fI%s\\fR is a file; \\- is standard input%s.\n", c->argument,
                c->argument[0] == '[' ? ", and so is no argument" : "");
    fputs(".SH OPTIONS\n", to);
    for (int i = 0; options_row(c, i); i++) put_row(options_row(c, i), to);
    put_exits(c->exits, to);
    put_block(".SH EXAMPLE\n", c->example, to);
    fputs(".SH SEE ALSO\n.BR isoroll (1)\n", to);
}

static void manual_program(FILE *to)
{
    put_head(NULL, "a rubber ball that rolls on a sphere, and its twin, a point on a sphere", to);
    fputs(".SH SYNOPSIS\n.B isoroll\n\\fICOMMAND\\fR [\\fIoptions\\fR] [\\fISCENE\\fR or \\fIFILE\\fR]\n.br\n"
          ".B isoroll\n\\fICOMMAND\\fR \\fB\\-\\-help\\fR\n.br\n.B isoroll \\-\\-version\n.SH DESCRIPTION\n",
          to);
    put_lines(about_isoroll, ".PP\n", to);
    fputs(".SH COMMANDS\n", to);
    for (int i = 0; commands[i]; i++) {
        fprintf(to, ".TP\n.BR isoroll\\-%s (1)\n", commands[i]->name);
        put_lines(command_doc(commands[i]), "", to);
    }
    put_exits(NULL, to);
    fputs(".SH ENVIRONMENT\n.TP\n.B NO_COLOR\nIf it is not empty, the progress bar has no colour.\n"
          ".TP\n.B COLUMNS\nHow wide text for people is made where standard output is no terminal.\n",
          to);
    put_block(".SH EXAMPLE\n", command_find("run")->example, to);
    fputs(".SH SEE ALSO\n", to);
    for (int i = 0; commands[i]; i++)
        fprintf(to, ".BR isoroll\\-%s (1)%s\n", commands[i]->name, commands[i + 1] ? "," : "");
}

/* --- the command ------------------------------------------------------------------------------------------------ */

typedef struct options {
    const char *page, *output;
} options;

static const char *page_word(int i)
{
    static const char *const first[] = {"isoroll", "bash", "zsh"};
    return i < 3 ? first[i] : command_word(i - 3);
}

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    const char *name = strcmp(o->page, "-") == 0 ? "isoroll" : o->page;
    iso_output *output;
    int i = 0;
    while (page_word(i) && strcmp(name, page_word(i)) != 0) i++;
    if (!page_word(i)) {
        char suggested[ISO_SUGGEST_SIZE];
        warn("manual: no page is called '%s'; %s", name, iso_suggest_word(suggested, name, page_word));
        return EXIT_USAGE;
    }
    const iso_status status = iso_output_open(ctx, o->output, &output);
    if (status != ISO_OK) return finish(ctx, status);
    if (strcmp(name, "isoroll") == 0)
        manual_program(iso_output_stream(output));
    else if (command_find(name))
        manual_command(command_find(name), iso_output_stream(output));
    else
        fputs(strcmp(name, "bash") == 0 ? complete_bash : complete_zsh, iso_output_stream(output));
    return finish(ctx, iso_output_close(ctx, output, true));
}

static const options defaults = {.page = "-", .output = "-"};

static const option_row rows[] = {ROW_OUTPUT(options, output), ROW_END};

const command command_manual = {
    COMMAND("manual", "[PAGE]", "print a man page, or the completion of a shell", page),
    .word = page_word,
    .description =
        "A page is isoroll (the default), the name of a command, bash or zsh. Installation puts all of them in "
        "their places. Where isoroll is not installed, this command prints them.",
    .example = "isoroll manual run | man -l -\nsource <(isoroll manual bash)",
};

/* manual.c - man pages in the format man(7), made from the tables of the commands. */
#include "command.h"

#include <ctype.h>
#include <string.h>

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

void manual_command(const command *c, FILE *to)
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

void manual_program(FILE *to)
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

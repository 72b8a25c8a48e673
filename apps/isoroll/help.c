/* help.c - the text of --help, for one command and for the program. */
#include <string.h>

#include "command.h"

enum { WIDTH = 100 };

/* The words of a line of text behind `column` characters; further lines begin behind `indent` blanks. */
static void print_words(const char *text, int column, int indent, FILE *to)
{
    const char *before = column > 0 ? " " : "";
    while (*text && *text != '\n') {
        const int word = (int)strcspn(text, " \n");
        if (column > 0 && column + (int)strlen(before) + word > WIDTH)
            column = fprintf(to, "\n%*s", indent, "") - 1, before = "";
        column += fprintf(to, "%s%.*s", before, word, text);
        before = " ";
        text += word;
        text += strspn(text, " ");
    }
    fputc('\n', to);
}

/* Each line of text behind `column` blanks; a long one goes on behind `indent`. */
static void print_lines(const char *text, int column, int indent, FILE *to)
{
    while (*text) {
        fprintf(to, "%*s", column, "");
        print_words(text, column, indent, to);
        text += strcspn(text, "\n");
        text += *text == '\n';
    }
}

static void print_row(const option_row *r, FILE *to)
{
    const int length = (int)strlen(r->name), name = length > 10 ? length : 10; /* then fewer blanks */
    char doc[512];
    const int used = snprintf(doc, sizeof doc, "%s", r->doc);
    if (r->letter && used < (int)sizeof doc)
        snprintf(doc + used, sizeof doc - (size_t)used, " (-%c%s%s)", r->letter, r->argument ? " " : "",
                 r->argument ? r->argument : "");
    const int column = fprintf(to, "  --%-*s %-*s", name, r->name, 19 - name, r->argument ? r->argument : "");
    print_words(doc, column, 25, to);
}

void help_command(const command *c, FILE *to)
{
    fprintf(to, "usage: isoroll %s [options] %s\n%s\n\n", c->name, c->argument, command_doc(c));
    for (int i = 0; options_row(c, i); i++) print_row(options_row(c, i), to);
    fputc('\n', to);
    print_lines(c->description, 0, 0, to);
    fputs("\nexample\n", to);
    print_lines(c->example, 1, 5, to);
    if (!c->exits) return;
    fputs("\nexit status\n", to);
    print_lines(c->exits, 1, 5, to);
}

void help_program(FILE *to)
{
    print_lines(about_isoroll, 0, 0, to);
    fputs("\nusage: isoroll COMMAND [options] [SCENE or FILE]      - is standard input or output\n\n", to);
    for (int i = 0; commands[i]; i++)
        fprintf(to, "  %-11s %-9s %s\n", commands[i]->name, commands[i]->argument, command_doc(commands[i]));
    fputs("\n  isoroll help COMMAND       the options of a command, as isoroll COMMAND --help\n"
          "  isoroll --version          the versions of isoroll and its libraries\n\nexit status\n",
          to);
    print_lines(about_exits, 1, 5, to);
}

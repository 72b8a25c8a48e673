/* help.c - the text of --help, for one command and for the program. */
#include <string.h>

#include "command.h"

enum { WIDTH = 100 };

/* Prints text in lines of at most WIDTH characters; a new line in the text stays one. */
static void print_folded(const char *text, FILE *to)
{
    for (int column = 0; *text;) {
        const size_t blanks = strspn(text, " "), word = strcspn(text + blanks, " \n");
        const bool fits = column == 0 || column + (int)(blanks + word) <= WIDTH;
        if (!fits) fputc('\n', to), column = 0;
        const size_t skipped = column == 0 ? blanks : 0;
        column += fprintf(to, "%.*s", (int)(blanks + word - skipped), text + skipped);
        text += blanks + word;
        if (*text == '\n') fputc(*text++, to), column = 0;
    }
    fputc('\n', to);
}

/* The words of a line of text behind `column` characters; further lines begin behind `indent` blanks. */
static void print_hanging(const char *text, int column, int indent, FILE *to)
{
    while (*text && *text != '\n') {
        const int word = (int)strcspn(text, " \n");
        if (column + 1 + word > WIDTH) column = fprintf(to, "\n%*s", indent, "") - 1;
        column += fprintf(to, " %.*s", word, text);
        text += word;
        text += strspn(text, " ");
    }
    fputc('\n', to);
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
    print_hanging(doc, column, 24, to);
}

/* Each line of text after two blanks; a long one goes on further right. */
static void print_indented(const char *text, FILE *to)
{
    while (*text) {
        fputc(' ', to);
        print_hanging(text, 1, 4, to);
        text += strcspn(text, "\n");
        text += *text == '\n';
    }
}

void help_command(const command *c, FILE *to)
{
    fprintf(to, "usage: isoroll %s [options] %s\n%s\n\n", c->name, c->argument, command_doc(c));
    for (int i = 0; options_row(c, i); i++) print_row(options_row(c, i), to);
    fputc('\n', to);
    print_folded(c->description, to);
    fputs("\nexample\n", to);
    print_indented(c->example, to);
    if (!c->exits) return;
    fputs("\nexit status\n", to);
    print_indented(c->exits, to);
}

void help_program(FILE *to)
{
    print_folded(about_isoroll, to);
    fputs("\nusage: isoroll COMMAND [options] [SCENE or FILE]      - is standard input or output\n\n", to);
    for (int i = 0; commands[i]; i++)
        fprintf(to, "  %-11s %-9s %s\n", commands[i]->name, commands[i]->argument, command_doc(commands[i]));
    fputs("\n  isoroll help COMMAND       the options of a command, as isoroll COMMAND --help\n"
          "  isoroll --version          the versions of isoroll and its libraries\n\nexit status\n",
          to);
    print_indented(about_exits, to);
}

/* help.c - the text of --help, for one command and for the program. */
#include <string.h>

#include "command.h"

static int width_of(FILE *to)
{
    const int width = terminal_width(to);
    return width == ISO_ANY_WIDTH ? USUAL_WIDTH : width;
}

/* Each line of text behind `column` blanks, folded. */
static void print_lines(const char *text, int column, FILE *to)
{
    char line[2048];
    while (*text) {
        const int length = (int)strcspn(text, "\n");
        snprintf(line, sizeof line, "%*s%.*s", column, "", length, text);
        iso_fold_line(to, line, strlen(line), width_of(to));
        text += length;
        text += *text == '\n';
    }
}

void help_command(const command *c, FILE *to)
{
    char usage[128];
    snprintf(usage, sizeof usage, "usage: isoroll %s [options] %s\n", c->name, c->argument);
    print_lines(usage, 0, to);
    print_lines(command_doc(c), 0, to);
    fputc('\n', to);
    for (int i = 0; options_row(c, i); i++) {
        const option_row *r = options_row(c, i);
        const int length = (int)strlen(r->name), name = length > 10 ? length : 10; /* then fewer blanks */
        const char *argument = r->argument ? r->argument : "";
        char line[1024], letter[64] = "";
        if (r->letter) snprintf(letter, sizeof letter, " (-%c%s%s)", r->letter, r->argument ? " " : "", argument);
        snprintf(line, sizeof line, "  --%-*s %-*s  %s%s", name, r->name, 18 - name, argument, r->doc, letter);
        iso_fold_line(to, line, strlen(line), width_of(to));
    }
    fputc('\n', to);
    print_lines(c->description, 0, to);
    fputs("\nexample\n", to);
    print_lines(c->example, 2, to);
    if (!c->exits) return;
    fputs("\nexit status\n", to);
    print_lines(c->exits, 2, to);
}

void help_program(FILE *to)
{
    const command *const *c = commands;
    char line[512];
    print_lines(about_isoroll, 0, to);
    print_lines("\nusage: isoroll COMMAND [options] [SCENE or FILE]      - is standard input or output", 0, to);
    for (int g = 0; command_groups[g].title; g++) {
        fputc('\n', to);
        print_lines(command_groups[g].title, 0, to);
        for (int i = 0; i < command_groups[g].count; i++, c++) {
            snprintf(line, sizeof line, "  %-11s  %-9s  %s", (*c)->name, (*c)->argument, command_doc(*c));
            iso_fold_line(to, line, strlen(line), width_of(to));
        }
    }
    print_lines("isoroll help COMMAND       the options of a command, as isoroll COMMAND --help\n"
                "isoroll --version          the versions of isoroll and its libraries\n",
                2, to);
    fputs("\nexit status\n", to);
    print_lines(about_exits, 2, to);
}

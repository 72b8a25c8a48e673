/* completion.c - scripts for bash and zsh that complete the command line, made from the tables of the commands. */
#include <string.h>

#include "command.h"

/* --- bash ------------------------------------------------------------------------------------------------------- */

static void put_words(const char *(*word)(int i), FILE *to)
{
    for (int i = 0; word && word(i); i++) fprintf(to, "%s%s", i ? " " : "", word(i));
}

/* One branch of `case "$command $option"`: the words that follow an option. */
static void put_values(const command *c, const option_row *r, FILE *to)
{
    fprintf(to, "    '%s --%s'", c->name, r->name);
    if (r->letter) fprintf(to, " | '%s -%c'", c->name, r->letter);
    fputs(") values=yes words='", to);
    put_words(r->word, to);
    fputs("' ;;\n", to);
}

static void put_options(const command *c, FILE *to)
{
    fprintf(to, "    %s) words='", c->name);
    for (int i = 0; options_row(c, i); i++) {
        const option_row *r = options_row(c, i);
        fprintf(to, "%s--%s", i ? " " : "", r->name);
        if (r->letter) fprintf(to, " -%c", r->letter);
    }
    fputs("' ;;\n", to);
}

static void put_topics(const command *c, FILE *to)
{
    if (!c->word) return;
    fprintf(to, "    %s) words='", c->name);
    put_words(c->word, to);
    fputs("' ;;\n", to);
}

/* An argument that must follow its option; one in brackets is written after a = in the same word. */
static bool needs_argument(const option_row *r)
{
    return r->argument && r->argument[0] != '[';
}

void complete_bash(FILE *to)
{
    fputs("# bash completion of isoroll, made by 'isoroll manual bash'\n"
          "_isoroll()\n{\n"
          "    local current=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} option words= values=\n"
          "    COMPREPLY=()\n"
          "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n        words='",
          to);
    for (int i = 0; commands[i]; i++) fprintf(to, "%s ", commands[i]->name);
    fputs(
        "--help --version'\n        mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n        return\n"
        "    fi\n"
        "    # --option=value stands in three words\n"
        "    option=${COMP_WORDS[COMP_CWORD - 1]}\n"
        "    [ \"$option\" != '=' ] || option=${COMP_WORDS[COMP_CWORD - 2]}\n"
        "    [ \"$current\" != '=' ] || current=\n"
        "    case \"$command $option\" in\n",
        to);
    for (int i = 0; commands[i]; i++)
        for (int j = 0; options_row(commands[i], j); j++)
            if (needs_argument(options_row(commands[i], j))) put_values(commands[i], options_row(commands[i], j), to);
    fputs("    esac\n    if [ -z \"$values\" ]; then\n        case $current in\n        -*) case $command in\n", to);
    for (int i = 0; commands[i]; i++) put_options(commands[i], to);
    fputs("        esac ;;\n        *) case $command in\n", to);
    for (int i = 0; commands[i]; i++) put_topics(commands[i], to);
    fputs("        esac ;;\n        esac\n    fi\n"
          "    # without words, bash completes names of files\n"
          "    [ -z \"$words\" ] || mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
          "}\ncomplete -o default -F _isoroll isoroll\n",
          to);
}

/* --- zsh -------------------------------------------------------------------------------------------------------- */

/* Text inside '...[text]...' of _arguments. */
static void put_quoted(const char *text, FILE *to)
{
    for (; *text; text++) {
        if (strchr("[]:\\", *text)) fputc('\\', to);
        fputs(*text == '\'' ? "'\\''" : (const char[]){*text, '\0'}, to);
    }
}

/* What completes an argument: its words, a file, or nothing. */
static void put_action(const char *(*word)(int i), bool file, FILE *to)
{
    if (word) fputc('(', to);
    put_words(word, to);
    if (word) fputc(')', to);
    if (!word) fputs(file ? "_files" : " ", to);
}

static void put_spec(const option_row *r, const char *dashes, const char *name, FILE *to)
{
    const bool is_long = dashes[1] == '-';
    fprintf(to, " \\\n            '%s%s", dashes, name);
    if (r->argument) fputs(!needs_argument(r) ? "=-" : is_long ? "=" : "+", to);
    fputc('[', to);
    put_quoted(r->doc, to);
    fputc(']', to);
    if (r->argument) {
        fputs(needs_argument(r) ? ":" : "::", to);
        put_quoted(needs_argument(r) ? r->argument : "N", to);
        fputc(':', to);
        put_action(r->word, r->file != OPTION_NO_FILE, to);
    }
    fputc('\'', to);
}

static void put_branch(const command *c, FILE *to)
{
    fprintf(to, "    %s)\n        _arguments -s -S", c->name);
    for (int i = 0; options_row(c, i); i++) {
        const option_row *r = options_row(c, i);
        const char letter[] = {r->letter, '\0'};
        put_spec(r, "--", r->name, to);
        if (r->letter) put_spec(r, "-", letter, to);
    }
    fputs(" \\\n            '1:", to);
    put_quoted(c->argument, to);
    fputc(':', to);
    put_action(c->word, true, to);
    fputs("' ;;\n", to);
}

void complete_zsh(FILE *to)
{
    fputs("#compdef isoroll\n# zsh completion of isoroll, made by 'isoroll manual zsh'\n"
          "_isoroll()\n{\n    local -a commands\n    commands=(\n",
          to);
    for (int i = 0; commands[i]; i++) {
        fprintf(to, "        '%s:", commands[i]->name);
        put_quoted(command_doc(commands[i]), to);
        fputs("'\n", to);
    }
    fputs("    )\n    if ((CURRENT == 2)); then\n        _describe command commands\n"
          "        compadd -- --help --version\n        return\n    fi\n"
          "    shift words\n    ((CURRENT--))\n    case ${words[1]} in\n",
          to);
    for (int i = 0; commands[i]; i++) put_branch(commands[i], to);
    fputs("    esac\n}\n_isoroll \"$@\"\n", to);
}

/* completion.c - completes the command line: the scripts for bash and zsh ask `isoroll --complete WORD...` for the
 * words that may stand in the place of the last one. */
#include <string.h>

#include "command.h"

const char complete_bash[] =
    "# bash completion of isoroll: the command says which words fit. Without words, bash completes names of files.\n"
    "_isoroll()\n"
    "{\n"
    "    local current=${COMP_WORDS[COMP_CWORD]} words\n"
    "    [ \"$current\" != '=' ] || current= # --option=value stands in three words\n"
    "    words=$(isoroll --complete \"${COMP_WORDS[@]:1:COMP_CWORD}\" 2>/dev/null | cut -f 1)\n"
    "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
    "}\n"
    "complete -o default -F _isoroll isoroll\n";

const char complete_zsh[] =
    "#compdef isoroll\n"
    "# zsh completion of isoroll: the command says which words fit. Without words, zsh completes names of files.\n"
    "_isoroll()\n"
    "{\n"
    "    local -a fits\n"
    "    local word doc\n"
    "    while IFS=$'\\t' read -r word doc; do\n"
    "        fits+=(\"${word//:/\\\\:}:$doc\")\n"
    "    done < <(isoroll --complete \"${words[@]:1:$((CURRENT - 1))}\" 2>/dev/null)\n"
    "    if (($#fits)) && compset -P '--*='; then _describe value fits\n"
    "    elif (($#fits)); then _describe word fits\n"
    "    else compset -P '--*='; _files\n"
    "    fi\n"
    "}\n"
    "_isoroll \"$@\"\n";

static void print(const char *dashes, const char *word, const char *doc)
{
    printf("%s%s\t%s\n", dashes, word, doc);
}

static void print_words(const char *(*word)(int i))
{
    for (int i = 0; word && word(i); i++) print("", word(i), "");
}

static void print_options(const command *c)
{
    const option_row *r;
    for (int i = 0; (r = options_row(c, i)); i++) {
        print("--", r->name, r->doc);
        if (r->letter) print("-", (char[]){r->letter, '\0'}, r->doc);
    }
}

/* The option whose argument is completed. It is in the last word, before "=", or in the word before it; bash makes "="
 * a word of its own. An argument in brackets always follows "=". */
static const option_row *option_of(const command *c, int count, char *word[])
{
    int at = count - 1; /* of the option */
    bool joined = strncmp(word[at], "--", 2) == 0 && strchr(word[at], '=');
    if (!joined) {
        const bool follows = strcmp(word[at - 1], "=") == 0;
        joined = follows || strcmp(word[at], "=") == 0;
        at -= follows ? 2 : 1;
    }
    const char *option = word[at];
    const size_t size = joined ? strcspn(option, "=") : strlen(option);
    const option_row *r;
    for (int i = 0; (r = options_row(c, i)); i++) {
        const bool named = size == strlen(r->name) + 2 && strncmp(option, "--", 2) == 0 &&
                           strncmp(option + 2, r->name, size - 2) == 0;
        const bool letter = r->letter && size == 2 && option[0] == '-' && option[1] == r->letter;
        if ((named || letter) && r->argument && (joined || r->argument[0] != '[')) return r;
    }
    return NULL;
}

void complete_line(int count, char *word[])
{
    const command *c = count > 1 ? command_find(word[0]) : NULL;
    if (count <= 1) {
        for (int i = 0; commands[i]; i++) print("", commands[i]->name, command_doc(commands[i]));
        print("", "--help", "what isoroll does");
        print("", "--version", "its version");
        return;
    }
    if (!c) return;
    const option_row *r = option_of(c, count, word);
    if (r)
        print_words(r->word);
    else if (word[count - 1][0] == '-')
        print_options(c);
    else
        print_words(c->word);
}

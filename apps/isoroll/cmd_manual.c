/* isoroll manual - prints the man pages and the completions for shells; the build installs what it prints. */
#include <string.h>

#include "base/names_impl.h"
#include "command.h"
#include "io/output_impl.h"

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
        complain("manual: no page is called '%s'; %s", name, iso_suggest_word(suggested, name, page_word));
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

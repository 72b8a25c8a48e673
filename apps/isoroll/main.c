/* main.c - the program isoroll: finds the command and runs it; --help and --version. */
#include <string.h>

#include "base/names_impl.h"
#include "command.h"

static int unknown(const char *name)
{
    const char *near = iso_nearest_word(name, command_word);
    if (near)
        warn("unknown command '%s'; did you mean '%s'?", name, near);
    else
        warn("unknown command '%s'; 'isoroll --help' lists them", name);
    return EXIT_USAGE;
}

int main(int argc, char **argv)
{
    program_begin();
    const char *name = argc > 1 ? argv[1] : "";
    const bool help = strcmp(name, "help") == 0;
    if (help && argc > 2 && command_find(argv[2]))
        return help_command(command_find(argv[2]), stdout), program_flush(EXIT_DONE);
    if (help && argc > 2) return unknown(argv[2]);
    if (help || strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0)
        return help_program(stdout), program_flush(EXIT_DONE);
    if (strcmp(name, "--version") == 0) return program_version(), program_flush(EXIT_DONE);
    if (strcmp(name, "--complete") == 0) return complete_line(argc - 2, argv + 2), program_flush(EXIT_DONE);
    const command *c = command_find(name);
    if (c) return program_flush(program_run(c, argc - 1, argv + 1));
    if (argc > 1) return unknown(name);
    help_program(stderr);
    return EXIT_USAGE;
}

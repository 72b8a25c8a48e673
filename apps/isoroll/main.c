/* main.c - the program isoroll: finds the command and runs it; --help and --version. */
#include <string.h>

#include "program.h"

int main(int argc, char **argv)
{
    program_begin();
    const char *name = argc > 1 ? argv[1] : "";
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || strcmp(name, "help") == 0)
        return help_program(stdout), program_flush(EXIT_DONE);
    if (strcmp(name, "--version") == 0) return program_version(), program_flush(EXIT_DONE);
    const command *c = command_find(name);
    if (c) return program_flush(program_run(c, argc - 1, argv + 1));
    if (argc < 2)
        help_program(stderr);
    else
        complain("unknown command '%s'; 'isoroll --help' lists them", name);
    return EXIT_USAGE;
}

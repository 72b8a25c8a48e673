/* commands.c - the list of commands, and what is said of all of them. */
#include <string.h>

#include "command.h"

extern const command command_run, command_convert, command_compare, command_cost, command_check, command_analogue,
    command_frequencies, command_explain, command_list, command_plot, command_manual, command_section, command_chaos,
    command_periodic, command_splitting, command_integrals, command_sweep, command_view;

const command *const commands[] = {&command_run,
                                   &command_convert,
                                   &command_compare,
                                   &command_cost,
                                   &command_check,
                                   &command_plot,
                                   &command_view,
                                   &command_section,
                                   &command_chaos,
                                   &command_periodic,
                                   &command_splitting,
                                   &command_integrals,
                                   &command_sweep,
                                   &command_explain,
                                   &command_analogue,
                                   &command_frequencies,
                                   &command_list,
                                   &command_manual,
                                   NULL};

const char *const about_isoroll =
    "isoroll simulates the rubber Chaplygin ball that rolls on a sphere, and its twin, a point on a sphere in a "
    "Neumann/Braden potential. It converts orbits of one model into orbits of the other.";

const char *const about_exits = "0: done\n"
                                "1: some rows failed, a bound was broken, or interrupted\n"
                                "2: wrong usage\n"
                                "3: bad input\n"
                                "4: numerical failure, or no memory\n"
                                "5: trouble with a file";

const char *command_word(int i)
{
    return commands[i] ? commands[i]->name : NULL;
}

const command *command_find(const char *name)
{
    for (int i = 0; commands[i]; i++)
        if (strcmp(commands[i]->name, name) == 0) return commands[i];
    return NULL;
}

/* commands.c - the list of commands, and what is said of all of them. */
#include <string.h>

#include "command.h"

#define COMMANDS(X)                                                                                                  \
    X(run)                                                                                                           \
    X(convert)                                                                                                       \
    X(compare) X(cost) X(check) X(plot) X(view) X(section) X(chaos) X(periodic) X(splitting) X(integrals) X(sweep)   \
        X(explain) X(analogue) X(frequencies) X(list) X(manual)
#define DECLARE(name) extern const command command_##name;
#define ADDRESS(name) &command_##name,

COMMANDS(DECLARE)
const command *const commands[] = {COMMANDS(ADDRESS) NULL};

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

const char *command_doc(const command *c)
{
    return c->doc ? c->doc : c->study->doc;
}

const command *command_find(const char *name)
{
    for (int i = 0; commands[i]; i++)
        if (strcmp(commands[i]->name, name) == 0) return commands[i];
    return NULL;
}

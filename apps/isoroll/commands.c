/* commands.c - the list of commands, and what is said of all of them. */
#include <string.h>

#include "command.h"

/* The groups, and the commands of each, in the order of --help. */
#define START(X) X(run) X(compare) X(convert) X(check) X(plot) X(view) X(explain)
#define STUDY(X) ISO_INSTRUMENT_LIST(X) /* study/options_impl.h */
#define MANY(X) X(sweep)
#define REFERENCE(X) X(list) X(manual)
#define COMMANDS(X) START(X) STUDY(X) MANY(X) REFERENCE(X)

#define DECLARE(name) extern const command command_##name;
#define ADDRESS(name) &command_##name,
#define ONE(name) +1

COMMANDS(DECLARE)
const command *const commands[] = {COMMANDS(ADDRESS) NULL};

const command_group command_groups[] = {
    {"start: one orbit, in both models", 0 START(ONE)},
    {"study: what an orbit, a ball or a method is like", 0 STUDY(ONE)},
    {"many: orbits or balls by the thousand", 0 MANY(ONE)},
    {"reference", 0 REFERENCE(ONE)},
    {NULL, 0},
};

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

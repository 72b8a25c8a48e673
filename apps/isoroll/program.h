/* program.h - how a program of isoroll begins, runs a command, and ends. */
#ifndef ISOROLL_PROGRAM_H
#define ISOROLL_PROGRAM_H

#include "command.h"

/* Sets up the process: streams, signals, the libraries. Call it first. */
void program_begin(void);

/* Reads the options and runs the command; argv[0] is its name. Gives the exit status. */
int program_run(const command *c, int argc, char **argv);

/* Writes what was printed. Gives the exit status: another one if that fails. */
int program_flush(int status);

void program_version(void);

#endif

/* manual.h - man pages and shell completions, made from the tables of the commands. */
#ifndef ISOROLL_MANUAL_H
#define ISOROLL_MANUAL_H

#include "command.h"

/* The man pages isoroll(1) and isoroll-NAME(1), in the format man(7). */
void manual_program(FILE *to);
void manual_command(const command *c, FILE *to);

/* Scripts that complete the command line of isoroll. */
void complete_bash(FILE *to);
void complete_zsh(FILE *to);

#endif

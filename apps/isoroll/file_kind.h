/* file_kind.h - which kind of file a command was given, where its beginning tells. */
#ifndef ISOROLL_FILE_KIND_H
#define ISOROLL_FILE_KIND_H

#include <stdbool.h>
#include <stddef.h>

#include "io/table_impl.h"
#include "io/text_impl.h"

struct command;

/* The kinds, as bits of command.takes. */
enum {
    FILE_SCENE = 1,
    FILE_SWEEP = 2, /* the YAML of a sweep */
    FILE_TRAJECTORY = 4,
    FILE_SECTION = 8,     /* or periodic orbits: a row is a place on the section, and can have the state there */
    FILE_RESULT = 16,     /* of a sweep */
    FILE_TABLE = 32,      /* of other commands: its rows are no states of one scene */
    FILE_HDF5 = 64,       /* its beginning does not tell what is in it */
    FILE_CERTIFIED = 128, /* rows of 'run --certify' */
    FILE_ROWS = FILE_TRAJECTORY | FILE_SECTION | FILE_HDF5
};

/* One of the kinds. 0: the file is no regular file, cannot be read, or its beginning does not tell. table: the name of
 * one of isoroll's tables; else "". */
unsigned file_kind(const char *path, char table[ISO_KIND_SIZE]);

/* Refuses a file that is surely of a kind that the command does not take: says what it is, and for what. False: it
 * was refused. */
bool file_fits(const struct command *c, const char *path);

#endif

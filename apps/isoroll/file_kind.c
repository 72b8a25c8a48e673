/* file_kind.c - tells kinds of files apart by their beginnings, and which command takes them (see file_kind.h). */
#include "file_kind.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "command.h"
#include "io/table.h"

enum { BEGINNING = 65536 };

void read_beginning(const char *path, char *text, size_t size)
{
    const bool standard = strcmp(path, "-") == 0;
    const bool regular = standard || is_regular(path);
    const int file = standard ? STDIN_FILENO : regular ? open(path, O_RDONLY | O_CLOEXEC) : -1;
    const ssize_t got = file >= 0 ? pread(file, text, size - 1, 0) : 0;
    text[got > 0 ? got : 0] = '\0';
    if (file >= 0 && !standard) close(file);
}

/* --- the kind --------------------------------------------------------------------------------------------------- */

/* The kind of one of isoroll's own tables, which say what they are; else "". */
static void table_name(const char *path, const char *text, char name[ISO_KIND_SIZE])
{
    *name = '\0';
    if (sscanf(text, "# isoroll %31[^0-9\r\n]", name) == 1)
        for (size_t end = strlen(name); end > 0 && name[end - 1] == ' '; end--) name[end - 1] = '\0';
    if (strncmp(text, "\211HDF\r\n", 6) == 0) iso_table_kind(path, name);
}

static unsigned kind_of_table(const char *kind)
{
    static const struct {
        const char *name;
        unsigned kind;
    } kinds[] = {{"trajectory", FILE_TRAJECTORY},
                 {"section", FILE_SECTION},
                 {"sweep", FILE_RESULT},
                 {"sweep part", FILE_RESULT},
                 {"periodic", FILE_ORBITS}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (strcmp(kind, kinds[i].name) == 0) return kinds[i].kind;
    return FILE_TABLE;
}

/* Whether a line has this key of YAML at its beginning. */
static bool has_key(const char *line, const char *const keys[])
{
    const size_t length = strcspn(line, ": \t\r\n");
    const char *behind = line + length + strspn(line + length, " \t");
    for (int i = 0; *behind == ':' && keys[i]; i++)
        if (strlen(keys[i]) == length && strncmp(line, keys[i], length) == 0) return true;
    return false;
}

/* A sweep or a scene: each line is a key of theirs, a comment, or indented. */
static unsigned kind_of_yaml(const char *text)
{
    static const char *const sweeps[] = {"scene", "vary", "measure", "until", "samples", "chunk", "vectors", NULL};
    static const char *const scenes[] = {"ball", "reduced", "point",  "surface", "initial",
                                         "time", "solver",  "output", "effects", NULL};
    unsigned kind = 0;
    for (const char *line = text; *line; line += strcspn(line, "\n"), line += *line == '\n') {
        if (strchr("# \t\r\n", *line) || strncmp(line, "---", 3) == 0) continue;
        if (!has_key(line, sweeps) && !has_key(line, scenes)) return 0;
        kind = kind == FILE_SWEEP || has_key(line, sweeps) ? FILE_SWEEP : FILE_SCENE;
    }
    return kind;
}

unsigned file_kind(const char *path)
{
    char text[BEGINNING], name[ISO_KIND_SIZE];
    if (strcmp(path, "-") == 0) return 0; /* what is read here is lost for the command */
    read_beginning(path, text, sizeof text);
    char *last = strlen(text) == sizeof text - 1 ? strrchr(text, '\n') : NULL;
    if (last) *last = '\0'; /* the line behind it was cut */
    table_name(path, text, name);
    if (*name) return kind_of_table(name);
    return strncmp(text, "\211HDF\r\n", 6) == 0 ? FILE_HDF5 : kind_of_yaml(text);
}

/* --- the refusal ------------------------------------------------------------------------------------------------ */

static const char *name_of(unsigned kind)
{
    switch (kind) {
    case FILE_SCENE: return "a scene";
    case FILE_SWEEP: return "a sweep";
    case FILE_TRAJECTORY: return "a trajectory";
    case FILE_SECTION: return "a section";
    case FILE_RESULT: return "the result of a sweep";
    case FILE_ORBITS: return "a table of periodic orbits";
    default: return "an HDF5 file";
    }
}

/* The commands that take a kind, with commas between. */
static void list_commands(unsigned kind, char list[200])
{
    *list = '\0';
    for (int i = 0; commands[i]; i++) {
        const size_t used = strlen(list);
        if (commands[i]->takes & kind) snprintf(list + used, 200 - used, "%s%s", used ? ", " : "", commands[i]->name);
    }
}

bool file_fits(const command *c, const char *path)
{
    char list[200], text[64], name[ISO_KIND_SIZE];
    const unsigned kind = c->takes ? file_kind(path) : 0;
    if (kind == 0 || c->takes & kind) return true;
    list_commands(kind, list);
    if (kind == FILE_SCENE && c->takes & FILE_SWEEP)
        complain("%s: '%s' is a scene: a sweep has the keys scene, vary and measure; scenes are for: %s", c->name,
                 path, list);
    else if (kind == FILE_SCENE && c->takes & FILE_TRAJECTORY)
        complain("%s: '%s' is a scene, and no trajectory: 'isoroll run %s -o trajectory.csv' makes one; scenes are "
                 "for: %s",
                 c->name, path, path, list);
    else if (kind == FILE_TABLE) {
        read_beginning(path, text, sizeof text);
        table_name(path, text, name);
        complain("%s: '%s' is a table '%s', with no states of one scene, which is for: %s", c->name, path, name,
                 list);
    } else
        complain("%s: '%s' is %s, which is for: %s", c->name, path, name_of(kind), list);
    return false;
}

/* file_kind.c - tells kinds of files apart by their beginnings, which command takes them, and what options add
 * to them (see file_kind.h). */
#include "file_kind.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "command.h"
#include "instrument/certify/certify_impl.h"
#include "sweep/sweep_impl.h"

/* --- the kind --------------------------------------------------------------------------------------------------- */

static const struct {
    const char *table; /* NULL: it is none of isoroll's tables, which say what they are */
    unsigned kind;
    const char *words;
} kinds[] = {{"trajectory", FILE_TRAJECTORY, "a trajectory"},
             {"section", FILE_SECTION, "a section"},
             {"sweep", FILE_RESULT, "the result of a sweep"},
             {"sweep part", FILE_RESULT, "the result of a sweep"},
             {ISO_CERTIFIED_KIND, FILE_CERTIFIED, "a certified orbit"},
             {ISO_ORBITS_KIND, FILE_SECTION, "a table of periodic orbits"},
             {NULL, FILE_SCENE, "a scene"},
             {NULL, FILE_SWEEP, "a sweep"},
             {NULL, FILE_HDF5, "an HDF5 file"}};

/* The first bytes of a regular file, as text in whole lines; "" of others: they can be read only once. */
static const char *beginning_of(const char *path)
{
    static char text[1 << 20];
    const int file = strcmp(path, "-") != 0 && is_regular(path) ? open(path, O_RDONLY | O_CLOEXEC) : -1;
    const ssize_t got = file >= 0 ? read(file, text, sizeof text - 1) : 0;
    text[got > 0 ? got : 0] = '\0';
    if (file >= 0) close(file);
    char *last = got == sizeof text - 1 ? strrchr(text, '\n') : NULL;
    if (last) *last = '\0'; /* the line behind it was cut */
    return text;
}

/* A sweep, or a scene: each line is a key of its, a comment, or indented. */
static unsigned kind_of_yaml(const char *text)
{
    static const char *const keys[] = {"ball", "reduced", "point",  "surface", "initial",
                                       "time", "solver",  "output", "effects", NULL};
    unsigned kind = 0;
    if ((strstr(text, "vary") || strstr(text, "measure")) && iso_sweep_is_one(text, strlen(text))) return FILE_SWEEP;
    for (const char *line = text; *line; line += strcspn(line, "\n"), line += *line == '\n') {
        const size_t length = strcspn(line, ": \t\r\n");
        int i = 0;
        if (strchr("# \t\r\n", *line) || strncmp(line, "---", 3) == 0) continue;
        while (keys[i] && (strlen(keys[i]) != length || strncmp(line, keys[i], length) != 0)) i++;
        if (!keys[i] || line[length + strspn(line + length, " \t")] != ':') return 0;
        kind = FILE_SCENE;
    }
    return kind;
}

unsigned file_kind(const char *path, char table[ISO_KIND_SIZE])
{
    const char *text = beginning_of(path);
    const bool hdf5 = strncmp(text, "\211HDF\r\n", 6) == 0;
    *table = '\0';
    if (sscanf(text, "# isoroll %31[^0-9\r\n]", table) == 1)
        for (size_t end = strlen(table); end > 0 && table[end - 1] == ' '; end--) table[end - 1] = '\0';
    if (hdf5) iso_table_kind(path, table);
    for (size_t i = 0; *table && i < sizeof kinds / sizeof *kinds; i++)
        if (kinds[i].table && strcmp(table, kinds[i].table) == 0) return kinds[i].kind;
    if (*table) return FILE_TABLE;
    return hdf5 ? FILE_HDF5 : kind_of_yaml(text);
}

/* --- the refusal ------------------------------------------------------------------------------------------------ */

bool file_fits(const command *c, const char *path)
{
    char list[200] = "", table[ISO_KIND_SIZE];
    const unsigned kind = c->takes ? file_kind(path, table) : 0;
    size_t i = 0;
    if (kind == 0 || c->takes & kind) return true;
    for (int n = 0; commands[n]; n++) { /* the commands that take it */
        const size_t used = strlen(list);
        if (commands[n]->takes & kind)
            snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "", commands[n]->name);
    }
    if (kind == FILE_SCENE && c->takes & FILE_SWEEP)
        warn("%s: '%s' is a scene: a sweep has the keys scene, vary and measure; scenes are for: %s", c->name, path,
             list);
    else if (kind == FILE_SCENE && c->takes & FILE_TRAJECTORY)
        warn("%s: '%s' is a scene, and no trajectory: 'isoroll run %s -o trajectory.csv' makes one; scenes are "
             "for: %s",
             c->name, path, path, list);
    else if (kind == FILE_TABLE)
        warn("%s: '%s' is a table '%s', with no states of one scene, which is for: %s", c->name, path, table, list);
    else {
        while (kinds[i].kind != kind || (*table && strcmp(kinds[i].table, table) != 0)) i++;
        warn("%s: '%s' is %s, which is for: %s", c->name, path, kinds[i].words, list);
    }
    return false;
}

/* --- options ---------------------------------------------------------------------------------------------------- */

const char *file_option_given(const file_options *o)
{
    const iso_file_parameters *a = &o->added;
    if (!isnan(a->k)) return "k";
    if (!isnan(a->J[0])) return "J";
    if (!isnan(a->eps)) return "eps";
    if (!isnan(a->h)) return "h";
    if (a->row_tolerance != ISO_ROW_TOLERANCE) return "row-tolerance";
    if (o->scene) return "scene";
    return o->columns ? "columns" : NULL;
}

iso_status parameters_of_file(iso_context *ctx, const file_options *o, iso_record *record, iso_params *params)
{
    iso_scene scene;
    const iso_status status = o->scene ? iso_scene_load(ctx, o->scene, &scene) : ISO_OK;
    return status == ISO_OK ? iso_file_parameters_apply(ctx, &o->added, o->scene ? &scene : NULL, record, params)
                            : status;
}

/* isoroll view - a page that opens from disk: the ball and its point move side by side. */
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include "view/view.h"

typedef struct options {
    file_options from;
    const char *output; /* NULL: not given */
    bool live;
} options;

/* --- which kind of file ----------------------------------------------------------------------------------------- */

typedef enum view_kind { SCENE, TRAJECTORY, SECTION } view_kind;

/* Copies standard input to a temporary file and reads that instead: so its first bytes can be read twice. */
static iso_status make_seekable(iso_context *ctx)
{
    char block[65536];
    ssize_t got = 0;
    FILE *copy = tmpfile();
    bool good = copy != NULL;
    while (good && (got = read(STDIN_FILENO, block, sizeof block)) > 0)
        good = fwrite(block, 1, (size_t)got, copy) == (size_t)got;
    good = good && got == 0 && fflush(copy) == 0 && lseek(fileno(copy), 0, SEEK_SET) == 0 &&
           dup2(fileno(copy), STDIN_FILENO) >= 0;
    const int error = errno;
    if (copy) fclose(copy);
    if (good) return ISO_OK;
    return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot read '<stdin>': %s", strerror(error));
}

/* isoroll's own files say in their first line what they are. Of other files the ending says it, or an option that is
 * only for trajectories. */
static view_kind kind_of(const file_options *from)
{
    static const char *const endings[] = {".h5", ".csv", ".txt", ".dat", ".tsv"};
    char table[ISO_KIND_SIZE];
    const unsigned kind = file_kind(strcmp(from->file, "-") == 0 ? "/dev/stdin" : from->file, table);
    if (kind == FILE_SECTION || kind == FILE_TRAJECTORY) return kind == FILE_SECTION ? SECTION : TRAJECTORY;
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (ends_with(from->file, endings[i])) return TRAJECTORY;
    const bool scene = ends_with(from->file, ".yaml") || ends_with(from->file, ".yml");
    return !scene && file_option_given(from) ? TRAJECTORY : SCENE;
}

/* The name of the file with its folder: many scenes are called scene.yaml. */
static const char *short_name(const char *path)
{
    const char *at = path + strlen(path);
    for (int slashes = 0; at > path && (slashes += at[-1] == '/') < 2; at--) {
    }
    return at;
}

/* --- the page --------------------------------------------------------------------------------------------------- */

/* What --live begins with where no scene is given: a ball on a sphere with twice its curvature, chaotic. */
static const char own_scene[] = "reduced: {k: 0.5, J: [1, 2, 5]}\n"
                                "initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}\n"
                                "time: {end: 60, step: 0.05}\n";

static bool has_own_scene(const options *o)
{
    return o->live && strcmp(o->from.file, "-") == 0;
}

static iso_status of_scene(iso_context *ctx, const options *o, view_page *page)
{
    iso_scene scene = {.places = 0};
    iso_status status = has_own_scene(o)
                            ? iso_scene_load_text(ctx, page->title, own_scene, sizeof own_scene - 1, &scene)
                            : iso_scene_load(ctx, o->from.file, &scene);
    if (status == ISO_OK) status = iso_scene_check_times(ctx, &scene);
    if (status == ISO_OK) status = view_of_scene(ctx, &scene, page);
    for (int e = 0; status == ISO_OK && page->live && e < ISO_EFFECTS; e++) /* the laboratory has a few: forces.js */
        if (page->effects.on[e] && e != ISO_ATTITUDE && e != ISO_LEVEL && e != ISO_ROTOR && e != ISO_GRAVITY)
            status = ISO_FAIL_INPUT(ctx, iso_effect_list[e]->name,
                                    "--live computes with level, rotor and gravity, and the scene has '%s': take it "
                                    "out, or leave out --live",
                                    iso_effect_list[e]->name);
    const char *path = o->from.file;
    char text[2048];
    status = iso_scene_blame(ctx, &scene, iso_text_name(path), status);
    if (status != ISO_BAD_INPUT || strcmp(path, "-") == 0 || access(path, F_OK) != 0 || is_regular(path))
        return status;
    snprintf(text, sizeof text, "%s", iso_context_message(ctx)); /* a pipe's beginning cannot be looked at */
    return ISO_FAIL_INPUT(ctx, "", "%s (a pipe is read as a scene: give a pipe of rows as -)", text);
}

static iso_status make(iso_context *ctx, const options *o, view_kind kind, view_page *page)
{
    iso_status status = kind == SECTION      ? view_of_section(ctx, &o->from, page)
                        : kind == TRAJECTORY ? view_of_trajectory(ctx, &o->from, page)
                                             : of_scene(ctx, o, page);
    if (strcmp(o->output, "-") == 0) progress_end();
    if (status == ISO_OK) status = view_write(ctx, o->output, page);
    return status;
}

static int run(iso_context *ctx, const void *options_given)
{
    static const char *const names[] = {"scene", "trajectory", "section"};
    const options *o = options_given;
    if (!o->output)
        return warn("view: -o FILE is missing: name the page, such as page.html; - is standard output"), EXIT_USAGE;
    const bool standard = strcmp(o->from.file, "-") == 0 && !o->live;
    iso_status status = view_check_build(ctx, o->live);
    if (status == ISO_OK && standard) status = make_seekable(ctx);
    if (status != ISO_OK) return finish(ctx, status);
    const view_kind kind = has_own_scene(o) ? SCENE : kind_of(&o->from);
    if (o->live && kind != SCENE)
        return warn("view: --live computes from a scene: '%s' is none", o->from.file), EXIT_USAGE;
    const char *given = file_option_given(&o->from);
    if (given && kind != TRAJECTORY)
        return warn("view: --%s is for trajectories, and this is a %s", given, names[kind]), EXIT_USAGE;
    view_page page = {.title = has_own_scene(o) ? "laboratory"
                               : standard       ? "<stdin>"
                                                : short_name(o->from.file),
                      .live = o->live,
                      .kind = names[kind],
                      .eps = NAN,
                      .h = NAN};
    begin_work(ctx, NULL);
    status = make(ctx, o, kind, &page);
    const bool no_orbit = page.no_orbit;
    view_page_free(&page);
    if (status == ISO_STOPPED) warn("interrupted: %s", iso_context_message(ctx));
    const int result = finish(ctx, status);
    return result == EXIT_DONE && no_orbit ? EXIT_SOME_FAILED : result;
}

static const options defaults = {.from = FILE_OPTIONS_UNSET};

static const option_row rows[] = {
    ROW_OF_FILE("output", "FILE", "a file", "the page; - is standard output", iso_set_text, options, output, 'o',
                OPTION_WRITES),
    ROW("live", NULL, NULL, "with the library inside: change k, J and the start in the page", iso_set_flag, options,
        live),
    ROWS_OF_FILE(options, from),
    ROW_END,
};

const command command_view = {
    COMMAND("view", "[FILE]", "make a page in which ball and point move side by side", from.file),
    .takes = FILE_SCENE | FILE_ROWS,
    .description =
        "FILE is a scene, a trajectory, a section or periodic orbits (CSV or HDF5). The page is one file. It opens "
        "from disk in any browser with WebGL, and needs no network.\n\n"
        "Left, the ball rolls on its plane or sphere; right, the point moves in its potential. Choose which clock "
        "runs evenly, t, tau or s: the other model then runs faster and slower. For a scene, each model is "
        "integrated by "
        "itself, and the page shows how far they differ. Columns that a trajectory lacks (clocks, attitude, the "
        "other model) are computed from row to row. In the page of a section, click a crossing: its orbit runs "
        "from the first crossing on; chaotic orbits are grey, undecided ones dark.\n\n"
        "A button lays both paths side by side, with the same numbers at equal states. Another one adds an orbit "
        "that "
        "begins 1e-6 radians beside: its distance shows whether the orbit is chaotic.\n\n"
        "Of more than 5000 rows, the page has only every second, third, ... row, and says so. A scene with large "
        "steps gets more rows between its own. Where rows are far apart, the page says how wrong the motion between "
        "them is.\n\n"
        "If the rows of a trajectory are no orbit of the stated equations, there is a page, a message and exit "
        "status 1.\n\n"
        "With --live the page has the library inside (WebAssembly): change k and J, throw the ball, or click the "
        "section to start there: the page computes anew. Of effects its scene can have level, rotor and gravity. "
        "Without FILE it begins with a scene of its own.",
    .exits = "1: interrupted, or the rows of a trajectory are no orbit (the page is there)",
    .example = "isoroll view scene.yaml -o page.html\nisoroll view section.csv -o section.html\n"
               "isoroll view --live -o laboratory.html",
};

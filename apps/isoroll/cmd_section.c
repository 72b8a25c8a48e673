/* isoroll section - the Poincare section of a scene, by the ball, by the point, or by both. */
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "instrument/chaos/chaos.h"
#include "instrument/section/section_impl.h"
#include "picture/section_impl.h"
#include "plot/draw.h"
#include "scene_options.h"
#include "shell.h"

/* What section can be told. */
typedef struct options {
    iso_section_request study;
    shell_options shell;
    bool quiet;
} options;

/* The file of the crossings, which go to standard output if none is named. */
static const char *table_of(const options *o)
{
    return o->shell.table ? o->shell.table : "-";
}

/* Where the rows go. */
typedef struct target {
    iso_context *ctx;
    const options *o;
    bool opened; /* from here on, an error is no mistake in the scene */
    iso_table_writer *writer;
    iso_picture_points *picture; /* NULL: none is drawn */
} target;

/* --- the rows --------------------------------------------------------------------------------------------------- */

static iso_status open_file(void *data, const iso_record *header)
{
    target *t = data;
    t->opened = true;
    iso_status status = t->o->shell.plot.path ? iso_picture_points_create(t->ctx, header, &t->picture) : ISO_OK;
    if (status == ISO_OK) status = iso_table_writer_open(t->ctx, table_of(t->o), "section", &t->writer);
    return status == ISO_OK ? iso_table_write_header(t->ctx, t->writer, header) : status;
}

static iso_status write_row(void *data, const double row[], size_t count)
{
    const target *t = data;
    (void)count;
    const iso_status status = t->picture ? iso_picture_points_row(t->ctx, t->picture, row) : ISO_OK;
    return status != ISO_OK ? status : iso_table_write_row(t->ctx, t->writer, row);
}

static iso_status keep_pair(void *data, size_t orbit, const iso_crossing *ball, const iso_crossing *point)
{
    const target *t = data;
    (void)orbit;
    if (!t->picture) return ISO_OK;
    return iso_picture_points_pair(t->ctx, t->picture, (double[]){ball->l, ball->x}, (double[]){point->l, point->x});
}

static void tell_note(void *data, const char *words)
{
    const target *t = data;
    if (!t->o->quiet) complain("%s", words);
}

static void show_progress(void *data, double part)
{
    (void)data;
    progress_show(part);
}

/* --- the summary ------------------------------------------------------------------------------------------------ */

static void tell_both(const iso_section_result *r)
{
    if (r->crossings[ISO_BALL] == r->crossings[ISO_POINT] && r->unequal == 0)
        complain("ball and point, each by itself: %zu crossings both", r->crossings[ISO_BALL]);
    else
        complain("ball and point, each by itself: %zu and %zu crossings; %zu orbits have different numbers",
                 r->crossings[ISO_BALL], r->crossings[ISO_POINT], r->unequal);
    if (r->distance > 0)
        complain("largest distance of the two%s, where they do not part: %.2g, at orbit %zu, crossing %zu",
                 r->nature.axis < 0 ? " in t, by the mean time between crossings" : " in (l, x)", r->distance,
                 r->distance_orbit, r->distance_crossing);
    if (r->parted > 0)
        complain("%zu of %zu orbits part (distance above %g): their rounding errors grow, as on chaotic orbits; the "
                 "first is orbit %zu, at crossing %zu",
                 r->parted, r->orbits, ISO_SECTION_PARTED, r->parted_orbit, r->parted_crossing);
}

static void tell(const iso_section_result *r)
{
    complain("%zu orbit%s, %zu crossings written", r->orbits, r->orbits == 1 ? "" : "s", r->rows);
    if (r->nature.global) complain("%s", r->nature.words);
    if (r->models == ISO_SHOW_BOTH) tell_both(r);
}

/* --- the picture ------------------------------------------------------------------------------------------------ */

/* Finds out which of the orbits are chaotic: the picture draws these in grey. If there are more than MOST_ORBITS, or
 * if this fails, the picture draws those in grey on which the models part. */
static void judge(iso_context *ctx, const iso_scene *scene, const iso_section_options *how,
                  const iso_section_result *r, iso_picture_points *picture)
{
    enum { MOST_ORBITS = 3000 };
    iso_chaos *chaos = NULL;
    iso_chaos_options c = iso_chaos_defaults();
    c.at_count = iso_picture_points_starts(picture, &c.at);
    c.models = r->models == ISO_SHOW_BOTH ? ISO_SHOW_POINT : r->models;
    c.axis = r->nature.axis;
    c.tolerance = how->tolerance;
    c.threads = how->threads;
    if (r->orbits > MOST_ORBITS || c.at_count == 0) return;
    c.progress = progress_told;
    progress_doing("verdicts");
    iso_status status = iso_chaos_run(ctx, scene, &c, &chaos);
    for (size_t i = 0; status == ISO_OK && i < chaos->starts; i++)
        status =
            iso_picture_points_judge(ctx, picture, chaos->start[i].l, chaos->start[i].x, chaos->start[i].verdict);
    iso_chaos_free(chaos);
}

static int draw(target *t, const iso_scene *scene, const iso_section_options *how, const iso_section_result *r)
{
    const iso_plot_page *page = &t->o->shell.plot;
    char text[PLOT_SECTION_OPTIONS];
    iso_record *over[ISO_PLOT_OVERS + 1];
    iso_picture picture = {.layout = NULL};
    if (!interrupted()) judge(t->ctx, scene, how, r, t->picture);
    iso_status status = plot_read_over(t->ctx, page, over);
    if (status == ISO_OK)
        status = iso_picture_points_make(t->ctx, t->picture, (const iso_record *const *)over,
                                         plot_section_options(page, text), &picture);
    if (status == ISO_OK) status = plot_draw(t->ctx, page, &picture);
    for (int i = 0; i < ISO_PLOT_OVERS; i++) iso_record_free(over[i]);
    iso_picture_free(&picture);
    return finish(t->ctx, status);
}

/* --- the whole -------------------------------------------------------------------------------------------------- */

/* Closes the file. It keeps all rows that were written. */
static int close_file(const target *t, iso_status status, const iso_section_result *r)
{
    const bool keep = r->rows > 0 && status != ISO_FILE_TROUBLE && status != ISO_CLOSED_PIPE;
    int result = finish(t->ctx, status);
    if (!t->writer) return result;
    const iso_status closed = iso_table_writer_close(t->ctx, t->writer, keep);
    if (closed != ISO_OK) return result == EXIT_DONE ? finish(t->ctx, closed) : result;
    if (status == ISO_STOPPED) complain("interrupted: %zu crossings were written", r->rows);
    if (!keep) return result;
    if (r->failed > 0) {
        complain("%zu of %zu orbits did not get to the end; %s", r->failed, r->orbits, r->words);
        result = result == EXIT_DONE ? EXIT_SOME_FAILED : result;
    }
    if (status == ISO_OK && !t->o->quiet) tell(r);
    return result;
}

static int run_scene(iso_context *ctx, const options *o, const iso_scene *scene, const iso_section_options *how)
{
    target t = {.ctx = ctx, .o = o};
    const iso_section_sink sink = {open_file, write_row, keep_pair, tell_note, show_progress, &t, NULL};
    iso_section_result r;
    begin_work(ctx, table_of(o));
    const iso_status status = iso_section_run(ctx, scene, how, &sink, &r);
    int result = t.opened ? close_file(&t, status, &r) : finish_scene(ctx, o->shell.file, scene, status);
    if (t.opened && o->shell.plot.path && r.rows > 0 && result <= EXIT_SOME_FAILED) {
        const int drawn = draw(&t, scene, how, &r);
        if (drawn != EXIT_DONE) result = drawn;
    }
    iso_picture_points_free(t.picture);
    return result;
}

static int section(iso_context *ctx, const options *o)
{
    iso_scene scene = {.places = 0};
    const iso_section_options *how = &o->study.how;
    int axis;
    iso_status status = iso_plot_check_page(ctx, &o->shell.plot);
    if (status == ISO_OK && o->shell.plot.path && how->column >= 0 &&
        !iso_section_is_of_axis(how->column, how->value, &axis))
        status = iso_context_fail(ctx, ISO_BAD_ARGUMENT, "",
                                  "--plot draws sections n_A = 0: an event has no coordinates l, x");
    if (status == ISO_OK) status = iso_scene_load(ctx, o->shell.file, &scene);
    return status == ISO_OK ? run_scene(ctx, o, &scene, how) : finish(ctx, status);
}

/* --- areas in place of crossings -------------------------------------------------------------------------------- */

static iso_status check_area(const shell *s)
{
    const shell_options *o = &((const options *)s->options)->shell;
    if (!o->plot.path) return ISO_OK;
    return iso_context_fail(s->ctx, ISO_BAD_ARGUMENT, "", "section: --area draws no picture: leave out --plot");
}

static int run(iso_context *ctx, const void *options_given)
{
    static const shell_parts areas = {
        .study = &iso_section_study, .kind = "section area", .check = check_area, .stopped = "orbits are missing"};
    const options *o = options_given;
    if (!o->study.area) return section(ctx, o);
    return shell_run(ctx, &areas, o, &o->shell);
}

static const options defaults = {.shell = {.file = "-"}};

static const option_row rows[] = {
    ROW_OUTPUT(options, shell.table),
    ROWS_OF_STUDY(iso_section_option),
    ROWS_OF_PLOT(options, shell.plot),
    ROWS_OF_SECTION(options, shell.plot),
    ROW("quiet", NULL, NULL, "print no summary on stderr", iso_set_flag, options, quiet),
    ROW_END,
};

const command command_section = {
    COMMAND_OF_STUDY(section, "SCENE", shell.file),
    .takes = FILE_SCENE,
    .description =
        "Follows orbits and writes a row for each crossing of the section n_A = 0, n_A increasing. The section is "
        "the same for ball and point. A row has the number of the orbit, the number of the crossing (from 1), t, "
        "tau, s, and the coordinates l and x of the section. Orbit 0 is the scene's own. Then come those of "
        "--starts, then those of --at. A start on the section is no crossing. Of the scene's times and solver, "
        "only the tolerance is read. All orbits have the scene's energy, on every level H of the point. On a low "
        "level the point cannot be at every l; no orbit starts where it cannot be.\n\n"
        "l is in (-pi, pi]. x is between -1 and 1; the boundary is the rotation about axis A. The return map keeps "
        "the area dL dl, where L = G(l) x is the point's momentum about axis A. --starts are spread evenly by this "
        "area.\n\n"
        "With --model both, each model is integrated by itself. The rows are the ball's. stderr tells the largest "
        "distance between the crossings of both models, and how many orbits part: on chaotic orbits the rounding "
        "errors of the models grow until they part.\n\n"
        "Where no effect but 'level' acts, crossings are searched in pieces of the path that are too short for two "
        "zeros of n_A: none is skipped. In addition, the length in s of each return is checked against bounds. A "
        "return outside them is an error.\n\n"
        "An orbit that does not come to the section within 10000 turns ends. The message tells between which "
        "values it stays, and names a section that it crosses, or an event. If the first model finds this before a "
        "crossing, the second is not asked.\n\n"
        "--plot draws the sections of both models side by side. A regular orbit has the colour of its "
        "rotation number, the mean turn from one crossing to the next: about axis A, or about its centre if it stays "
        "in a part of the "
        "circle of l. Its images by the reversors are drawn too; with a rotor, those by the reversors that hold. "
        "A curve with gaps is one orbit near a resonance: its crossings come back nearly to the same places. "
        "Chaotic orbits are grey, undecided ones dark. "
        "--window draws a part of it. "
        "--over FILE draws over it what 'periodic -o' or 'splitting -o' wrote: periodic orbits, by a crossing "
        "of each and its images, and the curves that leave and enter the unstable rotation, if a row has the k of "
        "the "
        "section.\n\n"
        "--area writes no crossings. It tells of each orbit, by each model, whether the return map keeps the area: "
        "|det D - 1|, where D is the derivative of the map from the start to a return, and what errors of the "
        "integration explain of it. The area is kept, not kept, or undecided. With effects beyond a level, D is "
        "that of the flow over steps of about a turn, between planes across it, by the invariant measure (10). A "
        "chaotic orbit is told only for its first returns. -o writes a row for each orbit.\n\n"
        "After Ctrl-C, the rows computed so far are kept.",
    .example = "isoroll section scene.yaml --starts 100 -o section.csv --plot section.png",
    .exits = "1: interrupted, some orbits did not get to the end, or --area finds an orbit that does not keep\n"
             "   the area, or cannot tell\n"
             "3: also: no orbit comes to the section\n"
             "4: the computation failed before the first crossing",
};

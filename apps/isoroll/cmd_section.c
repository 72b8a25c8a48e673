/* isoroll section - the Poincare section of a scene, by the ball, by the point, or by both. */
#include <string.h>

#include "command.h"
#include "instrument/chaos/chaos.h"
#include "instrument/section/section_impl.h"
#include "picture/section_impl.h"
#include "plot/draw.h"
#include "stream.h"

/* Options of `isoroll section`. */
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
    stream to;                   /* first */
    iso_picture_points *picture; /* NULL: none is drawn */
    bool draws;
    int l;        /* the column l of table 0; -1: there is none */
    double at[2]; /* l, x of its last row                       */
} target;

static iso_status open_file(void *data, int table, const iso_record *header)
{
    target *t = data;
    if (table == 0) t->l = iso_record_find(header, "l");
    if (table == 0 && t->draws) ISO_TRY(iso_picture_points_create(t->to.ctx, header, &t->picture));
    return stream_header(&t->to, table, header);
}

static iso_status write_row(void *data, int table, const double row[], size_t count)
{
    target *t = data;
    if (table > 0 && t->picture) iso_picture_points_pair(t->picture, t->at, row + 5);
    if (table > 0) return ISO_OK;
    if (t->l >= 0) memcpy(t->at, row + t->l, sizeof t->at);
    if (t->picture) ISO_TRY(iso_picture_points_row(t->to.ctx, t->picture, row));
    return stream_row(&t->to, table, row, count);
}

/* --- the picture ------------------------------------------------------------------------------------------------ */

/* Finds out which of the orbits are chaotic: the picture draws these in grey. If there are more than MOST_ORBITS, or
 * if this fails, the picture draws those in grey on which the models part. */
static void classify_orbits(iso_context *ctx, const iso_scene *scene, const iso_section_options *how,
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
    c.progress = progress_sink;
    progress_doing("verdicts");
    const iso_status status = iso_chaos_run(ctx, scene, &c, &chaos);
    for (size_t i = 0; status == ISO_OK && i < chaos->starts; i++)
        iso_picture_points_verdict(picture, chaos->start[i].l, chaos->start[i].x,
                                   iso_verdict_name(chaos->start[i].verdict));
    iso_chaos_free(chaos);
}

static int draw(target *t, const options *o, const iso_scene *scene, const iso_section_result *r)
{
    const iso_plot_page *page = &o->shell.plot;
    char text[PLOT_SECTION_OPTIONS];
    iso_record *over[ISO_PLOT_OVERS + 1];
    iso_picture picture = {.layout = NULL};
    if (!interrupted()) classify_orbits(t->to.ctx, scene, &o->study.how, r, t->picture);
    iso_status status = plot_read_over(t->to.ctx, page, over);
    if (status == ISO_OK)
        status = iso_picture_points_make(t->to.ctx, t->picture, (const iso_record *const *)over,
                                         plot_section_options(page, text), &picture);
    if (status == ISO_OK) status = plot_draw(t->to.ctx, page, &picture);
    for (int i = 0; i < ISO_PLOT_OVERS; i++) iso_record_free(over[i]);
    iso_picture_free(&picture);
    return finish(t->to.ctx, status);
}

/* --- the whole -------------------------------------------------------------------------------------------------- */

static int run_scene(iso_context *ctx, const options *o, const iso_scene *scene)
{
    target t = {.to = {.ctx = ctx, .output = table_of(o), .kind = "section", .quiet = o->quiet},
                .draws = o->shell.plot.path != NULL};
    iso_study_result r = {.sink = stream_sink(&t.to)};
    r.sink.header = open_file;
    r.sink.row = write_row;
    begin_work(ctx, table_of(o));
    const iso_status status =
        iso_study_answer(ctx, &iso_section_study, &(iso_study_subject){.scene = scene}, &o->study, &r);
    const iso_section_result *found = r.found;
    const bool keep = found && found->rows > 0 && status != ISO_FILE_TROUBLE && status != ISO_CLOSED_PIPE;
    int result = t.to.opened ? stream_close(&t.to, status, keep) : finish_scene(ctx, o->shell.file, scene, status);
    if (keep && status == ISO_STOPPED) warn("interrupted: %zu crossings were written", found->rows);
    if (keep && r.failed) result = worse(result, EXIT_SOME_FAILED);
    if (keep && status == ISO_OK && !o->quiet && result <= EXIT_SOME_FAILED) warn_lines(r.text);
    if (keep && t.draws && result <= EXIT_SOME_FAILED) {
        const int drawn = draw(&t, o, scene, found);
        if (drawn != EXIT_DONE) result = drawn;
    }
    iso_picture_points_free(t.picture);
    iso_study_result_free(&r);
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
        status = ISO_FAIL_ARGUMENT(ctx, "", "--plot draws sections n_A = 0: an event has no coordinates l, x");
    if (status == ISO_OK) status = iso_scene_load(ctx, o->shell.file, &scene);
    return status == ISO_OK ? run_scene(ctx, o, &scene) : finish(ctx, status);
}

/* --- areas in place of crossings -------------------------------------------------------------------------------- */

static iso_status check_area(const shell *s)
{
    const shell_options *o = &((const options *)s->options)->shell;
    if (!o->plot.path) return ISO_OK;
    return ISO_FAIL_ARGUMENT(s->ctx, "", "section: --area draws no picture: leave out --plot");
}

static int run(iso_context *ctx, const void *options_given)
{
    static const shell_parts areas = {.kind = "section area", .check = check_area, .stopped = "orbits are missing"};
    const options *o = options_given;
    if (!o->study.area) return section(ctx, o);
    return shell_run(ctx, &iso_section_study, &areas, o, &o->shell);
}

static const option_row rows[] = {
    ROW_OUTPUT(options, shell.table),
    ROWS_OF_STUDY(iso_section_option),
    ROWS_OF_PLOT(options, shell.plot),
    ROWS_OF_SECTION(options, shell.plot),
    ROW("quiet", NULL, NULL, "print no summary on stderr", iso_set_flag, options, quiet),
    ROW_END,
};

const command command_section = {
    COMMAND_OF_SCENE(section),
    .run = run,
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

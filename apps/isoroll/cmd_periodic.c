/* isoroll periodic - finds periodic orbits and tells whether they are stable; follows them; draws a chart. */
#include "command.h"
#include "instrument/periodic/periodic_study_impl.h"

OPTIONS_OF_SCENE(iso_periodic_request);

/* Draws a row for each crossing of each orbit. */
static int draw_list(const shell *s)
{
    const iso_periodic *f = s->result.found;
    iso_record *whole = NULL;
    if (f->count == 0) return warn("no picture: there is no orbit"), EXIT_SOME_FAILED;
    iso_status status = iso_record_create_like(s->ctx, s->result.table[0], 0, NULL, &whole);
    for (size_t i = 0; i < f->count; i++) {
        iso_periodic_orbit o = f->orbit[i];
        for (int n = 0; status == ISO_OK && n < 2 * o.period; n++) {
            o.l = f->orbit[i].half[n][0], o.x = f->orbit[i].half[n][1];
            status = iso_columns_append(s->ctx, iso_periodic_orbit_fields, &o, whole);
        }
    }
    const int result = status == ISO_OK ? shell_draw(s, whole) : finish(s->ctx, status);
    iso_record_free(whole);
    return result;
}

static int draw_branches(const shell *s)
{
    return ((const iso_continuations *)s->result.found)->count > 0 ? shell_draw(s, s->result.table[0]) : EXIT_DONE;
}

/* Interrupted while orbits were sought, or followed. */
static void warn_interrupted(const shell *s)
{
    warn(s->result.found ? "interrupted: branches are missing or cut" : "interrupted: orbits are missing");
}

static json_t *json_without_scene(const shell *s)
{
    return json_of(s->result.fields, s->result.found);
}

static int run(iso_context *ctx, const void *options_given)
{
    static const shell_parts list = {.kind = "periodic", .stopped = "orbits are missing", .draw = draw_list},
                             follow = {.kind = "periodic follow",
                                       .interrupted = warn_interrupted,
                                       .json = json_without_scene,
                                       .draw = draw_branches},
                             chart = {.kind = "periodic chart", .stopped = "no chart", .json = json_without_scene};
    const options *o = options_given;
    const shell_parts *parts = o->study.chart ? &chart : o->study.follow ? &follow : &list;
    return shell_run(ctx, &iso_periodic_study, parts, o, &o->shell);
}

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_periodic_option),
    ROW_OUTPUT(options, shell.table),
    ROWS_OF_PLOT(options, shell.plot),
    ROW_JSON(options, shell.json),
    ROW_END,
};

const command command_periodic = {
    COMMAND_OF_SCENE(periodic),
    .run = run,
    .description =
        "Shows the rotations about the principal axes first: the trace of Hill's equation over half a turn, found "
        "in two ways, stable between -2 and 2. Then it searches for all symmetric periodic orbits of at most P "
        "returns to the section n_a = 0, as roots along the six symmetry lines: x = 0, l = 0 and l = pi/2 of the "
        "section, for the reversors S1, S2, S3; and three lines half way between two crossings, for T S1, T S2, T "
        "S3. A message says where some may be missing. Orbits without a symmetry need --all.\n\n"
        "For each orbit: a point (l, x) of the section, the trace of the return map's derivative over the period "
        "with its error, stability, which reversors map the orbit to itself, how many copies R, S1 S2 and T make "
        "of it (itself among them), and its period in t. JSON and -o add the start in both models, the periods in "
        "tau and s, and how well the orbit closes. lib/doc/theory.md explains R, S1, S2, S3 and T.\n\n"
        "Only k, J and the energy of the scene are read. Orbits of the free ball do not depend on the energy, only "
        "their clocks do. A point off H = 0, or a ball with the effect 'level', has a level (H/eps) J2^(1/k), J2 "
        "the middle moment: a number without a unit. Orbits depend on it. On a low level the point cannot reach "
        "the whole sphere. Then a rotation may be missing, and the point oscillates between two places of rest "
        "instead.\n\n"
        "For k = 1 and k = -1 most periodic orbits fill tori, on every level. Those on the symmetry lines are "
        "listed as degenerate (trace 2).\n\n"
        "--follow k=A:B follows symmetric orbits from the scene's k to A and to B, or until they end: folds, "
        "period doublings, touches of the trace -2, symmetry breaking and collisions with rotations are located. "
        "Where a branch cannot be followed, a line says where and why, and the part so far is kept. --branches "
        "follows what branches off as well, but not what branches off from that. While k or a moment changes, the "
        "level stays that of the scene; --follow level=A:B changes it.\n\n"
        "--chart J2 shows in which part of the plane of k and J2 the rotations about the axes of the least and of "
        "the greatest moment are stable, and the borders on which a trace is 2 or -2. (The axis of the middle "
        "moment is never stable.) The level is that of the scene, or --level; --chart level=A:B has the level in "
        "place of J2.\n\n"
        "-o FILE writes one row for each orbit, in doubles. --plot draws all orbits and their copies on the "
        "section, unstable ones in grey.",
    .example = "isoroll periodic scene.yaml --period 8 --plot orbits.svg",
    .exits = "1: interrupted, or a branch could not be followed to its end\n"
             "2: wrong usage, or a range without the scene's value\n"
             "3: bad input: an effect that acts, other than 'level', two equal moments, a ball at rest",
};

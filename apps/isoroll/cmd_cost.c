/* isoroll cost - measures what accuracy costs: error and processor time for every backend, method and tolerance. */
#include <math.h>
#include <string.h>

#include "command.h"
#include "task/cost/cost_impl.h"

OPTIONS_OF_SCENE(iso_cost_request);

static iso_status check(const shell *s)
{
    const bool table = s->common->table && strcmp(s->common->table, "-") == 0,
               want = !isnan(((const options *)s->options)->study.want);
    if (table && (s->common->json || want))
        return ISO_FAIL_ARGUMENT(s->ctx, "output",
                                 "cost: standard output has room for one: choose -o -, --json or --want");
    return ISO_OK;
}

static void warn_interrupted(const shell *s)
{
    const iso_cost_found *f = s->result.found;
    if (f->cost)
        warn("interrupted: %d of %d cells were measured", iso_cost_count(f->cost, iso_cost_is_measured),
             f->cost->cells);
    else
        warn("interrupted: nothing has been measured");
}

/* The error and time to expect of the choice go to stderr. */
static int print_expected(const shell *s)
{
    char text[ISO_COST_EXPECTED];
    const iso_cost_found *f = s->result.found;
    if (isnan(f->want) || s->common->json) return EXIT_DONE;
    iso_cost_expected(f, text);
    warn("%s", text);
    return EXIT_DONE;
}

static int draw(const shell *s)
{
    const iso_cost *c = ((const iso_cost_found *)s->result.found)->cost;
    if (iso_cost_count(c, iso_cost_is_measured) > 0) return shell_draw(s, s->result.table[0]);
    return warn("no picture: nothing has been measured"), EXIT_DONE;
}

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_cost_option),
    ROWS_OF_PLOT(options, shell.plot),
    ROW_OF_FILE("output", "FILE", "a file", "write the table to FILE; - is standard output", iso_set_text, options,
                shell.table, 'o', OPTION_WRITES),
    ROW_JSON(options, shell.json),
    ROW_END,
};

const command command_cost = {
    COMMAND_OF_SCENE(cost),
    .parts = {.kind = "cost",
              .check = check,
              .change = shell_change,
              .interrupted = warn_interrupted,
              .write = print_expected,
              .draw = draw},
    .description =
        "All backends, methods and tolerances are measured. --backend, --method or --tol restrict the measurement to "
        "one; the scene's own backend, method and tolerance are not read.\n\n"
        "An error is the largest relative error of (omega, n) at 20 times from the start to the end. The reference "
        "is "
        "none of the measured runs. A time is processor time, the median of several runs; set-up is shown apart.\n\n"
        "--want X prints the cheapest choice as options of 'isoroll run'. After Ctrl-C, what has "
        "been measured is printed.",
    .example = "isoroll cost scene.yaml --quick --plot cost.svg\n"
               "isoroll run scene.yaml $(isoroll cost scene.yaml --want 1e-9)",
    .exits = "1: a run failed, or nothing reaches the error that --want asks for",
};

/* chaos_print.c - the text of chaos, and the lines of its table (study/study.h). */
#include <math.h>

#include "instrument/chaos/chaos_impl.h"
#include "study/study_impl.h"

static void print_head(FILE *to, const iso_scene *scene, const iso_chaos *c)
{
    fprintf(to, "this orbit: %s%s\n", iso_verdict_name(c->own.verdict),
            c->own.disagree ? ": ball and point disagree" : "");
    if (c->plane >= 0)
        fprintf(to, "  it is the rotation about axis %d in a principal plane, which is periodic\n", c->plane + 1);
    if (c->integral) fprintf(to, "  %s is an additional integral: no orbit is chaotic\n", c->integral->name);
    fputs("\n", to);
    iso_params_print(to, &scene->params);
    fputs("\n", to);
    if (c->axis < 0)
        fprintf(to, "a turn is a step of %.6g in t: no section n_a = 0 is known to be global here\n", c->turn);
    else
        fprintf(to, "a turn is a return to the section n_%d = 0, n_%d increasing\n", c->axis + 1, c->axis + 1);
    if (c->plane < 0) fputs("\nlargest exponents per unit of t, tau and s\n", to);
}

/* Of each model the indicators; then what the exponents are worth. An error that is not known is "?". */
static void print_models(FILE *to, const iso_chaos *c)
{
    bool rough = false;
    long longest = 0;
    iso_table_begin(to, 1);
    fputs("model\tverdict\tturns\tMEGNO\tGALI_2\tper t\tper tau\tper s\n", to);
    for (int m = 0; m < 2; m++) {
        const iso_indication *i = &c->own.result[m];
        if (!c->with[m]) continue;
        fprintf(to, "%s\t%s\t%ld\t%.4g\t%.1e", iso_model_kind_name(m), iso_verdict_name(i->verdict), i->turns,
                i->megno, i->gali2);
        for (int clock = 0; clock < ISO_CLOCKS; clock++)
            if (isnan(i->exponent[clock]))
                fputs("\t-", to);
            else if (isnan(i->error[clock]))
                fprintf(to, "\t%.2e +- ?", i->exponent[clock]);
            else
                fprintf(to, "\t%.2e +- %.0e", i->exponent[clock], i->error[clock]);
        fputs("\n", to);
        if (i->verdict != ISO_CHAOTIC) continue;
        rough = rough || isnan(i->error[ISO_CLOCK_T] + i->per_turn_error);
        if (i->exponent_turns > i->turns && i->exponent_turns > longest) longest = i->exponent_turns;
    }
    iso_table_end(to);
    if (c->own.verdict == ISO_REGULAR)
        fputs("  the exponents of a regular orbit are 0: these estimates fall like 1/turns\n", to);
    if (longest > 0) fprintf(to, "  the exponents are from %ld turns\n", longest);
    if (rough) fputs("  +- ?: the orbit is too short to know this error; --exponent-turns makes it longer\n", to);
}

static void print_share(FILE *to, const iso_chaos_fraction *s, bool integrable)
{
    fprintf(to, "\n%zu starts spread evenly over the section, by its area dL dl, with a tolerance of %g:\n", s->asked,
            s->tolerance);
    if (s->count < s->asked) {
        fprintf(to, "  %zu of them were followed", s->count);
        if (s->failed > 0) fprintf(to, "; %zu failed", s->failed);
        fprintf(to, s->count > 0 ? ": the shares are of these\n" : ": no share is known\n");
    }
    if (s->count == 0) return;
    fprintf(to,
            "  chaotic    %8.4f   (%zu); 95 %% interval %.4f to %.4f\n"
            "  regular    %8.4f   (%zu)\n"
            "  undecided  %8.4f   (%zu)\n",
            s->share, s->chaotic, s->low, s->high, s->regular_share, s->regular, s->undecided_share, s->undecided);
    if (s->undecided > 0 && integrable)
        fputs("  undecided ones are not chaotic: the integral excludes it\n", to);
    else if (s->undecided > 0)
        fprintf(
            to,
            "  undecided ones count as not chaotic in the share and at the low end of the interval, as chaotic at\n"
            "  its high end; the middle of what is possible is %.4f\n",
            ((double)s->chaotic + (double)s->undecided / 2) / (double)s->count);
    if (s->checked > 0 && s->disagree == 0)
        fprintf(to, "  ball and point both decided %zu of them, and never disagree\n", s->checked);
    else if (s->disagree > 0)
        fprintf(to, "  ball and point both decided %zu of them, and disagree about %zu: undecided\n", s->checked,
                s->disagree);
}

void iso_chaos_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result)
{
    const iso_chaos *c = result->found;
    (void)options;
    print_head(to, scene, c);
    if (c->plane < 0) print_models(to, c);
    const iso_indication *one = &c->own.result[ISO_BALL], *other = &c->own.result[ISO_POINT];
    const double apart = fabs(one->exponent[ISO_CLOCK_T] - other->exponent[ISO_CLOCK_T]),
                 error = hypot(one->error[ISO_CLOCK_T], other->error[ISO_CLOCK_T]);
    if (c->with[ISO_BALL] && c->with[ISO_POINT] && !isnan(apart) && !isnan(error))
        fprintf(to, "  the exponents per t of both models are %.2g errors apart\n", apart / error);
    if (c->share.asked > 0) print_share(to, &c->share, c->integral);
}

/* Orbit 0 is the scene's own. Other orbits that were not followed have no row. */
iso_status iso_chaos_describe(iso_context *ctx, const iso_scene *scene, const void *options, iso_study_result *result)
{
    const iso_chaos_options *how = &((const iso_chaos_request *)options)->how;
    const iso_chaos *c = result->found;
    const iso_chaos_fraction *part = &c->share;
    iso_record *table = result->table[0];
    const double axis = c->chart + 1;
    char ball[ISO_BALL_SIZE];
    ISO_TRY(iso_record_set_numbers(ctx, table, "axis", 1, &axis));
    ISO_TRY(iso_record_set_numbers(ctx, table, "tolerance", 1,
                                   isnan(how->tolerance) ? &scene->tolerance : &how->tolerance));
    if (part->count > 0) ISO_TRY(iso_record_set_numbers(ctx, table, "starts_tolerance", 1, &part->tolerance));
    ISO_TRY(
        iso_record_set(ctx, table, "orbit 0", "the scene's own; l and x are nan: it need not start on the section"));
    ISO_TRY(iso_record_set(ctx, table, "nan elsewhere", "not known; an orbit that was not followed has no row"));
    iso_ball_text(ball, &scene->params);
    if (part->count == 0)
        return iso_study_title(ctx, result, "%s: this orbit is %s", ball, iso_verdict_name(c->own.verdict));
    return iso_study_title(ctx, result,
                           "%s: %.3g of the section is chaotic (95 %%: %.3g to %.3g), %.3g beside it undecided", ball,
                           part->share, part->low, part->high, (double)part->undecided / (double)part->count);
}

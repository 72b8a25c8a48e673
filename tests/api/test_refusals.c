/* One situation has one status, one field and one sentence, whoever is asked: each study is given a scene that does
 * not suit it, and arguments that are wrong. A row of the table is a situation; a * in its sentence is the study's own
 * part. */
#include <fnmatch.h>
#include <gsl/gsl_test.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "instrument/chaos/chaos.h"
#include "instrument/section/section.h"
#include "instrument/section/section_impl.h"
#include "io/scene_file.h"
#include "orbit/crossings.h"
#include "study/study.h"
#include "task/list/tables.h"

static iso_context *ctx;

#define BODY(J) "reduced: {k: 0.5, J: [" J "], D: 0.5}\n"
#define MOVING "initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}\n"
#define RESTING "initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0, 0, 0]}\n"
#define END "time: {end: 1, step: 0.5}\n"
#define BALL BODY("1.4, 2.1, 3.0") MOVING END
#define POINT "point: {k: 0.5, J: [1.4, 2.1, 3.0]" /* its eps, and } */
#define HERE "initial: {gamma: [0.6, 0, 0.8], M: [0, 0, 0]}\n" END

/* The scenes; a situation names one. */
static const char free_ball[] = BALL, equal[] = BODY("2, 2, 3") MOVING END,
                  resting[] = BODY("1.4, 2.1, 3.0") RESTING END, resting_point[] = POINT "}\n" HERE,
                  pulled[] = POINT ", eps: 1}\n" HERE,
                  repelled[] = POINT ", eps: -1}\n"
                                     "initial: {gamma: [0.6, 0, 0.8], M: [0, 0.5, 0]}\n" END,
                  field[] = BALL "effects: {field: {linear: [0.1, 0.2, 0.3]}}\n",
                  resting_in_field[] =
                      BODY("1.4, 2.1, 3.0") RESTING END "effects: {field: {linear: [0.1, 0.2, 0.3]}}\n",
                  rolling[] = BALL "effects: {rolling_resistance: {coefficient: 0.1}}\n",
                  twisting[] = BALL "effects: {twist: {resistance: 10}}\n",
                  level[] = BALL "effects: {level: {c: 0.3}}\n",
                  tilted[] = "reduced: {k: 1, J: [1.4, 2.1, 3.0], D: 0.5}\n" MOVING END
                             "effects: {gravity: {mgb: 0.7, up: [0, 0.6, 0.8]}}\n",
                  heavy[] = BALL "effects: {gravity: {mgb: 0.7, up: [0, 0.6, 0.8]}}\n";

typedef struct situation {
    const char *what, *scene;
    const char *asked; /* "study" or "study option value", with commas between */
    iso_status status;
    const char *about;    /* iso_context_about() */
    const char *sentence; /* a pattern of fnmatch() */
} situation;

static const situation situations[] = {
    {"rolling resistance", rolling, "section,chaos,frequencies", ISO_BAD_INPUT, "rolling_resistance",
     "'rolling_resistance' takes energy from the ball: a motion that comes to rest *"},
    {"friction of the twist", twisting, "section,chaos,frequencies", ISO_BAD_INPUT, "twist",
     "'twist' takes energy from the ball: a motion that comes to rest *"},
    {"an effect", field, "periodic,splitting", ISO_BAD_INPUT, "field",
     "* only of the free ball and of the point, on every level of its energy: remove 'field'"},
    {"an effect", field, "integrals", ISO_BAD_INPUT, "field",
     "* only of the free ball and of the point, on every level of its energy and in a magnetic field: remove "
     "'field'"},
    {"weight", tilted, "periodic,splitting", ISO_BAD_INPUT, "gravity",
     "* only of the free ball and of the point, on every level of its energy: remove 'gravity'"},
    {"a tilted plane", tilted, "chaos,frequencies", ISO_BAD_INPUT, "gravity",
     "on a tilted plane the ball rolls away ever faster: its motion *"},
    {"no point", heavy, "section model point,chaos model both,section as both,compare", ISO_NOT_MAPPED, "gravity",
     "'gravity' breaks the isomorphism: *. There is no such point; the ball alone can be had"},
    {"a level that drives the point off", level, "periodic,splitting", ISO_BAD_INPUT, "level",
     "* only where the point's coupling eps is above 0; here it is *"},
    {"eps below 0", repelled, "periodic,splitting", ISO_BAD_INPUT, "level",
     "* only where the point's coupling eps is above 0; here it is -1*"},
    {"a ball at rest", resting, "section,chaos,frequencies,periodic,area", ISO_BAD_INPUT, "angular_velocity",
     "a ball at rest *"},
    {"a ball at rest", resting, "compare", ISO_NOT_MAPPED, "angular_velocity", "a ball at rest *"},
    {"a point at rest", resting_point, "section,chaos,frequencies,periodic", ISO_BAD_INPUT, "M", "a point at rest *"},
    {"a ball that starts at rest", resting_in_field, "chaos,area", ISO_BAD_INPUT, "angular_velocity",
     "the ball starts at rest, where *: start it a little later"},
    {"a point that starts at rest", pulled, "chaos", ISO_BAD_INPUT, "M",
     "the point starts at rest, where *: start it a little later"},
    {"equal moments", equal, "periodic,splitting", ISO_BAD_INPUT, "J",
     "J1 and J2 are equal: a rotation about axis 3 carries every orbit along, so *"},
    {"other starts, and an effect", field, "section starts 2,section at 0;0,chaos starts 2,chaos at 0;0",
     ISO_BAD_INPUT, "field",
     "no other starts can be given here: the section has a chart only where nothing acts but a level or a magnetic "
     "field, without "
     "'field'"},
    {"a start outside the chart", free_ball, "section at 0;1.5,chaos at 0;1.5", ISO_BAD_INPUT, "at",
     "l, x = 0, 1.5 is outside the chart: l is any angle, x is between -1 and 1"},
    {"a start on the boundary", free_ball, "section at 0;-1,chaos at 0;-1", ISO_BAD_INPUT, "at",
     "l, x = 0, -1 is the rotation about axis 3, in the plane n_3 = 0 itself: it is the boundary of the section, and "
     "never crosses it"},
    {"a start where the level closes the chart", pulled, "section axis 2 at 0;0.5", ISO_BAD_INPUT, "at",
     "n_2 = 0 is closed at l = 0 on the level H = *: the potential there is not below H"},
    {"no axis", free_ball, "section axis 4,chaos axis 0,section axis 12", ISO_BAD_ARGUMENT, "",
     "--axis '*': expected auto, 1, 2 or 3"},
    {"no axis of a program", free_ball,
     "iso_section_run axis,iso_chaos_run axis,iso_crossings_create axis,iso_section_areas_find axis",
     ISO_BAD_ARGUMENT, "axis", "axis 4 is not 1, 2 or 3"},
    {"no tolerance", free_ball, "section tol 2,chaos tol 1e-16,integrals tol 0.2", ISO_BAD_ARGUMENT, "tol",
     "tol is '*': expected a number in [[]1e-15, 0.1]"},
    {"no tolerance of a program", free_ball,
     "iso_section_run tolerance,iso_chaos_run tolerance,iso_crossings_create tolerance", ISO_BAD_ARGUMENT,
     "tolerance", "tolerance 2 is not in [[]1e-15, 0.1]"},
};

/* --- who is asked ----------------------------------------------------------------------------------------------- */

/* A study by its name, with options NAME VALUE NAME VALUE; a ; in a value stands for a comma. */
static iso_status by_name(const iso_study *study, const iso_scene *scene, char *options)
{
    iso_study_result result = {0};
    const iso_study_subject subject = {.scene = scene};
    bool value = false;
    for (char *c = options; *c; c++) {
        if (*c == ' ') *c = (value = !value) ? '=' : '\n';
        if (*c == ';') *c = ',';
    }
    const iso_status status = iso_study_ask_text(ctx, study, &subject, options, &result);
    iso_study_result_free(&result);
    return status;
}

/* --- calls of a program: an axis that is none, or a tolerance ---------------------------------------------------- */

static iso_status section_run(const iso_scene *scene, bool axis)
{
    iso_section_options o = iso_section_defaults();
    iso_sink sink = {0};
    iso_section_result result;
    if (axis) o.axis = 3;
    if (!axis) o.tolerance = 2;
    return iso_section_run(ctx, scene, &o, &sink, NULL, &result);
}

static iso_status chaos_run(const iso_scene *scene, bool axis)
{
    iso_chaos_options o = iso_chaos_defaults();
    iso_chaos *c = NULL;
    if (axis) o.axis = 3;
    if (!axis) o.tolerance = 2;
    const iso_status status = iso_chaos_run(ctx, scene, &o, &c);
    iso_chaos_free(c);
    return status;
}

static iso_status crossings_create(const iso_scene *scene, bool axis)
{
    const iso_batch_orbit orbit = {.params = &scene->params, .start = &scene->start};
    iso_crossings_options o = iso_crossings_defaults();
    iso_crossings *c = NULL;
    if (axis) o.axis = 3;
    if (!axis) o.tolerance = 2;
    const iso_status status = iso_crossings_create(ctx, &orbit, 1, &o, &c);
    iso_crossings_free(c);
    return status;
}

static iso_status area(const iso_scene *scene, bool axis)
{
    iso_section_areas found;
    iso_section_options o = iso_section_defaults();
    if (axis) o.axis = 3;
    const iso_status status = iso_section_areas_find(ctx, scene, &o, NULL, NULL, &found);
    iso_section_areas_free(&found);
    return status;
}

static iso_status ask(const iso_scene *scene, const char *name, char *options)
{
    static const struct {
        const char *name;
        iso_status (*call)(const iso_scene *scene, bool flag);
        const char *flag; /* the word that sets it */
    } calls[] = {{"area", area, ""},
                 {"iso_section_areas_find", area, "axis"},
                 {"iso_section_run", section_run, "axis"},
                 {"iso_chaos_run", chaos_run, "axis"},
                 {"iso_crossings_create", crossings_create, "axis"}};
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++)
        if (strcmp(calls[i].name, name) == 0)
            return calls[i].call(scene, strcmp(options, calls[i].flag) == 0 && *options);
    const iso_study *study = iso_study_find(name);
    if (study) return by_name(study, scene, options);
    return iso_context_fail(ctx, ISO_STOPPED, "", "this test knows no '%s'", name);
}

/* --- the law ---------------------------------------------------------------------------------------------------- */

static void hold(const situation *s)
{
    iso_scene scene;
    char asked[256], *rest = NULL;
    if (iso_scene_load_text(ctx, s->what, s->scene, strlen(s->scene), &scene) != ISO_OK) {
        gsl_test(1, "%s: %s", s->what, iso_context_message(ctx));
        return;
    }
    snprintf(asked, sizeof asked, "%s", s->asked);
    for (char *one = strtok_r(asked, ",", &rest); one; one = strtok_r(NULL, ",", &rest)) {
        char line[64];
        const size_t name = strcspn(one, " ");
        snprintf(line, sizeof line, "%s", one + name + (one[name] == ' '));
        one[name] = '\0';
        const iso_status status = ask(&scene, one, line);
        const char *words = status == ISO_OK ? "it is done" : iso_context_message(ctx);
        gsl_test(status != s->status || fnmatch(s->sentence, words, 0) != 0, "%s: %s: %s: %s", s->what, one,
                 iso_status_text(status), words);
        gsl_test(strcmp(iso_context_about(ctx), s->about) != 0, "%s: %s: about '%s'", s->what, one,
                 iso_context_about(ctx));
    }
}

int main(void)
{
    ctx = iso_context_create();
    gsl_test_verbose(1);
    for (size_t i = 0; i < sizeof situations / sizeof *situations; i++) hold(&situations[i]);
    iso_context_free(ctx);
    return gsl_test_summary();
}

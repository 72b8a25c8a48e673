/* test_refusals.c - one situation has one status, one field and one sentence, whoever is asked: each study is given a
 * scene that does not suit it, and arguments that are wrong. A row of the table is a situation; a * in its sentence is
 * the study's own part. The place in the scene's file, which iso_study_ask puts before the sentence, is that of
 * test_api_studies.c. */
#include <fnmatch.h>

#include "ask.h"

#define BODY(J) "reduced: {k: 0.5, J: [" J "], D: 0.5}\n"
#define MOVING "initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}\n"
#define RESTING "initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0, 0, 0]}\n"
#define END "time: {end: 1, step: 0.5}\n"
#define BALL BODY("1.4, 2.1, 3.0") MOVING END
#define A_POINT "point: {k: 0.5, J: [1.4, 2.1, 3.0]" /* its eps, and } */
#define HERE "initial: {gamma: [0.6, 0, 0.8], M: [0, 0, 0]}\n" END

/* The scenes; a situation names one. */
static const char free_ball[] = BALL, equal[] = BODY("2, 2, 3") MOVING END,
                  resting[] = BODY("1.4, 2.1, 3.0") RESTING END, resting_point[] = A_POINT "}\n" HERE,
                  pulled[] = A_POINT ", eps: 1}\n" HERE,
                  repelled[] = A_POINT ", eps: -1}\n"
                                       "initial: {gamma: [0.6, 0, 0.8], M: [0, 0.5, 0]}\n" END,
                  field[] = BALL "effects: {field: {linear: [0.1, 0.2, 0.3]}}\n",
                  resting_in_field[] =
                      BODY("1.4, 2.1, 3.0") RESTING END "effects: {field: {linear: [0.1, 0.2, 0.3]}}\n",
                  braked[] = BALL "effects: {rolling_resistance: {coefficient: 0.1}}\n",
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
    {"rolling resistance", braked, "section,chaos,frequencies", ISO_BAD_INPUT, "rolling_resistance",
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
    {"a ball at rest", resting, "section,chaos,frequencies,periodic,section area true", ISO_BAD_INPUT,
     "angular_velocity", "a ball at rest *"},
    {"a ball at rest", resting, "compare", ISO_NOT_MAPPED, "angular_velocity", "a ball at rest *"},
    {"a point at rest", resting_point, "section,chaos,frequencies,periodic", ISO_BAD_INPUT, "M", "a point at rest *"},
    {"a ball that starts at rest", resting_in_field, "chaos,section area true", ISO_BAD_INPUT, "angular_velocity",
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
    {"no tolerance", free_ball, "section tol 2,chaos tol 1e-16,integrals tol 0.2", ISO_BAD_ARGUMENT, "tol",
     "tol is '*': expected a number in [[]1e-15, 0.1]"},
    {"a number that went wrong", free_ball, "section tol nan,chaos tol -1e-9,section tol inf,cost tol 0",
     ISO_BAD_ARGUMENT, "tol", "tol is '*': expected a number *"},
    {"-1 in another language", free_ball, "section starts -1,chaos starts 1.5,section starts 1e17", ISO_BAD_ARGUMENT,
     "starts", "starts is '*': expected a whole number from 0 on"},
    {"none", free_ball, "section crossings 0", ISO_BAD_ARGUMENT, "crossings",
     "crossings is '0': expected a whole number from 1 on"},
    {"no model", free_ball, "section model x,chaos model x", ISO_BAD_ARGUMENT, "model",
     "model is 'x': expected ball, point or both"},
    {"an option without a value", free_ball, "section at,chaos at", ISO_BAD_ARGUMENT, "at",
     "'at' is no option: write NAME=VALUE"},
    {"no option", free_ball, "section mood 1,chaos mood 1", ISO_BAD_ARGUMENT, "mood", "* has no option 'mood'*"},
    {"an option that is gone", free_ball, "section cloud 640", ISO_BAD_ARGUMENT, "cloud",
     "*any more: section --area *"},
    {"no start", free_ball, "section at 1,chaos at 1,section at 0;x", ISO_BAD_ARGUMENT, "",
     "--at '*': expected l,x, or several of them with ; between: 0.5,0.2;1,-0.3"},
    {"no event", free_ball, "section event x:1", ISO_BAD_ARGUMENT, "",
     "--event: there is no column 'x'; valid are t, *"},
    {"no value of an event", free_ball, "section event n1", ISO_BAD_ARGUMENT, "",
     "--event 'n1': expected COLUMN=VALUE, such as omega1=0.5"},
    {"an event with areas", free_ball, "section area true event n1:0.1", ISO_BAD_ARGUMENT, "",
     "section: --area or --event, not both: *"},
    {"many k and many levels", free_ball, "splitting k 0.5;1 level 0;1", ISO_BAD_ARGUMENT, "",
     "--k has 2 values and --level 2: give many k and one level, or one k and many levels"},
    {"a step of 0", free_ball, "splitting k 0.5_1_0", ISO_BAD_ARGUMENT, "", "--k '0.5:1:0': expected values and *"},
    {"every row fails", free_ball, "splitting k 500", ISO_BAD_INPUT, "",
     "k = 500: the splitting is measured only for 0.05 <= |k| <= 50"},
    {"two answers", free_ball, "periodic chart J2 follow k:0.4_0.6", ISO_BAD_ARGUMENT, "chart",
     "periodic: --chart or --follow, not both"},
    {"a branch far away", free_ball, "periodic follow k:5_6", ISO_BAD_ARGUMENT, "range",
     "the scene has k = 0.5: the range 5 to 6 must contain it"},
};

/* --- who is asked ----------------------------------------------------------------------------------------------- */

/* A study by its name, with options NAME VALUE NAME VALUE; in a value ; is a comma, : is =, and _ is a colon. */
static iso_status ask_by(const iso_scene *scene, const char *name, char *options)
{
    bool value = false;
    const iso_study_subject subject = {.scene = scene};
    iso_study_result result = {.text = NULL};
    for (char *c = options; *c; c++)
        *c = *c == ' ' ? ((value = !value) ? '=' : '\n') : *c == ';' ? ',' : *c == ':' ? '=' : *c == '_' ? ':' : *c;
    const iso_status status = iso_study_ask_text(ctx, iso_study_find(name), &subject, options, &result);
    iso_study_result_free(&result);
    return status;
}

/* --- the law ---------------------------------------------------------------------------------------------------- */

static void hold(const situation *s)
{
    const iso_scene scene = parse(s->scene);
    char all[256], *rest = NULL;
    snprintf(all, sizeof all, "%s", s->asked);
    for (char *one = strtok_r(all, ",", &rest); one; one = strtok_r(NULL, ",", &rest)) {
        char line[64];
        const size_t name = strcspn(one, " ");
        snprintf(line, sizeof line, "%s", one + name + (one[name] == ' '));
        one[name] = '\0';
        const iso_status status = ask_by(&scene, one, line);
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
    for (size_t i = 0; i < sizeof situations / sizeof *situations; i++) hold(&situations[i]);
    iso_context_free(ctx);
    return gsl_test_summary();
}

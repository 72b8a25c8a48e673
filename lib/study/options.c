/* options.c - options of studies as text, those of the section among them, and changes of scenes (see study.h). */
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/names_impl.h"
#include "base/number_impl.h"
#include "base/rational_impl.h"
#include "method/methods_impl.h"
#include "orbit/crossings.h"
#include "orbit/orbit_impl.h"
#include "study/options_impl.h"

/* --- setters ---------------------------------------------------------------------------------------------------- */

bool iso_set_text(void *at, const char *text)
{
    *(const char **)at = text;
    return *text != '\0';
}

bool iso_set_flag(void *at, const char *text)
{
    (void)text;
    return *(bool *)at = true;
}

bool iso_set_number(void *at, const char *text)
{
    return iso_rational_read_double(text, strlen(text), at);
}

bool iso_set_positive(void *at, const char *text)
{
    return iso_set_number(at, text) && *(double *)at > 0;
}

bool iso_set_tolerance(void *at, const char *text)
{
    return iso_set_number(at, text) && iso_tolerance_is_good(*(double *)at);
}

/* clang-format off */
#define WHOLE(name, type, least)                                                                                     \
    bool iso_set_##name(void *at, const char *text)                                                                  \
    {                                                                                                                \
        double x;                                                                                                    \
        if (!iso_set_number(&x, text) || x < least || x != floor(x) || x >= 9e15) return false;                      \
        *(type *)at = (type)fmin(x, sizeof(type) < 8 ? 1e9 : x);                                                     \
        return true;                                                                                                 \
    }
WHOLE(whole, double, 0)
WHOLE(count, double, 1)
WHOLE(whole_int, int, 0)
WHOLE(count_int, int, 1)
WHOLE(whole_long, long, 0)
WHOLE(count_long, long, 1)
WHOLE(whole_size, size_t, 0)
WHOLE(count_size, size_t, 1)
WHOLE(seed, uint64_t, 0)
/* clang-format on */

bool iso_set_bound(void *at, const char *text)
{
    return iso_set_number(at, text) && *(double *)at >= 0;
}

bool iso_set_vector(void *at, const char *text)
{
    double *x = at;
    for (int i = 0; i < 3; i++) {
        const size_t length = strcspn(text, ",");
        if (!iso_rational_read_double(text, length, &x[i]) || (text[length] == ',') != (i < 2)) return false;
        text += length + 1;
    }
    return true;
}

const char *iso_backend_word(int i)
{
    static const char *const words[] = {"ball", "point", "exact", "auto", NULL};
    return words[i];
}

/* Whether the text is a word of a list; *i: its place there. */
static bool find_word(const char *text, const char *(*word)(int), int *i)
{
    for (*i = 0; word(*i); ++*i)
        if (strcmp(text, word(*i)) == 0) return true;
    return false;
}

bool iso_set_backend(void *at, const char *text)
{
    int i;
    return find_word(text, iso_backend_name, &i) && (*(iso_backend *)at = (iso_backend)i, true);
}

bool iso_set_model(void *at, const char *text)
{
    int i;
    return find_word(text, iso_model_kind_name, &i) && (*(iso_model_kind *)at = (iso_model_kind)i, true);
}

bool iso_set_method(void *at, const char *text)
{
    return (strcmp(text, "auto") == 0 || iso_method_find(text)) && iso_set_text(at, text);
}

const char *iso_models_word(int i)
{
    return i < ISO_SHOW_START ? iso_models_name(i) : NULL;
}

bool iso_set_models(void *at, const char *text)
{
    int i;
    return find_word(text, iso_models_word, &i) && (*(iso_models *)at = (iso_models)i, true);
}

const char *iso_option_gone(const char *command, const char *name)
{
    static const struct {
        const char *command, *name, *instead;
    } gone[] = {
        {"cost", "horizons", "compare two runs of cost with different --t-end"},
        {"section", "cloud", "section --area tells of each orbit whether the area is kept"},
        {"view", "frames", "the page records a video"},
        {"view", "fps", "the page records a video"},
        {"view", "seconds", "the page records a video"},
    };
    for (size_t i = 0; i < sizeof gone / sizeof *gone; i++)
        if (strcmp(command, gone[i].command) == 0 && strcmp(name, gone[i].name) == 0) return gone[i].instead;
    return NULL;
}

const iso_option *iso_study_option_find(const iso_study *study, const char *name, size_t length)
{
    const iso_option *o = study->options;
    while (o->name && (strlen(o->name) != length || strncmp(o->name, name, length) != 0)) o++;
    return o->name ? o : NULL;
}

static iso_status refuse_option(iso_context *ctx, const iso_study *study, const char *name)
{
    const char *names[32], *gone = iso_option_gone(study->name, name);
    char suggested[ISO_SUGGEST_SIZE];
    size_t count = 0;
    if (gone)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, name, "%s has no option '%s' any more: %s", study->name, name,
                                gone);
    for (const iso_option *o = study->options; o->name && count < sizeof names / sizeof *names; o++)
        names[count++] = o->name;
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, name, "%s has no option '%s'; %s", study->name, name,
                            iso_suggest(suggested, name, count, names));
}

iso_status iso_study_set(iso_context *ctx, const iso_study *study, const char *name, const char *text, void *options)
{
    const iso_option *o = iso_study_option_find(study, name, strlen(name));
    if (!o) return refuse_option(ctx, study, name);
    if (o->argument ? o->set((char *)options + o->offset, text)
                    : strcmp(text, "true") == 0 && o->set((char *)options + o->offset, text))
        return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, name, "%s is '%s': expected %s", name, text,
                            o->argument ? o->expected : "true");
}

const char *iso_option_type(const iso_option *o)
{
    static const struct {
        bool (*set)(void *at, const char *text);
        const char *type;
    } types[] = {{iso_set_flag, "flag"},        {iso_set_number, "number"},    {iso_set_positive, "number"},
                 {iso_set_tolerance, "number"}, {iso_set_bound, "number"},     {iso_set_vector, "numbers"},
                 {iso_set_whole, "whole"},      {iso_set_count, "whole"},      {iso_set_whole_int, "whole"},
                 {iso_set_count_int, "whole"},  {iso_set_whole_long, "whole"}, {iso_set_count_long, "whole"},
                 {iso_set_whole_size, "whole"}, {iso_set_count_size, "whole"}, {iso_set_seed, "whole"}};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (types[i].set == o->set) return types[i].type;
    return o->word ? "word" : "text";
}

/* --- the section ------------------------------------------------------------------------------------------------ */

bool iso_set_at(void *at, const char *text)
{
    const char **list = at;
    int i = 0;
    while (list[i]) i++;
    if (i == ISO_STUDY_MOST_AT) return false;
    list[i] = text;
    return *text != '\0';
}

static iso_status read_axis(iso_context *ctx, const char *text, int *axis)
{
    *axis = ISO_AXIS_AUTO;
    if (!text || strcmp(text, "auto") == 0) return ISO_OK;
    *axis = text[0] - '1';
    if (strlen(text) == 1 && *axis >= 0 && *axis < 3) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "", "--axis '%s': expected auto, 1, 2 or 3", text);
}

/* Points l,x with semicolons between. */
static iso_status read_points(iso_context *ctx, const char *text, double (**list)[2], size_t *count)
{
    size_t most = *count;
    for (const char *c = text; *c; c++) most += *c == ';';
    double(*more)[2] = realloc(*list, (most + 1) * sizeof *more);
    if (!more) return iso_context_no_memory(ctx, "the starts");
    *list = more;
    for (const char *c = text; *c; c += *c == ';') {
        const size_t l = strcspn(c, ",;"), x = c[l] == ',' ? strcspn(c + l + 1, ";") : 0;
        if (x == 0 || !iso_rational_read_double(c, l, &more[*count][0]) ||
            !iso_rational_read_double(c + l + 1, x, &more[*count][1]))
            return ISO_FAIL_ARGUMENT(
                ctx, "", "--at '%s': expected l,x, or several of them with ; between: 0.5,0.2;1,-0.3", text);
        ++*count;
        c += l + 1 + x;
    }
    return ISO_OK;
}

iso_status iso_section_words_read(iso_context *ctx, iso_section_words *words, int *axis, const double (**at)[2],
                                  size_t *count)
{
    iso_status status = read_axis(ctx, words->axis, axis);
    *count = 0;
    for (int i = 0; status == ISO_OK && words->at[i]; i++)
        status = read_points(ctx, words->at[i], &words->points, count);
    *at = (const double(*)[2])words->points;
    return status;
}

/* --- scenes ----------------------------------------------------------------------------------------------------- */

const iso_option iso_scene_change_option[] = {ISO_OPTIONS_OF_SCENE(iso_scene_request, change), ISO_OPTION_END};

/* What an option says does not stand in the file. Of end and step, a wrong one may be due to the other. */
static void forget_places(const iso_scene_changes *c, iso_scene *scene)
{
    if (c->method) iso_scene_forget_place(scene, "method");
    if (isnan(c->end) && isnan(c->step)) return;
    iso_scene_forget_place(scene, "end");
    iso_scene_forget_place(scene, "step");
}

iso_status iso_scene_apply(iso_context *ctx, const iso_scene_changes *c, iso_scene *scene)
{
    if ((int)c->backend >= 0) scene->backend = c->backend;
    if ((int)c->as >= 0) scene->as = c->as, scene->columns = 0;
    if (c->method) snprintf(scene->method, sizeof scene->method, "%s", c->method);
    if (!isnan(c->tolerance)) scene->tolerance = c->tolerance;
    if (!isnan(c->end)) scene->end = c->end;
    if (!isnan(c->step)) scene->step = c->step;
    forget_places(c, scene);
    return iso_scene_check_times(ctx, scene);
}

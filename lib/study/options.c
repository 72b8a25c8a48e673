/* options.c - options of studies as text, and tables that begin with what they found (see study.h). */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/nearest_impl.h"
#include "base/number_impl.h"
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
    return iso_number_read(text, strlen(text), at);
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

const char *iso_models_word(int i)
{
    return i < ISO_SHOW_START ? iso_shown_name(i) : NULL;
}

bool iso_set_models(void *at, const char *text)
{
    for (int i = 0; iso_models_word(i); i++)
        if (strcmp(text, iso_models_word(i)) == 0) return *(iso_models *)at = (iso_models)i, true;
    return false;
}

iso_status iso_study_set(iso_context *ctx, const iso_study *study, const char *name, const char *text, void *options)
{
    const iso_option *o = study->options;
    const char *names[32];
    char suggested[ISO_SUGGEST_SIZE];
    size_t count = 0;
    for (; o->name && strcmp(o->name, name) != 0; o++) names[count++] = o->name;
    if (!o->name)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, name, "%s has no option '%s'; %s", study->name, name,
                                iso_suggest(suggested, name, count, names));
    if (o->argument ? o->set((char *)options + o->offset, text)
                    : strcmp(text, "true") == 0 && o->set((char *)options + o->offset, text))
        return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, name, "%s is '%s': expected %s", name, text,
                            o->argument ? o->expected : "true");
}

/* --- tables ----------------------------------------------------------------------------------------------------- */

iso_status iso_study_table(iso_context *ctx, const char *kind, const iso_scene *scene, const iso_field *fields,
                           const void *result, const iso_field *rows, iso_record **table)
{
    static const iso_field none[] = {ISO_FIELD_END};
    ISO_TRY(iso_columns_create(ctx, rows ? rows : none, table));
    iso_record_set_kind(*table, kind);
    iso_status status = iso_record_describe_scene(ctx, *table, scene);
    return status == ISO_OK ? iso_record_set_fields(ctx, *table, fields, result) : status;
}

/* sweep_settings.c - reads the settings of a mapping in a sweep's text, as their table describes them. */
#include <math.h>

#include "base/number_impl.h"
#include "sweep/sweep_draft_impl.h"
#include "sweep/sweep_impl.h"

iso_status iso_sweep_check_keys(iso_yaml *y, const yaml_node_t *mapping, const char *what, size_t count,
                                const char *const names[])
{
    if (mapping->type != YAML_MAPPING_NODE) return iso_yaml_expected(y, mapping, what, "a mapping");
    size_t i;
    for (const yaml_node_pair_t *p = mapping->data.mapping.pairs.start; p < mapping->data.mapping.pairs.top; p++)
        ISO_TRY(iso_yaml_key(y, mapping, iso_yaml_node(y, p->key), "key", count, names, &i));
    return ISO_OK;
}

static iso_status read_setting(iso_yaml *y, const yaml_node_t *node, const iso_sweep_setting *s, double *value)
{
    bool flag = false;
    int word;
    if (s->word) {
        ISO_TRY(iso_yaml_word(y, node, s->name, s->word, ~0u, &word));
        return *value = word, ISO_OK;
    }
    const iso_status status =
        s->flag ? iso_yaml_flag(y, node, s->name, &flag) : iso_yaml_number(y, node, s->name, value);
    if (s->flag) *value = flag;
    const bool fits = s->least == s->most || (*value >= s->least && *value <= s->most);
    if (status != ISO_OK || (fits && (!s->whole || *value == floor(*value)))) return status;
    return iso_yaml_fail(y, node->start_mark, "'%s' is %s, it must be %sfrom %s to %s", s->name, ISO_SHORT(*value),
                         s->whole ? "a whole number " : "", ISO_SHORT(s->least), ISO_SHORT(s->most));
}

iso_status iso_sweep_read_settings(iso_yaml *y, const yaml_node_t *mapping, const iso_sweep_setting settings[],
                                   double value[])
{
    iso_status status = ISO_OK;
    for (const iso_sweep_setting *s = settings; s && s->name && status == ISO_OK; s++, value++) {
        const yaml_node_t *node;
        *value = s->usual;
        if (iso_yaml_find(y, mapping, s->name, NULL, &node))
            status = read_setting(y, node, s, value);
        else if (s->missing)
            status = iso_yaml_fail(y, mapping->start_mark, "missing '%s' in %s", s->name, s->missing);
    }
    return status;
}

iso_status iso_sweep_read_mapping(iso_yaml *y, const yaml_node_t *mapping, const char *what,
                                  const iso_sweep_setting settings[], double value[])
{
    const char *names[ISO_SWEEP_SETTINGS];
    size_t count = 0;
    for (const iso_sweep_setting *s = settings; s && s->name; s++) names[count++] = s->name;
    ISO_TRY(iso_sweep_check_keys(y, mapping, what, count, names));
    return iso_sweep_read_settings(y, mapping, settings, value);
}

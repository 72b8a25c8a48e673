/* scene_draft_impl.h - a scene between its text and its physics: reading keys (scene_keys.c), checking
 * (scene_file.c). */
#ifndef ISO_IO_SCENE_DRAFT_IMPL_H
#define ISO_IO_SCENE_DRAFT_IMPL_H

#include "base/rational_impl.h"
#include "io/yaml_impl.h"
#include "orbit/scene.h"

/* What the file says, before physics has looked at it. */
typedef struct iso_draft {
    iso_yaml yaml;
    const yaml_node_t *root, *key; /* key: whose value is being read */
    int surface, backend, as;      /* enumerators */
    iso_body body;
    double k, J[3], eps;
    double D; /* NAN: not written */
    double normal[3], angular_velocity[3], gamma[3], M[3];
    bool project;
    iso_scene scene;
} iso_draft;

/* Records "name:line:column: ..." at a node and returns ISO_BAD_INPUT. */
#define ISO_FAIL_AT(draft, node, ...) iso_yaml_fail(&(draft)->yaml, (node)->start_mark, __VA_ARGS__)

/* A draft before its text is read. */
iso_draft iso_draft_empty(iso_context *ctx, const char *name);

/* The i-th key that a scene can have, and its section; those of `effects` are the names of the effects. False: there
 * are no more. */
bool iso_scene_key_at(int i, const char **section, const char **key);

/* Notes where a key stands, for what is found wrong only later, when an orbit is made. */
void iso_scene_note_place(iso_scene *s, const char *key, yaml_mark_t at);

/* Reads a number that may be written as a fraction; `what` names it in messages. If the double does not show what is
 * written (base/rational_impl.h), the place is noted under the key's name with ISO_ROUNDED_KEY before it. */
iso_status iso_draft_ratio(iso_draft *d, const yaml_node_t *value, const char *what, const char *key, double *x);
iso_status iso_draft_ratios(iso_draft *d, const yaml_node_t *value, const char *key, double x[3]); /* a list of 3 */

/* Of an effect that the scene writes: its i-th key of text, the first one required; NULL past the last. And what
 * reads the value of it: an expression, a list of them, the parameters. */
const char *iso_draft_text_key(iso_effect_id id, int i);
iso_status iso_draft_text(iso_draft *d, iso_effect_id id, int i, const yaml_node_t *value);

/* Whether its expressions are some, their constants finite, and none that acts has a corner by its form, when the whole
 * scene is known. effects: the section. */
iso_status iso_draft_check_expressions(iso_draft *d, iso_effect_id id, const yaml_node_t *effects);

/* Reads every key under d->root into the draft: types, ranges, unknown, duplicate and missing keys.
 * What must hold between sections is left to the caller. Errors: ISO_BAD_INPUT. */
iso_status iso_draft_read_keys(iso_draft *d);

/* The same for changes of the scene that the draft holds. */
iso_status iso_draft_read_changes(iso_draft *d);

/* Checks what must hold between keys and makes d->scene. The yaml is only read, so that copies of a draft, with other
 * numbers in them, can be made on several threads at the same time. Errors: ISO_BAD_INPUT. */
iso_status iso_draft_make(iso_draft *d);

/* A number or a vector that the text states, for sweeps. */
typedef struct iso_draft_number {
    char name[2 * ISO_NAME_SIZE]; /* "k", "surface.radius", "gravity.up"  */
    int count;                    /* 1, 3 or 9 numbers                    */
    size_t offset;                /* of the first, from the draft's begin */
    const yaml_node_t *value;     /* where it stands                      */
} iso_draft_number;

/* Lists the numbers that the text states, at most `most`, and returns how many. A number that two sections can have, or
 * that belongs to an effect, is called SECTION.KEY. */
int iso_draft_numbers(iso_draft *d, int most, iso_draft_number list[]);

/* Their texts, of all that are one number or three (scene_file.h). Errors: ISO_NO_MEMORY. */
iso_status iso_draft_literals(iso_draft *d, iso_literals *literals);

#endif

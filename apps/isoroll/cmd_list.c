/* isoroll list - prints what there is: systems, backends, effects, methods and so on. */
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "task/list/list_impl.h"

typedef struct options {
    const char *topic;
} options;

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    iso_memory memory;
    FILE *to = iso_memory_open(&memory);
    if (!to) return finish(ctx, iso_context_no_memory(ctx, "a list"));
    const iso_status status = iso_list_print(ctx, strcmp(o->topic, "-") == 0 ? NULL : o->topic, to);
    char *text = iso_memory_close(to, &memory);
    if (text && status == ISO_OK) iso_fold(stdout, text, terminal_width(stdout));
    free(text);
    if (!text && status == ISO_OK) return finish(ctx, iso_context_no_memory(ctx, "a list"));
    if (status == ISO_BAD_ARGUMENT) return warn("%s", iso_context_message(ctx)), EXIT_USAGE;
    return finish(ctx, status);
}

static const option_row rows[] = {ROW_END};

const command command_list = {
    COMMAND_OF_ZEROS("list", "[TOPIC]", "list what there is: systems, backends, effects, methods, columns, ...",
                     topic),
    .run = run,
    .word = iso_list_topic,
    .description = "A topic is systems, backends, effects, methods, surfaces, integrals, clocks, columns or tables. "
                   "Without one, "
                   "all topics are listed.",
    .example = "isoroll list methods",
};

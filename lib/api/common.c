/* common.c - what the calls for other languages share: notes, texts, and the slow monitor. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "api/interface_impl.h"

int iso_interface(void)
{
    return ISO_INTERFACE;
}

/* --- notes ------------------------------------------------------------------------------------------------------ */

notes iso_notes_begin(char text[], size_t room)
{
    if (room > 0) *text = '\0';
    return (notes){text, room, 0};
}

static void put(notes *n, const char *words)
{
    for (; *words && n->used + 1 < n->room; words++) n->text[n->used++] = *words;
    if (n->room > 0) n->text[n->used] = '\0';
}

void iso_notes_add(notes *n, const char *words)
{
    if (n->used > 0) put(n, "\n");
    put(n, words);
}

iso_status iso_text_give(iso_context *ctx, FILE *to, iso_memory *memory, char text[], size_t room, size_t *length)
{
    char *whole = iso_memory_close(to, memory);
    if (!whole) return iso_context_no_memory(ctx, "a text");
    *length = memory->used;
    if (room > 0) snprintf(text, room, "%s", whole);
    free(whole);
    return ISO_OK;
}

/* --- the monitor ------------------------------------------------------------------------------------------------ */

struct iso_slow_monitor {
    bool (*go_on)(void *data);
    void *data;
    double seconds, asked;
};

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static bool ask_sometimes(void *data)
{
    iso_slow_monitor *m = data;
    const double time = now();
    if (time - m->asked < m->seconds) return true;
    m->asked = time;
    return m->go_on(m->data);
}

iso_status iso_slow_monitor_create(iso_context *ctx, double seconds, bool (*go_on)(void *data), void *data,
                                   iso_slow_monitor **monitor)
{
    iso_slow_monitor *m = *monitor = malloc(sizeof *m);
    if (!m) return iso_context_no_memory(ctx, "a monitor");
    *m = (iso_slow_monitor){go_on, data, seconds, now()};
    iso_context_set_monitor(ctx, ask_sometimes, m);
    return ISO_OK;
}

void iso_slow_monitor_free(iso_slow_monitor *monitor)
{
    free(monitor);
}

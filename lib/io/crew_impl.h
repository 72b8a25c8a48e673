/* crew_impl.h - a few threads that work off tasks while the caller goes on.
 *
 *     iso_crew *crew = iso_crew_create();
 *     iso_crew_give(crew, &task);            task.work(task.data) is called by some thread
 *     ...
 *     iso_crew_finish(crew, &task);          it is done now
 *     iso_crew_free(crew);
 *
 * Readers and writers of text give blocks of lines to a crew: the blocks are independent, and the caller takes them
 * in their order. With one processor there are no threads, and iso_crew_finish does the work.
 */
#ifndef ISO_IO_CREW_IMPL_H
#define ISO_IO_CREW_IMPL_H

#include <stdbool.h>

typedef struct iso_crew iso_crew;

typedef enum iso_task_state { ISO_TASK_DONE, ISO_TASK_WAITS, ISO_TASK_RUNS } iso_task_state;

/* The caller sets work and data, and the rest to 0. */
typedef struct iso_crew_task {
    void (*work)(void *data); /* in default arithmetic (base/arithmetic_impl.h); no signal comes to its thread */
    void *data;
    iso_task_state state; /* the crew's, as is next */
    struct iso_crew_task *next;
} iso_crew_task;

/* No thread starts before the first task. NULL: no memory. */
iso_crew *iso_crew_create(void);

/* All tasks must be finished. NULL is allowed. */
void iso_crew_free(iso_crew *crew);

/* Threads that work beside the caller: 0 to 3. */
int iso_crew_size(const iso_crew *crew);

/* Puts a task behind those that wait. It must not be one that waits or runs. Starts the threads, as many as can be
 * had. */
void iso_crew_give(iso_crew *crew, iso_crew_task *task);

/* Returns when the task is done. Meanwhile the caller works off tasks that wait: this one, or those before it. A task
 * that was never given is done. */
void iso_crew_finish(iso_crew *crew, iso_crew_task *task);

/* Whether the task is done. */
bool iso_crew_is_done(iso_crew *crew, const iso_crew_task *task);

#endif

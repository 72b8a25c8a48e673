/* tasks_impl.h - a few threads that work off tasks while the caller goes on.
 *
 *     iso_tasks *tasks = iso_tasks_create();
 *     iso_tasks_give(tasks, &task);            task.work(task.data) is called by some thread
 *     ...
 *     iso_tasks_finish(tasks, &task);          it is done now
 *     iso_tasks_free(tasks);
 *
 * Readers and writers of text give blocks of lines to them: the blocks are independent, and the caller takes them
 * in their order. With one processor there are no threads, and iso_tasks_finish does the work.
 */
#ifndef ISO_IO_TASKS_IMPL_H
#define ISO_IO_TASKS_IMPL_H

#include <stdbool.h>

typedef struct iso_tasks iso_tasks;

/* The caller sets work and data, and the rest to 0. */
typedef struct iso_task {
    void (*work)(void *data); /* in default arithmetic (base/arithmetic_impl.h); no signal comes to its thread */
    void *data;
    bool given; /* set here: it waits or runs */
} iso_task;

/* No thread starts before the first task. NULL: no memory. */
iso_tasks *iso_tasks_create(void);

/* All tasks must be finished. NULL is allowed. */
void iso_tasks_free(iso_tasks *tasks);

/* Threads that work beside the caller: 0 to 3. */
int iso_tasks_size(const iso_tasks *tasks);

/* Puts a task behind those that wait, which are fewer than 16. It must not be one that waits or runs. Starts the
 * threads, as many as can be had. */
void iso_tasks_give(iso_tasks *tasks, iso_task *task);

/* Returns when the task is done. Meanwhile the caller works off tasks that wait: this one, or those before it. A task
 * that was never given is done. */
void iso_tasks_finish(iso_tasks *tasks, iso_task *task);

/* Whether the task is done. */
bool iso_tasks_is_done(iso_tasks *tasks, const iso_task *task);

#endif

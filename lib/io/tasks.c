/* tasks.c - a queue of tasks under a lock, and the threads that work it off (tasks_impl.h). */
#include "io/tasks_impl.h"

#include <pthread.h>
#include <signal.h>
#include <stdlib.h>

#include "base/arithmetic_impl.h"
#include "base/pool_impl.h"

enum { MOST = 3, QUEUE = 16 };

struct iso_tasks {
    pthread_mutex_t lock;
    pthread_cond_t given, done; /* a task waits, or all end; a task is done */
    iso_task *queue[QUEUE];     /* those that wait: from `first` to `last` */
    unsigned first, last;
    int size, started;
    bool tried, ends; /* tried: to start the threads */
    pthread_t thread[MOST];
};

iso_tasks *iso_tasks_create(void)
{
    iso_tasks *c = calloc(1, sizeof *c);
    if (!c) return NULL;
    pthread_mutex_init(&c->lock, NULL);
    pthread_cond_init(&c->given, NULL);
    pthread_cond_init(&c->done, NULL);
    c->size = (int)iso_pool_threads(0, MOST, 1) - 1;
    return c;
}

int iso_tasks_size(const iso_tasks *c)
{
    return c->size;
}

/* Works off the first task that waits. The lock is held before and after. */
static void work_off(iso_tasks *c)
{
    iso_task *task = c->queue[c->first++ % QUEUE];
    pthread_mutex_unlock(&c->lock);
    task->work(task->data);
    pthread_mutex_lock(&c->lock);
    task->given = false;
    pthread_cond_broadcast(&c->done);
}

static void *attend(void *tasks)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_tasks *c = tasks;
    pthread_mutex_lock(&c->lock);
    while (!c->ends)
        if (c->first != c->last)
            work_off(c);
        else
            pthread_cond_wait(&c->given, &c->lock);
    pthread_mutex_unlock(&c->lock);
    return NULL;
}

/* Signals go to the caller's thread: it waits in read(), which a signal must end. */
static void start(iso_tasks *c)
{
    sigset_t all, before;
    c->tried = true;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    while (c->started < c->size && pthread_create(&c->thread[c->started], NULL, attend, c) == 0) c->started++;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
}

void iso_tasks_free(iso_tasks *c)
{
    if (!c) return;
    pthread_mutex_lock(&c->lock);
    c->ends = true;
    pthread_cond_broadcast(&c->given);
    pthread_mutex_unlock(&c->lock);
    for (int i = 0; i < c->started; i++) pthread_join(c->thread[i], NULL);
    pthread_cond_destroy(&c->given);
    pthread_cond_destroy(&c->done);
    pthread_mutex_destroy(&c->lock);
    free(c);
}

void iso_tasks_give(iso_tasks *c, iso_task *task)
{
    if (!c->tried) start(c);
    pthread_mutex_lock(&c->lock);
    task->given = true;
    c->queue[c->last++ % QUEUE] = task;
    pthread_cond_signal(&c->given);
    pthread_mutex_unlock(&c->lock);
}

void iso_tasks_finish(iso_tasks *c, iso_task *task)
{
    ISO_DEFAULT_ARITHMETIC;
    pthread_mutex_lock(&c->lock);
    while (task->given)
        if (c->first != c->last)
            work_off(c);
        else
            pthread_cond_wait(&c->done, &c->lock);
    pthread_mutex_unlock(&c->lock);
}

bool iso_tasks_is_done(iso_tasks *c, const iso_task *task)
{
    pthread_mutex_lock(&c->lock);
    const bool done = !task->given;
    pthread_mutex_unlock(&c->lock);
    return done;
}

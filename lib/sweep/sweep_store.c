/* sweep_store.c - the result of a sweep while it is computed: chunks in their order, a file that can be gone on with. */
#define _GNU_SOURCE /* asprintf */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/output_impl.h"
#include "sweep/sweep_store_impl.h"

static iso_status refuse(iso_context *ctx, const char *path, const char *why)
{
    return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "'%s' %s", path, why);
}

/* --- chunks that wait ------------------------------------------------------------------------------------------- */

iso_status iso_sweep_queue_add(iso_context *ctx, iso_sweep_queue *q, const iso_sweep_rows *rows)
{
    iso_sweep_rows copy;
    if (q->count == q->room) {
        iso_sweep_rows *more = realloc(q->rows, (2 * q->room + 8) * sizeof *more);
        if (!more) return iso_context_no_memory(ctx, "chunks of a sweep");
        q->rows = more;
        q->room = 2 * q->room + 8;
    }
    ISO_TRY(iso_sweep_rows_create(ctx, rows->columns, rows->most, &copy));
    memcpy(copy.number, rows->number, iso_sweep_rows_bytes(rows));
    copy.first = rows->first;
    copy.count = rows->count;
    size_t i = q->count++;
    for (; i > 0 && q->rows[i - 1].first > rows->first; i--) q->rows[i] = q->rows[i - 1];
    q->rows[i] = copy;
    return ISO_OK;
}

bool iso_sweep_queue_take(iso_sweep_queue *q, size_t first, iso_sweep_rows *rows)
{
    if (q->count == 0 || (first != SIZE_MAX && q->rows[0].first != first)) return false;
    *rows = q->rows[0];
    memmove(q->rows, q->rows + 1, --q->count * sizeof *q->rows);
    return true;
}

void iso_sweep_queue_free(iso_sweep_queue *q)
{
    for (size_t i = 0; i < q->count; i++) iso_sweep_rows_free(&q->rows[i]);
    free(q->rows);
}

/* --- what is there already -------------------------------------------------------------------------------------- */

static bool is_ours(const iso_sweep_store *s, const iso_sweep_reader *r)
{
    return memcmp(r->head.hash, s->head->hash, sizeof r->head.hash) == 0 && r->shard.index == s->shard.index &&
           r->shard.count == s->shard.count;
}

/* A result that is there is this sweep's, or it is refused. A program that was killed just before its end may have left
 * the rows beside it. */
static iso_status look_at_result(iso_context *ctx, iso_sweep_store *s, bool resume)
{
    iso_sweep_reader *reader, *rows = NULL;
    iso_status status = iso_sweep_reader_open(ctx, s->path, &reader);
    if (status == ISO_NO_MEMORY) return status;
    if (status != ISO_OK) return refuse(ctx, s->path, "is there, and is no result of a sweep: it is not overwritten");
    const bool same = is_ours(s, reader);
    if (same && resume) status = iso_sweep_reader_all(ctx, reader, &s->failures, NULL, NULL);
    iso_sweep_reader_close(reader);
    if (status != ISO_OK) return status;
    if (!same) return refuse(ctx, s->path, "is the result of another sweep, shard or version: it is not overwritten");
    if (!resume) return refuse(ctx, s->path, "is there already, the result of this sweep: it is not overwritten");
    char *part = iso_file_part(s->rows);
    if (part && access(part, R_OK) == 0 && iso_sweep_reader_open(ctx, part, &rows) == ISO_OK && is_ours(s, rows))
        unlink(part);
    iso_sweep_reader_close(rows);
    free(part);
    s->complete = true;
    s->done = s->wanted;
    return ISO_OK;
}

/* A journal of version 0.2 has the chunks that were finished, in a form that is not read any more. */
static iso_status look_for_journal(iso_context *ctx, const char *path)
{
    static const char mark[] = "isoroll sweep journal\n";
    char *name, begin[sizeof mark] = "";
    if (asprintf(&name, "%s.journal", path) < 0) return iso_context_no_memory(ctx, "a sweep");
    FILE *file = fopen(name, "re");
    const bool is = file && fread(begin, 1, sizeof mark - 1, file) == sizeof mark - 1 && strcmp(begin, mark) == 0;
    if (file) fclose(file);
    const iso_status status =
        is ? refuse(ctx, name,
                    "is the journal of an older version of isoroll, which cannot be gone on with: remove it to begin "
                    "again, or give another name")
           : ISO_OK;
    free(name);
    return status;
}

/* The length of a file in whole lines, the first `most` of them. *header: whether its first line is that of a sweep;
 * *columns: whether the line with its columns is there. */
static size_t lines_length(const char *name, size_t most, bool *header, bool *columns)
{
    size_t length = 0, room = 0;
    ssize_t got;
    char *line = NULL;
    FILE *file = fopen(name, "re");
    *header = *columns = false;
    while (file && most-- > 0 && (got = getline(&line, &room, file)) > 0) {
        *header = *header || strncmp(line, "# isoroll sweep", 15) == 0;
        if (!*header || line[got - 1] != '\n') break;
        *columns = *columns || strncmp(line, "point,", 6) == 0;
        length += (size_t)got;
    }
    free(line);
    if (file) fclose(file);
    return length;
}

/* Reads the chunks that are whole. *lines: those of the file up to there. */
static iso_status read_chunks(iso_context *ctx, iso_sweep_store *s, size_t *lines)
{
    iso_sweep_reader *r;
    iso_sweep_rows rows;
    iso_status status = iso_sweep_rows_create(ctx, s->head->columns, s->head->chunk, &rows);
    if (status == ISO_OK) status = iso_sweep_reader_open(ctx, s->part, &r);
    if (status != ISO_OK) return iso_sweep_rows_free(&rows), status;
    r->unended = true;
    while (s->done < s->wanted && (status = iso_sweep_reader_rows(ctx, r, &rows)) == ISO_OK) {
        iso_sweep_failures_add(&s->failures, &rows);
        s->writer.sum = r->sum;
        *lines = iso_table_at(r->table)->line;
        s->done++;
    }
    iso_sweep_reader_close(r);
    iso_sweep_rows_free(&rows);
    return status == ISO_NO_MEMORY ? status : ISO_OK;
}

/* What a program has left is cut behind its last whole chunk. */
static iso_status take_rows(iso_context *ctx, iso_sweep_store *s, bool resume)
{
    bool header, columns;
    iso_sweep_reader *r = NULL;
    size_t length = lines_length(s->part, SIZE_MAX, &header, &columns), lines = 0;
    if (columns && iso_sweep_reader_open(ctx, s->part, &r) == ISO_NO_MEMORY) return ISO_NO_MEMORY;
    const bool same = r && is_ours(s, r);
    iso_sweep_reader_close(r);
    if (!header || (columns && !r)) return refuse(ctx, s->part, "is no file of a sweep: it would be overwritten");
    if (columns && !same)
        return refuse(
            ctx, s->part,
            "has chunks of another sweep, shard, version or kind of vectors: remove it, or give another name");
    if (!resume)
        return refuse(ctx, s->part,
                      "has chunks of this sweep: add --resume to go on with it, or remove it to begin again");
    s->ours = true;
    if (!columns) return iso_table_go_on(ctx, s->writer.table, s->writer.header, 0); /* its header was cut short */
    if (truncate(s->part, (off_t)length) != 0) return iso_file_trouble(ctx, "write", s->part);
    ISO_TRY(read_chunks(ctx, s, &lines));
    length = lines > 0 ? lines_length(s->part, lines, &header, &columns) : 0;
    return iso_table_go_on(ctx, s->writer.table, s->writer.header, length);
}

/* --- opening ---------------------------------------------------------------------------------------------------- */

static iso_status open_named(iso_context *ctx, iso_sweep_store *s, bool resume)
{
    struct stat file;
    ISO_TRY(look_for_journal(ctx, s->path));
    ISO_TRY(iso_sweep_writer_open(ctx, s->rows, s->head, s->shard, true, &s->writer));
    s->part = iso_file_part(s->rows);
    if (!s->part || stat(s->part, &file) != 0) return iso_file_trouble(ctx, "write", s->rows);
    if (file.st_size > 0) return take_rows(ctx, s, resume);
    s->ours = true;
    if (access(s->path, F_OK) == 0) return look_at_result(ctx, s, resume); /* it has come meanwhile */
    return iso_table_go_on(ctx, s->writer.table, s->writer.header, 0);
}

static iso_status open_store(iso_context *ctx, iso_sweep_store *s, bool resume)
{
    struct stat file;
    if (s->shard.count > ISO_SWEEP_MOST_SHARDS)
        return ISO_FAIL_ARGUMENT(ctx, "", "--shard: n is %zu, it must be at most %d", s->shard.count,
                                 ISO_SWEEP_MOST_SHARDS);
    ISO_TRY(iso_table_check_format(ctx, s->path));
    const bool named = strcmp(s->path, "-") != 0, there = named && stat(s->path, &file) == 0;
    if (there && S_ISDIR(file.st_mode)) return errno = EISDIR, iso_file_trouble(ctx, "write", s->path);
    if (there && S_ISREG(file.st_mode)) return look_at_result(ctx, s, resume);
    if (named && !there) return open_named(ctx, s, resume);
    return iso_sweep_writer_open(ctx, s->path, s->head, s->shard, false, &s->writer);
}

iso_status iso_sweep_store_open(iso_context *ctx, const char *path, const iso_sweep_head *head, iso_sweep_shard shard,
                                bool resume, iso_sweep_store **store)
{
    *store = NULL;
    iso_sweep_store *s = calloc(1, sizeof *s);
    if (!s) return iso_context_no_memory(ctx, "a sweep");
    s->head = head;
    s->shard = shard;
    s->wanted = iso_sweep_shard_chunks(head, shard);
    s->path = iso_file_follow(path); /* its rows stand beside the result, not beside a link to it */
    iso_status status = s->path || errno == ENOMEM ? ISO_OK : iso_file_trouble(ctx, "write", path);
    if (s->path && asprintf(&s->rows, "%s%s", s->path, iso_table_is_hdf5(s->path) ? ".csv" : "") < 0) s->rows = NULL;
    if (status == ISO_OK) status = s->rows ? open_store(ctx, s, resume) : iso_context_no_memory(ctx, "a sweep");
    if (status != ISO_OK) iso_sweep_store_close(s), s = NULL;
    *store = s;
    return status;
}

void iso_sweep_store_close(iso_sweep_store *s)
{
    if (!s) return;
    iso_context *ctx = iso_context_create(); /* nobody hears of trouble now */
    if (s->ours && (s->done == 0 || s->complete)) unlink(s->part);
    iso_sweep_writer_close(ctx, &s->writer, false);
    iso_context_free(ctx);
    iso_sweep_queue_free(&s->queue);
    free(s->path);
    free(s->rows);
    free(s->part);
    free(s);
}

/* --- adding and finishing --------------------------------------------------------------------------------------- */

/* Each chunk reaches the file: a program that is killed loses those that are computed, and those that wait. */
iso_status iso_sweep_store_add(iso_context *ctx, iso_sweep_store *s, const iso_sweep_rows *rows)
{
    iso_sweep_rows next;
    iso_status status = iso_sweep_queue_add(ctx, &s->queue, rows);
    while (status == ISO_OK && s->done < s->wanted &&
           iso_sweep_queue_take(&s->queue, (s->shard.index + s->done * s->shard.count) * s->head->chunk, &next)) {
        status = iso_sweep_writer_rows(ctx, &s->writer, &next);
        if (status == ISO_OK) status = iso_table_flush(ctx, s->writer.table);
        if (status == ISO_OK) s->done++, iso_sweep_failures_add(&s->failures, &next);
        iso_sweep_rows_free(&next);
    }
    return status;
}

iso_status iso_sweep_store_finish(iso_context *ctx, iso_sweep_store *s)
{
    iso_sweep_reader *r;
    if (s->complete) return ISO_OK;
    if (!s->part || !iso_table_is_hdf5(s->path)) {
        const iso_status status = iso_sweep_writer_close(ctx, &s->writer, true);
        s->ours = s->ours && status != ISO_OK;
        return status;
    }
    ISO_TRY(iso_sweep_writer_end(ctx, &s->writer));
    ISO_TRY(iso_table_flush(ctx, s->writer.table));
    ISO_TRY(iso_sweep_reader_open(ctx, s->part, &r));
    const iso_status status = iso_sweep_copy(ctx, &r, 1, s->shard, s->path, NULL);
    iso_sweep_reader_close(r);
    s->complete = status == ISO_OK; /* the rows as CSV go when this closes */
    return status;
}

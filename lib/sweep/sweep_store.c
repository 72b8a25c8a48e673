/* sweep_store.c - the result of a sweep while it is computed: chunks in order, a file that can be gone on with. */
#define _GNU_SOURCE /* asprintf */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/output_impl.h"
#include "sweep/sweep_store_impl.h"

#define REFUSE(path, why) ISO_FAIL_FILE(ctx, "'%s' " why, path)

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
    if (status != ISO_OK) return REFUSE(s->path, "is there, and is no result of a sweep: it is not overwritten");
    const bool same = is_ours(s, reader);
    if (same && resume) status = iso_sweep_copy(ctx, &reader, 1, s->shard, NULL, NULL, &s->failures);
    iso_sweep_reader_close(reader);
    if (status != ISO_OK) return status;
    if (!same) return REFUSE(s->path, "is the result of another sweep, shard or version: it is not overwritten");
    if (!resume) return REFUSE(s->path, "is there already, the result of this sweep: it is not overwritten");
    char *part = iso_file_part(s->rows);
    if (part && access(part, R_OK) == 0 && iso_sweep_reader_open(ctx, part, &rows) == ISO_OK && is_ours(s, rows))
        unlink(part);
    iso_sweep_reader_close(rows);
    free(part);
    s->complete = true;
    s->done = s->wanted;
    return ISO_OK;
}

/* What a part that was left has, as far as its lines are whole. */
typedef struct remains {
    size_t lines, length; /* lines, at most `lines`, and their bytes       */
    bool header, columns; /* its first line is that of a sweep; the line with its columns is there */
} remains;

static remains look_at_lines(const char *name, size_t most)
{
    remains r = {.lines = 0};
    size_t room = 0;
    ssize_t got;
    char *line = NULL;
    FILE *file = fopen(name, "re");
    while (file && r.lines < most && (got = getline(&line, &room, file)) > 0) {
        r.header = r.header || strncmp(line, "# isoroll sweep", 15) == 0;
        if (!r.header || line[got - 1] != '\n') break;
        r.columns = r.columns || strncmp(line, "point,", 6) == 0;
        r.lines++;
        r.length += (size_t)got;
    }
    free(line);
    if (file) fclose(file);
    return r;
}

/* Reads the chunks that are whole, which end before line `most` of the file, and cuts it behind the last one. */
static iso_status read_chunks(iso_context *ctx, iso_sweep_store *s, iso_sweep_reader *r, size_t most)
{
    iso_sweep_rows rows;
    size_t lines = 0;
    iso_status status = iso_sweep_rows_create(ctx, s->head->columns, s->head->chunk, &rows);
    r->unended = true;
    while (status == ISO_OK && s->done < s->wanted) {
        status = iso_sweep_reader_rows(ctx, r, &rows);
        if (status != ISO_OK || iso_table_at(r->table)->line > most) break;
        iso_sweep_failures_add(&s->failures, &rows);
        s->writer.sum = r->sum;
        lines = iso_table_at(r->table)->line;
        s->done++;
    }
    iso_sweep_rows_free(&rows);
    if (status == ISO_NO_MEMORY) return status;
    return iso_table_go_on(ctx, s->writer.file, s->writer.table, look_at_lines(s->part, lines).length);
}

static iso_status take_rows(iso_context *ctx, iso_sweep_store *s, bool resume)
{
    const remains left = look_at_lines(s->part, SIZE_MAX);
    iso_sweep_reader *r = NULL;
    iso_status status = left.columns ? iso_sweep_reader_open(ctx, s->part, &r) : ISO_OK;
    if (status == ISO_NO_MEMORY) return status;
    if (!left.header || (left.columns && !r))
        status = REFUSE(s->part, "is no file of a sweep: it would be overwritten");
    else if (r && !is_ours(s, r))
        status =
            REFUSE(s->part,
                   "has chunks of another sweep, shard, version or kind of vectors: remove it, or give another name");
    else if (!resume)
        status =
            REFUSE(s->part, "has chunks of this sweep: add --resume to go on with it, or remove it to begin again");
    else if (s->ours = true, r)
        status = read_chunks(ctx, s, r, left.lines);
    else
        status = iso_table_go_on(ctx, s->writer.file, s->writer.table, 0); /* its header was cut short */
    iso_sweep_reader_close(r);
    return status;
}

/* --- opening ---------------------------------------------------------------------------------------------------- */

static iso_status open_named(iso_context *ctx, iso_sweep_store *s, bool resume)
{
    /* A journal of version 0.2 has the chunks that were finished, in a form that is not read any more. */
    static const char mark[] = "isoroll sweep journal\n";
    char *name, begin[sizeof mark] = "";
    struct stat file;
    if (asprintf(&name, "%s.journal", s->path) < 0) return iso_context_no_memory(ctx, "a sweep");
    FILE *old = fopen(name, "re");
    const bool is = old && fread(begin, 1, sizeof mark - 1, old) == sizeof mark - 1 && strcmp(begin, mark) == 0;
    if (old) fclose(old);
    const iso_status status =
        is ? REFUSE(name, "is the journal of an older version of isoroll, which cannot be gone on with: remove it to "
                          "begin again, or give another name")
           : ISO_OK;
    free(name);
    ISO_TRY(status);
    ISO_TRY(iso_sweep_writer_open(ctx, s->rows, s->head, s->shard, true, &s->writer));
    s->part = iso_file_part(s->rows);
    if (!s->part || stat(s->part, &file) != 0) return iso_file_trouble(ctx, "write", s->rows);
    if (file.st_size > 0) return take_rows(ctx, s, resume);
    s->ours = true;
    if (access(s->path, F_OK) == 0) return look_at_result(ctx, s, resume); /* it has come meanwhile */
    return iso_table_go_on(ctx, s->writer.file, s->writer.table, 0);
}

static iso_status open_store(iso_context *ctx, iso_sweep_store *s, bool resume)
{
    struct stat file;
    if (!s->path) return iso_sweep_writer_open(ctx, NULL, s->head, s->shard, false, &s->writer);
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
    s->path = path ? iso_file_follow(path) : NULL; /* its rows stand beside the result, not beside a link to it */
    iso_status status = !path || s->path || errno == ENOMEM ? ISO_OK : iso_file_trouble(ctx, "write", path);
    if (s->path && asprintf(&s->rows, "%s%s", s->path, iso_table_is_hdf5(s->path) ? ".csv" : "") < 0) s->rows = NULL;
    if (status == ISO_OK && path && !s->rows) status = iso_context_no_memory(ctx, "a sweep");
    if (status == ISO_OK) status = open_store(ctx, s, resume);
    s->next = s->done;
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
    for (size_t i = 0; i < s->waiting; i++) iso_sweep_rows_free(&s->early[i]);
    free(s->early);
    free(s->path);
    free(s->rows);
    free(s->part);
    free(s);
}

/* --- adding and finishing --------------------------------------------------------------------------------------- */

/* Writes the chunks whose turn it is, or all. Each one reaches the file: a program that is killed loses those that are
 * computed, and those that wait. */
static iso_status write_early(iso_context *ctx, iso_sweep_store *s, bool all)
{
    iso_status status = ISO_OK;
    while (status == ISO_OK && s->waiting > 0 &&
           (all || s->early[0].first == (s->shard.index + s->done * s->shard.count) * s->head->chunk)) {
        iso_sweep_rows next = s->early[0];
        memmove(s->early, s->early + 1, --s->waiting * sizeof *s->early);
        status = iso_sweep_writer_rows(ctx, &s->writer, &next);
        if (status == ISO_OK && s->writer.file) status = iso_table_flush(ctx, s->writer.file);
        if (status == ISO_OK) s->done++, iso_sweep_failures_add(&s->failures, &next);
        iso_sweep_rows_free(&next);
    }
    return status;
}

/* Keeps a copy of the chunk until its turn comes. */
iso_status iso_sweep_store_add(iso_context *ctx, iso_sweep_store *s, const iso_sweep_rows *rows)
{
    iso_sweep_rows copy, *more = realloc(s->early, (s->waiting + 1) * sizeof *more);
    if (!more) return iso_context_no_memory(ctx, "chunks of a sweep");
    s->early = more;
    ISO_TRY(iso_sweep_rows_create(ctx, rows->columns, rows->most, &copy));
    memcpy(copy.number, rows->number, iso_sweep_rows_bytes(rows));
    copy.first = rows->first;
    copy.count = rows->count;
    size_t i = s->waiting++;
    for (; i > 0 && more[i - 1].first > rows->first; i--) more[i] = more[i - 1];
    more[i] = copy;
    return write_early(ctx, s, false);
}

static bool next_chunk(void *store, size_t *c)
{
    iso_sweep_store *s = store;
    if (s->next == s->wanted || (s->interrupted && s->interrupted())) return false;
    *c = s->shard.index + s->next++ * s->shard.count;
    return true;
}

static iso_status take_chunk(void *store, iso_context *ctx, size_t c, const iso_sweep_rows *rows)
{
    iso_sweep_store *s = store;
    (void)c;
    const iso_status status = iso_sweep_store_add(ctx, s, rows);
    if (s->progress) s->progress(s->data, (double)(s->done + s->waiting) / (double)s->wanted);
    return status;
}

iso_sweep_source iso_sweep_store_source(iso_sweep_store *s)
{
    return (iso_sweep_source){next_chunk, take_chunk, s};
}

iso_status iso_sweep_store_table(iso_context *ctx, iso_sweep_store *s, iso_record **table)
{
    iso_status status = write_early(ctx, s, true);
    if (status == ISO_OK && s->done == s->wanted) status = iso_sweep_writer_end(ctx, &s->writer);
    *table = s->done > 0 ? s->writer.table : NULL;
    if (*table) s->writer.table = NULL;
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
    ISO_TRY(iso_table_flush(ctx, s->writer.file));
    ISO_TRY(iso_sweep_reader_open(ctx, s->part, &r));
    const iso_status status = iso_sweep_copy(ctx, &r, 1, s->shard, s->path, NULL, NULL);
    iso_sweep_reader_close(r);
    s->complete = status == ISO_OK; /* the rows as CSV go when this closes */
    return status;
}

/* sweep_journal.c - the journal of a sweep: a head, and one record for each finished chunk. Numbers stand as they are
 * in memory; the head tells other machines apart.
 *
 *     head     mark, hash, points, chunk, columns, shard, checksum
 *     record   chunk, length of what follows, checksum; then numbers, statuses, and for each status that is not 0 the
 *              length of a reason and the reason
 */
#define _GNU_SOURCE /* asprintf */
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/replacement_impl.h"
#include "sweep/sweep_store_impl.h"

typedef struct journal_head {
    char mark[24];
    double order; /* tells how this machine writes numbers */
    uint64_t hash[2], points, chunk, columns, index, count, checksum;
} journal_head;

/* --- small things ----------------------------------------------------------------------------------------------- */

static iso_status trouble(iso_context *ctx, const iso_sweep_journal *j, const char *what)
{
    return iso_file_trouble(ctx, what, j->name ? j->name : "a temporary file");
}

static journal_head head_of(const iso_sweep_journal *j)
{
    journal_head h;
    memset(&h, 0, sizeof h); /* also what lies between its members */
    snprintf(h.mark, sizeof h.mark, "isoroll sweep journal\n");
    h.order = -1234.5;
    memcpy(h.hash, j->head->hash, sizeof h.hash);
    h.points = j->head->count;
    h.chunk = j->head->chunk;
    h.columns = (uint64_t)j->head->columns;
    h.index = j->shard.index;
    h.count = j->shard.count;
    h.checksum = iso_sweep_checksum(&h, offsetof(journal_head, checksum), 1);
    return h;
}

/* False: the file ends before (errno is 0), or cannot be read. */
static bool read_at(const iso_sweep_journal *j, off_t at, void *bytes, size_t length)
{
    size_t done = 0;
    while (done < length) {
        const ssize_t got = pread(j->descriptor, (char *)bytes + done, length - done, at + (off_t)done);
        if (got < 0 && errno == EINTR) continue;
        if (got == 0) errno = 0;
        if (got <= 0) return false;
        done += (size_t)got;
    }
    return true;
}

/* After a failure the file is cut to what it was. */
static iso_status append(iso_context *ctx, iso_sweep_journal *j, const void *bytes, size_t length)
{
    size_t done = 0;
    while (done < length) {
        const ssize_t got = pwrite(j->descriptor, (const char *)bytes + done, length - done, j->end + (off_t)done);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) {
            if (got == 0) errno = EIO;
            const iso_status status = trouble(ctx, j, "write");
            (void)!ftruncate(j->descriptor, j->end);
            return status;
        }
        done += (size_t)got;
    }
    j->end += (off_t)length;
    return ISO_OK;
}

/* --- records ---------------------------------------------------------------------------------------------------- */

/* Reads the record at `at` into rows. False: it is not whole (errno is 0), or it cannot be read. */
static bool read_record(iso_sweep_journal *j, off_t at, iso_sweep_record *r, iso_sweep_rows *rows)
{
    if (!read_at(j, at, r, sizeof *r)) return false;
    errno = 0;
    if (r->length > j->room - sizeof *r || r->chunk >= iso_sweep_chunks(j->head)) return false;
    if (!read_at(j, at + (off_t)sizeof *r, j->buffer, r->length)) return false;
    rows->first = r->chunk * j->head->chunk;
    rows->count = iso_sweep_chunk_points(j->head, r->chunk);
    return r->checksum == iso_sweep_record_sum(r, j->buffer) && iso_sweep_rows_unpack(j->buffer, r->length, rows);
}

/* --- opening ---------------------------------------------------------------------------------------------------- */

static iso_status refuse(iso_context *ctx, const char *path, const char *why)
{
    return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "'%s' %s", path, why);
}

/* Whether only zeros follow: a loss of power can leave them in place of bytes that were not on the disk yet. */
static bool is_empty(iso_sweep_journal *j, off_t at, off_t size)
{
    for (; at < size; at += (off_t)j->room) {
        const size_t length = size - at < (off_t)j->room ? (size_t)(size - at) : j->room;
        if (!read_at(j, at, j->buffer, length)) return false;
        for (size_t i = 0; i < length; i++)
            if (j->buffer[i] != 0) return errno = 0, false;
    }
    return true;
}

/* Whether what follows j->end can be a record that was cut short: it is not longer than one, and no whole record
 * stands in it. False with errno 0: it cannot. */
static bool is_torn(iso_sweep_journal *j, off_t size)
{
    if (is_empty(j, j->end, size)) return true;
    if (errno != 0 || size - j->end > (off_t)j->room) return false;
    const size_t length = (size_t)(size - j->end);
    return read_at(j, j->end, j->buffer, length) && !iso_sweep_record_inside(j->head, j->buffer, length);
}

/* What is behind the last whole record is cut off if it is a record that was cut short. Else chunks would be lost. */
static iso_status cut_tail(iso_context *ctx, iso_sweep_journal *j, off_t size)
{
    if (j->end >= size) return ISO_OK;
    j->ours = errno == 0 && is_torn(j, size);
    if (j->ours) return ftruncate(j->descriptor, j->end) == 0 ? ISO_OK : trouble(ctx, j, "write");
    return errno != 0 ? trouble(ctx, j, "read") : refuse(ctx, j->name, "is damaged: remove it to begin again");
}

/* Takes the records that are there. */
static iso_status scan(iso_context *ctx, iso_sweep_journal *j, off_t size)
{
    iso_sweep_rows rows;
    iso_sweep_record r;
    ISO_TRY(iso_sweep_rows_create(ctx, j->head->columns, j->head->chunk, &rows));
    j->ours = true;
    while (j->end < size && read_record(j, j->end, &r, &rows)) {
        if (r.chunk % j->shard.count == j->shard.index && j->at[r.chunk] == 0) {
            j->at[r.chunk] = j->end;
            j->done++;
            iso_sweep_failures_add(&j->failures, &rows);
        }
        j->end += (off_t)(sizeof r + r.length);
    }
    iso_status status = cut_tail(ctx, j, size);
    iso_sweep_rows_free(&rows);
    return status;
}

/* The name of the journal of a sweep into `path`, links followed, to be freed by the caller. NULL with errno set. */
static char *name_of_journal(const char *path)
{
    char *name, *end;
    if (asprintf(&name, "%s.journal", path) < 0) return errno = ENOMEM, NULL;
    end = iso_file_follow(name);
    free(name);
    return end;
}

/* A program killed just before its end leaves a complete result, and the journal beside it. */
static void remove_old(const iso_sweep_journal *j)
{
    const journal_head mine = head_of(j);
    journal_head there;
    char *name = name_of_journal(j->path);
    if (!name) return;
    const int fd = open(name, O_RDONLY | O_CLOEXEC);
    const bool ours = fd >= 0 && flock(fd, LOCK_EX | LOCK_NB) == 0 &&
                      read(fd, &there, sizeof there) == sizeof there && memcmp(&there, &mine, sizeof mine) == 0;
    if (ours) unlink(name);
    if (fd >= 0) close(fd);
    free(name);
}

/* A result that is there is this sweep's, or it is refused. */
static iso_status look_at_result(iso_context *ctx, iso_sweep_journal *j, bool resume)
{
    iso_sweep_reader *reader;
    iso_status status = iso_sweep_reader_open(ctx, j->path, &reader);
    if (status == ISO_NO_MEMORY) return status;
    if (status != ISO_OK) return refuse(ctx, j->path, "is there, and is no result of a sweep: it is not overwritten");
    const bool same = memcmp(reader->head.hash, j->head->hash, sizeof j->head->hash) == 0 &&
                      reader->shard.index == j->shard.index && reader->shard.count == j->shard.count;
    if (same && resume) status = iso_sweep_reader_failures(ctx, reader, &j->failures);
    iso_sweep_reader_close(reader);
    if (status != ISO_OK) return status;
    if (!same) return refuse(ctx, j->path, "is the result of another sweep, shard or version: it is not overwritten");
    if (!resume) return refuse(ctx, j->path, "is there already, the result of this sweep: it is not overwritten");
    remove_old(j);
    j->complete = true;
    j->done = j->wanted;
    return ISO_OK;
}

/* A journal that was there before. */
static iso_status take_old(iso_context *ctx, iso_sweep_journal *j, off_t size, bool resume)
{
    const journal_head mine = head_of(j);
    journal_head there;
    j->ours = size == 0;
    if (j->ours && access(j->path, F_OK) == 0) return look_at_result(ctx, j, resume); /* it has come meanwhile */
    if (j->ours) return append(ctx, j, &mine, sizeof mine);
    const bool read = size >= (off_t)sizeof there && read_at(j, 0, &there, sizeof there);
    if (!read && resume && size < (off_t)sizeof there) { /* cut short before its first record */
        char begin[sizeof there.mark];
        const size_t length = (size_t)size < sizeof begin ? (size_t)size : sizeof begin;
        if (read_at(j, 0, begin, length) && memcmp(begin, mine.mark, length) == 0)
            return append(ctx, j, &mine, sizeof mine);
    }
    if (!read || memcmp(there.mark, mine.mark, sizeof mine.mark) != 0)
        return refuse(ctx, j->name, "is no journal of a sweep: it would be overwritten");
    if (memcmp(&there, &mine, sizeof mine) != 0)
        return refuse(
            ctx, j->name,
            "is the journal of another sweep, shard, version or kind of vectors: remove it, or give another name");
    if (!resume)
        return refuse(ctx, j->name,
                      "has chunks of this sweep: add --resume to go on with it, or remove it to begin again");
    j->end = (off_t)sizeof mine;
    return scan(ctx, j, size);
}

static iso_status open_named(iso_context *ctx, iso_sweep_journal *j, bool resume)
{
    struct stat s;
    j->name = name_of_journal(j->path);
    if (!j->name) return iso_file_trouble(ctx, "write the journal of", j->path);
    j->descriptor = iso_file_open_locked(j->name);
    if (j->descriptor < 0 && errno == EWOULDBLOCK)
        return refuse(ctx, j->name, "is in use: another isoroll works on this sweep");
    if (j->descriptor < 0 || fstat(j->descriptor, &s) != 0) return trouble(ctx, j, "write");
    if (!S_ISREG(s.st_mode)) return refuse(ctx, j->name, "is no regular file");
    return take_old(ctx, j, s.st_size, resume);
}

static iso_status open_unnamed(iso_context *ctx, iso_sweep_journal *j)
{
    const journal_head mine = head_of(j);
    FILE *file = tmpfile();
    j->descriptor = file ? fcntl(fileno(file), F_DUPFD_CLOEXEC, 0) : -1;
    if (file) fclose(file);
    return j->descriptor < 0 ? trouble(ctx, j, "write") : append(ctx, j, &mine, sizeof mine);
}

static iso_status open_journal(iso_context *ctx, iso_sweep_journal *j, bool resume)
{
    struct stat s;
    if (j->shard.count > ISO_SWEEP_MOST_SHARDS)
        return ISO_FAIL_ARGUMENT(ctx, "", "--shard: n is %zu, it must be at most %d", j->shard.count,
                                 ISO_SWEEP_MOST_SHARDS);
    ISO_TRY(iso_table_check_format(ctx, j->path));
    if (strcmp(j->path, "-") == 0) return open_unnamed(ctx, j);
    if (stat(j->path, &s) != 0) return open_named(ctx, j, resume);
    if (S_ISDIR(s.st_mode)) return errno = EISDIR, iso_file_trouble(ctx, "write", j->path);
    return S_ISREG(s.st_mode) ? look_at_result(ctx, j, resume) : open_unnamed(ctx, j);
}

iso_status iso_sweep_journal_open(iso_context *ctx, const char *path, const iso_sweep_head *head,
                                  iso_sweep_shard shard, bool resume, iso_sweep_journal **journal)
{
    *journal = NULL;
    iso_sweep_journal *j = calloc(1, sizeof *j);
    if (!j) return iso_context_no_memory(ctx, "a sweep");
    const size_t chunks = iso_sweep_chunks(head);
    j->descriptor = -1;
    j->path = iso_file_follow(path); /* the journal stands beside the result, not beside a link to it */
    if (!j->path && errno != ENOMEM) {
        free(j);
        return iso_file_trouble(ctx, "write", path);
    }
    j->head = head;
    j->shard = shard;
    j->wanted = chunks > shard.index ? (chunks - shard.index - 1) / shard.count + 1 : 0;
    j->at = calloc(chunks + 1, sizeof *j->at);
    j->room =
        sizeof(iso_sweep_record) + iso_sweep_rows_bytes(&(iso_sweep_rows){.columns = head->columns}, head->chunk);
    j->buffer = malloc(j->room);
    const iso_status status =
        j->path && j->at && j->buffer ? open_journal(ctx, j, resume) : iso_context_no_memory(ctx, "a sweep");
    if (status != ISO_OK) iso_sweep_journal_close(j), j = NULL;
    *journal = j;
    return status;
}

/* A journal that holds nothing but its head is removed; not one that was refused. */
void iso_sweep_journal_close(iso_sweep_journal *j)
{
    if (!j) return;
    if (j->descriptor >= 0) {
        if (j->ours && j->end <= (off_t)sizeof(journal_head)) unlink(j->name);
        close(j->descriptor);
    }
    free(j->path);
    free(j->name);
    free(j->at);
    free(j->buffer);
    free(j);
}

/* --- what is there ---------------------------------------------------------------------------------------------- */

bool iso_sweep_journal_has(const iso_sweep_journal *j, size_t c)
{
    return j->complete || c % j->shard.count != j->shard.index || j->at[c] != 0;
}

/* --- adding and finishing --------------------------------------------------------------------------------------- */

/* Against a loss of power, at most every fifth second. */
static void sync_now_and_then(iso_sweep_journal *j)
{
    const time_t now = time(NULL);
    if (now - j->synced < 5) return;
    if (j->synced > 0) (void)!fdatasync(j->descriptor);
    j->synced = now;
}

iso_status iso_sweep_journal_add(iso_context *ctx, iso_sweep_journal *j, size_t c, const iso_sweep_rows *rows)
{
    if (iso_sweep_journal_has(j, c)) return ISO_OK;
    iso_sweep_record r = {.chunk = c};
    const off_t at = j->end;
    const size_t length = r.length = iso_sweep_rows_pack(rows, j->buffer + sizeof r);
    r.checksum = iso_sweep_record_sum(&r, j->buffer + sizeof r);
    memcpy(j->buffer, &r, sizeof r);
    ISO_TRY(append(ctx, j, j->buffer, sizeof r + length));
    j->at[c] = at;
    j->done++;
    iso_sweep_failures_add(&j->failures, rows);
    sync_now_and_then(j);
    return ISO_OK;
}

static iso_status next_rows(iso_context *ctx, void *journal, size_t c, iso_sweep_rows *rows)
{
    iso_sweep_journal *j = journal;
    iso_sweep_record r;
    if (read_record(j, j->at[c], &r, rows)) return ISO_OK;
    if (errno == 0) errno = EIO;
    return trouble(ctx, j, "read");
}

iso_status iso_sweep_journal_finish(iso_context *ctx, iso_sweep_journal *j)
{
    if (j->complete) return ISO_OK;
    const iso_status status = iso_sweep_write(ctx, j->path, j->head, j->shard, next_rows, j);
    if (status == ISO_OK && j->name) unlink(j->name);
    return status;
}

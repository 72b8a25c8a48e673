/* times.c - reads output times (stream.h): numbers between blanks, commas, new lines and comments. */
#include "base/number_impl.h"
#include "io/output_impl.h"
#include "io/text_impl.h"
#include "stream.h"

#include <string.h>

/* Where in a file, from 1, columns in characters. */
typedef struct place {
    int line, column;
} place;

enum { WORD = 512 }; /* as long as a number can be (iso_number_read) */

/* The next number of the file into word, with the place where it begins; its length, 0 at the end. Between them are
 * blanks, commas, new lines, and comments, which begin with #. */
static size_t next_word(FILE *file, char word[WORD], place *at)
{
    size_t length = 0;
    bool comment = false;
    for (int c; length < WORD - 1 && (c = getc(file)) != EOF;) {
        comment = c != '\n' && (comment || c == '#');
        if (c != '\0' && strchr(" \t,\r\n#", c)) {
            if (length > 0) {
                ungetc(c, file);
                break;
            }
        } else if (!comment) {
            word[length++] = (char)c;
            continue;
        }
        at->column = c == '\n' ? 1 : at->column + ((c & 0xC0) != 0x80);
        at->line += c == '\n';
    }
    word[length] = '\0';
    return length;
}

static iso_status read_words(iso_context *ctx, const char *name, FILE *file, iso_record *times)
{
    char word[WORD];
    place at = {1, 1};
    size_t length;
    double time;
    while ((length = next_word(file, word, &at)) > 0) {
        if (!iso_number_read(word, length, &time))
            return ISO_FAIL_INPUT(ctx, "", "%s:%d:%d: '%.40s' is not a time: expected a finite number", name, at.line,
                                  at.column, word);
        ISO_TRY(iso_record_add(ctx, times, 1, &time));
        at.column += (int)length;
    }
    if (ferror(file)) return iso_file_trouble(ctx, "read", name);
    if (iso_record_rows(times) > 0) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, "", "%s:1:1: no times in this file: expected numbers", name);
}

iso_status times_read(iso_context *ctx, const char *path, iso_record **times)
{
    ISO_TRY(iso_record_create(ctx, 1, (const char *[]){"time"}, times));
    FILE *file = iso_text_open(ctx, path);
    if (!file) return ISO_FILE_TROUBLE;
    const iso_status status = read_words(ctx, iso_text_name(path), file, *times);
    iso_text_close(file);
    return status;
}

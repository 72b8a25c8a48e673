/* folder.h - a folder of the test's own in /tmp, and files in it. mkdtemp(folder) makes it, rmdir(folder) takes it
 * away. */
#ifndef ISO_TESTS_FOLDER_H
#define ISO_TESTS_FOLDER_H

#include <dirent.h>
#include <gsl/gsl_test.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[] = "/tmp/isoroll-test-XXXXXX";

/* A path in the folder; four can be in use at once. */
static inline const char *in_folder(const char *name)
{
    static char paths[4][256];
    static int next;
    char *path = paths[next++ % 4];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

static inline int files_in_folder(void)
{
    DIR *d = opendir(folder);
    int count = -2; /* . and .. */
    while (d && readdir(d)) count++;
    if (d) closedir(d);
    return count;
}

static inline void put_file(const char *path, const char *text, size_t length)
{
    FILE *file = fopen(path, "wb");
    gsl_test(!file || fwrite(text, 1, length, file) != length, "cannot write %s", path);
    if (file) fclose(file);
}

/* The whole file as a text of at most 4 MiB, "" where there is none; until the next call. */
static inline const char *file_text(const char *path)
{
    static char text[1 << 22];
    FILE *file = fopen(path, "rb");
    text[file ? fread(text, 1, sizeof text - 1, file) : 0] = '\0';
    if (file) fclose(file);
    return text;
}

/* A gnuplot that is a script of ours: put its folder, the first of PATH, before the others. */
static inline void put_gnuplot(const char *path, const char *body)
{
    FILE *file = fopen(path, "w");
    if (!file) exit(1);
    fprintf(file, "#!/bin/sh\n%s\n", body);
    fclose(file);
    chmod(path, 0755);
}

#endif

/* embedded.c - finds a file that the build put into the program (see embedded.h). */
#include "embedded.h"

#include <string.h>

const embedded_file *embedded_find(const embedded_file *files, const char *name)
{
    while (files->name && strcmp(files->name, name) != 0) files++;
    return files;
}

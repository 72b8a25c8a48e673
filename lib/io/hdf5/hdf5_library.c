/* hdf5_library.c - loads the HDF5 library when it is first needed (hdf5_library_impl.h). The table is the library's:
 * there is one in a process, as there is one HDF5. */
#include "io/hdf5/hdf5_library_impl.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

iso_hdf5_library h5;

static char trouble[512]; /* "": the table is full */

/* Finds the address of a function or a variable of the library. */
static void find(void *library, const char *name, void *pointer)
{
    void *const address = library ? dlsym(library, name) : NULL;
    memcpy(pointer, &address, sizeof address);
    if (address || *trouble) return;
    const char *why = dlerror();
    strncat(trouble, why ? why : name, sizeof trouble - 1);
}

static void load(void)
{
    const char *wanted = getenv("ISOROLL_HDF5"); /* counts only if it is not empty */
    const char *name = wanted && *wanted ? wanted : ISO_HDF5_SONAME;
    void *const library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
#define FIND(name) find(library, "H5" #name, &h5.name);
    ISO_HDF5_NAMES(FIND)
    if (*trouble) return;
    h5.dont_atexit(); /* it would close what it could not close before, as on a full disk, and crash (1.10) */
    h5.open();
}

iso_status iso_hdf5_load(iso_context *ctx)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, load);
    if (!*trouble) return ISO_OK;
    return iso_context_fail(
        ctx, ISO_FILE_TROUBLE, "",
        "no HDF5 library, which files in .h5 need: %s. Install HDF5 1.10 or later (for Python: h5py), or set "
        "ISOROLL_HDF5 to the path of its libhdf5",
        trouble);
}

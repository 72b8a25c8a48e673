/* hdf5_refuse.c - what is refused of a file of HDF5 before its rows are read: it may come from people nobody knows.
 *
 * HDF5 can take the rows of a dataset from other files: by external links, external storage, virtual datasets. So a
 * file could name any file that its reader may read, and show it. HDF5 loads unknown filters from folders of plugins. A
 * file of a few bytes can promise rows that nobody wrote, and chunks of any size. None of these is needed for a table.
 */
#include <stdlib.h>

#include "io/hdf5/hdf5_impl.h"

/* --- what is asked while HDF5 reads ----------------------------------------------------------------------------- */

/* HDF5 calls this before it opens the other file of an external link. */
static herr_t refuse_link(const char *from, const char *group, const char *to, const char *object, unsigned *flags,
                          hid_t plan, void *elsewhere)
{
    (void)from, (void)group, (void)to, (void)object, (void)flags, (void)plan;
    *(bool *)elsewhere = true;
    return -1;
}

/* Memory for a word of a block; NULL: the words are too long, or there is none. */
static void *give_word(size_t size, void *left)
{
    size_t *room = left;
    if (size > *room) return *room = 0, NULL;
    *room -= size;
    return malloc(size);
}

static void take_word(void *word, void *left)
{
    (void)left;
    free(word);
}

void iso_hdf5_guard(iso_hdf5_store *s)
{
    s->access = H5Pcreate(H5P_DATASET_ACCESS);
    H5Pset_chunk_cache(s->access, 1, ISO_HDF5_MOST_CHUNKS, 1);
    H5Pset_elink_cb(s->access, refuse_link, &s->elsewhere);
    s->transfer = H5Pcreate(H5P_DATASET_XFER);
    s->word_room = ISO_HDF5_WORDS;
    H5Pset_vlen_mem_manager(s->transfer, give_word, &s->word_room, take_word, NULL);
}

/* --- what a dataset is ------------------------------------------------------------------------------------------ */

/* Of those that HDF5 has itself, and that lose nothing; each once, so that no chunk is packed by more than deflate
 * can. */
static const char *trouble_of_filters(hid_t plan)
{
    const int count = H5Pget_nfilters(plan);
    bool seen[H5Z_FILTER_FLETCHER32 + 1] = {false};
    for (int i = 0; i < count; i++) {
        unsigned flags;
        size_t numbers = 0;
        const int filter = H5Pget_filter2(plan, (unsigned)i, &flags, &numbers, NULL, 0, NULL, NULL);
        if (filter < H5Z_FILTER_DEFLATE || filter > H5Z_FILTER_FLETCHER32)
            return "expected no filters but deflate (gzip), shuffle and fletcher32 for ";
        if (seen[filter]) return "the same filter stands twice before ";
        seen[filter] = true;
    }
    return count < 0 ? "unknown filters of " : NULL;
}

/* Rows that were promised, but never written. A chunk is written as a whole. */
static const char *trouble_of_room(iso_hdf5_store *s, hid_t id, hid_t plan, const hsize_t size[2], double bytes)
{
    static const char unwritten[] = "this dataset has rows that were never written: ";
    const double stored = (double)H5Dget_storage_size(id);
    hsize_t chunk[2] = {0, 1}, there = 0;
    if (H5Pget_layout(plan) != H5D_CHUNKED)
        return stored < (double)size[0] * (double)size[1] * bytes ? unwritten : NULL;
    const hid_t all = H5Dget_space(id);
    const bool counted = H5Pget_chunk(plan, 2, chunk) > 0 && H5Dget_num_chunks(id, all, &there) >= 0;
    H5Sclose(all);
    if (!counted || chunk[0] == 0 || chunk[1] == 0) return "unknown chunks of ";
    const hsize_t rows = size[0] / chunk[0] + (size[0] % chunk[0] > 0), columns = (size[1] - 1) / chunk[1] + 1;
    const double room = (double)chunk[0] * (double)chunk[1] * bytes;
    s->chunks += room;
    if (s->chunks > ISO_HDF5_MOST_CHUNKS) return "more than 256 MiB for one chunk of each dataset, with ";
    if ((double)there < (double)rows * (double)columns) return unwritten;
    return stored > 1.1 * room * (double)there + ISO_HDF5_BLOCK ? "more is stored than the rows of " : NULL;
}

const char *iso_hdf5_trouble_of_set(iso_hdf5_store *s, hid_t id, hid_t type, const hsize_t size[2])
{
    enum { MOST_BYTES = 16, WORD_STORED = 16 }; /* of a number; of a word of any length: where it stands */
    const hid_t plan = H5Dget_create_plist(id);
    const H5T_class_t class = H5Tget_class(type);
    const size_t bytes = H5Tget_size(type);
    const char *trouble = NULL;
    if (plan < 0 || type < 0)
        trouble = "cannot read what this dataset is: ";
    else if (H5Pget_layout(plan) == H5D_VIRTUAL)
        trouble = "a virtual dataset, whose rows would come from other files: ";
    else if (H5Pget_external_count(plan) != 0)
        trouble = "external storage, whose rows would come from other files: ";
    else if (class == H5T_STRING ? bytes > ISO_HDF5_WORDS / ISO_HDF5_BLOCK : bytes > MOST_BYTES)
        trouble = "expected numbers, or words of at most 16 KiB, for ";
    else if (class != H5T_STRING && class != H5T_FLOAT && class != H5T_INTEGER)
        trouble = "expected numbers or words for ";
    else
        trouble = trouble_of_filters(plan);
    if (!trouble && size[0] > 0 && size[1] > 0)
        trouble = trouble_of_room(s, id, plan, size, H5Tis_variable_str(type) > 0 ? WORD_STORED : (double)bytes);
    H5Pclose(plan);
    return trouble;
}

/* strangers.c - strangers KIND FILE DATASET: puts one of a kind that isoroll refuses, or one that it takes ("packed"),
 * in the place of a dataset. */
#include <hdf5.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static hid_t file, type, space, plan;
static hsize_t size[2] = {0, 1};
static int rank;

static hid_t create(const char *path)
{
    const hid_t id = H5Dcreate2(file, path, type, space, H5P_DEFAULT, plan, H5P_DEFAULT);
    if (id < 0) exit(1);
    return id;
}

static void chunks(hsize_t rows)
{
    const hsize_t chunk[2] = {rows, size[1]}, most[2] = {H5S_UNLIMITED, size[1]};
    H5Pset_chunk(plan, rank, chunk);
    space = H5Screate_simple(rank, size, most);
}

static hid_t follow(const char *link, hid_t group, const void *bytes, size_t length, hid_t how, hid_t transfer)
{
    (void)link, (void)bytes, (void)length, (void)how, (void)transfer;
    return H5Gopen2(group, "/", H5P_DEFAULT);
}

/* Links in the place of the dataset. */
static int link_in_place(const char *kind, const char *path)
{
    char group[64];
    snprintf(group, sizeof group, "%.*s", (int)(strrchr(path, '/') - path), path);
    if (strcmp(kind, "external-link") == 0) return H5Lcreate_external("other.h5", path, file, path, 0, 0) >= 0;
    if (strcmp(kind, "external-group") == 0) {
        H5Ldelete(file, group, H5P_DEFAULT);
        return H5Lcreate_external("other.h5", group, file, group, 0, 0) >= 0;
    }
    if (strcmp(kind, "soft-external") == 0) {
        char to[80];
        snprintf(to, sizeof to, "/x%s", path);
        return H5Lcreate_external("other.h5", "/", file, "/x", 0, 0) >= 0 &&
               H5Lcreate_soft(to, file, path, 0, 0) >= 0;
    }
    if (strcmp(kind, "dangling") == 0) return H5Lcreate_soft("/nowhere", file, path, 0, 0) >= 0;
    if (strcmp(kind, "round") == 0) return H5Lcreate_soft(path, file, path, 0, 0) >= 0;
    if (strcmp(kind, "group") == 0) return H5Gcreate2(file, path, 0, 0, 0) >= 0;
    if (strcmp(kind, "user-link") == 0) {
        const H5L_class_t class = {
            .version = H5L_LINK_CLASS_T_VERS, .id = 200, .comment = "own", .trav_func = follow};
        return H5Lregister(&class) >= 0 && H5Lcreate_ud(file, path, (H5L_type_t)200, "other.h5", 9, 0, 0) >= 0;
    }
    return 0;
}

/* The dataset's own rows, with other filters. */
static void filtered(const char *kind, const char *path, void *data)
{
    hid_t id;
    chunks(4096);
    if (strcmp(kind, "filter") == 0) H5Pset_filter(plan, 32000, H5Z_FLAG_OPTIONAL, 0, NULL);
    if (strcmp(kind, "scaled") == 0) H5Pset_scaleoffset(plan, H5Z_SO_FLOAT_DSCALE, 3);
    if (strcmp(kind, "twice") == 0) H5Pset_deflate(plan, 9), H5Pset_deflate(plan, 9);
    if (strcmp(kind, "packed") == 0) H5Pset_shuffle(plan), H5Pset_deflate(plan, 9), H5Pset_fletcher32(plan);
    id = create(path);
    if (H5Dwrite(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) exit(1);
    H5Dclose(id);
}

/* A chunk of any size in a few bytes. */
static void tiny_chunk(const char *path, hsize_t rows)
{
    const hsize_t first[2] = {0, 0};
    chunks(rows);
    H5Pset_deflate(plan, 9);
    if (H5Dwrite_chunk(create(path), H5P_DEFAULT, 0, first, 1, "x") < 0) exit(1);
}

/* One dataset of zeros has the names of all in its group. */
static void many_names(void)
{
    double *const zeros = calloc(size[0] = 1 << 21, sizeof *zeros);
    const char *const names[] = {"/clock/tau", "/clock/s"};
    rank = 1;
    type = H5T_NATIVE_DOUBLE;
    chunks(1 << 17);
    H5Pset_deflate(plan, 9);
    const hid_t id = create("/clock/t");
    H5Dwrite(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, zeros);
    H5Dclose(id);
    free(zeros);
    H5Ldelete(file, "/ball", H5P_DEFAULT);
    for (int i = 0; i < 2; i++) H5Lcreate_hard(file, "/clock/t", file, names[i], 0, 0);
}

int main(int count, char **argument)
{
    if (count != 4) return 2;
    const char *kind = argument[1], *path = argument[3];
    file = H5Fopen(argument[2], H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t old = H5Dopen2(file, path, H5P_DEFAULT);
    if (old < 0) return 2;
    space = H5Dget_space(old);
    type = H5Dget_type(old);
    plan = H5Pcreate(H5P_DATASET_CREATE);
    rank = H5Sget_simple_extent_dims(space, size, NULL);
    void *const data = calloc(size[0] * size[1] + 1, H5Tget_size(type));
    if (H5Dread(old, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) return 1;
    H5Dclose(old);
    H5Ldelete(file, path, H5P_DEFAULT);
    if (link_in_place(kind, path)) {
    } else if (strcmp(kind, "external-storage") == 0) {
        H5Pset_external(plan, "secret", 0, H5F_UNLIMITED), create(path);
    } else if (strcmp(kind, "virtual") == 0) {
        H5Pset_virtual(plan, space, "other.h5", path, space), create(path);
    } else if (strcmp(kind, "unwritten") == 0) { /* chunks */
        size[0] = (hsize_t)1 << 40, chunks(4096), create(path);
    } else if (strcmp(kind, "unpacked") == 0) {
        size[0] = (hsize_t)1 << 40, chunks(4096), H5Pset_deflate(plan, 9), create(path);
    } else if (strcmp(kind, "promised") == 0) { /* contiguous, without room until it is written */
        size[0] = (hsize_t)1 << 40, space = H5Screate_simple(rank, size, NULL), create(path);
    } else if (strcmp(kind, "endless") == 0) { /* a part is written: one more chunk is not */
        filtered(kind, path, data);
        const hsize_t more[2] = {size[0] + 4096, size[1]};
        H5Dset_extent(H5Dopen2(file, path, H5P_DEFAULT), more);
    } else if (strcmp(kind, "wide-chunk") == 0) {
        tiny_chunk(path, (hsize_t)1 << 26);
    } else if (strcmp(kind, "reference") == 0) {
        type = H5T_STD_REF_OBJ, chunks(4096), create(path);
    } else if (strcmp(kind, "compound") == 0) {
        type = H5Tcreate(H5T_COMPOUND, 8), H5Tinsert(type, "x", 0, H5T_NATIVE_DOUBLE), chunks(4096), create(path);
    } else if (strcmp(kind, "long-words") == 0) {
        type = H5Tcopy(H5T_C_S1), H5Tset_size(type, (size_t)1 << 30), chunks(1), create(path);
    } else if (strcmp(kind, "lines") == 0) { /* the rows are good; a line of the header is two */
        filtered(kind, path, data);
        const char text[] = "0.1*n1\n + 5*n2";
        const hid_t string = H5Tcopy(H5T_C_S1);
        H5Tset_size(string, sizeof text);
        const hid_t id = H5Acreate2(file, "potential.U", string, H5Screate(H5S_SCALAR), H5P_DEFAULT, H5P_DEFAULT);
        if (H5Awrite(id, string, text) < 0) return 1;
    } else if (strcmp(kind, "both") == 0) {
        filtered(kind, path, data);
        H5Lcreate_hard(file, path, file, strrchr(path, '/'), 0, 0);
    } else if (strcmp(kind, "names") == 0) {
        many_names();
    } else {
        filtered(kind, path, data);
    }
    free(data);
    return H5Fclose(file) < 0;
}

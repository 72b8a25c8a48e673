/* trajectory_impl.h - what the reader and the writer of trajectory files share. */
#ifndef ISO_IO_TRAJECTORY_IMPL_H
#define ISO_IO_TRAJECTORY_IMPL_H

#include "io/trajectory.h"

#define ISO_TRAJECTORY_MAGIC "# isoroll trajectory "
#define ISO_TRAJECTORY_VERSION "1"

/* Refuses formats that are not built: ISO_BAD_ARGUMENT. */
iso_status iso_trajectory_check_format(iso_context *ctx, const char *path);

#endif

/* energy.h - the energies of a ball along a trajectory, for pictures. */
#ifndef ISO_STUDY_ENERGY_H
#define ISO_STUDY_ENERGY_H

#include "base/record.h"
#include "model/params.h"

/* A new record with a row for each row of `record`, a ball's trajectory with its effects (orbit/description.h):
 *
 *     the ball's first clock, or "row"
 *     h = kinetic + potential
 *     kinetic = (1/2)(omega, J omega) - (D/2)(omega,n)^2, the second term for a ball that twists
 *     potential                                            (kinetic and potential only where there is a potential)
 *
 * in the units of the record. If the energy is not known, *energies is NULL and the status ISO_OK. It is not known on
 * a plane with gravity if the columns of `attitude` are missing: the energy needs the height.
 * Errors: ISO_BAD_INPUT (no columns of a ball, a row that is no state), ISO_NUMERICAL, ISO_NO_MEMORY. */
iso_status iso_record_energies(iso_context *ctx, const iso_params *params, const iso_record *record,
                               iso_record **energies);

#endif

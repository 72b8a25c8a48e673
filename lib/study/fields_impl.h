/* fields_impl.h - the lists of fields of the results of all studies (base/field.h). */
#ifndef ISO_STUDY_FIELDS_IMPL_H
#define ISO_STUDY_FIELDS_IMPL_H

#include "base/field.h"

extern const iso_field iso_chaos_orbit_fields[], iso_indicator_fields[], iso_chaos_fraction_fields[],
    iso_chaos_fields[], iso_indication_fields[], iso_residual_fields[], iso_cost_cell_fields[], iso_cost_fields[],
    iso_frequencies_fields[], iso_integral_search_fields[], iso_continuation_fields[], iso_branch_row_fields[],
    iso_periodic_orbit_fields[], iso_periodic_fields[], iso_chart_row_fields[], iso_section_fields[],
    iso_comparison_fields[], iso_difference_fields[], iso_separatrix_fields[], iso_separatrix_table_fields[],
    iso_checked_fields[], iso_section_area_fields[];

#endif

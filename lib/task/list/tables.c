/* tables.c - the lists of studies (study/study.h) and of the tables that they make (see list_impl.h). */
#include "study/fields_impl.h"
#include "task/list/list_impl.h"

#include <string.h>

#include "instrument/chaos/chaos.h"
#include "instrument/frequencies/frequencies.h"
#include "instrument/integrals/integrals.h"
#include "instrument/periodic/continuation.h"
#include "instrument/periodic/periodic.h"
#include "instrument/periodic/stability_chart.h"
#include "instrument/section/section.h"
#include "instrument/separatrix/separatrix.h"
#include "study/options_impl.h"
#include "task/cost/cost.h"

#define ISO_STUDY_ROW(name) &iso_##name##_study,

const iso_study *iso_study_at(int i)
{
    static const iso_study *const studies[] = {ISO_STUDY_LIST(ISO_STUDY_ROW)};
    return i >= 0 && i < (int)(sizeof studies / sizeof *studies) ? studies[i] : NULL;
}

const iso_study *iso_study_find(const char *name)
{
    int i = 0;
    while (iso_study_at(i) && strcmp(iso_study_at(i)->name, name) != 0) i++;
    return iso_study_at(i);
}

const iso_result_table *iso_result_table_at(int i)
{
    static const iso_result_table tables[] = {
        {"section", "a crossing of the section", iso_section_fields, false},
        {"chaos", "an orbit", iso_chaos_orbit_fields, false},
        {"periodic", "a periodic orbit", iso_periodic_orbit_fields, false},
        {"periodic follow", "a point of a branch, or an event on it", iso_branch_row_fields, false},
        {"periodic chart", "a point of the chart, or of a border in it", iso_chart_row_fields, false},
        {"splitting", "a value of k or of the level", iso_separatrix_fields, false},
        {"cost", "a backend with a method and a tolerance", iso_cost_cell_fields, false},
        {"check", "a residual", iso_checked_fields, true},
        {"chaos indicators", "a turn of the scene's own orbit", iso_indicator_fields, true},
        {"compare", "a time of the scene", iso_difference_fields, true},
        {"section area", "an orbit by one model", iso_section_area_fields, true},
    };
    return i >= 0 && i < (int)(sizeof tables / sizeof *tables) ? &tables[i] : NULL;
}

/* tables.c - the list of the tables that studies make (see tables.h). */
#include "study/tables/tables.h"

#include "study/chaos/chaos.h"
#include "study/cost/cost.h"
#include "study/periodic/continuation.h"
#include "study/periodic/periodic.h"
#include "study/periodic/stability_chart.h"
#include "study/separatrix/separatrix.h"

const iso_result_table *iso_result_table_at(int i)
{
    static const iso_result_table tables[] = {
        {"chaos", "an orbit", iso_chaos_orbit_fields},
        {"periodic", "a periodic orbit", iso_periodic_orbit_fields},
        {"periodic follow", "a point of a branch, or an event on it", iso_branch_row_fields},
        {"periodic chart", "a point of the chart, or of a border in it", iso_chart_row_fields},
        {"splitting", "a value of k or of the level", iso_separatrix_fields},
        {"cost", "a backend with a method and a tolerance", iso_cost_cell_fields},
    };
    return i >= 0 && i < (int)(sizeof tables / sizeof *tables) ? &tables[i] : NULL;
}

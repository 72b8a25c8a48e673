/* rivals.c - the lists of rivals. */
#include "rivals.h"

const rival rivals[] = {
    {"GSL rk8pd", rival_gsl_rk8pd, false},
#ifdef RIVAL_ODEINT
    {"odeint fehlberg78", rival_odeint_fehlberg, false},
    {"odeint bulirsch_stoer", rival_odeint_stoer, false},
#endif
    {"ARKODE fehlberg_13_7_8", rival_arkode_fehlberg, true},
    {"CVODE adams", rival_cvode_adams, true},
    {NULL, NULL, false},
};

const rival_walker rival_walkers[] = {
    {"GSL rk8pd", rival_follow_gsl},
#ifdef RIVAL_ODEINT
    {"odeint fehlberg78", rival_follow_fehlberg},
    {"odeint bulirsch_stoer", rival_follow_stoer},
#endif
    {NULL, NULL},
};

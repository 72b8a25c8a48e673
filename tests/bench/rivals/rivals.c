/* rivals.c - the lists of rivals. */
#include "rivals.h"

const rival rivals[] = {
    {"GSL rk8pd", rival_gsl_rk8pd},
#ifdef RIVAL_ODEINT
    {"odeint fehlberg78", rival_odeint_fehlberg},
    {"odeint bulirsch_stoer", rival_odeint_stoer},
#endif
    {"ARKODE fehlberg_13_7_8", rival_arkode_fehlberg},
    {"CVODE adams", rival_cvode_adams},
    {NULL, NULL},
};

const rival_walker rival_walkers[] = {
    {"GSL rk8pd", rival_follow_gsl},
#ifdef RIVAL_ODEINT
    {"odeint fehlberg78", rival_follow_fehlberg},
    {"odeint bulirsch_stoer", rival_follow_stoer},
#endif
    {NULL, NULL},
};

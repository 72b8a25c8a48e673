/* explain_impl.h - what the study explain is asked, and what it finds. */
#ifndef ISO_STUDY_EXPLAIN_IMPL_H
#define ISO_STUDY_EXPLAIN_IMPL_H

#include "study/options_impl.h"

typedef struct iso_explanation {
    const char *backend, *method; /* method NULL: the closed solution */
    bool twin;
    const char *integrability;
    size_t rows;
    const char *text; /* all, in words; it is freed with the rest */
} iso_explanation;

#endif

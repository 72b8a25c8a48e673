/* verdict.h - the verdicts on an orbit: regular, chaotic, undecided. */
#ifndef ISO_STUDY_VERDICT_H
#define ISO_STUDY_VERDICT_H

/* ISO_INTEGRABLE: regular because there is an additional integral, although the estimated frequencies have not
 * settled. */
typedef enum iso_verdict { ISO_REGULAR, ISO_CHAOTIC, ISO_UNDECIDED, ISO_INTEGRABLE } iso_verdict;

/* "regular", "chaotic", "undecided", "integrable" */
const char *iso_verdict_name(iso_verdict verdict);

#endif

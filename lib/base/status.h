/* status.h - what a call answers: one list, from which the enum and the texts are made.
 *
 * Every isoroll function that can fail returns an iso_status; the words that go with it (what, where, what to
 * do) are in the context: iso_context_message(). Nothing in the library prints, exits or aborts.
 */
#ifndef ISO_BASE_STATUS_H
#define ISO_BASE_STATUS_H

#include "api.h"

ISO_C_BEGIN

/*      name            text                              when                                               */
#define ISO_STATUS_LIST(X)                                                                                           \
    X(ISO_OK, "done")                            /* the answer is complete                             */            \
    X(ISO_BAD_ARGUMENT, "bad argument")          /* a call with numbers or names it does not take      */            \
    X(ISO_BAD_INPUT, "bad input")                /* a scene or file says something that cannot be      */            \
    X(ISO_NOT_MAPPED, "outside the isomorphism") /* the other model has no such orbit                  */            \
    X(ISO_NUMERICAL, "numerical failure")        /* integration stopped, or a result is not finite     */            \
    X(ISO_STOPPED, "stopped on request")         /* iso_context_set_monitor() answered false           */            \
    X(ISO_FILE_TROUBLE, "file trouble")          /* cannot open, read, write or rename                 */            \
    X(ISO_NO_MEMORY, "out of memory")            /* malloc gave none                                   */            \
    X(ISO_CLOSED_PIPE, "closed pipe")            /* the reader of what we write has gone               */

typedef enum iso_status {
#define ISO_STATUS_ENUM(name, text) name,
    ISO_STATUS_LIST(ISO_STATUS_ENUM)
#undef ISO_STATUS_ENUM
} iso_status;

/* The status in a few words; "unknown status" for a number that is none. */
ISO_API const char *iso_status_text(iso_status status);

/* For functions that return an iso_status: makes the call. If its status is not ISO_OK, the function returns that
 * status at once, so nothing may be open. */
#define ISO_TRY(call)                                                                                                \
    do {                                                                                                             \
        const iso_status iso_answer = (call);                                                                        \
        if (iso_answer != ISO_OK) return iso_answer;                                                                 \
    } while (0)

ISO_C_END

#endif

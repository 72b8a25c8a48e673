/* convert_write.c - what leaves a conversion: good rows, marks in the place of bad ones, and the words about these.
 * It is the lowest layer of a conversion and calls none of the others. */
#include <math.h>
#include <string.h>

#include "orbit/convert_impl.h"

void iso_worst_note(iso_worst *worst, double value, size_t line)
{
    if (worst->line > 0 && !(fabs(value) > worst->value) && !isnan(value)) return;
    worst->value = isnan(value) ? INFINITY : fabs(value);
    worst->line = line;
}

/* If so many rows at the beginning of a file are all bad, the conversion ends. */
enum { HOPELESS = 20 };

static iso_status give_up(const iso_conversion *c)
{
    const char *words = c->first_words ? c->first_words : "none can be read";
    return iso_context_fail(c->ctx, c->first_words ? c->first_failure : ISO_BAD_INPUT, "",
                            "not one of the first %d rows can be converted: %s", HOPELESS, words);
}

iso_status iso_conversion_mark(iso_conversion *c)
{
    if (!c->begun && c->summary.bad == HOPELESS) return give_up(c);
    if (c->begun && !c->is_held && !c->unwritten) return c->target.row(c->target.data, NULL);
    ++*(c->unwritten && !c->is_held ? &c->first_marks : &c->marks);
    return ISO_OK;
}

iso_status iso_conversion_bad(iso_conversion *c, size_t line, iso_status why)
{
    const bool ends = why == ISO_NO_MEMORY || why == ISO_STOPPED || why == ISO_FILE_TROUBLE || why == ISO_CLOSED_PIPE;
    if (ends) return why;
    if (why == ISO_BAD_ARGUMENT) why = ISO_BAD_INPUT; /* the argument comes from the file */
    if (!c->begun && !c->first_words) {
        c->first_failure = why;
        c->first_words = strdup(iso_context_message(c->ctx));
    }
    c->summary.bad++;
    const iso_status status = c->target.bad(c->target.data, line, why, iso_context_message(c->ctx));
    return status == ISO_OK ? iso_conversion_mark(c) : status;
}

iso_status iso_conversion_emit(iso_conversion *c, const conversion_row *row)
{
    return c->target.row(c->target.data, row->out);
}

iso_status iso_conversion_write_marks(iso_conversion *c, size_t *marks)
{
    iso_status status = ISO_OK;
    for (; status == ISO_OK && *marks > 0; --*marks) status = c->target.row(c->target.data, NULL);
    return status;
}

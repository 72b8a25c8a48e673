/* isoroll.h - all that a program calls: contexts, records, sinks, tables in files, scenes, solutions, batches, studies,
 * sweeps. Objects are opaque, options are text, results are records. A study takes a request in text and gives tables.
 *
 * Rules for all functions of the library. A header names only the exceptions.
 *
 * Arguments stand in this order: the context, the object that is asked or changed, the inputs, the outputs.
 * Functions of an object that keeps its context (solutions) take no context.
 *
 * Results. A function that can fail returns an iso_status, and the context then has the words
 *   (iso_context_message). After an error the outputs are not defined, but an output that is a new object is NULL.
 *
 * Ownership. What *_create, *_open, *_read or another function gives as a new object belongs to the caller,
 *   who releases it by the *_free or *_close of its type. Both accept NULL.
 * - Strings and pointers that a function returns belong to the library or to the object asked. They are valid until
 *   that object changes or is released.
 * - Inputs are read, not kept: they may go after the call. Headers name the exceptions, such as
 *   the header of a conversion. An object must not outlive its context.
 *
 * NULL is allowed only where a header says so. Strings that a call takes (names, texts, paths, keys) end with a zero
 * byte and are not NULL: the library does not test it.
 *
 * Binary interface: it is kept from version 0.3 on. A function may be added; none changes its arguments or goes without
 *   a new number in the name of the shared library.
 *
 * Units are the caller's own, any that fit together (SI, for example). Angles are in radians. Axes are those of the
 *   body. Vectors have three numbers, states six: omega, n of the ball; M, gamma of the point.
 *
 * Threads. A context, and objects made with it, are for one thread at a time. Different contexts share nothing.
 *
 * Errors never end the program, and the library prints nothing. See base/context.h for GSL's error handler.
 *
 * The host's rounding mode, floating-point traps, flush-to-zero mode and locale change no result by a bit: a function
 *   that returns an iso_status computes by C's default rules (so does what it calls back), and restores the host's.
 *   Single formulas, which return numbers (most of model and map), are computed by the host's rules.
 */
#ifndef ISOROLL_H
#define ISOROLL_H

#include "base/api.h"
#include "base/context.h"
#include "base/record.h"
#include "base/sink.h"
#include "base/status.h"
#include "base/version.h"

#include "io/table.h"

#include "api/interface.h"

#endif

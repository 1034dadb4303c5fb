/* SPDX-License-Identifier: MIT
 *
 * watch_format - how a status chart shows a value, and reads one that is typed.
 *
 * The bits of a value may be shown as another type has them; the variable keeps its type.
 * It knows no toolkit, and no variable.
 */
#ifndef EDITOR_WATCH_FORMAT_H
#define EDITOR_WATCH_FORMAT_H

#include "engine/base/diag.h"
#include "engine/base/iec.h"

#include <stdbool.h>

enum watch_format {
	WATCH_AUTO,              /* as its type is written                     */
	WATCH_BIN, WATCH_HEX,    /* its bits                                   */
	WATCH_SIGNED, WATCH_UNSIGNED,
	WATCH_FLOAT,             /* the bits of a number as those of a REAL    */
	WATCH_TIME,              /* of a number: ms                            */
	WATCH_FORMATS
};

/** watch_format_word - as a file has it: "hex". Lives for ever. */
const char *watch_format_word(enum watch_format format);
/** watch_format_find - of a word; WATCH_FORMATS: none. */
enum watch_format watch_format_find(const char *word, size_t len);
/** watch_format_label - N_() text. Lives for ever. */
const char *watch_format_label(enum watch_format format);
/** watch_format_fits - can a value of @type be shown so? */
bool watch_format_fits(enum watch_format format, enum iec_type type);

/** watch_print - a value; one that does not fit @format as its type is written. As
 * snprintf; IEC_VALUE_TEXT bytes are enough. */
int watch_print(enum watch_format format, enum iec_type type, union iec_value value,
		char *out, size_t size);
/**
 * watch_parse - what a person types in a cell of this format
 * @room: gets the bytes of a STRING, which @out then points to
 *
 * A literal that says itself what it is (16#FF) may stand in any format.
 * Owns: nothing.   Scan-safe: no.   Fails: false; DIAG_BAD_LITERAL or DIAG_LITERAL_RANGE
 * in @why.
 */
bool watch_parse(enum watch_format format, enum iec_type type, const char *text,
		 struct iec_text *room, union iec_value *out, enum diag_id *why);

#endif

/* SPDX-License-Identifier: MIT
 *
 * text_mend - the change of a text that a message asks for, where it leaves no choice.
 *
 * It changes nothing itself, and knows no widget.
 */
#ifndef EDITOR_TEXT_MEND_H
#define EDITOR_TEXT_MEND_H

#include "engine/base/diag.h"

#include <glib.h>

/* Bytes of a text, and their replacement. */
struct text_mend {
	gsize at, len;
	char *with;          /* owned                                          */
};
/**
 * text_mend_find - what mends an error
 * @text: all of it; @at: byte at which the message says the error is
 * Owns: the caller frees out->with.   Fails: FALSE: a person must decide.
 */
gboolean text_mend_find(const char *text, gsize at, const struct diag *diag,
			struct text_mend *out);

#endif

/* SPDX-License-Identifier: MIT
 *
 * mend_drawn - a row that was drawn with the characters of a picture: `--| Start |--( Motor )--`.
 *
 * Books, forums and simulators print ladders so. Contacts stand between bars or in [ ], coils in ( ), with the sign of their kind
 * before the name or alone with the name behind it.
 */
#ifndef TEXT_MEND_DRAWN_H
#define TEXT_MEND_DRAWN_H

#include "engine/text/mend.h"

/** mend_is_drawn - does a dash touch a bar, a bracket or a parenthesis? @text: NUL-ended. Scan-safe: yes. */
bool mend_is_drawn(const char *text);

/**
 * mend_drawn - writes a drawn row as cells
 * @text: the row, without blanks around it, NUL-ended; gets the new one
 * @size: its room
 * @out:  gets the change, its line is not written
 *
 * False: it is no drawing that is understood, and nothing was changed. Owns: nothing. Scan-safe: no.
 */
bool mend_drawn(char *text, size_t size, struct mended *out);

#endif

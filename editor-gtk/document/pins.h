/* SPDX-License-Identifier: MIT
 *
 * pins - the interface of a function or function block: its inputs and outputs in the order in
 * which callers are drawn. symbols.h edits their fields.
 */
#ifndef EDITOR_PINS_H
#define EDITOR_PINS_H

#include "editor-gtk/document/document.h"

/** pins_count - pins of one kind: VAR_INPUT, VAR_OUTPUT or VAR_IN_OUT. */
int pins_count(const struct pou *pou, uint16_t kind);
/** pins_are - is variable @index of @pou a pin? Its kind; 0: it is none. */
uint16_t pins_kind(const struct pou *pou, int index);
/**
 * pin_move - exchanges a pin with the next (@by 1) or previous (-1) one of its block
 *
 * Callers keep the operands of all pins, because rungs name them. Refused: a caller gives
 * operands by position, or the power of a row would go to or come from another pin. One step of
 * the history. Returns NULL, or why it failed, translated, which the caller frees.
 */
char *pin_move(LadderDocument *document, int pou, int index, int by);
/** pins_set_result - sets the type of a FUNCTION. Returns as pin_move(). */
char *pins_set_result(LadderDocument *document, int pou, const char *type);

#endif

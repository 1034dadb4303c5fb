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
/** pins_kind - the kind of variable @index of @pou; 0: it is no pin. */
uint16_t pins_kind(const struct pou *pou, int index);
/** pin_calls - the number of boxes and calls of other POUs that give or take an operand at a pin. */
int pin_calls(LadderDocument *document, int pou, int index);
/**
 * pin_set_kind - makes variable @index of a POU a pin of another kind, or a variable of its own
 * @kind: one of SYMBOL_KINDS (symbols.h), or 0: VAR
 *
 * Callers keep their operands: one that does not fit any more is an error there. Refused: a
 * caller gives operands by position, or the power of a row would go to or come from another
 * pin. One step of the history. Returns NULL, or why it failed, translated, which the caller
 * frees.
 */
char *pin_set_kind(LadderDocument *document, int pou, int index, uint16_t kind);
/**
 * pin_put - makes variable @index of a POU the one before @before, or the last one, of a kind
 * @kind: as for pin_set_kind()
 * @before: a variable of that kind; -1: none
 *
 * Callers keep the operands of all pins, because rungs name them. Qualifiers such as RETAIN stay: a
 * block with other ones is passed as a whole. Refused: as in pin_set_kind(). One step of the
 * history. Returns as pin_set_kind().
 */
char *pin_put(LadderDocument *document, int pou, int index, uint16_t kind, int before);
/** pins_set_result - sets the type of a FUNCTION. Returns as pin_set_kind(). */
char *pins_set_result(LadderDocument *document, int pou, const char *type);

#endif

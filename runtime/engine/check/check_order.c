/* SPDX-License-Identifier: MIT
 *
 * check_order - gives each unnamed parameter of CAL its pin.
 *
 * The reader does not know the block of an instance yet. After this every call has named
 * parameters. It reports nothing.
 */
#include "engine/check/check_il.h"

#include <string.h>

/* The row of the block that a line calls; NULL: the line is no call. */
static const struct word_row *row_of(struct scope *scope, const struct pou *pou,
				     const struct il_line *line)
{
	const struct meaning *m;
	enum diag_id why;

	if (line->kind != IL_OP || line->op != OP_CAL)
		return NULL;
	m = scope_find(scope, pou, line->operand, &why);
	return m && m->kind == MEANING_INSTANCE ? scope_row(scope, (enum word)m->word) :
						  NULL;
}

/* The pin behind @pin that a value goes to; pin_count: there is none. */
static int next_pin(const struct word_row *row, int pin)
{
	do
		pin++;
	while (pin < row->pin_count && row->pin[pin].dir != PIN_IN &&
	       row->pin[pin].dir != PIN_IN_OUT);
	return pin;
}

void il_order_args(struct scope *scope, const struct pou *pou, struct il *il)
{
	struct names *names = &scope_project(scope)->names;
	const struct word_row *row = NULL;
	int pin = -1;

	for (int i = 0; i < il->count; i++) {
		struct il_line *line = &il->line[i];

		if (line->kind != IL_ARG_IN && line->kind != IL_ARG_OUT) {
			row = row_of(scope, pou, line);
			pin = -1;
		}
		if (line->kind != IL_ARG_IN || !(line->mark & IL_IN_ORDER))
			continue;
		line->pin = 0;
		pin = row ? next_pin(row, pin) : pin;
		if (row && pin < row->pin_count)
			line->pin = names_intern(names, row->pin[pin].name,
						 strlen(row->pin[pin].name));
	}
}

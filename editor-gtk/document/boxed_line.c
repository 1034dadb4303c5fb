/* SPDX-License-Identifier: MIT
 *
 * boxed_line - see boxed_line.h. Boxes and their statements stand in one order.
 */
#include "editor-gtk/document/boxed_line.h"

#include "engine/base/lex.h"

#include <string.h>

/* How many boxes stand before a cell, and that one. */
static int number_of(const struct pou *pou, int rung, int row, int col)
{
	int number = 0;

	for (int i = 0; i <= rung; i++) {
		const struct rung *in = pou->rung[i];
		const int end = i < rung ? in->rows * in->cols : row * in->cols + col + 1;

		for (int k = 0; k < end; k++)
			number += in->cell[k].word == ELEM_EXECUTE;
	}
	return number;
}

/* Does `EXECUTE:` or `EXECUTE Name:` stand at the lexer? */
static bool is_heading(struct lex lex)
{
	if (!lex_is(&lex, "EXECUTE"))
		return false;
	if (lex_next(&lex) == TOKEN_NAME)
		lex_next(&lex);
	return lex_is(&lex, ":");
}

int boxed_line(const char *text, const struct pou *pou, int rung, int row, int col)
{
	int number = number_of(pou, rung, row, col);
	bool begins = true;
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	lex.newlines = true;
	while (lex_next(&lex) != TOKEN_END) {
		if (begins && is_heading(lex) && --number == 0)
			return lex.token.line + 1;
		begins = lex.token.kind == TOKEN_NEWLINE;
	}
	return 0;
}

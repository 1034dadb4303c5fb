/* SPDX-License-Identifier: MIT
 *
 * reserved - names that a project must not declare. check_names.c finds names that are
 * declared twice.
 */
#include "engine/check/reserved.h"

#include "engine/base/ascii.h"
#include "engine/base/catalog.h"
#include "engine/base/lex.h"

#include <string.h>

static const char *const keywords[] = {
	"RUNG", "RUNGBOARD", "PROJECT", "INCLUDE", "USES", "OFF", "VIEW", "END_VIEW",
	"SUBROUTINE", "END_SUBROUTINE", /* only rung files have these */
	"VAR", "VAR_GLOBAL", "RETAIN",
	"CONSTANT", "AT", "END_VAR", "PROGRAM", "END_PROGRAM",
	"CONFIGURATION", "END_CONFIGURATION", "ARRAY", "OF",
	"TRUE", "FALSE", "EN", "ENO",
	"FUNCTION", "END_FUNCTION", "FUNCTION_BLOCK", "END_FUNCTION_BLOCK",
	"VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR_TEMP", "TYPE",
	"END_TYPE", "STRUCT", "END_STRUCT", "AND", "OR", "XOR", "NOT", "MOD",
	"AND_THEN", "OR_ELSE",
};
#define OF_RUNGS 10
#define KEYWORDS (int)(sizeof(keywords) / sizeof(keywords[0]))

/* Words of cells and of lists may be variables: a cell and an instruction begin with their
 * word, and a type follows a colon. Operators of expressions may not. */
const char *reserved_word(int i)
{
	if (i < 0 || i >= KEYWORDS + IEC_TYPE_COUNT)
		return NULL;
	return i < KEYWORDS ? keywords[i] :
	       iec_type_row((enum iec_type)(i - KEYWORDS))->word;
}

bool reserved_of_rungs(const char *name)
{
	int i = 0;

	while (i < OF_RUNGS && !ascii_is(keywords[i], name, strlen(name)))
		i++;
	return i < OF_RUNGS;
}

bool reserved_generated(const char *name)
{
	const char letter = *name == '_' ? ascii_upper(name[1]) : '\0';

	if (!letter || !strchr("ELNPSTVX", letter) || name[2] == '0' || !name[2])
		return false;
	for (name += 2; ascii_digit(*name); name++)
		;
	return !*name;
}

/* A word of the language, SYS_…, or a generated name, in any case. */
static bool reserved_name(const char *name)
{
	const size_t len = strlen(name);
	const char *word;

	if (len >= 4 && ascii_same(name, "SYS_", 4))
		return true;
	for (int i = 0; (word = reserved_word(i)); i++)
		if (*word && ascii_is(word, name, len))
			return true;
	return reserved_generated(name);
}

enum diag_id reserved_fault(const char *name)
{
	const size_t len = strlen(name);
	struct iec_addr addr;
	struct lex lex;

	lex_init(&lex, name, len);
	if (!len || len > LIMIT_NAME || lex_next(&lex) != TOKEN_NAME ||
	    lex.token.len != len || strchr(name, '.'))
		return DIAG_EXPECTED;
	if (reserved_name(name))
		return DIAG_RESERVED_NAME;
	return iec_addr_parse(name, len, &addr) == ADDR_NONE ? DIAG_COUNT :
	       DIAG_SHADOWS_ADDRESS;
}

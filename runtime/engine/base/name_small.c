/* SPDX-License-Identifier: MIT
 *
 * name_small - the names that a small board knows have ASCII letters only.
 *
 * Replaces name.c, whose tables of Unicode would take 2 KB. Texts in quotes may have any character.
 */
#include "engine/base/lex.h"

bool utf8_is_letter(const char *text, size_t len)
{
	(void)text;
	(void)len;
	return false;
}

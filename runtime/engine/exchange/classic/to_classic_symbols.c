/* SPDX-License-Identifier: MIT
 *
 * to_classic_symbols - names and comments as ClassicLadder's symbols, of at most 9 bytes.
 */
#include "engine/exchange/classic/to_classic_parts.h"

#include "engine/base/ascii.h"

#include <stdio.h>
#include <string.h>

/* Of "(* %B3: the pump *)": "the pump". */
static const char *plain_comment(struct leaving *e, const char *text)
{
	size_t len = strlen(text);
	const char *colon;
	char *copy;

	if (len < 4 || text[0] != '(')
		return "";
	copy = arena_copy(e->arena, text + 2, len - 4);
	while (copy && *copy == ' ')
		copy++;
	for (len = copy ? strlen(copy) : 0; len && copy[len - 1] == ' '; len--)
		copy[len - 1] = '\0';
	if (!copy || *copy != '%')
		return copy ? copy : "";
	colon = strstr(copy, ": ");
	return colon && !memchr(copy, ' ', (size_t)(colon - copy)) ? colon + 2 :
	       strchr(copy, ' ') ? copy : "";
}

/* Is the name what an import makes of no symbol? */
static bool says_number(const struct out_slot *slot, const char *own)
{
	char text[LIMIT_NAME + 16];

	snprintf(text, sizeof(text), "%s%d", own, slot->number);
	return !strcmp(text, slot->name);
}

static bool symbol_taken(const struct leaving *e, const char *name)
{
	for (int i = 0; i < e->out->symbols; i++)
		if (!strcmp(e->out->symbol[i].name, name))
			return true;
	return false;
}

/* At most 9 bytes, and no other has it. */
static const char *symbol_name(struct leaving *e, const char *name)
{
	const char *cut = out_text(e, "%.*s", classic_cut(name, CLASSIC_SYMBOL), name);

	for (int i = 2; symbol_taken(e, cut) && i < CLASSIC_LIMIT; i++) {
		int digits = snprintf(NULL, 0, "%d", i);

		cut = out_text(e, "%.*s%d", classic_cut(name, CLASSIC_SYMBOL - digits),
			       name, i);
	}
	return cut;
}

void out_symbol(struct leaving *e, const struct out_slot *slot, const char *prefix,
		const char *own)
{
	const char *comment = plain_comment(e, slot->comment), *name = slot->name;
	const int most = e->dialect == CLASSIC_UPSTREAM ? CLASSIC_COMMENT :
							  CLASSIC_SYMBOL_COMMENT;
	struct classic_symbol *symbol;
	size_t len = strlen(own);

	if (says_number(slot, own) && !*comment)
		return;
	if (slot->block >= 0 && !strncmp(name, own, len)) {
		/* TM0_Delay */
		while (ascii_digit(name[len]))
			len++;
		if (name[len] == '_' && name[len + 1])
			name += len + 1;
	}
	symbol = arena_push(e->arena, &e->out->symbol, &e->out->symbols, sizeof(*symbol));
	if (!symbol)
		return;
	e->out->symbols--;
	symbol->variable = out_text(e, "%%%s%d", prefix, slot->number);
	symbol->name = says_number(slot, own) ? "" : symbol_name(e, name);
	symbol->comment = comment;
	if (*symbol->name && strcmp(symbol->name, name) != 0)
		tell_line(e, slot->var->line, "%s is called %s there", slot->name,
			  symbol->name);
	if (strlen(comment) > (size_t)most)
		tell_line(e, slot->var->line, "the comment of %s is cut to %d bytes",
			  slot->name, most);
	e->out->symbols++;
}

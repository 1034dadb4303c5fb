/* SPDX-License-Identifier: MIT
 *
 * plcopen_stores - which variables a body stores into.
 *
 * Other tools let a program store into an input: the value stays until the input is read again. Here a program
 * cannot, so such a variable keeps its value only without its address.
 */
#include "engine/exchange/plcopen/plcopen_convert.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"

#include <stdlib.h>
#include <string.h>

struct plc_store { const char *name; int pou; };

static void add(struct plcopen *c, int pou, const char *name, size_t len)
{
	struct plc_store *added = len ? arena_push(c->arena, &c->stores.one, &c->stores.count, sizeof(*added)) : NULL;

	if (added)
		*added = (struct plc_store){ plc_print(c, "%.*s", (int)len, name), pou };
}

/* `Name :=` outside of parentheses, `=> Name`, and in a list ST, S, R and the like. */
static void find_in_text(struct plcopen *c, int pou, const char *text)
{
	static const char *const stores[] = { "ST", "STN", "S", "R", "=>" };
	struct token name = { .kind = TOKEN_END };
	bool stored = false;
	struct lex lex;
	int open = 0;

	lex_init(&lex, text, strlen(text));
	while (lex_next(&lex) != TOKEN_END) {
		const bool named = lex.token.kind == TOKEN_NAME;

		if ((named && stored) || (open == 0 && name.kind == TOKEN_NAME && lex_is(&lex, ":=")))
			add(c, pou, named && stored ? lex.token.text : name.text, named && stored ? lex.token.len : name.len);
		stored = false;
		for (size_t i = 0; i < sizeof(stores) / sizeof(*stores); i++)
			stored |= lex_is(&lex, stores[i]);
		open += lex_is(&lex, "(");
		open -= lex_is(&lex, ")") && open > 0;
		open = lex_is(&lex, ";") ? 0 : open;
		name = lex.token;
	}
}

static void find_in_child(struct plcopen *c, int pou, const struct xml_node *node, const char *child)
{
	const struct xml_node *name = xml_look(node, child);

	if (name && name->text)
		find_in_text(c, pou, plc_print(c, "=> %s", name->text));
}

/* Nests as deep as the file, which is bounded. */
static void find_in(struct plcopen *c, int pou, const struct xml_node *node, bool lines)
{
	if (xml_is(node, "documentation") || xml_is(node, "comment"))
		return;
	lines |= xml_is(node, "ST") || xml_is(node, "IL") || xml_is(node, "STCode");
	if (lines && node->text)
		find_in_text(c, pou, node->text);
	if (xml_is(node, "coil"))
		find_in_child(c, pou, node, "variable");
	if (xml_is(node, "outVariable") || xml_is(node, "inOutVariable"))
		find_in_child(c, pou, node, "expression");
	if (xml_is(node, "reference") && node->parent && xml_is(node->parent, "action") && xml_value(node, "name"))
		add(c, pou, xml_value(node, "name"), strlen(xml_value(node, "name")));
	for (const struct xml_node *each = node->first; each; each = each->next)
		find_in(c, pou, each, lines);
}

static int compare_stores(const void *a, const void *b)
{
	const char *one = ((const struct plc_store *)a)->name, *two = ((const struct plc_store *)b)->name;

	while (*one && ascii_upper(*one) == ascii_upper(*two)) {
		one++;
		two++;
	}
	return (unsigned char)ascii_upper(*one) - (unsigned char)ascii_upper(*two);
}

static void find_all(struct plcopen *c)
{
	c->stores.found = true;
	for (int i = 0; i < c->pous; i++)
		find_in(c, i, c->pou[i].node, false);
	if (c->stores.count)
		qsort(c->stores.one, (size_t)c->stores.count, sizeof(*c->stores.one), compare_stores);
}

/* The variable that @name means in the POU: one of its own, or one from outside? */
static bool is_own(const struct plcopen_pou *pou, const char *name)
{
	const struct xml_node *variable = plc_find_variable(pou, name);

	return variable && !xml_is(variable->parent, "externalVars");
}

bool plc_stores_input(struct plcopen *c, const struct xml_node *variable, const char *address)
{
	const struct plc_store key = { xml_value(variable, "name"), 0 };
	const struct xml_node *list = variable->parent, *owner = list ? list->parent : NULL;
	const struct plc_store *at, *end;

	if (!key.name || ascii_upper(address[1]) != 'I' || !list || !owner)
		return false;
	if (!c->stores.found)
		find_all(c);
	at = c->stores.count ? bsearch(&key, c->stores.one, (size_t)c->stores.count, sizeof(*at), compare_stores) : NULL;
	if (!at)
		return false;
	end = c->stores.one + c->stores.count;
	while (at > c->stores.one && !compare_stores(at - 1, &key))
		at--;
	for (; at < end && !compare_stores(at, &key); at++) {
		const struct plcopen_pou *pou = &c->pou[at->pou];

		if (xml_is(owner, "interface") ? owner->parent == pou->node : !is_own(pou, key.name))
			return true;
	}
	return false;
}

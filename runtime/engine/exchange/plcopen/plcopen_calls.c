/* SPDX-License-Identifier: MIT
 *
 * plcopen_calls - calls of actions with inputs, in Structured Text.
 *
 * In CODESYS `Pump.Start(Reset := TRUE)` stores into the input Reset of the block and runs its action. Here an action
 * has no inputs, so that becomes `Pump.Reset := TRUE; Pump.Start()`.
 */
#include "engine/exchange/plcopen/plcopen_convert.h"

#include "engine/base/lex.h"

#include <string.h>

bool plc_is_action(const struct plcopen *c, const char *name)
{
	for (int i = 0; i < c->pous; i++)
		if (plc_has_action(c, &c->pou[i], name))
			return true;
	return false;
}

/* Behind the last dot of a name. */
static const char *last_part(const struct token *name)
{
	const char *part = name->text;

	for (size_t i = 0; i < name->len; i++)
		part = name->text[i] == '.' ? name->text + i + 1 : part;
	return part;
}

/* A name without dots is an action of the POU in work. */
static bool is_action(struct plcopen *c, const struct token *name)
{
	const char *part = last_part(name);
	const size_t before = (size_t)(part - name->text);
	const struct plcopen_pou *own;

	part = plc_print(c, "%.*s", (int)(name->len - before), part);
	if (before)
		return plc_is_action(c, part);
	own = c->pou_name ? plc_pou(c, plc_print(c, "%.*s", (int)strcspn(c->pou_name, "."), c->pou_name)) : NULL;
	return own && plc_has_action(c, own, part);
}

/* One input, `Name := value`, as a statement; the lexer stops at the comma or parenthesis behind it. */
static bool put_input(struct plc_build *to, struct plcopen *c, const struct token *name, struct lex *lex)
{
	const int before = (int)(last_part(name) - name->text);
	const struct token input = lex->token;
	const char *value, *end;
	int open = 0;

	if (input.kind != TOKEN_NAME || lex_next(lex) == TOKEN_END || !lex_is(lex, ":="))
		return false;
	lex_next(lex);
	value = end = lex->token.text;
	for (; lex->token.kind != TOKEN_END && (open || (!lex_is(lex, ",") && !lex_is(lex, ")"))); lex_next(lex)) {
		open += lex_is(lex, "(") || lex_is(lex, "[");
		open -= lex_is(lex, ")") || lex_is(lex, "]");
		end = lex->token.text + lex->token.len;
	}
	plc_add_text(to, plc_print(c, "%.*s%.*s := %.*s; ", before, name->text, (int)input.len, input.text,
				   (int)(end - value), value));
	return end > value && lex->token.kind != TOKEN_END;
}

/* The call that @name begins, the lexer at its parenthesis, which steps to the closing one. NULL: it has no inputs, or
 * others. */
static const char *plain_call(struct plcopen *c, const struct token *name, struct lex *lex)
{
	struct plc_build all;
	bool good = true;
	int count = 0;

	plc_build(&all);
	do {
		lex_next(lex);
		good = !(count == 0 && lex_is(lex, ")")) && put_input(&all, c, name, lex);
		count++;
	} while (good && lex_is(lex, ","));
	plc_add_text(&all, plc_print(c, "%.*s()", (int)name->len, name->text));
	return good ? plc_built(c, &all) : (plc_built(c, &all), NULL);
}

/* Does a statement begin behind the token? */
static bool ends_statement(const struct lex *lex)
{
	return lex_is(lex, ";") || lex_is(lex, "THEN") || lex_is(lex, "ELSE") || lex_is(lex, "DO") || lex_is(lex, ":") ||
	       lex_is(lex, "REPEAT");
}

const char *plc_plain_calls(struct plcopen *c, const char *text)
{
	const char *from = text;
	struct plc_build all;
	bool begins = true;
	struct lex lex;

	plc_build(&all);
	lex_init(&lex, text, strlen(text));
	while (lex_next(&lex) != TOKEN_END) {
		const struct token name = lex.token;
		struct lex ahead = lex;

		if (begins && name.kind == TOKEN_NAME && lex_next(&ahead) != TOKEN_END && lex_is(&ahead, "(") &&
		    is_action(c, &name)) {
			const char *call = plain_call(c, &name, &ahead);

			if (call) {
				plc_add_text(&all, plc_print(c, "%.*s%s", (int)(name.text - from), from, call));
				lex = ahead;
				from = lex.token.text + 1;
			}
		}
		begins = ends_statement(&lex);
	}
	plc_add_text(&all, from);
	return plc_built(c, &all);
}

enum { MOST_WORK = 20000000 }; /* names that are compared: a hostile file may have many */

/* ---- actions of charts ---- */

bool plc_is_called(const struct plcopen_pou *pou, const char *name)
{
	for (int i = 0; i < pou->called.count; i++)
		if (plc_same(pou->called.name[i], name))
			return true;
	return false;
}

/* @name, or Pump.@name, is called in @pou. */
static void note_call(struct plcopen *c, struct plcopen_pou *pou, const char *name)
{
	const char *part = strrchr(name, '.');

	for (int i = 0; i < c->pous; i++) {
		struct plcopen_pou *owner = &c->pou[i];
		const char **added = NULL;

		if (owner->language == PLCOPEN_SFC && (part || owner == pou) && plc_has_action(c, owner, part ? part + 1 : name) &&
		    !plc_is_called(owner, part ? part + 1 : name))
			added = arena_push(c->arena, &owner->called.name, &owner->called.count, sizeof(*added));
		if (added)
			*added = part ? part + 1 : name;
	}
}

static void find_called(struct plcopen *c, struct plcopen_pou *pou, const char *text, long *work)
{
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	while (*work > 0 && lex_next(&lex) != TOKEN_END) {
		const struct token name = lex.token;
		struct lex ahead = lex;

		if (name.kind != TOKEN_NAME || lex_next(&ahead) == TOKEN_END || !lex_is(&ahead, "("))
			continue;
		*work -= c->pous;
		note_call(c, pou, plc_print(c, "%.*s", (int)name.len, name.text));
	}
}

void plc_find_called(struct plcopen *c)
{
	long work = MOST_WORK;
	bool charts = false;

	for (int i = 0; i < c->pous; i++)
		charts |= c->pou[i].language == PLCOPEN_SFC;
	for (int i = 0; charts && i < c->pous; i++)
		for (const struct xml_node *node = c->pou[i].node, *end = node->next; node && node != end; node = xml_next(node)) {
			if (node->text && strchr(node->text, '('))
				find_called(c, &c->pou[i], node->text, &work);
			if (xml_is(node, "block") && xml_value(node, "typeName") && work-- > 0)
				note_call(c, &c->pou[i], xml_value(node, "typeName"));
		}
}

/* ---- calls of functions without some inputs ---- */

static int inputs_of(const struct plcopen_pou *pou)
{
	const struct xml_node *interface = xml_look(pou->node, "interface");
	int count = 0;

	for (const struct xml_node *list = interface ? interface->first : NULL; list; list = list->next)
		for (const struct xml_node *each = xml_is(list, "inputVars") ? list->first : NULL; each; each = each->next)
			count += xml_is(each, "variable");
	return count;
}

/* The inputs that a call names, the lexer at its parenthesis; -1: it gives them by their places. */
static int named_inputs(struct lex lex)
{
	int open = 0, count = 0;
	bool named = false;

	do {
		const bool enables = lex_is(&lex, "EN");

		open += lex_is(&lex, "(");
		open -= lex_is(&lex, ")");
		if (open != 1 || lex.token.kind != TOKEN_NAME)
			continue;
		lex_next(&lex);
		named |= lex_is(&lex, ":=");
		count += lex_is(&lex, ":=") && !enables;
		open += lex_is(&lex, "(");
		open -= lex_is(&lex, ")");
	} while (open > 0 && lex_next(&lex) != TOKEN_END);
	return named ? count : -1;
}

static void find_short(struct plcopen *c, const char *text, long *work)
{
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	while (*work > 0 && lex_next(&lex) != TOKEN_END) {
		const struct token name = lex.token;
		struct plcopen_pou *pou;
		struct lex ahead = lex;
		int named;

		if (name.kind != TOKEN_NAME || lex_next(&ahead) == TOKEN_END || !lex_is(&ahead, "("))
			continue;
		*work -= c->pous;
		pou = plc_pou(c, plc_print(c, "%.*s", (int)name.len, name.text));
		if (!pou || pou->kind != POU_FUNCTION || pou->called_short)
			continue;
		named = named_inputs(ahead);
		pou->called_short = named >= 0 && named < inputs_of(pou);
	}
}

void plc_find_short_calls(struct plcopen *c)
{
	long work = MOST_WORK;

	for (int i = 0; i < c->pous; i++)
		for (const struct xml_node *node = c->pou[i].node, *end = node->next; node && node != end; node = xml_next(node))
			if (node->text && strchr(node->text, '('))
				find_short(c, node->text, &work);
}

/* SPDX-License-Identifier: MIT
 *
 * join_wires - a BOOL that one line alone reads stands in that line, before a network becomes rungs.
 *
 * So a rung gets the contacts of both lines instead of a variable between them. It is done only where the value
 * cannot be another one in its new place: it always can be computed, what it reads is not written in between, and
 * contacts show the place.
 */
#include "engine/convert/networks.h"

#include "engine/base/ascii.h"
#include "engine/base/catalog.h"
#include "engine/model/fbd.h"

#include <stdio.h>
#include <string.h>

enum { TEXT_MOST = 400 }; /* bytes of a joined line */

static const char *text_of(const struct acts *acts, const struct st_item *item)
{
	return project_text(acts->project, item->text);
}

/* The operators and functions that contacts and comparisons in a rung say. */
static bool is_logic(const struct acts *acts, const struct token *token)
{
	static const char *const words[] = { "AND", "OR", "XOR", "NOT", "LT", "LE", "GT", "GE", "EQ", "NE" };

	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++)
		if (ascii_is(words[i], token->text, token->len))
			return text_is_pure(acts, token);
	return false;
}

static bool is_bool_wire(const struct acts *acts, int network, const struct token *name)
{
	const struct pou *pou = acts->pou;
	const uint32_t wire = fbd_wire_name(&acts->project->names, name->text, name->len, network, false);
	const int at = vars_find(&pou->vars, names_fold(&acts->project->names, wire));

	return at >= 0 && pou->vars.var[at].type == IEC_BOOL;
}

/* `Wire := value`, of a value that always can be computed. @value: gets where it begins. */
static bool is_joinable(const struct acts *acts, int network, const struct st_item *item, struct token *wire,
			const char **value)
{
	struct lex lex;
	int open = 0;

	if (item->kind != ST_ASSIGN)
		return false;
	lex_init(&lex, text_of(acts, item), strlen(text_of(acts, item)));
	lex_next(&lex);
	*wire = lex.token;
	lex_next(&lex);
	if (wire->kind != TOKEN_NAME || !lex_is(&lex, ":=") || !is_bool_wire(acts, network, wire))
		return false;
	lex_next(&lex);
	*value = lex.token.text;
	for (; lex.token.kind != TOKEN_END; ) {
		const struct token token = lex.token;

		open += lex_is(&lex, "(") - lex_is(&lex, ")");
		if (lex_is(&lex, "[") || lex_is(&lex, "^") || lex_is(&lex, "+") || lex_is(&lex, "-") || lex_is(&lex, "*") ||
		    lex_is(&lex, "/") || lex_is(&lex, "MOD") || lex_is(&lex, "=>") || token.kind == TOKEN_ADDRESS ||
		    token.kind == TOKEN_STRING || lex_is(&lex, "AND_THEN") || lex_is(&lex, "OR_ELSE") ||
		    (lex_is(&lex, ":=") && !open))
			return false;
		lex_next(&lex);
		if (token.kind == TOKEN_NAME && lex_is(&lex, "(") && !is_logic(acts, &token))
			return false;
	}
	return true;
}

/* Where @text names the wire; NULL: nowhere, or not once. @uses: is raised by each. */
static const char *use_in(const char *text, const struct token *wire, int *uses)
{
	const char *found = NULL;
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	while (lex_next(&lex) != TOKEN_END) {
		struct lex next = lex;

		lex_next(&next);
		if (lex.token.kind != TOKEN_NAME || lex.token.len < wire->len ||
		    !ascii_same(lex.token.text, wire->text, wire->len) ||
		    (lex.token.len > wire->len && lex.token.text[wire->len] != '.') || lex_is(&next, ":="))
			continue;
		*uses += lex.token.len == wire->len ? 1 : 2;
		found = lex.token.text;
	}
	return found;
}

/* Do contacts show the value at @place of @item? Not at a pin of a function. */
static bool is_shown(const struct acts *acts, const struct st_item *item, const char *place)
{
	const char *text = text_of(acts, item);
	struct { bool call, logic; } open[LIMIT_EXPR_DEPTH + 2] = { { false, false } };
	struct token before = { .kind = TOKEN_END };
	bool first = true;
	struct lex lex;
	int depth = 0;

	if (item->kind != ST_ASSIGN && item->kind != ST_CALL && item->kind != ST_SET && item->kind != ST_RESET &&
	    item->kind != ST_JUMP_IF && item->kind != ST_RETURN_IF && item->kind != ST_STOP_IF)
		return false;
	lex_init(&lex, text, strlen(text));
	while (lex_next(&lex) != TOKEN_END && lex.token.text < place) {
		if (lex_is(&lex, "(") && depth < LIMIT_EXPR_DEPTH) {
			open[++depth].call = before.kind == TOKEN_NAME && op_find(before.text, before.len) == OP_COUNT;
			/* The pins of the block that a line calls. */
			open[depth].logic = !open[depth].call || is_logic(acts, &before) ||
					    (item->kind == ST_CALL && depth == 1 && first);
			first = false;
		}
		depth -= lex_is(&lex, ")") && depth > 0;
		if (lex.token.kind != TOKEN_NAME || !text_is_pure(acts, &lex.token))
			first &= before.kind == TOKEN_END;
		before = lex.token;
	}
	for (; depth > 0; depth--)
		if (!open[depth].logic)
			return false;
	return true;
}

/* Is anything that the value reads written by the items between? */
static bool stays(struct acts *acts, const struct st_item *item, const char *value, int count)
{
	struct lex lex;

	lex_init(&lex, value, strlen(value));
	while (lex_next(&lex) != TOKEN_END) {
		const struct token name = lex.token;
		struct lex next = lex;

		lex_next(&next);
		if (name.kind != TOKEN_NAME || lex_is(&next, "(") || lex_is(&next, ":="))
			continue;
		for (int i = 0; i < count; i++)
			if (item[i].kind != ST_COMMENT && text_may_write(acts, text_of(acts, &item[i]), &name))
				return false;
	}
	return true;
}

/* Puts the value of the line @at into the line that alone reads it. */
static void join_line(struct acts *acts, int network, struct st_item *item, int count, int at)
{
	const char *value = NULL, *place = NULL, *old;
	char text[TEXT_MOST];
	struct token wire;
	int uses = 0, user = -1, len;

	if (!is_joinable(acts, network, &item[at], &wire, &value))
		return;
	for (int i = 0; i < count && uses < 2; i++) {
		const int before = uses;
		const char *found = item[i].kind == ST_COMMENT ? NULL : use_in(text_of(acts, &item[i]), &wire, &uses);

		if (uses > before) {
			user = i;
			place = found;
		}
	}
	if (uses != 1 || user <= at || !is_shown(acts, &item[user], place) ||
	    !stays(acts, item + at + 1, value, user - at - 1))
		return;
	old = text_of(acts, &item[user]);
	len = snprintf(text, sizeof(text), "%.*s(%s)%s", (int)(place - old), old, value, place + wire.len);
	if (len < 0 || len >= (int)sizeof(text))
		return;
	item[user].text = acts_intern(acts, text, (size_t)len);
	item[at].kind = ST_EMPTY;
}

void networks_join(struct acts *acts, int network, struct st_item *item, int count)
{
	for (int i = 0; i < count; i++)
		join_line(acts, network, item, count, i);
}

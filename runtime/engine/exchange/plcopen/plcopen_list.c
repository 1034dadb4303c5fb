/* SPDX-License-Identifier: MIT
 *
 * plcopen_list - labels of instruction lists that are reached with a result.
 *
 * In other tools `JMP Save` may bring the result to `Save: ST Count`. Here the result ends at a label, so it is kept
 * in a variable before each jump and before the label, and loaded behind it.
 */
#include "engine/exchange/plcopen/plcopen_convert.h"

#include "engine/base/ascii.h"
#include "engine/base/iec.h"
#include "engine/base/lex.h"

#include <string.h>

/* A line of a list: its label, its operator and its operand; kind TOKEN_END: it has none. */
struct line { const char *text; size_t len; struct token label, op, operand; };

struct lines { struct line *one; int count; };

static struct line read_line(const char *text, size_t len)
{
	struct line line = { .text = text, .len = len };
	struct lex lex, ahead;

	lex_init(&lex, text, len);
	if (lex_next(&lex) != TOKEN_NAME)
		return line;
	ahead = lex;
	if (lex_next(&ahead) != TOKEN_END && lex_is(&ahead, ":")) {
		line.label = lex.token;
		lex_next(&ahead);
		lex = ahead;
	}
	line.op = lex.token;
	if (lex.token.kind != TOKEN_END)
		lex_next(&lex);
	line.operand = lex.token;
	return line;
}

static struct lines read_lines(struct plcopen *c, const char *text)
{
	struct lines all = { NULL, 0 };

	while (*text) {
		const size_t len = strcspn(text, "\n");
		struct line *added = arena_push(c->arena, &all.one, &all.count, sizeof(*added));

		if (added)
			*added = read_line(text, len);
		text += len + (text[len] == '\n');
	}
	return all;
}

static bool is_op(const struct line *line, const char *word)
{
	const struct lex lex = { .token = line->op };

	return line->op.kind == TOKEN_NAME && lex_is(&lex, word);
}

static bool same(const struct token *a, const struct token *b)
{
	return a->kind == TOKEN_NAME && b->kind == TOKEN_NAME && a->len == b->len && ascii_same(a->text, b->text, a->len);
}

/* The type of the variable that the first instruction behind label @at stores the result to; NULL: it does not. */
static const char *stored_type(struct plcopen *c, const struct plcopen_pou *pou, const struct lines *all, int at)
{
	const struct xml_node *variable, *type;

	while (at + 1 < all->count && all->one[at].op.kind != TOKEN_NAME)
		at++;
	if (!is_op(&all->one[at], "ST") || all->one[at].operand.kind != TOKEN_NAME)
		return NULL;
	variable = plc_find_variable(pou, plc_print(c, "%.*s", (int)all->one[at].operand.len, all->one[at].operand.text));
	type = variable ? xml_look(variable, "type") : NULL;
	return type && type->first && iec_type_find(type->first->name, strlen(type->first->name)) != IEC_NONE ?
	       type->first->name : NULL;
}

/* Do all jumps to the label bring a result? Behind JMPC and JMPCN it is a condition. */
static bool brings(const struct lines *all, const struct token *label)
{
	bool any = false;

	for (int i = 0; i < all->count; i++) {
		if (!same(&all->one[i].operand, label))
			continue;
		if (is_op(&all->one[i], "JMPC") || is_op(&all->one[i], "JMPCN"))
			return false;
		any |= is_op(&all->one[i], "JMP");
	}
	return any;
}

/* Does nothing lead from the lines above into line @at? */
static bool ends_above(const struct lines *all, int at)
{
	while (--at >= 0)
		if (all->one[at].op.kind == TOKEN_NAME)
			return is_op(&all->one[at], "JMP") || is_op(&all->one[at], "RET");
	return true;
}

static const char *keep_result(struct plcopen *c, const struct lines *all, int at, const char *name)
{
	const struct line *to = &all->one[at];
	struct plc_build out;

	plc_build(&out);
	for (int i = 0; i < all->count; i++) {
		const struct line *line = &all->one[i];
		const bool leads = is_op(line, "JMP") && same(&line->operand, &to->label);

		if (leads || (i == at && !ends_above(all, at)))
			plc_add_text(&out, plc_print(c, "ST %s ", name));
		if (leads)
			plc_add_text(&out, "\n");
		if (i == at && !ends_above(all, at))
			plc_add_text(&out, "\n");
		if (i != at) {
			plc_add_text(&out, plc_print(c, "%.*s\n", (int)line->len, line->text));
			continue;
		}
		plc_add_text(&out, plc_print(c, "%.*s:\nLD %s\n", (int)to->label.len, to->label.text, name));
		if (line->op.kind == TOKEN_NAME)
			plc_add_text(&out, plc_print(c, "%.*s\n", (int)(line->text + line->len - line->op.text), line->op.text));
	}
	return plc_built(c, &out);
}

/* Does a comment go on in the next line? Then lines say something else. */
static bool has_long_comment(const struct lines *all)
{
	for (int i = 0; i < all->count; i++) {
		int open = 0;

		for (size_t k = 0; k + 1 < all->one[i].len; k++) {
			open += all->one[i].text[k] == '(' && all->one[i].text[k + 1] == '*';
			open -= all->one[i].text[k] == '*' && all->one[i].text[k + 1] == ')';
		}
		if (open)
			return true;
	}
	return false;
}

const char *plc_labels(struct plcopen *c, struct plcopen_pou *pou, const struct xml_node *node, const char *text)
{
	struct lines all = read_lines(c, text);
	int changes = 0;

	for (int i = 0; i < all.count && changes < 100 && !has_long_comment(&all); i++) {
		const struct token label = all.one[i].label;
		const char *type = label.kind == TOKEN_NAME ? stored_type(c, pou, &all, i) : NULL;

		if (!type || !brings(&all, &label))
			continue;
		plc_report(c, REPORT_CHANGED, node, report_said(c->report,
			   REPORTED("the result that is brought to the label %s stands in a variable")),
			   plc_print(c, "%.*s", (int)label.len, label.text));
		text = keep_result(c, &all, i, plc_make(c, pou, "Result", type));
		all = read_lines(c, text);
		changes++;
	}
	return text;
}

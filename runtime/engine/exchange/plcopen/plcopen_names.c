/* SPDX-License-Identifier: MIT
 *
 * plcopen_names - names that nothing can have here get another one, wherever they stand.
 */
#include "engine/exchange/plcopen/plcopen_convert.h"

#include "engine/base/ascii.h"
#include "engine/base/catalog.h"
#include "engine/base/lex.h"
#include "engine/check/reserved.h"
#include "engine/model/words.h"

#include <string.h>

static const char *renamed(const struct plcopen *c, const char *name, size_t len)
{
	for (int i = 0; i < c->rename.count; i++)
		if (strlen(c->rename.one[i].from) == len && ascii_same(c->rename.one[i].from, name, len))
			return c->rename.one[i].to;
	return NULL;
}

/* Functions, blocks and types share their names with those that are built in. No cell and no instruction begins
 * with the name of a type, so it may be R or LD. */
static bool is_built_in(const struct xml_node *node, const char *name)
{
	const enum word word = word_find(name, strlen(name));

	if (xml_is(node, "dataType"))
		return word != WORD_COUNT && !words_is_operator(name, strlen(name));
	return xml_is(node, "pou") &&
	       ((word != WORD_COUNT && word_row(word)->kind != WORD_ELEM) ||
		op_find(name, strlen(name)) != OP_COUNT);
}

static void add_rename(struct plcopen *c, const struct xml_node *node, const char *name)
{
	struct plc_rename *added;

	added = arena_push(c->arena, &c->rename.one, &c->rename.count, sizeof(*added));
	if (!added)
		return;
	*added = (struct plc_rename){ name, plc_print(c, "%s_1", name) };
	plc_report(c, REPORT_CHANGED, node,
		   report_said(c->report, REPORTED("the name \"%s\" becomes %s")), name, added->to);
}

static bool has_name(const struct xml_node *node)
{
	return xml_is(node, "variable") || xml_is(node, "pou") || xml_is(node, "dataType") ||
	       xml_is(node, "value");
}

void plc_find_renames(struct plcopen *c, struct xml_node *project)
{
	for (struct xml_node *node = project; node; node = xml_next(node)) {
		const char *name = has_name(node) ? xml_value(node, "name") : NULL;

		if (!name || !plc_is_name(name) || renamed(c, name, strlen(name)))
			continue;
		if (reserved_fault(name) == DIAG_RESERVED_NAME || is_built_in(node, name))
			add_rename(c, node, name);
	}
}

const char *plc_renamed(struct plcopen *c, const char *text)
{
	const char *from = text;
	struct plc_build all;
	struct lex lex;

	if (!c->rename.count)
		return text;
	plc_build(&all);
	lex_init(&lex, text, strlen(text));
	while (lex_next(&lex) != TOKEN_END) {
		const char *at = lex.token.text, *end = at + lex.token.len;

		if (lex.token.kind != TOKEN_NAME)
			continue;
		/* Names with dots are one token. */
		while (at < end) {
			const char *dot = memchr(at, '.', (size_t)(end - at));
			const size_t len = (size_t)((dot ? dot : end) - at);
			const char *to = renamed(c, at, len);

			if (to) {
				plc_add_text(&all, plc_print(c, "%.*s%s", (int)(at - from), from, to));
				from = at + len;
			}
			at += len + 1;
		}
	}
	plc_add_text(&all, from);
	return plc_built(c, &all);
}

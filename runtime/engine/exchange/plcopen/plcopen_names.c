/* SPDX-License-Identifier: MIT
 *
 * plcopen_names - names that nothing can have here get another one, wherever they stand. Texts of a WSTRING get the
 * quotes of a STRING.
 */
#include "engine/exchange/plcopen/plcopen_convert.h"

#include "engine/base/ascii.h"
#include "engine/base/catalog.h"
#include "engine/base/lex.h"
#include "engine/check/reserved.h"
#include "engine/model/convert.h"
#include "engine/model/words.h"

#include <stdlib.h>
#include <string.h>

static bool is_text(const char *word, const char *text, size_t len)
{
	return strlen(word) == len && ascii_same(word, text, len);
}

/* @list: what stands before the name and its dot; @list_len 0: nothing. */
static const char *renamed(const struct plcopen *c, const char *name, size_t len, const char *list, size_t list_len)
{
	for (int i = 0; i < c->rename.count; i++) {
		const struct plc_rename *one = &c->rename.one[i];

		if (is_text(one->from, name, len) && (!one->list || (list_len && is_text(one->list, list, list_len))))
			return one->to;
	}
	return NULL;
}

/* Functions, blocks and types share their names with those that are built in. No cell and no instruction begins
 * with the name of a type, so it may be R or LD. */
static bool is_built_in(const struct xml_node *node, const char *name)
{
	const enum word word = word_find(name, strlen(name));
	struct convert_word convert;

	if (xml_is(node, "dataType"))
		return word != WORD_COUNT && !words_is_operator(name, strlen(name));
	return xml_is(node, "pou") &&
	       (convert_make(name, strlen(name), &convert) || (word != WORD_COUNT && word_row(word)->kind != WORD_ELEM) ||
		op_find(name, strlen(name)) != OP_COUNT);
}

static bool must_go(const struct xml_node *node, const char *name)
{
	return reserved_fault(name) == DIAG_RESERVED_NAME || is_built_in(node, name);
}

static void add_rename(struct plcopen *c, const struct xml_node *node, struct plc_rename rename)
{
	struct plc_rename *added;

	added = arena_push(c->arena, &c->rename.one, &c->rename.count, sizeof(*added));
	if (!added)
		return;
	*added = rename;
	plc_report(c, REPORT_CHANGED, node,
		   report_said(c->report, REPORTED("the name \"%s\" becomes %s")),
		   rename.list ? plc_print(c, "%s.%s", rename.list, rename.from) : rename.from, rename.to);
}

static bool has_name(const struct xml_node *node)
{
	return xml_is(node, "variable") || xml_is(node, "pou") || xml_is(node, "dataType") ||
	       xml_is(node, "value");
}

/* ---- global variables of several lists ---- */

/* Something that has a name, in the order of names, then of the file. */
struct named_node { const char *name; const struct xml_node *node; int order; };
struct named_nodes { struct named_node *one; int count; };

static int compare_names(const char *a, const char *b)
{
	while (*a && ascii_upper(*a) == ascii_upper(*b)) {
		a++;
		b++;
	}
	return (unsigned char)ascii_upper(*a) - (unsigned char)ascii_upper(*b);
}

static int compare_nodes(const void *a, const void *b)
{
	const struct named_node *one = a, *two = b;
	const int names = compare_names(one->name, two->name);

	return names ? names : one->order - two->order;
}

static int compare_name(const void *name, const void *node)
{
	return compare_names(name, ((const struct named_node *)node)->name);
}

static struct named_nodes nodes_with_names(struct plcopen *c, struct xml_node *project)
{
	struct named_nodes all = { NULL, 0 };

	for (struct xml_node *node = project; node; node = xml_next(node)) {
		const char *name = has_name(node) ? xml_value(node, "name") : NULL;
		struct named_node *added = name && plc_is_name(name) ?
			arena_push(c->arena, &all.one, &all.count, sizeof(*added)) : NULL;

		if (added)
			*added = (struct named_node){ name, node, all.count };
	}
	if (all.count)
		qsort(all.one, (size_t)all.count, sizeof(*all.one), compare_nodes);
	return all;
}

static bool is_global(const struct xml_node *node)
{
	const struct xml_node *list = node->parent;

	return xml_is(node, "variable") && list && xml_is(list, "globalVars") &&
	       !(list->parent && xml_is(list->parent, "interface"));
}

/* The name of the list around a variable, if others can say it; else NULL. */
static const char *list_of(const struct xml_node *variable)
{
	const char *name = is_global(variable) ? xml_value(variable->parent, "name") : NULL;

	return name && plc_is_name(name) ? name : NULL;
}

/* Lists may have variables of one name there. Here the first one keeps it. @same: all that have the name. */
static void find_twice(struct plcopen *c, struct named_nodes all, struct named_nodes same)
{
	const struct xml_node *first = NULL, *before = NULL;
	int number = 0;

	for (int i = 0; i < same.count; i++) {
		const struct xml_node *node = same.one[i].node;
		const char *name = same.one[i].name, *list = list_of(node), *to = name;

		if (!is_global(node) || node->parent == before)
			continue;
		before = node->parent;
		if (!first) {
			first = node;
			number = must_go(node, name); /* then the first one gets _1 */
			continue;
		}
		if (!list || (list_of(first) && plc_same(list_of(first), list)))
			continue;
		while (bsearch(to, all.one, (size_t)all.count, sizeof(*all.one), compare_name))
			to = plc_print(c, "%s_%d", name, ++number);
		add_rename(c, node, (struct plc_rename){ name, to, list });
	}
}

static void find_lists(struct plcopen *c, struct xml_node *project)
{
	const struct named_nodes all = nodes_with_names(c, project);
	int count;

	for (int i = 0; i < all.count; i += count) {
		for (count = 1; i + count < all.count && plc_same(all.one[i].name, all.one[i + count].name); count++)
			;
		find_twice(c, all, (struct named_nodes){ all.one + i, count });
	}
}

const char *plc_declared(struct plcopen *c, const struct xml_node *variable)
{
	const char *name = xml_value(variable, "name"), *list = list_of(variable);
	const char *to = list ? renamed(c, name, strlen(name), list, strlen(list)) : NULL;

	return to ? to : plc_renamed(c, name);
}

/* ---- all names ---- */

void plc_find_renames(struct plcopen *c, struct xml_node *project)
{
	find_lists(c, project);
	for (struct xml_node *node = project; node; node = xml_next(node)) {
		const char *name = has_name(node) ? xml_value(node, "name") : NULL;

		if (!name || !plc_is_name(name) || renamed(c, name, strlen(name), NULL, 0))
			continue;
		if (must_go(node, name))
			add_rename(c, node, (struct plc_rename){ name, plc_print(c, "%s_1", name), NULL });
	}
}

/* "a'b" as 'a$'b' */
static void add_narrow(struct plc_build *all, struct token text)
{
	char one[3] = "$";

	plc_add_text(all, "'");
	for (size_t i = 1; i + 1 < text.len; i++) {
		const bool escape = text.text[i] == '$' && i + 2 < text.len;

		i += escape;
		one[1] = text.text[i];
		plc_add_text(all, (escape && one[1] != '"') || one[1] == '\'' ? one : one + 1);
	}
	plc_add_text(all, "'");
}

const char *plc_renamed(struct plcopen *c, const char *text)
{
	const char *from = text;
	struct plc_build all;
	struct lex lex;

	if (!c->rename.count && !strpbrk(text, "%\""))
		return text;
	plc_build(&all);
	lex_init(&lex, text, strlen(text));
	while (lex_next(&lex) != TOKEN_END) {
		const char *at = lex.token.text, *end = at + lex.token.len, *before = at;

		if (lex.token.kind == TOKEN_ADDRESS) {
			const char *to = plc_moved(c, at, lex.token.len);

			if (to) {
				plc_add_text(&all, plc_print(c, "%.*s%s", (int)(at - from), from, to));
				from = end;
			}
		}
		if (lex.token.kind == TOKEN_STRING) {
			plc_add_text(&all, plc_print(c, "%.*s", (int)(at - from), from));
			add_narrow(&all, lex.token);
			from = end;
		}
		if (lex.token.kind != TOKEN_NAME)
			continue;
		/* Names with dots are one token. */
		while (at < end) {
			const char *dot = memchr(at, '.', (size_t)(end - at));
			const size_t len = (size_t)((dot ? dot : end) - at);
			const char *to = renamed(c, at, len, before, at > before ? (size_t)(at - before) - 1 : 0);

			if (to) {
				plc_add_text(&all, plc_print(c, "%.*s%s", (int)(at - from), from, to));
				from = at + len;
			}
			before = at;
			at += len + 1;
		}
	}
	plc_add_text(&all, from);
	return plc_built(c, &all);
}

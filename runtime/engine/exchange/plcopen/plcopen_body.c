/* SPDX-License-Identifier: MIT
 *
 * plcopen_body - POUs: heading, variables, body.
 */
#include "engine/exchange/plcopen/plcopen_graph.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"

#include <stdlib.h>
#include <string.h>

enum plcopen_language plc_language(struct xml_node *body, struct xml_node **element)
{
	static const char *const names[] = {
		[PLCOPEN_ST] = "ST", [PLCOPEN_IL] = "IL", [PLCOPEN_LD] = "LD", [PLCOPEN_FBD] = "FBD",
		[PLCOPEN_SFC] = "SFC",
	};

	for (struct xml_node *each = body ? body->first : NULL; each; each = each->next)
		for (int i = PLCOPEN_ST; i <= PLCOPEN_SFC; i++)
			if (xml_is(each, names[i])) {
				*element = each;
				return (enum plcopen_language)i;
			}
	*element = NULL;
	return PLCOPEN_NONE;
}

/* ---- text that is made before the text above it ---- */

struct plc_part plc_part_begin(struct plcopen *c)
{
	struct plc_part part = { c->text, c->place, c->lines };

	sink_memory_init(&c->text);
	c->out = sink_to_memory(&c->text);
	c->place = NULL;
	c->lines = 0;
	return part;
}

/* Changes what is written now with @part. */
void plc_part_swap(struct plcopen *c, struct plc_part *part)
{
	const struct plc_part own = { c->text, c->place, c->lines };

	c->text = part->text;
	c->place = part->place;
	c->lines = part->lines;
	*part = own;
}

void plc_part_append(struct plcopen *c, struct plc_part *part)
{
	const char *text = sink_memory_text(&part->text);
	struct foreign_place *place;

	for (int i = 0; i < part->lines; i++) {
		place = arena_push(c->arena, &c->place, &c->lines, sizeof(*place));
		if (place)
			*place = part->place[i];
	}
	if (part->text.failed)
		c->text.failed = true;
	sink_text(&c->out, text);
	sink_memory_free(&part->text);
}

/* ---- text ---- */

/* Of an inner `(*` nothing is left where comments do not nest, as in the compiler of Beremiz: the
 * first `*)` ends the comment. Only a text that would not end otherwise is read like that. */
static const char *flat_comments(struct plcopen *c, const struct xml_node *element, const char *text)
{
	int depth = 0, inner = 0;
	char *flat;

	for (const char *at = text; *at; at++) {
		depth += at[0] == '(' && at[1] == '*';
		depth -= at[0] == '*' && at[1] == ')';
	}
	if (depth <= 0)
		return text;
	flat = arena_copy(c->arena, text, strlen(text));
	depth = 0;
	for (char *at = flat; at && *at; at++) {
		if (at[0] == '*' && at[1] == ')') {
			depth = 0;
		} else if (at[0] == '(' && at[1] == '*') {
			inner += depth;
			at[1] = depth ? ' ' : '*';
			depth = 1;
		}
	}
	if (!flat || !inner)
		return text;
	plc_report(c, REPORT_CHANGED, element, "%s",
		   report_said(c->report, REPORTED("comments do not nest in this text: a (* inside one is left out")));
	return flat;
}

static const char *word_of(const struct plcopen_pou *pou)
{
	return pou->kind == POU_FUNCTION ? "FUNCTION" : pou->kind == POU_BLOCK ? "FUNCTION_BLOCK" : "PROGRAM";
}

/* Some tools write the whole POU where its body belongs. What is between its name and its end is the same with the
 * declarations in front. */
static const char *inside(struct plcopen *c, struct plcopen_pou *pou, const char *text)
{
	const char *word = word_of(pou), *end = NULL, *type;
	struct lex lex;
	char *inner;

	lex_init(&lex, text, strlen(text));
	lex_next(&lex);
	if (!lex_is(&lex, word) || lex_next(&lex) != TOKEN_NAME ||
	    !plc_same(plc_print(c, "%.*s", (int)lex.token.len, lex.token.text), pou->name))
		return text;
	if (pou->kind == POU_FUNCTION) {
		lex_next(&lex);
		type = lex.at;
		if (!lex_is(&lex, ":") || lex_next(&lex) != TOKEN_NAME)
			return text;
		pou->result = plc_print(c, "%s", plc_trim(c, plc_print(c, "%.*s", (int)(lex.at - type), type)));
	}
	for (const char *at = text; at < lex.at; at++)
		c->at += *at == '\n';
	text = lex.at;
	word = plc_print(c, "END_%s", word);
	while (lex_next(&lex) != TOKEN_END)
		if (lex_is(&lex, word))
			end = lex.token.text;
	inner = end ? arena_copy(c->arena, text, (size_t)(end - text)) : NULL;
	return inner ? inner : text;
}

/* The text of a body in ST or IL. */
static void put_text(struct plcopen *c, struct plcopen_pou *pou, struct xml_node *element)
{
	int line = element->line;
	const char *text = xml_text(c->arena, element, &line);
	size_t len = strlen(text);

	/* Blank lines at both ends say nothing. */
	for (const char *at = text; *at && (unsigned char)*at <= ' '; at++)
		if (*at == '\n') {
			line++;
			text = at + 1;
		}
	len = strlen(text);
	while (len && (unsigned char)text[len - 1] <= ' ')
		len--;
	c->at = line;
	text = arena_copy(c->arena, text, len);
	if (!text || !*text)
		return;
	text = inside(c, pou, flat_comments(c, element, text));
	text = xml_is(element, "IL") ? plc_labels(c, pou, element, text) : plc_plain_calls(c, text);
	plc_text(c, plc_renamed(c, text));
	plc_put(c, "\n");
}

/* Writes a body; returns the language that it has here. */
static enum plcopen_language put_drawn(struct plcopen *c, struct plcopen_pou *pou,
				       enum plcopen_language language, struct xml_node *element)
{
	struct plc_groups groups;
	struct plc_graph graph;

	if (!plc_graph_read(c, pou, element, &graph))
		return language;
	plc_groups_make(c, &graph, &groups);
	c->pictures = true;
	if (language == PLCOPEN_LD && plc_ladder(c, &graph, &groups, "")) {
		c->pictures = false;
		return PLCOPEN_LD;
	}
	if (language == PLCOPEN_LD)
		plc_report(c, REPORT_CHANGED, element, "%s",
			   report_said(c->report, REPORTED("not every network can be a rung: the ladder becomes a function block diagram")));
	plc_networks(c, &graph, &groups, false, "  ");
	c->pictures = false;
	return PLCOPEN_FBD;
}

static enum plcopen_language put_body(struct plcopen *c, struct plcopen_pou *pou)
{
	if (pou->body)
		pou->body->taken = true;
	switch ((int)pou->language) {
	case PLCOPEN_ST:
	case PLCOPEN_IL:
		put_text(c, pou, pou->body);
		return pou->language;
	case PLCOPEN_LD:
	case PLCOPEN_FBD:
		return put_drawn(c, pou, pou->language, pou->body);
	case PLCOPEN_SFC:
		if (pou->kind != POU_FUNCTION) {
			plc_chart(c, pou);
			return PLCOPEN_SFC;
		}
		pou->body->taken = false;
		plc_report(c, REPORT_LOST, pou->body,
			   report_said(c->report, REPORTED("%s is a chart, which a function cannot be: it does nothing")), pou->name);
		return PLCOPEN_ST;
	default:
		return PLCOPEN_ST;
	}
}

bool plc_put_inner(struct plcopen *c, struct plcopen_pou *pou, struct xml_node *body,
		   const char *indent)
{
	struct xml_node *element;
	const enum plcopen_language language = plc_language(body, &element);
	struct plc_groups groups;
	struct plc_graph graph;

	if (!element)
		return false;
	body->taken = element->taken = true;
	switch ((int)language) {
	case PLCOPEN_ST:
	case PLCOPEN_IL:
		put_text(c, pou, element);
		return true;
	case PLCOPEN_LD:
	case PLCOPEN_FBD:
		if (!plc_graph_read(c, pou, element, &graph))
			return true;
		plc_groups_make(c, &graph, &groups);
		if (language != PLCOPEN_LD || !plc_ladder(c, &graph, &groups, indent))
			plc_networks(c, &graph, &groups, true, indent);
		return true;
	default:
		return false;
	}
}

/* ---- actions ---- */

bool plc_has_action(const struct plcopen *c, const struct plcopen_pou *pou, const char *name)
{
	const char *dot = strchr(name, '.');
	const struct xml_node *list;

	if (dot)
		pou = NULL;
	for (int i = 0; dot && i < c->pous; i++)
		if (strlen(c->pou[i].name) == (size_t)(dot - name) && ascii_same(c->pou[i].name, name, (size_t)(dot - name)))
			pou = &c->pou[i];
	list = pou && pou->kind != POU_FUNCTION ? xml_look(pou->node, "actions") : NULL;
	for (const struct xml_node *each = list ? list->first : NULL; each; each = each->next)
		if (xml_is(each, "action") && xml_value(each, "name") &&
		    plc_same(xml_value(each, "name"), dot ? dot + 1 : name))
			return true;
	return false;
}

/* The POU whose instance a variable is; NULL: it is none. */
static struct plcopen_pou *block_of(const struct plcopen *c, const struct xml_node *variable)
{
	const struct xml_node *type = variable ? xml_look(variable, "type") : NULL;
	const struct xml_node *derived = type ? xml_look(type, "derived") : NULL;

	return derived && xml_value(derived, "name") ? plc_pou(c, xml_value(derived, "name")) : NULL;
}

bool plc_instance_action(const struct plcopen *c, const struct plcopen_pou *pou, const char *name)
{
	char part[LIMIT_NAME + 1];

	for (bool first = true; ; first = false) {
		const size_t len = strcspn(name, ".");
		const struct xml_node *variable;

		if (!len || len >= sizeof(part))
			return false;
		memcpy(part, name, len);
		part[len] = '\0';
		if (!name[len])
			return !first && plc_has_action(c, pou, part);
		variable = plc_find_variable(pou, part);
		if (!variable && first)
			return name[len] && plc_is_action(c, strrchr(name, '.') + 1);
		pou = block_of(c, variable);
		if (!pou)
			return false;
		name += len + 1;
	}
}

/* An action inside of a chart has no networks; another one is a body like that of its POU. */
static void put_action_body(struct plcopen *c, struct plcopen_pou *pou, struct xml_node *body, bool behind)
{
	struct xml_node *element;
	const enum plcopen_language language = plc_language(body, &element);

	if (language == PLCOPEN_SFC) {
		xml_take_all(body);
		plc_report(c, REPORT_LOST, element, "%s",
			   report_said(c->report, REPORTED("an action that is a chart itself does nothing here")));
		return;
	}
	if (!behind || !element || language <= PLCOPEN_IL) {
		plc_put_inner(c, pou, body, "  ");
		return;
	}
	body->taken = element->taken = true;
	c->rungs = 0;
	put_drawn(c, pou, language, element);
}

void plc_actions(struct plcopen *c, struct plcopen_pou *pou, bool behind)
{
	struct xml_node *list = pou->kind == POU_FUNCTION ? NULL : xml_child(pou->node, "actions");

	for (struct xml_node *each = list ? list->first : NULL; each; each = each->next) {
		const char *name = xml_take(each, "name");

		if (!xml_is(each, "action") || !name || (pou->language == PLCOPEN_SFC && plc_is_called(pou, name) != behind))
			continue;
		each->taken = true;
		c->at = each->line;
		if (behind)
			c->pou_name = plc_print(c, "%s.%s", pou->name, name);
		plc_put(c, "\n");
		if (*plc_documentation(c, each)) {
			plc_comment(c, plc_documentation(c, each));
			plc_put(c, "\n");
		}
		plc_put(c, "ACTION %s:\n", plc_renamed(c, name));
		put_action_body(c, pou, xml_child(each, "body"), behind);
		plc_put(c, "END_ACTION\n");
		c->pou_name = pou->name;
	}
}

/* ---- POUs ---- */

static const char *const language_word[] = { "ST", "ST", "IL", "LD", "FBD", "SFC" };

static const char *return_type(struct plcopen *c, struct plcopen_pou *pou)
{
	struct xml_node *interface = xml_child(pou->node, "interface");
	struct xml_node *type = xml_child(interface, "returnType");

	if (type)
		return plc_type(c, type);
	if (pou->result)
		return pou->result;
	plc_report(c, REPORT_CHANGED, pou->node,
		   report_said(c->report, REPORTED("the function %s has no result; it gets one of BOOL")),
		   pou->name);
	return "BOOL";
}

static void put_heading(struct plcopen *c, struct plcopen_pou *pou, enum plcopen_language language)
{
	c->at = pou->node->line;
	plc_put(c, "\n");
	if (*plc_documentation(c, pou->node)) {
		plc_comment(c, plc_documentation(c, pou->node));
		plc_put(c, "\n");
	}
	if (pou->kind == POU_FUNCTION)
		plc_put(c, "FUNCTION %s : %s", plc_renamed(c, pou->name), return_type(c, pou));
	else
		plc_put(c, "%s %s", word_of(pou), plc_renamed(c, pou->name));
	plc_put(c, " %s\n", language_word[language]);
}

static void put_pou(struct plcopen *c, struct plcopen_pou *pou)
{
	struct plc_part before, behind = { .lines = 0 };
	enum plcopen_language language;

	c->pou_name = pou->name;
	if (plc_own_pou(c, pou)) {
		c->pou_name = NULL;
		return;
	}
	c->rungs = 0;
	c->made.count = 0;
	c->made.name = NULL;
	before = plc_part_begin(c);
	c->added = plc_part_begin(c);
	plc_part_swap(c, &c->added);
	language = put_body(c, pou);
	if (language == PLCOPEN_SFC)
		plc_part_append(c, &c->added);
	behind = plc_part_begin(c);
	plc_actions(c, pou, true);
	if (language != PLCOPEN_SFC)
		plc_part_append(c, &c->added);
	plc_part_swap(c, &behind);
	plc_part_swap(c, &before);
	put_heading(c, pou, language);
	plc_interface(c, pou);
	plc_part_append(c, &before);
	c->at = pou->node->line;
	plc_put(c, "END_%s\n", word_of(pou));
	plc_part_append(c, &behind);
	c->count.pous++;
	c->pou_name = NULL;
}

static void find_pou(struct plcopen *c, struct xml_node *node)
{
	const char *name = xml_take(node, "name"), *type = xml_take(node, "pouType");
	struct xml_node *body = xml_look(node, "body");
	struct plcopen_pou pou = { .node = node, .name = name };
	struct plcopen_pou *added;

	if (!name || !type)
		return;
	if (plc_same(type, "function"))
		pou.kind = POU_FUNCTION;
	else if (plc_same(type, "functionBlock") || plc_same(type, "function_block"))
		pou.kind = POU_BLOCK;
	else if (plc_same(type, "program"))
		pou.kind = POU_PROGRAM;
	else
		return;
	node->taken = true;
	if (body)
		body->taken = true;
	pou.language = plc_language(body, &pou.body);
	added = arena_push(c->arena, &c->pou, &c->pous, sizeof(*added));
	if (added)
		*added = pou;
}

void plc_find_pous(struct plcopen *c, struct xml_node *pous)
{
	for (struct xml_node *each = pous ? pous->first : NULL; each; each = each->next)
		if (xml_is(each, "pou"))
			find_pou(c, each);
}

void plc_pous(struct plcopen *c)
{
	for (int i = 0; i < c->pous; i++)
		put_pou(c, &c->pou[i]);
	plc_own_others(c);
}

/* SPDX-License-Identifier: MIT
 *
 * plcopen_own - the text that an export of this project has put beside what the XML says.
 *
 * It is read only while the XML says what it said then: all of it, or that of a POU. It names no
 * other file, so an XML from elsewhere cannot have a file of this machine read.
 */
#include "engine/exchange/plcopen/plcopen_convert.h"

#include "engine/base/lex.h"
#include "engine/base/sink.h"
#include "engine/exchange/plcopen/plcopen_digest.h"

#include <stdlib.h>
#include <string.h>

static bool has_digest(const struct xml_node *node, const struct xml_node *of)
{
	const char *digest = xml_value(node, "digest");

	return digest && strlen(digest) == 16 && strtoull(digest, NULL, 16) == plcopen_digest(of);
}

/* Of all parts, as they are read one behind another. */
static bool names_files(const struct xml_node *own)
{
	struct sink_memory memory;
	struct sink sink;
	struct lex lex;
	bool names = false, found = false;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	for (const struct xml_node *part = own->first; part; part = part->next)
		sink_text(&sink, part->text);
	lex_init(&lex, sink_memory_text(&memory), memory.len);
	while (!memory.failed && !found && lex_next(&lex) != TOKEN_END) {
		found = names && lex.token.kind == TOKEN_STRING;
		names = lex_is(&lex, "INCLUDE") || lex_is(&lex, "USES");
	}
	found |= memory.failed;
	sink_memory_free(&memory);
	return found;
}

/* A part ends with its line, so that no word or comment goes on in the next one. */
static bool is_part(const struct xml_node *node)
{
	const size_t len = node->text ? strlen(node->text) : 0;

	return xml_is(node, "part") && len && node->text[len - 1] == '\n';
}

static bool are_parts(const struct xml_node *own)
{
	for (const struct xml_node *part = own->first; part; part = part->next)
		if (!is_part(part))
			return false;
	return true;
}

void plc_find_own(struct plcopen *c, struct xml_node *project)
{
	for (struct xml_node *add = project->first; add; add = add->next)
		for (struct xml_node *data = xml_is(add, "addData") ? add->first : NULL; data; data = data->next)
			if (plcopen_is_own(data) && xml_look(data, "text")) {
				c->own = xml_look(data, "text");
				add->taken = true;
				xml_take_all(data);
			}
	if (c->own && (!are_parts(c->own) || names_files(c->own))) {
		plc_report(c, REPORT_LOST, c->own, "%s",
			   report_said(c->report, REPORTED("the text beside the drawing is damaged and is not read")));
		c->own = NULL;
	}
}

static void put_part(struct plcopen *c, const struct xml_node *part)
{
	c->at = part->line;
	plc_text(c, part->text);
}

static int count_variables(const struct xml_node *node)
{
	int count = 0;

	for (const struct xml_node *each = node ? node->first : NULL; each; each = each->next)
		count += xml_is(each, "variable");
	return count;
}

static void count_pou(struct plcopen *c, const struct xml_node *pou)
{
	const struct xml_node *interface = xml_look(pou, "interface");

	for (const struct xml_node *list = interface ? interface->first : NULL; list; list = list->next)
		c->count.variables += count_variables(list);
	c->count.pous++;
	c->count.own++;
}

static void count_all(struct plcopen *c, const struct xml_node *project)
{
	const struct xml_node *configurations = xml_look(xml_look(project, "instances"), "configurations");

	for (const struct xml_node *each = c->types ? c->types->first : NULL; each; each = each->next)
		c->count.types += xml_is(each, "dataType");
	for (int i = 0; i < c->pous; i++)
		count_pou(c, c->pou[i].node);
	for (const struct xml_node *list = configurations && configurations->first ? configurations->first->first : NULL;
	     list; list = list->next)
		if (xml_is(list, "globalVars"))
			c->count.variables += count_variables(list);
}

bool plc_own_project(struct plcopen *c, struct xml_node *project)
{
	if (!c->own)
		return false;
	if (!has_digest(c->own, project)) {
		plc_report(c, REPORT_CHANGED, c->own, "%s",
			   report_said(c->report, REPORTED("another tool has changed the file: what stays the same comes from the text beside it, the rest from the XML")));
		return false;
	}
	for (const struct xml_node *part = c->own->first; part; part = part->next)
		put_part(c, part);
	count_all(c, project);
	xml_take_all(project);
	return true;
}

/* What stands behind a POU: its actions. */
static void put_behind(struct plcopen *c, const char *name)
{
	for (const struct xml_node *part = c->own->first; part; part = part->next)
		if (xml_value(part, "behind") && plc_same(xml_value(part, "behind"), name))
			put_part(c, part);
}

bool plc_own_pou(struct plcopen *c, const struct plcopen_pou *pou)
{
	for (const struct xml_node *part = c->own ? c->own->first : NULL; part; part = part->next) {
		const char *name = xml_value(part, "pou");

		if (!name || !plc_same(name, pou->name))
			continue;
		if (!has_digest(part, pou->node)) {
			plc_report(c, REPORT_CHANGED, pou->node,
				   report_said(c->report, REPORTED("%s was changed since it was exported: it is read from the XML")),
				   pou->name);
			return false;
		}
		put_part(c, part);
		put_behind(c, pou->name);
		count_pou(c, pou->node);
		xml_take_all(pou->node);
		return true;
	}
	return false;
}

void plc_own_others(struct plcopen *c)
{
	for (const struct xml_node *part = c->own ? c->own->first : NULL; part; part = part->next) {
		const char *name = xml_value(part, "pou");

		if (name && !xml_value(part, "digest") && !plc_pou(c, name))
			put_part(c, part);
	}
}

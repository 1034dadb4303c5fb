/* SPDX-License-Identifier: MIT
 *
 * plcopen_text - writing text that knows the lines it comes from, and the report.
 */
#include "engine/exchange/plcopen/plcopen_convert.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/limits.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { CLIP = 120 }; /* bytes of a text in a line of the report */

static void write_text(struct plcopen *c, const char *text, size_t len, bool follows)
{
	for (size_t i = 0; i < len; i++) {
		struct foreign_place *place;

		if (text[i] != '\n')
			continue;
		place = arena_push(c->arena, &c->place, &c->lines, sizeof(*place));
		if (place)
			*place = (struct foreign_place){ "", c->at };
		if (follows)
			c->at++;
	}
	sink_write(&c->out, text, len);
}

void plc_text(struct plcopen *c, const char *text)
{
	write_text(c, text, strlen(text), true);
}

/* Formats into the arena if a line is longer than usual. */
static const char *format_text(struct plcopen *c, char *line, size_t size, const char *format,
			       va_list args)
{
	va_list again;
	char *whole = line;
	int len;

	va_copy(again, args);
	len = vsnprintf(line, size, format, args);
	if (len >= 0 && (size_t)len >= size) {
		whole = arena_alloc(c->arena, (size_t)len + 1);
		if (whole)
			vsnprintf(whole, (size_t)len + 1, format, again);
	}
	va_end(again);
	return whole && len >= 0 ? whole : "";
}

void plc_put(struct plcopen *c, const char *format, ...)
{
	char line[400];
	const char *text;
	va_list args;

	va_start(args, format);
	text = format_text(c, line, sizeof(line), format, args);
	va_end(args);
	write_text(c, text, strlen(text), false);
}

const char *plc_print(struct plcopen *c, const char *format, ...)
{
	char line[400];
	const char *text;
	va_list args;

	va_start(args, format);
	text = format_text(c, line, sizeof(line), format, args);
	va_end(args);
	if (text == line)
		text = arena_copy(c->arena, line, strlen(line));
	return text ? text : "";
}

void plc_build(struct plc_build *build)
{
	sink_memory_init(&build->memory);
}

void plc_add_text(struct plc_build *build, const char *text)
{
	const struct sink sink = sink_to_memory(&build->memory);

	sink_text(&sink, text);
}

void plc_add(struct plc_build *build, const char *format, ...)
{
	char line[200];
	va_list args;

	va_start(args, format);
	vsnprintf(line, sizeof(line), format, args);
	va_end(args);
	plc_add_text(build, line);
}

const char *plc_built(struct plcopen *c, struct plc_build *build)
{
	const char *text = arena_copy(c->arena, sink_memory_text(&build->memory), build->memory.len);

	if (build->memory.failed)
		c->text.failed = true;
	sink_memory_free(&build->memory);
	return text ? text : "";
}

/* One line: control characters and runs of blanks are one blank; no comment ends or begins in it. */
const char *plc_flat(struct plcopen *c, const char *text)
{
	char *out = arena_alloc(c->arena, 2 * strlen(text) + 1), *at = out;

	if (!out)
		return "";
	for (; *text; text++) {
		const bool blank = (unsigned char)*text <= ' ';

		if (blank && (at == out || at[-1] == ' '))
			continue;
		if (at > out && ((at[-1] == '*' && *text == ')') || (at[-1] == '(' && *text == '*') ||
				 (at[-1] == '*' && *text == '/') || (at[-1] == '/' && *text == '*')))
			*at++ = ' ';
		*at++ = blank ? ' ' : *text;
	}
	while (at > out && at[-1] == ' ')
		at--;
	*at = '\0';
	return out;
}

void plc_comment(struct plcopen *c, const char *text)
{
	text = plc_flat(c, text);
	if (*text)
		plc_put(c, " (* %s *)", text);
}

void plc_string(struct plcopen *c, const char *text)
{
	text = plc_flat(c, text);
	plc_put(c, "\"");
	for (; *text; text++)
		plc_put(c, *text == '"' || *text == '$' ? "$%c" : "%c", *text);
	plc_put(c, "\"");
}

const char *plc_trim(struct plcopen *c, const char *text)
{
	size_t len;

	while (*text && (unsigned char)*text <= ' ')
		text++;
	for (len = strlen(text); len && (unsigned char)text[len - 1] <= ' '; len--)
		;
	text = arena_copy(c->arena, text, len);
	return text ? text : "";
}

void plc_report(struct plcopen *c, enum report_kind kind, const struct xml_node *node,
		const char *text, ...)
{
	struct report_line line = { kind, "", node ? node->line : 0, c->pou_name, 0, NULL };
	char whole[400];
	va_list args;

	va_start(args, text);
	vsnprintf(whole, sizeof(whole), text, args);
	va_end(args);
	report_add(c->report, line, "%s", whole);
}

const char *plc_documentation(struct plcopen *c, struct xml_node *node)
{
	struct xml_node *documentation = xml_child(node, "documentation");

	return documentation ? xml_text(c->arena, documentation, NULL) : "";
}

bool plc_is_name(const char *name)
{
	const size_t len = strlen(name);
	struct lex lex;

	lex_init(&lex, name, len);
	return len && len <= LIMIT_NAME && lex_next(&lex) == TOKEN_NAME && lex.token.len == len && !strchr(name, '.');
}

bool plc_same(const char *a, const char *b)
{
	return ascii_is(a, b, strlen(b));
}

struct plcopen_pou *plc_pou(const struct plcopen *c, const char *name)
{
	for (int i = 0; i < c->pous; i++)
		if (plc_same(c->pou[i].name, name))
			return &c->pou[i];
	return NULL;
}

/* ---- what nobody took ---- */

/* They say where something is drawn, or who made it and when. */
static bool is_layout(const char *name)
{
	static const char *const names[] = {
		"x", "y", "width", "height", "globalId", "localId", "color", "hidden",
		"xmlns", "schemaLocation", "noNamespaceSchemaLocation", "handleUnknown",
	};

	for (size_t i = 0; i < sizeof(names) / sizeof(*names); i++)
		if (!strcmp(name, names[i]))
			return true;
	return false;
}

static bool is_drawing(const struct xml_node *node)
{
	static const char *const names[] = { "position", "relPosition", "coordinateInfo" };

	for (size_t i = 0; i < sizeof(names) / sizeof(*names); i++)
		if (xml_is(node, names[i]))
			return true;
	return false;
}

/* The name that the element itself, or the next one around it, has. */
static const char *named_by(const struct xml_node *node)
{
	static const char *const names[] = { "name", "instanceName", "typeName", "label" };

	for (size_t i = 0; i < sizeof(names) / sizeof(*names); i++) {
		const char *name = xml_value(node, names[i]);

		if (name)
			return name;
	}
	return "";
}

static void report_element(struct plcopen *c, const struct xml_node *node)
{
	const char *name = named_by(node), *before = c->pou_name;
	const struct xml_node *pou = node;

	while (pou && !xml_is(pou, "pou"))
		pou = pou->parent;
	c->pou_name = pou ? xml_value(pou, "name") : NULL;
	if (*name)
		plc_report(c, REPORT_LOST, node,
			   report_said(c->report, REPORTED("the element %s \"%.*s\" is left out")),
			   node->name, CLIP, name);
	else
		plc_report(c, REPORT_LOST, node,
			   report_said(c->report, REPORTED("the element %s is left out")),
			   node->name);
	c->pou_name = before;
}

/* What an attribute has that is left out. */
static bool says_nothing(const char *value)
{
	return !*value || !strcmp(value, "false") || !strcmp(value, "none");
}

static void report_attributes(struct plcopen *c, const struct xml_node *node)
{
	for (const struct xml_attribute *a = node->attribute; a; a = a->next)
		if (!a->taken && !is_layout(a->name) && !says_nothing(a->value))
			plc_report(c, REPORT_LOST, node,
				   report_said(c->report,
					       REPORTED("%s %s=\"%.*s\" is left out")),
				   node->name, a->name, CLIP, a->value);
}

void plc_leftovers(struct plcopen *c, struct xml_node *root)
{
	struct xml_node *node = root;

	while (node) {
		const bool skip = !node->taken || is_drawing(node);

		if (!node->taken && !is_drawing(node))
			report_element(c, node);
		else if (!skip)
			report_attributes(c, node);
		if (!skip && node->first) {
			node = node->first;
			continue;
		}
		while (node && node != root && !node->next)
			node = node->parent;
		node = node && node != root ? node->next : NULL;
	}
}

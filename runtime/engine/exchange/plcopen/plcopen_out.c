/* SPDX-License-Identifier: MIT
 *
 * plcopen_out - elements, attributes and texts of XML.
 */
#include "engine/exchange/plcopen/plcopen_out.h"

#include "engine/base/lex.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void begin(struct out *out, const char *format, va_list args, const char *end)
{
	char line[512];

	vsnprintf(line, sizeof(line), format, args);
	sink_repeat(&out->sink, "  ", out->depth);
	sink_text(&out->sink, "<");
	sink_text(&out->sink, line);
	sink_text(&out->sink, end);
}

void plco_open(struct out *out, const char *format, ...)
{
	va_list args;

	va_start(args, format);
	begin(out, format, args, ">\n");
	va_end(args);
	out->depth++;
}

void plco_line(struct out *out, const char *format, ...)
{
	va_list args;

	va_start(args, format);
	begin(out, format, args, "/>\n");
	va_end(args);
}

void plco_close(struct out *out, const char *name)
{
	out->depth--;
	sink_repeat(&out->sink, "  ", out->depth);
	sink_text(&out->sink, "</");
	sink_text(&out->sink, name);
	sink_text(&out->sink, ">\n");
}

static const char *entity(char c)
{
	switch (c) {
	case '<':
		return "&lt;";
	case '>':
		return "&gt;";
	case '&':
		return "&amp;";
	case '"':
		return "&quot;";
	default:
		return NULL;
	}
}

void plco_escape(struct out *out, const char *text)
{
	const char *plain = text;

	for (; *text; text++) {
		const bool control = (unsigned char)*text < ' ' && *text != '\n' && *text != '\t';
		const char *with = control ? "?" : entity(*text);

		if (!with)
			continue;
		sink_write(&out->sink, plain, (size_t)(text - plain));
		sink_text(&out->sink, with);
		plain = text + 1;
	}
	sink_text(&out->sink, plain);
}

void plco_named(struct out *out, const char *element, const char *attribute, const char *value,
	       bool empty)
{
	sink_repeat(&out->sink, "  ", out->depth);
	sink_printf(&out->sink, "<%s %s=\"", element, attribute);
	plco_escape(out, value);
	sink_text(&out->sink, empty ? "\"/>\n" : "\">\n");
	out->depth += !empty;
}

void plco_place(struct out *out, int id, int x, int y)
{
	while (out->places <= id) {
		struct out_place *added = arena_push(out->arena, &out->place, &out->places, sizeof(*added));

		if (!added)
			return;
		*added = (struct out_place){ 0, 0 };
	}
	out->place[id] = (struct out_place){ x, y };
}

void plco_position(struct out *out, int x, int y)
{
	out->at_x = x;
	out->at_y = y;
	out->outputs = 0;
	plco_line(out, "position x=\"%d\" y=\"%d\"", x, y);
}

void plco_output(struct out *out, const char *name, bool negated, int width)
{
	plco_open(out, "variable formalParameter=\"%s\"%s", name, negated ? " negated=\"true\"" : "");
	plco_open(out, "connectionPointOut");
	plco_line(out, "relPosition x=\"%d\" y=\"%d\"", width, 20 * ++out->outputs);
	plco_close(out, "connectionPointOut");
	plco_close(out, "variable");
}

void plco_connection(struct out *out, int id, const char *pin)
{
	const struct out_place from = id < out->places ? out->place[id] : (struct out_place){ out->at_x, out->at_y };

	if (pin)
		plco_open(out, "connection refLocalId=\"%d\" formalParameter=\"%s\"", id, pin);
	else
		plco_open(out, "connection refLocalId=\"%d\"", id);
	plco_line(out, "position x=\"%d\" y=\"%d\"", out->at_x, out->at_y);
	plco_line(out, "position x=\"%d\" y=\"%d\"", from.x, from.y);
	plco_close(out, "connection");
}

bool plco_is_action(struct out *out, const char *name)
{
	const struct project *project = out->project;
	const struct pou *own = out->pou;
	const char *whole;
	int found;

	if (own->kind == POU_ACTION && pou_owner(project, own) >= 0)
		own = &project->pou[pou_owner(project, own)];
	whole = plco_print(out, "%s.%s", plco_id(out, own->name), name);
	found = project_find_pou(project, whole, strlen(whole));
	if (found < 0)
		found = project_find_pou(project, name, strlen(name));
	return found >= 0 && project->pou[found].kind == POU_ACTION;
}

const char *plco_numbers(struct out *out, const char *text)
{
	const char *from = text;
	struct sink_memory memory;
	struct sink sink;
	struct lex lex;

	if (!out->project->words.as_numbers)
		return text;
	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	lex_init(&lex, text, strlen(text));
	while (lex_next(&lex) != TOKEN_END) {
		const char *word = lex.token.kind != TOKEN_NAME ? NULL :
				   words_number(lex.token.text, lex.token.len);

		if (!word)
			continue;
		sink_write(&sink, from, (size_t)(lex.token.text - from));
		sink_text(&sink, word);
		from = lex.token.text + lex.token.len;
	}
	sink_text(&sink, from);
	text = plco_print(out, "%s", memory.failed ? text : sink_memory_text(&memory));
	sink_memory_free(&memory);
	return text;
}

static bool is_variable(const struct out *out, const struct var_table *table, const char *name, size_t len)
{
	struct names *names = &out->project->names;

	return vars_find(table, names_fold(names, names_intern(names, name, len))) >= 0;
}

/* The bytes of a name that are its namespaces: 4 of GVL.Level. 0: it has none, or they are needed. */
static size_t space_of(struct out *out, const struct token *name)
{
	const struct project *project = out->project;
	const struct pou *pou = out->pou;
	const char *rest = name->text;
	size_t len = name->len;

	if (!words_strip(&project->words, &rest, &len))
		return 0;
	if (pou && pou->kind == POU_ACTION && pou_owner(project, pou) >= 0)
		pou = &project->pou[pou_owner(project, pou)];
	if (is_variable(out, &project->globals, name->text, strcspn(name->text, ".")) ||
	    (pou && is_variable(out, &pou->vars, name->text, strcspn(name->text, "."))))
		return 0;
	if (pou && is_variable(out, &pou->vars, rest, memchr(rest, '.', len) ? strcspn(rest, ".") : len)) {
		plco_lost(out, REPORT_LOST, pou->line, 0, report_said(out->report,
			 REPORTED("the format has no namespaces: other tools do not find %s")),
			 plco_print(out, "%.*s", (int)name->len, name->text));
		return 0;
	}
	return (size_t)(rest - name->text);
}

const char *plco_words(struct out *out, const char *text)
{
	const char *from;
	struct sink_memory memory;
	struct sink sink;
	struct lex lex;

	from = text = plco_numbers(out, text);
	if (!out->project->words.space_count)
		return text;
	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	lex_init(&lex, text, strlen(text));
	while (lex_next(&lex) != TOKEN_END) {
		const bool member = lex.token.text > text && lex.token.text[-1] == '.';
		const size_t space = lex.token.kind == TOKEN_NAME && !member ? space_of(out, &lex.token) : 0;

		if (!space)
			continue;
		sink_write(&sink, from, (size_t)(lex.token.text - from));
		from = lex.token.text + space;
	}
	sink_text(&sink, from);
	text = plco_print(out, "%s", memory.failed ? text : sink_memory_text(&memory));
	sink_memory_free(&memory);
	return text;
}

void plco_text(struct out *out, const char *name, const char *text)
{
	sink_repeat(&out->sink, "  ", out->depth);
	sink_printf(&out->sink, "<%s>", name);
	plco_escape(out, plco_words(out, text));
	sink_printf(&out->sink, "</%s>\n", name);
}

/* XML has no control characters. */
static void put_allowed(struct out *out, const char *text, size_t len)
{
	const char *plain = text, *end = text + len;

	for (; text < end; text++) {
		if ((unsigned char)*text >= ' ' || *text == '\n' || *text == '\t' || *text == '\r')
			continue;
		sink_write(&out->sink, plain, (size_t)(text - plain));
		sink_text(&out->sink, "?");
		plain = text + 1;
	}
	sink_write(&out->sink, plain, (size_t)(end - plain));
}

void plco_formatted(struct out *out, const char *name, const char *text)
{
	const char *end;

	plco_open(out, "%s", name);
	sink_repeat(&out->sink, "  ", out->depth);
	sink_text(&out->sink, "<xhtml:p><![CDATA[");
	while ((end = strstr(text, "]]>"))) {
		put_allowed(out, text, (size_t)(end - text) + 2);
		sink_text(&out->sink, "]]><![CDATA[");
		text = end + 2;
	}
	put_allowed(out, text, strlen(text));
	sink_text(&out->sink, "]]></xhtml:p>\n");
	plco_close(out, name);
}

const char *plco_bare(struct out *out, const char *comment)
{
	char *bare = arena_alloc(out->arena, strlen(comment) + 2), *at = bare;
	struct lex lex;

	if (!bare)
		return "";
	lex_init(&lex, comment, strlen(comment));
	lex.comments = true;
	while (lex_next(&lex) != TOKEN_END) {
		const char *from = lex.token.text, *end = from + lex.token.len;

		if (lex.token.kind != TOKEN_COMMENT)
			continue;
		from += 2;
		if (lex.token.text[1] == '*' && end - from >= 2)
			end -= 2;
		while (from < end && (unsigned char)*from <= ' ')
			from++;
		while (end > from && (unsigned char)end[-1] <= ' ')
			end--;
		if (at > bare)
			*at++ = '\n';
		memcpy(at, from, (size_t)(end - from));
		at += end - from;
	}
	*at = '\0';
	return bare;
}

void plco_documentation(struct out *out, const char *comment)
{
	const char *bare = plco_bare(out, comment);

	if (*bare)
		plco_formatted(out, "documentation", bare);
}

void plco_lost(struct out *out, enum report_kind kind, int line, int rung, const char *text, ...)
{
	struct report_line place = { kind, "", line, out->pou ? plco_id(out, out->pou->name) : NULL, rung, NULL };
	char whole[400];
	va_list args;

	va_start(args, text);
	vsnprintf(whole, sizeof(whole), text, args);
	va_end(args);
	report_add(out->report, place, "%s", whole);
}

const char *plco_id(const struct out *out, uint32_t id)
{
	return project_text(out->project, id);
}

const char *plco_print(struct out *out, const char *format, ...)
{
	va_list args, again;
	char *text;
	int len;

	va_start(args, format);
	va_copy(again, args);
	len = vsnprintf(NULL, 0, format, args);
	va_end(args);
	text = len < 0 ? NULL : arena_alloc(out->arena, (size_t)len + 1);
	if (text)
		vsnprintf(text, (size_t)len + 1, format, again);
	va_end(again);
	return text ? text : "";
}

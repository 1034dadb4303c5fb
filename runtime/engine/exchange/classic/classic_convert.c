/* SPDX-License-Identifier: MIT
 *
 * classic_convert - what the files of the import write with: the text with a place for each line, and the
 * report. It knows no section, rung or name.
 */
#include "engine/exchange/classic/classic_convert.h"

#include "engine/exchange/foreign_text.h"

#include <stdio.h>

static bool room_for(struct conversion *c, size_t more)
{
	struct classic_text *out = c->out;
	size_t cap = c->cap ? c->cap : 4096;
	char *text;

	while (cap - out->len <= more)
		cap *= 2;
	if (cap == c->cap)
		return true;
	text = arena_grow(c->arena, out->text, out->len, cap);
	if (!text)
		return false;
	out->text = text;
	c->cap = cap;
	return true;
}

/* Notes the place in work for each line that ends behind @from. */
static void count_lines(struct conversion *c, size_t from)
{
	struct classic_text *out = c->out;

	for (size_t i = from; i < out->len; i++) {
		struct classic_place *place;

		if (out->text[i] != '\n')
			continue;
		place = arena_push(c->arena, &out->place, &out->lines, sizeof(*place));
		if (place)
			*place = c->at;
	}
}

void put(struct conversion *c, const char *format, ...)
{
	struct classic_text *out = c->out;
	size_t from = out->len;
	va_list args;
	int need;

	va_start(args, format);
	need = vsnprintf(NULL, 0, format, args);
	va_end(args);
	if (need < 0 || !room_for(c, (size_t)need + 1))
		return;
	va_start(args, format);
	vsnprintf(out->text + out->len, (size_t)need + 1, format, args);
	va_end(args);
	out->len += (size_t)need;
	count_lines(c, from);
}

const char *text_of(struct conversion *c, const char *format, ...)
{
	va_list args;
	char *text;

	va_start(args, format);
	text = foreign_print(c->arena, format, args);
	va_end(args);
	return text ? text : "";
}

void put_quoted(struct conversion *c, const char *text)
{
	put(c, "\"");
	for (; *text; text++) {
		if ((unsigned char)*text < ' ')
			put(c, " ");
		else
			put(c, "%s%c", *text == '"' || *text == '$' ? "$" : "", *text);
	}
	put(c, "\"");
}

void tell(struct conversion *c, enum report_kind kind, const char *format, ...)
{
	struct report_line line = {
		.kind = kind, .member = c->at.member, .line = c->at.line,
		.pou = c->section_pou, .rung = c->section_pou ? c->rung : 0,
	};
	va_list args;
	char *text;

	va_start(args, format);
	text = foreign_print(c->arena, report_said(c->report, format), args);
	va_end(args);
	if (text)
		report_add(c->report, line, "%s", text);
}

const char *label_of(const struct conversion *c, int number)
{
	int index = classic_rung_index(c->project, number);

	return index >= 0 && c->section_of[index] == c->section + 1 ? c->label[index] : NULL;
}

void add_program(struct conversion *c, const char *name)
{
	const char **slot = arena_push(c->arena, &c->programs.name, &c->programs.count,
				       sizeof(*slot));

	if (slot)
		*slot = name;
}

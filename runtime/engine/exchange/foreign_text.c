/* SPDX-License-Identifier: MIT
 *
 * foreign_text - the text of a rung file while an importer writes it.
 */
#include "engine/exchange/foreign_text.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/limits.h"
#include "engine/check/reserved.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void writing_init(struct writing *w, struct arena *arena, struct classic_report *report)
{
	*w = (struct writing){ .arena = arena, .report = report, .at = { "", 0 } };
	names_init(&w->taken, arena);
}

static bool room_for(struct writing *w, size_t more)
{
	size_t room = w->room ? w->room : 4096;
	char *text;

	while (room - w->out.len <= more)
		room *= 2;
	if (room == w->room)
		return true;
	text = arena_grow(w->arena, w->out.text, w->out.len, room);
	if (!text)
		return false;
	w->out.text = text;
	w->room = room;
	return true;
}

static void note_line(struct writing *w, struct foreign_place at)
{
	struct foreign_place *place = arena_push(w->arena, &w->out.place, &w->out.lines,
						 sizeof(*place));

	if (place)
		*place = at;
}

void w_put(struct writing *w, const char *format, ...)
{
	const size_t from = w->out.len;
	va_list args;
	int need;

	va_start(args, format);
	need = vsnprintf(NULL, 0, format, args);
	va_end(args);
	if (need < 0 || !room_for(w, (size_t)need + 1))
		return;
	va_start(args, format);
	vsnprintf(w->out.text + w->out.len, (size_t)need + 1, format, args);
	va_end(args);
	w->out.len += (size_t)need;
	for (size_t i = from; i < w->out.len; i++)
		if (w->out.text[i] == '\n')
			note_line(w, w->at);
}

void w_add(struct writing *w, const struct foreign_text *text)
{
	if (!text->len || !room_for(w, text->len + 1))
		return;
	memcpy(w->out.text + w->out.len, text->text, text->len + 1);
	w->out.len += text->len;
	for (int i = 0; i < text->lines; i++)
		note_line(w, text->place[i]);
}

char *foreign_print(struct arena *arena, const char *format, va_list args)
{
	va_list again;
	char *text;
	int need;

	va_copy(again, args);
	need = vsnprintf(NULL, 0, format, again);
	va_end(again);
	text = need < 0 ? NULL : arena_alloc(arena, (size_t)need + 1);
	if (text)
		vsnprintf(text, (size_t)need + 1, format, args);
	return text;
}

const char *w_text(struct writing *w, const char *format, ...)
{
	va_list args;
	char *text;

	va_start(args, format);
	text = foreign_print(w->arena, format, args);
	va_end(args);
	return text ? text : "";
}

void w_tell(struct writing *w, enum report_kind kind, const char *format, ...)
{
	const struct report_line line = {
		.kind = kind, .member = w->at.member, .line = w->at.line, .pou = w->pou,
		.rung = w->pou ? w->rung : 0,
	};
	va_list args;
	char *text;

	va_start(args, format);
	text = foreign_print(w->arena, report_said(w->report, format), args);
	va_end(args);
	if (text)
		report_add(w->report, line, "%s", text);
}

/* ---- names ---- */

static bool is_name_char(const char *text, size_t len)
{
	const char upper = ascii_upper(*text);

	return len > 1 ? utf8_is_letter(text, len) :
	       (upper >= 'A' && upper <= 'Z') || ascii_digit(upper) || upper == '_';
}

const char *foreign_name(struct arena *arena, const char *wish, size_t most)
{
	size_t len = strlen(wish), at = 0, out = 0;
	char *name = arena_alloc(arena, len + 3);

	if (!name)
		return "_";
	if (len > most)
		len = most;
	if (!len || ascii_digit(wish[0]))
		name[out++] = 'N';
	while (at < len) {
		const size_t found = utf8_length(wish + at, len - at), step = found ? found : 1;

		if (is_name_char(wish + at, step)) {
			memcpy(name + out, wish + at, step);
			out += step;
		} else {
			name[out++] = '_';
		}
		at += step;
	}
	return name;
}

/* Takes @name. false: it is taken, in any spelling. */
static bool claim(struct writing *w, const char *name)
{
	const int before = w->taken.count;
	const uint32_t id = names_intern(&w->taken, name, strlen(name));

	return id && w->taken.count > before && names_fold(&w->taken, id) == id;
}

/* Each base counts on from its last number: a thousand names of one base need a thousand
 * tries. */
static int number_behind(struct writing *w, const char *base)
{
	const uint32_t id = names_intern(&w->taken, base, strlen(base));
	int *number;

	while ((uint32_t)w->tried_count <= id) {
		number = arena_push(w->arena, &w->tried, &w->tried_count, sizeof(*number));
		if (!number)
			return 0;
		*number = 1;
	}
	return ++w->tried[id];
}

/* Statements of Structured Text begin with them. */
static bool begins_statement(const char *name)
{
	static const char *const words[] = {
		"IF", "THEN", "ELSIF", "ELSE", "END_IF", "CASE", "END_CASE", "FOR", "TO", "BY", "DO",
		"END_FOR", "WHILE", "END_WHILE", "REPEAT", "UNTIL", "END_REPEAT", "EXIT",
		"CONTINUE", "RETURN", "EXECUTE", "END_EXECUTE", "JMP",
	};

	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++)
		if (ascii_is(words[i], name, strlen(name)))
			return true;
	return false;
}

const char *w_name(struct writing *w, const char *wish)
{
	const char *base = foreign_name(w->arena, wish, LIMIT_NAME - 24), *name = base;

	if (reserved_fault(base) != DIAG_COUNT || begins_statement(base))
		base = name = w_text(w, "%s_", base);
	if (reserved_fault(base) != DIAG_COUNT)
		base = name = w_text(w, "N%s", base);
	while (!claim(w, name) && !w->arena->failed)
		name = w_text(w, "%s_%d", base, number_behind(w, base));
	return name;
}

/* ---- comments and literals ---- */

const char *w_clean(struct writing *w, const char *text)
{
	char *copy = arena_copy(w->arena, text, strlen(text));

	for (char *at = copy; at && *at; at++)
		if ((unsigned char)*at < ' ' || *at == 127)
			*at = ' ';
		else if (at > copy && ((*at == ')' && at[-1] == '*') || (*at == '*' && at[-1] == '(')))
			*at = '.';
	return copy ? copy : "";
}

void w_comment(struct writing *w, const char *indent, const char *text)
{
	while (*text) {
		const size_t len = strcspn(text, "\r\n");
		const char *line = arena_copy(w->arena, text, len);

		if (line && line[strspn(line, " \t")])
			w_put(w, "%s(* %s *)\n", indent, w_clean(w, line));
		text += len;
		text += strspn(text, "\r\n");
	}
}

const char *w_string(struct writing *w, const char *text, size_t most)
{
	size_t len = strlen(text), out = 0;
	char *literal;

	while (len > most || (len < strlen(text) && ((unsigned char)text[len] & 0xc0) == 0x80))
		len--;
	literal = arena_alloc(w->arena, 2 * len + 3);
	if (!literal)
		return "''";
	literal[out++] = '\'';
	for (size_t i = 0; i < len; i++) {
		if (text[i] == '\'' || text[i] == '$')
			literal[out++] = '$';
		literal[out++] = (unsigned char)text[i] < ' ' ? ' ' : text[i];
	}
	literal[out++] = '\'';
	return literal;
}

const char *foreign_utf8(struct arena *arena, const char *text, size_t len)
{
	size_t bad = 0, out = 0;
	char *copy;

	if (utf8_valid(text, len, &bad))
		return arena_copy(arena, text, len);
	copy = arena_alloc(arena, 2 * len + 1);
	for (size_t i = 0; copy && i < len; i++) {
		const unsigned char byte = (unsigned char)text[i];

		if (byte < 0x80) {
			copy[out++] = text[i];
		} else if (byte < 0xa0) {
			copy[out++] = '?';
		} else {
			copy[out++] = (char)(0xc0 | byte >> 6);
			copy[out++] = (char)(0x80 | (byte & 0x3f));
		}
	}
	return copy;
}

/* SPDX-License-Identifier: MIT
 *
 * codesys - the text that CODESYS 2.3 exports (.EXP).
 *
 * It is IEC text with headings in comments. Between POUs stand parts that are none: libraries,
 * pictures, the configuration of a controller. They are left out. A POU whose body is drawn
 * cannot be read: an error names its line.
 */
#include "engine/exchange/iec_file/iec_file_parts.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/limits.h"

#include <string.h>

bool codesys_is(const char *bytes, size_t len)
{
	static const char begin[] = "(* @";
	size_t at = len >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;

	while (at < len && bytes[at] && strchr(" \t\r\n", bytes[at]))
		at++;
	return (len - at >= strlen(begin) && !memcmp(bytes + at, begin, strlen(begin))) ||
	       (len - at > 8 && !memcmp(bytes + at, "LIBRARY", 7) && strchr("\r\n", bytes[at + 7]));
}

/* What a line begins. */
enum line_kind { LINE_TEXT, LINE_POU, LINE_END, LINE_BODY, LINE_PART };

/* A name at the beginning of a line, @len bytes. */
static enum line_kind kind_of(const char *name, size_t len, bool inside)
{
	static const char *const pous[] = { "PROGRAM", "FUNCTION", "FUNCTION_BLOCK",
					    "FUNCTIONBLOCK", "ACTION" };
	static const char *const parts[] = { "LIBRARY", "VISUALISATION", "TRANSITION",
					     "PLC_CONFIGURATION", "TASK_CONFIGURATION" };
	static const char body[] = "_BODY";

	if (ascii_prefix("END_", name, len))
		return LINE_END;
	for (size_t i = 0; i < sizeof(pous) / sizeof(*pous); i++)
		if (ascii_is(pous[i], name, len))
			return LINE_POU;
	if (*name == '_' && len > strlen(body) && !memcmp(name + len - 5, body, 5))
		return LINE_BODY;
	for (size_t i = 0; !inside && i < sizeof(parts) / sizeof(*parts); i++)
		if (ascii_is(parts[i], name, len))
			return LINE_PART;
	return !inside && *name == '_' ? LINE_PART : LINE_TEXT;
}

static size_t name_length(const char *at, const char *end)
{
	const char *from = at;

	while (at < end && (*at == '_' || ascii_digit(*at) ||
			    (ascii_upper(*at) >= 'A' && ascii_upper(*at) <= 'Z')))
		at++;
	return (size_t)(at - from);
}

/* Puts blanks over [from, to), which keeps the lines. */
static void blank(char *from, const char *to)
{
	for (; from < to; from++)
		if (*from != '\n' && *from != '\r')
			*from = ' ';
}

struct scan {
	struct lex lex;
	char *text;
	struct diag place;
	struct diag_list *diags;
};

/* The start of the line in which the part ends that the line at @at begins: END_… of a drawn body,
 * which stays; the line behind the end of another part. */
static const char *end_of(struct scan *s, const char *at, bool body)
{
	const char *end = s->lex.end;

	while ((at = memchr(at, '\n', (size_t)(end - at)))) {
		const char *line = ++at;
		bool ends;

		s->lex.line++;
		while (line < end && (*line == ' ' || *line == '\t'))
			line++;
		const size_t len = name_length(line, end);

		ends = ascii_prefix("END_", line, len) || ascii_prefix("_END_", line, len) ||
		       ascii_prefix("PLC_END", line, len);
		if (body && ends && ascii_prefix("END_", line, len))
			return at;
		if (!body && kind_of(line, len, false) == LINE_POU)
			return at;
		if (!body && (ends || (end - line >= 4 && !memcmp(line, "(* @", 4) &&
				       !memcmp(line + 4, "NEST", end - line >= 8 ? 4 : 0)))) {
			if (!ends)
				return at;
			at = memchr(line, '\n', (size_t)(end - line));
			s->lex.line++;
			return at ? at + 1 : end;
		}
	}
	return end;
}

/* "FBD" of _FBD_BODY. */
static void leave_out(struct scan *s, enum line_kind kind)
{
	const struct token token = s->lex.token;
	const bool body = kind == LINE_BODY;
	const int skip = body ? 1 : 0, less = body ? 6 : 0;
	const bool action = ascii_is("TRANSITION", token.text, token.len);

	s->place.id = body ? DIAG_OTHER_BODY : action ? DIAG_OBJECT_PART : DIAG_OTHER_PART;
	s->place.line = token.line;
	s->place.column = token.column;
	diag_add(s->diags, s->place, "%.*s", (int)(token.len < 40 ? token.len : 40) - less,
		 token.text + skip);
	const char *end = end_of(s, token.text, body);

	blank(s->text + (token.text - s->text), end);
	s->lex.at = s->lex.line_start = end;
}

void codesys_blank(const char *file, char *text, size_t len, struct diag_list *diags)
{
	struct scan s = { .text = text, .place = { .file = file }, .diags = diags };
	bool inside = false, first = true;

	lex_init(&s.lex, text, len);
	s.lex.newlines = true;
	while (lex_next(&s.lex) != TOKEN_END) {
		const struct token token = s.lex.token;
		enum line_kind kind = LINE_TEXT;

		if (first && token.kind == TOKEN_NAME)
			kind = kind_of(token.text, token.len, inside);
		first = token.kind == TOKEN_NEWLINE;
		if (kind == LINE_POU)
			inside = true;
		else if (kind == LINE_END && !ascii_is("END_VAR", token.text, token.len) &&
			 !ascii_is("END_IF", token.text, token.len))
			inside = inside && !(ascii_is("END_PROGRAM", token.text, token.len) ||
					     ascii_is("END_ACTION", token.text, token.len) ||
					     ascii_prefix("END_FUNCTION", token.text, token.len));
		if (kind != LINE_BODY && kind != LINE_PART)
			continue;
		leave_out(&s, kind);
		first = true;
	}
}

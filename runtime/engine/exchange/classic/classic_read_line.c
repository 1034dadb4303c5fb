/* SPDX-License-Identifier: MIT
 *
 * classic_read_line - lines, numbers and texts of a ClassicLadder project.
 *
 * Ends of lines of both kinds, 8-bit texts, numbers of any length: what comes out is
 * bounded. It knows nothing of what a line means.
 */
#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/exchange/classic/classic_read.h"

#include <stdio.h>

static bool is_blank(char c)
{
	return c == ' ' || c == '\t' || c == '\r';
}

void classic_member_begin(struct classic_reader *reader,
			  const struct classic_member *member)
{
	reader->member = member;
	reader->at = member->text;
	reader->end = member->text + member->len;
	reader->line_number = member->line - 1;
	reader->line = member->text;
	reader->len = 0;
}

bool classic_line_next(struct classic_reader *reader)
{
	/* More errors than are kept: nobody would read them. */
	while (reader->at < reader->end && reader->diags->errors <= LIMIT_DIAGS) {
		const char *line = reader->at;
		size_t left = (size_t)(reader->end - line);
		const char *newline = memchr(line, '\n', left);
		size_t len = newline ? (size_t)(newline - line) : left;

		reader->at = line + len + (newline ? 1 : 0);
		reader->line_number++;
		while (len && is_blank(line[len - 1]))
			len--;
		while (len && is_blank(*line)) {
			line++;
			len--;
		}
		reader->line = line;
		reader->len = len;
		if (len <= CLASSIC_LINE)
			return true;
		classic_fail(reader, DIAG_IMPORT_LONG_LINE, line, 16);
	}
	return false;
}

bool classic_line_told(struct classic_reader *reader)
{
	while (classic_line_next(reader))
		if (reader->len && *reader->line != ';')
			return true;
	return false;
}

const char *classic_line_after(const struct classic_reader *reader, const char *key)
{
	size_t len = ascii_prefix(key, reader->line, reader->len);

	return len ? reader->line + len : NULL;
}

struct classic_place classic_here(const struct classic_reader *reader)
{
	return (struct classic_place){ reader->member->name, reader->line_number };
}

/* A file of a folder is named whole; the member of a container stands in the text. */
bool classic_fail_at(struct classic_reader *reader, enum diag_id id,
		     struct classic_place place, const char *text, size_t len)
{
	struct diag diag = { .id = id, .file = reader->project->file,
			     .line = place.line };
	int shown;

	while (len && is_blank(text[len - 1]))
		len--;
	while (len && is_blank(*text)) {
		text++;
		len--;
	}
	shown = len > LIMIT_ARG ? LIMIT_ARG : (int)len;
	if (diag_severity(id) == SEVERITY_ERROR)
		reader->good = false;
	if (!place.member || !*place.member)
		return diag_add(reader->diags, diag, "%.*s", shown, text);
	return diag_add(reader->diags, diag, "%.40s%s%.*s", place.member,
			len ? ": " : "", shown, text);
}

bool classic_fail(struct classic_reader *reader, enum diag_id id, const char *text,
		  size_t len)
{
	return classic_fail_at(reader, id, classic_here(reader), text, len);
}

void classic_lost(struct classic_reader *reader, const char *text)
{
	report_add(reader->report, (struct report_line){
			.kind = REPORT_LOST, .member = reader->member->name,
			.line = reader->line_number }, "%s", text);
}

const char *classic_text(struct classic_reader *reader, const char *from, size_t len)
{
	bool latin = !utf8_valid(from, len, NULL);
	char *text, *to;

	while (len && is_blank(from[len - 1]))
		len--;
	while (len && is_blank(*from)) {
		from++;
		len--;
	}
	if (!len)
		return "";
	text = to = arena_alloc(reader->arena, len * 2 + 1);
	if (!text)
		return "";
	for (size_t i = 0; i < len; i++) {
		unsigned char byte = (unsigned char)from[i];

		if (byte == '\t')
			*to++ = ' ';
		else if (byte < ' ' || byte == 127 || (latin && byte > 127 && byte < 160))
			*to++ = '?';
		else if (byte < 128 || !latin) {
			*to++ = (char)byte;
		} else {
			*to++ = (char)(0xc0 | byte >> 6);
			*to++ = (char)(0x80 | (byte & 0x3f));
		}
	}
	return text;
}

const char *classic_name(struct classic_reader *reader, const char *from, size_t len,
			 size_t usual)
{
	const char *text = classic_text(reader, from, len);
	size_t bytes = strlen(text);

	if (bytes > LIMIT_NAME) {
		classic_fail(reader, DIAG_NAME_TOO_LONG, text, bytes);
		return "";
	}
	if (usual && bytes > usual)
		classic_fail(reader, DIAG_IMPORT_LONG, text, bytes);
	return text;
}

bool classic_number(const char **at, const char *end, int *out)
{
	const char *p = *at;
	bool minus = false;
	int64_t value = 0;

	while (p < end && is_blank(*p))
		p++;
	if (p < end && (*p == '-' || *p == '+'))
		minus = *p++ == '-';
	if (p == end || !ascii_digit(*p))
		return false;
	for (; p < end && ascii_digit(*p); p++)
		if (value <= INT32_MAX)
			value = value * 10 + (*p - '0');
	while (p < end && is_blank(*p))
		p++;
	if (value > INT32_MAX)
		value = INT32_MAX;
	*out = (int)(minus ? -value : value);
	*at = p;
	return true;
}

bool classic_numbers(struct classic_reader *reader, const char *at, int *out, int least,
		     int max)
{
	const char *end = reader->line + reader->len;
	int count = 0;

	memset(out, 0, (size_t)max * sizeof(*out));
	while (at < end && count < max) {
		if (!classic_number(&at, end, &out[count]))
			break;
		count++;
		if (at == end)
			break;
		if (*at != ',')
			return classic_fail(reader, DIAG_IMPORT_FIELDS, at,
					    (size_t)(end - at));
		at++;
	}
	if (count < least || (at < end && count < max))
		return classic_fail(reader, DIAG_IMPORT_FIELDS, reader->line, reader->len);
	return true;
}

bool classic_in_range(struct classic_reader *reader, int number, int low, int high)
{
	char text[16];

	if (number >= low && number <= high)
		return true;
	snprintf(text, sizeof(text), "%d", number);
	return classic_fail(reader, DIAG_IMPORT_RANGE, text, strlen(text));
}

bool classic_version(struct classic_reader *reader, int known)
{
	const char *at = classic_line_after(reader, "#VER=");
	int version;

	if (!at)
		return true;
	if (!classic_number(&at, reader->line + reader->len, &version))
		return classic_fail(reader, DIAG_IMPORT_FIELDS, reader->line, reader->len);
	if (version > known)
		return classic_fail(reader, DIAG_NEWER_VERSION, reader->line, reader->len);
	return true;
}

void classic_twice(struct classic_reader *reader, struct classic_place place,
		   const char *what, int number)
{
	char text[40];

	snprintf(text, sizeof(text), "%s %d", what, number);
	classic_fail_at(reader, DIAG_IMPORT_TWICE, place, text, strlen(text));
}

/* SPDX-License-Identifier: MIT
 *
 * iec_file - which of the readers of this room a file needs, and text in Windows-1252.
 */
#include "engine/exchange/iec_file/iec_file_parts.h"

#include "engine/base/lex.h"
#include "engine/base/limits.h"

#include <stdlib.h>
#include <string.h>

/* The code points of the bytes 0x80 to 0x9F in Windows-1252; 0: none. */
static const uint16_t high[32] = {
	0x20ac, 0,      0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0x02c6, 0x2030, 0x0160,
	0x2039, 0x0152, 0,      0x017d, 0,      0,      0x2018, 0x2019, 0x201c, 0x201d, 0x2022,
	0x2013, 0x2014, 0x02dc, 0x2122, 0x0161, 0x203a, 0x0153, 0,      0x017e, 0x0178,
};

/* Appends a byte beyond ASCII as UTF-8; returns its bytes. */
static size_t put_byte(unsigned char byte, char *out)
{
	const unsigned int code = byte < 0xa0 ? high[byte - 0x80] : byte;
	size_t len = 0;

	if (!code) {
		out[0] = '?';
		return 1;
	}
	if (code < 0x800) {
		out[len++] = (char)(0xc0 | code >> 6);
	} else {
		out[len++] = (char)(0xe0 | code >> 12);
		out[len++] = (char)(0x80 | (code >> 6 & 0x3f));
	}
	out[len++] = (char)(0x80 | (code & 0x3f));
	return len;
}

/* Where in a text of CODESYS a byte stands. */
struct text_place { int comments; bool text, line; };

static void step(struct text_place *place, const char *at, const char *end)
{
	const char next = end - at > 1 ? at[1] : '\0', last = at[-1];

	if (place->line)
		place->line = *at != '\n';
	else if (place->text)
		place->text = *at != '\'' && *at != '\n';
	else if (*at == '*' && last == '(')
		place->comments++;
	else if (*at == ')' && last == '*' && place->comments)
		place->comments--;
	else if (!place->comments && *at == '\'')
		place->text = true;
	else if (!place->comments && *at == '/' && next == '/')
		place->line = true;
}

/* @out: room for 3 * @len bytes. @exported: a STRING keeps its bytes, as the controllers of
 * CODESYS 2.3 have them. */
static size_t from_windows(const char *text, size_t len, char *out, bool exported)
{
	static const char digit[] = "0123456789ABCDEF";
	struct text_place place = { .comments = 0 };
	size_t at = 0;

	for (size_t i = 0; i < len; i++) {
		const unsigned char byte = (unsigned char)text[i];

		if (exported && i > 0 && !(place.text && text[i - 1] == '$'))
			step(&place, text + i, text + len);
		if (byte < 0x80) {
			out[at++] = text[i];
		} else if (exported && place.text) {
			out[at++] = '$';
			out[at++] = digit[byte >> 4];
			out[at++] = digit[byte & 15];
		} else {
			at += put_byte(byte, out + at);
		}
	}
	return at;
}

/* The text of a file in UTF-8; NULL: no memory. */
static char *text_of(const char *file, const char *bytes, size_t len, size_t *out_len, bool *same,
		     bool exported, struct diag_list *diags)
{
	struct diag place = { .id = DIAG_WINDOWS_TEXT, .file = file };
	char *out;
	size_t bad = 0;

	*same = utf8_valid(bytes, len, &bad) || memchr(bytes, 0, len);
	out = malloc((*same ? len : 3 * len) + 1);
	if (!out)
		return NULL;
	if (*same) {
		memcpy(out, bytes, len);
		*out_len = len;
	} else {
		*out_len = from_windows(bytes, len, out, exported);
		place.line = 1;
		for (size_t i = 0; i < bad; i++)
			place.line += bytes[i] == '\n';
		diag_add(diags, place, "%s", "");
	}
	out[*out_len] = '\0';
	return out;
}

static bool no_memory(struct diag_list *diags, struct diag place)
{
	place.id = DIAG_NO_MEMORY;
	return diag_add(diags, place, "%s", "");
}

static bool open_twincat(struct diag place, const struct text_file *files, int count, int at,
			 char **out, size_t *out_len, struct diag_list *diags)
{
	const int errors = diags->errors;

	*out = malloc(2 * files[at].len + 64);
	if (!*out)
		return no_memory(diags, place);
	*out_len = twincat_text(place.file, files[at].text, files[at].len, *out, diags);
	twincat_blank_lists(files, count, *out, *out_len);
	if (diags->errors == errors)
		return true;
	free(*out);
	*out = NULL;
	return false;
}

/* Tells what a file is that is no IEC text; true: the reader tells it. */
static bool refuse(struct diag place, const char *bytes, size_t len, struct diag_list *diags)
{
	const char *arg = "";
	struct lex lex;

	lex_init(&lex, bytes, len);
	lex_next(&lex);
	if (lex_is(&lex, "RUNGBOARD"))
		return true;
	place.id = stranger_find(bytes, len, &arg);
	return place.id == DIAG_COUNT || diag_add(diags, place, "%s", arg);
}

bool iec_file_text(const struct text_file *files, int count, int at, char **out, size_t *out_len,
		   struct diag_list *diags)
{
	const char *file = files[at].name, *bytes = files[at].text;
	const size_t len = files[at].len;
	const struct diag place = { .file = file };
	const bool exported = codesys_is(bytes, len);
	bool same = true;

	*out = NULL;
	if (len > LIMIT_TEXT || utf16_text(bytes, len))
		return true; /* the reader tells it */
	if (twincat_is(bytes, len))
		return open_twincat(place, files, count, at, out, out_len, diags);
	if (!exported && (!text_is_plain(bytes, len) || stranger_is_siemens(bytes, len)))
		return refuse(place, bytes, len, diags);
	*out = text_of(file, bytes, len, out_len, &same, exported, diags);
	if (!*out)
		return no_memory(diags, place);
	if (exported)
		codesys_blank(file, *out, *out_len, diags);
	if (exported || !same)
		return true;
	free(*out);
	*out = NULL;
	return true;
}

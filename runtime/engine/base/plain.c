/* SPDX-License-Identifier: MIT
 *
 * plain - steps through text one character at a time; see plain.h.
 */
#include "engine/base/plain.h"

#include "engine/base/lex.h"

#include <string.h>

/* Bytes of the character at @text; *@odd: control or broken, one byte then, but
 * for the controls of U+0080 … U+009F, which have two. */
static size_t character(const char *text, size_t len, bool *odd)
{
	unsigned char first = (unsigned char)text[0];
	size_t size = first < 0x80 ? 1 : first < 0xe0 ? 2 :
		      first < 0xf0 ? 3 : 4;

	*odd = first < 0x20 || first == 0x7f;
	if (*odd || size == 1)
		return 1;
	if (size > len || !utf8_valid(text, size, NULL)) {
		*odd = true;
		return 1;
	}
	*odd = first == 0xc2 && (unsigned char)text[1] < 0xa0;
	return size;
}

size_t plain_clip(const char *text, size_t len, int columns, int *width)
{
	size_t at = 0;

	*width = 0;
	while (at < len) {
		bool odd;
		size_t size = character(text + at, len - at, &odd);
		int wide = odd ? 1 : utf8_width(text + at, size);

		if (*width + wide > columns)
			break;
		*width += wide;
		at += size;
	}
	return at;
}

void plain_write(const struct sink *sink, const char *text, size_t len)
{
	size_t plain = 0, at = 0;

	while (at < len) {
		bool odd;
		size_t size = character(text + at, len - at, &odd);

		if (odd) {
			sink_write(sink, text + plain, at - plain);
			sink_text(sink, strchr("\t\n\r", text[at]) ? " " : "?");
			plain = at + size;
		}
		at += size;
	}
	sink_write(sink, text + plain, len - plain);
}

void plain_text(const struct sink *sink, const char *text)
{
	plain_write(sink, text, strlen(text));
}

static bool is_blank(char c)
{
	return c == ' ' || c == '\t' || c == '\r';
}

static bool starts(const char *text, size_t len, const char *mark)
{
	return len >= 2 && memcmp(text, mark, 2) == 0;
}

const char *plain_comment_line(const char **at, size_t *len)
{
	while (**at) {
		const char *line = *at;
		size_t size = strcspn(line, "\n");

		*at = line + size + (line[size] == '\n');
		while (size > 0 && is_blank(*line))
			line++, size--;
		if (starts(line, size, "(*") || starts(line, size, "//"))
			line += 2, size -= 2;
		while (size > 0 && is_blank(line[size - 1]))
			size--;
		if (size >= 2 && starts(line + size - 2, 2, "*)"))
			size -= 2;
		while (size > 0 && is_blank(line[size - 1]))
			size--;
		while (size > 0 && is_blank(*line))
			line++, size--;
		*len = size;
		if (size > 0)
			return line;
	}
	return NULL;
}

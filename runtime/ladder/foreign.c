/* SPDX-License-Identifier: MIT
 *
 * foreign - control characters of ASCII and of Unicode (U+0080 to U+009F) become ?.
 */
#include "ladder/foreign.h"

#include <string.h>

/* Bytes of the control character at @text; 0: it is none. */
static size_t control(const char *text, size_t len)
{
	const unsigned char byte = (unsigned char)*text;

	if (byte < ' ' || byte == 127)
		return 1;
	return byte == 0xc2 && len > 1 && ((unsigned char)text[1] & 0xe0) == 0x80 ? 2 : 0;
}

void foreign_write(const struct sink *out, const char *text, size_t len)
{
	size_t from = 0;

	for (size_t at = 0; at < len;) {
		const size_t bytes = control(text + at, len - at);

		if (!bytes) {
			at++;
			continue;
		}
		sink_write(out, text + from, at - from);
		sink_text(out, "?");
		at += bytes;
		from = at;
	}
	sink_write(out, text + from, len - from);
}

void foreign_text(const struct sink *out, const char *text)
{
	foreign_write(out, text, strlen(text));
}

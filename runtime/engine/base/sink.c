/* SPDX-License-Identifier: MIT
 *
 * sink - writes text, numbers and JSON to a sink.
 */
#include "engine/base/sink.h"

#include "engine/base/lex.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void sink_mark(const struct sink *sink, int kind, int number, bool begins)
{
	if (sink->mark)
		sink->mark(sink->context, kind, number, begins);
}

void sink_write(const struct sink *sink, const char *text, size_t len)
{
	if (len > 0)
		sink->write(sink->context, text, len);
}

void sink_text(const struct sink *sink, const char *text)
{
	sink_write(sink, text, strlen(text));
}

void sink_repeat(const struct sink *sink, const char *text, int count)
{
	size_t len = strlen(text);

	for (int i = 0; i < count; i++)
		sink_write(sink, text, len);
}

void sink_printf(const struct sink *sink, const char *format, ...)
{
	char buffer[500];
	va_list list;

	va_start(list, format);
	int len = vsnprintf(buffer, sizeof(buffer), format, list);
	va_end(list);
	if (len < 0)
		return;
	if (len >= (int)sizeof(buffer))
		len = (int)sizeof(buffer) - 1;
	sink_write(sink, buffer, (size_t)len);
}

/* The escape of a character in JSON (RFC 8259 chapter 7); NULL: it needs none. */
static const char *json_escape(unsigned char byte)
{
	switch (byte) {
	case '"':
		return "\\\"";
	case '\\':
		return "\\\\";
	case '\n':
		return "\\n";
	case '\r':
		return "\\r";
	case '\t':
		return "\\t";
	default:
		return NULL;
	}
}

static void json_valid(const struct sink *sink, const char *text, size_t len)
{
	size_t plain = 0;

	for (size_t i = 0; i < len; i++) {
		unsigned char byte = (unsigned char)text[i];
		const char *escape = json_escape(byte);

		if (!escape && byte >= 0x20 && byte != 0x7f)
			continue;
		sink_write(sink, text + plain, i - plain);
		plain = i + 1;
		if (escape)
			sink_text(sink, escape);
		else
			sink_printf(sink, "\\u%04x", byte);
	}
	sink_write(sink, text + plain, len - plain);
}

void sink_json_string(const struct sink *sink, const char *text, size_t len)
{
	size_t bad = 0;

	sink_text(sink, "\"");
	while (len > 0 && !utf8_valid(text, len, &bad)) {
		json_valid(sink, text, bad);
		/* utf8_valid() refuses NUL, but JSON can express it. */
		sink_text(sink, text[bad] ? "\\ufffd" : "\\u0000");
		text += bad + 1;
		len -= bad + 1;
	}
	json_valid(sink, text, len);
	sink_text(sink, "\"");
}

void sink_json_text(const struct sink *sink, const char *text)
{
	if (text)
		sink_json_string(sink, text, strlen(text));
	else
		sink_text(sink, "null");
}

void sink_memory_init(struct sink_memory *memory)
{
	*memory = (struct sink_memory){ 0 };
}

void sink_memory_free(struct sink_memory *memory)
{
	free(memory->text);
	sink_memory_init(memory);
}

static void append(void *context, const char *text, size_t len)
{
	struct sink_memory *memory = context;

	if (memory->failed)
		return;
	if (len >= memory->size - memory->len) {
		size_t size = memory->size ? memory->size : 256;

		while (size - memory->len <= len && size <= SIZE_MAX / 2)
			size *= 2;
		char *grown = size - memory->len > len ?
			      realloc(memory->text, size) : NULL;
		if (!grown) {
			memory->failed = true;
			return;
		}
		memory->text = grown;
		memory->size = size;
	}
	memcpy(memory->text + memory->len, text, len);
	memory->len += len;
	memory->text[memory->len] = '\0';
}

struct sink sink_to_memory(struct sink_memory *memory)
{
	return (struct sink){ .write = append, .context = memory };
}

const char *sink_memory_text(const struct sink_memory *memory)
{
	return memory->text ? memory->text : "";
}

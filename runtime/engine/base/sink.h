/* SPDX-License-Identifier: MIT
 *
 * sink - the destination of text that the library writes.
 *
 * The library prints nothing itself. A caller passes a sink (stdout, a file, memory)
 * and handles failed writes in it.
 */
#ifndef BASE_SINK_H
#define BASE_SINK_H

#include <stdbool.h>
#include <stddef.h>

struct sink {
	/** Takes @len bytes; any bytes, in pieces of any size. */
	void (*write)(void *context, const char *text, size_t len);
	void *context;
	/** NULL, or called where a part of the text begins and ends; @kind and @number
	 * are the writer's. */
	void (*mark)(void *context, int kind, int number, bool begins);
};

/** sink_mark - marks where a part of the text begins or ends. */
void sink_mark(const struct sink *sink, int kind, int number, bool begins);
/** sink_write - @len bytes. Scan-safe: as the sink's function. So are all. */
void sink_write(const struct sink *sink, const char *text, size_t len);
/** sink_text - a NUL-ended string. */
void sink_text(const struct sink *sink, const char *text);
/** sink_repeat - a string @count times; nothing if @count is 0 or less. */
void sink_repeat(const struct sink *sink, const char *text, int count);
/**
 * sink_printf - formatted text
 *
 * For numbers and short words: what is longer than 500 bytes is cut. Names and
 * other text of a user's file go through sink_text or %.*s with a small bound.
 */
void sink_printf(const struct sink *sink, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/** sink_json_string - @len bytes of @text as a JSON string with its quotes;
 * bytes that are not UTF-8 become U+FFFD. */
void sink_json_string(const struct sink *sink, const char *text, size_t len);
/** sink_json_text - the same of a NUL-ended string; NULL gives null. */
void sink_json_text(const struct sink *sink, const char *text);

/* A sink that grows in memory, for tests and for comparing. */
struct sink_memory {
	char *text;   /* NUL-ended; NULL: nothing was written yet             */
	size_t len, size;
	bool failed;  /* memory ran out: the text is incomplete               */
};

/** sink_memory_init - empty. Give it back with sink_memory_free. */
void sink_memory_init(struct sink_memory *memory);
void sink_memory_free(struct sink_memory *memory);
/** sink_to_memory - the sink that appends to @memory, which must outlive it. */
struct sink sink_to_memory(struct sink_memory *memory);
/** sink_memory_text - what was written, NUL-ended; "" when nothing was. */
const char *sink_memory_text(const struct sink_memory *memory);

#endif

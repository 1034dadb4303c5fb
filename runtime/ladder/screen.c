/* SPDX-License-Identifier: MIT
 *
 * screen - frames of text with ECMA-48 sequences that all terminals know, so no terminal
 * database is needed.
 */
#include "ladder/screen.h"

#include "engine/base/lex.h"

#include <string.h>

static void add(struct screen *screen, const char *text, size_t len)
{
	struct sink sink = sink_to_memory(&screen->frame);

	sink_write(&sink, text, len);
}

static void add_text(struct screen *screen, const char *text)
{
	add(screen, text, strlen(text));
}

void screen_begin(struct screen *screen, int width, int height)
{
	screen->frame.len = 0;
	screen->width = width;
	screen->height = height;
	screen->row = screen->col = 0;
	screen->limit = width;
	add_text(screen, "\033[H");
}

void screen_free(struct screen *screen)
{
	sink_memory_free(&screen->frame);
}

/* Length of the character at @text in bytes; 0: it is not printable. */
static size_t char_len(const char *text, size_t left)
{
	unsigned char c = (unsigned char)*text;
	size_t len = c < 0x80 ? 1 : c < 0xe0 ? 2 : c < 0xf0 ? 3 : 4;

	if (c < 0x20 || c == 0x7f || len > left || !utf8_valid(text, len, NULL))
		return 0;
	return len;
}

void screen_put(struct screen *screen, enum style style, const char *text)
{
	static const char *const sequence[] = {
		[STYLE_PLAIN] = "", [STYLE_BOLD] = "\033[1m",
		[STYLE_DIM] = "\033[2m", [STYLE_GOOD] = "\033[1;32m",
		[STYLE_BAD] = "\033[1;31m", [STYLE_TITLE] = "\033[7m",
	};
	size_t len = strlen(text), at = 0;
	bool styled = screen->colour && style != STYLE_PLAIN;

	if (screen->row >= screen->height)
		return;
	if (styled)
		add_text(screen, sequence[style]);
	while (at < len) {
		size_t bytes = char_len(text + at, len - at);
		int width = bytes ? utf8_width(text + at, bytes) : 1;

		if (screen->col + width > screen->limit)
			break;
		add(screen, bytes ? text + at : "?", bytes ? bytes : 1);
		screen->col += width;
		at += bytes ? bytes : 1;
	}
	if (styled)
		add_text(screen, "\033[0m");
}

void screen_column(struct screen *screen, int col, int limit)
{
	screen->limit = screen->width;
	while (screen->col < col && screen->col < screen->width &&
	       screen->row < screen->height) {
		add_text(screen, " ");
		screen->col++;
	}
	if (limit < screen->width)
		screen->limit = limit;
}

bool screen_line(struct screen *screen)
{
	screen->limit = screen->width;
	if (screen->row + 1 >= screen->height) {
		screen->row = screen->height;
		return false;
	}
	add_text(screen, "\033[K\r\n");
	screen->row++;
	screen->col = 0;
	return true;
}

void screen_end(struct screen *screen)
{
	/* After a full last row, clearing would erase its last character. */
	if (screen->col < screen->width)
		add_text(screen, "\033[J");
}

/* SPDX-License-Identifier: MIT
 *
 * screen - one frame of text for a terminal, clipped to its size.
 *
 * Text is put from left to right and top to bottom. Text that does not fit is cut, not
 * wrapped. A frame is one block of bytes. It reads no keys.
 */
#ifndef LADDER_SCREEN_H
#define LADDER_SCREEN_H

#include "engine/base/sink.h"

enum style { STYLE_PLAIN, STYLE_BOLD, STYLE_DIM, STYLE_GOOD, STYLE_BAD,
	     STYLE_TITLE };

struct screen {
	struct sink_memory frame;
	int width, height;
	int row, col;         /* 0-based, where the next text goes            */
	int limit;            /* column that text must not reach              */
	bool colour;
};

/** screen_begin - starts an empty frame of this size. Owns: screen_free(). */
void screen_begin(struct screen *screen, int width, int height);
void screen_free(struct screen *screen);
/** screen_put - puts text; bytes that are no printable UTF-8 become `?`. */
void screen_put(struct screen *screen, enum style style, const char *text);
/** screen_column - puts blanks up to column @col; text is then cut at @limit. */
void screen_column(struct screen *screen, int col, int limit);
/** screen_line - starts the next row. False: there is none, and nothing more is put. */
bool screen_line(struct screen *screen);
/** screen_end - clears the rest of the screen. The frame is then in screen->frame. */
void screen_end(struct screen *screen);
#endif

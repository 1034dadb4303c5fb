/* SPDX-License-Identifier: MIT
 *
 * screen - one frame of text for a terminal, clipped to its size.
 *
 * Rows are put from left to right and top to bottom; what does not fit is left
 * out, never wrapped. A frame is one block of bytes. It reads no keys.
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

/** screen_begin - an empty frame of this size. Give it back by screen_free. */
void screen_begin(struct screen *screen, int width, int height);
void screen_free(struct screen *screen);
/** screen_put - any bytes; what is no printable UTF-8 is shown as `?`. */
void screen_put(struct screen *screen, enum style style, const char *text);
/** screen_column - blanks up to column @col; text then ends before @limit. */
void screen_column(struct screen *screen, int col, int limit);
/** screen_line - the next row. False: there is none; put nothing more. */
bool screen_line(struct screen *screen);
/** screen_end - clears what is below. The frame is then in screen->frame. */
void screen_end(struct screen *screen);
#endif

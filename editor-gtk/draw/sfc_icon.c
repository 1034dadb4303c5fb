/* SPDX-License-Identifier: MIT
 *
 * sfc_icon - the tools of a chart as strokes; see sfc_icon.h.
 */
#include "editor-gtk/draw/sfc_icon.h"

#define BOX_WIDTH  24 /* px, of a step                                        */
#define BOX_HEIGHT 16
#define STUB       7  /* px of a line above and below a box                   */
#define APART      11 /* px from the middle to a branch                       */
#define BAR        6  /* px, half of the bar of a transition                  */

struct pen {
	struct picture *picture;
	float width;
	float x, y;            /* the middle                                  */
};

static void line(const struct pen *pen, float x1, float y1, float x2, float y2)
{
	picture_line(pen->picture, TOKEN_INK, STROKE_SOLID, pen->width, pen->x + x1, pen->y + y1,
		     pen->x + x2, pen->y + y2);
}

static void frame(const struct pen *pen, float x, float y, float w, float h)
{
	picture_frame(pen->picture, TOKEN_INK, STROKE_SOLID, pen->width, pen->x + x, pen->y + y,
		      w, h);
}

static void step(const struct pen *pen)
{
	frame(pen, -BOX_WIDTH / 2.0f, -BOX_HEIGHT / 2.0f, BOX_WIDTH, BOX_HEIGHT);
	line(pen, 0, -BOX_HEIGHT / 2.0f - STUB, 0, -BOX_HEIGHT / 2.0f);
	line(pen, 0, BOX_HEIGHT / 2.0f, 0, BOX_HEIGHT / 2.0f + STUB);
}

/* A line down with the bar of a transition. */
static void way(const struct pen *pen, float x, float from, float to)
{
	const float bar = (from + to) / 2;

	line(pen, x, from, x, to);
	picture_line(pen->picture, TOKEN_INK, STROKE_SOLID, 2 * pen->width, pen->x + x - BAR,
		     pen->y + bar, pen->x + x + BAR, pen->y + bar);
}

static void twin_line(const struct pen *pen, float y)
{
	line(pen, -APART - 6, y, APART + 6, y);
	line(pen, -APART - 6, y + 3, APART + 6, y + 3);
}

static void alternative(const struct pen *pen)
{
	line(pen, -APART, -7, APART, -7);
	line(pen, 0, -14, 0, -7);
	way(pen, -APART, -7, 13);
	way(pen, APART, -7, 13);
}

static void simultaneous(const struct pen *pen)
{
	line(pen, 0, -14, 0, -5);
	twin_line(pen, -5);
	line(pen, -APART, -2, -APART, 12);
	line(pen, APART, -2, APART, 12);
}

static void jump(const struct pen *pen)
{
	way(pen, -6, -14, 0);
	line(pen, -6, 0, -6, 9);
	line(pen, -6, 9, 10, 9);
	line(pen, 10, 9, 4, 5);
	line(pen, 10, 9, 4, 13);
}

static void wait(const struct pen *pen)
{
	line(pen, -APART, -14, -APART, -6);
	line(pen, APART, -14, APART, -6);
	twin_line(pen, -6);
	way(pen, 0, -3, 13);
}

static void action(const struct pen *pen, enum sfc_tool tool, struct lettering *lettering)
{
	const struct lettered text = lettering_fit(lettering, LETTER_TYPE, sfc_tool_name(tool), -1,
						   0);

	frame(pen, -24, -10, 22, 20);
	frame(pen, -2, -10, 26, 20);
	picture_text(pen->picture, TOKEN_INK, LETTER_TYPE, text, pen->x - 13 - text.width / 2,
		     pen->y + 4);
	line(pen, 3, 0, 18, 0);
}

void sfc_icon_draw(enum sfc_tool tool, const struct theme *theme, struct lettering *lettering,
		   float width, float height, struct picture *picture)
{
	const struct pen pen = { picture, theme->shape_width, width / 2, height / 2 };

	switch ((int)tool) {
	case TOOL_STEP: step(&pen); break;
	case TOOL_INITIAL:
		step(&pen);
		frame(&pen, -BOX_WIDTH / 2.0f + 3, -BOX_HEIGHT / 2.0f + 3, BOX_WIDTH - 6,
		      BOX_HEIGHT - 6);
		break;
	case TOOL_MACRO:
		step(&pen);
		line(&pen, -BOX_WIDTH / 2.0f, -4, BOX_WIDTH / 2.0f, -4);
		line(&pen, -BOX_WIDTH / 2.0f, 4, BOX_WIDTH / 2.0f, 4);
		break;
	case TOOL_TRANSITION: way(&pen, 0, -14, 14); break;
	case TOOL_ALTERNATIVE: alternative(&pen); break;
	case TOOL_SIMULTANEOUS: simultaneous(&pen); break;
	case TOOL_JUMP: jump(&pen); break;
	case TOOL_WAIT: wait(&pen); break;
	default: action(&pen, tool, lettering); break;
	}
}

/* SPDX-License-Identifier: MIT
 *
 * drawn - what the tests of drawings share: a rung becomes strokes, and strokes are
 * looked at: does anything lie over anything else?
 */
#ifndef TESTS_EDITOR_DRAWN_H
#define TESTS_EDITOR_DRAWN_H

#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/draw/sheet.h"
#include "engine/ladder.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A project from a file, or from @text if it is not NULL; NULL: it has errors, which are
 * printed. */
static inline struct ladder *drawn_load(const char *file, const char *text)
{
	struct ladder *ladder = ladder_new();
	bool good = text ? ladder_load_text(ladder, file, text, strlen(text)) :
			   ladder_load(ladder, file);
	const struct diag_list *diags = ladder_diags(ladder);
	char line[400];

	for (int i = 0; i < diags->count && !good; i++) {
		diag_print(&diags->diag[i], line, sizeof(line));
		printf("# %s\n", line);
	}
	if (good)
		return ladder;
	ladder_free(ladder);
	return NULL;
}

struct area { float x, y, right, bottom; };

/* The area of a text's ink: digits and capitals have about seven tenths of the font size. */
static inline struct area ink_of(const struct stroke *s)
{
	float size = letter_style(s->letter)->size;

	return (struct area){ s->x + 0.5f, s->y - 0.7f * size, s->x + s->w - 0.5f,
			      s->y + 0.15f * size };
}

static inline bool meet(struct area a, struct area b)
{
	return a.x < b.right && b.x < a.right && a.y < b.bottom && b.y < a.bottom;
}

static inline bool crosses(struct area ink, const struct stroke *s)
{
	float half = s->width / 2;

	if (s->kind == STROKE_LINE) /* of slanting ones only the middle counts       */
		return meet(ink, s->x == s->w || s->y == s->h ?
			(struct area){ fminf(s->x, s->w) - half, fminf(s->y, s->h) - half,
				       fmaxf(s->x, s->w) + half,
				       fmaxf(s->y, s->h) + half } :
			(struct area){ (s->x + s->w) / 2, (s->y + s->h) / 2,
				       (s->x + s->w) / 2, (s->y + s->h) / 2 });
	if (s->kind == STROKE_WAVE)
		return meet(ink, (struct area){ s->x, s->y, s->x + s->w, s->y + 3 });
	if (s->kind != STROKE_FRAME || s->style != STROKE_SOLID ||
	    s->token == TOKEN_ACCENT || s->token == TOKEN_COMMENT)
		return false;
	struct area out = { s->x, s->y, s->x + s->w, s->y + s->h };
	bool inside = ink.x >= out.x + s->width && ink.right <= out.right - s->width &&
		      ink.y >= out.y + s->width && ink.bottom <= out.bottom - s->width;
	return meet(ink, out) && !inside;
}

/* Texts over texts, texts over lines of shapes and wires, texts outside of the strip: each
 * is printed as a comment. Returns how many. */
static inline int drawn_faults(const struct picture *picture, float width, float height,
		 const char *where)
{
	int faults = 0;

	for (int i = 0; i < picture->count; i++) {
		const struct stroke *text = &picture->stroke[i];

		if (text->kind != STROKE_TEXT)
			continue;
		struct area ink = ink_of(text);
		bool outside = ink.x < 0 || ink.y < 0 || ink.right > width ||
			       ink.bottom > height;
		if (outside)
			printf("# %s: \"%s\" stands outside\n", where, text->text);
		faults += outside;
		for (int k = 0; k < picture->count; k++) {
			const struct stroke *other = &picture->stroke[k];
			bool over = other->kind == STROKE_TEXT ?
				k > i && meet(ink, ink_of(other)) : crosses(ink, other);

			if (over)
				printf("# %s: \"%s\" over %s at %g %g\n", where, text->text,
				       other->text ? other->text :
				       token_name(other->token), (double)other->x,
				       (double)other->y);
			faults += over;
		}
	}
	return faults;
}

/* All rungs of a sheet, each looked at; @full: with every mark at every cell, with power
 * and values. Returns the faults. */
static inline bool drawn_value(void *context, int row, int col, struct live_value *out)
{
	(void)context;
	(void)row;
	(void)col;
	snprintf(out->text, sizeof(out->text), "3.2 s / 5 s");
	out->part = 0.5f;
	return true;
}

static inline int drawn_sheet(struct sheet *sheet, bool full, const char *where)
{
	int faults = 0;

	for (int i = 0; i < sheet->count; i++) {
		struct rung_layout *layout = sheet->rung[i];
		int cells = layout->rung->rows * layout->rung->cols;
		int marks = layout->rows * layout->columns;
		uint8_t *cell = g_malloc((gsize)cells);
		struct grid_mark *mark = g_new(struct grid_mark, marks);
		struct grid_live live = { cell, drawn_value, NULL };
		struct grid_scene scene = { .drafting = &sheet->drafting, .layout = layout,
					    .theme = theme_get(THEME_LIGHT, THEME_GREEN) };
		struct picture picture;
		char name[200];

		memset(cell, LIVE_KNOWN | LIVE_IN | LIVE_OUT | LIVE_CLOSED, (size_t)cells);
		for (int m = 0; m < marks; m++) {
			int row = m / layout->columns, column = m % layout->columns;
			int col = rung_layout_col(layout, row, column);
			enum place place = col < 0 ? PLACE_NONE :
				word_row(rung_at(layout->rung, row, col)->word)->place;

			mark[m] = (struct grid_mark){ row, column, MARK_ERROR };
			if (place == PLACE_PIN) /* its box has them             */
				mark[m].marks = 0;
			if (place == PLACE_SERIES || place == PLACE_LAST)
				mark[m].marks |= MARK_FORCED | MARK_CHANGED;
			if (place == PLACE_LAST)
				mark[m].marks |= MARK_TWICE;
		}
		if (full) {
			scene.live = &live;
			scene.mark = mark;
			scene.mark_count = marks;
			scene.state = RUNG_CURRENT | RUNG_EDITED | RUNG_CHANGED;
		}
		snprintf(name, sizeof(name), "%s rung %d", where, i + 1);
		picture_init(&picture);
		grid_draw(&scene, &picture);
		faults += drawn_faults(&picture, rung_layout_width(layout), layout->height,
				       name);
		picture_clear(&picture);
		g_free(cell);
		g_free(mark);
	}
	return faults;
}

#endif

/* SPDX-License-Identifier: MIT
 *
 * strips - what a sheet of rungs has drawn: how many rungs anew, and a cell as it shows it.
 */
#ifndef TESTS_EDITOR_STRIPS_H
#define TESTS_EDITOR_STRIPS_H

#include "editor-gtk/ladder/grid_view_inside.h"

/* The drawings that were seen last, one a rung. Begins as NULL. */
typedef GPtrArray StripsSeen;

static inline void strip_unref(gpointer node)
{
	if (node)
		gsk_render_node_unref(node);
}

/** strips_redrawn - how many rungs have another drawing than at the last call. */
static inline guint strips_redrawn(LadderGridView *view, StripsSeen **seen)
{
	guint count = 0;

	if (!*seen)
		*seen = g_ptr_array_new_with_free_func(strip_unref);
	for (guint i = 0; i < view->strips->len; i++) {
		GskRenderNode *node = strip_of(view, (int)i)->node;

		if (i >= (*seen)->len)
			g_ptr_array_add(*seen, NULL);
		if (!node || node == (*seen)->pdata[i])
			continue;
		count++;
		strip_unref((*seen)->pdata[i]);
		(*seen)->pdata[i] = gsk_render_node_ref(node);
	}
	return count;
}

/** strip_live - the LIVE_… bits of a cell, and the text of its value, or ""; false: none is shown.
 * @text: 48 bytes */
static inline bool strip_live(LadderGridView *view, int rung, int row, int col, unsigned int *bits,
			      char *text)
{
	const struct live_rung *live = live_rung_of(view, rung);
	struct live_value value = { .text = "" };

	if (!live || row < 0 || row >= live->rows || col < 0 || col >= live->cols)
		return false;
	*bits = live->bits[row * live->cols + col];
	live_rung_value((void *)live, row, col, &value);
	g_strlcpy(text, value.text, sizeof(value.text));
	return true;
}

#endif

/* SPDX-License-Identifier: MIT
 *
 * tile - a tile of a palette: a drawn picture, a name, its key; it is clicked or dragged.
 */
#ifndef EDITOR_TILE_H
#define EDITOR_TILE_H

#include "editor-gtk/kit/picture.h"

#include <gtk/gtk.h>

struct tile {
	const char *name;        /* below the picture                           */
	const char *told;        /* what it does                                */
	const char *key;         /* "F5"; "": none                             */
	/* Draws it in the middle of @width x @height px. */
	void (*draw)(const struct tile *tile, const struct theme *theme,
		     struct lettering *lettering, float width, float height,
		     struct picture *picture);
	const void *of;          /* for draw(); lives as long as the tile         */
	const char *action;      /* activated by a click, with @id                */
	GdkContentProvider *(*drag)(int id); /* what is dragged                 */
	int id;
};

/** tile_new - @tile: copied, without its texts. */
GtkWidget *tile_new(const struct tile *tile);
/** tile_with - @tile with a button that opens @menu: more of its kind.
 * @menu: taken over. */
GtkWidget *tile_with(GtkWidget *tile, const char *name, GMenu *menu);

#endif

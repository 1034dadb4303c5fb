/* SPDX-License-Identifier: MIT
 *
 * sheet_window - the toolkit, a document and an empty window for tests of sheets.
 */
#ifndef TESTS_EDITOR_SHEET_WINDOW_H
#define TESTS_EDITOR_SHEET_WINDOW_H

#include "editor-gtk/document/document.h"
#include "editor-gtk/window/app.h"
#include "tests/editor/screen.h"

#include <adwaita.h>
#include <gtksourceview/gtksource.h>
#include <string.h>

/**
 * sheet_window - starts the toolkit on a screen of its own and shows a window with an empty box
 * @text:   the project of @document
 * @window: set to the window
 *
 * Owns: the caller frees both. NULL, with the plan of a skipped test: there is no screen.
 */
static inline LadderDocument *sheet_window(const char *text, int width, int height, GtkWidget **window)
{
	LadderDocument *document;

	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return NULL;
	}
	adw_init();
	gtk_source_init();
	app_style();
	document = ladder_document_new();
	ladder_document_open_text(document, NULL, text, strlen(text), true);
	*window = gtk_window_new();
	gtk_window_set_default_size(GTK_WINDOW(*window), width, height);
	gtk_window_set_child(GTK_WINDOW(*window), gtk_box_new(GTK_ORIENTATION_VERTICAL, 0));
	screen_show(*window);
	return document;
}

#endif

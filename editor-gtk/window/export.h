/* SPDX-License-Identifier: MIT
 *
 * export - files that a window writes beside its program: where, under which name, and over
 * what. Also paper: to a printer, into a PDF.
 *
 * A file is written whole, or what was there stays. Saving the program is files.c's.
 */
#ifndef EDITOR_EXPORT_H
#define EDITOR_EXPORT_H

#include "editor-gtk/window/origin.h"

struct export {
	struct core *core;
	struct origin *origin;
};

typedef void export_write(gpointer part, const char *path);

void export_init(struct export *export, struct core *core, struct origin *origin);
/** export_named - @write(@part, @path), which gets the first of @endings (".csv|.txt") if it
 * has none of them. If a file of that name is there, of which the file dialog did not know,
 * the person is asked. */
void export_named(struct core *core, const char *path, const char *endings,
		  export_write *write, gpointer part);
/** export_ask - asks for a file beside the program, named as it, and writes it. @endings: as
 * above; lives for ever. Returns the dialog; it owns itself. */
GtkFileChooser *export_ask(struct export *export, const char *title, const char *endings,
			   export_write *write, gpointer part);
/** export_symbols - asks for a file: all symbols as a table. */
void export_symbols(struct export *export);
void export_pdf(struct export *export);
void export_print(struct export *export);

#endif

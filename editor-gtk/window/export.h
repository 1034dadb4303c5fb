/* SPDX-License-Identifier: MIT
 *
 * export - writes files beside the program (symbols, PDF), and prints.
 *
 * A file is replaced only if the new one was written whole. Saving the program is in
 * files.c.
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
/** export_named - calls @write(@part, path). Adds the first of @endings (".csv|.txt") if
 * @path has none of them; then asks before it replaces an existing file, which the file
 * chooser could not check. */
void export_named(struct core *core, const char *path, const char *endings,
		  export_write *write, gpointer part);
/** export_ask - asks for a file, proposed beside the program with its name, and writes it.
 * @endings: static. Returns the dialog; it frees itself. */
GtkFileChooser *export_ask(struct export *export, const char *title, const char *endings,
			   export_write *write, gpointer part);
/** export_symbols - asks for a file and writes all symbols as a table. */
void export_symbols(struct export *export);
void export_pdf(struct export *export);
void export_print(struct export *export);
/** export_preview - the page that shows what would be printed. */
void export_preview(struct export *export);

#endif

/* SPDX-License-Identifier: MIT
 *
 * chooser - where people are asked for a file; see chooser.h.
 */
#include "editor-gtk/document/chooser.h"

void chooser_beside(GtkFileChooserNative *chooser, LadderDocument *document)
{
	const char *path = ladder_document_path(document);
	GFile *file = path ? g_file_new_for_path(path) : NULL;
	GFile *folder = file ? g_file_get_parent(file) : NULL;

	if (folder)
		gtk_file_chooser_set_current_folder(GTK_FILE_CHOOSER(chooser), folder,
						    NULL);
	g_clear_object(&folder);
	g_clear_object(&file);
}

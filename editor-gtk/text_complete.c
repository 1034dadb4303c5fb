/* SPDX-License-Identifier: MIT
 *
 * text_complete - colours of IL and rung files, and what could stand at the cursor.
 */
#include "editor-gtk/text_complete.h"

GtkSourceLanguage *text_language(void)
{
	return gtk_source_language_manager_get_language(
		gtk_source_language_manager_get_default(), "rung");
}

void text_complete_attach(GtkSourceView *view, LadderDocument *document, int pou)
{
	(void)view;
	(void)document;
	(void)pou;
}

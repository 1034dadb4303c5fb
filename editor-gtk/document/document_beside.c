/* SPDX-License-Identifier: MIT
 *
 * document_beside - text files beside a document in its history: one Undo for all.
 *
 * They are saved by themselves, and what is done to them does not change the document.
 */
#include "editor-gtk/document/document_inside.h"

#include <string.h>

struct beside {
	file_apply apply; /* NULL: it is not shown any more                    */
	gpointer file;
};

int ladder_document_attach(LadderDocument *document, file_apply apply, gpointer file)
{
	const struct beside beside = { apply, file };

	if (!document->files)
		document->files = g_array_new(FALSE, FALSE, sizeof(struct beside));
	g_array_append_val(document->files, beside);
	return (int)document->files->len - 1;
}

void ladder_document_detach(LadderDocument *document, int file)
{
	g_array_index(document->files, struct beside, file) = (struct beside){ NULL, NULL };
	history_forget_file(document->history, file);
	document_tell_state(document);
}

void ladder_document_note(LadderDocument *document, int file, const char *name,
			  const char *key, gsize at, const char *before, const char *after)
{
	ladder_document_begin(document, name, key);
	history_add(document->history, change_new(CHANGE_FILE, file, at,
		document_one_text(before, strlen(before)),
		document_one_text(after, strlen(after))));
	ladder_document_end(document);
}

void document_apply_file(LadderDocument *document, const struct change *change,
			 const char *from, const char *to)
{
	const struct beside *beside =
		&g_array_index(document->files, struct beside, change->pou);

	if (!beside->apply)
		document_report_lost(from);
	beside->apply(beside->file, change->at, from, to);
}

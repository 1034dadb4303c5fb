/* SPDX-License-Identifier: MIT
 *
 * rename - gives a name of the project another name, wherever it is used: in the program, in
 * its scenarios, in each plant that these or the program's name choose, and in the status and
 * timing charts of its VIEW part.
 *
 * The engine renames programs; here names in scenarios and charts are found. All files change in one
 * step of the history. Files beside the project are not saved here.
 */
#ifndef EDITOR_RENAME_H
#define EDITOR_RENAME_H

#include "editor-gtk/document/document.h"

#include "engine/xref/xref.h"

/* A file beside the project that has the name, or the charts of the VIEW part. */
struct rename_file {
	char *path;      /* NULL: the VIEW part                               */
	char *text;      /* with the new name                                 */
	int places;
};

/** rename_files - the files beside the project that have the name, with @name in its place. A
 * plant has it if its variable of the same name has the address on the other side. @name NULL:
 * only counts.
 * Caller: g_ptr_array_unref(), of struct rename_file. Fails: NULL, and @why. */
GPtrArray *rename_files(LadderDocument *document, const struct xref_target *target,
			const char *name, char **why);
/** rename_refusal - why @name is refused, translated; NULL: it is not. Caller frees. */
char *rename_refusal(LadderDocument *document, const struct xref_target *target,
		     const char *name);
/** rename_everywhere - renames as one step, called @step. Emits "file-opened" of the document
 * for each file that was not open. @places: NULL, or gets how many changed. Fails: false,
 * nothing changed, and @why, which the caller frees. */
bool rename_everywhere(LadderDocument *document, const struct xref_target *target,
		       const char *name, const char *step, int *places, char **why);

/** rename_reason - why something cannot be renamed, translated. Owns: the caller. */
char *rename_reason(LadderDocument *document, const struct ladder_rename *how,
		    const char *name);

#endif

/* SPDX-License-Identifier: MIT
 *
 * pou_import - imports programs and blocks of another project, with their declarations.
 *
 * It also copies a program or block of a document to another file.
 *
 * The globals, structures and blocks that they use are imported too. Equal ones are shared.
 * A name that already means something else is changed in the import, never in the project,
 * and the result says so.
 */
#ifndef EDITOR_POU_IMPORT_H
#define EDITOR_POU_IMPORT_H

#include "editor-gtk/document/side_file.h"

/**
 * pou_import - into the document, as one step
 * @from:   the other project, loaded; borrowed, its parts may be renamed
 * @chosen: for each of its POUs
 * @told:   what was imported and renamed; or why nothing was
 *
 * Fails: false, nothing changed.
 */
bool pou_import(LadderDocument *document, struct ladder *from, const bool *chosen,
		GString *told);
/** pou_export - copies POU @pou, with what it needs, into the rung file @path, which is saved.
 * @told: as in pou_import(). Fails: false, the file is as before. A file of the project itself,
 * also by another path, is refused. */
bool pou_export(LadderDocument *document, int pou, const char *path, GString *told);
/** pou_export_text - the text of @file with the same copy. Owns: the caller. Fails: NULL, and
 * @told says why. */
char *pou_export_text(LadderDocument *document, int pou, LadderSideFile *file, GString *told);
/** pou_export_needs - as pou_import_needs(), for a POU of a document. Caller frees. */
char *pou_export_needs(LadderDocument *document, int pou);

#endif

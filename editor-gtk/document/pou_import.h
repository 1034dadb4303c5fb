/* SPDX-License-Identifier: MIT
 *
 * pou_import - imports programs and blocks of another project, with their declarations.
 *
 * The globals, structures and blocks that they use are imported too. Equal ones are shared.
 * A name that already means something else is changed in the import, never in the project,
 * and the result says so.
 */
#ifndef EDITOR_POU_IMPORT_H
#define EDITOR_POU_IMPORT_H

#include "editor-gtk/document/document.h"

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

#endif

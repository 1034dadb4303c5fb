/* SPDX-License-Identifier: MIT
 *
 * pou_import - programs and blocks of another project, with what they need.
 *
 * The globals, structures and blocks they use come along. What is there already and the
 * same is shared; a name that is taken by something else is changed in what comes, never
 * in what was there, and that is told.
 */
#ifndef EDITOR_POU_IMPORT_H
#define EDITOR_POU_IMPORT_H

#include "editor-gtk/document/document.h"

/**
 * pou_import - into the document, as one step
 * @from:   the other project, loaded; borrowed, other names may be given to its parts
 * @chosen: of each of its POUs
 * @told:   what came, what was renamed; or why nothing came
 *
 * Fails: false, nothing changed.
 */
bool pou_import(LadderDocument *document, struct ladder *from, const bool *chosen,
		GString *told);

#endif

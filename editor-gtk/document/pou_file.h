/* SPDX-License-Identifier: MIT
 *
 * pou_file - moves a program or block to another file, which the project includes.
 *
 * Only the POU moves, with the comments above it. What it uses stays where it is: an included
 * file and this one share all names. Both files change in one step, and neither is saved by it.
 */
#ifndef EDITOR_POU_FILE_H
#define EDITOR_POU_FILE_H

#include "editor-gtk/document/document.h"

/** pou_file_name - for a new file with the POU: "Motor.rung". Owns: the caller. */
char *pou_file_name(LadderDocument *document, int pou);
/** pou_file_refusal - why no new file beside the project can have this name, translated; NULL:
 * one can. Owns: the caller. */
char *pou_file_refusal(LadderDocument *document, const char *name);
/** pou_file_path - of the file @name beside the project. Owns: the caller. */
char *pou_file_path(LadderDocument *document, const char *name);
/**
 * pou_to_file - moves POU @pou to the file @path, as one step
 * @told: what was done, for the person; or why nothing was
 *
 * A file that does not exist is made. The INCLUDE stands where the POU stood, so programs keep
 * their order. A file with programs of its own that this project does not include gets the POU
 * with all that it needs, and the POU leaves the project. Emits "file-opened" of the document, also if it is open.
 * Fails: false, nothing changed: other POUs use it and the file cannot be included, or the
 * project could not be read or would have new errors.
 */
bool pou_to_file(LadderDocument *document, int pou, const char *path, GString *told);

#endif

/* SPDX-License-Identifier: MIT
 *
 * fbd_instances - the instances of blocks in lines of networks that are to be pasted.
 *
 * A block that a POU calls twice runs twice a scan, and a timer runs too fast: a copy needs an instance of its
 * own. It declares nothing.
 */
#ifndef EDITOR_FBD_INSTANCES_H
#define EDITOR_FBD_INSTANCES_H

#include "engine/model/project.h"

/** fbd_instance_again - an instance that @text, lines or networks, calls and POU @pou calls already.
 * @name: gets its name; @type: that of its block, borrowed from @project. False: there is none. */
bool fbd_instance_again(struct project *project, int pou, const char *text, char name[LIMIT_NAME + 1],
			const char **type);
/** fbd_instance_stem - its name without the number at its end. */
void fbd_instance_stem(const char *name, char stem[LIMIT_NAME + 1]);
/** fbd_name_replaced - @text with the name @to in place of @name, also in an index: Low, Low.X, A[Low + 1]. Owns: the caller, free(). NULL: no memory. */
char *fbd_name_replaced(const char *text, const char *name, const char *to);

#endif

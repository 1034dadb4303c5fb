/* SPDX-License-Identifier: MIT
 *
 * properties_dialog - the properties of the project, and those of a program or block.
 */
#ifndef EDITOR_PROPERTIES_DIALOG_H
#define EDITOR_PROPERTIES_DIALOG_H

#include "editor-gtk/window/core.h"

void project_properties_show(struct core *core);
/** pou_properties_show - name and comment can be changed, if it is not of another file. */
void pou_properties_show(struct core *core, int pou);

#endif

/* SPDX-License-Identifier: MIT
 *
 * sfc_tool - what the palette of a chart offers: a step, a branch, a jump, an action with its
 * qualifier.
 *
 * A table: texts and keys. sfc/ does them, sfc_icon.c draws them.
 */
#ifndef EDITOR_SFC_TOOL_H
#define EDITOR_SFC_TOOL_H

#include "editor-gtk/kit/verbs.h"
#include "engine/model/sfc.h"

enum sfc_tool {
	TOOL_STEP, TOOL_INITIAL, TOOL_MACRO,
	TOOL_TRANSITION, TOOL_ALTERNATIVE, TOOL_SIMULTANEOUS, TOOL_JUMP, TOOL_WAIT,
	TOOL_ACTION,     /* with QUALIFIER_N; the others follow                 */
	TOOL_COUNT = TOOL_ACTION + QUALIFIER_COUNT
};

/** sfc_tool_name - translated; of an action its qualifier. Lives for ever. */
const char *sfc_tool_name(enum sfc_tool tool);
/** sfc_tool_family - N_() text; the tools of a family follow each other. Lives for ever. */
const char *sfc_tool_family(enum sfc_tool tool);
/** sfc_tool_told - translated: what it does. Lives for ever. */
const char *sfc_tool_told(enum sfc_tool tool);
/** sfc_tool_verb - the verb that does the same by a key; VERB_COUNT: none. */
enum verb sfc_tool_verb(enum sfc_tool tool);

#endif

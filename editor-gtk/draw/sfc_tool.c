/* SPDX-License-Identifier: MIT
 *
 * sfc_tool - the table of the tools of a chart; see sfc_tool.h.
 */
#include "editor-gtk/draw/sfc_tool.h"

#include "editor-gtk/kit/i18n.h"

static const struct { const char *name, *told; enum verb verb; } tools[] = {
	[TOOL_STEP] = { N_("Step"), N_("a new step and the transition before it"),
			VERB_step_below },
	[TOOL_INITIAL] = { N_("Initial step"), N_("makes this step the initial step, or an ordinary one again"),
			   VERB_step_kind },
	[TOOL_MACRO] = { N_("Macro-step"), N_("puts the selected steps into one box"),
			 VERB_macro_make },
	[TOOL_TRANSITION] = { N_("Transition"),
			      N_("a new transition and the step behind it; asks for the condition"),
			      VERB_COUNT },
	[TOOL_ALTERNATIVE] = { N_("Alternative"), N_("another way out of the step"),
			       VERB_step_branch },
	[TOOL_SIMULTANEOUS] = { N_("Simultaneous"),
				N_("another step that becomes active at the same time"),
				VERB_step_parallel },
	[TOOL_JUMP] = { N_("Jump"), N_("a jump to a step of the chart"), VERB_lead_to },
	[TOOL_WAIT] = { N_("Wait"), N_("the transition also waits for another step"),
			VERB_wait_for },
};

static const char *const qualifiers[QUALIFIER_COUNT] = {
	[QUALIFIER_N] = N_("on while the step is active"),
	[QUALIFIER_S] = N_("on until R ends it"),
	[QUALIFIER_R] = N_("ends what S began"),
	[QUALIFIER_L] = N_("on for a time, at most as long as the step"),
	[QUALIFIER_D] = N_("on after a time, while the step is active"),
	[QUALIFIER_P] = N_("one scan, when the step becomes active"),
	[QUALIFIER_P0] = N_("one scan, when the step ends"),
	[QUALIFIER_P1] = N_("one scan, when the step begins"),
	[QUALIFIER_SD] = N_("on after a time, even if the step has ended, until R"),
	[QUALIFIER_DS] = N_("on after a time if the step is still active, until R"),
	[QUALIFIER_SL] = N_("on for a time, even if the step has ended"),
};

const char *sfc_tool_name(enum sfc_tool tool)
{
	return tool < TOOL_ACTION ? _(tools[tool].name) :
	       qualifier_word((enum qualifier)(tool - TOOL_ACTION));
}

const char *sfc_tool_family(enum sfc_tool tool)
{
	return tool < TOOL_TRANSITION ? N_("Steps") :
	       tool < TOOL_ACTION ? N_("Transitions") : N_("Actions");
}

const char *sfc_tool_told(enum sfc_tool tool)
{
	return _(tool < TOOL_ACTION ? tools[tool].told : qualifiers[tool - TOOL_ACTION]);
}

enum verb sfc_tool_verb(enum sfc_tool tool)
{
	return tool < TOOL_ACTION ? tools[tool].verb :
	       tool == TOOL_ACTION ? VERB_step_does : VERB_COUNT;
}

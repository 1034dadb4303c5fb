/* SPDX-License-Identifier: MIT
 *
 * sim_words - why a simulation stands, in the language of the session.
 */
#include "editor-gtk/sim/sim_inside.h"

#include "editor-gtk/kit/i18n.h"

char *sim_place_words(const struct fault_place *at)
{
	if (at->rung)
		return g_strdup_printf(_("%s, rung %u (%u,%u)"), at->pou, at->rung, at->row,
				       at->col);
	if (at->line)
		return g_strdup_printf(_("%s, line %u"), at->pou, at->line);
	return g_strdup(at->pou);
}

char *sim_fault_words(const struct resource *resource)
{
	char *place = sim_place_words(&resource->fault_at), *text;

	if (resource->fault_at.task)
		text = g_strdup_printf(_("task %s: %s: %s"), resource->fault_at.task,
				       said(fault_text(resource->fault)), place);
	else
		text = g_strdup_printf("%s: %s", said(fault_text(resource->fault)), place);
	g_free(place);
	return text;
}

char *sim_halt_words(const struct resource *resource)
{
	char *place = sim_place_words(&resource->halt_at);
	char *text = g_strdup_printf(_("STOP, outputs are safe: the program says so: %s"),
				     place);

	g_free(place);
	return text;
}

char *sim_failed_words(const struct resource *resource, bool faulted)
{
	char *place = sim_place_words(&resource->error_at);
	char *text = g_strdup_printf(faulted ?
		_("FAULT: an operation failed, such as a division by zero: %s. Outputs are "
		  "off; Run goes on with ENO FALSE, as the board does") :
		_("ENO is FALSE: an operation failed, such as a division by zero: %s"), place);

	g_free(place);
	return text;
}
